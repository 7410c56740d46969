//! Functions that are linear on the screen, with a bound of their error; and lines.

use crate::interval::Ball;

/// Unit roundoff of doubles.
const U: f64 = f64::EPSILON / 2.0;

/// A function `c + x * px + y * py` of a point of a tile, its coefficients known up to radii.
#[derive(Debug, Clone, Copy)]
pub(super) struct BallForm {
    pub(super) c: Ball,
    pub(super) x: Ball,
    pub(super) y: Ball,
}

impl BallForm {
    /// The same everywhere.
    pub(super) const fn constant(c: Ball) -> Self {
        Self { c, x: Ball::ZERO, y: Ball::ZERO }
    }

    #[must_use]
    pub(super) fn times(&self, by: Ball) -> Self {
        Self { c: self.c * by, x: self.x * by, y: self.y * by }
    }

    #[must_use]
    pub(super) fn plus(&self, other: &Self) -> Self {
        Self { c: self.c + other.c, x: self.x + other.x, y: self.y + other.y }
    }

    #[must_use]
    pub(super) fn signed(&self, sign: f64) -> Self {
        if sign < 0.0 { Self { c: -self.c, x: -self.x, y: -self.y } } else { *self }
    }

    /// In plain doubles, with one bound of the error for points within `span` pixels of the tile's corner.
    pub(super) fn plain(&self, span: f64) -> Form {
        let spread = self.c.radius + span * (self.x.radius + self.y.radius);
        let size = self.c.mid.abs() + span * (self.x.mid.abs() + self.y.mid.abs());
        // Two evaluations (the pixel's corner, a point in the pixel), three roundings each; the bound's own few.
        let error = (spread + 8.0 * U * size) * (1.0 + 16.0 * U) + f64::MIN_POSITIVE;
        let error = if error.is_finite() { error } else { f64::INFINITY };
        Form { c: self.c.mid, x: self.x.mid, y: self.y.mid, error }
    }
}

/// A linear function of a point of a tile in plain doubles: `at` is within `error` of the exact value.
#[derive(Debug, Clone, Copy)]
pub(super) struct Form {
    pub(super) c: f64,
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) error: f64,
}

impl Form {
    #[inline(always)]
    pub(super) fn at(&self, [x, y]: [f64; 2]) -> f64 {
        self.c + (self.x * x + self.y * y)
    }

    /// The same function of a point measured from another corner.
    #[inline(always)]
    pub(super) fn seen_from(&self, corner: [f64; 2]) -> Self {
        Self { c: self.at(corner), ..*self }
    }

    /// The least and the largest value over a square of this side at the corner, without the error.
    #[inline(always)]
    pub(super) fn range(&self, corner: [f64; 2], side: f64) -> (f64, f64) {
        let (at, x, y) = (self.at(corner), self.x * side, self.y * side);
        let below = |v: f64| if v < 0.0 { v } else { 0.0 };
        (at + below(x) + below(y), at - below(-x) - below(-y))
    }

    /// The line where it is 0, in the unit square.
    #[inline]
    pub(super) fn line(&self) -> Line {
        let gradient = (self.x * self.x + self.y * self.y).sqrt();
        let span = self.x.abs() + self.y.abs();
        if self.c.abs() > 2.0 * (span + self.error) {
            return Line::constant(self.c);
        }
        if gradient <= self.error || !gradient.is_finite() {
            return Line::UNKNOWN;
        }
        let by = 1.0 / gradient;
        // |c| is at most a few pixels here: the roundings of the division and of later evaluations are below this.
        let delta = (self.error * by + 32.0 * U * (1.0 + self.c.abs() * by)) * (1.0 + 16.0 * U);
        Line { x: self.x * by, y: self.y * by, c: self.c * by, delta }
    }
}

/// A line on a pixel's unit square: the signed distance from it, positive on its inner side. The exact line's distance
/// differs by at most `delta` anywhere on the square.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    x: f64,
    y: f64,
    c: f64,
    pub(super) delta: f64,
}

/// Where a piece lies of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// On the inner side, but for a strip along the line that has been accounted for.
    In,
    /// On the outer side, but for such a strip.
    Out,
    /// On both.
    Both,
    /// The line is not known well enough.
    Unknown,
}

impl Line {
    /// A line of which nothing is known.
    const UNKNOWN: Self = Self { x: 0.0, y: 0.0, c: 0.0, delta: f64::INFINITY };

    /// The points with this x.
    pub(super) fn upright(x: f64) -> Self {
        Self { x: 1.0, y: 0.0, c: -x, delta: 2.0 * U }
    }

    /// The points with this y.
    pub(super) fn level(y: f64) -> Self {
        Self { x: 0.0, y: 1.0, c: -y, delta: 2.0 * U }
    }

    /// All of the square on one side.
    fn constant(sign: f64) -> Self {
        Self { x: 0.0, y: 0.0, c: if sign > 0.0 { 8.0 } else { -8.0 }, delta: 0.0 }
    }

    #[inline(always)]
    pub(super) fn at(&self, [x, y]: [f64; 2]) -> f64 {
        self.c + (self.x * x + self.y * y)
    }

