//! 3D segment boxes (3.3.2, 4.3.2, Algorithms 3.3 and 3.4, Figs. 3.6 and 4.4), and the pixels that their pictures cover.
//!
//! Input: a segment, half its width in pixels, a view, the terrain's heights. Output: a [`SegmentBox`] and its [`Outline`] on the screen.
//! - Algorithm 3.4 shifts vertices along the bisector by half the box's width, 4.3.2 calls the shift the mitre vector of 3.6: that is longer by
//!   1 / cos(half the turn), and only with it neighbouring boxes are as wide as the line. Where a line turns straight back there is no mitre: its boxes
//!   end at right angles.
//! - "The projection" of a box that its mitres twist is that of all that its corners span.
//! - The near plane cuts boxes; the far plane does not.
//!
//! Refuses: nothing; a box whose numbers leave the range of the device's covers the whole picture.

use super::camera::{Camera, P2, P3};
use super::update::Segment;
use crate::math;
use crate::raster::device::Real;
use crate::space::Plan;
use crate::technique::dynamic_line::Boxes;
use crate::terrain::Mesh;

/// What all boxes of a view have in common.
#[derive(Debug, Clone, Copy)]
pub struct BoxMaker<T> {
    /// The view.
    pub camera: Camera<T>,
    heights: [T; 2],
    /// How far the terrain may be above or below the eye.
    away: T,
    boxes: Boxes,
}

/// A box around what a segment may cover.
#[derive(Debug, Clone, Copy)]
pub struct SegmentBox<T> {
    /// Its corners in the plan: at the start left and right, at the end right and left.
    pub plan: [P2<T>; 4],
    heights: [T; 2],
}

/// 1 + cos of a turn below which a line runs straight back.
const STRAIGHT_BACK: f64 = 1e-6;

/// The vector from a vertex to the left corner of a line of half width 1 (3.6): where the sides of both segments meet. `None`: it turns straight back,
/// or a segment has no length.
pub fn miter<T: Real>(before: P2<T>, at: P2<T>, after: P2<T>) -> Option<P2<T>> {
    let (into, out) = (at.minus(before).normalized()?, after.minus(at).normalized()?);
    let share = T::of(1.0) + into.dot(out);
    let sum = into.plus(out).left();
    (share.get() > STRAIGHT_BACK).then(|| P2 { x: sum.x / share, y: sum.y / share })
}

impl<T: Real> BoxMaker<T> {
    /// The boxes of a view of a terrain.
    pub fn new(camera: Camera<T>, mesh: &Mesh, boxes: Boxes) -> Self {
        let (low, high) = mesh.heights().unwrap_or_default();
        // 4.3.2: a small offset, so that no box is flat and none touches the surface.
        let offset = (high - low) / 1024.0 + mesh.resolution() / 64.0;
        let heights = [T::of(low - offset), T::of(high + offset)];
        let eye = camera.eye().map_or(0.0, |eye| eye.z.get());
        let away = T::of(math::max((high - eye).abs(), (low - eye).abs()));
        Self { camera, heights, away, boxes }
    }

    /// Half the width of a segment's box.
    fn half_width(&self, segment: &Segment<T>, half_px: T) -> T {
        let most = |a: T, b: T| if a > b { a } else { b };
        if self.boxes != Boxes::Enclosing {
            // Algorithm 3.3.
            let (start, end) = (self.camera.pixel_at(segment.start), self.camera.pixel_at(segment.end));
            return half_px * most(start, end);
        }
        let growth = half_px * self.camera.pixel();
        let slack = self.slack(segment);
        let Some(eye) = self.camera.eye() else { return growth + slack };
        // The widest place: reach = growth * r, r <= the distance of (far + reach, away).
        let one = T::of(1.0);
        let distance = |p: P3<T>| {
            let d = p.minus(eye).plan();
            d.dot(d).sqrt()
        };
        let far = most(distance(segment.start), distance(segment.end));
        let g = growth * growth;
        let root = (g * g * far * far + (one - g) * g * (far * far + self.away * self.away)).sqrt();
        let reach = (g * far + root) / (one - g);
        if growth < one { reach * T::of(1.0 + 1e-6) + slack } else { T::of(f64::INFINITY) }
    }

    /// What rounding may do to surface points near a segment, and to their pictures: some roundings of numbers as large as the coordinates and those of view
    /// space.
    fn slack(&self, segment: &Segment<T>) -> T {
        let size = |p: P3<T>| {
            let at = p.get();
            at.x.abs() + at.y.abs() + at.z.abs()
        };
        let sizes = [segment.start, segment.end].map(|p| size(p) + size(self.camera.view(p)));
        T::of(ROUNDINGS * (sizes[0] + sizes[1] + self.away.get()))
    }

