//! The errors of the triangles in a tile, 128 cells a side, and what its posts say of larger ones.
//!
//! Input: what posts are measured by ([`Measure`]), a tile. Output: [`Tile::errors`], [`Tile::shares`]. Refuses: nothing.
//!
//! A triangle's largest distance is found from the smallest up: of the two smallest layers that of the one post that their halves do not tell, of all larger
//! ones by a search through these.

use super::deviation::{Deviation, Farthest, Slope, Value, Window, deviation, farthest};
use super::extent::Extent;
use super::quad::{CELLS, Quad};
use super::right_triangle::{Post, RightTriangle};
use super::search::Search;
use crate::math;

/// The error of a triangle in which there is a post, and one is missing.
pub(super) const MIXED: f32 = f32::INFINITY;
/// The error of a triangle in which there is no post.
pub(super) const NOTHING: f32 = f32::NEG_INFINITY;

/// Triangles of a square that are larger than a half of a quarter of it: its two halves, and their four halves.
pub(super) const OF_A_SQUARE: usize = 6;
/// A tile has 2^n cells a side.
pub(super) const TILE: u32 = CELLS.trailing_zeros();
/// Errors of a tile: of its squares, from the smallest that have a post in their middle.
const OF_A_TILE: usize = first_of(TILE + 1);
/// From this layer on a triangle's posts are so many that a search is quicker than looking at all.
const SEARCHED: u32 = 9;
/// From this layer on wide vectors are worth asking for.
const WIDE: u32 = 6;

/// What the posts of a lattice are measured by.
pub(super) trait Measure: Sync {
    /// What is known of a post.
    type Value: Value;

    /// That of a post; missing beyond the lattice.
    fn at(&self, post: Post) -> Self::Value;

    /// Appends those of a row from a column to another.
    fn append(&self, row: u32, ends: [u32; 2], to: &mut Vec<Self::Value>);

    /// A distance that a triangle surely has, by what it has at its corners.
    fn least(&self, triangle: &RightTriangle, corners: [Self::Value; 3]) -> f64;

    /// Whether some triangle between two rows [has](Self::least) such a distance.
    fn has_least(&self, rows: [u32; 2]) -> bool;

    /// How far roundings may take a distance.
    fn slack(&self) -> f64;
}

/// The place of a triangle that can be split: the square that it is a half or a quarter of has 2^n posts a side.
#[inline]
pub(super) fn place(triangle: &RightTriangle) -> (u32, [u32; 2], usize) {
    place_in(triangle.layer(), triangle)
}

/// The [`place`] of a triangle of a layer.
#[inline]
fn place_in(layer: u32, triangle: &RightTriangle) -> (u32, [u32; 2], usize) {
    let RightTriangle { apex, left, right } = triangle;
    let n = layer.div_ceil(2);
    if layer.is_multiple_of(2) {
        let cell = [0, 1].map(|k| apex[k].min(left[k]).min(right[k]) >> n);
        // The lower half is the first.
        (n, cell, usize::from(apex[1] >> n != cell[1]))
    } else {
        let side = match (left[1] == right[1], left[0] < apex[0] || left[1] < apex[1]) {
            // A side from west to east has an end on both sides of the apex.
            (true, _) => usize::from(left[1] > apex[1]),
            (false, _) => 2 + usize::from(left[0] > apex[0]),
        };
        (n, apex.map(|at| at >> n), 2 + side)
    }
}

/// Where the squares of 2^n posts a side start among those of a tile.
const fn first_of(n: u32) -> usize {
    let (mut first, mut smaller) = (0, 1);
    while smaller < n {
        first += OF_A_SQUARE << (2 * (TILE - smaller));
        smaller += 1;
    }
    first
}

/// The place of a triangle's error in its tile.
#[inline]
pub(super) fn in_tile(n: u32, cell: [u32; 2], slot: usize) -> usize {
    let side = 1 << (TILE - n);
    let [x, y] = cell.map(|at| (at % side) as usize);
    first_of(n) + (y * side as usize + x) * OF_A_SQUARE + slot
}

/// Memory that tiles use one after the other.
pub(super) struct Scratch<V> {
    values: Vec<V>,
    within: Vec<f64>,
}

impl<V> Scratch<V> {
    pub fn new() -> Self {
        Self { values: Vec::new(), within: Vec::new() }
    }
}

