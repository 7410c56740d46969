//! Speed against error: what every technique costs and how far its picture is from the truth.
//!
//! Input: an opened scene, which [`measure()`] runs by every technique over its settings ([`sweep`]). Output: [`Measured`], its [`Run`]s and
//! pictures; [`write()`] makes of several a [`Report`] as `report.json`, `report.csv` ([`table`]), plots ([`plot`]) and one page that needs no
//! network ([`page`]). The papers' own tables are [`tables`]. Refuses: nothing that draws.
//!
//! ```no_run
//! use drapery::measure::Unwatched;
//! use drapery::output::Batch;
//! use drapery::{Budget, open, report};
//!
//! // A caller who wants times lends a clock: see `drapery::measure`.
//! let measured = report::measure(open("scene.toml")?, &Budget::default(), 1, &Unwatched)?;
//! report::write(vec![measured], 1, Batch::into("report".as_ref())?)?;
//! # Ok::<(), drapery::Error>(())
//! ```

mod axis;
mod exhibit;
mod files;
mod flip;
mod measuring;
mod notable;
pub mod page;
mod pareto;
pub mod plot;
mod run;
pub mod sweep;
pub mod table;
pub mod tables;

pub use exhibit::Exhibit;
pub use files::{PAGE, write};
pub use flip::flip;
pub use measuring::{Measured, measure};
pub use pareto::front;
pub use run::{Errors, Metric, REPORT_SCHEMA, Report, Run, SceneReport};

/// The name of the truth among the techniques'.
pub const TRUTH: &str = crate::truth::NAME;

/// The name of plain supersampling among the techniques'.
pub const SUPERSAMPLING: &str = "supersampling";
