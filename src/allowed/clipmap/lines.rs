//! Line primitives: what of a texel's share is known when a segment's ends may lie a little elsewhere.

use super::count::between;
use super::share::convex_area;
use crate::math;
use crate::space::Texel;
use crate::technique::clipmap::LineFilter;

/// What a share may be off besides: a device's area.
const AREA: f64 = 1.0 / 1024.0;

/// A segment of a width, both in texels of a tile of some texels a side.
#[derive(Debug, Clone, Copy)]
pub(super) struct Primitive {
    pub(super) segment: [Texel; 2],
    pub(super) width: f64,
    /// How far an end may lie elsewhere along each axis.
    pub(super) slack: f64,
    pub(super) size: usize,
}

impl Primitive {
    /// The rectangle around it, counter-clockwise on the map, grown by a margin on all sides; `None` where nothing is left of it.
    pub(super) fn ring(&self, margin: f64) -> Option<[Texel; 4]> {
        let [from, to] = self.segment;
        let way = to - from;
        let along = way.try_normalize()?;
        let half = 0.5 * self.width + margin;
        if half <= 0.0 || way.length() + 2.0 * margin <= 0.0 {
            return None;
        }
        let (aside, on) = (along.perp() * half, along * margin);
        let (from, to) = (from + -on, to + on);
        Some([from + aside, to + aside, to + -aside, from + -aside])
    }

    /// By how much its sides may lie elsewhere.
    fn off(&self) -> f64 {
        let [from, to] = self.segment;
        (to - from).try_normalize().map_or(0.0, |along| self.slack * (along.x.abs() + along.y.abs()))
    }

    /// Calls `visit` with each texel of which its rectangle covers something, and the share of it.
    pub(super) fn coverage(&self, visit: &mut dyn FnMut(usize, [f64; 2])) {
        let Some(outer) = self.ring(self.off()) else { return };
        let inner = self.ring(-self.off());
        let y = outer.map(|p| p.y);
        let low = y.iter().copied().fold(f64::INFINITY, math::min);
        let high = y.iter().copied().fold(f64::NEG_INFINITY, math::max);
        for row in between(low - 1.0, high, 0.0, self.size) {
            let Some((west, east)) = columns(&outer, row as f64) else { continue };
            for column in between(west - 1.0, east, 0.0, self.size) {
                let corner = [column as f64, row as f64];
                let most = math::min(convex_area(&outer, corner) + AREA, 1.0);
                let least = inner.as_ref().map_or(0.0, |ring| convex_area(ring, corner));
                // A texel that is covered by all but a hair is covered.
                let least = if least >= 1.0 - 1e-12 { 1.0 } else { math::max(least - AREA, 0.0) };
                visit(column + self.size * row, [least, most]);
            }
        }
    }

    /// Calls `visit` with each texel that a wide line without anti-aliasing covers or may cover: columns (or rows) of whole texels along its minor axis,
    /// where its start is before a texel's centre and its end not.
    pub(super) fn plain(&self, visit: &mut dyn FnMut(usize, [f64; 2])) {
        let [from, to] = self.segment;
        let way = to - from;
        let is_flat = way.x.abs() >= way.y.abs();
        let split = |p: Texel| if is_flat { (p.x, p.y) } else { (p.y, p.x) };
        let ((a, minor), (b, _)) = (split(from), split(to));
        if a == b {
            return;
        }
        let slope = if is_flat { way.y / way.x } else { way.x / way.y };
        let wide = (self.width + 0.5).floor().clamp(1.0, 1e6);
        let (low, high) = (math::min(a, b), math::max(a, b));
        let off = self.slack * (1.0 + slope.abs());
        for k in between(low - self.slack, high + self.slack, 0.5, self.size) {
            let at = k as f64 + 0.5;
            let is_sure = at - low > self.slack && high - at > self.slack;
            let start = minor + (at - a) * slope - 0.5 * (wide - 1.0);
            let (first, last) = ((start - off).floor(), (start + off).floor() + wide - 1.0);
            for n in between(first, last, 0.0, self.size) {
                // In whichever way it is rounded.
                let is_in = is_sure
                    && (start + off).floor() <= n as f64
                    && n as f64 <= (start - off).floor() + wide - 1.0;
                let texel = if is_flat { k + self.size * n } else { n + self.size * k };
                visit(texel, [f64::from(u8::from(is_in)), 1.0]);
            }
        }
    }

