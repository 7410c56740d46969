//! Many small triangles at once, in single precision: the path that nearly all triangles of a large terrain take.
//!
//! Corners are projected in double precision and rounded to single precision in tile coordinates. Sixteen triangles at a
//! time are then sorted into: no sample near (most), exactly one sample near (decided in place), several (filled row by row, by functions
//! that are made for sixteen at a time too). The error of a rounded corner bounds every doubt.

use super::facet::Facet;
use super::pictures::{Pictures, TOGETHER};
use super::tile::{PAD, Tile};
use super::{KEY_ERROR, TileView};
use crate::math::{max_f32, min_f32};
use crate::scene::Diagonal;
use crate::terrain::{Grid, Node, SKY};
use glam::DVec3;

/// Triangles handled together.
pub const LANES: usize = 16;

/// Unit roundoff of single precision.
const U32: f64 = f32::EPSILON as f64 / 2.0;

/// What is known of a triangle after sorting.
const NOTHING: u32 = 0;
const COVERS_ONE: u32 = 1;
const DOUBTFUL_ONE: u32 = 2;
const SEVERAL: u32 = 4;

/// A value for each of sixteen triangles.
type Lanes = [f32; LANES];

/// Up to sixteen projected points: tile coordinates and depth keys. NaN where there is no point, as in the last place.
#[derive(Debug, Clone, Copy)]
struct Points {
    x: [f32; LANES + 1],
    y: [f32; LANES + 1],
    key: [f32; LANES + 1],
}

/// Sixteen of some points in their order.
#[derive(Clone, Copy)]
struct Sixteen<'a> {
    x: &'a [f32; LANES],
    y: &'a [f32; LANES],
    key: &'a [f32; LANES],
}

impl Points {
    /// No points.
    const NONE: Self =
        Self { x: [f32::NAN; LANES + 1], y: [f32::NAN; LANES + 1], key: [f32::NAN; LANES + 1] };

    /// The points of a line of posts.
    #[inline(always)]
    fn project(&mut self, line: &PostLine, heights: &[f64; LANES]) {
        for (k, h) in heights.iter().enumerate() {
            let i = k as f64;
            let p = line.at(i, *h);
            let depth = line.depth.x + i * line.depth.y + h * line.depth.z;
            let inverse = 1.0 / p.z;
            self.x[k] = (p.x * inverse) as f32;
            self.y[k] = (p.y * inverse) as f32;
            self.key[k] = (if line.is_parallel { -depth } else { inverse }) as f32;
        }
    }

    /// The sixteen points from place `SHIFT` (0 or 1) on.
    #[inline(always)]
    fn from<const SHIFT: usize>(&self) -> Sixteen<'_> {
        Sixteen {
            x: shifted::<SHIFT>(&self.x),
            y: shifted::<SHIFT>(&self.y),
            key: shifted::<SHIFT>(&self.key),
        }
    }

    /// One point.
    #[inline(always)]
    fn get(&self, lane: usize) -> (f32, f32, f32) {
        (self.x[lane], self.y[lane], self.key[lane])
    }

    /// Sets one point.
    #[inline(always)]
    fn set(&mut self, lane: usize, (x, y, key): (f32, f32, f32)) {
        (self.x[lane], self.y[lane], self.key[lane]) = (x, y, key);
    }
}

#[inline(always)]
fn shifted<const SHIFT: usize>(values: &[f32; LANES + 1]) -> &[f32; LANES] {
    const NONE: [f32; LANES] = [f32::NAN; LANES];
    values[SHIFT..].first_chunk().unwrap_or(&NONE)
}

/// A line of posts in homogeneous tile coordinates.
pub(super) struct PostLine {
    origin: DVec3,
    step: DVec3,
    up: DVec3,
    /// View depth of the first post at height 0, per post, per metre of height.
    depth: DVec3,
    is_parallel: bool,
}

