//! How wide the truth's intervals are.

use super::super::figure::{Figure, Panel, Paper, Scale};
use super::super::shot::Shot;
use crate::compare::{Difference, Expected};
use crate::error::{Error, Result};
use crate::measure::image;
use crate::truth::{Budget, Truth};

const VALLEY: &str = include_str!("../schneider_klein/valley.toml");

pub(super) const INTERVALS: Figure = Figure {
    name: "ours-intervals",
    paper: Paper::Ours,
    number: "",
    title: "The truth, and how much of it is unknown",
    caption: "The right picture, and the width of each pixel's certified interval as pixels are cut into more and more pieces: black is less than a 65,535th, blue at most \
              a step of an 8-bit code, yellow to pink more.",
    look_for: "doubt lies on borders alone, and shrinks: the first budgets stop in the middle of the work and say so; the right value is in the interval all the same.",
    draw: intervals,
};

/// How often pixels are cut.
const DEPTHS: [u32; 3] = [2, 5, 12];

fn intervals(scale: Scale) -> Result<Vec<Panel>> {
    let shot = Shot::scaled(VALLEY, &[], scale)?;
    let mut panels = vec![Panel::picture("the truth's estimate", shot.truth()?)];
    for depth in DEPTHS {
        let truth = Truth::of(&shot.stage, &Budget::new(1.0 / 510.0, depth)?)?;
        let low = Expected::exactly(image(&truth.low)?);
        let width = Difference::of(&low, &image(&truth.high)?)
            .map_err(|what| Error::internal(format!("a truth's width: {what}")).caused_by(what))?;
        let caption = format!("at most {} pieces a pixel: widest {:.4}", 1u32 << depth, truth.widest());
        panels.push(Panel::picture(caption, width.heat_map(1.0 / 255.0)));
    }
    Ok(panels)
}
