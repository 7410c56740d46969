//! What a depth buffer holds, and the depth test.

use super::number::{Real, clamp_to_unit};
use crate::scene::DepthFormat;

/// The content of a depth buffer as singles: the depth itself in the floating-point formats, the integer (exact up to 24
/// bits) in the fixed-point ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DepthBuffer(pub DepthFormat);

impl DepthBuffer {
    /// Whether the near plane has the largest depth.
    pub fn is_reversed(self) -> bool {
        self.0 == DepthFormat::F32Reversed
    }

    /// The largest integer of a fixed-point format.
    fn most(self) -> Option<f64> {
        match self.0 {
            DepthFormat::F32 | DepthFormat::F32Reversed => None,
            DepthFormat::Unorm24 => Some(16_777_215.0),
            DepthFormat::Unorm16 => Some(65_535.0),
        }
    }

    /// The least difference that two depths up to some largest one keep: a step of a fixed-point format; of a
    /// floating-point one, with 23 bits behind the point, the step of the largest depth.
    pub(super) fn step(self, largest: f64) -> f64 {
        let largest = largest as f32;
        self.most().map_or_else(|| f64::from(largest.next_up()) - f64::from(largest), |most| 1.0 / most)
    }

    /// What the buffer is cleared to: the far plane. (So terrain whose depth rounds to the far plane's is not seen.)
    pub fn cleared(self) -> f32 {
        if self.is_reversed() { 0.0 } else { self.most().unwrap_or(1.0) as f32 }
    }

    /// What a depth of 0..=1 is stored as: the nearest value of the format, ties to even.
    pub fn store<T: Real>(self, depth: T) -> f32 {
        let depth = clamp_to_unit(depth).get();
        self.most().map_or(depth, |most| (depth * most).round_ties_even()) as f32
    }

    /// The depth of 0..=1 that a stored value means.
    pub fn load<T: Real>(self, stored: f32) -> T {
        let stored = T::of(stored.into());
        self.most().map_or(stored, |most| stored / T::of(most))
    }

    /// The depth test: strictly nearer. The first of two equal ones stays.
    pub fn passes(self, new: f32, old: f32) -> bool {
        if self.is_reversed() { new > old } else { new < old }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [DepthFormat; 4] =
        [DepthFormat::F32Reversed, DepthFormat::F32, DepthFormat::Unorm24, DepthFormat::Unorm16];

    #[test]
    fn every_integer_of_a_fixed_point_buffer_comes_back() {
        for (format, most) in [(DepthFormat::Unorm24, 16_777_215u32), (DepthFormat::Unorm16, 65_535)] {
            let buffer = DepthBuffer(format);
            for k in (0..=most).step_by(97).chain([most - 1, most]) {
                let stored = k as f32;
                assert_eq!(buffer.store(buffer.load::<f64>(stored)), stored);
            }
        }
    }

    #[test]
    fn the_first_of_two_equal_depths_stays_and_the_far_plane_is_not_seen() {
        for buffer in ALL.map(DepthBuffer) {
            let far = if buffer.is_reversed() { 0.0 } else { 1.0 };
            let stored = buffer.store(0.25);
            assert!(buffer.passes(stored, buffer.cleared()) && !buffer.passes(stored, stored));
            assert!(!buffer.passes(buffer.store(far), buffer.cleared()));
            assert_eq!(buffer.passes(buffer.store(0.75), stored), buffer.is_reversed());
        }
    }
}
