//! Triangles cut at the near plane, the far plane and the guard band, in clip space.

use super::number::Real;
use crate::space::{Clip, Lens, ViewFrame};

/// The guard band's least reach from the picture's middle, in pixels.
const GUARD: f64 = 65_536.0;

/// The planes that clip.
#[derive(Debug, Clone)]
pub(super) struct Volume<T> {
    /// w is at least this. Rounding may put the near plane behind the eye: the division still stays finite.
    least_w: T,
    /// |x| and |y| are at most these times w.
    guard: [T; 2],
    is_reversed: bool,
    is_far_finite: bool,
}

#[derive(Debug, Clone, Copy)]
enum Plane {
    Eye,
    Near,
    Far,
    Left,
    Right,
    Bottom,
    Top,
}

impl Plane {
    const ALL: [Self; 7] =
        [Self::Eye, Self::Near, Self::Far, Self::Left, Self::Right, Self::Bottom, Self::Top];
}

impl<T: Real> Volume<T> {
    pub(super) fn new(frame: &ViewFrame, is_reversed: bool) -> Self {
        let least_w = match frame.lens() {
            Lens::Central { .. } => frame.near() / 256.0,
            Lens::Parallel { .. } => 1.0,
        };
        let guard = [frame.width(), frame.height()]
            .map(|size| crate::math::max(2.0, GUARD / (size as f64 / 2.0)))
            .map(T::of);
        Self { least_w: T::of(least_w), guard, is_reversed, is_far_finite: frame.far().is_finite() }
    }

    /// Positive inside, 0 on the plane.
    fn distance(&self, plane: Plane, Clip { x, y, z, w }: Clip<T>) -> T {
        match plane {
            Plane::Eye => w - self.least_w,
            Plane::Near if self.is_reversed => w - z,
            Plane::Near => z,
            Plane::Far if !self.is_far_finite => T::of(1.0),
            Plane::Far if self.is_reversed => z,
            Plane::Far => w - z,
            Plane::Left => self.guard[0] * w + x,
            Plane::Right => self.guard[0] * w - x,
            Plane::Bottom => self.guard[1] * w + y,
            Plane::Top => self.guard[1] * w - y,
        }
    }

    fn is_inside(&self, plane: Plane, corner: Clip<T>) -> bool {
        self.distance(plane, corner) >= T::of(0.0)
    }

    /// Calls `emit` with the triangles of what remains of one; `is_clamped`: the near and the far plane clip nothing.
    pub(super) fn clip(&self, triangle: &[Clip<T>; 3], is_clamped: bool, mut emit: impl FnMut([Clip<T>; 3])) {
        if !triangle.iter().flat_map(|corner| corner.to_array()).all(|v| v.get().is_finite()) {
            return;
        }
        let is_off = |plane: Plane| is_clamped && matches!(plane, Plane::Near | Plane::Far);
        let inside = Plane::ALL
            .map(|plane| triangle.iter().filter(|&&c| is_off(plane) || self.is_inside(plane, c)).count());
        if inside.contains(&0) {
            return;
        }
        if inside == [3; 7] {
            return emit(*triangle);
        }
        let mut polygon = triangle.to_vec();
        for plane in Plane::ALL.into_iter().filter(|plane| !is_off(*plane)) {
            polygon = self.cut(plane, &polygon);
        }
        for k in 2..polygon.len() {
            emit([polygon[0], polygon[k - 1], polygon[k]]);
        }
    }

    /// What lies inside one plane (Sutherland & Hodgman 1974, "Reentrant polygon clipping").
    fn cut(&self, plane: Plane, polygon: &[Clip<T>]) -> Vec<Clip<T>> {
        let mut out = Vec::with_capacity(polygon.len() + 1);
        for (k, &a) in polygon.iter().enumerate() {
            let b = polygon[(k + 1) % polygon.len()];
            if self.is_inside(plane, a) {
                out.push(a);
            }
            match (self.is_inside(plane, a), self.is_inside(plane, b)) {
                (true, false) => out.push(self.crossing(plane, a, b)),
                (false, true) => out.push(self.crossing(plane, b, a)),
                _ => {}
            }
        }
        out
    }

    /// Where an edge leaves: always from its inner end, so that the two triangles of a shared edge find the same point.
    fn crossing(&self, plane: Plane, inside: Clip<T>, outside: Clip<T>) -> Clip<T> {
        let (d, e) = (self.distance(plane, inside), self.distance(plane, outside));
        let t = d / (d - e);
        let (from, to) = (inside.to_array(), outside.to_array());
        Clip::from_array([0, 1, 2, 3].map(|k| from[k] + (to[k] - from[k]) * t))
    }
}
