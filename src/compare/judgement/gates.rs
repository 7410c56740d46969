//! What a frame may have wrong and still pass.

/// The most failing pixels in a window of 16 x 16 that right programs had when a bundle allowed too little; each bug that one
/// can see had 13 and more.
pub const MOST_IN_WINDOW: usize = 4;

/// Limits of a judgement by what a bundle allows. A frame has to pass all of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Gates {
    /// So many pixels may lie outside of what is allowed.
    pub allow: usize,
    /// So many of them within any 16 x 16 pixels.
    pub densest: usize,
    /// Whether a frame fails whose open pixels lean all to one side.
    pub strict: bool,
}

impl Default for Gates {
    /// No pixel may lie outside.
    fn default() -> Self {
        Self { allow: 0, densest: MOST_IN_WINDOW, strict: false }
    }
}
