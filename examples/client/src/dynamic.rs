//! `dynamic-line`: boxes around segments fill lists of pixels, which are sorted and composed; then the picture is filtered.

use crate::frame::{Frame, floats, target, texture};
use crate::geometry::{self, Chain, Heights, Item, Point};
use crate::{gl, statics, tables};

/// Of what shaders are made, in this order, behind the tables' places.
const PARTS: [&str; 5] = [
    include_str!("glsl/tables.glsl"),
    include_str!("glsl/ground.glsl"),
    include_str!("glsl/stroke.glsl"),
    include_str!("glsl/compose.glsl"),
    include_str!("glsl/dynamic.glsl"),
];

const COLLECT_VERTEX: &str = "#version 450 core
layout(location = 0) in vec3 place;
layout(location = 1) in float number;
uniform mat4 clip_from_world;
uniform vec2 shift;
flat out int line;
void main() {
  line = int(number);
  gl_Position = clip_from_world * vec4(place, 1.0);
  gl_Position.xy += shift * gl_Position.w;
}";

const COLLECT: &str = "
flat in int line;
uniform sampler2D plan;
uniform usampler2D ids;
void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  if (texelFetch(ids, p, 0).x == NONE) return;
  vec3 X = texelFetch(plan, p, 0).xyz;
  int at = LINES + line * 10;
  bool holds = apart(X.xy, pair(at), pair(at + 2)) <= single(at + 4) * pixel_at(X);
  if (thin == 1) holds = holds || apart(gl_FragCoord.xy, pair(at + 6), pair(at + 8)) <= 0.5;
  if (!holds) return;
  uint entry = atomicAdd(count, 1u);
  if (entry >= most) return;
  uint below = atomicExchange(heads[p.y * int(size.x) + p.x], entry);
  entries[entry] = uvec4(uint(single(at + 5)), uint(line), below, 0u);
}";

const RESOLVE: &str = "
uniform sampler2D plan;
uniform usampler2D ids;
uniform vec4 sky;
layout(location = 0) out vec4 to;
void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  uint id = texelFetch(ids, p, 0).x;
  vec3 X = texelFetch(plan, p, 0).xyz;
  for (uint at = heads[p.y * int(size.x) + p.x]; at != NONE; at = entries[at].z) hit(entries[at].x, AGAIN == 1);
  look_up(X.xy);
  to = id == NONE ? sky : compose(vec4(ground(id, X.xy), 1.0));
}";

const FILTER: &str = include_str!("glsl/fxaa.glsl");

/// A part of a segment that is drawn.
struct Part {
    item: usize,
    ends: [[f64; 3]; 2],
    /// The plan directions of the parts before and after it.
    before: Option<Point>,
    after: Option<Point>,
    half_px: f64,
}

struct View {
    clip: Vec<f64>,
    depth: Vec<f64>,
    eye: Vec<f64>,
    pixel: f64,
    parallel: bool,
    near: f64,
    far: f64,
    size: [f64; 2],
}

impl View {
    fn new(frame: &Frame) -> Self {
        let of = frame.bundle;
        let camera = |name: &str| of.number(&["camera", name]);
        Self {
            clip: of.matrix("clip_from_world"),
            depth: of.matrix("view_from_world")[8..12].iter().map(|v| -v).collect(),
            eye: of.numbers(&["camera", "eye"]),
            pixel: camera("pixel").unwrap_or(0.0),
            parallel: of.parameters["camera"]["orthographic"].as_bool() == Some(true),
            near: camera("near_m").unwrap_or(f64::NEG_INFINITY),
            far: camera("far_m").unwrap_or(f64::INFINITY),
            size: [frame.width as f64, frame.height as f64],
        }
    }

    fn row(row: &[f64], p: [f64; 3]) -> f64 {
        row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3]
    }

    /// The place on the screen, y up, or none before the near plane.
    fn screen(&self, p: [f64; 3]) -> Option<Point> {
        if Self::row(&self.depth, p) < self.near {
            return None;
        }
        let w = Self::row(&self.clip[12..16], p);
        Some(
            [0, 1].map(|axis| {
                (Self::row(&self.clip[4 * axis..4 * axis + 4], p) / w + 1.0) / 2.0 * self.size[axis]
            }),
        )
    }

    fn in_frustum(&self, p: [f64; 3]) -> bool {
        let inside = |s: Point| (0..2).all(|axis| s[axis] >= 0.0 && s[axis] <= self.size[axis]);
        self.screen(p).is_some_and(inside) && Self::row(&self.depth, p) <= self.far
    }

    fn pixel_at(&self, p: [f64; 3]) -> f64 {
        let away = (0..3).map(|k| (p[k] - self.eye[k]).powi(2)).sum::<f64>().sqrt();
        if self.parallel { self.pixel } else { self.pixel * away }
    }
}

