//! Stencil volumes (Schneider & Klein 2007): a sample is painted where its visible point lies between walls that stand on footprints.

use super::pixel::Blending;
use super::sampled::Sampling;
use crate::canvas::SamplePattern;
use crate::error::{Error, Result};
use crate::footprint::Strokes;
use crate::technique::stencil_volume::{
    Counting, FarPlane, Grouping, Overflow, Settings, VolumeCaps, VolumeJoins,
};

/// Where the technique takes samples, and its strokes.
///
/// # Errors
/// When the settings ask for failures that the paper warns of, or for masks that several objects share.
pub(super) fn sampling(settings: &Settings) -> Result<Sampling> {
    let unknown = [
        (settings.method != Counting::Automatic, "method", "automatic"),
        (settings.overflow != Overflow::Wrap, "overflow", "wrap"),
        (settings.far != FarPlane::Clamp, "far", "clamp"),
        (settings.caps != VolumeCaps::Both, "caps", "both"),
        (settings.grouping != Grouping::Object, "grouping", "object"),
    ];
    if let Some((_, setting, known)) = unknown.into_iter().find(|(is_unknown, ..)| *is_unknown) {
        return Err(Error::unsupported(format!(
            "nobody knows what stencil-volume's picture may be with another `{setting}` than \"{known}\""
        ))
        .help("leave the setting out, or judge the picture by a tolerance"));
    }
    let samples_of_buffers = settings.samples as usize;
    let spots = SamplePattern::Grid(samples_of_buffers).places();
    let strokes = match settings.joins {
        VolumeJoins::None => Strokes::Rectangles,
        VolumeJoins::Style => Strokes::Polygons,
    };
    // A wall's depth is that of a place within a shift, and the terrain's that of another within a shift: two apart, and one from here.
    Ok(Sampling { spots, strokes, depths_of_shifts: 3.0, blending: Blending::Target, samples_of_buffers })
}
