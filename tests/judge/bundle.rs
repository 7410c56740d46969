//! A bundle made by hand: 40 x 30 pixels, two hypotheses, open pixels in two rows, three buffers, two features.

use drapery::buffer::{Buffer, Plane, Values};
use drapery::output::{Npy, write_png};
use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};
use serde_json::json;
use std::path::Path;

pub const SIZE: (usize, usize) = (40, 30);
/// A row whose pixels may be 50 or 200 in red, nothing between.
pub const FEW: usize = 10;
/// A row whose pixels may be 40 to 220 in red.
pub const RANGE: usize = 20;

/// What the reference draws, in codes of 8 bits: by the first hypothesis, and by the second, which has other blues.
pub fn code(x: usize, y: usize, hypothesis: usize) -> [u8; 4] {
    let red = match y {
        FEW if x.is_multiple_of(2) => 50,
        FEW => 200,
        RANGE => 40 + 4 * x as u8,
        _ => x as u8,
    };
    [red, y as u8, 9 + 20 * hypothesis as u8, 255]
}

/// What a program draws: the reference's picture by a hypothesis, changed.
pub fn drawn(hypothesis: usize, change: impl Fn(usize, usize, &mut [u8; 4])) -> Buffer<[u8; 4]> {
    let pixel = |k: usize| {
        let (x, y) = (k % SIZE.0, k / SIZE.0);
        let mut pixel = code(x, y, hypothesis);
        change(x, y, &mut pixel);
        pixel
    };
    Buffer::from_values(SIZE.0, SIZE.1, (0..SIZE.0 * SIZE.1).map(pixel).collect())
}

pub fn write_picture(path: &Path, picture: &Buffer<[u8; 4]>) {
    let mut file = Vec::new();
    write_png(picture, &mut file).unwrap();
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(path, file).unwrap();
}

pub fn write_plane(path: &Path, width: usize, values: Values) {
    let length = match &values {
        Values::F64(values) => values.len(),
        Values::F32(values) => values.len(),
        Values::U32(values) => values.len(),
        Values::U16(values) => values.len(),
        Values::U8(values) => values.len(),
    };
    let plane = Plane { name: "table", width, height: length / width, components: 1, values };
    let mut file = Vec::new();
    Npy::new(&plane).unwrap().write(&mut file).unwrap();
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(path, file).unwrap();
}

/// One end of what a hypothesis allows: an 8-bit code and its rounding, and the open rows.
fn end(hypothesis: usize, is_hi: bool) -> Vec<u16> {
    let bounded = |(x, y): (usize, usize)| {
        let mut ends = code(x, y, hypothesis).map(|code| {
            let code = 257 * u16::from(code);
            if is_hi { code.saturating_add(128) } else { code.saturating_sub(128) }
        });
        let red = match (y, is_hi) {
            (FEW, false) => Some(50 * 257 - 128),
            (FEW, true) => Some(200 * 257 + 128),
            (RANGE, false) => Some(40 * 257),
            (RANGE, true) => Some(220 * 257),
            _ => None,
        };
        ends[0] = red.unwrap_or(ends[0]);
        ends
    };
    places().flat_map(bounded).collect()
}

fn places() -> impl Iterator<Item = (usize, usize)> {
    (0..SIZE.0 * SIZE.1).map(|k| (k % SIZE.0, k / SIZE.0))
}

fn write_end(path: &Path, codes: &[u16]) {
    let bytes: Vec<u8> = codes.iter().flat_map(|code| code.to_ne_bytes()).collect();
    let mut file = Vec::new();
    let (width, height) = (SIZE.0 as u32, SIZE.1 as u32);
    PngEncoder::new(&mut file).write_image(&bytes, width, height, ExtendedColorType::Rgba16).unwrap();
    std::fs::write(path, file).unwrap();
}

/// A row of a table: a pixel, and two colours that differ in red.
fn row((x, y): (usize, usize), hypothesis: usize, reds: [u8; 2], slack: u32) -> [u32; 9] {
    let colors = reds.map(|red| {
        let mut color = code(x, y, hypothesis);
        color[0] = red;
        color.map(|code| 257 * u32::from(code))
    });
    let mut row = [0; 9];
    row[0] = (y * SIZE.0 + x) as u32;
    for k in 0..4 {
        row[1 + k] = colors[0][k].saturating_sub(slack);
        row[5 + k] = (colors[1][k] + slack).min(65535);
    }
    row
}

/// The depth of each pixel.
pub fn depth() -> Vec<f64> {
    places().map(|(x, y)| if y == 0 { f64::INFINITY } else { 100.0 + x as f64 }).collect()
}

