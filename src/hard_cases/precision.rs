//! Cases 17 to 20: large coordinates, edges on a globe, nearly straight joints, borders.

use super::artifact::{Artifact, Variant};
use super::case::Case;
use super::figure::Figure;
use super::hand::{Hand, worst};
use super::picture::{STEP, differing, differing_by, farthest, wrong_inside};
use super::setup::{Setup, points, polygon, stroke, towards};
use crate::crs::{Crs, CurveKind, Geodesy};
use crate::error::Result;
use crate::technique::Kind;
use glam::DVec2;

pub(super) const CASES: &[Case] = &[
    Case::new(17, "Jitter of single precision", &Kind::ALL, (|| far_away(EARTH, None), jitter))
        .told("cesium#14", "1 cm lines, seen from 1 m, 6,378,000 m from the origin: within 1/255 of the same scene at the origin."),
    Case::new(18, "What lies between two vertices on a globe", &Kind::ALL, (geodesic, edge_model))
        .told("cesium#7507, RFC 7946", "Between (-120, 40) and (-80, 40) the geodesic is 1.770 degrees (on WGS 84) north of the parallel."),
    Case::new(19, "Nearly straight joints", &Kind::ALL, (|| bent(1e-3), nearly_straight))
        .told("cesium#7855, #7885", "Turns of 1e-3 to 1e-12 degrees look as no turn: nothing is missing, nothing sticks out."),
    Case::new(20, "A fill and its own outline disagree", &Kind::ALL, (|| bordered("#ff8800", "#ffffff"), border))
        .told("cesium#11883", "The outline's centre line is the fill's border: of a square of 80 m with an outline of 10 m a fill of 4900 and an outline of 3200 square metres are seen.")
        .known(&[
            Artifact::of(Kind::StencilVolume, "A box a segment: the outline has no corners (Schneider & Klein 2007, 4.1)."),
            Artifact::of(Kind::GeometryOverlay, "Draws polylines alone; fills are not seen (Wartell et al. 2003, 3)."),
        ])
        .trying(&[Variant::right(Kind::StencilVolume, &["technique.stencil-volume.joins=style"])]),
];

/// As far from the origin as the earth's surface from its centre.
const EARTH: f64 = 6_378_000.0;

/// Lines of a centimetre from a metre above, all of it moved to the north-east.
fn far_away(by: f64, kind: Option<Kind>) -> Setup {
    let at = |[x, y]: [f64; 2]| [x + by, y + by];
    let road = points(&[[-0.5, -0.375], [0.0625, 0.125], [0.4375, -0.25]].map(at));
    let camera = format!(
        "eye = [{:?}, {:?}, 1.0], target = [{by:?}, {by:?}, 0.0], near_m = 0.01",
        by + 0.125,
        by - 0.75
    );
    let terrain = "kind = \"fbm\", seed = 2, posts = [9, 9], cell_m = 0.25, height_m = 0.0625";
    let layers = stroke(kind, &road, 0.01, 3.0);
    Setup::new([96, 64], terrain, &camera, &layers).moved(by)
}

fn jitter(hand: &Hand) -> Result<Vec<Figure>> {
    let near = hand.draw(&far_away(0.0, hand.kind()), &[])?;
    let of = |by: f64| -> Result<Vec<Figure>> {
        let far = hand.draw(&far_away(by, hand.kind()), &[])?;
        Ok(vec![
            Figure::none("pixels off by more than 1/255", differing_by(STEP + 1e-9, &far, &near)),
            Figure::told("largest difference", farthest(&far, &near)),
        ])
    };
    let mut figures = worst([of(EARTH)?, of(20_037_508.0)?]);
    figures.push(Figure::at_least(5.0, "covered, pixels", near.covered()));
    Ok(figures)
}

/// The middle of a box's northern edge, in the middle of 64 rows of 200 km.
fn box_of(northern: &str) -> Setup {
    let camera = "eye_geo = [-100, 41.770, 400000], target_geo = [-100, 41.770, 0], projection = \"orthographic\", height_m = 200000.0";
    let coarse = Setup::globe(camera, &polygon(&format!("[-120, 30], [-80, 30], {northern}"), ""));
    Setup {
        text: coarse.text.replace("posts = [73, 37], cell_deg = 5", "posts = [361, 181], cell_deg = 1"),
        ..coarse
    }
}

