//! What all techniques' models are asked.

use super::envelope::Envelope;
use crate::compare::{FeatureRun, Hypothesis, Stage as Buffers};
use crate::space::ViewFrame;
use crate::stage::Stage;

/// A view of a stage.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) stage: &'a Stage,
    pub(super) frame: &'a ViewFrame,
    /// Is told the share that is done (0..=1), from any thread.
    pub(super) progress: &'a (dyn Fn(f64) + Sync),
}

/// A picture by one guess, the buffers behind it, and which features have a say where.
pub(super) type Judged = (Hypothesis, Vec<Buffers>, Vec<FeatureRun>);

/// A set of choices that a machine makes the same way everywhere.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Guess {
    /// Its name in files and reports.
    pub(super) name: String,
    pub(super) envelope: Envelope,
    /// Whether a target of code values rounds what it blends before it does.
    pub(super) has_coarse_blends: bool,
    /// Whether volumes that cross the far plane are painted on the sky.
    pub(super) paints_sky: bool,
}

impl Guess {
    /// By an envelope alone.
    pub(super) fn of(envelope: Envelope) -> Self {
        let name = match envelope.subpixel_bits {
            0 => "single-precision".to_owned(),
            bits => format!("{bits}-bit-vertices"),
        };
        Self { name, envelope, has_coarse_blends: false, paints_sky: false }
    }

    /// The same on a machine that blends code values, not numbers.
    pub(super) fn with_coarse_blends(self) -> Self {
        Self { name: format!("{}-coarse-blends", self.name), has_coarse_blends: true, ..self }
    }

    /// The same on a machine to which faces beyond the far plane are as far as the sky.
    pub(super) fn with_painted_sky(self) -> Self {
        Self { name: format!("{}-painted-sky", self.name), paints_sky: true, ..self }
    }

    /// What it assumes, in a sentence.
    pub(super) fn says(&self) -> String {
        let vertices = match self.envelope.subpixel_bits {
            0 => "nothing is snapped, and arithmetic is in single precision".to_owned(),
            bits => format!("vertices are snapped to {bits} bits behind a pixel's point, or less"),
        };
        let blends = match self.has_coarse_blends {
            true => {
                ", and blends are of code values: colours and opacities are rounded before they are multiplied, and after"
            }
            false => "",
        };
        let sky = match self.paints_sky {
            true => {
                ", and volumes that cross the far plane are painted on the sky: their depths are clamped there"
            }
            false => "",
        };
        format!("{vertices}{blends}{sky}")
    }
}
