//! The style of a layer.

use super::by_column::{as_number, setting};
use crate::error::Result;
use crate::scene::{Cap, Color, Dash, Join};
use crate::scene_file::by_column::{
    FillSpec, LineSpec, OutlineSpec, PaintSpec, StyleSetting, StyleSpec, WidthSpec,
};
use crate::scene_file::names::JoinName;
use crate::scene_file::section::{Section, as_color, bug};

pub(super) fn style(section: &mut Section<'_>) -> Result<StyleSpec> {
    let origin = section.origin();
    Ok(StyleSpec {
        fill: section.take("fill").map(|node| Section::read(origin, node, fill)).transpose()?,
        outline: section.take("outline").map(|node| Section::read(origin, node, outline)).transpose()?,
        line: section.take("line").map(|node| Section::read(origin, node, line)).transpose()?,
        point: section.take("point").map(|node| Section::read(origin, node, point)).transpose()?,
    })
}

fn fill(section: &mut Section<'_>) -> Result<FillSpec> {
    let is_inverted = section.flag("invert")?.unwrap_or(false);
    let places = ["color", "opacity"].map(|key| section.first_of(&[key]).map(|(_, place)| place.clone()));
    let paint = paint(section)?;
    let columns = [paint.color.column(), paint.opacity.column()];
    let told = places.iter().zip(columns).find_map(|(place, column)| Some((place.as_ref()?, column?)));
    if let Some((place, column)) = told.filter(|_| is_inverted) {
        let what = format!(
            "an inverted fill is painted once, outside of all polygons: no column (`{column}`) can tell how"
        );
        return Err(section
            .error_at(place, what)
            .help("write one color and one opacity, or leave `invert` out"));
    }
    Ok(FillSpec { paint, rule: section.name("rule")?.unwrap_or_default(), is_inverted })
}

fn outline(section: &mut Section<'_>) -> Result<OutlineSpec> {
    let is_dashed = section.first_of(&["dash"]).is_some();
    if let Some((key, place)) = section.first_of(&["cap"]).filter(|_| !is_dashed) {
        return Err(section.error_at(place, format!("`{key}` of an outline goes with `dash` only")));
    }
    let cap = section.name("cap")?.unwrap_or_default();
    let line = stroke(section, cap)?;
    Ok(OutlineSpec { line, mode: section.name("mode")?.unwrap_or_default() })
}

fn line(section: &mut Section<'_>) -> Result<LineSpec> {
    let cap = section.name("cap")?.unwrap_or_default();
    stroke(section, cap)
}

/// A point is a line of no length with round caps.
fn point(section: &mut Section<'_>) -> Result<LineSpec> {
    stroke(section, Cap::Round)
}

fn stroke(section: &mut Section<'_>, cap: Cap) -> Result<LineSpec> {
    let (paint, width, join, dash) = (paint(section)?, width(section)?, join(section)?, dash(section)?);
    Ok(LineSpec { paint, width, join, cap, dash })
}

fn dash(section: &mut Section<'_>) -> Result<Option<Dash>> {
    let Some(lengths) = section.numbers_of_any_count("dash")? else {
        return match section.first_of(&["dash_offset"]) {
            Some((key, place)) => Err(section.error_at(place, format!("`{key}` goes with `dash` only"))),
            None => Ok(None),
        };
    };
    let offset = section.number("dash_offset")?.unwrap_or(0.0);
    Dash::new(&lengths, offset).map(Some).ok_or_else(|| bug("a pattern of dashes"))
}

fn paint(section: &mut Section<'_>) -> Result<PaintSpec> {
    let black = StyleSetting::Constant(Color([0.0, 0.0, 0.0, 1.0]));
    Ok(PaintSpec {
        color: setting(section, "color", as_color)?.unwrap_or(black),
        opacity: setting(section, "opacity", as_number)?.unwrap_or(StyleSetting::Constant(1.0)),
    })
}

fn width(section: &mut Section<'_>) -> Result<WidthSpec> {
    let metres = setting(section, "width_m", as_number)?;
    let pixels = setting(section, "width_px", as_number)?;
    Ok(pixels.map_or(WidthSpec::Metres(metres.unwrap_or(StyleSetting::Constant(1.0))), WidthSpec::Pixels))
}

fn join(section: &mut Section<'_>) -> Result<Join> {
    let name = section.name("join")?.unwrap_or(JoinName::Round);
    if name != JoinName::Miter
        && let Some((key, place)) = section.first_of(&["miter_limit"])
    {
        return Err(section.error_at(place, format!("`{key}` goes with join = \"miter\" only")));
    }
    Ok(match name {
        JoinName::Round => Join::Round,
        JoinName::Bevel => Join::Bevel,
        JoinName::Miter => Join::Miter { limit: section.number("miter_limit")?.unwrap_or(4.0) },
    })
}
