//! A triangulated irregular network: Delaunay triangles over scattered points (the sole user of spade), or triangles over vertices that
//! each have a plan point and an up.

use super::{Bounds, Drape, MOST_CHILDREN, Node, SurfaceTriangle, SurfaceVertex};
use crate::error::{Error, Result};
use crate::index::{morton, packed_levels};
use crate::math;
use crate::parallel;
use crate::space::{Plan, PlanBox, World};
use glam::DVec3;
use spade::{DelaunayTriangulation, HasPosition, InsertionError, Point2, Triangulation};
use std::ops::Range;

/// Triangles in a leaf of the hierarchy.
const CLUSTER: usize = 128;
/// How far the length of an up may be from 1.
const UNIT: f64 = 1e-9;

/// Triangles over scattered points, numbered along a space-filling curve.
#[derive(Debug, Clone)]
pub struct Tin {
    vertices: Vec<World>,
    triangles: Vec<[u32; 3]>,
    /// From the leaves up: the lowest and highest corner of each node.
    levels: Vec<Vec<(DVec3, DVec3)>>,
    /// `None`: all vertices lie straight over their plan points.
    draped: Option<Draped>,
}

/// Where the vertices lie in the plan, and what is up there.
#[derive(Debug, Clone)]
struct Draped {
    plan: Vec<Plan>,
    up: Vec<DVec3>,
    /// From the leaves up: the rectangle of the plan of each node.
    levels: Vec<Vec<PlanBox>>,
}

#[derive(Clone, Copy)]
struct Sample {
    at: World,
    index: u32,
}

impl HasPosition for Sample {
    type Scalar = f64;
    fn position(&self) -> Point2<f64> {
        Point2::new(self.at.x, self.at.y)
    }
}

/// What the triangulation could not take, in words.
fn refused(error: InsertionError) -> Error {
    let why = match error {
        InsertionError::TooSmall => "a coordinate is nearer to 0 than 1.8e-43, but not 0",
        InsertionError::TooLarge => "a coordinate is beyond 3e60",
        InsertionError::NAN => "a coordinate is not a number",
    };
    Error::new(format!("the points cannot be triangulated: {why}")).caused_by(error)
}

impl Tin {
    /// The Delaunay triangulation of points; of points at the same place the last counts.
    ///
    /// # Errors
    /// When a coordinate is out of range, or the points span no triangle.
    pub fn new(points: Vec<World>) -> Result<Self> {
        if points.len() >= u32::MAX as usize / 2 {
            return Err(Error::unsupported("more points than this program can number")
                .help("give the terrain a `window`"));
        }
        let samples = points.iter().enumerate().map(|(i, &at)| Sample { at, index: i as u32 }).collect();
        let delaunay = DelaunayTriangulation::<Sample>::bulk_load_stable(samples).map_err(refused)?;
        let mut triangles: Vec<[u32; 3]> =
            delaunay.inner_faces().map(|f| f.vertices().map(|v| v.data().index)).map(from_lowest).collect();
        if triangles.is_empty() {
            return Err(Error::new("the points span no triangle")
                .help("at least three points off one line are needed"));
        }
        order_by_place(&points, &mut triangles);
        let levels = box_levels(&points, &triangles);
        Ok(Self { vertices: points, triangles, levels, draped: None })
    }

    /// See [`super::Mesh::of_surface`].
    pub(super) fn of_surface(vertices: Vec<SurfaceVertex>, triangles: Vec<[u32; 3]>) -> Result<Self> {
        check(&vertices, &triangles)?;
        Ok(Self::by_place(vertices, triangles))
    }

    /// Triangles of a surface that is one, numbered along a space-filling curve of the plan.
    pub(super) fn by_place(vertices: Vec<SurfaceVertex>, mut triangles: Vec<[u32; 3]>) -> Self {
        let plan: Vec<Plan> = vertices.iter().map(|vertex| vertex.plan).collect();
        order_by_place(&plan, &mut triangles);
        Self::in_order(vertices, triangles)
    }

