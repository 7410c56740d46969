//! Figs. 12, 13 and 15: roads on hills by single sampling and by more and more samples.

use super::super::figure::{Figure, Panel, Paper, Scale};
use super::super::pictures::{Part, enlarged};
use super::super::shot::Shot;
use crate::error::Result;
use crate::technique::Kind;

const ROADS: &str = include_str!("roads.toml");

pub(super) const FIGURE_12: Figure = Figure {
    name: "she-12",
    paper: Paper::She,
    number: "Fig. 12",
    title: "Roads narrower than a pixel",
    caption: "Roads of 5 m, most of which are less than a pixel wide, enlarged: single sampling by stencil volumes beside inverse projection with 2 x 2, 3 x 3 \
              and 4 x 4 samples a pixel.",
    look_for: "single sampling breaks far roads into dots; with more samples they become whole and fainter, as far as they are narrower than a pixel.",
    draw: |scale| compared("layer.roads.line.width_m=5", [0.1, 0.2, 0.7, 0.6], 2, scale),
};

pub(super) const FIGURE_13: Figure = Figure {
    name: "she-13",
    paper: Paper::She,
    number: "Fig. 13",
    title: "Roads wider than a pixel",
    caption: "Roads of 20 m from near by, enlarged: single sampling by stencil volumes beside inverse projection with 2 x 2, 3 x 3 and 4 x 4 samples \
              a pixel.",
    look_for: "stairs along the borders in (a); n x n samples give n x n + 1 shades between road and ground.",
    draw: |scale| compared("layer.roads.line.width_m=20", [0.3, 0.55, 0.55, 0.8], 4, scale),
};

pub(super) const FIGURE_15: Figure = Figure {
    name: "she-15",
    paper: Paper::She,
    number: "Fig. 15",
    title: "Roads of two ranks on a map and on the terrain",
    caption: "Roads and lanes from straight above, and the same on the terrain, by inverse projection with 5 x 5 samples a pixel.",
    look_for: "no road is broken, none has stairs, and the far ones fade.",
    draw: figure_15,
};

/// Stencil volumes' one sample, then inverse projection's.
fn compared(width: &str, part: Part, times: usize, scale: Scale) -> Result<Vec<Panel>> {
    let single = Shot::scaled(ROADS, &[width], scale)?.by(Kind::StencilVolume)?;
    let mut panels =
        vec![Panel::picture("stencil volumes, one sample a pixel", enlarged(&single, part, times))];
    for n in 2..=4 {
        let samples = format!("technique.inverse-projection.samples={n}");
        let picture = Shot::scaled(ROADS, &[width, &samples], scale)?.by(Kind::InverseProjection)?;
        let caption = format!("inverse projection, {n} x {n} samples a pixel");
        panels.push(Panel::picture(caption, enlarged(&picture, part, times)));
    }
    Ok(panels)
}

fn figure_15(scale: Scale) -> Result<Vec<Panel>> {
    let lanes = "layer.roads.line.width_m=6";
    let samples = "technique.inverse-projection.samples=5";
    let map = ["camera.eye=[0, 0, 3000]", "camera.target=[0, 0, 0]", "camera.up=[0, 1, 0]", lanes, samples];
    let map = Shot::scaled(MOUNTAIN, &map, scale)?.by(Kind::InverseProjection)?;
    let seen = Shot::scaled(MOUNTAIN, &[lanes, samples], scale)?.by(Kind::InverseProjection)?;
    Ok(vec![Panel::picture("from straight above", map), Panel::picture("from the south", seen)])
}

/// A mountain with roads of two ranks.
const MOUNTAIN: &str = include_str!("mountain.toml");
