//! What samples of a picture may see and be held by, when each may be taken anywhere in a small square around its place.
//!
//! A machine that rounds vertices takes each sample, in effect, a little beside its place, and one that rounds depths takes visible points a little
//! along their rays. Whatever it does so, what it sees is one of a sample's outcomes.

use super::Budget;
use super::outcome::Sample;
use super::seen::SeenPlan;
use super::setting::Setting;
use super::tile::{MOST_SHIFT, Probes, TILE, certify_tile};
use crate::buffer::Buffer;
use crate::draw_list::DrawList;
use crate::footprint::{Footprints, PixelSize, Strokes};
use crate::math;
use crate::parallel;
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::tiling::Tiling;

/// Squares are cut into at most 2^depth pieces: straight borders need few, round ones stay open where they are cut this small.
const DEPTH: u32 = 5;

/// Samples and how far they may stray.
pub struct Probe<'a> {
    /// What is painted: the stage's list, or an empty one for what is seen alone.
    pub list: &'a DrawList,
    /// What its strokes are.
    pub strokes: Strokes,
    /// Where samples lie in each pixel, from its upper left corner, 0..=1. Of the last one's outcomes depth and plan are those of its own
    /// square; where there are many, of the others' they may be those of more of the pixel.
    pub spots: &'a [[f64; 2]],
    /// How far a sample may be shifted along each axis, pixels; at most a quarter. Each is asked for.
    pub shifts: &'a [f64],
    /// How many such shifts' worth of the surface's depth a visible point may seem to lie elsewhere along its ray, because its depth is that
    /// of another place in the square.
    pub depths_of_shifts: f64,
    /// How far along its ray a visible point of a view depth (metres) may seem to lie elsewhere besides, metres.
    pub along: &'a (dyn Fn(f64) -> f64 + Sync),
    /// How far a visible point's coordinates may be off, as a share of their size (how large they are and how far the eye is).
    pub share: f64,
}

/// What `judge` makes of each pixel's samples; it is told the pixel (column, row) and its samples, by shift and then in the order of the spots.
/// `progress` is told the share that is done (0..=1), from any thread.
pub fn probe<R: Send + Clone>(
    stage: &Stage,
    view: &ViewFrame,
    of: &Probe,
    judge: &(dyn Fn([usize; 2], &[Sample]) -> R + Sync),
    progress: &(dyn Fn(f64) + Sync),
) -> Buffer<R> {
    probe_around((stage, view), 0, of, judge, progress)
}

/// As [`probe`] of a picture with `border` more pixels on each side: the pixel in its upper left corner is number 0, 0.
pub fn probe_around<R: Send + Clone>(
    (stage, view): (&Stage, &ViewFrame),
    border: usize,
    of: &Probe,
    judge: &(dyn Fn([usize; 2], &[Sample]) -> R + Sync),
    progress: &(dyn Fn(f64) + Sync),
) -> Buffer<R> {
    // The terrain is the picture's own.
    let mesh = &*stage.mesh_for(view);
    let view = &view.with_border(border);
    let size = PixelSize::of(view, mesh);
    let seen = SeenPlan::new(mesh, view);
    let footprints = Footprints::stroked(of.list, size, of.strokes, &|plan| seen.meets(plan));
    let budget = Budget { width: 0.0, depth: DEPTH, coverage: true };
    let setting = Setting::new(&stage.scene, mesh, (&footprints, size), budget).of_what_shows();
    let tiling = Tiling::new(view.width(), view.height(), TILE);
    let shifts: Vec<f64> = of.shifts.iter().map(|shift| math::min(*shift, MOST_SHIFT)).collect();
    let (spots, depths_of_shifts, along) = (of.spots, of.depths_of_shifts, of.along);
    let probes = Probes { spots, shifts: &shifts, depths_of_shifts, along, share: of.share };
    let tiles = parallel::map_telling(tiling.count(), progress, |k| {
        let place = tiling.place(k);
        let tile = certify_tile(&setting, mesh, view, &place, Some(probes));
        let pixel = |k: usize| [place.corner[0] + k % place.size[0], place.corner[1] + k / place.size[0]];
        tile.samples.iter().enumerate().map(|(k, samples)| judge(pixel(k), samples)).collect::<Vec<R>>()
    });
    let mut all: Vec<Option<R>> = vec![None; view.width() * view.height()];
    for (k, tile) in tiles.into_iter().enumerate() {
        for (result, at) in tile.into_iter().zip(tiling.rows(k).flatten()) {
            all[at] = Some(result);
        }
    }
    Buffer::from_values(view.width(), view.height(), all.into_iter().flatten().collect())
}
