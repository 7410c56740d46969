//! Rings and lines on the unrolled globe: consecutive longitudes follow one another, whatever turn they are written in.
//!
//! Input: rings or a line as a file has them, longitudes anywhere, in degrees or as metres of Mercator's cylinder. Output: the same vertices, each with the number of turns that it is
//! moved by. Refuses: nothing.
//!
//! What a jump of more than half a turn between two vertices means is not written in a file:
//! - along a pole it is no way at all;
//! - else it is a step across the antimeridian, the short way: rings of +-179 are narrow;
//! - a ring that is a frame of the world stays as it is written: it spans the globe from east to west and more than a quarter of the way
//!   from pole to pole, and all its vertices lie on that frame; or nothing would be left of it;
//! - a ring that comes back a turn off runs around a pole: that along which the file closes it, else the one on its side of the equator.
//!   The file's way along the meridian to the pole and back is left out: nothing ends there.

use crate::crs::Turn;
use crate::math::min;
use crate::space::{Plan, PlanBox};
use glam::DVec2;

/// So near to a pole, degrees, longitudes mean nothing.
const AT_POLE: f64 = 1e-6;

/// What is narrower than this share of a turn, a metre, is a writer's rounding.
const NOTHING: f64 = 2.5e-8;

/// The vertices of a frame of the world lie so near to its sides, degrees, ...
const FRAME_MARGIN: f64 = 2.0;

/// ... and it spans more latitude than this, degrees.
const FRAME_HEIGHT: f64 = 45.0;

/// A ring (without its closing vertex) or a line, unrolled.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Unrolled {
    written: Vec<Plan>,
    /// By how many turns each vertex is moved.
    turns: Vec<i64>,
    /// What a turn of longitude is in the file's unit.
    turn: f64,
    /// How many turns on a ring comes back to its first vertex.
    pub(super) around: i64,
    /// The pole that a ring with turns encloses: 1 the northern, -1 the southern one.
    pub(super) pole: f64,
    /// Whether it stays as it is written, its edges too.
    is_as_written: bool,
}

impl Unrolled {
    /// What stays as it is written.
    fn as_written(written: Vec<Plan>, turn: Turn) -> Self {
        let turns = vec![0; written.len()];
        Self { turns, written, turn: turn.length, around: 0, pole: 0.0, is_as_written: true }
    }

    /// By how much longitude grows from a ring's first vertex to its first vertex.
    pub(super) fn way_around(&self) -> f64 {
        if self.around == 0 { 0.0 } else { self.around as f64 * self.turn }
    }

    /// The vertices, moved by so many turns more. A vertex that ends on the turn it is written in keeps its bits.
    pub(super) fn moved(&self, by: i64) -> impl Iterator<Item = Plan> + '_ {
        let place = move |(p, turns): (&Plan, &i64)| match turns + by {
            0 => *p,
            turns => Plan::new(p.x + turns as f64 * self.turn, p.y),
        };
        self.written.iter().zip(&self.turns).map(place)
    }

    /// The same with further vertices along its edges. `between` gives those between two vertices, in order from the first one, which is
    /// the southern one (the western one of two on a parallel), on the turn that this is written on: neighbours get the same.
    pub(super) fn with_vertices(
        self,
        is_ring: bool,
        mut between: impl FnMut(Plan, Plan) -> Vec<Plan>,
    ) -> Self {
        if self.is_as_written {
            return self;
        }
        let count = self.written.len();
        let mut all = Self { written: Vec::with_capacity(count), turns: Vec::with_capacity(count), ..self };
        let vertices = self.written.iter().copied().zip(self.turns.iter().copied());
        let mut following = vertices.clone().skip(1);
        let closing = vertices.clone().next().map(|(first, at)| (first, at + self.around));
        for (from, from_turns) in vertices {
            all.written.push(from);
            all.turns.push(from_turns);
            let Some((to, to_turns)) = following.next().or(closing.filter(|_| is_ring)) else { break };
            let is_forward = (from.y, from.x) <= (to.y, to.x);
            let (first, second, on, off) = match is_forward {
                true => (from, to, from_turns, to_turns - from_turns),
                false => (to, from, to_turns, from_turns - to_turns),
            };
            let mut along = between(first, second + DVec2::new(off as f64 * self.turn, 0.0));
            if !is_forward {
                along.reverse();
            }
            all.turns.resize(all.turns.len() + along.len(), on);
            all.written.append(&mut along);
        }
        all
    }

    /// The box around it.
    pub(super) fn bounds(&self) -> PlanBox {
        PlanBox::around(self.moved(0))
    }

    /// A ring around a pole as a ring of the plane that repeats every turn: its line from a turn west of `west` to a turn east of `east`,
    /// closed beyond the pole, where nothing is.
    pub(super) fn chain(&self, west: f64, east: f64) -> Vec<Plan> {
        let step = self.around.abs();
        let length = step as f64 * self.turn;
        let bounds = self.bounds();
        let first = ((west - self.turn - bounds.max.x) / length).floor() as i64;
        let last = ((east + self.turn - bounds.min.x) / length).ceil() as i64;
        let mut all: Vec<Plan> = match self.around > 0 {
            true => (first..=last).flat_map(|k| self.moved(k * step)).collect(),
            false => (first..=last).rev().flat_map(|k| self.moved(k * step)).collect(),
        };
        if let (Some(start), Some(end)) = (all.first().copied(), all.last().copied()) {
            let beyond = self.pole * 0.75 * self.turn;
            all.extend([Plan::new(end.x, beyond), Plan::new(start.x, beyond)]);
        }
        all
    }
}