    /// Algorithm 3.4.
    pub fn of(&self, segment: &Segment<T>, half_px: T) -> SegmentBox<T> {
        let half = self.half_width(segment, half_px);
        let (start, end) = (segment.start.plan(), segment.end.plan());
        let zero = T::of(0.0);
        let along = end.minus(start).normalized().unwrap_or(P2 { x: T::of(1.0), y: zero });
        let normal = along.left();
        let mitre = |before: Option<P2<T>>, at, after: Option<P2<T>>| {
            let wanted = self.boxes == Boxes::Mitred;
            before.zip(after).filter(|_| wanted).and_then(|(before, after)| miter(before, at, after))
        };
        // A line's ends, and all corners of overlapping boxes, reach half a width further.
        let runs_on = |neighbour: Option<P2<T>>| neighbour.is_none() || self.boxes != Boxes::Mitred;
        let shift = |neighbour| if runs_on(neighbour) { along.times(half) } else { P2 { x: zero, y: zero } };
        let front = mitre(segment.before, start, Some(end)).unwrap_or(normal).times(half);
        let back = mitre(Some(start), end, segment.after).unwrap_or(normal).times(half);
        let (from, to) = (start.minus(shift(segment.before)), end.plus(shift(segment.after)));
        let plan = [from.plus(front), from.minus(front), to.minus(back), to.plus(back)];
        SegmentBox { plan, heights: self.heights }
    }

    /// The picture of a box, and what lies within `margin` pixels of it in both directions; `None`: nothing of it lies before the near plane.
    pub fn outline(&self, of: &SegmentBox<T>, margin: f64) -> Option<Outline> {
        let camera = &self.camera;
        let seen: [P3<T>; 8] = std::array::from_fn(|k| {
            let P2 { x, y } = of.plan[k % 4];
            camera.view(P3 { x, y, z: of.heights[k / 4] })
        });
        let mut points = Vec::with_capacity(32);
        let mut add = |seen: P3<T>| {
            let at = camera.screen(seen).get();
            let ends = [-margin, margin];
            match margin > 0.0 {
                true => points.extend(
                    ends.into_iter()
                        .flat_map(|x| ends.into_iter().map(move |y| Plan::new(at.x + x, at.y + y))),
                ),
                false => points.push(at),
            }
        };
        let before = seen.map(|p| camera.is_before(p));
        seen.iter().zip(before).filter(|(_, before)| *before).for_each(|(p, _)| add(*p));
        if before.contains(&true) && before.contains(&false) {
            // All that the corners span is cut: each way between two of them.
            for (k, j) in (0..8).flat_map(|k| (0..k).map(move |j| (k, j))) {
                if before[k] != before[j] {
                    add(camera.at_near(seen[k], seen[j]));
                }
            }
        }
        (!points.is_empty()).then(|| Outline::around(points))
    }
}

/// What rounding may do, as a share of the numbers that go into it.
const ROUNDINGS: f64 = 128.0 * f64::EPSILON;

/// Pixels: what reaches farther covers the whole picture.
const FARTHEST: f64 = 1e100;

/// A convex part of the screen.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    /// Its corners in order; none: the whole screen.
    corners: Vec<Plan>,
    /// By how much rounding may have moved its sides.
    slack: f64,
}

impl Outline {
    /// The convex hull of some points (Andrew 1979, the monotone chain).
    fn around(mut points: Vec<Plan>) -> Self {
        if !points.iter().all(|p| p.x.abs() < FARTHEST && p.y.abs() < FARTHEST) {
            return Self { corners: Vec::new(), slack: 0.0 };
        }
        let farthest = points.iter().map(|p| math::max(p.x.abs(), p.y.abs())).fold(0.0, math::max);
        points.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        let mut corners: Vec<Plan> = Vec::with_capacity(points.len() + 1);
        let mut chain = |points: &mut dyn Iterator<Item = &Plan>, floor: usize| {
            for p in points {
                while corners.len() >= floor + 2 {
                    let (a, b) = (corners[corners.len() - 2], corners[corners.len() - 1]);
                    if (b - a).perp_dot(*p - b) > 0.0 {
                        break;
                    }
                    corners.pop();
                }
                corners.push(*p);
            }
            corners.pop();
            corners.len()
        };
        let lower = chain(&mut points.iter(), 0);
        chain(&mut points.iter().rev(), lower);
        if corners.is_empty() {
            corners.push(points[0]);
        }
        Self { corners, slack: ROUNDINGS * farthest }
    }

