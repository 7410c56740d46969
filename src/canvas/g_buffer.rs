//! What samples see, and the buffers that show it.

use super::frame::picture_plane;
use crate::buffer::{Plane, Values};
use crate::parallel;
use crate::raster::{Counts, Lattice};
use crate::scene::Device;
use crate::space::{Plan, ViewFrame};
use crate::terrain::Mesh;
use crate::visibility::{Hit, Planes, Sight};

/// Rows whose plan points are one piece of parallel work.
const ROWS_AT_A_TIME: usize = 16;

/// What the samples of a lattice see, with their plan points at hand.
#[derive(Debug)]
pub struct GBuffer<'a> {
    sight: Sight<'a>,
    columns: usize,
    /// Rows from the top, [`ROWS_AT_A_TIME`] together; infinite where the sky is seen.
    plan: Vec<Vec<Plan>>,
}

impl<'a> GBuffer<'a> {
    /// Finds what a lattice sees, in tiles of `tile` samples a side.
    pub fn new(view: &'a ViewFrame, mesh: &'a Mesh, device: &Device, lattice: Lattice, tile: usize) -> Self {
        let mut sight = Sight::new(view, mesh, device, lattice, tile);
        sight.see();
        let plan = parallel::map_indices(lattice.rows.div_ceil(ROWS_AT_A_TIME), |k| {
            let first = ROWS_AT_A_TIME * k;
            let rows = first..lattice.rows.min(first + ROWS_AT_A_TIME);
            let mut points = vec![Plan::default(); lattice.columns * rows.len()];
            let mut planes = Planes::default();
            for (row, points) in rows.zip(points.chunks_mut(lattice.columns)) {
                sight.plan_of_row(row, points, &mut planes);
            }
            points
        });
        Self { sight, columns: lattice.columns, plan }
    }

    /// What is seen.
    pub fn sight(&self) -> &Sight<'a> {
        &self.sight
    }

    /// The triangle of a sample, [`crate::terrain::SKY`] for none.
    #[inline(always)]
    pub fn triangle(&self, column: usize, row: usize) -> u32 {
        self.sight.triangle(column, row)
    }

    /// The plan points of all samples, rows from the top, infinite where the sky is seen.
    pub fn plan_points(&self) -> impl Iterator<Item = &Plan> {
        self.plan.iter().flatten()
    }

    /// The plan point of a sample, infinite where the sky is seen.
    #[inline(always)]
    pub fn plan(&self, column: usize, row: usize) -> Plan {
        self.plan[row / ROWS_AT_A_TIME][row % ROWS_AT_A_TIME * self.columns + column]
    }
}

/// A buffer of what samples see, all but `guard` columns and rows at each border: `depth`, `plan` (both infinite in the sky) or `triangle`
/// ([`crate::terrain::SKY`] there); `None` for another name.
pub fn surface_plane(name: &str, sight: &Sight, guard: usize) -> Option<Plane> {
    let of_hits = |f: fn(Hit) -> [f64; 2], components: usize| {
        let rows = inner_rows(sight, guard, |column, row| {
            sight.hit(column, row).map_or([f64::INFINITY; 2], f).into_iter().take(components)
        });
        Values::F64(rows)
    };
    let (name, components, values) = match name {
        "depth" => ("depth", 1, of_hits(|hit| [hit.depth; 2], 1)),
        "triangle" => {
            let triangles = inner_rows(sight, guard, |column, row| [sight.triangle(column, row)]);
            ("triangle", 1, Values::U32(triangles))
        }
        "plan" => ("plan", 2, of_hits(|hit| [hit.plan.x, hit.plan.y], 2)),
        _ => return None,
    };
    let lattice = sight.lattice();
    Some(picture_plane(name, [lattice.columns - 2 * guard, lattice.rows - 2 * guard], components, values))
}

/// What each sample within the guard band has, rows from the top.
fn inner_rows<T: Copy + Send, I: IntoIterator<Item = T>>(
    sight: &Sight,
    guard: usize,
    of: impl Fn(usize, usize) -> I + Send + Sync,
) -> Vec<T> {
    let lattice = sight.lattice();
    let rows = parallel::map_indices(lattice.rows - 2 * guard, |row| {
        (guard..lattice.columns - guard).flat_map(|column| of(column, row + guard)).collect::<Vec<T>>()
    });
    rows.concat()
}

/// What finding out what is seen took, as a frame counts it.
pub fn sight_counts(counts: &Counts) -> [(&'static str, u64); 3] {
    [
        ("triangles_drawn", counts.triangles),
        ("hidden_nodes", counts.hidden_nodes),
        ("exact_decisions", counts.exact_decisions),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Diagonal, Posts, Surface};
    use crate::space::{Viewpoint, World};
    use crate::terrain::SKY;
    use glam::{DVec2, DVec3};

    /// A sloped square of 20 x 20 m, seen from the south over its northern rim.
    fn scene() -> (Mesh, ViewFrame) {
        let heights = (0..441).map(|k| f64::from(k % 21)).collect();
        let posts = Posts::new((21, 21), Plan::default(), (DVec2::X, DVec2::Y), heights).unwrap();
        let view = Viewpoint {
            eye: World::new(10.0, -20.0, 15.0),
            target: World::new(10.0, 15.0, 12.0),
            up: DVec3::Z,
            near: 0.1,
            far: f64::INFINITY,
        };
        let frame = ViewFrame::perspective(&view, 50.0, (12, 8)).unwrap();
        (Mesh::new(Surface::Grid(posts), Diagonal::SwNe).unwrap(), frame)
    }

    #[test]
    fn a_guard_band_leaves_the_picture_as_it_is() {
        let (mesh, view) = scene();
        let see = |guard| GBuffer::new(&view, &mesh, &Device::default(), Lattice::centres(&view, guard), 5);
        let (bare, guarded) = (see(0), see(2));
        for name in ["depth", "triangle", "plan"] {
            let plane = surface_plane(name, bare.sight(), 0).unwrap();
            assert_eq!((plane.name, plane.width, plane.height), (name, 12, 8));
            assert_eq!(surface_plane(name, guarded.sight(), 2).unwrap(), plane);
        }
        assert_eq!(surface_plane("color", bare.sight(), 0), None);
    }

    #[test]
    fn planes_say_what_the_samples_see_and_are_infinite_in_the_sky() {
        let (mesh, view) = scene();
        let seen = GBuffer::new(&view, &mesh, &Device::default(), Lattice::centres(&view, 0), 5);
        let plane = |name| surface_plane(name, seen.sight(), 0).unwrap();
        let (Values::F64(depth), Values::U32(triangle), Values::F64(plan)) =
            (plane("depth").values, plane("triangle").values, plane("plan").values)
        else {
            panic!("other kinds of numbers")
        };
        let is_sky = |k: usize| triangle[k] == SKY;
        assert!((0..96).any(is_sky) && !(0..96).all(is_sky));
        for k in 0..96 {
            let at = seen.plan(k % 12, k / 12);
            assert_eq!([plan[2 * k], plan[2 * k + 1]], [at.x, at.y]);
            assert_eq!((depth[k].is_infinite(), at.is_finite()), (is_sky(k), !is_sky(k)));
        }
    }
}
