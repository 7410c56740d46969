//! How much border runs through a square of the screen, at most.

use crate::allowed::polygon::{clipped, diameter};
use crate::certainty::PaintRange;
use crate::footprint::{Footprints, HalfPlane, Primitive};
use crate::math;
use crate::scene::Imagery;
use crate::space::{Plan, PlanBox, ViewFrame};
use crate::terrain::{Mesh, SKY};
use crate::truth::{Outcome, Sample};
use glam::DVec2;
use std::f64::consts::{PI, SQRT_2};

/// How far a chord may be off a round border, pixels: what the technique promises.
pub(super) const CHORD: f64 = 1.0 / 512.0;

/// How far a border may be off because a width that grows with the distance is taken as linear, pixels.
pub(super) const BEND: f64 = 1.0 / 256.0;

/// More borders than this may change all of a square.
const CROWD: usize = 512;

/// Parts of edges that a round border may have in a square.
const CHORDS: f64 = 32.0;

/// A convex border is no longer in a square than its sides.
const SIDES: f64 = 4.0;

/// The borders in a square.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Borders {
    /// How long all straight ones are together, pixels, and how many.
    straight: (f64, f64),
    /// The same of round ones, at most: of a static width, and of one that grows.
    round: [(f64, f64); 2],
    /// Whether they are too many, or may be there or not.
    is_open: bool,
    /// Parts of triangles and of texels between them.
    pub(super) parts: f64,
    /// Parts of edges.
    pub(super) edges: f64,
}

impl Borders {
    /// How much of the square may look otherwise when each border strays so far along each axis, in pixels and their areas.
    pub(super) fn doubt(&self, shift: f64) -> f64 {
        if self.is_open {
            return f64::INFINITY;
        }
        // The strip beside borders of this length, round their ends, in a square that is as much larger.
        let strip =
            |off: f64, (length, count): (f64, f64)| off * (length * (1.0 + 6.0 * shift) + count * PI * off);
        let off = SQRT_2 * shift;
        strip(off, self.straight)
            + strip(off + CHORD, self.round[0])
            + strip(off + CHORD + BEND, self.round[1])
    }

    fn add_arc(&mut self, kind: usize, length: f64) {
        self.round[kind].0 += length;
        self.round[kind].1 += 1.0;
        self.edges += CHORDS;
    }

    fn add_line(&mut self, length: f64) {
        self.straight.0 += length;
        self.straight.1 += 1.0;
        self.edges += 1.0;
    }
}

/// What borders are found in.
pub(super) struct Counter<'a> {
    pub(super) footprints: &'a Footprints<'a>,
    pub(super) imagery: Option<&'a Imagery>,
    pub(super) mesh: &'a Mesh,
    pub(super) frame: &'a ViewFrame,
    /// How far borders may stray, pixels.
    pub(super) shift: f64,
}

/// A triangle that a square may see.
struct Seen {
    triangle: u32,
    /// Around what is seen of it.
    plan: PlanBox,
    /// Its corners' numbers, and on the screen; `None` where one is behind the eye.
    corners: [u32; 3],
    screen: Option<[DVec2; 3]>,
    /// Whether a plane of the view cuts it.
    is_cut: bool,
}

impl Seen {
    /// Whether it and another one are one sheet along the edge that begins at a corner: both are seen from the same side.
    fn continues_in(&self, edge: usize, other: &Self) -> bool {
        let place = |k: usize| other.corners.iter().position(|corner| *corner == self.corners[k % 3]);
        let (Some(from), Some(to), Some(own), Some(its)) =
            (place(edge), place(edge + 1), self.screen, other.screen)
        else {
            return false;
        };
        // Neighbours that turn alike have their edge in opposite directions.
        let is_opposite = (to + 1) % 3 == from;
        let turn = |[a, b, c]: [DVec2; 3]| (b - a).perp_dot(c - a) > 0.0;
        self.triangle != other.triangle && (turn(own) == turn(its)) == is_opposite
    }
}

