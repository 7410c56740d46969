//! How errors grow with what makes scenes hard: offsets, turns, the near plane, widths, distances, overlaps.

use super::hand::{Hand, Truths, Who};
use super::machine::{MACHINES, Machine};
use super::picture::{Picture, farthest, rmse};
use super::setup::{Setup, lines, points, polygons, square, stroke, towards};
use crate::error::{Error, ErrorKind, Result};
use crate::math;
use crate::parallel;
use crate::technique::Kind;
use serde::Serialize;

/// An error over what it grows with, of a technique on a machine.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Curve {
    /// What is changed, with its unit.
    pub over: &'static str,
    /// What the error is.
    pub error: &'static str,
    /// The technique.
    pub technique: &'static str,
    /// The machine.
    pub machine: &'static str,
    /// What was changed to, and the error.
    pub points: Vec<[f64; 2]>,
}

/// What is changed, and how the error is found.
struct Subject {
    over: &'static str,
    error: &'static str,
    values: &'static [f64],
    measure: fn(&Hand, f64) -> Result<f64>,
}

const SUBJECTS: &[Subject] = &[
    Subject {
        over: "offset, m",
        error: "largest difference from the scene at the origin",
        values: &[0.0, 1.0, 1e2, 1e4, 1e5, 1e6, 6.4e6],
        measure: by_offset,
    },
    Subject {
        over: "turn, degrees",
        error: "rms to the truth",
        values: &[1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12],
        measure: by_turn,
    },
    Subject {
        over: "near plane, m",
        error: "rms to the truth",
        values: &[0.001, 0.01, 0.1, 1.0, 4.0, 16.0, 40.0],
        measure: by_near_plane,
    },
    Subject {
        over: "width, pixels",
        error: "covered area off, of the right one",
        values: &[0.02, 0.05, 0.1, 0.3, 0.9, 3.0, 9.0, 30.0],
        measure: by_width,
    },
    Subject {
        over: "distance, m",
        error: "covered area off, of the right one",
        // Nearer than 173 m a line lies below the picture.
        values: &[200.0, 300.0, 500.0, 1000.0, 2000.0, 5000.0],
        measure: by_distance,
    },
    Subject {
        over: "overlaps",
        error: "largest difference from the truth",
        values: &[1.0, 4.0, 16.0, 64.0, 255.0, 256.0, 257.0, 600.0],
        measure: by_overlaps,
    },
];

/// All curves. `progress` is told the share that is done (0..=1), from any thread.
///
/// # Errors
/// When a scene is wrong (a bug of ours).
pub fn curves(progress: &(dyn Fn(f64) + Sync)) -> Result<Vec<Curve>> {
    let tasks: Vec<(&Subject, Kind)> =
        SUBJECTS.iter().flat_map(|subject| Kind::ALL.map(|kind| (subject, kind))).collect();
    let of = |k: usize| curves_of(tasks[k].0, tasks[k].1);
    let found: Result<Vec<Vec<Curve>>> =
        parallel::map_telling(tasks.len(), progress, of).into_iter().collect();
    Ok(found?.concat())
}

/// A technique's curves, one a machine; none where it refuses the scenes.
fn curves_of(subject: &Subject, kind: Kind) -> Result<Vec<Curve>> {
    let truths = Truths::default();
    let mut curves = Vec::new();
    for machine in MACHINES {
        let hand = Hand { who: Who::Technique(kind), machine: *machine, settings: &[], truths: &truths };
        let points = points_of(subject, &hand)?;
        if !points.is_empty() {
            curves.push(curve(subject, kind, machine, points));
        }
    }
    Ok(curves)
}

fn curve(subject: &Subject, kind: Kind, machine: &Machine, points: Vec<[f64; 2]>) -> Curve {
    let (technique, machine) = (kind.name(), machine.name);
    Curve { over: subject.over, error: subject.error, technique, machine, points }
}

fn points_of(subject: &Subject, hand: &Hand) -> Result<Vec<[f64; 2]>> {
    let mut points = Vec::new();
    for value in subject.values {
        match (subject.measure)(hand, *value) {
            Ok(error) => points.push([*value, error]),
            Err(error) if error.kind() == ErrorKind::Unsupported => {}
            Err(error) => return Err(error),
        }
    }
    Ok(points)
}