impl PostLine {
    /// Homogeneous tile coordinates of post `i` of the line, `height` metres high.
    #[inline(always)]
    pub(super) fn at(&self, i: f64, height: f64) -> DVec3 {
        DVec3::new(
            self.origin.x + i * self.step.x + height * self.up.x,
            self.origin.y + i * self.step.y + height * self.up.y,
            self.origin.z + i * self.step.z + height * self.up.z,
        )
    }
}

/// The outcome of sorting sixteen triangles.
struct Sorted {
    state: [u32; LANES],
    /// The first column and row of the tile with a sample near, and how many more there are.
    column: Lanes,
    row: Lanes,
    columns_on: Lanes,
    rows_on: Lanes,
    key: Lanes,
}

impl Sorted {
    const NOTHING: Self = Self {
        state: [NOTHING; LANES],
        column: [0.0; LANES],
        row: [0.0; LANES],
        columns_on: [0.0; LANES],
        rows_on: [0.0; LANES],
        key: [0.0; LANES],
    };

    /// The triangles in a state, a bit for each.
    #[inline(always)]
    fn of_state(&self, state: u32) -> u32 {
        let bits = self.state.iter().enumerate().map(|(lane, s)| u32::from(*s == state) << lane);
        bits.fold(0, |all, bit| all | bit)
    }
}

/// The bits of the first of sixteen lanes: the others hold no triangle, whatever was computed of them.
#[inline(always)]
fn first_lanes(count: usize) -> u32 {
    (1 << count.min(LANES)) - 1
}

/// The places of the bits that are set, from the lowest on.
#[inline(always)]
fn lanes_of(mut bits: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = bits.trailing_zeros() as usize;
        bits &= bits.wrapping_sub(1);
        (lane < LANES).then_some(lane)
    })
}

/// A linear function of the samples for each of sixteen triangles: its value at the first sample near, and by how much it grows from column
/// to column and from row to row.
#[derive(Clone, Copy)]
struct Planes {
    at_first: Lanes,
    by_column: Lanes,
    by_row: Lanes,
}

impl Planes {
    const NONE: Self = Self { at_first: [0.0; LANES], by_column: [0.0; LANES], by_row: [0.0; LANES] };

    /// That of one triangle: at the first sample of row `row`, and by column.
    #[inline(always)]
    fn of(&self, lane: usize, row: f32) -> (f32, f32) {
        (self.at_first[lane] + row * self.by_row[lane], self.by_column[lane])
    }
}

/// Which samples of a row near a triangle are filled.
struct Near {
    /// The tile's column of the first that is near.
    first: usize,
    /// The first and the last that are filled, counted from that.
    columns: (usize, usize),
    /// Which of the rows near the triangle it is.
    row: usize,
}

/// What sixteen triangles are filled by.
struct Shapes {
    /// Edge functions, positive inside.
    edges: [Planes; 3],
    /// What they may be off.
    doubt: Lanes,
    key: Planes,
    /// 1 where keys are within [`KEY_ERROR`] in the triangle; if not, it is drawn in double precision.
    is_key_sure: [u32; LANES],
}

/// A patch of terrain whose pictures of points lie near the tile and surely beyond the near plane.
#[derive(Debug, Clone, Copy)]
pub struct Patch {
    /// A bound of the error of a point's tile coordinates after rounding to single precision.
    point_error: f32,
}

/// How far from a tile's middle a patch may reach, in samples.
const GUARD: f64 = 256.0;
/// What projecting in double precision may add to a point's error, in samples.
const PROJECTION_ERROR: f64 = 1e-7;

