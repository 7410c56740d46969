//! What rays through pixels' centres and corners may end in.

use super::ground::Ground;
use super::place::{Patch, Place, Range, around, distances};
use crate::certainty::{Known, PaintRange};
use crate::predicate::TrianglePlane;
use crate::space::{Plan, PlanBox, Ray, Screen, ViewFrame};
use crate::terrain::{Mesh, PlanMap, SKY, SurfaceTriangle, TriangleDrape};
use crate::truth::{Outcome, Sample};

/// A view of a terrain by a machine that may stray.
pub(super) struct Eye<'a> {
    pub(super) view: &'a ViewFrame,
    pub(super) mesh: &'a Mesh,
    /// How far a sample may stray along each axis, pixels.
    pub(super) shift: f64,
    /// How far along its ray a point of a view depth may seem to lie elsewhere, metres.
    pub(super) along: &'a (dyn Fn(f64) -> f64 + Sync),
    pub(super) ground: &'a Ground<'a>,
    /// How far rounding may move plan points, metres.
    pub(super) slack: f64,
}

/// Connected places that a ray may end in, a patch for each triangle.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Spread {
    pub(super) place: Place,
    triangles: Vec<u32>,
    /// The terrain's own paints there.
    pub(super) paints: Vec<PaintRange>,
}

/// All that a ray may end in.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Sight {
    pub(super) is_sky: bool,
    pub(super) spreads: Vec<Spread>,
}

/// A side of a quadrilateral so many times longer than the planes at its ends would make it spans a silhouette.
const SILHOUETTE_RATIO: f64 = 8.0;

/// What rounding may do to that ratio.
const RATIO_SHARE: f64 = 1e-3;

/// The square of a probe is so much larger than the shift.
const EASE: f64 = 1.0625;

impl Sight {
    /// What a sample at a place of the screen may end in.
    pub(super) fn of(sample: &Sample, eye: &Eye, at: Screen) -> Self {
        let mut sight = Self::default();
        for outcome in &sample.outcomes {
            if outcome.triangle == SKY {
                sight.is_sky = true;
                continue;
            }
            let patch = eye.patch(outcome, at);
            let bounds = patch.bounds().grown(eye.slack);
            let paints = eye.ground.paints(outcome.triangle, &bounds);
            let spread = Spread { place: Place(vec![patch]), triangles: vec![outcome.triangle], paints };
            sight.add(spread, &bounds);
        }
        sight
    }

    /// Adds a spread within a box, and makes one of those that it connects.
    fn add(&mut self, mut all: Spread, bounds: &PlanBox) {
        let is_apart = |spread: &Spread| !spread.place.0.iter().any(|p| p.bounds().meets(bounds));
        let (apart, touched): (Vec<Spread>, Vec<Spread>) =
            std::mem::take(&mut self.spreads).into_iter().partition(is_apart);
        touched.into_iter().for_each(|spread| all.take(spread));
        self.spreads = apart;
        self.spreads.push(all);
    }

    /// One spread of all.
    pub(super) fn joined(&self) -> Self {
        let mut spreads = self.spreads.iter().cloned();
        let mut joined: Vec<Spread> = spreads.next().into_iter().collect();
        spreads.for_each(|spread| joined[0].take(spread));
        Self { is_sky: self.is_sky, spreads: joined }
    }

    /// How many different things it may be.
    pub(super) fn count(&self) -> usize {
        self.spreads.len() + usize::from(self.is_sky)
    }
}

impl Spread {
    fn take(&mut self, other: Self) {
        self.place.0.extend(other.place.0);
        self.triangles.extend(other.triangles);
        for paint in other.paints {
            if !self.paints.contains(&paint) {
                self.paints.push(paint);
            }
        }
    }

    fn patches(&self) -> impl Iterator<Item = (u32, PlanBox)> {
        self.triangles.iter().copied().zip(self.place.0.iter().map(Patch::bounds))
    }
}

