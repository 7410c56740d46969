//! The maps between world, view and screen, and the ray of each screen point.

use super::{PlanBox, Screen, View, World};
use crate::error::{Error, Result};
use crate::math;
use glam::DVec3;

/// How rays run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Lens {
    /// All through the eye (perspective). `pixel` is a pixel's size at view depth 1.
    Central {
        /// Size of a pixel at view depth 1 (no unit).
        pixel: f64,
    },
    /// All along the view direction (orthographic). `pixel` is a pixel's size in metres.
    Parallel {
        /// Size of a pixel in metres.
        pixel: f64,
    },
}

impl Lens {
    /// A pixel's size: at view depth 1 (central) or everywhere (parallel).
    #[inline(always)]
    pub fn pixel(self) -> f64 {
        match self {
            Self::Central { pixel } | Self::Parallel { pixel } => pixel,
        }
    }
}

/// The line of sight of a screen point, *defined* as the straight line through two points whose coordinates are the
/// stored doubles. Every exact decision is about this line, so that there is one right answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// The eye (perspective) or the point of the eye's plane (orthographic).
    pub from: World,
    /// A second point, `reach` times the unit view depth farther on.
    pub through: World,
}

/// Where the camera stands and how it maps the world to the screen.
///
/// # Guarantees
/// `right`, `up` and `forward` are finite, of unit length and perpendicular up to rounding; pixel size and near plane are
/// finite and positive; the image has at least one pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewFrame {
    eye: World,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    lens: Lens,
    width: f64,
    height: f64,
    near: f64,
    far: f64,
    reach: f64,
    origin: DVec3,
}

/// What a [`ViewFrame`] is made of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Viewpoint {
    /// The eye.
    pub eye: World,
    /// A point in the middle of the picture.
    pub target: World,
    /// What is up in the picture.
    pub up: DVec3,
    /// Nothing nearer is seen (view depth, metres).
    pub near: f64,
    /// Nothing farther is seen (view depth, metres); infinite: no limit.
    pub far: f64,
}

impl ViewFrame {
    /// The frame of a perspective picture; `fov_y_deg` is the whole vertical angle.
    ///
    /// # Errors
    /// When the eye is the target, `up` is parallel to the view, or a number is out of range.
    pub fn perspective(view: &Viewpoint, fov_y_deg: f64, size: (usize, usize)) -> Result<Self> {
        if !(fov_y_deg > 0.0 && fov_y_deg < 180.0) {
            return Err(Error::new(format!("a vertical field of view of {fov_y_deg} degrees shows nothing"))
                .help("use an angle between 0 and 180, such as 45"));
        }
        let tangent = math::tan(fov_y_deg.to_radians() / 2.0);
        Self::new(view, Lens::Central { pixel: 2.0 * tangent / size.1 as f64 }, size)
    }

    /// The frame of an orthographic picture `height_m` metres high.
    ///
    /// # Errors
    /// As [`ViewFrame::perspective`].
    pub fn orthographic(view: &Viewpoint, height_m: f64, size: (usize, usize)) -> Result<Self> {
        Self::new(view, Lens::Parallel { pixel: height_m / size.1 as f64 }, size)
    }

    fn new(view: &Viewpoint, lens: Lens, (width, height): (usize, usize)) -> Result<Self> {
        let refuse = |what: &str, help: &str| Err(Error::new(what).help(help));
        if !(view.eye.is_finite() && view.target.is_finite() && view.up.is_finite()) {
            return refuse("the camera's eye, target or up is not finite", "use plain numbers");
        }
        if width == 0 || height == 0 || !(lens.pixel() > 0.0 && lens.pixel().is_finite()) {
            return refuse("the picture has no pixels or no extent", "give width, height and extent above 0");
        }
        if !(view.near > 0.0 && view.near.is_finite() && view.far > view.near) {
            return refuse("the near plane must lie between 0 and the far plane", "use near_m = 1.0");
        }
        let Some(forward) = (view.target - view.eye).try_normalize() else {
            return refuse("the camera's eye is its target", "move eye or target");
        };
        let Some(right) = view.up.try_normalize().map(|up| forward.cross(up)).filter(|r| r.length() > 1e-9)
        else {
            return refuse(
                "the camera looks along its own up direction",
                "give another `up`, such as [0, 1, 0]",
            );
        };
        let right = right.normalize();
        let up = right.cross(forward).normalize();
        let reach = power_of_two_above(view.eye.to_vec().abs().max_element());
        let (width, height, near, far) = (width as f64, height as f64, view.near, view.far);
        Ok(Self {
            eye: view.eye,
            right,
            up,
            forward,
            lens,
            width,
            height,
            near,
            far,
            reach,
            origin: DVec3::ZERO,
        })
    }

