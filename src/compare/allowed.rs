//! What a technique's picture may be, of whatever right program draws it.

/// What a picture and the buffers behind it may be. The judge reads it from a bundle; the renderer works it out.
///
/// Colours are straight alpha, encoded, in codes of 16 bits: 0..=65535 of 0..=1, red, green, blue, alpha. An 8-bit code is
/// 257 of them; the rounding of 8-bit targets is inside the intervals already.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Allowed {
    /// Pixels a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// What may be chosen once for the whole picture: the first is the technique at the scene's own settings. One of them
    /// has to fit all pixels.
    pub hypotheses: Vec<Hypothesis>,
    /// The buffers that a picture is made of, from the first stage to the last.
    pub stages: Vec<Stage>,
    /// Which features have a say in which pixels, by rows.
    pub features: Vec<FeatureRun>,
    /// What the picture would be by other choices, each tried on a picture that fails; none of them lets one pass. May be empty.
    pub alternatives: Vec<Alternative>,
}

/// What a picture would be if something were chosen otherwise than the scene has it.
#[derive(Debug, Clone, PartialEq)]
pub struct Alternative {
    /// The key of the scene file and its value, as `--set` has it.
    pub choice: String,
    /// The picture; what it says is what the choice means.
    pub hypothesis: Hypothesis,
}

/// What a picture may be by one set of choices that a program makes the same way everywhere.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Hypothesis {
    /// Its name in reports and files.
    pub name: String,
    /// What it assumes, in a sentence.
    pub says: String,
    /// The least of each pixel's channels, rounded down; rows from the top.
    pub lo: Vec<[u16; 4]>,
    /// The most of each pixel's channels, rounded up.
    pub hi: Vec<[u16; 4]>,
    /// Sorted by pixel. A pixel that has any must be in one of them; they lie within `lo` and `hi`.
    pub choices: Vec<Choice>,
    /// Sorted by pixel, one at most of each: those in which a decision is open.
    pub extremes: Vec<Extremes>,
}

/// One of few colours, with its rounding, that an open pixel may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Choice {
    /// Column + width * row.
    pub pixel: u32,
    /// The least of its channels.
    pub lo: [u16; 4],
    /// The most of its channels.
    pub hi: [u16; 4],
}

/// The two ends of an open pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Extremes {
    /// Column + width * row.
    pub pixel: u32,
    /// Its colour when all that is open is answered with out.
    pub least: [u16; 4],
    /// Its colour when all that is open is answered with in.
    pub most: [u16; 4],
}

/// What a buffer may be.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// The buffer's name, as in its file's.
    pub buffer: String,
    /// Its values.
    pub range: StageRange,
}

/// The values that a buffer may have.
#[derive(Debug, Clone, PartialEq)]
pub enum StageRange {
    /// Each value between two, ends included; rows from the top, then columns, then components. A buffer of samples has a few a pixel: it is as
    /// many times as wide and as high as the picture.
    Between {
        /// Values a pixel.
        components: usize,
        /// The least of each.
        lo: Vec<f64>,
        /// The most of each.
        hi: Vec<f64>,
    },
    /// One of a place's values here, sorted by place (column + width * row of the buffer); a place without any may have any value.
    OneOf(Vec<(u32, f64)>),
}

/// Pixels of a row in which a feature has a say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FeatureRun {
    /// The row, from 0 at the top.
    pub row: u32,
    /// The first column.
    pub first: u32,
    /// The last column.
    pub last: u32,
    /// The layer's place in the scene, from 0.
    pub layer: u32,
    /// The feature's place in its layer, from 0.
    pub feature: u32,
}
