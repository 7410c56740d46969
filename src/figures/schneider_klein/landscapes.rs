//! Figs. 1 and 6: land use and roads on a landscape.

use super::super::figure::{Figure, Paper};
use super::super::ways::{WHOLE, Way, drawn_in};
use crate::technique::Kind;

const VALLEY: &str = include_str!("valley.toml");

pub(super) const FIGURE_1: Figure = Figure {
    name: "schneider-klein-1",
    paper: Paper::SchneiderKlein,
    number: "Fig. 1",
    title: "Roads on a landscape",
    caption: "Roads on mountains by stencil volumes; the land is generated, not the paper's.",
    look_for: "roads follow every triangle of the terrain: they are a set of the plan, and the stencil asks each pixel's point whether it is in it.",
    draw: |scale| drawn_in(&ROADS, VALLEY, WHOLE, scale),
};

const ROADS: [Way; 1] = [Way::by(
    Kind::StencilVolume,
    &["layer.forest.fill.opacity=0", "layer.meadow.fill.opacity=0", "layer.lake.fill.opacity=0"],
    "roads of 16 m",
)];

pub(super) const FIGURE_6: Figure = Figure {
    name: "schneider-klein-6",
    paper: Paper::SchneiderKlein,
    number: "Fig. 6",
    title: "Translucent polygons and lines",
    caption: "Land use in polygons with holes, drawn translucently, a lake with an island, and roads; from far, from near and from above.",
    look_for: "the ground's shading is seen through the polygons; where two of them meet there is neither a gap nor a place that is covered twice.",
    draw: |scale| drawn_in(&LAND_USE, VALLEY, WHOLE, scale),
};

const LAND_USE: [Way; 4] = [
    Way::by(Kind::StencilVolume, &["layer.roads.line.opacity=0"], "land use"),
    Way::by(Kind::StencilVolume, &[], "with roads"),
    Way::by(
        Kind::StencilVolume,
        &["camera.eye=[-900, -2500, 1500]", "camera.target=[0, -1300, 500]"],
        "the lake and its island",
    ),
    Way::by(
        Kind::StencilVolume,
        &["camera.eye=[0, -900, 4200]", "camera.target=[0, -899, 0]", "compositing.mode=\"additive\""],
        "from above, colours added",
    ),
];
