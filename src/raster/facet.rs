//! One triangle of any size and place in double precision: homogeneous edge functions, no clipping.
//!
//! Edge functions of homogeneous coordinates (Olano & Greer 1997, "Triangle scan conversion using 2D homogeneous
//! coordinates") hold for corners behind the eye too; the near plane is a test of each sample's depth.

use super::tile::{PAD, Tile};
use super::{KEY_ERROR, TileView};
use crate::math::{self, max_f32, min_f32};
use crate::space::World;
use crate::terrain::SKY;
use glam::DVec3;

/// Unit roundoff of doubles.
const U: f64 = f64::EPSILON / 2.0;
/// Unit roundoff of single precision.
const SINGLE: f64 = f32::EPSILON as f64 / 2.0;

/// Linear functions of a sample (x, y) in tile coordinates that decide a triangle's coverage and depth.
///
/// Edge functions are scaled to the distance from the edge in samples and evaluated in single precision; what lies nearer to
/// an edge than `doubt` is decided exactly.
#[derive(Debug, Clone, Copy)]
pub struct Facet {
    id: u32,
    /// Edge functions, positive inside: f.x * x + f.y * y + f.z.
    edges: [DVec3; 3],
    doubt: f32,
    key: DVec3,
    /// Keys between these surely lie between the near and the far plane.
    sure_keys: (f32, f32),
    /// Whether keys are within [`KEY_ERROR`]; if not, each covered sample is decided exactly.
    is_key_sure: bool,
}

/// What single-precision evaluation of a scaled edge function may be off, in samples: in a tile of at most 512
/// samples a side its terms are below 1024 and are rounded three times (3 * 1024 * 2^-24 < 2e-4).
const EVALUATION_DOUBT: f64 = 2e-4;

/// A triangle's corner and two sides in homogeneous tile coordinates, with the sizes that bound their errors.
struct Corner {
    a: DVec3,
    u: DVec3,
    v: DVec3,
    depths: [f64; 3],
    /// Bounds of |A - eye|, |B - A|, |C - A| (sums of absolute coordinates).
    size: [f64; 3],
}

impl Facet {
    /// Draws triangle `id` into the tile.
    pub fn draw(tile: &mut Tile, id: u32, corners: &[World; 3]) {
        let view = &tile.view;
        let corner = Corner::new(view, corners);
        if corner.is_outside(view) {
            return;
        }
        let Some((from, to)) = tile.samples_in(corner.rectangle(view)) else {
            return;
        };
        tile.counts.triangles += 1;
        match Self::new(&tile.view, id, &corner) {
            Some(facet) => facet.fill(tile, from, to),
            // Edge-on as far as doubles tell: thin, so that few samples are near.
            None => {
                for r in from.1..=to.1 {
                    for c in from.0..=to.0 {
                        tile.decide(c, r, id);
                    }
                }
            }
        }
        tile.touch(from, to);
    }

    /// The functions of a triangle; `None` when it is edge-on as far as doubles tell.
    fn new(view: &TileView, id: u32, corner: &Corner) -> Option<Self> {
        let Corner { a, u, v, depths, size: [c_size, u_size, v_size] } = corner;
        let (ab, ca) = (a.cross(*u), v.cross(*a));
        let normal = u.cross(*v);
        let bc = normal - ab - ca;
        // Every coordinate is at most gain times its displacement and off by 16 roundings of that; products of two,
        // evaluated within `gain` samples of the tile's middle, are off by at most 128 of theirs.
        let gain = view.gain();
        let longest = math::max(*u_size, *v_size);
        let edge_error = 128.0 * U * gain * 3.0 * gain * c_size * longest;
        let normal_error = 128.0 * U * gain * 3.0 * gain * u_size * v_size;
        let det = a.dot(normal);
        let det_error = 400.0 * U * gain * gain * c_size * u_size * v_size;
        let size = if view.is_parallel() { normal.z } else { det };
        let size_error = if view.is_parallel() { normal_error } else { det_error };
        if size.abs() <= 2.0 * size_error {
            return None;
        }
        let sign = size.signum();
        let farthest = math::max(math::max(depths[0], depths[1]), depths[2]);
        let nearest = math::min(math::min(depths[0], depths[1]), depths[2]);
        let (key, is_key_sure) = if view.is_parallel() {
            let (du, dv) = (depths[1] - depths[0], depths[2] - depths[0]);
            let key = -(DVec3::Z * depths[0] + (ca * du + ab * dv) / normal.z);
            let error = 4.0 * edge_error * (du.abs() + dv.abs()) / normal.z.abs() + 32.0 * U * c_size;
            (key, error <= KEY_ERROR / 4.0 * nearest)
        } else {
            let error = normal_error / det.abs();
            (normal / det, det_error <= KEY_ERROR / 8.0 * det.abs() && error * farthest <= KEY_ERROR / 8.0)
        };
        let least_key = if view.is_parallel() { nearest } else { 1.0 / farthest };
        let shape =
            TriangleShape { edges: [ab * sign, bc * sign, ca * sign], edge_error: 3.0 * edge_error, key };
        Some(Self::of_shape(id, &shape, (is_key_sure, least_key), sure_keys(view, nearest, farthest)))
    }

