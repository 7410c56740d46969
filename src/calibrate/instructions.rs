//! What a client is to draw, as files.

use super::drawing::{Picture, Way};
use super::pictures::pictures;
use crate::buffer::{Plane, Values};
use crate::error::{Error, Result};
use crate::output::{Batch, Npy};
use serde_json::{Value, json};

/// What is to be done, for people.
const INSTRUCTIONS: &str = include_str!("instructions.md");

/// Writes the instructions; the files are in their places when it returns.
///
/// # Errors
/// When a file cannot be written: then no file is.
pub fn write_instructions(mut batch: Batch) -> Result<()> {
    let pictures = pictures();
    for picture in pictures.iter().filter(|picture| !picture.rectangles.is_empty()) {
        for (table, plane) in tables(picture) {
            let npy = Npy::new(&plane)?;
            batch.stage(&format!("{}.{table}.npy", picture.name), |to| npy.write(to))?;
        }
    }
    let told: Vec<Value> = pictures.iter().map(told).collect();
    let text = serde_json::to_string_pretty(&json!({ "schema": 1, "pictures": told }));
    let text =
        text.map_err(|error| Error::internal(format!("calibration.json: {error}")).caused_by(error))?;
    for (name, text) in [("calibration.json", &text[..]), ("README.md", INSTRUCTIONS)] {
        batch.stage(name, |to| to.write_all(text.as_bytes()).and_then(|()| to.write_all(b"\n")))?;
    }
    batch.commit()
}

/// What is told of a picture.
fn told(picture: &Picture) -> Value {
    let samples = if let Way::Samples(count) = picture.way { count } else { 1 };
    let depth = match picture.way {
        Way::Depth => "less",
        Way::DepthReversed => "greater",
        _ => "off",
    };
    let writes = match picture.way {
        Way::Interpolated => "depth",
        Way::Filtered => "texture",
        _ => "color",
    };
    json!({
        "name": picture.name,
        "width": picture.side,
        "height": picture.side,
        "samples": samples,
        "depth_test": depth,
        "writes": writes,
        "triangles": 2 * picture.rectangles.len(),
    })
}

/// The tables of a picture's triangles.
fn tables(picture: &Picture) -> [(&'static str, Plane); 3] {
    let half = picture.side as f64 / 2.0;
    let (mut vertices, mut triangles, mut colors) = (Vec::new(), Vec::new(), Vec::new());
    for (k, rectangle) in picture.rectangles.iter().enumerate() {
        let first = 4 * k as u32;
        triangles.extend([first, first + 1, first + 2, first, first + 2, first + 3]);
        colors.extend(rectangle.color.into_iter().chain(rectangle.color));
        for [x, y, z] in rectangle.corners() {
            vertices.extend([x / half - 1.0, 1.0 - y / half, z].map(|v| v as f32));
        }
    }
    let table = |name, values, rows: usize| Plane { name, width: 3, height: rows, components: 1, values };
    let count = picture.rectangles.len();
    [
        ("vertices", table("vertices", Values::F32(vertices), 4 * count)),
        ("triangles", table("triangles", Values::U32(triangles), 2 * count)),
        ("colors", table("colors", Values::U8(colors), 2 * count)),
    ]
}
