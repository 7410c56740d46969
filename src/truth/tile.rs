//! The triangles of a tile, and the tile's pixels.

use super::facet::{Facet, Hit};
use super::knowledge::Pixel;
use super::outcome::{PixelLook, Sample, SeenPiece};
use super::polygon::{self, Pieces};
use super::refine::Refinery;
use super::setting::Setting;
use super::tile_rays::TileRays;
use super::visible::Sight;
use super::{Centre, PixelCoverage, Tally};
use crate::math;
use crate::space::{Lens, PlanBox, Screen, ViewFrame, World};
use crate::terrain::{self, Bounds, Mesh, Node, SKY};
use crate::tiling::TilePlace;
use glam::DVec3;
use std::ops::Range;

/// Side of a tile in pixels: a multiple of [`BLOCK`].
pub(super) const TILE: usize = 32;

/// A pixel's square with more triangles than this is quartered, down to an eighth of a pixel.
const MOST_TRIANGLES: usize = 24;
const SMALLEST: f64 = 1.0 / 8.0;

/// The half spaces of what a rectangle of the screen sees: through the eye, or along the view.
#[derive(Debug)]
pub(super) struct Frustum {
    /// Inward normals of the sides, each with a point of its plane.
    sides: [(DVec3, World); 4],
    forward: DVec3,
    eye: World,
    near: f64,
    far: f64,
}

/// What rounding may do to the place of a box, as a share of the coordinates.
const BOX_SHARE: f64 = 1e-9;

