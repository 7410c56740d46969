//! Why a pixel has its colour, for a person: what is in it, what each technique did there, how near its decisions were, and what is right.
//!
//! Input: an opened scene, pixels of its view and techniques. Output: [`Account`]s, data with a text ([`Account::text`]), JSON and a page
//! ([`page`]). What is in a pixel comes from the mesh and the footprints, as the truth sees them, never from a technique; what a technique
//! did comes from the code that draws its frames ([`crate::technique::explain`]). Refuses: a pixel beside the picture, a technique that is
//! asked for and does not draw the scene, a feature that there is not.

mod absence;
mod account;
mod asking;
mod bench;
mod close_up;
mod interesting;
mod ladder;
mod margin;
mod names;
pub mod page;
mod scenery;
mod search;
mod techniques;
mod text;

pub use account::{Account, ByTechnique, Centre, Covering, LeftOut, Presence, Ray, Right, Rung, Step, Tried};
pub use asking::{Asking, pixel};
pub use interesting::{Interesting, picture};
pub use margin::{Margin, Silhouette};
pub use scenery::{Piece, Scenery, Shape};
