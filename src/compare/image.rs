//! Pictures as numbers.

use crate::buffer::{Buffer, Plane, Values};
use crate::error::{Error, Result};

/// A picture of any number of channels, its values in units of 1: code values of 8 bits are 255ths, of 16 bits 65535ths.
///
/// # Guarantees
/// There is at least one pixel and one channel, and the values fill it. They may be infinite, or not a number.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    width: usize,
    height: usize,
    channels: usize,
    values: Vec<f64>,
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
        let wanted = width.checked_mul(height).and_then(|pixels| pixels.checked_mul(channels));
        if wanted == Some(0) {
            return Err(Error::usage("there is nothing to compare: the picture has no pixel or no channel"));
        }
        if wanted != Some(values.len()) {
            return Err(Error::usage(format!(
                "a picture of {width} x {height} pixels of {channels} channels cannot have {} values",
                values.len()
            )));
        }
        Ok(Self { width, height, channels, values })
    }

    /// A picture that is known to be filled.
    pub(super) fn filled(width: usize, height: usize, channels: usize, values: Vec<f64>) -> Self {
        debug_assert_eq!(values.len(), width * height * channels, "values fill a picture");
        Self { width, height, channels, values }
    }

    /// A picture of 8-bit code values.
    ///
    /// # Errors
    /// When it has no pixel.
    pub fn from_rgba8(picture: &Buffer<[u8; 4]>) -> Result<Self> {
        let codes = picture.values().as_flattened();
        let values = codes.iter().map(|code| f64::from(*code) / 255.0).collect();
        Self::new(picture.width(), picture.height(), 4, values)
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
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    pub(super) fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// The same, with 0 in some pixels: what is not looked at need be no number.
    ///
    /// # Panics
    /// When it is not told of each pixel.
    #[must_use]
    pub fn without(mut self, ignored: &[bool]) -> Self {
        self.fill_pixels(ignored, 0.0);
        self
    }

    /// Gives some pixels a value in every channel.
    pub(super) fn fill_pixels(&mut self, which: &[bool], value: f64) {
        assert_eq!(which.len(), self.width * self.height, "pixels and what is told of them");
        let pixels = self.values.chunks_exact_mut(self.channels).zip(which);
        pixels.filter(|(_, is_meant)| **is_meant).for_each(|(pixel, _)| pixel.fill(value));
    }

    /// Of each pixel of a mask, whether it is marked: whether it has a colour other than black, and is not transparent.
    pub fn marked(&self) -> Vec<bool> {
        let is_marked = |pixel: &[f64]| {
            let colors = pixel.len() - usize::from([2, 4].contains(&pixel.len()));
            pixel[..colors].iter().any(|value| *value != 0.0)
                && pixel[colors..].iter().all(|alpha| *alpha != 0.0)
        };
        self.values.chunks_exact(self.channels).map(is_marked).collect()
    }

    /// Where the value of this index is.
    pub(super) fn place(&self, index: usize) -> ValuePlace {
        let pixel = index / self.channels;
        ValuePlace { x: pixel % self.width, y: pixel / self.width, channel: index % self.channels }
    }

    /// The place of the first value that is not a number.
    pub(super) fn first_nan(&self) -> Option<ValuePlace> {
        self.values.iter().position(|v| v.is_nan()).map(|index| self.place(index))
    }

    /// The value of each pixel's channel; a channel 3 that a colour does not have is its alpha, 1.
    pub(super) fn at(&self, pixel: usize, channel: usize) -> f64 {
        if channel < self.channels { self.values[pixel * self.channels + channel] } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn code_values_are_255ths() {
        let picture = Buffer::from_values(2, 1, vec![[0, 51, 102, 255], [255, 0, 204, 153]]);
        let image = Image::from_rgba8(&picture).unwrap();
        assert_eq!((image.width(), image.height(), image.channels()), (2, 1, 4));
        assert_eq!(image.values(), [0.0, 0.2, 0.4, 1.0, 1.0, 0.0, 0.8, 0.6]);
    }

    #[test]
    fn a_buffers_numbers_of_every_kind_stay_as_they_are() {
        let of = |values: Values| {
            let plane = Plane { name: "p", width: 1, height: 2, components: 1, values };
            Image::from_plane(&plane).unwrap().values().to_vec()
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
