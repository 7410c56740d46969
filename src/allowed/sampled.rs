//! Techniques that take samples: a pixel is the mean of what points of it see and are held by.

use super::envelope::COORDINATES;
use super::model::{Guess, View};
use super::picture;
use super::pixel::{Blending, PixelRange};
use super::stages::{Seen, stages};
use crate::buffer::Buffer;
use crate::compare::{FeatureRun, Hypothesis, Stage};
use crate::footprint::Strokes;
use crate::resolve::Compositor;
use crate::truth::{Probe, probe};

/// Where a technique takes samples, and what strokes it has.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sampling {
    /// Places in a pixel, from its upper left corner, 0..=1.
    pub(super) spots: Vec<[f64; 2]>,
    pub(super) strokes: Strokes,
    /// How many shifts' worth of depth a comparison of two surfaces may be off: see [`Probe::depths_of_shifts`].
    pub(super) depths_of_shifts: f64,
    pub(super) blending: Blending,
}

/// What a pixel may be, and what its centre may see.
#[derive(Debug, Clone, Default)]
struct Judged {
    range: PixelRange,
    centre: Seen,
}

impl Sampling {
    /// The picture by one guess.
    pub(super) fn picture(&self, view: &View, guess: &Guess) -> (Hypothesis, Vec<Stage>, Vec<FeatureRun>) {
        let stage = view.stage;
        let compositor = Compositor::new(stage.scene.compositing);
        let along = |depth: f64| guess.envelope.along(view.frame, depth);
        let centre = [0.5; 2];
        let mut spots = self.spots.clone();
        if !spots.contains(&centre) {
            spots.push(centre);
        }
        let at_centre = spots.iter().position(|spot| *spot == centre).unwrap_or(0);
        let count = self.spots.len();
        let of = Probe {
            list: &stage.draw_list,
            strokes: self.strokes,
            spots: &spots,
            shift: guess.envelope.shift(),
            depths_of_shifts: self.depths_of_shifts,
            along: &along,
            share: COORDINATES,
        };
        let judged: Buffer<Judged> = probe(
            stage,
            view.frame,
            &of,
            &|_, samples| Judged {
                range: PixelRange::of_samples(&samples[..count], &compositor, self.blending),
                centre: Seen::of(&samples[at_centre], &along),
            },
            view.progress,
        );
        let (width, height) = (judged.width(), judged.height());
        let (ranges, centres) = judged.values().iter().cloned().map(|of| (of.range, of.centre)).unzip();
        let ranges: Buffer<PixelRange> = Buffer::from_values(width, height, ranges);
        let centres: Buffer<Seen> = Buffer::from_values(width, height, centres);
        (
            picture::hypothesis(guess.name.clone(), &ranges),
            stages(&centres),
            picture::feature_runs(&ranges, &stage.draw_list),
        )
    }
}