impl Frustum {
    /// What a rectangle of the screen sees.
    pub(super) fn new(frame: &ViewFrame, [x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> Self {
        let pixel = frame.lens().pixel();
        let (half_width, half_height) = (frame.width() as f64 / 2.0, frame.height() as f64 / 2.0);
        let (right, up, forward) = (frame.right(), frame.up(), frame.forward());
        let (west, east) = ((x0 - half_width) * pixel, (x1 - half_width) * pixel);
        let (top, bottom) = ((half_height - y0) * pixel, (half_height - y1) * pixel);
        let eye = frame.eye();
        let sides = match frame.lens() {
            Lens::Central { .. } => [
                (right - forward * west, eye),
                (forward * east - right, eye),
                (up - forward * bottom, eye),
                (forward * top - up, eye),
            ],
            Lens::Parallel { .. } => [
                (right, eye + right * west),
                (-right, eye + right * east),
                (up, eye + up * bottom),
                (-up, eye + up * top),
            ],
        };
        Self { sides, forward, eye, near: frame.near(), far: frame.far() }
    }

    /// Calls `visit` with the leaves of the terrain's hierarchy, from a node down, that may be seen.
    pub(super) fn for_each_leaf(&self, mesh: &Mesh, node: Node, visit: &mut dyn FnMut(Node, &Bounds)) {
        let Some(bounds) = mesh.bounds(node).filter(|b| self.meets(b.center, &b.axes)) else {
            return;
        };
        match node.level {
            0 => visit(node, &bounds),
            _ => mesh.for_each_child(node, |child| self.for_each_leaf(mesh, child, visit)),
        }
    }

    /// Whether a box may be seen; `center` and half extents as of [`crate::terrain::Bounds`].
    fn meets(&self, center: World, axes: &[DVec3; 3]) -> bool {
        let reach = |normal: DVec3| axes.iter().fold(0.0, |sum, axis| sum + normal.dot(*axis).abs());
        let size = center.to_vec().abs().max_element() + self.eye.to_vec().abs().max_element();
        let margin = |normal: DVec3| {
            let sides = axes.iter().fold(0.0, |sum, axis| sum + axis.length());
            BOX_SHARE * normal.length() * (size + sides)
        };
        let depth = self.forward.dot(center - self.eye);
        let span = reach(self.forward) + margin(self.forward);
        depth + span >= self.near
            && depth - span <= self.far
            && self.sides.iter().all(|(n, at)| n.dot(center - *at) + reach(*n) + margin(*n) >= 0.0)
    }

    /// Whether terrain that is draped vertically may be seen between two heights over a box of the plan.
    pub(super) fn meets_plan(&self, plan: &PlanBox, (low, high): (f64, f64)) -> bool {
        let middle = plan.min.to_vec() / 2.0 + plan.max.to_vec() / 2.0;
        let half = plan.max.to_vec() / 2.0 - plan.min.to_vec() / 2.0;
        if !half.is_finite() {
            return true;
        }
        let center = World::new(middle.x, middle.y, (low + high) / 2.0);
        self.meets(center, &[DVec3::X * half.x, DVec3::Y * half.y, DVec3::Z * ((high - low) / 2.0)])
    }
}

/// A tile's answers: lower bounds, upper bounds, estimates of its pixels, rows from the top.
pub(super) struct TileTruth {
    pub(super) colors: Vec<[[f64; 4]; 3]>,
    pub(super) coverage: Vec<PixelCoverage>,
    pub(super) centres: Vec<Option<Centre>>,
    /// Where samples are probed, those of each pixel; the colours are then left out.
    pub(super) samples: Vec<Vec<Sample>>,
    pub(super) tally: Tally,
}

/// Where samples lie in each pixel, and how far from there what they see may be taken.
#[derive(Clone, Copy)]
pub(super) struct Probes<'a> {
    /// Places in the pixel, 0..=1 from its upper left corner.
    pub(super) spots: &'a [[f64; 2]],
    /// How far a sample may be shifted along each axis, pixels: each of these is asked for.
    pub(super) shifts: &'a [f64],
    /// How many shifts' worth of the surface's depth a visible point may seem to lie elsewhere along its ray.
    pub(super) depths_of_shifts: f64,
    /// How far along its ray a visible point of a view depth may seem to lie elsewhere besides, metres.
    pub(super) along: &'a (dyn Fn(f64) -> f64 + Sync),
    /// How far a visible point's coordinates may be off, as a share of their size.
    pub(super) share: f64,
}

/// The largest shift of a sample, pixels: more than that is no question of rounding.
pub(super) const MOST_SHIFT: f64 = 0.25;

/// A leaf of the terrain's hierarchy as a tile sees it.
#[derive(Debug)]
struct Leaf {
    node: Node,
    /// A box of the tile around what is seen of it.
    from: [f64; 2],
    to: [f64; 2],
    /// No point of it is nearer (as [`Facet::nearness`]).
    nearest: f64,
    /// Its facets among the tile's, once one of its pixels needed them.
    facets: Option<Range<u32>>,
}

/// A tile at work.
struct Work<'a> {
    setting: &'a Setting<'a>,
    mesh: &'a Mesh,
    rays: TileRays,
    /// Nearest first.
    leaves: Vec<Leaf>,
    facets: Vec<Facet>,
    /// A box of the tile around each facet, small enough that going through many is quick.
    boxes: Vec<Reach>,
    /// The tile's pixels that are in the picture.
    size: [usize; 2],
    pieces: Pieces,
    sight: Sight,
    refinery: Refinery,
    /// A square this small is not quartered any more, pixels.
    smallest: f64,
    /// `None`: whole pixels are certified.
    probes: Option<Probes<'a>>,
    out: TileTruth,
}

/// The truth of a tile of the picture, or what samples in its pixels may see.
pub(super) fn certify_tile(
    setting: &Setting,
    mesh: &Mesh,
    frame: &ViewFrame,
    place: &TilePlace,
    probes: Option<Probes>,
) -> TileTruth {
    let size = place.size;
    let mut work = Work::new(setting, mesh, frame, place, probes);
    for y in (0..size[1]).step_by(BLOCK) {
        for x in (0..size[0]).step_by(BLOCK) {
            work.block([x, y]);
        }
    }
    work.out.tally.pieces = work.refinery.pieces;
    work.out.tally.triangles += work.facets.len() as u64;
    work.out
}

