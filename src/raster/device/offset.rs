//! Polygon offset: a triangle's depth moved by a multiple of its slope and of the depth buffer's step (OpenGL 2.1,
//! section 3.5.5; 4.6, section 14.6.5).

use super::depth::DepthBuffer;
use super::number::Real;
use super::scan::Primitive;
use crate::math;

/// How far polygons' depth is moved: `slope * factor + step * units`, positive away from the eye whichever end of the
/// depth range is near.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PolygonOffset {
    /// Times the triangle's largest slope: the larger of |dz/dx| and |dz/dy|, depth a pixel; the specification allows it
    /// instead of the gradient's length.
    pub factor: f64,
    /// Times the least difference that the depth buffer keeps.
    pub units: f64,
}

impl PolygonOffset {
    /// A triangle with its depths moved. (They may leave 0..=1 then: [`DepthBuffer::store`] clamps each fragment's.)
    #[must_use]
    pub fn applied<T: Real>(&self, primitive: &Primitive<T>, buffer: DepthBuffer) -> Primitive<T> {
        let offset = self.of(primitive, buffer);
        Primitive { corners: primitive.corners.map(|[x, y, z]| [x, y, z + offset]), ..*primitive }
    }

    fn of<T: Real>(&self, primitive: &Primitive<T>, buffer: DepthBuffer) -> T {
        self.at(slope(primitive), T::of(largest_depth(primitive)), buffer)
    }

    /// What is added to depths of a triangle with this largest slope (depth a pixel) and this largest depth, in -1..=1.
    pub fn at<T: Real>(&self, slope: T, largest_depth: T, buffer: DepthBuffer) -> T {
        let farther = if buffer.is_reversed() { -1.0 } else { 1.0 };
        let step = T::of(buffer.step(largest_depth.get()));
        let offset = slope * T::of(farther * self.factor) + step * T::of(farther * self.units);
        // One is as far as depth reaches; a triangle thin enough to leave the range of numbers is moved so far.
        T::of(math::max(-1.0, math::min(offset.get(), 1.0)))
    }
}

/// The larger of |dz/dx| and |dz/dy|; 0 for a triangle without area, which covers nothing.
fn slope<T: Real>(primitive: &Primitive<T>) -> T {
    let zero = T::of(0.0);
    let abs = |v: T| if v < zero { zero - v } else { v };
    let [a, b, c] = primitive.corners;
    let from_a = |p: [T; 3]| [p[0] - a[0], p[1] - a[1], p[2] - a[2]];
    let ([ux, uy, uz], [vx, vy, vz]) = (from_a(b), from_a(c));
    let area = ux * vy - uy * vx;
    if area == zero {
        return zero;
    }
    let by_x = abs((uz * vy - uy * vz) / area);
    let by_y = abs((ux * vz - uz * vx) / area);
    if by_x > by_y { by_x } else { by_y }
}

