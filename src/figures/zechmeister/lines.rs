//! Figs. 3.6, 3.7, 4.4 and 4.7: boxes of dynamic lines, order, overlaps.

use super::super::figure::{Figure, Panel, Paper, Scale};
use super::super::pictures::magnified;
use super::super::shot::Shot;
use super::super::ways::{Way, drawn_in};
use crate::buffer::Look;
use crate::error::{Error, Result};
use crate::output::{Npy, look};
use crate::technique::Kind;

const LINES: &str = include_str!("lines.toml");

pub(super) const FIGURE_3_6: Figure = Figure {
    name: "zechmeister-3.6",
    paper: Paper::Zechmeister,
    number: "Fig. 3.6",
    title: "Boxes around segments",
    caption: "How many segments' boxes cover each pixel (dark to light), and the lines that are found in them.",
    look_for: "boxes are wider than the lines where the ground rises and falls: they reach from its lowest to its highest place.",
    draw: |_| boxes(&["technique.dynamic-line.boxes=\"mitred\""]),
};

/// The picture of how many boxes there are, and the frame's.
fn boxes(changes: &[&str]) -> Result<Vec<Panel>> {
    let frame = Shot::of(LINES, changes)?.frame(Kind::DynamicLine, &["boxes"])?;
    let counted = look(Npy::new(frame.plane("boxes")?)?, Look::Count);
    let counted = counted.ok_or_else(|| Error::internal("a figure's boxes cannot be seen"))?;
    Ok(vec![
        Panel::picture("boxes a pixel", magnified(&counted, 2)),
        Panel::picture("lines", magnified(frame.image(), 2)),
    ])
}

pub(super) const FIGURE_3_7: Figure = Figure {
    name: "zechmeister-3.7",
    paper: Paper::Zechmeister,
    number: "Fig. 3.7",
    title: "The order of lines",
    caption: "Lines composed in the order in which a parallel machine might find them, and in draw order.",
    look_for: "where lines cross, (a) changes its mind from pixel to pixel.",
    draw: |_| drawn_in(&ORDER, LINES, ([0.1, 0.1, 0.9, 0.9], 3), Scale::Full),
};

const OPAQUE: [&str; 2] = ["layer.red.line.opacity=1", "layer.blue.line.opacity=1"];
const ORDER: [Way; 2] = [
    Way::by(
        Kind::DynamicLine,
        &[OPAQUE[0], OPAQUE[1], "technique.dynamic-line.sorting=\"none\""],
        "as they are found",
    ),
    Way::by(Kind::DynamicLine, &OPAQUE, "sorted"),
];

pub(super) const FIGURE_4_4: Figure = Figure {
    name: "zechmeister-4.4",
    paper: Paper::Zechmeister,
    number: "Fig. 4.4",
    title: "Boxes that overlap, and boxes that meet",
    caption: "Boxes with offsets at corners and boxes that meet in mitres, how many cover a pixel, and lines that are drawn once for each of their segments.",
    look_for: "with offsets neighbours' boxes overlap, and so do translucent segments.",
    draw: figure_4_4,
};

fn figure_4_4(_: Scale) -> Result<Vec<Panel>> {
    let double = "technique.dynamic-line.overlaps=\"double\"";
    let overlapping = boxes(&["technique.dynamic-line.boxes=\"overlapping\"", double])?;
    let mitred = boxes(&["technique.dynamic-line.boxes=\"mitred\"", double])?;
    let told = |panel: Panel, words: &str| Panel { caption: format!("{words}: {}", panel.caption), ..panel };
    let panels = overlapping.into_iter().map(|panel| told(panel, "with offsets"));
    Ok(panels.chain(mitred.into_iter().map(|panel| told(panel, "mitred"))).collect())
}

pub(super) const FIGURE_4_7: Figure = Figure {
    name: "zechmeister-4.7",
    paper: Paper::Zechmeister,
    number: "Fig. 4.7",
    title: "A line over itself",
    caption: "Translucent static lines with round corners, counted twice where their segments overlap, and once.",
    look_for: "dark discs at joints in (a); different lines are composed one over the other in both.",
    draw: |_| drawn_in(&OVERLAPS, LINES, ([0.1, 0.1, 0.9, 0.9], 3), Scale::Full),
};

const STATIC: [&str; 2] = [
    "layer.red.line={ color = \"#d7301f\", opacity = 0.5, width_m = 12 }",
    "layer.blue.line={ color = \"#2166ac\", opacity = 0.5, width_m = 12 }",
];
const OVERLAPS: [Way; 2] = [
    Way::by(
        Kind::StaticDecal,
        &[STATIC[0], STATIC[1], "technique.static-decal.overlaps=\"double\""],
        "each segment by itself",
    ),
    Way::by(Kind::StaticDecal, &STATIC, "a line once"),
];
