//! Figs. 1, 2, 3 and 9: widths over many levels of the texture.

use super::super::figure::{Figure, Paper};
use super::super::ways::{WHOLE, Way, drawn_in};
use crate::technique::Kind;

const LINES: &str = include_str!("lines.toml");

pub(super) const FIGURE_1: Figure = Figure {
    name: "taibo-1",
    paper: Paper::Taibo,
    number: "Fig. 1",
    title: "A width in texels",
    caption: "Roads that are 5 texels wide in every level of the texture, and roads of 5 m.",
    look_for: "in (a) roads jump in width where the level changes, and are wider in the distance than near by.",
    draw: |scale| drawn_in(&TEXELS, LINES, WHOLE, scale),
};

const TEXELS: [Way; 2] = [
    Way::by(
        Kind::Clipmap,
        &[
            "technique.clipmap.pixel_width=\"texels\"",
            "layer.roads.line={ color = \"#1f3f8f\", width_px = 5 }",
        ],
        "5 texels wide in all levels",
    ),
    Way::by(Kind::Clipmap, &[], "5 m wide"),
];

pub(super) const FIGURE_2: Figure = Figure {
    name: "taibo-2",
    paper: Paper::Taibo,
    number: "Fig. 2",
    title: "Widths that a device can draw",
    caption: "Roads of 5 m as line primitives of a device that draws lines of at most 10 texels: wider ones are drawn as wide as it can, or left out \
              (solution 1).",
    look_for: "near roads become thin, or fade away: their widths in texels of the finest levels are over the limit.",
    draw: |scale| drawn_in(&LIMITED, LINES, WHOLE, scale),
};

const LIMITED: [Way; 2] = [
    Way::by(
        Kind::Clipmap,
        &["technique.clipmap.solution=\"1-lines\"", "technique.clipmap.wide_lines=\"clamp\""],
        "as wide as the device can",
    ),
    Way::by(Kind::Clipmap, &["technique.clipmap.solution=\"1-lines\""], "solution 1: left out"),
];

pub(super) const FIGURE_3: Figure = Figure {
    name: "taibo-3",
    paper: Paper::Taibo,
    number: "Fig. 3",
    title: "Lines as polygons",
    caption: "The same roads tessellated into polygons (solution 2), and the truth.",
    look_for: "one width from the nearest to the farthest segment.",
    draw: |scale| drawn_in(&POLYGONS, LINES, WHOLE, scale),
};

const POLYGONS: [Way; 2] = [
    Way::by(Kind::Clipmap, &["technique.clipmap.solution=\"2-polygons\""], "solution 2: polygons"),
    Way::truth(&[], "the truth"),
];

pub(super) const FIGURE_9: Figure = Figure {
    name: "taibo-9",
    paper: Paper::Taibo,
    number: "Fig. 9",
    title: "Thin lines as lines and as polygons",
    caption: "Roads of 1.2 m far away, enlarged: line primitives, polygons whose texels are in or out, solution 4a (lines where they are thin, polygons \
              near by), and the truth.",
    look_for: "polygons break into pieces where they are narrower than a texel.",
    draw: |scale| drawn_in(&THIN, LINES, ([0.25, 0.2, 0.75, 0.55], 2), scale),
};

const THIN: [Way; 4] = [
    Way::by(
        Kind::Clipmap,
        &["layer.roads.line.width_m=1.2", "technique.clipmap.solution=\"1-lines\""],
        "line primitives",
    ),
    Way::by(
        Kind::Clipmap,
        &["layer.roads.line.width_m=1.2", "technique.clipmap.solution=\"2-polygons\""],
        "polygons",
    ),
    Way::by(Kind::Clipmap, &["layer.roads.line.width_m=1.2"], "solution 4a"),
    Way::truth(&["layer.roads.line.width_m=1.2"], "the truth"),
];
