//! Fast approximate anti-aliasing of a finished picture (3.5, 4.5, after Lottes 2009, "FXAA", NVIDIA).
//!
//! Input: encoded colours. Output: colours in which steps of edges are smoothed. Written from what the filter is known to do: where the luma of a pixel and its
//! four neighbours differs enough there is an edge; it runs along rows or columns, whichever differs less; both its ends are looked for; nearer to
//! an end more of the neighbour across the edge is mixed in; single pixels that stand out are mixed with all around. Steps and thresholds are those of the
//! filter's default quality. Refuses: nothing.
//!
//! Colours are mixed premultiplied. Beyond the picture its border goes on.

use crate::math;

/// A difference of luma below this share of the largest luma around is no edge.
const EDGE_SHARE: f64 = 0.166;
/// Nor is one below this.
const EDGE_LEAST: f64 = 0.0833;
/// How much of a pixel that stands out is taken away at most.
const SUBPIXEL: f64 = 0.75;
/// How many pixels on each look along an edge is.
const STEPS: [f64; 5] = [1.0, 1.5, 2.0, 4.0, 12.0];
/// Pixels that a pixel's colour may depend on in each direction: all steps, one more for those between pixels.
pub const REACH: usize = 22;

/// A colour, premultiplied, and its luma.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Texel {
    color: [f64; 4],
    luma: f64,
}

/// A picture that is to be smoothed.
#[derive(Debug)]
pub struct Picture {
    size: [usize; 2],
    texels: Vec<Texel>,
}

impl Picture {
    /// The picture of encoded colours with straight alpha, rows from the top.
    pub fn new(size: [usize; 2], colors: &[[f64; 4]]) -> Self {
        let texel = |[r, g, b, a]: &[f64; 4]| {
            let color = [r * a, g * a, b * a, *a];
            // Rec. 601.
            Texel { color, luma: 0.299 * color[0] + 0.587 * color[1] + 0.114 * color[2] }
        };
        Self { size, texels: colors.iter().map(texel).collect() }
    }

    fn at(&self, [x, y]: [usize; 2], [dx, dy]: [isize; 2]) -> &Texel {
        let place = |at: usize, by: isize, size: usize| at.saturating_add_signed(by).min(size - 1);
        &self.texels[place(y, dy, self.size[1]) * self.size[0] + place(x, dx, self.size[0])]
    }

    /// The texel at a place between two neighbours: `by` of the way from a pixel to its neighbour across the edge.
    fn mixed(&self, at: [usize; 2], across: [isize; 2], by: f64) -> [f64; 4] {
        let (own, other) = (self.at(at, [0, 0]).color, self.at(at, across).color);
        std::array::from_fn(|k| own[k] + (other[k] - own[k]) * by)
    }

    /// The smoothed colour of a pixel: encoded, straight alpha.
    pub fn smoothed(&self, at: [usize; 2]) -> [f64; 4] {
        let [r, g, b, a] = self.filtered(at);
        let straight = |v: f64| if a > 0.0 { math::min(v / a, 1.0) } else { 0.0 };
        [straight(r), straight(g), straight(b), a]
    }

