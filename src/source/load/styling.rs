//! How features look: the settings of a style, each the same for all or told by a column.

use super::columns::Columns;
use crate::error::{Error, Result};
use crate::scene::{Attribute, Color, Feature, Fill, Line, Outline, Shape, Style, Width};
use crate::scene_file::{
    ByColumn, LayerSpec, LineSpec, PaintSpec, Scale, StyleSetting, WidthSpec, nearest_or_all,
};
use std::collections::BTreeMap;

/// The styles of a layer's features, each once in the order in which features have them, and at least one; each feature
/// names its own. A layer whose style asks for no column has one, whatever its features.
pub(super) fn styled(
    features: &mut [Feature],
    spec: &LayerSpec,
    columns: &Columns<'_>,
) -> Result<Vec<Style>> {
    let settings = Settings { spec, columns };
    if spec.style.columns().next().is_none() {
        return settings.style(Takes::ALL, 0).map(|style| vec![style]);
    }
    let mut styles: Vec<Style> = Vec::new();
    let mut numbers = BTreeMap::new();
    for feature in features {
        let style = settings
            .style(Takes::of(&feature.shape), feature.index)
            .map_err(|e| columns.blame(e.in_feature(feature.index)))?;
        feature.style = *numbers.entry(bits(&style)).or_insert_with(|| {
            styles.push(style);
            styles.len() as u32 - 1
        });
    }
    if styles.is_empty() {
        styles.push(Style::default());
    }
    Ok(styles)
}

/// What is painted outside of all of a layer's polygons: its fill, where that is inverted, which is the same for all.
pub(super) fn outside(spec: &LayerSpec) -> Option<Fill> {
    let fill = spec.style.fill.as_ref().filter(|fill| fill.is_inverted)?;
    match (&fill.paint.color, &fill.paint.opacity) {
        (StyleSetting::Constant(color), StyleSetting::Constant(opacity)) => {
            Some(Fill { color: color.with_opacity(*opacity), rule: fill.rule })
        }
        _ => None,
    }
}

/// All that may differ between the styles of a layer: which parts there are, their colours and widths. (A part's width has the same unit in
/// all of them.)
fn bits(style: &Style) -> Vec<u64> {
    let outline = style.outline.map(|outline| outline.line);
    let parts = [style.fill.is_some(), outline.is_some(), style.line.is_some(), style.point.is_some()];
    let parts = parts.map(u64::from);
    let lines = || outline.iter().chain(&style.line).chain(&style.point);
    let widths = lines().map(|line| match line.width {
        Width::Metres(width) | Width::Pixels(width) => width.to_bits(),
    });
    let colors = style.fill.iter().map(|fill| fill.color).chain(lines().map(|line| line.color));
    let colors = colors.flat_map(|Color(channels)| channels.map(f64::to_bits));
    parts.into_iter().chain(colors).chain(widths).collect()
}

/// Which parts of a style a feature takes; what it does not take is not asked of its columns.
#[derive(Clone, Copy)]
struct Takes {
    areas: bool,
    lines: bool,
    points: bool,
}

impl Takes {
    const ALL: Self = Self { areas: true, lines: true, points: true };

    fn of(shape: &Shape) -> Self {
        Self {
            areas: shape.is_area(),
            lines: matches!(shape, Shape::Line(_)),
            points: matches!(shape, Shape::Points(_)),
        }
    }
}

/// A layer's settings, to be looked up for its features.
struct Settings<'a> {
    spec: &'a LayerSpec,
    columns: &'a Columns<'a>,
}

