//! The error of every triangle of the hierarchy: how far it, and what it may be split into, is from the full surface at most.
//!
//! Input: the posts of a grid or a globe. Output: [`Errors`], of which a view takes those that it needs ([`ErrorsInView`]). Refuses: nothing.
//!
//! The largest distance of a triangle is exact (`deviation`; over a globe as `places` has it), rounded up. Where a half has a larger one, its whole has that, too: an error
//! bounds all that lies below (saturation, after Lindstrom and Pascucci 2002, cited as [9]). Posts of a tile, 128 cells a side, are
//! looked at while they are near (`tile`): first for all triangles inside of it, then for its share of all larger ones. Of a large terrain only what is larger than a tile is
//! kept; what lies in a tile is found again when a view looks into it, and kept for the next.

use super::deviation::Deviation;
use super::extent::Extent;
use super::places::{Heights, Places};
use super::right_triangle::RightTriangle;
use super::tile::{Measure, NOTHING, OF_A_SQUARE, Scratch, TILE, Tile, in_tile, place, rounded_up};
use crate::math;
use crate::parallel;
use crate::terrain::Lattice;
use std::cell::OnceCell;
use std::sync::{Arc, Mutex, PoisonError};

/// Of a terrain with no more tiles all errors are kept: 128 MiB.
const MOST_KEPT: usize = 1024;

/// The errors of a tile's triangles.
type OfTile = Arc<[f32]>;

/// The errors of triangles, metres; f32 rounded up.
#[derive(Debug)]
pub(super) struct Errors {
    extent: Extent,
    /// Tiles a row.
    columns: u32,
    posts: Posts,
    /// Of each tile those of the square that it is.
    tops: Vec<[f32; OF_A_SQUARE]>,
    /// Those of larger squares, from the smallest, row by row.
    above: Vec<Vec<[f32; OF_A_SQUARE]>>,
    /// Those of the tiles that the last view looked into, or of all; no result depends on it.
    kept: Mutex<Vec<Option<OfTile>>>,
    are_all_kept: bool,
}

/// Posts, by what they are measured.
#[derive(Debug)]
enum Posts {
    /// By heights over a plane.
    Plane(Heights),
    /// By places in space.
    Globe(Places),
}

/// What is found of a tile at first.
struct Found {
    errors: Option<OfTile>,
    top: [f32; OF_A_SQUARE],
    shares: Vec<[Deviation; OF_A_SQUARE]>,
}

impl Errors {
    /// Those of the triangles over some posts.
    pub fn new(lattice: &Lattice) -> Self {
        Self::keeping(lattice, MOST_KEPT)
    }

    /// The same, of a terrain of more tiles without those that no view needs.
    pub(super) fn keeping(lattice: &Lattice, most_kept: usize) -> Self {
        let extent = Extent::of(lattice);
        match lattice {
            Lattice::Plane(grid) => {
                let heights = Heights::new(grid);
                let (found, slack) = (all_tiles(&heights, extent, most_kept), heights.slack());
                Self::of(extent, Posts::Plane(heights), found, slack)
            }
            Lattice::Globe(globe) => {
                let places = Places::new(globe);
                let (found, slack) = (all_tiles(&places, extent, most_kept), places.slack());
                Self::of(extent, Posts::Globe(places), found, slack)
            }
        }
    }

    fn of(extent: Extent, posts: Posts, found: Vec<Found>, slack: f64) -> Self {
        let [columns, _] = extent.cells(TILE);
        let above = (1..).zip(TILE + 1..=extent.top()).map(|(up, n)| {
            let [squares, rows] = extent.cells(n);
            let mut all = vec![[Deviation::default(); OF_A_SQUARE]; (squares * rows) as usize];
            for (k, tile) in (0..).zip(&found) {
                let square = ((k / columns) >> up) * squares + ((k % columns) >> up);
                let sum = all[square as usize].iter_mut().zip(&tile.shares[up as usize - 1]);
                sum.for_each(|(sum, share)| *sum = sum.joined(*share));
            }
            all.into_iter().map(|square| square.map(|deviation| rounded_up(deviation, slack))).collect()
        });
        let above = above.collect();
        let are_all_kept = found.iter().all(|tile| tile.errors.is_some());
        let (tops, kept) = found.into_iter().map(|tile| (tile.top, tile.errors)).unzip();
        let mut all = Self { extent, columns, posts, tops, above, kept: Mutex::new(kept), are_all_kept };
        for root in extent.root().roots() {
            all.saturate(root);
        }
        all
    }

