//! A headless OpenGL 4.5 context on Mesa's software GPU, and the few calls that the client makes.
#![allow(non_snake_case, missing_docs, clippy::missing_safety_doc)]

use std::ffi::{CStr, CString, c_char, c_void};
use std::ptr::{null, null_mut};

pub type Enum = u32;

pub const FUNC_ADD: Enum = 0x8006;
pub const MIN: Enum = 0x8007;
pub const SCISSOR_TEST: Enum = 0xC11;
pub const TEXTURE_2D_ARRAY: Enum = 0x8C1A;
pub const LINES: Enum = 1;
pub const POLYGON_OFFSET_FILL: Enum = 0x8037;
pub const TRIANGLES: Enum = 4;
pub const LESS: Enum = 0x201;
pub const GREATER: Enum = 0x204;
pub const EQUAL: Enum = 0x202;
pub const NOTEQUAL: Enum = 0x205;
pub const ALWAYS: Enum = 0x207;
pub const ZERO: Enum = 0;
pub const ONE: Enum = 1;
pub const ONE_MINUS_SRC_ALPHA: Enum = 0x303;
pub const CONSTANT_ALPHA: Enum = 0x8003;
pub const ONE_MINUS_CONSTANT_ALPHA: Enum = 0x8004;
pub const FRONT: Enum = 0x404;
pub const BACK: Enum = 0x405;
pub const FRONT_AND_BACK: Enum = 0x408;
pub const DEPTH_TEST: Enum = 0xB71;
pub const STENCIL_TEST: Enum = 0xB90;
pub const CULL_FACE: Enum = 0xB44;
pub const ALL_BARRIERS: u32 = u32::MAX;
pub const BLEND: Enum = 0xBE2;
pub const DITHER: Enum = 0xBD0;
pub const DEPTH_CLAMP: Enum = 0x864F;
pub const FRAMEBUFFER_SRGB: Enum = 0x8DB9;
pub const UNSIGNED_BYTE: Enum = 0x1401;
pub const UNSIGNED_INT: Enum = 0x1405;
pub const FLOAT: Enum = 0x1406;
pub const DEPTH_COMPONENT: Enum = 0x1902;
pub const RGBA: Enum = 0x1908;
pub const RED_INTEGER: Enum = 0x8D94;
pub const KEEP: Enum = 0x1E00;
pub const REPLACE: Enum = 0x1E01;
pub const INCR: Enum = 0x1E02;
pub const DECR: Enum = 0x1E03;
pub const INCR_WRAP: Enum = 0x8507;
pub const DECR_WRAP: Enum = 0x8508;
pub const RGBA8: Enum = 0x8058;
pub const SRGB8_ALPHA8: Enum = 0x8C43;
pub const RGBA32F: Enum = 0x8814;
pub const R32F: Enum = 0x822E;
pub const R32UI: Enum = 0x8236;
pub const DEPTH24_STENCIL8: Enum = 0x88F0;
pub const DEPTH32F_STENCIL8: Enum = 0x8CAD;
pub const FRAMEBUFFER: Enum = 0x8D40;
pub const READ_FRAMEBUFFER: Enum = 0x8CA8;
pub const DRAW_FRAMEBUFFER: Enum = 0x8CA9;
pub const COLOR_ATTACHMENT0: Enum = 0x8CE0;
pub const DEPTH_STENCIL_ATTACHMENT: Enum = 0x821A;
pub const TEXTURE_2D: Enum = 0xDE1;
pub const TEXTURE0: Enum = 0x84C0;
pub const TEXTURE_BUFFER: Enum = 0x8C2A;
pub const SHADER_STORAGE_BUFFER: Enum = 0x90D2;
pub const ARRAY_BUFFER: Enum = 0x8892;
pub const STATIC_DRAW: Enum = 0x88E4;
pub const COLOR: Enum = 0x1800;
pub const DEPTH_STENCIL: Enum = 0x84F9;
pub const TEXTURE_MAG_FILTER: Enum = 0x2800;
pub const TEXTURE_MIN_FILTER: Enum = 0x2801;
pub const NEAREST: Enum = 0x2600;
pub const COLOR_BIT: u32 = 0x4000;
pub const LOWER_LEFT: Enum = 0x8CA1;
pub const ZERO_TO_ONE: Enum = 0x935F;
const VERTEX_SHADER: Enum = 0x8B31;
const FRAGMENT_SHADER: Enum = 0x8B30;
const RENDERER: Enum = 0x1F01;
const VERSION: Enum = 0x1F02;
const SUBPIXEL_BITS: Enum = 0xD50;

