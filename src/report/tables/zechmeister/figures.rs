//! The experiments of the thesis's chapter 5, each under the number of its figure.

use super::amounts::amounts;
use super::bench::{Bench, Case};
use super::decals::{Decals, Look, empty_corner};
use crate::error::Result;
use crate::scene::{Camera, Join, Projection};
use crate::space::{Plan, ViewFrame};

/// A figure: its number, what it shows, and the studies that it is of; an empty list: all.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Figure {
    /// The thesis's number; 5.4 is the table's row on how data is distributed, which has no figure.
    pub number: &'static str,
    /// What it shows.
    pub title: &'static str,
    /// Its studies.
    pub studies: &'static [&'static str],
    /// What is varied.
    pub factor: &'static str,
}

const LINES: &[&str] = &["HORA IL", "HORA RLL", "Cologne SA"];
const POLYGONS: &[&str] = &["Graz SC", "Cologne SA", "HORA FA", "HORA RC"];

/// All of them.
pub const FIGURES: [Figure; 13] = [
    figure("5.5", "Volumes, static and dynamic", &[], "vertices"),
    figure("5.6", "Shares of exterior and interior polygons and lines", &["HORA IL"], ""),
    figure("5.7", "Overhead when all is out of view", &["Graz SC", "Cologne SA", "HORA RC"], "vertices"),
    figure("5.8", "Thirty frames while zooming in", &["Cologne SA", "HORA RC"], "zoom"),
    figure("5.9", "Share of anti-aliasing", &["HORA IL", "HORA RLL", "HORA RC"], "anti-aliasing"),
    figure("5.10", "Resolution of the decal grid", &[], "grid"),
    figure("5.12", "Leaf capacity of quadtrees", POLYGONS, "leaf capacity"),
    figure("5.13", "Depth of quadtrees", POLYGONS, "depth"),
    figure("5.14", "Width and opacity of static lines", LINES, "width"),
    figure("5.15", "Width and opacity of dynamic lines", LINES, "width"),
    figure("5.16", "Corner styles: round, miter, bevel", LINES, "corners"),
    figure("5.17", "Resolution of the picture, dynamic lines", LINES, "resolution"),
    figure("5.4", "Distribution of the data", &["HORA IL", "HORA RLL", "Cologne SA", "HORA RC"], "spread"),
];

const fn figure(
    number: &'static str,
    title: &'static str,
    studies: &'static [&'static str],
    factor: &'static str,
) -> Figure {
    Figure { number, title, studies, factor }
}

/// Frames while zooming in (Fig. 5.8).
const FRAMES: usize = 30;
/// How much nearer each frame is.
const NEARER: f64 = 0.9;

/// Runs all figures that a scene is part of.
pub(super) fn run(bench: &mut Bench, is_part: impl Fn(&Figure) -> bool) -> Result<()> {
    for figure in FIGURES.iter().filter(|figure| is_part(figure)) {
        match figure.number {
            "5.5" => approaches(bench)?,
            "5.6" => plain(
                bench,
                "5.6",
                &[Decals::Exterior, Decals::Polygons, Decals::StaticLines, Decals::DynamicLines],
            )?,
            "5.7" => out_of_view(bench)?,
            "5.8" => zoom(bench)?,
            "5.9" => anti_aliasing(bench)?,
            "5.10" => grid(bench)?,
            "5.12" => quadtrees(bench, "5.12", "leaf capacity", "leaf_capacity", &[2, 8, 32, 128])?,
            "5.13" => quadtrees(bench, "5.13", "depth", "depth", &[2, 4, 8, 16])?,
            "5.14" => widths(bench, "5.14", Decals::StaticLines)?,
            "5.15" => widths(bench, "5.15", Decals::DynamicLines)?,
            "5.16" => corners(bench)?,
            "5.17" => resolution(bench)?,
            _ => distribution(bench)?,
        }
    }
    Ok(())
}

/// A case without anything special.
fn case<'a>(figure: &'static str, decals: Decals, factors: &'a [(&'static str, f64)]) -> Case<'a> {
    Case { figure, decals, look: Look::default(), changes: &[], factors, view: None }
}

fn plain(bench: &mut Bench, figure: &'static str, parts: &[Decals]) -> Result<()> {
    parts.iter().try_for_each(|decals| bench.measure(&case(figure, *decals, &[])))
}

/// How many vertices the scene has, as the thesis counts.
fn vertices(bench: &Bench) -> f64 {
    let all = amounts(&bench.stage);
    (all.exterior.vertices + all.interior.vertices + all.lines.vertices) as f64
}

/// Fig. 5.5: the volumes that the thesis compares with, all decals static, and dynamic lines over static polygons.
fn approaches(bench: &mut Bench) -> Result<()> {
    let factors = [("vertices", vertices(bench))];
    for decals in [Decals::Volumes, Decals::Static, Decals::Polygons, Decals::DynamicLines] {
        bench.measure(&case("5.5", decals, &factors))?;
    }
    Ok(())
}

/// Fig. 5.7: the data lies in the south-western half of each side, the camera frames the north-eastern corner.
fn out_of_view(bench: &mut Bench) -> Result<()> {
    let bounds = bench.stage.mesh.plan_bounds();
    let heights = bench.stage.mesh.heights().unwrap_or_default();
    let image = bench.stage.scene.image;
    let aspect = image.width as f64 / image.height as f64;
    let fov_y_deg = 20.0;
    let (eye, target) = ViewFrame::framing(&empty_corner(&bounds), heights, fov_y_deg, aspect);
    let projection = Projection::Perspective { fov_y_deg };
    let view = Camera { projection, ..Camera::new(eye, target) }.view(&image)?;
    let factors = [("vertices", vertices(bench))];
    let look = Look { shrunk: Some((0.5, bounds.min)), ..Look::default() };
    for decals in [Decals::Polygons, Decals::StaticLines, Decals::DynamicLines] {
        bench.measure(&Case { look, view: Some(&view), ..case("5.7", decals, &factors) })?;
    }
    Ok(())
}

