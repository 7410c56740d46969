//! What a technique sees, whichever machine is imitated.

use super::hit::on_plane;
use super::{Hit, Machine, Visible, hit};
use crate::predicate::{TrianglePlane, quick_hit_parameter};
use crate::raster::device::PolygonOffset;
use crate::raster::{Counts, Lattice};
use crate::scene::Device;
use crate::space::{Plan, ViewFrame, World};
use crate::terrain::{Drape, Mesh, PlanMap, SKY, TriangleDrape};

/// The triangle and the surface point of each sample of a lattice: exact, or as a [`Device`] finds them.
///
/// ```
/// # use drapery::{raster::Lattice, scene::{Device, Precision}, space::ViewFrame, terrain::Mesh, visibility::Sight};
/// fn heights(frame: &ViewFrame, mesh: &Mesh, device: &Device) -> Vec<Option<f64>> {
///     let lattice = Lattice::centres(frame, 0);
///     let mut sight = Sight::new(frame, mesh, device, lattice, 128);
///     sight.see();
///     (0..lattice.columns).map(|c| sight.hit(c, 0).map(|hit| hit.world.z)).collect()
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

    /// The same with a polygon offset: an imitated machine moves back what it stores, and with it where that is. (Exact mathematics stores nothing.)
    #[must_use]
    pub fn with_polygon_offset(mut self, offset: PolygonOffset) -> Self {
        self.machine = self.machine.map(|machine| machine.with_polygon_offset(offset));
        self
    }

    /// Finds what each sample sees.
    pub fn see(&mut self) {
        if let Some(machine) = &self.machine {
            machine.see(&mut self.visible, self.mesh);
            self.stored = self.visible.keys();
        } else {
            self.visible.see(self.frame, self.mesh);
        }
        self.visible.write_triangles(&mut self.ids);
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

    /// The depth buffer's content at a sample; `None` where no machine is imitated.
    pub fn stored(&self, column: usize, row: usize) -> Option<f32> {
        self.machine.as_ref().map(|_| self.stored[row * self.visible.lattice.columns + column])
    }

    /// The imitated machine, if any.
    pub fn machine(&self) -> Option<&Machine> {
        self.machine.as_ref()
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
        let (at, triangle) = (self.visible.lattice.at(column, row), self.mesh.surface_triangle(id)?);
        match &self.machine {
            None => Some(hit(self.frame, &self.frame.ray(at), &triangle)),
            Some(machine) => {
                machine.hit(at, self.stored[row * self.visible.lattice.columns + column], &triangle)
            }
        }
    }

    /// The plan points of a row of samples, infinite where the sky is seen; the same as those of [`Sight::hit`].
    pub fn plan_of_row(&self, row: usize, plan: &mut [Plan], planes: &mut Planes) {
        match self.mesh.drape() {
            Drape::Vertical => self.points_of_row((0, row), plan, planes),
            Drape::Affine => self.draped_row(row, plan, planes),
        }
    }

    /// As [`Sight::plan_of_row`], of a mesh with plan points of its own.
    fn draped_row(&self, row: usize, plan: &mut [Plan], planes: &mut Planes) {
        let sky = Plan::new(f64::INFINITY, f64::INFINITY);
        let of_hit = |column| self.hit(column, row).map_or(sky, |hit| hit.plan);
        if self.machine.is_some() {
            plan.iter_mut().enumerate().for_each(|(column, to)| *to = of_hit(column));
            return;
        }
        let mut world = vec![World::default(); plan.len()];
        self.world_of_row((0, row), &mut world, planes);
        let start = row * self.visible.lattice.columns;
        let mut column = 0;
        for run in self.ids[start..start + plan.len()].chunk_by(|a, b| a == b) {
            let map = self.map_of(run[0]);
            for k in column..column + run.len() {
                plan[k] = map.map_or_else(|| of_hit(k), |map| map.at(world[k]));
            }
            column += run.len();
        }
    }

    /// The map of a triangle with plan points of its own, if it is precise.
    fn map_of(&self, id: u32) -> Option<PlanMap> {
        let triangle = if id == SKY { None } else { self.mesh.surface_triangle(id) }?;
        match &triangle.drape {
            TriangleDrape::Vertical => None,
            TriangleDrape::Affine { plan, .. } => {
                Some(PlanMap::new(&triangle.world, plan)).filter(PlanMap::is_sure)
            }
        }
    }

    /// The surface points of neighbours in a row from (column, row) on, infinite where the sky is seen; the same as those of
    /// [`Sight::hit`].
    pub fn world_of_row(&self, from: (usize, usize), points: &mut [World], planes: &mut Planes) {
        self.points_of_row(from, points, planes);
    }

    fn points_of_row<P: From<World>>(
        &self,
        (first, row): (usize, usize),
        points: &mut [P],
        planes: &mut Planes,
    ) {
        if self.machine.is_some() {
            let sky = || P::from(nowhere());
            for (k, to) in points.iter_mut().enumerate() {
                *to = self.hit(first + k, row).map_or_else(sky, |hit| P::from(hit.world));
            }
            return;
        }
        let arch = pulp::Arch::new();
        for (k, points) in points.chunks_mut(TOGETHER).enumerate() {
            arch.dispatch(Neighbours { sight: self, at: (first + TOGETHER * k, row), points, planes });
        }
    }

    /// The surface point of a sample on a plane.
    #[cold]
    fn grazing_point(&self, (column, row): (usize, usize)) -> World {
        let ray = self.frame.ray(self.visible.lattice.at(column, row));
        let triangle = self.mesh.triangle(self.triangle(column, row));
        triangle.map_or_else(nowhere, |triangle| on_plane(self.frame, &ray, &TrianglePlane::new(&triangle)).0)
    }

    /// What was done.
    pub fn counts(&self) -> Counts {
        self.visible.counts()
    }
}

