//! `allowed.json`: where a bundle holds what it allows.

use serde::Deserialize;

pub(super) const NAME: &str = "allowed.json";
pub(super) const SCHEMA: u64 = 1;

#[derive(Debug, Deserialize)]
pub(super) struct Document {
    pub technique: String,
    pub width: usize,
    pub height: usize,
    /// The picture of the reference itself.
    pub picture: String,
    pub hypotheses: Vec<HypothesisFiles>,
    pub stages: Vec<StageFiles>,
    /// A table.
    pub features: String,
    /// What pictures would be by other choices; few bundles have any.
    #[serde(default)]
    pub alternatives: Vec<AlternativeFiles>,
}

#[derive(Debug, Deserialize)]
pub(super) struct AlternativeFiles {
    pub choice: String,
    #[serde(flatten)]
    pub hypothesis: HypothesisFiles,
}

#[derive(Debug, Deserialize)]
pub(super) struct HypothesisFiles {
    pub name: String,
    pub says: String,
    pub lo: String,
    pub hi: String,
    pub choices: String,
    pub extremes: String,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) struct StageFiles {
    pub buffer: String,
    pub lo: Option<String>,
    pub hi: Option<String>,
    pub one_of: Option<String>,
}
