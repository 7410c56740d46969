//! The bounds of the filters, where operands lie so near to a tie that a smaller bound would decide wrongly; and that ordinary
//! operands are decided without exact arithmetic.

use super::{power_of_2, rational, rational_det, sign, signum};
use crate::predicate::*;
use dashu::rational::RBig;
use proptest::prelude::*;

/// 0, or a number with any last digits within a factor of 2 from 1.
fn digits() -> impl Strategy<Value = f64> {
    let any_digits = (0..1_u64 << 52, any::<bool>()).prop_map(|(digits, is_negative)| {
        let v = f64::from_bits(1.0_f64.to_bits() | digits);
        if is_negative { -v } else { v }
    });
    prop_oneof![2 => Just(0.0), 3 => any_digits]
}

/// Vectors along axes, in planes of axes and across, of one magnitude.
fn vector() -> impl Strategy<Value = DVec3> {
    (digits(), digits(), digits()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

/// A ray and a triangle.
#[derive(Debug, Clone, Copy)]
struct Hit {
    ray: Ray,
    triangle: [World; 3],
}

impl Hit {
    /// Numerator and denominator of the ray's parameter at the triangle's plane.
    fn fraction(&self) -> (RBig, RBig) {
        let [a, b, c] = self.triangle;
        let (u, v) = (Difference::new(b, a), Difference::new(c, a));
        let along = Difference::new(self.ray.through, self.ray.from);
        (rational_det(&[Difference::new(a, self.ray.from), u, v]), rational_det(&[along, u, v]))
    }

    /// The ray's parameter; `None` for a ray in the plane or beside it.
    fn parameter(&self) -> Option<RBig> {
        let (n, d) = self.fraction();
        (d != RBig::ZERO).then(|| n / d)
    }

    /// A coordinate of the point that is hit.
    fn coordinate(&self, axis: usize, parameter: &RBig) -> RBig {
        let [from, through] = [self.ray.from, self.ray.through].map(|p| rational(p.to_vec()[axis]));
        from.clone() + (through - from) * parameter.clone()
    }

    /// The point that is hit, rounded.
    fn rounded(&self, parameter: &RBig) -> DVec3 {
        DVec3::from_array([0, 1, 2].map(|axis| self.coordinate(axis, parameter).to_f64().value()))
    }
}

/// Rays and triangles of very small to very large size, many of whose determinants are what rounding leaves of larger products:
/// rays that start almost in the plane, and rays that almost lie in it.
fn hit() -> impl Strategy<Value = Hit> {
    let weights = || (digits(), digits());
    let magnitude = || prop_oneof![Just(-30), Just(0), Just(30)];
    let vectors = prop::array::uniform5(vector());
    (vectors, magnitude(), magnitude(), 0..4, weights()).prop_map(
        |([from, start, along, u, v], far, wide, how, (s, t))| {
            let (far, wide) = (power_of_2(far), power_of_2(wide));
            let in_plane = (u * s + v * t) * far;
            let (start, along) = (start * far, along * far);
            let (start, along) = match how {
                0 => (start, along),
                1 => (in_plane, along),
                2 => (start, in_plane),
                _ => (start + in_plane * 64.0, along),
            };
            let from = world(from * far);
            let a = from + start;
            Hit { ray: Ray { from, through: from + along }, triangle: [a, a + u * wide, a + v * wide] }
        },
    )
}

fn world(p: DVec3) -> World {
    World::new(p.x, p.y, p.z)
}

/// Whether a determinant is no small rest of the products that it is summed of.
fn is_clear(rows: [DVec3; 3]) -> bool {
    let [a, b, c] = rows;
    let [m, p, q] = rows.map(DVec3::abs);
    let sum = DVec3::new(p.y * q.z + p.z * q.y, p.z * q.x + p.x * q.z, p.x * q.y + p.y * q.x);
    a.dot(b.cross(c)).abs() > m.dot(sum) / f64::from(1 << 16)
}

/// A double and its neighbours: those that the predicates take.
fn around(v: f64) -> impl Iterator<Item = f64> {
    let all = [v, v.next_up(), v.next_down(), v.next_up().next_up(), v.next_down().next_down()];
    all.into_iter().filter(|v| *v == 0.0 || v.abs() > power_of_2(-160))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]
    #[test]
    fn a_parameter_is_no_farther_off_than_its_bound(hit in hit()) {
        let Hit { ray, triangle } = hit;
        let found = Parameter::of(&ray, &triangle);
        if found.error.is_finite() {
            let exact = hit.parameter().expect("a finite bound tells that the ray is not in the plane");
            let bound = rational(found.error);
            let (least, most) = (rational(found.value) - bound.clone(), rational(found.value) + bound);
            prop_assert!(least <= exact && exact <= most, "{} +- {}", found.value, found.error);
        }
    }

    #[test]
    fn an_ordinary_hit_is_found_without_exact_arithmetic(hit in hit()) {
        let Hit { ray, triangle: [a, b, c] } = hit;
        let (start, along, u, v) = (a - ray.from, ray.through - ray.from, b - a, c - a);
        if is_clear([start, u, v]) && is_clear([along, u, v]) {
            prop_assert!(quick_hit_parameter(&ray, &TrianglePlane::new(&hit.triangle).numbers()).1);
        }
    }

    #[test]
    fn the_sign_of_a_determinant_near_0_is_that_of_rational_arithmetic(hit in hit()) {
        let Hit { ray, triangle: [a, b, c] } = hit;
        let edges = [Difference::new(b, a), Difference::new(c, a)];
        for first in [Difference::new(a, ray.from), Difference::new(ray.through, ray.from)] {
            for rows in [[first, edges[0], edges[1]], [edges[0], first, edges[1]], [edges[0], edges[1], first]] {
                prop_assert_eq!(signum(sign_of_det(&rows)), sign(&rational_det(&rows)));
            }
        }
    }

    #[test]
    fn of_two_triangles_through_almost_one_point_of_a_ray_the_nearer_is_that_of_rational_arithmetic(
        first in hit(),
        sides in prop::array::uniform2(vector()),
    ) {
        let Some(parameter) = first.parameter() else { return Ok(()) };
        let corner = world(first.rounded(&parameter));
        let second = Hit { triangle: [corner, corner + sides[0], corner + sides[1]], ..first };
        let Some(other) = second.parameter() else { return Ok(()) };
        let order = compare_along_ray(&first.ray, &first.triangle, &second.triangle);
        prop_assert_eq!(order, parameter.partial_cmp(&other).unwrap());
        let order = compare_along_ray(&first.ray, &second.triangle, &first.triangle);
        prop_assert_eq!(order, other.partial_cmp(&parameter).unwrap());
    }

    #[test]
    fn a_hit_almost_at_a_height_is_above_it_where_rational_arithmetic_says_so(hit in hit()) {
        let Some(parameter) = hit.parameter() else { return Ok(()) };
        let exact = hit.coordinate(2, &parameter);
        for height in around(exact.to_f64().value()) {
            let found = hit_is_above(&hit.ray, &hit.triangle, height);
            prop_assert_eq!(found, exact >= rational(height), "{}", height);
        }
    }

    #[test]
    fn a_hit_almost_on_a_line_lies_on_the_side_that_rational_arithmetic_finds(
        hit in hit(),
        step in vector(),
        is_between in any::<bool>(),
        magnitude in prop_oneof![Just(-30), Just(0), Just(30)],
    ) {
        let Some(parameter) = hit.parameter() else { return Ok(()) };
        let (x, y) = (hit.coordinate(0, &parameter), hit.coordinate(1, &parameter));
        let step = step.truncate() * power_of_2(magnitude);
        let place = hit.rounded(&parameter);
        for at_x in around(place.x) {
            let at = Plan::new(at_x, place.y);
            let (a, b) = (if is_between { at + -step } else { at }, at + step);
            if a == b {
                continue;
            }
            let (along_x, along_y) = (rational(b.x) - rational(a.x), rational(b.y) - rational(a.y));
            let side = along_x.clone() * (y.clone() - rational(a.y)) - along_y.clone() * (x.clone() - rational(a.x));
            // On the line: a step east, then one north.
            let signs = [sign(&side), -sign(&along_y), sign(&along_x)];
            let expected = signs.into_iter().find(|s| *s != 0.0).unwrap();
            prop_assert_eq!(signum(hit_side(&hit.ray, &hit.triangle, a, b)), expected);
        }
    }
}
