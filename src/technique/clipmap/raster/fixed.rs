//! Points and edges in fixed-point texel coordinates, so that sums of areas are exact: whatever the order, whatever the tile.

use crate::space::Texel;

/// Fractional bits of a texel: edges are moved by at most 2^-17 texel, areas are off by some 2^-16.
pub(super) const BITS: u32 = 16;
/// A texel.
pub(super) const ONE: i64 = 1 << BITS;

/// A coordinate of a texture stays below this (texels), so that fixed-point numbers and their differences are exact as doubles.
pub(super) const FARTHEST: f64 = 4_294_967_296.0;

/// A point in units of 2^-16 texel, x east, y south, relative to a tile's first texel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Fixed {
    pub(super) x: i64,
    pub(super) y: i64,
}

impl Fixed {
    /// The nearest point to one of the level; `origin` is the tile's first texel.
    #[inline(always)]
    pub(super) fn new(at: Texel, origin: (i64, i64)) -> Self {
        Self {
            x: nearest(at.x * ONE as f64) - (origin.0 << BITS),
            y: nearest(at.y * ONE as f64) - (origin.1 << BITS),
        }
    }
}

/// The nearest whole number, the even one of two; for magnitudes below 2^51.
#[inline(always)]
fn nearest(v: f64) -> i64 {
    // Adding 1.5 * 2^52 leaves the whole part in the lowest bits of the significand.
    const SHIFT: f64 = 6_755_399_441_055_744.0;
    (v + SHIFT).to_bits() as i64 - SHIFT.to_bits() as i64
}

/// An edge that is not level, from its northern end (smaller y) to its southern.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Edge {
    pub(super) top: Fixed,
    pub(super) bottom: Fixed,
    /// What is added to the winding number of points east of it: 1 where the ring runs south, -1 where it runs north. So a ring
    /// that turns counter-clockwise on the map counts 1 inside.
    pub(super) sign: i32,
    /// x over y.
    slope: f64,
    /// y over x; of no use where it is not finite, nor needed there.
    inverse: f64,
}

impl Edge {
    /// The edge from one vertex of a ring to the next; `None` when it is level.
    #[inline(always)]
    pub(super) fn new(from: Fixed, to: Fixed) -> Option<Self> {
        let (top, bottom, sign) = match from.y < to.y {
            true => (from, to, 1),
            false => (to, from, -1),
        };
        let (width, height) = ((bottom.x - top.x) as f64, (bottom.y - top.y) as f64);
        (height > 0.0).then(|| Self { top, bottom, sign, slope: width / height, inverse: height / width })
    }

    /// x over y and y over x.
    #[inline(always)]
    pub(super) fn slopes(&self) -> (f64, f64) {
        (self.slope, self.inverse)
    }

    /// Whether it meets at most two texels of a row (otherwise, at most two of a column).
    #[inline(always)]
    pub(super) fn is_steep(&self) -> bool {
        (self.bottom.x - self.top.x).abs() <= self.bottom.y - self.top.y
    }

    /// Where it crosses a height between its ends. The same in every tile: the product does not depend on the origin, and the
    /// sum is exact.
    #[inline(always)]
    pub(super) fn x_at(&self, y: i64) -> i64 {
        self.top.x + nearest((y - self.top.y) as f64 * self.slope)
    }

    /// At which height it crosses a meridian between its ends; the caller keeps it within a row.
    #[inline(always)]
    pub(super) fn y_at(&self, x: i64) -> i64 {
        self.top.y + nearest((x - self.top.x) as f64 * self.inverse)
    }

    /// Its part in a row that it passes through.
    #[inline(always)]
    pub(super) fn in_row(&self, row: i64) -> EdgePiece {
        let (north, south) = (row << BITS, (row + 1) << BITS);
        let top = if self.top.y >= north { self.top } else { Fixed { x: self.x_at(north), y: north } };
        let bottom =
            if self.bottom.y <= south { self.bottom } else { Fixed { x: self.x_at(south), y: south } };
        EdgePiece { top, bottom }
    }
}

/// The part of an edge in a row of texels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct EdgePiece {
    pub(super) top: Fixed,
    pub(super) bottom: Fixed,
}

/// A ring without what lies farther than `reach` from the texture's corner on either axis: coordinates beyond are moved to the
/// limit, edges across it are cut there first. Within nothing changes.
pub(super) fn without_far<'r>(ring: &'r [Texel], reach: f64, out: &'r mut Vec<Texel>) -> &'r [Texel] {
    let is_near = |p: &Texel| (p.x.abs() <= reach) & (p.y.abs() <= reach);
    if ring.iter().fold(true, |all, p| all & is_near(p)) {
        return ring;
    }
    out.clear();
    for (k, &from) in ring.iter().enumerate() {
        let to = ring[(k + 1) % ring.len()];
        out.push(from);
        let mut cuts = [0.0; 4];
        let mut count = 0;
        let mut cut = |a: f64, b: f64, limit: f64| {
            if (a < limit) != (b < limit) {
                cuts[count] = (limit - a) / (b - a);
                count += 1;
            }
        };
        for limit in [-reach, reach] {
            cut(from.x, to.x, limit);
            cut(from.y, to.y, limit);
        }
        cuts[..count].sort_unstable_by(f64::total_cmp);
        out.extend(cuts[..count].iter().map(|t| Texel::from(from.to_vec() * (1.0 - t) + to.to_vec() * *t)));
    }
    for p in out.iter_mut() {
        *p = Texel::new(p.x.clamp(-reach, reach), p.y.clamp(-reach, reach));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_whole_number_is_found_on_both_sides_of_zero() {
        let cases = [
            (0.4, 0),
            (0.5, 0),
            (1.5, 2),
            (-0.4, 0),
            (-0.5, 0),
            (-1.5, -2),
            (-7.2, -7),
            (2e15, 2_000_000_000_000_000),
        ];
        assert!(cases.iter().all(|(v, whole)| nearest(*v) == *whole));
    }

    #[test]
    fn an_edge_crosses_rows_at_the_same_places_in_every_tile() {
        let (a, b) = (Texel::new(1000.3, 17.9), Texel::new(1531.71, 401.33));
        let edges = [(0, 0), (1024, 0), (1280, 256), (-512, 128)].map(|origin| {
            let edge = Edge::new(Fixed::new(a, origin), Fixed::new(b, origin)).unwrap();
            let at = |row: i64| edge.x_at((row - origin.1) << BITS) + (origin.0 << BITS);
            (18..=401).map(at).collect::<Vec<_>>()
        });
        assert!(edges.iter().all(|xs| *xs == edges[0]));
    }

    #[test]
    fn a_ring_is_cut_where_it_leaves_for_infinity() {
        let ring = [Texel::new(0.0, 0.0), Texel::new(1e30, 1e30), Texel::new(-1e30, 1e30)];
        let mut room = Vec::new();
        let out = without_far(&ring, FARTHEST, &mut room);
        assert!(out.iter().all(|p| p.x.abs() <= FARTHEST && p.y.abs() <= FARTHEST));
        let on_diagonal = |p: &Texel| p.x == FARTHEST && (p.y - FARTHEST).abs() < 1.0;
        assert!(out[1..].iter().any(on_diagonal), "{out:?}");
    }
}