/// The edge as a geodesic, a vertex each quarter of a degree or so; along the parallel where there is no ellipsoid.
fn geodesic() -> Setup {
    let Ok(ground) = Crs::parse("EPSG:4326").and_then(|crs| Geodesy::of(&crs)) else {
        return box_of(PARALLEL);
    };
    let way = ground.curve(CurveKind::Geodesic, DVec2::new(-120.0, 40.0), DVec2::new(-80.0, 40.0));
    let places: Vec<[f64; 2]> = (0..=160).rev().map(|k| way.at(f64::from(k) / 160.0).to_array()).collect();
    box_of(&points(&places))
}

/// The edge in two vertices.
const PARALLEL: &str = "[-80, 40], [-120, 40]";

fn edge_model(hand: &Hand) -> Result<Vec<Figure>> {
    let drawn = hand.draw(&geodesic(), &[])?;
    // Geometry overlay draws the border alone.
    let row = match hand.kind() {
        Some(Kind::GeometryOverlay) => drawn.middle()[1],
        _ => 64.0 - drawn.column(32),
    };
    let straight = hand.draw(&box_of(PARALLEL), &[])?;
    Ok(vec![
        // A row is 3.1 km; cells of a degree stray by less than one.
        Figure::at_most(1.0, "rows from 41.770 degrees", (row - 32.0).abs()),
        Figure::none(
            "pixels covered along the parallel",
            straight.values.iter().filter(|value| value[0] > 0.0).count(),
        ),
    ])
}

/// A line of 100 m that turns in its middle.
fn bend(turn: f64) -> String {
    points(&[[-50.0, 0.3], [0.0, 0.3], towards([0.0, 0.3], turn, 50.0)])
}

fn bent(turn: f64) -> Setup {
    Setup::map(&stroke(None, &bend(turn), 6.5, 6.5))
}

fn nearly_straight(hand: &Hand) -> Result<Vec<Figure>> {
    let of = |points: &str| Setup::map(&stroke(hand.kind(), points, 6.5, 6.5));
    let straight = of("[-50, 0.3], [50, 0.3]");
    // Ends may look as the technique has them.
    let drawn = hand.draw(&straight, &[])?;
    let mut figures = Vec::new();
    for turn in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12f64] {
        for turn in [turn, -turn] {
            let bent = hand.draw(&of(&bend(turn)), &[])?;
            figures.push(vec![
                Figure::none("pixels wrong inside", wrong_inside(&bent, &drawn)),
                Figure::told("pixels unlike the straight line's", differing(&bent, &drawn) as f64),
                Figure::at_most(
                    0.02,
                    "area off, of the line's",
                    (bent.covered() / drawn.covered() - 1.0).abs(),
                ),
            ]);
        }
    }
    Ok(worst(figures))
}

/// A turned square of 80 m with an outline of 10 m.
fn bordered(fill: &str, outline: &str) -> Setup {
    let half = 40.0 * std::f64::consts::SQRT_2;
    let corners = [17.0, 107.0, 197.0, 287.0].map(|angle| towards([0.3, 0.2], angle, half));
    let layer = format!(
        "[[layer]]\nfeatures = [{{ polygon = [{}] }}]\nfill = {{ color = \"{fill}\" }}\n\
         outline = {{ color = \"{outline}\", width_m = 10, join = \"miter\" }}\n",
        points(&corners)
    );
    Setup::map(&layer)
}

fn border(hand: &Hand) -> Result<Vec<Figure>> {
    let fill = hand.draw(&bordered("#ffffff", "#000000"), &[])?.covered();
    let outline = hand.draw(&bordered("#000000", "#ffffff"), &[])?.covered();
    let most = if hand.kind().is_none() { 1e-3 } else { 0.02 };
    Ok(vec![
        Figure::at_most(most, "fill's area off", (fill / 4900.0 - 1.0).abs()),
        Figure::at_most(most, "outline's area off", (outline / 3200.0 - 1.0).abs()),
        Figure::told("fill, square metres", fill),
        Figure::told("outline, square metres", outline),
    ])
}
