//! `static-decal`: each sample looks its plan point up in the grid of cells, and composes what holds it.

use crate::frame::Frame;
use crate::tables::{self, Tables};

/// Of what the shader is made, in this order, behind the tables' places.
const PARTS: [&str; 5] = [
    include_str!("glsl/tables.glsl"),
    include_str!("glsl/ground.glsl"),
    include_str!("glsl/stroke.glsl"),
    include_str!("glsl/compose.glsl"),
    include_str!("glsl/decal.glsl"),
];

const MAIN: &str = "
uniform sampler2D plan;
uniform usampler2D ids;
uniform vec4 sky;
uniform float share;
layout(location = 0) out vec4 to;
void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  uint id = texelFetch(ids, p, 0).x;
  vec2 P = texelFetch(plan, p, 0).xy;
  look_up(P);
  to = (id == NONE ? sky : compose(vec4(ground(id, P), 1.0))) * share;
}";

/// Sixteenths of a pixel to the right and down, as Direct3D and Vulkan place samples.
const FOUR: [[f64; 2]; 4] = [[-2.0, -6.0], [6.0, -2.0], [-6.0, 2.0], [2.0, 6.0]];
const EIGHT: [[f64; 2]; 8] =
    [[1.0, -3.0], [-1.0, 3.0], [5.0, 1.0], [-3.0, -5.0], [-5.0, 5.0], [-7.0, -1.0], [3.0, 7.0], [7.0, -7.0]];

/// Where samples lie, pixels from the centre, right and down.
fn places(samples: usize, bug: &str) -> Vec<[f64; 2]> {
    let sixteenths = |of: &[[f64; 2]]| of.iter().map(|p| p.map(|v| v / 16.0)).collect();
    let mut places: Vec<[f64; 2]> = match samples {
        4 => sixteenths(&FOUR),
        8 => sixteenths(&EIGHT),
        count => {
            let n = (count as f64).sqrt().round() as usize;
            let at = |k: usize| (k as f64 + 0.5) / n as f64 - 0.5;
            (0..n * n).map(|k| [at(k % n), at(k / n)]).collect()
        }
    };
    match bug {
        "one-sample" => places = vec![[0.0; 2]],
        "transposed" => places.iter_mut().for_each(|p| p.swap(0, 1)),
        _ => {}
    }
    places
}

/// A single-precision number that is not more, or not less.
fn outwards(v: f64, up: bool) -> f32 {
    let near = v as f32;
    match up {
        true if f64::from(near) < v => near.next_up(),
        false if f64::from(near) > v => near.next_down(),
        _ => near,
    }
}

fn structures(frame: &Frame) -> Result<Tables, String> {
    let of = frame.bundle;
    let origin = of.numbers(&["origin"]);
    let mut tables = Tables::default();
    let boxes = |values: Vec<f64>, round: bool| -> Vec<f32> {
        let local = |k: usize, v: f64| {
            let v = v - origin[k % 2];
            if round { outwards(v, k % 4 >= 2) } else { v as f32 }
        };
        values.into_iter().enumerate().map(|(k, v)| local(k, v)).collect()
    };
    for (name, table) in [
        ("CELLS", "cells"),
        ("LINE_NODES", "line-nodes"),
        ("SEGMENTS", "segments"),
        ("POLYGON_NODES", "polygon-nodes"),
        ("POLYGONS", "polygons"),
        ("AREAS", "areas"),
        ("PARTS", "ring-parts"),
        ("RINGS", "rings"),
        ("NODES", "quadtree-nodes"),
        ("LEAVES", "quadtree-leaves"),
        ("EDGES", "quadtree-edges"),
    ] {
        let is_side = |k: usize| frame.bug == "no-cut" && table == "segments" && k % 6 == 5;
        let values = of.own(table)?.into_iter().enumerate();
        tables.whole(name, values.map(|(k, v)| if is_side(k) { 0 } else { v as u32 }));
    }
    let mut styles = of.own("styles")?;
    for style in styles.chunks_exact_mut(6) {
        match frame.bug {
            "nonzero" => style[1] = 1.0,
            "no-cut" => style[2] = 0.0,
            "bevel" => style[3] = 1.0,
            "no-caps" => style[4] = 0.0,
            _ => {}
        }
    }
    tables.whole("STYLES", styles.into_iter().map(|v| v as u32));
    tables.whole("ITEM_STYLES", of.own("items")?.chunks_exact(3).map(|row| row[2] as u32));
    let wider = if frame.bug == "wide-lines" { 1.05 } else { 1.0 };
    let values = of.own("style-values")?;
    tables.single("VALUES", values.chunks_exact(7).flat_map(|v| [(v[4] * wider) as f32, v[5] as f32]));
    let vertices = of.own("decal-vertices")?;
    let local = |k: usize, v: f64| match frame.bug {
        "f32-subtract" => v as f32 - origin[k % 2] as f32,
        _ => (v - origin[k % 2]) as f32,
    };
    tables.single("VERTICES", vertices.into_iter().enumerate().map(|(k, v)| local(k, v)));
    tables.single("GRID", boxes(of.own("grid")?, false));
    tables.single("LINE_BOXES", boxes(of.own("line-boxes")?, true));
    tables.single("POLYGON_BOXES", boxes(of.own("polygon-boxes")?, true));
    tables.single("QUADS", boxes(of.own("quadtree-boxes")?, false));
    tables.number("CELLS_A_SIDE", of.number(&["settings", "grid"]).unwrap_or(1.0) as i32);
    tables.number("WIDE", if of.word(&["settings", "hierarchy"]) == "wide" { 8 } else { 2 });
    let twice = of.word(&["settings", "overlaps"]) == "double" || frame.bug == "twice";
    tables.number("TWICE", i32::from(twice));
    tables::items(of, frame.bug, &mut tables)?;
    Ok(tables)
}

pub fn draw(frame: &mut Frame) -> Result<(), String> {
    let settings = |name| frame.bundle.word(&["settings", name]);
    if settings("edges") != "sampled" || settings("hierarchy") == "curve" {
        return Err("this client draws `edges = \"sampled\"`, and no trees along a curve".into());
    }
    let tables = structures(frame)?;
    let program = frame.screen_program(&(tables.text.clone() + &PARTS.concat() + MAIN))?;
    tables.bind(program);
    let samples = frame.bundle.number(&["settings", "samples"]).unwrap_or(8.0) as usize;
    let places = places(samples, frame.bug);
    frame.mean(&places, program)
}
