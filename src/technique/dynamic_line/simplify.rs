//! Which vertices of a piece of a line a view keeps (3.3.1).
//!
//! Input: the screen points of consecutive vertices, where they have one. Output: the places of those that are kept. Refuses: nothing; a vertex that
//! is not before the eye is always kept.

use crate::math;
use crate::space::Plan;

/// The proposal of 3.3.1, by Algorithm 3.2: a vertex goes where it lies in the same pixel as the one before it; the first vertex is not asked.
/// Pixels are compared as columns and rows: the index of line 3 would take some vertices beside the picture for others within.
pub fn same_pixel(screen: &[Option<Plan>], kept: &mut Vec<u32>) {
    let pixel = |at: &Option<Plan>| at.map(|at| (at.x.floor(), at.y.floor()));
    let differs =
        |pair: &[Option<Plan>]| pixel(&pair[0]).is_none_or(|before| pixel(&pair[1]) != Some(before));
    kept.extend((1..).zip(screen.windows(2)).filter(|(_, pair)| differs(pair)).map(|(k, _)| k));
}

/// Leaves out vertices that are no farther than `error` pixels from the segment that remains; the first and the last vertex stay, and the first is not
/// named.
///
/// From a kept vertex the segment grows as long as a ray from there meets a disc of that radius around each vertex that is left out: those
/// rays are a [`Cone`]. A vertex that is left out is then nearer than `error` to the ray, at a place that is no farther from its start than the
/// vertex is: the segment has to be as long.
pub fn screen_error(screen: &[Option<Plan>], error: f64, kept: &mut Vec<u32>) {
    let last = screen.len() - 1;
    let mut start = 0;
    while start < last {
        let end = farthest_end(&screen[start..], error) + start;
        kept.push(end as u32);
        start = end;
    }
}

/// How many vertices a segment may look ahead beyond its last good end.
const MOST_AHEAD: usize = 256;

/// The farthest vertex that a segment from the first one may end at.
fn farthest_end(screen: &[Option<Plan>], error: f64) -> usize {
    let Some(start) = screen[0] else { return 1 };
    let (mut good, mut cone, mut reach) = (1, Cone::All, 0.0);
    // A share for the rounding of these few operations.
    let error = error * (1.0 - 1e-9);
    for (k, at) in screen.iter().enumerate().skip(1) {
        let way = at.map(|at| [at.x - start.x, at.y - start.y]);
        let Some(way) = way.filter(|way| squared(*way).is_finite()) else { break };
        let length = squared(way).sqrt();
        // A segment of no length has only what lies around its start, which `reach` tells.
        if length >= reach && (length == 0.0 || cone.has(way)) {
            good = k;
        } else if k > good + MOST_AHEAD {
            break;
        }
        if length > error {
            reach = math::max(reach, length);
            cone = cone.narrowed(way, error / length);
        }
        if matches!(cone, Cone::Empty) {
            break;
        }
    }
    good
}

/// Directions that are left.
#[derive(Debug, Clone, Copy)]
enum Cone {
    /// Every one.
    All,
    /// Those between two that are less than half a turn apart: to the left of the first (y up), to the right of the second.
    Between([f64; 2], [f64; 2]),
    /// None.
    Empty,
}

fn squared([x, y]: [f64; 2]) -> f64 {
    x * x + y * y
}

/// Positive where `b` lies to the left of `a`.
fn turn(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

impl Cone {
    fn has(&self, way: [f64; 2]) -> bool {
        match *self {
            Self::All => true,
            Self::Between(first, second) => turn(first, way) >= 0.0 && turn(way, second) >= 0.0,
            Self::Empty => false,
        }
    }

    /// Those that meet a disc at the end of a way, whose radius is `sine` (less than 1) times the way's length, too.
    fn narrowed(self, way: [f64; 2], sine: f64) -> Self {
        let cosine = (1.0 - sine * sine).sqrt();
        let turned = |sine: f64| [way[0] * cosine - way[1] * sine, way[0] * sine + way[1] * cosine];
        let (low, high) = (turned(-sine), turned(sine));
        let Self::Between(first, second) = self else {
            return if matches!(self, Self::All) { Self::Between(low, high) } else { Self::Empty };
        };
        // Both cones are less than half a turn wide. They share a direction where one has an end of the other.
        let disc = Self::Between(low, high);
        match (self.has(low), self.has(high), disc.has(first), disc.has(second)) {
            (true, true, ..) => disc,
            (true, false, _, true) => Self::Between(low, second),
            (false, true, true, _) => Self::Between(first, high),
            (_, _, true, true) => self,
            _ => Self::Empty,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn at(x: f64, y: f64) -> Option<Plan> {
        Some(Plan::new(x, y))
    }

    fn kept(by: impl Fn(&mut Vec<u32>)) -> Vec<u32> {
        let mut out = Vec::new();
        by(&mut out);
        out
    }

    #[test]
    fn vertices_in_the_pixel_of_the_one_before_go() {
        let line =
            [at(0.2, 0.5), at(0.9, 0.1), at(1.1, 0.1), at(1.9, 0.9), at(0.5, 0.5), None, None, at(0.5, 0.5)];
        assert_eq!(kept(|out| same_pixel(&line, out)), [2, 4, 5, 6, 7]);
        // (-1, 5) and (9, 4) have one index in a picture of ten columns.
        assert_eq!(kept(|out| same_pixel(&[at(9.5, 4.5), at(-0.5, 5.5)], out)), [1]);
    }

    #[test]
    fn a_straight_line_keeps_its_ends() {
        let line: Vec<_> = (0..40).map(|k| at(f64::from(k), 0.3 * f64::from(k))).collect();
        assert_eq!(kept(|out| screen_error(&line, 0.1, out)), [39]);
    }

    #[test]
    fn a_line_that_runs_back_keeps_its_turning_point() {
        let line = [at(0.0, 0.0), at(5.0, 0.0), at(10.0, 0.0), at(5.0, 0.0), at(1.0, 0.0)];
        assert_eq!(kept(|out| screen_error(&line, 0.5, out)), [2, 4]);
    }

    proptest! {
        #[test]
        fn no_vertex_that_goes_is_farther_than_the_error_from_its_segment(
            steps in prop::collection::vec((-4.0..8.0f64, -3.0..3.0f64), 1..80),
            error in 0.05..4.0f64,
        ) {
            let mut line = vec![Plan::default()];
            for (x, y) in steps {
                line.push(*line.last().unwrap() + glam::DVec2::new(x, y));
            }
            let screen: Vec<_> = line.iter().copied().map(Some).collect();
            let mut ends = vec![0];
            screen_error(&screen, error, &mut ends);
            prop_assert_eq!(*ends.last().unwrap() as usize, line.len() - 1);
            for pair in ends.windows(2) {
                let (a, b) = (line[pair[0] as usize], line[pair[1] as usize]);
                for &p in &line[pair[0] as usize..pair[1] as usize] {
                    let (d, v) = (b - a, p - a);
                    let t = if d.length_squared() > 0.0 { (v.dot(d) / d.length_squared()).clamp(0.0, 1.0) } else { 0.0 };
                    prop_assert!((v - d * t).length() <= error, "{:?} of {:?}", p, pair);
                }
            }
        }
    }
}
