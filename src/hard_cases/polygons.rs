//! Cases 33 to 42: holes, rules, overlaps, the globe's seam and poles, order, picking.

use super::artifact::Variant;
use super::case::{BY_WINDING, Case, EDGE_NORMALS, FILLS};
use super::figure::Figure;
use super::hand::{Hand, worst};
use super::picture::differing;
use super::setup::{HILLS, Setup, points, polygon, polygons, square, towards};
use super::tiles::chance;
use crate::error::{Error, Result};
use crate::technique::{FrameOptions, Kind};
use std::fmt::Write;

const STENCIL: &[Kind] = &[Kind::StencilVolume];

pub(super) const CASES: &[Case] = &[
    Case::new(33, "A hole touches the outer ring", FILLS, (touching_ring, |hand| area(hand, &touching_ring(), 4.0, 400.0)))
        .told("earcut#45", "400 square metres.")
        .known(EDGE_NORMALS)
        .trying(BY_WINDING),
    Case::new(34, "Holes touch", FILLS, (touching_holes, |hand| area(hand, &touching_holes(), 16.0, 454.5)))
        .told("earcut#177", "454.5 square metres.")
        .known(EDGE_NORMALS)
        .trying(BY_WINDING),
    Case::new(35, "A polygon crosses itself", FILLS, (|| pentagram("nonzero"), rules))
        .told("cesium#1209", "A pentagram of radius 100: 7756.77 square metres by even-odd, 11225.70 by nonzero.")
        .known(EDGE_NORMALS)
        .trying(BY_WINDING),
    Case::new(36, "The stencil overflows", STENCIL, (|| stacked(3), overflow))
        .told("mapbox-gl-js#2269", "1 to 600 stacked prisms cover what one covers; with 8 bits that wrap, those of 256 and 512 vanish, no others.")
        .trying(&[
            Variant::right(Kind::StencilVolume, &["technique.stencil-volume.overflow=saturate"]),
            Variant::right(Kind::StencilVolume, &["device.stencil_bits=16"]),
        ]),
    Case::new(37, "Overlaps inside one batch", FILLS, (overlapping, in_sequence))
        .told("cesium#8695", "Two squares of alpha 0.5 are composed in sequence: 0.75 where they overlap.")
        .trying(&[Variant::known(
            Kind::StencilVolume,
            &["technique.stencil-volume.grouping=color"],
            "Objects of a colour share a mask, which is applied once (Schneider & Klein 2007, 4.2).",
        )]),
    Case::new(38, "The antimeridian", &Kind::ALL, (|| across(180.0), antimeridian))
        .told("maplibre#5380, cesium#9052", "A box from 170 to -170 degrees has the picture of one from 80 to 100."),
    Case::new(39, "Poles", &Kind::ALL, (|| cap_of(0.0), poles))
        .told("cesium#8033", "A ring at latitude 80 and a lune of 30 degrees are filled to the pole, and equal their turned twins."),
    Case::new(40, "Polygons smaller than a pixel", FILLS, (specks, mean))
        .told("cesium#12103", "Squares of 0.1 pixels at random places in each pixel: the mean is 0.01."),
    Case::new(41, "Order across types", FILLS, (|| pair(0, 2), order))
        .told("cesium#5903, #9419", "Red 0.5 over blue 0.5 is red 0.5 and blue 0.25 over black, for every pair of fill, outline and line."),
    Case::new(42, "Picking disagrees with drawing", &Kind::ALL, (picked, picking))
        .told("deck.gl#8760", "The id buffer has the topmost feature that covers a pixel's centre."),
];

/// How far an area of so many pixels a square metre is off.
fn area(hand: &Hand, setup: &Setup, pixels: f64, right: f64) -> Result<Vec<Figure>> {
    let area = hand.draw(setup, &[])?.covered() / pixels;
    let most = if hand.kind().is_none() { 1e-4 } else { 0.02 };
    Ok(vec![
        Figure::at_most(most, "area off", (area / right - 1.0).abs()),
        Figure::told("area, square metres", area),
    ])
}

fn touching_ring() -> Setup {
    let rings =
        "[10, 10], [25, 10], [25, 40], [10, 40]; [15, 30], [20, 35], [10, 40]; [15, 15], [15, 20], [20, 15]";
    let shifted = polygon(rings, "") + "offset = [-17.53, -25.02]\n";
    Setup::map_of(64.0, 128, &shifted)
}

fn touching_holes() -> Setup {
    let rings = "[0, 0], [20, 0], [20, 25], [0, 25]; [3, 3], [2, 12], [9, 15]; [9, 21], [2, 12], [7, 22]";
    let shifted = polygon(rings, "") + "offset = [-10.03, -12.52]\n";
    Setup::map_of(32.0, 128, &shifted)
}

fn pentagram(rule: &str) -> Setup {
    let ring = [0.0, 2.0, 4.0, 1.0, 3.0].map(|k| towards([0.3, -0.2], 83.0 - 72.0 * k, 100.0));
    Setup::map_of(256.0, 128, &polygon(&points(&ring), &format!(", rule = \"{rule}\"")))
}

