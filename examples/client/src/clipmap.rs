//! `clipmap`: tiles of a virtual texture over the plan, drawn where a first pass asks for them, and sampled.

use crate::frame::{Frame, SCREEN, floats, target, texture};
use crate::geometry::{self, Item, Point};
use crate::gl;
use crate::tables::{self, Tables, texels};

const PARTS: [&str; 3] =
    [include_str!("glsl/tables.glsl"), include_str!("glsl/ground.glsl"), include_str!("glsl/clipmap.glsl")];

const MAIN: &str = "
uniform sampler2D plan;
uniform usampler2D ids;
uniform vec4 sky;
layout(location = 0) out vec4 to;
void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  uint id = texelFetch(ids, p, 0).x;
  vec2 P = texelFetch(plan, p, 0).xy;
  if (id == NONE) { to = sky; return; }
  vec4 c = filtered(id, P), below = vec4(ground(id, P), 1.0);
  to = ADDITIVE == 1 ? min(below + c, 1.0) : c + below * (1.0 - c.a);
}";

/// Places of the plan to texels of a tile, row 0 the northern one.
const PLAN_VERTEX: &str = "#version 450 core
layout(location = 0) in vec2 place;
uniform vec4 scale;
void main() { gl_Position = vec4(place * scale.xy + scale.zw, 0.5, 1.0); }";

const PAINT: &str = "#version 450 core
uniform vec4 paint; layout(location = 0) out vec4 to; void main() { to = paint; }";

/// The share of a texel that a rectangle covers, from `ends.xy` to `ends.zw` in texels; with `both` what it has in common with another one.
const COVERAGE: &str = "#version 450 core
uniform vec4 paint, ends, others;
uniform float half_width;
uniform int both;
layout(location = 0) out vec4 to;
vec3 side(vec4 e, int k) {
  vec2 d = normalize(e.zw - e.xy), n = vec2(-d.y, d.x);
  if (k == 0) return vec3(d, -dot(d, e.xy));
  if (k == 1) return vec3(-d, dot(d, e.zw));
  return k == 2 ? vec3(n, half_width - dot(n, e.xy)) : vec3(-n, half_width + dot(n, e.xy));
}
void main() {
  vec2 at = floor(gl_FragCoord.xy), of[12];
  int count = 4;
  of[0] = at; of[1] = at + vec2(1.0, 0.0); of[2] = at + 1.0; of[3] = at + vec2(0.0, 1.0);
  for (int k = 0; k < 4 + 4 * both; k++) {
    vec3 plane = side(k < 4 ? ends : others, k & 3);
    vec2 cut[12];
    int kept = 0;
    for (int k = 0; k < count; k++) {
      vec2 a = of[k], b = of[k + 1 == count ? 0 : k + 1];
      float s = dot(plane.xy, a) + plane.z, t = dot(plane.xy, b) + plane.z;
      if (s >= 0.0) cut[kept++] = a;
      if ((s >= 0.0) != (t >= 0.0)) cut[kept++] = mix(a, b, s / (s - t));
    }
    for (int k = 0; k < kept; k++) of[k] = cut[k];
    count = kept;
  }
  float twice = 0.0;
  for (int k = 1; k + 1 < count; k++) {
    vec2 a = of[k] - of[0], b = of[k + 1] - of[0];
    twice += a.x * b.y - a.y * b.x;
  }
  to = paint * clamp(0.5 * abs(twice), 0.0, 1.0);
}";

/// A paint by the shares of texels that have been added up.
const SHARES: &str = "#version 450 core
uniform sampler2D shares;
uniform vec4 paint;
layout(location = 0) out vec4 to;
void main() { to = paint * clamp(texelFetch(shares, ivec2(gl_FragCoord.xy), 0).r, 0.0, 1.0); }";

const TILE: usize = 256;

/// Tiles that are kept at once.
const MOST_TILES: usize = 700;

