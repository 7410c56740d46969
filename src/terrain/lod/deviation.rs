//! How far a triangle of the hierarchy is from the full surface: exactly, over some of its posts.
//!
//! Input: the heights of posts, or their places in space ([`Value`]); a triangle. Output: [`Deviation`]. Refuses: nothing; posts beyond the grid are missing, as those
//! without a height.
//!
//! Both surfaces are linear over every smallest triangle, and these nest: the largest distance is that at a post.

use super::right_triangle::{Post, RightTriangle};
use crate::math;
use glam::DVec3;
use std::ops::{Add, Div, Mul, Sub};

/// What a surface has at a post.
pub(super) trait Value:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self> + Div<f64, Output = Self>
{
    /// Whether it is that of a post that is missing.
    fn is_missing(self) -> bool;

    /// A number that grows with the size of a difference; NaN of one from a missing post.
    fn measure(self) -> f64;

    /// The size of a difference by its [measure](Self::measure), metres.
    fn size_of(measure: f64) -> f64;

    /// The size of a difference, metres; NaN of one from a missing post.
    #[inline(always)]
    fn size(self) -> f64 {
        Self::size_of(self.measure())
    }
}

/// A height over a plane.
impl Value for f64 {
    #[inline(always)]
    fn is_missing(self) -> bool {
        self.is_nan()
    }

    #[inline(always)]
    fn measure(self) -> f64 {
        self.abs()
    }

    #[inline(always)]
    fn size_of(measure: f64) -> f64 {
        measure
    }
}

/// A place in space.
impl Value for DVec3 {
    #[inline(always)]
    fn is_missing(self) -> bool {
        self.is_nan()
    }

    #[inline(always)]
    fn measure(self) -> f64 {
        self.length_squared()
    }

    #[inline(always)]
    fn size_of(measure: f64) -> f64 {
        measure.sqrt()
    }
}

/// The distance of a triangle from the posts in it, and which there are.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Deviation {
    /// The largest, in metres, of the posts that are there; it counts where all are.
    pub most: f64,
    /// Whether some post is there.
    pub some_there: bool,
    /// Whether some post is missing.
    pub some_missing: bool,
}

impl Deviation {
    /// That of all of a triangle, of that of two parts of its posts.
    #[must_use]
    pub fn joined(self, other: Self) -> Self {
        Self {
            most: math::max(self.most, other.most),
            some_there: self.some_there || other.some_there,
            some_missing: self.some_missing || other.some_missing,
        }
    }

    /// That of posts which are all there.
    pub fn of_all(most: f64) -> Self {
        Self { most, some_there: true, some_missing: false }
    }
}

/// A rectangle of posts, its borders included.
#[derive(Debug)]
pub(super) struct Window<V> {
    /// The south-western post.
    pub low: Post,
    /// The north-eastern post.
    pub high: Post,
    /// Whether all its posts are there.
    pub is_whole: bool,
    /// What the surface has at them, row by row.
    values: Vec<V>,
}

impl<V: Value> Window<V> {
    /// A rectangle of posts whose rows `fill` appends; memory of an earlier one is used again.
    pub fn new(
        [low, high]: [Post; 2],
        mut values: Vec<V>,
        mut fill: impl FnMut(u32, [u32; 2], &mut Vec<V>),
    ) -> Self {
        values.clear();
        (low[1]..=high[1]).for_each(|row| fill(row, [low[0], high[0]], &mut values));
        let is_whole = values.iter().all(|value| !value.is_missing());
        Self { low, high, is_whole, values }
    }

    /// Its memory, to be used again.
    pub fn into_values(self) -> Vec<V> {
        self.values
    }

    /// Whether it has a post.
    #[inline(always)]
    pub fn contains(&self, post: Post) -> bool {
        (0..2).all(|k| self.low[k] <= post[k] && post[k] <= self.high[k])
    }

    /// What the surface has at a post.
    #[inline(always)]
    pub fn at(&self, [column, row]: Post) -> V {
        let columns = (self.high[0] - self.low[0] + 1) as usize;
        self.values[(row - self.low[1]) as usize * columns + (column - self.low[0]) as usize]
    }

    /// Those of a part of a row.
    #[inline(always)]
    fn line(&self, row: u32, [first, last]: [u32; 2]) -> &[V] {
        let columns = (self.high[0] - self.low[0] + 1) as usize;
        let start = (row - self.low[1]) as usize * columns;
        &self.values[start + (first - self.low[0]) as usize..=start + (last - self.low[0]) as usize]
    }
}

/// The plane of a triangle over the grid: its height (or point) at a post is that at the apex and so much more for each column and row.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slope<V> {
    apex: [f64; 2],
    at_apex: V,
    by: [V; 2],
}

