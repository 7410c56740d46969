//! The settings of a scene that need no data: image, compositing, device, technique parameters.

use super::{Clipmap, StencilVolume};

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

/// How colours are composed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Compositing {
    /// On which values.
    pub space: BlendSpace,
    /// By which formula.
    pub mode: BlendMode,
}

/// The values that are blended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BlendSpace {
    /// Encoded (sRGB-style) values, as GPU paths do.
    #[default]
    Encoded,
    /// Linear light.
    Linear,
}

/// The formula of blending.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BlendMode {
    /// Source over destination.
    #[default]
    Over,
    /// Source times alpha plus destination, clamped at 1 (Schneider & Klein).
    Additive,
}

/// The machine to imitate; the default is exact mathematics.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Device {
    /// Arithmetic of transforms, interpolation and plan points.
    pub precision: Precision,
    /// Fractional bits of vertex positions on the screen: 0 (no snapping), 4 or 8.
    pub subpixel_bits: u32,
    /// What the depth buffer holds.
    pub depth: DepthFormat,
    /// Bits of the stencil buffer, 1..=16.
    pub stencil_bits: u32,
    /// The widest line primitive.
    pub max_line_width_px: f64,
    /// Fractional bits of a texture filter's weights; 0: exact.
    pub filter_bits: u32,
}

impl Default for Device {
    fn default() -> Self {
        Self {
            precision: Precision::F64,
            subpixel_bits: 0,
            depth: DepthFormat::F32Reversed,
            stencil_bits: 8,
            max_line_width_px: 10.0,
            filter_bits: 0,
        }
    }
}

impl Device {
    /// Whether visibility is decided by exact mathematics: f64, no snapping. (The depth format then only says how a
    /// stored depth would be rounded; it decides nothing.)
    pub fn is_exact(&self) -> bool {
        self.precision == Precision::F64
            && self.subpixel_bits == 0
            && matches!(self.depth, DepthFormat::F32Reversed)
    }
}

/// Arithmetic.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Precision {
    /// IEEE double.
    #[default]
    F64,
    /// IEEE single.
    F32,
}

/// What a depth buffer holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DepthFormat {
    /// Single precision, 1 at the near plane, 0 at infinity.
    #[default]
    F32Reversed,
    /// Single precision, 0 at the near plane, 1 at the far plane.
    F32,
    /// 24-bit fixed point, 0 at the near plane.
    Unorm24,
    /// 16-bit fixed point, 0 at the near plane.
    Unorm16,
}

/// Parameters of the techniques.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TechniqueSettings {
    /// Taibo et al. 2014.
    pub clipmap: Clipmap,
    /// She 2016.
    pub inverse_projection: InverseProjection,
    /// Schneider & Klein 2007.
    pub stencil_volume: StencilVolume,
}

/// Parameters of inverse projection (She 2016).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct InverseProjection {
    /// n: n x n samples in each P pixel (She 3.4).
    pub samples: u32,
    /// Which points make a pixel's quadrilateral (She 3.2).
    pub corners: Corners,
    /// How a sample is judged (She 3.5).
    pub point_in_polygon: PointInPolygon,
    /// What is done with a pixel whose quadrilateral spans the sky or a silhouette (the paper is silent).
    pub silhouette: Silhouette,
}

impl Default for InverseProjection {
    fn default() -> Self {
        Self {
            samples: 3,
            corners: Corners::default(),
            point_in_polygon: PointInPolygon::default(),
            silhouette: Silhouette::default(),
        }
    }
}

/// Which points make a pixel's quadrilateral.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Corners {
    /// The centres of the pixel and of its right, upper right and upper neighbours (She Fig. 6b: half a pixel's shift).
    #[default]
    Centres,
    /// The pixel's own four corners.
    True,
}

/// How a sample is judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PointInPolygon {
    /// By the normals of the edges that meet the pixel, with the pedal rule (She Codes A and B).
    #[default]
    EdgeNormals,
    /// By the winding number, exactly.
    Winding,
}

/// What is done with a pixel whose quadrilateral has no meaning.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Silhouette {
    /// One sample at the pixel's centre, counted in `counts.refused`.
    #[default]
    Centre,
    /// The quadrilateral is used all the same where its corners see terrain (the paper's smear).
    Smear,
}
