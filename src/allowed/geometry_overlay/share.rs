//! How much of a pixel the rectangle around a segment covers (OpenGL 2.1, 3.4.2), when the segment's ends may stray.

use super::screen_line::ScreenLine;
use crate::allowed::polygon::{area_of, cut};
use crate::math;
use crate::space::Plan;
use glam::DVec2;

/// At least and at most; a line so many pixels wide.
pub(super) fn share(line: &ScreenLine, width: f64, [x, y]: [usize; 2]) -> [f64; 2] {
    let [a, b] = line.ends;
    let length = (b - a).length();
    let along = if length > 0.0 { (b - a) / length } else { DVec2::X };
    let off = std::f64::consts::SQRT_2 * line.stray;
    // Ends that stray turn the rectangle about its middle, too: its own ends the more the wider it is.
    let [by_side, by_end] = [off * (1.0 + 2.0 * off / length), off * (1.0 + width / length)];
    let area = |sign: f64| {
        let limits = [-by_end * sign, length + by_end * sign, width / 2.0 + by_side * sign];
        if limits[0] >= limits[1] || limits[2] <= 0.0 {
            return 0.0;
        }
        let corner = |dx: f64, dy: f64| Plan::new(x as f64 + dx, y as f64 + dy) - a;
        let mut polygon = vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
        let across = along.perp();
        for (normal, limit) in
            [(-along, -limits[0]), (along, limits[1]), (across, limits[2]), (-across, limits[2])]
        {
            polygon = cut(&polygon, |p| limit - p.dot(normal));
        }
        math::min(area_of(&polygon), 1.0)
    };
    // A segment whose ends may lie on one another may have any direction.
    let least = if length > 8.0 * off { area(-1.0) } else { 0.0 };
    let most = if length > 8.0 * off { area(1.0) } else { around(line, width, off, [x, y]) };
    [math::max(least - ROUNDING, 0.0), math::min(most + ROUNDING, 1.0)]
}

/// Far more than what adding up the areas of a pixel may be off.
const ROUNDING: f64 = 1e-6;

/// At most what a very short segment covers: as much as its rectangle has, where that may be.
fn around(line: &ScreenLine, width: f64, off: f64, [x, y]: [usize; 2]) -> f64 {
    let [a, b] = line.ends;
    let middle = a + (b - a) * 0.5;
    let reach = width / 2.0 + off + (b - a).length();
    let near = |from: f64, at: f64| from - reach <= at && at <= from + 1.0 + reach;
    let all = width * ((b - a).length() + 2.0 * off);
    if near(x as f64, middle.x) && near(y as f64, middle.y) { math::min(all, 1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_lies_within_what_straying_ends_leave() {
        let line = ScreenLine::of_ends([Plan::new(-3.0, 0.5), Plan::new(0.5, 0.5)], 0.001);
        let [least, most] = share(&line, 1.0, [0, 0]);
        assert!(least < 0.5 && least > 0.49 && most > 0.5 && most < 0.51, "{least} {most}");
        assert!(share(&line, 1.0, [3, 5])[1] < 1e-5);
        let dot = ScreenLine::of_ends([Plan::new(0.5, 0.5), Plan::new(0.501, 0.5)], 0.01);
        let [least, most] = share(&dot, 1.0, [0, 0]);
        assert!(least == 0.0 && most > 0.001 && most < 0.2, "{most}");
    }
}