    fn filtered(&self, at: [usize; 2]) -> [f64; 4] {
        let luma = |dx: isize, dy: isize| self.at(at, [dx, dy]).luma;
        let own = luma(0, 0);
        let [north, south, west, east] = [luma(0, -1), luma(0, 1), luma(-1, 0), luma(1, 0)];
        let around = [north, south, west, east];
        let most = around.iter().fold(own, |most, l| math::max(*l, most));
        let least = around.iter().fold(own, |least, l| math::min(*l, least));
        let range = most - least;
        if range < math::max(EDGE_LEAST, most * EDGE_SHARE) {
            return self.at(at, [0, 0]).color;
        }
        let [nw, ne, sw, se] = [luma(-1, -1), luma(1, -1), luma(-1, 1), luma(1, 1)];
        // How much a pixel stands out from the eight around it.
        let mean = (2.0 * (north + south + west + east) + nw + ne + sw + se) / 12.0;
        let out = math::min((mean - own).abs() / range, 1.0);
        let smooth = out * out * (3.0 - 2.0 * out);
        let subpixel = smooth * smooth * SUBPIXEL;
        // Differences from row to row are those of an edge along rows.
        let bend = |a: f64, b: f64, c: f64| (a - 2.0 * b + c).abs();
        let rows = 2.0 * bend(north, own, south) + bend(nw, west, sw) + bend(ne, east, se);
        let columns = 2.0 * bend(west, own, east) + bend(nw, north, ne) + bend(sw, south, se);
        let is_along_rows = rows >= columns;
        let (before, after) = if is_along_rows { (north, south) } else { (west, east) };
        let [to_before, to_after] = [before - own, after - own].map(f64::abs);
        let sign = if to_before >= to_after { -1 } else { 1 };
        let (neighbour, gradient) = if sign < 0 { (before, to_before) } else { (after, to_after) };
        let across = if is_along_rows { [0, sign] } else { [sign, 0] };
        let edge = Edge {
            picture: self,
            at,
            across,
            along: if is_along_rows { [1, 0] } else { [0, 1] },
            luma: (own + neighbour) / 2.0,
            enough: gradient / 4.0,
        };
        let by = math::max(edge.shift(own), subpixel);
        self.mixed(at, across, by)
    }
}

/// An edge between a pixel and its neighbour across it.
struct Edge<'p> {
    picture: &'p Picture,
    at: [usize; 2],
    across: [isize; 2],
    along: [isize; 2],
    /// Its luma beside the pixel.
    luma: f64,
    /// A luma that differs by this from it ends it.
    enough: f64,
}

