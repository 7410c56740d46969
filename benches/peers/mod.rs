//! The terrain on which other programs are timed.

use drapery::scene::{Posts, Surface};
use drapery::space::Plan;
use glam::DVec2;

/// A number of 0..=1 for each point of an integer lattice.
fn lattice_noise(x: i64, y: i64) -> f64 {
    let mut h = (x as u32).wrapping_mul(0x8da6_b343) ^ (y as u32).wrapping_mul(0xd816_3841);
    for (shift, factor) in [(13, 0x5bd1_e995), (15, 0x27d4_eb2d)] {
        h = (h ^ (h >> shift)).wrapping_mul(factor);
    }
    f64::from(h ^ (h >> 16)) / f64::from(u32::MAX)
}

/// Value noise with a fade of the fifth degree.
fn noise(x: f64, y: f64) -> f64 {
    let fade = |t: f64| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let (i, j) = (x.floor() as i64, y.floor() as i64);
    let (s, t) = (fade(x - x.floor()), fade(y - y.floor()));
    let row = |j| lattice_noise(i, j) * (1.0 - s) + lattice_noise(i + 1, j) * s;
    row(j) * (1.0 - t) + row(j + 1) * t
}

/// Rough hills over the unit square, of `n` posts a side and heights of 0 to 0.16.
pub fn hills(n: usize) -> Surface {
    let step = 1.0 / (n - 1) as f64;
    let height = |k: usize| {
        let (x, y) = ((k % n) as f64 * step, (k / n) as f64 * step);
        let octave = |o: i32| {
            let scale = f64::from(1 << o);
            let shift = f64::from(o);
            0.5 / scale * noise(x * 4.0 * scale + 17.3 * shift, y * 4.0 * scale + 31.7 * shift)
        };
        f64::from((0.2 * (0..9).map(octave).sum::<f64>()) as f32)
    };
    let heights = (0..n * n).map(height).collect();
    let steps = (DVec2::X * step, DVec2::Y * step);
    Surface::Grid(Posts::new((n, n), Plan::default(), steps, heights).expect("finite heights"))
}