    /// Scales edge functions to distances and says how far they can be trusted; `least_key` is the least magnitude of
    /// the key on the triangle.
    fn of_shape(
        id: u32,
        shape: &TriangleShape,
        (is_key_sure, least_key): (bool, f64),
        (least, most): (f64, f64),
    ) -> Self {
        let mut doubt = EVALUATION_DOUBT;
        let edges = shape.edges.map(|e| {
            let slope = e.x.abs() + e.y.abs();
            // An edge in the eye's plane, or of no length, has no slope on the screen: its samples are decided exactly.
            let is_clear = slope > 0.0;
            doubt = if is_clear {
                math::max(shape.edge_error / slope + EVALUATION_DOUBT, doubt)
            } else {
                f64::INFINITY
            };
            if is_clear { e / slope } else { DVec3::ZERO }
        });
        // A key is evaluated from the first of 16 samples on: two roundings of what it changes by over them.
        let is_key_sure = is_key_sure && shape.key.x.abs() * 64.0 * SINGLE <= KEY_ERROR / 8.0 * least_key;
        let sure_keys = (least as f32, most as f32);
        Self { id, edges, doubt: doubt as f32, key: shape.key, sure_keys, is_key_sure }
    }

    /// Draws the samples of columns and rows `from..=to`.
    fn fill(&self, tile: &mut Tile, from: (usize, usize), to: (usize, usize)) {
        tile.arch.dispatch(Fill { facet: self, tile, from, to });
    }

    #[inline(always)]
    fn fill_rows(&self, tile: &mut Tile, from: (usize, usize), to: (usize, usize)) {
        let mut open = [0u32; PAD];
        let last = tile.samples.stride() - PAD;
        for r in from.1..=to.1 {
            let mut first = from.0;
            while first <= to.0 {
                // A whole vector must fit the padded row.
                let c = if first < last { first } else { last };
                let lanes = (first - c, to.0 - c);
                if self.fill_lanes(tile, (c, r), lanes, &mut open) {
                    self.settle(tile, c, r, &open);
                }
                first = c + PAD;
            }
        }
    }

    /// Draws the samples `lanes.0..=lanes.1` of the vector at (c, r) as far as the filter decides; tells whether any is left
    /// open, and in `open` which: 1 for coverage, 2 for depth alone.
    #[inline(always)]
    fn fill_lanes(
        &self,
        tile: &mut Tile,
        (c, r): (usize, usize),
        lanes: (usize, usize),
        open: &mut [u32; PAD],
    ) -> bool {
        let start = r * tile.samples.stride() + c;
        let (x, y) = (tile.view.first.0 + c as f64, tile.view.first.1 + r as f64);
        let [f0, f1, f2] = &self.edges;
        let (e0, d0) = ((f0.x * x + f0.y * y + f0.z) as f32, f0.x as f32);
        let (e1, d1) = ((f1.x * x + f1.y * y + f1.z) as f32, f1.x as f32);
        let (e2, d2) = ((f2.x * x + f2.y * y + f2.z) as f32, f2.x as f32);
        let (k0, dk) = ((self.key.x * x + self.key.y * y + self.key.z) as f32, self.key.x as f32);
        let (from, to) = (lanes.0 as f32, lanes.1 as f32);
        let (Some(keys), Some(ids)) = (
            tile.samples.keys[start..].first_chunk_mut::<PAD>(),
            tile.samples.ids[start..].first_chunk_mut::<PAD>(),
        ) else {
            return false;
        };
        let mut any = 0;
        for lane in 0..PAD {
            let x = lane as f32;
            let least = min_f32(min_f32(e0 + d0 * x, e1 + d1 * x), e2 + d2 * x);
            let key = k0 + dk * x;
            let (old, old_id) = (keys[lane], ids[lane]);
            let tolerance = (2.0 * KEY_ERROR as f32) * max_f32(key.abs(), old.abs());
            let is_empty = old_id == SKY;
            let inside = least > self.doubt;
            let possible = (least >= -self.doubt) & (x >= from) & (x <= to);
            let is_sure = inside & self.is_key_sure & (key > self.sure_keys.0) & (key < self.sure_keys.1);
            let wins = possible & is_sure & (is_empty | (key - old > tolerance));
            let loses = is_sure & !is_empty & (old - key > tolerance);
            let is_open = possible & !wins & !loses;
            keys[lane] = if wins { key } else { old };
            ids[lane] = if wins { self.id } else { old_id };
            open[lane] = if is_open { 1 + u32::from(is_sure) } else { 0 };
            any |= open[lane];
        }
        any != 0
    }

