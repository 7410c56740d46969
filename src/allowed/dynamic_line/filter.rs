//! FXAA over pixels of which some may have one of several colours (Lottes 2009; Zechmeister 2020, 3.5, 4.5; `docs/semantics.md`).
//!
//! Input: of each pixel the colours that it may have. Output: the colours that the filter may give it: the filter is run for each combination of those that it reads,
//! and both ways where rounding may turn a comparison. Refuses: nothing; of too many combinations only a range is told.
//!
//! The filter: an edge is where the luma of a pixel and its four neighbours differs by a sixth of the largest, and a twelfth at least; it runs along rows or columns,
//! whichever differs less; its ends are looked for 1, 2.5, 4.5, 8.5 and 20.5 pixels away; the nearer end tells how much of the neighbour across the edge is
//! mixed in; a pixel that stands out from the eight around it is mixed with that neighbour, too, by three quarters at most.

use crate::math;

/// The share of the largest luma, and the luma, by which pixels differ across an edge.
const EDGE: [f64; 2] = [0.166, 0.0833];
/// How much of a neighbour a pixel that stands out takes at most.
const SUBPIXEL: f64 = 0.75;
/// Where an edge's ends are looked for, pixels away.
const LOOKS: [f64; 5] = [1.0, 2.5, 4.5, 8.5, 20.5];
/// What rounding in single precision may do to a comparison of lumas.
const TIE: f64 = 4e-6;
/// More combinations are not tried.
const MOST_RUNS: usize = 192;

/// An encoded colour, premultiplied.
pub(super) type Premultiplied = [f64; 4];

/// The colours that a pixel may have.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Candidates {
    /// One of these, those with the fewest items first.
    Each(Vec<Premultiplied>),
    /// Any between two.
    Between([Premultiplied; 2]),
}

/// How near to halfway between two codes a colour may be rounded to either, codes.
const HALFWAY: f64 = 1e-3;

impl Candidates {
    /// The same from a target of 8 bits.
    pub(super) fn rounded(self) -> Self {
        let all = match self {
            Self::Each(all) => all,
            Self::Between([low, high]) => {
                let code = |v: f64, by: f64| (v * 255.0 + by).floor() / 255.0;
                return Self::Between([
                    low.map(|v| code(v, 0.5 - HALFWAY)),
                    high.map(|v| code(v, 0.5 + HALFWAY)),
                ]);
            }
        };
        let mut rounded: Vec<Premultiplied> = Vec::with_capacity(all.len());
        for color in all {
            let either = [-HALFWAY, HALFWAY].map(|by| color.map(|v| (v * 255.0 + 0.5 + by).floor() / 255.0));
            for color in either {
                if !rounded.contains(&color) {
                    rounded.push(color);
                }
            }
        }
        Self::Each(rounded)
    }
}

/// What the filter may make of a pixel.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Filtered {
    /// One of these colours: that of the first candidates of all pixels first, and that of the last ones last. How much of a neighbour is mixed in is
    /// not the same on all machines: with each, what its rounding may do.
    Each(Vec<(Premultiplied, f64)>),
    /// Any between two.
    Between([Premultiplied; 2]),
}

/// The pixels of a picture and what each may be.
#[derive(Debug)]
pub(super) struct Picture {
    pub(super) size: [usize; 2],
    pub(super) pixels: Vec<Candidates>,
    /// How much a machine's share of a neighbour may be off: half a step of its texture filter's weights.
    pub(super) weight: f64,
}

/// Decisions of one run, in the order in which they are asked for.
#[derive(Debug, Default)]
struct Way {
    /// What was picked, and of how many.
    picked: Vec<(usize, usize)>,
    next: usize,
    /// Which candidate each open pixel that was read has.
    of_pixels: Vec<(usize, usize)>,
    /// Whether new decisions take the last answer rather than the first.
    takes_last: bool,
}

impl Way {
    fn pick(&mut self, of: usize) -> usize {
        if self.next == self.picked.len() {
            self.picked.push((if self.takes_last { of - 1 } else { 0 }, of));
        }
        self.next += 1;
        self.picked[self.next - 1].0
    }

    /// Goes on to the next row of decisions; false where there is none.
    fn advance(&mut self) -> bool {
        (self.next, self.takes_last) = (0, false);
        self.of_pixels.clear();
        while let Some((picked, of)) = self.picked.pop() {
            if picked + 1 < of {
                self.picked.push((picked + 1, of));
                return true;
            }
        }
        false
    }

    /// Whether a >= b; both answers where rounding may turn it.
    fn is_at_least(&mut self, a: f64, b: f64) -> bool {
        if (a - b).abs() > TIE { a > b } else { self.pick(2) == 0 }
    }
}

/// A pixel may have any colour of a range: the filter cannot be run.
struct Unknown;

impl Picture {
    fn index(&self, [x, y]: [usize; 2], [dx, dy]: [isize; 2]) -> usize {
        // Beyond the picture its border goes on.
        let place = |at: usize, by: isize, size: usize| at.saturating_add_signed(by).min(size - 1);
        place(y, dy, self.size[1]) * self.size[0] + place(x, dx, self.size[0])
    }

