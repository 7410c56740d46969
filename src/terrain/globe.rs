//! Posts over a globe -> vertices along its normals, and triangles: of a cell two, of a column's end at a pole one.
//!
//! Input: [`GlobePosts`]. Output: [`GlobeMesh`]: all triangles, and the posts as a lattice whose first and last row are those at the poles, where the
//! surface reaches them, and whose last column is the first one, where it goes all around. Refuses: more posts than can be numbered, posts without a triangle.
//!
//! - The vertices of both ends of a full circle have the same point of the world, to the bit, and plan points that are a turn apart.
//! - All posts at a pole would be one point. The triangle from two neighbours of the last row to the pole has there the longitude of their
//!   middle.
//! - The triangles are made when they are first asked for: a level-of-detail mesh needs the posts alone, and of a grid of arc minutes all
//!   triangles would be a hundred times as large.

use super::grid::{half_corners, splits_sw_ne};
use super::lod::Post;
use super::{SurfaceVertex, Tin};
use crate::error::{Error, Result};
use crate::math;
use crate::parallel;
use crate::scene::{Diagonal, GlobePosts};
use crate::space::{Plan, PlanBox, World};
use glam::DVec3;
use std::sync::OnceLock;

/// The triangles of all posts over a globe.
#[derive(Debug)]
pub struct GlobeMesh {
    posts: GlobePosts,
    diagonal: Diagonal,
    /// All triangles, once somebody has asked for them.
    tin: OnceLock<Tin>,
    /// The lowest and the highest post.
    heights: (f64, f64),
}

/// What stands in a row of the lattice.
pub(super) enum RowOf {
    /// A row of posts, by its number among them.
    Posts(usize),
    /// The southern pole (0), or the northern one (1).
    Pole(usize),
}