    /// Decides the samples that the filter left open.
    #[cold]
    fn settle(&self, tile: &mut Tile, c: usize, r: usize, open: &[u32; PAD]) {
        for (lane, how) in open.iter().enumerate() {
            match how {
                1 => tile.decide(c + lane, r, self.id),
                2 => {
                    let (x, y) = (tile.view.first.0 + (c + lane) as f64, tile.view.first.1 + r as f64);
                    let key = (self.key.y * y + self.key.z + self.key.x * x) as f32;
                    tile.offer(c + lane, r, key, self.id);
                }
                _ => {}
            }
        }
    }
}

/// [`Facet::fill_rows`] compiled for the widest vectors of the machine at hand.
struct Fill<'f, 'a, 't> {
    facet: &'f Facet,
    tile: &'t mut Tile<'a>,
    from: (usize, usize),
    to: (usize, usize),
}

impl pulp::WithSimd for Fill<'_, '_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.facet.fill_rows(self.tile, self.from, self.to);
    }
}

/// A triangle's edge functions (positive inside, of any scale), a bound of their error in the tile, and its key.
struct TriangleShape {
    edges: [DVec3; 3],
    edge_error: f64,
    key: DVec3,
}

/// The keys that surely lie between the near and the far plane; all of them when the triangle's corners do.
fn sure_keys(view: &TileView, nearest: f64, farthest: f64) -> (f64, f64) {
    let key = |depth: f64| if view.is_parallel() { -depth } else { 1.0 / depth };
    let (near, far) = (view.frame.near(), view.frame.far());
    let slack = 4.0 * KEY_ERROR;
    let most =
        if nearest > near * (1.0 + slack) { f64::INFINITY } else { key(near) - slack * key(near).abs() };
    let least =
        if farthest < far * (1.0 - slack) { f64::NEG_INFINITY } else { key(far) + slack * key(far).abs() };
    (least, most)
}

impl Corner {
    fn new(view: &TileView, [a, b, c]: &[World; 3]) -> Self {
        let eye = view.frame.eye();
        let (start, u, v) = (*a - eye, *b - *a, *c - *a);
        let depth = view.depth(start);
        Self {
            a: view.map_point(*a),
            u: view.map(u),
            v: view.map(v),
            depths: [depth, depth + view.depth(u), depth + view.depth(v)],
            size: [
                start.abs().element_sum() + eye.to_vec().abs().max_element(),
                u.abs().element_sum(),
                v.abs().element_sum(),
            ],
        }
    }

    /// Whether all corners lie beside the tile on one side, in front of the near plane or beyond the far one.
    fn is_outside(&self, view: &TileView) -> bool {
        let [a, b, c] = [self.a, self.a + self.u, self.a + self.v];
        let slack = 64.0 * U * view.gain() * self.size.iter().sum::<f64>();
        let all = |f: &dyn Fn(DVec3) -> f64| f(a) < -slack && f(b) < -slack && f(c) < -slack;
        let (first, last) = (view.first, view.last());
        let depth_slack = 64.0 * U * self.size.iter().sum::<f64>();
        all(&|h| h.x - first.0 * h.z)
            || all(&|h| last.0 * h.z - h.x)
            || all(&|h| h.y - first.1 * h.z)
            || all(&|h| last.1 * h.z - h.y)
            || self.depths.iter().all(|d| *d < view.frame.near() - depth_slack)
            || self.depths.iter().all(|d| *d > view.frame.far() + depth_slack)
    }

    /// The rectangle of the triangle's picture in tile coordinates; all of the tile when a corner is near the eye's plane.
    fn rectangle(&self, view: &TileView) -> [f64; 4] {
        let tile = [view.first.0, view.first.1, view.last().0, view.last().1];
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        // The rectangle's hair (10^-3 samples) must cover the error of a projected corner.
        let least_w = 1e6 * U * view.gain() * self.size.iter().sum::<f64>();
        for h in [self.a, self.a + self.u, self.a + self.v] {
            if h.z <= least_w {
                return tile;
            }
            let at = [h.x / h.z, h.y / h.z];
            for k in 0..2 {
                low[k] = math::min(at[k], low[k]);
                high[k] = math::max(at[k], high[k]);
            }
        }
        [low[0], low[1], high[0], high[1]]
    }
}
