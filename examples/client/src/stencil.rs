//! `stencil-volume`: the bundle's volumes, counted in a two-sided stencil.

use crate::bundle::paint;
use crate::frame::{Frame, SCREEN, VERTEX, floats};
use crate::gl;

const NONE: u64 = u32::MAX as u64;

/// A row of `objects`, with what its item is painted with.
struct Object {
    layer: u64,
    pass: u64,
    volumes: std::ops::Range<usize>,
    cut: std::ops::Range<usize>,
    /// 1 the inside of `cut` counts, 2 its outside.
    side: u64,
    stroke_m: Option<f64>,
    paint: [f64; 4],
}

/// A row of `volumes`, and where its triangles are.
struct Volume {
    z_fail: bool,
    even_odd: bool,
    first: usize,
    count: usize,
}

fn objects(frame: &Frame) -> Result<Vec<Object>, String> {
    let rows = frame.bundle.own("objects")?;
    let mut found: Vec<Object> = Vec::new();
    let mut last = (NONE, NONE);
    for row in rows.chunks_exact(8) {
        let at = |k: usize| row[k] as usize;
        let of = frame.bundle.properties(row[0] as u64, row[1] as u64)?;
        let key = (row[0] as u64, row[1] as u64);
        let fills = !of["fill"].is_null() && (key != last || of["stroke"].is_null());
        last = key;
        found.push(Object {
            layer: key.0,
            pass: row[2] as u64,
            volumes: at(3)..at(3) + at(4),
            cut: at(5)..at(5) + at(6),
            side: row[7] as u64,
            stroke_m: of["stroke-width-m"].as_f64().filter(|_| !fills),
            paint: paint(of, if fills { "fill" } else { "stroke" }),
        });
    }
    if frame.bug == "missing-line" {
        let lines: Vec<usize> = (0..found.len()).filter(|k| found[*k].stroke_m.is_some()).collect();
        found.remove(lines[lines.len() / 2]);
    }
    if frame.bug == "layer-order" {
        let (one, two) = (found[0].layer, found[found.len() - 1].layer);
        let (first, rest): (Vec<_>, Vec<_>) = found.into_iter().partition(|object| object.layer == two);
        let (last, middle): (Vec<_>, Vec<_>) = rest.into_iter().partition(|object| object.layer == one);
        found = first.into_iter().chain(middle).chain(last).collect();
    }
    Ok(found)
}

/// The rectangle of a segment, 5 % wider.
fn widened(corners: &mut [[f64; 2]], width: f64) {
    let apart = |a: [f64; 2], b: [f64; 2]| (b[0] - a[0]).hypot(b[1] - a[1]);
    if corners.len() != 4 {
        return;
    }
    let off = |k: usize| (apart(corners[k], corners[(k + 1) % 4]) - width).abs();
    let k = usize::from(off(1) < off(0));
    for (a, b) in [(k, k + 1), ((k + 3) % 4, (k + 2) % 4)] {
        let (p, q) = (corners[a], corners[b]);
        for axis in 0..2 {
            let more = 0.025 * (q[axis] - p[axis]);
            corners[a][axis] = p[axis] - more;
            corners[b][axis] = q[axis] + more;
        }
    }
}