impl Edge<'_> {
    /// By how much the edge's luma differs `distance` pixels along it.
    fn difference(&self, distance: f64) -> f64 {
        let on_edge = |step: isize| {
            let [dx, dy] = self.along.map(|along| along * step);
            let (own, other) = (
                self.picture.at(self.at, [dx, dy]),
                self.picture.at(self.at, [dx + self.across[0], dy + self.across[1]]),
            );
            (own.luma + other.luma) / 2.0
        };
        let (whole, rest) = (distance.floor(), distance - distance.floor());
        let step = whole as isize;
        on_edge(step) * (1.0 - rest) + (if rest > 0.0 { on_edge(step + 1) * rest } else { 0.0 }) - self.luma
    }

    /// The distance of the edge's end in a direction, and the difference there.
    fn end(&self, direction: f64) -> (f64, f64) {
        let mut distance = 0.0;
        let mut difference = 0.0;
        for step in STEPS {
            distance += step;
            difference = self.difference(direction * distance);
            if difference.abs() >= self.enough {
                break;
            }
        }
        (distance, difference)
    }

    /// How much of the neighbour across the edge belongs to the pixel.
    fn shift(&self, own: f64) -> f64 {
        let (back, on) = (self.end(-1.0), self.end(1.0));
        let (nearest, difference) = if back.0 < on.0 { back } else { on };
        // Only at the end where the edge steps to the pixel's own side.
        let is_darker = own < self.luma;
        if (difference < 0.0) == is_darker { 0.0 } else { 0.5 - nearest / (back.0 + on.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(rows: &[&str]) -> Picture {
        let colors = rows.iter().flat_map(|row| row.bytes().map(|b| [f64::from(b - b'0') / 9.0; 3]));
        let colors: Vec<_> = colors.map(|[r, g, b]| [r, g, b, 1.0]).collect();
        Picture::new([rows[0].len(), rows.len()], &colors)
    }

    fn smoothed(picture: &Picture) -> Vec<String> {
        let digit = |x, y| char::from(b'0' + (picture.smoothed([x, y])[0] * 9.0 + 0.5) as u8);
        let [width, height] = picture.size;
        (0..height).map(|y| (0..width).map(|x| digit(x, y)).collect()).collect()
    }

    #[test]
    fn what_has_no_edge_stays_as_it_is() {
        let flat = picture(&["4444", "4444", "4444"]);
        assert_eq!(smoothed(&flat), ["4444", "4444", "4444"]);
        let straight = picture(&["000000", "000000", "999999", "999999"]);
        assert_eq!(smoothed(&straight)[1][1..5], *"0000");
    }

    #[test]
    fn a_step_of_an_edge_becomes_a_ramp() {
        let step = picture(&["0000000000", "0000000000", "0000099999", "9999999999", "9999999999"]);
        let rows = smoothed(&step);
        let ramp: Vec<u8> = rows[2].bytes().collect();
        assert!(ramp.is_sorted(), "{rows:?}");
        assert!(ramp[4] > b'0' && ramp[5] < b'9', "{rows:?}");
    }

    #[test]
    fn a_pixel_that_stands_out_is_lessened() {
        let dot = picture(&["00000", "00000", "00900", "00000", "00000"]);
        assert!(smoothed(&dot)[2].as_bytes()[2] < b'9');
    }

    #[test]
    fn clear_pixels_have_no_colour_to_give() {
        let colors = [[0.0, 0.0, 0.0, 0.0], [1.0, 1.0, 1.0, 1.0], [0.5, 0.5, 0.5, 0.0], [1.0, 1.0, 1.0, 1.0]];
        let picture = Picture::new([2, 2], &colors);
        for at in [[0, 0], [1, 0], [0, 1], [1, 1]] {
            let [r, .., a] = picture.smoothed(at);
            assert!(a == 0.0 || (r - 1.0).abs() < 1e-12, "white, more or less: {r} {a}");
        }
    }

    fn value(picture: &Picture, at: [usize; 2]) -> f64 {
        picture.smoothed(at)[0]
    }

    fn assert_near(found: f64, right: f64, what: &str) {
        assert!((found - right).abs() < 1e-12, "{what}: {found} {right}");
    }

    #[test]
    fn a_ramp_is_as_steep_as_the_distances_of_its_ends_say() {
        let step = picture(&["0000000000", "0000000000", "0000099999", "9999999999", "9999999999"]);
        // Looks end 1, 2.5, 4.5, 8.5 and 20.5 pixels on: at the step, or at the last of them, as there is none.
        for (k, distance) in [(0, 1.0), (1, 2.5), (3, 4.5)] {
            let share = 0.5 - distance / (distance + 20.5);
            assert_near(value(&step, [4 - k, 2]), share, &format!("dark, {k} from the step"));
            assert_near(value(&step, [5 + k, 2]), 1.0 - share, &format!("bright, {k} from the step"));
        }
        // A step half as high is one: a quarter of the difference across the edge is enough.
        let low = picture(&["0000000000", "0000000000", "0000555555", "9999999999", "9999999999"]);
        assert_near(value(&low, [3, 2]), 0.5 - 1.0 / 21.5, "before a low step");
        // Beyond the step the edge turns away: (5, 1) stands out by a quarter.
        let out: f64 = 0.25;
        let smooth = out * out * (3.0 - 2.0 * out);
        assert_near(value(&step, [5, 1]), 0.75 * smooth * smooth, "above the step");
        // Beside a dot: two of twelve parts.
        let dot = picture(&["00000", "00000", "00900", "00000", "00000"]);
        let out: f64 = 1.0 / 6.0;
        let smooth = out * out * (3.0 - 2.0 * out);
        assert_near(value(&dot, [2, 1]), 0.75 * smooth * smooth, "above the dot");
        assert_near(value(&dot, [2, 2]), 0.25, "the dot");
    }

    #[test]
    fn what_differs_by_less_than_a_share_of_the_brightest_or_in_blue_alone_is_no_edge() {
        let faint = picture(&["99999", "99999", "99899", "99999", "99999"]);
        assert_eq!(smoothed(&faint)[2], "99899");
        let dot = |color: [f64; 3]| {
            let color = |k: usize| if k == 12 { color } else { [0.0; 3] };
            let colors: Vec<_> = (0..25).map(color).map(|[r, g, b]| [r, g, b, 1.0]).collect();
            Picture::new([5, 5], &colors).smoothed([2, 2])
        };
        assert_eq!(dot([0.0, 0.0, 0.5]), [0.0, 0.0, 0.5, 1.0]);
        assert_eq!([dot([0.5, 0.0, 0.0])[0], dot([0.0, 0.5, 0.0])[1]], [0.125; 2]);
    }
}
