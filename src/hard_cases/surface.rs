//! Cases 9 to 16: slopes, walls, silhouettes, levels of detail.

use super::artifact::{Artifact, Variant};
use super::case::Case;
use super::figure::Figure;
use super::hand::{Hand, stage, worst};
use super::machine::DEPTHS;
use super::picture::{STEP, differing_by, stray};
use super::setup::{PLANE, Setup, line, lines, polygon, stroke};
use crate::error::{Error, Result};
use crate::math;
use crate::scene::{Posts, Surface};
use crate::space::{Plan, World};
use crate::technique::{FrameOptions, Kind};
use glam::DVec2;

pub(super) const CASES: &[Case] = &[
    Case::new(9, "Smear on steep slopes", &Kind::ALL, (|| ramp(80.0), smear))
        .told("cesium#6691", "4 m in the plan are 4, 5.66, 23.0, 45.9 and 229 m on ramps of 0, 45, 80, 85 and 89 degrees.")
        .known(&[
            Artifact::of(Kind::GeometryOverlay, "Lines of the screen are as wide whatever the slope, and at most what the device draws (Wartell et al. 2003, 3)."),
        ]),
    Case::new(10, "A vertical wall in a TIN", &Kind::ALL, (|| wall(None), |hand| hand.against_truth(&wall(hand.kind()), &[])))
        .told("cesium#7453", "A line across the wall paints its trace up the wall: the truth."),
    Case::new(11, "Silhouettes break widths from derivatives", &[Kind::InverseProjection, Kind::StaticDecal, Kind::Clipmap], (ridges, silhouettes))
        .told("", "Nothing is drawn between two ramps that are 50 m apart in depth: the truth.")
        .trying(&[Variant::known(
            Kind::InverseProjection,
            &["technique.inverse-projection.silhouette=smear"],
            "A pixel's quadrilateral spans both ramps (She 2016, 3.2: neighbouring centres as corners).",
        )]),
    Case::new(12, "Triangles against bilinear patches", &[Kind::GeometryOverlay, Kind::StaticDecal], (saddle, diagonals))
        .told("osgearth PR#275", "In the middle of a cell of heights 0, 10 / 10, 0 the surface is at 0 or at 10 m, by its diagonal, never at 5."),
    Case::new(13, "Seams between levels of detail", &[Kind::GeometryOverlay, Kind::Clipmap], (seams, once))
        .told("maplibre#4991, #7523", "A line of alpha 0.5 is composed once everywhere: no pixel is brighter than 0.5.")
        .known(&[Artifact::of(
            Kind::GeometryOverlay,
            "Wide lines overlap at their joints, and each triangle crossed has one (Wartell et al. 2003, 3.1; OpenGL 2.1, 3.4.2).",
        )]),
    Case::new(14, "Popping between levels of detail", &[Kind::GeometryOverlay], (popping, levels))
        .told("", "From straight above, the picture is the same for six levels.")
        .known(&[Artifact::of_machines(
            Kind::GeometryOverlay,
            "Where a line is cut at other triangles it has other vertices, and a machine rounds them (Wartell et al. 2003, 3.2.1).",
        )]),
    Case::new(15, "Wobble from rasterised heights", &[Kind::Clipmap], (|| pillar(0), wobble))
        .told("deck.gl#7605", "Behind a pillar, a camera step of 0.1 pixels moves the line by 0.1 pixels.")
        .trying(&[Variant::right(Kind::Clipmap, &["technique.clipmap.polygons=exact", "technique.clipmap.joints=style", "technique.clipmap.overlaps=once"])]),
    Case::new(16, "Lines fight with the terrain", &[Kind::GeometryOverlay], (|| jittered(0), fights))
        .told("osgearth#159, QGIS PR#40226", "Near 0.1 and far 1e6 m: no fragment of a line in view is lost, wherever the camera stands.")
        .on(DEPTHS)
        .trying(&[Variant::known(
            Kind::GeometryOverlay,
            &["technique.geometry-overlay.offset_factor=0", "technique.geometry-overlay.offset_units=0"],
            "Without polygon offset lines and mesh have equal depths (Wartell et al. 2003, 3).",
        )]),
];

/// A ramp that fills the picture, seen along its normal; a line of 4 m along the contour is half the picture high.
fn ramp(slope: f64) -> Setup {
    let (sin, cos) = (math::sin(slope.to_radians()), math::cos(slope.to_radians()));
    let middle = 64.0 * math::tan(slope.to_radians());
    let far = 500.0;
    let camera = format!(
        "eye = [0, {:?}, {:?}], target = [0, 0, {middle:?}], up = [0, {cos:?}, {sin:?}], projection = \"orthographic\", height_m = {:?}",
        -far * sin,
        middle + far * cos,
        8.0 / cos
    );
    let terrain = format!("kind = \"ramp\", posts = [3, 3], cell_m = 64.0, slope_deg = {slope:?}");
    Setup::new([16, 128], &terrain, &camera, &line("[-60, 0.01], [60, 0.01]", 4.0, ""))
}