impl Patch {
    /// Whether a box qualifies: all of it beyond the near plane and before the far one, its picture within `GUARD`
    /// samples of the tile's middle, and doubles precise enough at its size.
    #[inline]
    pub fn new(view: &TileView, depth: (f64, f64), size: f64, rectangle: &[f64; 4]) -> Option<Self> {
        let w = if view.is_parallel() { 1.0 } else { depth.0 };
        let projection_error = 128.0 * f64::EPSILON * view.gain() * size / w;
        let reach = rectangle.iter().fold(1.0, |m, v| if v.abs() > m { v.abs() } else { m });
        let fits = depth.0 > view.frame.near() * (1.0 + 4.0 * KEY_ERROR)
            && depth.1 < view.frame.far() * (1.0 - 4.0 * KEY_ERROR)
            && reach < GUARD
            && projection_error < PROJECTION_ERROR;
        // Half a unit in the last place of the largest coordinate, doubled for the box's own rounding.
        fits.then_some(Self { point_error: (2.0 * U32 * reach + PROJECTION_ERROR) as f32 })
    }

    /// Draws the cells of a grid's leaf, row by row.
    pub fn draw_grid(&self, tile: &mut Tile, grid: &Grid, node: Node) {
        tile.arch.dispatch(DrawGrid { patch: self, tile, grid, node });
    }

    /// Draws numbered triangles of the tile's mesh, sixteen at a time.
    pub fn draw_triangles(&self, tile: &mut Tile, ids: std::ops::Range<u32>) {
        let arch = tile.arch;
        let Some((vertices, triangles)) = tile.mesh.numbered() else { return };
        let mut pictures = Pictures::NONE;
        for start in ids.clone().step_by(LANES) {
            let first = (start - ids.start) as usize % TOGETHER;
            if first == 0 {
                let end = ids.end.min(start + TOGETHER as u32);
                pictures.take(&tile.view, arch, vertices, &triangles[start as usize..end as usize]);
            }
            let mut corners = [Points::NONE; 3];
            pictures.each((first, LANES), |lane, corner, picture| corners[corner].set(lane, picture));
            let ids = start..ids.end.min(start + LANES as u32);
            arch.dispatch(DrawSixteen { patch: self, tile, corners: &corners, ids });
        }
    }

    /// Draws the first `count` of sixteen triangles, whose numbers are `step` apart.
    #[inline(always)]
    fn draw_sixteen(
        &self,
        tile: &mut Tile,
        corners: &[Sixteen; 3],
        (first, step, count): (u32, u32, usize),
        sorted: &mut Sorted,
    ) {
        if !self.sort(&tile.view, corners, sorted) {
            return;
        }
        let [one, doubtful, several] =
            [COVERS_ONE, DOUBTFUL_ONE, SEVERAL].map(|state| sorted.of_state(state) & first_lanes(count));
        tile.counts.triangles += u64::from((one | doubtful | several).count_ones());
        let id = |lane: usize| first + step * lane as u32;
        let sample = |lane: usize| (sorted.column[lane] as usize, sorted.row[lane] as usize);
        for lane in lanes_of(one) {
            let (c, r) = sample(lane);
            tile.offer(c, r, sorted.key[lane], id(lane));
        }
        for lane in lanes_of(doubtful) {
            let (c, r) = sample(lane);
            tile.decide(c, r, id(lane));
        }
        if several != 0 {
            let shapes = self.shapes(&tile.view, corners, sorted);
            for lane in lanes_of(several) {
                if shapes.is_key_sure[lane] != 0 {
                    shapes.fill(tile, sorted, lane, id(lane));
                } else if let Some(corners) = tile.mesh.triangle(id(lane)) {
                    Facet::draw(tile, id(lane), &corners);
                }
            }
        }
    }