impl GlobeMesh {
    /// A globe over some posts.
    ///
    /// # Errors
    /// When there are too many to number, they make no triangle, or one is out of all bounds.
    pub(super) fn new(posts: GlobePosts, diagonal: Diagonal) -> Result<Self> {
        let known = posts.posts.heights().iter().chain(posts.poles.iter().flatten());
        let heights = known.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &height| {
            (math::min(height, low), math::max(height, high))
        });
        check(&posts, diagonal, heights)?;
        Ok(Self { posts, diagonal, tin: OnceLock::new(), heights })
    }

    /// All its triangles.
    #[inline]
    pub(super) fn tin(&self) -> &Tin {
        self.tin.get_or_init(|| {
            let (vertices, triangles) = surface(&self.posts, self.diagonal);
            Tin::by_place(vertices, triangles)
        })
    }

    /// Bytes held, with the triangles if there are any so far.
    pub(super) fn bytes(&self) -> usize {
        self.tin.get().map_or(0, Tin::bytes) + size_of_val(self.posts.posts.heights())
    }

    /// The posts.
    pub fn posts(&self) -> &GlobePosts {
        &self.posts
    }

    pub(super) fn diagonal(&self) -> Diagonal {
        self.diagonal
    }

    pub(super) fn plan_bounds(&self) -> PlanBox {
        self.posts.plan_bounds()
    }

    /// The lowest and the highest post, above the ellipsoid.
    pub(super) fn heights(&self) -> (f64, f64) {
        self.heights
    }

    /// The smaller side of its cells in the plan.
    pub(super) fn resolution(&self) -> f64 {
        math::min(self.posts.posts.east().length(), self.posts.posts.north().length())
    }

    /// Columns and rows of the lattice.
    pub fn size(&self) -> [usize; 2] {
        lattice_size(&self.posts)
    }

    /// Whether its first and its last row are at a pole.
    pub fn poles(&self) -> [bool; 2] {
        self.posts.poles.map(|height| height.is_some())
    }

    /// What stands in a row of the lattice.
    pub(super) fn row(&self, row: usize) -> RowOf {
        let [south, _] = self.poles();
        match row.checked_sub(usize::from(south)) {
            None => RowOf::Pole(0),
            Some(row) if row < self.posts.posts.rows() => RowOf::Posts(row),
            Some(_) => RowOf::Pole(1),
        }
    }

    /// A row's y in the plan.
    pub fn y_of(&self, row: usize) -> f64 {
        match self.row(row) {
            RowOf::Posts(row) => self.posts.posts.plan(0, row).y,
            RowOf::Pole(pole) => self.posts.pole_rows()[pole],
        }
    }

    /// The height of a post; NaN where there is none.
    pub(super) fn height(&self, [column, row]: Post) -> f64 {
        let (column, row, [columns, rows]) = (column as usize, row as usize, self.size());
        let own = self.posts.posts.columns();
        match self.row(row) {
            _ if column >= columns || row >= rows => f64::NAN,
            RowOf::Posts(row) => self.posts.posts.heights()[row * own + column % own],
            RowOf::Pole(pole) => self.posts.poles[pole].unwrap_or(f64::NAN),
        }
    }

    /// The vertex of a post that is there; at a pole each column has one.
    pub(super) fn vertex(&self, post: Post) -> SurfaceVertex {
        let (column, row) = (post[0] as usize, post[1] as usize);
        match self.row(row) {
            RowOf::Posts(row) => vertex(&self.posts, column, row),
            RowOf::Pole(pole) => pole_vertex(&self.posts, pole, self.posts.column(column)),
        }
    }

    /// No less than the largest deviation of a triangle of all posts ([`largest_deviation`](super::Mesh::largest_deviation)), without these triangles: a row's cells have
    /// the same shape up to heights, and a deviation is largest where these are as far apart as anywhere in the row.
    pub(super) fn most_deviation(&self, distance: impl Fn(World, Plan) -> f64 + Sync) -> f64 {
        let [columns, rows] = self.size();
        let of_row = |row: usize| {
            let (low, high, most) = self.heights_of_cells(row);
            let ends = [low, math::max(high - most, low)];
            let cells = [0, 1, columns - 2].map(|i| i.min(columns - 2));
            let halves = cells.into_iter().flat_map(|i| [false, true].map(|second| (i, second)));
            let of_half = |(i, second): (usize, bool)| {
                let corners = half_corners(splits_sw_ne(self.diagonal, i, row), second);
                let posts = corners.map(|(di, dj)| [(i + di) as u32, (row + dj) as u32]);
                let heights =
                    (0..16).map(|k| [0, 1, 2].map(|bit| ends[k & 1] + most * (k >> (bit + 1) & 1) as f64));
                let off = heights.map(|heights| self.deviation(posts, heights, &distance));
                off.fold(0.0, math::max)
            };
            if most >= 0.0 { halves.map(of_half).fold(0.0, math::max) } else { 0.0 }
        };
        // Places are linear in heights but for a share that is far smaller.
        parallel::map_indices(rows - 1, of_row).into_iter().fold(0.0, math::max) * 1.001
    }

    /// Over the cells between a row and the next: the lowest and the highest post, and the most that two of a cell differ; less than 0 where there is none.
    fn heights_of_cells(&self, row: usize) -> (f64, f64, f64) {
        let own = self.posts.posts.columns();
        let line = |row: usize| {
            let of_pole =
                |pole: usize| std::borrow::Cow::from(vec![self.posts.poles[pole].unwrap_or(f64::NAN); own]);
            match self.row(row) {
                RowOf::Posts(row) => self.posts.posts.heights()[row * own..(row + 1) * own].into(),
                RowOf::Pole(pole) => of_pole(pole),
            }
        };
        let (south, north) = (line(row), line(row + 1));
        let mut all = (f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY);
        let cell = |i: usize, next: usize| {
            let (s, n) = ([south[i], south[next]], [north[i], north[next]]);
            let fold = |f: fn(f64, f64) -> f64, start: f64| f(s[0], f(s[1], f(n[0], f(n[1], start))));
            (fold(math::min, f64::INFINITY), fold(math::max, f64::NEG_INFINITY))
        };
        let mut take = |(low, high): (f64, f64)| {
            all = (math::min(low, all.0), math::max(high, all.1), math::max(high - low, all.2));
        };
        (1..own).for_each(|i| take(cell(i - 1, i)));
        if self.posts.is_closed {
            take(cell(own - 1, 0));
        }
        all
    }

    /// The deviation of the triangle of some posts if they were so high.
    fn deviation(&self, posts: [Post; 3], heights: [f64; 3], distance: &impl Fn(World, Plan) -> f64) -> f64 {
        let places =
            posts.map(|[column, row]| Plan::new(self.posts.column(column as usize), self.y_of(row as usize)));
        let at_pole = posts.map(|[_, row]| matches!(self.row(row as usize), RowOf::Pole(_)));
        // Of two corners at a pole there is no triangle; one alone is between the others.
        let places = match at_pole.iter().filter(|is| **is).count() {
            0 => places,
            1 => [0, 1, 2].map(|k| {
                let between = 0.5 * (places[(k + 1) % 3].x + places[(k + 2) % 3].x);
                if at_pole[k] { Plan::new(between, places[k].y) } else { places[k] }
            }),
            _ => return 0.0,
        };
        let world = [0, 1, 2].map(|k| self.posts.globe.world(places[k], heights[k]).to_vec());
        let middle = places.map(|place| place.to_vec()).iter().sum::<glam::DVec2>() / 3.0;
        distance(World::from(world.iter().sum::<DVec3>() / 3.0), Plan::from(middle))
    }

    /// The vertex at a pole of a triangle whose other corners stand in two columns: at the longitude between them.
    pub(super) fn pole_between(&self, row: u32, columns: [u32; 2]) -> SurfaceVertex {
        let [west, east] = columns.map(|column| self.posts.column(column as usize));
        pole_vertex(&self.posts, usize::from(row > 0), 0.5 * (west + east))
    }
}

