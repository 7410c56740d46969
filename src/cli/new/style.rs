//! The style of a layer in a starter scene: colours by what it shows, widths by what the camera shows.

use super::files::Layer;
use super::framing::Framing;
use super::rounding::two_digits;
use super::theme::{Look, Theme, shaded, written};
use crate::cli::written::{key, quoted_text};
use drapery::math::{max, min};
use drapery::scene::{Feature, Shape};
use drapery::source::vector::{ColumnKind, ColumnSummary};
use drapery::space::{Plan, PlanBox};

/// Borders are so many pixels wide.
const OUTLINE: f64 = 1.4;
/// Points are so many pixels wide.
const POINT: f64 = 9.0;
/// Lines and borders cover at most this share of the picture, as long as they are seen at all.
const CROWD: f64 = 0.10;
/// The share of a polygon's extent that its border takes at most.
const BORDER: f64 = 0.08;
/// The least width in pixels.
const LEAST: f64 = 0.3;
/// The colour of areas whose tag says nothing.
const UNKNOWN: [u8; 3] = [0xb5, 0xae, 0xa4];
/// Classes of roads, from the most important: words of OpenStreetMap, which others use too. The number is the rank.
const CLASSES: [(&str, usize); 16] = [
    ("motorway", 0),
    ("highway", 0),
    ("trunk", 0),
    ("primary", 1),
    ("major", 1),
    ("secondary", 2),
    ("tertiary", 3),
    ("minor", 3),
    ("unclassified", 4),
    ("residential", 4),
    ("living_street", 4),
    ("service", 5),
    ("track", 5),
    ("path", 6),
    ("footway", 6),
    ("cycleway", 6),
];
/// Widths of the ranks, as shares of the widest.
const RANKS: [f64; 7] = [1.0, 0.85, 0.7, 0.55, 0.45, 0.35, 0.25];

/// How large the parts of a layer are, where the camera looks.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Measures {
    /// Metres of lines.
    lines: f64,
    /// Metres of polygons' borders.
    borders: f64,
    /// How many points there are.
    points: usize,
    /// The middle one of the polygons' extents.
    extent: f64,
}

impl Measures {
    pub(super) fn of(features: &[Feature], plan: &PlanBox) -> Self {
        let mut measures = Self::default();
        let mut extents = Vec::new();
        for feature in features {
            let bounds = PlanBox::around(feature.shape.parts().flatten().copied());
            if !bounds.meets(plan) {
                continue;
            }
            if let Shape::Points(points) = &feature.shape {
                measures.points += points.len();
                continue;
            }
            let length: f64 = feature.shape.parts().map(|part| length_within(part, plan)).sum();
            if !feature.shape.is_area() {
                measures.lines += length;
            } else {
                let size = bounds.max - bounds.min;
                measures.borders += length;
                extents.push(max(size.x, size.y));
            }
        }
        extents.sort_by(f64::total_cmp);
        Self { extent: extents.get(extents.len() / 2).copied().unwrap_or(0.0), ..measures }
    }
}

/// The length of the segments that begin in a box.
fn length_within(part: &[Plan], plan: &PlanBox) -> f64 {
    let begins_inside = |pair: &&[Plan]| plan.meets(&PlanBox { min: pair[0], max: pair[0] });
    part.windows(2).filter(begins_inside).map(|pair| (pair[1] - pair[0]).length()).sum()
}

/// Widths in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Widths {
    pub(super) line: f64,
    pub(super) outline: f64,
    pub(super) point: f64,
}

impl Widths {
    /// Widths that are seen well and hide nothing.
    pub(super) fn of(look: &Look, measures: &Measures, framing: &Framing) -> Self {
        let pixel = framing.pixel;
        let size = framing.plan.max - framing.plan.min;
        let crowded = |pixels: f64, length: f64| {
            let room = if length > 0.0 { CROWD * size.x * size.y / length } else { f64::INFINITY };
            min(pixels * pixel, room)
        };
        let floor = LEAST * pixel;
        // Where an area is hardly filled, its border is what shows it.
        let outline = if look.opacity < 0.2 { look.width } else { OUTLINE };
        let border = if measures.extent > 0.0 { BORDER * measures.extent } else { f64::INFINITY };
        let apart = (CROWD * size.x * size.y / max(measures.points as f64, 1.0)).sqrt();
        Self {
            point: two_digits(max(min(POINT * pixel, apart), floor)),
            line: two_digits(max(crowded(look.width, measures.lines), floor)),
            outline: two_digits(max(min(crowded(outline, measures.borders), border), floor)),
        }
    }
}