    /// The error of a triangle that is no smaller than half a tile's half.
    fn of_large(&self, (n, cell, slot): (u32, [u32; 2], usize)) -> f32 {
        match n.checked_sub(TILE + 1) {
            None => self.tops[self.tile(n, cell)][slot],
            Some(up) => self.above[up as usize][self.square(n, cell)][slot],
        }
    }

    /// The tile that a square no larger lies in.
    #[inline]
    fn tile(&self, n: u32, cell: [u32; 2]) -> usize {
        let [x, y] = cell.map(|at| at >> (TILE - n));
        (y * self.columns + x) as usize
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
        let Some(up) = n.checked_sub(TILE + 1) else { return self.of_large((n, cell, slot)) };
        let below = triangle.halves().map(|halves| halves.map(|half| self.saturate(half)));
        let square = self.square(n, cell);
        let error = &mut self.above[up as usize][square][slot];
        *error = below.into_iter().flatten().fold(*error, math::max_f32);
        *error
    }

    /// The errors in a tile, found again.
    fn look_into(&self, tile: usize) -> OfTile {
        let place = [tile as u32 % self.columns, tile as u32 / self.columns];
        match &self.posts {
            Posts::Plane(heights) => {
                Tile::new(heights, self.extent, place, &mut Scratch::new()).errors().into()
            }
            Posts::Globe(places) => {
                Tile::new(places, self.extent, place, &mut Scratch::new()).errors().into()
            }
        }
    }

    /// Those that a view needs.
    pub fn in_view(&self) -> ErrorsInView<'_> {
        let before = self.kept.lock().unwrap_or_else(PoisonError::into_inner).clone();
        let tiles = before.iter().map(|_| OnceCell::new()).collect();
        ErrorsInView { errors: self, before, tiles }
    }
}

/// What is found of all tiles of a lattice, row by row.
fn all_tiles<M: Measure>(measure: &M, extent: Extent, most_kept: usize) -> Vec<Found> {
    let [columns, rows] = extent.cells(TILE);
    let places: Vec<[u32; 2]> = (0..columns * rows).map(|k| [k % columns, k / columns]).collect();
    let is_kept = places.len() <= most_kept;
    parallel::map_with(&places, Scratch::new, |scratch, place| {
        let mut tile = Tile::new(measure, extent, *place, scratch);
        let errors = tile.errors();
        let first = in_tile(TILE, *place, 0);
        let top = std::array::from_fn(|slot| errors[first + slot]);
        let shares = tile.shares();
        *scratch = tile.into_scratch();
        Found { errors: is_kept.then(|| errors.into()), top, shares }
    })
}

/// The errors that a view needs, each found when it is first asked for.
pub(super) struct ErrorsInView<'e> {
    errors: &'e Errors,
    /// Those of tiles that are known from before.
    before: Vec<Option<OfTile>>,
    tiles: Vec<OnceCell<OfTile>>,
}

impl ErrorsInView<'_> {
    /// The error of a triangle that can be split.
    #[inline]
    pub fn of(&self, triangle: &RightTriangle) -> f32 {
        let (n, cell, slot) = place(triangle);
        if n >= TILE {
            return self.errors.of_large((n, cell, slot));
        }
        let tile = self.errors.tile(n, cell);
        self.tiles[tile].get_or_init(|| self.known(tile))[in_tile(n, cell, slot)]
    }

    fn known(&self, tile: usize) -> OfTile {
        self.before[tile].clone().unwrap_or_else(|| self.errors.look_into(tile))
    }

    /// Looks into the tiles that some triangles lie in, at once.
    pub fn look_into(&self, triangles: &[RightTriangle]) {
        let mut tiles: Vec<usize> = triangles
            .iter()
            .map(|triangle| {
                let (n, cell, _) = place(triangle);
                self.errors.tile(n, cell)
            })
            .filter(|tile| self.tiles[*tile].get().is_none())
            .collect();
        tiles.sort_unstable();
        tiles.dedup();
        let (errors, before) = (self.errors, &self.before);
        let known = |tile: &usize| before[*tile].clone().unwrap_or_else(|| errors.look_into(*tile));
        for (tile, found) in tiles.iter().zip(parallel::map(&tiles, known)) {
            self.tiles[*tile].get_or_init(|| found);
        }
    }

    /// Keeps what was found for the next view: of a large terrain no more than that.
    pub fn keep(self) {
        if !self.errors.are_all_kept {
            let seen = self.tiles.into_iter().map(OnceCell::into_inner).collect();
            *self.errors.kept.lock().unwrap_or_else(PoisonError::into_inner) = seen;
        }
    }
}
