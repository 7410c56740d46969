//! Cases 43 to 55: from real files and reports tried since.

use super::artifact::Artifact;
use super::case::{BY_WINDING, Case, EDGE_NORMALS, FILLS};
use super::figure::Figure;
use super::hand::{Hand, worst};
use super::machine::DEPTHS;
use super::picture::{STEP, differing, differing_by};
use super::setup::{HILLS, PLANE, Setup, line, lines, points, polygon, polygons, square, stroke, towards};
use super::tiles::chance;
use crate::error::Result;
use crate::scene::{Scene, Shape, Surface};
use crate::space::{Plan, World};
use crate::technique::Kind;

const STENCIL: &[Kind] = &[Kind::StencilVolume];
/// What samples do to lines thinner than their spacing.
const HAIRLINES: &[Artifact] = &[
    Artifact::of(
        Kind::Clipmap,
        "Polygons of so thin lines are holes and dashes; line primitives below `threshold_texels` are not (Taibo et al. 2014, 4.2.5).",
    ),
    Artifact::of(
        Kind::StencilVolume,
        "One sample a pixel: \"intermittence\" (She 2016, Fig. 1c, of stencil volumes).",
    ),
    Artifact::of(
        Kind::InverseProjection,
        "n x n samples miss lines thinner than their spacing (She 2016, 3.2).",
    ),
    Artifact::of(
        Kind::StaticDecal,
        "Eight samples a pixel miss lines thinner than their spacing (Zechmeister 2020, 3.5).",
    ),
];

pub(super) const CASES: &[Case] = &[
    Case::new(43, "A mask of the world with a hole", FILLS, (|| mask("180"), masks))
        .told("deck.gl#5578, cesium#9967", "Rings of +-180, +-179 and +-180.2 degrees: the hole is empty, the rest is filled."),
    Case::new(44, "A ring that closes over a pole", FILLS, (polar, over_the_pole))
        .told("globe.gl#189", "Closed along -180 and 180 degrees it is filled to the pole."),
    Case::new(45, "An edge along a parallel", FILLS, (|| parallel(20.0), along_a_parallel))
        .told("telluric#154", "Projected edges of 0.1 to 20 degrees follow the parallel."),
    Case::new(46, "Members that overlap", FILLS, (members, union))
        .told("CartoDB#2144", "Squares of +-200 and +-100 m as members of one feature: 160,000 square metres."),
    Case::new(47, "Terrain below zero, exaggeration", &[Kind::StencilVolume, Kind::GeometryOverlay], (|| sunk(-1000.0), below_zero))
        .told("cesium#11385", "Moved 1000 m down and exaggerated: the picture of the scene that is not moved."),
    Case::new(48, "Hairlines", FILLS, (|| hair(0.3), hairlines))
        .told("femtovg#339, resvg#239", "Lines of 0.02 to 0.9 pixels cover as much as they are wide; none is thicker or gone.")
        .known(HAIRLINES),
    Case::new(49, "A segment of no length", FILLS, (|| dot("square"), dots))
        .told("vello#1055", "Butt covers nothing, square w x w, round a disc.")
        .known(&[
            Artifact::of(Kind::StencilVolume, "A box a segment: no caps, so no dots (Schneider & Klein 2007, 4.1)."),
            Artifact::of(Kind::StaticDecal, "Ends are round, whatever the style (Zechmeister 2020, 4.2.1)."),
            Artifact::of(Kind::InverseProjection, "Ends are flat, whatever the style (She 2016, Fig. 4)."),
            Artifact::of(Kind::Clipmap, "Strips have no caps (Taibo et al. 2014, 4.2)."),
        ]),
    Case::new(50, "The eye near the ground", STENCIL, (|| low(1.0, "1"), near_the_ground))
        .told("osgearth#509", "0.5 to 2 m over the ground and 5 m under it, near planes of 0.01 to 40 m: the truth.")
        .on(DEPTHS),
    Case::new(51, "Many of everything", FILLS, (star, many))
        .told("", "A star of 2,001 points; 500 equal features; 1,600 lines far from the view: the truth.")
        .known(EDGE_NORMALS)
        .trying(BY_WINDING),
    Case::new(52, "Hundreds of triangles in a pixel", FILLS, (thumbnail, |hand| hand.against_truth(&thumbnail(), &[])))
        .told("", "A thumbnail of a large grid: the truth."),
    Case::new(53, "Grazing views", FILLS, (|| grazing(1e-3), all_covered))
        .told("", "1e-13 to 1e-5 radians over a plane that a feature covers: the ground in the feature's colour."),
    Case::new(54, "Cliffs", FILLS, (cliffs, |hand| hand.against_truth(&cliffs(), &[])))
        .told("", "Neighbouring vertices 2^-20 of a cell apart: the truth."),
    Case::new(55, "Bugs that scenes must show", STENCIL, (inside, shown_bugs))
        .told("", "Swapped alphas, a missing top cap with the eye inside, origins subtracted in single precision: each changes the picture."),
];