    /// Sorts sixteen triangles by the samples near them, and decides those with one sample; `false`: none has any.
    #[inline(always)]
    fn sort(&self, view: &TileView, [a, b, c]: &[Sixteen; 3], out: &mut Sorted) -> bool {
        let (first, last) = (view.first, view.last());
        let (first_x, first_y) = (first.0 as f32, first.1 as f32);
        let (last_x, last_y) = (last.0 as f32, last.1 as f32);
        let hair = 2.0 * self.point_error;
        let mut any = NOTHING;
        for k in 0..LANES {
            let (ax, ay, bx, by, cx, cy) = (a.x[k], a.y[k], b.x[k], b.y[k], c.x[k], c.y[k]);
            let (low_x, high_x) = (min_f32(min_f32(ax, bx), cx), max_f32(max_f32(ax, bx), cx));
            let (low_y, high_y) = (min_f32(min_f32(ay, by), cy), max_f32(max_f32(ay, by), cy));
            // The samples of the tile in the box.
            let (x0, x1) = ((low_x - hair).ceil(), (high_x + hair).floor());
            let (y0, y1) = ((low_y - hair).ceil(), (high_y + hair).floor());
            let (x0, x1) = (max_f32(x0, first_x), min_f32(x1, last_x));
            let (y0, y1) = (max_f32(y0, first_y), min_f32(y1, last_y));
            let sum = (ax + bx + cx) + (ay + by + cy);
            let exists = sum.is_finite();
            let near = exists & (x0 <= x1) & (y0 <= y1);
            let one = (x0 == x1) & (y0 == y1);
            // Edge functions at the first sample, on the screen (y down); of one sign inside.
            let ab = (bx - ax) * (y0 - ay) - (by - ay) * (x0 - ax);
            let bc = (cx - bx) * (y0 - by) - (cy - by) * (x0 - bx);
            let ca = (ax - cx) * (y0 - cy) - (ay - cy) * (x0 - cx);
            let doubt = edge_doubt(max_f32(high_x - low_x, high_y - low_y), self.point_error);
            let (least, most) = (min_f32(min_f32(ab, bc), ca), max_f32(max_f32(ab, bc), ca));
            let outside = (least < -doubt) & (most > doubt);
            let inside = (least > doubt) | (most < -doubt);
            let (ka, kb, kc) = (a.key[k], b.key[k], c.key[k]);
            let area = ab + bc + ca;
            let key = ka + (ca * (kb - ka) + ab * (kc - ka)) / area;
            let spread = max_f32(max_f32(ka, kb), kc) - min_f32(min_f32(ka, kb), kc);
            let is_key_sure = 8.0 * doubt * spread <= (KEY_ERROR as f32 / 4.0) * key.abs() * area.abs();
            let state_of_one = if outside {
                NOTHING
            } else if inside & is_key_sure {
                COVERS_ONE
            } else {
                DOUBTFUL_ONE
            };
            out.state[k] = if !near {
                NOTHING
            } else if one {
                state_of_one
            } else {
                SEVERAL
            };
            any |= out.state[k];
            out.column[k] = x0 - first_x;
            out.row[k] = y0 - first_y;
            out.columns_on[k] = x1 - x0;
            out.rows_on[k] = y1 - y0;
            out.key[k] = key;
        }
        any != NOTHING
    }

