//! How far a triangle of the hierarchy over a plane is from the full surface: exactly, over some of its posts.
//!
//! Input: heights of posts, a triangle. Output: [`Deviation`]. Refuses: nothing; posts beyond the grid are missing, as those without a height.
//!
//! Both surfaces are linear over every smallest triangle, and these nest: the largest distance is that at a post.

use super::right_triangle::{Post, RightTriangle};
use crate::math;
use crate::scene::Posts;
use std::ops::{Add, Div, Mul, Range, Sub};

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
}

/// A rectangle of posts, its borders included.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    /// The south-western post.
    pub low: Post,
    /// The north-eastern post.
    pub high: Post,
    /// Whether all its posts are there.
    pub is_whole: bool,
}

/// The plane of a triangle over the grid: its height (or point) at a post is that at the apex and so much more for each column and row.
pub(super) struct Slope<V> {
    apex: [f64; 2],
    at_apex: V,
    pub(super) by: [V; 2],
}

impl<V> Slope<V>
where
    V: Copy + Add<Output = V> + Sub<Output = V> + Mul<f64, Output = V> + Div<f64, Output = V>,
{
    pub(super) fn of(triangle: &RightTriangle, [a, l, r]: [V; 3]) -> Self {
        let apex = triangle.apex.map(f64::from);
        // The legs; a is right-angled, so each column and row is a combination of two with powers of two below the line.
        let leg = |end: Post| [0, 1].map(|k| f64::from(end[k]) - apex[k]);
        let ([lx, ly], [rx, ry]) = (leg(triangle.left), leg(triangle.right));
        let area = lx * ry - ly * rx;
        let (l, r) = (l - a, r - a);
        Self { apex, at_apex: a, by: [(l * ry - r * ly) / area, (r * lx - l * rx) / area] }
    }

    #[inline(always)]
    pub(super) fn at(&self, i: u32, j: u32) -> V {
        self.at_apex
            + (self.by[0] * (f64::from(i) - self.apex[0]) + self.by[1] * (f64::from(j) - self.apex[1]))
    }
}

/// The first and last column of a row's posts in a triangle.
#[inline(always)]
pub(super) fn columns(triangle: &RightTriangle, row: u32) -> (u32, u32) {
    let [a, l, r] = triangle.corners();
    let (mut low, mut high) = (u32::MAX, 0);
    for ([ax, ay], [bx, by]) in [(a, l), (l, r), (r, a)] {
        if ay.min(by) <= row && row <= ay.max(by) {
            // Sides run along rows, columns or diagonals.
            let ends = match ay == by {
                true => [ax, bx],
                false if ax < bx => [ax + row.abs_diff(ay); 2],
                false if ax > bx => [ax - row.abs_diff(ay); 2],
                false => [ax; 2],
            };
            low = low.min(ends[0]).min(ends[1]);
            high = high.max(ends[0]).max(ends[1]);
        }
    }
    (low, high)
}

/// The deviation of a triangle over the posts of a window; of the smallest that can be split, what their halves' deviations do not tell.
pub(super) fn deviation(posts: &Posts, triangle: &RightTriangle, window: &Window) -> Deviation {
    let corners = triangle.corners();
    let range = |k: usize| {
        let at = corners.map(|post| post[k]);
        (at[0].min(at[1]).min(at[2]), at[0].max(at[1]).max(at[2]))
    };
    let ((west, east), (south, north)) = (range(0), range(1));
    let height = |[i, j]: Post| posts.heights()[j as usize * posts.columns() + i as usize];
    let is_inside = (east as usize) < posts.columns() && (north as usize) < posts.rows();
    let heights = if is_inside { corners.map(height) } else { [f64::NAN; 3] };
    if let Some(middle) = triangle.middle().filter(|_| is_inside && window.is_whole && triangle.layer() < 3) {
        // Other posts of these are corners, or such middles of their halves.
        let most = (0.5 * (heights[1] + heights[2]) - height(middle)).abs();
        return Deviation { most, some_there: true, some_missing: false };
    }
    let slope = Slope::of(triangle, heights);
    // Heights so large that their differences are not finite are as far as can be.
    let most = if slope.by.iter().all(|by| by.is_finite()) { 0.0 } else { f64::INFINITY };
    let found = Deviation { most, some_missing: !is_inside, some_there: false };
    let rows = south.max(window.low[1])..north.min(window.high[1]) + 1;
    if west > window.high[0] || rows.is_empty() {
        return found;
    }
    let over = Over { posts, triangle, window, slope, rows };
    if is_inside && window.is_whole {
        pulp::Arch::new().dispatch(Whole { over, found })
    } else {
        over.lines().fold(found, |found, (line, start)| found.joined(sparse(line, start, over.slope.by[0])))
    }
}

/// The posts of a window in a triangle, row by row.
struct Over<'a> {
    posts: &'a Posts,
    triangle: &'a RightTriangle,
    window: &'a Window,
    slope: Slope<f64>,
    rows: Range<u32>,
}

impl Over<'_> {
    /// Of each row the heights, and the triangle's height at the first of them.
    #[inline(always)]
    fn lines(&self) -> impl Iterator<Item = (&[f64], f64)> {
        self.rows.clone().filter_map(|row| {
            let (first, last) = columns(self.triangle, row);
            let (first, last) = (first.max(self.window.low[0]), last.min(self.window.high[0]));
            let start = row as usize * self.posts.columns();
            (first <= last).then(|| {
                let line = &self.posts.heights()[start + first as usize..=start + last as usize];
                (line, self.slope.at(first, row))
            })
        })
    }
}

/// [`farthest`] of all lines, compiled for the widest vectors of the machine at hand.
struct Whole<'a> {
    over: Over<'a>,
    found: Deviation,
}

impl pulp::WithSimd for Whole<'_> {
    type Output = Deviation;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Deviation {
        let mut found = self.found;
        for (line, start) in self.over.lines() {
            found.some_there = true;
            found.most = math::max(farthest(line, start, self.over.slope.by[0]), found.most);
        }
        found
    }
}

/// Posts that are looked at together.
const LANES: usize = 8;

/// The farthest of a row of heights from a line that rises by `step` from post to post.
#[inline(always)]
fn farthest(heights: &[f64], start: f64, step: f64) -> f64 {
    let mut most = [0.0; LANES];
    let (eights, rest) = heights.as_chunks::<LANES>();
    let mut at: [f64; LANES] = std::array::from_fn(|k| k as f64);
    for eight in eights {
        for k in 0..LANES {
            most[k] = math::max((start + at[k] * step - eight[k]).abs(), most[k]);
            at[k] += LANES as f64;
        }
    }
    for (k, height) in rest.iter().enumerate() {
        most[k] = math::max((start + at[k] * step - height).abs(), most[k]);
    }
    most.into_iter().fold(0.0, math::max)
}

/// The same of a row in which heights may be missing.
fn sparse(heights: &[f64], start: f64, step: f64) -> Deviation {
    let mut found = Deviation::default();
    for (k, height) in heights.iter().enumerate() {
        let off = (start + k as f64 * step - height).abs();
        found.most = math::max(off, found.most);
        found.some_missing |= height.is_nan();
        found.some_there |= !height.is_nan();
    }
    found
}
