//! A comparison as a picture: where, and how far.

use super::difference::{Difference, is_over};
use crate::buffer::Buffer;
use crate::math;

/// A pixel that is as expected.
const EQUAL: [u8; 4] = [12, 12, 16, 255];
/// From near to far, of pixels within the tolerance: cold and dim.
const PASSING: [[u8; 3]; 3] = [[24, 32, 66], [38, 66, 112], [66, 108, 150]];
/// From near to far, of pixels over it: hot and bright.
const FAILING: [[u8; 3]; 3] = [[255, 236, 92], [255, 122, 24], [255, 0, 96]];
/// The distance at the dim end of the scale, one step of 16 bits; the bright end is 1.
const LEAST: f64 = 1.0 / 65535.0;

impl Difference {
    /// The comparison as a picture: as expected is almost black, within the tolerance blue, over it yellow, orange, red
    /// and pink; equal steps for equal ratios of distance, from 1/65535 to 1.
    pub fn heat_map(&self, tolerance: f64) -> Buffer<[u8; 4]> {
        let color = |distance: f64| {
            if distance == 0.0 {
                return EQUAL;
            }
            along(if is_over(distance, tolerance) { &FAILING } else { &PASSING }, share(distance))
        };
        let pixels = self.of_pixels(color);
        Buffer::from_values(self.distances().width(), self.distances().height(), pixels)
    }
}

/// The place of a distance on the scale, 0..=1.
fn share(distance: f64) -> f64 {
    let share = 1.0 - math::ln(math::min(distance, 1.0)) / math::ln(LEAST);
    math::max(share, 0.0)
}

/// The colour at a share of a ramp.
fn along(ramp: &[[u8; 3]; 3], share: f64) -> [u8; 4] {
    let at = usize::from(share >= 0.5);
    let t = 2.0 * share - at as f64;
    let mix = |k: usize| {
        let v = f64::from(ramp[at][k]) * (1.0 - t) + f64::from(ramp[at + 1][k]) * t;
        // A cast keeps within 0..=255.
        (v + 0.5).floor() as u8
    };
    [mix(0), mix(1), mix(2), 255]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::{Expected, Image};

    fn seen(distances: &[f64], tolerance: f64) -> Vec<[u8; 4]> {
        let image = |values: Vec<f64>| Image::new(distances.len(), 1, 1, values).unwrap();
        let black = Expected::exactly(image(vec![0.0; distances.len()]));
        let difference = Difference::of(&black, &image(distances.to_vec())).unwrap();
        difference.heat_map(tolerance).values().to_vec()
    }

    #[test]
    fn failing_pixels_are_hot_and_others_cold() {
        let opaque = |[r, g, b]: [u8; 3]| [r, g, b, 255];
        let map = seen(&[0.0, 1e-9, 1.0, LEAST], 0.5);
        assert_eq!(map, [EQUAL, opaque(PASSING[0]), opaque(FAILING[2]), opaque(PASSING[0])]);
        assert_eq!(seen(&[f64::INFINITY, 1e-300], 0.0), [opaque(FAILING[2]), opaque(FAILING[0])]);
    }

    #[test]
    fn equal_ratios_of_distance_are_equal_steps() {
        let steps = [1.0, 1.0 / 256.0, 1.0 / 65536.0].map(share);
        assert!(
            (steps[0] - 1.0).abs() < 1e-12 && (steps[1] - 0.5).abs() < 1e-6 && steps[2] < 1e-6,
            "{steps:?}"
        );
    }
}