    /// The frame of a world whose local zero has these absolute coordinates: nothing is seen elsewhere, but an imitated machine may calculate with absolute ones.
    #[must_use]
    pub fn with_origin(self, origin: DVec3) -> Self {
        Self { origin, ..self }
    }

    /// The absolute coordinates of local zero; 0 where nobody said.
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// The eye.
    pub fn eye(&self) -> World {
        self.eye
    }
    /// The direction of screen x.
    pub fn right(&self) -> DVec3 {
        self.right
    }
    /// The direction against screen y.
    pub fn up(&self) -> DVec3 {
        self.up
    }
    /// The direction of view depth.
    pub fn forward(&self) -> DVec3 {
        self.forward
    }
    /// How rays run.
    pub fn lens(&self) -> Lens {
        self.lens
    }
    /// A pixel's size at a point, metres: grows with the distance from the eye in space (perspective), or is the same everywhere.
    pub fn pixel_m(&self, at: World) -> f64 {
        match self.lens {
            Lens::Central { pixel } => pixel * (at - self.eye).length(),
            Lens::Parallel { pixel } => pixel,
        }
    }
    /// The nearest view depth that is seen.
    pub fn near(&self) -> f64 {
        self.near
    }
    /// The farthest view depth that is seen (infinite by default).
    pub fn far(&self) -> f64 {
        self.far
    }
    /// The image's width in pixels.
    pub fn width(&self) -> usize {
        self.width as usize
    }
    /// The image's height in pixels.
    pub fn height(&self) -> usize {
        self.height as usize
    }
    /// The frame of a picture with so many more pixels at each border, which sees the same in the others.
    #[must_use]
    pub fn with_border(&self, pixels: usize) -> Self {
        let more = 2.0 * pixels as f64;
        Self { width: self.width + more, height: self.height + more, ..*self }
    }
    /// View depth of [`Ray::through`] from [`Ray::from`], metres.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// The offset of a screen point from the image's centre, in pixels, x right and y *up*.
    #[inline(always)]
    fn offset(&self, at: Screen) -> (f64, f64) {
        (at.x - self.width / 2.0, self.height / 2.0 - at.y)
    }

    /// The line of sight of a screen point.
    #[inline(always)]
    pub fn ray(&self, at: Screen) -> Ray {
        let (x, y) = self.offset(at);
        match self.lens {
            Lens::Central { pixel } => {
                let direction = self.forward + self.right * (x * pixel) + self.up * (y * pixel);
                Ray { from: self.eye, through: self.eye + direction * self.reach }
            }
            Lens::Parallel { pixel } => {
                let from = self.eye + (self.right * (x * pixel) + self.up * (y * pixel));
                Ray { from, through: from + self.forward * self.reach }
            }
        }
    }

    /// `view_from_world`: right, up, towards the viewer.
    #[inline]
    pub fn view_from_world(&self, p: World) -> View {
        let c = p - self.eye;
        View::new(self.right.dot(c), self.up.dot(c), -self.forward.dot(c))
    }

    /// View depth (distance along the view direction) of a point, metres.
    #[inline]
    pub fn depth(&self, p: World) -> f64 {
        self.forward.dot(p - self.eye)
    }

    /// `screen_from_world`; `None` at or behind the eye's plane of a central lens.
    #[inline]
    pub fn screen_from_world(&self, p: World) -> Option<Screen> {
        let v = self.view_from_world(p);
        let scale = match self.lens {
            Lens::Central { .. } if v.z >= 0.0 => return None,
            Lens::Central { pixel } => 1.0 / (-v.z * pixel),
            Lens::Parallel { pixel } => 1.0 / pixel,
        };
        Some(Screen::new(self.width / 2.0 + v.x * scale, self.height / 2.0 - v.y * scale))
    }

