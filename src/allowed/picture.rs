//! Pixels' ranges as the picture that a judge reads.

use super::pixel::{ColorRange, PixelRange};
use crate::buffer::Buffer;
use crate::compare::{Choice, Extremes, FeatureRun, Hypothesis};
use crate::draw_list::DrawList;
use crate::math;

/// A picture of what pixels may be.
pub(super) fn hypothesis(name: String, pixels: &Buffer<PixelRange>) -> Hypothesis {
    let mut picture = Hypothesis { name, ..Hypothesis::default() };
    for (pixel, range) in (0..).zip(pixels.values()) {
        let [lo, hi] = codes(&range.all);
        picture.lo.push(lo);
        picture.hi.push(hi);
        picture.choices.extend(range.choices.iter().map(|choice| {
            let [lo, hi] = codes(choice);
            Choice { pixel, lo, hi }
        }));
        if let Some([least, most]) = range.extremes {
            let nearest = |color: [f64; 4]| color.map(|v| (within(v) * CODES + 0.5) as u16);
            picture.extremes.push(Extremes { pixel, least: nearest(least), most: nearest(most) });
        }
    }
    picture
}

/// The features that have a say in pixels, by rows.
pub(super) fn feature_runs(pixels: &Buffer<PixelRange>, list: &DrawList) -> Vec<FeatureRun> {
    let mut runs: Vec<FeatureRun> = Vec::new();
    for (row, pixels) in (0..).zip(pixels.values().chunks(pixels.width().max(1))) {
        let start = runs.len();
        for (column, range) in (0..).zip(pixels) {
            for item in range.items.iter().map(|item| &list.items()[*item as usize]) {
                let (layer, feature) = (item.layer, item.feature);
                let is_next = |run: &&mut FeatureRun| {
                    (run.layer, run.feature) == (layer, feature) && run.last + 1 >= column
                };
                match runs[start..].iter_mut().rev().find(is_next) {
                    Some(run) => run.last = column,
                    None => runs.push(FeatureRun { row, first: column, last: column, layer, feature }),
                }
            }
        }
    }
    runs
}

/// The largest code of 16 bits.
pub(super) const CODES: f64 = 65535.0;

/// A hair of a code, for the rounding of what is computed here.
const HAIR: f64 = 1e-6;

fn within(v: f64) -> f64 {
    math::min(math::max(v, 0.0), 1.0)
}

/// Codes around colours.
fn codes([low, high]: &ColorRange) -> [[u16; 4]; 2] {
    [
        low.map(|v| (within(v) * CODES - HAIR).floor() as u16),
        high.map(|v| (within(v) * CODES + HAIR).ceil() as u16),
    ]
}
