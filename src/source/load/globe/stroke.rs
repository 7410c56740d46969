//! Strokes of a width in metres on the ground, as polygons of longitude and latitude.
//!
//! Input: a path of the plan (its segments straight in longitude and latitude), a line's style. Output: rings, counter-clockwise, whose union
//! is the stroke, to a 256th of its width ([`Brush::SHARES`]). Refuses: nothing.
//!
//! What lies beside a point of the path is a step in the plane that touches the ellipsoid there, taken down along the normal: off the
//! distance on the ground by a third of the square of the half width's share of the earth's radius. A run of segments that hardly turn is one
//! strip; where the path turns, strips end, and the join of the style is a polygon of its own, as caps are.

use super::foot::{Ground, SAME_PLACE};
use crate::math::{cos, max, min, sin};
use crate::scene::{Cap, Join};
use crate::space::{DISC_CORNERS, Ellipsoid};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Turns up to this are no corners: what a join adds there, and a bisected end takes, is below a 128th of half the width.
const GENTLE: f64 = 0.25;

/// A strip's path goes no farther around than this, radians, and has no more ends of segments: it must not close around the globe.
const WIDEST: f64 = 1.0;
const LONGEST: usize = 64;

/// How often a segment is halved.
const DEEPEST: u32 = 16;

/// What a stroke is drawn with.
#[derive(Clone, Copy)]
pub(super) struct Brush {
    ground: Ground,
    /// Half the width, metres.
    half: f64,
    join: Join,
    cap: Cap,
}

/// A cut across a stroke.
#[derive(Clone, Copy)]
struct Section {
    /// Where on the path, as the path has it.
    on_path: DVec2,
    place: DVec3,
    /// Unit vectors: along the path, and up.
    ahead: DVec3,
    up: DVec3,
    left: DVec2,
    right: DVec2,
}

impl Section {
    fn aside(&self) -> DVec3 {
        self.up.cross(self.ahead)
    }
}

impl Brush {
    /// A stroke is off by at most this part of its width.
    const SHARES: f64 = 256.0;

    /// A brush of a width in metres.
    pub(super) fn new(ellipsoid: Ellipsoid, width: f64, join: Join, cap: Cap) -> Self {
        Self { ground: Ground { ellipsoid, tolerance: width / Self::SHARES }, half: 0.5 * width, join, cap }
    }

    /// The rings of a stroke along a path in radians; a joined path ends where it begins, maybe a turn on.
    pub(super) fn stroke(&self, path: &[DVec2], is_joined: bool) -> Vec<Vec<DVec2>> {
        let mut rings = Vec::new();
        let runs: Vec<Vec<Section>> =
            path.windows(2).filter_map(|pair| self.segment(pair[0], pair[1])).collect();
        let (Some(first), Some(last)) = (runs.first(), runs.last()) else {
            path.first().into_iter().for_each(|place| self.dot(*place, &mut rings));
            return rings;
        };
        let (start, end) = (first[0], last[last.len() - 1]);
        let mut strip: Vec<Section> = Vec::new();
        for (k, run) in runs.iter().enumerate() {
            if let Some(before) = strip.last().copied() {
                let shortest = min(length(&runs[k - 1]), length(run));
                match self.bisected(&before, &run[0], shortest) {
                    Some(between) => {
                        strip.pop();
                        strip.push(between);
                    }
                    None => {
                        self.finish(&strip, &mut rings);
                        self.join(&before, &run[0], &mut rings);
                        strip = vec![run[0]];
                    }
                }
            } else {
                strip.push(run[0]);
            }
            for section in &run[1..] {
                let is_long = (section.on_path.x - strip[0].on_path.x).abs() > WIDEST;
                if strip.len() > 1 && (is_long || strip.len() >= LONGEST) {
                    self.finish(&strip, &mut rings);
                    strip.drain(..strip.len() - 1);
                }
                strip.push(*section);
            }
        }
        self.finish(&strip, &mut rings);
        if is_joined {
            self.join(&end, &start, &mut rings);
        } else {
            self.end(&end, &mut rings);
            self.end(&Section { ahead: -start.ahead, ..start }, &mut rings);
        }
        rings
    }

