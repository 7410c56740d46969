//! What a bundle holds: its numbers, its tables and the paints of its features.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde_json::Value;

/// An opened bundle.
pub struct Bundle {
    folder: PathBuf,
    pub parameters: Value,
    features: BTreeMap<(u64, u64), Value>,
    inverted: BTreeMap<u64, Value>,
}

/// A paint: straight and encoded, alpha with the feature's opacity in it.
pub type Paint = [f64; 4];

impl Bundle {
    pub fn open(folder: &Path) -> Result<Self, String> {
        let json = |name: &str| -> Result<Value, String> {
            let text = std::fs::read(folder.join(name)).map_err(|error| format!("{name}: {error}"))?;
            serde_json::from_slice(&text).map_err(|error| format!("{name}: {error}"))
        };
        let mut features = BTreeMap::new();
        let mut inverted = BTreeMap::new();
        for feature in json("features.geojson")?["features"].as_array().ok_or("no features")? {
            let of = &feature["properties"];
            let layer = of["layer-number"].as_u64().unwrap_or(0);
            if of["fill-invert"].as_bool() == Some(true) {
                inverted.insert(layer, feature.clone());
            } else {
                features.insert((layer, of["feature"].as_u64().unwrap_or(0)), feature.clone());
            }
        }
        Ok(Self { folder: folder.to_owned(), parameters: json("parameters.json")?, features, inverted })
    }

    pub fn technique(&self) -> &str {
        self.parameters["technique"].as_str().unwrap_or("")
    }

    /// A table, as f64 whatever it holds, and the number of its columns.
    pub fn table(&self, name: &str) -> Result<(Vec<f64>, usize), String> {
        let bytes = std::fs::read(self.folder.join(name)).map_err(|error| format!("{name}: {error}"))?;
        let header = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        let text = String::from_utf8_lossy(&bytes[10..header]).into_owned();
        let shape = text.split(['(', ')']).nth(1).ok_or("a table without a shape")?;
        let sizes: Vec<usize> = shape.split(',').filter_map(|size| size.trim().parse().ok()).collect();
        let body = &bytes[header..];
        let values = if text.contains("<f8") {
            body.chunks_exact(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect()
        } else if text.contains("<u4") {
            body.chunks_exact(4).map(|b| f64::from(u32::from_le_bytes(b.try_into().unwrap()))).collect()
        } else {
            body.iter().map(|b| f64::from(*b)).collect()
        };
        Ok((values, sizes[1..].iter().product::<usize>().max(1)))
    }

    /// A picture of the bundle as red, green, blue and alpha of eight bits, its width and its height; none where it has none.
    pub fn picture(&self, name: &str) -> Result<Option<(Vec<u8>, usize, usize)>, String> {
        let Ok(bytes) = std::fs::read(self.folder.join(name)) else { return Ok(None) };
        let wrong = |error: png::DecodingError| format!("{name}: {error}");
        let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        decoder
            .set_transformations(png::Transformations::normalize_to_color8() | png::Transformations::ALPHA);
        let mut reader = decoder.read_info().map_err(wrong)?;
        let mut texels = vec![0; reader.output_buffer_size().ok_or("a picture that is too large")?];
        let frame = reader.next_frame(&mut texels).map_err(wrong)?;
        let texels = match frame.color_type {
            png::ColorType::GrayscaleAlpha => {
                texels.chunks_exact(2).flat_map(|p| [p[0], p[0], p[0], p[1]]).collect()
            }
            _ => texels,
        };
        Ok(Some((texels, frame.width as usize, frame.height as usize)))
    }

    /// The table `T.NAME.npy` of the technique.
    pub fn own(&self, name: &str) -> Result<Vec<f64>, String> {
        Ok(self.table(&format!("{}.{name}.npy", self.technique()))?.0)
    }

    pub fn properties(&self, layer: u64, feature: u64) -> Result<&Value, String> {
        Ok(&self.feature(layer, feature)?["properties"])
    }

    /// A feature of a layer; `u32::MAX`: what is outside of all.
    pub fn feature(&self, layer: u64, feature: u64) -> Result<&Value, String> {
        let inverted = || self.inverted.get(&layer).filter(|_| feature == u64::from(u32::MAX));
        let found = self.features.get(&(layer, feature)).or_else(inverted);
        found.ok_or_else(|| format!("no feature {feature} of layer {layer}"))
    }

    /// The opacity of a layer as a whole.
    pub fn layer_opacity(&self, layer: u64) -> f64 {
        let of = self.features.range((layer, 0)..(layer + 1, 0)).map(|(_, of)| of).next();
        let of = of.or(self.inverted.get(&layer));
        of.and_then(|of| of["properties"]["layer-opacity"].as_f64()).unwrap_or(1.0)
    }

    pub fn number(&self, path: &[&str]) -> Option<f64> {
        path.iter().fold(&self.parameters, |value, key| &value[*key]).as_f64()
    }

    pub fn word(&self, path: &[&str]) -> &str {
        path.iter().fold(&self.parameters, |value, key| &value[*key]).as_str().unwrap_or("")
    }

    pub fn numbers(&self, path: &[&str]) -> Vec<f64> {
        let found = path.iter().fold(&self.parameters, |value, key| &value[*key]).as_array();
        found.into_iter().flatten().filter_map(Value::as_f64).collect()
    }

    /// A matrix of `camera`, row after row.
    pub fn matrix(&self, name: &str) -> Vec<f64> {
        let rows = self.parameters["camera"][name].as_array();
        rows.into_iter().flatten().filter_map(Value::as_array).flatten().filter_map(Value::as_f64).collect()
    }
}

/// The paint that a style's `fill` or `stroke` is.
pub fn paint(of: &Value, kind: &str) -> Paint {
    let text = of[kind].as_str().unwrap_or("#000000").trim_start_matches('#');
    let code = |at: usize| text.get(at..at + 2).and_then(|code| u8::from_str_radix(code, 16).ok());
    let part = |at| f64::from(code(at).unwrap_or(255)) / 255.0;
    [part(0), part(2), part(4), part(6) * of[format!("{kind}-opacity")].as_f64().unwrap_or(1.0)]
}

pub fn to_linear(c: f64) -> f64 {
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

pub fn to_encoded(c: f64) -> f64 {
    if c <= 0.0031308 { c * 12.92 } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 }
}