    /// Triangles that are numbered as they are given: neighbours near one another.
    pub(super) fn in_order(vertices: Vec<SurfaceVertex>, triangles: Vec<[u32; 3]>) -> Self {
        let is_vertical = vertices.iter().all(|vertex| *vertex == SurfaceVertex::vertical(vertex.world));
        let world: Vec<World> = vertices.iter().map(|vertex| vertex.world).collect();
        let levels = box_levels(&world, &triangles);
        let draped = (!is_vertical).then(|| {
            let (plan, up): (Vec<Plan>, Vec<DVec3>) = vertices.iter().map(|v| (v.plan, v.up)).unzip();
            let leaf = |c: &[[u32; 3]]| PlanBox::around(c.iter().flatten().map(|&v| plan[v as usize]));
            let join = |c: &[PlanBox]| PlanBox::around(c.iter().flat_map(|plan| [plan.min, plan.max]));
            let levels = levels_of(&triangles, leaf, join);
            Draped { plan, up, levels }
        });
        Self { vertices: world, triangles, levels, draped }
    }

    pub(super) fn drape(&self) -> Drape {
        if self.draped.is_some() { Drape::Affine } else { Drape::Vertical }
    }

    /// The points.
    pub fn vertices(&self) -> &[World] {
        &self.vertices
    }

    /// The triangles as numbers of points, counter-clockwise.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The corners of a triangle.
    ///
    /// # Panics
    /// When there is no such triangle.
    #[inline]
    pub fn triangle(&self, id: u32) -> [World; 3] {
        self.triangles[id as usize].map(|v| self.vertices[v as usize])
    }

    pub(super) fn vertex(&self, number: usize) -> SurfaceVertex {
        let world = self.vertices[number];
        match &self.draped {
            None => SurfaceVertex::vertical(world),
            Some(draped) => SurfaceVertex { world, plan: draped.plan[number], up: draped.up[number] },
        }
    }

    #[inline]
    pub(super) fn surface_triangle(&self, id: u32) -> SurfaceTriangle {
        match &self.draped {
            None => SurfaceTriangle::vertical(self.triangle(id)),
            Some(_) => SurfaceTriangle::between(self.triangles[id as usize].map(|v| self.vertex(v as usize))),
        }
    }

    /// A rectangle of the plan around a node's triangles.
    pub(super) fn plan_of(&self, node: Node) -> PlanBox {
        match &self.draped {
            None => self.bounds(node).below(),
            Some(draped) => draped.levels[node.level as usize][node.x as usize],
        }
    }

    /// The height over a plan point of a mesh that is draped vertically; `None` where there is no triangle.
    pub(super) fn height_at(&self, at: Plan) -> Option<f64> {
        let mut stack = vec![Node { level: self.levels.len() as u32 - 1, x: 0, y: 0 }];
        while let Some(node) = stack.pop() {
            let plan = self.plan_of(node);
            if !plan.contains(&PlanBox::around([at])) {
                continue;
            }
            if node.level > 0 {
                self.for_each_child(node, |child| stack.push(child));
            } else if let Some(height) = self.leaf(node).find_map(|id| height_on(&self.triangle(id), at)) {
                return Some(height);
            }
        }
        None
    }

    /// The side of the square that two triangles cover on the average.
    pub(super) fn resolution(&self) -> f64 {
        let area = |[a, b, c]: [World; 3]| (b.plan() - a.plan()).perp_dot(c.plan() - a.plan()).abs();
        let doubled: f64 = (0..self.triangles.len() as u32).map(|id| area(self.triangle(id))).sum();
        (doubled / self.triangles.len() as f64).sqrt()
    }

    /// The triangles of a leaf.
    pub fn leaf(&self, node: Node) -> Range<u32> {
        let first = node.x as usize * CLUSTER;
        first as u32..(first + CLUSTER).min(self.triangles.len()) as u32
    }

    pub(super) fn levels(&self) -> usize {
        self.levels.len()
    }

    pub(super) fn bounds(&self, node: Node) -> Bounds {
        let (low, high) = self.levels[node.level as usize][node.x as usize];
        let half = (high - low) / 2.0;
        Bounds {
            center: World::from(low + half),
            axes: [DVec3::X * half.x, DVec3::Y * half.y, DVec3::Z * half.z],
        }
    }

