//! In which order the lines of a pixel are composed, among one another and with what is static.

use super::lines::Held;
use crate::allowed::composition::Laid;
use crate::certainty::Known;
use crate::technique::dynamic_line::LineOverlaps;

/// More entries of an unsorted list are not tried in each order.
const MOST_UNSORTED: usize = 4;

/// Lines in draw order.
pub(super) fn once_each(held: &[Held], overlaps: LineOverlaps) -> Vec<Laid> {
    let laid = |of: &Held| {
        let known = match (of.least, of.most) {
            (0, 0) => Known::Out,
            (0, _) => Known::Open,
            _ => Known::In,
        };
        match overlaps {
            LineOverlaps::Once => Laid::once(of.item, known),
            LineOverlaps::Double => Laid { least: of.least, most: of.most, ..Laid::once(of.item, known) },
        }
    };
    held.iter().map(laid).collect()
}

/// Lines in each order that a parallel machine may find them in, from the lowest on (Fig. 3.7a).
pub(super) fn unsorted(held: &[Held], overlaps: LineOverlaps) -> Vec<Vec<Laid>> {
    let most: u32 = held.iter().map(|of| of.most).sum();
    if held.len() == 1 {
        return vec![once_each(held, overlaps)];
    }
    if most as usize > MOST_UNSORTED {
        // Any number of any of them, twice: whatever comes last is over all others.
        let laid: Vec<Laid> =
            held.iter().map(|of| Laid { least: 0, ..Laid::once(of.item, Known::Open) }).collect();
        let often = Laid { most: most + 1, ..Laid::once(held[0].item, Known::Open) };
        let all = held.iter().map(|of| Laid { item: of.item, ..often });
        return vec![laid.iter().copied().chain(all.clone()).chain(all).collect()];
    }
    let entries: Vec<(u32, Known)> = held
        .iter()
        .flat_map(|of| (0..of.most).map(|k| (of.item, if k < of.least { Known::In } else { Known::Open })))
        .collect();
    let mut orders = vec![Vec::new()];
    for entry in entries {
        orders = orders
            .into_iter()
            .flat_map(|order: Vec<(u32, Known)>| {
                (0..=order.len()).map(move |at| {
                    let mut with = order.clone();
                    with.insert(at, entry);
                    with
                })
            })
            .collect();
    }
    orders.iter().flat_map(|order| runs(order, overlaps)).collect()
}

/// A list as it is composed: of entries of one line that follow one another one counts, if overlaps do not. Each open entry is tried both ways, as what lies
/// between two entries matters.
fn runs(order: &[(u32, Known)], overlaps: LineOverlaps) -> Vec<Vec<Laid>> {
    let open: Vec<usize> = (0..order.len()).filter(|k| order[*k].1 == Known::Open).collect();
    let list = |answers: usize| {
        let is_in = |k: usize| open.iter().position(|o| *o == k).is_none_or(|bit| answers >> bit & 1 == 1);
        let mut laid: Vec<Laid> = Vec::new();
        for (item, _) in (0..order.len()).filter(|k| is_in(*k)).map(|k| order[k]) {
            let is_again = laid.last().is_some_and(|last| last.item == item);
            if !(is_again && overlaps == LineOverlaps::Once) {
                laid.push(Laid::once(item, Known::In));
            }
        }
        laid
    };
    (0..1 << open.len()).map(list).collect()
}

/// Lines among static decals, from the lowest on: by the draw order that both share, whatever the lines' own order is.
pub(super) fn merged(lines: &[Laid], statics: &[Laid]) -> Vec<Laid> {
    let (mut lines, mut statics) = (lines.iter().rev().peekable(), statics.iter().rev().peekable());
    let mut all = Vec::new();
    while let (Some(line), Some(other)) = (lines.peek(), statics.peek()) {
        all.extend(if line.item > other.item { lines.next() } else { statics.next() });
    }
    all.extend(lines.chain(statics));
    all.reverse();
    all
}
