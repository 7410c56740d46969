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

    /// What remains of a segment; its direction stays. An end behind the eye is cut off first: what remains lies before it.
    pub(super) fn clip_segment(&self, [mut a, mut b]: [Clip<T>; 2]) -> Option<[Clip<T>; 2]> {
        if ![a, b].iter().flat_map(|end| end.to_array()).all(|v| v.get().is_finite()) {
            return None;
        }
        for plane in Plane::ALL {
            match (self.is_inside(plane, a), self.is_inside(plane, b)) {
                (true, true) => {}
                (true, false) => b = self.before_the_eye(self.crossing(plane, a, b)),
                (false, true) => a = self.before_the_eye(self.crossing(plane, b, a)),
                (false, false) => return None,
            }
        }
        Some([a, b])
    }

    /// A crossing whose w rounding has not put behind the eye, where the picture would be mirrored.
    fn before_the_eye(&self, crossing: Clip<T>) -> Clip<T> {
        let w = if crossing.w < self.least_w { self.least_w } else { crossing.w };
        Clip { w, ..crossing }
    }

    /// Where an edge leaves: always from its inner end, so that the two triangles of a shared edge find the same point.
    fn crossing(&self, plane: Plane, inside: Clip<T>, outside: Clip<T>) -> Clip<T> {
        let (d, e) = (self.distance(plane, inside), self.distance(plane, outside));
        let t = d / (d - e);
        let (from, to) = (inside.to_array(), outside.to_array());
        Clip::from_array([0, 1, 2, 3].map(|k| from[k] + (to[k] - from[k]) * t))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::{Viewpoint, World};
    use glam::DVec3;

    fn volume<T: Real>() -> Volume<T> {
        let (eye, target) = (World::new(0.0, 0.0, 0.0), World::new(0.0, 1.0, 0.0));
        let view = Viewpoint { eye, target, up: DVec3::Z, near: 1.0, far: f64::INFINITY };
        Volume::new(&ViewFrame::perspective(&view, 60.0, (64, 64)).unwrap(), true)
    }

    fn lies_before_the_eye<T: Real>() {
        let volume = volume::<T>();
        let clip = |[x, y, w]: [f64; 3]| Clip { x, y, z: 1.0, w }.to_array().map(T::of);
        let mut left = 0;
        for power in 0..36 {
            let far = f64::from(1u32 << (power % 18)) * f64::from(1u32 << (power / 2));
            for behind in [0.5, 0.0, -3.0, -1e3, -1e7] {
                for x in [-0.3, 0.0, 0.7] {
                    let ends =
                        [[x * far, far / 3.0, far], [x, 0.0, behind]].map(|p| Clip::from_array(clip(p)));
                    for ends in [ends, [ends[1], ends[0]]] {
                        let Some(rest) = volume.clip_segment(ends) else { continue };
                        left += 1;
                        assert!(rest.iter().all(|end| end.w >= volume.least_w), "{ends:?} becomes {rest:?}");
                    }
                }
            }
        }
        assert!(left > 500, "{left}");
    }

    #[test]
    fn what_remains_of_a_segment_lies_before_the_eye_however_much_is_rounded() {
        lies_before_the_eye::<f64>();
        lies_before_the_eye::<f32>();
    }

    #[test]
    fn a_segment_keeps_its_direction_and_its_inner_end() {
        let volume = volume::<f64>();
        let inner = Clip { x: 0.0, y: 0.0, z: 1.0, w: 5.0 };
        let outer = Clip { x: 0.0, y: 2.0, z: 1.0, w: -3.0 };
        // From w = 5 to the near plane's w = z = 1: half of the way.
        let crossing = Clip { x: 0.0, y: 1.0, z: 1.0, w: 1.0 };
        let close = |a: Clip<f64>, b: Clip<f64>| {
            a.to_array().iter().zip(b.to_array()).all(|(a, b)| (a - b).abs() < 1e-12)
        };
        let [a, b] = volume.clip_segment([inner, outer]).unwrap();
        assert!(a == inner && close(b, crossing), "{b:?}");
        let [a, b] = volume.clip_segment([outer, inner]).unwrap();
        assert!(b == inner && close(a, crossing), "{a:?}");
        assert!(volume.clip_segment([inner, inner]).is_some_and(|rest| rest == [inner, inner]));
        assert!(volume.clip_segment([outer, outer]).is_none());
    }
}