/// Writes a bundle, all but its manifest.
pub fn write_unsigned(folder: &Path) {
    let allowed = folder.join("allowed");
    std::fs::create_dir_all(&allowed).unwrap();
    write_picture(&folder.join("clipmap.png"), &drawn(0, |_, _, _| {}));
    let names = ["as-set", "other-blue"];
    for (h, name) in names.iter().enumerate() {
        write_end(&allowed.join(format!("{name}.lo.png")), &end(h, false));
        write_end(&allowed.join(format!("{name}.hi.png")), &end(h, true));
        let few = (0..SIZE.0).flat_map(|x| [50, 200].map(|red| row((x, FEW), h, [red, red], 128)));
        let few: Vec<u32> = few.flatten().collect();
        write_plane(&allowed.join(format!("{name}.choices.npy")), 9, Values::U32(few));
        let open = [(FEW, [50, 200]), (RANGE, [40, 220])];
        let open = open.iter().flat_map(|(y, ends)| (0..SIZE.0).map(move |x| row((x, *y), h, *ends, 0)));
        write_plane(&allowed.join(format!("{name}.extremes.npy")), 9, Values::U32(open.flatten().collect()));
    }
    let widened = |by: f64| Values::F64(depth().into_iter().map(|depth| depth + by).collect());
    write_plane(&allowed.join("depth.lo.npy"), SIZE.0, widened(-0.5));
    write_plane(&allowed.join("depth.hi.npy"), SIZE.0, widened(0.5));
    let one_of = Values::F64(vec![0.0, 7.0, 0.0, 8.0, 41.0, f64::from(u32::MAX)]);
    write_plane(&allowed.join("triangle.one-of.npy"), 2, one_of);
    let runs = [[FEW, 0, SIZE.0 - 1, 0, 0], [RANGE, 0, 19, 1, 0], [RANGE, 10, 39, 1, 1]];
    let runs = Values::U32(runs.as_flattened().iter().map(|value| *value as u32).collect());
    write_plane(&allowed.join("features.npy"), 5, runs);
    let feature = |layer: &str, [number, feature]: [u32; 2], name: &str| {
        let properties =
            json!({ "layer": layer, "layer-number": number, "feature": feature, "number": 3, "name": name });
        json!({ "type": "Feature", "properties": properties, "geometry": null })
    };
    let features = [
        feature("roads", [0, 0], "Main Street"),
        feature("lakes", [1, 0], "Mirror"),
        feature("lakes", [1, 1], ""),
    ];
    let features = json!({ "type": "FeatureCollection", "features": features });
    std::fs::write(folder.join("features.geojson"), features.to_string()).unwrap();
    let hypotheses = names.map(|name| {
        let file = |what: &str| format!("allowed/{name}.{what}");
        json!({ "name": name, "says": format!("blue is {name}"), "lo": file("lo.png"), "hi": file("hi.png"), "choices": file("choices.npy"), "extremes": file("extremes.npy") })
    });
    let document = json!({
        "schema": 1, "technique": "clipmap", "width": SIZE.0, "height": SIZE.1, "picture": "clipmap.png", "envelope": {}, "hypotheses": hypotheses,
        "stages": [{ "buffer": "depth", "lo": "allowed/depth.lo.npy", "hi": "allowed/depth.hi.npy" }, { "buffer": "triangle", "one-of": "allowed/triangle.one-of.npy" }],
        "features": "allowed/features.npy"
    });
    std::fs::write(folder.join("allowed.json"), document.to_string()).unwrap();
}

/// Writes the manifest of all that is in a bundle.
pub fn sign(folder: &Path) {
    let mut names: Vec<String> = ["", "allowed"].iter().flat_map(|below| files_in(folder, below)).collect();
    names.retain(|name| name != "manifest.json");
    names.sort();
    let entry = |name: &String| {
        let bytes = std::fs::read(folder.join(name)).unwrap();
        json!({ "name": name, "bytes": bytes.len(), "blake3": blake3::hash(&bytes).to_hex().as_str() })
    };
    let files: Vec<_> = names.iter().map(entry).collect();
    let manifest = json!({ "schema": 1, "program": "drapery 0.1.0", "kind": "bundle", "technique": "clipmap", "files": files });
    std::fs::write(folder.join("manifest.json"), manifest.to_string()).unwrap();
}

fn files_in(folder: &Path, below: &str) -> Vec<String> {
    let entries = std::fs::read_dir(folder.join(below)).unwrap().map(|entry| entry.unwrap());
    let files = entries.filter(|entry| entry.path().is_file());
    let name = |name: String| if below.is_empty() { name } else { format!("{below}/{name}") };
    files.map(|entry| name(entry.file_name().into_string().unwrap())).collect()
}

/// Writes a bundle.
pub fn write_bundle(folder: &Path) {
    write_unsigned(folder);
    sign(folder);
}
