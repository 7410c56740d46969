//! What samples see, and the buffers that show it.

use super::frame::picture_plane;
use crate::buffer::{Plane, Values};
use crate::parallel;
use crate::raster::{Counts, Lattice};
use crate::scene::Device;
use crate::space::{Plan, ViewFrame};
use crate::terrain::Mesh;
use crate::visibility::{Hit, Sight};

/// What the samples of a lattice see, with their plan points at hand.
#[derive(Debug)]
pub struct GBuffer<'a> {
    sight: Sight<'a>,
    /// Rows from the top; infinite where the sky is seen.
    plan: Vec<Plan>,
}

impl<'a> GBuffer<'a> {
    /// Finds what a lattice sees, in tiles of `tile` samples a side.
    pub fn new(view: &'a ViewFrame, mesh: &'a Mesh, device: &Device, lattice: Lattice, tile: usize) -> Self {
        let mut sight = Sight::new(view, mesh, device, lattice, tile);
        sight.see();
        let mut plan = vec![Plan::default(); lattice.columns * lattice.rows];
        parallel::for_each_chunk(&mut plan, lattice.columns, |row, points| sight.plan_of_row(row, points));
        Self { sight, plan }
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

    /// The plan point of a sample, infinite where the sky is seen.
    #[inline(always)]
    pub fn plan(&self, column: usize, row: usize) -> Plan {
        self.plan[row * self.sight.lattice().columns + column]
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
fn inner_rows<T: Send, I: IntoIterator<Item = T>>(
    sight: &Sight,
    guard: usize,
    of: impl Fn(usize, usize) -> I + Send + Sync,
) -> Vec<T> {
    let lattice = sight.lattice();
    let rows = parallel::map_indices(lattice.rows - 2 * guard, |row| {
        (guard..lattice.columns - guard).flat_map(|column| of(column, row + guard)).collect::<Vec<T>>()
    });
    rows.into_iter().flatten().collect()
}

/// What finding out what is seen took, as a frame counts it.
pub fn sight_counts(counts: &Counts) -> [(&'static str, u64); 3] {
    [
        ("triangles_drawn", counts.triangles),
        ("hidden_nodes", counts.hidden_nodes),
        ("exact_decisions", counts.exact_decisions),
    ]
}