    /// A dot: by the cap a disc, a square along the axes, or nothing.
    pub(super) fn dot(&self, place: DVec2, rings: &mut Vec<Vec<DVec2>>) {
        let [east, north, _] = Ellipsoid::directions(place.x, place.y);
        let at = self.ground.at(place);
        match self.cap {
            Cap::Butt => {}
            Cap::Round => self.disc((at, east, north), rings),
            Cap::Square => {
                let corners = [east - north, east + north, north - east, -east - north];
                self.polygon(corners.map(|corner| at + corner * self.half), rings);
            }
        }
    }

    /// The cut across the path where it goes into a direction of the plan; `None` where that is no way over the ground.
    fn section(&self, on_path: DVec2, step: DVec2) -> Option<Section> {
        let ellipsoid = &self.ground.ellipsoid;
        let [east, north, up] = Ellipsoid::directions(on_path.x, on_path.y);
        let (n, m) = (ellipsoid.prime_vertical(on_path.y), ellipsoid.meridian(on_path.y));
        let ahead = (east * (n * cos(on_path.y) * step.x) + north * (m * step.y)).try_normalize()?;
        Some(self.across(on_path, ahead, up))
    }

    fn across(&self, on_path: DVec2, ahead: DVec3, up: DVec3) -> Section {
        let place = self.ground.at(on_path);
        let aside = up.cross(ahead) * self.half;
        let (left, right) = (self.ground.below(place + aside), self.ground.below(place - aside));
        Section { on_path, place, ahead, up, left, right }
    }

    /// The cuts across a segment: as many as its sides need; `None` of one that goes nowhere, as along a pole.
    fn segment(&self, from: DVec2, to: DVec2) -> Option<Vec<Section>> {
        let step = to - from;
        let is_one_place = (self.ground.at(to) - self.ground.at(from)).length() <= SAME_PLACE;
        if is_one_place && (step.x.abs() < 1.0 || self.ground.is_pole(from)) {
            return None;
        }
        let (first, last) = (self.section(from, step)?, self.section(to, step)?);
        let mut all = vec![first];
        self.halve(&first, &last, step, DEEPEST, &mut all);
        all.push(last);
        Some(all)
    }

    fn halve(&self, a: &Section, b: &Section, step: DVec2, depth: u32, all: &mut Vec<Section>) {
        if depth == 0 || self.is_even(a, b) {
            return;
        }
        let along = |share: f64| self.section(a.on_path + (b.on_path - a.on_path) * share, step);
        let [Some(first), Some(middle), Some(last)] = [along(0.25), along(0.5), along(0.75)] else { return };
        let off = |share: f64, section: &Section| {
            max(
                self.ground.off((a.left, b.left), share, section.left),
                self.ground.off((a.right, b.right), share, section.right),
            )
        };
        let off = max(off(0.5, &middle), max(off(0.25, &first), off(0.75, &last)));
        if off <= self.ground.tolerance {
            return;
        }
        self.halve(a, &middle, step, depth - 1, all);
        all.push(middle);
        self.halve(&middle, b, step, depth - 1, all);
    }

    /// Whether the sides between two cuts are straight in the plan without looking: the width of a metre in degrees hardly changes there.
    fn is_even(&self, a: &Section, b: &Section) -> bool {
        let way = (b.on_path - a.on_path).abs();
        let least = min(cos(a.on_path.y), cos(b.on_path.y));
        // 1 + 2 tan^2 of the latitude is how the second derivative of 1 / cos compares with it.
        let growth = 2.0 - least * least;
        self.ground.is_level(a.on_path, self.half)
            && self.ground.is_level(b.on_path, self.half)
            && way.length_squared() * growth <= least * least / 64.0
    }

