//! Cases 21 to 28: joins, caps, dashes, widths.

use super::artifact::{Artifact, Variant};
use super::case::Case;
use super::figure::Figure;
use super::hand::{Hand, worst};
use super::setup::{Setup, line, lines, points, towards};
use crate::error::Result;
use crate::math;
use crate::technique::Kind;

/// Techniques that draw strokes of metres.
const STROKES: &[Kind] = &[
    Kind::Clipmap,
    Kind::StencilVolume,
    Kind::InverseProjection,
    Kind::StaticDecal,
    Kind::GeometryOverlay,
    Kind::Analytic,
];

const SCREEN_LINES: Artifact = Artifact::of(
    Kind::GeometryOverlay,
    "OpenGL's lines: each segment a parallelogram as wide along an axis of the screen, without joins (Wartell et al. 2003, 3.2.1; OpenGL 2.1, 3.4.2).",
);
const BOXES: Artifact =
    Artifact::of(Kind::StencilVolume, "A box a segment: no joins, no caps (Schneider & Klein 2007, 4.1).");
const THESIS_JOINS: Artifact = Artifact::of(
    Kind::StaticDecal,
    "Miters below 40 degrees, and ends, are round (Zechmeister 2020, 4.2.1).",
);
const ALGORITHM_1: Artifact = Artifact::of(
    Kind::Clipmap,
    "Joints by the angle alone: acute ones are bevelled, whatever the style (Taibo et al. 2014, 4.2.4, Algorithm 1).",
);
const FIXED_CORNERS: Artifact = Artifact::of(
    Kind::InverseProjection,
    "Corners are mitred and ends flat, whatever the style (She 2016, Fig. 4).",
);

/// Settings by which techniques do as the style says.
const BY_STYLE: &[Variant] = &[
    Variant::right(Kind::Clipmap, EXACT),
    Variant::right(Kind::StencilVolume, &["technique.stencil-volume.joins=style"]),
    Variant::right(Kind::StaticDecal, &["technique.static-decal.joins=style"]),
];
/// The clipmap as exact as it gets.
const EXACT: &[&str] = &[
    "technique.clipmap.polygons=exact",
    "technique.clipmap.joints=style",
    "technique.clipmap.overlaps=once",
    "technique.clipmap.threshold_texels=0",
];

pub(super) const CASES: &[Case] = &[
    Case::new(21, "A turn of 180 degrees", STROKES, (turned, turn_back))
        .told("mapbox-gl-js#4008", "There and back covers what the longer way covers: 40 square metres, nothing far away.")
        .known(&[THESIS_JOINS, SCREEN_LINES])
        .trying(BY_STYLE),
    Case::new(22, "Acute miters", STROKES, (|| vee(30.0), miters))
        .told("cesium#5231", "Interior 90, 30, 10 and 1 degrees, limit 4: two miters (1.41 and 3.86), two bevels; areas in closed form.")
        .known(&[BOXES, THESIS_JOINS, ALGORITHM_1, FIXED_CORNERS, SCREEN_LINES])
        .trying(BY_STYLE),
    Case::new(23, "Repeated vertices", STROKES, (|| chain(CLOSED[1]), repeated))
        .told("cesium#898, #12921", "The picture without the repetitions; of vertices that are all equal see 49."),
    Case::new(24, "A width much larger than the segments", STROKES, (wheel, minkowski))
        .told("mapbox-gl-js#10000", "A 360-gon of radius 2, 10 m wide: the Minkowski sum with a disc, 153.93 square metres.")
        .known(&[BOXES, ALGORITHM_1, FIXED_CORNERS, THESIS_JOINS, SCREEN_LINES])
        .trying(BY_STYLE),
    Case::new(25, "A line over itself, half transparent", STROKES, (|| eight(ONE), over_itself))
        .told("mapbox-gl-js#681, #794", "One feature covers 0.5 where it crosses itself, two features 0.75.")
        .known(&[
            Artifact::of(Kind::Clipmap, "Triangles that overlap are blended twice (Taibo et al. 2014, 4.2.3 and Fig. 8)."),
            SCREEN_LINES,
        ])
        .trying(BY_STYLE),
    Case::new(26, "Dashes over a seam", STROKES, (unseamed, dashes))
        .told("mapbox-gl-js#5395", "100 m in dashes of 10 and gaps of 5: 70 m are on, with or without a vertex at 37.3 m.")
        .known(&[Artifact::of(Kind::StaticDecal, "Ends are round, whatever the style: those of each dash (Zechmeister 2020, 4.2.1).")])
        .trying(&[Variant::right(Kind::StaticDecal, &["technique.static-decal.joins=style"])]),
    Case::new(27, "The width is off", STROKES, (|| wide(7.0), widths))
        .told("cesium#13675", "Lines of 1, 3, 7, 16 and 31 pixels: what they cover along their length is their width.")
        .known(&[SCREEN_LINES]),
    Case::new(28, "A squeeze at high latitudes", STROKES, (|| upright(75.0), both_axes))
        .told("WorldWindJava#275", "On a globe a width is the same along a parallel and along a meridian, at latitudes 40 and 75.")
        .known(&[SCREEN_LINES]),
];

