//! A tile of samples: the nearest triangle and a depth key of each, and how far each block of samples sees.

use super::{KEY_ERROR, TileView};
use crate::predicate;
use crate::space::World;
use crate::terrain::{Mesh, SKY};
use std::cmp::Ordering;

/// Samples a side of a block of the hierarchical depth test.
const BLOCK: usize = 8;

/// Rows of a tile are padded to a multiple of this, so that a row can be drawn in whole vectors.
pub(super) const PAD: usize = 16;

/// How often each way of deciding was taken.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counts {
    /// Nodes of the terrain's hierarchy that were looked at.
    pub nodes: u64,
    /// Nodes dropped because what they hold is hidden.
    pub hidden_nodes: u64,
    /// Triangles that were set up.
    pub triangles: u64,
    /// Samples whose side of an edge or order in depth needed exact arithmetic.
    pub exact_decisions: u64,
}

impl Counts {
    /// The sum of two counts.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            nodes: self.nodes + other.nodes,
            hidden_nodes: self.hidden_nodes + other.hidden_nodes,
            triangles: self.triangles + other.triangles,
            exact_decisions: self.exact_decisions + other.exact_decisions,
        }
    }
}

/// The state of a tile while triangles are drawn into it.
///
/// A sample's *key* grows towards the viewer: 1 / depth for a central lens, -depth for a parallel one, within
/// [`KEY_ERROR`] of the true value; -inf where nothing has been seen.
#[derive(Debug)]
pub struct Tile<'a> {
    /// Which tile.
    pub view: TileView,
    /// The terrain.
    pub mesh: &'a Mesh,
    /// What its samples see so far.
    pub samples: &'a mut Samples,
    /// What was done.
    pub counts: Counts,
    /// The vectors that kernels are run with; the bits are the same with any.
    pub(super) arch: pulp::Arch,
}

/// The memory of a tile: used again from frame to frame.
#[derive(Debug, Clone, Default)]
pub struct Samples {
    /// Keys, rows from the top, [`Samples::stride`] apart.
    pub keys: Vec<f32>,
    /// Triangles, [`SKY`] where none has been seen; laid out as the keys.
    pub ids: Vec<u32>,
    stride: usize,
    /// The least key of each block.
    farthest: Vec<f32>,
    dirty: Vec<bool>,
    blocks_a_row: usize,
}

impl Samples {
    /// Forgets everything and takes the size of a tile.
    pub(super) fn reset(&mut self, width: usize, height: usize) {
        self.stride = width.div_ceil(PAD) * PAD;
        self.blocks_a_row = width.div_ceil(BLOCK);
        refill(&mut self.keys, self.stride * height, f32::NEG_INFINITY);
        refill(&mut self.ids, self.stride * height, SKY);
        refill(&mut self.farthest, self.blocks_a_row * height.div_ceil(BLOCK), f32::NEG_INFINITY);
        refill(&mut self.dirty, self.blocks_a_row * height.div_ceil(BLOCK), false);
    }

    /// How far rows lie apart in `keys` and `ids`: at least the tile's width.
    #[inline(always)]
    pub fn stride(&self) -> usize {
        self.stride
    }
}

fn refill<T: Clone>(values: &mut Vec<T>, count: usize, value: T) {
    values.clear();
    values.resize(count, value);
}

impl<'a> Tile<'a> {
    /// A tile that has seen nothing, in memory that is used again.
    pub fn new(view: TileView, mesh: &'a Mesh, samples: &'a mut Samples) -> Self {
        samples.reset(view.width, view.height);
        Self { mesh, samples, counts: Counts::default(), view, arch: pulp::Arch::new() }
    }

    /// The key of a depth in metres.
    #[inline(always)]
    pub fn key_of_depth(&self, depth: f64) -> f64 {
        if self.view.is_parallel() { -depth } else { 1.0 / depth }
    }

    /// Notes that samples of columns and rows `from..=to` may have changed.
    #[inline]
    pub fn touch(&mut self, from: (usize, usize), to: (usize, usize)) {
        for y in from.1 / BLOCK..=to.1 / BLOCK {
            let samples = &mut *self.samples;
            let row = y * samples.blocks_a_row;
            samples.dirty[row + from.0 / BLOCK..=row + to.0 / BLOCK].fill(true);
        }
    }

    /// Whether every sample in the rectangle (tile coordinates) has seen something nearer than all of `key`.
    pub fn hides(&mut self, rectangle: [f64; 4], key: f64) -> bool {
        let Some((from, to)) = self.samples_in(rectangle) else {
            return true;
        };
        // Anything farther by more than the errors of both keys is hidden for sure.
        let limit = key + 4.0 * KEY_ERROR * key.abs();
        for y in from.1 / BLOCK..=to.1 / BLOCK {
            for x in from.0 / BLOCK..=to.0 / BLOCK {
                if f64::from(self.farthest_key(x, y)) <= limit {
                    return false;
                }
            }
        }
        true
    }

