//! What each pixel of a tile sees: convex fragments of triangles that do not overlap.
//!
//! Triangles come in any order, best the nearest first; where two fragments of a pixel overlap, the farther one loses what the nearer one
//! covers. A pixel that is covered wholly hides what is farther than all of its fragments.

use super::convex::{NOTHING, Side, are_apart, area, common, cut, without};
use super::facet::{Facet, Outline, split_by_key};
use crate::math;
use glam::DVec2;
use std::ops::Range;

/// Pixels a side of a tile.
pub(super) const TILE: usize = 32;

/// Pixels a side of a block.
pub(super) const BLOCK: usize = 8;

/// Blocks a side of a tile.
const BLOCKS: usize = TILE / BLOCK;

/// A pixel is covered wholly where no more of it than this is left.
pub(super) const FULL: f64 = 1.0 - 1e-8;

/// A part of a triangle that a pixel sees.
#[derive(Debug, Clone)]
pub(super) struct Fragment {
    /// The triangle, among [`Sheet::facets`].
    pub(super) facet: u32,
    /// Its corners; none of one that is the whole pixel.
    corners: Range<u32>,
    /// Its share of the pixel.
    pub(super) area: f64,
}

impl Fragment {
    /// All of a pixel.
    pub(super) fn whole(facet: u32) -> Self {
        Self { facet, corners: 0..0, area: 1.0 }
    }
}

/// What a pixel sees so far.
#[derive(Debug, Default, Clone)]
struct Seen {
    fragments: Vec<Fragment>,
    /// The share that is covered.
    covered: f64,
    /// The least key of what is seen.
    farthest: f64,
    /// Whether there were more fragments than may be.
    is_crowded: bool,
}

/// The pixels of a tile: memory that is used again from tile to tile.
#[derive(Debug, Default)]
pub(super) struct Sheet {
    /// The triangles that pixels may see.
    pub(super) facets: Vec<Facet>,
    size: [usize; 2],
    pixels: Vec<Seen>,
    /// The triangle that covers each block wholly and alone, whose pixels then have no fragments of their own.
    whole: Vec<Option<u32>>,
    corners: Vec<DVec2>,
    /// The least key of what each block sees; -inf where something of it is not covered.
    farthest: Vec<f64>,
    is_dirty: Vec<bool>,
    /// Whether nothing is seen in a block so far.
    is_empty: Vec<bool>,
    /// The most fragments that a pixel may have.
    budget: usize,
    room: [Vec<DVec2>; 2],
}

impl Sheet {
    /// Forgets everything: a tile of such a size, whose pixels may have so many fragments.
    pub(super) fn reset(&mut self, size: [usize; 2], budget: usize) {
        (self.size, self.budget) = (size, budget);
        self.facets.clear();
        self.corners.clear();
        self.pixels.resize_with(TILE * TILE, Seen::default);
        for seen in &mut self.pixels {
            seen.fragments.clear();
            (seen.covered, seen.farthest, seen.is_crowded) = (0.0, f64::NEG_INFINITY, budget == 0);
        }
        self.whole.clear();
        self.whole.resize(BLOCKS * BLOCKS, None);
        self.farthest.clear();
        self.farthest.resize(BLOCKS * BLOCKS, f64::NEG_INFINITY);
        self.is_empty.clear();
        self.is_empty.resize(BLOCKS * BLOCKS, budget > 0);
        self.is_dirty.clear();
        self.is_dirty.resize(BLOCKS * BLOCKS, budget == 0);
    }

    /// What a pixel sees; what is left of its area is sky.
    pub(super) fn fragments(&self, [x, y]: [usize; 2]) -> &[Fragment] {
        &self.pixels[y * TILE + x].fragments
    }

    /// The triangle that a block sees alone, if there is one: its pixels have no fragments.
    pub(super) fn whole(&self, [x, y]: [usize; 2]) -> Option<u32> {
        self.whole[y / BLOCK * BLOCKS + x / BLOCK]
    }

