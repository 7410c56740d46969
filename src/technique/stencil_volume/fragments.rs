//! The fragments of a face in a tile: by the filter and the exact predicates, or by the imitated machine.

use super::block::{BEFORE, BEHIND, COLUMNS, NONE, OPEN, ROWS};
use super::context::Way;
use super::extrusion::Volume;
use super::face::{Face, Fragment, Outline};
use super::solid::{Located, Solid};
use super::stencil::Method;
use super::tile::{Tile, sample_of};
use super::view::Entry;
use crate::predicate;
use crate::raster::device::Window;
use crate::space::{Lens, Ray};
use crate::terrain::SKY;

/// Takes the fragments of a face.
pub type Visit<'v, 'a, R> = dyn FnMut(&mut Tile<'a, R>, (usize, usize), Fragment) + 'v;

impl<'a, R> Tile<'a, R> {
    /// Calls `visit` with each fragment of a face that is no volume's own (a box's).
    pub fn for_each_fragment(&mut self, outline: &Outline, entry: &Entry, visit: &mut Visit<'_, 'a, R>) {
        if self.context.way == Way::Machine {
            return self.visit_on_machine(outline, visit);
        }
        let face = self.setup().face(*outline, self.context.is_cut(entry.volume));
        if let Some(face) = face {
            self.visit_face(&face, visit);
        }
    }

    /// Calls `visit` with each fragment of a face, exactly.
    pub fn visit_face(&mut self, face: &Face, visit: &mut Visit<'_, 'a, R>) {
        let mut states = [NONE; COLUMNS];
        for y in face.rows.0 / ROWS..=face.rows.1 / ROWS {
            for x in face.columns.0 / COLUMNS..=face.columns.1 / COLUMNS {
                let block = y * self.blocks_a_row + x;
                let Some((from, to)) = self.blocks[block].rows_of(face, self.view.first) else { continue };
                for r in from..=to {
                    self.blocks[block].classify(face, self.view.first, r, &mut states);
                    for (lane, state) in states.into_iter().enumerate() {
                        let at = (block, r * COLUMNS + lane);
                        let fragment = match state {
                            NONE => None,
                            OPEN => self.decide((&face.outline, face.facing), at),
                            state => {
                                face.facing.map(|facing| Fragment { facing, is_behind: state == BEHIND })
                            }
                        };
                        if let Some(fragment) = fragment {
                            visit(self, at, fragment);
                        }
                    }
                }
            }
        }
    }

    /// Decides exactly how a sample's line of sight crosses a face.
    #[cold]
    fn decide(&mut self, (face, facing): (&Outline, Option<i32>), at: (usize, usize)) -> Option<Fragment> {
        self.counts.exact_decisions += 1;
        let [c, r] = sample_of(&self.blocks, at);
        let ray = self.view.ray(c, r);
        let id = self.context.sight.triangle(self.view.column + c, self.view.row + r);
        let ground = if id == SKY { None } else { self.context.mesh.triangle(id) };
        let seen = match self.view.frame.lens() {
            Lens::Central { .. } => facing,
            Lens::Parallel { .. } => None,
        };
        let fragment = face.decide(&ray, ground.as_ref(), seen)?;
        self.is_unclipped(face, &ray).then_some(fragment)
    }

    /// Whether the near and the far plane leave a fragment of a face standing.
    fn is_unclipped(&self, face: &Outline, ray: &Ray) -> bool {
        if !self.context.clips() {
            return true;
        }
        let frame = &self.view.frame;
        let [a, b, c, ..] = *face.corners() else { return true };
        predicate::is_hit_beyond(frame, ray, &[a, b, c], frame.near())
            && (frame.far().is_infinite() || !predicate::is_hit_beyond(frame, ray, &[a, b, c], frame.far()))
    }

    /// Calls `visit` with each fragment of a face that the imitated machine draws.
    pub fn visit_on_machine(&mut self, outline: &Outline, visit: &mut Visit<'_, 'a, R>) {
        let context = self.context;
        let Some(machine) = context.sight.machine() else { return };
        let (column, row) = (self.view.column, self.view.row);
        let window = Window { columns: column..column + self.view.width, rows: row..row + self.view.height };
        let corners = outline.corners();
        for k in 2..corners.len() {
            let triangle = [corners[0], corners[k - 1], corners[k]];
            let place = (context.sight.lattice(), &window);
            machine.rasterize(&triangle, !context.clips(), place, &mut |(c, r), facing, depth| {
                let stored = context.sight.stored(c, r).unwrap_or(depth);
                let is_behind = !machine.passes(depth, stored);
                let at = self.index(c - column, r - row);
                visit(self, at, Fragment { facing, is_behind });
            });
        }
    }

    /// Decides and counts the samples of a row that the filter left open.
    #[cold]
    fn settle(&mut self, face: &Face, (block, r): (usize, usize), method: Method, states: &[i32; COLUMNS]) {
        for (lane, _) in states.iter().enumerate().filter(|(_, state)| **state == OPEN) {
            let at = (block, r * COLUMNS + lane);
            self.settle_one((&face.outline, face.facing), at, method);
        }
    }

    /// Decides and counts a sample that a filter left open.
    fn settle_one(&mut self, face: (&Outline, Option<i32>), at: (usize, usize), method: Method) {
        if let Some(fragment) = self.decide(face, at) {
            self.counts.fragments += 1;
            self.stencil.counts[at.0][at.1] += method.step(fragment);
        }
    }

    /// Counts samples near the faces of a volume, face by face.
    #[cold]
    fn settle_near(&mut self, volume: &Volume, near: &[(usize, usize)], method: Method) {
        Outline::for_each(self.context.extrusion, volume, false, |face| {
            let facing = face.seen_by(&self.view.frame);
            // Edge-on no line crosses it.
            if facing != Some(0) {
                near.iter().for_each(|at| self.settle_one((&face, facing), *at, method));
            }
        });
    }
}

/// Counts the faces of a volume in some blocks, compiled for the widest vectors of the machine at hand.
pub struct Sparse<'t, 'a, 'f, R> {
    pub tile: &'t mut Tile<'a, R>,
    pub faces: &'f [Face],
    pub method: Method,
    pub blocks: &'f [usize],
}

