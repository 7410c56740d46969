//! Cases 29 to 32: borders of tiles and cells, structures, shared edges, history.

use super::case::{BY_WINDING, Case, EDGE_NORMALS, FILLS};
use super::figure::Figure;
use super::hand::{Hand, stage, worst};
use super::picture::{Picture, STEP};
use super::setup::{HILLS, Setup, points, polygon, polygons, stroke};
use crate::error::Result;
use crate::parallel;
use crate::technique::{self, FrameOptions, Kind};
use std::fmt::Write;

pub(super) const CASES: &[Case] = &[
    Case::new(29, "A stroke leaves its tile or cell", &Kind::ALL, (|| beside(1.0, None), borders))
        .told("cesium#13675, #13737; maplibre#4685", "At 0, w/4 and w/2 beside a border the picture is the untiled one."),
    Case::new(30, "Structures drop or reorder", &Kind::ALL, (|| crowd(&|k| k, None), permuted))
        .told("cesium's lookup of 2026", "A long line among 2,000 segments in another sequence, drawn in the order of a column: the same picture."),
    Case::new(31, "Shared edges", FILLS, (board, owners))
        .told("cesium#11291", "Squares and triangles of alpha 0.5 with corners on sample points: each sample has one owner, 0.5 everywhere.")
        .known(EDGE_NORMALS)
        .trying(BY_WINDING),
    Case::new(32, "The picture depends on what was seen before", &Kind::ALL, (|| hills(None), history))
        .told("maplibre#8251", "Seen at once or after five zooms, by 1, 3 or 8 threads: the same picture."),
];

/// An upright and a level stroke of 4 m beside the middle of the map, where tiles and cells meet.
fn beside(off: f64, kind: Option<Kind>) -> Setup {
    let upright = points(&[[off, -40.3], [off, 40.2]]);
    let level = points(&[[-40.1, off], [40.4, off]]);
    Setup::map(&stroke(kind, &format!("{upright}; {level}"), 4.0, 4.0))
}

fn borders(hand: &Hand) -> Result<Vec<Figure>> {
    let mut figures = Vec::new();
    for off in [0.0, 1.0, 2.0 - 1e-9, 2.0, 2.0 + 1e-9] {
        let setup = beside(off, hand.kind());
        if hand.kind().is_none() {
            return hand.against_truth(&setup, &[]);
        }
        let tiled = |tile: usize, changes: &[&str]| {
            let options = FrameOptions { tile, ..FrameOptions::default() };
            Ok(Picture::of_codes(&hand.frame(&setup, changes, &options)?.image))
        };
        let whole = tiled(128, &["technique.static-decal.grid=1"])?;
        for tile in [16, 64] {
            figures.push(hand.same(&tiled(tile, &["technique.static-decal.grid=1"])?, &whole));
        }
        for grid in ["technique.static-decal.grid=4", "technique.static-decal.grid=64"] {
            figures.push(hand.same(&tiled(128, &[grid])?, &whole));
        }
    }
    Ok(worst(figures))
}

/// How many segments there are beside the long line.
const SEGMENTS: u32 = 2000;

/// A number from 0 to 1 by integers alone.
pub(super) fn chance(seed: u32) -> f64 {
    let mut hash = u64::from(seed).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    hash = (hash ^ hash >> 32).wrapping_mul(0xd6e8_feb8_6659_fd93);
    ((hash ^ hash >> 32) >> 11) as f64 / (1u64 << 53) as f64
}

