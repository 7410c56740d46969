//! Figs. 4, 9 and 10: how lines become areas, and how samples are judged by the normals of edges.

use super::super::drawing::{Drawing, Window};
use super::super::figure::{Figure, Panel, Paper, Scale};
use super::super::pixel_grid::PixelGrid;
use super::super::shot::Shot;
use super::super::volumes::{VOLUMES, volumes};
use super::areas::{EDGES, Edge, edges};
use crate::error::{Error, Result};
use crate::space::Plan;
use crate::technique::Kind;

const CORNER: &str = include_str!("corner.toml");
/// The drawings' size.
const SIZE: [f64; 2] = [480.0, 320.0];

pub(super) const FIGURE_4: Figure = Figure {
    name: "she-4",
    paper: Paper::She,
    number: "Fig. 4",
    title: "From a line to an area",
    caption: "A line; each segment made wide by itself; the parallels cut and extended to where they meet, with caps at both ends and the edges' outward \
              normals.",
    look_for: "the overlap inside the corner and the gap outside are gone: one polygon, whose edges know their outside.",
    draw: figure_4,
};

pub(super) const FIGURE_9: Figure = Figure {
    name: "she-9",
    paper: Paper::She,
    number: "Fig. 9",
    title: "In or out by the normals of near edges",
    caption: "Each edge in a pixel votes on a sample S: for in where the vectors from S to its ends point along its normal, else for out. Only those vote on \
              which the foot of the perpendicular from S lies. Samples of P pixels, full where the sum says in: with all votes, and with those alone.",
    look_for: "with all votes samples at corners and ends are judged wrong; the pedal rule mends most of them.",
    draw: figure_9,
};

pub(super) const FIGURE_10: Figure = Figure {
    name: "she-10",
    paper: Paper::She,
    number: "Fig. 10",
    title: "Where the rule fails",
    caption: "A line with a narrow corner: the rule of edges' normals, winding numbers, and the truth.",
    look_for: "at the corner's tip and its inside the rule is off, with winding numbers nothing but the number of samples is.",
    draw: figure_10,
};

fn figure_4(_: Scale) -> Result<Vec<Panel>> {
    let shot = Shot::of(CORNER, &[])?;
    let frame = shot.frame(Kind::InverseProjection, &EDGES)?;
    let edges = edges(&frame)?;
    let window =
        Window::around(edges.iter().map(|edge| edge.from), [40.0, 40.0, SIZE[0] - 80.0, SIZE[1] - 80.0]);
    let list = &shot.stage.draw_list;
    let item = list.items().first().ok_or_else(|| Error::internal("a figure's line is lost"))?;
    let path: Vec<Plan> =
        list.strokes(item).iter().flat_map(|chain| list.vertices_of(chain).to_vec()).collect();
    let new = |title: &str| {
        let mut drawing = Drawing::new(title, SIZE);
        drawing.line(&window.all(&path), "ink edge dash");
        path.iter().for_each(|vertex| drawing.dot(window.at(*vertex), 3.5, "ink dot"));
        drawing
    };
    let mut wide = new("wide segments");
    for volume in volumes(&shot.frame(Kind::StencilVolume, &VOLUMES)?)? {
        for ring in &volume.rings {
            wide.ring(&window.all(ring), "blue area");
            wide.ring(&window.all(ring), "blue edge");
        }
    }
    let mut area = new("an area with normals");
    for edge in &edges {
        area.line(&window.all(&[edge.from, edge.to]), "orange edge");
        let middle = window.at(edge.middle());
        let normal = edge.normal() * 22.0;
        area.arrow([middle, [middle[0] + normal.x, middle[1] - normal.y]], "green edge");
    }
    Ok(vec![
        Panel::drawing("the line", new("a line").svg()),
        Panel::drawing("each segment by itself (as stencil volumes have them)", wide.svg()),
        Panel::drawing("the area, its edges and their normals", area.svg()),
    ])
}

