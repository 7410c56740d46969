//! Every sign is that of rational arithmetic, at ties and near them.

mod filters;

use super::*;
use crate::space::Viewpoint;
use dashu::rational::RBig;
use proptest::prelude::*;

fn rational(v: f64) -> RBig {
    RBig::try_from(v).unwrap()
}

fn rational_det(rows: &[Difference; 3]) -> RBig {
    let m: Vec<Vec<RBig>> =
        rows.iter().map(|r| (0..3).map(|k| rational(r.of[k]) - rational(r.minus[k])).collect()).collect();
    let minor = |i: usize, j: usize| m[1][i].clone() * m[2][j].clone() - m[1][j].clone() * m[2][i].clone();
    m[0][0].clone() * minor(1, 2) + m[0][1].clone() * minor(2, 0) + m[0][2].clone() * minor(0, 1)
}

fn sign(v: &RBig) -> f64 {
    match v.partial_cmp(&RBig::ZERO).unwrap() {
        Ordering::Less => -1.0,
        Ordering::Equal => 0.0,
        Ordering::Greater => 1.0,
    }
}

fn coordinate() -> impl Strategy<Value = f64> {
    // Few distinct values a few ulps apart: determinants near and at zero are frequent.
    (0..6i32, -2..3i64).prop_map(|(k, ulps)| {
        let base = f64::from(k) * 0.1;
        f64::from_bits((base.to_bits() as i64 + if base == 0.0 { 0 } else { ulps }) as u64)
    })
}

fn point() -> impl Strategy<Value = World> {
    (coordinate(), coordinate(), coordinate()).prop_map(|(x, y, z)| World::new(x, y, z))
}

/// Points of a small lattice: that a ray meets an edge is frequent, and determinants of doubles are exact.
fn post() -> impl Strategy<Value = World> {
    let at = || (-2..3i8).prop_map(f64::from);
    (at(), at(), at()).prop_map(|(x, y, z)| World::new(x, y, z))
}

/// A central and a parallel view to the north: right is east on the screen, up is up.
fn looking_north() -> [ViewFrame; 2] {
    let (eye, target) = (World::new(0.0, -8.0, 0.0), World::new(0.0, 0.0, 0.0));
    let view = Viewpoint { eye, target, up: DVec3::Z, near: 0.5, far: f64::INFINITY };
    [ViewFrame::perspective(&view, 60.0, (8, 8)), ViewFrame::orthographic(&view, 8.0, (8, 8))]
        .map(|frame| frame.unwrap())
}

/// The first side that is not 0 of the edge a -> b, as the ray is moved by each of these steps (`true`: its start too).
fn first_side(ray: &Ray, is_start_moved: bool, [a, b]: [World; 2], steps: &[DVec3]) -> f64 {
    let side = |step: &DVec3| {
        let (from, through) = (if is_start_moved { ray.from + *step } else { ray.from }, ray.through + *step);
        (through - from).dot((b - from).cross(a - from))
    };
    steps.iter().map(side).find(|side| *side != 0.0).unwrap_or(0.0)
}

/// 2 to an exponent of a double that is not subnormal.
fn power_of_2(exponent: i32) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// -1, 0 or 1.
fn signum(v: f64) -> f64 {
    if v == 0.0 { 0.0 } else { v.signum() }
}

#[test]
fn an_edge_that_turns_counter_clockwise_about_the_ray_is_on_its_positive_side() {
    for frame in looking_north() {
        let ray = Ray { from: frame.eye(), through: World::new(0.0, 0.0, 0.0) };
        let (a, b, c) = (World::new(1.0, 3.0, -1.0), World::new(1.0, 2.0, 1.0), World::new(-1.0, 2.5, 0.0));
        for (from, to) in [(a, b), (b, c), (c, a)] {
            assert!(ray_side(&frame, &ray, from, to) > 0.0 && moved_ray_side(&ray, from, to) > 0.0);
            assert!(ray_side(&frame, &ray, to, from) < 0.0 && moved_ray_side(&ray, to, from) < 0.0);
        }
    }
}