/// The truth of one pixel, and what it sees.
pub(super) fn seen_in_pixel(
    setting: &Setting,
    (mesh, frame): (&Mesh, &ViewFrame),
    corner: [usize; 2],
) -> PixelLook {
    let mut work = Work::new(setting, mesh, frame, &TilePlace { corner, size: [1, 1] }, None);
    work.block([0, 0]);
    let at = |[x, y]: [f64; 2]| Screen::new(corner[0] as f64 + x, corner[1] as f64 + y);
    let piece = |triangle, shape| SeenPiece {
        triangle,
        corners: work.pieces.of(shape).iter().map(|corner| at(*corner)).collect(),
    };
    let fragments = work.sight.fragments.iter();
    let terrain = fragments.map(|f| piece(work.facets[f.facet as usize].id, f.shape));
    let pieces = terrain.chain(work.sight.sky.iter().map(|shape| piece(SKY, *shape))).collect();
    let [low, high, estimate] = work.out.colors[0];
    let coverage = work.out.coverage.pop().unwrap_or_default();
    PixelLook { low, high, estimate, coverage, centre: work.out.centres[0], pieces }
}

impl Leaf {
    fn new(node: Node, bounds: &Bounds, (frame, corner): (&ViewFrame, [f64; 2])) -> Self {
        let everywhere = ([f64::NEG_INFINITY; 2], [f64::INFINITY; 2]);
        let mut leaf =
            Self { node, from: everywhere.1, to: everywhere.0, nearest: f64::INFINITY, facets: None };
        let mut least = f64::INFINITY;
        for k in 0..8 {
            let sign = |bit: u32| if k >> bit & 1 == 0 { -1.0 } else { 1.0 };
            let [a, b, c] = bounds.axes;
            let p = bounds.center + (a * sign(0) + b * sign(1) + c * sign(2));
            let depth = frame.depth(p);
            least = if depth < least { depth } else { least };
            for (axis, at) in
                frame.screen_from_world(p).map_or([f64::NAN; 2], |s| [s.x, s.y]).into_iter().enumerate()
            {
                leaf.from[axis] = math::min(at - corner[axis] - LEAF_MARGIN, leaf.from[axis]);
                leaf.to[axis] = math::max(at - corner[axis] + LEAF_MARGIN, leaf.to[axis]);
            }
        }
        let size = bounds.center.to_vec().abs().max_element() + frame.eye().to_vec().abs().max_element();
        // Too near for rounding to stay below the margin, or behind the eye: it may be anywhere.
        if least <= NEAR_SHARE * size && matches!(frame.lens(), Lens::Central { .. }) {
            (leaf.from, leaf.to) = everywhere;
            return leaf;
        }
        leaf.nearest = match frame.lens() {
            Lens::Central { .. } => 1.0 / least * (1.0 + 1e-6),
            Lens::Parallel { .. } => -least + NEAR_SHARE * size,
        };
        leaf
    }

    /// Whether a square may see some of it.
    fn meets(&self, [x, y]: [f64; 2], side: f64) -> bool {
        self.from[0] <= x + side && self.to[0] >= x && self.from[1] <= y + side && self.to[1] >= y
    }
}

/// What is added around a leaf's box on the screen, pixels: far more than the rounding of its place.
const LEAF_MARGIN: f64 = 1e-2;

/// View depths below this share of the coordinates are too near to trust a box's place on the screen.
const NEAR_SHARE: f64 = 1e-6;

/// Side of a block of pixels that open the terrain's leaves together.
const BLOCK: usize = 8;

/// Triangles that a block's first look takes; each further look takes twice as many.
const FIRST_LOOK: usize = 512;

/// When a block has looked at so many and is not done, its pixels are done in parts, each with triangles of its own.
const MOST_OF_A_BLOCK: usize = 8192;

/// A box of a tile: west, north, east, south.
#[derive(Debug, Clone, Copy)]
struct Reach([f32; 4]);

impl Reach {
    /// All of the tile.
    const ALL: Self = Self([f32::NEG_INFINITY, f32::NEG_INFINITY, f32::INFINITY, f32::INFINITY]);

