//! Where the nodes lie that ways use.

use super::block::{Block, Position};
use crate::error::Result;
use crate::space::Plan;

/// The place of a node that has not been met.
const NOWHERE: Position = [i32::MAX; 2];

/// The nodes that are used, by their ids in ascending order: 16 bytes each.
pub(super) struct Nodes {
    ids: Vec<i64>,
    places: Vec<Position>,
    /// Where the next node is looked for first.
    next: usize,
}

impl Nodes {
    /// Those with these ids, in any order and any number of times.
    pub(super) fn used(mut ids: Vec<i64>) -> Self {
        ids.sort_unstable();
        ids.dedup();
        ids.shrink_to_fit();
        Self { places: vec![NOWHERE; ids.len()], ids, next: 0 }
    }

    /// Notes where the nodes of a block are; how many nodes of it have tags.
    pub(super) fn find(&mut self, block: &Block<'_>) -> Result<usize> {
        let mut tagged = 0;
        block.nodes(&mut |id, place, is_tagged| {
            tagged += usize::from(is_tagged);
            // Most files have them in this order.
            let is_next = self.ids.get(self.next) == Some(&id);
            let at = if is_next { Ok(self.next) } else { self.ids.binary_search(&id) };
            if let Ok(at) = at {
                self.places[at] = place;
                self.next = at + 1;
            }
        })?;
        Ok(tagged)
    }

    /// The place of a node as it is stored; `None`: the file does not hold it.
    pub(super) fn position(&self, id: i64) -> Option<Position> {
        let place = self.ids.binary_search(&id).ok().map(|at| self.places[at]);
        place.filter(|place| *place != NOWHERE)
    }

    /// The place of a node in degrees.
    pub(super) fn place(&self, id: i64) -> Option<Plan> {
        let [x, y] = self.position(id)?;
        Some(Plan::new(f64::from(x) / 1e7, f64::from(y) / 1e7))
    }
}
