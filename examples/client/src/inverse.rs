//! `inverse-projection`: a fragment looks at its plan point and those of its neighbours, and at the areas' edges.

use crate::bundle::paint;
use crate::frame::{Frame, floats};
use crate::gl;
use crate::tables::texels;

const PARTS: [&str; 2] = [include_str!("glsl/ground.glsl"), include_str!("inverse.frag")];

/// The tables as texels of four numbers: edges; areas (three texels each).
struct Tables {
    edges: Vec<f32>,
    sides: Vec<f32>,
    areas: Vec<f32>,
}

fn tables(frame: &Frame) -> Result<Tables, String> {
    let of = frame.bundle;
    let (rows, owners, outside) = (of.own("areas")?, of.own("edge-areas")?, of.own("edge-sides")?);
    let origin = of.numbers(&["origin"]);
    let lower = |v: f64, axis: usize| match frame.bug {
        "f32-subtract" => v as f32 - origin[axis] as f32,
        _ => (v - origin[axis]) as f32,
    };
    let mut tables = Tables { edges: Vec::new(), sides: Vec::new(), areas: Vec::new() };
    for (k, edge) in of.own("area-edges")?.chunks_exact(4).enumerate() {
        let row = &rows[owners[k] as usize * 8..][..8];
        let width = of.properties(row[1] as u64, row[2] as u64)?["stroke-width-m"].as_f64();
        let more = width.filter(|_| frame.bug == "wide-lines" && row[3] == 1.0).unwrap_or(0.0) * 0.025;
        let (dx, dy) = (edge[2] - edge[0], edge[3] - edge[1]);
        let scale = if outside[k] == 1.0 { -more } else { more } / dx.hypot(dy).max(1e-9);
        for end in 0..2 {
            tables.edges.push(lower(edge[2 * end] + dy * scale, 0));
            tables.edges.push(lower(edge[2 * end + 1] - dx * scale, 1));
        }
        tables.sides.push(outside[k] as f32);
    }
    let strokes = rows.chunks_exact(8).filter(|row| row[3] == 1.0).count();
    let mut seen = 0;
    for (k, row) in rows.chunks_exact(8).enumerate() {
        let first = owners.iter().position(|owner| *owner == k as f64).unwrap_or(0);
        let count = owners.iter().filter(|owner| **owner == k as f64).count();
        let style = of.properties(row[1] as u64, row[2] as u64)?;
        seen += usize::from(row[3] == 1.0);
        let missing = frame.bug == "missing-line" && row[3] == 1.0 && seen == strokes.div_ceil(2);
        let color = frame.premultiplied(paint(style, if row[3] == 1.0 { "stroke" } else { "fill" }));
        let opacity = of.layer_opacity(row[1] as u64) as f32;
        let cut =
            if frame.bug == "no-cut" || row[6] == 0.0 { [0.0, 0.0] } else { [row[6] as f32, row[7] as f32] };
        let paints = if missing { 0.0 } else { row[5] as f32 };
        let rule = if frame.bug == "nonzero" { 1.0 } else { row[4] as f32 };
        tables.areas.extend([first as f32, count as f32, rule, paints]);
        tables.areas.extend([cut[0], cut[1], row[1] as f32, opacity]);
        tables.areas.extend(color);
    }
    Ok(tables)
}

pub fn draw(frame: &Frame) -> Result<(), String> {
    let settings = |name| frame.bundle.word(&["settings", name]);
    if settings("corners") != "centres" {
        return Err("this client draws `corners = \"centres\"` alone".into());
    }
    let tables = tables(frame)?;
    let program = frame.screen_program(&PARTS.concat())?;
    frame.use_program(program);
    texels(program, 0, "edges", floats(&tables.edges), gl::RGBA32F);
    texels(program, 1, "sides", floats(&tables.sides), gl::R32F);
    texels(program, 2, "areas", floats(&tables.areas), gl::RGBA32F);
    let n = if frame.bug == "one-sample" {
        1.0
    } else {
        frame.bundle.number(&["settings", "samples"]).unwrap_or(3.0)
    };
    let set = |name: &str, value: i32| unsafe { gl::glUniform1i(gl::uniform(program, name), value) };
    set("n", n as i32);
    set("count", (tables.areas.len() / 12) as i32);
    set("by_winding", i32::from(settings("point_in_polygon") == "winding"));
    set("by_centre", i32::from(settings("silhouette") == "centre"));
    set("additive", i32::from(frame.bundle.word(&["compositing_mode"]) == "additive"));
    set("reach", if frame.bug == "left-quad" { -1 } else { 1 });
    unsafe {
        gl::glUniform2f(gl::uniform(program, "size"), frame.wide() as f32, frame.high() as f32);
        gl::glBindFramebuffer(gl::FRAMEBUFFER, frame.framebuffer);
        gl::glDisable(gl::DEPTH_TEST);
        frame.fill();
    }
    gl::check()
}
