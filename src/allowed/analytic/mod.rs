//! Analytic coverage (ours): the right colour of each pixel, off by what borders may stray.
//!
//! The truth's certified interval is the mean over the pixel of what is seen and held. A program takes nothing from a rasterizer, so nothing is snapped: single
//! precision moves each border on the screen by no more than a thousandth of a pixel, so that it paints no more of the pixel otherwise than strips along
//! the borders, times how much changes across them. Wherever that is more than all that the pixel's points may see and be held by, it is that. Pixels that a
//! program may find too crowded may also be what samples make of them. Buffers of pixels' centres are those of the device, whose vertices are snapped.

mod borders;
mod plane;
mod round;
mod strips;

use super::envelope::{COORDINATES, Envelope};
use super::model::{Guess, View};
use super::picture;
use super::pixel::{BLEND, Blending, ColorRange, PixelRange, widened};
use super::sampled::Pictures;
use super::stages::{Seen, stages};
use crate::buffer::Buffer;
use crate::certainty::{PaintMean, PaintRange};
use crate::footprint::{Footprints, PixelSize, Strokes};
use crate::math;
use crate::resolve::{Compositor, encoded_from_linear, linear_from_encoded};
use crate::scene::{BlendSpace, GroundColors};
use crate::technique::analytic::Settings;
use crate::truth::{Budget, Probe, Sample, certify, probe};
use borders::{Borders, Counter, Square};
use glam::DVec2;
use strips::{BEND, CHORD};

/// Sets of items have bits for so many.
const MOST_ITEMS: usize = 64;

/// Parts that a triangle may be seen in, between others before it.
const PARTS: f64 = 4.0;

/// Three squares a side, each as far as its middle may stray, cover a pixel.
const THIRD: f64 = 1.0 / 6.0;

/// What lies in a pixel, or by it.
#[derive(Debug, Clone)]
struct Look {
    /// Around all paints.
    paint: PaintRange,
    /// By each guess, how far each channel of the mean paint may be off.
    doubts: Vec<[f64; 4]>,
    /// Whether a program may find more parts or edges in it than the settings allow.
    may_be_sampled: bool,
    items: Vec<u32>,
    centre: Seen,
}

/// The pictures by guesses; the last one is the widest.
pub(super) fn pictures(settings: &Settings, view: &View, guesses: &[Guess]) -> Pictures {
    let (stage, frame) = (view.stage, view.frame);
    let compositor = Compositor::new(stage.scene.compositing);
    let progress = |share: f64| (view.progress)(0.5 * share);
    // What is not known of the right colour is allowed, too.
    let budget = Budget { width: 1.0 / 2040.0, ..Budget::default() };
    let truth = certify(stage, frame, &budget, &progress);
    let looks = looks(settings, view, guesses);
    let samples =
        looks.values().iter().any(|look| look.may_be_sampled).then(|| sampled(settings, view, guesses));
    let mut all = Pictures::default();
    for (number, guess) in guesses.iter().enumerate() {
        let range = |(pixel, look): (usize, &Look)| {
            let right = [truth.low.values()[pixel], truth.high.values()[pixel]];
            let color = strayed(
                right,
                (&look.paint, look.doubts[number]),
                &compositor,
                stage.scene.compositing.space,
            );
            let own =
                PixelRange { all: widened(color, BLEND), items: look.items.clone(), ..PixelRange::default() };
            let samples = samples.as_ref().filter(|_| look.may_be_sampled);
            let samples = samples.map(|of| of.values()[pixel][number].clone());
            PixelRange::any_of(
                Some(own).filter(|_| !samples_all(settings)).into_iter().chain(samples).collect(),
            )
        };
        let ranges = looks.values().iter().enumerate().map(range).collect();
        let ranges = Buffer::from_values(frame.width(), frame.height(), ranges);
        all.hypotheses.push(picture::hypothesis(guess.name.clone(), &ranges));
        all.features = picture::feature_runs(&ranges, &stage.draw_list);
    }
    let centres = looks.into_values().into_iter().map(|look| look.centre).collect();
    all.stages = stages(&Buffer::from_values(frame.width(), frame.height(), centres));
    all
}

/// Whether a program samples every pixel.
fn samples_all(settings: &Settings) -> bool {
    settings.fragments == 0 || settings.crowd == 0
}

/// The right colour, off by what borders may change of the mean paint, and no more than its paints allow.
fn strayed(
    right: ColorRange,
    (paint, doubt): (&PaintRange, [f64; 4]),
    compositor: &Compositor,
    space: BlendSpace,
) -> ColorRange {
    let mut mean = PaintMean::NOTHING;
    mean.add(paint, 1.0);
    let [least, most, _] = mean.colors(compositor, 1e-12);
    // Where opacities differ, a mean of colours is none of straight ones.
    let alpha = paint.low[3];
    if alpha < paint.high[3] || alpha == 0.0 {
        return [least, most];
    }
    let moved = |v: f64, by: f64| match space {
        BlendSpace::Encoded => v + by,
        BlendSpace::Linear => encoded_from_linear(math::max(linear_from_encoded(v) + by, 0.0)),
    };
    let mut range = right;
    for c in 0..3 {
        let by = doubt[c] / alpha;
        range[0][c] = math::max(moved(right[0][c], -by), least[c]);
        range[1][c] = math::min(moved(right[1][c], by), most[c]);
    }
    range
}

