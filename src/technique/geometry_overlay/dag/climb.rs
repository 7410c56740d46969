//! From the smallest triangles of a section up to what they are halves of (3.2), and from each clipping on to the next (3.1).
//!
//! Input: a [`Section`]. Output: its clippings. Refuses: nothing.

use super::structure::{NONE, TriangleClipping};
use super::trace::Section;

/// The clippings of a section in `layers` layers: the smallest first, in the order of the walk, then layer by layer.
pub fn climb(section: &Section, layers: u32) -> Vec<TriangleClipping> {
    let mut all = smallest(section);
    // Of each clipping the first one that it is made of.
    let mut first_parts = vec![NONE; all.len()];
    let mut layer = 0..all.len();
    for number in 0..layers {
        let start = all.len();
        if number + 1 < layers {
            for k in layer.clone() {
                let whole = all[k].triangle.whole();
                let is_new = all.len() == start || all[all.len() - 1].triangle != whole;
                if is_new {
                    all.push(TriangleClipping { triangle: whole, parent: NONE, ..all[k] });
                    first_parts.push(k as u32);
                }
                let parent = all.len() - 1;
                let part = all[k];
                all[parent].take_end_of(&part);
                all[k].parent = parent as u32;
            }
        }
        for k in layer.start..layer.end.saturating_sub(1) {
            let next = all[k + 1];
            let is_over_longest_side =
                all[k].triangle.left == next.triangle.right && all[k].triangle.right == next.triangle.left;
            // The finer of two beyond the exit edge has that as its longest side; the coarser is the whole of it.
            let finer = if is_over_longest_side { k as u32 + 1 } else { first_parts[k + 1] };
            let coarser = if is_over_longest_side { next.parent } else { k as u32 + 1 };
            if finer == NONE {
                all[k].next = [coarser, NONE];
            } else {
                all[k].next = [finer, coarser];
                all[k].decision_vertex = all[finer as usize].triangle.apex;
            }
        }
        layer = start..all.len();
    }
    all
}

/// The clippings of the smallest triangles.
fn smallest(section: &Section) -> Vec<TriangleClipping> {
    let (mut first, before) = (0, u32::from(!section.enters));
    let crossing = |k: u32| match k.checked_sub(before) {
        Some(k) if (k as usize) < section.crossings.len() => k,
        _ => NONE,
    };
    let clipping = |(k, &(triangle, end)): (u32, &_)| {
        let clipping = TriangleClipping {
            triangle,
            decision_vertex: triangle.apex,
            vertices: [first, end],
            crossings: [crossing(k), crossing(k + 1)],
            next: [NONE; 2],
            parent: NONE,
            finest_exit_descendant: k,
        };
        first = end;
        clipping
    };
    (0..).zip(&section.triangles).map(clipping).collect()
}