    /// What the triangles that have several samples near are filled by.
    #[inline(always)]
    fn shapes(&self, view: &TileView, [a, b, c]: &[Sixteen; 3], sorted: &Sorted) -> Shapes {
        let (first_x, first_y) = (view.first.0 as f32, view.first.1 as f32);
        let mut shapes = Shapes {
            edges: [Planes::NONE; 3],
            doubt: [0.0; LANES],
            key: Planes::NONE,
            is_key_sure: [0; LANES],
        };
        for k in 0..LANES {
            let (ax, ay, bx, by, cx, cy) = (a.x[k], a.y[k], b.x[k], b.y[k], c.x[k], c.y[k]);
            let (x, y) = (sorted.column[k] + first_x, sorted.row[k] + first_y);
            let width = max_f32(max_f32(ax, bx), cx) - min_f32(min_f32(ax, bx), cx);
            let height = max_f32(max_f32(ay, by), cy) - min_f32(min_f32(ay, by), cy);
            let doubt = fill_doubt(max_f32(width, height), self.point_error);
            let ab = (bx - ax) * (y - ay) - (by - ay) * (x - ax);
            let bc = (cx - bx) * (y - by) - (cy - by) * (x - bx);
            let ca = (ax - cx) * (y - cy) - (ay - cy) * (x - cx);
            let area = ab + bc + ca;
            // Where the area's sign is in doubt, so is every sample near.
            let sign = if area < 0.0 { -1.0 } else { 1.0 };
            let mut set = |edge: usize, at_first: f32, by_column: f32, by_row: f32| {
                shapes.edges[edge].at_first[k] = sign * at_first;
                shapes.edges[edge].by_column[k] = sign * by_column;
                shapes.edges[edge].by_row[k] = sign * by_row;
            };
            set(0, ab, ay - by, bx - ax);
            set(1, bc, by - cy, cx - bx);
            set(2, ca, cy - ay, ax - cx);
            let (ka, kb, kc) = (a.key[k], b.key[k], c.key[k]);
            let (u, v) = ((kb - ka) / area, (kc - ka) / area);
            let key = ka + (ca * u + ab * v);
            let by_column = (cy - ay) * u + (ay - by) * v;
            let by_row = (ax - cx) * u + (bx - ax) * v;
            let spread = max_f32(max_f32(ka, kb), kc) - min_f32(min_f32(ka, kb), kc);
            let least = min_f32(min_f32(ka.abs(), kb.abs()), kc.abs());
            // Two edge functions and, three times, their sum are in doubt: that may make half of a key's error. The other half is a dozen
            // roundings of the terms that make a key.
            let terms = key.abs() + sorted.columns_on[k] * by_column.abs() + sorted.rows_on[k] * by_row.abs();
            let is_sure = (6.0 * doubt * spread <= (KEY_ERROR as f32 / 2.0) * least * area.abs())
                & (terms <= 4.0 * least);
            shapes.key.at_first[k] = key;
            shapes.key.by_column[k] = by_column;
            shapes.key.by_row[k] = by_row;
            shapes.doubt[k] = doubt;
            shapes.is_key_sure[k] = u32::from(is_sure);
        }
        shapes
    }
}

impl Shapes {
    /// Fills the samples near one of the triangles.
    #[inline(always)]
    fn fill(&self, tile: &mut Tile, sorted: &Sorted, lane: usize, id: u32) {
        let (column, row) = (sorted.column[lane] as usize, sorted.row[lane] as usize);
        let (columns_on, rows_on) = (sorted.columns_on[lane] as usize, sorted.rows_on[lane] as usize);
        let last = tile.samples.stride() - PAD;
        let mut open = [0; PAD];
        for r in 0..=rows_on {
            let mut from = column;
            while from <= column + columns_on {
                // A whole vector must fit the padded row.
                let c = if from < last { from } else { last };
                let near = Near { first: column, columns: (from - column, columns_on), row: r };
                if self.fill_row(tile, (lane, id), (c, row + r), &near, &mut open) {
                    self.settle(tile, (lane, id), (c, row + r), &near, &open);
                }
                from = c + PAD;
            }
        }
    }

