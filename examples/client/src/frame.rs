//! The terrain in the buffers of the GPU, and the finished frame.

use std::path::Path;

use crate::bundle::{Bundle, Paint, to_encoded, to_linear};
use crate::{gl, write};

/// A vertex goes to clip space by the bundle's matrix in single precision.
pub const VERTEX: &str = "#version 450 core
layout(location = 0) in vec3 place;
layout(location = 2) in vec2 across;
uniform mat4 clip_from_world;
uniform vec2 shift;
out vec3 plan;
void main() {
  plan = vec3(across, place.z);
  gl_Position = clip_from_world * vec4(place, 1.0);
  gl_Position.xy += shift * gl_Position.w;
}";

/// The triangle of [`Frame::fill`].
pub const SCREEN: &str = "#version 450 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 1.0 : -1.0, gl_VertexID == 2 ? 1.0 : -1.0, 0.5, 1.0); }";

/// What all techniques share.
pub struct Frame<'a> {
    pub bundle: &'a Bundle,
    pub bug: &'a str,
    /// Samples along a side of a pixel.
    pub samples: usize,
    pub width: usize,
    pub height: usize,
    pub linear: bool,
    /// The depth test of what is nearer.
    pub nearer: gl::Enum,
    pub framebuffer: u32,
    ids: u32,
    /// Where plan points and heights are drawn.
    plan: u32,
    pub ids_texture: u32,
    pub plan_texture: u32,
    pub mesh: u32,
    /// Pixels that are drawn beyond the right and the upper border.
    extra: usize,
    corners: usize,
    float: bool,
    /// How far what is drawn is moved to the right and up, pixels.
    offset: [f64; 2],
    /// Where the finished picture is, if it is of floating point and not in `framebuffer`.
    shown: Option<u32>,
    imagery: Option<u32>,
}

pub fn floats(values: &[f32]) -> u32 {
    let mut buffer = 0;
    unsafe {
        gl::glGenBuffers(1, &mut buffer);
        gl::glBindBuffer(gl::ARRAY_BUFFER, buffer);
        gl::glBufferData(
            gl::ARRAY_BUFFER,
            size_of_val(values) as isize,
            values.as_ptr().cast(),
            gl::STATIC_DRAW,
        );
    }
    buffer
}

pub fn texture(format: gl::Enum, width: usize, height: usize) -> u32 {
    let mut texture = 0;
    unsafe {
        gl::glGenTextures(1, &mut texture);
        gl::glBindTexture(gl::TEXTURE_2D, texture);
        gl::glTexStorage2D(gl::TEXTURE_2D, 1, format, width as i32, height as i32);
        for filter in [gl::TEXTURE_MIN_FILTER, gl::TEXTURE_MAG_FILTER] {
            gl::glTexParameteri(gl::TEXTURE_2D, filter, gl::NEAREST as i32);
        }
    }
    texture
}

pub fn target(color: u32, depth: Option<u32>) -> Result<u32, String> {
    let mut framebuffer = 0;
    unsafe {
        gl::glGenFramebuffers(1, &mut framebuffer);
        gl::glBindFramebuffer(gl::FRAMEBUFFER, framebuffer);
        gl::glFramebufferTexture2D(gl::FRAMEBUFFER, gl::COLOR_ATTACHMENT0, gl::TEXTURE_2D, color, 0);
        if let Some(depth) = depth {
            gl::glFramebufferTexture2D(
                gl::FRAMEBUFFER,
                gl::DEPTH_STENCIL_ATTACHMENT,
                gl::TEXTURE_2D,
                depth,
                0,
            );
        }
        match gl::glCheckFramebufferStatus(gl::FRAMEBUFFER) {
            0x8CD5 => Ok(framebuffer),
            code => Err(format!("the target is not complete: {code:#x}")),
        }
    }
}

fn color_format(float: bool, linear: bool) -> gl::Enum {
    match (float, linear) {
        (true, _) => gl::RGBA32F,
        (false, true) => gl::SRGB8_ALPHA8,
        (false, false) => gl::RGBA8,
    }
}