/// Parts of at most so many metres, their ends on the terrain.
fn matched(chain: &Chain, most: f64, heights: &Heights) -> Vec<[f64; 3]> {
    let mut found = Vec::new();
    let n = chain.points.len();
    let on = |p: Point| [p[0], p[1], heights.over(p)];
    let segments = if chain.closed { n } else { n - 1 };
    for k in 0..segments {
        let (a, b) = (chain.points[k], chain.points[(k + 1) % n]);
        let length = (b[0] - a[0]).hypot(b[1] - a[1]);
        let parts = if length <= most { 1.0 } else { (length / most).floor() + 1.0 };
        found.extend((0..parts as usize).map(|part| {
            let t = part as f64 / parts;
            on([a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t])
        }));
    }
    found.push(on(chain.points[segments % n]));
    found
}

fn direction(a: [f64; 3], b: [f64; 3]) -> Point {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length = dx.hypot(dy);
    [dx / length, dy / length]
}

/// The parts of a scene's dynamic lines that the view keeps.
fn parts(frame: &Frame, view: &View, items: &[Item], heights: &Heights) -> Result<Vec<Part>, String> {
    let setting = |name| frame.bundle.word(&["settings", name]);
    let most = frame.bundle.number(&["settings", "l_max"]).unwrap_or(heights.resolution / 2.0);
    let simplify = match setting("simplification") {
        "same-pixel" => true,
        "none" => false,
        _ => return Err("this client simplifies by pixels alone".into()),
    };
    let by_vertices = setting("culling") == "vertices";
    let wider = if frame.bug == "wide-lines" { 1.05 } else { 1.0 };
    let mut found = Vec::new();
    for (number, item) in items.iter().enumerate() {
        let Some(width) = item.width_px() else { continue };
        for chain in &item.chains {
            let half_px = width / 2.0 * wider;
            let all = matched(chain, most, heights);
            if let [only] = all[..] {
                found.push(Part { item: number, ends: [only; 2], before: None, after: None, half_px });
                continue;
            }
            let pixels: Vec<Option<[i64; 2]>> =
                all.iter().map(|p| view.screen(*p).map(|s| s.map(|v| v.floor() as i64))).collect();
            let stays =
                |k: &usize| *k == 0 || !simplify || pixels[*k].is_none() || pixels[*k] != pixels[*k - 1];
            let kept: Vec<[f64; 3]> = (0..all.len()).filter(stays).map(|k| all[k]).collect();
            let directions: Vec<Point> = kept.windows(2).map(|pair| direction(pair[0], pair[1])).collect();
            let last = directions.len();
            let is_closed = chain.closed && kept.first() == kept.last();
            for (k, pair) in kept.windows(2).enumerate() {
                if by_vertices && !view.in_frustum(pair[0]) && !view.in_frustum(pair[1]) {
                    continue;
                }
                let before = if k > 0 {
                    Some(directions[k - 1])
                } else {
                    directions.last().copied().filter(|_| is_closed)
                };
                let after = if k + 1 < last {
                    Some(directions[k + 1])
                } else {
                    directions.first().copied().filter(|_| is_closed)
                };
                found.push(Part { item: number, ends: [pair[0], pair[1]], before, after, half_px });
            }
        }
    }
    Ok(found)
}

