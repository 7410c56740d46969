//! Figs. 4 to 8: how lines become polygons.

use super::super::drawing::{Drawing, Window};
use super::super::figure::{Figure, Panel, Paper};
use super::super::shot::Shot;
use super::super::strips::{Primitive, Tessellated};
use crate::error::Result;

const JOINT: &str = include_str!("joint.toml");
const SIZE: [f64; 2] = [440.0, 300.0];

const SEGMENT: &str = "layer.line.features=[{ line = [[-14, -5], [14, 5]] }]";
const POLYLINE: &str = "layer.line.features=[{ line = [[-22, -6], [-7, 4], [8, -3], [20, 8]] }]";
const WIDE: &str = "layer.line.features=[{ line = [[-16, -7], [0, 5], [17, -2]] }]";
const ACUTE: &str = "layer.line.features=[{ line = [[-15, -7], [11, 2], [-13, 8]] }]";

pub(super) const FIGURE_4: Figure = Figure {
    name: "taibo-4",
    paper: Paper::Taibo,
    number: "Fig. 4",
    title: "A segment as an area",
    caption: "Method 1: each end of a segment becomes two vertices, half the width to its left and right.",
    look_for: "vertices in the order of the strip: left, right, left, right.",
    draw: |_| Ok(vec![drawn("method 1", [SEGMENT, "method-1"], Primitive::Triangles)?]),
};

pub(super) const FIGURE_5: Figure = Figure {
    name: "taibo-5",
    paper: Paper::Taibo,
    number: "Fig. 5",
    title: "Segments that are not connected",
    caption: "A polyline of which each segment is an area by itself (method 1).",
    look_for: "gaps outside of each joint, overlaps inside.",
    draw: |_| Ok(vec![drawn("method 1", [POLYLINE, "method-1"], Primitive::Triangles)?]),
};

pub(super) const FIGURE_6: Figure = Figure {
    name: "taibo-6",
    paper: Paper::Taibo,
    number: "Fig. 6",
    title: "Two segments connected",
    caption: "Method 2: the sides of both segments run on to where they meet, left and right.",
    look_for: "one pair of vertices for the joint.",
    draw: |_| Ok(vec![drawn("method 2", [WIDE, "method-2"], Primitive::Triangles)?]),
};

pub(super) const FIGURE_7: Figure = Figure {
    name: "taibo-7",
    paper: Paper::Taibo,
    number: "Fig. 7",
    title: "Two segments that join in an acute angle",
    caption: "Method 2 where the angle is acute: the outer sides meet far away.",
    look_for: "the pike, which grows without a limit as the angle shrinks.",
    draw: |_| Ok(vec![drawn("method 2", [ACUTE, "method-2"], Primitive::Triangles)?]),
};

pub(super) const FIGURE_8: Figure = Figure {
    name: "taibo-8",
    paper: Paper::Taibo,
    number: "Fig. 8",
    title: "Ways to tessellate an acute joint",
    caption: "Methods 3a and 3b, drawn as a strip of triangles and as one of quadrilaterals.",
    look_for: "what is covered twice is darker: it shows in lines that are translucent. Method 3b covers nothing twice.",
    draw: |_| {
        let ways = [
            ("method 3a, triangles", "method-3a-strip", Primitive::Triangles),
            ("method 3a, quadrilaterals", "method-3a-quads", Primitive::Quads),
            ("method 3b, triangles", "method-3b", Primitive::Triangles),
            ("method 3b, quadrilaterals", "method-3b", Primitive::Quads),
        ];
        ways.iter().map(|(caption, joints, primitive)| drawn(caption, [ACUTE, joints], *primitive)).collect()
    },
};

/// The strips of a line, in numbers and areas.
fn drawn(caption: &str, [line, joints]: [&str; 2], primitive: Primitive) -> Result<Panel> {
    let joints = format!("technique.clipmap.joints=\"{joints}\"");
    let line = Tessellated::of(&Shot::of(JOINT, &[line, &joints])?)?;
    let window = Window::around(line.points(), [36.0, 36.0, SIZE[0] - 72.0, SIZE[1] - 72.0]);
    let mut drawing = Drawing::new(caption, SIZE);
    for area in line.strips.iter().flat_map(|strip| primitive.areas(strip)) {
        drawing.ring(&window.all(&area), "blue area");
        drawing.ring(&window.all(&area), "blue edge thin");
    }
    for path in &line.paths {
        drawing.line(&window.all(path), "ink edge");
        path.iter().for_each(|vertex| drawing.dot(window.at(*vertex), 3.0, "ink dot"));
    }
    for (k, vertex) in line.strips.iter().flatten().enumerate() {
        let [x, y] = window.at(*vertex);
        drawing.dot([x, y], 3.0, "orange dot");
        // Vertices in one place have their numbers side by side.
        let before = line.strips.iter().flatten().take(k).filter(|other| **other == *vertex).count();
        drawing.small([x + 6.0 + 18.0 * before as f64, y - 6.0], "start", &(k + 1).to_string());
    }
    Ok(Panel::drawing(caption, drawing.svg()))
}
