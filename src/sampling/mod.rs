//! Plain supersampling: each pixel the mean of n x n point samples, the way to a right picture that everybody knows.
//!
//! Input: a scene, its terrain, the view and n. Output: [`Sampled`], colours that were not rounded. Refuses: nothing.
//!
//! It is what the truth competes with in a report: it sees by [`crate::visibility`], asks the same
//! footprints, and is parallel over blocks of pixels. Its samples are exact up to the rounding of plan points and strokes' borders; its error is that of
//! replacing an area by points, which nobody can tell without a truth.

mod nearby;

use crate::buffer::Buffer;
use crate::footprint::{Footprints, PixelSize};
use crate::parallel;
use crate::raster::Lattice;
use crate::resolve::{Compositor, GroundPaint, Paint};
use crate::scene::Device;
use crate::space::{Plan, ViewFrame};
use crate::stage::Stage;
use crate::terrain::{Mesh, SKY};
use crate::visibility::Sight;
use nearby::Nearby;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Samples a side of a block that is seen at once.
const BLOCK: usize = 256;

/// A picture of n x n samples a pixel.
#[derive(Debug)]
pub struct Sampled {
    /// RGBA, straight alpha, encoded values 0..=1.
    pub colors: Buffer<[f64; 4]>,
    /// Bytes of the footprints and their index.
    pub structure_bytes: usize,
}

/// Draws a view of a scene with `n` x `n` samples a pixel, at the middles of as many equal squares. `progress` is told the share that is done
/// (0..=1), from any thread.
pub fn sample(stage: &Stage, view: &ViewFrame, n: usize, progress: &(dyn Fn(f64) + Sync)) -> Sampled {
    let (draw_list, mesh) = (&stage.draw_list, &*stage.mesh_for(view));
    let size = PixelSize::of(view, mesh);
    let bounds = mesh.plan_bounds();
    let footprints = Footprints::new(draw_list, size, &|plan| plan.meets(&bounds));
    let sampler = Sampler::new((stage, mesh), view, &footprints, n.max(1));
    let (width, height) = (view.width(), view.height());
    let side = (BLOCK / n.max(1)).max(1);
    let columns = width.div_ceil(side);
    let count = columns * height.div_ceil(side);
    let done = AtomicUsize::new(0);
    let blocks = parallel::map_indices(count, |k| {
        let corner = [k % columns * side, k / columns * side];
        let colors = sampler.block(corner, [side.min(width - corner[0]), side.min(height - corner[1])]);
        progress((done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / count as f64);
        colors
    });
    let mut colors = vec![[0.0; 4]; width * height];
    for (k, block) in blocks.into_iter().enumerate() {
        let corner = [k % columns * side, k / columns * side];
        let of_row = side.min(width - corner[0]);
        for (r, row) in block.chunks_exact(of_row).enumerate() {
            let to = (corner[1] + r) * width + corner[0];
            colors[to..to + of_row].copy_from_slice(row);
        }
    }
    Sampled { colors: Buffer::from_values(width, height, colors), structure_bytes: footprints.bytes() }
}

/// What stays the same for all pixels.
struct Sampler<'a> {
    mesh: &'a Mesh,
    view: &'a ViewFrame,
    footprints: &'a Footprints<'a>,
    n: usize,
    compositor: Compositor,
    ground: GroundPaint<'a>,
    /// The paint of each style of items.
    paints: Vec<Paint>,
    sky: Paint,
}

/// What the samples of some pixels see.
struct Seen<'a> {
    sight: Sight<'a>,
    plan: Vec<Plan>,
    columns: usize,
}

impl<'a> Sampler<'a> {
    fn new(
        (stage, mesh): (&'a Stage, &'a Mesh),
        view: &'a ViewFrame,
        footprints: &'a Footprints<'a>,
        n: usize,
    ) -> Self {
        let Stage { scene, draw_list, .. } = stage;
        let compositor = Compositor::new(scene.compositing);
        Self {
            mesh,
            view,
            footprints,
            n,
            compositor,
            ground: GroundPaint::new(&scene.ground, mesh, compositor),
            paints: draw_list.styles().iter().map(|style| compositor.paint(style.paint)).collect(),
            sky: compositor.paint(scene.image.background),
        }
    }

    /// The colours of a rectangle of pixels, rows from the top.
    fn block(&self, corner: [usize; 2], size: [usize; 2]) -> Vec<[f64; 4]> {
        let seen = self.see(corner, size);
        let mut nearby = Nearby::default();
        let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y]));
        pixels.map(|pixel| self.compositor.encoded(self.pixel(&seen, pixel, &mut nearby))).collect()
    }

    /// What the samples of a rectangle of pixels see.
    fn see(&self, corner: [usize; 2], size: [usize; 2]) -> Seen<'a> {
        let step = 1.0 / self.n as f64;
        let (columns, rows) = (size[0] * self.n, size[1] * self.n);
        let (x, y) = (corner[0] as f64 + 0.5 * step, corner[1] as f64 + 0.5 * step);
        let lattice = Lattice { x, y, step, columns, rows };
        let mut sight = Sight::new(self.view, self.mesh, &Device::default(), lattice, BLOCK);
        sight.see();
        let mut plan = vec![Plan::default(); columns * rows];
        for (row, points) in plan.chunks_exact_mut(columns).enumerate() {
            sight.plan_of_row(row, points);
        }
        Seen { sight, plan, columns }
    }

    /// The mean paint of a pixel's samples.
    fn pixel(&self, seen: &Seen, [x, y]: [usize; 2], nearby: &mut Nearby) -> Paint {
        let n = self.n;
        let samples = (y * n..(y + 1) * n).flat_map(|r| (x * n..(x + 1) * n).map(move |c| [c, r]));
        let points = samples.map(|at| seen.plan_at(at)).filter(|at| at.is_finite());
        let has_all = nearby.find(self.footprints, points);
        let mut sum = Paint::CLEAR;
        for r in y * n..(y + 1) * n {
            // Rows are summed first: fewer roundings.
            let mut of_row = Paint::CLEAR;
            for c in x * n..(x + 1) * n {
                if !has_all {
                    // The samples lie far apart: each has its own neighbourhood.
                    nearby.find_all(self.footprints, seen.plan_at([c, r]));
                }
                of_row = of_row.plus(self.paint(seen, [c, r], nearby));
            }
            sum = sum.plus(of_row);
        }
        sum.divided_by((n * n) as f64)
    }

    /// The composed paint of a sample.
    fn paint(&self, seen: &Seen, [column, row]: [usize; 2], nearby: &Nearby) -> Paint {
        let (id, plan) = (seen.sight.triangle(column, row), seen.plan_at([column, row]));
        if id == SKY || !plan.is_finite() {
            return self.sky;
        }
        let from_eye =
            || seen.sight.hit(column, row).map_or(0.0, |hit| (hit.world - self.view.eye()).length());
        let holding =
            nearby.items().iter().filter(|item| nearby.holds(self.footprints, item, (plan, &from_eye)));
        holding.fold(self.ground.at(id, plan), |below, item| {
            let style = self.footprints.list().items()[item.number as usize].style;
            self.compositor.over(below, self.paints[style as usize])
        })
    }
}

impl Seen<'_> {
    fn plan_at(&self, [column, row]: [usize; 2]) -> Plan {
        self.plan[row * self.columns + column]
    }
}

#[cfg(test)]
mod tests;
