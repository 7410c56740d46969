//! Which pixels aliased lines have fragments in, as far as that is known (OpenGL 2.1, 3.4.1): those whose diamonds the line leaves.
//!
//! Input: segments whose ends may stray. Output: for a pixel how often the segments of a strip are drawn there. Where two segments meet near a diamond's
//! border, it is not known which of them leaves the diamond, but that one does. Refuses: nothing.
//!
//! A wide line is drawn as many times as it is wide, each a pixel farther across its major axis: a pixel has a fragment where one of as many diamonds is left.

use super::screen_line::ScreenLine;
use crate::certainty::Known;
use crate::math;
use crate::space::Plan;

/// Which of a wide line's diamonds: whether lines of its kind are steep, and where the diamond's centre is from the pixel's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Diamond {
    pub(super) is_steep: bool,
    /// Halves of pixels across the major axis.
    pub(super) across: i32,
}

/// What a segment does in a diamond.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Crossing {
    /// Whether the start and the end lie in it.
    ends: [Known; 2],
    /// Whether some of the segment lies in it; that of an end where it comes nearest there.
    meets: Meets,
    /// Whether its fragment is drawn for other reasons, and whether it is of this kind of diamonds.
    pub(super) is_drawn: Known,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Meets {
    Known(Known),
    AsEnd(usize),
}

/// The diamonds whose leaving draws a pixel, by a line so many pixels wide.
pub(super) fn diamonds(line: &ScreenLine, width: u32) -> Vec<(Diamond, Known)> {
    let along = line.ends[1] - line.ends[0];
    let (x, y) = (along.x.abs(), along.y.abs());
    let of = |is_steep: bool, known: Known| {
        (0..width as i32).map(move |k| (Diamond { is_steep, across: 2 * k - (width as i32 - 1) }, known))
    };
    if width == 1 {
        return of(false, Known::In).collect();
    }
    match () {
        () if (x - y).abs() <= 4.0 * line.stray => {
            of(false, Known::Open).chain(of(true, Known::Open)).collect()
        }
        () => of(y > x, Known::In).collect(),
    }
}

impl Crossing {
    /// What a segment does in a diamond of a pixel; `None`: it does not come near.
    pub(super) fn new(line: &ScreenLine, pixel: Plan, diamond: Diamond) -> Option<Self> {
        let across = f64::from(diamond.across) / 2.0;
        let centre = match diamond.is_steep {
            true => Plan::new(pixel.x + across, pixel.y),
            false => Plan::new(pixel.x, pixel.y + across),
        };
        let doubt = 2.0 * line.stray;
        let reach = |p: Plan| (p.x - centre.x).abs() + (p.y - centre.y).abs();
        let known = |reach: f64| match () {
            () if reach < 0.5 - doubt => Known::In,
            () if reach > 0.5 + doubt => Known::Out,
            () => Known::Open,
        };
        let [a, b] = line.ends;
        // The distance is convex along the segment, and bends where a coordinate is the centre's.
        let bends = [(a.x - centre.x, b.x - centre.x), (a.y - centre.y, b.y - centre.y)];
        let shares = bends
            .into_iter()
            .map(|(from, to)| from / (from - to))
            .filter(|share| (0.0..=1.0).contains(share));
        let between: Vec<f64> = shares.map(|share| reach(a + (b - a) * share)).collect();
        let ends = [reach(a), reach(b)];
        let least = between.iter().copied().fold(math::min(ends[0], ends[1]), math::min);
        if known(least) == Known::Out {
            return None;
        }
        let nearest = usize::from(ends[1] < ends[0]);
        let meets_at_end = least == ends[nearest] && {
            // Whatever the ends' straying, the segment leaves that end away from the diamond, and does not pass a bend first.
            let (p, away) = (line.ends[nearest] - centre, line.ends[1 - nearest] - line.ends[nearest]);
            let growth = away.x * p.x.signum() + away.y * p.y.signum();
            growth > 2.0 * doubt && p.x.abs() > doubt && p.y.abs() > doubt
        };
        let meets = match known(least) {
            Known::Open if meets_at_end => Meets::AsEnd(nearest),
            of => Meets::Known(of),
        };
        Some(Self { ends: ends.map(known), meets, is_drawn: Known::In })
    }

    /// The same, drawn as far as it is known for other reasons.
    pub(super) fn drawn(self, is_drawn: Known) -> Self {
        Self { is_drawn, ..self }
    }
}

/// More open answers are not tried one by one.
const MOST_OPEN: usize = 8;

