//! What the imitated machine sees (see [`crate::raster::device`]), and what its depth buffer says where that is.
//!
//! Input: a view, a terrain, a [`Device`]. Output: the tiles of [`Visible`], whose keys hold the *depth buffer's content*
//! here: the depth (f32 formats) or the integer (fixed-point formats); the far plane's where nothing was drawn. Every
//! triangle passes through the machine, in order of its number, and only a strictly nearer one replaces another.

use super::{Hit, Visible, VisibleTile};
use crate::index::bins;
use crate::parallel;
use crate::raster::device::{Pipeline, PolygonOffset, Primitive, Real, Window};
use crate::raster::{Counts, Lattice};
use crate::scene::{Device, Precision};
use crate::space::{Screen, ViewFrame, World};
use crate::terrain::{Mesh, SurfaceTriangle, TriangleDrape};

/// Triangles that are transformed at a time.
const CHUNK: u32 = 4096;

/// The machine of a [`Device`], set up for a view of a terrain.
#[derive(Debug, Clone)]
pub enum Machine {
    /// It calculates in single precision.
    Single(Pipeline<f32>),
    /// It calculates in double precision.
    Double(Pipeline<f64>),
}

impl Machine {
    /// Sets the machine up.
    pub fn new(frame: &ViewFrame, mesh: &Mesh, device: &Device) -> Self {
        match device.precision {
            Precision::F32 => Self::Single(Pipeline::new(frame, mesh, device)),
            Precision::F64 => Self::Double(Pipeline::new(frame, mesh, device)),
        }
    }

    /// The machine that moves what it sees back by a polygon offset.
    #[must_use]
    pub fn with_polygon_offset(self, offset: PolygonOffset) -> Self {
        match self {
            Self::Single(pipeline) => Self::Single(pipeline.with_polygon_offset(offset)),
            Self::Double(pipeline) => Self::Double(pipeline.with_polygon_offset(offset)),
        }
    }

    /// Finds what each sample sees.
    pub fn see(&self, visible: &mut Visible, mesh: &Mesh) {
        match self {
            Self::Single(pipeline) => see_through(pipeline, visible, mesh),
            Self::Double(pipeline) => see_through(pipeline, visible, mesh),
        }
    }

    /// Calls `visit` with what a triangle that leaves the depth buffer alone covers of a window of the lattice: column and
    /// row, its facing (1: its corners run counter-clockwise as they are seen, else -1) and what it would store as depth.
    /// `is_clamped`: neither the near nor the far plane clips it (NV_depth_clamp).
    pub fn rasterize(
        &self,
        triangle: &[World; 3],
        is_clamped: bool,
        place: (&Lattice, &Window),
        visit: &mut dyn FnMut((usize, usize), i32, f32),
    ) {
        match self {
            Self::Single(pipeline) => pipeline.rasterize(triangle, is_clamped, place, visit),
            Self::Double(pipeline) => pipeline.rasterize(triangle, is_clamped, place, visit),
        }
    }

    /// The depth test.
    pub fn passes(&self, new: f32, old: f32) -> bool {
        match self {
            Self::Single(pipeline) => pipeline.depth().passes(new, old),
            Self::Double(pipeline) => pipeline.depth().passes(new, old),
        }
    }

    /// The surface point that the depth buffer's content means at a screen point where a triangle was drawn, by the inverse
    /// matrix (She 3.2); `None` where the machine's arithmetic finds no point before the eye. Where the triangle is not draped
    /// vertically no matrix leads to the plan: its plan point is interpolated.
    pub fn hit(&self, at: Screen, stored: f32, triangle: &SurfaceTriangle) -> Option<Hit> {
        match self {
            Self::Single(pipeline) => hit_of(pipeline, at, stored, triangle),
            Self::Double(pipeline) => hit_of(pipeline, at, stored, triangle),
        }
    }
}

fn hit_of<T: Real>(
    pipeline: &Pipeline<T>,
    at: Screen,
    stored: f32,
    triangle: &SurfaceTriangle,
) -> Option<Hit> {
    let (world, depth) = pipeline.unproject(at, stored)?;
    let plan = match &triangle.drape {
        TriangleDrape::Vertical => world.plan(),
        TriangleDrape::Affine { plan, .. } => pipeline.plan_at(at, &triangle.world, plan)?,
    };
    Some(Hit { plan, world, depth })
}

fn see_through<T: Real>(pipeline: &Pipeline<T>, visible: &mut Visible, mesh: &Mesh) {
    let lattice = visible.lattice;
    let primitives = primitives(pipeline, mesh, &lattice);
    let windows = parallel::map(&primitives, |primitive| primitive.window(&lattice));
    let numbered = (0u32..).zip(&windows);
    let seen = numbered.filter_map(|(k, window)| Some((k, window.as_ref()?)));
    let bins =
        bins(&visible.tiling(), seen.map(|(k, window)| (k, [window.columns.clone(), window.rows.clone()])));
    let mut work: Vec<_> = visible.tiles.iter_mut().enumerate().collect();
    parallel::for_each(&mut work, |(number, tile)| {
        let bin = bins.of(*number);
        pipeline.clear(&mut tile.samples, (tile.width, tile.height));
        let in_tile = bin.iter().map(|&k| &primitives[k as usize]);
        pipeline.draw(in_tile, (&lattice, &window(tile)), &mut tile.samples);
        tile.counts = Counts { triangles: bin.len() as u64, ..Counts::default() };
    });
}

/// All screen triangles in order of their numbers.
fn primitives<T: Real>(pipeline: &Pipeline<T>, mesh: &Mesh, lattice: &Lattice) -> Vec<Primitive<T>> {
    let count = mesh.triangle_ids();
    let chunks = parallel::map_indices(count.div_ceil(CHUNK) as usize, |k| {
        let first = k as u32 * CHUNK;
        pipeline.primitives(mesh, first..count.min(first.saturating_add(CHUNK)), lattice)
    });
    chunks.concat()
}

fn window(tile: &VisibleTile) -> Window {
    Window { columns: tile.column..tile.column + tile.width, rows: tile.row..tile.row + tile.height }
}
