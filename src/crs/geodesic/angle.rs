//! Angles as their sines and cosines, which stay exact where an angle in radians would round: at poles and antipodes.

use crate::math::{atan2, cos, hypot, sin};

/// An angle; its sine and cosine have the length 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Angle {
    pub(super) sin: f64,
    pub(super) cos: f64,
}

impl Angle {
    /// The direction of a point off the origin.
    pub(super) fn towards(sin: f64, cos: f64) -> Self {
        let length = hypot(sin, cos);
        Self { sin: sin / length, cos: cos / length }
    }

    pub(super) fn of_radians(x: f64) -> Self {
        Self { sin: sin(x), cos: cos(x) }
    }

    /// Of degrees; exact at whole right angles.
    pub(super) fn of_degrees(x: f64) -> Self {
        let quarters = (x / 90.0).round();
        let rest = Self::of_radians((x - 90.0 * quarters).to_radians());
        match quarters.rem_euclid(4.0) as u8 {
            0 => rest,
            1 => Self { sin: rest.cos, cos: -rest.sin },
            2 => Self { sin: -rest.sin, cos: -rest.cos },
            _ => Self { sin: -rest.cos, cos: rest.sin },
        }
    }

    pub(super) fn radians(self) -> f64 {
        atan2(self.sin, self.cos)
    }

    pub(super) fn plus(self, other: Self) -> Self {
        Self {
            sin: self.sin * other.cos + self.cos * other.sin,
            cos: self.cos * other.cos - self.sin * other.sin,
        }
    }

    pub(super) fn minus(self, other: Self) -> Self {
        self.plus(Self { sin: -other.sin, cos: other.cos })
    }

    /// The sine and cosine of twice the angle.
    pub(super) fn doubled(self) -> (f64, f64) {
        (2.0 * self.sin * self.cos, (self.cos - self.sin) * (self.cos + self.sin))
    }
}
