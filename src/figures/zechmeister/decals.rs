//! Chapters 3 to 5: static decals and dynamic lines side by side.

use super::super::figure::{Figure, Paper, Scale};
use super::super::ways::{WHOLE, Way, drawn_in};
use crate::technique::Kind;

const RIVERS: &str = include_str!("rivers.toml");
const NESTED: &str = include_str!("nested.toml");
const STAR: &str = include_str!("star.toml");
const THIN: &str = include_str!("thin.toml");
const ALL: [f64; 4] = [0.0, 0.0, 1.0, 1.0];

/// Widths in pixels.
const RIVERS_PX: &str = "layer.rivers.line={ color = \"#2166ac\", width_px = 3 }";
const BORDERS_PX: &str = "layer.borders.line={ color = \"#202020\", width_px = 2 }";
const MIDDLE: [&str; 2] = ["camera.eye=[0, -7000, 4200]", "camera.target=[0, -1500, 300]"];
const NEAR: [&str; 2] = ["camera.eye=[300, -3300, 1500]", "camera.target=[300, -1600, 500]"];

pub(super) const FIGURE_3_2: Figure = Figure {
    name: "zechmeister-3.2",
    paper: Paper::Zechmeister,
    number: "Fig. 3.2",
    title: "Static and dynamic lines at three distances",
    caption: "Rivers and borders with a width on the ground, and with a width on the screen.",
    look_for: "static lines are hardly seen from afar and wide from near by; dynamic ones are as wide in all pictures.",
    draw: |scale| drawn_in(&DISTANCES, RIVERS, WHOLE, scale),
};

const DISTANCES: [Way; 6] = [
    Way::by(Kind::StaticDecal, &[], "static, far"),
    Way::by(Kind::DynamicLine, &[RIVERS_PX, BORDERS_PX], "dynamic, far"),
    Way::by(Kind::StaticDecal, &MIDDLE, "static, nearer"),
    Way::by(Kind::DynamicLine, &[RIVERS_PX, BORDERS_PX, MIDDLE[0], MIDDLE[1]], "dynamic, nearer"),
    Way::by(Kind::StaticDecal, &NEAR, "static, near"),
    Way::by(Kind::DynamicLine, &[RIVERS_PX, BORDERS_PX, NEAR[0], NEAR[1]], "dynamic, near"),
];

pub(super) const FIGURE_3_3: Figure = Figure {
    name: "zechmeister-3.3",
    paper: Paper::Zechmeister,
    number: "Fig. 3.3",
    title: "Polygons with holes",
    caption: "Two exterior rings with two interior ones each, and a polygon within one of the holes.",
    look_for: "the polygon in the hole is painted, the rest of the hole is not.",
    draw: |_| drawn_in(&[Way::by(Kind::StaticDecal, &[], "static decals")], NESTED, (ALL, 2), Scale::Full),
};

const BY_PIXELS: &str = "layer.area.outline={ color = \"#101010\", width_px = 9, opacity = 0.75 }";

pub(super) const FIGURE_3_9: Figure = Figure {
    name: "zechmeister-3.9",
    paper: Paper::Zechmeister,
    number: "Fig. 3.9",
    title: "Anti-aliasing of static and dynamic outlines",
    caption: "A polygon with static outlines with one and with eight samples a pixel, and with dynamic outlines without and with FXAA.",
    look_for: "FXAA smooths all that has contrast, the ground's triangles too; samples smooth borders alone.",
    draw: |_| drawn_in(&SMOOTHED, STAR, ([0.2, 0.2, 0.8, 0.8], 4), Scale::Full),
};

const SMOOTHED: [Way; 4] = [
    Way::by(Kind::StaticDecal, &["technique.static-decal.samples=1"], "static, one sample"),
    Way::by(Kind::StaticDecal, &[], "static, eight samples"),
    Way::by(
        Kind::DynamicLine,
        &[BY_PIXELS, "technique.dynamic-line.antialiasing=\"none\""],
        "dynamic, one sample",
    ),
    Way::by(Kind::DynamicLine, &[BY_PIXELS], "dynamic, FXAA"),
];

pub(super) const FIGURE_3_11: Figure = Figure {
    name: "zechmeister-3.11",
    paper: Paper::Zechmeister,
    number: "Fig. 3.11",
    title: "Corners of outlines",
    caption: "A polygon's outline with round corners, miters and bevels.",
    look_for: "the polygon's own corners are the same, the outline's are not.",
    draw: |_| drawn_in(&CORNERS, STAR, ([0.15, 0.15, 0.85, 0.85], 3), Scale::Full),
};

const CORNERS: [Way; 3] = [
    Way::by(Kind::StaticDecal, &["technique.static-decal.joins=\"style\""], "round"),
    Way::by(
        Kind::StaticDecal,
        &["technique.static-decal.joins=\"style\"", "layer.area.outline.join=\"miter\""],
        "miter",
    ),
    Way::by(
        Kind::StaticDecal,
        &["technique.static-decal.joins=\"style\"", "layer.area.outline.join=\"bevel\""],
        "bevel",
    ),
];

