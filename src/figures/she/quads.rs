//! Figs. 3, 5, 6 and 8: from pixels to the plan, by volumes and by quadrilaterals.

use super::super::drawing::{Drawing, Window};
use super::super::figure::{Figure, Panel, Paper, Scale};
use super::super::scenery::{Scenery, on_ray};
use super::super::shot::Shot;
use super::super::volumes::{VOLUMES, volumes};
use super::areas::{EDGES, edges};
use crate::error::Result;
use crate::space::{Plan, Screen, World};
use crate::technique::Kind;

const HILLOCK: &str = include_str!("hillock.toml");
/// Where the observer stands and looks to.
const OBSERVER: [[f64; 3]; 2] = [[205.0, -190.0, 120.0], [-4.0, -38.0, 14.0]];
const SIZE: (usize, usize) = (680, 460);
/// How far before the eye its picture is drawn, metres.
const PICTURE: f64 = 34.0;
/// The height at which the plan is drawn, metres.
const PLANE: f64 = -46.0;

pub(super) const FIGURE_3: Figure = Figure {
    name: "she-3",
    paper: Paper::She,
    number: "Fig. 3",
    title: "How stencil volumes colour two pixels",
    caption: "A camera of 12 x 8 pixels, the terrain, and the volumes of a road: pixel 1 sees a point of the terrain that lies in a volume, pixel 2 does not.",
    look_for: "volumes reach a little below and above the terrain; that is all of the road that is in them.",
    draw: figure_3,
};

pub(super) const FIGURE_5: Figure = Figure {
    name: "she-5",
    paper: Paper::She,
    number: "Fig. 5",
    title: "How inverse projection colours pixels",
    caption: "The same pixels as quadrilaterals in the plan, drawn below the terrain: without the road (grey), on its border (orange), wholly in it (blue).",
    look_for: "the road is a polygon of the plan; no volume is needed. Quadrilaterals of neighbours share their sides.",
    draw: figure_5,
};

pub(super) const FIGURE_6: Figure = Figure {
    name: "she-6",
    paper: Paper::She,
    number: "Fig. 6",
    title: "Gaps between pixels, and how they are closed",
    caption: "Pixels in the plan: with the depth of its centre for all four corners of a pixel, and with what its own centre and those of its right, upper \
              right and upper neighbours see.",
    look_for: "gaps and overlaps in (a), none in (b), where all has moved by half a pixel. Dots are the points that centres see.",
    draw: figure_6,
};

fn figure_3(_: Scale) -> Result<Vec<Panel>> {
    let shot = Shot::of(HILLOCK, &[])?;
    let frame = shot.frame(Kind::StencilVolume, &[&VOLUMES[..], &["stencil", "plan"]].concat())?;
    let mut scenery = Scenery::new("a camera, terrain and a road's volumes", SIZE, OBSERVER)?;
    scenery.terrain(&shot.stage.mesh);
    for volume in volumes(&frame)? {
        for face in volume.faces() {
            scenery.ring(&face, "orange area faint");
            scenery.ring(&face, "orange edge thin");
        }
    }
    scenery.camera(&shot.view, PICTURE);
    let (counts, plan) = (frame.whole::<1>("stencil")?, frame.real::<2>("plan")?);
    let first = |is_in: bool| {
        let is_such = |k: &usize| plan[*k][0].is_finite() && (counts[*k][0] > 0) == is_in;
        let near = if is_in { 0 } else { counts.len() };
        (0..counts.len()).filter(is_such).min_by_key(|k| k.abs_diff(near))
    };
    for (pixel, class, word) in [(first(true), "orange", "pixel 1"), (first(false), "blue", "pixel 2")] {
        let Some(pixel) = pixel else { continue };
        let seen = shot.on_ground(Plan::new(plan[pixel][0], plan[pixel][1]));
        scenery.line(&[shot.view.eye(), seen], &format!("{class} edge"));
        scenery.dot(seen, &format!("{class} dot"), word);
    }
    let caption =
        "stencil volumes: the terrain's point that a pixel's centre sees is in a volume, or in none";
    Ok(vec![Panel::drawing(caption, scenery.svg())])
}

