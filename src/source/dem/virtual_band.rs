//! What a virtual raster makes of its files' samples: the kind of number it stores, and what they all must count in.

use super::nodata::Nodata;
use super::vertical::VerticalUnit;
use crate::error::{Error, Result};
use std::path::PathBuf;

/// How a mosaic stores what it takes of its files.
#[derive(Debug, Clone, Copy)]
pub(super) struct Storage {
    pub(super) nodata: Nodata,
    pub(super) number: Number,
}

/// A kind of number that heights are stored as.
#[derive(Debug, Clone, Copy)]
pub(super) enum Number {
    /// Whole numbers from the first to the last.
    Whole(f64, f64),
    Single,
    Double,
}

impl Storage {
    /// What a height is once it is stored: rounded and cut to what the kind of number holds; NaN where it means no data.
    pub(super) fn stored(self, height: f64) -> f64 {
        let stored = match self.number {
            // NaN stays what it is.
            Number::Whole(low, high) => height.round().clamp(low, high),
            Number::Single => f64::from(height as f32),
            Number::Double => height,
        };
        self.nodata.height(stored)
    }
}

/// What the samples of all files of a mosaic must count in, as it is the first one's that its header states.
#[derive(Debug, Clone)]
pub(super) struct Agreement {
    /// The file that all others must agree with.
    pub(super) first: PathBuf,
    /// Its unit; `None`: the mosaic itself states one.
    pub(super) unit: Option<Option<VerticalUnit>>,
    /// Its factor and offset; `None`: the mosaic itself states them.
    pub(super) scaling: Option<(f64, f64)>,
}

impl Agreement {
    /// Refuses a file whose samples count in something else, by its unit, and its factor and offset.
    pub(super) fn check(&self, own_unit: Option<&VerticalUnit>, own: (f64, f64)) -> Result<()> {
        let refuse = |what: &str, own: String, first: String| {
            Err(Error::new(format!("{what} is {own}, that of {} is {first}", self.first.display())).help(
                "name the files themselves, each is then converted by its own: source = [\"A.tif\", \"B.tif\"]",
            ))
        };
        let words = |unit: Option<&VerticalUnit>| unit.map_or("the metre", VerticalUnit::words).to_owned();
        if let Some(unit) = self.unit.as_ref().map(Option::as_ref)
            && !VerticalUnit::agree(unit, own_unit)
        {
            return refuse("the unit of its heights", words(own_unit), words(unit));
        }
        match self.scaling {
            Some(first) if first != own => {
                let words = |(factor, offset): (f64, f64)| format!("x {factor} + {offset}");
                refuse("the scale of its samples", words(own), words(first))
            }
            _ => Ok(()),
        }
    }
}