/// Where the sky is seen.
fn nowhere() -> World {
    World::new(f64::INFINITY, f64::INFINITY, f64::INFINITY)
}

/// Samples whose points are found together.
const TOGETHER: usize = 64;

/// Planes of triangles that were seen lately: the rows of samples below see many of them again.
#[derive(Debug)]
pub struct Planes {
    /// By the last digits of their triangles' numbers.
    known: Vec<(u32, [f64; 9])>,
}

impl Default for Planes {
    /// None.
    fn default() -> Self {
        Self { known: vec![(SKY, [0.0; 9]); Self::COUNT] }
    }
}

impl Planes {
    const COUNT: usize = 256;

    /// The numbers of a triangle's plane; all 0 for none.
    #[inline(always)]
    fn numbers(&mut self, mesh: &Mesh, id: u32) -> &[f64; 9] {
        // A triangle's number tells little more than its column: neighbours in both directions are to have places of their own.
        let place = &mut self.known[(id ^ id >> 7) as usize % Self::COUNT];
        if place.0 != id {
            *place = (id, Self::made(mesh, id));
        }
        &place.1
    }

    fn made(mesh: &Mesh, id: u32) -> [f64; 9] {
        mesh.triangle(id).map_or([0.0; 9], |triangle| TrianglePlane::new(&triangle).numbers())
    }
}

/// The surface points of up to [`TOGETHER`] neighbours in a row, compiled for the widest vectors of the machine at hand.
struct Neighbours<'a, P> {
    sight: &'a Sight<'a>,
    at: (usize, usize),
    points: &'a mut [P],
    planes: &'a mut Planes,
}

impl<P: From<World>> pulp::WithSimd for Neighbours<'_, P> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { sight, at: (column, row), points, planes } = self;
        let (frame, lattice) = (sight.frame, &sight.visible.lattice);
        let start = row * lattice.columns + column;
        let ids = &sight.ids[start..start + points.len()];
        if ids.iter().all(|id| *id == SKY) {
            return points.fill_with(|| P::from(nowhere()));
        }
        let mut numbers = [[0.0; TOGETHER]; 9];
        let mut own = [0.0; 9];
        let mut last = SKY;
        for (k, id) in ids.iter().enumerate() {
            if *id != last {
                own = if *id == SKY { [0.0; 9] } else { *planes.numbers(sight.mesh, *id) };
                last = *id;
            }
            for (numbers, own) in numbers.iter_mut().zip(own) {
                numbers[k] = own;
            }
        }
        let mut all_sure = true;
        for (k, to) in points.iter_mut().enumerate() {
            let ray = frame.ray(lattice.at(column + k, row));
            let (t, is_sure) = quick_hit_parameter(&ray, &numbers.each_ref().map(|n| n[k]));
            *to = P::from(ray.from + (ray.through - ray.from) * t);
            all_sure &= is_sure;
        }
        if !all_sure {
            // The sky's numbers are not sure of anything, nor are those of planes that are grazed.
            for (k, (to, id)) in points.iter_mut().zip(ids).enumerate() {
                let ray = frame.ray(lattice.at(column + k, row));
                if *id == SKY {
                    *to = P::from(nowhere());
                } else if !quick_hit_parameter(&ray, &numbers.each_ref().map(|n| n[k])).1 {
                    *to = P::from(sight.grazing_point((column + k, row)));
                }
            }
        }
    }
}