    /// The cut that two segments share where the path hardly turns and both are long enough.
    fn bisected(&self, before: &Section, after: &Section, shortest: f64) -> Option<Section> {
        let sine = before.ahead.cross(after.ahead).length();
        let is_gentle =
            before.ahead.dot(after.ahead) > 0.0 && sine <= sin(GENTLE) && sine * self.half <= shortest;
        let ahead = (before.ahead + after.ahead).try_normalize()?;
        is_gentle.then(|| self.across(after.on_path, ahead, after.up))
    }

    fn finish(&self, strip: &[Section], rings: &mut Vec<Vec<DVec2>>) {
        let [first, .., last] = strip else { return };
        let mut ring: Vec<DVec2> = strip.iter().map(|section| section.right).collect();
        self.over(last.right, last.left, &mut ring);
        ring.extend(strip.iter().rev().map(|section| section.left));
        self.over(first.left, first.right, &mut ring);
        rings.push(self.ground.along_the_poles(ring));
    }

    /// Adds the places between two that are no farther apart than a few widths.
    fn over(&self, from: DVec2, to: DVec2, ring: &mut Vec<DVec2>) {
        if !self.ground.is_level(from, self.half) || !self.ground.is_level(to, self.half) {
            self.ground.between(from, to, ring);
        }
    }

    /// A polygon whose corners are points above the ground.
    fn polygon<const N: usize>(&self, corners: [DVec3; N], rings: &mut Vec<Vec<DVec2>>) {
        let corners = corners.map(|corner| self.ground.below(corner));
        let mut ring = Vec::with_capacity(N);
        for (k, corner) in corners.iter().enumerate() {
            ring.push(*corner);
            self.over(*corner, corners[(k + 1) % N], &mut ring);
        }
        rings.push(self.ground.along_the_poles(ring));
    }

    fn disc(&self, (at, x, y): (DVec3, DVec3, DVec3), rings: &mut Vec<Vec<DVec2>>) {
        let corners: [DVec3; DISC_CORNERS] = std::array::from_fn(|k| {
            let angle = TAU * k as f64 / DISC_CORNERS as f64;
            at + (x * cos(angle) + y * sin(angle)) * self.half
        });
        self.polygon(corners, rings);
    }

    /// What joins the segments that end and begin at a corner.
    fn join(&self, before: &Section, after: &Section, rings: &mut Vec<Vec<DVec2>>) {
        let at = after.place;
        let cosine = before.ahead.dot(after.ahead);
        let turn = before.ahead.cross(after.ahead).dot(after.up);
        // The corner is on the outer side: right of a turn to the left.
        let outwards = if turn > 0.0 { -self.half } else { self.half };
        let [mut from, mut to] = [before, after].map(|section| at + section.aside() * outwards);
        if turn <= 0.0 {
            std::mem::swap(&mut from, &mut to);
        }
        match self.join {
            Join::Round => self.disc((at, after.ahead, after.aside()), rings),
            Join::Miter { limit } if limit * limit * (1.0 + cosine) * 0.5 >= 1.0 => {
                let tip = (before.aside() + after.aside()) * (outwards / (1.0 + cosine));
                self.polygon([at, from, at + tip, to], rings);
            }
            Join::Miter { .. } | Join::Bevel => self.polygon([at, from, to], rings),
        }
    }

    /// The cap of an end, out of which the section leads.
    fn end(&self, section: &Section, rings: &mut Vec<Vec<DVec2>>) {
        let (at, ahead, aside) = (section.place, section.ahead * self.half, section.aside() * self.half);
        match self.cap {
            Cap::Butt => {}
            Cap::Round => self.disc((at, section.ahead, section.aside()), rings),
            Cap::Square => {
                self.polygon([at - aside, at - aside + ahead, at + aside + ahead, at + aside], rings)
            }
        }
    }
}

/// The length of a segment's path, by its cuts.
fn length(run: &[Section]) -> f64 {
    run.windows(2).map(|pair| (pair[1].place - pair[0].place).length()).sum()
}
