//! Which fragments of a stippled line are drawn, as far as that is known (OpenGL 2.1, 3.4.2).

use super::diamond::{Crossing, Diamond, often};
use super::screen_line::ScreenLine;
use crate::certainty::Known;
use crate::space::Plan;
use crate::technique::geometry_overlay::Settings;

/// Where the fragments of a segment are counted from, and by how much the counter grows over it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Count {
    is_steep: bool,
    direction: i64,
    /// The first fragment's column (of a steep segment its row): between two.
    first: [i64; 2],
    /// The counter at the start: between two.
    start: [i64; 2],
    /// How many fragments there are from the first one to the last one: between two.
    steps: [i64; 2],
    /// Which axis is the major one is not known, or which columns are: the counter may be off by one.
    is_doubtful: bool,
}

/// A stipple's pattern repeats after so many bits.
const BITS: i64 = 16;

impl Count {
    /// That of a segment so many pixels wide (one of two numbers) with the counter at its start.
    pub(super) fn new(line: &ScreenLine, widths: [u32; 2], start: [i64; 2]) -> Self {
        let [a, b] = line.ends;
        let (x, y) = ((b.x - a.x).abs(), (b.y - a.y).abs());
        let is_steep = y > x;
        let major = |p: Plan| if is_steep { p.y } else { p.x };
        let direction = if major(b) > major(a) { 1 } else { -1 };
        // The copies of a wide line have the same columns; those of an even number of pixels lie between rows.
        let diamond = Diamond { is_steep, across: i32::from(widths[0].is_multiple_of(2)) };
        let is_left = |column: i64, end: Plan| -> Known {
            let share = (column as f64 + 0.5 - major(a)) / (major(b) - major(a));
            let minor = |p: Plan| if is_steep { p.x } else { p.y };
            let at = if share.is_finite() { minor(a) + (minor(b) - minor(a)) * share } else { minor(end) };
            let range = |row: i64| -> [u32; 2] {
                let [along, across] = [column as f64 + 0.5, row as f64 + 0.5];
                let pixel = if is_steep { Plan::new(across, along) } else { Plan::new(along, across) };
                let crossing = Crossing::new(line, pixel, diamond);
                crossing.map_or([0; 2], |crossing| often(&[crossing]))
            };
            let row = at.floor() as i64;
            let all = (row - 1..=row + 1).map(range).fold([0; 2], |sum, of| [sum[0] + of[0], sum[1] + of[1]]);
            match all {
                [least, _] if least > 0 => Known::In,
                [_, 0] => Known::Out,
                _ => Known::Open,
            }
        };
        let ends = [a, b].map(|p| major(p).floor() as i64);
        let scan = |from: i64, to: i64, step: i64, end: Plan| -> [i64; 2] {
            let mut column = from;
            let mut may_be = None;
            loop {
                match is_left(column, end) {
                    Known::In => return [may_be.unwrap_or(column), column],
                    Known::Open => may_be = may_be.or(Some(column)),
                    Known::Out => {}
                }
                if column == to {
                    return [may_be.unwrap_or(to + step), to + step];
                }
                column += step;
            }
        };
        let first = scan(ends[0] - direction, ends[1] + direction, direction, a);
        let last = scan(ends[1] + direction, ends[0] - direction, -direction, b);
        let steps =
            [((last[1] - first[1]) * direction + 1).max(0), ((last[0] - first[0]) * direction + 1).max(0)];
        Self {
            is_steep,
            direction,
            first,
            start,
            steps,
            is_doubtful: (x - y).abs() <= 4.0 * line.stray || widths[0] != widths[1],
        }
    }

    /// The counter at its end: what is not known adds up along a primitive.
    pub(super) fn end(&self) -> [i64; 2] {
        [self.start[0] + self.steps[0], self.start[1] + self.steps[1]]
    }

    /// Whether its fragment at a pixel is drawn.
    pub(super) fn is_on(&self, [x, y]: [usize; 2], settings: &Settings) -> Known {
        let column = if self.is_steep { y as i64 } else { x as i64 };
        let steps = self.first.map(|first| (column - first) * self.direction);
        let slack = i64::from(self.is_doubtful);
        let low = self.start[0] + steps[1].min(steps[0]) - slack;
        let high = self.start[1] + steps[0].max(steps[1]) + slack;
        let factor = i64::from(settings.stipple_factor.clamp(1, 256));
        if high - low >= BITS * factor {
            return if settings.stipple & 0xffff == 0 { Known::Out } else { Known::Open };
        }
        let is_on = |counter: i64| settings.stipple >> (counter.div_euclid(factor).rem_euclid(BITS)) & 1 == 1;
        let all = (low..=high).map(|counter| Known::of(is_on(counter)));
        all.reduce(|a, b| if a == b { a } else { Known::Open }).unwrap_or(Known::Open)
    }
}
