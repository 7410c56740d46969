//! A cell's bounding volume hierarchy: a full tree over what is sorted by draw order, with implicit indices (4.2.1, *Bounding Volume
//! Hierarchies*), walked without a stack (4.4.1, Algorithm 3.5).
//!
//! The thesis fills the leaves up to a power of two with empty ones. They lie behind all others, so on every level the nodes that are not
//! empty come first, and how many they are follows from the number of leaves: only their boxes are kept.

use crate::space::SmallBox;

/// A full tree of boxes whose nodes have 2^`bits` children.
#[derive(Debug, Default)]
pub(super) struct Bvh {
    /// The nodes that are not empty, level by level from the root.
    boxes: Box<[SmallBox]>,
    leaves: u32,
    levels: u8,
    bits: u8,
}

impl Bvh {
    /// The tree over leaves in their order, 2^`bits` to a node.
    pub(super) fn new(leaves: &[SmallBox], bits: u8) -> Self {
        let mut levels = 0;
        while (leaves.len() as u64) > 1 << (bits * levels) {
            levels += 1;
        }
        let mut below = leaves.to_vec();
        let mut all = vec![below.clone()];
        for _ in 0..levels {
            let joined = |boxes: &[SmallBox]| boxes[1..].iter().fold(boxes[0], |sum, one| sum.joined(*one));
            below = below.chunks(1 << bits).map(joined).collect();
            all.push(below.clone());
        }
        let boxes = all.into_iter().rev().flatten().collect();
        Self { boxes, leaves: leaves.len() as u32, levels, bits }
    }

    /// How many nodes of a level are not empty; the leaves are those of level `levels`.
    #[inline(always)]
    fn count(&self, level: u8) -> u32 {
        let below = u32::from((self.levels - level) * self.bits);
        ((u64::from(self.leaves) + (1u64 << below) - 1) >> below) as u32
    }

    /// Boxes of nodes that are not empty, level by level from the root, and how many each level has.
    pub(super) fn nodes(&self) -> (&[SmallBox], Vec<u32>) {
        let levels = if self.leaves == 0 { 0 } else { self.levels + 1 };
        (&self.boxes, (0..levels).map(|level| self.count(level)).collect())
    }

    /// How many children a node has.
    pub(super) fn children(&self) -> usize {
        1 << self.bits
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.boxes[..])
    }
}

/// A walk over the leaves that meet a box, in their order.
#[derive(Debug)]
pub(super) struct Walk<'a> {
    tree: &'a Bvh,
    wanted: SmallBox,
    level: u8,
    /// The node's place in its level.
    place: u32,
    /// Where the level's boxes start.
    start: u32,
    is_done: bool,
    /// Nodes whose boxes were looked at.
    pub(super) visited: u32,
}

impl<'a> Walk<'a> {
    #[inline(always)]
    pub(super) fn new(tree: &'a Bvh, wanted: SmallBox) -> Self {
        Self { tree, wanted, level: 0, place: 0, start: 0, is_done: tree.leaves == 0, visited: 0 }
    }

    /// To the next node that is not below this one (Eqs. 4.6, 4.7): the right sibling, or that of the nearest ancestor that has one.
    #[inline(always)]
    fn go_on(&mut self) {
        let mask = (1 << self.tree.bits) - 1;
        loop {
            if self.level == 0 {
                self.is_done = true;
                return;
            }
            if self.place & mask != mask && self.place + 1 < self.tree.count(self.level) {
                self.place += 1;
                return;
            }
            self.level -= 1;
            self.place >>= self.tree.bits;
            self.start -= self.tree.count(self.level);
        }
    }
}

impl Iterator for Walk<'_> {
    type Item = u32;

    /// The next leaf whose box meets the wanted one.
    #[inline(always)]
    fn next(&mut self) -> Option<u32> {
        while !self.is_done {
            self.visited += 1;
            if !self.tree.boxes[(self.start + self.place) as usize].meets(&self.wanted) {
                self.go_on();
            } else if self.level == self.tree.levels {
                let leaf = self.place;
                self.go_on();
                return Some(leaf);
            } else {
                // To the left child (Eq. 4.5).
                self.start += self.tree.count(self.level);
                self.level += 1;
                self.place <<= self.tree.bits;
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::{Plan, PlanBox};
    use proptest::prelude::*;

    fn small(x: i32, y: i32, w: i32, h: i32) -> SmallBox {
        let corner = |x: i32, y: i32| Plan::new(f64::from(x), f64::from(y));
        SmallBox::around(&PlanBox { min: corner(x, y), max: corner(x + w, y + h) })
    }

    proptest! {
        #[test]
        fn a_walk_finds_what_meets_a_box_in_order_and_nothing_else(
            leaves in prop::collection::vec((0..40i32, 0..40i32, 0..9i32, 0..9i32), 0..70),
            (x, y, w, h) in (0..45i32, 0..45i32, 0..9i32, 0..9i32), bits in 1..4u8,
        ) {
            let boxes: Vec<SmallBox> = leaves.iter().map(|(x, y, w, h)| small(*x, *y, *w, *h)).collect();
            let wanted = small(x, y, w, h);
            let tree = Bvh::new(&boxes, bits);
            let found: Vec<u32> = Walk::new(&tree, wanted).collect();
            let right: Vec<u32> = (0..).zip(&boxes).filter(|(_, b)| b.meets(&wanted)).map(|(k, _)| k).collect();
            prop_assert_eq!(found, right);
            let (nodes, counts) = tree.nodes();
            prop_assert_eq!(nodes.len(), counts.iter().sum::<u32>() as usize);
        }
    }

    #[test]
    fn what_lies_apart_is_passed_over_in_one_step() {
        let boxes: Vec<SmallBox> = (0..64).map(|k| small(10 * k, 0, 1, 1)).collect();
        let tree = Bvh::new(&boxes, 1);
        let mut walk = Walk::new(&tree, small(0, 5, 1000, 1));
        assert_eq!((walk.next(), walk.visited), (None, 1));
        let mut walk = Walk::new(&tree, small(0, 0, 1, 1));
        assert_eq!((walk.next(), walk.next(), walk.visited), (Some(0), None, 13));
    }
}