impl<R> pulp::WithSimd for Sparse<'_, '_, '_, R> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { tile, faces, method, blocks } = self;
        let first = tile.view.first;
        let mut covered = [0; COLUMNS];
        for &block in blocks {
            tile.stencil.touched[block] = true;
            for face in faces {
                let Some((from, to)) = tile.blocks[block].rows_of(face, first) else { continue };
                let step = |state, is_behind| match face.facing {
                    Some(facing) => (state, method.step(Fragment { facing, is_behind })),
                    None => (state, 0),
                };
                let [(_, behind), (_, before)] = [step(BEHIND, true), step(BEFORE, false)];
                for r in from..=to {
                    let mut states = [NONE; COLUMNS];
                    let any_open = tile.blocks[block].classify(face, first, r, &mut states);
                    let mut steps = [0; COLUMNS];
                    for lane in 0..COLUMNS {
                        let state = states[lane];
                        let forward = if state == BEFORE { before } else { 0 };
                        steps[lane] = if state == BEHIND { behind } else { forward };
                        covered[lane] += i32::from((state == BEHIND) | (state == BEFORE));
                    }
                    tile.stencil.add(block, r, &steps);
                    if any_open {
                        tile.settle(face, (block, r), method, &states);
                    }
                }
            }
        }
        tile.counts.fragments += covered.iter().map(|v| *v as u64).sum::<u64>();
    }
}

/// Counts a volume of one convex ring in the blocks that it may meet: what its faces leave of a sample that lies surely in it, and face
/// by face what lies near one. Compiled for the widest vectors of the machine at hand.
pub struct Convex<'t, 'a, R> {
    pub tile: &'t mut Tile<'a, R>,
    pub volume: &'t Volume,
    pub solid: Solid,
    pub method: Method,
    pub blocks: &'t [usize],
    /// The first and the last row of the tile that its picture can touch.
    pub rows: (usize, usize),
}

impl<R> pulp::WithSimd for Convex<'_, '_, R> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { tile, volume, solid, method, blocks, rows } = self;
        let mut located = Located { inside: [NONE; COLUMNS], near: [NONE; COLUMNS] };
        let mut covered = [0; COLUMNS];
        let mut near = Vec::new();
        for &number in blocks {
            let block = &tile.blocks[number];
            if solid.misses(block) {
                continue;
            }
            tile.stencil.touched[number] = true;
            let last = (rows.1 - block.row).min(ROWS - 1);
            for r in rows.0.saturating_sub(block.row)..=last {
                let any_near = solid.locate(&tile.blocks[number], r, &mut located);
                // Whether fronts are counted before a point or backs behind it: one more is entered than left.
                tile.stencil.add(number, r, &located.inside);
                (0..COLUMNS).for_each(|lane| covered[lane] += located.inside[lane]);
                if any_near {
                    let lanes = (0..COLUMNS).filter(|lane| located.near[*lane] != 0);
                    near.extend(lanes.map(|lane| (number, r * COLUMNS + lane)));
                }
            }
        }
        tile.counts.fragments += covered.iter().map(|v| *v as u64).sum::<u64>();
        if !near.is_empty() {
            tile.settle_near(volume, &near, method);
        }
    }
}