/// The faces of all volumes as triangles.
fn volumes(frame: &Frame, objects: &[Object]) -> Result<(Vec<Volume>, Vec<f32>), String> {
    let [rows, levels, rings, corners] =
        ["volumes", "volume-levels", "volume-rings", "volume-corners"].map(|name| frame.bundle.own(name));
    let (rows, levels, rings, corners) = (rows?, levels?, rings?, corners?);
    let origin = frame.bundle.numbers(&["origin"]);
    let mut width = vec![None; rows.len() / 6];
    for object in objects {
        object.volumes.clone().for_each(|k| width[k] = object.stroke_m);
    }
    let mut values: Vec<f32> = Vec::new();
    let mut found = Vec::new();
    for (k, row) in rows.chunks_exact(6).enumerate() {
        let first = values.len() / 3;
        let (bottom, top) = (levels[2 * k], levels[2 * k + 1]);
        let mut outline = Vec::new();
        let range = row[0] as usize..row[0] as usize + row[1] as usize;
        let skip = frame.bug == "missing-hole" && range.len() > 1;
        for ring in rings.chunks_exact(2).skip(range.start).take(if skip { 1 } else { range.len() }) {
            let of = corners.chunks_exact(2).skip(ring[0] as usize).take(ring[1] as usize);
            let mut ring: Vec<[f64; 2]> = of.map(|c| [c[0], c[1]]).collect();
            if let Some(width) = width[k].filter(|_| frame.bug == "wide-lines") {
                widened(&mut ring, width);
            }
            outline.push(ring);
        }
        let place = |c: [f64; 2], z: f64| match frame.bug {
            "f32-subtract" => [c[0] as f32 - origin[0] as f32, c[1] as f32 - origin[1] as f32, z as f32],
            _ => [(c[0] - origin[0]) as f32, (c[1] - origin[1]) as f32, z as f32],
        };
        let mut add =
            |corners: [([f64; 2], f64); 3]| corners.iter().for_each(|(c, z)| values.extend(place(*c, *z)));
        if row[4] != 0.0 && bottom != top {
            let apex = outline[0][0];
            let edges = || {
                outline.iter().flat_map(|ring| (0..ring.len()).map(|k| (ring[k], ring[(k + 1) % ring.len()])))
            };
            for (a, b) in edges().filter(|(a, b)| *a != apex && *b != apex) {
                if frame.bug != "no-caps" && frame.bug != "no-top-caps" {
                    add([(apex, top), (a, top), (b, top)]);
                }
                if frame.bug != "no-caps" {
                    add([(apex, bottom), (b, bottom), (a, bottom)]);
                }
            }
            for (a, b) in edges() {
                add([(a, bottom), (b, bottom), (b, top)]);
                add([(a, bottom), (b, top), (a, top)]);
            }
        }
        let z_fail = row[2] == 1.0 && frame.bug != "z-pass";
        let even_odd = row[5] == 0.0 && frame.bug != "nonzero";
        found.push(Volume { z_fail, even_odd, first, count: values.len() / 3 - first });
    }
    Ok((found, values))
}

/// Counts the faces of volumes into the stencil's bits of `mask`, two-sided.
fn count(frame: &Frame, volumes: &[Volume], mask: u32) {
    let (up, down) = match frame.bundle.word(&["settings", "overflow"]) == "wrap" && frame.bug != "saturate" {
        true => (gl::INCR_WRAP, gl::DECR_WRAP),
        false => (gl::INCR, gl::DECR),
    };
    unsafe {
        gl::glColorMask(0, 0, 0, 0);
        gl::glEnable(gl::DEPTH_TEST);
        gl::glEnable(gl::STENCIL_TEST);
        gl::glStencilMask(mask);
        gl::glStencilFunc(gl::ALWAYS, 0, 0xff);
        for like in volumes.chunk_by(|a, b| a.z_fail == b.z_fail && a.first + a.count == b.first) {
            if like[0].z_fail {
                gl::glStencilOpSeparate(gl::BACK, gl::KEEP, up, gl::KEEP);
                gl::glStencilOpSeparate(gl::FRONT, gl::KEEP, down, gl::KEEP);
            } else {
                gl::glStencilOpSeparate(gl::FRONT, gl::KEEP, gl::KEEP, up);
                gl::glStencilOpSeparate(gl::BACK, gl::KEEP, gl::KEEP, down);
            }
            let count: usize = like.iter().map(|volume| volume.count).sum();
            gl::glDrawArrays(gl::TRIANGLES, like[0].first as i32, count as i32);
        }
    }
}

/// Where stencil & mask is not zero: `passes`; elsewhere `fails`.
fn apply(mask: u32, equal: Option<i32>, passes: gl::Enum, fails: gl::Enum) {
    unsafe {
        gl::glDisable(gl::DEPTH_TEST);
        gl::glStencilMask(0xff);
        match equal {
            Some(value) => gl::glStencilFunc(gl::EQUAL, value, mask),
            None => gl::glStencilFunc(gl::NOTEQUAL, 0, mask),
        }
        gl::glStencilOpSeparate(gl::FRONT_AND_BACK, fails, passes, passes);
    }
}