fn lattice_size(posts: &GlobePosts) -> [usize; 2] {
    let poles = posts.poles.iter().flatten().count();
    [posts.posts.columns() + usize::from(posts.is_closed), posts.posts.rows() + poles]
}

/// The vertex of a post, of those of a full circle also behind the last column.
fn vertex(posts: &GlobePosts, i: usize, j: usize) -> SurfaceVertex {
    let own = posts.posts.columns();
    let at = posts.posts.plan(i % own, j);
    let height = posts.posts.heights()[j * own + i % own];
    SurfaceVertex {
        world: if height.is_nan() { World::default() } else { posts.globe.world(at, height) },
        plan: Plan::new(posts.column(i), at.y),
        up: posts.globe.up(at),
    }
}

/// A vertex at a pole that the surface reaches, at a place x of the plan.
fn pole_vertex(posts: &GlobePosts, pole: usize, x: f64) -> SurfaceVertex {
    let (y, height) = (posts.pole_rows()[pole], posts.poles[pole].unwrap_or_default());
    let at = Plan::new(posts.posts.first.x, y);
    SurfaceVertex { world: posts.globe.world(at, height), plan: Plan::new(x, y), up: posts.globe.up(at) }
}

/// Refuses what is no surface.
fn check(posts: &GlobePosts, diagonal: Diagonal, (low, high): (f64, f64)) -> Result<()> {
    let (own, rows) = (posts.posts.columns(), posts.posts.rows());
    let [columns, _] = lattice_size(posts);
    if (columns * (rows + 2)) as u64 * 2 >= u64::from(u32::MAX) {
        return Err(Error::unsupported(format!(
            "{own} x {rows} posts are more than this program can number"
        ))
        .help("give the terrain a `window`"));
    }
    let exists = |i: usize, j: usize| !posts.posts.heights()[j * own + i % own].is_nan();
    let mut cells = (0..rows - 1).flat_map(|j| (0..columns - 1).map(move |i| (i, j)));
    let is_pole = |pole: usize, j: usize| {
        posts.poles[pole].is_some() && (0..columns - 1).any(|i| exists(i, j) && exists(i + 1, j))
    };
    if !cells.any(|at| halves(posts, diagonal, at).next().is_some())
        && !is_pole(0, 0)
        && !is_pole(1, rows - 1)
    {
        return Err(Error::new("a surface of 0 triangles cannot be drawn")
            .help("at least three posts of a cell need a height"));
    }
    // No coordinate is more than twice as large.
    let reach =
        posts.globe.ellipsoid.a + posts.globe.world_origin.length() + math::max(low.abs(), high.abs());
    if !(4.0 * reach).is_finite() {
        return Err(Error::new(format!("heights from {low} to {high} m are out of all bounds"))
            .help("give finite coordinates: no height beyond 1e300 m"));
    }
    Ok(())
}

/// The halves of a cell between rows of posts whose posts are there, as offsets from its south-western post.
fn halves(
    posts: &GlobePosts,
    diagonal: Diagonal,
    (i, j): (usize, usize),
) -> impl Iterator<Item = [(usize, usize); 3]> + '_ {
    // A row at the southern pole is the lattice's first.
    let (own, south) = (posts.posts.columns(), usize::from(posts.poles[0].is_some()));
    let exists =
        move |(di, dj): (usize, usize)| !posts.posts.heights()[(j + dj) * own + (i + di) % own].is_nan();
    let both = [false, true].map(|second| half_corners(splits_sw_ne(diagonal, i, j + south), second));
    both.into_iter().filter(move |corners| corners.iter().all(|corner| exists(*corner)))
}