/// The four corners of a part's box in the plan.
fn footprint(part: &Part, half: f64, mitred: bool) -> [Point; 4] {
    let [a, b] = part.ends;
    let along = if a == b { [1.0, 0.0] } else { direction(a, b) };
    let left = [-along[1] * half, along[0] * half];
    let corners = |at: [f64; 3], neighbour: Option<Point>, ahead: f64| -> [Point; 2] {
        let turn =
            neighbour.map(|d| d[0] * along[0] + d[1] * along[1]).filter(|c| mitred && *c > -1.0 + 1e-9);
        match (neighbour, turn) {
            (Some(d), Some(cosine)) => {
                let m = [0, 1].map(|axis| (left[axis] + [-d[1], d[0]][axis] * half) / (1.0 + cosine));
                [[at[0] + m[0], at[1] + m[1]], [at[0] - m[0], at[1] - m[1]]]
            }
            _ => {
                let further = if mitred && neighbour.is_some() { 0.0 } else { ahead * half };
                let at = [at[0] + along[0] * further, at[1] + along[1] * further];
                [[at[0] + left[0], at[1] + left[1]], [at[0] - left[0], at[1] - left[1]]]
            }
        }
    };
    let ([p, q], [r, s]) = (corners(a, part.before, -1.0), corners(b, part.after, 1.0));
    [p, q, s, r]
}

/// The convex hull of a few points, counter-clockwise.
fn hull(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let half = |points: &mut dyn Iterator<Item = Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..]
                && (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut all = half(&mut points.iter().copied());
    all.extend(half(&mut points.iter().rev().copied()));
    all
}

/// The triangles of prisms over parts' footprints, four numbers a corner, seen from outside counter-clockwise.
fn boxes(frame: &Frame, parts: &[Part], view: &View, heights: &Heights, grow: f64) -> Vec<f32> {
    let mitred = frame.bundle.word(&["settings", "boxes"]) == "mitred";
    let [low, high] = heights.range;
    let more = (high - low) / 1024.0 + heights.resolution / 64.0;
    let mut values = Vec::new();
    for (number, part) in parts.iter().enumerate() {
        let size = view.pixel_at(part.ends[0]).max(view.pixel_at(part.ends[1]));
        let ring = hull(footprint(part, (part.half_px + grow) * size, mitred).to_vec());
        let mut add = |corners: [(Point, f64); 3]| {
            for (p, z) in corners {
                values.extend([p[0] as f32, p[1] as f32, z as f32, number as f32]);
            }
        };
        let (bottom, top) = (low - more, high + more);
        for k in 0..ring.len() {
            let (a, b) = (ring[k], ring[(k + 1) % ring.len()]);
            add([(a, bottom), (b, bottom), (b, top)]);
            add([(a, bottom), (b, top), (a, top)]);
            if k > 0 && k + 1 < ring.len() {
                add([(ring[0], top), (a, top), (b, top)]);
                add([(ring[0], bottom), (b, bottom), (a, bottom)]);
            }
        }
    }
    values
}

/// Entries that all lists may have.
const MOST_ENTRIES: u32 = 1 << 23;

