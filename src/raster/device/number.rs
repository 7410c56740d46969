//! The numbers that the imitated machine calculates with.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Sub};

/// Snapped coordinates are counted in units of 2^-12 pixels.
pub(super) const GRID_BITS: u32 = 12;

/// What edge functions are made of: exact integers for snapped vertices, the device's numbers otherwise.
pub trait Coordinate:
    Copy + PartialOrd + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    /// A coordinate in pixels.
    fn of_pixels(pixels: f64) -> Self;
    /// Its value as a double, rounded.
    fn rounded(self) -> f64;
}

/// A floating-point number of the device's precision: every operation rounds to it.
pub trait Real: Coordinate + Debug + Send + Sync + Div<Output = Self> + 'static {
    /// The nearest number of this precision.
    fn of(value: f64) -> Self;
    /// The number as a double, exactly.
    fn get(self) -> f64;
    /// The square root, rounded to nearest.
    fn sqrt(self) -> Self;
}

/// The number moved into 0..=1.
pub(super) fn clamp_to_unit<T: Real>(value: T) -> T {
    let (zero, one) = (T::of(0.0), T::of(1.0));
    if value < zero {
        zero
    } else if value > one {
        one
    } else {
        value
    }
}

impl Coordinate for i128 {
    fn of_pixels(pixels: f64) -> Self {
        (pixels * f64::from(1u32 << GRID_BITS)).round_ties_even() as Self
    }
    fn rounded(self) -> f64 {
        self as f64
    }
}

macro_rules! real {
    ($($t:ty),*) => {$(
        impl Coordinate for $t {
            fn of_pixels(pixels: f64) -> Self {
                pixels as Self
            }
            fn rounded(self) -> f64 {
                self.into()
            }
        }

        impl Real for $t {
            fn of(value: f64) -> Self {
                value as Self
            }
            fn get(self) -> f64 {
                self.into()
            }
            fn sqrt(self) -> Self {
                self.sqrt()
            }
        }
    )*};
}
real!(f32, f64);
