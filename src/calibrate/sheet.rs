//! A client's picture, looked at pixel by pixel.

use crate::compare::Image;
use crate::error::{Error, Result};
use std::path::{Path, PathBuf};

/// A picture of the size that was asked for, with red, green and blue.
#[derive(Debug)]
pub(super) struct Sheet {
    image: Image,
    path: PathBuf,
}

impl Sheet {
    /// Reads a picture.
    ///
    /// # Errors
    /// When it cannot be read, or has another size or no colours.
    pub(super) fn read(path: &Path, side: usize) -> Result<Self> {
        let image = Image::read(path)?;
        let sheet = Self { image, path: path.to_owned() };
        let (width, height) = (sheet.image.width(), sheet.image.height());
        if (width, height) != (side, side) {
            return Err(
                sheet.refused(&format!("the picture is {width} x {height} pixels, not {side} x {side}"))
            );
        }
        if sheet.image.channels() < 3 {
            return Err(sheet.refused("the picture has no colours"));
        }
        Ok(sheet)
    }

    /// A pixel's red, green and blue.
    pub(super) fn at(&self, [x, y]: [usize; 2]) -> [f64; 3] {
        let first = (y * self.image.width() + x) * self.image.channels();
        std::array::from_fn(|k| self.image.value(first + k))
    }

    /// Whether a pixel of a picture in black and white is white.
    ///
    /// # Errors
    /// When it is neither.
    pub(super) fn is_white(&self, at: [usize; 2]) -> Result<bool> {
        let [red, ..] = self.at(at);
        if (0.25..=0.75).contains(&red) || red.is_nan() {
            let [x, y] = at;
            return Err(self.contradiction(&format!(
                "pixel {x},{y} is neither black nor white, so several samples or blending are on"
            )));
        }
        Ok(red > 0.75)
    }

    /// A picture that does not fit together.
    pub(super) fn contradiction(&self, what: &str) -> Error {
        Error::usage(format!("the picture contradicts itself: {what}"))
            .in_file(&self.path)
            .help("draw it as the instructions say (README.md of `drapery calibrate export`)")
    }

    fn refused(&self, what: &str) -> Error {
        Error::usage(what)
            .in_file(&self.path)
            .help("draw it as the instructions say (README.md of `drapery calibrate export`)")
    }
}
