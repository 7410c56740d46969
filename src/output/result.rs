//! `result.json`: what a run of `render` tells to programs.
//!
//! Keys stand in the order of the fields here, numbers are written so that they are read back as they were, and
//! nothing names the machine, the day or a path outside the folder.

use crate::error::{Error, Result};
use serde::ser::{Serialize, SerializeMap, Serializer};
use serde_json::Value;

/// The version of the layout: it grows when something that was there changes or goes.
pub const RESULT_SCHEMA: u32 = 1;

/// The whole file.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct RenderResult {
    /// [`RESULT_SCHEMA`].
    pub schema: u32,
    /// What was drawn.
    pub scene: SceneResult,
    /// What the user should know about the input.
    pub notes: Vec<String>,
    /// How, by each technique.
    pub runs: Vec<RunResult>,
    /// What there is at the pixel that was asked about.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pick: Option<PickResult>,
    /// The items that the buffers `id` and `ids` and `pick` name, by their numbers; absent where nobody asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub items: Option<Vec<ItemResult>>,
}

/// What there is at a pixel.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct PickResult {
    /// Its column and row.
    pub pixel: [usize; 2],
    /// By each technique.
    pub runs: Vec<PickedRun>,
}

/// What there is at a pixel by a technique.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct PickedRun {
    /// The technique's name.
    pub technique: String,
    /// The topmost item at the pixel's middle; `null` where there is none.
    pub topmost: Option<u32>,
    /// All items that touch the pixel, the topmost first; `null` where the technique cannot tell.
    pub items: Option<Vec<PickedItem>>,
}

/// An item that touches a pixel.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct PickedItem {
    /// Its number.
    pub item: u32,
    /// How much of the pixel it covers, at least and at most; of the truth alone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub coverage: Option<[f64; 2]>,
}

/// What an item is.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct ItemResult {
    /// Its number, in draw order.
    pub item: u32,
    /// The number of its layer.
    pub layer: u32,
    /// The layer's name.
    pub layer_name: String,
    /// Its feature's place in the layer, in draw order; `null` of what lies outside of all.
    pub feature: Option<u32>,
    /// The feature's number in its file.
    pub number: Option<u32>,
    /// What it is of the feature: `fill`, `outline`, `line`, `point`, `outside`, or on a globe `stroke`.
    pub part: String,
    /// The feature's name, if it has an attribute that is called so.
    pub name: Option<String>,
    /// The feature's attributes.
    pub attributes: ByName,
}

/// What was drawn.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct SceneResult {
    /// The scene's name.
    pub name: String,
    /// The hash of what the scene file says (`SceneFile::hash`).
    pub hash: String,
    /// What the plan space is.
    pub plan_space: String,
    /// Absolute plan coordinates of the local zero point.
    pub origin: [f64; 2],
    /// Its absolute height.
    pub origin_height: f64,
    /// Where the view shows a level-of-detail mesh: how far that is from the full surface.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surface_error: Option<SurfaceError>,
}

/// How far a view's mesh is from the full surface, over the triangles that the view may see: upper bounds.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct SurfaceError {
    /// Up or down.
    pub metres: f64,
    /// In pixels of their size where each triangle comes nearest to the eye; `null` where the eye may be in one.
    pub pixels: f64,
    /// Triangles that are left out, as some of the posts in them are missing and some are not.
    pub left_out: u32,
}

/// One technique's run.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct RunResult {
    /// The technique's name.
    pub technique: String,
    /// Its parameters, by their names in the scene file.
    pub parameters: ByName,
    /// The machine that was imitated, as the scene file writes it.
    pub device: ByName,
    /// The picture.
    pub image: ImageResult,
    /// Milliseconds to build the structures that do not depend on the camera: the median of all runs.
    pub prepare_ms: f64,
    /// Milliseconds to draw a frame, without the buffers that were asked for: the median of all runs.
    pub frame_ms: f64,
    /// Bytes of the technique's structures.
    pub structure_bytes: usize,
    /// What was counted.
    pub counts: ByName,
    /// How far the picture is from the truth; absent where that was not computed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<ErrorResult>,
    /// The buffers that were asked for.
    pub buffers: Vec<BufferResult>,
}

/// A picture.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct ImageResult {
    /// Its file in the folder.
    pub path: String,
    /// Pixels a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// BLAKE3 over the pixel values in row order.
    pub hash: String,
}

/// How far a picture is from the truth, in units of 1.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct ErrorResult {
    /// The largest.
    pub max: f64,
    /// The mean.
    pub mean: f64,
    /// The root of the mean square.
    pub rmse: f64,
    /// What 99 of 100 values do not exceed.
    pub p99: f64,
    /// The share of pixels that are off by more than 1/255.
    pub over_one_code_value: f64,
    /// The width of the widest interval of the truth.
    pub reference_width_max: f64,
}

