//! The faces of a volume, and whether a line of sight crosses one before or behind the terrain that it sees.
//!
//! Input: a [`Volume`], a tile. Output: [`Face`]s: linear functions of the sample (coverage) and of the surface point that it sees
//! (the depth test), in single precision with bounds of their errors, and [`Outline::decide`], which decides exactly what lies
//! within the bounds. Refuses: nothing; a face seen edge-on is crossed by no line.
//!
//! The depth test needs no depths: the line of sight crosses a face behind the surface point exactly when the point lies on the
//! side of the face's plane that the line comes from. So walls ask for the point's side of a line of the plan, caps
//! for its height.

use super::extrusion::{Extrusion, Volume, nadir};
use crate::math;
use crate::predicate::{hit_is_above, hit_side, moved_ray_side, orient2d};
use crate::raster::TileView;
use crate::space::{Lens, Plan, PlanBox, Ray, ViewFrame, World};
use glam::DVec3;

/// Unit roundoff of doubles.
const U: f64 = f64::EPSILON / 2.0;
/// Unit roundoff of single precision.
const SINGLE: f64 = f32::EPSILON as f64 / 2.0;
/// What single-precision evaluation of a scaled edge function may be off, in samples (see [`crate::raster::Facet`]).
const EVALUATION_DOUBT: f64 = 2e-4;

/// A line of sight crosses a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fragment {
    /// 1: the volume is entered (a front face), -1: left.
    pub facing: i32,
    /// Whether the face lies behind the surface point: the depth test fails.
    pub is_behind: bool,
}

/// A convex face of a volume, as points: a wall, a cap, a triangle of a cap's fan (4.2.1, Fig. 5).
#[derive(Debug, Clone, Copy)]
pub struct Outline {
    corners: [World; 4],
    count: usize,
    /// 0: a wall over the line from the first corner to the second; else the vertical direction from which the
    /// corners run counter-clockwise.
    up: i32,
}

impl Outline {
    /// The corners, counter-clockwise seen from outside (for a triangle of a fan: or clockwise, so that it counts negatively).
    pub fn corners(&self) -> &[World] {
        &self.corners[..self.count]
    }

    /// Calls `visit` with the faces of a volume in order: the top cap (unless it is open above), the bottom cap, the walls.
    pub fn for_each(
        extrusion: &Extrusion,
        volume: &Volume,
        is_open_above: bool,
        mut visit: impl FnMut(Self),
    ) {
        for (height, up) in [(volume.high, 1), (volume.low, -1)] {
            if up == 1 && is_open_above {
                continue;
            }
            if volume.is_box {
                extrusion.rings_of(volume).for_each(|ring| visit(Self::level(ring, height, up, 1.0)));
                continue;
            }
            // One fan for all rings: the triangles' signs cancel outside and in holes (Fig. 5).
            let Some(&apex) = extrusion.rings_of(volume).next().and_then(<[Plan]>::first) else { continue };
            for (a, b) in extrusion.rings_of(volume).flat_map(sides) {
                let turn = orient2d(apex, a, b);
                if turn != 0.0 {
                    visit(Self::level(&[apex, a, b], height, up, turn));
                }
            }
        }
        for (a, b) in extrusion.rings_of(volume).flat_map(sides).filter(|(a, b)| a != b) {
            visit(Self::wall(a, b, (volume.low, volume.high)));
        }
    }

    /// The faces of an upright box.
    pub fn of_box(plan: &PlanBox, levels: (f64, f64)) -> [Self; 6] {
        let (min, max) = (plan.min, plan.max);
        let [a, b, c, d] = [min, Plan::new(max.x, min.y), max, Plan::new(min.x, max.y)];
        let ring = [a, b, c, d];
        [
            Self::level(&ring, levels.1, 1, 1.0),
            Self::level(&ring, levels.0, -1, 1.0),
            Self::wall(a, b, levels),
            Self::wall(b, c, levels),
            Self::wall(c, d, levels),
            Self::wall(d, a, levels),
        ]
    }

    /// The wall over the line between two corners of a ring.
    pub fn wall(a: Plan, b: Plan, (low, high): (f64, f64)) -> Self {
        Self { corners: [nadir(a, low), nadir(b, low), nadir(b, high), nadir(a, high)], count: 4, up: 0 }
    }

