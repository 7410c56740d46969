//! Gradient noise (Perlin 2002) over the plan.

use super::random::{at, scramble, signed};
use glam::DVec2;

/// Noise of about -1..=1 that changes over a distance of 1; 0 at whole numbers.
pub(super) fn noise(seed: u64, p: DVec2) -> f64 {
    let cell = DVec2::new(p.x.floor(), p.y.floor());
    let (i, j) = (cell.x as i64, cell.y as i64);
    let d = p - cell;
    let corner = |di: i64, dj: i64| {
        let gradient = gradient(at(seed, i.wrapping_add(di), j.wrapping_add(dj)));
        let from = DVec2::new(d.x - di as f64, d.y - dj as f64);
        gradient.x * from.x + gradient.y * from.y
    };
    let (u, v) = (fade(d.x), fade(d.y));
    let south = blend(corner(0, 0), corner(1, 0), u);
    let north = blend(corner(0, 1), corner(1, 1), u);
    // The sum of unit gradients reaches sqrt(1/2) in the middle of a cell.
    blend(south, north, v) * std::f64::consts::SQRT_2
}

/// A direction of length 1.
fn gradient(hash: u64) -> DVec2 {
    let (x, y) = (signed(hash), signed(scramble(hash)));
    let length = (x * x + y * y).sqrt();
    if length > 0.0 { DVec2::new(x / length, y / length) } else { DVec2::X }
}

/// 6 t^5 - 15 t^4 + 10 t^3: no jump of the second derivative at the cells' borders (Perlin 2002).
fn fade(t: f64) -> f64 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

fn blend(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

/// Mountains of 0..=1: ridged octaves of noise on a plan that is itself bent a little, each octave the stronger the
/// higher the ground already is, so that valleys stay smooth (after Musgrave's ridged multifractal, 1998).
pub(super) fn mountains(seed: u64, octaves: u32, p: DVec2) -> f64 {
    let bend = DVec2::new(noise(scramble(seed ^ 1), p), noise(scramble(seed ^ 2), p));
    let mut p = p + bend * 0.25;
    let (mut height, mut most, mut size, mut weight) = (0.0, 0.0, 1.0, 1.0);
    for octave in 0..octaves {
        let n = noise(scramble(seed ^ (3 + u64::from(octave))), p);
        let ridge = 1.0 - n.abs();
        // The largest forms are hills, the smaller ones more and more ridges.
        let share = crate::math::min(0.6 + 0.1 * f64::from(octave), 0.85);
        let form = (1.0 - share) * (0.5 + 0.5 * n) + share * ridge * ridge;
        height += size * weight * form;
        most += size;
        weight = crate::math::min(crate::math::max(1.7 * weight * form, 0.02), 1.0);
        size *= 0.46;
        // Turned by the angle of the 3-4-5 triangle, so that the lattices do not line up.
        p = DVec2::new(0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y) * 2.0 + DVec2::new(17.3, 9.1);
    }
    stretch(height / most)
}

/// Spreads the heights that occur over 0..=1; what lies below becomes flat valley floor.
fn stretch(height: f64) -> f64 {
    let spread = (height - 0.16) / (0.80 - 0.16);
    crate::math::min(crate::math::max(spread, 0.0), 1.0)
}
