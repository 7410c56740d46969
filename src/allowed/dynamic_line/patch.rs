//! All the places of the plan that a pixel's centre may see on one triangle.

use crate::allowed::model::{Guess, View};
use crate::allowed::surface::Surface;
use crate::math;
use crate::space::{Lens, Plan, PlanBox, Screen, World};
use crate::terrain::Mesh;

/// A convex part of the plan, and how far from the eye the surface is over it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Patch {
    /// Its corners, in order.
    corners: Vec<Plan>,
    /// Least and largest, metres.
    pub(super) distance: [f64; 2],
    /// What single precision does to such places, metres.
    pub(super) slack: f64,
}

/// What single precision does to places, as a share of the coordinates that go into them: some ten roundings.
const SINGLE_SHARE: f64 = 1.0 / (1 << 20) as f64;

impl Patch {
    /// That of a pixel's centre, which a machine takes within a shift of its place and whose depth it rounds. The triangle's plane tells where
    /// that is; the surface's box bounds it.
    pub(super) fn new(view: &View, guess: &Guess, mesh: &Mesh, surface: &Surface, pixel: [usize; 2]) -> Self {
        let frame = view.frame;
        let shift = guess.envelope.shift();
        let centre = pixel.map(|v| v as f64 + 0.5);
        let corners = mesh.triangle(surface.triangle);
        let hit = |x: f64, y: f64| {
            let ray = frame.ray(Screen::new(centre[0] + x, centre[1] + y));
            let way = (ray.through - ray.from) / frame.reach();
            let [a, b, c] = corners?;
            let normal = (b - a).cross(c - a);
            let depth = normal.dot(a - ray.from) / normal.dot(way);
            (depth.is_finite() && depth > 0.0).then(|| (ray.from + way * depth, depth, way))
        };
        let places: [_; 5] = [(0.0, 0.0), (-shift, -shift), (shift, -shift), (shift, shift), (-shift, shift)]
            .map(|(x, y)| hit(x, y));
        let plan = surface.plan;
        let boxed =
            [plan.min, Plan::new(plan.max.x, plan.min.y), plan.max, Plan::new(plan.min.x, plan.max.y)];
        let eye = frame.eye();
        let whole = || {
            // The plane is seen edge-on: the box is all that is known.
            let corner = frame.lens().pixel() * ((frame.width() + frame.height()) as f64 / 2.0);
            let (near, far) = surface.depth;
            let slack = SINGLE_SHARE * (eye.to_vec().abs().max_element() + far);
            let distance = match frame.lens() {
                Lens::Central { .. } => [near - slack, far * (1.0 + corner) + slack],
                Lens::Parallel { .. } => [1.0; 2],
            };
            Self { corners: boxed.to_vec(), distance, slack }
        };
        let [Some((at, depth, way)), rest @ ..] = places else { return whole() };
        let Some(rest) = rest.into_iter().collect::<Option<Vec<_>>>() else { return whole() };
        let size = |p: World| p.to_vec().abs().max_element();
        let slack = SINGLE_SHARE * (size(at) + size(eye));
        // A machine's point lies on the ray through the centre, as deep as another place of the square, rounded.
        let apart = rest.iter().fold(0.0, |most, (_, other, _)| math::max((other - depth).abs(), most));
        let along = way * (apart + guess.envelope.along(frame, depth));
        let mut points: Vec<Plan> = Vec::with_capacity(8);
        let mut distance = [f64::INFINITY, 0.0];
        for (place, ..) in &rest {
            points.extend([*place + along, *place + -along].map(World::plan));
            let from_eye = (*place - eye).length();
            distance = [math::min(from_eye, distance[0]), math::max(from_eye, distance[1])];
        }
        let reach = along.length() + slack;
        let corners = clipped(hull(points), &plan.grown(along.truncate().length() + slack));
        let distance = match frame.lens() {
            Lens::Central { .. } => [distance[0] - reach, distance[1] + reach],
            Lens::Parallel { .. } => [1.0; 2],
        };
        if corners.is_empty() {
            return Self { corners: boxed.to_vec(), distance, slack };
        }
        Self { corners, distance, slack }
    }

    /// A box around it.
    pub(super) fn bounds(&self) -> PlanBox {
        PlanBox::around(self.corners.iter().copied()).grown(self.slack)
    }

    /// Whether all of it lies to the left of a way (y up).
    pub(super) fn is_left_of(&self, [from, to]: [Plan; 2]) -> bool {
        let along = to - from;
        let least = self.slack * along.length();
        self.corners.iter().all(|p| along.perp_dot(*p - from) >= least)
    }

    /// How far its places are from a segment: at least and at most.
    pub(super) fn distances(&self, ends: [Plan; 2]) -> [f64; 2] {
        let most = self.corners.iter().map(|p| to_segment(*p, ends)).fold(0.0, math::max);
        let mut least = self.corners.iter().map(|p| to_segment(*p, ends)).fold(f64::INFINITY, math::min);
        let count = self.corners.len();
        let sides = (0..count).map(|k| [self.corners[k], self.corners[(k + 1) % count]]);
        let mut is_left = true;
        for side in sides {
            if cross(side, ends) {
                return [0.0, most + self.slack];
            }
            is_left &= (side[1] - side[0]).perp_dot(ends[0] - side[0]) >= 0.0;
            least = math::min(math::min(to_segment(ends[0], side), to_segment(ends[1], side)), least);
        }
        let least = if is_left && count > 2 { 0.0 } else { least };
        [math::max(least - self.slack, 0.0), most + self.slack]
    }
}

