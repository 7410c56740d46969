//! Pictures as numbers.

use crate::buffer::{Buffer, Plane, Values};
use crate::error::{Error, Result};
use std::borrow::Cow;

/// A picture of any number of channels, its values in units of 1: code values of 8 bits are 255ths, of 16 bits 65535ths.
///
/// # Guarantees
/// There is at least one pixel and one channel, and the values fill it. They may be infinite, or not a number.
#[derive(Debug, Clone)]
pub struct Image {
    width: usize,
    height: usize,
    channels: usize,
    samples: Samples,
}

/// The values of a picture: rows from the top, then columns, then channels. Codes stay what they are in their file, an eighth or a quarter
/// of the memory of doubles.
#[derive(Debug, Clone)]
pub(super) enum Samples {
    /// 255ths.
    Codes8(Vec<u8>),
    /// 65535ths.
    Codes16(Vec<u16>),
    /// In units of 1.
    Reals(Vec<f64>),
}

impl Samples {
    /// How many values there are.
    fn len(&self) -> usize {
        match self {
            Self::Codes8(codes) => codes.len(),
            Self::Codes16(codes) => codes.len(),
            Self::Reals(values) => values.len(),
        }
    }
}

/// A value's place in a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub struct ValuePlace {
    /// The pixel's column, from 0.
    pub x: usize,
    /// The pixel's row, from 0 at the top.
    pub y: usize,
    /// The channel, from 0.
    pub channel: usize,
}

impl Image {
    /// A picture of these values: rows from the top, then columns, then channels.
    ///
    /// # Errors
    /// When there is no pixel or no channel, or the values do not fill it.
    pub fn new(width: usize, height: usize, channels: usize, values: Vec<f64>) -> Result<Self> {
        Self::of(width, height, channels, Samples::Reals(values))
    }

    /// The same of values of any kind.
    pub(super) fn of(width: usize, height: usize, channels: usize, samples: Samples) -> Result<Self> {
        let wanted = width.checked_mul(height).and_then(|pixels| pixels.checked_mul(channels));
        if wanted == Some(0) {
            return Err(Error::usage("there is nothing to compare: the picture has no pixel or no channel"));
        }
        if wanted != Some(samples.len()) {
            return Err(Error::usage(format!(
                "a picture of {width} x {height} pixels of {channels} channels cannot have {} values",
                samples.len()
            )));
        }
        Ok(Self { width, height, channels, samples })
    }

    /// A picture that is known to be filled.
    pub(super) fn filled(width: usize, height: usize, channels: usize, samples: Samples) -> Self {
        debug_assert_eq!(samples.len(), width * height * channels, "values fill a picture");
        Self { width, height, channels, samples }
    }

    /// A picture of 8-bit code values.
    ///
    /// # Errors
    /// When it has no pixel.
    pub fn from_rgba8(picture: &Buffer<[u8; 4]>) -> Result<Self> {
        let codes = picture.values().as_flattened().to_vec();
        Self::of(picture.width(), picture.height(), 4, Samples::Codes8(codes))
    }

    /// A buffer's numbers as they are.
    ///
    /// # Errors
    /// When it has no pixel, or its values do not fill it.
    pub fn from_plane(plane: &Plane) -> Result<Self> {
        let values = match &plane.values {
            Values::F64(values) => values.clone(),
            Values::F32(values) => values.iter().map(|v| f64::from(*v)).collect(),
            Values::U32(values) => values.iter().map(|v| f64::from(*v)).collect(),
            Values::U16(values) => values.iter().map(|v| f64::from(*v)).collect(),
            Values::U8(values) => values.iter().map(|v| f64::from(*v)).collect(),
        };
        Self::new(plane.width, plane.height, plane.components, values)
    }

    /// Pixels a row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Values a pixel.
    pub fn channels(&self) -> usize {
        self.channels
    }

    /// All values: rows from the top, then columns, then channels.
    pub fn values(&self) -> impl ExactSizeIterator<Item = f64> {
        (0..self.samples.len()).map(|index| self.value(index))
    }

