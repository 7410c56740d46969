//! Samples and textures that are read otherwise.

use super::super::edit::Edit::{Keys, Picture, Tile};
use super::super::picture;
use super::bug::{Bug, Class::Sampling as Here};
use crate::technique::Kind;

const TEXTURE: &[Kind] = &[Kind::Clipmap];
const DECAL: &[Kind] = &[Kind::StaticDecal];
const INVERSE: &[Kind] = &[Kind::InverseProjection];
const DYNAMIC: &[Kind] = &[Kind::DynamicLine];

/// The bugs.
pub(super) const BUGS: &[Bug] = &[
    Bug::any(Here, "half the resolution", Picture(picture::half_the_resolution)),
    Bug::any(Here, "quads transposed", Picture(picture::quads_transposed)),
    Bug::any(Here, "smeared", Picture(picture::smeared)),
    Bug::of(DECAL, Here, "one sample for n", Keys(&["technique.static-decal.samples=1"])),
    Bug::of(DECAL, Here, "half as many samples", Keys(&["technique.static-decal.samples=4"])),
    Bug::of(DECAL, Here, "a grid for the pattern", Keys(&["technique.static-decal.samples=9"])),
    Bug::of(DECAL, Here, "edges by distance", Keys(&["technique.static-decal.edges=\"analytic\""])),
    Bug::of(INVERSE, Here, "one sample", Keys(&["technique.inverse-projection.samples=1"])),
    Bug::of(INVERSE, Here, "more samples", Keys(&["technique.inverse-projection.samples=5"])),
    Bug::of(
        INVERSE,
        Here,
        "corners of the pixel itself",
        Keys(&["technique.inverse-projection.corners=\"true\""]),
    ),
    Bug::of(INVERSE, Here, "corners at centres", Keys(&["technique.inverse-projection.corners=\"centres\""])),
    Bug::of(
        INVERSE,
        Here,
        "silhouettes smeared",
        Keys(&["technique.inverse-projection.silhouette=\"smear\""]),
    ),
    Bug::of(
        &[Kind::StencilVolume],
        Here,
        "two by two samples",
        Keys(&["technique.stencil-volume.samples=2"]),
    ),
    Bug::of(
        &[Kind::StencilVolume],
        Here,
        "one sample for all",
        Keys(&["technique.stencil-volume.samples=1"]),
    ),
    Bug::of(TEXTURE, Here, "nearest texels", Keys(&["technique.clipmap.filter=\"nearest\""])),
    Bug::of(TEXTURE, Here, "one level", Keys(&["technique.clipmap.filter=\"bilinear\""])),
    Bug::of(TEXTURE, Here, "no anisotropy", Keys(&["technique.clipmap.filter=\"trilinear\""])),
    Bug::of(TEXTURE, Here, "two probes", Keys(&["technique.clipmap.anisotropy=2"])),
    Bug::of(TEXTURE, Here, "a level too coarse", Keys(&["technique.clipmap.level_bias=1"])),
    Bug::of(TEXTURE, Here, "a level too fine", Keys(&["technique.clipmap.level_bias=-1"])),
    Bug::of(TEXTURE, Here, "a level too coarse in a tile", Tile(&Keys(&["technique.clipmap.level_bias=1"]))),
    Bug::of(
        TEXTURE,
        Here,
        "a small texture",
        Keys(&["technique.clipmap.virtual_size=256", "technique.clipmap.clip_size=256"]),
    ),
    Bug::of(TEXTURE, Here, "weights of three bits", Keys(&["device.filter_bits=3"])),
    Bug::of(
        DYNAMIC,
        Here,
        "no filter over the picture",
        Keys(&["technique.dynamic-line.antialiasing=\"none\""]),
    ),
    Bug::of(
        DYNAMIC,
        Here,
        "a filter over the picture",
        Keys(&["technique.dynamic-line.antialiasing=\"fxaa\""]),
    ),
    Bug::of(
        &[Kind::GeometryOverlay],
        Here,
        "lines with soft edges",
        Keys(&["technique.geometry-overlay.lines=\"antialiased\""]),
    ),
    Bug::of(
        &[Kind::GeometryOverlay],
        Here,
        "lines with hard edges",
        Keys(&["technique.geometry-overlay.lines=\"gl\""]),
    ),
];
