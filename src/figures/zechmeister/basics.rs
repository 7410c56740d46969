//! Chapter 2: what other techniques do, samples, gaps between segments.

use super::super::figure::{Figure, Paper};
use super::super::ways::{Way, drawn_in};
use crate::technique::Kind;

const STEEP: &str = include_str!("steep.toml");
const ROADS: &str = include_str!("../she/roads.toml");
const SAMPLES: &str = include_str!("samples.toml");
const BEND: &str = include_str!("bend.toml");
const ALL: [f64; 4] = [0.0, 0.0, 1.0, 1.0];

pub(super) const FIGURE_2_4: Figure = Figure {
    name: "zechmeister-2.4",
    paper: Paper::Zechmeister,
    number: "Fig. 2.4",
    title: "Where a texture is too coarse",
    caption: "Stripes in a texture over a steep cone, and the truth.",
    look_for: "on steep slopes texels are drawn out, near the eye they are large.",
    draw: |scale| drawn_in(&TEXTURE, STEEP, (ALL, 2), scale),
};

const TEXTURE: [Way; 2] = [
    Way::by(
        Kind::Clipmap,
        &["technique.clipmap.virtual_size=256", "technique.clipmap.filter=\"nearest\""],
        "a texture of 256 texels a side",
    ),
    Way::truth(&[], "the truth"),
];

pub(super) const FIGURE_2_7: Figure = Figure {
    name: "zechmeister-2.7",
    paper: Paper::Zechmeister,
    number: "Fig. 2.7",
    title: "Lines that disappear in the terrain",
    caption: "Stripes drawn as lines on the terrain without a polygon offset by a machine of single precision, and by stencil volumes.",
    look_for: "lines sink into the terrain in places; volumes need not touch it.",
    draw: |scale| drawn_in(&SUNK, STEEP, (ALL, 2), scale),
};

const SUNK: [Way; 2] = [
    Way::by(
        Kind::GeometryOverlay,
        &[
            "technique.geometry-overlay.offset_factor=0",
            "technique.geometry-overlay.offset_units=0",
            "technique.geometry-overlay.widths=\"one\"",
            "device.precision=\"f32\"",
            "device.depth=\"unorm24\"",
        ],
        "lines as geometry",
    ),
    Way::by(Kind::StencilVolume, &[], "stencil volumes"),
];

pub(super) const FIGURE_2_9: Figure = Figure {
    name: "zechmeister-2.9",
    paper: Paper::Zechmeister,
    number: "Fig. 2.9",
    title: "A narrow line by volumes and by looking it up",
    caption: "Narrow roads by stencil volumes with one sample a pixel, and by static decals with eight.",
    look_for: "dashes on the left, whole lines on the right.",
    draw: |scale| drawn_in(&NARROW, ROADS, ([0.1, 0.2, 0.6, 0.55], 2), scale),
};

const NARROW: [Way; 2] = [
    Way::by(Kind::StencilVolume, &[], "stencil volumes"),
    Way::by(Kind::StaticDecal, &[], "static decals, 8 samples a pixel"),
];

pub(super) const FIGURE_2_14: Figure = Figure {
    name: "zechmeister-2.14",
    paper: Paper::Zechmeister,
    number: "Fig. 2.14",
    title: "One, four and eight samples a pixel",
    caption: "A triangle, a line and points by static decals, each pixel twelve times as wide.",
    look_for: "as many shades as samples, and one more.",
    draw: |_| drawn_in(&COUNTS, SAMPLES, (ALL, 12), super::super::figure::Scale::Full),
};

const COUNTS: [Way; 4] = [
    Way::by(Kind::StaticDecal, &["technique.static-decal.samples=1"], "one sample"),
    Way::by(Kind::StaticDecal, &["technique.static-decal.samples=4"], "four samples"),
    Way::by(Kind::StaticDecal, &["technique.static-decal.samples=8"], "eight samples"),
    Way::truth(&[], "the truth"),
];

pub(super) const FIGURE_2_15: Figure = Figure {
    name: "zechmeister-2.15",
    paper: Paper::Zechmeister,
    number: "Fig. 2.15",
    title: "Gaps between segments, and what closes them",
    caption: "Segments as they are, with discs at their ends, with corners connected, and with triangles in the gaps.",
    look_for: "the gap outside of each joint.",
    draw: |_| drawn_in(&GAPS, BEND, (ALL, 5), super::super::figure::Scale::Full),
};

const GAPS: [Way; 4] = [
    Way::by(Kind::StencilVolume, &[], "segments alone (stencil volumes)"),
    Way::by(Kind::StaticDecal, &[], "round: discs"),
    Way::by(Kind::StaticDecal, &["layer.line.line.join=\"miter\""], "miter: corners connected"),
    Way::by(Kind::StaticDecal, &["layer.line.line.join=\"bevel\""], "bevel: triangles"),
];