fn figure_9(_: Scale) -> Result<Vec<Panel>> {
    let shot = Shot::of(CORNER, &[])?;
    let frame = shot.frame(Kind::InverseProjection, &[&EDGES[..], &["class"]].concat())?;
    let (edges, classes) = (edges(&frame)?, frame.whole::<1>("class")?);
    let window =
        Window::around(edges.iter().map(|edge| edge.from), [40.0, 40.0, SIZE[0] - 80.0, SIZE[1] - 80.0]);
    let grid = PixelGrid::new(&shot, 26.0);
    let [columns, rows] = [shot.view.width(), shot.view.height()];
    let voted = |title: &str, votes: &dyn Fn(&Edge, Plan) -> bool| {
        let mut drawing = grid.drawing(title);
        grid.lines(&mut drawing);
        edges.iter().for_each(|edge| drawing.line(&grid.all(&[edge.from, edge.to]), "ink edge"));
        // A pixel is a metre of the plan, whose zero is in the picture's middle.
        for k in (0..classes.len()).filter(|k| classes[*k][0] == 1) {
            let west = (k % columns) as f64 - 0.5 * columns as f64;
            let south = 0.5 * rows as f64 - (k / columns) as f64 - 1.0;
            let near: Vec<&Edge> = edges.iter().filter(|edge| edge.meets([west, south])).collect();
            for (u, v) in (0..9).map(|k| (f64::from(k % 3) + 0.5, f64::from(k / 3) + 0.5)) {
                let sample = Plan::new(west + u / 3.0, south + v / 3.0);
                let flag: i32 =
                    near.iter().filter(|edge| votes(edge, sample)).map(|edge| edge.vote(sample)).sum();
                drawing.dot(grid.at(sample), 2.8, if flag > 0 { "orange dot" } else { "soft open" });
            }
        }
        drawing.svg()
    };
    let is_on = |edge: &Edge, sample: Plan| (0.0..=1.0).contains(&edge.foot(sample));
    Ok(vec![
        Panel::drawing(
            "a sample S, the feet of its perpendiculars on the edges, and votes",
            feet(&edges, &window),
        ),
        Panel::drawing("all edges in the pixel vote (Code A alone)", voted("all edges vote", &|_, _| true)),
        Panel::drawing("those with the foot on them (Codes A and B)", voted("correlated edges vote", &is_on)),
    ])
}

/// A sample with the perpendiculars to all edges.
fn feet(edges: &[Edge], window: &Window) -> String {
    let mut drawing = Drawing::new("feet of perpendiculars", SIZE);
    let sample = Plan::new(-1.4, -1.3);
    for edge in edges {
        let foot = edge.foot(sample);
        let is_in = (0.0..=1.0).contains(&foot);
        let at = edge.from + (edge.to - edge.from) * foot;
        drawing
            .line(&window.all(&[edge.from, edge.to]), if is_in { "orange edge thick" } else { "soft edge" });
        if is_in {
            drawing.line(&window.all(&[sample, at]), "blue edge dash");
            drawing.dot(window.at(at), 3.5, "blue dot");
            let [x, y] = window.at(at);
            drawing.small([x + 6.0, y + 14.0], "start", &format!("{:+}", edge.vote(sample)));
        }
    }
    drawing.dot(window.at(sample), 5.0, "ink dot");
    let [x, y] = window.at(sample);
    drawing.word([x + 9.0, y - 6.0], "start", "S");
    drawing.svg()
}

fn figure_10(_: Scale) -> Result<Vec<Panel>> {
    let winding = "technique.inverse-projection.point_in_polygon=\"winding\"";
    let shots = [
        (Shot::of(CORNER, &[])?, "edges' normals with the pedal rule, 3 x 3 samples"),
        (Shot::of(CORNER, &[winding])?, "winding numbers, 3 x 3 samples"),
    ];
    let mut panels = Vec::new();
    for (shot, caption) in &shots {
        let frame = shot.frame(Kind::InverseProjection, &EDGES)?;
        panels.push(Panel::drawing(*caption, with_edges(shot, frame.image(), &edges(&frame)?)?));
    }
    let (shot, _) = &shots[0];
    let edges = edges(&shot.frame(Kind::InverseProjection, &EDGES)?)?;
    panels.push(Panel::drawing("the truth", with_edges(shot, &shot.truth()?, &edges)?));
    Ok(panels)
}

/// A picture of pixels with an area's edges over it.
fn with_edges(shot: &Shot, picture: &crate::buffer::Buffer<[u8; 4]>, edges: &[Edge]) -> Result<String> {
    let grid = PixelGrid::new(shot, 26.0);
    let mut drawing = grid.drawing("pixels and an area's edges");
    grid.picture(&mut drawing, picture)?;
    grid.lines(&mut drawing);
    edges.iter().for_each(|edge| drawing.line(&grid.all(&[edge.from, edge.to]), "ink edge"));
    Ok(drawing.svg())
}