impl Counter<'_> {
    /// The borders in what some samples in a square of the screen may see.
    pub(super) fn borders(&self, (corner, side): (DVec2, f64), samples: &[Sample]) -> Borders {
        let outcomes = || samples.iter().flat_map(|sample| &sample.outcomes);
        let seen = self.seen(outcomes());
        let margin = 2.0 * self.shift + 1e-3;
        let low = corner - DVec2::splat(margin);
        let square = [low, low + DVec2::splat(side + 2.0 * margin)];
        let diagonal = SQRT_2 * side;
        let is_even = is_even(outcomes());
        let mut all = Borders::default();
        for of in &seen {
            let length =
                of.screen.map_or(diagonal, |screen| math::min(diameter(&clipped(&screen, square)), diagonal));
            for edge in 0..3 {
                let is_inner = is_even && seen.iter().any(|other| of.continues_in(edge, other));
                let ends = of.screen.map(|screen| [screen[edge], screen[(edge + 1) % 3]]);
                let part = ends.map_or(diagonal, |ends| diameter(&clipped(&ends, square)));
                if !is_inner && part > 0.0 {
                    all.add_line(part);
                }
            }
            if of.is_cut {
                all.add_line(diagonal);
            }
            let texels = self.imagery.map_or([0.0; 2], |imagery| texel_borders(imagery, &of.plan));
            all.straight.0 += (texels[0] + texels[1]) * length;
            all.straight.1 += texels[0] + texels[1];
            all.parts += (1.0 + texels[0]) * (1.0 + texels[1]);
            self.add_features(&of.plan, (length, SIDES * side), &mut all);
        }
        all
    }

    /// The triangles that are seen.
    fn seen<'o>(&self, outcomes: impl Iterator<Item = &'o Outcome>) -> Vec<Seen> {
        let mut seen: Vec<Seen> = Vec::new();
        for outcome in outcomes.filter(|outcome| outcome.triangle != SKY) {
            let triangle = outcome.triangle;
            if let Some(known) = seen.iter_mut().find(|of| of.triangle == triangle) {
                known.plan.include_box(&outcome.plan);
                continue;
            }
            let (Some(world), Some(corners)) = (self.mesh.triangle(triangle), self.mesh.corners(triangle))
            else {
                continue;
            };
            let [a, b, c] = world.map(|p| self.frame.screen_from_world(p).map(|at| at.to_vec()));
            let screen = a.zip(b).zip(c).map(|((a, b), c)| [a, b, c]);
            let crosses = |limit: f64| {
                let is_near = world.map(|p| self.frame.depth(p) < limit);
                is_near[0] != is_near[1] || is_near[1] != is_near[2]
            };
            let is_cut = crosses(self.frame.near()) || crosses(self.frame.far());
            seen.push(Seen { triangle, plan: outcome.plan, corners, screen, is_cut });
        }
        seen
    }

    /// Counts the borders of items in a box of the plan, straight ones and round ones no longer than this.
    fn add_features(&self, plan: &PlanBox, (length, round): (f64, f64), all: &mut Borders) {
        let (mut parts, mut primitives) = (Vec::new(), Vec::new());
        self.footprints.parts_near(plan, |part| {
            parts.push(part);
            parts.len() < CROWD
        });
        if parts.len() >= CROWD {
            all.is_open = true;
            all.edges = f64::INFINITY;
            return;
        }
        // A long part has several boxes.
        parts.sort_unstable();
        parts.dedup();
        for part in parts {
            self.footprints.primitives(part, &mut primitives);
        }
        for primitive in primitives.iter().filter(|primitive| !primitive.misses(plan)) {
            match primitive {
                Primitive::Edge { .. } => all.add_line(length),
                Primitive::Convex(shape) => {
                    shape.sides().iter().filter(|side| meets(side, plan)).for_each(|_| all.add_line(length));
                }
                Primitive::Near { from, to, growth, .. } if *growth > 0.0 => {
                    if self.may_reach([*from, *to], *growth, plan) {
                        all.add_arc(1, round);
                    }
                }
                Primitive::Near { .. } => all.add_arc(0, round),
                // It may be there or not.
                Primitive::Perhaps(_) => all.is_open = true,
            }
        }
    }

    /// Whether a stroke whose width grows with the distance may reach a box.
    fn may_reach(&self, [from, to]: [Plan; 2], growth: f64, plan: &PlanBox) -> bool {
        let middle = plan.min + (plan.max - plan.min) * 0.5;
        let radius = 0.5 * (plan.max - plan.min).length();
        let along = to - from;
        let squared = along.length_squared();
        let share = if squared > 0.0 { ((middle - from).dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
        let distance = (middle - (from + along * share)).length() - radius;
        let eye = self.frame.eye();
        // The surface is no farther from the eye there than the farthest place over the box.
        let (low, high) = self.mesh.heights().unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        let height = math::max((low - eye.z).abs(), (high - eye.z).abs());
        distance <= growth * ((middle - eye.plan()).length() + radius + height)
    }
}

/// Whether what lies below all items looks the same everywhere.
fn is_even<'o>(outcomes: impl Iterator<Item = &'o Outcome>) -> bool {
    let grounds = outcomes.filter(|outcome| outcome.triangle != SKY).map(|outcome| outcome.ground);
    grounds.reduce(|a: PaintRange, b| a.hull(&b)).is_none_or(|all| all.width() == 0.0)
}

/// The most borders between texels that a box of the plan has along each axis.
fn texel_borders(imagery: &Imagery, plan: &PlanBox) -> [f64; 2] {
    let (extent, texels) = (imagery.extent.max - imagery.extent.min, &imagery.texels);
    let size = plan.max - plan.min;
    let along = |size: f64, extent: f64, count: usize| {
        math::min((size / extent * count as f64).ceil() + 1.0, count as f64)
    };
    [along(size.x, extent.x, texels.width()), along(size.y, extent.y, texels.height())]
}

/// Whether a half plane's border may run through a box.
fn meets(side: &HalfPlane, plan: &PlanBox) -> bool {
    let beyond = HalfPlane { normal: side.normal.map(|n| -n), offset: -side.offset, ..*side };
    !side.excludes(plan) && !beyond.excludes(plan)
}