/// The vertices and triangles of a surface over a globe, triangles counter-clockwise in the plan.
fn surface(posts: &GlobePosts, diagonal: Diagonal) -> (Vec<SurfaceVertex>, Vec<[u32; 3]>) {
    let (own, rows) = (posts.posts.columns(), posts.posts.rows());
    let [columns, _] = lattice_size(posts);
    let exists = |i: usize, j: usize| !posts.posts.heights()[j * own + i % own].is_nan();
    let number = |i: usize, j: usize| (j * columns + i) as u32;
    let mut vertices: Vec<SurfaceVertex> =
        (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j))).map(|(i, j)| vertex(posts, i, j)).collect();
    let mut triangles = Vec::with_capacity(2 * columns * rows);
    for (i, j) in (0..rows - 1).flat_map(|j| (0..columns - 1).map(move |i| (i, j))) {
        let cell = halves(posts, diagonal, (i, j));
        triangles.extend(cell.map(|corners| corners.map(|(di, dj)| number(i + di, j + dj))));
    }
    for pole in (0..2).filter(|pole| posts.poles[*pole].is_some()) {
        let is_north = pole == 1;
        let row = if is_north { rows - 1 } else { 0 };
        for i in (0..columns - 1).filter(|i| exists(*i, row) && exists(i + 1, row)) {
            let (west, east, at_pole) = (number(i, row), number(i + 1, row), vertices.len() as u32);
            let between = 0.5 * (posts.column(i) + posts.column(i + 1));
            vertices.push(pole_vertex(posts, pole, between));
            triangles.push(if is_north { [west, east, at_pole] } else { [east, west, at_pole] });
        }
    }
    (vertices, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Posts;
    use crate::space::{Ellipsoid, Globe};
    use glam::{DVec2, DVec3};
    use std::collections::BTreeMap;

    /// A world of so many posts around, and rows without the poles.
    fn world(
        columns: usize,
        rows: usize,
        diagonal: Diagonal,
    ) -> (GlobePosts, Vec<SurfaceVertex>, Vec<[u32; 3]>) {
        let globe = Globe {
            ellipsoid: Ellipsoid { a: 1000.0, f: 0.1 },
            plan_origin: DVec2::ZERO,
            world_origin: DVec3::ZERO,
        };
        let step = globe.turn() / columns as f64;
        let first = Plan::new(-0.5 * globe.turn(), -0.5 * step * (rows - 1) as f64);
        let heights = (0..columns * rows).map(|k| (k % 7) as f64).collect();
        let steps = (DVec2::X * step, DVec2::Y * step);
        let posts = Posts::new((columns, rows), first, steps, heights).unwrap();
        let posts = GlobePosts { posts, globe, is_closed: true, poles: [Some(-3.0), Some(5.0)] };
        let (vertices, triangles) = surface(&posts, diagonal);
        (posts, vertices, triangles)
    }

    #[test]
    fn a_world_is_closed_and_faces_outwards() {
        for diagonal in [Diagonal::SwNe, Diagonal::NwSe, Diagonal::Alternating] {
            let (posts, vertices, triangles) = world(12, 5, diagonal);
            assert_eq!(triangles.len(), 12 * 4 * 2 + 2 * 12);
            // Vertices are the same where their points of the world are, to the bit.
            let bits = |v: u32| vertices[v as usize].world.to_vec().to_array().map(f64::to_bits);
            let mut edges = BTreeMap::new();
            for corners in &triangles {
                let [a, b, c] = corners.map(|v| vertices[v as usize]);
                let normal = (b.world - a.world).cross(c.world - a.world);
                assert!(normal.dot(a.world.to_vec() + b.world.to_vec() + c.world.to_vec()) > 0.0);
                assert!((b.plan - a.plan).perp_dot(c.plan - a.plan) > 0.0);
                for (from, to) in [(0, 1), (1, 2), (2, 0)] {
                    let (from, to) = (bits(corners[from]), bits(corners[to]));
                    *edges.entry((from, to)).or_insert(0) += 1;
                }
            }
            for ((from, to), count) in &edges {
                assert_eq!(
                    (*count, edges.get(&(*to, *from))),
                    (1, Some(&1)),
                    "an edge has one triangle on each side"
                );
            }
            let bounds = posts.plan_bounds();
            assert!((bounds.max.x - bounds.min.x - posts.globe.turn()).abs() < 1e-9);
            assert!((bounds.max.y - bounds.min.y - 0.5 * posts.globe.turn()).abs() < 1e-9);
            assert!(vertices.iter().all(|v| v.plan.x >= bounds.min.x && v.plan.x <= bounds.max.x));
        }
    }

    #[test]
    fn vertices_lie_over_their_places() {
        let (posts, vertices, _) = world(8, 3, Diagonal::SwNe);
        for vertex in &vertices {
            assert!((vertex.up.length() - 1.0).abs() < 1e-15);
            let is_pole = vertex.plan.y.abs() > 0.249 * posts.globe.turn();
            assert!(is_pole || posts.globe.distance_on_the_ground(vertex.world, vertex.plan) < 1e-9);
        }
    }

    #[test]
    fn what_has_no_height_has_no_triangle() {
        let (mut posts, _, all) = world(8, 4, Diagonal::SwNe);
        posts.posts.heights_mut()[0] = f64::NAN;
        let (vertices, triangles) = surface(&posts, Diagonal::SwNe);
        assert!(vertices.iter().all(|vertex| vertex.world.is_finite()));
        // The first post is at the seam: of the cells at both ends, and of two at the pole.
        assert!(triangles.len() + 4 <= all.len() && triangles.len() + 6 >= all.len());
        posts.poles = [None, None];
        let (_, open) = surface(&posts, Diagonal::SwNe);
        assert_eq!(open.len() + 6 + 8, triangles.len());
    }
}
