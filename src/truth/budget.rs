//! How much work the truth may be.

use crate::error::{Error, Result};

/// How exact the truth has to be, and how much work may go into a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Budget {
    /// A pixel is refined until no channel's interval is wider than this (units of 1).
    pub width: f64,
    /// A pixel is cut into at most 2^depth pieces.
    pub depth: u32,
    /// Whether the coverage of each item is kept, to the same width.
    pub coverage: bool,
}

impl Budget {
    /// The deepest that [`Budget::new`] takes: a million pieces.
    pub const MOST_DEPTH: u32 = 20;

    /// A budget without coverage.
    ///
    /// # Errors
    /// When the width is not in 0..=1 or the depth is over [`Budget::MOST_DEPTH`].
    pub fn new(width: f64, depth: u32) -> Result<Self> {
        if !(0.0..=1.0).contains(&width) {
            return Err(Error::new(format!("a truth of width {width} cannot be asked for"))
                .help("give a width from 0 (as narrow as the depth allows) to 1, such as 0.002"));
        }
        if depth > Self::MOST_DEPTH {
            return Err(Error::new(format!("2^{depth} pieces a pixel are too many"))
                .help(format!("give a depth of at most {}", Self::MOST_DEPTH)));
        }
        Ok(Self { width, depth, coverage: false })
    }
}

impl Default for Budget {
    /// Half a code value wide, 4,096 pieces.
    fn default() -> Self {
        Self { width: 1.0 / 510.0, depth: 12, coverage: false }
    }
}
