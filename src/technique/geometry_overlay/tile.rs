//! A rectangle of pixels: fragments of lines and fills, the depth test against the mesh, composition (3.2.1).
//!
//! Input: a frame's pieces that may touch the rectangle, in the order in which they are drawn. Output: its pixels, and what was counted. Each pixel is decided by
//! itself, so that neither tiles nor threads matter. Refuses: nothing.

use super::drawing::{NO_CLIPPING, Piece};
use super::step::Step;
use crate::buffer::Touches;
use crate::canvas::{Backdrop, Kept, LastGround, Pixels, Record};
use crate::raster::device::{DepthBuffer, Pipeline, PolygonOffset, Real, SurfaceDepth, Window};
use crate::resolve::{Paint, Stack};
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::terrain::{Mesh, SKY};
use crate::tiling::TilePlace;
use crate::visibility::Sight;

/// What all tiles of a frame are drawn with.
pub(super) struct FrameContext<'a, T> {
    pub stage: &'a Stage,
    pub mesh: &'a Mesh,
    pub view: &'a ViewFrame,
    /// What the pixels' centres see.
    pub sight: Sight<'a>,
    pub backdrop: Backdrop<'a>,
    pub pipeline: Pipeline<T>,
    pub offset: PolygonOffset,
    /// The segments and faces of the view, in the order in which they are drawn.
    pub pieces: Vec<Piece<T>>,
    /// The paint of each style of items.
    pub paints: Vec<Paint>,
}

/// What was counted.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub(super) struct Counts {
    /// Fragments of lines and fills.
    pub fragments: u64,
    /// Those that the depth test kept.
    pub drawn: u64,
}

/// A finished rectangle of pixels, rows from the top.
pub(super) struct Drawn {
    pub pixels: Pixels,
    /// The number of the topmost segment's triangle clipping, where that is wanted; [`NO_CLIPPING`] for none, or a fill.
    pub clippings: Kept<u32>,
    /// Which items have fragments in its pixels, where that is wanted.
    pub touches: Touches,
    pub counts: Counts,
}

/// A fragment that the depth test kept.
#[derive(Debug, Clone, Copy)]
struct Entry {
    /// The pixel's place in the rectangle, row by row.
    pixel: u32,
    item: u32,
    clipping: u32,
    share: f64,
    is_smooth: bool,
}

/// The surface that was asked for last.
#[derive(Clone, Copy)]
struct LastSurface<T> {
    pixel: usize,
    /// Its depth, moved back; `None` in the sky.
    depth: Option<T>,
}

