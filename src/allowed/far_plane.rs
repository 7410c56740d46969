//! What machines paint on the sky where volumes cross a finite far plane.
//!
//! Faces beyond that plane are not cut but have their depths clamped to it (NV_depth_clamp; Schneider & Klein 2007, 4.2.1), which is what the sky
//! has: they do not pass, whichever way faces are counted, and a volume that holds the ray's point on the far plane is painted. In exact mathematics
//! nothing is behind the sky.

use super::composition::{Composer, Laid};
use super::model::{Guess, View};
use crate::certainty::Known;
use crate::draw_list::{DrawList, Item};
use crate::footprint::{Footprints, PixelSize, Strokes};
use crate::math;
use crate::space::{Plan, PlanBox, Screen, ViewFrame, World};
use crate::terrain::{Mesh, SKY};
use crate::truth::{Outcome, Sample};

/// Heights, least and greatest.
type Heights = [f64; 2];

/// A far plane that volumes may cross.
pub(super) struct FarPlane<'a> {
    view: &'a ViewFrame,
    footprints: Footprints<'a>,
    composer: Composer<'a>,
    /// Between which heights volumes stand at most.
    most: Heights,
    /// Between which heights each item's area surely has a volume; none for strokes, each segment of which has levels of its own.
    sure: Vec<Option<Heights>>,
    /// Depths that may be taken for the plane's, metres before it.
    before: f64,
}

impl<'a> FarPlane<'a> {
    /// That of a view, which has one. `guess` is the widest.
    pub(super) fn new(view: &View<'a>, strokes: Strokes, guess: &Guess) -> Self {
        let (stage, frame) = (view.stage, view.frame);
        let (list, mesh) = (&stage.draw_list, &*stage.mesh);
        let size = PixelSize::of(frame, &stage.mesh_for(frame));
        let sure = |(number, item): (u32, &Item)| {
            let is_area = list.style_of(number).stroke.is_none();
            is_area.then(|| heights_under(mesh, list, item)).flatten()
        };
        Self {
            view: frame,
            footprints: Footprints::stroked(list, size, strokes, &|_| true),
            composer: Composer::new(&stage.scene, list),
            most: most_levels(list, mesh.heights()),
            sure: list.numbered().map(sure).collect(),
            before: guess.envelope.along(frame, frame.far()),
        }
    }

    /// Paints the sky that a sample at a place of the screen may see. `shift`: how far it may be shifted along each axis, pixels.
    pub(super) fn paint(&self, sample: &mut Sample, at: Screen, shift: f64) {
        let Some(place) = sample.outcomes.iter().position(|outcome| outcome.triangle == SKY) else { return };
        let laid = self.crossing(at, shift);
        if laid.is_empty() {
            return;
        }
        let bare = sample.outcomes.remove(place);
        let composed = self.composer.over(bare.ground, &laid);
        let paints = if composed.each.is_empty() { vec![composed.range] } else { composed.each };
        // All are told to be of the same items: to which side these pixels lean says nothing of widths.
        let items = Some(laid.iter().map(|one| (one.item, Known::Open)).collect());
        let painted = Outcome { items, ..bare };
        sample.outcomes.extend(paints.into_iter().map(|paint| Outcome { paint, ..painted.clone() }));
    }

    /// The items of whose volumes one holds a ray's point on the plane, or may, in draw order.
    fn crossing(&self, at: Screen, shift: f64) -> Vec<Laid> {
        let (plan, heights) = self.around(at, shift);
        if heights[1] < self.most[0] || heights[0] > self.most[1] {
            return Vec::new();
        }
        let (mut near, mut room) = (Vec::new(), Vec::new());
        self.footprints.parts_near(&plan, |part| {
            if !self.footprints.misses(part, &plan, &mut room) {
                near.push(part.item);
            }
            true
        });
        let mut items = near.clone();
        self.footprints.areas_near(&plan, |item| items.push(item));
        items.sort_unstable();
        items.dedup();
        let is_within = |[low, high]: Heights| low <= heights[0] && heights[1] <= high;
        let known = |item: u32| {
            if near.contains(&item) {
                return Known::Open;
            }
            let wanted = self.footprints.wants_polygon(item);
            if self.footprints.wants_stroke(item)
                || wanted != Some(self.footprints.polygon_holds(item, plan.min))
            {
                return Known::Out;
            }
            if self.sure[item as usize].is_some_and(is_within) { Known::In } else { Known::Open }
        };
        let told = items.into_iter().map(|item| Laid::once(item, known(item)));
        told.filter(|laid| laid.most > 0).collect()
    }

    /// Around what a shifted ray meets of the plane: in the plan, and heights.
    fn around(&self, at: Screen, shift: f64) -> (PlanBox, Heights) {
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
fn most_levels(list: &DrawList, heights: Option<(f64, f64)>) -> Heights {
    let Some((low, high)) = heights else { return [f64::NEG_INFINITY, f64::INFINITY] };
    let all = PlanBox::around(list.vertices().iter().copied());
    // Twice, as strokes reach beyond their vertices.
    let extent = if all.is_empty() { 0.0 } else { 2.0 * (all.max - all.min).element_sum() };
    let clearance = (high - low) / 32.0 + extent / 512.0;
    [low - clearance, high + clearance]
}

/// Places along each side of a rectangle whose heights are looked at.
const PLACES: u32 = 32;

/// Heights that the terrain has under the rectangle around an item's border, all of which lie within the item's volume; `None`: none are found.
fn heights_under(mesh: &Mesh, list: &DrawList, item: &Item) -> Option<Heights> {
    let border = list.border(item).iter().flat_map(|ring| list.vertices_of(ring).iter().copied());
    let plan = PlanBox::around(border).common(&mesh.plan_bounds());
    if plan.is_empty() {
        return None;
    }
    let along = |from: f64, to: f64, k: u32| from + (to - from) * ((f64::from(k) + 0.5) / f64::from(PLACES));
    let places = (0..PLACES * PLACES).map(|k| {
        let x = along(plan.min.x, plan.max.x, k % PLACES);
        Plan::new(x, along(plan.min.y, plan.max.y, k / PLACES))
    });
    let found = places.filter_map(|at| mesh.height_at(at));
    let [low, high] = found
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [math::min(z, low), math::max(z, high)]);
    (low <= high).then_some([low, high])
}
