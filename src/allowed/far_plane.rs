//! What machines paint on the sky where volumes cross a finite far plane.
//!
//! Faces beyond that plane are not cut but have their depths clamped to it (NV_depth_clamp; Schneider & Klein 2007, 4.2.1), which is what the sky
//! has: they do not pass, whichever way faces are counted, and a volume that holds the ray's point on the far plane is painted. In exact mathematics
//! nothing is behind the sky.

use super::composition::{Composer, Laid};
use super::model::{Guess, View};
use crate::certainty::Known;
use crate::draw_list::DrawList;
use crate::footprint::{Footprints, PixelSize, Strokes};
use crate::math;
use crate::space::{PlanBox, Screen, ViewFrame, World};
use crate::terrain::SKY;
use crate::truth::{Outcome, Sample};

/// A far plane that volumes may cross.
pub(super) struct FarPlane<'a> {
    view: &'a ViewFrame,
    footprints: Footprints<'a>,
    composer: Composer<'a>,
    /// Between which heights volumes stand at most.
    levels: [f64; 2],
    /// Depths that may be taken for the plane's, metres before it.
    before: f64,
}

impl<'a> FarPlane<'a> {
    /// That of a view; `None`: it is infinite. `guess` is the widest.
    pub(super) fn of(view: &View<'a>, strokes: Strokes, guess: &Guess) -> Option<Self> {
        let (stage, frame) = (view.stage, view.frame);
        if frame.far().is_infinite() {
            return None;
        }
        let list = &stage.draw_list;
        let size = PixelSize::of(frame, &stage.mesh_for(frame));
        Some(Self {
            view: frame,
            footprints: Footprints::stroked(list, size, strokes, &|_| true),
            composer: Composer::new(&stage.scene, list),
            levels: levels(list, stage.mesh.heights()),
            before: guess.envelope.along(frame, frame.far()),
        })
    }

    /// Adds to what a sample at a place of the screen may see, if that is the sky, what a machine paints there. `shift`: how far it may be shifted
    /// along each axis, pixels.
    pub(super) fn add_to(&self, sample: &mut Sample, at: Screen, shift: f64) {
        let Some(place) = sample.outcomes.iter().position(|outcome| outcome.triangle == SKY) else { return };
        let laid = self.crossing(at, shift);
        if laid.is_empty() {
            return;
        }
        let sky = &mut sample.outcomes[place];
        // A machine paints all of the sky's pixels, or none: no side to lean to, so the bare sky is told to be of the same items.
        sky.items = Some(laid.iter().map(|one| (one.item, Known::Open)).collect());
        let bare = sky.clone();
        let composed = self.composer.over(bare.ground, &laid);
        let paints = if composed.each.is_empty() { vec![composed.range] } else { composed.each };
        let painted = paints.into_iter().map(|paint| Outcome { paint, ..bare.clone() });
        sample.outcomes.extend(painted.filter(|painted| painted.paint != bare.paint));
    }

    /// The items of whose volumes one holds a ray's point on the plane, or may, in draw order.
    fn crossing(&self, at: Screen, shift: f64) -> Vec<Laid> {
        let (plan, heights) = self.around(at, shift);
        if heights[1] < self.levels[0] || heights[0] > self.levels[1] {
            return Vec::new();
        }
        let (mut open, mut room) = (Vec::new(), Vec::new());
        self.footprints.parts_near(&plan, |part| {
            if !self.footprints.misses(part, &plan, &mut room) {
                open.push(part.item);
            }
            true
        });
        let mut items = open.clone();
        self.footprints.areas_near(&plan, |item| items.push(item));
        items.sort_unstable();
        items.dedup();
        let known = |item: u32| match self.footprints.wants_polygon(item) {
            _ if open.contains(&item) => Known::Open,
            Some(wanted) if !self.footprints.wants_stroke(item) => {
                Known::of(self.footprints.polygon_holds(item, plan.min) == wanted)
            }
            _ => Known::Out,
        };
        let told = items.into_iter().map(|item| (item, known(item)));
        told.filter(|(_, known)| *known != Known::Out).map(|(item, known)| Laid::once(item, known)).collect()
    }

    /// Around what a shifted ray meets of the plane: in the plan, and heights.
    fn around(&self, at: Screen, shift: f64) -> (PlanBox, [f64; 2]) {
        let (mut plan, mut heights) = (PlanBox::EMPTY, [f64::INFINITY, f64::NEG_INFINITY]);
        for (dx, dy) in [(-shift, -shift), (shift, -shift), (-shift, shift), (shift, shift)] {
            let ray = self.view.ray(Screen::new(at.x + dx, at.y + dy));
            let way = (ray.through - ray.from) / self.view.reach();
            for depth in [self.view.far() - self.before, self.view.far()] {
                let point: World = ray.from + way * depth;
                plan.include(point.plan());
                heights = [math::min(point.z, heights[0]), math::max(point.z, heights[1])];
            }
        }
        (plan, heights)
    }
}

/// Between which heights volumes over a terrain stand at most: their caps keep a 32nd of the heights and a 512th of their own extent away.
fn levels(list: &DrawList, heights: Option<(f64, f64)>) -> [f64; 2] {
    let Some((low, high)) = heights else { return [f64::NEG_INFINITY, f64::INFINITY] };
    let all = PlanBox::around(list.vertices().iter().copied());
    // Twice, as strokes reach beyond their vertices.
    let extent = if all.is_empty() { 0.0 } else { 2.0 * (all.max - all.min).element_sum() };
    let clearance = (high - low) / 32.0 + extent / 512.0;
    [low - clearance, high + clearance]
}