/// A square of posts that is looked at in one piece.
pub(super) struct Tile<'m, M: Measure> {
    measure: &'m M,
    extent: Extent,
    /// Column and row among the tiles.
    place: [u32; 2],
    window: Window<M::Value>,
    /// The largest distance of the posts in each triangle from itself, and from what it may be split into; infinite where they are not looked at.
    within: Vec<f64>,
}

impl<'m, M: Measure> Tile<'m, M> {
    /// A tile by its column and row.
    pub fn new(measure: &'m M, extent: Extent, place: [u32; 2], scratch: &mut Scratch<M::Value>) -> Self {
        let low = place.map(|at| at * CELLS);
        let high = [0, 1].map(|k| (low[k] + CELLS).min(extent.last[k]));
        let values = std::mem::take(&mut scratch.values);
        let window = Window::new([low, high], values, |row, ends, to| measure.append(row, ends, to));
        let mut within = std::mem::take(&mut scratch.within);
        within.clear();
        within.resize(OF_A_TILE, 0.0);
        Self { measure, extent, place, window, within }
    }

    /// Its memory, to be used again.
    pub fn into_scratch(self) -> Scratch<M::Value> {
        Scratch { values: self.window.into_values(), within: self.within }
    }

    /// The errors of the triangles in it, by [`in_tile`].
    pub fn errors(&mut self) -> Box<[f32]> {
        let mut errors = vec![NOTHING; OF_A_TILE].into_boxed_slice();
        let is_full = self.is_full();
        let has_least = self.measure.has_least([self.window.low[1], self.window.high[1]]);
        for root in self.roots() {
            if is_full && !has_least {
                self.fill_full(2 * TILE, &root, &mut errors);
            } else {
                self.fill(&root, &mut errors);
            }
        }
        errors
    }

    /// The two triangles that it is covered by.
    fn roots(&self) -> [RightTriangle; 2] {
        let [x, y] = self.place;
        (Quad { level: 0, x, y }).roots()
    }

    /// Whether all its posts are there.
    fn is_full(&self) -> bool {
        let [low, high] = [self.window.low, self.window.high];
        self.window.is_whole && (0..2).all(|k| high[k] - low[k] == CELLS)
    }

    fn within(&self, triangle: &RightTriangle) -> f64 {
        if triangle.layer() == 0 {
            return 0.0;
        }
        let (n, cell, slot) = place(triangle);
        self.within[in_tile(n, cell, slot)]
    }

    /// Finds the errors of a triangle and of all below it; returns the former, and the largest distance of a post within.
    fn fill(&mut self, triangle: &RightTriangle, errors: &mut [f32]) -> (f32, f64) {
        if !self.extent.holds(triangle) {
            return (NOTHING, 0.0);
        }
        let Some((middle, halves)) = triangle.middle().zip(triangle.halves()) else { return (NOTHING, 0.0) };
        let below = halves.map(|half| self.fill(&half, errors));
        let is_inside = triangle.corners().into_iter().all(|post| self.window.contains(post));
        let (own, within) = if is_inside && self.window.is_whole {
            let corners = triangle.corners().map(|post| self.window.at(post));
            let most = if triangle.layer() < 3 {
                // Other posts of these are corners, or such middles of their halves.
                ((corners[1] + corners[2]) * 0.5 - self.window.at(middle)).size()
            } else {
                self.most(triangle.layer(), triangle, &Slope::of(triangle, corners))
            };
            let own = math::max(self.measure.least(triangle, corners), most);
            (Deviation::of_all(own), below.iter().fold(most, |most, (_, within)| math::max(*within, most)))
        } else {
            (self.looked_at(triangle), f64::INFINITY)
        };
        let own = rounded_up(own, self.measure.slack());
        let error = below.into_iter().fold(own, |most, (error, _)| math::max_f32(error, most));
        let (n, cell, slot) = place(triangle);
        let at = in_tile(n, cell, slot);
        errors[at] = error;
        self.within[at] = within;
        (error, within)
    }