/// How often segments that follow one another, each from where the one before ends, are drawn at a pixel: at least, at most.
pub(super) fn often(run: &[Crossing]) -> [u32; 2] {
    // Open answers: those of the run's vertices, and two of each segment.
    let count = run.len();
    let vertex = |k: usize| if k < count { run[k].ends[0] } else { run[count - 1].ends[1] };
    let mut open: Vec<(usize, usize)> =
        (0..=count).filter(|k| vertex(*k) == Known::Open).map(|k| (0, k)).collect();
    open.extend((0..count).filter(|k| run[*k].meets == Meets::Known(Known::Open)).map(|k| (1, k)));
    open.extend((0..count).filter(|k| run[*k].is_drawn == Known::Open).map(|k| (2, k)));
    if open.len() > MOST_OPEN {
        return run.iter().map(often_alone).fold([0; 2], |sum, of| [sum[0] + of[0], sum[1] + of[1]]);
    }
    let mut range = [u32::MAX, 0];
    for answers in 0..1u32 << open.len() {
        let is_in = |known: Known, question: (usize, usize)| match known {
            Known::Open => {
                open.iter().position(|of| *of == question).is_some_and(|bit| answers >> bit & 1 == 1)
            }
            known => known == Known::In,
        };
        let drawn = (0..count).filter(|&k| {
            let ends = [k, k + 1].map(|k| is_in(vertex(k), (0, k)));
            let meets = match run[k].meets {
                Meets::AsEnd(end) => ends[end],
                Meets::Known(known) => ends[0] || is_in(known, (1, k)),
            };
            !ends[1] && meets && is_in(run[k].is_drawn, (2, k))
        });
        let drawn = drawn.count() as u32;
        range = [range[0].min(drawn), range[1].max(drawn)];
    }
    range
}

fn often_alone(one: &Crossing) -> [u32; 2] {
    let meets = match one.meets {
        Meets::AsEnd(_) => Known::Open,
        Meets::Known(known) => known,
    };
    let known = (!one.ends[1]).and(meets.or(one.ends[0])).and(one.is_drawn);
    [u32::from(known == Known::In), u32::from(known != Known::Out)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crossing(from: (f64, f64), to: (f64, f64)) -> Option<Crossing> {
        let line = ScreenLine::of_ends([from, to].map(|(x, y)| Plan::new(x, y)), 0.01);
        Crossing::new(&line, Plan::new(0.5, 0.5), Diamond { is_steep: false, across: 0 })
    }

    #[test]
    fn a_diamond_that_is_left_is_drawn_and_one_in_which_a_line_ends_is_not() {
        let often = |from, to| crossing(from, to).map(|crossing| often(&[crossing]));
        assert_eq!(often((-2.0, 0.4), (3.0, 0.6)), Some([1, 1]));
        assert_eq!(often((-2.0, 0.4), (0.5, 0.5)), Some([0, 0]));
        assert_eq!(often((0.5, 0.5), (3.0, 0.5)), Some([1, 1]));
        assert_eq!(often((-2.0, 0.4), (1.005, 0.495)), Some([0, 1]));
        assert_eq!(often((-2.0, 1.4), (3.0, 1.6)), None);
        assert_eq!(often((0.0, -0.5), (1.5, 1.0)), Some([0, 1]), "past the tip of two sides");
    }

    #[test]
    fn one_of_two_segments_that_meet_on_a_border_leaves_the_diamond() {
        let at = (0.75, 0.745);
        let run = [crossing((0.1, 0.5), at).unwrap(), crossing(at, (2.0, 1.3)).unwrap()];
        assert_eq!([often(&run[..1]), often(&run[1..])], [[0, 1]; 2]);
        assert_eq!(often(&run), [1, 1]);
        let hidden = run.map(|one| Crossing { is_drawn: Known::Open, ..one });
        assert_eq!(often(&hidden), [0, 1]);
    }

    #[test]
    fn a_wide_line_has_a_diamond_for_each_pixel_of_its_width() {
        let line = |to: (f64, f64)| ScreenLine::of_ends([Plan::default(), Plan::new(to.0, to.1)], 0.01);
        let of = |to, width| {
            diamonds(&line(to), width).iter().map(|(d, _)| (d.is_steep, d.across)).collect::<Vec<_>>()
        };
        assert_eq!(of((9.0, 2.0), 1), [(false, 0)]);
        assert_eq!(of((9.0, 2.0), 3), [(false, -2), (false, 0), (false, 2)]);
        assert_eq!(of((2.0, 9.0), 2), [(true, -1), (true, 1)]);
        assert_eq!(of((9.0, 9.0), 2).len(), 4);
    }
}
