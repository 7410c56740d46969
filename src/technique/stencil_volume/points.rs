//! The surface points that a tile's samples see.

use super::block::{Block, COLUMNS, ROWS};
use super::context::{FrameContext, Way};
use super::face::SampleFrame;
use super::view::Entry;
use crate::math;
use crate::raster::TileView;
use crate::space::{Lens, World};
use crate::visibility::Planes;
use std::ops::Range;

/// The surface points of a tile that volumes may touch, in blocks, and where they lie.
pub fn seen(context: &FrameContext, view: &TileView, entries: &[Entry]) -> (SampleFrame, Vec<Block>) {
    let size = (view.width, view.height);
    let mut blocks = Vec::new();
    for row in (0..view.height).step_by(ROWS) {
        blocks.extend((0..view.width).step_by(COLUMNS).map(|column| Block::new((column, row), size)));
    }
    let mut origin = None;
    if context.way != Way::Machine {
        let (mut points, mut planes) = (vec![World::default(); view.width], Planes::default());
        for r in rows_of(view, entries) {
            context.sight.world_of_row((view.column, view.row + r), &mut points, &mut planes);
            origin = origin.or_else(|| points.iter().copied().find(|p| p.is_finite()));
            let Some(origin) = origin else { continue };
            let from = r / ROWS * view.width.div_ceil(COLUMNS);
            context.arch.dispatch(Take { points: &points, r: r % ROWS, origin, blocks: &mut blocks[from..] });
        }
    }
    context.arch.dispatch(Close { blocks: &mut blocks });
    let reach = blocks.iter().fold(0.0, |most, block| math::max_f32(block.reach(), most));
    (place(view, origin.unwrap_or_default(), f64::from(reach)), blocks)
}

/// The rows of the tile that volumes may touch: the depth test of the others is never asked.
fn rows_of(view: &TileView, entries: &[Entry]) -> Range<usize> {
    let windows = entries.iter().map(|entry| entry.samples_in(view));
    let rows = windows.fold((view.height, 0), |all, ((_, r0), (_, r1))| (all.0.min(r0), all.1.max(r1 + 1)));
    rows.0..rows.1
}

/// [`Block::set_row`] of a row of blocks, compiled for the widest vectors of the machine at hand.
struct Take<'t> {
    points: &'t [World],
    r: usize,
    origin: World,
    blocks: &'t mut [Block],
}

impl pulp::WithSimd for Take<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        for (block, points) in self.blocks.iter_mut().zip(self.points.chunks(COLUMNS)) {
            block.set_row(self.r, points, self.origin);
        }
    }
}

/// [`Block::close`] of all blocks, as [`Take`].
struct Close<'t> {
    blocks: &'t mut [Block],
}

impl pulp::WithSimd for Close<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        for block in self.blocks {
            block.close();
        }
    }
}

/// How precisely points are known that reach so far from an origin.
fn place(view: &TileView, origin: World, reach: f64) -> SampleFrame {
    let frame = &view.frame;
    // How far a surface point lies from the start of its ray.
    let picture = match frame.lens() {
        Lens::Central { .. } => 0.0,
        Lens::Parallel { pixel } => pixel * (frame.width() + frame.height()) as f64,
    };
    let far = reach * (1.0 + f64::from(f32::EPSILON));
    let size = frame.eye().to_vec().abs().max_element() + origin.to_vec().abs().max_element();
    // Parameters of hits are good to 2^-30 of themselves.
    let error = (size + far + picture) * (2.0 / (1u64 << 30) as f64);
    SampleFrame { origin, reach: far, error }
}