    /// The columns and rows of the samples in a rectangle of tile coordinates, grown by a hair; `None`: none.
    #[inline]
    pub fn samples_in(&self, [x0, y0, x1, y1]: [f64; 4]) -> Option<((usize, usize), (usize, usize))> {
        const HAIR: f64 = 1e-3;
        let span = |low: f64, high: f64, first: f64, count: usize| {
            let (from, to) = (low - HAIR - first, high + HAIR - first);
            let last = (count - 1) as f64;
            // Casts truncate, faster than `ceil` and `floor` where those are calls; NaN gives an empty span.
            let from = if from > 0.0 { from as usize + usize::from(from > from as usize as f64) } else { 0 };
            if to < 0.0 || to.is_nan() {
                None
            } else {
                Some((from, if to < last { to } else { last } as usize))
            }
            .filter(|(from, to)| from <= to)
        };
        let (c0, c1) = span(x0, x1, self.view.first.0, self.view.width)?;
        let (r0, r1) = span(y0, y1, self.view.first.1, self.view.height)?;
        Some(((c0, r0), (c1, r1)))
    }

    fn farthest_key(&mut self, x: usize, y: usize) -> f32 {
        let Samples { keys, stride, farthest, dirty, blocks_a_row, .. } = &mut *self.samples;
        let block = y * *blocks_a_row + x;
        if std::mem::take(&mut dirty[block]) {
            let (columns, rows) =
                (self.view.width.min((x + 1) * BLOCK), self.view.height.min((y + 1) * BLOCK));
            let mut least = f32::INFINITY;
            for r in y * BLOCK..rows {
                let row = &keys[r * *stride + x * BLOCK..r * *stride + columns];
                least = row.iter().fold(least, |m, &k| if k < m { k } else { m });
            }
            farthest[block] = least;
        }
        farthest[block]
    }

    /// Offers triangle `id`, which covers sample (c, r), with a key within [`KEY_ERROR`]: the nearer one stays.
    #[inline]
    pub fn offer(&mut self, c: usize, r: usize, key: f32, id: u32) {
        let at = r * self.samples.stride + c;
        let (old, old_id) = (self.samples.keys[at], self.samples.ids[at]);
        let difference = f64::from(key) - f64::from(old);
        let tolerance =
            2.0 * KEY_ERROR * f64::from(if key.abs() > old.abs() { key.abs() } else { old.abs() });
        let wins = if old_id == SKY || difference > tolerance {
            true
        } else if difference < -tolerance {
            false
        } else {
            self.is_nearer(c, r, id, old_id)
        };
        if wins {
            self.samples.keys[at] = key;
            self.samples.ids[at] = id;
        }
    }

    /// Exactly: whether `id` is met before `old`; the lower number where both are met in one point.
    #[cold]
    fn is_nearer(&mut self, c: usize, r: usize, id: u32, old: u32) -> bool {
        self.counts.exact_decisions += 1;
        let (Some(new_corners), Some(old_corners)) = (self.mesh.triangle(id), self.mesh.triangle(old)) else {
            return false;
        };
        match predicate::compare_along_ray(&self.view.ray(c, r), &new_corners, &old_corners) {
            Ordering::Less => true,
            Ordering::Equal => id < old,
            Ordering::Greater => false,
        }
    }

    /// Decides exactly whether triangle `id` covers sample (c, r) between near and far plane, and offers it if so.
    #[cold]
    pub fn decide(&mut self, c: usize, r: usize, id: u32) {
        self.counts.exact_decisions += 1;
        let Some(corners) = self.mesh.triangle(id) else {
            return;
        };
        let ray = self.view.ray(c, r);
        if !covers(&self.view, &ray, &corners) {
            return;
        }
        let frame = &self.view.frame;
        let seen = predicate::is_hit_beyond(frame, &ray, &corners, frame.near())
            && (frame.far().is_infinite() || !predicate::is_hit_beyond(frame, &ray, &corners, frame.far()));
        if seen {
            let depth = predicate::hit_parameter(&ray, &corners) * frame.reach();
            self.offer(c, r, self.key_of_depth(depth) as f32, id);
        }
    }
}

/// Whether the ray's line crosses the triangle (never for a triangle seen edge-on).
fn covers(view: &TileView, ray: &crate::space::Ray, [a, b, c]: &[World; 3]) -> bool {
    let side = |from, to| {
        let side = predicate::ray_side(&view.frame, ray, from, to);
        if side == 0.0 { 0.0 } else { side.signum() }
    };
    let first = side(*a, *b);
    first != 0.0 && side(*b, *c) == first && side(*c, *a) == first
}
