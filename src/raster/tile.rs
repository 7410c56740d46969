//! A tile of samples: the nearest triangle and a depth key of each, and how far each block of samples sees.

use super::{KEY_ERROR, TileView};
use crate::predicate;
use crate::space::World;
use crate::terrain::{Mesh, SKY};
use std::cmp::Ordering;

/// Samples a side of a block of the hierarchical depth test.
const BLOCK: usize = 8;

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
    /// Keys, rows from the top, `stride` apart.
    pub keys: Vec<f32>,
    /// Triangles, [`SKY`] where none has been seen.
    pub ids: Vec<u32>,
    /// What was done.
    pub counts: Counts,
    stride: usize,
    /// The least key of each block.
    farthest: Vec<f32>,
    dirty: Vec<bool>,
    blocks_a_row: usize,
}

impl<'a> Tile<'a> {
    /// A tile that has seen nothing.
    pub fn new(view: TileView, mesh: &'a Mesh) -> Self {
        let (blocks_a_row, block_rows) = (view.width.div_ceil(BLOCK), view.height.div_ceil(BLOCK));
        let stride = blocks_a_row * BLOCK;
        let samples = stride * block_rows * BLOCK;
        Self {
            mesh,
            keys: vec![f32::NEG_INFINITY; samples],
            ids: vec![SKY; samples],
            counts: Counts::default(),
            stride,
            farthest: vec![f32::NEG_INFINITY; blocks_a_row * block_rows],
            dirty: vec![false; blocks_a_row * block_rows],
            blocks_a_row,
            view,
        }
    }

    /// Where row `r` starts in `keys` and `ids`.
    #[inline(always)]
    pub fn row_start(&self, r: usize) -> usize {
        r * self.stride
    }

    /// The key of a depth in metres.
    #[inline(always)]
    pub fn key_of_depth(&self, depth: f64) -> f64 {
        if self.view.is_parallel() {
            -depth
        } else {
            1.0 / depth
        }
    }

    /// Notes that samples of columns and rows `from..=to` may have changed.
    #[inline]
    pub fn touch(&mut self, from: (usize, usize), to: (usize, usize)) {
        for y in from.1 / BLOCK..=to.1 / BLOCK {
            self.dirty[y * self.blocks_a_row + from.0 / BLOCK..=y * self.blocks_a_row + to.0 / BLOCK]
                .fill(true);
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
            let from = (low - HAIR - first).ceil();
            let to = (high + HAIR - first).floor();
            let from = if from > 0.0 { from } else { 0.0 };
            let end = (count - 1) as f64;
            let to = if to < end { to } else { end };
            (from <= to).then_some((from as usize, to as usize))
        };
        let (c0, c1) = span(x0, x1, self.view.first.0, self.view.width)?;
        let (r0, r1) = span(y0, y1, self.view.first.1, self.view.height)?;
        Some(((c0, r0), (c1, r1)))
    }

    fn farthest_key(&mut self, x: usize, y: usize) -> f32 {
        let block = y * self.blocks_a_row + x;
        if std::mem::take(&mut self.dirty[block]) {
            let (columns, rows) = (
                self.view.width.min((x + 1) * BLOCK),
                self.view.height.min((y + 1) * BLOCK),
            );
            let mut least = f32::INFINITY;
            for r in y * BLOCK..rows {
                let row = &self.keys[r * self.stride + x * BLOCK..r * self.stride + columns];
                least = row.iter().fold(least, |m, &k| if k < m { k } else { m });
            }
            self.farthest[block] = least;
        }
        self.farthest[block]
    }

    /// Offers triangle `id`, which covers sample (c, r), with a key within [`KEY_ERROR`]: the nearer one stays.
    #[inline]
    pub fn offer(&mut self, c: usize, r: usize, key: f32, id: u32) {
        let at = self.row_start(r) + c;
        let (old, old_id) = (self.keys[at], self.ids[at]);
        let difference = f64::from(key) - f64::from(old);
        let tolerance = 2.0
            * KEY_ERROR
            * f64::from(if key.abs() > old.abs() {
                key.abs()
            } else {
                old.abs()
            });
        let wins = if old_id == SKY || difference > tolerance {
            true
        } else if difference < -tolerance {
            false
        } else {
            self.is_nearer(c, r, id, old_id)
        };
        if wins {
            self.keys[at] = key;
            self.ids[at] = id;
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