    /// Calls `visit` with each texel whose filter sees some of the line, and how much.
    pub(super) fn prefiltered(&self, filter: LineFilter, visit: &mut dyn FnMut(usize, [f64; 2])) {
        let [from, to] = self.segment;
        let Some(along) = (to - from).try_normalize() else { return };
        let (length, half, off) = ((to - from).length(), 0.5 * self.width, self.off());
        let reach = half + radius(filter) + off;
        let ends = radius(filter) + off;
        let (low, high) = (math::min(from.y, to.y) - reach - ends, math::max(from.y, to.y) + reach + ends);
        let Some(outer) = (Self { width: 2.0 * reach, ..*self }).ring(ends) else { return };
        let band = |across: f64| seen(filter, half + across) - seen(filter, across - half);
        for row in between(low, high, 0.5, self.size) {
            let Some((west, east)) = columns(&outer, row as f64) else { continue };
            for column in between(west - 1.0, east, 0.5, self.size) {
                let p = Texel::new(column as f64 + 0.5, row as f64 + 0.5) - from;
                let (across, start) = (along.perp_dot(p).abs(), p.dot(along));
                let part = |off: f64| {
                    let end = |at: f64| seen(filter, at + off);
                    band(math::max(across - off, 0.0)) * end(start) * end(length - start)
                };
                let (least, most) = (math::max(part(-off) - TABLE, 0.0), math::min(part(off) + TABLE, 1.0));
                if most > TABLE {
                    visit(column + self.size * row, [least, most]);
                }
            }
        }
    }
}

/// What a table of 32 entries between which one goes straight may be off.
const TABLE: f64 = 1.0 / 256.0;

/// Between which x a convex ring has points in a row of texels.
fn columns(ring: &[Texel; 4], row: f64) -> Option<(f64, f64)> {
    let edges = (0..4).map(|k| super::edges::Edge { from: ring[k], to: ring[(k + 1) % 4] });
    edges
        .filter_map(|edge| edge.columns_within(row, row + 1.0))
        .reduce(|(west, east), (a, b)| (math::min(west, a), math::max(east, b)))
}

/// How far from a texel's centre a filter reaches.
fn radius(filter: LineFilter) -> f64 {
    match filter {
        // Of a texel's area.
        LineFilter::Disc => (1.0 / std::f64::consts::PI).sqrt(),
        LineFilter::Cone => 1.0,
        LineFilter::Gaussian => 1.5,
    }
}

/// How much of a filter lies in a half plane whose border is so far beyond its centre.
fn seen(filter: LineFilter, border: f64) -> f64 {
    let radius = radius(filter);
    if border >= radius {
        return 1.0;
    }
    if border <= -radius {
        return 0.0;
    }
    match filter {
        LineFilter::Disc => {
            let share = border / radius;
            0.5 + (share * (1.0 - share * share).sqrt() + math::asin(share)) / std::f64::consts::PI
        }
        LineFilter::Cone => {
            // By the integral over slices of the cone's profile, in closed form: of 1 - r, times 3 / pi.
            let (s, root) = (border, (1.0 - border * border).sqrt());
            let cubic = if s == 0.0 { 0.0 } else { s * s * s * math::asinh(root / s.abs()) };
            0.5 + (2.0 * s * root + math::asin(s) - cubic) / std::f64::consts::PI
        }
        LineFilter::Gaussian => {
            let mass = |x: f64| math::erf(x * std::f64::consts::SQRT_2);
            0.5 + 0.5 * mass(border) / mass(radius)
        }
    }
}