/// An item as it is drawn into tiles.
struct Drawn {
    paint: [f32; 4],
    layer: u64,
    opacity: f64,
    even_odd: bool,
    /// Of what its polygon's mask is to be: 1 inside, 2 outside, 0 no matter.
    side: u32,
    /// First and count of the fan of each member's rings.
    members: Vec<(i32, i32)>,
    /// First and count of triangles of strips and dots.
    strips: (i32, i32),
    /// The segments, for line primitives; none where there are never such.
    segments: Vec<[Point; 2]>,
    width: f64,
    /// West, south, east, north of all that is drawn.
    bounds: [f64; 4],
}

struct Texture {
    north_west: Point,
    side: f64,
    size: usize,
    /// First tile, tiles a side.
    levels: Vec<(usize, usize)>,
}

impl Texture {
    fn new(frame: &Frame) -> Result<Self, String> {
        let terrain = frame.bundle.numbers(&["terrain"]);
        let [west, south, east, north] = terrain[..] else { return Err("no terrain".into()) };
        let size = frame.bundle.number(&["settings", "virtual_size"]).unwrap_or(256.0) as usize;
        let mut levels = Vec::new();
        let mut first = 0;
        for level in 0..=size.ilog2() {
            let tiles = ((size >> level) / TILE).max(1);
            levels.push((first, tiles));
            first += tiles * tiles;
        }
        Ok(Self { north_west: [west, north], side: (east - west).max(north - south), size, levels })
    }

    fn tiles(&self) -> usize {
        self.levels.last().map_or(0, |(first, tiles)| first + tiles * tiles)
    }

    fn texel(&self, level: usize) -> f64 {
        self.side / self.size as f64 * (1usize << level) as f64
    }

    /// First column and row, and tiles a side, of what is at hand around a point.
    fn at_hand(&self, level: usize, center: Point, clip_size: usize) -> [u32; 3] {
        let (_, tiles) = self.levels[level];
        let side = (clip_size / TILE).min(tiles);
        let texels =
            [center[0] - self.north_west[0], self.north_west[1] - center[1]].map(|v| v / self.texel(level));
        let first = texels.map(|c| {
            let first = (c / TILE as f64 - (clip_size / TILE) as f64 / 2.0 + 0.5).floor();
            first.clamp(0.0, (tiles - side) as f64) as u32
        });
        [first[0], first[1], side as u32]
    }
}

