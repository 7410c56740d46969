//! Where a pixel reads the texture, as far as it is known: the plan point of its centre, and its footprint there.
//!
//! What the centre sees is a triangle's plane. Nearby shifts of the pixel move the plan point along the two derivatives; depths that are
//! rounded move it along the ray; single precision moves it anywhere a little.

use super::texture::Texture;
use crate::certainty::PaintRange;
use crate::math;
use crate::space::{Lens, Plan, PlanBox, Screen, Texel, ViewFrame, World};
use crate::terrain::{SurfaceTriangle, TriangleDrape};
use glam::{DMat2, DVec2, DVec3};

/// What roundings in single precision may come to, of the largest coordinate: a few of them.
const SINGLE: f64 = 4.0 / (1 << 24) as f64;

/// How far quotients of a footprint's axes may stray by roundings in single precision. (Four fifths of the millionth by which a quotient may be
/// over a whole number without another probe.)
const RATIO: f64 = 4e-7;

/// What a pixel sees, and where it reads the texture then.
#[derive(Debug, Clone)]
pub(super) struct Look {
    /// The triangle.
    pub(super) triangle: u32,
    /// The ground's paint.
    pub(super) ground: PaintRange,
    /// Where it reads, in texels of level 0; the point strays from there by each of `ways`, times -1 to 1, and by `noise` along both axes.
    pub(super) at: Texel,
    pub(super) ways: [DVec2; 3],
    pub(super) noise: f64,
    /// The longer derivative, texels of level 0: at least and at most.
    pub(super) longer: [f64; 2],
    /// The length of the footprint's long axis, texels of level 0: at least and at most.
    pub(super) long: [f64; 2],
    /// The axis, and how far its ends may lie elsewhere.
    pub(super) axis: DVec2,
    pub(super) axis_off: f64,
    /// Its length over that of the short one, at least and at most.
    pub(super) ratio: [f64; 2],
}

/// A triangle's plane: from the screen to the plan, with derivatives.
struct Plane<'a> {
    view: &'a ViewFrame,
    corner: World,
    normal: DVec3,
    /// From the world to the plan: what of a displacement counts for each axis of the plan, and where the corner lies.
    axes: [DVec3; 2],
    plan: Plan,
}

impl<'a> Plane<'a> {
    fn new(view: &'a ViewFrame, triangle: &SurfaceTriangle) -> Self {
        let [a, b, c] = triangle.world;
        let (u, v) = (b - a, c - a);
        let normal = u.cross(v);
        let (axes, plan) = match &triangle.drape {
            TriangleDrape::Vertical => ([DVec3::X, DVec3::Y], a.plan()),
            TriangleDrape::Affine { plan: [p, q, r], .. } => {
                // Coordinates along both sides by the reciprocal vectors.
                let square = normal.length_squared();
                let (along_u, along_v) = (v.cross(normal) / square, normal.cross(u) / square);
                let (to_q, to_r) = (*q - *p, *r - *p);
                ([along_u * to_q.x + along_v * to_r.x, along_u * to_q.y + along_v * to_r.y], *p)
            }
        };
        Self { view, corner: a, normal, axes, plan }
    }

    fn in_plan(&self, way: DVec3) -> DVec2 {
        DVec2::new(self.axes[0].dot(way), self.axes[1].dot(way))
    }

    /// The point that a screen point sees, how a view depth more moves it along the ray, and how a pixel to the right and one down do.
    fn see(&self, at: Screen) -> Option<(World, DVec3, DMat2)> {
        let view = self.view;
        let (x, y) = (at.x - 0.5 * view.width() as f64, 0.5 * view.height() as f64 - at.y);
        let pixel = view.lens().pixel();
        let steps = [view.right() * pixel, -view.up() * pixel];
        let aside = view.right() * (x * pixel) + view.up() * (y * pixel);
        let (from, along, reach) = match view.lens() {
            Lens::Parallel { .. } => (view.eye() + aside, view.forward(), None),
            Lens::Central { .. } => (view.eye(), view.forward() + aside, Some(())),
        };
        let depth = self.normal.dot(self.corner - from) / self.normal.dot(along);
        let scale = if reach.is_some() { depth } else { 1.0 };
        // A step that leaves the plane is taken back along the ray.
        let moved = |step: DVec3| (step - along * (self.normal.dot(step) / self.normal.dot(along))) * scale;
        let [right, down] = steps.map(|step| self.in_plan(moved(step)));
        let turns = DMat2::from_cols(right, down);
        (depth.is_finite() && turns.is_finite()).then_some((from + along * depth, along, turns))
    }
}