fn smear(hand: &Hand) -> Result<Vec<Figure>> {
    let mut off: f64 = 0.0;
    for slope in [0.0, 45.0, 80.0, 85.0, 89.0] {
        let rows = hand.draw(&ramp(slope), &[])?.column(8);
        off = math::max(off, (rows - 64.0).abs() / 64.0);
    }
    let most = if hand.kind().is_none() { 1e-6 } else { 1.5 / 64.0 };
    Ok(vec![Figure::at_most(most, "width off, of the width", off)])
}

/// A wall of 40 m on a millimetre of ground.
fn wall(kind: Option<Kind>) -> Setup {
    let columns = [-64.0, -48.0, -32.0, -16.0, 0.0, 1.0 / 1024.0, 16.0, 32.0, 48.0, 64.0];
    let height = |x: f64| if x > 0.0 { 40.0 } else { 0.0 };
    let rows = (-4..=4).map(|row| 16.0 * f64::from(row));
    let points = rows.flat_map(|y| columns.map(|x| World::new(x, y, height(x))));
    let camera = "eye = [-80, 10, 60], target = [0, 0, 20]";
    Setup::new([96, 64], PLANE, camera, &stroke(kind, "[-60, -5], [60, 8]", 4.0, 5.0))
        .over(Surface::Points(points.collect()))
}

/// Posts five metres apart, in rows to the north, of a height by the row's place.
fn rows(height: impl Fn(f64) -> f64) -> Surface {
    let (columns, rows) = (25, 51);
    let first = Plan::new(-60.0, -100.0);
    let heights =
        (0..rows).flat_map(|row| std::iter::repeat_n(height(first.y + 5.0 * f64::from(row)), columns));
    let steps = (DVec2::new(5.0, 0.0), DVec2::new(0.0, 5.0));
    grid((columns, 51), first, steps, heights.collect())
}

/// A grid; what it is made of here is never refused.
fn grid(posts: (usize, usize), first: Plan, steps: (DVec2, DVec2), heights: Vec<f64>) -> Surface {
    match Posts::new(posts, first, steps, heights) {
        Ok(posts) => Surface::Grid(posts),
        Err(_) => Surface::Points(Vec::new()),
    }
}

/// Two ramps, the second one 50 m behind the first one's edge.
fn ridges() -> Setup {
    let height = |y: f64| match y {
        _ if y <= 0.0 => 0.3 * (y + 100.0),
        _ if y < 50.0 => -20.0,
        _ => 0.3 * (y - 50.0),
    };
    let lines = "[-20.3, -99], [33.1, 149]; [25.2, -99], [-12.8, 149]; [-50, 0.01], [50, 0.01]";
    Setup::new([96, 64], PLANE, "eye = [0, -180, 45], target = [0, 0, 20], near_m = 1", &line(lines, 1.2, ""))
        .over(rows(height))
}

fn silhouettes(hand: &Hand) -> Result<Vec<Figure>> {
    let (drawn, right) = (hand.draw(&ridges(), &[])?, hand.truth(&ridges(), &[])?);
    let mut figures = hand.against_truth(&ridges(), &[])?;
    figures.push(Figure::none("stray pixels", stray(&drawn, &right)));
    figures.push(Figure::told("covered, of what is right", drawn.covered() / right.covered()));
    Ok(figures)
}

/// A cell of heights 0, 10 / 10, 0 and a stroke over its middle.
fn saddle() -> Setup {
    let steps = (DVec2::new(100.0, 0.0), DVec2::new(0.0, 100.0));
    let cell = grid((2, 2), Plan::new(-50.0, -50.0), steps, vec![0.0, 10.0, 10.0, 0.0]);
    let camera = "eye = [0, -60, 60], target = [0, 0, 5]";
    Setup::new([96, 96], PLANE, camera, &line("[-2, 0], [2, 0]", 3.0, "")).over(cell)
}

fn diagonals(hand: &Hand) -> Result<Vec<Figure>> {
    let mut off: f64 = 0.0;
    for (diagonal, height) in [("sw-ne", 0.0), ("nw-se", 10.0)] {
        let change = format!("terrain.diagonal={diagonal}");
        let view = stage(&saddle(), &[&change])?.view()?;
        let place = view.screen_from_world(World::new(0.0, 0.0, height));
        let place = place.ok_or_else(|| Error::internal("the middle is not seen"))?;
        let [x, y] = hand.draw(&saddle(), &[&change])?.middle();
        off = math::max(off, math::hypot(x - place.x, y - place.y));
    }
    // Half of the cell's height would be some three pixels.
    Ok(vec![Figure::at_most(1.5, "from the place, pixels", off)])
}

