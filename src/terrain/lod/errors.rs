//! The error of every triangle of the hierarchy: how far it, and what it may be split into, is from the full surface at most.
//!
//! Input: the posts of a grid or a globe. Output: [`Errors`]. Refuses: nothing.
//!
//! The largest distance of a triangle is exact (`deviation`; over a globe as `places` has it), rounded up. Where a half has a larger one, its whole has that, too: an error
//! bounds all that lies below (saturation, after Lindstrom and Pascucci 2002, cited as [9]). Posts of a tile, 128 cells a side, are
//! looked at while they are near: first for all triangles inside of it, then for its share of all larger ones.

use super::deviation::{Deviation, Window, deviation};
use super::extent::Extent;
use super::places::Places;
use super::quad::{CELLS, Quad};
use super::right_triangle::RightTriangle;
use crate::math;
use crate::parallel;
use crate::scene::Posts;
use crate::terrain::Lattice;

/// The error of a triangle in which there is a post, and one is missing.
pub(super) const MIXED: f32 = f32::INFINITY;
/// The error of a triangle in which there is no post.
pub(super) const NOTHING: f32 = f32::NEG_INFINITY;

/// Triangles of a square that are larger than a half of a quarter of it: its two halves, and their four halves.
const OF_A_SQUARE: usize = 6;
/// A tile has 2^n cells a side.
const TILE: u32 = CELLS.trailing_zeros();

/// The errors of triangles, metres; f32 rounded up.
#[derive(Debug, Clone)]
pub(super) struct Errors {
    extent: Extent,
    /// Tiles a row.
    columns: u32,
    /// Of each tile those of its squares, from the smallest that have a post in their middle.
    tiles: Vec<Box<[f32]>>,
    /// Those of larger squares, from the smallest, row by row.
    above: Vec<Vec<[f32; OF_A_SQUARE]>>,
}