    /// The columns and rows of a picture around the centres in it; `None`: there are none.
    pub fn window(&self, [width, height]: [usize; 2]) -> Option<[std::ops::Range<usize>; 2]> {
        if self.corners.is_empty() {
            return Some([0..width, 0..height]);
        }
        let range = |of: fn(&Plan) -> f64, count: usize| {
            let low = self.corners.iter().map(of).fold(f64::INFINITY, math::min);
            let high = self.corners.iter().map(of).fold(f64::NEG_INFINITY, math::max);
            centres(low - self.slack, high + self.slack, 0..count)
        };
        let (columns, rows) = (range(|p| p.x, width), range(|p| p.y, height));
        (!columns.is_empty() && !rows.is_empty()).then_some([columns, rows])
    }

    /// The columns of `columns` whose centres in a row lie in it, as far as rounding tells.
    pub fn columns(&self, row: usize, columns: std::ops::Range<usize>) -> std::ops::Range<usize> {
        if self.corners.is_empty() {
            return columns;
        }
        let y = row as f64 + 0.5;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (k, a) in self.corners.iter().enumerate() {
            let b = &self.corners[(k + 1) % self.corners.len()];
            let is_beyond = |p: &Plan| [p.y > y + self.slack, p.y < y - self.slack];
            if is_beyond(a).into_iter().zip(is_beyond(b)).any(|(a, b)| a && b) {
                continue;
            }
            // The same point whichever way the edge runs.
            let (a, b) = if (a.y, a.x) <= (b.y, b.x) { (a, b) } else { (b, a) };
            let share = math::min(math::max((y - a.y) / (b.y - a.y), 0.0), 1.0);
            let ends = if a.y == b.y { [a.x, b.x] } else { [a.x + (b.x - a.x) * share; 2] };
            low = math::min(low, math::min(ends[0], ends[1]));
            high = math::max(high, math::max(ends[0], ends[1]));
        }
        centres(low - self.slack, high + self.slack, columns)
    }
}

/// The pixels of a range whose centres lie between two places, both included.
fn centres(low: f64, high: f64, range: std::ops::Range<usize>) -> std::ops::Range<usize> {
    if low > high {
        return range.start..range.start;
    }
    // Casts saturate: what lies before the first pixel becomes 0.
    let from = ((low - 0.5).ceil() as usize).max(range.start);
    let to = if high < 0.5 { 0 } else { ((high - 0.5).floor() as usize).saturating_add(1).min(range.end) };
    from..to.max(from)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn an_outline_has_the_centres_that_no_edge_between_its_points_keeps_out(
            points in prop::collection::vec((-3.0..12.0f64, -3.0..12.0f64), 1..12),
        ) {
            let points: Vec<Plan> = points.into_iter().map(|(x, y)| Plan::new(x, y)).collect();
            let outline = Outline::around(points.clone());
            let is_in = |p: Plan| {
                let left = |a: Plan, b: Plan, c: Plan| (b - a).perp_dot(c - a);
                points.iter().all(|a| points.iter().all(|b| {
                    let is_edge = points.iter().all(|c| left(*a, *b, *c) >= 0.0);
                    !is_edge || a == b || left(*a, *b, p) >= 0.0
                }))
            };
            let window = outline.window([10, 9]);
            for row in 0..9 {
                let columns = outline.columns(row, 0..10);
                for column in 0..10 {
                    let inside = is_in(Plan::new(column as f64 + 0.5, row as f64 + 0.5)) && points.len() > 2;
                    prop_assert_eq!(columns.contains(&column), inside, "{} {}", column, row);
                    let in_window = window.as_ref().is_some_and(|[c, r]| c.contains(&column) && r.contains(&row));
                    prop_assert!(in_window || !inside);
                }
            }
        }
    }

    #[test]
    fn a_mitre_reaches_where_the_sides_meet() {
        let p = |x: f64, y: f64| P2 { x, y };
        let at = miter(p(0.0, 0.0), p(4.0, 0.0), p(4.0, 4.0)).unwrap();
        assert_eq!((at.x, at.y), (-1.0, 1.0));
        assert_eq!(miter(p(0.0, 0.0), p(4.0, 0.0), p(1.0, 0.0)), None);
    }
}