    pub(super) fn for_each_child(&self, node: Node, mut visit: impl FnMut(Node)) {
        let level = node.level - 1;
        let end = (node.x as usize + 1) * MOST_CHILDREN;
        for x in node.x as usize * MOST_CHILDREN..end.min(self.levels[level as usize].len()) {
            visit(Node { level, x: x as u32, y: 0 });
        }
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.vertices[..])
            + size_of_val(&self.triangles[..])
            + self.levels.iter().map(|l| size_of_val(&l[..])).sum::<usize>()
            + self.draped.as_ref().map_or(0, Draped::bytes)
    }
}

/// The height of a triangle at a plan point; `None` beside it. Points of its border count, so that no seam has none.
fn height_on([a, b, c]: &[World; 3], at: Plan) -> Option<f64> {
    let [p, q, r] = [a, b, c].map(|corner| corner.plan() - at);
    let weights = [q.perp_dot(r), r.perp_dot(p), p.perp_dot(q)];
    let sum = weights[0] + weights[1] + weights[2];
    let is_in = sum > 0.0 && weights.iter().all(|weight| *weight >= -1e-12 * sum);
    is_in.then(|| (a.z * weights[0] + b.z * weights[1] + c.z * weights[2]) / sum)
}

impl Draped {
    fn bytes(&self) -> usize {
        size_of_val(&self.plan[..])
            + size_of_val(&self.up[..])
            + self.levels.iter().map(|l| size_of_val(&l[..])).sum::<usize>()
    }
}

/// Refuses what is no surface.
fn check(vertices: &[SurfaceVertex], triangles: &[[u32; 3]]) -> Result<()> {
    if triangles.is_empty() || triangles.len() >= u32::MAX as usize {
        return Err(Error::new(format!("a surface of {} triangles cannot be drawn", triangles.len()))
            .help("give it at least one, and fewer than 2^32 - 1"));
    }
    let is_fine = |vertex: &SurfaceVertex| {
        vertex.world.is_finite() && vertex.plan.is_finite() && (vertex.up.length() - 1.0).abs() < UNIT
    };
    if let Some(number) = vertices.iter().position(|vertex| !is_fine(vertex)) {
        return Err(Error::new(format!(
            "vertex {number} of the surface is not finite, or its up no unit vector"
        ))
        .help("give finite coordinates, and an up of length 1"));
    }
    let missing = triangles.iter().position(|corners| corners.iter().any(|v| *v as usize >= vertices.len()));
    missing.map_or(Ok(()), |triangle| {
        Err(Error::new(format!("triangle {triangle} of the surface has a corner that is no vertex"))
            .help(format!("the {} vertices are counted from 0", vertices.len())))
    })
}