/// The world from west to east with a hole of 20 degrees, seen from above the hole.
fn mask(reach: &str) -> Setup {
    let rings = format!(
        "[-{reach}, -85], [{reach}, -85], [{reach}, 85], [-{reach}, 85]; [10, 40], [30, 40], [30, 60], [10, 60]"
    );
    Setup::globe("eye_geo = [20, 50, 6000000], target_geo = [20, 50, 0]", &polygon(&rings, ""))
}

fn masks(hand: &Hand) -> Result<Vec<Figure>> {
    let of = |reach: &str| -> Result<Vec<Figure>> {
        let drawn = hand.draw(&mask(reach), &[])?;
        let mut figures = hand.against_truth(&mask(reach), &[])?;
        figures.push(Figure::at_most(0.01, "covered of the hole", drawn.shade(32, 32)));
        figures.push(Figure::at_least(0.99, "covered beside it", drawn.shade(32, 54)));
        Ok(figures)
    };
    Ok(worst([of("180")?, of("179")?, of("180.2")?]))
}

fn polar() -> Setup {
    let ring = "[-180, -60], [-90, -70], [0, -65], [90, -75], [180, -60], [180, -90], [-180, -90]";
    Setup::globe("eye_geo = [0, -90, 6000000], target_geo = [0, -90, 0]", &polygon(ring, ""))
}

fn over_the_pole(hand: &Hand) -> Result<Vec<Figure>> {
    let drawn = hand.draw(&polar(), &[])?;
    let mut figures = hand.against_truth(&polar(), &[])?;
    figures.push(Figure::at_least(0.99, "covered of the pole", drawn.shade(32, 32)));
    Ok(figures)
}

/// A box with its northern edge on latitude 60, so many degrees wide, seen from above the middle of that edge.
fn parallel(degrees: f64) -> Setup {
    let [west, east] = [-0.5, 0.5].map(|share| 20.0 + share * degrees);
    let ring = points(&[[west, 50.0], [east, 50.0], [east, 60.0], [west, 60.0]]);
    let camera = "eye_geo = [20, 60, 300000], target_geo = [20, 60, 0], projection = \"orthographic\", height_m = 100000.0";
    let coarse = Setup::globe(camera, &polygon(&ring, ""));
    Setup {
        text: coarse.text.replace("posts = [73, 37], cell_deg = 5", "posts = [361, 181], cell_deg = 1"),
        ..coarse
    }
}

fn along_a_parallel(hand: &Hand) -> Result<Vec<Figure>> {
    let off =
        |degrees: f64| -> Result<f64> { Ok((hand.draw(&parallel(degrees), &[])?.column(32) - 32.0).abs()) };
    let rows = [off(0.1)?, off(1.0)?, off(5.0)?, off(20.0)?];
    // A row is 1.6 km; cells of a degree stray by less. A straight edge of 20 degrees would be 75 km off.
    Ok(vec![Figure::at_most(1.0, "rows off", rows.into_iter().fold(0.0, crate::math::max))])
}