pub(super) const FIGURE_3_12: Figure = Figure {
    name: "zechmeister-3.12",
    paper: Paper::Zechmeister,
    number: "Fig. 3.12",
    title: "Inset, normal and offset outlines",
    caption: "A polygon with a translucent outline inside of its border, on it, and outside.",
    look_for: "how much of the polygon is seen through the outline: all of its width, half of it, none.",
    draw: |_| drawn_in(&MODES, STAR, ([0.15, 0.15, 0.85, 0.85], 3), Scale::Full),
};

const THINNER: &str = "layer.area.outline.opacity=0.5";
const MITERS: [&str; 2] = ["technique.static-decal.joins=\"style\"", "layer.area.outline.join=\"miter\""];
const MODES: [Way; 3] = [
    Way::by(
        Kind::StaticDecal,
        &[THINNER, MITERS[0], MITERS[1], "layer.area.outline.mode=\"inset\""],
        "inset",
    ),
    Way::by(Kind::StaticDecal, &[THINNER, MITERS[0], MITERS[1]], "normal"),
    Way::by(
        Kind::StaticDecal,
        &[THINNER, MITERS[0], MITERS[1], "layer.area.outline.mode=\"offset\""],
        "offset",
    ),
];

pub(super) const FIGURE_4_8: Figure = Figure {
    name: "zechmeister-4.8",
    paper: Paper::Zechmeister,
    number: "Fig. 4.8",
    title: "Wide outlines",
    caption: "An outline that is wider than the polygon's arms: normal, inset and offset by the side of each segment, as in the thesis, and inset and offset as \
              the definition has them: the stroke inside of the polygon, and outside of it.",
    look_for: "by sides, the inset outline leaves the polygon and the offset one enters it; by the whole polygon they do not.",
    draw: |_| drawn_in(&WIDE, STAR, ([0.15, 0.1, 0.85, 0.9], 3), Scale::Full),
};

const BROAD: &str = "layer.area.outline.width_m=44";
const WHOLE_POLYGON: &str = "technique.static-decal.outlines=\"polygon\"";
const WIDE: [Way; 5] = [
    Way::by(Kind::StaticDecal, &[THINNER, BROAD], "normal"),
    Way::by(Kind::StaticDecal, &[THINNER, BROAD, "layer.area.outline.mode=\"inset\""], "inset, by sides"),
    Way::by(Kind::StaticDecal, &[THINNER, BROAD, "layer.area.outline.mode=\"offset\""], "offset, by sides"),
    Way::by(
        Kind::StaticDecal,
        &[THINNER, BROAD, "layer.area.outline.mode=\"inset\"", WHOLE_POLYGON],
        "inset, by the polygon",
    ),
    Way::by(
        Kind::StaticDecal,
        &[THINNER, BROAD, "layer.area.outline.mode=\"offset\"", WHOLE_POLYGON],
        "offset, by the polygon",
    ),
];

const HALF_PX: &str = "layer.areas.outline={ color = \"#101010\", width_px = 0.5 }";

pub(super) const FIGURE_4_9: Figure = Figure {
    name: "zechmeister-4.9",
    paper: Paper::Zechmeister,
    number: "Fig. 4.9",
    title: "Outlines narrower than a pixel",
    caption: "Polygons from straight above with outlines narrower than a pixel: static, dynamic, dynamic with the correction, and wider.",
    look_for: "dashes in (a) and (b), none in (c) and (d).",
    draw: |_| drawn_in(&THIN_LINES, THIN, (ALL, 3), Scale::Full),
};

const THIN_LINES: [Way; 4] = [
    Way::by(Kind::StaticDecal, &[], "static"),
    Way::by(Kind::DynamicLine, &[HALF_PX], "dynamic, half a pixel wide"),
    Way::by(
        Kind::DynamicLine,
        &[HALF_PX, "technique.dynamic-line.thin_lines=\"correction\""],
        "dynamic, corrected",
    ),
    Way::by(
        Kind::DynamicLine,
        &["layer.areas.outline={ color = \"#101010\", width_px = 2 }"],
        "dynamic, two pixels wide",
    ),
];

const TWO_PX: &str = "layer.areas.outline={ color = \"#101010\", width_px = 2 }";
const TWO_M: &str = "layer.areas.outline.width_m=4.6";

pub(super) const FIGURE_5_11: Figure = Figure {
    name: "zechmeister-5.11",
    paper: Paper::Zechmeister,
    number: "Fig. 5.11",
    title: "A hole's outline, enlarged",
    caption: "A hole with a static outline, with eight samples a pixel and with one, and with a dynamic outline, with FXAA and without.",
    look_for: "samples place the border to an eighth of a pixel; FXAA guesses it from the picture.",
    draw: |_| drawn_in(&ENLARGED, THIN, ([0.72, 0.4, 0.98, 0.72], 10), Scale::Full),
};

const ENLARGED: [Way; 4] = [
    Way::by(Kind::StaticDecal, &[TWO_M, "technique.static-decal.samples=8"], "static, eight samples"),
    Way::by(Kind::StaticDecal, &[TWO_M], "static, one sample"),
    Way::by(Kind::DynamicLine, &[TWO_PX, "technique.dynamic-line.antialiasing=\"fxaa\""], "dynamic, FXAA"),
    Way::by(Kind::DynamicLine, &[TWO_PX], "dynamic, one sample"),
];
