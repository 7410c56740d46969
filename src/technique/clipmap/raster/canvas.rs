//! The texels of a tile, and blending into them.

use super::rows::{ByRows, FOUR, RowCoverage, Runs};
use super::weight::Weight;
use crate::resolve::Paint;
use crate::scene::BlendMode;
use crate::technique::clipmap::TexelFormat;
use std::ops::Range;

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
#[derive(Debug, Clone)]
pub(super) struct Canvas {
    width: usize,
    /// Texels of a row with those that fill it to a multiple of four.
    stride: usize,
    texels: Vec<[f32; 4]>,
    format: TexelFormat,
    arch: pulp::Arch,
}

impl Canvas {
    /// An empty tile.
    pub(super) fn new((width, height): (usize, usize), format: TexelFormat) -> Self {
        let stride = width.next_multiple_of(FOUR);
        Self { width, stride, texels: vec![[0.0; 4]; stride * height], format, arch: pulp::Arch::new() }
    }

    /// A row of texels.
    pub(super) fn row(&self, row: usize) -> &[[f32; 4]] {
        &self.texels[row * self.stride..][..self.width]
    }

    /// Empties all texels.
    pub(super) fn clear(&mut self) {
        self.texels.fill([0.0; 4]);
    }

    /// Mixes all texels with what they were: `share` of what they are now.
    pub(super) fn mix(&mut self, before: &[[f32; 4]], share: f32) {
        for (texel, before) in self.texels.iter_mut().zip(before) {
            let mixed = std::array::from_fn(|k| before[k] * (1.0 - share) + texel[k] * share);
            *texel = rounded(mixed, self.format);
        }
    }

    /// All texels, with those that fill the rows.
    pub(super) fn texels(&self) -> &[[f32; 4]] {
        &self.texels
    }

    /// Blends ink into a row, as much of it as is covered.
    pub(super) fn blend(&mut self, row: usize, coverage: &RowCoverage, ink: &Ink) {
        let texels = &mut self.texels[row * self.stride + coverage.first..];
        for (texel, &share) in texels.iter_mut().zip(&coverage.coverage) {
            *texel = blended(*texel, ink, share, self.format);
        }
    }

    /// Blends ink wherever an item lies.
    pub(super) fn blend_item(&mut self, item: &mut impl ByRows, weight: Weight, ink: &Ink) {
        let arch = self.arch;
        if ink.mode == BlendMode::Over && self.format == TexelFormat::F32 {
            arch.dispatch(OverItem { canvas: self, item, weight, color: ink.color });
        } else {
            arch.dispatch(BlendItem { canvas: self, item, weight, ink });
        }
    }
}

/// Blends ink into a row in any way.
struct Blend<'a> {
    texels: &'a mut [[f32; 4]],
    ink: &'a Ink,
    format: TexelFormat,
}

impl Runs for Blend<'_> {
    #[inline(always)]
    fn alike(&mut self, columns: Range<usize>, coverage: f32) {
        for texel in &mut self.texels[columns] {
            *texel = blended(*texel, self.ink, coverage, self.format);
        }
    }

    #[inline(always)]
    fn four(&mut self, first: usize, coverage: &[f32; FOUR]) {
        for (texel, share) in self.texels[first..first + FOUR].iter_mut().zip(coverage) {
            *texel = blended(*texel, self.ink, *share, self.format);
        }
    }
}

/// Blends an item into a tile; compiled for the widest vectors of the machine at hand, the bits are the same with any.
struct BlendItem<'a, I> {
    canvas: &'a mut Canvas,
    item: &'a mut I,
    weight: Weight,
    ink: &'a Ink,
}

impl<I: ByRows> pulp::WithSimd for BlendItem<'_, I> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { canvas, item, weight, ink } = self;
        let format = canvas.format;
        for row in item.rows() {
            let texels = &mut canvas.texels[row * canvas.stride..][..canvas.stride];
            item.take_row(row, weight, &mut Blend { texels, ink, format });
        }
    }
}

/// The same for what is mostly done: blending over texels that are numbers.
struct OverItem<'a, I> {
    canvas: &'a mut Canvas,
    item: &'a mut I,
    weight: Weight,
    color: [f32; 4],
}

impl<I: ByRows> pulp::WithSimd for OverItem<'_, I> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { canvas, item, weight, color } = self;
        for row in item.rows() {
            let texels = &mut canvas.texels[row * canvas.stride..][..canvas.stride];
            item.take_row(row, weight, &mut Over { texels, color });
        }
    }
}

/// Blends ink over a row.
struct Over<'a> {
    texels: &'a mut [[f32; 4]],
    color: [f32; 4],
}

impl Runs for Over<'_> {
    #[inline(always)]
    fn alike(&mut self, columns: Range<usize>, coverage: f32) {
        let texels = &mut self.texels[columns];
        if coverage == 1.0 && self.color[3] == 1.0 {
            texels.fill(self.color);
        } else {
            for texel in texels {
                *texel = over(*texel, &self.color, coverage);
            }
        }
    }

    #[inline(always)]
    fn four(&mut self, first: usize, coverage: &[f32; FOUR]) {
        let numbers = self.texels[first..first + FOUR].as_flattened_mut();
        for k in 0..4 * FOUR {
            let share = coverage[k / 4];
            numbers[k] = self.color[k % 4] * share + numbers[k] * (1.0 - self.color[3] * share);
        }
    }
}

#[inline(always)]
fn over(below: [f32; 4], color: &[f32; 4], share: f32) -> [f32; 4] {
    // None of an ink changes nothing, all of an opaque one leaves nothing below: no case needs a branch.
    let keep = 1.0 - color[3] * share;
    std::array::from_fn(|k| color[k] * share + below[k] * keep)
}

/// A texel with ink on it.
#[inline(always)]
fn blended(below: [f32; 4], ink: &Ink, share: f32, format: TexelFormat) -> [f32; 4] {
    let above = match ink.mode {
        BlendMode::Over => over(below, &ink.color, share),
        BlendMode::Additive => {
            std::array::from_fn(|k| crate::math::min_f32(below[k] + ink.color[k] * share, 1.0))
        }
    };
    rounded(above, format)
}

/// A texel as its format holds it.
#[inline(always)]
fn rounded(texel: [f32; 4], format: TexelFormat) -> [f32; 4] {
    match format {
        TexelFormat::F32 => texel,
        // A cast rounds towards zero.
        TexelFormat::Unorm8 => texel.map(|v| f32::from((v * 255.0 + 0.5) as u8) / 255.0),
    }
}
