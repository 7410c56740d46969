//! Figs. 3 and 4: lines simplified, and borders over mountains.

use super::super::figure::{Figure, Panel, Paper, Scale};
use super::super::pictures::magnified;
use super::super::shot::Shot;
use super::super::ways::{WHOLE, Way, drawn_in};
use crate::error::Result;
use crate::technique::Kind;

const ZIG: &str = include_str!("zig.toml");
const BORDERS: &str = include_str!("borders.toml");

pub(super) const FIGURE_3: Figure = Figure {
    name: "wartell-3",
    paper: Paper::Wartell,
    number: "Fig. 3",
    title: "What is left of a line's BLG tree",
    caption: "A border within large triangles, drawn by its BLG trees cut at tolerances of 0, 1, 4 and 12 pixels. The paper shows how such a tree is made, these \
              pictures what it does.",
    look_for: "the points that are left are those farthest from the chords.",
    draw: figure_3,
};

fn figure_3(_: Scale) -> Result<Vec<Panel>> {
    let panel = |tolerance: &i32| {
        let tolerance_px = format!("technique.geometry-overlay.tolerance_px={tolerance}");
        let frame = Shot::of(ZIG, &[&tolerance_px])?.frame(Kind::GeometryOverlay, &[])?;
        let caption = format!(
            "tolerance {tolerance} px: {} of {} points",
            frame.count("points_drawn"),
            frame.count("points")
        );
        Ok(Panel::picture(caption, magnified(frame.image(), 2)))
    };
    [0, 1, 4, 12].iter().map(panel).collect()
}

pub(super) const FIGURE_4: Figure = Figure {
    name: "wartell-4",
    paper: Paper::Wartell,
    number: "Fig. 4",
    title: "Borders over mountains",
    caption: "Borders with many points over a level-of-detail mesh within a pixel of the full terrain, drawn as lines of one pixel.",
    look_for: "lines keep to the mesh: none sinks into it, none floats. `drapery report --tables=wartell` has Table 1 on 240,000 points.",
    draw: |scale| drawn_in(&OVERVIEW, BORDERS, WHOLE, scale),
};

const OVERVIEW: [Way; 2] = [
    Way::by(Kind::GeometryOverlay, &[], "from afar"),
    Way::by(
        Kind::GeometryOverlay,
        &["camera.eye=[0, -8000, 3300]", "camera.target=[300, -4200, 300]", "layer.borders.line.width_px=2"],
        "from near by",
    ),
];
