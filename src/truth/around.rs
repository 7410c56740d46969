//! What is near a region of the plan, remembered: pieces side by side are near the same parts and polygons.

use super::setting::Setting;
use crate::footprint::{BorderPart, Footprints};
use crate::space::{Plan, PlanBox, SmallBox};

/// A region with more parts than this is not remembered: going through them would cost more than to look in the tree.
const MOST_KEPT: usize = 192;

/// A region that is hardly crowded is followed by a larger one.
const FEW: usize = MOST_KEPT / 8;

/// By how many times what a piece sees a region reaches beyond it: at first, at least, at most.
const REACH: (f64, f64, f64) = (4.0, 0.5, 16.0);

/// After a region of the least reach that was crowded so many pieces are not worth to remember anything.
const PAUSE: u32 = 64;

/// Regions that are remembered: on a ridge pixels see what is near and what is far by turns.
const REGIONS: usize = 3;

/// What is near some regions.
#[derive(Debug)]
pub(super) struct Around {
    /// The one that was used last comes first.
    regions: [Region; REGIONS],
    reach: f64,
    pause: u32,
}

/// All that is near a box of the plan.
#[derive(Debug, Default)]
struct Region {
    /// `None`: nothing is known.
    plan: Option<PlanBox>,
    parts: Vec<(SmallBox, BorderPart)>,
    /// The items that have an edge among the parts, in order.
    with_edges: Vec<u32>,
    areas: Vec<(SmallBox, Inside)>,
}

/// An item that a polygon bounds.
#[derive(Debug, Clone, Copy)]
struct Inside {
    item: u32,
    /// Whether its polygon holds the region, which none of its edges is near; `None`: that has not been asked.
    holds: Option<bool>,
}

impl Default for Around {
    fn default() -> Self {
        Self { regions: Default::default(), reach: REACH.0, pause: 0 }
    }
}

impl Around {
    /// Appends the parts whose box meets one, if they are no more than `most`; false: they may be more, or have to be looked for.
    pub(super) fn parts(
        &mut self,
        footprints: &Footprints,
        (plan, most): (&PlanBox, usize),
        out: &mut Vec<BorderPart>,
    ) -> bool {
        let Some(region) = self.region(footprints, plan) else { return false };
        let wanted = SmallBox::around(plan);
        for (small, part) in &region.parts {
            if small.meets(&wanted) {
                out.push(*part);
            }
        }
        out.len() <= most
    }

    /// Calls `visit` with each item that a polygon bounds whose box meets one; and with whether its polygon holds all of the box, if
    /// no edge is near it, so that one point of it, `at`, tells.
    pub(super) fn areas(
        &mut self,
        setting: &Setting,
        (plan, at): (&PlanBox, &dyn Fn() -> Plan),
        mut visit: impl FnMut(u32, Option<bool>),
    ) {
        let footprints = setting.footprints;
        let Some(region) = self.region(footprints, plan) else {
            return footprints.areas_near(plan, |item| visit(item, None));
        };
        let wanted = SmallBox::around(plan);
        let with_edges = &region.with_edges;
        for (_, area) in region.areas.iter_mut().filter(|(small, _)| small.meets(&wanted)) {
            let has_no_edge = || setting.knows_between && with_edges.binary_search(&area.item).is_err();
            if area.holds.is_none() && has_no_edge() {
                let at = at();
                // Where a ray grazes its facet, the point that is computed may lie beside the box.
                let is_there = plan.contains(&PlanBox::around([at]));
                area.holds = is_there.then(|| footprints.polygon_holds(area.item, at));
            }
            visit(area.item, area.holds);
        }
    }

    /// A region that holds a box, made if need be; `None`: too much is near it.
    fn region(&mut self, footprints: &Footprints, plan: &PlanBox) -> Option<&mut Region> {
        let known = |region: &Region| region.plan.is_some_and(|all| all.contains(plan));
        match self.regions.iter().position(known) {
            Some(0) => {}
            Some(k) => self.regions[..=k].rotate_right(1),
            None => self.remember(footprints, plan)?,
        }
        Some(&mut self.regions[0])
    }