fn largest_depth<T: Real>(primitive: &Primitive<T>) -> f64 {
    primitive.corners.iter().fold(0.0, |most, corner| math::max(most, corner[2].get().abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::DepthFormat;

    /// Depth grows by 1/64 a pixel to the right and falls by 1/32 a pixel down; 0.5 at (8, 8).
    fn tilted<T: Real>() -> Primitive<T> {
        with_slope([1.0 / 64.0, -1.0 / 32.0])
    }

    fn with_slope<T: Real>([by_x, by_y]: [f64; 2]) -> Primitive<T> {
        let corner = |x: f64, y: f64| [x, y, 0.5 + (x - 8.0) * by_x + (y - 8.0) * by_y].map(T::of);
        Primitive { id: 7, corners: [corner(2.0, 3.0), corner(14.5, 4.0), corner(5.0, 15.25)] }
    }

    fn level(depth: f64) -> Primitive<f64> {
        Primitive { id: 0, corners: [[0.0, 0.0, depth], [1.0, 0.0, depth], [0.0, 1.0, depth]] }
    }

    fn offset(factor: f64, units: f64) -> PolygonOffset {
        PolygonOffset { factor, units }
    }

    #[test]
    fn the_slope_is_the_larger_of_both_and_moves_farther() {
        for (format, sign) in [
            (DepthFormat::F32, 1.0),
            (DepthFormat::Unorm24, 1.0),
            (DepthFormat::Unorm16, 1.0),
            (DepthFormat::F32Reversed, -1.0),
        ] {
            let buffer = DepthBuffer(format);
            assert_eq!(offset(1.0, 0.0).of(&tilted::<f64>(), buffer), sign / 32.0);
            assert_eq!(offset(-2.5, 0.0).of(&tilted::<f64>(), buffer), -sign * 2.5 / 32.0);
            assert_eq!(offset(1.0, 0.0).of(&tilted::<f32>(), buffer), sign as f32 / 32.0);
            // The corners run the other way round.
            let Primitive { id, corners: [a, b, c] } = tilted::<f64>();
            assert_eq!(offset(1.0, 0.0).of(&Primitive { id, corners: [a, c, b] }, buffer), sign / 32.0);
            let moved = offset(1.0, 0.0).applied(&tilted::<f64>(), buffer);
            for (before, after) in tilted::<f64>().corners.iter().zip(moved.corners) {
                assert_eq!(after, [before[0], before[1], before[2] + sign / 32.0]);
            }
            assert_eq!(moved.id, 7);
        }
    }

    #[test]
    fn the_slope_s_sign_does_not_matter() {
        let buffer = DepthBuffer(DepthFormat::F32);
        for slope in
            [[1.0, 2.0], [-1.0, 2.0], [1.0, -2.0], [-1.0, -2.0], [-2.0, 1.0], [2.0, -1.0], [-2.0, 0.0]]
        {
            let primitive = with_slope::<f64>(slope.map(|v| v / 64.0));
            assert_eq!(offset(1.0, 0.0).of(&primitive, buffer), 1.0 / 32.0, "{slope:?}");
        }
    }

    #[test]
    fn a_unit_is_a_step_of_the_depth_buffer() {
        let unit = |format, depth| offset(0.0, 1.0).of(&level(depth), DepthBuffer(format));
        assert_eq!(unit(DepthFormat::Unorm16, 0.3), 1.0 / 65_535.0);
        assert_eq!(unit(DepthFormat::Unorm24, 0.3), 1.0 / 16_777_215.0);
        let two_to_the = |power: i32| (0..-power).fold(1.0, |v, _| v / 2.0);
        // 1 has the exponent 0; 0.5 to below 1 have -1; 0.125 and 0.2 have -3.
        for (depth, power) in [(1.0, -23), (0.5, -24), (0.99, -24), (0.125, -26), (0.2, -26)] {
            assert_eq!(unit(DepthFormat::F32, depth), two_to_the(power));
            assert_eq!(unit(DepthFormat::F32Reversed, depth), -two_to_the(power));
        }
        // The largest depth of a triangle decides.
        let mut sloping = level(0.2);
        sloping.corners[1][2] = 0.75;
        assert_eq!(offset(0.0, 3.0).of(&sloping, DepthBuffer(DepthFormat::F32)), 3.0 * two_to_the(-24));
        assert!(unit(DepthFormat::F32, 0.0) > 0.0);
    }

    #[test]
    fn a_unit_moves_every_stored_depth_to_the_next_one() {
        for format in [DepthFormat::Unorm16, DepthFormat::Unorm24] {
            let buffer = DepthBuffer(format);
            for k in (0..65_000u32).step_by(371) {
                let depth: f64 = buffer.load(k as f32);
                let moved = offset(0.0, 1.0).applied(&level(depth), buffer).corners[0][2];
                assert_eq!(buffer.store(moved), (k + 1) as f32);
            }
        }
    }

    #[test]
    fn slope_and_units_add_up_and_the_depth_buffer_clamps_what_leaves_it() {
        let buffer = DepthBuffer(DepthFormat::Unorm16);
        let both = offset(1.0, 4.0).of(&tilted::<f64>(), buffer);
        assert_eq!(both, 1.0 / 32.0 + 4.0 / 65_535.0);
        let far = offset(1e9, 0.0).applied(&tilted::<f64>(), buffer);
        let near = offset(-1e9, 0.0).applied(&tilted::<f64>(), buffer);
        assert!(far.corners.iter().all(|c| buffer.store(c[2]) == 65_535.0));
        assert!(near.corners.iter().all(|c| buffer.store(c[2]) == 0.0));
    }

    #[test]
    fn what_has_no_area_or_hardly_any_gets_a_finite_offset() {
        let buffer = DepthBuffer(DepthFormat::F32);
        let flat = Primitive { id: 0, corners: [[0.0, 0.0, 0.1], [1.0, 1.0, 0.2], [2.0, 2.0, 0.9]] };
        assert_eq!(offset(1.0, 0.0).of(&flat, buffer), 0.0);
        let thin = Primitive { id: 0, corners: [[0.0f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1e-42, 1.0]] };
        for factor in [1e38, -1e38, 0.0] {
            assert!(offset(factor, 1e38).of(&thin, buffer).abs() <= 1.0);
        }
    }
}
