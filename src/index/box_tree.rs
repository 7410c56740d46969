//! A packed tree of boxes: which of many boxes meet one.

use super::morton::morton;
use crate::parallel;
use crate::space::{Plan, PlanBox, SmallBox};

/// Boxes or nodes in a node.
const FAN: usize = 8;

/// Levels that a tree of as many boxes as a `u32` counts can have.
const MOST_LEVELS: usize = 12;

/// Boxes sorted along a Morton curve, packed eight to a node, level by level. Their corners are rounded outwards to single
/// precision: a query may name a box that it just misses, never miss one that it meets.
#[derive(Debug, Default)]
pub struct BoxTree {
    /// The number of each leaf's box, in the order of the curve.
    order: Vec<u32>,
    /// Level 0 holds the boxes, each further level the boxes around eight of the one below.
    levels: Vec<Vec<SmallBox>>,
}

impl BoxTree {
    /// A tree over these boxes; those that are empty meet nothing.
    pub fn new(boxes: &[PlanBox]) -> Self {
        let mut whole = PlanBox::EMPTY;
        boxes.iter().for_each(|plan| whole.include_box(plan));
        let mut order: Vec<(u64, u32)> =
            boxes.iter().enumerate().map(|(k, plan)| (place(&whole, plan), k as u32)).collect();
        parallel::sort_by_key(&mut order, |entry| *entry);
        let order: Vec<u32> = order.into_iter().map(|(_, k)| k).collect();
        let leaves = order.iter().map(|&k| SmallBox::around(&boxes[k as usize])).collect();
        let levels = packed_levels(leaves, FAN, |boxes: &[SmallBox]| {
            boxes.iter().skip(1).fold(boxes[0], |all, one| all.joined(*one))
        });
        Self { order, levels }
    }

    /// Calls `visit` with the number of each box that meets `plan` until it returns false; returns whether it never did.
    #[inline]
    pub fn query(&self, plan: &PlanBox, mut visit: impl FnMut(u32) -> bool) -> bool {
        self.query_boxes(plan, |number, _| visit(number))
    }

    /// As [`Self::query`], with each box as it is kept: another query of what meets it and `plan` finds nothing else.
    #[inline]
    pub fn query_boxes(&self, plan: &PlanBox, visit: impl FnMut(u32, &SmallBox) -> bool) -> bool {
        let wanted = SmallBox::around(plan);
        self.walk(|small| small.meets(&wanted), visit)
    }

    /// The numbers of the boxes that meet one, in order.
    pub fn found(&self, plan: &PlanBox) -> Vec<u32> {
        let mut found = Vec::new();
        self.query(plan, |number| {
            found.push(number);
            true
        });
        found.sort_unstable();
        found
    }

    /// As [`Self::query`] with each box that is wanted. `is_wanted` is asked of boxes around several first: it must want those that hold a box that
    /// it wants.
    #[inline]
    pub fn search(
        &self,
        is_wanted: impl FnMut(&SmallBox) -> bool,
        mut visit: impl FnMut(u32) -> bool,
    ) -> bool {
        self.walk(is_wanted, |number, _| visit(number))
    }

    #[inline]
    fn walk(
        &self,
        mut is_wanted: impl FnMut(&SmallBox) -> bool,
        mut visit: impl FnMut(u32, &SmallBox) -> bool,
    ) -> bool {
        let top = self.levels.len().saturating_sub(1);
        if self.order.is_empty() || !is_wanted(&self.levels[top][0]) {
            return true;
        }
        let mut stack = [(0u32, 0u32); FAN * MOST_LEVELS];
        let mut height = 1;
        stack[0] = (top as u32, 0);
        while height > 0 {
            height -= 1;
            let (level, node) = stack[height];
            if level == 0 {
                if !visit(self.order[node as usize], &self.levels[0][node as usize]) {
                    return false;
                }
                continue;
            }
            let below = &self.levels[level as usize - 1];
            let start = node as usize * FAN;
            for k in (start..(start + FAN).min(below.len())).rev() {
                if is_wanted(&below[k]) {
                    stack[height] = (level - 1, k as u32);
                    height += 1;
                }
            }
        }
        true
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.order[..]) + self.levels.iter().map(|l| size_of_val(&l[..])).sum::<usize>()
    }
}

/// The levels of a tree whose nodes hold `fan` consecutive nodes of the level below, from the leaves up to one node; `around` makes a node of
/// those that it holds.
pub fn packed_levels<T>(leaves: Vec<T>, fan: usize, around: impl Fn(&[T]) -> T) -> Vec<Vec<T>> {
    let mut levels = vec![leaves];
    while let Some(top) = levels.last().filter(|top| top.len() > 1) {
        let next = top.chunks(fan).map(&around).collect();
        levels.push(next);
    }
    levels
}

/// The place of a box's middle on a Morton curve over the whole.
fn place(whole: &PlanBox, plan: &PlanBox) -> u64 {
    let size = whole.max - whole.min;
    let middle = Plan::from((plan.min.to_vec() + plan.max.to_vec()) / 2.0);
    let cell = |v: f64, low: f64, size: f64| ((v - low) / size * 65_536.0) as u32;
    morton(cell(middle.x, whole.min.x, size.x), cell(middle.y, whole.min.y, size.y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn plan_box() -> impl Strategy<Value = PlanBox> {
        (-1e3..1e3f64, -1e3..1e3f64, 0.0..50.0f64, 0.0..50.0f64)
            .prop_map(|(x, y, w, h)| PlanBox::around([Plan::new(x, y), Plan::new(x + w, y + h)]))
    }

    proptest! {
        #[test]
        fn a_query_names_every_box_that_meets_it_and_hardly_any_other(
            boxes in prop::collection::vec(plan_box(), 0..300),
            wanted in plan_box(),
        ) {
            let mut found = Vec::new();
            BoxTree::new(&boxes).query(&wanted, |k| { found.push(k as usize); true });
            found.sort_unstable();
            let near: Vec<usize> = (0..boxes.len()).filter(|&k| boxes[k].grown(1e-3).meets(&wanted)).collect();
            prop_assert!((0..boxes.len()).filter(|&k| boxes[k].meets(&wanted)).all(|k| found.contains(&k)));
            prop_assert!(found.iter().all(|k| near.contains(k)));
        }
    }
}
