//! Features as GeoJSON (RFC 7946, but in the scene's plan coordinates), styled in the words of the simplestyle specification and
//! of the scene file.

use crate::parameter::Named;
use crate::scene::{Color, Feature, Join, Layer, Line, Shape, Width};
use crate::space::Plan;
use glam::DVec2;
use serde_json::{Map, Value, json};
use std::io::{self, Write};

/// Writes all features in draw order, each in a line, in absolute plan coordinates.
///
/// # Errors
/// Those of the writer.
pub fn write_features(layers: &[Layer], origin: DVec2, to: &mut dyn Write) -> io::Result<()> {
    write!(to, "{{\"type\":\"FeatureCollection\",\"features\":[")?;
    let mut separator = "\n";
    for layer in layers {
        for feature in &layer.features {
            to.write_all(separator.as_bytes())?;
            separator = ",\n";
            let properties = Value::Object(properties(layer, feature));
            write!(to, "{{\"type\":\"Feature\",\"properties\":{properties},\"geometry\":")?;
            write_shape(&feature.shape, origin, to)?;
            write!(to, "}}")?;
        }
    }
    write!(to, "\n]}}\n")
}

fn properties(layer: &Layer, feature: &Feature) -> Map<String, Value> {
    let mut all = Map::new();
    let mut put = |name: &str, value: Value| all.insert(name.into(), value);
    put("layer", layer.name.clone().into());
    put("number", feature.index.into());
    let style = layer.style_of(feature);
    let mut stroke = |line: &Line| {
        put("stroke", hex(line.color).into());
        put("stroke-opacity", line.color.0[3].into());
        match line.width {
            Width::Metres(width) => put("stroke-width-m", width.into()),
            Width::Pixels(width) => put("stroke-width-px", width.into()),
        };
        let (join, limit) = match line.join {
            Join::Round => ("round", None),
            Join::Bevel => ("bevel", None),
            Join::Miter { limit } => ("miter", Some(limit)),
        };
        put("join", join.into());
        if let Some(limit) = limit {
            put("miter-limit", limit.into());
        }
        put("cap", line.cap.word().into());
    };
    match &feature.shape {
        Shape::Line(_) => style.line.iter().for_each(stroke),
        Shape::Polygon(_) => {
            style.outline.iter().for_each(|outline| stroke(&outline.line));
            if let Some(outline) = &style.outline {
                put("outline-mode", outline.mode.word().into());
            }
            if let Some(fill) = &style.fill {
                put("fill", hex(fill.color).into());
                put("fill-opacity", fill.color.0[3].into());
                put("fill-rule", fill.rule.word().into());
            }
        }
    }
    all
}

/// A colour without its alpha, as the web writes it.
fn hex(color: Color) -> String {
    let code = |v: f64| (v * 255.0 + 0.5) as u8;
    let [r, g, b, _] = color.0.map(code);
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn write_shape(shape: &Shape, origin: DVec2, to: &mut dyn Write) -> io::Result<()> {
    let (kind, parts, closes) = match shape {
        Shape::Line(parts) => ("MultiLineString", parts, false),
        Shape::Polygon(rings) => ("Polygon", rings, true),
    };
    write!(to, "{{\"type\":\"{kind}\",\"coordinates\":[")?;
    for (k, part) in parts.iter().enumerate() {
        let first = part.first().filter(|_| closes);
        write!(to, "{}[", if k == 0 { "" } else { "," })?;
        for (k, Plan { x, y, .. }) in part.iter().chain(first).enumerate() {
            let place = json!([origin.x + x, origin.y + y]);
            write!(to, "{}{place}", if k == 0 { "" } else { "," })?;
        }
        write!(to, "]")?;
    }
    write!(to, "]}}")
}
