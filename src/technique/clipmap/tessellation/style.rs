//! Joins and caps of a layer's style as strips: what the paper does not have. With them a strip's union is the footprint that the truth
//! measures, but for the sides that a circle is cut into.

use super::joint::Corner;
use super::strip::{Sagitta, Strips};
use crate::math;
use crate::scene::{Cap, Join};
use crate::space::Plan;
use glam::DVec2;

/// The most sides of a circle.
const MOST_SIDES: f64 = 4096.0;

/// Adds the pairs of a joint; where the strip cannot go on through it, it ends, the join is a strip of its own, and another begins.
pub(super) fn joint(corner: &Corner, join: Join, sagitta: Sagitta, out: &mut Strips) {
    let (s1, s2) = corner.lengths;
    let shortest = math::min(s1, s2);
    // Half a segment belongs to the joint at each of its ends. A disc's back lies in segments that are longer than it.
    let fits = corner.cut_off() <= 0.5 * shortest && (join != Join::Round || corner.half <= shortest);
    let through = corner.intersection().filter(|_| fits);
    let Some(m) = through else {
        out.push(corner.at, corner.before, -corner.before);
        out.end();
        alone(corner, join, sagitta, out);
        out.push(corner.at, corner.after, -corner.after);
        return;
    };
    if corner.turn == 0.0 || is_mitred(corner, join) {
        return out.push(corner.at, m, -m);
    }
    // Around the outside, always back to the inner corner.
    let is_left = corner.turn > 0.0;
    let mut pair = |aside: DVec2| match is_left {
        true => out.push(corner.at, m, -aside),
        false => out.push(corner.at, aside, -m),
    };
    pair(corner.before);
    if join == Join::Round {
        arc(corner.before, corner.after, sagitta, &mut pair);
    }
    pair(corner.after);
}

/// Whether the sides run on until they meet: the ratio of miter length to width is 1 / cos(turn / 2), its square 2 / (1 + cos turn).
fn is_mitred(corner: &Corner, join: Join) -> bool {
    matches!(join, Join::Miter { limit } if 2.0 <= limit * limit * (1.0 - corner.cosine()))
}

/// A join that is a strip of its own.
fn alone(corner: &Corner, join: Join, sagitta: Sagitta, out: &mut Strips) {
    if join == Join::Round {
        return disc(corner.at, corner.half, sagitta, out);
    }
    if corner.turn == 0.0 {
        return;
    }
    let outer = if corner.turn > 0.0 { -1.0 } else { 1.0 };
    let mut fan = |aside: DVec2| {
        let (left, right) = if outer < 0.0 { (DVec2::ZERO, aside) } else { (aside, DVec2::ZERO) };
        out.push(corner.at, left, right);
    };
    fan(corner.before * outer);
    if let Some(m) = corner.intersection().filter(|_| is_mitred(corner, join)) {
        fan(m * outer);
    }
    fan(corner.after * outer);
    out.end();
}

/// Calls `pair` with the offsets between two, on the shorter way around.
fn arc(from: DVec2, to: DVec2, sagitta: Sagitta, pair: &mut impl FnMut(DVec2)) {
    let angle = math::atan2(from.perp_dot(to), from.dot(to));
    let sides = sides(sagitta, angle.abs());
    let step = rotation(angle / sides as f64);
    let mut at = from;
    for _ in 1..sides {
        at = turned(at, step);
        pair(at);
    }
}

/// How many sides an arc of an angle has.
fn sides(Sagitta(sagitta): Sagitta, angle: f64) -> usize {
    // A side over the angle a stays 1 - cos(a / 2), nearly a^2 / 8, of the radius within the circle.
    let widest = (8.0 * sagitta).sqrt();
    let most = math::max(MOST_SIDES * angle / std::f64::consts::TAU, 1.0);
    math::min((angle / widest).ceil(), most.ceil()) as usize
}

fn rotation(angle: f64) -> DVec2 {
    DVec2::new(math::cos(angle), math::sin(angle))
}

fn turned(v: DVec2, by: DVec2) -> DVec2 {
    DVec2::new(v.x * by.x - v.y * by.y, v.x * by.y + v.y * by.x)
}

/// What stands before a line's first pair, whose left offset is `aside`.
pub(super) fn start_cap(at: Plan, aside: DVec2, cap: Cap, sagitta: Sagitta, out: &mut Strips) {
    // The perpendicular of a left offset points backwards.
    let back = aside.perp();
    match cap {
        Cap::Butt => {}
        Cap::Square => out.push(at, back + aside, back - aside),
        Cap::Round => half_disc(aside, back, sagitta, false, &mut |left, right| out.push(at, left, right)),
    }
}

/// What follows a line's last pair.
pub(super) fn end_cap(at: Plan, aside: DVec2, cap: Cap, sagitta: Sagitta, out: &mut Strips) {
    let ahead = -aside.perp();
    match cap {
        Cap::Butt => {}
        Cap::Square => out.push(at, ahead + aside, ahead - aside),
        Cap::Round => half_disc(aside, ahead, sagitta, true, &mut |left, right| out.push(at, left, right)),
    }
}

/// The pairs of half a disc between its straight side and its tip, either way, without the straight side.
fn half_disc(aside: DVec2, tip: DVec2, sagitta: Sagitta, to_tip: bool, pair: &mut impl FnMut(DVec2, DVec2)) {
    let sides = sides(sagitta, std::f64::consts::FRAC_PI_2);
    let step = std::f64::consts::FRAC_PI_2 / sides as f64;
    for k in 1..=sides {
        let k = if to_tip { k } else { sides + 1 - k };
        if k == sides {
            pair(tip, tip);
        } else {
            let turn = rotation(step * k as f64);
            pair(aside * turn.x + tip * turn.y, aside * -turn.x + tip * turn.y);
        }
    }
}

fn disc(at: Plan, radius: f64, sagitta: Sagitta, out: &mut Strips) {
    let (aside, ahead) = (DVec2::new(0.0, radius), DVec2::new(radius, 0.0));
    half_disc(aside, -ahead, sagitta, false, &mut |left, right| out.push(at, left, right));
    out.push(at, aside, -aside);
    half_disc(aside, ahead, sagitta, true, &mut |left, right| out.push(at, left, right));
    out.end();
}

/// A line of one vertex: nothing, a square along the axes, a disc.
pub(super) fn dot(at: Plan, half: f64, cap: Cap, sagitta: Sagitta, out: &mut Strips) {
    match cap {
        Cap::Butt => {}
        Cap::Square => {
            let (aside, ahead) = (DVec2::new(0.0, half), DVec2::new(half, 0.0));
            out.push(at, aside - ahead, -aside - ahead);
            out.push(at, aside + ahead, ahead - aside);
            out.end();
        }
        Cap::Round => disc(at, half, sagitta, out),
    }
}
