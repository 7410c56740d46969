//! `geometry-overlay`: the bundle's clippings as GL lines, over the mesh moved back by the polygon offset.

use std::collections::HashMap;

use crate::bundle::Bundle;
use crate::frame::{Frame, VERTEX, floats};
use crate::geometry::{self, Item};
use crate::gl;

const NONE: f64 = u32::MAX as f64;

type Post = [u32; 2];
type Place = [f64; 3];

/// The posts that are vertices of the mesh: their heights.
struct Posts {
    first: [f64; 2],
    east: [f64; 2],
    north: [f64; 2],
    heights: HashMap<Post, f64>,
}

impl Posts {
    fn new(bundle: &Bundle) -> Result<Self, String> {
        let vertices = bundle.table("mesh.vertices.npy")?.0;
        let of = |key: &str| bundle.numbers(&["posts", key]).try_into();
        let (Ok(first), Ok(east), Ok(north)) = (of("first"), of("east"), of("north")) else {
            return Err("the bundle does not say where the terrain's posts are".into());
        };
        let mut posts = Self { first, east, north, heights: HashMap::new() };
        posts.heights = vertices.chunks_exact(3).map(|v| (posts.number([v[0], v[1]]), v[2])).collect();
        Ok(posts)
    }

    /// The column and row of a post.
    fn number(&self, at: [f64; 2]) -> Post {
        let ([x, y], [a, b], [c, d]) =
            ([at[0] - self.first[0], at[1] - self.first[1]], self.east, self.north);
        let area = a * d - b * c;
        [(x * d - y * c) / area, (a * y - b * x) / area].map(|v| v.round() as u32)
    }

    /// The place of a column and a row, at a height.
    fn place(&self, at: [f64; 2], z: f64) -> Place {
        let [x, y] = [0, 1].map(|axis| self.first[axis] + at[0] * self.east[axis] + at[1] * self.north[axis]);
        [x, y, z]
    }
}

/// A quad clipping of a line, as it is drawn in the mesh in use: polylines of places.
struct Clipping {
    line: u32,
    item: usize,
    runs: Vec<Vec<Place>>,
}

struct Tables {
    quad_clippings: Vec<f64>,
    triangle_clippings: Vec<f64>,
    vertices: Vec<f64>,
    crossings: Vec<f64>,
}

impl Tables {
    fn row(&self, k: usize) -> &[f64] {
        &self.triangle_clippings[16 * k..16 * k + 16]
    }

