//! Edges that are straight in a file and curves in the plan: vertices between, so that no chord is too far off.
//!
//! An edge is halved until points on it are no farther than the tolerance from its chord, far from the terrain no farther than a share of
//! the distance: there only the side on which a curve passes the terrain matters. What is decided depends on the edge alone, not on its
//! direction, so that neighbours keep sharing their edges.

use super::window::Region;
use crate::crs::{PlanFrom, Turn};
use crate::error::Result;
use crate::math::max;
use crate::space::{Plan, PlanBox};

/// How often an edge may be halved.
const DEEPEST: u32 = 16;

/// Far away a chord may be off by this share of its distance from the terrain.
const FAR: f64 = 0.25;

/// How edges are followed.
pub(super) struct Follow {
    /// Metres that a chord may be off near the terrain.
    pub(super) tolerance: f64,
    /// The rectangle of the plan that matters.
    pub(super) near: PlanBox,
    /// Longer edges, in the file's unit, are looked at wherever they are.
    pub(super) long: f64,
}

/// The end of an edge: in the file and in the plan.
type End = (Plan, Plan);

impl Follow {
    /// Adds the vertices between the ends of an edge; `place` leads from the file to the plan.
    pub(super) fn between(
        &self,
        a: End,
        b: End,
        place: &impl Fn(Plan) -> Result<Plan>,
        all: &mut Vec<Plan>,
    ) -> Result<()> {
        self.halve(a, b, DEEPEST, place, all)
    }

    fn halve(
        &self,
        (from, a): End,
        (to, b): End,
        depth: u32,
        place: &impl Fn(Plan) -> Result<Plan>,
        all: &mut Vec<Plan>,
    ) -> Result<()> {
        if depth == 0 || from == to {
            return Ok(());
        }
        let far = self.distance(&PlanBox::around([a, b]));
        let way = (to - from).abs();
        if (b - a).length() <= far && max(way.x, way.y) <= self.long {
            return Ok(());
        }
        // A sum that does not depend on the edge's direction.
        let between = |t: f64| Plan::new(from.x * (1.0 - t) + to.x * t, from.y * (1.0 - t) + to.y * t);
        let middle = between(0.5);
        let m = place(middle)?;
        let off = max(
            distance_from_chord(m, a, b),
            max(
                distance_from_chord(place(between(0.25))?, a, b),
                distance_from_chord(place(between(0.75))?, a, b),
            ),
        );
        if off <= max(self.tolerance, FAR * far) {
            return Ok(());
        }
        self.halve((from, a), (middle, m), depth - 1, place, all)?;
        all.push(m);
        self.halve((middle, m), (to, b), depth - 1, place, all)
    }

    /// How far a box is from what matters.
    fn distance(&self, of: &PlanBox) -> f64 {
        let x = max(of.min.x - self.near.max.x, self.near.min.x - of.max.x);
        let y = max(of.min.y - self.near.max.y, self.near.min.y - of.max.y);
        max(max(x, y), 0.0)
    }
}

fn distance_from_chord(p: Plan, a: Plan, b: Plan) -> f64 {
    let (chord, to) = (b - a, p - a);
    let squared = chord.length_squared();
    let t = if squared > 0.0 { to.dot(chord) / squared } else { 0.0 };
    (to - chord * t.clamp(0.0, 1.0)).length()
}

/// Edges of a file that are longer than this may pass the terrain on another side than their chords.
pub(super) fn long(map: &PlanFrom, horizon: Option<&Region>, turn: Option<Turn>) -> f64 {
    match (turn, horizon) {
        (Some(turn), _) => turn.length / 72.0,
        (None, Some(horizon)) => {
            let size = horizon.bounds.max - horizon.bounds.min;
            max(size.x, size.y) / 16.0
        }
        (None, None) => 1e5 / map.file().metres_per_unit().unwrap_or(1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{cos, sin};

    /// A circle around (0, 0) by its angle x and radius y, as polar projections draw parallels.
    fn polar(p: Plan) -> Result<Plan> {
        Ok(Plan::new(p.y * cos(p.x), p.y * sin(p.x)))
    }

    fn followed(follow: &Follow, from: Plan, to: Plan) -> Vec<Plan> {
        let mut all = vec![polar(from).unwrap()];
        follow.between((from, all[0]), (to, polar(to).unwrap()), &polar, &mut all).unwrap();
        all.push(polar(to).unwrap());
        all
    }

    #[test]
    fn no_chord_near_the_terrain_is_off_by_more_than_the_tolerance() {
        let near = PlanBox { min: Plan::new(-1.0, 80.0), max: Plan::new(60.0, 120.0) };
        let follow = Follow { tolerance: 0.01, near, long: 0.1 };
        let arc = followed(&follow, Plan::new(-0.3, 100.0), Plan::new(2.9, 100.0));
        let mut there = 0;
        for pair in arc.windows(2) {
            let chord = PlanBox::around([pair[0], pair[1]]);
            let middle = (pair[0].to_vec() + pair[1].to_vec()) * 0.5;
            let off = 100.0 - middle.length();
            let distance = follow.distance(&chord);
            assert!(off <= max(0.01, 0.25 * distance) * 1.01, "{off} at {distance}");
            there += usize::from(distance == 0.0);
        }
        // sqrt(8 * 100 * 0.01) = 2.8 is the longest chord, the arc in the rectangle is 65 long.
        assert!((23..=60).contains(&there) && arc.len() < there + 20, "{there} of {}", arc.len());
    }

    #[test]
    fn an_edge_has_the_same_vertices_in_both_directions() {
        let near = PlanBox { min: Plan::new(-200.0, -200.0), max: Plan::new(200.0, 200.0) };
        let follow = Follow { tolerance: 0.003, near, long: 0.1 };
        let (a, b) = (Plan::new(0.1234, 97.1), Plan::new(1.777, 103.3));
        let mut back = followed(&follow, b, a);
        back.reverse();
        let there = followed(&follow, a, b);
        assert!(there.len() > 20);
        assert_eq!(there, back);
    }

    #[test]
    fn a_whole_turn_is_followed_though_it_ends_where_it_starts() {
        let near = PlanBox { min: Plan::new(-1.0, -1.0), max: Plan::new(1.0, 1.0) };
        let follow = Follow { tolerance: 0.01, near, long: 0.5 };
        let turn = std::f64::consts::TAU;
        let circle = followed(&follow, Plan::new(0.0, 100.0), Plan::new(turn, 100.0));
        // Far from what matters it is coarse, but goes around it.
        assert!((5..40).contains(&circle.len()), "{}", circle.len());
        let area: f64 = circle.windows(2).map(|p| p[0].to_vec().perp_dot(p[1].to_vec()) * 0.5).sum();
        assert!(area > 20_000.0, "{area}");
    }
}