fn members() -> Setup {
    let union = |scene: &mut Scene| {
        let ring = |half: f64| {
            vec![vec![
                Plan::new(-half, -half),
                Plan::new(half, -half),
                Plan::new(half, half),
                Plan::new(-half, half),
            ]]
        };
        scene.layers[0].features[0].shape = Shape::MultiPolygon(vec![ring(200.0), ring(100.0)]);
    };
    let map = Setup::map_of(513.0, 128, &polygon(&square([0.0, 0.0], 400.0), ""));
    Setup { edit: Some(union), ..map }
}

fn union(hand: &Hand) -> Result<Vec<Figure>> {
    let pixel = 513.0 / 128.0;
    let area = pixel * pixel * hand.draw(&members(), &[])?.covered();
    let most = if hand.kind().is_none() { 1e-5 } else { 0.01 };
    Ok(vec![
        Figure::at_most(most, "area off", (area / 160_000.0 - 1.0).abs()),
        Figure::told("area, square metres", area),
    ])
}

/// Hills, a field and a road, all of it moved up.
fn sunk(by: f64) -> Setup {
    let layers = polygon("[-150, -150], [120, -180], [60, 20], [160, 150], [-120, 90]", "")
        + &line("[-280, -200], [0, 100], [250, -60], [300, 280]", 12.0, "");
    let camera = format!("eye = [40, -420, {:?}], target = [0, 0, {:?}]", 460.0 + by, 60.0 + by);
    Setup::new([96, 64], HILLS, &camera, &layers)
        .with_terrain(&format!("vertical_scale = 2.0, offset = [0, 0, {by:?}]"))
}

fn below_zero(hand: &Hand) -> Result<Vec<Figure>> {
    let here = hand.draw(&sunk(0.0), &[])?;
    Ok(worst([
        hand.same(&hand.draw(&sunk(-1000.0), &[])?, &here),
        hand.same(&hand.draw(&sunk(3000.0), &[])?, &here),
    ]))
}

/// A thin line of 90 m, turned by 17 degrees.
fn hair(width: f64) -> Setup {
    let ends = [towards([0.37, 0.21], 17.0, 45.0), towards([0.37, 0.21], 197.0, 45.0)];
    Setup::map(&line(&points(&ends), width, ""))
}

fn hairlines(hand: &Hand) -> Result<Vec<Figure>> {
    let names = ["0.02 px off, of the width", "0.1 px off", "0.3 px off", "0.9 px off"];
    // The truth stops at half a code value.
    let most = if hand.kind().is_none() { 2e-3 } else { 0.1 };
    let of = |(name, width): (&&'static str, f64)| {
        Ok(Figure::at_most(
            most,
            name,
            (hand.draw(&hair(width), &[])?.covered() / (90.0 * width) - 1.0).abs(),
        ))
    };
    names.iter().zip([0.02, 0.1, 0.3, 0.9]).map(of).collect()
}

fn dot(cap: &str) -> Setup {
    Setup::map(&line("[3.3, 4.2], [3.3, 4.2]", 21.0, &format!("cap = \"{cap}\"")))
}

fn dots(hand: &Hand) -> Result<Vec<Figure>> {
    let area = |cap: &str| -> Result<f64> { Ok(hand.draw(&dot(cap), &[])?.covered()) };
    let most = if hand.kind().is_none() { 1e-4 } else { 0.02 };
    Ok(vec![
        Figure::at_most(1e-9, "butt, square metres", area("butt")?),
        Figure::at_most(most, "square off", (area("square")? / 441.0 - 1.0).abs()),
        Figure::at_most(most, "round off", (area("round")? / (110.25 * std::f64::consts::PI) - 1.0).abs()),
    ])
}