    /// On which side of the line a convex piece lies; `slop` grows by what the line's uncertainty makes doubtful, in pixels'
    /// areas.
    #[inline]
    pub(super) fn side(&self, piece: &[[f64; 2]], slop: &mut f64) -> Side {
        if self.delta >= MOST_DELTA {
            return Side::Unknown;
        }
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for p in piece {
            let s = self.at(*p);
            low = if s < low { s } else { low };
            high = if s > high { s } else { high };
        }
        if low >= self.delta {
            return Side::In;
        }
        if high <= -self.delta {
            return Side::Out;
        }
        // The strip of doubt along the line is at most as long as the piece.
        if low >= -self.delta || high <= self.delta {
            *slop += 2.0 * self.delta * extent(piece);
            return if low + high > 0.0 { Side::In } else { Side::Out };
        }
        Side::Both
    }
}

/// A line known no better than this, in pixels, decides nothing.
const MOST_DELTA: f64 = 1.0 / 16.0;

/// A bound of a piece's diameter.
fn extent(piece: &[[f64; 2]]) -> f64 {
    let [mut west, mut north] = piece[0];
    let (mut east, mut south) = (west, north);
    for [x, y] in piece {
        (west, east) = (if *x < west { *x } else { west }, if *x > east { *x } else { east });
        (north, south) = (if *y < north { *y } else { north }, if *y > south { *y } else { south });
    }
    (east - west) + (south - north)
}

#[cfg(test)]
mod tests {
    use super::*;
    use dashu::rational::RBig;
    use proptest::prelude::*;

    fn number() -> impl Strategy<Value = f64> {
        prop_oneof![1 => Just(0.0), 2 => -1.0..1.0, 1 => -1e6..1e6]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn a_form_in_plain_doubles_is_no_farther_off_than_its_bound(
            [c, x, y] in prop::array::uniform3(number()),
            corner in prop::array::uniform2(0..64_u32),
            at in prop::array::uniform2(0.0..=1.0),
        ) {
            let ball = BallForm { c: Ball::exact(c), x: Ball::exact(x), y: Ball::exact(y) };
            let form = ball.plain(65.0);
            let corner = corner.map(f64::from);
            let found = form.seen_from(corner).at(at);
            let rational = |v: f64| RBig::try_from(v).unwrap();
            let place = [0, 1].map(|k| rational(corner[k]) + rational(at[k]));
            let [px, py] = place;
            let exact = rational(c) + rational(x) * px + rational(y) * py;
            let bound = rational(form.error);
            let (least, most) = (rational(found) - bound.clone(), rational(found) + bound);
            prop_assert!(least <= exact && exact <= most, "{found} +- {}", form.error);
        }

        #[test]
        fn a_form_on_a_square_lies_between_the_ends_of_its_range(
            [c, x, y] in prop::array::uniform3(number()),
            corner in prop::array::uniform2(0.0..64.0),
            side in 0.0..8.0,
        ) {
            let form = Form { c, x, y, error: 0.0 };
            let corners = [[0.0, 0.0], [side, 0.0], [0.0, side], [side, side]];
            let values = corners.map(|[dx, dy]| form.at([corner[0] + dx, corner[1] + dy]));
            let least = values.into_iter().fold(f64::INFINITY, crate::math::min);
            let most = values.into_iter().fold(f64::NEG_INFINITY, crate::math::max);
            let (low, high) = form.range(corner, side);
            let hair = 1e-12 * (c.abs() + 64.0 * (x.abs() + y.abs()));
            prop_assert!((low - least).abs() <= hair && (high - most).abs() <= hair);
        }
    }

    #[test]
    fn a_piece_along_a_line_is_doubtful_in_a_strip_as_long_as_the_piece() {
        let lines = [(Line::upright(0.5), [0.0, 1.0]), (Line::level(0.5), [1.0, 0.0])];
        for (line, [x, y]) in lines {
            // From the line to far off on its one side, to and fro along it.
            let [a, b, c] =
                [[0.5, 0.5], [0.5 + 0.25 * x, 0.5 + 0.25 * y], [0.5 - 0.125 * x, 0.5 - 0.125 * y]];
            for piece in [[a, b, c], [b, c, a], [c, a, b]] {
                let mut slop = 0.0;
                assert_ne!(line.side(&piece, &mut slop), Side::Both);
                assert!((2.0 * line.delta * 0.375..=2.0 * line.delta * 0.5).contains(&slop), "{slop}");
            }
        }
    }

    #[test]
    fn a_piece_off_a_line_is_on_one_side_without_a_doubt_and_one_across_on_both() {
        let across = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
        for (line, way) in [(Line::upright(0.5), [1.0, 0.0]), (Line::level(0.5), [0.0, 1.0])] {
            let moved = |by: f64| across.map(|[x, y]| [x + by * way[0], y + by * way[1]]);
            let mut slop = 0.0;
            assert_eq!(line.side(&moved(0.0), &mut slop), Side::Both);
            assert_eq!(line.side(&moved(0.75), &mut slop), Side::In);
            assert_eq!(line.side(&moved(-0.75), &mut slop), Side::Out);
            assert_eq!(slop, 0.0);
        }
    }
}