/// A level-of-detail mesh, lines across and along its borders.
fn seams() -> Setup {
    let terrain = "kind = \"fbm\", seed = 11, posts = [129, 129], cell_m = 5.0, height_m = 200.0";
    let layers = lines("[-250, -200], [250, 180]; [-256, 3], [256, 3]", "width_m = 30, opacity = 0.5");
    Setup::new([96, 64], terrain, "eye = [20, -420, 300], target = [0, 0, 60]", &layers)
        .with_terrain("diagonal = \"alternating\", lod = { error_px = 2.0 }")
}

fn once(hand: &Hand) -> Result<Vec<Figure>> {
    let one = ["layer.0.features=[{ line = [[-250, -200], [250, 180]] }]"];
    let (drawn, right) = (hand.draw(&seams(), &one)?, hand.truth(&seams(), &one)?);
    let twice = drawn.values.iter().filter(|value| value[0] > 0.5 + 2.0 * STEP).count();
    Ok(vec![
        Figure::none("pixels composed twice", twice),
        Figure::at_least(0.5, "covered, of what is right", drawn.covered() / right.covered()),
    ])
}

/// Waves of 20 m, lines and a border over them.
fn popping() -> Setup {
    let terrain = "kind = \"sine\", posts = [129, 129], cell_m = 1.0, height_m = 20.0";
    let camera = "eye = [0, 0, 500], target = [0, 0, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 128.0";
    let layers = lines("[-60.3, -41.2], [10.7, 50.9], [61.3, -20.6]", "width_px = 1");
    Setup::new([96, 96], terrain, camera, &layers)
        .with_terrain("diagonal = \"alternating\", lod = { level = 0 }")
}

fn levels(hand: &Hand) -> Result<Vec<Figure>> {
    let full = hand.draw(&popping(), &[])?;
    let of = |level: u32| {
        let drawn = hand.draw(&popping(), &[&format!("terrain.lod={{ level = {level} }}")])?;
        // Borders of a footprint do not move either; the truth's are the middles of intervals.
        let most = if hand.kind().is_none() { STEP } else { 1e-9 };
        Ok(vec![Figure::none("pixels that change", differing_by(most, &drawn, &full))])
    };
    Ok(worst((1..6).map(of).collect::<Result<Vec<_>>>()?))
}

/// A pillar before a line, the camera so many tenths of a pixel to the east.
fn pillar(step: u32) -> Setup {
    let x = 0.025 * f64::from(step);
    let terrain = "kind = \"tent\", posts = [101, 101], cell_m = 1.0, height_m = 100.0, radius_m = 1.0";
    let camera = format!(
        "eye = [{x:?}, -200, 200], target = [{x:?}, 0, 0], projection = \"orthographic\", height_m = 16.0"
    );
    Setup::new([96, 64], terrain, &camera, &line("[-4.3, -9], [-3.9, 9]", 0.8, ""))
}

fn wobble(hand: &Hand) -> Result<Vec<Figure>> {
    let place = |step: u32| Ok(hand.draw(&pillar(step), &[])?.middle()[0]);
    let places = (0..11).map(place).collect::<Result<Vec<f64>>>()?;
    let off = places.windows(2).fold(0.0, |most, pair| math::max(most, (pair[0] - pair[1] - 0.1).abs()));
    Ok(vec![Figure::at_most(0.03, "a step off, pixels", off)])
}

/// A plane and a field's border, the camera somewhere else.
fn jittered(step: u32) -> Setup {
    let (x, z) = (0.037 * f64::from(step % 10), 120.0 + 0.029 * f64::from(step / 10));
    let camera = format!("eye = [{x:?}, -400, {z:?}], target = [0, 0, -90], near_m = 0.1, far_m = 1e6");
    let layers = lines("[-200, -150], [150, 180]; [-180, 60], [200, -40]", "width_px = 2")
        + &polygon("[-100, -100], [100, -90], [80, 100]", "");
    Setup::new([96, 64], PLANE, &camera, &layers)
}

fn fights(hand: &Hand) -> Result<Vec<Figure>> {
    let mut lost = 0;
    // The truth has no fragments.
    for step in (0..100).filter(|_| hand.kind().is_some()) {
        let frame = hand.frame(&jittered(step), &[], &FrameOptions::default())?;
        let count =
            |name: &str| frame.counts.iter().find(|(known, _)| *known == name).map_or(0, |(_, count)| *count);
        lost += count("fragments") - count("fragments_drawn");
    }
    Ok(vec![Figure::none("fragments lost", lost as usize)])
}