    /// The same of a triangle of a tile that is full, where no triangle has a distance that its posts do not tell.
    fn fill_full(&mut self, layer: u32, triangle: &RightTriangle, errors: &mut [f32]) -> (f32, f64) {
        let Some((middle, halves)) = triangle.middle().zip(triangle.halves()) else { return (NOTHING, 0.0) };
        let below = match layer {
            1 => [(NOTHING, 0.0); 2],
            _ => halves.map(|half| self.fill_full(layer - 1, &half, errors)),
        };
        let corners = triangle.corners().map(|post| self.window.at(post));
        let most = match layer {
            // Other posts of these are corners, or such middles of their halves.
            ..3 => ((corners[1] + corners[2]) * 0.5 - self.window.at(middle)).size(),
            _ => self.most(layer, triangle, &Slope::of(triangle, corners)),
        };
        let [(one, within_one), (other, within_other)] = below;
        let own = rounded_up(Deviation::of_all(most), self.measure.slack());
        let error = math::max_f32(math::max_f32(one, other), own);
        let within = math::max(math::max(within_one, within_other), most);
        let (n, cell, slot) = place_in(layer, triangle);
        let at = in_tile(n, cell, slot);
        errors[at] = error;
        self.within[at] = within;
        (error, within)
    }

    /// The largest distance of the posts that a triangle of a layer, with all corners in the window, has there; all are there.
    fn most(&self, layer: u32, triangle: &RightTriangle, slope: &Slope<M::Value>) -> f64 {
        if !slope.is_finite() {
            return f64::INFINITY;
        }
        let found = (layer >= SEARCHED).then(|| self.search(slope, 1 << layer).over(triangle)).flatten();
        found.unwrap_or_else(|| match layer {
            ..WIDE => farthest(&self.window, triangle, slope),
            _ => pulp::Arch::new().dispatch(Farthest { window: &self.window, triangle, slope }),
        })
    }

    fn search<'s>(
        &'s self,
        slope: &Slope<M::Value>,
        posts: u32,
    ) -> Search<'s, M::Value, impl Fn(&RightTriangle) -> f64 + 's> {
        Search::new(
            *slope,
            &self.window,
            |triangle| self.within(triangle),
            (4.0 * self.measure.slack(), 32 + posts / 8),
        )
    }

    /// The deviation of its posts from a triangle, each looked at.
    fn looked_at(&self, triangle: &RightTriangle) -> Deviation {
        let corners = triangle.corners().map(|post| self.measure.at(post));
        let is_inside = triangle.corners().iter().all(|post| (0..2).all(|k| post[k] <= self.extent.last[k]));
        let slope = is_inside.then(|| Slope::of(triangle, corners));
        let mut found = deviation(&self.window, triangle, slope.as_ref());
        if is_inside {
            found.most = math::max(self.measure.least(triangle, corners), found.most);
        }
        found
    }

    /// The deviations of its posts from the larger triangles around it, from those of the smallest square up; after its [errors](Self::errors).
    pub fn shares(&self) -> Vec<[Deviation; OF_A_SQUARE]> {
        let of_square = |n: u32| {
            let mut share = [Deviation::default(); OF_A_SQUARE];
            let cell = self.place.map(|at| at >> (n - TILE));
            for half in RightTriangle::of_cell(cell, 1 << n) {
                let quarters = half.halves().into_iter().flatten();
                for triangle in quarters.chain([half]) {
                    share[place(&triangle).2] = self.share(&triangle);
                }
            }
            share
        };
        (TILE + 1..=self.extent.top()).map(of_square).collect()
    }

    /// The deviation of its posts from a larger triangle.
    fn share(&self, triangle: &RightTriangle) -> Deviation {
        let is_inside = triangle.corners().iter().all(|post| (0..2).all(|k| post[k] <= self.extent.last[k]));
        if !(is_inside && self.is_full()) {
            return self.looked_at(triangle);
        }
        let corners = triangle.corners().map(|post| self.measure.at(post));
        let slope = Slope::of(triangle, corners);
        let roots = self.roots();
        let within = roots.iter().filter(|root| triangle.holds(root));
        let within = within.map(|root| self.most(2 * TILE, root, &slope));
        within.fold(Deviation::default(), |found, most| {
            let own = math::max(self.measure.least(triangle, corners), most);
            found.joined(Deviation::of_all(own))
        })
    }
}

/// What is stored of a deviation that is known up to `slack`.
pub(super) fn rounded_up(deviation: Deviation, slack: f64) -> f32 {
    match (deviation.some_there, deviation.some_missing) {
        (false, _) => NOTHING,
        (true, true) => MIXED,
        (true, false) => {
            let most = deviation.most + slack;
            let error = most as f32;
            if f64::from(error) < most { error.next_up() } else { error }
        }
    }
}
