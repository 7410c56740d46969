//! The spaces of `docs/semantics.md` as types, so that points of two spaces cannot be mixed.
//!
//! ```text
//!   plan / world                     view                      screen
//!     north (y)                        up (y)                   (0,0)-----> x
//!       ^   up (z)                       ^                        |
//!       |  /                             |                        |   pixel (i, j) has its
//!       | /                              +-----> right (x)        v   centre at (i + 1/2, j + 1/2)
//!       +-------> east (x)              /                         y
//!                                      v  towards the viewer (z): the camera looks down -z
//! ```
//!
//! Plan and world coordinates in memory are relative to the scene's origin (see [`crate::scene::Scene::origin`]),
//! so that coordinates of UTM or ECEF size lose nothing.
//!
//! Between view and screen lies [`Clip`] space, homogeneous and in the numbers of the machine that is imitated.
//!
//! Points of two spaces do not subtract:
//! ```compile_fail
//! use drapery::space::{Plan, Screen};
//! let _ = Plan::new(0.0, 0.0) - Screen::new(1.0, 1.0);
//! ```
//! Points of one space do not add, displacements do:
//! ```compile_fail
//! use drapery::space::Plan;
//! let _ = Plan::new(0.0, 0.0) + Plan::new(1.0, 1.0);
//! ```

mod clip;
mod disc;
mod ellipsoid;
mod globe;
mod small_box;
mod view;

pub use clip::Clip;
pub use disc::{DISC_CORNERS, disc_corners};
pub use ellipsoid::Ellipsoid;
pub use globe::Globe;
pub use small_box::SmallBox;
pub use view::{Lens, Ray, ViewFrame, Viewpoint};

use glam::{DVec2, DVec3};
use std::fmt;
use std::ops::{Add, Sub};

macro_rules! point_2d {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Default)]
        pub struct $name {
            /// First coordinate.
            pub x: f64,
            /// Second coordinate.
            pub y: f64,
        }

        impl $name {
            /// The point with these coordinates.
            #[inline(always)]
            pub const fn new(x: f64, y: f64) -> Self {
                Self { x, y }
            }

            /// The displacement from the space's zero point.
            #[inline(always)]
            pub const fn to_vec(self) -> DVec2 {
                DVec2::new(self.x, self.y)
            }

            /// Whether both coordinates are finite.
            #[inline]
            pub fn is_finite(self) -> bool {
                self.x.is_finite() && self.y.is_finite()
            }
        }

        impl From<DVec2> for $name {
            #[inline(always)]
            fn from(v: DVec2) -> Self {
                Self::new(v.x, v.y)
            }
        }

        impl Sub for $name {
            type Output = DVec2;
            #[inline(always)]
            fn sub(self, other: Self) -> DVec2 {
                DVec2::new(self.x - other.x, self.y - other.y)
            }
        }

        impl fmt::Display for $name {
            /// Both coordinates with the precision asked for.
            fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("(")?;
                fmt::Display::fmt(&self.x, f)?;
                f.write_str(", ")?;
                fmt::Display::fmt(&self.y, f)?;
                f.write_str(")")
            }
        }

        impl Add<DVec2> for $name {
            type Output = Self;
            #[inline(always)]
            fn add(self, by: DVec2) -> Self {
                Self::new(self.x + by.x, self.y + by.y)
            }
        }
    };
}

macro_rules! point_3d {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Default)]
        pub struct $name {
            /// First coordinate.
            pub x: f64,
            /// Second coordinate.
            pub y: f64,
            /// Third coordinate.
            pub z: f64,
        }

        impl $name {
            /// The point with these coordinates.
            #[inline(always)]
            pub const fn new(x: f64, y: f64, z: f64) -> Self {
                Self { x, y, z }
            }

            /// The displacement from the space's zero point.
            #[inline(always)]
            pub const fn to_vec(self) -> DVec3 {
                DVec3::new(self.x, self.y, self.z)
            }

            /// Whether all coordinates are finite.
            #[inline]
            pub fn is_finite(self) -> bool {
                self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
            }
        }

        impl From<DVec3> for $name {
            #[inline(always)]
            fn from(v: DVec3) -> Self {
                Self::new(v.x, v.y, v.z)
            }
        }

        impl Sub for $name {
            type Output = DVec3;
            #[inline(always)]
            fn sub(self, other: Self) -> DVec3 {
                DVec3::new(self.x - other.x, self.y - other.y, self.z - other.z)
            }
        }

        impl Add<DVec3> for $name {
            type Output = Self;
            #[inline(always)]
            fn add(self, by: DVec3) -> Self {
                Self::new(self.x + by.x, self.y + by.y, self.z + by.z)
            }
        }
    };
}