/// A field and a road on a slope, the eye so high over it.
fn low(height: f64, near: &str) -> Setup {
    let layers =
        polygon("[-20, -15], [15, -18], [10, 20], [-15, 25]", "") + &line("[-60, 2], [60, 33]", 3.0, "");
    let camera = format!("eye = [0, -3, {:?}], target = [2, 30, 3], near_m = {near}", 5.2893 + height);
    // 61 m north of its southern edge at -64 m the ramp is at 5.34 m less what 0.6 m are.
    let ramp = "kind = \"ramp\", posts = [9, 9], cell_m = 16.0, slope_deg = 5.0";
    Setup::new([64, 48], ramp, &camera, &layers)
}

fn near_the_ground(hand: &Hand) -> Result<Vec<Figure>> {
    let mut figures = Vec::new();
    for height in [0.5, 1.0, 2.0, -5.0] {
        for near in ["0.01", "0.3", "1", "5", "40"] {
            figures.push(hand.against_truth(&low(height, near), &[])?);
        }
    }
    Ok(worst(figures))
}

/// A star of 2,001 points: every 1,000th of as many places on a circle.
fn star() -> Setup {
    let place = |k: u32| towards([0.3, 0.2], 360.0 * f64::from(k * 1000 % 2001) / 2001.0, 60.0);
    let ring: Vec<[f64; 2]> = (0..2001).map(place).collect();
    Setup::map_of(130.0, 64, &polygon(&points(&ring), ", rule = \"nonzero\""))
}

fn many(hand: &Hand) -> Result<Vec<Figure>> {
    let equal = format!("{{ polygon = [[{}]] }}, ", square([0.3, 0.2], 40.0)).repeat(500);
    let equal = Setup::map_of(128.0, 64, &polygons(&equal, ", opacity = 0.01"));
    let far: Vec<String> = (0..1600)
        .map(|k| points(&[[3000.0 + f64::from(k), 2000.0], [3100.0, 2500.0 + 400.0 * chance(k)]]))
        .collect();
    let wide = "kind = \"plane\", posts = [3, 3], cell_m = 6000.0";
    let camera = "eye = [0, 0, 100], target = [0, 0, 0], up = [0, 1, 0]";
    let far =
        Setup::new([64, 64], wide, camera, &line(&(far.join(";") + "; [-40, -30.2], [40, 20.3]"), 3.0, ""));
    let of = |setup: &Setup| hand.against_truth(setup, &[]);
    let mut figures = worst([of(&equal)?, of(&far)?]);
    // Spikes finer than samples: what they cover is asked, not where.
    let star = hand.draw(&star(), &[])?.covered() / hand.truth(&star(), &[])?.covered();
    let limit = if hand.is_exact() { 0.03 } else { 0.1 };
    figures.push(Figure::at_most(limit, "the star's area off", (star - 1.0).abs()));
    Ok(figures)
}

/// A grid of 256 x 256 cells in 16 x 16 pixels.
fn thumbnail() -> Setup {
    let terrain = "kind = \"fbm\", seed = 4, posts = [257, 257], cell_m = 4.0, height_m = 300.0";
    let layers = polygon(
        "[-300, -300], [280, -260], [240, 310], [-310, 250]; [-100, -90], [90, -100], [80, 110], [-120, 80]",
        "",
    );
    Setup::new([16, 16], terrain, "eye = [0, -1500, 1900], target = [0, 0, 100], fov_y_deg = 30", &layers)
}

/// A plane that a feature covers, the eye so much above the horizon of its middle.
fn grazing(angle: f64) -> Setup {
    let camera =
        format!("eye = [0, -100, {:?}], target = [0, 0, 0], near_m = 0.5, fov_y_deg = 20", 100.0 * angle);
    Setup::new([32, 32], PLANE, &camera, &polygon(&square([0.0, 0.0], 2000.0), ""))
}