fn rules(hand: &Hand) -> Result<Vec<Figure>> {
    let most = if hand.kind().is_none() { 1e-5 } else { 0.01 };
    let of = |name, rule: &str, right: f64| {
        let area = 4.0 * hand.draw(&pentagram(rule), &[])?.covered();
        Ok(Figure::at_most(most, name, (area / right - 1.0).abs()))
    };
    Ok(vec![of("even-odd area off", "even-odd", 7756.77)?, of("nonzero area off", "nonzero", 11_225.70)?])
}

/// So many squares on top of one another, seen at a slant.
fn stacked(count: usize) -> Setup {
    let features = format!("{{ polygon = [[{}]] }}, ", square([0.3, 0.2], 40.0)).repeat(count);
    let layers =
        polygons(&features, ", rule = \"nonzero\"") + "[technique.stencil-volume]\ngrouping = \"color\"\n";
    let hill = "kind = \"fbm\", seed = 1, posts = [21, 21], cell_m = 5.0, height_m = 20.0";
    Setup::new([48, 48], hill, "eye = [10, -80, 60], target = [0, 0, 5]", &layers)
}

fn overflow(hand: &Hand) -> Result<Vec<Figure>> {
    let one = hand.draw(&stacked(1), &[])?;
    let mut figures = Vec::new();
    // The truth of 600 equal squares is that of one.
    let counts: &[usize] = if hand.kind().is_none() { &[2] } else { &[2, 100, 255, 257, 511, 513, 600] };
    for count in counts {
        figures.push(hand.same(&hand.draw(&stacked(*count), &[])?, &one));
    }
    let vanish = [256, 512].iter().map(|count| Ok(hand.draw(&stacked(*count), &[])?.covered() == 0.0));
    let vanish = if hand.kind().is_none() { Vec::new() } else { vanish.collect::<Result<Vec<bool>>>()? };
    figures.push(vec![Figure::told(
        "of 256 and 512 vanish",
        vanish.iter().filter(|gone| **gone).count() as f64,
    )]);
    Ok(worst(figures))
}

fn overlapping() -> Setup {
    let squares = [[-10.3, 0.2], [9.7, -0.3]].map(|at| format!("{{ polygon = [[{}]] }}, ", square(at, 50.0)));
    Setup::map(&polygons(&squares.concat(), ", opacity = 0.5, rule = \"nonzero\""))
}

fn in_sequence(hand: &Hand) -> Result<Vec<Figure>> {
    let drawn = hand.draw(&overlapping(), &[])?;
    Ok(vec![
        Figure::at_most(0.003, "once covered, from 0.5", (drawn.shade(36, 64) - 0.5).abs()),
        Figure::at_most(0.003, "twice covered, from 0.75", (drawn.shade(64, 64) - 0.75).abs()),
    ])
}

/// A box of 20 degrees around a longitude.
fn across(longitude: f64) -> Setup {
    let [west, east] = [-10.0, 10.0].map(|by| longitude + by);
    let east = if east > 180.0 { east - 360.0 } else { east };
    let ring = points(&[[west, -10.0], [east, -10.0], [east, 10.0], [west, 10.0]]);
    let camera = format!("eye_geo = [{longitude:?}, 3, 5000000], target_geo = [{longitude:?}, 3, 0]");
    Setup::globe(&camera, &polygon(&ring, ""))
}

/// Two pictures of a globe that is turned: last digits of the worlds differ, so borders may.
fn twins(hand: &Hand, own: &Setup, other: &Setup) -> Result<Vec<Figure>> {
    let (own_drawn, other_drawn) = (hand.draw(own, &[])?, hand.draw(other, &[])?);
    let mut figures = vec![
        Figure::none(
            "pixels wrong inside, of the twin's",
            super::picture::wrong_inside(&own_drawn, &other_drawn),
        ),
        Figure::told("pixels unlike the twin's", differing(&own_drawn, &other_drawn) as f64),
        Figure::at_least(100.0, "covered, pixels", own_drawn.covered()),
    ];
    if hand.kind() != Some(Kind::GeometryOverlay) {
        figures.extend(hand.against_truth(own, &[])?);
    } else {
        // It draws the border alone.
        figures.pop();
    }
    Ok(figures)
}

fn antimeridian(hand: &Hand) -> Result<Vec<Figure>> {
    twins(hand, &across(180.0), &across(90.0))
}

/// A ring at latitude 80, begun at a longitude, and a lune that reaches the southern pole.
fn cap_of(from: f64) -> Setup {
    let ring = [0.0, 90.0, 180.0, 270.0].map(|by| [from + by, 80.0]);
    let camera = format!("eye_geo = [{from:?}, 90, 4000000], target_geo = [{from:?}, 90, 0]");
    Setup::globe(&camera, &polygon(&points(&ring), ""))
}

