//! The settings of a scene that need no data: image, compositing, device, technique parameters.

use crate::parameter::{Key, Range, Settings, Shape, Value, settings, words};
use std::collections::BTreeMap;

/// A colour with straight alpha, encoded (sRGB-style) values 0..=1 of red, green, blue, alpha.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Color(pub [f64; 4]);

impl Color {
    /// The colour of four 8-bit code values.
    pub fn from_rgba8([r, g, b, a]: [u8; 4]) -> Self {
        Self([r, g, b, a].map(|v| f64::from(v) / 255.0))
    }

    /// The same colour, its alpha multiplied by `opacity`.
    #[must_use]
    pub fn with_opacity(self, opacity: f64) -> Self {
        let [r, g, b, a] = self.0;
        Self([r, g, b, a * opacity])
    }
}

/// Size and background of the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImageSettings {
    /// Pixels a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The sky.
    pub background: Color,
}

settings! {
    /// How colours are composed.
    pub struct Compositing of "compositing" {
        /// The values that are blended.
        space: BlendSpace = BlendSpace::Encoded;
        /// The formula of blending.
        mode: BlendMode = BlendMode::Over;
    }
}

words! {
    /// The values that are blended.
    pub enum BlendSpace {
        /// Encoded (sRGB-style) values, as GPU paths do.
        Encoded = "encoded",
        /// Linear light.
        Linear = "linear",
    }
}

words! {
    /// The formula of blending.
    pub enum BlendMode {
        /// Source over destination.
        Over = "over",
        /// Source times alpha plus destination, clamped at 1 (Schneider & Klein).
        Additive = "additive",
    }
}

settings! {
    /// The machine to imitate; the default is exact mathematics.
    pub struct Device of "device" {
        /// Arithmetic of transforms, interpolation and plan points.
        precision: Precision = Precision::F64;
        /// How positions of vertices reach it.
        position: Positions = Positions::Local;
        /// Fractional bits of vertex positions on the screen; 0: no snapping.
        subpixel_bits: u32 = 0, Shape::IntegerOf(&[0, 4, 8]);
        /// From which corners depth is interpolated where positions are snapped.
        interpolation: Interpolation = Interpolation::Snapped;
        /// What the depth buffer holds.
        depth: DepthFormat = DepthFormat::F32Reversed;
        /// Bits of the stencil buffer.
        stencil_bits: u32 = 8, Shape::Integer(1, 16);
        /// The widest line primitive, in texels where it draws a texture.
        max_line_width_px: f64 = 10.0, Shape::Number(Range::Positive);
        /// Fractional bits of a texture filter's weights, 8 on most; 0: exact.
        filter_bits: u32 = 0, Shape::Integer(0, 16);
        /// Fractional bits of the weight between two levels of a texture; 0: those of other weights.
        level_bits: u32 = 0, Shape::Integer(0, 16);
    }
}

impl Device {
    /// Whether visibility is decided by exact mathematics: f64, local positions, no snapping. (The depth format then only says how a
    /// stored depth would be rounded; it decides nothing.)
    pub fn is_exact(&self) -> bool {
        self.precision == Precision::F64
            && self.position == Positions::Local
            && self.subpixel_bits == 0
            && matches!(self.depth, DepthFormat::F32Reversed)
    }
}

words! {
    /// Arithmetic.
    pub enum Precision {
        /// IEEE double.
        F64 = "f64",
        /// IEEE single.
        F32 = "f32",
    }
}

words! {
    /// How positions of vertices reach the machine: as numbers of its precision, but each in its own way.
    pub enum Positions {
        /// Relative to the scene's local zero.
        Local = "local",
        /// Absolute: in the scene's CRS, on a globe geocentric.
        Absolute = "absolute",
        /// Absolute, as a multiple of 65536 and a rest; the eye's are subtracted from either (Cozzi & Ring 2011, 5.4).
        RelativeToEye = "relative-to-eye",
    }
}

words! {
    /// From which corners depth is interpolated.
    pub enum Interpolation {
        /// As they are after snapping: depth moves with them (SwiftShader).
        Snapped = "snapped",
        /// As they were before: snapping moves only what is covered (lavapipe).
        Unsnapped = "unsnapped",
    }
}

words! {
    /// What a depth buffer holds.
    pub enum DepthFormat {
        /// Single precision, 1 at the near plane, 0 at infinity.
        F32Reversed = "f32-reversed",
        /// Single precision, 0 at the near plane, 1 at the far plane.
        F32 = "f32",
        /// 24-bit fixed point, 0 at the near plane.
        Unorm24 = "unorm24",
        /// 16-bit fixed point, 0 at the near plane.
        Unorm16 = "unorm16",
    }
}

/// What is said of the techniques' parameters beyond their defaults: values by the names of technique and parameter, so that a scene
/// knows no technique.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TechniqueSettings(BTreeMap<(&'static str, &'static str), Value>);

impl TechniqueSettings {
    /// A technique's settings.
    pub fn get<S: Settings>(&self) -> S {
        S::from_values(&|parameter| self.0.get(&(S::NAME, parameter)).cloned())
    }

    /// Says all settings of a technique.
    pub fn set<S: Settings>(&mut self, settings: S) {
        for (key, (_, value)) in S::TABLE.keys.iter().zip(settings.values()) {
            self.say(S::NAME, key, value);
        }
    }

    /// Says the value of one parameter of a technique; it is of the parameter's shape.
    pub fn say(&mut self, technique: &'static str, parameter: &Key, value: Value) {
        let place = (technique, parameter.name);
        if parameter.default.is_some_and(|default| default() == value) {
            self.0.remove(&place);
        } else {
            self.0.insert(place, value);
        }
    }
}

/// Settings of one technique; the others have their defaults.
impl<S: Settings> From<S> for TechniqueSettings {
    fn from(settings: S) -> Self {
        let mut all = Self::default();
        all.set(settings);
        all
    }
}
