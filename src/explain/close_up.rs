//! A pixel and what is around it, seen through a microscope: point samples, each as the truth composes it.

use super::bench::{Bench, Near};
use crate::buffer::Buffer;
use crate::holding::Nearby;
use crate::parallel;
use crate::resolve::code_values;
use crate::space::Screen;

/// How far beside the pixel is shown, pixels.
pub(super) const BESIDE: f64 = 0.5;

/// What is shown of points that are not known.
const UNKNOWN: [u8; 4] = [0, 0, 0, 0];

/// The square around a pixel, [`BESIDE`] larger on each side, in so many samples a side.
pub(super) fn close_up(bench: &Bench, near: &Near, side: usize) -> Buffer<[u8; 4]> {
    let [x, y] = near.pixel.map(|v| v as f64 - BESIDE);
    let step = (1.0 + 2.0 * BESIDE) / side as f64;
    let rows = parallel::map_indices(side, |row| {
        let mut room = Nearby::default();
        let at = |k: usize| (k as f64 + 0.5) * step;
        let code = |column: usize| {
            let spot = bench.spot(near, Screen::new(x + at(column), y + at(row)), &mut room);
            spot.map_or(UNKNOWN, |paint| code_values(bench.backdrop.compositor.encoded(paint)))
        };
        (0..side).map(code).collect::<Vec<_>>()
    });
    Buffer::from_values(side, side, rows.concat())
}