/// What is drawn, and the corners of its triangles.
fn drawn(frame: &Frame, items: &[Item]) -> Result<(Vec<Drawn>, Vec<f32>), String> {
    let of = frame.bundle;
    let origin = of.numbers(&["origin"]);
    let setting = |name| of.word(&["settings", name]);
    let rows = of.table("items.npy")?.0;
    let paints = of.table("items.paint.npy")?.0;
    let (vertices, strips) = (of.own("vertices")?, of.own("strips")?);
    let local = |k: usize| match frame.bug {
        "f32-subtract" => [0, 1].map(|axis| f64::from(vertices[2 * k + axis] as f32 - origin[axis] as f32)),
        _ => [0, 1].map(|axis| vertices[2 * k + axis] - origin[axis]),
    };
    let pixel_m = frame.middle_pixel();
    let mut values: Vec<f32> = Vec::new();
    let mut found = Vec::new();
    for (number, item) in items.iter().enumerate() {
        let paint = &paints[5 * number..5 * number + 5];
        let mut bounds = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
        let mut add = |p: Point| {
            values.extend(p.map(|v| v as f32));
            for axis in 0..2 {
                bounds[axis] = bounds[axis].min(p[axis]);
                bounds[axis + 2] = bounds[axis + 2].max(p[axis]);
            }
            (values.len() / 2) as i32
        };
        let mut end = found.last().map_or(0, |last: &Drawn| last.strips.0 + last.strips.1);
        let mut members = Vec::new();
        for rings in &item.members {
            let first = end;
            let skip = if frame.bug == "missing-hole" { 1 } else { rings.len() };
            let edges = rings
                .iter()
                .take(skip)
                .flat_map(|ring| (0..ring.len()).map(|k| [ring[k], ring[(k + 1) % ring.len()]]));
            for [a, b] in edges {
                end = [rings[0][0], a, b].map(&mut add)[2];
            }
            members.push((first, end - first));
        }
        let first = end;
        let own = strips
            .chunks_exact(5)
            .filter(|row| item.kind >= 2 && row[..2] == rows[6 * number..6 * number + 2]);
        let width = item.width_m().or(item.width_px().map(|px| px * pixel_m)).unwrap_or(0.0);
        for row in own {
            let (at, count) = (row[3] as usize, row[4] as usize);
            let mut corners: Vec<Point> = (at..at + count).map(local).collect();
            if frame.bug == "wide-lines" {
                for pair in corners.chunks_exact_mut(2) {
                    let more = [0, 1].map(|axis| 0.025 * (pair[1][axis] - pair[0][axis]));
                    (0..2).for_each(|axis| (pair[0][axis] -= more[axis], pair[1][axis] += more[axis]).1);
                }
            }
            for k in 0..count.saturating_sub(2) {
                end = [corners[k], corners[k + 1], corners[k + 2]].map(&mut add)[2];
            }
        }
        for dot in item.chains.iter().filter(|chain| item.kind == 4 && chain.points.len() == 1) {
            let corner = |k: usize| {
                let turn = k as f64 / 128.0 * std::f64::consts::TAU;
                [dot.points[0][0] + width / 2.0 * turn.cos(), dot.points[0][1] + width / 2.0 * turn.sin()]
            };
            for k in 1..127 {
                end = [corner(0), corner(k), corner(k + 1)].map(&mut add)[2];
            }
        }
        let pairs = |chain: &geometry::Chain| {
            let n = chain.points.len();
            (0..if chain.closed { n } else { n.saturating_sub(1) })
                .map(|k| [chain.points[k], chain.points[(k + 1) % n]])
                .collect::<Vec<_>>()
        };
        let may_be_thin = item.kind < 4 && setting("solution") != "2-polygons";
        let color = if frame.bug == "encoded-blends" {
            encoded(paint)
        } else {
            frame.premultiplied([paint[0], paint[1], paint[2], paint[3]])
        };
        found.push(Drawn {
            paint: color,
            layer: rows[6 * number] as u64,
            opacity: paint[4],
            even_odd: item.rule == 0 && frame.bug != "nonzero",
            side: if item.kind < 2 || frame.bug != "no-cut" { item.side } else { 0 },
            members,
            strips: (first, end - first),
            segments: item.chains.iter().filter(|_| may_be_thin).flat_map(pairs).collect(),
            width: if frame.bug == "wide-lines" { width * 1.05 } else { width },
            bounds,
        });
    }
    if frame.bug == "missing-line" {
        let lines: Vec<usize> = (0..found.len()).filter(|k| found[*k].strips.1 > 0).collect();
        if let Some(k) = lines.get(lines.len() / 2) {
            found[*k].paint = [0.0; 4];
        }
    }
    if frame.bug == "layer-order" {
        found.reverse();
    }
    Ok((found, values))
}

/// A paint premultiplied as if nothing were in linear light.
fn encoded(paint: &[f64]) -> [f32; 4] {
    [paint[0] * paint[3], paint[1] * paint[3], paint[2] * paint[3], paint[3]].map(|v| v as f32)
}

/// Draws tiles into the layers of a texture.
struct Press<'a> {
    texture: &'a Texture,
    items: &'a [Drawn],
    buffer: u32,
    paint: u32,
    screen: u32,
    coverage: u32,
    all_shares: u32,
    framebuffer: u32,
    /// A target for shares of texels, and its texture.
    shares: (u32, u32),
    additive: bool,
    once: bool,
    threshold: f64,
    most_width: f64,
    all_thin: bool,
}

