//! The parameters of the clipmap texture, and what they stand for.

use crate::parameter::{Range, Shape, settings, words};
use crate::scene::TechniqueSettings;
use crate::technique::Contradiction;

/// Texels a side: powers of two from one tile to what the paper's system may have.
const SIDES: Shape = Shape::IntegerOf(&[
    1 << 8,
    1 << 9,
    1 << 10,
    1 << 11,
    1 << 12,
    1 << 13,
    1 << 14,
    1 << 15,
    1 << 16,
    1 << 17,
    1 << 18,
    1 << 19,
    1 << 20,
]);

settings! {
    /// Parameters of the clipmap texture.
    pub struct Settings of "clipmap" {
        /// Texels a side of the virtual texture's finest level.
        "Taibo 2" virtual_size: u32 = 1 << 20, SIDES;
        /// Texels a side of the part of each level that is at hand; beyond it coarser levels are seen.
        "Taibo 2" clip_size: u32 = 2048, SIDES;
        /// The middle of that part: plan x, plan y, absolute; "automatic": the visible point nearest to the eye.
        "Tanner et al. 1998" center: Option<[f64; 2]> = None, Shape::Or("automatic", &Shape::Numbers(2));
        /// What the cache of tiles may hold, MiB; at least one tile.
        "Taibo 2" cache_mib: f64 = 1024.0, Shape::Number(Range::Positive);
        /// What a texel holds; "unorm8" rounds after each blending.
        "Not in the paper" texel: TexelFormat = TexelFormat::F32;
        /// How lines are kept and drawn.
        "Taibo 4" solution: Solution = Solution::Adjacency;
        /// How lines become polygons; "style": as `join` and `cap` say, which the paper does not have.
        "Taibo 4.2" joints: Joints = Joints::Combined;
        /// Joints of a smaller angle are bevelled, degrees.
        "Taibo Algorithm 1" angle_deg: f64 = 90.0, Shape::Number(Range::Between(0.0, 180.0));
        /// Lines that are thinner, in texels, are line primitives in solutions 3 and 4.
        "Taibo Algorithm 2" threshold_texels: f64 = 1.5, Shape::Number(Range::NotNegative);
        /// How line primitives are rasterized.
        "Taibo 3" lines: LinePrimitives = LinePrimitives::Coverage;
        /// What prefiltered line primitives are filtered with.
        "Taibo 3" line_filter: LineFilter = LineFilter::Gaussian;
        /// What happens to line primitives wider than device.max_line_width_px.
        "Taibo 3, 4.1" wide_lines: WideLines = WideLines::Discard;
        /// How fills and the polygons of lines are rasterized.
        "Taibo 4.2" polygons: PolygonRaster = PolygonRaster::Aliased;
        /// Whether a feature is blended twice where it covers a texel twice (tiny-skia's polygons are not).
        "Taibo Fig. 8" overlaps: Overlaps = Overlaps::Blend;
        /// How solution 4b keeps offsets.
        "Taibo 4.4" offsets: OffsetForm = OffsetForm::Rectangular;
        /// What a layer's width_px is in the texture: metres by the distance of the picture's middle, or texels in every level.
        "Taibo 3" pixel_width: PixelWidth = PixelWidth::Distance;
        /// How the texture is sampled.
        "Taibo 2" filter: TextureFilter = TextureFilter::Anisotropic;
        /// The most probes of the anisotropic filter.
        "Taibo 2" anisotropy: u32 = 8, Shape::Integer(1, 64);
        /// Added to the level that is sampled: below 0 is sharper.
        "Not in the paper" level_bias: f64 = 0.0, Shape::Number(Range::Between(-16.0, 16.0));
    }
}

/// A cache that holds no tile.
pub(super) fn contradiction(settings: &TechniqueSettings) -> Option<Contradiction> {
    let settings: Settings = settings.get();
    let (cache, tile) = (settings.cache_mib, settings.tile_bytes() as f64 / MIB);
    (cache < tile).then(|| Contradiction {
        parameter: "cache_mib",
        what: format!("a `technique.clipmap.cache_mib` of {cache} holds no tile"),
        help: format!("one tile takes {tile} MiB; the default is {}", Settings::default().cache_mib),
    })
}

/// Bytes of a MiB.
const MIB: f64 = 1_048_576.0;

/// Texels a side of a tile (5).
pub const TILE_TEXELS: u32 = 256;