fn all_covered(hand: &Hand) -> Result<Vec<Figure>> {
    let of = |angle: f64| -> Result<Vec<Figure>> {
        let drawn = hand.draw(&grazing(angle), &[])?;
        let painted = hand.draw(&grazing(angle), &["terrain.color=\"#ffffff\""])?;
        Ok(vec![
            Figure::none("pixels unlike the painted ground", differing_by(STEP, &drawn, &painted)),
            Figure::told("pixels that differ at all", differing(&drawn, &painted) as f64),
        ])
    };
    Ok(worst([of(1e-13)?, of(1e-11)?, of(1e-9)?, of(1e-7)?, of(1e-5)?, of(1e-3)?]))
}

/// Terraces of 16 m whose edges are 2^-20 of that wide.
fn cliffs() -> Setup {
    let mut corners = Vec::new();
    for column in -4..=4 {
        for row in -4..=4 {
            let (x, y) = (16.0 * f64::from(column), 16.0 * f64::from(row));
            let height = |column: i32| f64::from((column + 40) % 3) * 8.0;
            corners.push(World::new(x, y, height(column)));
            corners.push(World::new(x + 16.0 / 1_048_576.0, y, height(column + 1)));
        }
    }
    let layers =
        polygon("[-40, -35], [45, -30], [30, 41], [-38, 33]", "") + &line("[-60, -5], [60, 8]", 4.0, "");
    Setup::new([96, 64], PLANE, "eye = [-70, -90, 80], target = [0, 0, 5]", &layers)
        .over(Surface::Points(corners))
}

/// Two roads of one colour in a volume that holds the eye.
fn inside() -> Setup {
    let field = polygon(&square([0.0, 0.0], 400.0), ", opacity = 0.4");
    let road = |opacity: &str, points: &str| lines(points, &format!("width_m = 30, opacity = {opacity}"));
    let layers = field + &road("0.2", "[-100, -130], [100, -70]") + &road("0.7", "[-100, -70], [100, -130]");
    let tent = "kind = \"tent\", posts = [41, 41], cell_m = 20.0, height_m = 200.0, radius_m = 150.0";
    Setup::new([64, 48], tent, "eye = [0, -180, 60], target = [0, 400, 120], near_m = 0.5", &layers)
}

fn shown_bugs(hand: &Hand) -> Result<Vec<Figure>> {
    let right = hand.draw(&inside(), &[])?;
    let swapped = hand.draw(&inside(), &["layer.1.line.opacity=0.7", "layer.2.line.opacity=0.2"])?;
    let mut figures =
        vec![Figure::at_least(1.0, "pixels by swapped alphas", differing(&swapped, &right) as f64)];
    if hand.kind().is_some() {
        let open = ["technique.stencil-volume.caps=bottom", "technique.stencil-volume.method=z-fail"];
        let open = hand.draw(&inside(), &open)?;
        figures.push(Figure::at_least(1.0, "pixels by a missing cap", differing(&open, &right) as f64));
    }
    // 7,000,000.1 is no single: it is half a metre off.
    let at = |round: &dyn Fn(f64) -> f64| {
        let corner = |[x, y]: [f64; 2]| [round(7e6 + x), round(7e6 + y)];
        let road = points(&[[-30.2, -20.3], [10.7, 25.2], [40.3, -10.4]].map(corner));
        let camera = "eye = [7000000, 7000000, 500], target = [7000000, 7000000, 0], up = [0, 1, 0], projection = \"orthographic\", height_m = 64.0";
        Setup::new([64, 64], PLANE, camera, &stroke(hand.kind(), &road, 3.0, 3.0)).moved(7e6)
    };
    let (exact, rounded) = (hand.draw(&at(&|x| x), &[])?, hand.draw(&at(&|x| f64::from(x as f32)), &[])?);
    figures.push(Figure::at_least(1.0, "pixels by origins in f32", differing(&rounded, &exact) as f64));
    Ok(figures)
}
