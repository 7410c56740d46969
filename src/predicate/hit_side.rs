//! Where the point that a ray sees lies: left or right of a line of the plan, above or below a level.
//!
//! Input: a ray, the triangle that it meets, a line of the plan or a height. Output: a side, exactly. A point on the line or
//! the level itself is moved by an infinitesimal step east, a still smaller one north and the smallest up, and so is the ray in
//! [`moved_ray_side`]: with the point its line of sight. So a count of the faces that the line crosses has one right answer.
//! Refuses: nothing; the ray must cross the triangle, not lie in its plane.

use super::{Difference, Expansion, Parameter, U, hit_fraction, orient3d, sign_of_det};
use crate::space::{Plan, Ray, World};
use glam::DVec3;

/// As [`super::ray_side`], but a ray that meets the edge exactly is moved in the world: east, then north, then up. 0 only for an
/// edge along the ray or of no length.
pub fn moved_ray_side(ray: &Ray, a: World, b: World) -> f64 {
    let side = -orient3d(a, b, ray.through, ray.from);
    if side != 0.0 {
        return side;
    }
    for step in [DVec3::X, DVec3::Y, DVec3::Z] {
        let step = Difference { of: step, minus: DVec3::ZERO };
        let rows = [step, Difference::new(b, a), Difference::new(ray.through, ray.from)];
        let sign = sign_of_det(&rows);
        if sign != 0.0 {
            return sign;
        }
    }
    0.0
}

/// The side of the line a -> b of the plan on which the ray meets a triangle: positive left, negative right; 0 only
/// for a line of no length.
pub fn hit_side(ray: &Ray, triangle: &[World; 3], a: Plan, b: Plan) -> f64 {
    let (along, start) = (b - a, ray.from.plan() - a);
    let d = (ray.through - ray.from).truncate();
    let t = Parameter::of(ray, triangle);
    let at = start + d * t.value;
    let value = along.x * at.y - along.y * at.x;
    // Six roundings bound each term's path; the parameter's own error reaches as far as the ray does.
    let reach = start.abs() + d.abs() * t.value.abs();
    let error = d.abs() * t.error + reach * (6.0 * U);
    let total = along.x.abs() * (error.y + 4.0 * U * reach.y) + along.y.abs() * (error.x + 4.0 * U * reach.x);
    if value.abs() > total {
        return value;
    }
    let sign = exact_hit_side(ray, triangle, a, b);
    [sign, a.y - b.y, b.x - a.x].into_iter().find(|v| *v != 0.0).unwrap_or(0.0)
}

/// Whether the ray meets a triangle at a height of at least `height`.
pub fn hit_is_above(ray: &Ray, triangle: &[World; 3], height: f64) -> bool {
    let (start, d) = (ray.from.z - height, ray.through.z - ray.from.z);
    let t = Parameter::of(ray, triangle);
    let value = start + d * t.value;
    let error = d.abs() * t.error + 8.0 * U * (start.abs() + (d * t.value).abs());
    if value.abs() > error {
        return value > 0.0;
    }
    at_hit(ray, triangle, |p| Expansion::difference(p.z, height)) >= 0.0
}

#[cold]
fn exact_hit_side(ray: &Ray, triangle: &[World; 3], a: Plan, b: Plan) -> f64 {
    at_hit(ray, triangle, |p| {
        let (x, y) = (Expansion::difference(p.x, a.x), Expansion::difference(p.y, a.y));
        Expansion::difference(b.x, a.x).times(&y).minus(&Expansion::difference(b.y, a.y).times(&x))
    })
}

/// The sign of an affine function where the ray meets a triangle.
#[cold]
fn at_hit(ray: &Ray, triangle: &[World; 3], function: impl Fn(World) -> Expansion) -> f64 {
    // At the parameter n / d the function is f(from) + n / d (f(through) - f(from)).
    let (n, d) = hit_fraction(ray, triangle);
    let (from, through) = (function(ray.from), function(ray.through));
    let value = from.times(&d).plus(&through.minus(&from).times(&n));
    value.sign() * d.sign()
}
