//! Points and the camera in the numbers of the device.

use crate::raster::device::Real;
use crate::space::{Lens, Plan, ViewFrame, World};
use glam::DVec3;

/// A point or a displacement of the plan or the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct P2<T> {
    /// First coordinate.
    pub x: T,
    /// Second coordinate.
    pub y: T,
}

/// A point or a displacement of the world or of view space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct P3<T> {
    /// First coordinate.
    pub x: T,
    /// Second coordinate.
    pub y: T,
    /// Third coordinate.
    pub z: T,
}

impl<T: Real> P2<T> {
    /// From another point to this one.
    #[inline(always)]
    pub fn minus(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }

    /// The sum.
    #[inline(always)]
    pub fn plus(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }

    /// So many times.
    #[inline(always)]
    pub fn times(self, by: T) -> Self {
        Self { x: self.x * by, y: self.y * by }
    }

    /// The scalar product.
    #[inline(always)]
    pub fn dot(self, other: Self) -> T {
        self.x * other.x + self.y * other.y
    }

    /// The product that is positive where `other` lies to the left.
    #[inline(always)]
    pub fn cross(self, other: Self) -> T {
        self.x * other.y - self.y * other.x
    }

    /// Turned left by a right angle.
    #[inline(always)]
    pub fn left(self) -> Self {
        Self { x: T::of(0.0) - self.y, y: self.x }
    }

    /// Of length 1; `None` for one of no length.
    #[inline(always)]
    pub fn normalized(self) -> Option<Self> {
        let length = self.dot(self).sqrt();
        (length > T::of(0.0)).then(|| Self { x: self.x / length, y: self.y / length })
    }

    /// In doubles.
    #[inline(always)]
    pub fn get(self) -> Plan {
        Plan::new(self.x.get(), self.y.get())
    }
}

impl<T: Real> P3<T> {
    /// A point of the world.
    #[inline(always)]
    pub fn of(p: World) -> Self {
        Self::of_vec(p.to_vec())
    }

    fn of_vec(v: DVec3) -> Self {
        Self { x: T::of(v.x), y: T::of(v.y), z: T::of(v.z) }
    }

    /// The plan point below.
    #[inline(always)]
    pub fn plan(self) -> P2<T> {
        P2 { x: self.x, y: self.y }
    }

    /// In doubles.
    #[inline(always)]
    pub fn get(self) -> World {
        World::new(self.x.get(), self.y.get(), self.z.get())
    }

    /// From another point to this one.
    #[inline(always)]
    pub fn minus(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }

    /// The scalar product.
    #[inline(always)]
    pub fn dot(self, other: Self) -> T {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// The point at a share of the way to another one.
    #[inline(always)]
    pub fn towards(self, to: Self, share: T) -> Self {
        let d = to.minus(self);
        Self { x: self.x + d.x * share, y: self.y + d.y * share, z: self.z + d.z * share }
    }
}

/// A view in the numbers of the device.
#[derive(Debug, Clone, Copy)]
pub struct Camera<T> {
    eye: P3<T>,
    axes: [P3<T>; 3],
    pixel: T,
    half: P2<T>,
    size: P2<T>,
    depths: [T; 2],
    is_central: bool,
}

impl<T: Real> Camera<T> {
    /// Of a view.
    pub fn new(view: &ViewFrame) -> Self {
        let [width, height] = [view.width(), view.height()].map(|size| size as f64);
        Self {
            eye: P3::of(view.eye()),
            axes: [view.right(), view.up(), view.forward()].map(P3::of_vec),
            pixel: T::of(view.lens().pixel()),
            half: P2 { x: T::of(width / 2.0), y: T::of(height / 2.0) },
            size: P2 { x: T::of(width), y: T::of(height) },
            depths: [T::of(view.near()), T::of(view.far())],
            is_central: matches!(view.lens(), Lens::Central { .. }),
        }
    }

    /// A point as it is seen: to the right, up, and view depth.
    #[inline(always)]
    pub fn view(&self, p: P3<T>) -> P3<T> {
        let d = p.minus(self.eye);
        let [x, y, z] = self.axes.map(|axis| axis.dot(d));
        P3 { x, y, z }
    }

    /// Whether a point of view space lies beyond the near plane.
    #[inline(always)]
    pub fn is_before(&self, seen: P3<T>) -> bool {
        seen.z >= self.depths[0]
    }

    /// Where a way through view space crosses the near plane.
    #[inline(always)]
    pub fn at_near(&self, from: P3<T>, to: P3<T>) -> P3<T> {
        let share = (self.depths[0] - from.z) / (to.z - from.z);
        P3 { z: self.depths[0], ..from.towards(to, share) }
    }

    /// The screen point of a point of view space before the eye, pixels.
    #[inline(always)]
    pub fn screen(&self, seen: P3<T>) -> P2<T> {
        let scale = if self.is_central { seen.z * self.pixel } else { self.pixel };
        P2 { x: self.half.x + seen.x / scale, y: self.half.y - seen.y / scale }
    }

    /// Whether a point of view space lies in the view's frustum.
    #[inline(always)]
    pub fn is_inside(&self, seen: P3<T>) -> bool {
        let zero = T::of(0.0);
        if !(self.is_before(seen) && seen.z < self.depths[1]) {
            return false;
        }
        let at = self.screen(seen);
        at.x >= zero && at.y >= zero && at.x <= self.size.x && at.y <= self.size.y
    }

    /// The size of a pixel at a point, metres: the view-dependent scale factor. Eq. 4.2 has dist(p, c) * tan(FOV_min / 2), in units of half the
    /// picture's shorter side; Eq. 4.1 one number for the whole view. Widths in pixels make the unit a pixel.
    #[inline(always)]
    pub fn pixel_at(&self, p: P3<T>) -> T {
        if !self.is_central {
            return self.pixel;
        }
        let d = p.minus(self.eye);
        self.pixel * d.dot(d).sqrt()
    }

    /// The size of a pixel at distance 1, or everywhere.
    pub fn pixel(&self) -> T {
        self.pixel
    }

    /// The eye, where pixels grow with the distance from it.
    pub fn eye(&self) -> Option<P3<T>> {
        self.is_central.then_some(self.eye)
    }
}