/// The lines of a layer's table that say how it looks.
pub(super) fn lines(layer: &Layer<'_>, look: &Look, widths: Widths) -> String {
    let mut text = String::new();
    let (fill, stroke) = (written(look.fill), written(look.stroke));
    if layer.summary.polygons > 0 {
        let names_many = matches!(Theme::of(&layer.name), None | Some(Theme::Place));
        let tags = tags(layer, &["natural", "landuse", "building"]).filter(|_| names_many);
        let fill = tags.map_or(quoted_text(&fill), |column| by_theme(column, |look| look.fill, UNKNOWN));
        text += &format!("fill = {{ color = {fill}, opacity = {} }}\n", look.opacity);
        text += &format!(
            "outline = {{ color = \"{stroke}\", width_m = {}, mode = \"inset\" }}   # or width_px = 1.5\n",
            widths.outline
        );
    }
    if layer.summary.lines > 0 {
        let (color, width) = by_class(layer, look, widths.line)
            .unwrap_or_else(|| (quoted_text(&stroke), widths.line.to_string()));
        text += &format!(
            "line = {{ color = {color}, width_m = {width}, join = \"round\", cap = \"round\" }}   # or width_px = 3.0\n"
        );
    }
    if layer.summary.points > 0 {
        text += &format!(
            "point = {{ color = \"{stroke}\", width_m = {} }}   # or width_px = 9.0\n",
            widths.point
        );
    }
    text
}

/// Colour and width of lines by their class, where a column tells that. Of roads: one hue, the important ones darker and wider.
fn by_class(layer: &Layer<'_>, look: &Look, width: f64) -> Option<(String, String)> {
    match Theme::of(&layer.name) {
        Some(Theme::Road) => layer.summary.columns.iter().find_map(|column| by_rank(column, look, width)),
        None | Some(Theme::Place) => {
            let column = tags(layer, &["highway", "waterway"])?;
            let roads = Look { stroke: Theme::Road.look().stroke, ..*look };
            by_rank(column, &roads, width)
                .or_else(|| Some((by_theme(column, |look| look.stroke, look.stroke), width.to_string())))
        }
        Some(_) => None,
    }
}

/// Colour and width of roads by a column of their classes.
fn by_rank(column: &ColumnSummary, look: &Look, width: f64) -> Option<(String, String)> {
    let texts = column.frequent.iter().filter_map(|(value, _)| value.text());
    let classes: Vec<(&str, usize)> = texts.filter_map(|text| Some((text, rank(text)?))).collect();
    if classes.len() < 2 {
        return None;
    }
    let color = |rank: usize| written(if rank <= 1 { shaded(look.stroke, 1) } else { look.stroke });
    let wide = |rank: usize| two_digits(width * RANKS[rank]);
    let map = |value: &dyn Fn(usize) -> String| {
        let entries = classes.iter().map(|(text, rank)| (*text, value(*rank)));
        mapped(column, entries, &value(4))
    };
    Some((map(&|rank| quoted_text(&color(rank))), map(&|rank| wide(rank).to_string())))
}

/// The column of tags that most features of a layer have a value in.
fn tags<'a>(layer: &'a Layer<'_>, names: &[&str]) -> Option<&'a ColumnSummary> {
    let columns = layer.summary.columns.iter().filter(|column| names.contains(&&column.name[..]));
    columns.filter(|column| column.kind == ColumnKind::Text).max_by_key(|column| column.values)
}

/// Colours by a column of tags: each value has that of what it or the column names.
fn by_theme(column: &ColumnSummary, of: impl Fn(Look) -> [u8; 3], default: [u8; 3]) -> String {
    let kind = Theme::of(&column.name).filter(|kind| *kind != Theme::Field);
    let entries = column.frequent.iter().filter_map(|(value, _)| {
        let text = value.text()?;
        let theme = Theme::of(text).or(kind)?;
        Some((text, quoted_text(&written(of(theme.look())))))
    });
    mapped(column, entries, &quoted_text(&written(default)))
}

/// A value of a style by a column.
fn mapped<'a>(
    column: &ColumnSummary,
    entries: impl Iterator<Item = (&'a str, String)>,
    default: &str,
) -> String {
    let entries: Vec<String> = entries.map(|(text, value)| format!("{} = {value}", key(text))).collect();
    let by = quoted_text(&column.name);
    match entries.is_empty() {
        true => default.to_owned(),
        false => format!("{{ by = {by}, map = {{ {} }}, default = {default} }}", entries.join(", ")),
    }
}

/// How important a class of roads is.
fn rank(class: &str) -> Option<usize> {
    let class = class.to_lowercase();
    let class = class.strip_suffix("_link").unwrap_or(&class);
    CLASSES.iter().find(|(word, _)| *word == class).map(|(_, rank)| *rank)
}