    fn color(&self, way: &mut Way, at: usize) -> Result<Premultiplied, Unknown> {
        match &self.pixels[at] {
            Candidates::Between(_) => Err(Unknown),
            Candidates::Each(all) => match &all[..] {
                [only] => Ok(*only),
                all => {
                    let known =
                        way.of_pixels.iter().find(|(pixel, _)| *pixel == at).map(|(_, picked)| *picked);
                    let picked = known.unwrap_or_else(|| {
                        let picked = way.pick(all.len());
                        way.of_pixels.push((at, picked));
                        picked
                    });
                    Ok(all[picked])
                }
            },
        }
    }

    /// What the filter may make of a pixel.
    pub(super) fn filtered(&self, at: [usize; 2]) -> Filtered {
        let mut found: Vec<(Premultiplied, f64)> = Vec::new();
        let mut way = Way::default();
        for _ in 0..MOST_RUNS {
            let Ok(color) = self.run(&mut way, at) else { return self.around(at) };
            if !found.contains(&color) {
                found.push(color);
            }
            if !way.advance() {
                if found.len() > 1 {
                    let Ok(last) = self.run(&mut Way { takes_last: true, ..Way::default() }, at) else {
                        return self.around(at);
                    };
                    found.retain(|color| *color != last);
                    found.push(last);
                }
                return Filtered::Each(found);
            }
        }
        self.around(at)
    }

    /// Around all that the filter can make of a pixel: at most three quarters of one of its four neighbours.
    fn around(&self, at: [usize; 2]) -> Filtered {
        let range = |by: [isize; 2]| match &self.pixels[self.index(at, by)] {
            Candidates::Between(range) => *range,
            Candidates::Each(all) => all.iter().fold([all[0]; 2], |[low, high], color| {
                [0, 1].map(|end| {
                    std::array::from_fn(|c| match end {
                        0 => math::min(low[c], color[c]),
                        _ => math::max(high[c], color[c]),
                    })
                })
            }),
        };
        let own = range([0, 0]);
        let mut all = own;
        for other in [[0, -1], [0, 1], [-1, 0], [1, 0]].map(range) {
            for c in 0..4 {
                let mixed =
                    |end: usize| own[end][c] + (other[end][c] - own[end][c]) * (SUBPIXEL + self.weight);
                all[0][c] = math::min(all[0][c], mixed(0));
                all[1][c] = math::max(all[1][c], mixed(1));
            }
        }
        Filtered::Between(all)
    }

    /// The filter with one row of decisions: a colour, and what a machine's weights may do to it.
    fn run(&self, way: &mut Way, at: [usize; 2]) -> Result<(Premultiplied, f64), Unknown> {
        let own_color = self.color(way, self.index(at, [0, 0]))?;
        let own = luma(&own_color);
        let mut read =
            |by: [isize; 2]| -> Result<f64, Unknown> { Ok(luma(&self.color(way, self.index(at, by))?)) };
        let cross = [read([0, -1])?, read([0, 1])?, read([-1, 0])?, read([1, 0])?];
        let most = cross.iter().fold(own, |most, l| math::max(*l, most));
        let least = cross.iter().fold(own, |least, l| math::min(*l, least));
        let range = most - least;
        if !way.is_at_least(range, math::max(EDGE[1], EDGE[0] * most)) {
            return Ok((own_color, 0.0));
        }
        let mut read =
            |by: [isize; 2]| -> Result<f64, Unknown> { Ok(luma(&self.color(way, self.index(at, by))?)) };
        let [nw, ne, sw, se] = [read([-1, -1])?, read([1, -1])?, read([-1, 1])?, read([1, 1])?];
        let [north, south, west, east] = cross;
        let mean = (2.0 * (north + south + west + east) + nw + ne + sw + se) / 12.0;
        let out = math::min((mean - own).abs() / range, 1.0);
        let smooth = out * out * (3.0 - 2.0 * out);
        let bend = |a: f64, b: f64, c: f64| (a - 2.0 * b + c).abs();
        let rows = [2.0 * bend(north, own, south), bend(nw, west, sw), bend(ne, east, se)];
        let columns = [2.0 * bend(west, own, east), bend(nw, north, ne), bend(sw, south, se)];
        let sum = |of: [f64; 3]| of[0] + of[1] + of[2];
        // Of the same numbers every machine makes the same.
        let is_along_rows = rows == columns || way.is_at_least(sum(rows), sum(columns));
        let (before, after) = if is_along_rows { (north, south) } else { (west, east) };
        let [to_before, to_after] = [before - own, after - own].map(f64::abs);
        let is_before = before == after || way.is_at_least(to_before, to_after);
        let (neighbour, gradient, sign) =
            if is_before { (before, to_before, -1) } else { (after, to_after, 1) };
        let [across, along] = if is_along_rows { [[0, sign], [1, 0]] } else { [[sign, 0], [0, 1]] };
        let edge = Edge { at, across, along, luma: (own + neighbour) / 2.0, enough: gradient / 4.0 };
        let [back, on] = [self.end(way, &edge, -1.0)?, self.end(way, &edge, 1.0)?];
        let (nearest, difference) = if back.0 < on.0 { back } else { on };
        let of_edge = match 0.5 - nearest / (back.0 + on.0) {
            share if share <= 0.0 => 0.0,
            // Only at the end where the edge steps to the pixel's own side.
            share => {
                let is_darker = own < edge.luma;
                let is_below = !way.is_at_least(difference, 0.0);
                if is_below == is_darker { 0.0 } else { share }
            }
        };
        let by = math::max(of_edge, smooth * smooth * SUBPIXEL);
        let other = self.color(way, self.index(at, across))?;
        let widest = (0..4).map(|c| (other[c] - own_color[c]).abs()).fold(0.0, math::max);
        Ok((std::array::from_fn(|c| own_color[c] + (other[c] - own_color[c]) * by), widest * self.weight))
    }