/// The place of a triangle that can be split: the square that it is a half or a quarter of has 2^n posts a side.
fn place(triangle: &RightTriangle) -> (u32, [u32; 2], usize) {
    let RightTriangle { apex, left, right } = triangle;
    let n = triangle.layer().div_ceil(2);
    if triangle.layer().is_multiple_of(2) {
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
fn first_of(n: u32) -> usize {
    (1..n).map(|n| OF_A_SQUARE << (2 * (TILE - n))).sum()
}

/// Posts, by which deviations are measured.
enum Measured<'p> {
    /// By heights over a plane.
    Plane(&'p Posts),
    /// By places in space.
    Globe(Places<'p>),
}

impl<'p> Measured<'p> {
    /// The posts, and how far roundings may take a deviation.
    fn of(lattice: &'p Lattice) -> (Self, f64) {
        match lattice {
            Lattice::Plane(grid) => {
                let (low, high) = lattice.heights();
                // A plane's coefficients and its heights at posts have a few roundings of numbers up to four times a height.
                let slack = 32.0 * f64::EPSILON * math::max(low.abs(), high.abs());
                (Self::Plane(grid.posts()), slack)
            }
            Lattice::Globe(globe) => {
                let places = Places::new(globe);
                let slack = places.slack();
                (Self::Globe(places), slack)
            }
        }
    }

    fn is_row_whole(&self, row: u32, [low, high]: [u32; 2]) -> bool {
        match self {
            Self::Plane(posts) => {
                let start = row as usize * posts.columns();
                let line = &posts.heights()[start + low as usize..=start + high as usize];
                line.iter().all(|height| !height.is_nan())
            }
            Self::Globe(places) => places.is_row_whole(row, [low, high]),
        }
    }

    fn deviation(&self, triangle: &RightTriangle, window: &Window) -> Deviation {
        match self {
            Self::Plane(posts) => deviation(posts, triangle, window),
            Self::Globe(places) => places.deviation(triangle, window),
        }
    }
}

impl Errors {
    /// Those of the triangles over some posts.
    pub fn new(lattice: &Lattice) -> Self {
        let extent = Extent::of(lattice);
        let [columns, rows] = extent.cells(TILE);
        let (posts, slack) = Measured::of(lattice);
        let posts = &posts;
        let made = parallel::map_indices((columns * rows) as usize, |k| {
            let tile = Tile { posts, extent, slack, place: [k as u32 % columns, k as u32 / columns] };
            (tile.errors(), tile.shares())
        });
        let (tiles, shares): (Vec<_>, Vec<_>) = made.into_iter().unzip();
        let above = (1..).zip(TILE + 1..=extent.top()).map(|(up, n)| {
            let [squares, rows] = extent.cells(n);
            let mut all = vec![[Deviation::default(); OF_A_SQUARE]; (squares * rows) as usize];
            for (k, share) in (0..).zip(&shares) {
                let square = ((k / columns) >> up) * squares + ((k % columns) >> up);
                let sum = all[square as usize].iter_mut().zip(&share[up as usize - 1]);
                sum.for_each(|(sum, share)| *sum = sum.joined(*share));
            }
            all.into_iter().map(|square| square.map(|deviation| rounded_up(deviation, slack))).collect()
        });
        let above = above.collect();
        let mut all = Self { extent, columns, tiles, above };
        for root in extent.root().roots() {
            all.saturate(root);
        }
        all
    }

    /// The error of a triangle that can be split.
    #[inline]
    pub fn of(&self, triangle: &RightTriangle) -> f32 {
        let (n, cell, slot) = place(triangle);
        match n.checked_sub(TILE + 1) {
            None => {
                let [x, y] = cell.map(|at| at >> (TILE - n));
                self.tiles[(y * self.columns + x) as usize][in_tile(n, cell, slot)]
            }
            Some(up) => self.above[up as usize][self.square(n, cell)][slot],
        }
    }

    fn square(&self, n: u32, [x, y]: [u32; 2]) -> usize {
        (y * self.extent.cells(n)[0] + x) as usize
    }

    /// Makes the errors of a triangle larger than a tile, and of those in it, no smaller than those of their halves.
    fn saturate(&mut self, triangle: RightTriangle) -> f32 {
        if !self.extent.holds(&triangle) {
            return NOTHING;
        }
        let (n, cell, slot) = place(&triangle);
        let Some(up) = n.checked_sub(TILE + 1) else { return self.of(&triangle) };
        let below = triangle.halves().map(|halves| halves.map(|half| self.saturate(half)));
        let square = self.square(n, cell);
        let error = &mut self.above[up as usize][square][slot];
        *error = below.into_iter().flatten().fold(*error, math::max_f32);
        *error
    }
}

/// The place of a triangle's error in its tile.
#[inline]
fn in_tile(n: u32, cell: [u32; 2], slot: usize) -> usize {
    let side = 1 << (TILE - n);
    let [x, y] = cell.map(|at| (at % side) as usize);
    first_of(n) + (y * side as usize + x) * OF_A_SQUARE + slot
}

/// A square of posts that is looked at in one piece.
struct Tile<'p> {
    posts: &'p Measured<'p>,
    extent: Extent,
    slack: f64,
    /// Column and row among the tiles.
    place: [u32; 2],
}

impl Tile<'_> {
    /// Its posts, those of its borders too.
    fn window(&self) -> Window {
        let low = self.place.map(|at| at * CELLS);
        let high = [0, 1].map(|k| (low[k] + CELLS).min(self.extent.last[k]));
        let is_whole = (low[1]..=high[1]).all(|row| self.posts.is_row_whole(row, [low[0], high[0]]));
        Window { low, high, is_whole }
    }

    /// The errors of the triangles in it.
    fn errors(&self) -> Box<[f32]> {
        let mut errors = vec![NOTHING; first_of(TILE + 1)].into_boxed_slice();
        let [x, y] = self.place;
        for root in (Quad { level: 0, x, y }).roots() {
            self.fill(&self.window(), root, &mut errors);
        }
        errors
    }

    /// Finds the errors of a triangle and of all below it; returns the former.
    fn fill(&self, window: &Window, triangle: RightTriangle, errors: &mut [f32]) -> f32 {
        if !self.extent.holds(&triangle) {
            return NOTHING;
        }
        let Some(halves) = triangle.halves() else { return NOTHING };
        let own = rounded_up(self.posts.deviation(&triangle, window), self.slack);
        let below = halves.map(|half| self.fill(window, half, errors));
        let error = below.into_iter().fold(own, math::max_f32);
        let (n, cell, slot) = place(&triangle);
        errors[in_tile(n, cell, slot)] = error;
        error
    }

    /// The deviations of its posts from the larger triangles around it, from those of the smallest square up.
    fn shares(&self) -> Vec<[Deviation; OF_A_SQUARE]> {
        let window = self.window();
        let of_square = |n: u32| {
            let mut share = [Deviation::default(); OF_A_SQUARE];
            let cell = self.place.map(|at| at >> (n - TILE));
            for half in RightTriangle::of_cell(cell, 1 << n) {
                let quarters = half.halves().into_iter().flatten();
                for triangle in quarters.chain([half]) {
                    share[place(&triangle).2] = self.posts.deviation(&triangle, &window);
                }
            }
            share
        };
        (TILE + 1..=self.extent.top()).map(of_square).collect()
    }
}

/// What is stored of a deviation that is known up to `slack`.
fn rounded_up(deviation: Deviation, slack: f64) -> f32 {
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
