//! What machines may do differently: how far a sample may stray, and depths, and colours.

use crate::scene::{DepthFormat, Device};
use crate::space::{Lens, ViewFrame};

/// What a machine may do and still draw a technique right.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Envelope {
    /// Fractional bits to which it snaps vertices on the screen; 0: it does not.
    pub subpixel_bits: u32,
    /// What it keeps depths in.
    pub depth: DepthFormat,
    /// Fractional bits of the weights of its texture filters.
    pub filter_bits: u32,
}

/// Snapping of usual hardware, and the coarsest that APIs allow: tried one after the other where a scene imitates no machine.
const USUAL_BITS: [u32; 2] = [8, 4];

/// Bits of filters' weights where a scene says none: what APIs ask for at least, and hardware has.
const USUAL_FILTER_BITS: u32 = 8;

/// What arithmetic in single precision does to a vertex's place on the screen, pixels: four roundings of a coordinate below 4,096.
const SINGLE: f64 = 4.0 / 4096.0;

/// Depths of two surfaces are compared, each interpolated and rounded: so many steps they may be off together.
pub(super) const DEPTH_STEPS: f64 = 4.0;

/// Coordinates in single precision may be off by this share: a rounding of the coordinate, and three of what is computed with it.
pub(super) const COORDINATES: f64 = 4.0 / (1 << 24) as f64;

impl Envelope {
    /// Those of machines that may draw for a device: its own, or the usual ones where it is exact mathematics.
    pub fn of(device: &Device) -> Vec<Self> {
        let filter_bits = if device.filter_bits == 0 { USUAL_FILTER_BITS } else { device.filter_bits };
        let of_bits = |subpixel_bits| Self { subpixel_bits, depth: device.depth, filter_bits };
        match device.subpixel_bits {
            0 => USUAL_BITS.map(of_bits).to_vec(),
            bits => vec![of_bits(bits)],
        }
    }

    /// The same of what is calculated without a rasterizer: nothing is snapped.
    #[must_use]
    pub fn unsnapped(self) -> Self {
        Self { subpixel_bits: 0, ..self }
    }

    /// How far a vertex may stray on the screen along each axis, pixels: half a step of the grid that it is snapped to, and rounding.
    pub fn shift(&self) -> f64 {
        match self.subpixel_bits {
            0 => SINGLE,
            bits => 0.5 / f64::from(1u32 << bits) + SINGLE,
        }
    }

    /// How far what is not snapped may stray on the screen: the rounding of single precision, pixels.
    pub fn single(&self) -> f64 {
        SINGLE
    }

    /// How far along its ray a point of a view depth (metres) may seem to lie elsewhere because depths are rounded, metres.
    pub fn along(&self, view: &ViewFrame, depth: f64) -> f64 {
        let (near, far) = (view.near(), view.far());
        let bits = match self.depth {
            DepthFormat::F32Reversed | DepthFormat::F32 | DepthFormat::Unorm24 => 24,
            DepthFormat::Unorm16 => 16,
        };
        let step = 1.0 / f64::from(1u32 << bits);
        let is_central = matches!(view.lens(), Lens::Central { .. });
        let of_depth = match (self.depth, is_central) {
            // near / depth in floating point: a share of it.
            (DepthFormat::F32Reversed, true) => step * depth,
            // 1 - near / depth, near 1 almost everywhere.
            (_, true) => step * depth * depth / near,
            // Linear between the planes; an infinite far plane lies beyond the terrain by its diagonal then.
            (_, false) => step * (if far.is_finite() { far } else { 16.0 * depth } - near),
        };
        DEPTH_STEPS * of_depth
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_imitated_machine_has_its_own_envelope_and_exact_mathematics_those_of_usual_ones() {
        let bits = |subpixel_bits| {
            let device = Device { subpixel_bits, ..Device::default() };
            Envelope::of(&device).iter().map(|e| e.subpixel_bits).collect::<Vec<_>>()
        };
        assert_eq!((bits(0), bits(4)), (vec![8, 4], vec![4]));
    }

    #[test]
    fn a_vertex_strays_by_half_a_step_of_its_grid() {
        let of = |subpixel_bits| Envelope { subpixel_bits, depth: DepthFormat::F32, filter_bits: 8 }.shift();
        assert!((of(4) - (1.0 / 32.0 + SINGLE)).abs() < 1e-15);
        assert!(of(8) < of(4) && of(0) == SINGLE);
    }
}
