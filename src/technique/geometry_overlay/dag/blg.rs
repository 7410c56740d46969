//! BLG trees: which of a clipping's points a tolerance leaves (3.2.2, Fig. 3; van Oosterom 1991, after Douglas and Peucker 1973).
//!
//! Input: points in any space. Output: [`BlgTree`]. Refuses: nothing.

use super::structure::NONE;
use glam::DVec3;

/// A binary line generalization tree: each node is the point that is farthest from the segment between two others.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct BlgTree {
    /// The root first; none where there are fewer than three points.
    nodes: Vec<Node>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Node {
    /// Which of the points.
    point: u32,
    /// Before and after it; [`NONE`] where no point lies between.
    children: [u32; 2],
    /// How far it is from the segment that it would be left out for.
    distance: f64,
}

impl BlgTree {
    /// Of a line's points. Of points that are equally far the middle one is taken, so that zigzags make no deep trees.
    pub fn new(points: &[DVec3]) -> Self {
        let mut nodes: Vec<Node> = Vec::new();
        let mut ranges = vec![(0, points.len().saturating_sub(1), None)];
        while let Some((first, last, parent)) = ranges.pop() {
            if last < first + 2 {
                continue;
            }
            let (mut point, mut distance) = (first, f64::NEG_INFINITY);
            for k in first + 1..last {
                let to = squared_distance(points[k], [points[first], points[last]]);
                let off_middle = |k: usize| (2 * k).abs_diff(first + last);
                if to > distance || (to == distance && off_middle(k) < off_middle(point)) {
                    (point, distance) = (k, to);
                }
            }
            let number = nodes.len();
            if let Some((parent, side)) = parent {
                let parent: &mut Node = &mut nodes[parent];
                parent.children[side] = number as u32;
            }
            nodes.push(Node { point: point as u32, children: [NONE; 2], distance: distance.sqrt() });
            ranges.push((point, last, Some((number, 1))));
            ranges.push((first, point, Some((number, 0))));
        }
        Self { nodes }
    }

    /// Calls `keep` with each point between the ends that is left, in order: no point that is left out is farther than `tolerance` from the
    /// segment between those that are left before and after it.
    pub fn select(&self, tolerance: f64, mut keep: impl FnMut(u32)) {
        let is_kept =
            |number: &u32| self.nodes.get(*number as usize).is_some_and(|node| node.distance > tolerance);
        // In order: what is before a node, the node, what is after it.
        let mut ahead = Vec::new();
        let mut at = Some(0).filter(is_kept);
        loop {
            while let Some(number) = at {
                ahead.push(number);
                at = Some(self.nodes[number as usize].children[0]).filter(is_kept);
            }
            let Some(number) = ahead.pop() else { return };
            let node = &self.nodes[number as usize];
            keep(node.point);
            at = Some(node.children[1]).filter(is_kept);
        }
    }
}

/// The square of a point's distance from a segment.
fn squared_distance(point: DVec3, [a, b]: [DVec3; 2]) -> f64 {
    let along = b - a;
    let length = along.length_squared();
    let share = if length > 0.0 { ((point - a).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    (point - (a + along * share)).length_squared()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn line() -> impl Strategy<Value = Vec<DVec3>> {
        let at = || prop_oneof![-4.0..4.0f64, (-3..4i8).prop_map(f64::from)];
        prop::collection::vec((at(), at(), at()).prop_map(|(x, y, z)| DVec3::new(x, y, z)), 0..40)
    }

    fn selected(tree: &BlgTree, tolerance: f64) -> Vec<u32> {
        let mut kept = Vec::new();
        tree.select(tolerance, |point| kept.push(point));
        kept
    }

    /// Douglas and Peucker's algorithm as its authors tell it.
    fn douglas_peucker(points: &[DVec3], first: usize, last: usize, tolerance: f64, kept: &mut Vec<u32>) {
        let distance = |k: &usize| squared_distance(points[*k], [points[first], points[last]]);
        let off_middle = |k: &usize| (2 * k).abs_diff(first + last);
        let order = |a: &usize, b: &usize| {
            distance(a).total_cmp(&distance(b)).then(off_middle(b).cmp(&off_middle(a))).then(b.cmp(a))
        };
        if let Some(farthest) = (first + 1..last).max_by(order).filter(|k| distance(k).sqrt() > tolerance) {
            douglas_peucker(points, first, farthest, tolerance, kept);
            kept.push(farthest as u32);
            douglas_peucker(points, farthest, last, tolerance, kept);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn what_a_tolerance_leaves_is_what_douglas_and_peucker_leave(points in line(), tolerance in 0.0..3.0f64) {
            let tree = BlgTree::new(&points);
            let kept = selected(&tree, tolerance);
            let mut expected = Vec::new();
            douglas_peucker(&points, 0, points.len().saturating_sub(1), tolerance, &mut expected);
            prop_assert_eq!(&kept, &expected);
            // And is as near as it says.
            let ends = [0].into_iter().chain(kept).chain([points.len().saturating_sub(1) as u32]);
            for pair in ends.collect::<Vec<_>>().windows(2) {
                let [from, to] = [pair[0] as usize, pair[1] as usize];
                for k in from + 1..to {
                    prop_assert!(squared_distance(points[k], [points[from], points[to]]).sqrt() <= tolerance);
                }
            }
        }
    }

    #[test]
    fn a_tolerance_below_0_leaves_all_points_and_a_long_zigzag_makes_no_deep_tree() {
        let zigzag: Vec<_> = (0..4096).map(|k| DVec3::new(f64::from(k), f64::from(k % 2), 0.0)).collect();
        let tree = BlgTree::new(&zigzag);
        assert_eq!(selected(&tree, -1.0), (1..4095).collect::<Vec<_>>());
        assert_eq!(selected(&tree, 1.5), [0; 0]);
        let mut depths = vec![0; tree.nodes.len()];
        for (k, node) in tree.nodes.iter().enumerate() {
            node.children
                .iter()
                .filter(|child| **child != NONE)
                .for_each(|c| depths[*c as usize] = depths[k] + 1);
        }
        assert!(depths.iter().max().unwrap() < &30, "{:?}", depths.iter().max());
    }

    #[test]
    fn what_lies_beyond_a_segments_end_is_as_far_as_from_that_end() {
        let hook = [0.0, 3.0, 2.0].map(|x| DVec3::new(x, 0.0, 0.0));
        let closed = [0.0, 3.0, 0.0].map(|z| DVec3::new(0.0, 0.0, z));
        for (points, distance) in [(hook, 1.0), (closed, 3.0)] {
            let tree = BlgTree::new(&points);
            assert_eq!(selected(&tree, distance - 0.01), [1]);
            assert_eq!(selected(&tree, distance), [0; 0]);
        }
    }

    #[test]
    fn lines_of_two_points_and_fewer_have_no_nodes() {
        for count in 0..3 {
            let tree = BlgTree::new(&vec![DVec3::ONE; count]);
            assert_eq!(selected(&tree, -1.0), [0; 0]);
            assert!(tree.nodes.is_empty());
        }
    }
}
