//! What each pixel of a tile sees: parts of triangles that do not overlap.
//!
//! Triangles come in any order, best the nearest first. A pixel lists those that reach into it, with the areas that they cover (`cells`). Where
//! all their sides cancel but for those outside of it and their areas fill it once, they lie side by side: nothing hides anything, and no polygon
//! is needed. In the other pixels (silhouettes, folds, what lies behind) triangles are cut to convex fragments; where two of them overlap, the
//! farther one loses what the nearer one covers. What is covered hides what is farther than all of it.

use super::boxes::with_hem;
use super::cells::{self, Cells};
use super::convex::{NOTHING, Pieces, Side, are_apart, area, common, cut, without};
use super::facet::{Facet, Order, Outline, order, split_by_key};
use crate::math;
use crate::resolve::Paint;
use crate::space::PlanBox;
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

/// A pixel that is covered more than this is covered twice somewhere.
const TWICE: f64 = 1.0 + 1e-6;

/// Lists have room for so many times the fragments that a pixel may have: much of what they hold may be hidden.
const ROOM: usize = 4;

/// No entry of a list.
const NONE: u32 = u32::MAX;

/// A part of a triangle that a pixel sees.
#[derive(Debug, Clone)]
pub(super) struct Fragment {
    /// The triangle, among [`Sheet::facets`].
    pub(super) facet: u32,
    shape: Shape,
    /// Its share of the pixel.
    pub(super) area: f64,
}

/// The form of a fragment.
#[derive(Debug, Clone)]
enum Shape {
    /// The whole pixel.
    Square,
    /// All of the triangle that lies in the pixel.
    Triangle,
    /// A polygon: the places of its corners, and the least and the most of their coordinates.
    Polygon(Range<u32>, [DVec2; 2]),
}

/// An entry of a pixel's list of triangles.
#[derive(Debug, Clone, Copy)]
struct Entry {
    facet: u32,
    next: u32,
    area: f64,
}

/// What a pixel sees so far.
#[derive(Debug, Clone)]
struct Seen {
    /// The share that is covered; of a list the sum, which is more where triangles overlap.
    covered: f64,
    /// The sum of the numbers of the triangles' sides in it.
    border: u64,
    /// The sum of the triangles' paints, each times its area.
    ground: Paint,
    /// The least key of what is seen.
    farthest: f64,
    /// Its list: the first and the last entry, and how many there are (that there is room for or not).
    first: u32,
    last: u32,
    count: u32,
    /// Whether it is covered wholly, so that it hides what is farther.
    is_closed: bool,
    /// Whether it has fragments in place of a list.
    is_cut: bool,
    /// Whether there were more fragments than may be.
    is_crowded: bool,
}

impl Seen {
    const NOTHING: Self = Self {
        covered: 0.0,
        border: 0,
        ground: Paint::CLEAR,
        farthest: f64::INFINITY,
        first: NONE,
        last: NONE,
        count: 0,
        is_closed: false,
        is_cut: false,
        is_crowded: false,
    };

    /// Whether its triangles lie side by side and cover it once.
    fn is_even(&self) -> bool {
        !self.is_cut && self.border == 0 && (self.covered - 1.0).abs() <= 1.0 - FULL
    }
}

/// A block of a tile.
#[derive(Debug, Clone)]
struct Block {
    /// The triangle that covers it wholly and alone, whose pixels then have no lists.
    whole: Option<u32>,
    /// Whether nothing is seen in it so far.
    is_empty: bool,
    /// How many of its pixels are closed, and how many it has.
    closed: u32,
    pixels: u32,
    /// The least key of what it sees, if all pixels are closed; to be found anew where it `is_dirty`.
    farthest: f64,
    is_dirty: bool,
    /// A box around all that it may see of the plan.
    plan: PlanBox,
}

/// The pixels of a tile: memory that is used again from tile to tile.
#[derive(Debug, Default)]
pub(super) struct Sheet {
    /// The triangles that pixels may see.
    pub(super) facets: Vec<Facet>,
    size: [usize; 2],
    pixels: Vec<Seen>,
    blocks: Vec<Block>,
    entries: Vec<Entry>,
    /// Of pixels that are cut.
    fragments: Vec<Vec<Fragment>>,
    corners: Vec<DVec2>,
    /// Around what the lists of crowded pixels have no room for, of the plan.
    beyond: Vec<PlanBox>,
    /// The least key that may be seen.
    least: f64,
    /// The most fragments that a pixel may have.
    budget: usize,
    cells: Cells,
    pieces: Pieces,
    room: [Vec<DVec2>; 2],
}