pub fn draw(frame: &mut Frame) -> Result<(), String> {
    let setting = |name| frame.bundle.word(&["settings", name]);
    for (name, known) in [
        ("corners", &["round"][..]),
        ("sorting", &["selection"]),
        ("thin_lines", &["none", "correction"]),
        ("antialiasing", &["none", "fxaa"]),
        ("boxes", &["mitred", "overlapping"]),
    ] {
        if !known.contains(&setting(name)) {
            return Err(format!("this client does not draw `{name} = \"{}\"`", setting(name)));
        }
    }
    let of_decals = |name| frame.bundle.word(&["further_settings", "static-decal", name]);
    let (heights, view) = (Heights::new(frame.bundle)?, View::new(frame));
    let items = geometry::items(frame.bundle)?;
    let parts = parts(frame, &view, &items, &heights)?;
    let down = frame.bundle.numbers(&["camera", "forward"])[2];
    let thin =
        setting("thin_lines") == "correction" && down <= -10f64.to_radians().cos() && frame.bug != "thin";
    let values = boxes(frame, &parts, &view, &heights, if thin { 0.75 } else { 0.0 });
    let mut all =
        statics::tables(frame, &items, of_decals("outlines") == "side", of_decals("overlaps") == "double");
    all.single(
        "LINES",
        parts.iter().flat_map(|part| {
            let [a, b] = part.ends;
            let [s, t] = part.ends.map(|p| view.screen(p).unwrap_or([f64::MAX; 2]));
            let numbers = [a[0], a[1], b[0], b[1], part.half_px, part.item as f64, s[0], s[1], t[0], t[1]];
            numbers.map(|v| v as f32)
        }),
    );
    all.number("AGAIN", i32::from(setting("overlaps") == "double" || frame.bug == "twice"));
    tables::items(frame.bundle, frame.bug, &mut all)?;
    frame.terrain()?;
    tables::storage(3, &vec![u32::MAX; frame.width * frame.height]);
    let mut entries = vec![0u32; 4 + 4 * MOST_ENTRIES as usize];
    entries[1] = MOST_ENTRIES;
    let entries = tables::storage(4, &entries);
    let common = all.text.clone() + &PARTS.concat();
    let (eye, size) = (view.eye.clone(), [frame.width as f32, frame.height as f32]);
    let fixed = frame.bug == "fixed-width";
    let pixel = if fixed { view.pixel * heights_away(&view, &heights) } else { view.pixel };
    let tell = |program: u32| unsafe {
        let at = |name: &str| gl::uniform(program, name);
        gl::glUniform3f(at("eye"), eye[0] as f32, eye[1] as f32, eye[2] as f32);
        gl::glUniform2f(at("size"), size[0], size[1]);
        gl::glUniform1f(at("pixel"), pixel as f32);
        gl::glUniform1i(at("parallel"), i32::from(view.parallel || fixed));
        gl::glUniform1i(at("thin"), i32::from(thin));
    };
    let collect = frame.program_that_sees(COLLECT_VERTEX, &(common.clone() + COLLECT))?;
    all.bind(collect);
    tell(collect);
    frame.use_program(collect);
    let buffer = floats(&values);
    let finished = texture(gl::RGBA32F, frame.width, frame.height);
    let picture = target(finished, None)?;
    unsafe {
        gl::glBindFramebuffer(gl::FRAMEBUFFER, picture);
        gl::glBindBuffer(gl::ARRAY_BUFFER, buffer);
        gl::glVertexAttribPointer(0, 3, gl::FLOAT, 0, 16, std::ptr::null());
        gl::glVertexAttribPointer(1, 1, gl::FLOAT, 0, 16, 12 as *const _);
        gl::glEnableVertexAttribArray(1);
        gl::glDisable(gl::DEPTH_TEST);
        gl::glDisable(gl::FRAMEBUFFER_SRGB);
        gl::glEnable(gl::DEPTH_CLAMP);
        // The far sides of a convex box cover what it covers, once, wherever the eye is.
        gl::glEnable(gl::CULL_FACE);
        gl::glCullFace(gl::FRONT);
        gl::glColorMask(0, 0, 0, 0);
        gl::glDrawArrays(gl::TRIANGLES, 0, (values.len() / 4) as i32);
        gl::glColorMask(1, 1, 1, 1);
        gl::glDisable(gl::CULL_FACE);
        gl::glDisable(gl::DEPTH_CLAMP);
        gl::glDisableVertexAttribArray(1);
        gl::glMemoryBarrier(gl::ALL_BARRIERS);
        let mut count = 0u32;
        gl::glBindBuffer(gl::SHADER_STORAGE_BUFFER, entries);
        gl::glGetBufferSubData(gl::SHADER_STORAGE_BUFFER, 0, 4, (&raw mut count).cast());
        if count > MOST_ENTRIES {
            return Err(format!("the pixels' lists have {count} entries: more than {MOST_ENTRIES}"));
        }
        gl::check()?;
        let resolve = frame.screen_program(&(common + include_str!("glsl/statics.glsl") + RESOLVE))?;
        all.bind(resolve);
        tell(resolve);
        gl::glBindFramebuffer(gl::FRAMEBUFFER, picture);
        frame.fill();
    }
    frame.show(picture, false);
    if setting("antialiasing") == "fxaa" && frame.bug != "no-filter" {
        let filter = frame.screen_program(FILTER)?;
        let filtered = target(texture(gl::RGBA32F, frame.width, frame.height), None)?;
        unsafe {
            gl::glActiveTexture(gl::TEXTURE0);
            gl::glBindTexture(gl::TEXTURE_2D, finished);
            gl::glUniform1i(gl::uniform(filter, "picture"), 0);
            gl::glBindFramebuffer(gl::FRAMEBUFFER, filtered);
            frame.fill();
        }
        frame.show(filtered, true);
    }
    gl::check()
}

/// How far the middle of the mesh is from the eye.
fn heights_away(view: &View, heights: &Heights) -> f64 {
    let z = (heights.range[0] + heights.range[1]) / 2.0;
    (view.eye[0].powi(2) + view.eye[1].powi(2) + (view.eye[2] - z).powi(2)).sqrt()
}