pub fn draw(frame: &Frame) -> Result<(), String> {
    let objects = objects(frame)?;
    let (volumes, values) = volumes(frame, &objects)?;
    let fragment = "#version 450 core
        uniform vec4 paint; layout(location = 0) out vec4 to; void main() { to = paint; }";
    let (faces, screen) = (gl::program(VERTEX, fragment)?, gl::program(SCREEN, fragment)?);
    let buffer = floats(&values);
    unsafe {
        gl::glBindFramebuffer(gl::FRAMEBUFFER, frame.framebuffer);
        gl::glBindBuffer(gl::ARRAY_BUFFER, buffer);
        gl::glVertexAttribPointer(0, 3, gl::FLOAT, 0, 12, std::ptr::null());
        if frame.bundle.word(&["settings", "far"]) == "clamp" {
            gl::glEnable(gl::DEPTH_CLAMP);
        }
    }
    for layer in objects.chunk_by(|a, b| a.layer == b.layer) {
        let opacity = frame.bundle.layer_opacity(layer[0].layer);
        frame.layer(opacity, &mut || {
            layer
                .chunk_by(|a, b| a.pass == b.pass)
                .for_each(|pass| mask(frame, pass, &volumes, faces, screen));
            Ok(())
        })?;
    }
    gl::check()
}

/// One pass: its mask is counted, and its colour drawn where the mask passes.
fn mask(frame: &Frame, pass: &[Object], volumes: &[Volume], faces: u32, screen: u32) {
    let object = &pass[0];
    let bits = |volume: &Volume| if volume.even_odd { 1 } else { 0xff };
    let cut = if frame.bug == "no-cut" { 0..0 } else { object.cut.clone() };
    let over_all = || unsafe {
        gl::glUseProgram(screen);
        frame.fill();
    };
    frame.use_program(faces);
    if !cut.is_empty() {
        count(frame, &volumes[cut.clone()], 0xff);
        let rule = bits(&volumes[cut.start]);
        apply_cut(rule);
        over_all();
        frame.use_program(faces);
    }
    let counted = if cut.is_empty() { 0xff } else { 0x7f };
    for object in pass {
        count(frame, &volumes[object.volumes.clone()], counted);
    }
    if !cut.is_empty() {
        let wrong = if object.side == 1 { 0 } else { 0x80 };
        apply(0x80, Some(wrong), gl::ZERO, gl::KEEP);
        over_all();
    }
    let color = frame.premultiplied(object.paint);
    let blend = if frame.bundle.word(&["compositing_mode"]) == "additive" {
        gl::ONE
    } else {
        gl::ONE_MINUS_SRC_ALPHA
    };
    unsafe {
        gl::glColorMask(1, 1, 1, 1);
        gl::glEnable(gl::BLEND);
        gl::glBlendFunc(gl::ONE, blend);
        let program = if cut.is_empty() { faces } else { screen };
        frame.use_program(program);
        gl::glUniform4f(gl::uniform(program, "paint"), color[0], color[1], color[2], color[3]);
    }
    let Some(first) = object.volumes.clone().next() else { return };
    apply(bits(&volumes[first]) & counted, None, gl::ZERO, gl::ZERO);
    if !cut.is_empty() {
        return over_all();
    }
    for object in pass {
        let of = &volumes[object.volumes.clone()];
        let count: usize = of.iter().map(|volume| volume.count).sum();
        unsafe {
            gl::glDrawArrays(gl::TRIANGLES, of.first().map_or(0, |volume| volume.first as i32), count as i32)
        };
    }
}

/// Where the counts pass by `rule`, the highest bit alone; zero elsewhere.
fn apply_cut(rule: u32) {
    unsafe {
        gl::glDisable(gl::DEPTH_TEST);
        gl::glStencilMask(0xff);
        // What is written must not be what is compared with: a count of just 128 is taken for none.
        gl::glStencilFunc(gl::NOTEQUAL, 0x80, rule & 0x7f);
        gl::glStencilOpSeparate(gl::FRONT_AND_BACK, gl::ZERO, gl::REPLACE, gl::REPLACE);
    }
}