/// The rings of one polygon.
pub(super) fn rings(rings: Vec<Vec<Plan>>, turn: Turn) -> Vec<Unrolled> {
    let mut all: Vec<Unrolled> = rings.into_iter().map(|written| ring(written, turn)).collect();
    let around = || all.iter().filter(|ring| ring.around != 0);
    // Two rings that enclose one pole leave the band between them, whichever pole that is.
    let told = around().map(|ring| ring.pole).find(|pole| *pole != 0.0);
    let pole = told.unwrap_or_else(|| {
        let mean =
            |ring: &Unrolled| ring.written.iter().map(|p| p.y).sum::<f64>() / ring.written.len() as f64;
        let side: f64 = around().map(mean).sum();
        if side < 0.0 { -1.0 } else { 1.0 }
    });
    for ring in all.iter_mut().filter(|ring| ring.around != 0 && ring.pole == 0.0) {
        ring.pole = pole;
    }
    all
}

fn ring(written: Vec<Plan>, turn: Turn) -> Unrolled {
    if is_frame(&written, turn) {
        return Unrolled::as_written(written, turn);
    }
    if let Some((mut rest, pole)) = without_the_way_along_a_pole(&written, turn) {
        // A box that reaches a pole: what is left is a parallel, a turn long, which is neither way the shorter one.
        let is_parallel = rest.len() == 2 && is_turn_apart(rest[0], rest[1], turn);
        if is_parallel {
            rest.insert(1, rest[0] + (rest[1] - rest[0]) * 0.5);
        }
        let mut unrolled = follow(rest, turn, true);
        unrolled.is_as_written |= is_parallel;
        if unrolled.around != 0 {
            return Unrolled { pole, ..unrolled };
        }
    }
    let unrolled = follow(written, turn, true);
    let width = |bounds: PlanBox| bounds.max.x - bounds.min.x;
    let as_written = width(PlanBox::around(unrolled.written.iter().copied()));
    let is_nothing = unrolled.around == 0 && width(unrolled.bounds()) < NOTHING * turn.length;
    if is_nothing && as_written > 0.5 * turn.length {
        return Unrolled::as_written(unrolled.written, turn);
    }
    unrolled
}

/// A line. One of two vertices a whole turn apart is a parallel.
pub(super) fn line(written: Vec<Plan>, turn: Turn) -> Unrolled {
    match written[..] {
        [a, b] if is_turn_apart(a, b, turn) => Unrolled::as_written(written, turn),
        _ => follow(written, turn, false),
    }
}

/// Whether two vertices are a whole turn apart, or more.
fn is_turn_apart(a: Plan, b: Plan, turn: Turn) -> bool {
    (a.x - b.x).abs() >= turn.length * (1.0 - NOTHING)
}

fn follow(written: Vec<Plan>, turn: Turn, is_ring: bool) -> Unrolled {
    let mut turns = Vec::with_capacity(written.len());
    let mut at = 0;
    for (k, p) in written.iter().enumerate() {
        if k > 0 {
            at += step(written[k - 1], *p, turn);
        }
        turns.push(at);
    }
    let around = match (written.first(), written.last()) {
        (Some(first), Some(last)) if is_ring => at + step(*last, *first, turn),
        _ => 0,
    };
    Unrolled { written, turns, turn: turn.length, around, pole: 0.0, is_as_written: false }
}

/// Over how many turns one goes from one vertex to the next.
fn step(from: Plan, to: Plan, turn: Turn) -> i64 {
    let plain = to.x - from.x;
    if plain.abs() <= 0.5 * turn.length || (pole(from, turn) != 0.0 && pole(to, turn) != 0.0) {
        return 0;
    }
    -((plain / turn.length).round() as i64)
}

