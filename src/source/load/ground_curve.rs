//! Edges that are curves of the ground: geodesics and rhumb lines between the vertices of a file in degrees, as further vertices.
//!
//! Input: rings and lines, unrolled. Output: the same with vertices between, so that what is straight in degrees between two of them is
//! nowhere farther from the curve than the tolerance on the ground, far from the terrain no farther than a share of the distance.
//! Refuses: nothing.
//!
//! - An edge is halved by its length until it is near enough. What is decided depends on the edge alone, not on its direction, so that
//!   neighbours keep sharing their edges.
//! - To a pole, whose longitude says nothing, an edge is a meridian. Between the poles it is that of the southern vertex.
//! - A geodesic between two meridians half a turn apart leads over a pole: the nearer one, between antipodes the northern one.
//! - What stays as it is written ([`super::unroll`]: frames of the world, parallels), and what is wider than half a turn, is no way on the
//!   ground; it stays straight in degrees.

use super::changes::Changes;
use super::unroll::Unrolled;
use super::window::Region;
use crate::crs::{CurveKind, Geodesy, GroundCurve, Turn};
use crate::math::{asin, cos, max, min, sin};
use crate::space::Plan;
use glam::DVec2;
use std::f64::consts::{FRAC_PI_2, PI};

/// How often an edge may be halved: from half a meridian to a millimetre is 34 times.
const DEEPEST: u32 = 40;

/// No edge is followed closer than to a millimetre.
const FINEST: f64 = 1e-3;

/// Points are looked at in quarters of an edge; of an S, what lies between them may be off by a bit more.
const BETWEEN_QUARTERS: f64 = 0.9;

/// Far away a chord may be off by this share of its distance from the terrain.
const FAR: f64 = 0.25;

/// What edges of a layer follow.
pub(super) struct GroundCurves {
    geodesy: Geodesy,
    kind: CurveKind,
    turn: Turn,
    /// Metres that a chord may be off.
    tolerance: f64,
    /// The box in the file's coordinates that matters; `None`: unknown.
    near: Option<Region>,
}

impl GroundCurves {
    pub(super) fn new(
        (geodesy, kind): (Geodesy, CurveKind),
        turn: Turn,
        tolerance: f64,
        near: Option<Region>,
    ) -> Self {
        Self { geodesy, kind, turn, tolerance: max(tolerance, FINEST), near }
    }

    /// What edges are, for people, and how many metres on the ground they may be off.
    pub(super) fn words(&self) -> (&'static str, f64) {
        let kind = match self.kind {
            CurveKind::Geodesic => "geodesics",
            CurveKind::RhumbLine => "rhumb lines",
        };
        (kind, self.tolerance)
    }

    /// A ring or a line with the vertices that its edges need.
    pub(super) fn followed(&self, part: Unrolled, is_ring: bool, changes: &mut Changes) -> Unrolled {
        part.with_vertices(is_ring, |a, b| {
            let along = self.between(a, b);
            changes.edges_on_the_ground += usize::from(!along.is_empty());
            changes.along_the_ground += along.len();
            along
        })
    }

    /// The vertices between two, the southern one first.
    fn between(&self, a: Plan, b: Plan) -> Vec<Plan> {
        let Turn { length, pole } = self.turn;
        let (half, width) = (0.5 * length, (b.x - a.x).abs());
        let is_along_a_pole = a.y >= pole || b.y <= -pole;
        if width == 0.0 || is_along_a_pole {
            return Vec::new();
        }
        if b.y >= pole {
            return vec![Plan::new(a.x, pole)];
        }
        if a.y <= -pole {
            return vec![Plan::new(b.x, -pole)];
        }
        if width > half || self.is_straight(a, b) {
            return Vec::new();
        }
        if self.kind == CurveKind::Geodesic && width == half {
            let over = if a.y + b.y >= 0.0 { pole } else { -pole };
            return vec![Plan::new(a.x, over), Plan::new(b.x, over)];
        }
        let curve = self.geodesy.curve(self.kind, a.to_vec(), b.to_vec());
        let mut all = Vec::new();
        self.halve(&curve, (0.0, a), (1.0, b), DEEPEST, &mut all);
        all
    }

    fn halve(
        &self,
        curve: &GroundCurve,
        (s, from): (f64, Plan),
        (t, to): (f64, Plan),
        depth: u32,
        all: &mut Vec<Plan>,
    ) {
        if depth == 0 {
            return;
        }
        let allowed = BETWEEN_QUARTERS * self.allowed(from, curve.length() * (t - s));
        let at = |share: f64| Plan::from(curve.at(s + (t - s) * share));
        let middle = at(0.5);
        let is_near_enough = |p: Plan| self.distance_from_chord(p, from, to) <= allowed;
        if is_near_enough(middle) && is_near_enough(at(0.25)) && is_near_enough(at(0.75)) {
            return;
        }
        let half = 0.5 * (s + t);
        self.halve(curve, (s, from), (half, middle), depth - 1, all);
        all.push(middle);
        self.halve(curve, (half, middle), (t, to), depth - 1, all);
    }

    /// How far the chord of a way of some length from a point on may be off.
    fn allowed(&self, from: Plan, length: f64) -> f64 {
        max(self.tolerance, FAR * (self.distance(from) - length))
    }

    /// Whether an edge is so short that its curve and its chord are the same to the tolerance, by a bound that costs little: seen from the
    /// ground a chord turns by no more than 2 |longitude| sin(latitude) a radian of its length, a rhumb line by half of that.
    fn is_straight(&self, a: Plan, b: Plan) -> bool {
        let (width, height) = (self.geodesy.radians(b.x - a.x).abs(), self.geodesy.radians(b.y - a.y));
        let lowest = if a.y < 0.0 && b.y > 0.0 { 0.0 } else { min(a.y.abs(), b.y.abs()) };
        let length = height + width * cos(self.geodesy.radians(lowest));
        let metres = length * self.geodesy.radius();
        length < 0.2 && 0.5 * width * metres <= BETWEEN_QUARTERS * self.allowed(a, metres)
    }

    /// The least that a place is away from what matters, metres; on the ellipsoid by a few hundredths less.
    fn distance(&self, p: Plan) -> f64 {
        let Some(Region { bounds, pole }) = self.near else { return 0.0 };
        let y = max(bounds.min.y - p.y, p.y - bounds.max.y);
        let middle = 0.5 * (bounds.min.x + bounds.max.x);
        let off = p.x - middle - self.turn.length * ((p.x - middle) / self.turn.length).round();
        let x = self.geodesy.radians(off.abs() - 0.5 * (bounds.max.x - bounds.min.x)).clamp(0.0, FRAC_PI_2);
        // The way to the nearest point of a meridian.
        let across = asin(min(1.0, cos(self.geodesy.radians(p.y)).abs() * sin(x)));
        let up = self.geodesy.radians(y).clamp(0.0, PI);
        0.95 * self.geodesy.radius() * if pole == 0.0 { max(across, up) } else { up }
    }

    /// How far a place is from what is straight in degrees between two.
    fn distance_from_chord(&self, p: Plan, a: Plan, b: Plan) -> f64 {
        let narrow = max(0.0, cos(self.geodesy.radians(p.y)));
        let metric = DVec2::new(narrow, 1.0);
        let (chord, to) = ((b - a) * metric, (p - a) * metric);
        let squared = chord.length_squared();
        let t = if squared > 0.0 { (to.dot(chord) / squared).clamp(0.0, 1.0) } else { 0.0 };
        self.geodesy.chord(p.to_vec(), (a + (b - a) * t).to_vec())
    }
}
