//! Ways of a relation, joined end to end into rings.

use std::collections::BTreeMap;

/// The rings that ways make, as chains of node ids that begin and end with the same one; `None` where one stays open.
///
/// Where more than two ways meet, any way on is taken: the rings then touch otherwise, and the edges, which alone count by the
/// even-odd rule, are the same.
pub(super) fn rings(ways: &[&[i64]]) -> Option<Vec<Vec<i64>>> {
    let mut at_node: BTreeMap<i64, Vec<usize>> = BTreeMap::new();
    for (number, way) in ways.iter().enumerate().rev() {
        let ends = way.first().zip(way.last())?;
        if ends.0 != ends.1 {
            at_node.entry(*ends.0).or_default().push(number);
            at_node.entry(*ends.1).or_default().push(number);
        }
    }
    let mut is_used = vec![false; ways.len()];
    let mut rings = Vec::new();
    for (number, way) in ways.iter().enumerate() {
        if std::mem::replace(&mut is_used[number], true) {
            continue;
        }
        let mut ring = way.to_vec();
        while ring.len() < 2 || ring.first() != ring.last() {
            let end = *ring.last()?;
            let next = loop {
                let next = at_node.get_mut(&end)?.pop()?;
                if !std::mem::replace(&mut is_used[next], true) {
                    break ways[next];
                }
            };
            match next.first() == Some(&end) {
                true => ring.extend(&next[1..]),
                false => ring.extend(next.iter().rev().skip(1)),
            }
        }
        rings.push(ring);
    }
    Some(rings)
}

#[cfg(test)]
mod tests {
    use super::rings;

    #[test]
    fn ways_in_any_order_and_direction_make_rings() {
        let ways: [&[i64]; 4] = [&[1, 2, 3], &[7, 8, 9, 7], &[5, 4, 3], &[5, 1]];
        assert_eq!(rings(&ways).unwrap(), [vec![1, 2, 3, 4, 5, 1], vec![7, 8, 9, 7]]);
    }

    #[test]
    fn what_stays_open_is_no_ring() {
        assert!(rings(&[&[1, 2, 3], &[3, 4]]).is_none());
        assert!(rings(&[&[]]).is_none());
        assert!(rings(&[&[1]]).is_none());
    }

    #[test]
    fn rings_that_touch_keep_all_edges() {
        // A figure of eight around node 1, cut into four ways.
        let ways: [&[i64]; 4] = [&[1, 2, 3], &[3, 1], &[1, 4, 5], &[5, 1]];
        let edges = rings(&ways).unwrap().iter().map(|ring| ring.len() - 1).sum::<usize>();
        assert_eq!(edges, 6);
    }
}
