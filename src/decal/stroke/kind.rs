//! What there is at a segment's ends.

/// What closes the gap between two segments.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Corner {
    /// Nothing: there is no gap, or it has no area.
    None,
    Round,
    Miter,
    Bevel,
}

/// How a segment's rectangle ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum End {
    /// Where the line ends, at its vertex.
    Butt,
    /// Where the line ends, half a width on.
    Square,
    /// In a disc around the vertex.
    Round,
    /// At its vertex, where another segment goes on.
    Joined,
}
