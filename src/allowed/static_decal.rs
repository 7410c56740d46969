//! Static decals (Zechmeister 2020): a sample is painted where its plan point lies in polygons, and in strokes as the thesis joins them.

use super::pixel::Blending;
use super::sampled::Sampling;
use crate::canvas::SamplePattern;
use crate::decal::{Edges, Joins, Outlines, Overlaps, Settings};
use crate::draw_list::{DrawList, ItemStyle};
use crate::error::{Error, Result};
use crate::footprint::Strokes;

/// Where the technique takes samples, and its strokes.
///
/// # Errors
/// When the settings ask for more than whether a sample is in such sets.
pub(super) fn sampling(settings: &Settings, list: &DrawList) -> Result<Sampling> {
    let unknown = |setting: &str, instead: &str| {
        Error::unsupported(format!("nobody knows what static-decal's picture may be with {setting}"))
            .help(format!("use {instead}, or judge it by its picture and a tolerance"))
    };
    if settings.edges == Edges::Analytic {
        return Err(unknown("edges = \"analytic\"", "technique.static-decal.edges = \"sampled\""));
    }
    let is_translucent = |style: &ItemStyle| style.stroke.is_some() && style.paint.0[3] < 1.0;
    if settings.overlaps == Overlaps::Double && list.styles().iter().any(is_translucent) {
        let instead = "technique.static-decal.overlaps = \"once\"";
        return Err(unknown("overlaps = \"double\" of translucent lines", instead));
    }
    let strokes = strokes(settings, false);
    let spots = SamplePattern::of(settings.samples).map_or_else(Vec::new, SamplePattern::places);
    // A plan point is that of the terrain's depth along the pixel's ray, or interpolated.
    Ok(Sampling { spots, strokes, depths_of_shifts: 1.0, blending: Blending::Shader, samples_of_buffers: 1 })
}

/// The strokes of the static decals among dynamic lines, whose samples are pixels' centres: those whose widths are in metres.
///
/// # Errors
/// As [`sampling`].
pub(super) fn strokes_in_metres(settings: &Settings, list: &DrawList) -> Result<Strokes> {
    sampling(settings, list).map(|_| strokes(settings, true))
}

fn strokes(settings: &Settings, in_metres_alone: bool) -> Strokes {
    Strokes::Decals {
        is_round_below_40: settings.joins == Joins::Thesis,
        is_cut_by_side: settings.outlines == Outlines::Side,
        in_metres_alone,
    }
}
