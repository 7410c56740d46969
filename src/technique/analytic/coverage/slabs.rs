//! Any edges: the fragment is cut into slabs at all heights where an edge ends or two of them cross. In a slab edges keep their order, and
//! between two of them lies a trapezoid.

use super::Part;
use super::convex::Convex;
use super::windings::Windings;
use crate::math;
use glam::DVec2;

/// Edges that rise by less, in pixels, are level: what they could change is no higher.
const LEVEL: f64 = 1e-15;

/// An edge that is not level, from its smaller y to its larger.
#[derive(Debug, Clone, Copy)]
struct Rising {
    low: DVec2,
    high: DVec2,
    /// Change of x with y.
    slope: f64,
    counter: u8,
    /// How its winding number changes from west to east.
    change: i32,
}

impl Rising {
    #[inline(always)]
    fn x_at(&self, y: f64) -> f64 {
        self.low.x + (y - self.low.y) * self.slope
    }

    /// The height at which another one crosses it between the ends of both.
    fn crossing(&self, other: &Self) -> Option<f64> {
        let low = math::max(self.low.y, other.low.y);
        let high = math::min(self.high.y, other.high.y);
        if low >= high {
            return None;
        }
        let (below, above) = (self.x_at(low) - other.x_at(low), self.x_at(high) - other.x_at(high));
        let crosses = (below > 0.0 && above < 0.0) || (below < 0.0 && above > 0.0);
        crosses.then(|| low + (high - low) * (below / (below - above)))
    }
}

/// A change of a winding number along the fragment's western border, above this height.
#[derive(Debug, Clone, Copy)]
struct Step {
    y: f64,
    counter: u8,
    change: i32,
}

/// Lists that are used again.
#[derive(Debug, Default)]
pub(super) struct Slabs {
    rising: Vec<Rising>,
    steps: Vec<Step>,
    heights: Vec<f64>,
    /// In a slab, from west to east: where an edge is, and which.
    order: Vec<(f64, u32)>,
    west: Vec<i32>,
    counts: Vec<i32>,
}

impl Slabs {
    /// Calls `tell` with sets of items and areas, which add up to the fragment's. The winding numbers are those at `place`.
    pub(super) fn measure(
        &mut self,
        fragment: &Convex,
        (parts, touches): (&[Part], &[Part]),
        place: DVec2,
        windings: &Windings,
        tell: &mut impl FnMut(u64, f64),
    ) {
        self.take(fragment, parts, touches);
        self.find_west(place, windings.counts());
        self.find_heights(fragment, parts);
        let (mut next, mut border) = (0, Border::new(fragment));
        for k in 1..self.heights.len() {
            let (low, high) = (self.heights[k - 1], self.heights[k]);
            while self.steps.get(next).is_some_and(|step| step.y <= low) {
                let step = self.steps[next];
                self.west[step.counter as usize] += step.change;
                next += 1;
            }
            if low < high {
                self.slab((low, high), border.at(low + 0.5 * (high - low)), windings, tell);
            }
        }
    }

    fn slab(
        &mut self,
        (low, high): (f64, f64),
        [west, east]: [f64; 2],
        windings: &Windings,
        tell: &mut impl FnMut(u64, f64),
    ) {
        let middle = low + 0.5 * (high - low);
        self.order.clear();
        for (k, edge) in (0..).zip(&self.rising) {
            if edge.low.y <= low && edge.high.y >= high {
                self.order.push((edge.x_at(middle), k));
            }
        }
        self.order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        self.counts.clear();
        self.counts.extend_from_slice(&self.west);
        let mut set = windings.set_of(&self.counts);
        let mut from = west;
        for &(x, k) in &self.order {
            let x = math::min(x, east);
            if x > from {
                tell(set, (x - from) * (high - low));
                from = x;
            }
            let edge = &self.rising[k as usize];
            self.counts[edge.counter as usize] += edge.change;
            let bit = 1 << (edge.counter / 2);
            set = (set & !bit) | windings.bit(edge.counter, &self.counts);
        }
        if east > from {
            tell(set, (east - from) * (high - low));
        }
    }

    /// Takes the edges, and what they change along the western border.
    fn take(&mut self, fragment: &Convex, parts: &[Part], touches: &[Part]) {
        self.rising.clear();
        self.steps.clear();
        let is_western = |side: Option<u8>| {
            side.is_some_and(|k| {
                let (a, b) = fragment.side(k as usize);
                b.y < a.y
            })
        };
        for part in parts.iter().chain(touches) {
            // Up along the border, an edge that comes in has its left above it.
            for (side, y, change) in [(part.enters, part.from.y, 1), (part.leaves, part.to.y, -1)] {
                if is_western(side) {
                    self.steps.push(Step { y, counter: part.counter, change });
                }
            }
            let is_up = part.to.y > part.from.y;
            let (low, high) = if is_up { (part.from, part.to) } else { (part.to, part.from) };
            if high.y - low.y >= LEVEL {
                let slope = (high.x - low.x) / (high.y - low.y);
                let change = if is_up { -1 } else { 1 };
                self.rising.push(Rising { low, high, slope, counter: part.counter, change });
            }
        }
        self.steps.sort_by(|a, b| a.y.total_cmp(&b.y));
    }

    /// From the winding numbers at a place, those at the western border below all steps.
    fn find_west(&mut self, place: DVec2, counts: &[i32]) {
        self.west.clear();
        self.west.extend_from_slice(counts);
        let spans = |edge: &&Rising| edge.low.y <= place.y && place.y < edge.high.y;
        for edge in self.rising.iter().filter(spans) {
            if edge.x_at(place.y) < place.x {
                self.west[edge.counter as usize] -= edge.change;
            }
        }
        for step in self.steps.iter().take_while(|step| step.y <= place.y) {
            self.west[step.counter as usize] -= step.change;
        }
    }

    /// All heights where anything ends or crosses, within those of the fragment.
    fn find_heights(&mut self, fragment: &Convex, parts: &[Part]) {
        self.heights.clear();
        self.heights.extend(fragment.corners().iter().map(|corner| corner.y));
        let least = self.heights.iter().copied().fold(f64::INFINITY, math::min);
        let most = self.heights.iter().copied().fold(f64::NEG_INFINITY, math::max);
        self.heights.extend(parts.iter().flat_map(|part| [part.from.y, part.to.y]));
        for (k, a) in self.rising.iter().enumerate() {
            self.heights.extend(self.rising[..k].iter().filter_map(|b| a.crossing(b)));
        }
        for y in &mut self.heights {
            *y = math::max(math::min(*y, most), least);
        }
        self.heights.sort_unstable_by(f64::total_cmp);
        self.heights.dedup();
    }
}

/// The fragment's western and eastern border at rising heights.
struct Border<'f> {
    fragment: &'f Convex,
}

impl<'f> Border<'f> {
    fn new(fragment: &'f Convex) -> Self {
        Self { fragment }
    }

    /// Where it begins and ends at a height that is no corner's.
    fn at(&mut self, y: f64) -> [f64; 2] {
        let (mut west, mut east) = (f64::INFINITY, f64::NEG_INFINITY);
        for k in 0..self.fragment.corners().len() {
            let (a, b) = self.fragment.side(k);
            if (a.y <= y) != (b.y <= y) {
                let x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
                west = math::min(west, x);
                east = math::max(east, x);
            }
        }
        [west, east]
    }
}
