//! Posts over a globe -> vertices along its normals, and triangles: of a cell two, of a column's end at a pole one.
//!
//! - The vertices of both ends of a full circle have the same point of the world, to the bit, and plan points that are a turn apart.
//! - All posts at a pole would be one point. The triangle from two neighbours of the last row to the pole has there the longitude of their
//!   middle.

use super::SurfaceVertex;
use super::grid::{half_corners, splits_sw_ne};
use crate::error::{Error, Result};
use crate::scene::{Diagonal, GlobePosts};
use crate::space::{Plan, World};

/// The vertices and triangles of a surface over a globe, triangles counter-clockwise in the plan.
pub(super) fn surface(posts: &GlobePosts, diagonal: Diagonal) -> Result<(Vec<SurfaceVertex>, Vec<[u32; 3]>)> {
    let (own, rows) = (posts.posts.columns(), posts.posts.rows());
    let columns = own + usize::from(posts.is_closed);
    if (columns * (rows + 2)) as u64 * 2 >= u64::from(u32::MAX) {
        return Err(Error::unsupported(format!(
            "{own} x {rows} posts are more than this program can number"
        ))
        .help("give the terrain a `window`"));
    }
    let vertex = |i: usize, j: usize| {
        let at = posts.posts.plan(i % own, j);
        let height = posts.posts.heights()[j * own + i % own];
        SurfaceVertex {
            world: if height.is_nan() { World::default() } else { posts.globe.world(at, height) },
            plan: Plan::new(posts.column(i), at.y),
            up: posts.globe.up(at),
        }
    };
    let exists = |i: usize, j: usize| !posts.posts.heights()[j * own + i % own].is_nan();
    let number = |i: usize, j: usize| (j * columns + i) as u32;
    let mut vertices: Vec<SurfaceVertex> =
        (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j))).map(|(i, j)| vertex(i, j)).collect();
    let mut triangles = Vec::with_capacity(2 * columns * rows);
    for (i, j) in (0..rows - 1).flat_map(|j| (0..columns - 1).map(move |i| (i, j))) {
        for second in [false, true] {
            let corners = half_corners(splits_sw_ne(diagonal, i, j), second);
            if corners.iter().all(|(di, dj)| exists(i + di, j + dj)) {
                triangles.push(corners.map(|(di, dj)| number(i + di, j + dj)));
            }
        }
    }
    for (side, (height, y)) in posts.poles.into_iter().zip(posts.pole_rows()).enumerate() {
        let Some(height) = height else { continue };
        let is_north = side == 1;
        let row = if is_north { rows - 1 } else { 0 };
        let at = Plan::new(posts.posts.first.x, y);
        let (world, up) = (posts.globe.world(at, height), posts.globe.up(at));
        for i in (0..columns - 1).filter(|i| exists(*i, row) && exists(i + 1, row)) {
            let pole = vertices.len() as u32;
            let between = 0.5 * (posts.column(i) + posts.column(i + 1));
            vertices.push(SurfaceVertex { world, plan: Plan::new(between, y), up });
            let (west, east) = (number(i, row), number(i + 1, row));
            triangles.push(if is_north { [west, east, pole] } else { [east, west, pole] });
        }
    }
    Ok((vertices, triangles))
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
        let (vertices, triangles) = surface(&posts, diagonal).unwrap();
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
        let (mut posts, _, all) = world(8, 4, Diagonal::Alternating);
        posts.posts.heights_mut()[0] = f64::NAN;
        let (vertices, triangles) = surface(&posts, Diagonal::Alternating).unwrap();
        assert!(vertices.iter().all(|vertex| vertex.world.is_finite()));
        // The first post is at the seam: of the cells at both ends, and of two at the pole.
        assert!(triangles.len() + 4 <= all.len() && triangles.len() + 6 >= all.len());
        posts.poles = [None, None];
        let (_, open) = surface(&posts, Diagonal::Alternating).unwrap();
        assert_eq!(open.len() + 6 + 8, triangles.len());
    }
}