    /// How far away an edge ends in a direction, and by how much its luma differs there.
    fn end(&self, way: &mut Way, edge: &Edge, direction: f64) -> Result<(f64, f64), Unknown> {
        let mut difference = 0.0;
        for distance in LOOKS {
            let place = direction * distance;
            let (whole, rest) = (place.floor(), place - place.floor());
            let mut value = self.on_edge(way, edge, whole as isize)? * (1.0 - rest);
            if rest > 0.0 {
                value += self.on_edge(way, edge, whole as isize + 1)? * rest;
            }
            difference = value - edge.luma;
            if way.is_at_least(difference.abs(), edge.enough) {
                return Ok((distance, difference));
            }
        }
        Ok((LOOKS[LOOKS.len() - 1], difference))
    }

    /// The luma between the two sides of an edge, so many pixels along it.
    fn on_edge(&self, way: &mut Way, edge: &Edge, step: isize) -> Result<f64, Unknown> {
        let [x, y] = edge.along.map(|along| along * step);
        let own = self.color(way, self.index(edge.at, [x, y]))?;
        let other = self.color(way, self.index(edge.at, [x + edge.across[0], y + edge.across[1]]))?;
        Ok((luma(&own) + luma(&other)) / 2.0)
    }
}

/// An edge between a pixel and a neighbour.
struct Edge {
    at: [usize; 2],
    across: [isize; 2],
    along: [isize; 2],
    luma: f64,
    /// It ends where its luma differs by this.
    enough: f64,
}

/// Rec. 601.
fn luma(color: &Premultiplied) -> f64 {
    0.299 * color[0] + 0.587 * color[1] + 0.114 * color[2]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(rows: &[&str]) -> Picture {
        let candidates = |byte: u8| {
            let gray = |digit: u8| {
                let v = f64::from(digit) / 9.0;
                [v, v, v, 1.0]
            };
            match byte {
                b'?' => Candidates::Each(vec![gray(0), gray(9)]),
                b'*' => Candidates::Between([gray(0), gray(9)]),
                digit => Candidates::Each(vec![gray(digit - b'0')]),
            }
        };
        let pixels = rows.iter().flat_map(|row| row.bytes()).map(candidates).collect();
        Picture { size: [rows[0].len(), rows.len()], pixels, weight: 0.0 }
    }

    fn reds(picture: &Picture, at: [usize; 2]) -> Vec<f64> {
        match picture.filtered(at) {
            Filtered::Each(all) => all.into_iter().map(|(color, _)| color[0]).collect(),
            Filtered::Between([low, high]) => vec![low[0], high[0]],
        }
    }

    #[test]
    fn a_ramp_is_as_steep_as_the_distances_of_its_ends_say() {
        let step = picture(&["0000000000", "0000000000", "0000099999", "9999999999", "9999999999"]);
        let share = 0.5 - 1.0 / 21.5;
        assert!((reds(&step, [4, 2])[0] - share).abs() < 1e-12);
        assert!((reds(&step, [5, 2])[0] - (1.0 - share)).abs() < 1e-12);
        assert_eq!(reds(&step, [4, 0]), [0.0]);
    }

    #[test]
    fn an_open_pixel_is_tried_both_ways_and_one_of_any_colour_leaves_a_range() {
        let known = ["0000000000", "0000000000", "0000099999", "9999999999", "9999999999"];
        let with = |byte: &str| {
            let open = format!("0000{byte}99999");
            picture(&[known[0], known[1], &open, known[3], known[4]])
        };
        let found = reds(&with("?"), [4, 2]);
        let expected = ["0", "9"].map(|byte| reds(&with(byte), [4, 2])[0]);
        assert_eq!((found[0], found[found.len() - 1]), (expected[0], expected[1]));
        let found = reds(&with("*"), [4, 2]);
        assert!(found[0] == 0.0 && (found[1] - 1.0).abs() < 1e-12);
    }

    #[test]
    fn where_rounding_may_turn_a_comparison_both_answers_are_there() {
        // Two and a half pixels on the mean of both columns is just as far from the edge's as ends it.
        let tie = picture(&["0000000000", "0000000000", "0000099999", "9999999999", "9999999999"]);
        let found = reds(&tie, [2, 2]);
        assert!(found.len() == 2, "{found:?}");
    }
}
