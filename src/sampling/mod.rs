//! Plain supersampling: each pixel the mean of n x n point samples, the way to a right picture that everybody knows.
//!
//! Input: a scene, its terrain, the view and n. Output: [`Sampled`], colours that were not rounded. Refuses: nothing.
//!
//! It is what the truth competes with in a report: it sees by [`crate::visibility`], asks the same
//! footprints, and is parallel over blocks of pixels. Its samples are exact up to the rounding of plan points and strokes' borders; its error is that of
//! replacing an area by points, which nobody can tell without a truth.

use crate::buffer::Buffer;
use crate::canvas::{Backdrop, GBuffer, LastGround, mean};
use crate::footprint::{Footprints, PixelSize};
use crate::holding::Nearby;
use crate::parallel;
use crate::raster::Lattice;
use crate::resolve::{Paint, Stack};
use crate::scene::Device;
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::terrain::{Mesh, SKY};
use crate::tiling::{TilePlace, Tiling};

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
    let tiling = Tiling::new(width, height, BLOCK / n.max(1));
    let blocks = parallel::map_telling(tiling.count(), progress, |k| sampler.block(&tiling.place(k)));
    let colors = tiling.assembled([0.0; 4], blocks.iter().map(Vec::as_slice));
    Sampled { colors: Buffer::from_values(width, height, colors), structure_bytes: footprints.bytes() }
}

/// What stays the same for all pixels.
struct Sampler<'a> {
    mesh: &'a Mesh,
    view: &'a ViewFrame,
    footprints: &'a Footprints<'a>,
    n: usize,
    backdrop: Backdrop<'a>,
    /// The paint of each style of items.
    paints: Vec<Paint>,
}

impl<'a> Sampler<'a> {
    fn new(
        (stage, mesh): (&'a Stage, &'a Mesh),
        view: &'a ViewFrame,
        footprints: &'a Footprints<'a>,
        n: usize,
    ) -> Self {
        let backdrop = Backdrop::of(&stage.scene, mesh);
        let styles = stage.draw_list.styles().iter();
        let paints = styles.map(|style| backdrop.compositor.paint(style.paint)).collect();
        Self { mesh, view, footprints, n, paints, backdrop }
    }

    /// The colours of a rectangle of pixels, rows from the top.
    fn block(&self, place: &TilePlace) -> Vec<[f64; 4]> {
        let seen = self.see(place);
        let (mut nearby, mut last) = (Nearby::default(), self.backdrop.no_ground());
        let [width, height] = place.size;
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
        let paints = pixels.map(|pixel| self.pixel(&seen, pixel, &mut nearby, &mut last));
        paints.map(|paint| self.backdrop.compositor.encoded(paint)).collect()
    }

    /// What the samples of a rectangle of pixels see.
    fn see(&self, place: &TilePlace) -> GBuffer<'a> {
        let lattice = Lattice::samples(place.corner, place.size, self.n);
        GBuffer::new(self.view, self.mesh, &Device::default(), lattice, BLOCK)
    }

    /// The mean paint of a pixel's samples; `last` is the ground of the sample before.
    fn pixel(&self, seen: &GBuffer, [x, y]: [usize; 2], nearby: &mut Nearby, last: &mut LastGround) -> Paint {
        let n = self.n;
        let samples = (y * n..(y + 1) * n).flat_map(|r| (x * n..(x + 1) * n).map(move |c| (c, r)));
        let points = samples.map(|(c, r)| seen.plan(c, r)).filter(|at| at.is_finite());
        let has_all = nearby.find(self.footprints, points);
        mean(n, |c, r| {
            let (c, r) = (x * n + c, y * n + r);
            if !has_all {
                // The samples lie far apart: each has its own neighbourhood.
                nearby.find_all(self.footprints, seen.plan(c, r));
            }
            self.paint(seen, (c, r), nearby, last)
        })
    }

    /// The composed paint of a sample.
    fn paint(
        &self,
        seen: &GBuffer,
        (column, row): (usize, usize),
        nearby: &Nearby,
        last: &mut LastGround,
    ) -> Paint {
        let (id, plan) = (seen.triangle(column, row), seen.plan(column, row));
        if id == SKY || !plan.is_finite() {
            return self.backdrop.sky;
        }
        let from_eye =
            || seen.sight().hit(column, row).map_or(0.0, |hit| (hit.world - self.view.eye()).length());
        let holding =
            nearby.items().iter().filter(|item| nearby.holds(self.footprints, item, (plan, &from_eye)));
        let list = self.footprints.list();
        let mut stack = Stack::on(self.backdrop.paint_at(last, id, || plan));
        for item in holding {
            let style = list.items()[item.number as usize].style as usize;
            let over = |below| self.backdrop.compositor.over(below, self.paints[style]);
            stack.draw(list.styles()[style].group, over);
        }
        stack.finished()
    }
}

#[cfg(test)]
mod tests;