impl<'a> Frame<'a> {
    pub fn new(
        bundle: &'a Bundle,
        bug: &'a str,
        samples: usize,
        extra: usize,
        float: bool,
    ) -> Result<Self, String> {
        let size =
            |name| bundle.number(&["image", name]).map(|size| size as usize * samples).ok_or("no size");
        let (width, height) = (size("width")?, size("height")?);
        let linear = bundle.word(&["compositing_space"]) == "linear";
        let format = color_format(float, linear);
        let kind = bundle.word(&["device", "depth"]).to_owned();
        let reversed = kind.contains("reversed");
        let depth = if kind.contains("24") { gl::DEPTH24_STENCIL8 } else { gl::DEPTH32F_STENCIL8 };
        let (wide, high) = (width + extra, height + extra);
        let color = texture(format, wide, high);
        let depth = texture(depth, wide, high);
        let framebuffer = target(color, Some(depth))?;
        let (ids_texture, plan_texture) = (texture(gl::R32UI, wide, high), texture(gl::RGBA32F, wide, high));
        let ids = target(ids_texture, Some(depth))?;
        let plan = target(plan_texture, Some(depth))?;
        unsafe {
            let mut array = 0;
            gl::glGenVertexArrays(1, &mut array);
            gl::glBindVertexArray(array);
            gl::glClipControl(gl::LOWER_LEFT, gl::ZERO_TO_ONE);
            gl::glDisable(gl::DITHER);
            gl::glViewport(0, 0, wide as i32, high as i32);
        }
        let nearer = if reversed { gl::GREATER } else { gl::LESS };
        let mut frame = Self {
            bundle,
            bug,
            samples,
            width,
            height,
            linear,
            nearer,
            framebuffer,
            ids,
            plan,
            ids_texture,
            plan_texture,
            extra,
            mesh: 0,
            corners: 0,
            float,
            offset: [0.0; 2],
            shown: None,
            imagery: None,
        };
        frame.read_imagery()?;
        frame.read_mesh()?;
        Ok(frame)
    }

    /// The texels that lie on the ground, if any do.
    fn read_imagery(&mut self) -> Result<(), String> {
        let Some((texels, width, height)) = self.bundle.picture("imagery.png")? else { return Ok(()) };
        let texture = texture(gl::RGBA8, width, height);
        let (w, h) = (width as i32, height as i32);
        unsafe {
            let from = texels.as_ptr().cast();
            gl::glTexSubImage2D(gl::TEXTURE_2D, 0, 0, 0, w, h, gl::RGBA, gl::UNSIGNED_BYTE, from);
        }
        self.imagery = Some(texture);
        gl::check()
    }

    /// West, south, east and north of the imagery, scene-local.
    fn extent(&self) -> [f32; 4] {
        let extent = self.bundle.numbers(&["ground", "extent"]);
        [0, 1, 2, 3].map(|k| extent.get(k).map_or(0.0, |v| *v as f32))
    }

    /// Each triangle with its own corners: place, colour, plan.
    fn read_mesh(&mut self) -> Result<(), String> {
        let (vertices, _) = self.bundle.table("mesh.vertices.npy")?;
        let (triangles, _) = self.bundle.table("mesh.triangles.npy")?;
        let plan = self.bundle.table("mesh.plan.npy").ok().map(|(plan, _)| plan);
        let ground = self.bundle.numbers(&["ground", "color"]);
        let light = self.bundle.numbers(&["ground", "light"]);
        let mut values = Vec::with_capacity(triangles.len() * 8);
        for corners in triangles.chunks_exact(3) {
            if corners[0] == f64::from(u32::MAX) {
                values.extend([0.0; 24]);
                continue;
            }
            let place = |k: f64, axis: usize| vertices[k as usize * 3 + axis];
            let side = |k: usize, axis| place(corners[k], axis) - place(corners[0], axis);
            let normal = [0, 1, 2].map(|axis: usize| {
                let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
                side(1, a) * side(2, b) - side(1, b) * side(2, a)
            });
            let length = normal.iter().map(|n| n * n).sum::<f64>().sqrt();
            let lit = match light.len() {
                3 => normal.iter().zip(&light).map(|(n, l)| n * l).sum::<f64>().max(0.0) / length,
                _ => 1.0,
            };
            let code = |c: &f64| if self.linear { to_linear(c * lit) } else { c * lit } as f32;
            let paint: Vec<f32> = match self.imagery {
                Some(_) => vec![lit as f32; 3],
                None => ground[..3].iter().map(code).collect(),
            };
            for corner in corners {
                values.extend([0, 1, 2].map(|axis| place(*corner, axis) as f32));
                values.extend(&paint);
                let over = |axis: usize| {
                    plan.as_ref().map_or(place(*corner, axis), |p| p[*corner as usize * 2 + axis])
                };
                values.extend([over(0) as f32, over(1) as f32]);
            }
        }
        self.corners = triangles.len();
        self.mesh = floats(&values);
        Ok(())
    }

