//! Figs. 2.5 and 3.10: lines on the mesh, corners in positions.

use super::super::clippings::clippings;
use super::super::drawing::{Drawing, Window};
use super::super::figure::{Figure, Panel, Paper, Scale};
use super::super::shot::Shot;
use super::super::strips::{Primitive, Tessellated};
use crate::error::Result;
use crate::space::Plan;

const BEND: &str = include_str!("bend.toml");
const QUAD: &str = include_str!("../wartell/quad.toml");
const SIZE: [f64; 2] = [480.0, 320.0];

pub(super) const FIGURE_2_5: Figure = Figure {
    name: "zechmeister-2.5",
    paper: Paper::Zechmeister,
    number: "Fig. 2.5",
    title: "A line gets the vertices that the mesh asks for",
    caption: "A line of one segment over the terrain's triangles from above and from the side: where it crosses an edge it gets a vertex.",
    look_for: "from the side the straight line is off the ground, the divided one is on it.",
    draw: figure_2_5,
};

pub(super) const FIGURE_3_10: Figure = Figure {
    name: "zechmeister-3.10",
    paper: Paper::Zechmeister,
    number: "Fig. 3.10",
    title: "Positions of three kinds of corners",
    caption: "A line of three segments with its vertices, and the vertices that round corners, miters and bevels need.",
    look_for: "the inner side of a corner is the same in all.",
    draw: figure_3_10,
};

fn figure_2_5(_: Scale) -> Result<Vec<Panel>> {
    let shot = Shot::of(QUAD, &["layer.line.features=[{ line = [[4, 13], [76, 63]] }]"])?;
    // Posts are ten metres apart, and the middle one, number 64, is the plan's zero.
    let of_post = |post: &Plan| Plan::new(10.0 * (post.x - 64.0), 10.0 * (post.y - 64.0));
    let mut cut: Vec<Plan> = Vec::new();
    for clipping in clippings(&shot)?.iter().filter(|clipping| clipping.layer == 0) {
        let fresh = clipping.line.iter().map(of_post).filter(|point| cut.last() != Some(point));
        cut.extend(fresh.collect::<Vec<_>>());
    }
    let ends = [cut.first(), cut.last()].map(|end| end.copied().unwrap_or_default());
    let window = Window::around([Plan::new(0.0, 0.0), Plan::new(80.0, 80.0)], [10.0, 10.0, 300.0, 300.0]);
    let mut above = Drawing::new("from above", [320.0, 320.0]);
    let mesh = shot.stage.mesh_for(&shot.view);
    for corners in (0..mesh.triangle_ids()).filter_map(|id| mesh.triangle(id)) {
        let corners = corners.map(|corner| Plan::new(corner.x, corner.y));
        if corners.iter().all(|at| (0.0..=80.0).contains(&at.x) && (0.0..=80.0).contains(&at.y)) {
            above.ring(&window.all(&corners), "ground");
        }
    }
    above.line(&window.all(&cut), "orange edge thick");
    cut.iter().for_each(|point| above.dot(window.at(*point), 3.0, "blue dot"));
    let along = |point: &Plan| Plan::new((*point - ends[0]).length(), 2.0 * shot.on_ground(*point).z);
    let profile: Vec<Plan> = cut.iter().map(along).collect();
    let window = Window::around(profile.iter().copied(), [16.0, 16.0, SIZE[0] - 32.0, SIZE[1] - 32.0]);
    let mut side = Drawing::new("from the side", SIZE);
    side.line(&window.all(&ends.map(|end| along(&end))), "ink edge dash");
    side.line(&window.all(&profile), "orange edge thick");
    profile.iter().for_each(|point| side.dot(window.at(*point), 3.0, "blue dot"));
    Ok(vec![
        Panel::drawing("from above", above.svg()),
        Panel::drawing("from the side, twice as high; broken: the line as it was", side.svg()),
    ])
}

fn figure_3_10(_: Scale) -> Result<Vec<Panel>> {
    let joins = ["round", "miter", "bevel"];
    let panel = |join: &&str| {
        let line = Tessellated::of(&Shot::of(BEND, &[&format!("layer.line.line.join=\"{join}\"")])?)?;
        let window = Window::around(line.points(), [30.0, 30.0, SIZE[0] - 60.0, SIZE[1] - 60.0]);
        let mut drawing = Drawing::new(*join, SIZE);
        for area in line.strips.iter().flat_map(|strip| Primitive::Triangles.areas(strip)) {
            drawing.ring(&window.all(&area), "blue area faint");
            drawing.ring(&window.all(&area), "blue edge thin");
        }
        line.strips.iter().flatten().for_each(|vertex| drawing.dot(window.at(*vertex), 3.0, "orange dot"));
        for path in &line.paths {
            drawing.line(&window.all(path), "ink edge");
            path.iter().for_each(|vertex| drawing.dot(window.at(*vertex), 3.0, "ink dot"));
        }
        Ok(Panel::drawing(*join, drawing.svg()))
    };
    joins.iter().map(panel).collect()
}