    /// A cap's part: `up` is 1 for the top cap, -1 for the bottom one, whose corners are taken in reverse.
    pub fn level(ring: &[Plan], height: f64, up: i32, turn: f64) -> Self {
        let mut corners = [nadir(ring[0], height); 4];
        let count = ring.len();
        for (k, corner) in corners.iter_mut().take(count).enumerate() {
            *corner = nadir(ring[if up > 0 { k } else { count - 1 - k }], height);
        }
        Self { corners, count, up: if turn > 0.0 { up } else { -up } }
    }

    /// Exactly: how the ray crosses the face, given the terrain's triangle that it meets (`None`: the sky, before which all
    /// faces lie) and, for a central lens, from which side the eye sees the face.
    pub fn decide(&self, ray: &Ray, ground: Option<&[World; 3]>, seen: Option<i32>) -> Option<Fragment> {
        let corners = self.corners();
        let side = |k: usize| {
            let side = moved_ray_side(ray, corners[k], corners[(k + 1) % corners.len()]);
            if side == 0.0 { 0.0 } else { side.signum() }
        };
        let first = side(0);
        if first == 0.0 || (1..corners.len()).any(|k| side(k) != first) {
            return None;
        }
        let facing = first as i32;
        // A line that crosses the face the other way round meets it behind the eye.
        if seen.is_some_and(|seen| seen != facing) {
            return None;
        }
        let is_behind = ground.is_some_and(|ground| self.outer_side(ray, ground) == facing);
        Some(Fragment { facing, is_behind })
    }

    /// 1 where the surface point lies on the side from which the corners run counter-clockwise, else -1.
    fn outer_side(&self, ray: &Ray, ground: &[World; 3]) -> i32 {
        let [a, b, ..] = self.corners;
        if self.up == 0 {
            return if hit_side(ray, ground, a.plan(), b.plan()) < 0.0 { 1 } else { -1 };
        }
        if hit_is_above(ray, ground, a.z) { self.up } else { -self.up }
    }

    /// From which side the lens sees the face: 1 or -1; 0: edge-on; `None`: rays differ, or doubles do not tell.
    pub fn seen_by(&self, frame: &ViewFrame) -> Option<i32> {
        let [a, b, ..] = self.corners;
        let sign = |v: f64| if v == 0.0 { 0 } else { v.signum() as i32 };
        match frame.lens() {
            Lens::Central { .. } if self.up == 0 => {
                Some(-sign(orient2d(a.plan(), b.plan(), frame.eye().plan())))
            }
            Lens::Central { .. } => Some(sign(frame.eye().z - a.z) * self.up),
            Lens::Parallel { pixel } => {
                let d = frame.forward();
                let along = b.plan() - a.plan();
                let (towards, size) = if self.up == 0 {
                    (along.x * d.y - along.y * d.x, along.abs().element_sum())
                } else {
                    (-d.z * f64::from(self.up), 1.0)
                };
                // Both points of a ray are rounded; their distance is `reach`.
                let reach = frame.eye().to_vec().abs().element_sum()
                    + pixel * (frame.width() + frame.height()) as f64;
                let doubt = 16.0 * U * (2.0 + reach / frame.reach()) * size;
                (towards.abs() > doubt).then(|| sign(towards))
            }
        }
    }
}

/// Where the surface points of a tile lie, as far as the depth test needs to know.
#[derive(Debug, Clone, Copy)]
pub struct SampleFrame {
    /// Points are kept in single precision relative to this one.
    pub origin: World,
    /// The largest coordinate of a point relative to the origin.
    pub reach: f64,
    /// What a coordinate may be off before it is rounded to single precision.
    pub error: f64,
}

/// A face set up for a tile.
#[derive(Debug, Clone, Copy)]
pub struct Face {
    /// Edge functions of tile coordinates, positive inside, scaled to distances in samples.
    pub edges: [DVec3; 4],
    /// What lies nearer to an edge than this many samples is decided exactly.
    pub doubt: f32,
    /// A function of the surface point, positive where the face lies behind it: x, y, z, constant.
    pub side: [f32; 4],
    /// Where that function is not larger, it is decided exactly.
    pub slack: f32,
    /// From which side the face is seen; `None`: each ray is asked.
    pub facing: Option<i32>,
    /// The first and last column and row of the tile that its picture can touch.
    pub columns: (usize, usize),
    /// As `columns`.
    pub rows: (usize, usize),
    /// The face itself.
    pub outline: Outline,
}

