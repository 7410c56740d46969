//! A network of wandering roads.

use super::random::Sequence;
use crate::math::{max, min};
use crate::scene::Shape;
use crate::scene_file::VectorGenerator;
use crate::space::{Plan, PlanBox};
use glam::DVec2;

/// The most segments of one road.
const LONGEST: usize = 240;

/// Roads of `count` segments in all. Most start at a junction: a vertex of an earlier road; each wanders until it has
/// had enough or leaves the window.
pub(super) fn roads(generator: &VectorGenerator, segment_m: Option<f64>, window: PlanBox) -> Vec<Shape> {
    let size = window.max - window.min;
    let walker = Walker { window, step: segment_m.unwrap_or(max(size.x, size.y) / 200.0) };
    let mut random = Sequence::new(generator.seed);
    let mut roads: Vec<Vec<Plan>> = Vec::new();
    let mut left = generator.count;
    while left > 0 {
        let start = walker.start(&roads, &mut random);
        let most = (LONGEST / 4 + random.below(LONGEST * 3 / 4)).min(left);
        let road = walker.walk(start, most, &mut random);
        left -= road.len() - 1;
        roads.push(road);
    }
    roads.into_iter().map(|road| Shape::Line(vec![road])).collect()
}

struct Walker {
    window: PlanBox,
    step: f64,
}

impl Walker {
    /// Where a road starts and in which direction.
    fn start(&self, roads: &[Vec<Plan>], random: &mut Sequence) -> (Plan, DVec2) {
        let earlier =
            roads.get(random.below(roads.len())).filter(|road| road.len() > 8 && random.unit() < 0.7);
        let Some(road) = earlier else {
            return (self.anywhere(random), direction(random));
        };
        let at = 2 + random.below(road.len() - 4);
        let along = road[at + 1] - road[at - 1];
        let across = if random.unit() < 0.5 { along.perp() } else { -along.perp() };
        (road[at], normalized(across).unwrap_or(DVec2::X))
    }

    fn anywhere(&self, random: &mut Sequence) -> Plan {
        let size = self.window.max - self.window.min;
        self.window.min + DVec2::new(random.unit() * size.x, random.unit() * size.y)
    }

    /// At least one segment, at most so many.
    fn walk(&self, (start, mut heading): (Plan, DVec2), most: usize, random: &mut Sequence) -> Vec<Plan> {
        let mut road = vec![start];
        let (mut here, mut bend, course) = (start, 0.0, heading);
        while road.len() <= most {
            // The bend changes slowly, and turns back to the first course: curves, neither a zigzag nor a knot.
            bend = 0.9 * bend + 0.07 * random.signed() + 0.02 * heading.perp_dot(course);
            heading = normalized(heading + heading.perp() * bend).unwrap_or(DVec2::X);
            let there = here + heading * self.step;
            here = self.inside(there);
            road.push(here);
            if here != there {
                break;
            }
        }
        road
    }

    fn inside(&self, p: Plan) -> Plan {
        let PlanBox { min: low, max: high } = self.window;
        Plan::new(min(max(p.x, low.x), high.x), min(max(p.y, low.y), high.y))
    }
}

/// A direction of unit length.
pub(super) fn direction(random: &mut Sequence) -> DVec2 {
    normalized(DVec2::new(random.signed(), random.signed())).unwrap_or(DVec2::X)
}

/// A vector's direction; `None` for that of no length.
pub(super) fn normalized(v: DVec2) -> Option<DVec2> {
    let length = (v.x * v.x + v.y * v.y).sqrt();
    (length > 0.0).then(|| DVec2::new(v.x / length, v.y / length))
}

#[cfg(test)]
mod tests {
    use super::super::{features, tests::*};
    use super::*;
    use crate::scene_file::VectorKind;

    fn lines(count: usize) -> Vec<Vec<Plan>> {
        let generator =
            VectorGenerator { kind: VectorKind::Roads { segment_m: None }, seed: 3, count, window: None };
        let line = |shape| {
            if let Shape::Line(mut lines) = shape { lines.remove(0) } else { panic!("not a line") }
        };
        features(&generator, window()).into_iter().map(|feature| line(feature.shape)).collect()
    }

    #[test]
    fn roads_have_exactly_the_segments_asked_for_and_stay_inside() {
        for count in [1, 7, 1000, 20_000] {
            let lines = lines(count);
            assert_eq!(lines.iter().map(|line| line.len() - 1).sum::<usize>(), count);
            assert!(lines.iter().flatten().all(|p| inside(*p)));
        }
    }

    #[test]
    fn most_roads_start_at_a_vertex_of_an_earlier_one() {
        let lines = lines(20_000);
        let joined = (1..lines.len()).filter(|&at| lines[..at].iter().flatten().any(|p| *p == lines[at][0]));
        assert!(joined.count() * 2 > lines.len());
    }

    #[test]
    fn steps_longer_than_the_window_come_to_an_end() {
        let kind = VectorKind::Roads { segment_m: Some(1e9) };
        let generator = VectorGenerator { kind, seed: 3, count: 50, window: Some([0.0, 0.0, 1.0, 1.0]) };
        assert_eq!(features(&generator, window()).len(), 50);
    }

    #[test]
    fn roads_keep_their_bits() {
        assert_eq!(bits(&lines(5000)), "2e33c0886bbdea0a");
    }
}