/// A road and a field over hills, all of it moved.
fn moved(hand: &Hand, by: f64) -> Setup {
    let at = |[x, y]: [f64; 2]| format!("[{:?}, {:?}]", x + by, y + by);
    let road = [[-60.0, -40.0], [10.0, 22.0], [55.0, 3.0]].map(at).join(", ");
    let field = [[-30.0, -45.0], [40.0, -30.0], [5.0, 40.0]].map(at).join(", ");
    let camera = format!("eye = [{:?}, {:?}, 110], target = [{by:?}, {by:?}, 5]", by + 5.0, by - 120.0);
    let layers = polygons(&format!("{{ polygon = [[{field}]] }}"), ", opacity = 0.5")
        + &stroke(hand.kind(), &road, 6.0, 6.0);
    Setup::new(
        [48, 48],
        "kind = \"fbm\", seed = 2, posts = [17, 17], cell_m = 10.0, height_m = 20.0",
        &camera,
        &layers,
    )
    .moved(by)
}

fn by_offset(hand: &Hand, by: f64) -> Result<f64> {
    Ok(farthest(&hand.draw(&moved(hand, by), &[])?, &hand.draw(&moved(hand, 0.0), &[])?))
}

fn by_turn(hand: &Hand, turn: f64) -> Result<f64> {
    let bend = points(&[[-50.0, 0.3], [0.0, 1.3], towards([0.0, 1.3], turn, 50.0)]);
    against_truth(hand, &Setup::map_of(128.0, 48, &stroke(hand.kind(), &bend, 8.0, 8.0)))
}

fn by_near_plane(hand: &Hand, near: f64) -> Result<f64> {
    let setup = moved(hand, 0.0);
    let near = format!("camera.near_m={near:?}");
    let changes = ["camera.eye=[5, -75, 24]", &near];
    let (drawn, right) = (hand.draw(&setup, &changes)?, hand.truth(&setup, &changes)?);
    Ok(rmse(&drawn, &right))
}

fn by_width(hand: &Hand, width: f64) -> Result<f64> {
    let setup = Setup::map_of(48.0, 48, &stroke(hand.kind(), "[-20.3, -11.7], [19.1, 14.9]", width, width));
    area_off(hand, &setup)
}

fn by_distance(hand: &Hand, distance: f64) -> Result<f64> {
    let across = format!("[-{0:?}, {distance:?}], [{0:?}, {distance:?}]", 2.0 * distance);
    let terrain = "kind = \"plane\", posts = [3, 3], cell_m = 20000.0";
    let camera = "eye = [0, 0, 100], target = [0, 1000, 100], fov_y_deg = 60, near_m = 1";
    area_off(hand, &Setup::new([16, 192], terrain, camera, &stroke(hand.kind(), &across, 2.0, 2.0)))
}

fn by_overlaps(hand: &Hand, count: f64) -> Result<f64> {
    if hand.kind() == Some(Kind::GeometryOverlay) {
        return Err(Error::unsupported("geometry-overlay draws lines, and these are fills"));
    }
    let opacity = 1.0 - math::pow(0.25, 1.0 / count);
    let square = square([0.3, 0.4], 30.0);
    let layer = match hand.kind() {
        Some(Kind::DynamicLine) => {
            let all = vec!["[-15.2, -3.1], [15.4, 7.3]"; count as usize].join(";");
            lines(&all, &format!("width_px = 9, opacity = {opacity:?}"))
        }
        _ => polygons(
            &format!("{{ polygon = [[{square}]] }}, ").repeat(count as usize),
            &format!(", opacity = {opacity:?}, rule = \"nonzero\""),
        ),
    };
    let setup = Setup::map_of(48.0, 48, &layer);
    // Where all around is the same: what borders do is not asked.
    let (drawn, right): (Picture, _) = (hand.draw(&setup, &[])?, hand.truth(&setup, &[])?);
    Ok((drawn.shade(24, 24) - right.shade(24, 24)).abs())
}

fn against_truth(hand: &Hand, setup: &Setup) -> Result<f64> {
    Ok(rmse(&hand.draw(setup, &[])?, &*hand.truth(setup, &[])?))
}

fn area_off(hand: &Hand, setup: &Setup) -> Result<f64> {
    let (drawn, right) = (hand.draw(setup, &[])?.covered(), hand.truth(setup, &[])?.covered());
    Ok((drawn - right).abs() / right)
}