impl Press<'_> {
    fn masks(&self, on: bool) {
        unsafe {
            gl::glDisable(gl::DEPTH_TEST);
            if on { gl::glEnable(gl::STENCIL_TEST) } else { gl::glDisable(gl::STENCIL_TEST) }
        }
    }

    fn fill(&self) {
        unsafe {
            gl::glViewport(0, 0, 3 * TILE as i32, 3 * TILE as i32);
            gl::glDrawArrays(gl::TRIANGLES, 0, 3);
            gl::glViewport(0, 0, TILE as i32, TILE as i32);
        }
    }

    /// What has been added up is 1 at most, before it is mixed with anything: targets of floating point do not see to that.
    fn clamp(&self) {
        unsafe {
            gl::glUseProgram(self.screen);
            gl::glUniform4f(gl::uniform(self.screen, "paint"), 1.0, 1.0, 1.0, 1.0);
            gl::glEnable(gl::BLEND);
            gl::glBlendEquation(gl::MIN);
        }
        self.fill();
        unsafe { gl::glBlendEquation(gl::FUNC_ADD) };
    }

    /// Sets bit 7 of the stencil where any member of an item's polygon holds a texel's centre.
    fn mask_polygon(&self, item: &Drawn) {
        self.masks(true);
        unsafe {
            gl::glColorMask(0, 0, 0, 0);
            for (first, count) in &item.members {
                gl::glUseProgram(self.paint);
                gl::glStencilMask(0x7f);
                gl::glStencilFunc(gl::ALWAYS, 0, 0xff);
                gl::glStencilOpSeparate(gl::FRONT, gl::KEEP, gl::KEEP, gl::INCR_WRAP);
                gl::glStencilOpSeparate(gl::BACK, gl::KEEP, gl::KEEP, gl::DECR_WRAP);
                gl::glDrawArrays(gl::TRIANGLES, *first, *count);
                gl::glUseProgram(self.screen);
                gl::glStencilMask(0xff);
                gl::glStencilFunc(gl::NOTEQUAL, 0x80, if item.even_odd { 1 } else { 0x7f });
                gl::glStencilOpSeparate(gl::FRONT_AND_BACK, gl::KEEP, gl::REPLACE, gl::REPLACE);
                self.fill();
                gl::glStencilMask(0x7f);
                gl::glStencilFunc(gl::ALWAYS, 0, 0xff);
                gl::glStencilOpSeparate(gl::FRONT_AND_BACK, gl::ZERO, gl::ZERO, gl::ZERO);
                self.fill();
            }
            gl::glColorMask(1, 1, 1, 1);
        }
    }

    fn color(&self, program: u32, item: &Drawn) {
        let [r, g, b, a] = item.paint;
        unsafe {
            gl::glUseProgram(program);
            gl::glUniform4f(gl::uniform(program, "paint"), r, g, b, a);
            gl::glEnable(gl::BLEND);
            gl::glBlendFunc(gl::ONE, if self.additive { gl::ONE } else { gl::ONE_MINUS_SRC_ALPHA });
        }
    }

    fn item(&self, item: &Drawn, level: usize, corner: Point) {
        let texel = self.texture.texel(level);
        let is_stroke = item.width > 0.0;
        let masked = !is_stroke || item.side != 0;
        if masked {
            self.mask_polygon(item);
        }
        self.masks(masked || self.once);
        // Bit 7 says where to draw, bit 0 where it has been drawn.
        let wanted = if masked && item.side != 2 { 0x80 } else { 0 };
        unsafe {
            gl::glStencilMask(0x01);
            gl::glStencilFunc(gl::EQUAL, wanted, if masked { 0x80 } else { 0 } | i32::from(self.once) as u32);
            gl::glStencilOpSeparate(
                gl::FRONT_AND_BACK,
                gl::KEEP,
                gl::KEEP,
                if self.once { gl::INCR } else { gl::KEEP },
            );
        }
        let is_thin = !item.segments.is_empty() && (self.all_thin || item.width / texel < self.threshold);
        if !is_stroke {
            self.color(self.screen, item);
            self.fill();
        } else if is_thin {
            if item.width / texel <= self.most_width {
                self.segments(item, texel, corner);
            }
        } else {
            self.color(self.paint, item);
            unsafe { gl::glDrawArrays(gl::TRIANGLES, item.strips.0, item.strips.1) };
        }
        unsafe {
            gl::glStencilMask(0xff);
            gl::glClearBufferfi(gl::DEPTH_STENCIL, 0, 0.0, 0);
        }
    }

    /// Line primitives: each is blended, or all together by what they cover (of which parts that three have in common count amiss).
    fn segments(&self, item: &Drawn, texel: f64, corner: Point) {
        let half = item.width / texel / 2.0;
        let in_texels =
            |[a, b]: &[Point; 2]| [a, b].map(|p| [(p[0] - corner[0]) / texel, (corner[1] - p[1]) / texel]);
        let all: Vec<[Point; 2]> = item.segments.iter().map(in_texels).filter(|[p, q]| p != q).collect();
        let around =
            |[p, q]: &[Point; 2], axis: usize| [p[axis].min(q[axis]) - half, p[axis].max(q[axis]) + half];
        let one = |ends: &[Point; 2], others: Option<&[Point; 2]>| {
            let block = |v: f64| (v.clamp(0.0, TILE as f64) / 8.0) as i32 * 8;
            let mut window = [[0; 2]; 2];
            for (axis, ends_of) in window.iter_mut().enumerate() {
                let of = others.map_or([f64::NEG_INFINITY, f64::INFINITY], |of| around(of, axis));
                let [low, high] = around(ends, axis);
                let (low, high) = (low.max(of[0]), high.min(of[1]));
                if high <= 0.0 || low >= TILE as f64 || high <= low {
                    return;
                }
                *ends_of = [block(low), (block(high) + 8).min(TILE as i32)];
            }
            let [[x0, x1], [y0, y1]] = window;
            let program = self.coverage;
            let four = |name: &str, [p, q]: &[Point; 2]| unsafe {
                let at = gl::uniform(program, name);
                gl::glUniform4f(at, p[0] as f32, p[1] as f32, q[0] as f32, q[1] as f32);
            };
            four("ends", ends);
            unsafe { gl::glUniform1i(gl::uniform(program, "both"), i32::from(others.is_some())) };
            if let Some(others) = others {
                four("others", others);
            }
            unsafe {
                gl::glEnable(gl::SCISSOR_TEST);
                gl::glScissor(x0, y0, x1 - x0, y1 - y0);
            }
            self.fill();
            unsafe { gl::glDisable(gl::SCISSOR_TEST) };
        };
        self.color(self.coverage, item);
        unsafe { gl::glUniform1f(gl::uniform(self.coverage, "half_width"), half as f32) };
        if !self.once {
            return all.iter().for_each(|ends| one(ends, None));
        }
        let paint = |share: f32| unsafe {
            gl::glUniform4f(gl::uniform(self.coverage, "paint"), share, 0.0, 0.0, 0.0);
        };
        unsafe {
            gl::glBindFramebuffer(gl::FRAMEBUFFER, self.shares.0);
            gl::glClearBufferfv(gl::COLOR, 0, [0.0; 4].as_ptr());
            gl::glDisable(gl::STENCIL_TEST);
            gl::glBlendFunc(gl::ONE, gl::ONE);
        }
        paint(1.0);
        all.iter().for_each(|ends| one(ends, None));
        paint(-1.0);
        for (k, ends) in all.iter().enumerate() {
            all[..k].iter().for_each(|others| one(ends, Some(others)));
        }
        unsafe {
            gl::glBindFramebuffer(gl::FRAMEBUFFER, self.framebuffer);
            gl::glEnable(gl::STENCIL_TEST);
            gl::glActiveTexture(gl::TEXTURE0);
            gl::glBindTexture(gl::TEXTURE_2D, self.shares.1);
        }
        self.color(self.all_shares, item);
        unsafe { gl::glUniform1i(gl::uniform(self.all_shares, "shares"), 0) };
        self.fill();
    }

    /// A tile of a level, into the framebuffer's layer.
    fn tile(&self, level: usize, column: usize, row: usize, below: &Below) {
        let texel = self.texture.texel(level);
        let wide = texel * TILE as f64;
        let corner = [
            self.texture.north_west[0] + column as f64 * wide,
            self.texture.north_west[1] - row as f64 * wide,
        ];
        unsafe {
            gl::glClearBufferfv(gl::COLOR, 0, [0.0; 4].as_ptr());
            gl::glClearBufferfi(gl::DEPTH_STENCIL, 0, 0.0, 0);
            gl::glBindBuffer(gl::ARRAY_BUFFER, self.buffer);
            gl::glVertexAttribPointer(0, 2, gl::FLOAT, 0, 8, std::ptr::null());
            gl::glUseProgram(self.paint);
            let scale = 2.0 / wide;
            let numbers =
                [scale, -scale, -1.0 - corner[0] * scale, corner[1] * scale - 1.0].map(|v| v as f32);
            let at = gl::uniform(self.paint, "scale");
            gl::glUniform4f(at, numbers[0], numbers[1], numbers[2], numbers[3]);
        }
        let near = |item: &&Drawn| {
            let more = item.width + texel;
            item.bounds[0] - more < corner[0] + wide
                && item.bounds[2] + more > corner[0]
                && item.bounds[1] - more < corner[1]
                && item.bounds[3] + more > corner[1] - wide
        };
        for layer in self.items.chunk_by(|a, b| a.layer == b.layer) {
            let here: Vec<&Drawn> = layer.iter().filter(near).collect();
            let Some(first) = here.first() else { continue };
            if first.opacity < 1.0 {
                below.keep();
            }
            here.iter().for_each(|item| self.item(item, level, corner));
            if first.opacity < 1.0 {
                self.masks(false);
                if self.additive {
                    self.clamp();
                }
                below.mix(first.opacity, || self.fill());
            }
        }
    }
}