fn lune(west: f64) -> Setup {
    let east = west + 30.0;
    let ring = points(&[[west, 0.0], [east, 0.0], [east, -90.0], [west, -90.0]]);
    let middle = west + 15.0;
    let camera = format!("eye_geo = [{middle:?}, -80, 4000000], target_geo = [{middle:?}, -80, 0]");
    Setup::globe(&camera, &polygon(&ring, ""))
}

fn poles(hand: &Hand) -> Result<Vec<Figure>> {
    let caps = twins(hand, &cap_of(0.0), &cap_of(90.0))?;
    Ok(worst([caps, twins(hand, &lune(0.0), &lune(90.0))?]))
}

/// A square of 0.1 m somewhere in each of 48 x 48 square metres.
fn specks() -> Setup {
    let mut features = String::new();
    for k in 0..48 * 48 {
        let at = |axis: u32, cell: u32| f64::from(cell) - 24.0 + 0.05 + 0.9 * chance(2 * k + axis);
        let _ = write!(features, "{{ polygon = [[{}]] }}, ", square([at(0, k % 48), at(1, k / 48)], 0.1));
    }
    Setup::map_of(48.0, 48, &polygons(&features, ""))
}

fn mean(hand: &Hand) -> Result<Vec<Figure>> {
    let mean = hand.draw(&specks(), &[])?.covered() / 2304.0;
    // One sample in 2,304 pixels meets 23 of the squares, give or take five.
    let most = if hand.kind().is_none() { 1e-3 } else { 0.5 };
    Ok(vec![
        Figure::at_most(most, "mean off, of 0.01", (100.0 * mean - 1.0).abs()),
        Figure::told("mean", mean),
    ])
}

/// A fill, an outline and a line that all cover the map's middle.
fn types(color: &str) -> [String; 3] {
    let ring = |at| format!("features = [{{ polygon = [[{}]] }}]", square(at, 40.0));
    let paint = format!("color = \"{color}\", opacity = 0.5");
    [
        format!("[[layer]]\n{}\nfill = {{ {paint} }}\n", ring([0.3, 0.2])),
        format!("[[layer]]\n{}\noutline = {{ {paint}, width_m = 10 }}\n", ring([20.3, 0.2])),
        format!(
            "[[layer]]\nfeatures = [{{ line = [[-20, 0.2], [20, 0.3]] }}]\nline = {{ {paint}, width_m = 30 }}\n"
        ),
    ]
}

fn pair(below: usize, above: usize) -> Setup {
    Setup::map(&[&types("#0000ff")[below][..], &types("#ff0000")[above][..]].concat())
}

fn order(hand: &Hand) -> Result<Vec<Figure>> {
    let mut off: f64 = 0.0;
    for (below, above) in (0..3).flat_map(|below| (0..3).map(move |above| (below, above))) {
        let drawn = hand.draw(&pair(below, above), &[])?;
        let middle = drawn.values[64 * 128 + 64];
        off = crate::math::max(off, super::picture::distance(&middle, &[0.5, 0.0, 0.25, 1.0]));
    }
    Ok(vec![Figure::at_most(0.004, "from (0.5, 0, 0.25)", off)])
}

/// Fields of several shades over hills, on top of one another.
fn picked() -> Setup {
    let field = |k: u32| {
        let at = |axis: u32| 300.0 * chance(7 * k + axis) - 150.0;
        let shade = 40 + 20 * k;
        format!(
            "[[layer]]\nfeatures = [{{ polygon = [[{}]] }}]\nfill = {{ color = \"#{shade:02x}{shade:02x}{shade:02x}\" }}\n",
            square([at(0), at(1)], 160.0)
        )
    };
    let fields: String = (0..10).map(field).collect();
    Setup::new([64, 48], HILLS, "eye = [40, -420, 260], target = [0, 0, 40]", &fields)
}

fn picking(hand: &Hand) -> Result<Vec<Figure>> {
    let Some(kind) = hand.kind() else { return hand.against_truth(&picked(), &[]) };
    if !kind.buffer_names().iter().any(|name| name == "id") {
        return Err(Error::unsupported(format!("{} has no buffer of ids", kind.name())));
    }
    let buffers = ["id".to_owned()];
    let frame = hand.frame(&picked(), &[], &FrameOptions { buffers: &buffers, ..FrameOptions::default() })?;
    let drawn = super::picture::Picture::of_codes(&frame.image);
    let ids = frame.planes.first().map(|plane| &plane.values);
    let Some(crate::buffer::Values::U32(ids)) = ids else { return Err(Error::internal("ids are numbers")) };
    let right = hand.truth(&picked(), &[])?;
    let is_wrong = |k: &usize| {
        let shade = if ids[*k] == u32::MAX { 0.0 } else { f64::from(40 + 20 * ids[*k]) / 255.0 };
        right.is_even(*k, 1) && (drawn.values[*k][0] - shade).abs() > 2.0 * super::picture::STEP
    };
    Ok(vec![Figure::none("pixels whose id is not what is drawn", (0..ids.len()).filter(is_wrong).count())])
}
