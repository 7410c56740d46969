//! Figs. 1 and 2: a line over the triangles of a quad.

use super::super::clippings::{Clipping, clippings};
use super::super::drawing::{Drawing, Window};
use super::super::figure::{Figure, Panel, Paper, Scale};
use super::super::shot::Shot;
use crate::error::Result;
use crate::space::Plan;

const QUAD: &str = include_str!("quad.toml");
const SEGMENT: &str = "layer.line.features=[{ line = [[6, 14], [73, 63]] }]";
const SIZE: [f64; 2] = [420.0, 420.0];
/// The posts that are drawn: nine by nine in the quad's middle.
const POSTS: [f64; 2] = [64.0, 72.0];

pub(super) const FIGURE_1: Figure = Figure {
    name: "wartell-1",
    paper: Paper::Wartell,
    number: "Fig. 1",
    title: "A polyline over meshes of three resolutions",
    caption: "Nine by nine posts of a quad, all of them, every second and every fourth in the mesh, and a line cut at the mesh's triangles.",
    look_for: "the parts of the line in neighbouring triangles, in two colours: fewer and longer ones where triangles are larger.",
    draw: figure_1,
};

pub(super) const FIGURE_2: Figure = Figure {
    name: "wartell-2",
    paper: Paper::Wartell,
    number: "Fig. 2",
    title: "Triangle clippings of one segment",
    caption: "One segment's triangle clippings, layer by layer from the smallest triangles to those four times as high and wide; the number of each is its row in the \
              program's table. Full arrows are nextTriangle[0], broken ones nextTriangle[1].",
    look_for: "a clipping goes on in its own layer or in the one beside it: which of the two is decided by one vertex of the mesh.",
    draw: figure_2,
};

fn window() -> Window {
    let [low, high] = POSTS;
    Window::around([Plan::new(low, low), Plan::new(high, high)], [20.0, 20.0, SIZE[0] - 40.0, SIZE[1] - 40.0])
}

/// Whether all of these are among the posts that are drawn.
fn is_shown(corners: &[Plan]) -> bool {
    let within = POSTS[0]..=POSTS[1];
    corners.iter().all(|post| within.contains(&post.x) && within.contains(&post.y))
}

fn figure_1(_: Scale) -> Result<Vec<Panel>> {
    let window = window();
    let mut panels = Vec::new();
    for (level, caption) in [(0, "all posts"), (1, "every second post"), (2, "every fourth post")] {
        let lod = format!("terrain.lod.level={level}");
        let shot = Shot::of(QUAD, &[&lod])?;
        let mut drawing = Drawing::new(caption, SIZE);
        let mesh = shot.stage.mesh_for(&shot.view);
        // Posts are ten metres apart, and the middle one, number 64, is the plan's zero.
        let post = |x: f64, y: f64| Plan::new(64.0 + 0.1 * x, 64.0 + 0.1 * y);
        for corners in (0..mesh.triangle_ids()).filter_map(|id| mesh.triangle(id)) {
            let corners = corners.map(|corner| post(corner.x, corner.y));
            if is_shown(&corners) {
                drawing.ring(&window.all(&corners), "ground");
            }
        }
        let of_mesh = |clipping: &&Clipping| clipping.layer == 2 * level;
        for (k, clipping) in clippings(&shot)?.iter().filter(of_mesh).enumerate() {
            drawing.line(
                &window.all(&clipping.line),
                if k % 2 == 0 { "orange edge thick" } else { "blue edge thick" },
            );
            for end in [clipping.line.first(), clipping.line.last()].into_iter().flatten() {
                drawing.dot(window.at(*end), 2.5, "ink dot");
            }
        }
        panels.push(Panel::drawing(caption, drawing.svg()));
    }
    Ok(panels)
}

fn figure_2(_: Scale) -> Result<Vec<Panel>> {
    let window = window();
    let all = clippings(&Shot::of(QUAD, &[SEGMENT])?)?;
    let middle = |clipping: &Clipping| {
        let [a, b, c] = clipping.corners;
        window.at(a + ((b - a) + (c - a)) * (1.0 / 3.0))
    };
    let mut panels = Vec::new();
    for layer in 0..5 {
        let mut drawing = Drawing::new(format!("layer {layer}"), SIZE);
        let here = || all.iter().filter(|one| one.layer == layer && is_shown(&one.corners));
        for clipping in here() {
            drawing.ring(&window.all(&clipping.corners), "blue area faint");
            drawing.ring(&window.all(&clipping.corners), "blue edge");
        }
        for clipping in here() {
            drawing.line(&window.all(&clipping.line), "orange edge thick");
        }
        for clipping in here() {
            for (next, class) in clipping.next.iter().zip(["ink edge", "ink edge dash"]) {
                let beyond = next.and_then(|next| all.get(next)).filter(|next| is_shown(&next.corners));
                if let Some(next) = beyond {
                    drawing.arrow([middle(clipping), middle(next)], class);
                }
            }
        }
        for clipping in here() {
            let [x, y] = middle(clipping);
            drawing.small([x, y - 5.0], "middle", &clipping.row.to_string());
        }
        panels.push(Panel::drawing(format!("layer {layer}"), drawing.svg()));
    }
    Ok(panels)
}