    /// Working-space, premultiplied.
    pub fn premultiplied(&self, paint: Paint) -> [f32; 4] {
        let part = |c: f64| (if self.linear { to_linear(c) } else { c } * paint[3]) as f32;
        [part(paint[0]), part(paint[1]), part(paint[2]), paint[3] as f32]
    }

    /// Sets the transform of a program.
    pub fn use_program(&self, program: u32) {
        let mut matrix = self.bundle.matrix("clip_from_world");
        if self.extra > 0 {
            for (row, all) in [self.width, self.height].into_iter().enumerate() {
                let share = all as f64 / (all + self.extra) as f64;
                (0..4).for_each(|k| {
                    matrix[4 * row + k] = share * (matrix[4 * row + k] + matrix[12 + k]) - matrix[12 + k]
                });
            }
        }
        let matrix: Vec<f32> = matrix.iter().map(|v| *v as f32).collect();
        let half = if self.bug == "half-pixel" { 0.5 } else { 0.0 };
        let shift = [0, 1]
            .map(|axis| (2.0 * (self.offset[axis] + half) / [self.wide(), self.high()][axis] as f64) as f32);
        unsafe {
            gl::glUseProgram(program);
            gl::glUniformMatrix4fv(gl::uniform(program, "clip_from_world"), 1, 1, matrix.as_ptr());
            gl::glUniform2f(gl::uniform(program, "shift"), shift[0], shift[1]);
        }
    }

    /// Colour, depth, the triangles' numbers and plan points.
    pub fn terrain(&self) -> Result<(), String> {
        let paint = [
            "const uint NONE = 0xffffffffu;\n",
            include_str!("glsl/ground.glsl"),
            "in vec3 plan; layout(location = 0) out vec4 to;
            void main() { to = vec4(ground(uint(gl_PrimitiveID), plan.xy), 1.0); }",
        ]
        .concat();
        let number = "layout(location = 0) out uint to; void main() { to = uint(gl_PrimitiveID); }";
        let plan = "in vec3 plan; layout(location = 0) out vec4 to; void main() { to = vec4(plan, 0.0); }";
        let sky = self.sky();
        let far = if self.nearer == gl::GREATER { 0.0 } else { 1.0 };
        for (target, fragment) in [(self.ids, number), (self.plan, plan), (self.framebuffer, &paint)] {
            let program = gl::program(VERTEX, &format!("#version 450 core\n{fragment}"))?;
            self.use_program(program);
            self.tell_ground(program);
            unsafe {
                gl::glBindFramebuffer(gl::FRAMEBUFFER, target);
                gl::glBindBuffer(gl::ARRAY_BUFFER, self.mesh);
                for (at, size, from) in [(0, 3, 0usize), (2, 2, 24)] {
                    gl::glVertexAttribPointer(at, size, gl::FLOAT, 0, 32, from as *const _);
                    gl::glEnableVertexAttribArray(at);
                }
                gl::glEnable(gl::DEPTH_TEST);
                gl::glDepthFunc(self.nearer);
                gl::glDepthMask(1);
                if self.linear && !self.float {
                    gl::glEnable(gl::FRAMEBUFFER_SRGB);
                }
                match target == self.ids {
                    true => gl::glClearBufferuiv(gl::COLOR, 0, [u32::MAX; 4].as_ptr()),
                    false if target == self.plan => {
                        gl::glClearBufferfv(gl::COLOR, 0, [f32::INFINITY; 4].as_ptr())
                    }
                    false => gl::glClearBufferfv(gl::COLOR, 0, sky.as_ptr()),
                }
                gl::glClearBufferfi(gl::DEPTH_STENCIL, 0, far, 0);
                gl::glDrawArrays(gl::TRIANGLES, 0, self.corners as i32);
                gl::glDepthMask(0);
            }
        }
        gl::check()
    }

