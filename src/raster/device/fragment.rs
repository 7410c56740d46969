//! What lines and faces of the screen leave in pixels.

/// A pixel that a line or a face covers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fragment {
    /// The pixel's column.
    pub column: usize,
    /// The pixel's row.
    pub row: usize,
    /// Depth at the pixel's centre: of a line, projected on it, so that it may leave 0..=1 beyond an end
    /// ([`super::DepthBuffer::store`] clamps it); of an anti-aliased face, that of the middle of what it covers.
    pub depth: f64,
    /// How much of the pixel is covered: 1, of what is anti-aliased more than 0 and at most 1.
    pub coverage: f64,
}
