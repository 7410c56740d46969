//! The words of the scene file and what they stand for.

use super::spec::HeightEncoding;
use crate::parameter::Named;
use crate::scene::{
    BlendMode, BlendSpace, Cap, Corners, Counting, DepthFormat, Diagonal, FarPlane, Grouping, Joints,
    LineFilter, LinePrimitives, OffsetForm, OutlineMode, Overflow, Overlaps, PixelWidth, PointInPolygon,
    PolygonRaster, Precision, Rule, Silhouette, Solution, TexelFormat, TextureFilter, VolumeCaps,
    VolumeJoins, WideLines,
};

macro_rules! named {
    ($($name:ty { $($word:literal => $value:ident),+ $(,)? })+) => {
        $(impl Named for $name {
            const NAMES: &'static [(&'static str, Self)] = &[$(($word, Self::$value)),+];
        })+
    };
}

/// The kinds of projection.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ProjectionName {
    Perspective,
    Orthographic,
}

/// The kinds of join.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum JoinName {
    Round,
    Miter,
    Bevel,
}

/// The terrain's shading.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ShadeName {
    Flat,
    Hillshade,
}

/// The generated terrains.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum TerrainName {
    Plane,
    Ramp,
    Sine,
    Cone,
    Tent,
    Fbm,
}

/// The generated layers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum VectorName {
    Roads,
    Paths,
    Mosaic,
    Parcels,
}

named! {
    ProjectionName { "perspective" => Perspective, "orthographic" => Orthographic }
    JoinName { "round" => Round, "miter" => Miter, "bevel" => Bevel }
    ShadeName { "flat" => Flat, "hillshade" => Hillshade }
    TerrainName {
        "plane" => Plane, "ramp" => Ramp, "sine" => Sine, "cone" => Cone, "tent" => Tent, "fbm" => Fbm
    }
    VectorName { "roads" => Roads, "paths" => Paths, "mosaic" => Mosaic, "parcels" => Parcels }
    HeightEncoding { "terrarium" => Terrarium, "mapbox" => Mapbox }
    Diagonal { "sw-ne" => SwNe, "nw-se" => NwSe, "alternating" => Alternating }
    Rule { "even-odd" => EvenOdd, "nonzero" => NonZero }
    OutlineMode { "inset" => Inset, "normal" => Normal, "offset" => Offset }
    Cap { "butt" => Butt, "square" => Square, "round" => Round }
    BlendSpace { "encoded" => Encoded, "linear" => Linear }
    BlendMode { "over" => Over, "additive" => Additive }
    Precision { "f64" => F64, "f32" => F32 }
    DepthFormat {
        "f32-reversed" => F32Reversed, "f32" => F32, "unorm24" => Unorm24, "unorm16" => Unorm16
    }
    Corners { "centres" => Centres, "true" => True }
    PointInPolygon { "edge-normals" => EdgeNormals, "winding" => Winding }
    Silhouette { "centre" => Centre, "smear" => Smear }
    Counting { "automatic" => Automatic, "z-pass" => ZPass, "z-fail" => ZFail }
    Overflow { "wrap" => Wrap, "saturate" => Saturate }
    FarPlane { "clamp" => Clamp, "clip" => Clip }
    VolumeCaps { "both" => Both, "bottom" => Bottom }
    VolumeJoins { "none" => None, "style" => Style }
    Grouping { "object" => Object, "color" => Color }
    TexelFormat { "f32" => F32, "unorm8" => Unorm8 }
    Solution {
        "1-lines" => Lines, "2-polygons" => Polygons, "3a-both" => Both, "3b-wireframe" => Wireframe,
        "4a-adjacency" => Adjacency, "4b-offsets" => Offsets
    }
    Joints {
        "algorithm-1" => Combined, "method-1" => Isolated, "method-2" => Corner, "method-3a-strip" => BevelStrip,
        "method-3a-quads" => BevelQuads, "method-3b" => BevelInner, "style" => Style
    }
    LinePrimitives { "plain" => Plain, "coverage" => Coverage, "prefiltered" => Prefiltered }
    LineFilter { "disc" => Disc, "cone" => Cone, "gaussian" => Gaussian }
    WideLines { "clamp" => Clamp, "discard" => Discard }
    PolygonRaster { "aliased" => Aliased, "tiny-skia" => TinySkia, "exact" => Exact }
    Overlaps { "blend" => Blend, "once" => Once }
    OffsetForm { "rectangular" => Rectangular, "polar" => Polar }
    PixelWidth { "distance" => Distance, "texels" => Texels }
    TextureFilter {
        "nearest" => Nearest, "bilinear" => Bilinear, "trilinear" => Trilinear, "anisotropic" => Anisotropic
    }
}
