//! Numbers for shaders: tables one after another in two buffers, and where each begins as GLSL constants.

use crate::bundle::Bundle;
use crate::gl;

/// Tables of whole numbers and of single precision.
#[derive(Default)]
pub struct Tables {
    whole: Vec<u32>,
    single: Vec<f32>,
    /// `const int NAME = ...;` of each.
    pub text: String,
}

impl Tables {
    fn begin(&mut self, name: &str, at: usize) {
        self.text += &format!("const int {name} = {at};\n");
    }

    pub fn whole(&mut self, name: &str, values: impl IntoIterator<Item = u32>) {
        self.begin(name, self.whole.len());
        self.whole.extend(values);
    }

    pub fn single(&mut self, name: &str, values: impl IntoIterator<Item = f32>) {
        self.begin(name, self.single.len());
        self.single.extend(values);
    }

    /// A number that shaders know by its name.
    pub fn number(&mut self, name: &str, value: i32) {
        self.text += &format!("const int {name} = {value};\n");
    }

    /// Tells a program, which is in use from here on, where both are.
    pub fn bind(&self, program: u32) {
        unsafe { gl::glUseProgram(program) };
        texels(program, 8, "whole_numbers", buffer(&self.whole), gl::R32UI);
        texels(program, 9, "single_numbers", buffer(&self.single), gl::R32F);
    }
}

/// Binds a buffer to a unit, as texels that a program in use reads.
pub fn texels(program: u32, unit: u32, name: &str, buffer: u32, format: gl::Enum) {
    let mut texture = 0;
    unsafe {
        gl::glGenTextures(1, &mut texture);
        gl::glActiveTexture(gl::TEXTURE0 + unit);
        gl::glBindTexture(gl::TEXTURE_BUFFER, texture);
        gl::glTexBuffer(gl::TEXTURE_BUFFER, format, buffer);
        gl::glUniform1i(gl::uniform(program, name), unit as i32);
    }
}

/// A buffer that holds values; an empty one holds something, as none can be empty.
pub fn buffer<T>(values: &[T]) -> u32 {
    let mut buffer = 0;
    let size = size_of_val(values) as isize;
    unsafe {
        gl::glGenBuffers(1, &mut buffer);
        gl::glBindBuffer(gl::ARRAY_BUFFER, buffer);
        gl::glBufferData(gl::ARRAY_BUFFER, size.max(16), std::ptr::null(), gl::STATIC_DRAW);
        gl::glBufferSubData(gl::ARRAY_BUFFER, 0, size, values.as_ptr().cast());
    }
    buffer
}

/// A buffer for shaders, bound to a place of its own.
pub fn storage<T>(place: u32, values: &[T]) -> u32 {
    let buffer = buffer(values);
    unsafe { gl::glBindBufferBase(gl::SHADER_STORAGE_BUFFER, place, buffer) };
    buffer
}

/// `items.npy` and `items.paint.npy`: who is painted, and how. Paints are premultiplied, in the space that is blended in.
pub fn items(of: &Bundle, bug: &str, tables: &mut Tables) -> Result<(), String> {
    let rows = of.table("items.npy")?.0;
    let mut paints = of.table("items.paint.npy")?.0;
    let lines: Vec<usize> = (0..rows.len() / 6).filter(|k| rows[6 * k + 2] >= 2.0).collect();
    let mut layers: Vec<u32> = rows.chunks_exact(6).map(|row| row[0] as u32).collect();
    if let ("missing-line", Some(k)) = (bug, lines.get(lines.len() / 2)) {
        paints[5 * k + 3] = 0.0;
    }
    if bug == "opacity-each" {
        paints.chunks_exact_mut(5).for_each(|p| (p[3], p[4]) = (p[3] * p[4], 1.0));
        layers.iter_mut().for_each(|layer| *layer = 0);
    }
    let linear = of.word(&["compositing_space"]) == "linear" && bug != "encoded-blends";
    tables.whole("ITEMS", rows.iter().map(|v| *v as u32));
    tables.single(
        "PAINTS",
        paints.chunks_exact(5).flat_map(|p| {
            let part = |c: f64| (if linear { crate::bundle::to_linear(c) } else { c } * p[3]) as f32;
            [part(p[0]), part(p[1]), part(p[2]), p[3] as f32, p[4] as f32]
        }),
    );
    let additive = of.word(&["compositing_mode"]) == "additive" && bug != "over";
    tables.number("ADDITIVE", i32::from(additive));
    tables.number("UPSIDE_DOWN", i32::from(bug == "layer-order"));
    Ok(())
}