/// A pixel's size at what a screen point sees of a triangle's plane, metres.
pub(super) fn pixel_m(view: &ViewFrame, triangle: &SurfaceTriangle, at: Screen) -> Option<f64> {
    let (world, ..) = Plane::new(view, triangle).see(at)?;
    Some(view.pixel_m(world))
}

/// What may stray.
#[derive(Clone, Copy)]
pub(super) struct Stray<'a> {
    /// Of a pixel on the screen, along each axis, pixels.
    pub(super) shift: f64,
    /// Of a view depth (metres) along its ray, metres.
    pub(super) along: &'a (dyn Fn(f64) -> f64 + Sync),
}

impl Look {
    /// What a pixel's centre that sees a triangle, somewhere in a box of the plan, reads; `None` where the triangle is seen edge-on.
    pub(super) fn of(
        view: &ViewFrame,
        texture: &Texture,
        (id, triangle): (u32, &SurfaceTriangle),
        (centre, plan, ground): (Screen, &PlanBox, PaintRange),
        stray: &Stray,
    ) -> Option<Self> {
        let plane = Plane::new(view, triangle);
        let (world, ray, turns) = plane.see(centre)?;
        let depth = view.depth(world);
        let point = plane.plan + plane.in_plan(world - plane.corner);
        let back = match triangle.drape {
            TriangleDrape::Vertical => ray.truncate() * (stray.along)(depth),
            // Interpolated, whatever the depth.
            TriangleDrape::Affine { .. } => DVec2::ZERO,
        };
        let size = world.to_vec().abs().max_element() + view.eye().to_vec().abs().max_element();
        let noise = SINGLE * size / texture.texel_m(0);
        let ways = [turns.x_axis * stray.shift, turns.y_axis * stray.shift, back];
        let mut look = Self {
            triangle: id,
            ground,
            at: texture.finest(point),
            ways: ways.map(|way| texture.way(way)),
            noise,
            longer: [f64::INFINITY, 0.0],
            long: [f64::INFINITY, 0.0],
            axis: DVec2::ZERO,
            axis_off: 0.0,
            ratio: [f64::INFINITY, 0.0],
        };
        look.narrow(texture, plan, texture.way(back));
        look.measure(texture, turns);
        // As the shifts have it, and as vertices in single precision do.
        let far = stray.shift;
        for (x, y) in [(-far, -far), (far, -far), (-far, far), (far, far)] {
            let (.., turns) = plane.see(Screen::new(centre.x + x, centre.y + y))?;
            look.measure(texture, turns);
        }
        let rounded = triangle.world.map(|p| {
            let single = |v: f64| f64::from(v as f32);
            World::new(single(p.x), single(p.y), single(p.z))
        });
        let single = Plane::new(view, &SurfaceTriangle { world: rounded, ..*triangle });
        look.measure(texture, single.see(centre)?.2);
        let [least, most] = look.ratio;
        let slack = RATIO * (1.0 + most);
        look.ratio = [least - slack, most + slack];
        look.axis_off += slack * look.axis.length() * turning(least);
        Some(look)
    }

    /// Where what may be seen is a smaller box than the ways lead to, as at silhouettes, the box.
    fn narrow(&mut self, texture: &Texture, plan: &PlanBox, back: DVec2) {
        if plan.is_empty() {
            return;
        }
        let middle = texture.finest(plan.min + (plan.max - plan.min) * 0.5);
        let half = texture.way((plan.max - plan.min) * 0.5).abs();
        let reach = |ways: &[DVec2; 3]| ways.iter().map(|way| way.abs().element_sum()).sum::<f64>();
        let boxed = [DVec2::new(half.x, 0.0), DVec2::new(0.0, half.y), back];
        if reach(&boxed) < reach(&self.ways) {
            (self.at, self.ways) = (middle, boxed);
        }
    }