    /// Makes the first region one around a box.
    fn remember(&mut self, footprints: &Footprints, plan: &PlanBox) -> Option<()> {
        let size = (plan.max - plan.min).max_element();
        if self.pause > 0 || !size.is_finite() || plan.is_empty() {
            self.pause = self.pause.saturating_sub(1);
            return None;
        }
        self.regions.rotate_right(1);
        let region = &mut self.regions[0];
        let all = plan.grown(size * self.reach);
        region.plan = None;
        region.parts.clear();
        let has_all = footprints.part_boxes_near(&all, |part, small| {
            region.parts.push((*small, part));
            region.parts.len() <= MOST_KEPT
        });
        if !has_all {
            self.pause = if self.reach > REACH.1 { 0 } else { PAUSE };
            self.reach = crate::math::max(self.reach / 2.0, REACH.1);
            return None;
        }
        if region.parts.len() < FEW {
            self.reach = crate::math::min(self.reach * 2.0, REACH.2);
        }
        let edges = region.parts.iter().filter(|(_, part)| footprints.edge(*part).is_some());
        region.with_edges = edges.map(|(_, part)| part.item).collect();
        region.with_edges.sort_unstable();
        region.with_edges.dedup();
        region.areas.clear();
        footprints.area_boxes_near(&all, |item, small| {
            region.areas.push((*small, Inside { item, holds: None }));
        });
        region.plan = Some(all);
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::footprint::PixelSize;
    use crate::scene_file::SceneFile;
    use crate::stage::Stage;
    use crate::truth::Budget;

    const SCENE: &str = r##"
schema = 1
image = { width = 8, height = 8 }
camera = { eye = [0, -2000, 2000], target = [0, 0, 0] }
terrain.generate = { kind = "plane", posts = [9, 9], cell_m = 250.0 }
[[layer]]
generate = { kind = "mosaic", seed = 4, count = 60, class = [0, 3], holes = 0.3, window = [-1000, -1000, 1000, 1000] }
fill = { color = "#4f7f4a" }
outline = { color = "#000000", width_m = 6.0, mode = "inset" }
[[layer]]
generate = { kind = "roads", seed = 5, count = 300, segment_m = 20.0, window = [-1000, -1000, 0, 1000] }
line = { color = "#ffffff", width_m = 4.0 }
"##;

    /// Any of the numbers of 0..1 that are multiples of 2^-20, from a counter.
    fn share(counter: &mut u64) -> f64 {
        *counter = counter.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (*counter ^ (*counter >> 29)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        (mixed >> 44) as f64 / f64::from(1 << 20)
    }

    #[test]
    fn what_is_remembered_near_a_box_is_what_the_trees_find_there() {
        let file = SceneFile::parse(SCENE, None, &[]).unwrap();
        let (scene, surface) = crate::source::load::load(&file, &|_| {}).unwrap();
        let stage = Stage::new(scene, surface).unwrap();
        let view = stage.view().unwrap();
        let mesh = &*stage.mesh_for(&view);
        let size = PixelSize::of(&view, mesh);
        let footprints = Footprints::new(&stage.draw_list, size, &|_| true);
        let setting = Setting::new(&stage.scene, mesh, (&footprints, size), Budget::default());
        let (mut around, mut counter) = (Around::default(), 0);
        let mut at = Plan::new(0.0, 0.0);
        let (mut remembered, mut told, most) = (0, 0, 48);
        for step in 0..4000 {
            // Side by side most of the time, now and then elsewhere; from a centimetre to a hundred metres wide.
            let side = [0.01, 1.0, 10.0, 100.0][step / 50 % 4];
            let mut next = |size: f64| size * (share(&mut counter) - 0.5);
            at = if step % 50 == 0 {
                Plan::new(next(2000.0), next(2000.0))
            } else {
                at + glam::DVec2::new(next(2.0 * side), next(2.0 * side))
            };
            let plan = PlanBox::around([at, at + glam::DVec2::new(side, 0.7 * side)]);
            let mut expected = Vec::new();
            footprints.parts_near(&plan, |part| {
                expected.push(part);
                true
            });
            let mut parts = Vec::new();
            if around.parts(&footprints, (&plan, most), &mut parts) {
                expected.sort_unstable();
                parts.sort_unstable();
                assert_eq!(parts, expected, "{plan:?}");
                remembered += 1;
            }
            let (mut expected, mut areas) = (Vec::new(), Vec::new());
            footprints.areas_near(&plan, |item| expected.push(item));
            around.areas(&setting, (&plan, &|| at), |item, holds| {
                areas.push(item);
                let Some(holds) = holds else { return };
                told += 1;
                for corner in [plan.min, plan.max] {
                    assert_eq!(footprints.polygon_holds(item, corner), holds, "{item} {plan:?}");
                }
            });
            expected.sort_unstable();
            areas.sort_unstable();
            assert_eq!(areas, expected, "{plan:?}");
        }
        assert!(remembered > 2000 && told > 1000, "{remembered} of 4,000 remembered, {told} polygons told");
    }
}
