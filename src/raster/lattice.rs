//! Where samples lie on the screen, and the linear map from the world to a tile's own coordinates.

use crate::space::{Lens, Ray, Screen, ViewFrame, World};
use crate::terrain::Bounds;
use glam::DVec3;

/// A regular lattice of samples: (column c, row r) lies at screen `(x + c * step, y + r * step)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice {
    /// Screen x of column 0.
    pub x: f64,
    /// Screen y of row 0.
    pub y: f64,
    /// Distance of neighbours in pixels.
    pub step: f64,
    /// Samples a row.
    pub columns: usize,
    /// Rows.
    pub rows: usize,
}

impl Lattice {
    /// The centres of a picture's pixels and `guard` pixels around it.
    pub fn centres(frame: &ViewFrame, guard: usize) -> Self {
        let start = 0.5 - guard as f64;
        let (columns, rows) = (frame.width() + 2 * guard, frame.height() + 2 * guard);
        Self { x: start, y: start, step: 1.0, columns, rows }
    }

    /// The corners of a picture's pixels.
    pub fn corners(frame: &ViewFrame) -> Self {
        Self { x: 0.0, y: 0.0, step: 1.0, columns: frame.width() + 1, rows: frame.height() + 1 }
    }

    /// n x n samples a pixel, in the middles of as many equal squares, of the rectangle of pixels at `corner`.
    pub fn samples(corner: [usize; 2], size: [usize; 2], n: usize) -> Self {
        let step = 1.0 / n as f64;
        let [x, y] = corner.map(|pixel| pixel as f64 + 0.5 * step);
        Self { x, y, step, columns: size[0] * n, rows: size[1] * n }
    }

    /// One sample a pixel of the rectangle of pixels at `corner`, at a place in each pixel, 0..=1 from its upper left corner.
    pub fn one_each(corner: [usize; 2], size: [usize; 2], place: [f64; 2]) -> Self {
        let at = |axis: usize| corner[axis] as f64 + place[axis];
        Self { x: at(0), y: at(1), step: 1.0, columns: size[0], rows: size[1] }
    }

    /// The screen point of a sample.
    #[inline(always)]
    pub fn at(&self, column: usize, row: usize) -> Screen {
        Screen::new(self.x + column as f64 * self.step, self.y + row as f64 * self.step)
    }
}

/// A tile of a lattice and how the world maps to it.
///
/// Tile coordinates are lattice columns and rows counted from the tile's middle, so that single precision resolves
/// 10^-5 of a sample's distance in the tile and around it.
#[derive(Debug, Clone)]
pub struct TileView {
    /// The view.
    pub frame: ViewFrame,
    /// The lattice.
    pub lattice: Lattice,
    /// The lattice column of the tile's first sample.
    pub column: usize,
    /// The lattice row of the tile's first sample.
    pub row: usize,
    /// Samples a row of the tile.
    pub width: usize,
    /// Rows of the tile.
    pub height: usize,
    /// Tile coordinates of the first sample.
    pub first: (f64, f64),
    rows: [DVec3; 3],
    eye: DVec3,
    depth_row: DVec3,
    gain: f64,
}