/// What lies below a layer that is composed as a whole.
struct Below {
    tile: u32,
    copy: u32,
    texture: u32,
    program: u32,
}

impl Below {
    fn keep(&self) {
        let n = TILE as i32;
        unsafe {
            gl::glBindFramebuffer(gl::READ_FRAMEBUFFER, self.tile);
            gl::glBindFramebuffer(gl::DRAW_FRAMEBUFFER, self.copy);
            gl::glBlitFramebuffer(0, 0, n, n, 0, 0, n, n, gl::COLOR_BIT, gl::NEAREST);
            gl::glBindFramebuffer(gl::FRAMEBUFFER, self.tile);
        }
    }

    fn mix(&self, opacity: f64, fill: impl Fn()) {
        unsafe {
            gl::glUseProgram(self.program);
            gl::glActiveTexture(gl::TEXTURE0);
            gl::glBindTexture(gl::TEXTURE_2D, self.texture);
            gl::glUniform1i(gl::uniform(self.program, "below"), 0);
            gl::glEnable(gl::BLEND);
            gl::glBlendColor(0.0, 0.0, 0.0, 1.0 - opacity as f32);
            gl::glBlendFunc(gl::CONSTANT_ALPHA, gl::ONE_MINUS_CONSTANT_ALPHA);
        }
        fill();
    }
}

