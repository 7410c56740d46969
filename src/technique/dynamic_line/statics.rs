//! Static decals among dynamic lines: fills, and strokes whose widths are in metres (3.4.1), at the plan point of a pixel's centre.
//!
//! Input: the scene's static decals, a pixel's plan point. Output: which of them hold it, and how much of the pixel each covers. The thesis renders both kinds one after the other; here
//! they are composed in the draw order that they share. Refuses: nothing.

use crate::canvas::Backdrop;
use crate::decal::{Decals, Hits, LookupCounts, Palette, PlanPixel, Shares};
use crate::draw_list::DrawList;
use crate::scene::BlendMode;
use crate::space::Plan;
use crate::visibility::PixelFootprint;
use glam::DVec2;

/// The static decals of a frame.
pub struct Statics<'a> {
    decals: &'a Decals<'a>,
    palette: Palette<'a>,
    /// Whether edges are analytic.
    is_analytic: bool,
}

/// Room for what is found at a pixel, used again from pixel to pixel.
#[derive(Debug, Default)]
pub struct Room {
    hits: Hits,
    shares: Shares,
}

impl<'a> Statics<'a> {
    /// Those of a list.
    pub fn new(
        decals: &'a Decals<'a>,
        (list, backdrop, mode): (&'a DrawList, &Backdrop, BlendMode),
        is_analytic: bool,
    ) -> Self {
        Self { decals, palette: Palette::new(list, backdrop.compositor, mode), is_analytic }
    }

    /// Adds the items that hold a plan point, what is drawn last first, and the share of the pixel that each covers; `footprint` is asked for analytic
    /// edges.
    pub fn find(
        &self,
        at: Plan,
        footprint: impl FnOnce() -> Option<PixelFootprint>,
        room: &mut Room,
        found: &mut Vec<(u32, f64)>,
    ) {
        if self.is_analytic {
            // A plane that is seen edge-on has no footprint: its point tells.
            let steps = footprint().map_or([DVec2::ZERO; 2], |footprint| [footprint.dx, footprint.dy]);
            self.decals.cover(&PlanPixel { at, steps }, &mut room.shares);
            found.extend(room.shares.found().iter().rev());
        } else {
            self.decals.find(&[at], &self.palette, &mut room.hits, &mut LookupCounts::default());
            found.extend(room.hits.found().iter().map(|hit| (hit.item, 1.0)));
        }
    }
}

/// Two lists, what is drawn last first, as one.
pub fn merged(lines: &[(u32, f64)], statics: &[(u32, f64)], all: &mut Vec<(u32, f64)>) {
    let (mut lines, mut statics) = (lines.iter().copied().peekable(), statics.iter().copied().peekable());
    while let (Some(line), Some(other)) = (lines.peek(), statics.peek()) {
        all.extend(if line.0 > other.0 { lines.next() } else { statics.next() });
    }
    all.extend(lines.chain(statics));
}
