//! Many short paths, evenly spread.

use super::random::Sequence;
use super::roads::direction;
use crate::math::{cos, sin};
use crate::scene::Shape;
use crate::scene_file::VectorGenerator;
use crate::space::PlanBox;
use glam::DVec2;

/// The most segments of a path; on average they have a little more than half as many.
const LONGEST: usize = 5;

/// Paths of `count` segments in all, each anywhere in the window; they bend a little, and may leave it by their length.
pub(super) fn paths(generator: &VectorGenerator, segment_m: Option<f64>, window: PlanBox) -> Vec<Shape> {
    let size = window.max - window.min;
    let step = segment_m.unwrap_or(crate::math::max(size.x, size.y) / 5000.0);
    let mut random = Sequence::new(generator.seed);
    let mut left = generator.count;
    let mut paths = Vec::new();
    while left > 0 {
        let segments = (1 + random.below(LONGEST)).min(left);
        left -= segments;
        let mut at = window.min + DVec2::new(random.unit() * size.x, random.unit() * size.y);
        let mut heading = direction(&mut random);
        let mut path = vec![at];
        for _ in 0..segments {
            at = at + heading * (step * (0.5 + random.unit()));
            path.push(at);
            let turn = 0.6 * random.signed();
            heading = heading.rotate(DVec2::new(cos(turn), sin(turn)));
        }
        paths.push(Shape::Line(vec![path]));
    }
    paths
}

#[cfg(test)]
mod tests {
    use super::super::{features, tests::*};
    use super::*;
    use crate::scene_file::VectorKind;
    use crate::space::Plan;

    fn lines(count: usize) -> Vec<Vec<Plan>> {
        let kind = VectorKind::Paths { segment_m: Some(20.0) };
        let generator = VectorGenerator { kind, seed: 3, count, window: None };
        let line = |shape| {
            if let Shape::Line(mut lines) = shape { lines.remove(0) } else { panic!("not a line") }
        };
        features(&generator, window()).into_iter().map(|feature| line(feature.shape)).collect()
    }

    #[test]
    fn paths_have_exactly_the_segments_asked_for_some_three_each() {
        for count in [1, 7, 10_000] {
            let lines = lines(count);
            assert_eq!(lines.iter().map(|line| line.len() - 1).sum::<usize>(), count);
        }
        assert!((3000..3700).contains(&lines(10_000).len()));
    }

    #[test]
    fn paths_start_inside() {
        assert!(lines(1000).iter().all(|line| inside(line[0])));
    }

    #[test]
    fn paths_keep_their_bits() {
        assert_eq!(bits(&lines(5000)), "d969b52d33f544fa");
    }
}