#[link(name = "EGL")]
unsafe extern "C" {
    fn eglGetPlatformDisplay(platform: u32, native: *mut c_void, attributes: *const isize) -> *mut c_void;
    fn eglInitialize(display: *mut c_void, major: *mut i32, minor: *mut i32) -> u32;
    fn eglBindAPI(api: u32) -> u32;
    fn eglCreateContext(
        d: *mut c_void,
        config: *mut c_void,
        share: *mut c_void,
        a: *const i32,
    ) -> *mut c_void;
    fn eglMakeCurrent(d: *mut c_void, draw: *mut c_void, read: *mut c_void, context: *mut c_void) -> u32;
}

#[link(name = "GL")]
unsafe extern "C" {
    fn glGetString(name: Enum) -> *const c_char;
    fn glGetIntegerv(name: Enum, to: *mut i32);
    fn glGetError() -> Enum;
    fn glCreateShader(kind: Enum) -> u32;
    fn glShaderSource(shader: u32, count: i32, text: *const *const c_char, lengths: *const i32);
    fn glCompileShader(shader: u32);
    fn glGetShaderInfoLog(shader: u32, size: i32, length: *mut i32, to: *mut c_char);
    fn glCreateProgram() -> u32;
    fn glAttachShader(program: u32, shader: u32);
    fn glLinkProgram(program: u32);
    fn glGetProgramiv(program: u32, name: Enum, to: *mut i32);
    fn glGetUniformLocation(program: u32, name: *const c_char) -> i32;
    pub fn glUseProgram(program: u32);
    pub fn glUniformMatrix4fv(at: i32, count: i32, transpose: u8, from: *const f32);
    pub fn glUniform4f(at: i32, x: f32, y: f32, z: f32, w: f32);
    pub fn glUniform3f(at: i32, x: f32, y: f32, z: f32);
    pub fn glUniform2f(at: i32, x: f32, y: f32);
    pub fn glUniform1f(at: i32, x: f32);
    pub fn glUniform1i(at: i32, x: i32);
    pub fn glGenVertexArrays(count: i32, to: *mut u32);
    pub fn glBindVertexArray(array: u32);
    pub fn glGenBuffers(count: i32, to: *mut u32);
    pub fn glBindBuffer(target: Enum, buffer: u32);
    pub fn glBindBufferBase(target: Enum, at: u32, buffer: u32);
    pub fn glBufferSubData(target: Enum, from: isize, size: isize, values: *const c_void);
    pub fn glGetBufferSubData(target: Enum, from: isize, size: isize, to: *mut c_void);
    pub fn glBufferData(target: Enum, size: isize, from: *const c_void, usage: Enum);
    pub fn glVertexAttribPointer(
        at: u32,
        size: i32,
        kind: Enum,
        norm: u8,
        stride: i32,
        offset: *const c_void,
    );
    pub fn glEnableVertexAttribArray(at: u32);
    pub fn glDisableVertexAttribArray(at: u32);
    pub fn glBlendEquation(mode: Enum);
    pub fn glScissor(x: i32, y: i32, width: i32, height: i32);
    pub fn glTexStorage3D(target: Enum, levels: i32, format: Enum, width: i32, height: i32, depth: i32);
    pub fn glFramebufferTextureLayer(target: Enum, attachment: Enum, texture: u32, level: i32, layer: i32);
    pub fn glLineWidth(width: f32);
    pub fn glPolygonOffset(factor: f32, units: f32);
    pub fn glMemoryBarrier(barriers: u32);
    pub fn glCullFace(face: Enum);
    pub fn glGenTextures(count: i32, to: *mut u32);
    pub fn glActiveTexture(unit: Enum);
    pub fn glBindTexture(target: Enum, texture: u32);
    pub fn glTexBuffer(target: Enum, format: Enum, buffer: u32);
    pub fn glTexStorage2D(target: Enum, levels: i32, format: Enum, width: i32, height: i32);
    pub fn glTexSubImage2D(
        target: Enum,
        level: i32,
        x: i32,
        y: i32,
        width: i32,
        height: i32,
        format: Enum,
        kind: Enum,
        from: *const c_void,
    );
    pub fn glTexParameteri(target: Enum, name: Enum, value: i32);
    pub fn glGenFramebuffers(count: i32, to: *mut u32);
    pub fn glBindFramebuffer(target: Enum, framebuffer: u32);
    pub fn glFramebufferTexture2D(target: Enum, attachment: Enum, kind: Enum, texture: u32, level: i32);
    pub fn glCheckFramebufferStatus(target: Enum) -> Enum;
    pub fn glBlitFramebuffer(
        a: i32,
        b: i32,
        c: i32,
        d: i32,
        e: i32,
        f: i32,
        g: i32,
        h: i32,
        mask: u32,
        filter: Enum,
    );
    pub fn glClearBufferfv(buffer: Enum, at: i32, value: *const f32);
    pub fn glClearBufferuiv(buffer: Enum, at: i32, value: *const u32);
    pub fn glClearBufferfi(buffer: Enum, at: i32, depth: f32, stencil: i32);
    pub fn glClipControl(origin: Enum, depth: Enum);
    pub fn glEnable(what: Enum);
    pub fn glDisable(what: Enum);
    pub fn glViewport(x: i32, y: i32, width: i32, height: i32);
    pub fn glDepthFunc(func: Enum);
    pub fn glDepthMask(on: u8);
    pub fn glColorMask(r: u8, g: u8, b: u8, a: u8);
    pub fn glStencilMask(mask: u32);
    pub fn glStencilFunc(func: Enum, reference: i32, mask: u32);
    pub fn glStencilOpSeparate(face: Enum, stencil_fails: Enum, depth_fails: Enum, passes: Enum);
    pub fn glBlendFunc(source: Enum, destination: Enum);
    pub fn glBlendColor(r: f32, g: f32, b: f32, a: f32);
    pub fn glDrawArrays(mode: Enum, first: i32, count: i32);
    pub fn glReadPixels(x: i32, y: i32, width: i32, height: i32, format: Enum, kind: Enum, to: *mut c_void);
}

