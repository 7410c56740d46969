//! How much detail of a grid is drawn.

/// A level-of-detail mesh of a grid, made anew for each view (Wartell et al. 2003, 2.1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevelOfDetail {
    /// What decides where posts are left out.
    pub detail: Detail,
    /// The share of quads whose own vertices are taken to be not there, 0..=1, so that they are drawn by those of a quad that holds them (3.2.1).
    pub borrow: f64,
}

/// What decides which posts of a grid are vertices of a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Detail {
    /// No triangle in view is farther from the full surface than so many pixels at its distance, finite; 0: all posts.
    ErrorPx(f64),
    /// Every 2^n-th post of every 2^n-th row.
    Level(u32),
}
