//! What a piece of a pixel knows of an item: whether it lies in it, or what could still tell.

use super::facet::{Facet, Hit};
use super::polygon::middle;
use super::setting::Setting;
use super::shape::{PixelGround, distance};
use super::tile_rays::TileRays;
use crate::certainty::Known;
use crate::space::{Plan, PlanBox};
use std::cell::OnceCell;

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
    /// None is in this box around it: the polygon holds all of the box or none, as far as that is known.
    Beyond(&'a PlanBox, Option<bool>),
}

/// A point in the middle of a piece, at which polygons are asked: once for all of the piece's items.
pub(super) struct Middle<'a> {
    pub(super) pixel: &'a Pixel<'a>,
    pub(super) ground: &'a PixelGround<'a>,
    pub(super) points: &'a [[f64; 2]],
    hit: OnceCell<Hit>,
    /// The items that have an edge so near to the point that it may lie on either side of it, in order; `None`: nothing is known of the point.
    doubtful: OnceCell<Option<Vec<u32>>>,
}

impl<'a> Middle<'a> {
    pub(super) fn new(pixel: &'a Pixel<'a>, ground: &'a PixelGround<'a>, points: &'a [[f64; 2]]) -> Self {
        Self { pixel, ground, points, hit: OnceCell::new(), doubtful: OnceCell::new() }
    }

    pub(super) fn hit(&self) -> &Hit {
        self.hit.get_or_init(|| self.ground.hit(middle(self.points)))
    }

    /// What the piece knows of an item at first; its stroke is open if the item has one.
    pub(super) fn first_state(&self, item: u32, edges: Edges<'_>, (first, count): (u32, u32)) -> State {
        let footprints = self.pixel.setting.footprints;
        let polygon = match (footprints.wants_polygon(item), edges) {
            (None, _) => Known::In,
            (Some(_), Edges::Across) => Known::Open,
            (Some(_), Edges::Near) => self.polygon(item),
            (Some(wanted), Edges::Beyond(_, Some(holds))) => Known::of(holds == wanted),
            (Some(wanted), Edges::Beyond(plan, None)) => match self.hit().plan {
                at if plan.contains(&PlanBox::around([at])) => {
                    Known::of(footprints.polygon_holds(item, at) == wanted)
                }
                // Where a ray grazes its facet, the point that is computed may lie beside the box.
                _ => self.polygon(item),
            },
        };
        let stroke = if footprints.wants_stroke(item) { Known::Open } else { Known::In };
        State { item, polygon, stroke, first, count }
    }

    /// Whether the piece, which no edge of the item's polygon crosses, lies where the item wants it, decided exactly at the point.
    pub(super) fn polygon(&self, item: u32) -> Known {
        let footprints = self.pixel.setting.footprints;
        let doubtful = self.doubtful.get_or_init(|| self.doubtful());
        let is_clear = doubtful.as_ref().is_some_and(|items| items.binary_search(&item).is_err());
        match footprints.wants_polygon(item).filter(|_| is_clear) {
            Some(wanted) => Known::of(footprints.polygon_holds(item, self.hit().plan) == wanted),
            None => Known::Open,
        }
    }

    fn doubtful(&self) -> Option<Vec<u32>> {
        let (footprints, at) = (self.pixel.setting.footprints, self.hit().plan);
        let rounding = 64.0 * f64::EPSILON * at.to_vec().abs().max_element();
        let reach = 2.0 * self.hit().error + rounding;
        if reach == f64::INFINITY {
            return None;
        }
        // The point is known up to `reach`: no edge may be that near.
        let mut doubtful = Vec::new();
        footprints.parts_near(&PlanBox::around([at]).grown(reach), |part| {
            let is_far = |[from, to]: [Plan; 2]| distance(from, to, at) > reach;
            if !footprints.edge(part).is_none_or(is_far) {
                doubtful.push(part.item);
            }
            true
        });
        doubtful.sort_unstable();
        Some(doubtful)
    }
}