impl TileView {
    /// The tile that starts at (column, row) of the lattice.
    pub fn new(frame: &ViewFrame, lattice: &Lattice, (column, row): (usize, usize), size: usize) -> Self {
        let (width, height) = (size.min(lattice.columns - column), size.min(lattice.rows - row));
        let (middle_x, middle_y) = ((width / 2) as f64, (height / 2) as f64);
        let (at_x, at_y) = (column as f64 + middle_x, row as f64 + middle_y);
        // Tile coordinates of homogeneous pixel coordinates (X, Y, w): (X - x w) / step with x the tile's middle.
        let (x, y) = (lattice.x + at_x * lattice.step, lattice.y + at_y * lattice.step);
        let basis = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| frame.homogeneous(axis));
        let local =
            |h: DVec3| DVec3::new((h.x - x * h.z) / lattice.step, (h.y - y * h.z) / lattice.step, h.z);
        let columns = basis.map(local);
        let rows = [0, 1, 2].map(|k| DVec3::new(columns[0][k], columns[1][k], columns[2][k]));
        Self {
            frame: *frame,
            lattice: *lattice,
            column,
            row,
            width,
            height,
            first: (-middle_x, -middle_y),
            rows,
            eye: local(frame.homogeneous_eye()),
            depth_row: frame.forward(),
            gain: gain(frame, lattice),
        }
    }

    /// Homogeneous tile coordinates of a displacement (linear).
    #[inline(always)]
    pub fn map(&self, d: DVec3) -> DVec3 {
        DVec3::new(self.rows[0].dot(d), self.rows[1].dot(d), self.rows[2].dot(d))
    }

    /// Homogeneous tile coordinates of a point.
    #[inline(always)]
    pub fn map_point(&self, p: World) -> DVec3 {
        self.map(p - self.frame.eye()) + self.eye
    }

    /// View depth of a displacement (linear).
    #[inline(always)]
    pub fn depth(&self, d: DVec3) -> f64 {
        self.depth_row.dot(d)
    }

    /// Whether rays are parallel.
    #[inline(always)]
    pub fn is_parallel(&self) -> bool {
        matches!(self.frame.lens(), Lens::Parallel { .. })
    }

    /// How far a unit of the world may reach in tile coordinates at depth 1: the scale of every rounding error
    /// (see [`super::Facet`] and [`super::Patch`]).
    #[inline(always)]
    pub fn gain(&self) -> f64 {
        self.gain
    }

    /// The ray of the tile's sample (c, r).
    #[inline]
    pub fn ray(&self, c: usize, r: usize) -> Ray {
        self.frame.ray(self.lattice.at(self.column + c, self.row + r))
    }

    /// Tile coordinates of the last sample.
    #[inline(always)]
    pub fn last(&self) -> (f64, f64) {
        (self.first.0 + (self.width - 1) as f64, self.first.1 + (self.height - 1) as f64)
    }

    /// What a box can cover of the tile; `None` when it cannot touch a sample of it (beside the tile, in front of the
    /// near plane or beyond the far one).
    #[inline]
    pub fn reach_of(&self, bounds: &Bounds) -> Option<BoxReach> {
        let center = self.map_point(bounds.center);
        let axes = bounds.axes.map(|a| self.map(a));
        let size = (bounds.center - self.frame.eye()).abs().element_sum()
            + bounds.axes.iter().map(|a| a.abs().element_sum()).sum::<f64>()
            + self.frame.eye().to_vec().abs().max_element();
        // The four sides of the tile as linear functions that are positive inside; a slack of some roundings.
        let slack = 64.0 * f64::EPSILON * self.gain * size;
        let (first, last) = (self.first, self.last());
        let most = |k: usize, sign: f64, limit: f64| {
            let f = |h: DVec3| sign * (h[k] - limit * h.z);
            f(center) + f(axes[0]).abs() + f(axes[1]).abs() + f(axes[2]).abs() + slack
        };
        let outside = most(0, 1.0, first.0) < 0.0
            || most(0, -1.0, last.0) < 0.0
            || most(1, 1.0, first.1) < 0.0
            || most(1, -1.0, last.1) < 0.0;
        let depth = self.depth(bounds.center - self.frame.eye());
        let spread =
            bounds.axes.iter().map(|a| self.depth(*a).abs()).sum::<f64>() + 64.0 * f64::EPSILON * size;
        if outside || depth + spread < self.frame.near() || depth - spread > self.frame.far() {
            return None;
        }
        Some(BoxReach { center, axes, depth: (depth - spread, depth + spread), size, slack })
    }
}

/// A box in homogeneous tile coordinates.
#[derive(Debug, Clone, Copy)]
pub struct BoxReach {
    center: DVec3,
    axes: [DVec3; 3],
    /// The least and the greatest view depth in the box.
    pub depth: (f64, f64),
    /// A bound of the sizes of all coordinates that enter, metres.
    pub size: f64,
    /// A bound of the error of homogeneous tile coordinates of points in the box.
    pub slack: f64,
}

impl BoxReach {
    /// The rectangle (x0, y0, x1, y1) in tile coordinates that holds the box's picture; it lies beyond the near plane.
    #[inline]
    pub fn rectangle(&self) -> [f64; 4] {
        let mut out = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
        for corner in 0..8u32 {
            let sign = |bit: u32| if corner >> bit & 1 == 1 { 1.0 } else { -1.0 };
            let h = self.center + self.axes[0] * sign(0) + self.axes[1] * sign(1) + self.axes[2] * sign(2);
            let (x, y) = (h.x / h.z, h.y / h.z);
            out = [
                crate::math::min(x, out[0]),
                crate::math::min(y, out[1]),
                crate::math::max(x, out[2]),
                crate::math::max(y, out[3]),
            ];
        }
        out
    }
}

/// The scale of rounding errors: extents of the lattice plus, for rays far off the axis, the square of their slope.
fn gain(frame: &ViewFrame, lattice: &Lattice) -> f64 {
    let pixel = frame.lens().pixel();
    let extent = (lattice.columns + lattice.rows) as f64;
    let slope = match frame.lens() {
        Lens::Central { .. } => 1.0 + pixel * (frame.width() + frame.height()) as f64,
        Lens::Parallel { .. } => 1.0,
    };
    slope * slope / (pixel * lattice.step) + extent
}
