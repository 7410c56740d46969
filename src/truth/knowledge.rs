//! What a piece of a pixel knows of an item: whether it lies in it, or what could still tell.

use super::facet::Facet;
use super::polygon::middle;
use super::setting::Setting;
use super::shape::{PixelGround, distance};
use super::tile_rays::TileRays;
use crate::certainty::Known;
use crate::footprint::Primitive;
use crate::space::PlanBox;

/// What a piece knows of an item.
#[derive(Debug, Clone, Copy)]
pub(super) struct State {
    pub(super) item: u32,
    pub(super) polygon: Known,
    pub(super) stroke: Known,
    /// The shapes that can still tell, in `lists`.
    pub(super) first: u32,
    pub(super) count: u32,
}

impl State {
    pub(super) fn known(&self) -> Known {
        self.polygon.and(self.stroke)
    }
}

/// What stays the same for a pixel.
#[derive(Clone, Copy)]
pub(super) struct Pixel<'a> {
    pub(super) setting: &'a Setting<'a>,
    pub(super) rays: &'a TileRays,
    pub(super) facets: &'a [Facet],
    /// Its corner in the tile.
    pub(super) corner: [f64; 2],
}

impl<'a> Pixel<'a> {
    pub(super) fn ground(&self, facet: u32) -> PixelGround<'a> {
        let size = self.setting.pixel_size;
        PixelGround { rays: self.rays, facet: &self.facets[facet as usize], pixel: self.corner, size }
    }
}

/// Where a fragment's edges of an item's polygon are.
#[derive(Clone, Copy)]
pub(super) enum Edges<'a> {
    /// Some may cross it.
    Across,
    /// None crosses it, but some are near.
    Near,
    /// None is in this box around it.
    Beyond(&'a PlanBox),
}

/// What a fragment knows of an item at first; its stroke is open if the item has one.
pub(super) fn first_state(
    pixel: &Pixel,
    (ground, points): (&PixelGround, &[[f64; 2]]),
    item: u32,
    edges: Edges<'_>,
    (first, count): (u32, u32),
) -> State {
    let footprints = pixel.setting.footprints;
    let polygon = match (footprints.wants_polygon(item), edges) {
        (None, _) => Known::In,
        (Some(_), Edges::Across) => Known::Open,
        (Some(_), Edges::Near) => polygon_at(pixel, ground, points, item),
        // The polygon holds all of the box, or none.
        (Some(wanted), Edges::Beyond(plan)) => match ground.hit(middle(points)).plan {
            at if plan.contains(&PlanBox::around([at])) => {
                Known::of(footprints.polygon_holds(item, at) == wanted)
            }
            // Where a ray grazes its facet, the point that is computed may lie beside the box.
            _ => polygon_at(pixel, ground, points, item),
        },
    };
    let stroke = if footprints.wants_stroke(item) { Known::Open } else { Known::In };
    State { item, polygon, stroke, first, count }
}

/// Whether a piece that no edge of an item's polygon crosses lies where the item wants it, decided exactly at a point of it.
pub(super) fn polygon_at(pixel: &Pixel, ground: &PixelGround, points: &[[f64; 2]], item: u32) -> Known {
    let footprints = pixel.setting.footprints;
    let hit = ground.hit(middle(points));
    let rounding = 64.0 * f64::EPSILON * hit.plan.to_vec().abs().max_element();
    let reach = 2.0 * hit.error + rounding;
    if reach == f64::INFINITY {
        return Known::Open;
    }
    // The point is known up to `reach`: no edge may be that near.
    let mut primitives = Vec::new();
    let is_clear = footprints.parts_near(&PlanBox::around([hit.plan]).grown(reach), |part| {
        primitives.clear();
        if part.item == item {
            footprints.primitives(part, &mut primitives);
        }
        primitives.iter().all(|primitive| match primitive {
            Primitive::Edge { from, to } => distance(*from, *to, hit.plan) > reach,
            _ => true,
        })
    });
    let wanted = footprints.wants_polygon(item);
    match wanted.filter(|_| is_clear) {
        Some(wanted) => Known::of(footprints.polygon_holds(item, hit.plan) == wanted),
        None => Known::Open,
    }
}