/// A current context without a window, and what drives it.
pub fn open() -> Result<String, String> {
    unsafe {
        let display = eglGetPlatformDisplay(0x31DD, null_mut(), null());
        if eglInitialize(display, null_mut(), null_mut()) == 0 || eglBindAPI(0x30A2) == 0 {
            return Err("EGL has no display without a surface".into());
        }
        let wanted = [0x3098, 4, 0x30FB, 5, 0x30FD, 1, 0x3038];
        let context = eglCreateContext(display, null_mut(), null_mut(), wanted.as_ptr());
        if context.is_null() || eglMakeCurrent(display, null_mut(), null_mut(), context) == 0 {
            return Err("EGL has no context of OpenGL 4.5".into());
        }
        let mut bits = 0;
        glGetIntegerv(SUBPIXEL_BITS, &mut bits);
        let says = |name| CStr::from_ptr(glGetString(name)).to_string_lossy();
        Ok(format!("{}; {}; {bits} sub-pixel bits", says(RENDERER), says(VERSION)))
    }
}

/// A program of a vertex and a fragment shader.
pub fn program(vertex: &str, fragment: &str) -> Result<u32, String> {
    unsafe {
        let program = glCreateProgram();
        let mut log = vec![0u8; 4096];
        for (kind, text) in [(VERTEX_SHADER, vertex), (FRAGMENT_SHADER, fragment)] {
            let shader = glCreateShader(kind);
            let text = CString::new(text).map_err(|error| error.to_string())?;
            glShaderSource(shader, 1, &text.as_ptr(), null());
            glCompileShader(shader);
            glGetShaderInfoLog(shader, 4096, null_mut(), log.as_mut_ptr().cast());
            glAttachShader(program, shader);
        }
        glLinkProgram(program);
        let mut linked = 0;
        glGetProgramiv(program, 0x8B82, &mut linked);
        if linked == 0 {
            return Err(format!("a shader does not compile: {}", String::from_utf8_lossy(&log)));
        }
        Ok(program)
    }
}

pub fn uniform(program: u32, name: &str) -> i32 {
    let name = CString::new(name).expect("names have no zeros");
    unsafe { glGetUniformLocation(program, name.as_ptr()) }
}

/// A texture of so many square layers.
pub fn layers(side: usize, count: usize) -> u32 {
    let mut texture = 0;
    unsafe {
        glGenTextures(1, &mut texture);
        glBindTexture(TEXTURE_2D_ARRAY, texture);
        glTexStorage3D(TEXTURE_2D_ARRAY, 1, RGBA32F, side as i32, side as i32, count as i32);
        for filter in [TEXTURE_MIN_FILTER, TEXTURE_MAG_FILTER] {
            glTexParameteri(TEXTURE_2D_ARRAY, filter, NEAREST as i32);
        }
    }
    texture
}

/// Calls that fail say so here, at the end of the frame.
pub fn check() -> Result<(), String> {
    match unsafe { glGetError() } {
        0 => Ok(()),
        code => Err(format!("OpenGL says error {code:#x}")),
    }
}