impl<T: Real> FrameContext<'_, T> {
    /// Draws a rectangle; `near`: the pieces that may touch it.
    pub(super) fn draw<R: Record<Step>>(
        &self,
        place: TilePlace,
        near: &[u32],
        (wants_colors, wants_clippings, touches): (bool, bool, Touches),
        record: &mut R,
    ) -> Drawn {
        let [width, height] = place.size;
        let mut counts = Counts::default();
        let entries = self.entries(place, near, &mut counts, record);
        let mut drawn = Drawn {
            pixels: Pixels::new(self.backdrop.compositor, width * height, wants_colors),
            clippings: Kept::new(wants_clippings),
            touches,
            counts,
        };
        let (mut last, mut next) = (self.backdrop.no_ground(), 0);
        for pixel in 0..width * height {
            let own = entries[next..].iter().take_while(|entry| entry.pixel as usize == pixel).count();
            let own = &entries[next..next + own];
            next += own.len();
            let at = (place.corner[0] + pixel % width, place.corner[1] + pixel / width);
            let ground = self.ground(at, &mut last);
            drawn.clippings.push(|| own.last().map_or(NO_CLIPPING, |entry| entry.clipping));
            let paint = self.composed(ground, own);
            if drawn.touches.is_wanted() {
                self.shares(own, &mut |item, share| drawn.touches.push([at.0, at.1], item, share >= 0.5));
            }
            record.step(|| Step::Color(paint));
            if own.is_empty() {
                drawn.pixels.push_ground(ground);
            } else {
                drawn.pixels.push(paint);
            }
        }
        drawn
    }

    fn ground(&self, (column, row): (usize, usize), last: &mut LastGround) -> Paint {
        let triangle = self.sight.triangle(column, row);
        let plan = || self.sight.hit(column, row).map(|hit| hit.plan).unwrap_or_default();
        self.backdrop.paint_at(last, triangle, plan)
    }

    /// The fragments that are seen: pixel by pixel, in the order in which they are drawn.
    fn entries<R: Record<Step>>(
        &self,
        place: TilePlace,
        near: &[u32],
        counts: &mut Counts,
        record: &mut R,
    ) -> Vec<Entry> {
        let ([x, y], [width, height]) = (place.corner, place.size);
        let window = Window { columns: x..x + width, rows: y..y + height };
        let mut entries = Vec::new();
        let mut last = LastSurface { pixel: usize::MAX, depth: None };
        for &number in near {
            let piece = &self.pieces[number as usize];
            piece.fragments(&window, &mut |fragment| {
                counts.fragments += 1;
                let pixel = (fragment.row - y) * width + fragment.column - x;
                if last.pixel != pixel {
                    let depth = self.surface((fragment.column, fragment.row), record);
                    last = LastSurface { pixel, depth };
                }
                let is_drawn = last.depth.is_none_or(|depth| self.is_before(T::of(fragment.depth), depth));
                record.step(|| Step::Fragment {
                    item: piece.item,
                    is_of_fill: piece.is_face(),
                    triangle: piece.triangle,
                    depth: fragment.depth,
                    share: fragment.coverage,
                    is_drawn,
                });
                if is_drawn {
                    counts.drawn += 1;
                    let Piece { item, clipping, is_smooth, .. } = *piece;
                    let (pixel, share) = (pixel as u32, fragment.coverage);
                    entries.push(Entry { pixel, item, clipping, share, is_smooth });
                }
            });
        }
        entries.sort_by_key(|entry| entry.pixel);
        entries
    }

    /// The depth of the surface that a pixel's centre sees, moved back by the polygon offset; `None`: the sky. An imitated machine has moved what it
    /// stored.
    fn surface<R: Record<Step>>(&self, (column, row): (usize, usize), record: &mut R) -> Option<T> {
        let triangle = self.sight.triangle(column, row);
        let corners = if triangle == SKY { None } else { self.mesh.triangle(triangle) };
        let (Some(corners), Some(hit)) = (corners, self.sight.hit(column, row)) else {
            record.step(|| Step::Sky);
            return None;
        };
        let buffer: DepthBuffer = self.pipeline.depth();
        let depth = match self.sight.stored(column, row) {
            Some(stored) => buffer.load(stored),
            None => {
                let SurfaceDepth { depth, slope } =
                    self.pipeline.surface_depth(self.view, &corners, hit.depth);
                depth + self.offset.at(slope, depth, buffer)
            }
        };
        record.step(|| Step::Surface {
            triangle,
            layer: self.mesh.layer_of(triangle),
            plan: hit.plan,
            depth: depth.get(),
        });
        Some(depth)
    }

    /// The depth test: strictly nearer, of depths as they are (exact mathematics) or as they are stored.
    fn is_before(&self, line: T, surface: T) -> bool {
        let buffer = self.pipeline.depth();
        match self.sight.machine() {
            Some(_) => buffer.passes(buffer.store(line), buffer.store(surface)),
            None if buffer.is_reversed() => line > surface,
            None => line < surface,
        }
    }

    /// The ground, and over it a pixel's fragments. Those of an item that were made by area are parts of one line or fill: their shares add up.
    fn composed(&self, ground: Paint, entries: &[Entry]) -> Paint {
        let list = &self.stage.draw_list;
        let mut stack = Stack::on(ground);
        let mut draw = |item: u32, share: f64| {
            let style = list.items()[item as usize].style as usize;
            let paint = self.paints[style].times(share);
            stack.draw(list.styles()[style].group, |below| self.backdrop.compositor.over(below, paint));
        };
        self.shares(entries, &mut draw);
        stack.finished()
    }

    /// Calls `visit` with the item and the share of a pixel of each of its fragments, or of all of an item's that were made by area.
    fn shares(&self, entries: &[Entry], visit: &mut dyn FnMut(u32, f64)) {
        for same in entries.chunk_by(|a, b| a.item == b.item && b.is_smooth) {
            let share = same.iter().map(|entry| entry.share).sum::<f64>();
            visit(same[0].item, crate::math::min(share, 1.0));
        }
    }
}