point_2d! {
    /// The 2D vector plane: metres east and north, relative to the scene's origin.
    Plan
}
point_2d! {
    /// A level of a texture over the plan: texels, (0, 0) the north-west corner, x east, y south; texel (i, j) has its centre at
    /// (i + 1/2, j + 1/2).
    Texel
}
point_3d! {
    /// Plan and height in metres, z up, relative to the scene's origin.
    World
}
point_3d! {
    /// The camera's space: origin at the eye, x right, y up, looking down -z; metres.
    View
}
point_2d! {
    /// The image: pixels, (0, 0) the top-left corner, y down; pixel (i, j) has its centre at (i + 1/2, j + 1/2).
    Screen
}

impl World {
    /// The plan point straight below: that of a surface point where draping is vertical (see [`crate::terrain::Drape`]).
    #[inline(always)]
    pub const fn plan(self) -> Plan {
        Plan::new(self.x, self.y)
    }
}

impl From<World> for Plan {
    /// The plan point straight below.
    #[inline(always)]
    fn from(p: World) -> Self {
        p.plan()
    }
}

/// An axis-aligned rectangle of the plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanBox {
    /// The south-west corner.
    pub min: Plan,
    /// The north-east corner.
    pub max: Plan,
}

impl PlanBox {
    /// The box that contains nothing.
    pub const EMPTY: Self = Self {
        min: Plan::new(f64::INFINITY, f64::INFINITY),
        max: Plan::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// The smallest box around some points.
    pub fn around(points: impl IntoIterator<Item = Plan>) -> Self {
        let mut all = Self::EMPTY;
        for p in points {
            all.include(p);
        }
        all
    }

    /// Grows to contain `p`.
    #[inline]
    pub fn include(&mut self, p: Plan) {
        self.min = Plan::new(crate::math::min(p.x, self.min.x), crate::math::min(p.y, self.min.y));
        self.max = Plan::new(crate::math::max(p.x, self.max.x), crate::math::max(p.y, self.max.y));
    }

    /// Grows to contain another box; an empty one changes nothing.
    pub fn include_box(&mut self, other: &Self) {
        if !other.is_empty() {
            self.include(other.min);
            self.include(other.max);
        }
    }

    /// What both contain.
    #[must_use]
    pub fn common(&self, other: &Self) -> Self {
        use crate::math::{max, min};
        Self {
            min: Plan::new(max(self.min.x, other.min.x), max(self.min.y, other.min.y)),
            max: Plan::new(min(self.max.x, other.max.x), min(self.max.y, other.max.y)),
        }
    }

    /// Whether it contains nothing.
    pub fn is_empty(&self) -> bool {
        !(self.min.x <= self.max.x && self.min.y <= self.max.y)
    }

    /// Whether two boxes share a point.
    #[inline]
    pub fn meets(&self, other: &Self) -> bool {
        self.min.x <= other.max.x
            && other.min.x <= self.max.x
            && self.min.y <= other.max.y
            && other.min.y <= self.max.y
    }

    /// Whether another box lies wholly in this one.
    #[inline]
    pub fn contains(&self, other: &Self) -> bool {
        self.min.x <= other.min.x
            && other.max.x <= self.max.x
            && self.min.y <= other.min.y
            && other.max.y <= self.max.y
    }

    /// The box grown by a margin in metres on each side.
    #[must_use]
    pub fn grown(&self, margin: f64) -> Self {
        Self { min: self.min + DVec2::splat(-margin), max: self.max + DVec2::splat(margin) }
    }
}