/// A line with mitred joins on a map, a metre a pixel.
fn chain(points: &str) -> Setup {
    Setup::map(&line(points, 4.0, "join = \"miter\", miter_limit = 4"))
}

/// How far a share may be off: by the truth hardly, by samples a little.
fn within(hand: &Hand, sampled: f64) -> f64 {
    if hand.kind().is_none() { 1e-4 } else { sampled }
}

fn turned() -> Setup {
    let points = "[-5.03, 0.02], [4.97, 0.02], [-3.03, 0.02]";
    Setup::map_of(32.0, 128, &line(points, 4.0, "join = \"miter\", miter_limit = 4"))
}

fn turn_back(hand: &Hand) -> Result<Vec<Figure>> {
    let area = hand.draw(&turned(), &[])?.covered() / 16.0;
    Ok(vec![
        Figure::at_most(within(hand, 0.05), "area off", (area / 40.0 - 1.0).abs()),
        Figure::told("area, square metres", area),
    ])
}

/// Two legs of 140 m that meet at an angle.
fn vee(interior: f64) -> Setup {
    let tip = [60.3, 0.2];
    let legs = [0.5, -0.5].map(|side| towards(tip, 180.0 + side * interior + 7.0, 140.0));
    let style = "join = \"miter\", miter_limit = 4";
    Setup::map_of(256.0, 128, &line(&points(&[legs[0], tip, legs[1]]), 2.0, style))
}

/// What the legs and their join cover: each leg is a trapezoid as long in the mean as itself; beyond the bevel a miter has its tip.
fn vee_area(interior: f64) -> f64 {
    let (half, legs) = (1.0, 2.0 * 140.0 * 2.0);
    let angle = interior.to_radians();
    if 1.0 / math::sin(0.5 * angle) <= 4.0 {
        return legs;
    }
    legs - (half * half / math::tan(0.5 * angle) - 0.5 * half * half * math::sin(angle))
}

fn miters(hand: &Hand) -> Result<Vec<Figure>> {
    let names = ["area off at 90 degrees", "at 30 degrees", "at 10 degrees", "at 1 degree"];
    let angles = [90.0, 30.0, 10.0, 1.0];
    let of = |(name, angle): (&&'static str, f64)| {
        let area = 4.0 * hand.draw(&vee(angle), &[])?.covered();
        Ok(Figure::at_most(within(hand, 0.03), name, (area / vee_area(angle) - 1.0).abs()))
    };
    names.iter().zip(angles).map(of).collect()
}

/// Chains with repetitions, and the same without them.
const REPEATED: [[&str; 2]; 2] = [
    [
        "[-30, -20.3], [-30, -20.3], [0, 10.2], [0, 10.2], [0, 10.2], [30, -5.1], [30, -5.1]",
        "[-30, -20.3], [0, 10.2], [30, -5.1]",
    ],
    ["[-30, -20.3], [0, 10.2], [0.000000000001, 10.2], [30, -5.1]", "[-30, -20.3], [0, 10.2], [30, -5.1]"],
];
/// A closed chain that goes on along its first segment, and the ring.
const CLOSED: [&str; 2] = [
    "[-30, -20.3], [0, 30.2], [30, -5.1], [-30, -20.3], [0, 30.2]",
    "[-30, -20.3], [0, 30.2], [30, -5.1], [-30, -20.3]",
];

fn repeated(hand: &Hand) -> Result<Vec<Figure>> {
    let mut figures = Vec::new();
    for [repeated, plain] in REPEATED {
        figures.extend(hand.same(&hand.draw(&chain(repeated), &[])?, &hand.draw(&chain(plain), &[])?));
    }
    let mut figures = worst([figures]);
    let [on, ring] = CLOSED.map(|points| hand.draw(&chain(points), &[]).map(|picture| picture.covered()));
    let (on, ring) = (on?, ring?);
    figures.push(Figure::at_most(
        within(hand, 0.02),
        "area of a ring that goes on off",
        (on / ring - 1.0).abs(),
    ));
    Ok(figures)
}

/// A wheel of 360 segments.
fn wheel() -> Setup {
    let ring: Vec<[f64; 2]> = (0..=360).map(|k| towards([0.03, 0.02], f64::from(k % 360), 2.0)).collect();
    Setup::map_of(16.0, 64, &line(&points(&ring), 10.0, "join = \"round\", cap = \"round\""))
}