fn figure_5(_: Scale) -> Result<Vec<Panel>> {
    let shot = Shot::of(HILLOCK, &[])?;
    let frame = shot.frame(Kind::InverseProjection, &[&EDGES[..], &["class", "quad", "plan"]].concat())?;
    let mut scenery = Scenery::new("a camera, terrain, and pixels in the plan", SIZE, OBSERVER)?;
    let (classes, quads) = (frame.whole::<1>("class")?, frame.real::<8>("quad")?);
    let below = |x: f64, y: f64| World::new(x, y, PLANE);
    for ([class], quad) in classes.iter().zip(&quads) {
        let corners: Vec<World> = quad.as_chunks::<2>().0.iter().map(|[x, y]| below(*x, *y)).collect();
        if corners.iter().all(|corner| corner.is_finite()) {
            let look = ["grid area", "orange area", "blue area"].get(*class as usize).copied();
            scenery.ring(&corners, look.unwrap_or_default());
            scenery.ring(&corners, "soft edge thin");
        }
    }
    for edge in edges(&frame)? {
        scenery.line(&[below(edge.from.x, edge.from.y), below(edge.to.x, edge.to.y)], "ink edge");
    }
    scenery.terrain(&shot.stage.mesh);
    scenery.camera(&shot.view, PICTURE);
    let columns = shot.view.width();
    let wanted = [1, 2].map(|class| (0..classes.len()).rev().find(|k| classes[*k][0] == class));
    for (pixel, class) in wanted.into_iter().zip(["orange", "blue"]) {
        let Some(pixel) = pixel else { continue };
        let at = Screen::new((pixel % columns) as f64 + 0.5, (pixel / columns) as f64 + 0.5);
        let [x, y] = frame.real::<2>("plan")?[pixel];
        let seen = shot.on_ground(Plan::new(x, y));
        scenery.line(&[shot.view.eye(), on_ray(&shot.view, at, PICTURE), seen], &format!("{class} edge"));
        scenery.line(&[seen, below(x, y)], &format!("{class} edge dash"));
        scenery.dot(seen, &format!("{class} dot"), "");
        scenery.dot(
            below(x, y),
            &format!("{class} dot"),
            if class == "blue" { "F pixel" } else { "P pixel" },
        );
    }
    Ok(vec![Panel::drawing("the plan is drawn below the terrain, where nothing else is", scenery.svg())])
}

/// A few pixels of the middle, as shares of the picture.
fn is_shown(k: usize, columns: usize) -> bool {
    (3..9).contains(&(k % columns)) && (2..7).contains(&(k / columns))
}

fn figure_6(_: Scale) -> Result<Vec<Panel>> {
    let shot = Shot::of(HILLOCK, &["terrain.generate.height_m=45"])?;
    let frame = shot.frame(Kind::InverseProjection, &["depth", "plan", "quad"])?;
    let (depths, plan, quads) =
        (frame.real::<1>("depth")?, frame.real::<2>("plan")?, frame.real::<8>("quad")?);
    let columns = shot.view.width();
    let shown: Vec<usize> =
        (0..quads.len()).filter(|k| is_shown(*k, columns) && depths[*k][0].is_finite()).collect();
    let own_depth = |k: usize| {
        let [x, y] = [k % columns, k / columns].map(|v| v as f64);
        let corners = [[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]];
        let on_ground = |[x, y]: [f64; 2]| on_ray(&shot.view, Screen::new(x, y), depths[k][0]);
        corners.map(on_ground).map(|point| Plan::new(point.x, point.y)).to_vec()
    };
    let of_neighbours =
        |k: usize| quads[k].as_chunks::<2>().0.iter().map(|[x, y]| Plan::new(*x, *y)).collect::<Vec<_>>();
    let all = shown.iter().flat_map(|k| [own_depth(*k), of_neighbours(*k)].concat());
    let window = Window::around(all.filter(|point| point.is_finite()), [10.0, 10.0, 460.0, 400.0]);
    let drawn = |corners: &dyn Fn(usize) -> Vec<Plan>| {
        let mut drawing = Drawing::new("pixels in the plan", [480.0, 420.0]);
        for k in &shown {
            let quad = window.all(&corners(*k));
            drawing.ring(&quad, "blue area");
            drawing.ring(&quad, "blue edge");
        }
        for k in &shown {
            drawing.dot(window.at(Plan::new(plan[*k][0], plan[*k][1])), 2.5, "orange dot");
        }
        drawing.svg()
    };
    Ok(vec![
        Panel::drawing("each corner at the depth of its pixel's centre", drawn(&own_depth)),
        Panel::drawing("corners are what four neighbours' centres see", drawn(&of_neighbours)),
    ])
}

/// The panels of Fig. 8: a pixel on the screen and in the plan.
pub(super) fn sample_spaces() -> Result<Vec<Panel>> {
    let shot = Shot::of(HILLOCK, &[])?;
    let quads = shot.frame(Kind::InverseProjection, &["quad"])?.real::<8>("quad")?;
    let (column, row) = (4, 3);
    let quad: Vec<Plan> = quads[row * shot.view.width() + column]
        .as_chunks::<2>()
        .0
        .iter()
        .map(|[x, y]| Plan::new(*x, *y))
        .collect();
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| Plan::new(x, y));
    let drawn = |title: &str, corners: &[Plan]| {
        let window = Window::around(corners.iter().copied(), [20.0, 20.0, 320.0, 320.0]);
        let mut drawing = Drawing::new(title, [360.0, 360.0]);
        drawing.ring(&window.all(corners), "blue area faint");
        drawing.ring(&window.all(corners), "blue edge");
        for (u, v) in (0..9).map(|k| ((f64::from(k % 3) + 0.5) / 3.0, (f64::from(k / 3) + 0.5) / 3.0)) {
            let lower = corners[0] + (corners[1] - corners[0]) * u;
            let upper = corners[3] + (corners[2] - corners[3]) * u;
            drawing.dot(window.at(lower + (upper - lower) * v), 4.0, "orange dot");
        }
        drawing.svg()
    };
    Ok(vec![
        Panel::drawing("on the screen", drawn("a pixel", &square)),
        Panel::drawing("in the plan", drawn("a pixel's quadrilateral", &quad)),
    ])
}