impl Settings {
    /// Bytes of a tile.
    pub fn tile_bytes(&self) -> usize {
        let texel = match self.texel {
            TexelFormat::F32 => 16,
            TexelFormat::Unorm8 => 4,
        };
        (TILE_TEXELS * TILE_TEXELS) as usize * texel
    }
}

words! {
    /// What a texel holds.
    pub enum TexelFormat {
        /// Four single-precision numbers.
        F32 = "f32",
        /// Four 8-bit code values, rounded after each blending, as a render target has them.
        Unorm8 = "unorm8",
    }
}

words! {
    /// The paper's solutions (4): what is kept in memory, and what is drawn of it.
    pub enum Solution {
        /// 1: line primitives.
        Lines = "1-lines",
        /// 2: polygons.
        Polygons = "2-polygons",
        /// 3a: both are kept; thin lines are line primitives, the others polygons.
        Both = "3a-both",
        /// 3b: polygons; thin ones as wireframe.
        Wireframe = "3b-wireframe",
        /// 4a: lines with adjacency, tessellated whenever a tile is drawn.
        Adjacency = "4a-adjacency",
        /// 4b: lines with an offset to each side.
        Offsets = "4b-offsets",
    }
}

words! {
    /// How lines are tessellated (4.2).
    pub enum Joints {
        /// Algorithm 1: method 2 for wide angles, method 3b for the others.
        Combined = "algorithm-1",
        /// Method 1: each segment for itself.
        Isolated = "method-1",
        /// Method 2: the sides run on until they meet.
        Corner = "method-2",
        /// Method 3a, as a triangle strip (Fig. 8a).
        BevelStrip = "method-3a-strip",
        /// Method 3a, as a strip of quadrilaterals (Fig. 8b).
        BevelQuads = "method-3a-quads",
        /// Method 3b: bevelled outside, the intersection inside.
        BevelInner = "method-3b",
        /// As the layer's `join` and `cap` say, which the paper does not have.
        Style = "style",
    }
}

words! {
    /// How line primitives are rasterized.
    pub enum LinePrimitives {
        /// Texels are in or out (OpenGL's wide lines).
        Plain = "plain",
        /// Alpha is the share of the texel that the line's rectangle covers (`GL_LINE_SMOOTH`).
        Coverage = "coverage",
        /// Alpha from half-plane distance functions and a table (McNamara et al. 2000, Chan & Durand 2005).
        Prefiltered = "prefiltered",
    }
}

words! {
    /// What prefiltered lines are filtered with: a kernel around the texel's centre.
    pub enum LineFilter {
        /// A disc of the texel's area.
        Disc = "disc",
        /// A cone of radius 1.
        Cone = "cone",
        /// A Gaussian of standard deviation 1/2, cut off at 3/2.
        Gaussian = "gaussian",
    }
}

words! {
    /// What happens to line primitives that are wider than the device can draw.
    pub enum WideLines {
        /// They are drawn as wide as it can (Fig. 2).
        Clamp = "clamp",
        /// They are not drawn (4.1, solution 1).
        Discard = "discard",
    }
}

words! {
    /// How polygons are rasterized: those of lines, and fills.
    pub enum PolygonRaster {
        /// Texels whose centre is inside.
        Aliased = "aliased",
        /// Anti-aliased by tiny-skia.
        TinySkia = "tiny-skia",
        /// The exact area in each texel.
        Exact = "exact",
    }
}

words! {
    /// What happens where a feature covers a texel twice.
    pub enum Overlaps {
        /// It is blended twice, as a graphics pipeline does (Fig. 8).
        Blend = "blend",
        /// It is blended once.
        Once = "once",
    }
}

words! {
    /// How solution 4b stores its offsets.
    pub enum OffsetForm {
        /// East and north.
        Rectangular = "rectangular",
        /// Length and angle.
        Polar = "polar",
    }
}

words! {
    /// What a layer's width in pixels is in the texture.
    pub enum PixelWidth {
        /// So many pixels at the distance of what the middle of the picture shows: the same metres in all levels.
        Distance = "distance",
        /// So many texels in each level (Fig. 1).
        Texels = "texels",
    }
}

words! {
    /// How the texture is sampled.
    pub enum TextureFilter {
        /// The nearest texel of the nearest level.
        Nearest = "nearest",
        /// Four texels of the nearest level.
        Bilinear = "bilinear",
        /// Four texels of each of two levels.
        Trilinear = "trilinear",
        /// Trilinear probes along the pixel's footprint.
        Anisotropic = "anisotropic",
    }
}
