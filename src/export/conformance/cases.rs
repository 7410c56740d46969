//! The cases of the conformance set: which scene, who draws it, what faults it shows.

use crate::technique::Kind;

/// A scene that exposes faults of a client.
#[derive(Debug, Clone, Copy)]
pub struct Case {
    /// Its name, and that of its folder.
    pub name: &'static str,
    /// Which faults it shows, in words.
    pub exposes: &'static str,
    /// The scene file.
    pub scene: &'static str,
    /// Who draws it so that they show.
    pub techniques: &'static [Kind],
}

/// Who fills areas, and draws widths in metres.
const METRES: &[Kind] = &[Kind::Clipmap, Kind::StencilVolume, Kind::InverseProjection, Kind::StaticDecal];

/// Who draws lines in metres.
const LINES: &[Kind] =
    &[Kind::Clipmap, Kind::StencilVolume, Kind::InverseProjection, Kind::StaticDecal, Kind::GeometryOverlay];

/// Who draws widths in pixels.
const PIXELS: &[Kind] = &[Kind::Clipmap, Kind::DynamicLine, Kind::GeometryOverlay];

/// The cases whose names are those of the files in `scenes/`.
macro_rules! cases {
    ($($name:literal by $techniques:expr, $exposes:literal;)+) => {
        /// All cases.
        pub const CASES: [Case; [$($name),+].len()] = [$(Case {
            name: $name,
            exposes: $exposes,
            scene: include_str!(concat!("scenes/", $name, ".toml")),
            techniques: $techniques,
        }),+];
    };
}

cases! {
    "caps" by &[Kind::StencilVolume], "a missing top cap; z-pass with the eye inside a volume";
    "eye-inside" by &[Kind::StencilVolume], "z-pass with the near plane inside a volume; volumes that are clipped at the near plane";
    "wrap" by &[Kind::StencilVolume], "a stencil that saturates instead of wrapping; clearing that misses what overflowed";
    "draw-order" by METRES, "layers, features, fills and outlines drawn in another order";
    "far-origin" by LINES, "origins subtracted in single precision; absolute coordinates in single precision";
    "holes" by METRES, "holes and islands dropped or filled; rings taken for polygons of their own";
    "joins" by METRES, "joins missing; miters where there are bevels, and the other way round";
    "rules" by METRES, "even-odd for nonzero, and the other way round";
    "overlaps" by METRES, "a feature blended twice where it covers a point twice";
    "widths" by METRES, "half widths for whole ones; widths a few percent off";
    "outlines" by METRES, "outlines that are inset or offset drawn on their border, or on the other side";
    "inverted" by METRES, "an inverted fill drawn inside; holes of a frame filled";
    "points" by METRES, "points dropped, or squares for discs; overlaps within a feature blended twice";
    "half-pixel" by LINES, "pictures shifted by half a pixel; rows from the bottom";
    "near-plane" by LINES, "features with a vertex behind the eye dropped or mirrored";
    "sky" by METRES, "a translucent sky made opaque; features drawn on the sky; alpha multiplied twice";
    "layer-opacity" by METRES, "a layer's opacity given to each of its features";
    "linear" by METRES, "blending on encoded values where linear light is asked for; light applied to linear values";
    "additive" by METRES, "over for additive; sums that wrap, or colours that are not premultiplied";
    "hillshade" by LINES, "normals mirrored or turned down; light from elsewhere";
    "diagonal" by LINES, "cells cut along the other diagonal";
    "silhouettes" by &[Kind::InverseProjection], "quadrilaterals that span a silhouette used all the same";
    "edge-normals" by &[Kind::InverseProjection], "edge normals without the pedal rule; exact insides instead";
    "clip-region" by &[Kind::Clipmap], "no fallback to coarser levels; a region around another centre";
    "anisotropy" by &[Kind::Clipmap], "no anisotropy; a level off by one";
    "sample-places" by &[Kind::StaticDecal], "samples elsewhere in the pixel, transposed, or upside down";
    "screen-widths" by PIXELS, "half widths for whole ones; widths that do not follow the distance";
    "thin-lines" by &[Kind::DynamicLine], "thin lines dashed";
}
