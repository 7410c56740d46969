//! Pictures that a page shows, each beside the heat map of its distance from the truth.

use crate::buffer::Buffer;
use crate::compare::{Difference, Expected, Image};
use crate::error::{Error, Result};
use crate::math;
use crate::output::small_png;

/// The distance above which a heat map is hot: one step of an 8-bit code.
const TOLERANCE: f64 = 1.0 / 255.0;

/// A picture and its heat map, as PNG files.
#[derive(Debug, Clone, PartialEq)]
pub struct Exhibit {
    /// What it shows.
    pub name: String,
    /// Why it is shown, and its error in words.
    pub caption: String,
    pub(super) picture: Vec<u8>,
    pub(super) heat_map: Vec<u8>,
}

impl Exhibit {
    /// A picture and its distance from what is expected.
    ///
    /// # Errors
    /// Internal errors only.
    pub fn new(
        (name, caption): (String, String),
        picture: &Buffer<[u8; 4]>,
        difference: &Difference,
    ) -> Result<Self> {
        Ok(Self { name, caption, picture: png(picture)?, heat_map: png(&difference.heat_map(TOLERANCE))? })
    }

    /// Bytes of both files.
    pub(super) fn bytes(&self) -> usize {
        self.picture.len() + self.heat_map.len()
    }
}

/// The colours of a heat map from 1/65535 (left) to 1 (right), in equal steps of the logarithm.
///
/// # Errors
/// Internal errors only.
pub(super) fn scale() -> Result<Vec<u8>> {
    const STEPS: usize = 480;
    let value = |k: usize| math::exp((k as f64 / (STEPS - 1) as f64 - 1.0) * math::ln(65535.0));
    let distances = Image::new(STEPS, 1, 1, (0..STEPS).map(value).collect())?;
    let zero = Expected::exactly(Image::new(STEPS, 1, 1, vec![0.0; STEPS])?);
    let difference = Difference::of(&zero, &distances);
    png(&difference
        .map_err(|what| Error::internal(format!("the scale: {what}")).caused_by(what))?
        .heat_map(TOLERANCE))
}

fn png(picture: &Buffer<[u8; 4]>) -> Result<Vec<u8>> {
    small_png(picture)
        .map_err(|error| Error::internal(format!("a picture of the report: {error}")).caused_by(error))
}