/// Short segments and a long one in a sequence, each as bright as its number is large, drawn in the order of their numbers.
fn crowd(number: &dyn Fn(u32) -> u32, kind: Option<Kind>) -> Setup {
    let mut features = String::new();
    for number in (0..=SEGMENTS).map(number) {
        let at = |k: u32| 120.0 * chance(4 * number + k) - 60.0;
        let [x, y] = [at(0), at(1)];
        let ends = match number {
            1000 => points(&[[-60.2, -50.1], [60.3, 50.4]]),
            _ => points(&[[x, y], [x + 0.1 * at(2), y + 0.1 * at(3)]]),
        };
        // Writing to a text does not fail.
        let _ = write!(features, "{{ line = [{ends}], properties = {{ n = {number} }} }}, ");
    }
    let width = if kind == Some(Kind::DynamicLine) { "width_px = 2" } else { "width_m = 2" };
    Setup::map(&format!(
        "[[layer]]\nfeatures = [{features}]\norder = {{ by = \"n\" }}\n\
         line = {{ color = {{ by = \"n\", stops = [[0, \"#000000\"], [{SEGMENTS}, \"#ffffff\"]] }}, {width} }}\n"
    ))
}

fn permuted(hand: &Hand) -> Result<Vec<Figure>> {
    let in_order = hand.draw(&crowd(&|k| k, hand.kind()), &[])?;
    // 2,001 and 779 have no common divisor.
    let mixed = hand.draw(&crowd(&|k| k * 779 % (SEGMENTS + 1), hand.kind()), &[])?;
    Ok(hand.same(&mixed, &in_order))
}

/// 8 x 8 cells of 6 m, a third of them squares, the others two triangles, with corners on the middles of pixels.
fn board() -> Setup {
    let mut features = String::new();
    for k in 0..64 {
        let (x, y) = (f64::from(k % 8) * 6.0 - 24.5, f64::from(k / 8) * 6.0 - 24.5);
        let (e, n) = (x + 6.0, y + 6.0);
        let rings = match k % 3 {
            0 => vec![points(&[[x, y], [e, y], [e, n], [x, n]])],
            _ => vec![points(&[[x, y], [e, y], [e, n]]), points(&[[x, y], [e, n], [x, n]])],
        };
        for ring in rings {
            let _ = write!(features, "{{ polygon = [[{ring}]] }}, ");
        }
    }
    Setup::map(&polygons(&features, ", opacity = 0.5"))
}

fn owners(hand: &Hand) -> Result<Vec<Figure>> {
    let drawn = hand.draw(&board(), &[])?;
    let inside = (42..86).flat_map(|y| (42..86).map(move |x| (x, y)));
    let wrong = inside.filter(|(x, y)| (drawn.shade(*x, *y) - 0.5).abs() > 2.0 * STEP).count();
    Ok(vec![Figure::none("pixels that are not 0.5", wrong)])
}

/// A field and a road over hills.
fn hills(kind: Option<Kind>) -> Setup {
    let field = polygon("[-150, -150], [120, -180], [60, 20], [160, 150], [-120, 90]", "");
    let road = stroke(kind, "[-280, -200], [0, 100], [250, -60], [300, 280]", 12.0, 5.0);
    Setup::new([64, 48], HILLS, "eye = [40, -420, 260], target = [0, 0, 40]", &(field + &road))
}

fn history(hand: &Hand) -> Result<Vec<Figure>> {
    let setup = hills(hand.kind());
    let Some(kind) = hand.kind() else { return hand.against_truth(&setup, &[]) };
    let changes = [hand.machine.keys, hand.settings].concat();
    let stage_of = |more: &[&str]| stage(&setup, &[&changes[..], more].concat());
    let here = stage_of(&[])?;
    let (view, options) = (here.view()?, FrameOptions::default());
    let direct = Picture::of_codes(&technique::prepare(kind, &here)?.frame(&view, &options)?.image);
    let prepared = technique::prepare(kind, &here)?;
    for height in ["2000", "900", "500", "400", "300"] {
        let other = stage_of(&[&format!("camera.eye=[40, -420, {height}]")])?.view()?;
        prepared.frame(&other, &options)?;
    }
    let after = Picture::of_codes(&prepared.frame(&view, &options)?.image);
    let mut figures = vec![hand.same(&after, &direct)];
    for threads in [1, 3, 8] {
        let frame = parallel::with_threads(threads, || prepared.frame(&view, &FrameOptions::default()))??;
        figures.push(hand.same(&Picture::of_codes(&frame.image), &direct));
    }
    Ok(worst(figures))
}
