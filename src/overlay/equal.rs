//! Members that are the same polygon.

use super::edge::order;
use super::edges::{Rings, borders};
use crate::space::{Plan, PlanBox};
use std::cmp::Ordering;

/// The members without those that equal an earlier one: the same rings in any order, from any vertex on, all turned or none.
pub(super) fn distinct(members: &[Rings]) -> Vec<usize> {
    // Hardly any have another one's box: the others need no more to differ.
    let bounds = |member: usize| PlanBox::around(borders(&members[member]).flatten().copied());
    let mut boxes: Vec<(PlanBox, usize)> =
        (0..members.len()).map(|member| (bounds(member), member)).collect();
    let by_box = |a: &PlanBox, b: &PlanBox| order(a.min, b.min).then(order(a.max, b.max));
    boxes.sort_by(|a, b| by_box(&a.0, &b.0).then(a.1.cmp(&b.1)));
    let mut is_again = vec![false; members.len()];
    for alike in boxes.chunk_by(|a, b| by_box(&a.0, &b.0).is_eq()) {
        if alike.len() < 2 || alike[0].0.is_empty() {
            continue;
        }
        let mut forms: Vec<(Rings, usize)> = alike.iter().map(|(_, k)| (form(&members[*k]), *k)).collect();
        forms.sort_by(|a, b| by_rings(&a.0, &b.0).then(a.1.cmp(&b.1)));
        for same in forms.chunk_by(|a, b| by_rings(&a.0, &b.0).is_eq()) {
            same.iter().skip(1).for_each(|(_, member)| is_again[*member] = true);
        }
    }
    (0..members.len()).filter(|member| !is_again[*member]).collect()
}

fn by_ring(a: &[Plan], b: &[Plan]) -> Ordering {
    let differ = a.iter().zip(b).map(|(p, q)| order(*p, *q)).find(|order| order.is_ne());
    differ.unwrap_or_else(|| a.len().cmp(&b.len()))
}

fn by_rings(a: &Rings, b: &Rings) -> Ordering {
    let differ = a.iter().zip(b).map(|(p, q)| by_ring(p, q)).find(|order| order.is_ne());
    differ.unwrap_or_else(|| a.len().cmp(&b.len()))
}

/// A form that equal members share: rings from their lowest vertex on and sorted, turned the way that comes first.
fn form(rings: &Rings) -> Rings {
    let from_lowest = |mut ring: Vec<Plan>| {
        let lowest = (0..ring.len()).min_by(|a, b| order(ring[*a], ring[*b])).unwrap_or(0);
        ring.rotate_left(lowest);
        ring
    };
    let sorted = |rings: Rings| {
        let mut rings: Rings = rings.into_iter().map(from_lowest).collect();
        rings.sort_by(|a, b| by_ring(a, b));
        rings
    };
    let own: Rings = borders(rings).cloned().collect();
    let turned = own.iter().map(|ring| ring.iter().rev().copied().collect()).collect();
    let (own, turned) = (sorted(own), sorted(turned));
    if by_rings(&own, &turned).is_le() { own } else { turned }
}
