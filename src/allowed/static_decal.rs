//! Static decals (Zechmeister 2020): a sample is painted where its plan point lies in polygons, and in strokes as the thesis joins them.

use super::sampled::Sampling;
use crate::canvas::SamplePattern;
use crate::draw_list::DrawList;
use crate::error::{Error, Result};
use crate::footprint::Strokes;
use crate::technique::static_decal::{Edges, Joins, Outlines, Overlaps, Settings};

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
    let mut styles = list.styles().iter().filter(|style| style.stroke.is_some());
    if settings.overlaps == Overlaps::Double && styles.clone().any(|style| style.paint.0[3] < 1.0) {
        let instead = "technique.static-decal.overlaps = \"once\"";
        return Err(unknown("overlaps = \"double\" of translucent lines", instead));
    }
    if settings.outlines == Outlines::Side && styles.any(|style| style.cut.is_some()) {
        let instead = "technique.static-decal.outlines = \"polygon\"";
        return Err(unknown("outlines = \"side\" of outlines that are inset or offset", instead));
    }
    let strokes = match settings.joins {
        Joins::Thesis => Strokes::RoundBelow40,
        Joins::Style => Strokes::Style,
    };
    let spots = SamplePattern::of(settings.samples).map_or_else(Vec::new, SamplePattern::places);
    // A plan point is that of the terrain's depth along the pixel's ray, or interpolated.
    Ok(Sampling { spots, strokes, depths_of_shifts: 1.0 })
}
