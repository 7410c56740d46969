//! The terrain as tables of vertices and triangles.

use crate::buffer::{Plane, Values};
use crate::terrain::{Drape, Mesh, SKY};

/// The vertices, a row each: x, y, z in scene-local metres; those of posts without data are as high as 0.
pub fn vertices(mesh: &Mesh) -> Plane {
    let height = |z: f64| if z.is_nan() { 0.0 } else { z };
    let places = mesh.vertices().map(|vertex| vertex.world);
    let values: Vec<f64> = places.flat_map(|p| [p.x, p.y, height(p.z)]).collect();
    Plane { name: "vertices", width: 3, height: values.len() / 3, components: 1, values: Values::F64(values) }
}

/// The vertices' places in the plan, a row each: x, y, scene-local; `None` where each vertex lies straight over its own.
pub fn plan_points(mesh: &Mesh) -> Option<Plane> {
    if mesh.drape() == Drape::Vertical {
        return None;
    }
    let values: Vec<f64> = mesh.vertices().flat_map(|vertex| [vertex.plan.x, vertex.plan.y]).collect();
    let height = values.len() / 2;
    Some(Plane { name: "plan", width: 2, height, components: 1, values: Values::F64(values) })
}

/// The triangles, a row each in the order of their numbers: three vertices' numbers, counter-clockwise in plan; three times
/// [`SKY`] where there is a hole.
pub fn triangles(mesh: &Mesh) -> Plane {
    let values: Vec<u32> =
        (0..mesh.triangle_ids()).flat_map(|id| mesh.corners(id).unwrap_or([SKY; 3])).collect();
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
    use crate::terrain::SurfaceVertex;
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
    fn vertices_that_do_not_lie_over_their_plan_points_have_a_table_of_these() {
        let mesh = scattered();
        assert!(plan_points(&mesh).is_none());
        let triangles = (0..mesh.triangle_ids()).filter_map(|id| mesh.corners(id)).collect();
        let leaning = mesh.vertices().map(|vertex| SurfaceVertex {
            plan: Plan::new(vertex.world.x + vertex.world.z, vertex.world.y),
            ..vertex
        });
        let plan = plan_points(&Mesh::of_surface(leaning.collect(), triangles).unwrap()).unwrap();
        assert_eq!((plan.width, plan.height), (2, 5));
        assert_eq!(plan.values, Values::F64(vec![0.0, 0.0, 10.0, 1.0, 6.0, 8.0, 8.0, 3.0, 2.0, 6.0]));
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