/// A corner in homogeneous tile coordinates, with the size that bounds its error.
#[derive(Debug, Clone, Copy)]
struct Vertex {
    at: DVec3,
    size: f64,
    /// Its place in the tile; `None` near the eye's plane and behind it.
    screen: Option<[f64; 2]>,
}

/// The function of an edge, positive on its left as the viewer sees it, scaled to distances in samples.
#[derive(Debug, Clone, Copy)]
struct Edge {
    function: DVec3,
    doubt: f64,
}

/// Sets up volumes for a tile.
#[derive(Debug)]
pub struct Setup<'a> {
    /// The tile.
    pub view: &'a TileView,
    /// Its surface points.
    pub place: SampleFrame,
    /// Whether top caps are left out.
    pub is_open_above: bool,
}

impl Setup<'_> {
    /// The faces of a volume that lie in the tile and are not seen edge-on, in order. `is_cut`: each fragment is to be asked where
    /// the near and far plane are, so nothing is left to the filter.
    pub fn faces(&self, extrusion: &Extrusion, volume: &Volume, is_cut: bool, faces: &mut Vec<Face>) {
        faces.clear();
        if let (Some(ring), true) = (extrusion.rings_of(volume).next(), volume.is_box && !is_cut) {
            return self.box_faces(ring, (volume.low, volume.high), faces);
        }
        Outline::for_each(extrusion, volume, self.is_open_above, |outline| {
            faces.extend(self.face(outline, is_cut));
        });
    }

    /// The faces of a convex volume of three or four corners: they share vertices and edges.
    fn box_faces(&self, ring: &[Plan], (low, high): (f64, f64), faces: &mut Vec<Face>) {
        let count = ring.len();
        let next = |k: usize| if k + 1 < count { k + 1 } else { 0 };
        let corner = |k: usize| ring[if k < count { k } else { 0 }];
        let bottom: [Vertex; 4] = std::array::from_fn(|k| self.vertex(nadir(corner(k), low)));
        let top: [Vertex; 4] = std::array::from_fn(|k| self.vertex(nadir(corner(k), high)));
        let along: [DVec3; 4] = std::array::from_fn(|k| (corner(next(k)) - corner(k)).extend(0.0));
        let up = DVec3::Z * (high - low);
        let below: [Edge; 4] = std::array::from_fn(|k| self.edge(&bottom[k], along[k]));
        let above: [Edge; 4] = std::array::from_fn(|k| self.edge(&top[k], along[k]));
        let upright: [Edge; 4] = std::array::from_fn(|k| self.edge(&bottom[k], up));
        if !self.is_open_above {
            let edges = above.map(|e| (e, 1.0));
            let outline = Outline::level(ring, high, 1, 1.0);
            faces.extend(self.set_up(outline, &top[..count], &edges[..count]));
        }
        let edges = below.map(|e| (e, -1.0));
        let outline = Outline::level(ring, low, -1, 1.0);
        faces.extend(self.set_up(outline, &bottom[..count], &edges[..count]));
        for k in 0..count {
            let n = next(k);
            let vertices = [bottom[k], bottom[n], top[n], top[k]];
            let edges = [(below[k], 1.0), (upright[n], 1.0), (above[k], -1.0), (upright[k], -1.0)];
            let outline = Outline::wall(ring[k], ring[n], (low, high));
            faces.extend(self.set_up(outline, &vertices, &edges));
        }
    }

    /// A face; `None` where it cannot touch a sample of the tile.
    pub fn face(&self, outline: Outline, is_cut: bool) -> Option<Face> {
        let corners = outline.corners();
        let vertices: [Vertex; 4] = std::array::from_fn(|k| self.vertex(outline.corners[k]));
        let vertices = &vertices[..corners.len()];
        if is_cut {
            return self.set_up(outline, vertices, &[]);
        }
        let edges: [(Edge, f64); 4] = std::array::from_fn(|k| {
            let (a, b) = (k % corners.len(), (k + 1) % corners.len());
            (self.edge(&vertices[a], corners[b] - corners[a]), 1.0)
        });
        self.set_up(outline, vertices, &edges[..corners.len()])
    }

    /// A face of known vertices and edges (each with the sign that makes it run as the face's corners do); without
    /// edges, every sample is to be decided exactly.
    #[inline(always)]
    fn set_up(&self, outline: Outline, vertices: &[Vertex], edges: &[(Edge, f64)]) -> Option<Face> {
        let facing = outline.seen_by(&self.view.frame);
        if facing == Some(0) {
            return None;
        }
        let (columns, rows) = self.rectangle(vertices)?;
        let mut face = Face {
            edges: [DVec3::new(0.0, 0.0, f64::MAX); 4],
            doubt: f32::INFINITY,
            side: [0.0; 4],
            slack: f32::INFINITY,
            facing,
            columns,
            rows,
            outline,
        };
        if let (Some(facing), false) = (facing, edges.is_empty()) {
            let mut doubt = EVALUATION_DOUBT;
            for (to, (edge, sign)) in face.edges.iter_mut().zip(edges) {
                *to = edge.function * (f64::from(facing) * sign);
                doubt = math::max(edge.doubt, doubt);
            }
            face.doubt = doubt as f32;
            (face.side, face.slack) = self.side(&outline, facing);
        }
        Some(face)
    }

    #[inline(always)]
    fn vertex(&self, p: World) -> Vertex {
        let eye = self.view.frame.eye();
        let at = self.view.map_point(p);
        let size = (p - eye).abs().element_sum() + eye.to_vec().abs().max_element();
        // A hair in `rectangle` must cover the error of a projected corner.
        let has_place = at.z > 1e6 * U * self.view.gain() * size;
        let w = 1.0 / at.z;
        Vertex { at, size, screen: if has_place { Some([at.x * w, at.y * w]) } else { None } }
    }

    /// The columns and rows around the face's picture; all of the tile's where a corner is near the eye's plane.
    #[inline(always)]
    fn rectangle(&self, vertices: &[Vertex]) -> Option<((usize, usize), (usize, usize))> {
        let view = self.view;
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for v in vertices {
            let Some(at) = v.screen else {
                return Some(((0, view.width - 1), (0, view.height - 1)));
            };
            for k in 0..2 {
                low[k] = math::min(at[k], low[k]);
                high[k] = math::max(at[k], high[k]);
            }
        }
        let span = |k: usize, first: f64, count: usize| {
            let (from, to) = (low[k] - first - 1e-3, high[k] - first + 1e-3);
            let last = (count - 1) as f64;
            if to < 0.0 || from > last {
                return None;
            }
            // Casts saturate: what lies before the first sample becomes 0.
            Some((from as usize, if to < last { to as usize } else { count - 1 }))
        };
        Some((span(0, view.first.0, view.width)?, span(1, view.first.1, view.height)?))
    }

    /// The function of an edge from a vertex, scaled to distances.
    #[inline(always)]
    fn edge(&self, from: &Vertex, along: DVec3) -> Edge {
        let gain = self.view.gain();
        // Tile coordinates run down, so what the viewer has on the left of an edge has a negative product.
        let e = -from.at.cross(self.view.map(along));
        let slope = e.x.abs() + e.y.abs();
        if slope <= 0.0 {
            return Edge { function: DVec3::ZERO, doubt: f64::INFINITY };
        }
        // As in `Facet`: every coordinate is at most `gain` times its displacement and off by 16 roundings of that.
        let error = 384.0 * U * gain * gain * from.size * along.abs().element_sum();
        let scale = 1.0 / slope;
        Edge { function: e * scale, doubt: error * scale + EVALUATION_DOUBT }
    }

    /// The function whose sign is the depth test's for a face that is seen from one side, and how small it must not be.
    pub fn side(&self, outline: &Outline, facing: i32) -> ([f32; 4], f32) {
        let SampleFrame { origin, reach, error } = self.place;
        let [a, b, ..] = outline.corners;
        let o = f64::from(facing);
        let (x, y, z) = if outline.up == 0 {
            let along = b.plan() - a.plan();
            let length = along.length();
            (o * along.y / length, -o * along.x / length, 0.0)
        } else {
            (0.0, 0.0, o * f64::from(outline.up))
        };
        let from = a - origin;
        let constant = -(x * from.x + y * from.y + z * from.z);
        // Rounding to single precision and five operations, on terms below reach and the constant.
        let slack = 8.0 * SINGLE * (2.0 * reach + constant.abs())
            + 4.0 * error
            + 16.0 * U * (a.to_vec().abs().max_element() + origin.to_vec().abs().max_element());
        ([x as f32, y as f32, z as f32, constant as f32], slack as f32)
    }
}

/// The sides of a ring, the last one back to the first corner.
fn sides(ring: &[Plan]) -> impl Iterator<Item = (Plan, Plan)> + '_ {
    ring.iter().enumerate().map(|(k, a)| (*a, ring[(k + 1) % ring.len()]))
}