    /// The value of this index.
    ///
    /// # Panics
    /// When there are not so many.
    pub fn value(&self, index: usize) -> f64 {
        match &self.samples {
            Samples::Codes8(codes) => f64::from(codes[index]) / 255.0,
            Samples::Codes16(codes) => f64::from(codes[index]) / 65535.0,
            Samples::Reals(values) => values[index],
        }
    }

    /// All values, as they are held.
    pub(super) fn samples(&self) -> &Samples {
        &self.samples
    }

    /// All values in units of 1; a colour without alpha has the alpha 1 where four channels are asked for.
    pub(super) fn reals(&self, channels: usize) -> Cow<'_, [f64]> {
        let values = match &self.samples {
            Samples::Reals(values) => Cow::Borrowed(&values[..]),
            _ => Cow::Owned(self.values().collect()),
        };
        with_alpha(values, (self.channels, channels), 1.0)
    }

    /// The same in codes of 8 bits; `None` where there are others.
    pub(super) fn codes8(&self, channels: usize) -> Option<Cow<'_, [u8]>> {
        match &self.samples {
            Samples::Codes8(codes) => {
                Some(with_alpha(Cow::Borrowed(codes), (self.channels, channels), u8::MAX))
            }
            _ => None,
        }
    }

    /// The same in codes of 16 bits: one of 8 bits is 257 of them. `None` where there are no codes.
    pub(super) fn codes16(&self, channels: usize) -> Option<Cow<'_, [u16]>> {
        let codes = match &self.samples {
            Samples::Codes8(codes) => Cow::Owned(codes.iter().map(|code| 257 * u16::from(*code)).collect()),
            Samples::Codes16(codes) => Cow::Borrowed(&codes[..]),
            Samples::Reals(_) => return None,
        };
        Some(with_alpha(codes, (self.channels, channels), u16::MAX))
    }

    /// The same picture with other values, of each the one that this makes of it.
    pub(super) fn map(&self, value: impl FnMut(f64) -> f64) -> Self {
        Self { samples: Samples::Reals(self.values().map(value).collect()), ..*self }
    }

    /// The same, with 0 in some pixels: what is not looked at need be no number.
    ///
    /// # Panics
    /// When it is not told of each pixel.
    #[must_use]
    pub fn without(mut self, ignored: &[bool]) -> Self {
        match &mut self.samples {
            Samples::Codes8(codes) => fill(codes, ignored, 0),
            Samples::Codes16(codes) => fill(codes, ignored, 0),
            Samples::Reals(values) => fill(values, ignored, 0.0),
        }
        self
    }

    /// The same, with a value in every channel of some pixels.
    pub(super) fn with(&self, value: f64, which: &[bool]) -> Self {
        let mut values = self.reals(self.channels).into_owned();
        fill(&mut values, which, value);
        Self { samples: Samples::Reals(values), ..*self }
    }

    /// Of each pixel of a mask, whether it is marked: whether it has a colour other than black, and is not transparent.
    pub fn marked(&self) -> Vec<bool> {
        let channels = self.channels;
        let colors = channels - usize::from([2, 4].contains(&channels));
        let is_marked = |pixel: usize| {
            let has = |channel: usize| self.value(pixel * channels + channel) != 0.0;
            (0..colors).any(has) && (colors..channels).all(has)
        };
        (0..self.width * self.height).map(is_marked).collect()
    }

    /// Where the value of this index is.
    pub(super) fn place(&self, index: usize) -> ValuePlace {
        let pixel = index / self.channels;
        ValuePlace { x: pixel % self.width, y: pixel / self.width, channel: index % self.channels }
    }

    /// The place of the first value that is not a number.
    pub(super) fn first_nan(&self) -> Option<ValuePlace> {
        let Samples::Reals(values) = &self.samples else { return None };
        values.iter().position(|v| v.is_nan()).map(|index| self.place(index))
    }
}