fn minkowski(hand: &Hand) -> Result<Vec<Figure>> {
    let step = 1f64.to_radians();
    // Steiner's formula: area, perimeter times radius, the disc; the hole is filled.
    let (polygon, around) = (180.0 * 4.0 * math::sin(step), 720.0 * 2.0 * math::sin(0.5 * step));
    let right = polygon + 5.0 * around + 25.0 * std::f64::consts::PI;
    let area = hand.draw(&wheel(), &[])?.covered() / 16.0;
    Ok(vec![Figure::at_most(within(hand, 0.005), "area off", (area / right - 1.0).abs())])
}

const ONE: &str = "[-30, -30.3], [30, 30.2], [30, -30.1], [-30, 30.4]";
const TWO: &str = "[-30, -30.3], [30, 30.2]; [30, -30.1], [-30, 30.4]";

fn eight(points: &str) -> Setup {
    Setup::map(&line(points, 8.0, "opacity = 0.5"))
}

fn over_itself(hand: &Hand) -> Result<Vec<Figure>> {
    let [one, two] =
        [ONE, TWO].map(|points| hand.draw(&eight(points), &[]).map(|picture| picture.shade(64, 64)));
    Ok(vec![
        Figure::at_most(0.003, "one feature, from 0.5", (one? - 0.5).abs()),
        Figure::at_most(0.003, "two features, from 0.75", (two? - 0.75).abs()),
    ])
}

/// 100 m without a vertex within.
fn unseamed() -> Setup {
    dashed("[-50.2, 0.3], [49.8, 0.3]")
}

fn dashed(points: &str) -> Setup {
    Setup::map(&line(points, 4.0, "dash = [10.0, 5.0]"))
}

fn dashes(hand: &Hand) -> Result<Vec<Figure>> {
    let seamed = dashed("[-50.2, 0.3], [-12.9, 0.3], [49.8, 0.3]");
    let drawn = hand.draw(&unseamed(), &[])?;
    let mut figures = hand.same(&hand.draw(&seamed, &[])?, &drawn);
    figures.push(Figure::at_most(
        within(hand, 0.02),
        "area off, of 280 square metres",
        (drawn.covered() / 280.0 - 1.0).abs(),
    ));
    Ok(figures)
}

/// A line that is turned by 17 degrees.
fn wide(width: f64) -> Setup {
    let ends = [towards([0.37, 0.21], 17.0, 45.0), towards([0.37, 0.21], 197.0, 45.0)];
    let map = Setup::map(&line(&points(&ends), width, ""));
    Setup { text: map.text + "[device]\nmax_line_width_px = 64.0\n", ..map }
}

fn widths(hand: &Hand) -> Result<Vec<Figure>> {
    let names = ["1 px off by", "3 px off by", "7 px off by", "16 px off by", "31 px off by"];
    let of = |(name, width): (&&'static str, f64)| {
        // Columns far from both ends, whatever these look like.
        let drawn = hand.draw(&wide(width), &[])?;
        let mean = (44..84).map(|x| drawn.column(x)).sum::<f64>() / 40.0;
        let across = math::cos(17f64.to_radians());
        Ok(Figure::at_most(within(hand, 0.06), name, (mean * across - width).abs()))
    };
    names.iter().zip([1.0, 3.0, 7.0, 16.0, 31.0]).map(of).collect()
}

/// A stroke of 30 km along a meridian, in the middle of 120 km.
fn upright(latitude: f64) -> Setup {
    along(&format!("[20, {}], [20, {}]", latitude - 1.5, latitude + 1.5), latitude)
}

fn along(points: &str, latitude: f64) -> Setup {
    let camera = format!(
        "eye_geo = [20, {latitude:?}, 300000], target_geo = [20, {latitude:?}, 0], projection = \"orthographic\", height_m = 120000.0"
    );
    let coarse = Setup::globe(&camera, &lines(points, "width_m = 30000"));
    Setup {
        text: coarse.text.replace("posts = [73, 37], cell_deg = 5", "posts = [361, 181], cell_deg = 1"),
        ..coarse
    }
}

fn both_axes(hand: &Hand) -> Result<Vec<Figure>> {
    let of = |latitude: f64| -> Result<Vec<Figure>> {
        let level = along(&format!("[8, {latitude}], [20, {latitude}], [32, {latitude}]"), latitude);
        let level = hand.draw(&level, &[])?.column(32);
        let drawn = hand.draw(&upright(latitude), &[])?;
        let upright: f64 = (0..64).map(|x| drawn.shade(x, 32)).sum();
        // A pixel is 1.9 km; cells of a degree stray from the ellipsoid's normals.
        let most = if hand.kind().is_none() { 0.02 } else { 0.08 };
        Ok(vec![
            Figure::at_most(most, "along the parallel off", (level / 16.0 - 1.0).abs()),
            Figure::at_most(most, "along the meridian off", (upright / 16.0 - 1.0).abs()),
        ])
    };
    Ok(worst([of(40.0)?, of(75.0)?]))
}
