//! The parameters of the clipmap texture (Taibo et al. 2014).

/// Parameters of the clipmap texture (Taibo et al. 2014).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clipmap {
    /// Texels a side of the virtual texture's finest level: a power of two.
    pub virtual_size: u32,
    /// Texels a side of the part of each level that is at hand: a power of two, at least a tile.
    pub clip_size: u32,
    /// The middle of that part (absolute plan coordinates); `None`: the visible point that is nearest to the eye.
    pub center: Option<[f64; 2]>,
    /// What the cache of tiles may hold, MiB.
    pub cache_mib: f64,
    /// What a texel holds.
    pub texel: TexelFormat,
    /// Which of the paper's solutions draws lines (4).
    pub solution: Solution,
    /// How lines are tessellated (4.2).
    pub joints: Joints,
    /// Joints whose angle is smaller are bevelled (Algorithm 1), degrees.
    pub angle_deg: f64,
    /// Lines that are thinner, in texels, are drawn as line primitives (Algorithm 2).
    pub threshold_texels: f64,
    /// How line primitives are rasterized.
    pub lines: LinePrimitives,
    /// What prefiltered lines are filtered with.
    pub line_filter: LineFilter,
    /// What happens to line primitives that are wider than the device can draw (3, 4.1).
    pub wide_lines: WideLines,
    /// How polygons are rasterized.
    pub polygons: PolygonRaster,
    /// What happens where a feature covers a texel twice.
    pub overlaps: Overlaps,
    /// How solution 4b stores its offsets.
    pub offsets: OffsetForm,
    /// What a layer's width in pixels is in the texture (3).
    pub pixel_width: PixelWidth,
    /// How the texture is sampled.
    pub filter: TextureFilter,
    /// The most probes of the anisotropic filter.
    pub anisotropy: u32,
    /// Added to the level that is sampled.
    pub level_bias: f64,
}

impl Default for Clipmap {
    fn default() -> Self {
        Self {
            virtual_size: 1 << 20,
            clip_size: 2048,
            center: None,
            cache_mib: 1024.0,
            texel: TexelFormat::default(),
            solution: Solution::default(),
            joints: Joints::default(),
            angle_deg: 90.0,
            threshold_texels: 1.5,
            lines: LinePrimitives::default(),
            line_filter: LineFilter::default(),
            wide_lines: WideLines::default(),
            polygons: PolygonRaster::default(),
            overlaps: Overlaps::default(),
            offsets: OffsetForm::default(),
            pixel_width: PixelWidth::default(),
            filter: TextureFilter::default(),
            anisotropy: 8,
            level_bias: 0.0,
        }
    }
}

/// Texels a side of a tile (5).
pub const TILE_TEXELS: u32 = 256;

impl Clipmap {
    /// Bytes of a tile.
    pub fn tile_bytes(&self) -> usize {
        let texel = match self.texel {
            TexelFormat::F32 => 16,
            TexelFormat::Unorm8 => 4,
        };
        (TILE_TEXELS * TILE_TEXELS) as usize * texel
    }
}

/// What a texel holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TexelFormat {
    /// Four single-precision numbers.
    #[default]
    F32,
    /// Four 8-bit code values, rounded after each blending, as a render target has them.
    Unorm8,
}

/// The paper's solutions (4): what is kept in memory, and what is drawn of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Solution {
    /// 1: line primitives.
    Lines,
    /// 2: polygons.
    Polygons,
    /// 3a: both are kept; thin lines are line primitives, the others polygons.
    Both,
    /// 3b: polygons; thin ones as wireframe.
    Wireframe,
    /// 4a: lines with adjacency, tessellated whenever a tile is drawn.
    #[default]
    Adjacency,
    /// 4b: lines with an offset to each side.
    Offsets,
}

/// How lines are tessellated (4.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Joints {
    /// Algorithm 1: method 2 for wide angles, method 3b for the others.
    #[default]
    Combined,
    /// Method 1: each segment for itself.
    Isolated,
    /// Method 2: the sides run on until they meet.
    Corner,
    /// Method 3a, as a triangle strip (Fig. 8a).
    BevelStrip,
    /// Method 3a, as a strip of quadrilaterals (Fig. 8b).
    BevelQuads,
    /// Method 3b: bevelled outside, the intersection inside.
    BevelInner,
    /// As the layer's `join` and `cap` say, which the paper does not have.
    Style,
}

/// How line primitives are rasterized.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LinePrimitives {
    /// Texels are in or out (OpenGL's wide lines).
    Plain,
    /// Alpha is the share of the texel that the line's rectangle covers (`GL_LINE_SMOOTH`).
    #[default]
    Coverage,
    /// Alpha from half-plane distance functions and a table (McNamara et al. 2000, Chan & Durand 2005).
    Prefiltered,
}

/// What prefiltered lines are filtered with: a kernel around the texel's centre.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LineFilter {
    /// A disc of the texel's area.
    Disc,
    /// A cone of radius 1.
    Cone,
    /// A Gaussian of standard deviation 1/2, cut off at 3/2.
    #[default]
    Gaussian,
}

/// What happens to line primitives that are wider than the device can draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum WideLines {
    /// They are drawn as wide as it can (Fig. 2).
    Clamp,
    /// They are not drawn (4.1, solution 1).
    #[default]
    Discard,
}

/// How polygons are rasterized: those of lines, and fills.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PolygonRaster {
    /// Texels whose centre is inside.
    #[default]
    Aliased,
    /// Anti-aliased by tiny-skia.
    TinySkia,
    /// The exact area in each texel.
    Exact,
}

/// What happens where a feature covers a texel twice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Overlaps {
    /// It is blended twice, as a graphics pipeline does (Fig. 8).
    #[default]
    Blend,
    /// It is blended once.
    Once,
}

/// How solution 4b stores its offsets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum OffsetForm {
    /// East and north.
    #[default]
    Rectangular,
    /// Length and angle.
    Polar,
}

/// What a layer's width in pixels is in the texture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PixelWidth {
    /// So many pixels at the distance of what the middle of the picture shows: the same metres in all levels.
    #[default]
    Distance,
    /// So many texels in each level (Fig. 1).
    Texels,
}

/// How the texture is sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TextureFilter {
    /// The nearest texel of the nearest level.
    Nearest,
    /// Four texels of the nearest level.
    Bilinear,
    /// Four texels of each of two levels.
    Trilinear,
    /// Trilinear probes along the pixel's footprint.
    #[default]
    Anisotropic,
}