    /// Draws `inside`, and what lay below over it as much as the layer's opacity says.
    pub fn layer(&self, opacity: f64, inside: &mut dyn FnMut() -> Result<(), String>) -> Result<(), String> {
        if opacity == 1.0 {
            return inside();
        }
        let format = color_format(self.float, self.linear);
        let below = texture(format, self.width, self.height);
        let copy = target(below, None)?;
        let (w, h) = (self.width as i32, self.height as i32);
        unsafe {
            gl::glBindFramebuffer(gl::READ_FRAMEBUFFER, self.framebuffer);
            gl::glBindFramebuffer(gl::DRAW_FRAMEBUFFER, copy);
            gl::glBlitFramebuffer(0, 0, w, h, 0, 0, w, h, gl::COLOR_BIT, gl::NEAREST);
            gl::glBindFramebuffer(gl::FRAMEBUFFER, self.framebuffer);
        }
        inside()?;
        let fragment = "#version 450 core
            uniform sampler2D below; layout(location = 0) out vec4 to;
            void main() { to = texelFetch(below, ivec2(gl_FragCoord.xy), 0); }";
        let program = gl::program(SCREEN, fragment)?;
        unsafe {
            gl::glUseProgram(program);
            gl::glActiveTexture(gl::TEXTURE0);
            gl::glBindTexture(gl::TEXTURE_2D, below);
            gl::glUniform1i(gl::uniform(program, "below"), 0);
            gl::glDisable(gl::DEPTH_TEST);
            gl::glDisable(gl::STENCIL_TEST);
            gl::glEnable(gl::BLEND);
            gl::glColorMask(1, 1, 1, 1);
            gl::glBlendColor(0.0, 0.0, 0.0, 1.0 - opacity as f32);
            gl::glBlendFunc(gl::CONSTANT_ALPHA, gl::ONE_MINUS_CONSTANT_ALPHA);
        }
        self.fill();
        Ok(())
    }

    /// A program over the whole picture that knows what pixels see: `plan`, `ids`, the ground and the sky.
    pub fn screen_program(&self, fragment: &str) -> Result<u32, String> {
        self.program_that_sees(SCREEN, fragment)
    }

    /// The same with another vertex shader.
    pub fn program_that_sees(&self, vertex: &str, fragment: &str) -> Result<u32, String> {
        let program = gl::program(vertex, &format!("#version 450 core\n{fragment}"))?;
        let set = |name: &str, value: i32| unsafe { gl::glUniform1i(gl::uniform(program, name), value) };
        let textures = [("plan", self.plan_texture), ("ids", self.ids_texture)];
        unsafe {
            gl::glUseProgram(program);
            for (unit, (name, texture)) in (4..).zip(textures) {
                gl::glActiveTexture(gl::TEXTURE0 + unit);
                gl::glBindTexture(gl::TEXTURE_2D, texture);
                set(name, unit as i32);
            }
            let [r, g, b, a] = self.sky();
            gl::glUniform4f(gl::uniform(program, "sky"), r, g, b, a);
        }
        self.tell_ground(program);
        gl::check()?;
        Ok(program)
    }

    /// Draws all pixels by one triangle that is not clipped: along the seam of clipped ones Mesa 22.3's llvmpipe loses loops of shaders.
    pub fn fill(&self) {
        let (w, h) = (self.wide() as i32, self.high() as i32);
        unsafe {
            gl::glViewport(0, 0, 3 * w, 3 * h);
            gl::glDrawArrays(gl::TRIANGLES, 0, 3);
            gl::glViewport(0, 0, w, h);
        }
    }

    /// What `glsl/ground.glsl` asks of a program in use.
    pub fn tell_ground(&self, program: u32) {
        let at = |name: &str| gl::uniform(program, name);
        let [west, south, east, north] = self.extent();
        unsafe {
            crate::tables::texels(program, 7, "mesh_numbers", self.mesh, gl::R32F);
            gl::glActiveTexture(gl::TEXTURE0 + 6);
            gl::glBindTexture(gl::TEXTURE_2D, self.imagery.unwrap_or(0));
            gl::glUniform1i(at("imagery"), 6);
            gl::glUniform1i(at("images"), i32::from(self.imagery.is_some()));
            gl::glUniform1i(at("linear"), i32::from(self.linear));
            gl::glUniform4f(at("extent"), west, south, east, north);
        }
    }

