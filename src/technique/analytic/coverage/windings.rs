//! Winding numbers -> sets of items.

use crate::scene::Rule;

/// What of its area's border an item wants.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Inside {
    /// Which winding numbers are inside.
    pub rule: Rule,
    /// Whether what is inside is wanted, or what is outside.
    pub is_wanted: bool,
}

/// When an item covers a point: when all that is asked for holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Membership {
    /// On which side of its area's border; `None`: no matter.
    pub area: Option<Inside>,
    /// Whether in a piece of its stroke.
    pub has_stroke: bool,
}

/// Two winding numbers for each item: that of its area's border, that of its stroke's pieces.
#[derive(Debug, Default)]
pub(super) struct Windings {
    items: Vec<Membership>,
    counts: Vec<i32>,
}

impl Windings {
    pub(super) fn clear(&mut self) {
        self.items.clear();
        self.counts.clear();
    }

    pub(super) fn add(&mut self, of: Membership) -> Option<u32> {
        let bit = self.items.len() as u32;
        if bit == u64::BITS {
            return None;
        }
        self.items.push(of);
        self.counts.extend([0, 0]);
        Some(bit)
    }

    /// The number of the winding number of an item's area.
    pub(super) fn area_of(item: u32) -> u8 {
        2 * item as u8
    }

    /// That of its stroke.
    pub(super) fn stroke_of(item: u32) -> u8 {
        2 * item as u8 + 1
    }

    pub(super) fn set(&mut self, counter: u8, turns: i32) {
        self.counts[counter as usize] = turns;
    }

    pub(super) fn change(&mut self, counter: u8, by: i32) {
        self.counts[counter as usize] += by;
    }

    /// All winding numbers.
    pub(super) fn counts(&self) -> &[i32] {
        &self.counts
    }

    /// The bit of a winding number's item, if the item covers where winding numbers are these.
    pub(super) fn bit(&self, counter: u8, counts: &[i32]) -> u64 {
        let item = counter as usize / 2;
        let of = &self.items[item];
        let is_in = of.area.is_none_or(|area| area.rule.contains(counts[2 * item]) == area.is_wanted);
        let covers = is_in && (!of.has_stroke || counts[2 * item + 1] > 0);
        u64::from(covers) << item
    }

    /// The items that cover where winding numbers are these.
    pub(super) fn set_of(&self, counts: &[i32]) -> u64 {
        (0..self.items.len()).fold(0, |set, item| set | self.bit(2 * item as u8, counts))
    }

    /// The items that cover where the winding numbers are its own.
    pub(super) fn set_of_all(&self) -> u64 {
        self.set_of(&self.counts)
    }

    /// The items that cover beyond some edges, seen from where the winding numbers are its own: each edge's winding number changes.
    pub(super) fn set_beyond(&mut self, edges: &[(u8, i32)]) -> u64 {
        edges.iter().for_each(|(counter, by)| self.change(*counter, *by));
        let set = self.set_of_all();
        edges.iter().for_each(|(counter, by)| self.change(*counter, -by));
        set
    }
}
