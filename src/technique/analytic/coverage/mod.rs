//! How much of a convex fragment of a pixel each set of items covers, exactly.
//!
//! Input: a fragment; items in draw order, each with directed edges of its area's border and closed pieces of its stroke, all in pixel units
//! from the pixel's own corner. Output: sets of items and the areas where just these cover, which add up to the fragment's area. Refuses
//! (`None`): more items than bits, more edges than the caller allows, no place that is clear of all edges; then who asked samples.
//!
//! Edges are cut to the fragment. What crosses what is a winding number for each item's area and one for its stroke: known at one place of
//! the fragment, it is known everywhere by the edges between. Coincident and shared edges, degenerate pieces and edges along the fragment's
//! border therefore need no care: whichever side rounding puts them on, both sides agree but for a strip as narrow as the rounding.

mod chords;
mod convex;
mod place;
mod slabs;
mod windings;

pub use windings::{Inside, Membership};

use convex::Convex;
use glam::DVec2;
use slabs::Slabs;
use windings::Windings;

/// Which closed form a fragment's areas have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Class {
    /// No edge: one set of items.
    Point,
    /// One straight edge from border to border.
    Half,
    /// Two that do not cross, such as both sides of a stroke.
    Band,
    /// Trapezoids between the heights where anything ends or crosses.
    Slabs,
}

/// The part of an edge that lies in the fragment.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Part {
    from: DVec2,
    to: DVec2,
    /// The fragment's side through which it comes in; `None`: it starts inside.
    enters: Option<u8>,
    /// The side through which it goes out.
    leaves: Option<u8>,
    /// Whose winding number is one more on its left.
    counter: u8,
}

/// The lists of one fragment; used again for the next.
#[derive(Debug, Default)]
pub struct Coverage {
    fragment: Convex,
    parts: Vec<Part>,
    /// Parts that are points of the border: nothing but a way in or out.
    touches: Vec<Part>,
    /// Closed pieces of strokes: their corners, one after the other.
    corners: Vec<DVec2>,
    /// Where each piece's corners end, and whose it is.
    pieces: Vec<(u32, u8)>,
    windings: Windings,
    place: Option<DVec2>,
    slabs: Slabs,
    areas: Vec<(u64, f64)>,
}

impl Coverage {
    /// Begins a fragment: at least three corners of a convex polygon, of either turn.
    pub fn begin(&mut self, corners: &[DVec2]) {
        self.fragment.set(corners);
        self.parts.clear();
        self.touches.clear();
        self.corners.clear();
        self.pieces.clear();
        self.windings.clear();
        self.place = None;
    }

    /// Adds an item above those that there are; returns its bit in the sets. `None`: there are more than sets have bits.
    pub fn item(&mut self, of: Membership) -> Option<u32> {
        self.windings.add(of)
    }

    /// Adds an edge of the border of an item's area: a point on the left (`cross(to - from, p - from) > 0`) has one turn more than one on
    /// the right. Edges that miss the fragment may be left out.
    pub fn edge(&mut self, item: u32, from: DVec2, to: DVec2) {
        self.cut(Windings::area_of(item), from, to);
    }

    /// Adds a closed convex piece of an item's stroke, of either turn.
    pub fn piece(&mut self, item: u32, ring: &[DVec2]) {
        let is_turned = convex::twice_area(ring) < 0.0;
        let side = |k: usize| {
            let (a, b) = (ring[k], ring[(k + 1) % ring.len()]);
            if is_turned { (b, a) } else { (a, b) }
        };
        if self.fragment.is_apart_from(ring) || (0..ring.len()).any(|k| self.fragment.is_right_of(side(k))) {
            return;
        }
        let counter = Windings::stroke_of(item);
        for k in 0..ring.len() {
            let (from, to) = side(k);
            self.cut(counter, from, to);
        }
        self.corners.extend_from_slice(ring);
        self.pieces.push((self.corners.len() as u32, counter));
    }

    fn cut(&mut self, counter: u8, from: DVec2, to: DVec2) {
        if let Some(part) = self.fragment.cut(from, to) {
            let part = Part { counter, ..part };
            if part.from == part.to { &mut self.touches } else { &mut self.parts }.push(part);
        }
    }

    /// A place in the fragment that is clear of all edges, where winding numbers can be asked. `None`: there is none that can be trusted.
    pub fn reference(&mut self) -> Option<DVec2> {
        if self.place.is_none() {
            self.place = place::clear_of(&self.fragment, &self.parts);
        }
        self.place
    }

    /// Says how often the border of an item's area turns around the [`reference`](Self::reference); 0 where it is not said.
    pub fn winding(&mut self, item: u32, turns: i32) {
        self.windings.set(Windings::area_of(item), turns);
    }

    /// How many parts of edges lie in the fragment.
    pub fn edges(&self) -> usize {
        self.parts.len()
    }

    /// Measures the areas. `None`: there are more than `crowd` parts of edges (or `crowd` is 0), or no reference.
    pub fn measure(&mut self, crowd: usize) -> Option<Class> {
        self.areas.clear();
        if crowd == 0 || self.parts.len() > crowd {
            return None;
        }
        let place = self.reference()?;
        self.count_pieces(place);
        let (fragment, windings, areas) = (&self.fragment, &mut self.windings, &mut self.areas);
        let mut tell = |set: u64, area: f64| add(areas, set, area);
        Some(match &self.parts[..] {
            [] => {
                tell(windings.set_of_all(), fragment.area());
                Class::Point
            }
            [one] if chords::of_one(fragment, one, place, windings, &mut tell) => Class::Half,
            [one, two] if chords::of_two(fragment, [one, two], place, windings, &mut tell) => Class::Band,
            parts => {
                self.slabs.measure(fragment, (parts, &self.touches), place, windings, &mut tell);
                Class::Slabs
            }
        })
    }

    /// The distinct sets of items, bit k for the k-th, and the areas where just these cover, in pixels' areas.
    pub fn areas(&self) -> &[(u64, f64)] {
        &self.areas
    }

    /// Counts the pieces that hold a place.
    fn count_pieces(&mut self, place: DVec2) {
        let mut first = 0;
        for &(end, counter) in &self.pieces {
            let ring = &self.corners[first..end as usize];
            if convex::holds(ring, place) {
                self.windings.change(counter, 1);
            }
            first = end as usize;
        }
        self.pieces.clear();
    }
}

/// Adds an area to that of its set.
fn add(areas: &mut Vec<(u64, f64)>, set: u64, area: f64) {
    match areas.iter_mut().find(|(of, _)| *of == set) {
        Some((_, sum)) => *sum += area,
        None => areas.push((set, area)),
    }
}

#[cfg(test)]
mod tests;