    /// Fills the vector at a place of the tile as far as that can be told; tells whether any sample is left open, and in `open` which: 1 for
    /// coverage, 2 for depth alone.
    #[inline(always)]
    fn fill_row(
        &self,
        tile: &mut Tile,
        (lane, id): (usize, u32),
        (c, r): (usize, usize),
        near: &Near,
        open: &mut [u32; PAD],
    ) -> bool {
        let row = near.row as f32;
        let [(e0, d0), (e1, d1), (e2, d2)] = self.edges.each_ref().map(|edge| edge.of(lane, row));
        let (k0, dk) = self.key.of(lane, row);
        let doubt = self.doubt[lane];
        let start = c as f32 - near.first as f32;
        let (from, to) = (near.columns.0 as f32, near.columns.1 as f32);
        let place = r * tile.samples.stride() + c;
        let (Some(keys), Some(ids)) = (
            tile.samples.keys[place..].first_chunk_mut::<PAD>(),
            tile.samples.ids[place..].first_chunk_mut::<PAD>(),
        ) else {
            return false;
        };
        let mut any = 0;
        for k in 0..PAD {
            let x = start + k as f32;
            let least = min_f32(min_f32(e0 + d0 * x, e1 + d1 * x), e2 + d2 * x);
            let key = k0 + dk * x;
            let (old, old_id) = (keys[k], ids[k]);
            let tolerance = (2.0 * KEY_ERROR as f32) * max_f32(key.abs(), old.abs());
            let is_empty = old_id == SKY;
            let possible = (least >= -doubt) & (x >= from) & (x <= to);
            let is_sure = least > doubt;
            let wins = possible & is_sure & (is_empty | (key - old > tolerance));
            let loses = is_sure & !is_empty & (old - key > tolerance);
            let is_open = possible & !wins & !loses;
            keys[k] = if wins { key } else { old };
            ids[k] = if wins { id } else { old_id };
            open[k] = if is_open { 1 + u32::from(is_sure) } else { 0 };
            any |= open[k];
        }
        any != 0
    }

    /// Decides the samples that were left open.
    #[cold]
    fn settle(
        &self,
        tile: &mut Tile,
        (lane, id): (usize, u32),
        (c, r): (usize, usize),
        near: &Near,
        open: &[u32; PAD],
    ) {
        for (k, how) in open.iter().enumerate() {
            match how {
                1 => tile.decide(c + k, r, id),
                2 => {
                    let (key, by_column) = self.key.of(lane, near.row as f32);
                    tile.offer(c + k, r, key + by_column * ((c + k) as f32 - near.first as f32), id);
                }
                _ => {}
            }
        }
    }
}

/// The lines of posts south and north of a row of cells with alternating diagonals, each as the corner that a half needs:
/// the third corner of half 0 and the first of half 1.
#[inline]
fn alternating_corners(grid: &Grid, (i, j): (usize, usize), south: &Points, north: &Points) -> [Points; 2] {
    let mut corners = [Points::NONE; 2];
    for lane in 0..LANES {
        let is_sw_ne = grid.splits_sw_ne(i + lane, j);
        corners[0].set(lane, north.get(lane + usize::from(is_sw_ne)));
        corners[1].set(lane, south.get(lane + usize::from(!is_sw_ne)));
    }
    corners
}

/// [`Patch::draw_grid`] compiled for the widest vectors of the machine at hand.
struct DrawGrid<'p, 'a, 't, 'g> {
    patch: &'p Patch,
    tile: &'t mut Tile<'a>,
    grid: &'g Grid,
    node: Node,
}

impl pulp::WithSimd for DrawGrid<'_, '_, '_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { patch, tile, grid, node } = self;
        let (columns, rows) = grid.cells(node);
        let lines = GridLines::new(&tile.view, grid, (columns.start, rows.start));
        let mut posts = [Points::NONE; 2];
        posts[0].project(&lines.line(rows.start), &lines.heights(grid, &columns, rows.start));
        let mut sorted = Sorted::NOTHING;
        for j in rows.clone() {
            let place = (j - rows.start) % 2;
            posts[1 - place].project(&lines.line(j + 1), &lines.heights(grid, &columns, j + 1));
            let first = grid.first_triangle(columns.start, j);
            let (south, north) = (&posts[place], &posts[1 - place]);
            let (sw, se) = (south.from::<0>(), south.from::<1>());
            let (nw, ne) = (north.from::<0>(), north.from::<1>());
            let own;
            let halves = match grid.diagonal() {
                Diagonal::SwNe => [[sw, se, ne], [sw, ne, nw]],
                Diagonal::NwSe => [[sw, se, nw], [se, ne, nw]],
                Diagonal::Alternating => {
                    own = alternating_corners(grid, (columns.start, j), south, north);
                    [[sw, se, own[0].from::<0>()], [own[1].from::<0>(), ne, nw]]
                }
            };
            for (half, corners) in (0..).zip(&halves) {
                patch.draw_sixteen(tile, corners, (first + half, 2, columns.len()), &mut sorted);
            }
        }
    }
}

