//! What a technique sees, whichever machine is imitated.

use super::hit::hit_plane;
use super::{Hit, Machine, Visible, hit};
use crate::predicate::TrianglePlane;
use crate::raster::{Counts, Lattice};
use crate::scene::Device;
use crate::space::{Plan, ViewFrame};
use crate::terrain::{Mesh, SKY};

/// The triangle and the surface point of each sample of a lattice: exact, or as a [`Device`] finds them.
///
/// ```
/// # use drapery::{raster::Lattice, scene::{Device, Precision}, space::ViewFrame, terrain::Mesh, visibility::Sight};
/// fn heights(frame: &ViewFrame, mesh: &Mesh, device: &Device) -> Vec<Option<f64>> {
///     let lattice = Lattice::centres(frame, 0);
///     let mut sight = Sight::new(frame, mesh, device, lattice, 128);
///     sight.see();
///     (0..lattice.columns).map(|c| sight.hit(c, 0).map(|hit| hit.height)).collect()
/// }
/// ```
#[derive(Debug)]
pub struct Sight<'a> {
    frame: &'a ViewFrame,
    mesh: &'a Mesh,
    /// `None`: exact.
    machine: Option<Machine>,
    visible: Visible,
    /// Triangles of all samples, rows from the top: what every pixel asks for lies in one place.
    ids: Vec<u32>,
    /// The depth buffer's content, where there is a machine.
    stored: Vec<f32>,
}

impl<'a> Sight<'a> {
    /// Room for a lattice, in tiles of `tile` samples a side; all is sky until [`Sight::see`].
    pub fn new(frame: &'a ViewFrame, mesh: &'a Mesh, device: &Device, lattice: Lattice, tile: usize) -> Self {
        Self {
            frame,
            mesh,
            machine: (!device.is_exact()).then(|| Machine::new(frame, mesh, device)),
            visible: Visible::new(&lattice, tile),
            ids: vec![SKY; lattice.columns * lattice.rows],
            stored: Vec::new(),
        }
    }

    /// Finds what each sample sees.
    pub fn see(&mut self) {
        if let Some(machine) = &self.machine {
            machine.see(&mut self.visible, self.mesh);
            self.stored = self.visible.keys();
        } else {
            self.visible.see(self.frame, self.mesh);
        }
        self.ids = self.visible.triangles();
    }

    /// The lattice.
    pub fn lattice(&self) -> &Lattice {
        &self.visible.lattice
    }

    /// The triangle of a sample, [`SKY`] for none.
    #[inline(always)]
    pub fn triangle(&self, column: usize, row: usize) -> u32 {
        self.ids[row * self.visible.lattice.columns + column]
    }

    /// The triangles of all samples, rows from the top.
    pub fn triangles(&self) -> &[u32] {
        &self.ids
    }

    /// The surface point of a sample; `None`: sky, or a depth that means no point before the eye.
    #[inline]
    pub fn hit(&self, column: usize, row: usize) -> Option<Hit> {
        let id = self.triangle(column, row);
        if id == SKY {
            return None;
        }
        let at = self.visible.lattice.at(column, row);
        match &self.machine {
            None => Some(hit(self.frame, &self.frame.ray(at), &self.mesh.triangle(id)?)),
            Some(machine) => machine.hit(at, self.stored[row * self.visible.lattice.columns + column]),
        }
    }

    /// The plan points of a row of samples, infinite where the sky is seen; the same as those of [`Sight::hit`].
    pub fn plan_of_row(&self, row: usize, plan: &mut [Plan]) {
        let sky = Plan::new(f64::INFINITY, f64::INFINITY);
        if self.machine.is_some() {
            for (column, to) in plan.iter_mut().enumerate() {
                *to = self.hit(column, row).map_or(sky, |hit| hit.plan);
            }
            return;
        }
        // Neighbours often see the same triangle: its plane is made once.
        let columns = self.visible.lattice.columns;
        let ids = &self.ids[row * columns..(row + 1) * columns];
        let mut column = 0;
        for run in ids.chunk_by(|a, b| a == b) {
            let points = &mut plan[column..column + run.len()];
            let triangle = if run[0] == SKY { None } else { self.mesh.triangle(run[0]) };
            match triangle {
                None => points.fill(sky),
                Some(triangle) => self.plan_of_run((column, row), &TrianglePlane::new(&triangle), points),
            }
            column += run.len();
        }
    }

    /// The plan points of neighbours in a row that see one plane.
    fn plan_of_run(&self, (column, row): (usize, usize), plane: &TrianglePlane, points: &mut [Plan]) {
        let (frame, lattice) = (self.frame, &self.visible.lattice);
        let run = Run { frame, lattice, column, row, plane, points };
        if !pulp::Arch::new().dispatch(run) {
            for (k, to) in points.iter_mut().enumerate() {
                *to = hit_plane(frame, &frame.ray(lattice.at(column + k, row)), plane).plan;
            }
        }
    }

    /// What was done.
    pub fn counts(&self) -> Counts {
        self.visible.counts()
    }
}

/// The plan points of neighbours that see one plane, as [`super::hit()`] computes them; compiled for the widest vectors of the machine
/// at hand. False: one of them is not precise enough in plain doubles.
struct Run<'a> {
    frame: &'a ViewFrame,
    lattice: &'a Lattice,
    column: usize,
    row: usize,
    plane: &'a TrianglePlane,
    points: &'a mut [Plan],
}

impl pulp::WithSimd for Run<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> bool {
        let mut all_sure = true;
        for (k, to) in self.points.iter_mut().enumerate() {
            let ray = self.frame.ray(self.lattice.at(self.column + k, self.row));
            let (t, is_sure) = self.plane.quick_hit_parameter(&ray);
            let at = ray.from + (ray.through - ray.from) * t;
            *to = at.plan();
            all_sure &= is_sure;
        }
        all_sure
    }
}