#[test]
fn an_expansion_is_rounded_to_its_value() {
    assert_eq!(Expansion::exactly(-3.5).rounded(), -3.5);
    assert_eq!(Expansion::difference(0.1, -0.2).rounded(), 0.1 + 0.2);
    let tiny = power_of_2(-80);
    let almost = Expansion::difference(1.0, tiny);
    assert_eq!((almost.rounded(), almost.minus(&Expansion::exactly(1.0)).rounded()), (1.0, -tiny));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]
    #[test]
    fn a_ray_that_meets_an_edge_is_moved_right_on_the_screen_and_then_down(p in prop::array::uniform3(post())) {
        let [through, a, b] = p;
        let steps = [DVec3::ZERO, DVec3::X, -DVec3::Z];
        let [central, parallel] = looking_north();
        let ray = Ray { from: central.eye(), through };
        let expected = first_side(&ray, false, [a, b], &steps);
        prop_assert_eq!(signum(ray_side(&central, &ray, a, b)), signum(expected));
        let ray = Ray { from: World::new(through.x, -8.0, through.z), through };
        let expected = first_side(&ray, true, [a, b], &steps);
        prop_assert_eq!(signum(ray_side(&parallel, &ray, a, b)), signum(expected));
    }

    #[test]
    fn the_side_of_a_line_of_the_plan_is_that_of_rational_arithmetic(p in prop::array::uniform3(point())) {
        let [a, b, q] = p.map(|p| p.plan());
        let [ab, aq] = [b, q].map(|to| [rational(to.x) - rational(a.x), rational(to.y) - rational(a.y)]);
        let expected = ab[0].clone() * aq[1].clone() - ab[1].clone() * aq[0].clone();
        prop_assert_eq!(signum(orient2d(a, b, q)), sign(&expected));
    }

    #[test]
    fn a_ray_that_meets_an_edge_is_moved_east_then_north_then_up(p in prop::array::uniform4(post())) {
        let [from, through, a, b] = p;
        let ray = Ray { from, through };
        let expected = first_side(&ray, true, [a, b], &[DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z]);
        prop_assert_eq!(signum(moved_ray_side(&ray, a, b)), signum(expected));
    }

    #[test]
    fn a_triangle_faces_along_its_normal(p in prop::array::uniform3(post())) {
        let [a, b, c] = p;
        let normal = (b - a).cross(c - a);
        let [central, parallel] = looking_north();
        prop_assert_eq!(signum(facing(&central, &p)), signum(normal.dot(a - central.eye())));
        prop_assert_eq!(signum(facing(&parallel, &p)), signum(normal.y));
    }

    #[test]
    fn the_parameter_of_a_hit_and_what_it_lies_beyond_are_those_of_rational_arithmetic(
        p in prop::array::uniform5(point()),
    ) {
        let (ray, t) = (Ray { from: p[0], through: p[1] }, [p[2], p[3], p[4]]);
        let (u, v) = (Difference::new(t[1], t[0]), Difference::new(t[2], t[0]));
        let d = rational_det(&[Difference::new(ray.through, ray.from), u, v]);
        if d == RBig::ZERO {
            prop_assert_eq!(hit_parameter(&ray, &t), 0.0);
            return Ok(());
        }
        let exact = rational_det(&[Difference::new(t[0], ray.from), u, v]) / d;
        let nearest = exact.to_f64().value();
        prop_assert!((hit_parameter(&ray, &t) - nearest).abs() <= nearest.abs() / f64::from(1 << 30));
        let [frame, _] = looking_north();
        let exact = exact * rational(frame.reach());
        let nearest = exact.to_f64().value();
        let depths = [nearest, nearest.next_up(), nearest.next_down(), 2.0 * nearest, -nearest, 0.0];
        // Nearer to 0 products leave the range of doubles.
        for depth in depths.into_iter().filter(|depth| *depth == 0.0 || depth.abs() > 1e-48) {
            prop_assert_eq!(is_hit_beyond(&frame, &ray, &t, depth), exact >= rational(depth));
        }
    }

    #[test]
    fn the_sign_of_a_determinant_is_that_of_rational_arithmetic(p in prop::array::uniform6(point())) {
        let rows = [Difference::new(p[0], p[1]), Difference::new(p[2], p[3]), Difference::new(p[4], p[5])];
        let expected = sign(&rational_det(&rows));
        prop_assert_eq!(exact_det(&rows).sign(), expected);
        let filtered = sign_of_det(&rows);
        prop_assert_eq!(signum(filtered), expected);
    }

    #[test]
    fn the_order_along_a_ray_is_that_of_rational_arithmetic(p in prop::array::uniform8(point())) {
        let ray = Ray { from: p[0], through: p[1] };
        let (t1, t2) = ([p[2], p[3], p[4]], [p[5], p[6], p[7]]);
        let parameter = |t: &[World; 3]| {
            let (u, v) = (Difference::new(t[1], t[0]), Difference::new(t[2], t[0]));
            let n = rational_det(&[Difference::new(t[0], ray.from), u, v]);
            let d = rational_det(&[Difference::new(ray.through, ray.from), u, v]);
            (d != RBig::ZERO).then(|| n / d)
        };
        if let (Some(first), Some(second)) = (parameter(&t1), parameter(&t2)) {
            prop_assert_eq!(compare_along_ray(&ray, &t1, &t2), first.partial_cmp(&second).unwrap());
        }
    }

    #[test]
    fn the_weights_of_a_hit_are_those_of_rational_arithmetic(p in prop::array::uniform5(point())) {
        let (ray, t) = (Ray { from: p[0], through: p[1] }, [p[2], p[3], p[4]]);
        let (u, v) = (Difference::new(t[1], t[0]), Difference::new(t[2], t[0]));
        let along = Difference::new(ray.through, ray.from);
        let d = rational_det(&[along, u, v]);
        prop_assume!(d != RBig::ZERO);
        let start = Difference::new(ray.from, t[0]);
        let exact = [[along, start, v], [along, u, start]].map(|rows| rational_det(&rows) / d.clone());
        for (weight, exact) in hit_weights(&ray, &t).into_iter().zip(exact) {
            prop_assert!((weight - exact.to_f64().value()).abs() <= 1e-14 * weight.abs());
        }
    }

    #[test]
    fn the_side_of_a_hit_is_that_of_rational_arithmetic(p in prop::array::uniform7(point())) {
        let (ray, t) = (Ray { from: p[0], through: p[1] }, [p[2], p[3], p[4]]);
        let (a, b) = (p[5].plan(), p[6].plan());
        let (u, v) = (Difference::new(t[1], t[0]), Difference::new(t[2], t[0]));
        let n = rational_det(&[Difference::new(t[0], ray.from), u, v]);
        let d = rational_det(&[Difference::new(ray.through, ray.from), u, v]);
        prop_assume!(d != RBig::ZERO && a != b);
        let at = |from: f64, to: f64| rational(from) + (rational(to) - rational(from)) * n.clone() / d.clone();
        let (x, y) = (at(ray.from.x, ray.through.x), at(ray.from.y, ray.through.y));
        let (along_x, along_y) = (rational(b.x) - rational(a.x), rational(b.y) - rational(a.y));
        let side = along_x.clone() * (y - rational(a.y)) - along_y.clone() * (x - rational(a.x));
        // On the line: a step east, then one north.
        let signs = [sign(&side), -sign(&along_y), sign(&along_x)];
        let expected = signs.into_iter().find(|s| *s != 0.0).unwrap();
        prop_assert_eq!(hit_side(&ray, &t, a, b).signum(), expected);
        let height = at(ray.from.z, ray.through.z) - rational(p[5].z);
        prop_assert_eq!(hit_is_above(&ray, &t, p[5].z), sign(&height) >= 0.0);
    }
}