/// The distance of a point from a segment.
pub(super) fn to_segment(p: Plan, [a, b]: [Plan; 2]) -> f64 {
    let (along, from) = (b - a, p - a);
    let length = along.length_squared();
    let t = if length > 0.0 { math::min(math::max(from.dot(along) / length, 0.0), 1.0) } else { 0.0 };
    (from - along * t).length()
}

/// Whether two segments cross or touch.
fn cross([a, b]: [Plan; 2], [c, d]: [Plan; 2]) -> bool {
    let side = |a: Plan, b: Plan, p: Plan| (b - a).perp_dot(p - a);
    side(a, b, c) * side(a, b, d) <= 0.0
        && side(c, d, a) * side(c, d, b) <= 0.0
        && PlanBox::around([a, b]).meets(&PlanBox::around([c, d]))
}

/// The corners of the smallest convex set around points, counter-clockwise (y up).
pub(super) fn hull(mut points: Vec<Plan>) -> Vec<Plan> {
    points.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let mut corners: Vec<Plan> = Vec::with_capacity(points.len() + 1);
    let mut half = |points: &mut dyn Iterator<Item = &Plan>| {
        let floor = corners.len();
        for p in points {
            while corners.len() >= floor + 2 {
                let [a, b] = [corners[corners.len() - 2], corners[corners.len() - 1]];
                if (b - a).perp_dot(*p - b) > 0.0 {
                    break;
                }
                corners.pop();
            }
            corners.push(*p);
        }
        corners.pop();
    };
    half(&mut points.iter());
    half(&mut points.iter().rev());
    corners
}

/// The part of a convex polygon in a box.
fn clipped(mut polygon: Vec<Plan>, within: &PlanBox) -> Vec<Plan> {
    let sides: [&dyn Fn(&Plan) -> f64; 4] =
        [&|p| p.x - within.min.x, &|p| within.max.x - p.x, &|p| p.y - within.min.y, &|p| within.max.y - p.y];
    for side in sides {
        let mut cut = Vec::with_capacity(polygon.len() + 1);
        for (k, p) in polygon.iter().enumerate() {
            let q = polygon[(k + 1) % polygon.len()];
            let (at_p, at_q) = (side(p), side(&q));
            if at_p >= 0.0 {
                cut.push(*p);
            }
            if (at_p >= 0.0) != (at_q >= 0.0) {
                cut.push(*p + (q - *p) * (at_p / (at_p - at_q)));
            }
        }
        polygon = cut;
    }
    polygon
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn plan(p: (f64, f64)) -> Plan {
        Plan::new(p.0, p.1)
    }

    proptest! {
        #[test]
        fn no_point_of_a_patch_is_nearer_or_farther_than_it_says(
            points in prop::collection::vec((-3.0..3.0f64, -3.0..3.0f64), 3..8),
            a in (-5.0..5.0f64, -5.0..5.0f64),
            b in (-5.0..5.0f64, -5.0..5.0f64),
            shares in prop::collection::vec(0.0..1.0f64, 8),
        ) {
            let points: Vec<Plan> = points.into_iter().map(plan).collect();
            let patch = Patch { corners: hull(points.clone()), distance: [1.0; 2], slack: 0.0 };
            let ends = [plan(a), plan(b)];
            let [least, most] = patch.distances(ends);
            let sum: f64 = shares[..points.len()].iter().sum();
            let mean = points.iter().zip(&shares).fold(glam::DVec2::ZERO, |at, (p, share)| at + p.to_vec() * (*share / sum));
            let found = to_segment(Plan::new(mean.x, mean.y), ends);
            prop_assert!(sum == 0.0 || (least - 1e-9..=most + 1e-9).contains(&found), "{found} {least} {most}");
            let nearest = (0..=400).map(|k| ends[0] + (ends[1] - ends[0]) * (f64::from(k) / 400.0));
            let on_border = (0..patch.corners.len()).flat_map(|k| {
                let (p, q) = (patch.corners[k], patch.corners[(k + 1) % patch.corners.len()]);
                (0..40).map(move |j| p + (q - p) * (f64::from(j) / 40.0))
            });
            let on_border: Vec<Plan> = on_border.collect();
            let near = nearest.flat_map(|p| on_border.iter().map(move |q| (*q - p).length())).fold(f64::INFINITY, math::min);
            prop_assert!(least == 0.0 || near <= least + 0.3, "not far below what there is: {near} {least}");
        }
    }

    #[test]
    fn a_polygon_is_cut_to_a_box() {
        let square = hull([(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0), (2.0, 2.0)].map(plan).to_vec());
        assert_eq!(square.len(), 4);
        let cut = clipped(square, &PlanBox::around([plan((1.0, -1.0)), plan((2.0, 9.0))]));
        let around = PlanBox::around(cut.iter().copied());
        assert_eq!((around.min, around.max), (plan((1.0, 0.0)), plan((2.0, 4.0))));
    }
}
