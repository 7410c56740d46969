//! The truth of a stage, timed, and distances from it.

use super::expected::expected;
use super::{Times, Watch, timed};
use crate::buffer::Buffer;
use crate::compare::{Difference, Expected, Image, Metrics};
use crate::error::{Error, Result};
use crate::output::ByName;
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::truth::{self, Budget, Truth};
use serde_json::Value;

/// The truth of a stage, and what it took.
#[derive(Debug)]
pub struct Certified {
    /// The truth.
    pub truth: Truth,
    /// How exact it was to be.
    pub budget: Budget,
    /// How long it took.
    pub times: Times,
    expected: Expected,
}

impl Certified {
    /// Computes the truth `repeat` times (at least once).
    ///
    /// # Errors
    /// An internal error where two of them differ.
    pub fn of(
        (stage, view): (&Stage, &ViewFrame),
        budget: &Budget,
        repeat: u32,
        watch: &dyn Watch,
    ) -> Result<Self> {
        watch.start(truth::NAME);
        let once = || timed(watch, || Ok(truth::certify(stage, view, budget, &|share| watch.done(share))));
        let (mut truth, first) = once()?;
        let mut times = vec![first];
        for _ in 1..repeat {
            let (again, ms) = once()?;
            if again.low != truth.low || again.high != truth.high {
                return Err(Error::internal("two truths of the same scene differ"));
            }
            (truth, _) = (again, times.push(ms));
        }
        let expected = expected(&truth)?;
        Ok(Self { truth, budget: *budget, times: Times::of(times), expected })
    }

    /// How far the values of a picture are from the truth.
    ///
    /// # Errors
    /// When there is no distance: another size, other channels, a value that is not a number.
    pub fn difference(&self, image: &Image) -> Result<Difference> {
        let difference = Difference::of(&self.expected, image);
        difference.map_err(|what| Error::internal(format!("against the truth: {what}")).caused_by(what))
    }

    /// How far a picture is from the truth.
    ///
    /// # Errors
    /// As [`Certified::difference`].
    pub fn metrics(&self, image: &Buffer<[u8; 4]>) -> Result<Metrics> {
        Ok(self.difference(&Image::from_rgba8(image)?)?.metrics(0.0))
    }

    /// The budget by the names of `--truth-width` and `--truth-depth`.
    pub fn parameters(&self) -> ByName {
        let Budget { width, depth, .. } = self.budget;
        ByName::from_pairs([("width", Value::from(width)), ("depth", Value::from(depth))])
    }

    /// What was done.
    pub fn counts(&self) -> ByName {
        let tally = &self.truth.tally;
        ByName::from_pairs([
            ("triangles", tally.triangles),
            ("fragments", tally.fragments),
            ("pieces", tally.pieces),
            ("wide_pixels", tally.wide_pixels),
        ])
    }
}