    /// The corners of a fragment of a pixel; `room` is for those of a whole one.
    pub(super) fn corners<'r>(
        &'r self,
        fragment: &Fragment,
        at: [usize; 2],
        room: &'r mut [DVec2; 4],
    ) -> &'r [DVec2] {
        if fragment.corners.is_empty() {
            *room = square(at, 1);
            return room;
        }
        &self.corners[fragment.corners.start as usize..fragment.corners.end as usize]
    }

    /// Whether a pixel had more fragments than may be, so that none tells what it sees.
    pub(super) fn is_crowded(&self, [x, y]: [usize; 2]) -> bool {
        self.pixels[y * TILE + x].is_crowded
    }

    /// Whether nothing with a key up to `key` is seen in a rectangle of the tile (x from, y from, x to, y to).
    pub(super) fn hides(&mut self, rectangle: [f64; 4], key: f64) -> bool {
        let Some([columns, rows]) = self.within(rectangle) else { return true };
        let blocks = |range: Range<usize>| range.start / BLOCK..range.end.div_ceil(BLOCK);
        for y in blocks(rows) {
            for x in blocks(columns.clone()) {
                if self.farthest_of([x, y]) < key {
                    return false;
                }
            }
        }
        true
    }

    fn farthest_of(&mut self, [x, y]: [usize; 2]) -> f64 {
        let block = y * BLOCKS + x;
        if std::mem::take(&mut self.is_dirty[block]) {
            let mut least = f64::INFINITY;
            for row in y * BLOCK..self.size[1].min((y + 1) * BLOCK) {
                let to = self.size[0].min((x + 1) * BLOCK);
                for seen in &self.pixels[row * TILE + x * BLOCK..row * TILE + to] {
                    least = math::min(seen.farthest, least);
                }
            }
            self.farthest[block] = least;
        }
        self.farthest[block]
    }

    /// The columns and rows of a rectangle; `None`: none.
    fn within(&self, [x0, y0, x1, y1]: [f64; 4]) -> Option<[Range<usize>; 2]> {
        const HAIR: f64 = 1e-6;
        // Casts saturate.
        let span = |low: f64, high: f64, count: usize| {
            let range = (low - HAIR) as usize..math::min(high + HAIR, count as f64 - 1.0) as usize + 1;
            (high + HAIR >= 0.0 && !range.is_empty()).then_some(range)
        };
        Some([span(x0, x1, self.size[0])?, span(y0, y1, self.size[1])?])
    }

    /// Adds a triangle to all pixels that it covers.
    pub(super) fn add(&mut self, (facet, outline): (Facet, Outline)) {
        let Some([columns, rows]) = self.within(outline.reach) else { return };
        let (number, mut is_seen) = (self.facets.len() as u32, false);
        for y in rows.start / BLOCK..rows.end.div_ceil(BLOCK) {
            for x in columns.start / BLOCK..columns.end.div_ceil(BLOCK) {
                is_seen |= self.add_to_block((&facet, &outline), number, [x, y], [&columns, &rows]);
            }
        }
        if is_seen {
            self.facets.push(facet);
        }
    }

    /// Adds a triangle to the pixels of a block that lie in some columns and rows; returns whether a part of it is seen there (so far).
    fn add_to_block(
        &mut self,
        (facet, outline): (&Facet, &Outline),
        number: u32,
        at: [usize; 2],
        [columns, rows]: [&Range<usize>; 2],
    ) -> bool {
        const HALF: f64 = BLOCK as f64 / 2.0;
        let middle = DVec2::new(at[0] as f64, at[1] as f64) * BLOCK as f64 + HALF;
        let is_apart = |side: &Side| side.at(middle) <= -HALF * side.normal.abs().element_sum();
        if facet.nearest_in(middle, HALF) <= self.farthest_of(at) || outline.bounds().any(is_apart) {
            return false;
        }
        let block = at[1] * BLOCKS + at[0];
        let holds = |side: &Side| side.at(middle) >= HALF * side.normal.abs().element_sum();
        let is_empty = self.whole[block].is_none() && self.is_empty[block];
        if is_empty && outline.bounds().all(holds) {
            self.whole[block] = Some(number);
            self.is_empty[block] = false;
            self.farthest[block] = facet.farthest_in(middle, HALF);
            return true;
        }
        self.divide(block);
        let of = |k: usize, range: &Range<usize>| {
            range.start.max(at[k] * BLOCK)..range.end.min((at[k] + 1) * BLOCK)
        };
        let (columns, rows) = (of(0, columns), of(1, rows));
        let mut is_seen = false;
        for y in rows {
            for x in columns.clone() {
                is_seen |= self.add_to_pixel((facet, outline), number, [x, y]);
            }
        }
        self.is_empty[block] &= !is_seen;
        is_seen
    }

    /// Gives the pixels of a block that sees one triangle alone fragments of it.
    fn divide(&mut self, block: usize) {
        let Some(facet) = self.whole[block].take() else { return };
        let [x, y] = [block % BLOCKS * BLOCK, block / BLOCKS * BLOCK];
        for y in y..self.size[1].min(y + BLOCK) {
            for x in x..self.size[0].min(x + BLOCK) {
                let farthest =
                    self.facets[facet as usize].farthest_in(DVec2::new(x as f64 + 0.5, y as f64 + 0.5), 0.5);
                let seen = &mut self.pixels[y * TILE + x];
                seen.fragments.push(Fragment::whole(facet));
                (seen.covered, seen.farthest) = (1.0, farthest);
            }
        }
    }

    /// Adds a triangle to a pixel; returns whether a part of it is seen there (so far).
    fn add_to_pixel(&mut self, (facet, outline): (&Facet, &Outline), number: u32, at: [usize; 2]) -> bool {
        let middle = DVec2::new(at[0] as f64 + 0.5, at[1] as f64 + 0.5);
        let pixel = at[1] * TILE + at[0];
        let seen = &self.pixels[pixel];
        if seen.is_crowded || facet.nearest_in(middle, 0.5) <= seen.farthest {
            return false;
        }
        let mut sides = outline.bounds().map(|side| {
            let reach = 0.5 * side.normal.abs().element_sum();
            (side, side.at(middle), reach)
        });
        if sides.clone().any(|(_, value, reach)| value <= -reach) {
            return false;
        }
        let [polygon, next] = &mut self.room;
        polygon.clear();
        polygon.extend(square(at, 1));
        let mut is_whole = true;
        for (side, ..) in sides.by_ref().filter(|(_, value, reach)| value < reach) {
            is_whole = false;
            next.clear();
            cut(polygon, side, next);
            std::mem::swap(polygon, next);
        }
        if is_whole && self.pixels[pixel].fragments.is_empty() {
            let farthest = facet.farthest_in(middle, 0.5);
            let seen = &mut self.pixels[pixel];
            seen.fragments.push(Fragment::whole(number));
            (seen.covered, seen.farthest) = (1.0, farthest);
            self.is_dirty[block_of(pixel)] = true;
            return true;
        }
        self.insert(facet, number, pixel)
    }

    /// Puts the polygon in `room` among the fragments of a pixel.
    fn insert(&mut self, facet: &Facet, number: u32, pixel: usize) -> bool {
        let polygon = std::mem::take(&mut self.room[0]);
        let is_seen = area(&polygon) > NOTHING && self.merge(facet, number, pixel, &polygon);
        self.room[0] = polygon;
        if is_seen {
            self.finish(facet, pixel);
        }
        is_seen
    }

    /// Resolves a new polygon against what a pixel sees; returns whether any of it is left.
    fn merge(&mut self, facet: &Facet, number: u32, pixel: usize, polygon: &[DVec2]) -> bool {
        // What others hide of the new one.
        let mut holes: Vec<Vec<DVec2>> = Vec::new();
        let count = self.pixels[pixel].fragments.len();
        let mut kept = 0;
        for k in 0..count {
            let old = self.pixels[pixel].fragments[k].clone();
            let mut room = [DVec2::ZERO; 4];
            let corners = self.corners(&old, [pixel % TILE, pixel / TILE], &mut room);
            let both = if are_apart(corners, polygon) { Vec::new() } else { common(corners, polygon) };
            let mut stays = true;
            if area(&both) > NOTHING {
                let other = &self.facets[old.facet as usize];
                let [nearer, farther] = split_by_key(facet, other, &both);
                if area(&farther) > NOTHING {
                    holes.push(farther);
                }
                if area(&nearer) > NOTHING {
                    stays = false;
                    let corners = corners.to_vec();
                    without(&corners, &nearer, |piece| self.push(old.facet, pixel, piece));
                }
            }
            if stays {
                self.pixels[pixel].fragments[kept] = old;
                kept += 1;
            }
        }
        // What was cut stands behind the old ones.
        self.pixels[pixel].fragments.drain(kept..count);
        let before = self.pixels[pixel].fragments.len();
        self.push_rest(number, pixel, polygon, &holes);
        self.pixels[pixel].fragments.len() > before || kept < count
    }

    /// Adds what of a polygon lies in none of some others.
    fn push_rest(&mut self, facet: u32, pixel: usize, polygon: &[DVec2], holes: &[Vec<DVec2>]) {
        if holes.is_empty() {
            self.push(facet, pixel, polygon);
            return;
        }
        let mut pieces = vec![polygon.to_vec()];
        for hole in holes {
            let mut next = Vec::new();
            for piece in pieces {
                if are_apart(&piece, hole) {
                    next.push(piece);
                } else {
                    without(&piece, hole, |rest| next.push(rest.to_vec()));
                }
            }
            pieces = next;
        }
        pieces.iter().for_each(|piece| self.push(facet, pixel, piece));
    }

    fn push(&mut self, facet: u32, pixel: usize, piece: &[DVec2]) {
        let first = self.corners.len() as u32;
        self.corners.extend_from_slice(piece);
        let corners = first..self.corners.len() as u32;
        self.pixels[pixel].fragments.push(Fragment { facet, corners, area: area(piece) });
    }

    /// Finds anew what a pixel hides.
    fn finish(&mut self, facet: &Facet, pixel: usize) {
        let block = block_of(pixel);
        let seen = &mut self.pixels[pixel];
        if seen.fragments.len() > self.budget {
            seen.fragments.clear();
            (seen.is_crowded, seen.covered) = (true, 0.0);
            seen.farthest = f64::INFINITY;
            self.is_dirty[block] = true;
            return;
        }
        seen.covered = seen.fragments.iter().map(|fragment| fragment.area).sum();
        if seen.covered < FULL {
            return;
        }
        let corners = &self.corners;
        let mut least = f64::INFINITY;
        for fragment in &seen.fragments {
            // The triangle that is being added is not among them yet.
            let of = self.facets.get(fragment.facet as usize).unwrap_or(facet);
            if fragment.corners.is_empty() {
                let middle = DVec2::new((pixel % TILE) as f64 + 0.5, (pixel / TILE) as f64 + 0.5);
                least = math::min(of.farthest_in(middle, 0.5), least);
            }
            let own = &corners[fragment.corners.start as usize..fragment.corners.end as usize];
            least = own.iter().map(|p| of.key.at(*p)).fold(least, |least, key| math::min(key, least));
        }
        seen.farthest = least;
        self.is_dirty[block] = true;
    }
}

/// The block of a pixel.
fn block_of(pixel: usize) -> usize {
    pixel / TILE / BLOCK * BLOCKS + pixel % TILE / BLOCK
}

/// The corners of so many pixels a side, from one on.
pub(super) fn square([x, y]: [usize; 2], side: usize) -> [DVec2; 4] {
    let (from, to) = (DVec2::new(x as f64, y as f64), DVec2::new((x + side) as f64, (y + side) as f64));
    [from, DVec2::new(to.x, from.y), to, DVec2::new(from.x, to.y)]
}