impl<V: Value> Slope<V> {
    /// That of a triangle by what it has at its corners.
    pub fn of(triangle: &RightTriangle, [a, l, r]: [V; 3]) -> Self {
        let apex = triangle.apex.map(f64::from);
        // The legs; a is right-angled, so each column and row is a combination of two with powers of two below the line.
        let leg = |end: Post| [0, 1].map(|k| f64::from(end[k]) - apex[k]);
        let ([lx, ly], [rx, ry]) = (leg(triangle.left), leg(triangle.right));
        let area = lx * ry - ly * rx;
        let (l, r) = (l - a, r - a);
        Self { apex, at_apex: a, by: [(l * ry - r * ly) / area, (r * lx - l * rx) / area] }
    }

    /// What it has at a column and row.
    #[inline(always)]
    pub fn at(&self, [column, row]: [f64; 2]) -> V {
        self.at_apex + (self.by[0] * (column - self.apex[0]) + self.by[1] * (row - self.apex[1]))
    }

    /// Whether it is the same everywhere.
    pub fn is_level(&self) -> bool {
        self.by.iter().all(|by| by.size() == 0.0)
    }

    /// Whether it is finite. Heights so large that their differences are not are as far as can be.
    pub fn is_finite(&self) -> bool {
        self.by.iter().all(|by| by.size().is_finite())
    }
}

/// The first and last column of the posts that a triangle has in one of its rows.
#[inline(always)]
fn columns(triangle: &RightTriangle, row: u32) -> [u32; 2] {
    let RightTriangle { apex: [x, y], left, right } = *triangle;
    let off = row.abs_diff(y);
    if left[1] == right[1] {
        // A longest side along a row.
        [x - off, x + off]
    } else if left[0] == right[0] {
        // One along a column.
        if left[0] > x { [x + off, left[0]] } else { [left[0], x - off] }
    } else {
        // Legs along a row and a column: that row's gets shorter.
        let end = if left[1] == y { left[0] } else { right[0] };
        if end > x { [x, end - off] } else { [end + off, x] }
    }
}

/// The deviation of a triangle over the posts of a window, each looked at; it has no slope where it reaches beyond the grid.
pub(super) fn deviation<V: Value>(
    window: &Window<V>,
    triangle: &RightTriangle,
    slope: Option<&Slope<V>>,
) -> Deviation {
    let rows = triangle.corners().map(|post| post[1]);
    let (south, north) = (rows[0].min(rows[1]).min(rows[2]), rows[0].max(rows[1]).max(rows[2]));
    let lines = (south.max(window.low[1])..north.min(window.high[1]) + 1).filter_map(|row| {
        let [first, last] = columns(triangle, row);
        let (first, last) = (first.max(window.low[0]), last.min(window.high[0]));
        (first <= last).then(|| (row, first, window.line(row, [first, last])))
    });
    let most = if slope.is_none_or(Slope::is_finite) { 0.0 } else { f64::INFINITY };
    let mut found = Deviation { most, some_there: false, some_missing: slope.is_none() };
    for (row, first, line) in lines {
        for (k, value) in line.iter().enumerate() {
            found.some_missing |= value.is_missing();
            found.some_there |= !value.is_missing();
            let at = [f64::from(first) + k as f64, f64::from(row)];
            let off = slope.map_or(0.0, |slope| (slope.at(at) - *value).size());
            found.most = math::max(off, found.most);
        }
    }
    found
}

/// The distance of the farthest post of a triangle in a window, each looked at; all are there.
#[inline(always)]
pub(super) fn farthest<V: Value>(window: &Window<V>, triangle: &RightTriangle, slope: &Slope<V>) -> f64 {
    let rows = triangle.corners().map(|post| post[1]);
    let (south, north) = (rows[0].min(rows[1]).min(rows[2]), rows[0].max(rows[1]).max(rows[2]));
    let mut most = 0.0;
    for row in south..=north {
        let [first, last] = columns(triangle, row);
        most =
            math::max(farthest_of(slope, [first, row].map(f64::from), window.line(row, [first, last])), most);
    }
    V::size_of(most)
}

/// [`farthest`], compiled for the widest vectors of the machine at hand.
pub(super) struct Farthest<'a, V> {
    pub window: &'a Window<V>,
    pub triangle: &'a RightTriangle,
    pub slope: &'a Slope<V>,
}

impl<V: Value> pulp::WithSimd for Farthest<'_, V> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> f64 {
        farthest(self.window, self.triangle, self.slope)
    }
}

/// Posts that are looked at together.
const LANES: usize = 8;

/// The largest measure of a row's posts from a plane.
#[inline(always)]
fn farthest_of<V: Value>(slope: &Slope<V>, [first, row]: [f64; 2], line: &[V]) -> f64 {
    let mut most = [0.0; LANES];
    let mut at: [f64; LANES] = std::array::from_fn(|k| first + k as f64);
    let (eights, rest) = line.as_chunks::<LANES>();
    for eight in eights {
        for k in 0..LANES {
            most[k] = math::max((slope.at([at[k], row]) - eight[k]).measure(), most[k]);
            at[k] += LANES as f64;
        }
    }
    let mut all = 0.0;
    for (k, value) in rest.iter().enumerate() {
        all = math::max((slope.at([at[k], row]) - *value).measure(), all);
    }
    if eights.is_empty() { all } else { most.into_iter().fold(all, math::max) }
}