    /// The points of a triangle clipping.
    fn points(&self, k: usize, posts: &Posts) -> Vec<Place> {
        let row = self.row(k);
        let corner = |at: usize| [row[at], row[at + 1]];
        let corners = [corner(0), corner(2), corner(4)];
        let heights = corners.map(|c| posts.heights.get(&c.map(|v| v as u32)).copied().unwrap_or(f64::NAN));
        let cross = |a: [f64; 2], b: [f64; 2], p: [f64; 2]| {
            (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
        };
        let whole = cross(corners[0], corners[1], corners[2]);
        // On an edge the weight of the corner opposite is nothing.
        let on = |p: [f64; 2], is_on_edge: bool| {
            let mut weights = [0, 1, 2].map(|k| cross(corners[(k + 1) % 3], corners[(k + 2) % 3], p) / whole);
            if is_on_edge {
                let least =
                    (0..3).min_by(|a, b| weights[*a].abs().total_cmp(&weights[*b].abs())).unwrap_or(0);
                weights[least] = 0.0;
            }
            let all: f64 = weights.iter().sum();
            posts.place(
                p,
                (0..3).map(|k| if weights[k] == 0.0 { 0.0 } else { weights[k] * heights[k] }).sum::<f64>()
                    / all,
            )
        };
        let pair = |of: &[f64], k: f64| [of[2 * k as usize], of[2 * k as usize + 1]];
        let mut found = Vec::new();
        if row[10] != NONE {
            found.push(on(pair(&self.crossings, row[10]), true));
        }
        found.extend((row[8] as usize..row[9] as usize).map(|k| on(pair(&self.vertices, k as f64), false)));
        if row[11] != NONE {
            found.push(on(pair(&self.crossings, row[11]), true));
        }
        found
    }

    /// Algorithm 1 for a quad clipping.
    fn walk(&self, quad: usize, posts: &Posts) -> Vec<Vec<Place>> {
        let of = &self.quad_clippings[7 * quad..7 * quad + 7];
        let is_vertex = |k: usize, at: usize| {
            let row = self.row(k);
            posts.heights.contains_key(&[row[at] as u32, row[at + 1] as u32])
        };
        let mut runs = Vec::new();
        let mut next = Some(of[5] as usize).filter(|_| of[6] > 0.0);
        while let Some(mut k) = next {
            while !is_vertex(k, 0) && self.row(k)[14] != NONE {
                k = self.row(k)[14] as usize;
            }
            runs.push(self.points(k, posts));
            let row = self.row(k);
            let first = row[13] == NONE || is_vertex(k, 6);
            next = Some(if first { row[12] } else { row[13] }).filter(|k| *k != NONE).map(|k| k as usize);
        }
        runs
    }
}

fn clippings(frame: &Frame, posts: &Posts) -> Result<Vec<Clipping>, String> {
    let of = frame.bundle;
    let tables = Tables {
        quad_clippings: of.own("quad-clippings")?,
        triangle_clippings: of.own("triangle-clippings")?,
        vertices: of.own("line-vertices")?,
        crossings: of.own("crossings")?,
    };
    let mut found = Vec::new();
    for row in of.own("polylines")?.chunks_exact(4) {
        for quad in row[2] as usize..(row[2] + row[3]) as usize {
            let runs = tables.walk(quad, posts);
            found.push(Clipping { line: row[0] as u32, item: row[1] as usize, runs });
        }
    }
    found.sort_by_key(|clipping| clipping.line);
    Ok(found)
}

/// The pixels that a line is wide where a clipping is drawn.
fn width(frame: &Frame, item: &Item, clipping: &Clipping) -> f64 {
    let of = frame.bundle;
    let most = of.number(&["device", "max_line_width_px"]).unwrap_or(1.0);
    let camera = |name: &str| of.number(&["camera", name]).unwrap_or(0.0);
    let eye = of.numbers(&["camera", "eye"]);
    let away = |p: &Place| (0..3).map(|k| (p[k] - eye[k]).powi(2)).sum::<f64>().sqrt();
    let wide = match (item.width_px(), item.width_m()) {
        _ if of.word(&["settings", "widths"]) == "one" || frame.bug == "thin" => 1.0,
        (Some(px), _) => px,
        (_, Some(metres)) if of.parameters["camera"]["orthographic"] == true => metres / camera("pixel"),
        (_, Some(metres)) => {
            // To the nearest place of its segments, not of its points alone.
            let of_segment = |a: &Place, b: &Place| {
                let d = [0, 1, 2].map(|k| b[k] - a[k]);
                let (along, length) =
                    (0..3).fold((0.0, 0.0), |(s, l), k| (s + (eye[k] - a[k]) * d[k], l + d[k] * d[k]));
                let t = if length > 0.0 { (along / length).clamp(0.0, 1.0) } else { 0.0 };
                away(&[0, 1, 2].map(|k| a[k] + d[k] * t))
            };
            let of_run = |run: &Vec<Place>| {
                run.windows(2).map(|pair| of_segment(&pair[0], &pair[1])).fold(f64::INFINITY, f64::min)
            };
            let nearest = clipping.runs.iter().map(of_run).fold(f64::INFINITY, f64::min);
            metres / (camera("pixel") * nearest)
        }
        _ => 1.0,
    };
    let wider = if frame.bug == "wide-lines" { wide * 1.05 } else { wide };
    wider.round().max(1.0).min(most)
}

pub fn draw(frame: &Frame) -> Result<(), String> {
    let setting = |name| frame.bundle.word(&["settings", name]);
    let number = |name| frame.bundle.number(&["settings", name]).unwrap_or(0.0);
    if setting("lines") != "gl" || setting("polygons") != "outlines" {
        return Err("this client draws GL lines alone".into());
    }
    if number("tolerance_px") > 0.0 || number("stipple") != 65535.0 {
        return Err("this client neither simplifies nor stipples".into());
    }
    let posts = Posts::new(frame.bundle)?;
    let clippings = clippings(frame, &posts)?;
    let items = geometry::items(frame.bundle)?;
    let paints = frame.bundle.table("items.paint.npy")?.0;
    let mut values: Vec<f32> = Vec::new();
    let mut first = Vec::new();
    for clipping in &clippings {
        first.push(values.len() / 3);
        for pair in clipping.runs.iter().flat_map(|run| run.windows(2)).filter(|pair| pair[0] != pair[1]) {
            values.extend(pair.iter().flatten().map(|v| *v as f32));
        }
    }
    first.push(values.len() / 3);
    let fragment = "#version 450 core
        uniform vec4 paint; layout(location = 0) out vec4 to; void main() { to = paint; }";
    let program = gl::program(VERTEX, fragment)?;
    // Farther is less where depths are reversed.
    let back = if frame.nearer == gl::GREATER { -1.0 } else { 1.0 };
    let moved = if frame.bug == "no-offset" { 0.0 } else { back };
    unsafe {
        gl::glEnable(gl::POLYGON_OFFSET_FILL);
        gl::glPolygonOffset(
            (moved * number("offset_factor")) as f32,
            (moved * number("offset_units")) as f32,
        );
        frame.terrain()?;
        gl::glDisable(gl::POLYGON_OFFSET_FILL);
    }
    let buffer = floats(&values);
    let mut drawn: Vec<usize> = (0..clippings.len()).collect();
    match frame.bug {
        "missing-line" => {
            let lost = clippings.get(clippings.len() / 2).map(|of| of.line);
            drawn.retain(|k| Some(clippings[*k].line) != lost);
        }
        "layer-order" => drawn.reverse(),
        _ => {}
    }
    let layers = frame.bundle.table("items.npy")?.0;
    let layer_of = |k: usize| layers[6 * clippings[k].item] as u64;
    for layer in drawn.chunk_by(|a, b| layer_of(*a) == layer_of(*b)) {
        let opacity = frame.bundle.layer_opacity(layer_of(layer[0]));
        frame.layer(opacity, &mut || {
            frame.use_program(program);
            unsafe {
                gl::glBindFramebuffer(gl::FRAMEBUFFER, frame.framebuffer);
                gl::glBindBuffer(gl::ARRAY_BUFFER, buffer);
                gl::glVertexAttribPointer(0, 3, gl::FLOAT, 0, 12, std::ptr::null());
                gl::glEnable(gl::DEPTH_TEST);
                gl::glDepthFunc(frame.nearer);
                gl::glDepthMask(0);
                gl::glEnable(gl::BLEND);
                let additive = frame.bundle.word(&["compositing_mode"]) == "additive";
                gl::glBlendFunc(gl::ONE, if additive { gl::ONE } else { gl::ONE_MINUS_SRC_ALPHA });
                if frame.bug == "no-depth-test" {
                    gl::glDisable(gl::DEPTH_TEST);
                }
            }
            for k in layer {
                let item = clippings[*k].item;
                let paint = &paints[5 * item..5 * item + 4];
                let [r, g, b, a] = frame.premultiplied([paint[0], paint[1], paint[2], paint[3]]);
                unsafe {
                    gl::glUniform4f(gl::uniform(program, "paint"), r, g, b, a);
                    gl::glLineWidth(width(frame, &items[item], &clippings[*k]) as f32);
                    gl::glDrawArrays(gl::LINES, first[*k] as i32, (first[*k + 1] - first[*k]) as i32);
                }
            }
            Ok(())
        })?;
    }
    gl::check()
}
