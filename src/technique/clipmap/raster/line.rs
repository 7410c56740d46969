//! Line primitives, as a graphics pipeline draws them (solution 1; sections 3 and 4.1).

use super::mask::Mask;
use super::prefilter::Table;
use crate::space::Texel;

/// A segment in a tile's own texels: (0, 0) is the tile's north-west corner.
///
/// Differences of a segment's ends do not depend on the tile, so neither do intensities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Segment {
    /// Where it starts.
    pub(super) from: Texel,
    /// Where it ends.
    pub(super) to: Texel,
    /// The tile's first texel.
    pub(super) origin: (i64, i64),
}

/// Draws OpenGL's wide lines without anti-aliasing: the width, rounded to whole texels, is measured along the minor axis, and a line
/// that runs along x covers a texel when its centre's x is from the start to before the end.
pub(super) fn plain(segment: &Segment, width: f64, mask: &mut Mask) {
    let Segment { from, to, origin } = *segment;
    let d = to - from;
    let is_flat = d.x.abs() >= d.y.abs();
    // Along the major axis and along the minor one.
    let split = |p: Texel| if is_flat { (p.x, p.y) } else { (p.y, p.x) };
    let ((a, minor), (b, _)) = (split(from), split(to));
    if a == b {
        return;
    }
    let slope = if is_flat { d.y / d.x } else { d.x / d.y };
    let wide = (width + 0.5).floor().clamp(1.0, 1e6);
    let (width, height) = mask.size();
    let ((major_origin, minor_origin), (major_size, minor_size)) = match is_flat {
        true => (origin, (width, height)),
        false => ((origin.1, origin.0), (height, width)),
    };
    // Centres from the start on, without the end.
    let within = |v: f64| (v - major_origin as f64 - 0.5).clamp(-1.0, major_size as f64 + 1.0);
    let (first, end) = if a < b {
        (within(a).ceil(), within(b).ceil())
    } else {
        (within(b).floor() + 1.0, within(a).floor() + 1.0)
    };
    for k in (first as i64).max(0)..(end as i64).min(major_size as i64) {
        let at = major_origin as f64 + k as f64 + 0.5;
        let middle = minor + (at - a) * slope;
        let start = (middle - 0.5 * (wide - 1.0)).floor() - minor_origin as f64;
        let start = start.clamp(-1e7, 1e7) as i64;
        for n in start.max(0)..(start + wide as i64).min(minor_size as i64) {
            let (column, row) = if is_flat { (k as usize, n as usize) } else { (n as usize, k as usize) };
            mask.raise(column, row, 1.0);
        }
    }
}

/// Draws a prefiltered line: a texel's intensity depends on its centre's distances from the line and from its ends.
pub(super) fn prefiltered(segment: &Segment, table: &Table, mask: &mut Mask) {
    let Segment { from, to, origin } = *segment;
    let d = to - from;
    let length = d.length();
    if length <= 0.0 {
        return;
    }
    let along = d / length;
    let (width, height) = mask.size();
    let reach = table.reach();
    let rows = {
        let grown = reach + table.radius();
        let low = crate::math::min(from.y, to.y) - grown - origin.1 as f64;
        let high = crate::math::max(from.y, to.y) + grown - origin.1 as f64;
        low.clamp(0.0, height as f64) as usize..high.ceil().clamp(0.0, height as f64) as usize
    };
    for row in rows {
        let y = origin.1 as f64 + row as f64 + 0.5;
        let Some((west, east)) = columns_near(from, to, along, y, reach, table.radius()) else { continue };
        let column = |x: f64| (x - origin.0 as f64).clamp(0.0, width as f64);
        for k in column(west) as usize..column(east).ceil() as usize {
            let x = origin.0 as f64 + k as f64 + 0.5;
            let p = Texel::new(x, y) - from;
            let start = p.dot(along);
            mask.raise(k, row, table.intensity(along.perp_dot(p), start, length - start));
        }
    }
}

/// Between which x a height meets the rectangle around a line that its intensity reaches.
fn columns_near(
    from: Texel,
    to: Texel,
    along: glam::DVec2,
    y: f64,
    across_reach: f64,
    end_reach: f64,
) -> Option<(f64, f64)> {
    let length = (to - from).length();
    let (mut west, mut east) = (f64::NEG_INFINITY, f64::INFINITY);
    // low <= (x - from.x) * a + c <= high for both axes of the rectangle.
    let mut narrow = |a: f64, c: f64, low: f64, high: f64| {
        if a.abs() < 1e-12 {
            return c >= low && c <= high;
        }
        let (p, q) = ((low - c) / a, (high - c) / a);
        let (p, q) = if p < q { (p, q) } else { (q, p) };
        west = crate::math::max(from.x + p, west);
        east = crate::math::min(from.x + q, east);
        true
    };
    let dy = y - from.y;
    let meets = narrow(along.x, along.y * dy, -end_reach, length + end_reach)
        && narrow(-along.y, along.x * dy, -across_reach, across_reach);
    (meets && west <= east).then_some((west, east))
}
