//! What is told of each run: the layout of `report.json`.

use crate::compare::Metrics;
use crate::error::{Error, Result};
use crate::measure::Times;
use crate::output::{ByName, SceneResult};
use std::cmp::Ordering;

/// The version of the layout of `report.json` and of the columns of `report.csv`: it grows when something that was there changes or
/// goes.
pub const REPORT_SCHEMA: u32 = 1;

/// Several scenes.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Report {
    /// [`REPORT_SCHEMA`].
    pub schema: u32,
    /// How many times each run was timed.
    pub repeat: u32,
    /// Each scene.
    pub scenes: Vec<SceneReport>,
}

/// All runs of a scene.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct SceneReport {
    /// What was drawn.
    pub scene: SceneResult,
    /// Pixels a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// What the user should know about the input.
    pub notes: Vec<String>,
    /// The width of the widest interval of the truth.
    pub reference_width_max: f64,
    /// How many pixels features touch; none: nothing was scored.
    pub feature_pixels: usize,
    /// The truth, each technique over its sweep, supersampling.
    pub runs: Vec<Run>,
}

/// A technique at one setting.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Run {
    /// The technique's name.
    pub technique: String,
    /// What differs from the scene's own settings: `samples=5`, or nothing.
    pub varied: Vec<String>,
    /// Whether these are the scene's own settings.
    pub is_own: bool,
    /// The runs of one line of the plot have the same, and are joined in the order of the list.
    #[serde(skip)]
    pub line: Option<String>,
    /// The parameters in use, by their names in the scene file.
    pub parameters: ByName,
    /// The machine that was imitated.
    pub device: ByName,
    /// Milliseconds to build what does not depend on the camera.
    pub prepare_ms: Times,
    /// Milliseconds of a frame.
    pub frame_ms: Times,
    /// Bytes of the technique's structures.
    pub structure_bytes: usize,
    /// What was counted.
    pub counts: ByName,
    /// How far the picture is from the truth; for the truth itself, how far it may be from the right picture.
    pub error: Errors,
    /// The same of the pixels alone that features touch: elsewhere only the ground's own edges are drawn.
    pub error_on_features: Errors,
    /// Whether the picture that was measured has 8-bit code values, whose rounding alone makes an error of up to 1/510.
    pub is_rounded: bool,
    /// BLAKE3 over the pixel values (8-bit code values) in row order.
    pub image_hash: String,
    /// Whether no other run of the scene is as fast and has as small a root mean square error.
    pub on_front: bool,
}

/// How far a picture is from the truth, in units of 1.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Errors {
    /// The largest distance.
    pub max: f64,
    /// The mean.
    pub mean: f64,
    /// The root of the mean square.
    pub rmse: f64,
    /// What 99 of 100 values do not exceed.
    pub p99: f64,
    /// The share of pixels that are off by more than 1/255.
    pub over_one_code_value: f64,
    /// The mean of FLIP against the truth's picture: for information, its last digits may differ between machines.
    pub flip_mean: Option<f64>,
}

impl Errors {
    /// The errors of a comparison.
    pub fn of(metrics: &Metrics, flip_mean: Option<f64>) -> Self {
        Self {
            max: metrics.max,
            mean: metrics.mean,
            rmse: metrics.rmse,
            p99: metrics.p99,
            over_one_code_value: metrics.over_one_code_value,
            flip_mean,
        }
    }
}

/// A number that tells how far a picture is from the truth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Metric {
    /// The root of the mean square over the pixels that features touch.
    FeatureRmse,
    /// The root of the mean square.
    Rmse,
    /// The mean.
    Mean,
    /// The 99th percentile.
    P99,
    /// The largest.
    Max,
    /// The share of pixels off by more than a code value.
    OverOne,
}

impl Metric {
    /// All, the one that is shown first at the front.
    pub const ALL: [Self; 6] =
        [Self::FeatureRmse, Self::Rmse, Self::Mean, Self::P99, Self::Max, Self::OverOne];

    /// A short name, for files.
    pub fn name(self) -> &'static str {
        match self {
            Self::FeatureRmse => "feature-rmse",
            Self::Rmse => "rmse",
            Self::Mean => "mean",
            Self::P99 => "p99",
            Self::Max => "max",
            Self::OverOne => "over-one",
        }
    }

    /// A word for a button.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::FeatureRmse => "root mean square on features",
            Self::Rmse => "root mean square",
            Self::Mean => "mean",
            Self::P99 => "99th percentile",
            Self::Max => "largest",
            Self::OverOne => "share over 1/255",
        }
    }

    /// What an axis says.
    pub fn title(self) -> &'static str {
        match self {
            Self::FeatureRmse => "error: root mean square over pixels that features touch",
            Self::Rmse => "error: root mean square",
            Self::Mean => "error: mean",
            Self::P99 => "error: 99th percentile",
            Self::Max => "error: largest",
            Self::OverOne => "share of pixels off by more than 1/255",
        }
    }

    /// Its value.
    pub fn of(self, run: &Run) -> f64 {
        let errors = &run.error;
        match self {
            Self::FeatureRmse => run.error_on_features.rmse,
            Self::Rmse => errors.rmse,
            Self::Mean => errors.mean,
            Self::P99 => errors.p99,
            Self::Max => errors.max,
            Self::OverOne => errors.over_one_code_value,
        }
    }
}

impl Run {
    /// A name for people: the technique and what was varied.
    pub fn label(&self) -> String {
        match self.varied.is_empty() {
            true => self.technique.clone(),
            false => format!("{} {}", self.technique, self.varied.join(" ")),
        }
    }

    /// Orders by the error that is shown first; of equals, the faster is less.
    pub fn by_error(&self, other: &Self) -> Ordering {
        let key = |run: &Self| (run.error.rmse, run.frame_ms.median);
        key(self).partial_cmp(&key(other)).unwrap_or(Ordering::Equal)
    }
}

impl SceneReport {
    /// Marks the runs that no other is both as fast and as right as.
    pub fn mark_front(&mut self) {
        let points: Vec<[f64; 2]> =
            self.runs.iter().map(|run| [run.frame_ms.median, Metric::Rmse.of(run)]).collect();
        let front = super::front(&points);
        for (k, run) in self.runs.iter_mut().enumerate() {
            run.on_front = front.contains(&k);
        }
    }
}

impl Report {
    /// The text of `report.json`.
    ///
    /// # Errors
    /// Internal errors only.
    pub fn to_json(&self) -> Result<String> {
        let text = serde_json::to_string_pretty(self);
        Ok(text.map_err(|error| Error::internal(format!("report.json: {error}")).caused_by(error))? + "\n")
    }
}
