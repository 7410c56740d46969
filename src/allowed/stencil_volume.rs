//! Stencil volumes (Schneider & Klein 2007): a sample is painted where its visible point lies between walls that stand on footprints.

use super::pixel::Blending;
use super::sampled::Sampling;
use crate::canvas::SamplePattern;
use crate::footprint::Strokes;
use crate::technique::stencil_volume::{Settings, VolumeJoins};

/// Where the technique takes samples, and its strokes.
pub(super) fn sampling(settings: &Settings) -> Sampling {
    let spots = SamplePattern::Grid(settings.samples as usize).places();
    let strokes = match settings.joins {
        VolumeJoins::None => Strokes::Rectangles,
        VolumeJoins::Style => Strokes::Polygons,
    };
    // A wall's depth is that of a place within a shift, and the terrain's that of another within a shift: two apart, and one from here.
    Sampling { spots, strokes, depths_of_shifts: 3.0, blending: Blending::Target }
}
