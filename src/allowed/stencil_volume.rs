//! Stencil volumes (Schneider & Klein 2007): a sample is painted where its visible point lies between walls that stand on footprints.

use super::sampled::Sampling;
use crate::footprint::Strokes;
use crate::technique::stencil_volume::{Settings, VolumeJoins};

/// Where the technique takes samples, and its strokes.
pub(super) fn sampling(settings: &Settings) -> Sampling {
    let n = settings.samples;
    let place = |k: u32| (f64::from(k) + 0.5) / f64::from(n);
    let spots = (0..n).flat_map(|y| (0..n).map(move |x| [place(x), place(y)])).collect();
    let strokes = match settings.joins {
        VolumeJoins::None => Strokes::Rectangles,
        VolumeJoins::Style => Strokes::Polygons,
    };
    // A wall's depth and the terrain's are both those of places within a shift.
    Sampling { spots, strokes, depths_of_shifts: 2.0 }
}