/// The tables and the text that the passes over the picture share.
fn reading(frame: &Frame, texture: &Texture) -> Result<Tables, String> {
    let of = frame.bundle;
    let number = |path: &[&str]| of.number(path).unwrap_or(0.0);
    let clip_size = number(&["settings", "clip_size"]) as usize;
    let center = match of.numbers(&["settings", "center"])[..] {
        [x, y] => [x - of.numbers(&["origin"])[0], y - of.numbers(&["origin"])[1]],
        _ => frame.nearest().unwrap_or(texture.north_west),
    };
    let mut tables = Tables::default();
    let levels = texture.levels.iter().enumerate().flat_map(|(level, (first, tiles))| {
        let clip_size = if frame.bug == "no-fallback" { texture.size } else { clip_size };
        let [column, row, side] = texture.at_hand(level, center, clip_size);
        [*first as u32, *tiles as u32, column, row, side]
    });
    tables.whole("LEVEL", levels);
    tables.number("SIZE", texture.size as i32);
    tables.number("COARSEST", texture.size.ilog2() as i32);
    let filter = match of.word(&["settings", "filter"]) {
        "nearest" => 0,
        "bilinear" => 1,
        "trilinear" => 2,
        _ if frame.bug == "isotropic" => 2,
        _ => 3,
    };
    tables.number("FILTER", filter);
    tables.number("NEAREST", i32::from(filter == 0));
    tables.number("ANISOTROPY", number(&["settings", "anisotropy"]) as i32);
    let bits = number(&["device", "filter_bits"]) as i32;
    tables.number("FILTER_BITS", bits);
    let level_bits = number(&["device", "level_bits"]) as i32;
    tables.number("LEVEL_BITS", if level_bits == 0 { bits } else { level_bits });
    tables.number("ADDITIVE", i32::from(of.word(&["compositing_mode"]) == "additive"));
    let bias = number(&["settings", "level_bias"]) + if frame.bug == "coarse" { 1.0 } else { 0.0 };
    tables.text += &format!("const float BIAS = {bias:.9};\n");
    Ok(tables)
}