/// The triangle turned so that its lowest number comes first: one form for each.
fn from_lowest([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// Sorts triangles along the Morton curve of their centroids, so that neighbours have near numbers.
fn order_by_place<P: Copy + Into<Plan> + Sync>(points: &[P], triangles: &mut [[u32; 3]]) {
    let bounds = PlanBox::around(points.iter().map(|p| (*p).into()));
    let size = bounds.max - bounds.min;
    let scale = 65_535.0 / math::max(math::max(size.x, size.y), f64::MIN_POSITIVE);
    parallel::sort_by_key(triangles, |t| {
        let sum = t.map(|v| points[v as usize].into() - bounds.min).into_iter().sum::<glam::DVec2>();
        let cell = sum / 3.0 * scale;
        (morton(cell.x as u32, cell.y as u32), *t)
    });
}

/// The lowest and highest corner of each node, from the leaves up.
fn box_levels(points: &[World], triangles: &[[u32; 3]]) -> Vec<Vec<(DVec3, DVec3)>> {
    let around = |corners: &mut dyn Iterator<Item = (DVec3, DVec3)>| {
        let nothing = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        corners.fold(nothing, |(low, high), (l, h)| (low.min(l), high.max(h)))
    };
    let corner = |&v: &u32| (points[v as usize].to_vec(), points[v as usize].to_vec());
    let leaf = |c: &[[u32; 3]]| around(&mut c.iter().flatten().map(corner));
    levels_of(triangles, leaf, |c| around(&mut c.iter().copied()))
}

/// What is known of each node, from the leaves up: of a leaf by its triangles, of the others by their children.
fn levels_of<B>(
    triangles: &[[u32; 3]],
    leaf: impl Fn(&[[u32; 3]]) -> B,
    join: impl Fn(&[B]) -> B,
) -> Vec<Vec<B>> {
    packed_levels(triangles.chunks(CLUSTER).map(leaf).collect(), MOST_CHILDREN, join)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::terrain::{Leaf, Mesh};

    #[test]
    fn four_corners_and_a_middle_make_four_triangles() {
        let p = |x: f64, y: f64| World::new(x, y, x + y);
        let tin = Tin::new(vec![p(0.0, 0.0), p(4.0, 0.0), p(4.0, 4.0), p(0.0, 4.0), p(2.0, 2.0)]).unwrap();
        assert_eq!(tin.triangles().len(), 4);
        for t in 0..4 {
            let [a, b, c] = tin.triangle(t);
            assert!(crate::predicate::orient2d(a.plan(), b.plan(), c.plan()) > 0.0);
        }
    }

    #[test]
    fn every_triangle_lies_in_the_boxes_of_its_ancestors_in_the_world_and_in_the_plan() {
        let n = 31u32;
        let at = |k: u32| (f64::from(k % n), f64::from(k / n));
        let vertices = (0..n * n).map(at).map(|(x, y)| SurfaceVertex {
            world: World::new(y - 0.3 * x, (x * 7.0 + y * 3.0) % 5.0, 2.0 * x),
            plan: Plan::new(100.0 + x * 0.5 - y, x + y * y / 9.0),
            up: DVec3::Y,
        });
        let cells = (0..n * (n - 1)).filter(|k| k % n < n - 1);
        let triangles = cells.flat_map(|k| [[k, k + 1, k + n], [k + 1, k + n + 1, k + n]]);
        let mesh = Mesh::of_surface(vertices.collect(), triangles.collect()).unwrap();
        assert_eq!((mesh.drape(), mesh.heights()), (Drape::Affine, None));
        let mut looked_at = 0;
        let mut stack = vec![(mesh.root(), mesh.root())];
        while let Some((node, parent)) = stack.pop() {
            let (plan, around) = (mesh.plan_of(node).unwrap(), mesh.plan_of(parent).unwrap());
            assert!(around.contains(&plan));
            if node.level > 0 {
                mesh.for_each_child(node, |child| stack.push((child, node)));
                continue;
            }
            let bounds = mesh.bounds(node).unwrap();
            let Leaf::Triangles(ids) = mesh.leaf(node) else { panic!("no cells") };
            for triangle in ids.filter_map(|id| mesh.surface_triangle(id)) {
                assert!(plan.contains(&PlanBox::around(triangle.plan())));
                for corner in triangle.world {
                    let off = (corner - bounds.center).abs();
                    assert!((0..3).all(|k| off[k] <= bounds.axes[k][k] * (1.0 + 1e-15)), "{corner:?}");
                    let eye = World::new(-50.0, 3.0, 9.0);
                    assert!((corner - eye).length() <= mesh.farthest_from(eye));
                }
                looked_at += 1;
            }
        }
        assert_eq!(looked_at, 2 * 30 * 30);
    }

    #[test]
    fn what_is_no_surface_is_refused() {
        let vertices: Vec<SurfaceVertex> = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)]
            .map(|(x, y)| SurfaceVertex::vertical(World::new(x, y, 0.0)))
            .into();
        let refused = |vertices: &[SurfaceVertex], triangles: &[[u32; 3]]| {
            Tin::of_surface(vertices.to_vec(), triangles.to_vec()).map(|_| ()).unwrap_err().to_string()
        };
        assert!(refused(&vertices, &[]).contains("0 triangles"));
        assert!(refused(&vertices, &[[0, 1, 2], [1, 2, 3]]).contains("triangle 1"));
        let with = |vertex| [vertices[0], vertex, vertices[2]];
        let long = SurfaceVertex { up: DVec3::Z * 1.1, ..vertices[1] };
        let nowhere = SurfaceVertex { plan: Plan::new(f64::NAN, 0.0), ..vertices[1] };
        for wrong in [long, nowhere] {
            assert!(refused(&with(wrong), &[[0, 1, 2]]).contains("vertex 1"));
        }
    }

    #[test]
    fn points_on_one_line_are_refused() {
        let line: Vec<_> = (0..5).map(|k| World::new(f64::from(k), 0.0, 0.0)).collect();
        assert!(Tin::new(line).unwrap_err().to_string().contains("no triangle"));
    }
}