    /// A box around a triangle, with a margin far above the rounding.
    fn of(corners: &[World; 3], rays: &TileRays) -> Self {
        let (frame, tile) = (&rays.frame, rays.corner);
        let mut all = Self([f32::INFINITY, f32::INFINITY, f32::NEG_INFINITY, f32::NEG_INFINITY]);
        for corner in corners {
            let size = corner.to_vec().abs().max_element() + frame.eye().to_vec().abs().max_element();
            let is_clear = frame.depth(*corner) > NEAR_SHARE * size || !rays.is_central;
            let Some(at) = frame.screen_from_world(*corner).filter(|_| is_clear) else {
                return Self::ALL;
            };
            let (x, y) = ((at.x - tile[0]) as f32, (at.y - tile[1]) as f32);
            let margin = LEAF_MARGIN as f32 + 1e-6 * (x.abs() + y.abs());
            all.0[0] = math::min_f32(x - margin, all.0[0]);
            all.0[1] = math::min_f32(y - margin, all.0[1]);
            all.0[2] = math::max_f32(x + margin, all.0[2]);
            all.0[3] = math::max_f32(y + margin, all.0[3]);
        }
        all
    }

    /// A square of a pixel, or of pixels: its corners are multiples of an eighth.
    fn of_square([x, y]: [f64; 2], side: f64) -> Self {
        Self([x as f32, y as f32, (x + side) as f32, (y + side) as f32])
    }

    #[inline(always)]
    fn meets(&self, other: &Self) -> bool {
        let ([w, n, e, s], [a, b, c, d]) = (self.0, other.0);
        // No short circuit: four comparisons cost less than a branch.
        (w <= c) & (a <= e) & (n <= d) & (b <= s)
    }
}

/// A block of pixels at work.
struct Block<'a> {
    /// Its first pixel.
    corner: [usize; 2],
    /// The leaves that have not been opened, nearest first.
    rest: &'a [usize],
    /// Which of its pixels are not done.
    open: &'a mut [[bool; BLOCK]; BLOCK],
}

/// Whether a facet may cover some of a square.
fn may_cover(facet: &Facet, corner: [f64; 2], side: f64) -> bool {
    facet.bounds().iter().all(|form| form.range(corner, side).1 >= -form.error)
}

/// Whether a facet surely covers all of a square.
fn covers(facet: &Facet, corner: [f64; 2], side: f64) -> bool {
    facet.bounds().iter().all(|form| form.range(corner, side).0 >= form.error)
}

/// Those of some facets that a square may see: not beside it, and not behind one that covers all of it.
fn narrowed((facets, boxes): (&[Facet], &[Reach]), from: &[u32], corner: [f64; 2], side: f64) -> Vec<u32> {
    let square = Reach::of_square(corner, side);
    let is_near = |k: usize| boxes[k].meets(&square) && may_cover(&facets[k], corner, side);
    let mut near: Vec<u32> = from.iter().copied().filter(|&k| is_near(k as usize)).collect();
    let mut cover = f64::NEG_INFINITY;
    for &k in &near {
        let facet = &facets[k as usize];
        let farthest = facet.nearness_range(corner, side).0;
        if farthest > cover && covers(facet, corner, side) {
            cover = farthest;
        }
    }
    near.retain(|&k| facets[k as usize].nearness_range(corner, side).1 >= cover);
    near
}

