//! One or two edges that run through the fragment from border to border.

use super::Part;
use super::convex::{Convex, beside};
use super::windings::Windings;
use glam::DVec2;

/// Two edges that come nearer than this, in pixels, may be one: rounding says on which side of it the other lies.
const DOUBT: f64 = 1e-12;

/// Shorter parts, in pixels, have no direction that could be trusted: they touch a corner.
const SHORT: f64 = 1e-9;

/// A part of an edge from one side of the fragment to another.
struct Chord<'p> {
    part: &'p Part,
    enters: usize,
    leaves: usize,
}

impl<'p> Chord<'p> {
    fn new(part: &'p Part) -> Option<Self> {
        let (enters, leaves) = (part.enters? as usize, part.leaves? as usize);
        let is_long = part.from.distance_squared(part.to) > SHORT * SHORT;
        (enters != leaves && is_long).then_some(Self { part, enters, leaves })
    }

    fn has_on_its_left(&self, at: DVec2) -> bool {
        beside((self.part.from, self.part.to), at) > 0.0
    }

    /// Whether another edge lies on its left; `None`: on both sides, or too near to tell.
    fn side_of(&self, other: &Part) -> Option<bool> {
        let line = (self.part.from, self.part.to);
        let [a, b] = [other.from, other.to].map(|end| beside(line, end));
        let doubt = DOUBT * (line.1 - line.0).length();
        if a > doubt && b > doubt {
            return Some(true);
        }
        (a < -doubt && b < -doubt).then_some(false)
    }

    /// How the edge's winding number changes from the side of `place` to the other one.
    fn change_seen_from(&self, place: DVec2) -> (u8, i32) {
        (self.part.counter, if self.has_on_its_left(place) { -1 } else { 1 })
    }

    /// The area on the left, or on the right, of the edge.
    fn area(&self, fragment: &Convex, on_left: bool) -> f64 {
        let corners = fragment.corners();
        // On the left the border runs from the edge's end to its start.
        let (first, last) = if on_left { (self.leaves, self.enters) } else { (self.enters, self.leaves) };
        let (start, end) =
            if on_left { (self.part.to, self.part.from) } else { (self.part.from, self.part.to) };
        let (mut twice, mut before, mut k) = (0.0, start, first);
        while k != last {
            k = if k + 1 < corners.len() { k + 1 } else { 0 };
            twice += (before - end).perp_dot(corners[k] - end);
            before = corners[k];
        }
        let area = 0.5 * twice;
        if area > 0.0 { area } else { 0.0 }
    }
}

/// Tells the areas on both sides of the only edge; false: it does not run from border to border.
pub(super) fn of_one(
    fragment: &Convex,
    part: &Part,
    place: DVec2,
    windings: &mut Windings,
    tell: &mut impl FnMut(u64, f64),
) -> bool {
    let Some(chord) = Chord::new(part) else { return false };
    let here = chord.area(fragment, chord.has_on_its_left(place));
    tell(windings.set_of_all(), here);
    tell(windings.set_beyond(&[chord.change_seen_from(place)]), fragment.area() - here);
    true
}

/// Tells the areas on both sides of two edges and between them; false: they do not run from border to border, or they meet.
pub(super) fn of_two(
    fragment: &Convex,
    parts: [&Part; 2],
    place: DVec2,
    windings: &mut Windings,
    tell: &mut impl FnMut(u64, f64),
) -> bool {
    let [Some(one), Some(two)] = parts.map(Chord::new) else { return false };
    let sides = (one.side_of(two.part), two.side_of(one.part));
    let (Some(two_is_left), Some(one_is_left)) = sides else { return false };
    let [beyond_one, beyond_two] = [one.area(fragment, !two_is_left), two.area(fragment, !one_is_left)];
    let between = fragment.area() - beyond_one - beyond_two;
    let is_beyond = [one.has_on_its_left(place) != two_is_left, two.has_on_its_left(place) != one_is_left];
    let [of_one, of_two] = [one.change_seen_from(place), two.change_seen_from(place)];
    // The edges that lie between the reference and each of the three regions.
    let (to_one, to_two, to_between): (&[_], &[_], &[_]) = match is_beyond {
        [true, _] => (&[], &[of_one, of_two], &[of_one]),
        [_, true] => (&[of_one, of_two], &[], &[of_two]),
        _ => (&[of_one], &[of_two], &[]),
    };
    tell(windings.set_beyond(to_between), between);
    tell(windings.set_beyond(to_one), beyond_one);
    tell(windings.set_beyond(to_two), beyond_two);
    true
}