/// The pole that a vertex is at: 1, -1, or 0 for none.
fn pole(p: Plan, turn: Turn) -> f64 {
    let is_there = p.y.abs() > turn.pole - AT_POLE * turn.length / 360.0;
    if is_there { 1_f64.copysign(p.y) } else { 0.0 }
}

/// A ring that goes along one of the poles for a turn, less its vertices there, and that pole.
fn without_the_way_along_a_pole(ring: &[Plan], turn: Turn) -> Option<(Vec<Plan>, f64)> {
    let n = ring.len();
    let start = ring.iter().position(|p| pole(*p, turn) == 0.0)?;
    let mut along: Option<(usize, usize, f64)> = None;
    let mut k = 0;
    while k < n {
        let at = |k: usize| ring[(start + k) % n];
        let side = pole(at(k), turn);
        let length = (k..n).take_while(|k| pole(at(*k), turn) == side).count();
        if side != 0.0 && (at(k + length - 1).x - at(k).x).abs() > 0.5 * turn.length {
            if along.is_some() {
                return None;
            }
            along = Some((k, length, side));
        }
        k += length;
    }
    let (first, length, side) = along?;
    let is_left = |k: &usize| !(first..first + length).contains(&((k + n - start) % n));
    let rest: Vec<Plan> = (0..n).filter(is_left).map(|k| ring[k]).collect();
    (rest.len() > 1).then_some((rest, side))
}

/// Whether a ring is a frame of the world.
fn is_frame(ring: &[Plan], turn: Turn) -> bool {
    let degree = turn.length / 360.0;
    let PlanBox { min: low, max: high } = PlanBox::around(ring.iter().copied());
    let margin = FRAME_MARGIN * degree;
    let is_on_a_side = |p: &Plan| {
        let across = min(p.x - low.x, high.x - p.x);
        let along = min(p.y - low.y, high.y - p.y);
        min(across, along) <= margin
    };
    high.x - low.x >= turn.length - 2.0 * margin
        && high.y - low.y > FRAME_HEIGHT * degree
        && ring.iter().all(is_on_a_side)
}

#[cfg(test)]
mod tests {
    use super::*;

    const DEGREES: Turn = Turn { length: 360.0, pole: 90.0 };

    fn plan(points: &[(f64, f64)]) -> Vec<Plan> {
        points.iter().map(|&(x, y)| Plan::new(x, y)).collect()
    }

    fn one(points: &[(f64, f64)]) -> Unrolled {
        rings(vec![plan(points)], DEGREES).remove(0)
    }

    fn xs(unrolled: &Unrolled) -> Vec<f64> {
        unrolled.moved(0).map(|p| p.x).collect()
    }

    #[test]
    fn a_ring_across_the_antimeridian_stays_narrow() {
        let island = one(&[(179.0, -16.0), (-179.0, -16.0), (-179.0, -17.0), (179.0, -17.0)]);
        assert_eq!((xs(&island), island.around), (vec![179.0, 181.0, 181.0, 179.0], 0));
        let box_of_the_pacific = one(&[(150.0, -40.0), (-120.0, -40.0), (-120.0, 40.0), (150.0, 40.0)]);
        assert_eq!(xs(&box_of_the_pacific), [150.0, 240.0, 240.0, 150.0]);
    }

    #[test]
    fn a_frame_of_the_world_stays_as_it_is_written() {
        for (edge, height) in [(180.0, 85.0), (179.9, 85.0), (180.2, 90.0), (179.0, 60.0), (200.0, 100.0)] {
            let frame = [(edge, height), (-edge, height), (-edge, -height), (edge, -height)];
            assert_eq!(xs(&one(&frame)), [edge, -edge, -edge, edge], "{edge}");
            let uneven =
                [(edge, height), (-10.0, height), (-edge, height), (-edge, -height), (edge, -height)];
            assert_eq!(xs(&one(&uneven)), [edge, -10.0, -edge, -edge, edge], "{edge}");
        }
        let half_at_a_pole = [(180.0, 90.0), (-180.0, 90.0), (-180.0, -85.0), (180.0, -85.0)];
        assert_eq!((xs(&one(&half_at_a_pole))[2], one(&half_at_a_pole).around), (-180.0, 0));
        let band = [(-180.0, 5.0), (180.0, 5.0), (180.0, 15.0), (-180.0, 15.0)];
        assert_eq!(xs(&one(&band)), [-180.0, 180.0, 180.0, -180.0]);
    }