impl Settings<'_> {
    fn style(&self, takes: Takes, index: usize) -> Result<Style> {
        let spec = &self.spec.style;
        let fill = spec.fill.as_ref().filter(|fill| takes.areas && !fill.is_inverted);
        let outline = spec.outline.as_ref();
        let outline = outline.filter(|_| takes.areas);
        let line = spec.line.as_ref().filter(|_| takes.lines);
        let fill =
            fill.map(|fill| Ok(Fill { color: self.color(&fill.paint, "fill", index)?, rule: fill.rule }));
        let outlined = outline.map(|outline| {
            let line = self.line(&outline.line, "outline", index)?;
            Ok(Outline { line, mode: outline.mode })
        });
        let lined = line.map(|line| self.line(line, "line", index));
        let point =
            spec.point.as_ref().filter(|_| takes.points).map(|point| self.line(point, "point", index));
        Ok(Style {
            fill: fill.transpose()?,
            outline: outlined.transpose()?,
            line: lined.transpose()?,
            point: point.transpose()?,
            swath: None,
            outline_dash: outline.and_then(|outline| outline.line.dash),
            line_dash: line.and_then(|line| line.dash),
        })
    }

    fn line(&self, line: &LineSpec, part: &str, index: usize) -> Result<Line> {
        let width = |setting, key| self.setting(setting, (part, key), between, index);
        Ok(Line {
            color: self.color(&line.paint, part, index)?,
            width: match &line.width {
                WidthSpec::Metres(setting) => Width::Metres(width(setting, "width_m")?),
                WidthSpec::Pixels(setting) => Width::Pixels(width(setting, "width_px")?),
            },
            join: line.join,
            cap: line.cap,
        })
    }

    fn color(&self, paint: &PaintSpec, part: &str, index: usize) -> Result<Color> {
        let mixed = |Color(a): Color, Color(b), t| Color(std::array::from_fn(|k| between(a[k], b[k], t)));
        let color = self.setting(&paint.color, (part, "color"), mixed, index)?;
        let opacity = self.setting(&paint.opacity, (part, "opacity"), between, index)?;
        Ok(color.with_opacity(opacity))
    }

    /// A setting for the feature with this number; `mix` is what lies between two stops.
    fn setting<T: Copy>(
        &self,
        setting: &StyleSetting<T>,
        (part, key): (&str, &str),
        mix: impl Fn(T, T, f64) -> T,
        index: usize,
    ) -> Result<T> {
        let by = match setting {
            StyleSetting::Constant(value) => return Ok(*value),
            StyleSetting::ByColumn(by) => by,
        };
        let key = || format!("layer.{}.{part}.{key}", self.spec.name);
        let value = self.columns.value(&by.column, index);
        let found = match (&by.scale, value) {
            (_, Attribute::Null) => None,
            (Scale::Map(entries), value) => entry(entries, value, key)?,
            (Scale::Stops(stops), value) => {
                let number = value.number().ok_or_else(|| no_number(&by.column, value, &key()))?;
                Some(along(stops, number, mix))
            }
        };
        found.or(by.default).ok_or_else(|| uncovered(by, value, &key()))
    }
}

/// What stands for a value. A number may have one spelling among the keys: of two it would not be known which is meant.
fn entry<T: Copy>(entries: &[(String, T)], value: &Attribute, map: impl Fn() -> String) -> Result<Option<T>> {
    let is_key = |key: &str| match value {
        Attribute::Null => false,
        Attribute::Boolean(flag) => key == if *flag { "true" } else { "false" },
        Attribute::Text(text) => key == text,
        Attribute::Integer(_) | Attribute::Number(_) => {
            let whole = key.parse().map(Attribute::Integer);
            whole.or_else(|_| key.parse().map(Attribute::Number)).is_ok_and(|key| key == *value)
        }
    };
    let mut found = entries.iter().filter(|(key, _)| is_key(key));
    match (found.next(), found.next()) {
        (Some((one, _)), Some((other, _))) => Err(Error::new(format!(
            "`{one}` and `{other}` in the map of `{}` are one number, {value}",
            map()
        ))
        .help("keep one of them")),
        (found, _) => Ok(found.map(|(_, setting)| *setting)),
    }
}

/// Linear between the stops around a number, and as at the last one beyond them.
fn along<T: Copy>(stops: &[(f64, T)], number: f64, mix: impl Fn(T, T, f64) -> T) -> T {
    let above = stops.partition_point(|(at, _)| *at <= number);
    if above == 0 || above == stops.len() {
        return stops[above.saturating_sub(1)].1;
    }
    let ((low, a), (high, b)) = (stops[above - 1], stops[above]);
    // The difference of two doubles may be none: half of it is. (Halves of the smallest doubles would be nothing.)
    let by = if (high - low).is_finite() { 1.0 } else { 0.5 };
    mix(a, b, (by * number - by * low) / (by * high - by * low))
}

fn between(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

fn no_number(column: &str, value: &Attribute, key: &str) -> Error {
    Error::new(format!("the column `{column}` holds {value}, and the stops of `{key}` are for numbers"))
        .help("write a `map` with an entry for each value in place of `stops`")
}

fn uncovered<T>(by: &ByColumn<T>, value: &Attribute, key: &str) -> Error {
    let column = &by.column;
    let Scale::Map(entries) = &by.scale else {
        return without_value(column, key);
    };
    if value.is_null() {
        return without_value(column, key);
    }
    let known: Vec<&str> = entries.iter().map(|(key, _)| key.as_str()).collect();
    let given = value.text().map_or_else(|| value.to_string(), Into::into);
    // The data is right there; what the scene calls it is not.
    let help = match value {
        Attribute::Boolean(_) => "entries of flags are called `true` and `false`".into(),
        _ => nearest_or_all(&given, &known, "entries"),
    };
    Error::new(format!(
        "the column `{column}` holds {value}, for which the map of `{key}` has no entry, and there is no `default`"
    ))
    .help(help)
}

fn without_value(column: &str, key: &str) -> Error {
    Error::new(format!("there is no value in the column `{column}`, and `{key}` has no `default`"))
        .help("give it a `default`, or leave such features out with `where`")
}