impl<'a> Work<'a> {
    fn new(
        setting: &'a Setting<'a>,
        mesh: &'a Mesh,
        frame: &ViewFrame,
        &TilePlace { corner, size }: &TilePlace,
        probes: Option<Probes<'a>>,
    ) -> Self {
        let start = corner.map(|v| v as f64);
        let margin = if probes.is_some() { MOST_SHIFT } else { 0.0 };
        let rays = TileRays::new(frame, start, TILE as f64 + margin);
        let end = [start[0] + size[0] as f64 + margin, start[1] + size[1] as f64 + margin];
        let frustum = Frustum::new(frame, start.map(|v| v - margin), end);
        let mut leaves = Vec::new();
        frustum.for_each_leaf(mesh, mesh.root(), &mut |node, bounds| {
            leaves.push(Leaf::new(node, bounds, (frame, start)));
        });
        leaves.sort_by(|a, b| b.nearest.total_cmp(&a.nearest));
        let count = size[0] * size[1];
        let kept = if setting.budget.coverage && probes.is_none() { count } else { 0 };
        let out = TileTruth {
            colors: vec![[[0.0; 4]; 3]; count],
            coverage: vec![PixelCoverage::default(); kept],
            centres: vec![None; count],
            samples: if probes.is_some() { vec![Vec::new(); count] } else { Vec::new() },
            tally: Tally::default(),
        };
        let (pieces, sight, refinery) = (Pieces::default(), Sight::default(), Refinery::default());
        let (facets, boxes) = (Vec::new(), Vec::new());
        Self {
            setting,
            mesh,
            rays,
            leaves,
            facets,
            boxes,
            size,
            pieces,
            sight,
            refinery,
            smallest: SMALLEST,
            probes,
            out,
        }
    }

    /// Does the pixels of a block: opens leaves, nearest first, until each pixel is covered before the next one.
    fn block(&mut self, [x, y]: [usize; 2]) {
        let (corner, side) = self.grown([x as f64, y as f64], BLOCK as f64);
        let near: Vec<usize> =
            (0..self.leaves.len()).filter(|&k| self.leaves[k].meets(corner, side)).collect();
        let mut open = [[true; BLOCK]; BLOCK];
        let (mut look, mut seen, mut facets) = (FIRST_LOOK, 0, Vec::new());
        loop {
            while seen < near.len() && facets.len() < look {
                facets.extend(self.facets_of(near[seen]));
                seen += 1;
            }
            let rest = &near[seen..];
            self.squares(&mut Block { corner: [x, y], rest, open: &mut open }, [0, 0], BLOCK, &facets);
            if rest.is_empty() {
                return;
            }
            if look >= MOST_OF_A_BLOCK && self.probes.is_none() {
                return self.in_parts([x, y], &open, &near);
            }
            look *= 2;
        }
    }

    /// The facets of a leaf, made when they are first asked for.
    fn facets_of(&mut self, leaf: usize) -> Range<u32> {
        if let Some(facets) = &self.leaves[leaf].facets {
            return facets.clone();
        }
        let first = self.facets.len() as u32;
        let square = self.grown([0.0, 0.0], TILE as f64);
        self.open_leaf(leaf, square);
        let facets = first..self.facets.len() as u32;
        self.leaves[leaf].facets = Some(facets.clone());
        facets
    }

    /// Appends the facets of a leaf that may cover some of a square.
    fn open_leaf(&mut self, leaf: usize, (corner, side): ([f64; 2], f64)) {
        let (mesh, rays, facets, boxes) = (self.mesh, &self.rays, &mut self.facets, &mut self.boxes);
        let square = Reach::of_square(corner, side);
        let mut offer = |id: u32| {
            // A leaf is seen in several tiles: most of its triangles elsewhere than here.
            let near = mesh.surface_triangle(id).map(|triangle| (triangle, Reach::of(&triangle.world, rays)));
            let Some((triangle, reach)) = near.filter(|(_, reach)| reach.meets(&square)) else { return };
            if let Some(facet) = Facet::new(rays, id, &triangle).filter(|f| may_cover(f, corner, side)) {
                facets.push(facet);
                boxes.push(reach);
            }
        };
        let node = self.leaves[leaf].node;
        match mesh.leaf(node) {
            terrain::Leaf::Cells(grid) => {
                let (columns, rows) = grid.cells(node);
                for (i, j) in rows.flat_map(|j| columns.clone().map(move |i| (i, j))) {
                    let first = grid.first_triangle(i, j);
                    offer(first);
                    offer(first + 1);
                }
            }
            terrain::Leaf::Triangles(ids) => ids.for_each(offer),
        }
    }