    /// The homogeneous pixel coordinates (x, y, w) of a displacement: linear, so that a point's are those of
    /// its displacement from the eye plus [`ViewFrame::homogeneous_eye`]; the screen point is (x / w, y / w).
    #[inline(always)]
    pub fn homogeneous(&self, d: DVec3) -> DVec3 {
        let depth = self.forward.dot(d);
        let (x, y) = (self.right.dot(d) / self.lens.pixel(), -self.up.dot(d) / self.lens.pixel());
        match self.lens {
            Lens::Central { .. } => {
                DVec3::new(x + self.width / 2.0 * depth, y + self.height / 2.0 * depth, depth)
            }
            Lens::Parallel { .. } => DVec3::new(x, y, 0.0),
        }
    }

    /// The homogeneous pixel coordinates of the eye itself (the constant part).
    #[inline(always)]
    pub fn homogeneous_eye(&self) -> DVec3 {
        match self.lens {
            Lens::Central { .. } => DVec3::ZERO,
            Lens::Parallel { .. } => DVec3::new(self.width / 2.0, self.height / 2.0, 1.0),
        }
    }

    /// A view from the south at 35 degrees that frames a box of the plan: the default camera's eye and target.
    pub fn framing(plan: &PlanBox, (low, high): (f64, f64), fov_y_deg: f64, aspect: f64) -> (World, World) {
        let middle = (plan.min.to_vec() + plan.max.to_vec()) / 2.0;
        let size = plan.max - plan.min;
        let span = math::max(math::max(size.x / aspect, size.y * 0.75), high - low);
        let distance = 1.0 + 0.62 * span / math::tan(fov_y_deg.to_radians() / 2.0);
        let tilt = 35f64.to_radians();
        let target = World::new(middle.x, middle.y, (low + high) / 2.0);
        let back = DVec3::new(0.0, -math::cos(tilt), math::sin(tilt)) * distance;
        (target + back, target)
    }
}

/// The smallest power of two that is at least `x` and at least 1.
fn power_of_two_above(x: f64) -> f64 {
    let mut power = 1.0;
    while power < x {
        power *= 2.0;
    }
    power
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame() -> ViewFrame {
        let view = Viewpoint {
            eye: World::new(10.0, -20.0, 5.0),
            target: World::new(0.0, 0.0, 0.0),
            up: DVec3::Z,
            near: 0.1,
            far: f64::INFINITY,
        };
        ViewFrame::perspective(&view, 50.0, (640, 480)).unwrap()
    }

    #[test]
    fn the_target_is_in_the_middle_of_the_picture() {
        let at = frame().screen_from_world(World::new(0.0, 0.0, 0.0)).unwrap();
        assert!((at.x - 320.0).abs() < 1e-9 && (at.y - 240.0).abs() < 1e-9, "{at:?}");
    }

    #[test]
    fn a_ray_meets_the_screen_point_it_was_made_for() {
        let frame = frame();
        let ray = frame.ray(Screen::new(17.25, 400.5));
        let at = frame.screen_from_world(ray.through).unwrap();
        assert!((at.x - 17.25).abs() < 1e-9 && (at.y - 400.5).abs() < 1e-9, "{at:?}");
        let h = frame.homogeneous(ray.through - frame.eye()) + frame.homogeneous_eye();
        assert!((h.x / h.z - 17.25).abs() < 1e-9 && (h.y / h.z - 400.5).abs() < 1e-9, "{h:?}");
    }

    #[test]
    fn a_camera_that_looks_along_up_is_refused() {
        let view = Viewpoint {
            eye: World::new(0.0, 0.0, 10.0),
            target: World::new(0.0, 0.0, 0.0),
            up: DVec3::Z,
            near: 1.0,
            far: f64::INFINITY,
        };
        let error = ViewFrame::perspective(&view, 50.0, (4, 4)).unwrap_err();
        assert!(error.to_string().contains("up"), "{error}");
    }
}