/// A buffer.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct BufferResult {
    /// Its name.
    pub name: String,
    /// Its file in the folder.
    pub path: String,
    /// How many bytes its values have, in the kind of numbers of the file.
    pub bytes: usize,
    /// BLAKE3 over its values in scene-local coordinates (the file has absolute ones), so that it is the same for a
    /// scene that is moved as a whole.
    pub hash: String,
}

/// Values by name, in an order of their own.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ByName(pub Vec<(String, Value)>);

impl ByName {
    /// Values.
    pub fn from_pairs<'a, V: Into<Value>>(pairs: impl IntoIterator<Item = (&'a str, V)>) -> Self {
        let pairs = pairs.into_iter();
        Self(pairs.map(|(name, value)| (name.to_owned(), value.into())).collect())
    }
}

impl Serialize for ByName {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (name, value) in &self.0 {
            map.serialize_entry(name, value)?;
        }
        map.end()
    }
}

impl RenderResult {
    /// The text of the file.
    ///
    /// # Errors
    /// Internal errors only.
    pub fn to_json(&self) -> Result<String> {
        let text = serde_json::to_string_pretty(self);
        let text = text.map_err(|error| Error::internal(format!("result.json: {error}")).caused_by(error))?;
        Ok(text + "\n")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example() -> RenderResult {
        RenderResult {
            schema: RESULT_SCHEMA,
            scene: SceneResult {
                name: "valley".into(),
                hash: "00".into(),
                plan_space: "EPSG:32733".into(),
                origin: [500_000.1, 0.0],
                origin_height: 120.0,
                surface_error: Some(SurfaceError { metres: 1.5, pixels: f64::INFINITY, left_out: 0 }),
            },
            notes: vec!["a \"note\"".into()],
            pick: None,
            items: None,
            runs: vec![RunResult {
                technique: "inverse-projection".into(),
                parameters: ByName::from_pairs([("samples", Value::from(3)), ("corners", "true".into())]),
                device: ByName::from_pairs([("precision", "f64")]),
                image: ImageResult {
                    path: "inverse-projection.png".into(),
                    width: 2,
                    height: 1,
                    hash: "11".into(),
                },
                prepare_ms: 0.1,
                frame_ms: 2.0,
                structure_bytes: 12,
                counts: ByName::from_pairs([("refused", u64::MAX), ("full", 1)]),
                error: Some(ErrorResult {
                    max: 0.5,
                    mean: 0.25,
                    rmse: 0.125,
                    p99: 0.5,
                    over_one_code_value: 0.75,
                    reference_width_max: 0.001,
                }),
                buffers: Vec::new(),
            }],
        }
    }

    #[test]
    fn the_file_has_the_fields_of_the_contract_in_its_order() {
        insta::assert_snapshot!(example().to_json().unwrap(), @r#"
        {
          "schema": 1,
          "scene": {
            "name": "valley",
            "hash": "00",
            "plan_space": "EPSG:32733",
            "origin": [
              500000.1,
              0.0
            ],
            "origin_height": 120.0,
            "surface_error": {
              "metres": 1.5,
              "pixels": null,
              "left_out": 0
            }
          },
          "notes": [
            "a \"note\""
          ],
          "runs": [
            {
              "technique": "inverse-projection",
              "parameters": {
                "samples": 3,
                "corners": "true"
              },
              "device": {
                "precision": "f64"
              },
              "image": {
                "path": "inverse-projection.png",
                "width": 2,
                "height": 1,
                "hash": "11"
              },
              "prepare_ms": 0.1,
              "frame_ms": 2.0,
              "structure_bytes": 12,
              "counts": {
                "refused": 18446744073709551615,
                "full": 1
              },
              "error": {
                "max": 0.5,
                "mean": 0.25,
                "rmse": 0.125,
                "p99": 0.5,
                "over_one_code_value": 0.75,
                "reference_width_max": 0.001
              },
              "buffers": []
            }
          ]
        }
        "#);
    }

    #[test]
    fn a_run_without_the_truth_says_nothing_of_an_error() {
        let mut result = example();
        result.runs[0].error = None;
        let back: Value = serde_json::from_str(&result.to_json().unwrap()).unwrap();
        let run = back["runs"][0].as_object().unwrap();
        assert!(!run.contains_key("error") && run.contains_key("counts"));
    }

    #[test]
    fn numbers_are_read_back_as_they_were() {
        let back: Value = serde_json::from_str(&example().to_json().unwrap()).unwrap();
        assert_eq!(back["scene"]["origin"][0], 500_000.1);
        assert_eq!(back["runs"][0]["counts"]["refused"], u64::MAX);
        assert_eq!(back["runs"][0]["parameters"]["samples"], 3);
    }
}
