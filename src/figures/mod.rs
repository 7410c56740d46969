//! The papers' figures, made again by their techniques, and some of our own: a folder a paper.
//!
//! Input: nothing; scenes are generated, so that everybody has them. Output: pictures (PNG) and drawings of structures (SVG), the same bits on every
//! machine, `figures.html` (one page with captions and what to look for) and `figures.json` ([`write()`]). What a renderer cannot make (photographs,
//! flow charts) and what other commands measure is in [`UNMADE`]. Refuses: names of no figure ([`chosen`]).

mod bars;
mod clippings;
mod curves;
mod drawing;
mod figure;
mod files;
mod made;
mod ours;
mod page;
mod pictures;
mod pixel_grid;
mod scenery;
mod schneider_klein;
mod she;
mod shot;
mod strips;
mod taibo;
mod unmade;
mod volumes;
mod wartell;
mod ways;
mod zechmeister;

pub use figure::{Content, Figure, Panel, Paper, Scale};
pub use files::{PAGE, write};
pub use made::hash;
pub use unmade::{UNMADE, Unmade};

use crate::error::{Error, Result};
use crate::scene_file::nearest;

/// Every figure, in the order of the page.
pub fn all() -> impl Iterator<Item = &'static Figure> {
    let papers = [
        schneider_klein::FIGURES,
        wartell::FIGURES,
        taibo::FIGURES,
        she::FIGURES,
        zechmeister::FIGURES,
        ours::FIGURES,
    ];
    papers.into_iter().flatten().copied()
}

/// The figures of these names, each a figure's or a paper's (all of its figures); all where there is no name. In the order of the page.
///
/// # Errors
/// When a name is no figure's, with the nearest.
pub fn chosen(names: &[String]) -> Result<Vec<&'static Figure>> {
    let is_named = |figure: &Figure, name: &str| figure.name == name || figure.paper.name() == name;
    for name in names {
        if !all().any(|figure| is_named(figure, name)) {
            return Err(unknown(name));
        }
    }
    let is_wanted = |figure: &&Figure| names.is_empty() || names.iter().any(|name| is_named(figure, name));
    Ok(all().filter(is_wanted).collect())
}

/// The refusal of a name.
fn unknown(name: &str) -> Error {
    let papers = Paper::ALL.iter().map(|paper| paper.name());
    let known: Vec<&str> = papers.chain(all().map(|figure| figure.name)).collect();
    let near = nearest(name, &known).map(|near| format!("did you mean `{near}`? ")).unwrap_or_default();
    Error::usage(format!("there is no figure `{name}`"))
        .help(format!("{near}`drapery figures --list` tells which there are"))
}