impl Sheet {
    /// Forgets everything: a tile of such a size, whose pixels may have so many fragments.
    pub(super) fn reset(&mut self, size: [usize; 2], budget: usize) {
        (self.size, self.budget, self.least) = (size, budget, f64::INFINITY);
        self.facets.clear();
        self.corners.clear();
        self.entries.clear();
        self.fragments.resize_with(TILE * TILE, Vec::new);
        self.beyond.resize(TILE * TILE, PlanBox::EMPTY);
        self.pixels.clear();
        self.pixels.resize(TILE * TILE, Seen { is_crowded: budget == 0, ..Seen::NOTHING });
        self.blocks.clear();
        self.blocks.extend((0..BLOCKS * BLOCKS).map(|k| {
            let [width, height] = block_size(size, k);
            Block {
                whole: None,
                is_empty: true,
                closed: 0,
                pixels: (width * height) as u32,
                farthest: f64::NEG_INFINITY,
                is_dirty: false,
                plan: PlanBox::EMPTY,
            }
        }));
    }

    /// The parts of triangles that a pixel sees; what is left of its area is sky. None of a crowded pixel.
    pub(super) fn fragments(&self, at: [usize; 2]) -> impl Iterator<Item = Fragment> + '_ {
        let (seen, whole) = (&self.pixels[pixel_of(at)], self.whole(at));
        let is_listed = !seen.is_cut && !seen.is_crowded;
        let mut next = if is_listed { seen.first } else { NONE };
        let listed = std::iter::from_fn(move || {
            let entry = self.entries.get(next as usize)?;
            next = entry.next;
            let shape = if entry.area >= 1.0 - NOTHING { Shape::Square } else { Shape::Triangle };
            Some(Fragment { facet: entry.facet, shape, area: entry.area })
        });
        let cut = if seen.is_cut { &self.fragments[pixel_of(at)][..] } else { &[] };
        let whole = whole.map(|facet| Fragment { facet, shape: Shape::Square, area: 1.0 });
        listed.chain(cut.iter().cloned()).chain(whole)
    }

    /// The mean paint of the ground that a pixel sees, how much of it that is, and how many parts of triangles; `None`: it is not known.
    pub(super) fn ground(&self, at: [usize; 2]) -> Option<(Paint, f64, u32)> {
        let seen = &self.pixels[pixel_of(at)];
        if let Some(facet) = self.whole(at) {
            return Some((self.facets[facet as usize].ground, 1.0, 1));
        }
        if seen.is_even() {
            return Some((seen.ground.divided_by(seen.covered), 1.0, seen.count));
        }
        if seen.is_crowded {
            return None;
        }
        let (mut ground, mut covered, mut count) = (Paint::CLEAR, 0.0, 0);
        for fragment in self.fragments(at) {
            ground = ground.plus(self.facets[fragment.facet as usize].ground.times(fragment.area));
            (covered, count) = (covered + fragment.area, count + 1);
        }
        Some((ground.divided_by(covered), if covered < FULL { covered } else { 1.0 }, count))
    }

    /// Whether a pixel sees nothing but the sky.
    pub(super) fn is_sky(&self, at: [usize; 2]) -> bool {
        let seen = &self.pixels[pixel_of(at)];
        self.whole(at).is_none() && seen.covered == 0.0 && !seen.is_crowded
    }

    /// The triangle that a block sees alone, if there is one.
    fn whole(&self, [x, y]: [usize; 2]) -> Option<u32> {
        self.blocks[y / BLOCK * BLOCKS + x / BLOCK].whole
    }

    /// The corners of a fragment of a pixel; `room` is for those of one that has none of its own.
    pub(super) fn corners<'r>(
        &'r self,
        fragment: &Fragment,
        at: [usize; 2],
        room: &'r mut [Vec<DVec2>; 2],
    ) -> &'r [DVec2] {
        match &fragment.shape {
            Shape::Polygon(corners, _) => &self.corners[corners.start as usize..corners.end as usize],
            Shape::Square => {
                room[0].clear();
                room[0].extend(square(at, 1));
                &room[0]
            }
            Shape::Triangle => {
                clip(&self.facets[fragment.facet as usize], at, room);
                &room[0]
            }
        }
    }

    /// Whether a fragment of a pixel has a point of the screen.
    pub(super) fn holds(&self, fragment: &Fragment, at: DVec2) -> bool {
        match &fragment.shape {
            Shape::Polygon(corners, _) => {
                super::convex::holds(&self.corners[corners.start as usize..corners.end as usize], at)
            }
            Shape::Square => true,
            Shape::Triangle => self.facets[fragment.facet as usize].holds(at),
        }
    }

    /// Whether a pixel had more fragments than may be, so that none tells what it sees.
    pub(super) fn is_crowded(&self, at: [usize; 2]) -> bool {
        self.pixels[pixel_of(at)].is_crowded
    }

    /// A box around all that a block may see of the plan.
    pub(super) fn plan_of_block(&self, [x, y]: [usize; 2]) -> PlanBox {
        with_hem(&self.blocks[y / BLOCK * BLOCKS + x / BLOCK].plan)
    }

    /// A box around all that a pixel sees of the plan.
    pub(super) fn plan_of_pixel(&self, at: [usize; 2]) -> PlanBox {
        let seen = &self.pixels[pixel_of(at)];
        let square = square(at, 1);
        let mut plan = PlanBox::EMPTY;
        let mut add = |facet: u32| plan.include_box(&self.facets[facet as usize].plan_in(square));
        if let Some(facet) = self.whole(at) {
            add(facet);
        } else if seen.is_cut {
            self.fragments[pixel_of(at)].iter().for_each(|fragment| add(fragment.facet));
        } else {
            let mut next = seen.first;
            while let Some(entry) = self.entries.get(next as usize) {
                add(entry.facet);
                next = entry.next;
            }
            if seen.is_crowded {
                plan.include_box(&self.beyond[pixel_of(at)]);
            }
        }
        with_hem(&plan)
    }

    /// The least key that may be seen in the tile.
    pub(super) fn least_key(&self) -> f64 {
        self.least
    }

    /// Whether nothing with a key up to `key` is seen in a rectangle of the tile (x from, y from, x to, y to).
    pub(super) fn hides(&mut self, rectangle: [f64; 4], key: f64) -> bool {
        let Some([columns, rows]) = self.within(rectangle) else { return true };
        let blocks = |range: Range<usize>| range.start / BLOCK..range.end.div_ceil(BLOCK);
        for y in blocks(rows) {
            for x in blocks(columns.clone()) {
                if self.farthest_of(y * BLOCKS + x) < key {
                    return false;
                }
            }
        }
        true
    }

    fn farthest_of(&mut self, block: usize) -> f64 {
        let of = &mut self.blocks[block];
        if of.closed < of.pixels {
            return f64::NEG_INFINITY;
        }
        if std::mem::take(&mut of.is_dirty) {
            of.farthest = f64::INFINITY;
            let ([x, y], [width, height]) = (corner_of(block), block_size(self.size, block));
            for row in y..y + height {
                for seen in &self.pixels[pixel_of([x, row])..][..width] {
                    of.farthest = math::min(seen.farthest, of.farthest);
                }
            }
        }
        of.farthest
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
    pub(super) fn add(&mut self, facet: Facet, outline: &Outline) {
        let Some([columns, rows]) = self.within(outline.reach) else { return };
        let (number, mut is_seen, mut open) = (self.facets.len() as u32, false, 0_u32);
        let is_large = columns.len() >= BLOCK && rows.len() >= BLOCK;
        for y in rows.start / BLOCK..rows.end.div_ceil(BLOCK) {
            for x in columns.start / BLOCK..columns.end.div_ceil(BLOCK) {
                match self.enter(&facet, number, [x, y], is_large) {
                    Entered::No => {}
                    Entered::Whole => is_seen = true,
                    Entered::Open => open |= 1 << (y * BLOCKS + x),
                }
            }
        }
        if open != 0 && self.budget == 0 {
            return;
        }
        if open != 0 {
            is_seen |= match &outline.corners {
                Some(corners) => self.add_areas((&facet, number), corners, [columns, rows], open),
                None => self.add_polygons((&facet, number), [columns, rows], open),
            };
        }
        if is_seen {
            self.facets.push(facet);
        }
    }

    /// Looks at what a triangle does to a block.
    fn enter(&mut self, facet: &Facet, number: u32, at: [usize; 2], is_large: bool) -> Entered {
        const HALF: f64 = BLOCK as f64 / 2.0;
        let middle = DVec2::new(at[0] as f64, at[1] as f64) * BLOCK as f64 + HALF;
        let number_of = at[1] * BLOCKS + at[0];
        if facet.nearest_in(middle, HALF) <= self.farthest_of(number_of) {
            return Entered::No;
        }
        let reach = |side: &Side| HALF * side.normal.abs().element_sum();
        let (is_empty, is_whole) = (self.blocks[number_of].is_empty, self.blocks[number_of].whole.is_some());
        if (is_large || is_whole) && facet.sides().any(|side| side.at(middle) <= -reach(&side)) {
            return Entered::No;
        }
        let corner = [at[0] * BLOCK, at[1] * BLOCK];
        self.blocks[number_of].plan.include_box(&facet.plan_in(square(corner, BLOCK)));
        let farthest = facet.farthest_in(middle, HALF);
        self.least = math::min(farthest, self.least);
        if self.budget > 0
            && is_large
            && is_empty
            && facet.sides().all(|side| side.at(middle) >= reach(&side))
        {
            let block = &mut self.blocks[number_of];
            block.whole = Some(number);
            (block.is_empty, block.is_dirty) = (false, false);
            (block.closed, block.farthest) = (block.pixels, farthest);
            return Entered::Whole;
        }
        self.divide(number_of);
        Entered::Open
    }

    /// Adds a triangle by the areas that it covers in the pixels of open blocks; returns whether any of it is seen (so far).
    fn add_areas(
        &mut self,
        (facet, number): (&Facet, u32),
        corners: &[DVec2; 3],
        ranges: [Range<usize>; 2],
        open: u32,
    ) -> bool {
        let mut cells = std::mem::take(&mut self.cells);
        cells.set(corners, ranges);
        let mut is_seen = false;
        cells.each(|at, area, border| {
            if open >> block_at(at) & 1 == 1 {
                is_seen |= self.add_to_pixel((facet, number), at, area, border);
            }
        });
        self.cells = cells;
        is_seen
    }

    /// The same for a triangle that planes cut, or whose corners have no places.
    fn add_polygons(
        &mut self,
        (facet, number): (&Facet, u32),
        [columns, rows]: [Range<usize>; 2],
        open: u32,
    ) -> bool {
        let mut is_seen = false;
        for at in rows.flat_map(|y| columns.clone().map(move |x| [x, y])) {
            let middle = DVec2::new(at[0] as f64 + 0.5, at[1] as f64 + 0.5);
            let reach = |side: &Side| 0.5 * side.normal.abs().element_sum();
            if open >> block_at(at) & 1 == 0 || facet.sides().any(|side| side.at(middle) <= -reach(&side)) {
                continue;
            }
            if facet.sides().all(|side| side.at(middle) >= reach(&side)) {
                is_seen |= self.add_to_pixel((facet, number), at, 1.0, 0);
                continue;
            }
            let mut room = std::mem::take(&mut self.room);
            clip(facet, at, &mut room);
            let covered = area(&room[0]);
            self.room = room;
            // Its sides are not walked over: they cancel nothing.
            let border = (u64::from(number) << 1 | 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
            is_seen |= covered > NOTHING && self.add_to_pixel((facet, number), at, covered, border);
        }
        is_seen
    }

    /// Gives the pixels of a block that sees one triangle alone lists.
    fn divide(&mut self, block: usize) {
        let Some(number) = self.blocks[block].whole.take() else { return };
        let ([x, y], [width, height]) = (corner_of(block), block_size(self.size, block));
        for at in (y..y + height).flat_map(|y| (x..x + width).map(move |x| [x, y])) {
            let facet = &self.facets[number as usize];
            let middle = DVec2::new(at[0] as f64 + 0.5, at[1] as f64 + 0.5);
            let entry = self.entries.len() as u32;
            self.entries.push(Entry { facet: number, next: NONE, area: 1.0 });
            self.pixels[pixel_of(at)] = Seen {
                covered: 1.0,
                ground: facet.ground,
                farthest: facet.farthest_in(middle, 0.5),
                first: entry,
                last: entry,
                count: 1,
                is_closed: true,
                ..Seen::NOTHING
            };
        }
        self.blocks[block].is_dirty = true;
    }

    /// Adds so much of a triangle to a pixel; returns whether a part of it is seen there (so far).
    fn add_to_pixel(
        &mut self,
        (facet, number): (&Facet, u32),
        at: [usize; 2],
        area: f64,
        border: u64,
    ) -> bool {
        let middle = DVec2::new(at[0] as f64 + 0.5, at[1] as f64 + 0.5);
        let [nearest, farthest] = match facet.is_small {
            true => [facet.keys[1], facet.keys[0]],
            false => [facet.nearest_in(middle, 0.5), facet.farthest_in(middle, 0.5)],
        };
        let pixel = pixel_of(at);
        let seen = &mut self.pixels[pixel];
        if seen.is_closed && nearest <= seen.farthest {
            return false;
        }
        if area > NOTHING && !seen.is_cut && seen.covered > TWICE {
            self.cut(at);
        }
        let seen = &mut self.pixels[pixel];
        if seen.is_cut {
            if seen.is_crowded || area <= NOTHING {
                return false;
            }
            let facets = std::mem::take(&mut self.facets);
            let is_seen = self.add_fragment(&facets, (facet, number), at);
            self.facets = facets;
            return is_seen;
        }
        self.count_in(at, (area, border), farthest, facet.ground);
        let is_seen = area > NOTHING;
        if is_seen {
            let seen = &mut self.pixels[pixel];
            if seen.count as usize <= ROOM * self.budget {
                let entry = self.entries.len() as u32;
                match self.entries.get_mut(seen.last as usize) {
                    Some(last) => last.next = entry,
                    None => seen.first = entry,
                }
                seen.last = entry;
                self.entries.push(Entry { facet: number, next: NONE, area });
            } else {
                if !std::mem::replace(&mut seen.is_crowded, true) {
                    self.beyond[pixel] = PlanBox::EMPTY;
                }
                self.beyond[pixel].include_box(&facet.plan_in(square(at, 1)));
            }
        }
        is_seen
    }

    /// Adds a triangle that lies in one pixel whose list has no room for it: nothing but its area, its sides and its paint is needed. False: it is
    /// none. Its keys are the least and the most of its corners'.
    pub(super) fn add_speck(
        &mut self,
        corners: &[DVec2; 3],
        [farthest, nearest]: [f64; 2],
        plan: impl FnOnce() -> PlanBox,
        ground: impl FnOnce() -> Paint,
    ) -> bool {
        let [a, b, c] = *corners;
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let first = low.floor();
        if low.x < 0.0 || low.y < 0.0 || high.x >= first.x + 1.0 || high.y >= first.y + 1.0 {
            return false;
        }
        let at = [first.x as usize, first.y as usize];
        if at[0] >= self.size[0] || at[1] >= self.size[1] {
            return false;
        }
        let seen = &self.pixels[pixel_of(at)];
        if self.budget == 0 || !seen.is_crowded || seen.is_cut || seen.covered > TWICE {
            return false;
        }
        if seen.is_closed && nearest <= seen.farthest {
            return true;
        }
        let plan = plan();
        self.beyond[pixel_of(at)].include_box(&plan);
        self.blocks[block_at(at)].plan.include_box(&plan);
        self.least = math::min(farthest, self.least);
        self.count_in(at, cells::inside_of_a_pixel(corners), farthest, ground());
        true
    }

    /// Counts the area and the sides of a triangle in a pixel.
    fn count_in(&mut self, at: [usize; 2], (area, border): (f64, u64), farthest: f64, ground: Paint) {
        let seen = &mut self.pixels[pixel_of(at)];
        self.blocks[block_at(at)].is_empty = false;
        seen.border = seen.border.wrapping_add(border);
        if area > NOTHING {
            seen.covered += area;
            seen.ground = seen.ground.plus(ground.times(area));
            seen.farthest = math::min(farthest, seen.farthest);
            seen.count += 1;
        }
        let is_closed = seen.border == 0 && seen.covered >= FULL;
        self.close(at, is_closed);
    }

    /// Says whether a pixel is closed.
    fn close(&mut self, at: [usize; 2], is_closed: bool) {
        let (seen, block) = (&mut self.pixels[pixel_of(at)], &mut self.blocks[block_at(at)]);
        block.is_dirty |= is_closed;
        match (std::mem::replace(&mut seen.is_closed, is_closed), is_closed) {
            (false, true) => block.closed += 1,
            (true, false) => block.closed -= 1,
            _ => {}
        }
    }

    /// Makes fragments of the lists of all pixels whose triangles do not lie side by side.
    pub(super) fn finish(&mut self) {
        let [width, height] = self.size;
        for at in (0..height).flat_map(|y| (0..width).map(move |x| [x, y])) {
            let seen = &self.pixels[pixel_of(at)];
            if !seen.is_cut && !seen.is_even() && (seen.count > 1 || seen.is_crowded) {
                self.cut(at);
            }
        }
    }

    /// Makes fragments of a pixel's list.
    fn cut(&mut self, at: [usize; 2]) {
        let pixel = pixel_of(at);
        let seen = &mut self.pixels[pixel];
        (seen.is_cut, seen.covered) = (true, 0.0);
        let mut next = std::mem::replace(&mut seen.first, NONE);
        self.fragments[pixel].clear();
        self.close(at, false);
        if self.pixels[pixel].is_crowded {
            self.crowd(at);
            return;
        }
        let facets = std::mem::take(&mut self.facets);
        while let Some(&Entry { facet: number, next: following, .. }) = self.entries.get(next as usize) {
            next = following;
            self.add_fragment(&facets, (&facets[number as usize], number), at);
            if self.pixels[pixel].is_crowded {
                break;
            }
        }
        self.facets = facets;
    }

    /// Gives a pixel up.
    fn crowd(&mut self, at: [usize; 2]) {
        let seen = &mut self.pixels[pixel_of(at)];
        (seen.is_crowded, seen.covered, seen.farthest) = (true, 0.0, f64::INFINITY);
        self.fragments[pixel_of(at)].clear();
        self.close(at, true);
    }

    /// Adds what of a triangle lies in a pixel to its fragments.
    fn add_fragment(&mut self, facets: &[Facet], (facet, number): (&Facet, u32), at: [usize; 2]) -> bool {
        let mut room = std::mem::take(&mut self.room);
        clip(facet, at, &mut room);
        let is_seen = area(&room[0]) > NOTHING && self.merge(facets, (facet, number), at, &room[0]);
        self.room = room;
        if is_seen {
            self.look_anew(facets, facet, at);
        }
        is_seen
    }

    /// Resolves a new polygon against what a pixel sees; returns whether any of it is left.
    fn merge(
        &mut self,
        facets: &[Facet],
        (facet, number): (&Facet, u32),
        at: [usize; 2],
        polygon: &[DVec2],
    ) -> bool {
        let pixel = pixel_of(at);
        let [low, high] = bounds_of(polygon);
        // What is left of the new one.
        let mut pieces = std::mem::take(&mut self.pieces);
        pieces.set(polygon);
        let count = self.fragments[pixel].len();
        let mut kept = 0;
        for k in 0..count {
            let Shape::Polygon(range, [from, to]) = self.fragments[pixel][k].shape.clone() else { continue };
            let mut stays = true;
            let may_meet = from.x < high.x && low.x < to.x && from.y < high.y && low.y < to.y;
            let corners = &self.corners[range.start as usize..range.end as usize];
            if may_meet && !pieces.is_empty() && !are_apart(corners, polygon) {
                let old = self.fragments[pixel][k].facet;
                match order(facet, &facets[old as usize], [polygon, corners]) {
                    Some(Order::Farther) => pieces.lose(corners),
                    Some(Order::Nearer) => {
                        stays = false;
                        let corners = corners.to_vec();
                        without(&corners, polygon, |piece| self.push(old, pixel, piece));
                    }
                    None => {
                        let both = common(corners, polygon);
                        if area(&both) > NOTHING {
                            let [nearer, farther] = split_by_key(facet, &facets[old as usize], &both);
                            if area(&farther) > NOTHING {
                                pieces.lose(&farther);
                            }
                            if area(&nearer) > NOTHING {
                                stays = false;
                                let corners = corners.to_vec();
                                without(&corners, &nearer, |piece| self.push(old, pixel, piece));
                            }
                        }
                    }
                }
            }
            if stays {
                self.fragments[pixel].swap(kept, k);
                kept += 1;
            }
        }
        // What was cut stands behind the old ones.
        self.fragments[pixel].drain(kept..count);
        let is_seen = !pieces.is_empty() || kept < count;
        pieces.rings().for_each(|piece| self.push(number, pixel, piece));
        self.pieces = pieces;
        is_seen
    }

    fn push(&mut self, facet: u32, pixel: usize, piece: &[DVec2]) {
        let first = self.corners.len() as u32;
        self.corners.extend_from_slice(piece);
        let shape = Shape::Polygon(first..self.corners.len() as u32, bounds_of(piece));
        self.fragments[pixel].push(Fragment { facet, shape, area: area(piece) });
    }

    /// Finds anew what a pixel hides.
    fn look_anew(&mut self, facets: &[Facet], facet: &Facet, at: [usize; 2]) {
        let pixel = pixel_of(at);
        let fragments = &self.fragments[pixel];
        if fragments.len() > self.budget {
            self.crowd(at);
            return;
        }
        let covered = fragments.iter().map(|fragment| fragment.area).sum();
        self.pixels[pixel].covered = covered;
        if covered < FULL {
            return;
        }
        let mut least = f64::INFINITY;
        for fragment in fragments {
            // The triangle that is being added is not among them yet.
            let of = facets.get(fragment.facet as usize).unwrap_or(facet);
            let Shape::Polygon(range, _) = &fragment.shape else { continue };
            let own = &self.corners[range.start as usize..range.end as usize];
            least = own.iter().map(|p| of.key.at(*p)).fold(least, |least, key| math::min(key, least));
        }
        self.pixels[pixel].farthest = least;
        self.close(at, true);
    }
}

/// What a triangle does to a block.
enum Entered {
    /// Nothing: it misses it, or is hidden there.
    No,
    /// It covers all of it, alone so far.
    Whole,
    /// Its pixels are to be looked at.
    Open,
}

/// What of a triangle lies in a pixel, in the first of two lists.
fn clip(facet: &Facet, at: [usize; 2], [polygon, next]: &mut [Vec<DVec2>; 2]) {
    let middle = DVec2::new(at[0] as f64 + 0.5, at[1] as f64 + 0.5);
    polygon.clear();
    polygon.extend(square(at, 1));
    for side in facet.sides() {
        if side.at(middle) < 0.5 * side.normal.abs().element_sum() {
            next.clear();
            cut(polygon, &side, next);
            std::mem::swap(polygon, next);
        }
    }
}

/// The least and the most of each coordinate.
fn bounds_of(polygon: &[DVec2]) -> [DVec2; 2] {
    let none = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    polygon.iter().fold(none, |[low, high], p| [low.min(*p), high.max(*p)])
}

fn pixel_of([x, y]: [usize; 2]) -> usize {
    y * TILE + x
}

/// The block of a pixel.
fn block_at([x, y]: [usize; 2]) -> usize {
    y / BLOCK * BLOCKS + x / BLOCK
}

/// A block's first column and row.
fn corner_of(block: usize) -> [usize; 2] {
    [block % BLOCKS * BLOCK, block / BLOCKS * BLOCK]
}

/// How many columns and rows of a tile of some size a block has.
fn block_size(size: [usize; 2], block: usize) -> [usize; 2] {
    let corner = corner_of(block);
    [0, 1].map(|k| size[k].saturating_sub(corner[k]).min(BLOCK))
}

/// The corners of so many pixels a side, from one on.
pub(super) fn square([x, y]: [usize; 2], side: usize) -> [DVec2; 4] {
    let (from, to) = (DVec2::new(x as f64, y as f64), DVec2::new((x + side) as f64, (y + side) as f64));
    [from, DVec2::new(to.x, from.y), to, DVec2::new(from.x, to.y)]
}
