//! The terrain as tables of vertices and triangles.

use crate::buffer::{Plane, Values};
use crate::terrain::{Mesh, SKY};

/// The vertices, a row each: x, y, z in scene-local metres; those of posts without data are as high as 0.
pub fn vertices(mesh: &Mesh) -> Plane {
    let values: Vec<f64> = match mesh {
        Mesh::Grid(grid) => {
            let posts = grid.posts();
            let numbers = (0..posts.rows()).flat_map(|j| (0..posts.columns()).map(move |i| (i, j)));
            let height = |z: f64| if z.is_nan() { 0.0 } else { z };
            numbers.map(|(i, j)| posts.world(i, j)).flat_map(|p| [p.x, p.y, height(p.z)]).collect()
        }
        Mesh::Tin(tin) => tin.vertices().iter().flat_map(|p| [p.x, p.y, p.z]).collect(),
    };
    Plane { name: "vertices", width: 3, height: values.len() / 3, components: 1, values: Values::F64(values) }
}

/// The triangles, a row each in the order of their numbers: three vertices' numbers, counter-clockwise in plan; three times
/// [`SKY`] where there is a hole.
pub fn triangles(mesh: &Mesh) -> Plane {
    let values: Vec<u32> = match mesh {
        Mesh::Grid(grid) => {
            let columns = grid.posts().columns();
            let numbers = |id: u32| {
                let cell = (id / 2) as usize;
                let (i, j) = (cell % (columns - 1), cell / (columns - 1));
                let corners = grid.half_corners(i, j, id % 2 == 1);
                corners.map(|(di, dj)| ((j + dj) * columns + i + di) as u32)
            };
            let exists = |id: u32| mesh.triangle(id).is_some();
            (0..mesh.triangle_ids()).flat_map(|id| if exists(id) { numbers(id) } else { [SKY; 3] }).collect()
        }
        Mesh::Tin(tin) => tin.triangles().as_flattened().to_vec(),
    };
    Plane {
        name: "triangles",
        width: 3,
        height: values.len() / 3,
        components: 1,
        values: Values::U32(values),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Diagonal, Posts, Surface};
    use crate::space::{Plan, World};
    use glam::DVec2;

    fn with_hole() -> Mesh {
        let heights = (0..12).map(|k| if k == 5 { f64::NAN } else { f64::from(k) * 0.5 }).collect();
        let steps = (DVec2::new(2.0, 0.25), DVec2::new(-0.5, 3.0));
        let posts = Posts::new((4, 3), Plan::new(-7.0, 11.0), steps, heights).unwrap();
        Mesh::new(Surface::Grid(posts), Diagonal::Alternating).unwrap()
    }

    fn scattered() -> Mesh {
        let points = [(0.0, 0.0), (9.0, 1.0), (4.0, 8.0), (5.0, 3.0), (-2.0, 6.0)];
        let points = points.iter().enumerate().map(|(k, &(x, y))| World::new(x, y, k as f64)).collect();
        Mesh::new(Surface::Points(points), Diagonal::default()).unwrap()
    }

    #[test]
    fn the_tables_make_the_mesh_again_with_its_holes() {
        for mesh in [with_hole(), scattered()] {
            let (Values::F64(places), Values::U32(corners)) =
                (vertices(&mesh).values, triangles(&mesh).values)
            else {
                panic!("other types")
            };
            let triangles: Vec<&[u32; 3]> = corners.as_chunks().0.iter().collect();
            assert_eq!(triangles.len(), mesh.triangle_ids() as usize);
            assert!(places.iter().all(|v| v.is_finite()));
            for (id, corners) in triangles.into_iter().enumerate() {
                let place = |v: u32| {
                    World::new(places[3 * v as usize], places[3 * v as usize + 1], places[3 * v as usize + 2])
                };
                let triangle = (*corners != [SKY; 3]).then(|| corners.map(place));
                assert_eq!(triangle, mesh.triangle(id as u32));
            }
        }
    }
}
