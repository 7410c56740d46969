//! Many small triangles at once, in single precision: the path that nearly all triangles of a large terrain take.
//!
//! Corners are projected in double precision and rounded to single precision in tile coordinates. Sixteen triangles at a
//! time are then sorted into: no sample near (most), exactly one sample near (decided in place), several
//! (handed to [`super::Facet::fill`]). The error of a rounded corner bounds every doubt.

use super::facet::{Facet, TriangleShape};
use super::tile::Tile;
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
const SEVERAL: u32 = 3;

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
    column: [f32; LANES],
    row: [f32; LANES],
    key: [f32; LANES],
}

impl Sorted {
    const NOTHING: Self =
        Self { state: [NOTHING; LANES], column: [0.0; LANES], row: [0.0; LANES], key: [0.0; LANES] };
}

/// A patch of terrain whose pictures of points lie near the tile and surely beyond the near plane.
#[derive(Debug, Clone, Copy)]
pub struct Patch {
    /// A bound of the error of a point's tile coordinates after rounding to single precision.
    point_error: f32,
}

/// Points whose pictures are kept while the triangles of a leaf are drawn.
const KNOWN: usize = 128;

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

    /// Draws rows of cells of a grid: the posts of column `i` on of rows `j..=j + rows`; `heights(row)` gives the
    /// sixteen heights of a row of posts, NaN where there is none.
    pub fn draw_grid(&self, tile: &mut Tile, grid: &Grid, node: Node) {
        let arch = tile.arch;
        let (columns, rows) = grid.cells(node);
        let mut posts = [Points::NONE; LANES];
        arch.dispatch(Project { view: &tile.view, grid, node, to: &mut posts });
        let mut sorted = Sorted::NOTHING;
        for j in rows.clone() {
            let first = grid.first_triangle(columns.start, j);
            let (south, north) = (&posts[j - rows.start], &posts[j - rows.start + 1]);
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
            for (half, corners) in halves.iter().enumerate() {
                arch.dispatch(Sort { patch: self, view: &tile.view, corners, sorted: &mut sorted });
                self.settle(tile, &sorted, corners, |lane| first + 2 * lane as u32 + half as u32);
            }
        }
    }

    /// Draws numbered triangles of the tile's mesh, sixteen at a time.
    pub fn draw_triangles(&self, tile: &mut Tile, ids: std::ops::Range<u32>) {
        let (arch, mut sorted) = (tile.arch, Sorted::NOTHING);
        // Triangles that follow one another share corners: pictures of points by the last digits of their numbers.
        let mut known = [(SKY, (0.0, 0.0, 0.0)); KNOWN];
        for start in ids.clone().step_by(LANES) {
            let mut corners = [Points::NONE; 3];
            for id in start..ids.end.min(start + LANES as u32) {
                let Some((numbers, triangle)) = tile.mesh.corners(id).zip(tile.mesh.triangle(id)) else {
                    continue;
                };
                for (points, (number, corner)) in corners.iter_mut().zip(numbers.into_iter().zip(triangle)) {
                    let place = &mut known[number as usize % KNOWN];
                    if place.0 != number {
                        let h = tile.view.map_point(corner);
                        let key = tile.key_of_depth(tile.view.frame.depth(corner));
                        *place = (number, ((h.x / h.z) as f32, (h.y / h.z) as f32, key as f32));
                    }
                    points.set((id - start) as usize, place.1);
                }
            }
            let sixteen = [corners[0].from::<0>(), corners[1].from::<0>(), corners[2].from::<0>()];
            arch.dispatch(Sort { patch: self, view: &tile.view, corners: &sixteen, sorted: &mut sorted });
            self.settle(tile, &sorted, &sixteen, |lane| start + lane as u32);
        }
    }

    /// Sorts sixteen triangles by the samples near them, and decides those with one sample.
    #[inline(always)]
    fn sort(&self, view: &TileView, [a, b, c]: &[Sixteen; 3], out: &mut Sorted) {
        let (first, last) = (view.first, view.last());
        let (first_x, first_y) = (first.0 as f32, first.1 as f32);
        let (last_x, last_y) = (last.0 as f32, last.1 as f32);
        let hair = 2.0 * self.point_error;
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
            out.column[k] = x0 - first_x;
            out.row[k] = y0 - first_y;
            out.key[k] = key;
        }
    }

    /// Draws what sorting left to do.
    #[inline]
    fn settle(&self, tile: &mut Tile, sorted: &Sorted, corners: &[Sixteen; 3], id: impl Fn(usize) -> u32) {
        for (lane, state) in sorted.state.iter().enumerate() {
            if *state != NOTHING {
                self.settle_one(tile, sorted, corners, lane, id(lane));
            }
        }
    }

    #[inline(always)]
    fn settle_one(&self, tile: &mut Tile, sorted: &Sorted, corners: &[Sixteen; 3], lane: usize, id: u32) {
        let (c, r) = (sorted.column[lane] as usize, sorted.row[lane] as usize);
        tile.counts.triangles += 1;
        match sorted.state[lane] {
            COVERS_ONE => tile.offer(c, r, sorted.key[lane], id),
            DOUBTFUL_ONE => tile.decide(c, r, id),
            _ => self.draw_several(tile, corners.map(|p| [p.x[lane], p.y[lane], p.key[lane]]), id),
        }
    }

    /// Draws a triangle that has several samples near it.
    fn draw_several(&self, tile: &mut Tile, corners: [[f32; 3]; 3], id: u32) {
        let [a, b, c] = corners.map(|p| p.map(f64::from));
        let range = |k: usize| {
            let v = [a[k], b[k], c[k]];
            v.iter().fold((v[0], v[0]), |(l, h), &v| (if v < l { v } else { l }, if v > h { v } else { h }))
        };
        let ((x0, x1), (y0, y1), (k0, k1)) = (range(0), range(1), range(2));
        let Some((from, to)) = tile.samples_in([x0, y0, x1, y1]) else {
            return;
        };
        let edge = |p: [f64; 3], q: [f64; 3]| {
            let (dx, dy) = (q[0] - p[0], q[1] - p[1]);
            DVec3::new(-dy, dx, dy * p[0] - dx * p[1])
        };
        let edges = [edge(a, b), edge(b, c), edge(c, a)];
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let longest = if x1 - x0 > y1 - y0 { x1 - x0 } else { y1 - y0 };
        let doubt = f64::from(edge_doubt(longest as f32, self.point_error));
        let key = (DVec3::Z * (a[2] * area) + edges[2] * (b[2] - a[2]) + edges[0] * (c[2] - a[2])) / area;
        let least = if k0.abs() < k1.abs() { k0.abs() } else { k1.abs() };
        let is_key_sure = 8.0 * doubt * (k1 - k0) <= KEY_ERROR / 4.0 * least * area.abs();
        if !is_key_sure || area == 0.0 {
            if let Some(corners) = tile.mesh.triangle(id) {
                Facet::draw(tile, id, &corners);
            }
            return;
        }
        let sign = area.signum();
        let shape = TriangleShape { edges: edges.map(|e| e * sign), edge_error: doubt, key };
        let facet = Facet::of_shape(id, &shape, (true, least), (f64::NEG_INFINITY, f64::INFINITY));
        facet.fill(tile, from, to);
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

/// Projects the posts of a node, row by row; compiled for the widest vectors of the machine at hand.
struct Project<'a> {
    view: &'a TileView,
    grid: &'a Grid,
    node: Node,
    to: &'a mut [Points; LANES],
}

impl pulp::WithSimd for Project<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let (columns, rows) = self.grid.cells(self.node);
        let lines = GridLines::new(self.view, self.grid, (columns.start, rows.start));
        for (points, j) in self.to.iter_mut().zip(rows.start..=rows.end) {
            points.project(&lines.line(j), &lines.heights(self.grid, &columns, j));
        }
    }
}

/// [`Patch::sort`] compiled for the widest vectors of the machine at hand.
struct Sort<'a> {
    patch: &'a Patch,
    view: &'a TileView,
    corners: &'a [Sixteen<'a>; 3],
    sorted: &'a mut Sorted,
}

impl pulp::WithSimd for Sort<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        self.patch.sort(self.view, self.corners, self.sorted);
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