    /// Takes a footprint into account; the first is the nominal one.
    fn measure(&mut self, texture: &Texture, turns: DMat2) {
        let [dx, dy] = [turns.x_axis, turns.y_axis].map(|way| texture.way(way));
        let around = |range: &mut [f64; 2], v: f64| {
            *range = [math::min(range[0], v), math::max(range[1], v)];
        };
        around(&mut self.longer, math::max(dx.length(), dy.length()));
        let (axis, short) = axes(dx, dy);
        around(&mut self.long, axis.length());
        if self.ratio[1] == 0.0 {
            self.axis = axis;
        }
        // Both directions of an axis are one.
        let off = math::min((axis - self.axis).length(), (axis + self.axis).length());
        self.axis_off = math::max(self.axis_off, off);
        let ratio = axis.length() / short;
        // Of zeros, as of a circle.
        let ratio = if ratio.is_nan() { 1.0 } else { ratio };
        around(&mut self.ratio, ratio);
    }
}

/// By how many times more than its matrix the direction of an ellipse's long axis may turn.
fn turning(ratio: f64) -> f64 {
    let square = ratio * ratio;
    math::min(square / math::max(square - 1.0, 1e-9), 1e6)
}

/// The long axis of the ellipse that two derivatives make of a circle, and the length of the short one.
fn axes(dx: DVec2, dy: DVec2) -> (DVec2, f64) {
    let (east, south, both) =
        (dx.x * dx.x + dy.x * dy.x, dx.y * dx.y + dy.y * dy.y, dx.x * dx.y + dy.x * dy.y);
    let half = 0.5 * (east - south);
    let root = (half * half + both * both).sqrt();
    let long = (0.5 * (east + south) + root).sqrt();
    let way = if half >= 0.0 { DVec2::new(half + root, both) } else { DVec2::new(both, root - half) };
    (way.try_normalize().unwrap_or(DVec2::X) * long, dx.perp_dot(dy).abs() / long)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Viewpoint;

    fn view() -> ViewFrame {
        let view = Viewpoint {
            eye: World::new(3.0, -40.0, 25.0),
            target: World::new(0.0, 0.0, 0.0),
            up: DVec3::Z,
            near: 1.0,
            far: f64::INFINITY,
        };
        ViewFrame::perspective(&view, 50.0, (64, 48)).unwrap()
    }

    #[test]
    fn derivatives_are_those_of_the_plan_point() {
        let view = view();
        let corners =
            [World::new(-20.0, -10.0, 1.0), World::new(25.0, -12.0, 3.0), World::new(0.0, 30.0, 8.0)];
        let plan = [Plan::new(1.0, 2.0), Plan::new(8.0, 3.0), Plan::new(2.0, 9.0)];
        let draped = TriangleDrape::Affine { plan, up: DVec3::Z };
        for drape in [TriangleDrape::Vertical, draped] {
            let plane = Plane::new(&view, &SurfaceTriangle { world: corners, drape });
            let place = |x: f64, y: f64| {
                let (world, ..) = plane.see(Screen::new(30.0 + x, 20.0 + y)).unwrap();
                plane.plan + plane.in_plan(world - plane.corner)
            };
            let (.., turns) = plane.see(Screen::new(30.0, 20.0)).unwrap();
            let step = 1e-4;
            let right = (place(step, 0.0) - place(-step, 0.0)) / (2.0 * step);
            let down = (place(0.0, step) - place(0.0, -step)) / (2.0 * step);
            assert!((right - turns.x_axis).length() < 1e-6 * right.length());
            assert!((down - turns.y_axis).length() < 1e-6 * down.length());
        }
        let (world, ..) =
            Plane::new(&view, &SurfaceTriangle::vertical(corners)).see(Screen::new(32.0, 24.0)).unwrap();
        assert!((view.screen_from_world(world).unwrap() - Screen::new(32.0, 24.0)).length() < 1e-9);
    }

    #[test]
    fn axes_are_those_of_the_ellipse() {
        let (axis, short) = axes(DVec2::new(1.0, 0.0), DVec2::new(1.0, 1.0));
        let golden = 0.5 * (1.0 + 5f64.sqrt());
        assert!((axis.length() - golden).abs() < 1e-12 && (short - 1.0 / golden).abs() < 1e-12);
        let (axis, short) = axes(DVec2::new(0.0, 3.0), DVec2::new(2.0, 0.0));
        assert!((axis.abs() - DVec2::new(0.0, 3.0)).length() < 1e-12 && (short - 2.0).abs() < 1e-12);
    }
}