    #[test]
    fn a_ring_around_a_pole_encloses_the_one_on_its_side() {
        let ice = one(&[(-180.0, -70.0), (-90.0, -75.0), (0.0, -70.0), (90.0, -75.0)]);
        assert_eq!((ice.around, ice.pole), (1, -1.0));
        let sea = one(&[(0.0, 80.0), (-120.0, 75.0), (120.0, 80.0)]);
        assert_eq!((xs(&sea), sea.around, sea.pole), (vec![0.0, -120.0, -240.0], -1, 1.0));
    }

    #[test]
    fn a_ring_that_a_file_closes_along_a_pole_encloses_it_without_the_way_there() {
        let antarctica = one(&[
            (-180.0, -90.0),
            (-180.0, -84.0),
            (0.0, -70.0),
            (90.0, -71.0),
            (180.0, -84.0),
            (180.0, -90.0),
        ]);
        assert_eq!((xs(&antarctica), antarctica.around), (vec![-180.0, 0.0, 90.0, 180.0], 1));
        assert_eq!(antarctica.pole, -1.0);
        // An ocean: its line is near the southern pole, but the file closes it at the northern one, and not quite there.
        let ocean = one(&[
            (-180.0, -60.0),
            (0.0, -70.0),
            (90.0, -50.0),
            (180.0, -60.0),
            (180.0, 90.000_000_000_000_06),
            (0.0, 90.0),
            (-180.0, 90.0),
        ]);
        assert_eq!((xs(&ocean), ocean.around, ocean.pole), (vec![-180.0, 0.0, 90.0, 180.0], 1, 1.0));
    }

    #[test]
    fn rings_around_the_globe_on_both_sides_of_the_equator_enclose_the_same_pole() {
        let circle = |y: f64| plan(&[(-180.0, y), (-90.0, y), (0.0, y), (90.0, y)]);
        let band = rings(vec![circle(10.0), circle(-12.0)], DEGREES);
        assert_eq!([band[0].pole, band[1].pole], [-1.0, -1.0]);
    }

    #[test]
    fn a_ring_around_a_pole_repeats_and_closes_where_nothing_is() {
        for turned in [false, true] {
            let mut points = [(-180.0, -70.0), (-90.0, -75.0), (0.0, -70.0), (90.0, -75.0)];
            if turned {
                points.reverse();
            }
            let chain = one(&points).chain(-10.0, 10.0);
            let bounds = PlanBox::around(chain.iter().copied());
            assert!(bounds.min.x <= -370.0 && bounds.max.x >= 370.0 && bounds.min.y == -270.0, "{bounds:?}");
            let hops = chain.windows(2).map(|pair| (pair[1].x - pair[0].x).abs());
            assert!(hops.take(chain.len() - 3).all(|hop| hop == 90.0), "{chain:?}");
        }
    }

    #[test]
    fn a_low_box_from_end_to_end_that_reaches_a_pole_is_a_ring_around_it() {
        for side in [-1.0, 1.0] {
            for turned in [false, true] {
                let mut corners = [
                    (-180.0, 90.0 * side),
                    (180.0, 90.0 * side),
                    (180.0, 60.0 * side),
                    (-180.0, 60.0 * side),
                ];
                if turned {
                    corners.reverse();
                }
                let ring = one(&corners);
                assert_eq!((ring.around.abs(), ring.pole), (1, side), "{side} {turned}");
                let bounds = PlanBox::around(ring.chain(-10.0, 10.0));
                assert!(bounds.min.x <= -370.0 && bounds.max.x >= 370.0, "{bounds:?}");
            }
        }
    }

    #[test]
    fn a_line_goes_on_over_the_antimeridian_and_a_parallel_is_whole() {
        let line_over = line(plan(&[(170.0, 0.0), (180.0, 0.0), (-180.0, 0.0), (-170.0, 1.0)]), DEGREES);
        assert_eq!(xs(&line_over), [170.0, 180.0, 180.0, 190.0]);
        let parallel = plan(&[(-180.0, 10.0), (180.0, 10.0)]);
        assert_eq!(xs(&line(parallel, DEGREES)), [-180.0, 180.0]);
    }

    #[test]
    fn what_needs_no_other_turn_keeps_its_bits() {
        let odd = [(10.1, 45.3), (10.7, 45.300_000_000_1), (-169.0, 46.0)];
        assert_eq!(one(&odd).moved(0).collect::<Vec<_>>(), plan(&odd));
        assert_eq!(line(plan(&odd), DEGREES).moved(0).collect::<Vec<_>>(), plan(&odd));
        // There and back again, too.
        let over = one(&[(0.1, 1.0), (-170.3, 2.0), (179.7, 3.0)]);
        assert_eq!(over.moved(0).collect::<Vec<_>>()[2], Plan::new(179.7 - 360.0, 3.0));
        assert_eq!(over.moved(1).collect::<Vec<_>>()[2], Plan::new(179.7, 3.0));
    }
}
