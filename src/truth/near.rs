//! The parts of items' borders that are near a fragment; of a crowd of one item's those are left out that cannot matter.

use super::around::Around;
use super::kept::KeptParts;
use super::knowledge::Middle;
use super::setting::Setting;
use super::shape::{Verdict, distance};
use crate::footprint::{BorderPart, Primitive};
use crate::space::{Plan, PlanBox};

/// A piece near more parts than this is cut before they are looked at one by one.
pub(super) const MOST_PARTS: usize = 48;

/// Where most are of one item, so many times more are looked at: the deepest of them tells most of a piece at once, and cuts it best.
const MORE_OF_ONE: usize = 8;

/// So many of an item's parts, the nearest, are asked whether a fragment lies wholly in them.
const MOST_ASKED: usize = 4;

/// Parts near a fragment.
#[derive(Debug, Default)]
pub(super) struct Near {
    parts: Vec<BorderPart>,
    /// The items that have a part of their stroke over all of the fragment: the stroke's other parts do not matter.
    covering: Vec<u32>,
    primitives: Vec<Primitive>,
    around: Around,
}

impl Near {
    /// Those of all items, in the items' order.
    pub(super) fn runs(&self) -> impl Iterator<Item = &[BorderPart]> {
        self.parts.chunk_by(|a, b| a.item == b.item)
    }

    /// The items whose stroke covers all of the fragment, as far as that has been found.
    pub(super) fn covering(&self) -> &[u32] {
        &self.covering
    }

    /// Whether there are many.
    pub(super) fn is_crowd(&self) -> bool {
        self.parts.len() > MOST_PARTS
    }

    /// Finds the parts near a fragment that sees this box of the plan. Returns false where there are more than `most`. `slop` grows by
    /// what is doubtful.
    pub(super) fn find(
        &mut self,
        (middle, plan): (&Middle, &PlanBox),
        most: usize,
        (kept, slop): (&mut KeptParts, &mut f64),
    ) -> bool {
        self.covering.clear();
        self.parts.clear();
        // Boxes of long parts meet much that they are far from.
        let is_all = self.around.parts(middle.pixel.setting.footprints, (plan, most), &mut self.parts)
            || self.collect(middle, plan, (most, false), (kept, slop))
            || self.collect(middle, plan, (most, true), (kept, slop));
        if is_all {
            self.parts.sort_unstable();
            self.parts.dedup();
        }
        is_all
    }

    /// Calls `visit` with each item that a polygon bounds whose box meets this one; and with whether the polygon holds all of it, if
    /// that is known: then `at` was asked for a point of it.
    pub(super) fn areas(
        &mut self,
        setting: &Setting,
        (plan, at): (&PlanBox, &dyn Fn() -> Plan),
        visit: impl FnMut(u32, Option<bool>),
    ) {
        self.around.areas(setting, (plan, at), visit);
    }

    /// `is_strict`: parts are asked whether they miss the box.
    fn collect(
        &mut self,
        middle: &Middle,
        plan: &PlanBox,
        (most, is_strict): (usize, bool),
        (kept, slop): (&mut KeptParts, &mut f64),
    ) -> bool {
        let footprints = middle.pixel.setting.footprints;
        let mut limit = most;
        self.parts.clear();
        let mut misses = |part| kept.of(footprints, part).iter().all(|primitive| primitive.misses(plan));
        footprints.parts_near(plan, |part| {
            let is_stroke = || footprints.edge(part).is_none();
            if (self.covering.contains(&part.item) && is_stroke()) || (is_strict && misses(part)) {
                return true;
            }
            self.parts.push(part);
            if self.parts.len() <= limit {
                return true;
            }
            match self.most_of_one() {
                Some(item) => {
                    if !self.covers(item, middle, slop) {
                        limit *= MORE_OF_ONE;
                    }
                    limit <= most * MORE_OF_ONE
                }
                None => false,
            }
        })
    }

    /// The item that most parts are of, if they are most of all.
    fn most_of_one(&mut self) -> Option<u32> {
        self.parts.sort_unstable();
        let most = self.parts.chunk_by(|a, b| a.item == b.item).max_by_key(|run| run.len())?;
        (most.len() > self.parts.len() / 2).then_some(most[0].item)
    }

    /// Whether a part of an item's stroke covers the fragment; then the stroke's parts are left out.
    fn covers(&mut self, item: u32, middle: &Middle, slop: &mut f64) -> bool {
        let (footprints, at) = (middle.pixel.setting.footprints, middle.hit().plan);
        let run = self.parts.iter().filter(|part| part.item == item);
        let strokes = run.filter(|part| footprints.edge(**part).is_none());
        let away = |part: BorderPart| {
            let [from, to] = footprints.segment(part);
            distance(from, to, at)
        };
        let mut strokes: Vec<_> = strokes.map(|part| (away(*part), *part)).collect();
        strokes.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let is_over = strokes.iter().take(MOST_ASKED).any(|(_, part)| {
            self.primitives.clear();
            footprints.primitives(*part, &mut self.primitives);
            self.primitives.iter().any(|primitive| {
                let shape = middle.ground.shape(&middle.ground.on_facet(primitive));
                matches!(shape.verdict(middle.ground, middle.points, slop), Verdict::In)
            })
        });
        if is_over {
            self.covering.push(item);
            self.parts.retain(|part| part.item != item || footprints.edge(*part).is_some());
        }
        is_over
    }
}
