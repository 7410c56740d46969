//! Fig. 1: what each approach does wrong.

use super::super::figure::{Figure, Paper};
use super::super::ways::{Way, drawn_in};
use crate::technique::Kind;

const ROADS: &str = include_str!("roads.toml");

pub(super) const FIGURE_1: Figure = Figure {
    name: "she-1",
    paper: Paper::She,
    number: "Fig. 1",
    title: "Artifacts of each approach",
    caption: "One scene by a texture that is too coarse, by lines drawn as geometry (without a polygon offset, and with one that is far too large), and by \
              stencil volumes with one sample a pixel.",
    look_for: "(a) texels as large as houses; (b) lines that sink into the terrain; (c) lines that are seen through hills; (d) broken lines and stairs.",
    draw: |scale| drawn_in(&APPROACHES, ROADS, ([0.1, 0.2, 0.6, 0.65], 2), scale),
};

const APPROACHES: [Way; 4] = [
    Way::by(
        Kind::Clipmap,
        &[
            "layer.roads.line.width_m=9",
            "technique.clipmap.virtual_size=1024",
            "technique.clipmap.filter=\"nearest\"",
        ],
        "texture: texels are seen",
    ),
    Way::by(
        Kind::GeometryOverlay,
        &[
            "layer.roads.line.width_m=9",
            "technique.geometry-overlay.offset_factor=0",
            "technique.geometry-overlay.offset_units=0",
            "device.precision=\"f32\"",
            "device.depth=\"unorm16\"",
        ],
        "geometry without polygon offset: puncture",
    ),
    Way::by(
        Kind::GeometryOverlay,
        &[
            "layer.roads.line.width_m=9",
            "technique.geometry-overlay.offset_factor=12",
            "device.precision=\"f32\"",
            "device.depth=\"unorm24\"",
        ],
        "geometry with a large polygon offset: suspension",
    ),
    Way::by(
        Kind::StencilVolume,
        &["layer.roads.line.width_m=9"],
        "stencil volumes, one sample a pixel: intermittence and stairs",
    ),
];