pub fn draw(frame: &mut Frame) -> Result<(), String> {
    let setting = |name| frame.bundle.word(&["settings", name]);
    for (name, known) in [
        ("solution", &["1-lines", "2-polygons", "3a-both", "4a-adjacency", "4b-offsets"][..]),
        ("joints", &["method-1", "method-2", "method-3a-strip", "method-3b", "algorithm-1", "style"]),
        ("lines", &["coverage"]),
        ("polygons", &["aliased"]),
        ("pixel_width", &["distance"]),
        ("texel", &["f32"]),
        ("wide_lines", &["discard"]),
    ] {
        if !known.contains(&setting(name)) {
            return Err(format!("this client does not draw `{name} = \"{}\"`", setting(name)));
        }
    }
    frame.terrain()?;
    let whole = Texture::new(frame)?;
    let items = geometry::items(frame.bundle)?;
    let (items, corners) = drawn(frame, &items)?;
    let tables = reading(frame, &whole)?;
    let text = tables.text.clone() + &PARTS.concat();
    let tell = |frame: &Frame, program: u32| {
        tables.bind(program);
        frame.use_program(program);
        let at = |name: &str| gl::uniform(program, name);
        unsafe {
            gl::glUniform2f(at("north_west"), whole.north_west[0] as f32, whole.north_west[1] as f32);
            gl::glUniform1f(at("finest"), whole.texel(0) as f32);
            gl::glUniform2f(at("size"), frame.width as f32, frame.height as f32);
        }
    };
    let picture = target(texture(gl::RGBA32F, frame.width, frame.height), None)?;
    // Which tiles are asked for.
    let marking = frame.screen_program(&("#define MARK\n".to_owned() + &text + MAIN))?;
    tell(frame, marking);
    let marks = tables::storage(3, &vec![0u32; whole.tiles().div_ceil(32)]);
    let mut asked = vec![0u32; whole.tiles().div_ceil(32)];
    unsafe {
        gl::glDisable(gl::DEPTH_TEST);
        gl::glDisable(gl::FRAMEBUFFER_SRGB);
        gl::glBindFramebuffer(gl::FRAMEBUFFER, picture);
        frame.fill();
        gl::glMemoryBarrier(gl::ALL_BARRIERS);
        gl::glBindBuffer(gl::SHADER_STORAGE_BUFFER, marks);
        let size = size_of_val(&asked[..]) as isize;
        gl::glGetBufferSubData(gl::SHADER_STORAGE_BUFFER, 0, size, asked.as_mut_ptr().cast());
    }
    let tiles: Vec<usize> = (0..whole.tiles()).filter(|k| asked[k / 32] >> (k % 32) & 1 == 1).collect();
    if tiles.len() > MOST_TILES {
        return Err(format!("the view asks for {} tiles: more than {MOST_TILES}", tiles.len()));
    }
    let mut pages = vec![0u32; whole.tiles()];
    tiles.iter().zip(0..).for_each(|(tile, layer)| pages[*tile] = layer);
    let store = press(frame, &whole, (&items, &corners), &tiles)?;
    let sampling = frame.screen_program(&(text + MAIN))?;
    tell(frame, sampling);
    texels(sampling, 10, "pages", tables::buffer(&pages), gl::R32UI);
    unsafe {
        gl::glActiveTexture(gl::TEXTURE0 + 11);
        gl::glBindTexture(gl::TEXTURE_2D_ARRAY, store);
        gl::glUniform1i(gl::uniform(sampling, "store"), 11);
        gl::glDisable(gl::BLEND);
        gl::glDisable(gl::STENCIL_TEST);
        gl::glBindFramebuffer(gl::FRAMEBUFFER, picture);
    }
    frame.fill();
    frame.show(picture, false);
    gl::check()
}