/// What lies in each pixel, for the widest of some guesses.
fn looks(settings: &Settings, view: &View, guesses: &[Guess]) -> Buffer<Look> {
    let (stage, frame) = (view.stage, view.frame);
    let mesh = &*stage.mesh_for(frame);
    // A border may stray into a square from so far beside it.
    let shift = guesses.iter().map(|guess| guess.envelope.shift()).fold(0.0, math::max) + CHORD + BEND;
    let of_device = Envelope::of(&stage.scene.device);
    let snapped = of_device.iter().map(Envelope::shift).fold(0.0, math::max);
    let along = |depth: f64| guesses.last().map_or(0.0, |guess| guess.envelope.along(frame, depth));
    let footprints = Footprints::new(&stage.draw_list, PixelSize::of(frame, mesh), &|_| true);
    let imagery = match &stage.scene.ground.colors {
        GroundColors::Imagery(imagery) => Some(imagery),
        GroundColors::Constant(_) => None,
    };
    let thirds = |k: usize| (0.5 + (k % 3) as f64) / 3.0;
    // The thirds of a pixel.
    let mut spots: Vec<[f64; 2]> = (0..9).map(|k| [thirds(k), thirds(k / 3)]).collect();
    // The middle one is the centre, too: its own place is wanted.
    spots.swap(4, 8);
    let of = Probe {
        list: &stage.draw_list,
        strokes: Strokes::Style,
        spots: &spots,
        shifts: &[THIRD + shift, snapped],
        depths_of_shifts: 0.0,
        along: &|_| 0.0,
        share: COORDINATES,
    };
    let counter = |guess: &Guess| {
        let shift = guess.envelope.shift();
        Counter { footprints: &footprints, imagery, mesh, frame, shift }
    };
    let counters: Vec<Counter> = guesses.iter().map(counter).collect();
    let judge = |at: [usize; 2], samples: &[Sample]| {
        let (pixel, centre) = samples.split_at(spots.len());
        let corner = DVec2::new(at[0] as f64, at[1] as f64);
        let items = items(pixel);
        let paint = pixel.iter().map(Sample::paint).reduce(|a, b| a.hull(&b)).unwrap_or(PaintRange::ANY);
        let squares = spots.iter().zip(pixel).map(|(spot, sample)| Square {
            corner: corner + DVec2::from_array(*spot) - DVec2::splat(THIRD),
            side: 2.0 * THIRD,
            sample,
        });
        let squares: Vec<Square> = squares.collect();
        let borders: Vec<Borders> =
            counters.iter().map(|counter| counter.borders(corner, &squares)).collect();
        let is_crowded = |of: &Borders| {
            PARTS * of.parts > f64::from(settings.fragments) || of.edges > f64::from(settings.crowd)
        };
        Look {
            paint,
            doubts: borders.iter().map(|of| of.doubt).collect(),
            may_be_sampled: samples_all(settings)
                || borders.iter().any(is_crowded)
                || items.len() > MOST_ITEMS,
            items,
            centre: centre.last().map(|sample| Seen::of(sample, &along)).unwrap_or_default(),
        }
    };
    probe(stage, frame, &of, &judge, &|share| (view.progress)(0.5 + 0.25 * share))
}

fn items(samples: &[Sample]) -> Vec<u32> {
    let outcomes = samples.iter().flat_map(|sample| &sample.outcomes);
    let mut items: Vec<u32> =
        outcomes.flat_map(|of| of.items.iter().flatten().map(|(item, _)| *item)).collect();
    items.sort_unstable();
    items.dedup();
    items
}

/// What pixels are by samples, by each guess.
fn sampled(settings: &Settings, view: &View, guesses: &[Guess]) -> Buffer<Vec<PixelRange>> {
    let stage = view.stage;
    let compositor = Compositor::new(stage.scene.compositing);
    let along = |depth: f64| guesses.last().map_or(0.0, |guess| guess.envelope.along(view.frame, depth));
    // What is round or grows is off as much for a sample.
    let shifts: Vec<f64> = guesses.iter().map(|guess| guess.envelope.shift() + CHORD + BEND).collect();
    let side = settings.samples as usize;
    let at = |k: usize| (0.5 + k as f64) / side as f64;
    let spots: Vec<[f64; 2]> = (0..side * side).map(|k| [at(k % side), at(k / side)]).collect();
    let of = Probe {
        list: &stage.draw_list,
        strokes: Strokes::Style,
        spots: &spots,
        shifts: &shifts,
        depths_of_shifts: 0.0,
        along: &along,
        share: COORDINATES,
    };
    let judge = |_: [usize; 2], samples: &[Sample]| {
        let of_guess = |samples: &[Sample]| {
            PixelRange::of_samples(samples, (&stage.draw_list, &compositor), Blending::Shader)
        };
        samples.chunks(spots.len()).map(of_guess).collect()
    };
    probe(stage, view.frame, &of, &judge, &|share| (view.progress)(0.75 + 0.25 * share))
}