    /// Does those open pixels of a square of a block that these facets cover.
    fn squares(&mut self, block: &mut Block, [x, y]: [usize; 2], side: usize, from: &[u32]) {
        let at = [block.corner[0] + x, block.corner[1] + y];
        let is_open = block.open[y..y + side].iter().any(|row| row[x..x + side].contains(&true));
        if !is_open || at[0] >= self.size[0] || at[1] >= self.size[1] {
            return;
        }
        let (corner, span) = self.grown(at.map(|v| v as f64), side as f64);
        let near = narrowed((&self.facets, &self.boxes), from, corner, span);
        if side == 1 {
            block.open[y][x] = !self.pixel(at, &near, block.rest);
            return;
        }
        let half = side / 2;
        for (dx, dy) in [(0, 0), (half, 0), (0, half), (half, half)] {
            self.squares(block, [x + dx, y + dy], half, &near);
        }
    }

    /// Does a pixel that sees some of these facets, unless more may be seen of the leaves that have not been opened: returns
    /// whether it is done.
    fn pixel(&mut self, [x, y]: [usize; 2], near: &[u32], rest: &[usize]) -> bool {
        let corner = [x as f64, y as f64];
        if let Some(probes) = self.probes {
            return self.probe([x, y], &probes, near, rest);
        }
        if !self.see(corner, ([0.0, 0.0], 1.0), near, rest) {
            return false;
        }
        let pixel = Pixel { setting: self.setting, rays: &self.rays, facets: &self.facets, corner };
        let colors = self.refinery.refine(&pixel, &mut self.pieces, &self.sight);
        let index = y * self.size[0] + x;
        self.out.colors[index] = colors;
        self.out.centres[index] = self.centre(corner);
        self.out.tally.fragments += self.sight.fragments.len() as u64;
        if self.setting.budget.coverage {
            self.out.coverage[index] = self.refinery.coverage();
        }
        true
    }

    /// Finds what a square of a pixel sees of these facets; false where more of it may be seen of the leaves that have not been opened.
    fn see(
        &mut self,
        pixel: [f64; 2],
        (corner, side): ([f64; 2], f64),
        near: &[u32],
        rest: &[usize],
    ) -> bool {
        self.pieces.clear();
        self.sight.clear();
        self.square(pixel, corner, side, near);
        let at = [pixel[0] + corner[0], pixel[1] + corner[1]];
        let next = rest.iter().map(|&k| &self.leaves[k]).find(|leaf| leaf.meets(at, side));
        next.is_none_or(|leaf| self.sight.hides(leaf.nearest))
    }

    /// A square with a margin around it that shifted samples may reach.
    fn grown(&self, [x, y]: [f64; 2], side: f64) -> ([f64; 2], f64) {
        let margin = if self.probes.is_some() { MOST_SHIFT } else { 0.0 };
        ([x - margin, y - margin], side + 2.0 * margin)
    }

    /// What the pixel's centre sees; where triangles meet there, one of them.
    fn centre(&self, pixel: [f64; 2]) -> Option<Centre> {
        const CENTRE: [f64; 2] = [0.5, 0.5];
        let mut fragments = self.sight.fragments.iter();
        let fragment = fragments.find(|f| polygon::holds(self.pieces.of(f.shape), CENTRE))?;
        let facet = &self.facets[fragment.facet as usize];
        let Hit { plan, world, .. } = facet.hit(&self.rays, pixel.map(|v| v + 0.5));
        Some(Centre { triangle: facet.id, world, plan })
    }

    /// Finds what a square of a pixel sees.
    fn square(&mut self, pixel: [f64; 2], corner: [f64; 2], side: f64, near: &[u32]) {
        if near.len() <= MOST_TRIANGLES || side <= self.smallest {
            return self.sight.see(&mut self.pieces, &self.facets, near, (pixel, corner, side));
        }
        let half = side / 2.0;
        for (dx, dy) in [(0.0, 0.0), (half, 0.0), (0.0, half), (half, half)] {
            let corner = [corner[0] + dx, corner[1] + dy];
            let few = narrowed(
                (&self.facets, &self.boxes),
                near,
                [pixel[0] + corner[0], pixel[1] + corner[1]],
                half,
            );
            self.square(pixel, corner, half, &few);
        }
    }
}

mod parts;
mod probing;
#[cfg(test)]
mod tests;
