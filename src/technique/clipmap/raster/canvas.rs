//! The texels of a tile, and blending into them.

use super::exact::RowCoverage;
use crate::resolve::Paint;
use crate::scene::{BlendMode, TexelFormat};

/// A paint as texels are blended with it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ink {
    /// Red, green, blue, premultiplied, and alpha.
    color: [f32; 4],
    mode: BlendMode,
}

impl Ink {
    /// The ink of a paint.
    pub fn new(paint: Paint, mode: BlendMode) -> Self {
        Self { color: paint.0.map(|v| v as f32), mode }
    }

    /// Its alpha.
    pub(super) fn alpha(&self) -> f64 {
        f64::from(self.color[3])
    }

    /// Whether blending adds.
    pub(super) fn adds(&self) -> bool {
        self.mode == BlendMode::Additive
    }
}

/// A tile's texels: premultiplied paint of the working space, rows from the north.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Canvas {
    width: usize,
    texels: Vec<[f32; 4]>,
    format: TexelFormat,
}

impl Canvas {
    /// An empty tile.
    pub(super) fn new((width, height): (usize, usize), format: TexelFormat) -> Self {
        Self { width, texels: vec![[0.0; 4]; width * height], format }
    }

    /// All texels, rows from the north.
    pub(super) fn texels(&self) -> &[[f32; 4]] {
        &self.texels
    }

    /// The texels.
    pub(super) fn into_texels(self) -> Vec<[f32; 4]> {
        self.texels
    }

    /// Blends ink into a row, as much of it as is covered.
    pub(super) fn blend(&mut self, row: usize, coverage: &RowCoverage, ink: &Ink) {
        let texels = &mut self.texels[row * self.width..(row + 1) * self.width];
        let texels = &mut texels[coverage.first..coverage.first + coverage.coverage.len()];
        let is_opaque = ink.color[3] >= 1.0 && ink.mode == BlendMode::Over;
        for (texel, &share) in texels.iter_mut().zip(&coverage.coverage) {
            if share == 1.0 && is_opaque {
                *texel = ink.color;
            } else if share > 0.0 {
                *texel = blended(*texel, ink, share);
                if self.format == TexelFormat::Unorm8 {
                    *texel = texel.map(rounded);
                }
            }
        }
        if is_opaque && self.format == TexelFormat::Unorm8 {
            texels.iter_mut().for_each(|texel| *texel = texel.map(rounded));
        }
    }
}

#[inline(always)]
fn blended(below: [f32; 4], ink: &Ink, share: f32) -> [f32; 4] {
    let source = ink.color.map(|v| v * share);
    match ink.mode {
        BlendMode::Over => {
            let keep = 1.0 - source[3];
            std::array::from_fn(|k| source[k] + below[k] * keep)
        }
        BlendMode::Additive => std::array::from_fn(|k| crate::math::min_f32(below[k] + source[k], 1.0)),
    }
}

/// The nearest of 256 code values.
#[inline(always)]
fn rounded(v: f32) -> f32 {
    (v * 255.0 + 0.5).floor() / 255.0
}
