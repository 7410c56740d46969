//! On which side of an outline's segments its polygon lies.
//!
//! The thesis asks of which side of a segment a sample is, since "the winding order of the polygons is always the same" (4.4.1). Here rings turn
//! as they are written, so a ring's turn and whether it is a hole say it.

use super::build::Source;
use crate::draw_list::{Chain, DrawList};
use crate::space::Plan;
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// About so many edges of a ring are asked in which other rings they lie.
const MOST_ASKED: usize = 32;

/// For each outline that is cut to a side: of each ring whether the polygon lies on the left, once somebody has asked. (Dashes are parts of rings.)
#[derive(Debug, Default)]
pub(super) struct Sides(BTreeMap<u32, Box<[OnceLock<bool>]>>);

impl Sides {
    /// Nothing has been asked yet.
    pub(super) fn of(list: &DrawList) -> Self {
        let is_cut = |number: &u32| list.style_of(*number).cut.is_some();
        let cut = list.numbered().filter(|(number, _)| is_cut(number));
        Self(
            cut.map(|(number, item)| {
                let rings = list.strokes(item).iter().map(|chain| chain.part + 1).max().unwrap_or(0);
                (number, (0..rings).map(|_| OnceLock::new()).collect())
            })
            .collect(),
        )
    }

    /// Whether the polygon of an outline lies on the left of one of its chains.
    pub(super) fn is_left_inside(&self, source: &Source, item: u32, chain: u32) -> bool {
        let chain = &source.list.strokes(&source.list.items()[item as usize])[chain as usize];
        let known = self.0.get(&item).and_then(|rings| rings.get(chain.part as usize));
        known.is_none_or(|known| *known.get_or_init(|| is_left_inside(source, item, chain)))
    }
}

/// The left of a ring that turns left is what it encloses; that is the polygon where the ring itself lies in none or an even number of the others.
fn is_left_inside(source: &Source, item: u32, chain: &Chain) -> bool {
    let list = source.list;
    // A dash tells nothing of the ring that it is a part of.
    let rings = list.area(&list.items()[item as usize]);
    let ring = rings.binary_search_by_key(&chain.part, |ring| ring.part).map_or(chain, |k| &rings[k]);
    let others: Vec<u32> = source
        .rings_of(list.area_owner(item))
        .filter(|other| {
            let chain = source.chain_of(*other);
            chain.member == ring.member && chain.part != ring.part
        })
        .collect();
    let is_in_even =
        |at: Plan| others.iter().map(|other| source.turns_around(*other, at)).sum::<i32>() % 2 == 0;
    // Rings may touch one another at vertices: middles of edges are asked, and most of them tell.
    let path = list.path_of(ring);
    let every = (path.len() / MOST_ASKED).max(1);
    let middles = || path.windows(2).step_by(every).map(|ends| ends[0] + (ends[1] - ends[0]) * 0.5);
    let even = middles().filter(|at| is_in_even(*at)).count();
    turns_left(list, ring) == (2 * even >= middles().len())
}

/// Whether a ring encloses more to its left than to its right.
fn turns_left(list: &DrawList, ring: &Chain) -> bool {
    let path = list.path_of(ring);
    let cross = |a: Plan, b: Plan| (a - path[0]).perp_dot(b - path[0]);
    path.windows(2).map(|ends| cross(ends[0], ends[1])).sum::<f64>() >= 0.0
}
