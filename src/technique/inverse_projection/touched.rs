//! Which items touch a pixel, by the steps that led to its colour.

use super::edge_index::EdgeIndex;
use super::expansion::AreaId;
use super::step::Step;
use crate::buffer::Touches;

/// Adds the items that are drawn in a pixel by its steps. What its middle is held by, the middle one of its n x n samples says; of an even n the last before it.
pub fn touch((index, n): (&EdgeIndex, u32), steps: &[Step], pixel: [usize; 2], touches: &mut Touches) {
    let mut whole: &[AreaId] = &[];
    let (mut samples, middle) = (0, (n - 1) / 2 * (n + 1));
    for step in steps {
        match step {
            Step::Areas { whole: areas, .. } => whole = areas,
            Step::Sample { within, .. } => {
                let mut areas = [whole, within].concat();
                areas.sort_unstable();
                items(index, &areas, &mut |item| touches.push(pixel, item, samples == middle));
                samples += 1;
            }
            _ => {}
        }
    }
    if samples == 0 {
        items(index, whole, &mut |item| touches.push(pixel, item, true));
    }
}

/// The items that are painted where a point lies in some areas, and in no others; they are in order.
fn items(index: &EdgeIndex, areas: &[AreaId], visit: &mut dyn FnMut(u32)) {
    for area in areas {
        let cut = index.cut_of(*area);
        let is_kept = cut.is_none_or(|(polygon, wanted)| areas.binary_search(&polygon).is_ok() == wanted);
        if is_kept && index.painted_by(*area).is_some() {
            visit(area.item());
        }
    }
}