    fn sky(&self) -> [f32; 4] {
        let sky = self.bundle.numbers(&["image", "background"]);
        self.premultiplied([sky[0], sky[1], sky[2], sky[3]])
    }

    /// Makes a target of floating point the finished picture; `encoded`: it is not in linear light.
    pub fn show(&mut self, target: u32, encoded: bool) {
        self.shown = Some(target);
        self.linear &= !encoded;
    }

    /// The mean of what a program makes of what pixels see at so many places, pixels right and down from their centres.
    pub fn mean(&mut self, places: &[[f64; 2]], program: u32) -> Result<(), String> {
        let sum = target(texture(gl::RGBA32F, self.wide(), self.high()), None)?;
        unsafe {
            gl::glBindFramebuffer(gl::FRAMEBUFFER, sum);
            gl::glClearBufferfv(gl::COLOR, 0, [0.0; 4].as_ptr());
        }
        for [right, down] in places {
            self.offset = [-right, *down];
            self.terrain()?;
            unsafe {
                gl::glUseProgram(program);
                gl::glUniform1f(gl::uniform(program, "share"), 1.0 / places.len() as f32);
                gl::glBindFramebuffer(gl::FRAMEBUFFER, sum);
                gl::glDisable(gl::DEPTH_TEST);
                gl::glDisable(gl::FRAMEBUFFER_SRGB);
                gl::glEnable(gl::BLEND);
                gl::glBlendFunc(gl::ONE, gl::ONE);
                self.fill();
                gl::glDisable(gl::BLEND);
            }
        }
        // Buffers are of the centres.
        self.offset = [0.0; 2];
        self.terrain()?;
        self.show(sum, false);
        gl::check()
    }

    fn read<T: Copy + Default>(&self, target: u32, format: gl::Enum, kind: gl::Enum, parts: usize) -> Vec<T> {
        let row = self.width * parts;
        let mut values = vec![T::default(); row * self.height];
        unsafe {
            gl::glBindFramebuffer(gl::FRAMEBUFFER, target);
            let (w, h) = (self.width as i32, self.height as i32);
            gl::glReadPixels(0, 0, w, h, format, kind, values.as_mut_ptr().cast());
        }
        values.chunks_exact(row).rev().flatten().copied().collect()
    }

    /// The number of the pixel that sees what is nearest to the eye's plane; of equals the first from the top, row by row.
    fn nearest_pixel(&self) -> Option<usize> {
        let depths: Vec<f32> = self.read(self.framebuffer, gl::DEPTH_COMPONENT, gl::FLOAT, 1);
        let ids: Vec<u32> = self.read(self.ids, gl::RED_INTEGER, gl::UNSIGNED_INT, 1);
        let of = |k: usize| self.view_depth(depths[k], ids[k]);
        (0..ids.len()).filter(|k| ids[*k] != u32::MAX).min_by(|a, b| of(*a).total_cmp(&of(*b)))
    }

    /// The plan point that it sees.
    pub fn nearest(&self) -> Option<[f64; 2]> {
        let plan: Vec<f32> = self.read(self.plan, gl::RGBA, gl::FLOAT, 4);
        self.nearest_pixel().map(|k| [f64::from(plan[4 * k]), f64::from(plan[4 * k + 1])])
    }

    /// The size of a pixel, metres, at what the picture's middle sees, or else at what is nearest.
    pub fn middle_pixel(&self) -> f64 {
        let ids: Vec<u32> = self.read(self.ids, gl::RED_INTEGER, gl::UNSIGNED_INT, 1);
        let plan: Vec<f32> = self.read(self.plan, gl::RGBA, gl::FLOAT, 4);
        let pixel = self.bundle.number(&["camera", "pixel"]).unwrap_or(0.0);
        let eye = self.bundle.numbers(&["camera", "eye"]);
        let middle = self.height / 2 * self.width + self.width / 2;
        let seen = Some(middle).filter(|k| ids[*k] != u32::MAX).or_else(|| self.nearest_pixel());
        let away = |k: usize| {
            (0..3).map(|axis| (f64::from(plan[4 * k + axis]) - eye[axis]).powi(2)).sum::<f64>().sqrt()
        };
        match self.bundle.parameters["camera"]["orthographic"] == true {
            true => pixel,
            false => seen.map_or(pixel, |k| pixel * away(k)),
        }
    }