/// [`Patch::draw_sixteen`] compiled for the widest vectors of the machine at hand.
struct DrawSixteen<'p, 'a, 't> {
    patch: &'p Patch,
    tile: &'t mut Tile<'a>,
    corners: &'p [Points; 3],
    ids: std::ops::Range<u32>,
}

impl pulp::WithSimd for DrawSixteen<'_, '_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { patch, tile, corners, ids } = self;
        let corners = corners.each_ref().map(|points| points.from::<0>());
        patch.draw_sixteen(tile, &corners, (ids.start, 1, ids.len()), &mut Sorted { ..Sorted::NOTHING });
    }
}

/// A bound of the error of an edge function at a sample in the box (of side `longest`) of a triangle whose corners are off
/// by at most `point_error` in each coordinate: each of the two products is off by 3 point errors times the side, and
/// the single-precision arithmetic adds 8 roundings of the side squared.
#[inline(always)]
fn edge_doubt(longest: f32, point_error: f32) -> f32 {
    let side = longest + 2e-3;
    side * (8.0 * point_error + 10.0 * (f32::EPSILON / 2.0) * side)
}

/// As [`edge_doubt`], of an edge function that is made for all samples in the box: its two slopes and four sums add 11 roundings.
#[inline(always)]
fn fill_doubt(longest: f32, point_error: f32) -> f32 {
    let side = longest + 2e-3;
    side * (8.0 * point_error + 24.0 * (f32::EPSILON / 2.0) * side)
}

/// The lines of posts of a grid in one column of nodes.
pub(super) struct GridLines {
    first_row: usize,
    /// The node's first post at height 0, then the steps to the next post and the next row.
    origin: DVec3,
    step: DVec3,
    next_row: DVec3,
    up: DVec3,
    depth: DVec3,
    depth_next_row: f64,
    is_parallel: bool,
}

impl GridLines {
    /// The lines from post (i, j) on: near the node, so that a large terrain costs no precision.
    pub(super) fn new(view: &TileView, grid: &Grid, (i, j): (usize, usize)) -> Self {
        let posts = grid.posts();
        let first = posts.plan(i, j);
        let start = crate::space::World::new(first.x, first.y, 0.0);
        let (east, north) = (posts.east().extend(0.0), posts.north().extend(0.0));
        let from_eye = start - view.frame.eye();
        Self {
            first_row: j,
            origin: view.map_point(start),
            step: view.map(east),
            next_row: view.map(north),
            up: view.map(DVec3::Z),
            depth: DVec3::new(view.depth(from_eye), view.depth(east), view.depth(DVec3::Z)),
            depth_next_row: view.depth(north),
            is_parallel: view.is_parallel(),
        }
    }

    /// The line of row `j` of the grid.
    #[inline(always)]
    pub(super) fn line(&self, j: usize) -> PostLine {
        let j = (j - self.first_row) as f64;
        PostLine {
            origin: self.origin + self.next_row * j,
            step: self.step,
            up: self.up,
            depth: self.depth + DVec3::X * (self.depth_next_row * j),
            is_parallel: self.is_parallel,
        }
    }

    /// The heights of a row of a node's posts, NaN beyond its last column.
    #[inline(always)]
    pub(super) fn heights(&self, grid: &Grid, columns: &std::ops::Range<usize>, j: usize) -> [f64; LANES] {
        let start = j * grid.posts().columns();
        let row = &grid.posts().heights()[start + columns.start..=start + columns.end];
        let mut heights = [f64::NAN; LANES];
        match row.first_chunk::<LANES>() {
            Some(whole) => heights = *whole,
            None => heights[..row.len()].copy_from_slice(row),
        }
        heights
    }
}