/// Pictures are equal by their values, in whatever way they are held.
impl PartialEq for Image {
    fn eq(&self, other: &Self) -> bool {
        let shape = |image: &Self| [image.width, image.height, image.channels];
        shape(self) == shape(other)
            && match (&self.samples, &other.samples) {
                (Samples::Codes8(a), Samples::Codes8(b)) => a == b,
                (Samples::Codes16(a), Samples::Codes16(b)) => a == b,
                _ => self.values().eq(other.values()),
            }
    }
}

/// Gives some pixels a value in every channel.
fn fill<T: Copy>(values: &mut [T], which: &[bool], value: T) {
    let channels = values.len() / which.len().max(1);
    assert_eq!(values.len(), which.len() * channels, "pixels and what is told of them");
    let pixels = values.chunks_exact_mut(channels).zip(which);
    pixels.filter(|(_, is_meant)| **is_meant).for_each(|(pixel, _)| pixel.fill(value));
}

/// Values of so many channels with as many as are wanted: a fourth behind three is an alpha.
fn with_alpha<T: Copy>(values: Cow<'_, [T]>, (channels, wanted): (usize, usize), opaque: T) -> Cow<'_, [T]> {
    if (channels, wanted) != (3, 4) {
        return values;
    }
    values.as_chunks().0.iter().flat_map(|[r, g, b]| [*r, *g, *b, opaque]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn code_values_are_255ths() {
        let picture = Buffer::from_values(2, 1, vec![[0, 51, 102, 255], [255, 0, 204, 153]]);
        let image = Image::from_rgba8(&picture).unwrap();
        assert_eq!((image.width(), image.height(), image.channels()), (2, 1, 4));
        assert_eq!(*image.reals(4), [0.0, 0.2, 0.4, 1.0, 1.0, 0.0, 0.8, 0.6]);
    }

    #[test]
    fn a_buffers_numbers_of_every_kind_stay_as_they_are() {
        let of = |values: Values| {
            let plane = Plane { name: "p", width: 1, height: 2, components: 1, values };
            Image::from_plane(&plane).unwrap().values().collect::<Vec<_>>()
        };
        assert_eq!(of(Values::F64(vec![0.1, -2.0])), [0.1, -2.0]);
        assert_eq!(of(Values::F32(vec![0.5, f32::INFINITY])), [0.5, f64::INFINITY]);
        assert_eq!(of(Values::U32(vec![7, u32::MAX])), [7.0, 4_294_967_295.0]);
        assert_eq!(of(Values::U16(vec![7, 65535])), [7.0, 65535.0]);
        assert_eq!(of(Values::U8(vec![7, 255])), [7.0, 255.0]);
    }

    #[test]
    fn a_mask_marks_what_is_neither_black_nor_transparent() {
        let marked = |channels: usize, values: &[f64]| {
            Image::new(values.len() / channels, 1, channels, values.to_vec()).unwrap().marked()
        };
        assert_eq!(marked(1, &[0.0, 0.1]), [false, true]);
        assert_eq!(marked(2, &[0.0, 1.0, 0.1, 1.0, 1.0, 0.0]), [false, true, false]);
        assert_eq!(marked(3, &[0.0, 0.0, 0.0, 0.0, 0.0, 0.1]), [false, true]);
        assert_eq!(
            marked(4, &[0.0, 0.0, 0.0, 1.0, 0.0, 0.1, 0.0, 0.5, 1.0, 1.0, 1.0, 0.0]),
            [false, true, false]
        );
    }

    #[test]
    fn values_that_do_not_fill_a_picture_are_refused() {
        let refused = |w, h, c, n| Image::new(w, h, c, vec![0.0; n]).unwrap_err().what().to_owned();
        assert_eq!(refused(2, 3, 4, 23), "a picture of 2 x 3 pixels of 4 channels cannot have 23 values");
        for (width, height, channels) in [(0, 3, 4), (2, 0, 4), (2, 3, 0)] {
            assert!(refused(width, height, channels, 0).starts_with("there is nothing to compare"));
        }
        assert!(refused(usize::MAX, 2, 2, 4).contains("cannot have 4 values"));
    }
}