/// All tiles that are asked for, a layer each.
fn press(
    frame: &Frame,
    whole: &Texture,
    (items, corners): (&[Drawn], &[f32]),
    tiles: &[usize],
) -> Result<u32, String> {
    let setting = |name| frame.bundle.word(&["settings", name]);
    let store = gl::layers(TILE, tiles.len().max(1));
    let copy_texture = texture(gl::RGBA32F, TILE, TILE);
    let copy = target(copy_texture, None)?;
    let stencil = texture(gl::DEPTH32F_STENCIL8, TILE, TILE);
    let framebuffer = target(copy_texture, Some(stencil))?;
    let shares = texture(gl::RGBA32F, TILE, TILE);
    let fragment = "#version 450 core
        uniform sampler2D below; layout(location = 0) out vec4 to;
        void main() { to = texelFetch(below, ivec2(gl_FragCoord.xy), 0); }";
    let below =
        Below { tile: framebuffer, copy, texture: copy_texture, program: gl::program(SCREEN, fragment)? };
    let press = Press {
        texture: whole,
        items,
        buffer: floats(corners),
        paint: gl::program(PLAN_VERTEX, PAINT)?,
        screen: gl::program(SCREEN, PAINT)?,
        coverage: gl::program(SCREEN, COVERAGE)?,
        all_shares: gl::program(SCREEN, SHARES)?,
        framebuffer,
        shares: (target(shares, None)?, shares),
        additive: frame.bundle.word(&["compositing_mode"]) == "additive",
        once: setting("overlaps") == "once" && frame.bug != "twice",
        threshold: frame.bundle.number(&["settings", "threshold_texels"]).unwrap_or(0.0),
        most_width: frame.bundle.number(&["device", "max_line_width_px"]).unwrap_or(0.0),
        all_thin: setting("solution") == "1-lines",
    };
    unsafe {
        gl::glViewport(0, 0, TILE as i32, TILE as i32);
        gl::glEnableVertexAttribArray(0);
    }
    for (layer, tile) in tiles.iter().enumerate() {
        let level = whole.levels.iter().rposition(|(first, _)| first <= tile).unwrap_or(0);
        let (first, across) = whole.levels[level];
        unsafe {
            gl::glBindFramebuffer(gl::FRAMEBUFFER, framebuffer);
            gl::glFramebufferTextureLayer(gl::FRAMEBUFFER, gl::COLOR_ATTACHMENT0, store, 0, layer as i32);
        }
        press.tile(level, (tile - first) % across, (tile - first) / across, &below);
    }
    unsafe { gl::glViewport(0, 0, frame.width as i32, frame.height as i32) };
    gl::check()?;
    Ok(store)
}
