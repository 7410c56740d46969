//! One triangle of any size and place in double precision: homogeneous edge functions, no clipping.
//!
//! Edge functions of homogeneous coordinates (Olano & Greer 1997, "Triangle scan conversion using 2D homogeneous
//! coordinates") hold for corners behind the eye too; the near plane is a test of each sample's depth.

use super::tile::Tile;
use super::{KEY_ERROR, TileView};
use crate::math;
use crate::space::World;
use glam::DVec3;

/// Unit roundoff of doubles.
const U: f64 = f64::EPSILON / 2.0;
/// Samples handled together.
const LANES: usize = 16;

/// Linear functions of a sample (x, y, 1) in tile coordinates that decide a triangle's coverage and depth.
#[derive(Debug, Clone, Copy)]
pub struct Facet {
    /// The triangle's number.
    pub id: u32,
    /// Edge functions, positive inside.
    pub edges: [DVec3; 3],
    /// A bound of the error of each edge function at any sample of the tile.
    pub edge_error: f64,
    /// The depth key.
    pub key: DVec3,
    /// Keys below this are surely in front of the far plane and surely beyond the near one: (least, greatest).
    pub sure_keys: (f64, f64),
    /// Whether keys are within [`KEY_ERROR`]; if not, each covered sample is decided exactly.
    pub is_key_sure: bool,
}

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
        let Corner {
            a,
            u,
            v,
            depths,
            size: [c_size, u_size, v_size],
        } = corner;
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
        let size_error = if view.is_parallel() {
            normal_error
        } else {
            det_error
        };
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
            (
                normal / det,
                det_error <= KEY_ERROR / 8.0 * det.abs() && error * farthest <= KEY_ERROR / 8.0,
            )
        };
        Some(Self {
            id,
            edges: [ab * sign, bc * sign, ca * sign],
            edge_error: 3.0 * edge_error,
            key,
            sure_keys: sure_keys(view, nearest, farthest),
            is_key_sure,
        })
    }

    /// Draws the samples of columns and rows `from..=to`.
    pub fn fill(&self, tile: &mut Tile, from: (usize, usize), to: (usize, usize)) {
        let arch = pulp::Arch::new();
        let mut states = [0u8; LANES];
        for r in from.1..=to.1 {
            let mut c = from.0;
            while c <= to.0 {
                let count = (to.0 + 1 - c).min(LANES);
                let open = arch.dispatch(
                    #[inline(always)]
                    || self.fill_lanes(tile, c, r, count, &mut states),
                );
                if open {
                    self.settle(tile, c, r, &states[..count]);
                }
                c += count;
            }
        }
    }

    /// Draws up to [`LANES`] samples of a row as far as the filter decides; tells whether any is left open in `states`.
    #[inline(always)]
    fn fill_lanes(
        &self,
        tile: &mut Tile,
        c: usize,
        r: usize,
        count: usize,
        states: &mut [u8; LANES],
    ) -> bool {
        let start = tile.row_start(r) + c;
        let (x0, y) = (tile.view.first.0 + c as f64, tile.view.first.1 + r as f64);
        let at_row = |f: DVec3| f.y * y + f.z;
        let [e0, e1, e2] = self.edges.map(at_row);
        let [d0, d1, d2] = self.edges.map(|f| f.x);
        let (k0, dk) = (at_row(self.key), self.key.x);
        let error = self.edge_error;
        let mut open = 0u8;
        let keys = &mut tile.keys[start..start + count];
        let ids = &mut tile.ids[start..start + count];
        for lane in 0..count {
            let x = x0 + lane as f64;
            let (a, b, d) = (e0 + d0 * x, e1 + d1 * x, e2 + d2 * x);
            let least = math::min(math::min(a, b), d);
            let key = (k0 + dk * x) as f32;
            let old = keys[lane];
            let tolerance = (2.0 * KEY_ERROR as f32) * math::max_f32(key.abs(), old.abs());
            let is_empty = ids[lane] == crate::terrain::SKY;
            let inside = least > error;
            let outside = least < -error;
            let is_sure =
                self.is_key_sure & (f64::from(key) > self.sure_keys.0) & (f64::from(key) < self.sure_keys.1);
            let nearer = is_empty | (key - old > tolerance);
            let farther = !is_empty & (old - key > tolerance);
            let wins = inside & is_sure & nearer;
            let is_open = !outside & !wins & !(inside & is_sure & farther);
            keys[lane] = if wins { key } else { old };
            ids[lane] = if wins { self.id } else { ids[lane] };
            states[lane] = u8::from(is_open) | (u8::from(inside & is_sure) << 1);
            open |= u8::from(is_open);
        }
        open != 0
    }

    /// Decides the samples that the filter left open.
    #[cold]
    fn settle(&self, tile: &mut Tile, c: usize, r: usize, states: &[u8]) {
        for (lane, state) in states.iter().enumerate() {
            match state {
                1 => tile.decide(c + lane, r, self.id),
                3 => {
                    let (x, y) = (
                        tile.view.first.0 + (c + lane) as f64,
                        tile.view.first.1 + r as f64,
                    );
                    let key = (self.key.y * y + self.key.z + self.key.x * x) as f32;
                    tile.offer(c + lane, r, key, self.id);
                }
                _ => {}
            }
        }
    }
}

/// The keys that surely lie between the near and the far plane; all of them when the triangle's corners do.
fn sure_keys(view: &TileView, nearest: f64, farthest: f64) -> (f64, f64) {
    let key = |depth: f64| if view.is_parallel() { -depth } else { 1.0 / depth };
    let (near, far) = (view.frame.near(), view.frame.far());
    let slack = 4.0 * KEY_ERROR;
    let most = if nearest > near * (1.0 + slack) {
        f64::INFINITY
    } else {
        key(near) - slack * key(near).abs()
    };
    let least = if farthest < far * (1.0 - slack) {
        f64::NEG_INFINITY
    } else {
        key(far) + slack * key(far).abs()
    };
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