    /// The pixels in a row that are drawn, with those beyond the border.
    pub fn wide(&self) -> usize {
        self.width + self.extra
    }

    /// The rows that are drawn.
    pub fn high(&self) -> usize {
        self.height + self.extra
    }

    /// The picture, the view depths and the triangles' numbers.
    pub fn save(&self, folder: &Path) -> Result<(), String> {
        let of = self.bundle.technique();
        let depth: Vec<f32> = self.read(self.framebuffer, gl::DEPTH_COMPONENT, gl::FLOAT, 1);
        let ids: Vec<u32> = self.read(self.ids, gl::RED_INTEGER, gl::UNSIGNED_INT, 1);
        let depth: Vec<u8> =
            depth.iter().zip(&ids).flat_map(|(d, id)| self.view_depth(*d, *id).to_le_bytes()).collect();
        let shape = format!("{}, {}", self.height, self.width);
        write::npy(&folder.join(format!("{of}.depth.npy")), "<f8", &shape, &depth)?;
        let ids: Vec<u8> = ids.iter().flat_map(|id| id.to_le_bytes()).collect();
        write::npy(&folder.join(format!("{of}.triangle.npy")), "<u4", &shape, &ids)?;
        let values: Vec<f64> = if self.float || self.shown.is_some() {
            let from = self.shown.unwrap_or(self.framebuffer);
            let values: Vec<f32> = self.read(from, gl::RGBA, gl::FLOAT, 4);
            values.iter().map(|v| f64::from(*v).min(1.0)).collect()
        } else {
            let values: Vec<u8> = self.read(self.framebuffer, gl::RGBA, gl::UNSIGNED_BYTE, 4);
            let linear = |k: usize, v: f64| if self.linear && k % 4 != 3 { to_linear(v) } else { v };
            values.iter().enumerate().map(|(k, v)| linear(k, f64::from(*v) / 255.0)).collect()
        };
        write::png(&folder.join(format!("{of}.png")), self.width / self.samples, &self.codes(&values))?;
        gl::check()
    }

    /// The metres in front of the eye of a stored depth, by the third and fourth row of the transform.
    fn view_depth(&self, stored: f32, id: u32) -> f64 {
        if id == u32::MAX {
            return f64::INFINITY;
        }
        let (clip, view) = (self.bundle.matrix("clip_from_world"), self.bundle.matrix("view_from_world"));
        let ahead: Vec<f64> = view[8..12].iter().map(|v| -v).collect();
        let steepest = (0..3).max_by(|a, b| ahead[*a].abs().total_cmp(&ahead[*b].abs())).unwrap_or(0);
        let scale = clip[8 + steepest] / ahead[steepest];
        let offset = clip[11] - scale * ahead[3];
        let orthographic = clip[12..15] == [0.0; 3];
        match (f64::from(stored), orthographic) {
            (z, true) => (z - offset) / scale,
            (z, false) => offset / (z - scale),
        }
    }

    /// The mean of the samples, straight, encoded and rounded.
    fn codes(&self, values: &[f64]) -> Vec<u8> {
        let n = self.samples;
        let mut codes = Vec::with_capacity(values.len() / n / n);
        for y in 0..self.height / n {
            for x in 0..self.width / n {
                let of =
                    |k: usize, part: usize| values[((y * n + k / n) * self.width + x * n + k % n) * 4 + part];
                let mean =
                    [0, 1, 2, 3].map(|part| (0..n * n).map(|k| of(k, part)).sum::<f64>() / (n * n) as f64);
                for part in mean[..3].iter().map(|c| if mean[3] == 0.0 { 0.0 } else { c / mean[3] }) {
                    let encoded = if self.linear { to_encoded(part) } else { part };
                    codes.push((255.0 * encoded.clamp(0.0, 1.0) + 0.5).floor() as u8);
                }
                codes.push((255.0 * mean[3] + 0.5).floor() as u8);
            }
        }
        codes
    }
}
