//! Speed against error: what every technique costs and how far its picture is from the truth.
//!
//! Input: a [`Truth`], and for each setting of a technique ([`sweep`]) its picture and times, as [`Run`]s. Output: [`Report`], which becomes
//! `report.json`, `report.csv` ([`table`]), plots ([`plot`]) and one page that needs no network ([`page`]); the papers' own tables are [`tables`]. Refuses: nothing. It
//! measures no time itself.

mod axis;
mod exhibit;
mod flip;
pub mod page;
mod pareto;
pub mod plot;
mod run;
pub mod sweep;
pub mod table;
pub mod tables;

pub use exhibit::Exhibit;
pub use flip::flip;
pub use pareto::front;
pub use run::{Errors, Metric, REPORT_SCHEMA, Report, Run, SceneReport, Times};

use crate::buffer::Buffer;
use crate::compare::{Expected, Image};
use crate::error::Result;
use crate::truth::Truth;

/// The name of the truth among the techniques'.
pub const TRUTH: &str = crate::truth::NAME;

/// The name of plain supersampling among the techniques'.
pub const SUPERSAMPLING: &str = "supersampling";

/// An interval that is no wider is that of one number.
const ROUNDING: f64 = 1e-12;

/// The truth as what is expected of a picture: each value between its bounds.
///
/// # Errors
/// Internal errors only.
pub fn expected(truth: &Truth) -> Result<Expected> {
    Expected::between(image(&truth.low)?, image(&truth.high)?)
}

/// Colours that were not rounded, as a picture to measure.
///
/// # Errors
/// When it has no pixel.
pub fn image(colors: &Buffer<[f64; 4]>) -> Result<Image> {
    Image::new(colors.width(), colors.height(), 4, colors.values().as_flattened().to_vec())
}

/// How far the truth's estimate may be from the right picture: half of each interval's width. What only allows for the rounding
/// of sums counts as nothing.
///
/// # Errors
/// When it has no pixel.
pub fn half_widths(truth: &Truth) -> Result<Image> {
    let bounds = truth.low.values().as_flattened().iter().zip(truth.high.values().as_flattened());
    let half = |width: f64| if width > ROUNDING { 0.5 * width } else { 0.0 };
    let halves = bounds.map(|(low, high)| half(high - low)).collect();
    Image::new(truth.low.width(), truth.low.height(), 4, halves)
}
