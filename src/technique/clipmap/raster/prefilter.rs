//! Intensity tables of prefiltered lines.
//!
//! McNamara, McCormack, Jouppi (2000), "Prefiltered antialiased lines using half-plane distance functions": what a filter around a
//! texel's centre sees of a half plane is a function of the distance alone, if the filter is round. Chan, Durand (2005), "Fast
//! prefiltered lines" (GPU Gems 2, 22): of a line's two sides together it is one table for a width, of 32 entries, interpolated.

use crate::math;
use crate::technique::clipmap::LineFilter;

/// Entries of a table.
const ENTRIES: usize = 32;

/// Radius of a disc with the area of a texel.
const DISC: f64 = 0.564_189_583_547_756_3;
/// Where the Gaussian is cut off, texels.
const CUT: f64 = 1.5;

/// What a filter sees of a line of a width, over the distance of its centre from the line.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Table {
    /// Distance beyond which the filter sees nothing of the line's sides.
    reach: f64,
    radius: f64,
    sides: [f32; ENTRIES + 1],
    ends: [f32; ENTRIES + 1],
}

impl Table {
    /// The table of a filter for lines of a width in texels.
    pub(super) fn new(filter: LineFilter, width: f64) -> Self {
        let half = 0.5 * width;
        let radius = radius(filter);
        let reach = half + radius;
        let share = |k: usize| k as f64 / ENTRIES as f64;
        // Both sides: what lies before the far one, less what lies before the near one.
        let side = |k: usize| {
            let at = reach * share(k);
            (half_plane(filter, half + at) - half_plane(filter, at - half)) as f32
        };
        // One end: from a radius outside to a radius inside.
        let end = |k: usize| half_plane(filter, radius * (2.0 * share(k) - 1.0)) as f32;
        Self { reach, radius, sides: std::array::from_fn(side), ends: std::array::from_fn(end) }
    }

    /// How far from a line its intensity reaches, texels.
    pub(super) fn reach(&self) -> f64 {
        self.reach
    }

    /// How far beyond a line's ends its intensity reaches, texels.
    pub(super) fn radius(&self) -> f64 {
        self.radius
    }

    /// The intensity at a distance from the line and, along it, from its start and before its end.
    #[inline]
    pub(super) fn intensity(&self, across: f64, from_start: f64, to_end: f64) -> f32 {
        let end = |along: f64| looked_up(&self.ends, 0.5 * (along / self.radius + 1.0));
        looked_up(&self.sides, across.abs() / self.reach) * end(from_start) * end(to_end)
    }
}

/// A table at a share 0..=1 of its length, clamped, between its entries linear.
fn looked_up(table: &[f32; ENTRIES + 1], share: f64) -> f32 {
    let at = share.clamp(0.0, 1.0) * ENTRIES as f64;
    let k = (at as usize).min(ENTRIES - 1);
    let t = (at - k as f64) as f32;
    table[k] * (1.0 - t) + table[k + 1] * t
}

fn radius(filter: LineFilter) -> f64 {
    match filter {
        LineFilter::Disc => DISC,
        LineFilter::Cone => 1.0,
        LineFilter::Gaussian => CUT,
    }
}

/// The share of a filter that lies in a half plane whose border is `at` texels beyond the filter's centre.
fn half_plane(filter: LineFilter, at: f64) -> f64 {
    let radius = radius(filter);
    if at >= radius {
        return 1.0;
    }
    if at <= -radius {
        return 0.0;
    }
    match filter {
        LineFilter::Disc => {
            0.5 + at * (radius * radius - at * at).sqrt() + radius * radius * math::asin(at / radius)
        }
        LineFilter::Cone => {
            // Simpson's rule over the cone seen from the side.
            const STEPS: usize = 64;
            let step = (at + 1.0) / STEPS as f64;
            let weight = |k: usize| match k {
                0 | STEPS => 1.0,
                k if k % 2 == 1 => 4.0,
                _ => 2.0,
            };
            (0..=STEPS).map(|k| weight(k) * cone_profile(step * k as f64 - 1.0)).sum::<f64>() * step / 3.0
        }
        LineFilter::Gaussian => {
            // Standard deviation 1/2: x / (sigma sqrt 2) = x sqrt 2.
            let mass = |x: f64| math::erf(x * std::f64::consts::SQRT_2);
            0.5 + 0.5 * mass(at) / mass(CUT)
        }
    }
}

/// A cone of radius and volume 1, integrated along lines at a distance from its axis.
fn cone_profile(s: f64) -> f64 {
    let chord = math::max(1.0 - s * s, 0.0).sqrt();
    let log = if s == 0.0 { 0.0 } else { s * s * math::asinh(chord / s.abs()) };
    (chord - log) * 3.0 / std::f64::consts::PI
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [LineFilter; 3] = [LineFilter::Disc, LineFilter::Cone, LineFilter::Gaussian];

    #[test]
    fn half_of_a_filter_lies_on_each_side_of_its_middle() {
        for filter in ALL {
            assert!((half_plane(filter, 0.0) - 0.5).abs() < 1e-6, "{filter:?}");
            assert!((half_plane(filter, 0.3) + half_plane(filter, -0.3) - 1.0).abs() < 1e-5, "{filter:?}");
            assert!((half_plane(filter, radius(filter) - 1e-9) - 1.0).abs() < 1e-5, "{filter:?}");
        }
    }

    #[test]
    fn a_line_gives_as_much_as_it_is_wide() {
        // What a line across the texels gives to all of them together is its width, whatever the filter.
        for filter in ALL {
            for width in [0.1, 0.5, 1.0, 2.3, 7.0] {
                let table = Table::new(filter, width);
                let steps = 4000;
                let step = 2.0 * table.reach() / f64::from(steps);
                let at = |k: i32| step * (f64::from(k) + 0.5) - table.reach();
                let sum: f64 =
                    (0..steps).map(|k| f64::from(table.intensity(at(k), 99.0, 99.0))).sum::<f64>() * step;
                assert!((sum - width).abs() < 0.005 * (1.0 + width), "{filter:?} {width} {sum}");
            }
        }
    }

    #[test]
    fn ends_fade_over_the_filters_width() {
        let table = Table::new(LineFilter::Gaussian, 8.0);
        assert_eq!(table.intensity(0.0, -1.5, 50.0), 0.0);
        assert!((table.intensity(0.0, 0.0, 50.0) - 0.5).abs() < 1e-6);
        assert!(table.intensity(0.0, 1.5, 50.0) > 0.999);
    }
}
