//! The parameters of the clipmap texture.

use crate::scene::file::shape::{POSITIVE, Range, Shape, TableShape, choice, key};
use crate::scene::{Joints, LineFilter, LinePrimitives, OffsetForm, Overlaps, PixelWidth, PolygonRaster};
use crate::scene::{Solution, TexelFormat, TextureFilter, WideLines};

/// Texels a side: from one tile to what the paper has (5).
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

pub(super) static CLIPMAP: TableShape = TableShape {
    keys: &[
        key("virtual_size", SIDES, "Texels a side of the finest level. Default: 1048576."),
        key(
            "clip_size",
            SIDES,
            "Texels a side of the part of each level that is at hand; beyond it coarser levels are seen. Default: 2048.",
        ),
        key(
            "center",
            Shape::Numbers(2),
            "The middle of that part: plan x, plan y. Default: the visible point nearest to the eye.",
        ),
        key(
            "cache_mib",
            POSITIVE,
            "What the cache of tiles may hold, MiB; at least one tile. Default: 1024.",
        ),
        key(
            "texel",
            choice::<TexelFormat>(),
            "What a texel holds; \"unorm8\" rounds after each blending. Default: \"f32\".",
        ),
        key(
            "solution",
            choice::<Solution>(),
            "How lines are kept and drawn (Taibo 4). Default: \"4a-adjacency\".",
        ),
        key(
            "joints",
            choice::<Joints>(),
            "How lines become polygons (Taibo 4.2); \"style\": as `join` and `cap` say. Default: \"algorithm-1\".",
        ),
        key(
            "angle_deg",
            Shape::Number(Range::Between(0.0, 180.0)),
            "Joints of a smaller angle are bevelled (Algorithm 1). Default: 90.",
        ),
        key(
            "threshold_texels",
            Shape::Number(Range::NotNegative),
            "Thinner lines are line primitives in solutions 3 and 4 (Algorithm 2). Default: 1.5.",
        ),
        key(
            "lines",
            choice::<LinePrimitives>(),
            "How line primitives are rasterized. Default: \"coverage\".",
        ),
        key(
            "line_filter",
            choice::<LineFilter>(),
            "What prefiltered line primitives are filtered with. Default: \"gaussian\".",
        ),
        key(
            "wide_lines",
            choice::<WideLines>(),
            "What happens to line primitives wider than device.max_line_width_px. Default: \"discard\".",
        ),
        key(
            "polygons",
            choice::<PolygonRaster>(),
            "How fills and the polygons of lines are rasterized. Default: \"aliased\".",
        ),
        key(
            "overlaps",
            choice::<Overlaps>(),
            "Whether a feature is blended twice where it covers a texel twice (tiny-skia's polygons are not). Default: \"blend\".",
        ),
        key("offsets", choice::<OffsetForm>(), "How solution 4b keeps offsets. Default: \"rectangular\"."),
        key(
            "pixel_width",
            choice::<PixelWidth>(),
            "What a layer's width_px is in the texture: metres by the distance of the picture's middle, or texels in every level. Default: \"distance\".",
        ),
        key("filter", choice::<TextureFilter>(), "How the texture is sampled. Default: \"anisotropic\"."),
        key("anisotropy", Shape::Integer(1, 64), "The most probes of the anisotropic filter. Default: 8."),
        key(
            "level_bias",
            Shape::Number(Range::Between(-16.0, 16.0)),
            "Added to the level that is sampled: below 0 is sharper. Default: 0.",
        ),
    ],
    rules: &[],
};
