//! Techniques that take samples: a pixel is the mean of what points of it see and are held by.

use super::envelope::COORDINATES;
use super::far_plane::FarPlane;
use super::model::{Guess, View};
use super::picture;
use super::pixel::{Blending, PixelRange};
use super::stages::{Seen, stages};
use crate::buffer::Buffer;
use crate::compare::{FeatureRun, Hypothesis, Stage};
use crate::footprint::Strokes;
use crate::resolve::Compositor;
use crate::space::Screen;
use crate::truth::{Probe, Sample, probe};
use std::borrow::Cow;

/// Where a technique takes samples, and what strokes it has.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sampling {
    /// Places in a pixel, from its upper left corner, 0..=1.
    pub(super) spots: Vec<[f64; 2]>,
    pub(super) strokes: Strokes,
    /// How many shifts' worth of depth a comparison of two surfaces may be off: see [`Probe::depths_of_shifts`].
    pub(super) depths_of_shifts: f64,
    pub(super) blending: Blending,
    /// So many samples along each axis of a pixel the technique's buffers have; 1: its centre's.
    pub(super) samples_of_buffers: usize,
}

/// What a pixel may be by each guess, and what the samples of its buffers may see by the last.
#[derive(Debug, Clone, Default)]
struct Judged {
    ranges: Vec<PixelRange>,
    seen: Vec<Seen>,
}

/// Of pictures with more samples in their buffers it is not told what these may be: they would take gigabytes.
const MOST_SAMPLES: usize = 1 << 22;

impl Sampling {
    /// The pictures by guesses, which are looked at together; the last one is the widest.
    pub(super) fn pictures(&self, view: &View, guesses: &[Guess]) -> Pictures {
        let stage = view.stage;
        let compositor = Compositor::new(stage.scene.compositing);
        let mut shifts: Vec<f64> = guesses.iter().map(|guess| guess.envelope.shift()).collect();
        shifts.dedup();
        let along = |depth: f64| guesses.last().map_or(0.0, |guess| guess.envelope.along(view.frame, depth));
        // The centre's own depth is wanted.
        let count = self.spots.len();
        let spots: Vec<[f64; 2]> = self.spots.iter().copied().chain([[0.5; 2]]).collect();
        let of = Probe {
            list: &stage.draw_list,
            strokes: self.strokes,
            spots: if self.spots == [[0.5; 2]] { &self.spots } else { &spots },
            shifts: &shifts,
            depths_of_shifts: self.depths_of_shifts,
            along: &along,
            share: COORDINATES,
        };
        let painting = guesses.iter().rfind(|guess| guess.paints_sky);
        let far = painting.map(|guess| FarPlane::new(view, self.strokes, guess));
        let (per_shift, n) = (of.spots.len(), self.samples_of_buffers);
        let has_stages = n == 1 || view.frame.width() * view.frame.height() * n * n <= MOST_SAMPLES;
        // By the widest shift; the centre is the last.
        let buffered = |samples: &'_ [Sample]| match n {
            1 => samples[samples.len() - 1..].to_vec(),
            _ if has_stages => samples[samples.len() - per_shift..][..count].to_vec(),
            _ => Vec::new(),
        };
        let judge = |pixel: [usize; 2], samples: &[Sample]| {
            let range = |guess: &Guess| {
                let shift = guess.envelope.shift();
                let first = shifts.iter().position(|of| *of == shift).unwrap_or(0) * of.spots.len();
                let blending = if guess.has_coarse_blends { Blending::CoarseTarget } else { self.blending };
                let mut samples = Cow::Borrowed(&samples[first..first + count]);
                if let Some(far) = far.as_ref().filter(|_| guess.paints_sky) {
                    for (sample, spot) in samples.to_mut().iter_mut().zip(&self.spots) {
                        let [x, y] = [0, 1].map(|k| pixel[k] as f64 + spot[k]);
                        far.paint(sample, Screen::new(x, y), shift);
                    }
                }
                PixelRange::of_samples(&samples, (&stage.draw_list, &compositor), blending)
            };
            Judged {
                ranges: guesses.iter().map(range).collect(),
                seen: buffered(samples).iter().map(|sample| Seen::of(sample, &along)).collect(),
            }
        };
        let judged: Buffer<Judged> = probe(stage, view.frame, &of, &judge, view.progress);
        let (width, height) = (judged.width(), judged.height());
        let (ranges, seen): (Vec<Vec<PixelRange>>, Vec<Vec<Seen>>) =
            judged.into_values().into_iter().map(|of| (of.ranges, of.seen)).unzip();
        let mut by_guess: Vec<Vec<PixelRange>> =
            guesses.iter().map(|_| Vec::with_capacity(ranges.len())).collect();
        for of_pixel in ranges {
            by_guess.iter_mut().zip(of_pixel).for_each(|(of_guess, range)| of_guess.push(range));
        }
        let pictures: Vec<Buffer<PixelRange>> =
            by_guess.into_iter().map(|ranges| Buffer::from_values(width, height, ranges)).collect();
        let hypotheses = guesses.iter().zip(&pictures);
        Pictures {
            hypotheses: hypotheses
                .map(|(guess, picture)| picture::hypothesis(guess.name.clone(), picture))
                .collect(),
            stages: if has_stages { stages(&by_sample(&seen, width, n)) } else { Vec::new() },
            features: pictures
                .last()
                .map(|picture| picture::feature_runs(picture, &stage.draw_list))
                .unwrap_or_default(),
        }
    }
}

/// What samples may see, n x n of each pixel in rows from the top, as one buffer of them.
fn by_sample(seen: &[Vec<Seen>], width: usize, n: usize) -> Buffer<Seen> {
    let height = seen.len() / width.max(1);
    let rows = (0..height * n).flat_map(|y| (0..width * n).map(move |x| (x, y)));
    let of = |(x, y): (usize, usize)| seen[y / n * width + x / n][y % n * n + x % n].clone();
    Buffer::from_values(width * n, height * n, rows.map(of).collect())
}

/// What pictures may be by several guesses.
#[derive(Debug, Default)]
pub(super) struct Pictures {
    pub(super) hypotheses: Vec<Hypothesis>,
    pub(super) stages: Vec<Stage>,
    pub(super) features: Vec<FeatureRun>,
}