impl Eye<'_> {
    fn patch(&self, outcome: &Outcome, at: Screen) -> Patch {
        let triangle = self.mesh.surface_triangle(outcome.triangle);
        let shift = self.shift * EASE;
        let around = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let plane = triangle.as_ref().map(|triangle| (triangle, TrianglePlane::new(&triangle.world)));
        let corners = plane.as_ref().and_then(|plane| {
            let mut corners = [Plan::default(); 4];
            for (to, (x, y)) in corners.iter_mut().zip(around) {
                let ray = self.view.ray(Screen::new(at.x + x * shift, at.y + y * shift));
                *to = hit(plane, &ray)?;
            }
            Some(corners)
        });
        // Attributes of a triangle that a sample just misses are taken beyond its sides; depths are of other places, and rounded.
        let ray = self.view.ray(at);
        let on_plane = plane.as_ref().and_then(|plane| hit(plane, &ray));
        let is_vertical = triangle.is_some_and(|t| matches!(t.drape, TriangleDrape::Vertical));
        let on_ray = is_vertical.then(|| {
            let (near, far) = outcome.depth;
            let depths = [near - (self.along)(near), far + (self.along)(far)];
            depths.map(|depth| (ray.from + (ray.through - ray.from) * (depth / self.view.reach())).plan())
        });
        Patch {
            plan: outcome.plan,
            corners,
            others: on_plane.into_iter().chain(on_ray.into_iter().flatten()).collect(),
        }
    }

    /// Whether the side between what two neighbouring rays may end in spans a silhouette.
    pub(super) fn silhouette(&self, [from, to]: [(&Spread, Screen); 2]) -> Known {
        if let ([one], [other]) = (&from.0.triangles[..], &to.0.triangles[..])
            && one == other
        {
            return Known::Out;
        }
        let rays = [from, to].map(|(_, at)| self.view.ray(at));
        let expected: [Vec<Range>; 2] = [(from.0, &rays[1]), (to.0, &rays[0])].map(|(spread, other)| {
            let plane = |triangle: u32| self.mesh.surface_triangle(triangle);
            let reach = |(triangle, place): (u32, PlanBox)| {
                // A plane that the neighbour's ray misses would reach to the horizon.
                let hit = plane(triangle)
                    .and_then(|triangle| hit(&(&triangle, TrianglePlane::new(&triangle.world)), other));
                hit.map_or([f64::INFINITY; 2], |hit| distances(&PlanBox::around([hit]), &place))
            };
            spread.patches().map(reach).collect()
        });
        let mut all: Option<Known> = None;
        for ((one, place), from_expected) in from.0.patches().zip(&expected[0]) {
            for ((other, beyond), to_expected) in to.0.patches().zip(&expected[1]) {
                let length = distances(&place, &beyond);
                let pair = match one == other {
                    true => Known::Out,
                    false => self.is_longer(length, *from_expected).and(self.is_longer(length, *to_expected)),
                };
                all = Some(all.map_or(pair, |all| if all == pair { all } else { Known::Open }));
            }
        }
        all.unwrap_or(Known::Open)
    }

    /// Whether a length is too many times an expected one.
    fn is_longer(&self, length: Range, expected: Range) -> Known {
        let slack = self.slack;
        let limit = around(
            [SILHOUETTE_RATIO * (1.0 - RATIO_SHARE) * (expected[0] - slack), f64::NEG_INFINITY],
            [f64::INFINITY, SILHOUETTE_RATIO * (1.0 + RATIO_SHARE) * (expected[1] + slack)],
        );
        match (length[0] - slack > limit[1], length[1] + slack > limit[0]) {
            (true, _) => Known::In,
            (_, false) => Known::Out,
            _ => Known::Open,
        }
    }
}

/// The plan point in which a ray meets a triangle's plane before the eye.
fn hit((triangle, plane): &(&SurfaceTriangle, TrianglePlane), ray: &Ray) -> Option<Plan> {
    let share = plane.hit_parameter(ray);
    let world = ray.from + (ray.through - ray.from) * share;
    let plan = match &triangle.drape {
        TriangleDrape::Vertical => world.plan(),
        TriangleDrape::Affine { plan, .. } => PlanMap::new(&triangle.world, plan).at(world),
    };
    (share > 0.0 && plan.is_finite()).then_some(plan)
}