fn zoom(bench: &mut Bench) -> Result<()> {
    let mut views = Vec::with_capacity(FRAMES);
    let mut distance = 1.0;
    for frame in 0..FRAMES {
        views.push((frame as f64, bench.nearer(distance)?));
        distance *= NEARER;
    }
    for decals in [Decals::Polygons, Decals::StaticLines, Decals::DynamicLines] {
        bench.frames(&case("5.8", decals, &[]), "zoom", &views)?;
    }
    Ok(())
}

/// Fig. 5.9: samples a pixel, and the filter.
fn anti_aliasing(bench: &mut Bench) -> Result<()> {
    for (decals, setting) in [
        (Decals::Static, ["technique.static-decal.samples=1", "technique.static-decal.samples=8"]),
        (
            Decals::DynamicLines,
            ["technique.dynamic-line.antialiasing=none", "technique.dynamic-line.antialiasing=fxaa"],
        ),
    ] {
        for (on, change) in setting.into_iter().enumerate() {
            let (changes, factors) = ([change], [("anti-aliasing", on as f64)]);
            bench.measure(&Case { changes: &changes, ..case("5.9", decals, &factors) })?;
        }
    }
    Ok(())
}

/// Fig. 5.10: half of the scene's own resolution, all of it, twice of it.
fn grid(bench: &mut Bench) -> Result<()> {
    let own = bench.grid();
    for cells in [own.div_ceil(2), own, own.saturating_mul(2).min(4096)] {
        let change = format!("technique.static-decal.grid={cells}");
        let (changes, factors) = ([change.as_str()], [("grid", f64::from(cells))]);
        bench.measure(&Case { changes: &changes, ..case("5.10", Decals::Static, &factors) })?;
    }
    Ok(())
}

/// Figs. 5.12 and 5.13.
fn quadtrees(
    bench: &mut Bench,
    figure: &'static str,
    factor: &'static str,
    parameter: &str,
    values: &[u32],
) -> Result<()> {
    for value in values {
        let change = format!("technique.static-decal.{parameter}={value}");
        let (changes, factors) = ([change.as_str()], [(factor, f64::from(*value))]);
        bench.measure(&Case { changes: &changes, ..case(figure, Decals::Polygons, &factors) })?;
    }
    Ok(())
}

/// Figs. 5.14 and 5.15: widths and opacities, and of dynamic lines also one colour for all, which need not be sorted (5.15c).
fn widths(bench: &mut Bench, figure: &'static str, decals: Decals) -> Result<()> {
    for (width, opacity) in [1.0, 4.0, 16.0].into_iter().flat_map(|w| [1.0, 0.5, 0.25].map(|a| (w, a))) {
        let look = Look { width: Some(width), opacity: Some(opacity), ..Look::default() };
        let factors = [("width", width), ("opacity", opacity), ("colors", 1.0)];
        bench.measure(&Case { look, ..case(figure, decals, &factors) })?;
        if decals == Decals::DynamicLines && opacity == 1.0 {
            let look = Look { is_one_color: true, ..look };
            let factors = [("width", width), ("opacity", opacity), ("colors", 0.0)];
            let changes = ["technique.dynamic-line.sorting=none"];
            bench.measure(&Case { look, changes: &changes, ..case(figure, decals, &factors) })?;
        }
    }
    Ok(())
}

/// Fig. 5.16: round, miter, bevel.
fn corners(bench: &mut Bench) -> Result<()> {
    for decals in [Decals::StaticLines, Decals::DynamicLines] {
        for (number, join) in [Join::Round, Join::Miter { limit: 4.0 }, Join::Bevel].into_iter().enumerate() {
            let look = Look { join: Some(join), ..Look::default() };
            let (changes, factors) = (["technique.dynamic-line.corners=style"], [("corners", number as f64)]);
            bench.measure(&Case { look, changes: &changes, ..case("5.16", decals, &factors) })?;
        }
    }
    Ok(())
}

/// Fig. 5.17.
fn resolution(bench: &mut Bench) -> Result<()> {
    for factor in [2.0 / 3.0, 1.0, 4.0 / 3.0, 2.0] {
        let view = bench.enlarged(factor)?;
        let factors = [("resolution", (view.width() * view.height()) as f64)];
        bench.measure(&Case { view: Some(&view), ..case("5.17", Decals::DynamicLines, &factors) })?;
    }
    Ok(())
}

/// The same data drawn together in the middle, and spread over all of the terrain.
fn distribution(bench: &mut Bench) -> Result<()> {
    let bounds = bench.stage.mesh.plan_bounds();
    let size = bounds.max - bounds.min;
    let middle = Plan::from(bounds.min.to_vec() + size * 0.5);
    for spread in [0.25, 0.5, 1.0] {
        let look = Look { shrunk: Some((spread, middle)), ..Look::default() };
        let factors = [("spread", spread)];
        for decals in [Decals::Static, Decals::DynamicLines] {
            bench.measure(&Case { look, ..case("5.4", decals, &factors) })?;
        }
    }
    Ok(())
}
