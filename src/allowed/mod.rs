//! What a technique's picture may be, of whatever right program draws it: for each pixel the colours that machines within a declared envelope
//! may come to.
//!
//! Input: a stage, a view, a technique at the scene's settings. Output: an [`Allowed`], which bundles carry and [`crate::compare`] judges by. No
//! technique's own code decides: what may be seen and held within a sample's square is found with the truth's certified pieces
//! ([`crate::truth::probe`]) over the technique's footprints. Refuses: techniques without a model.

mod clipmap;
mod composition;
mod dynamic_line;
mod envelope;
mod geometry_overlay;
mod inverse_projection;
mod model;
mod picture;
mod pixel;
mod sampled;
mod stages;
mod static_decal;
mod stencil_volume;
mod surface;

pub use envelope::Envelope;

use crate::compare::{Allowed, FeatureRun, Hypothesis, Stage as StageOfPicture};
use crate::error::Result;
use crate::scene::Device;
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::technique::{self, Kind};
use envelope::DEPTH_STEPS;
use model::{Guess, View};
use sampled::Pictures;

/// What a technique's picture of a view may be. `progress` is told the share that is done (0..=1), from any thread.
///
/// # Errors
/// When the technique does not draw such a scene, or nobody knows what its picture may be.
pub fn allowed(
    kind: Kind,
    (stage, frame): (&Stage, &ViewFrame),
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Allowed> {
    technique::applies(kind, stage)?;
    let guesses = guesses(kind, &stage.scene.device);
    let view = View { stage, frame, progress };
    let settings = &stage.scene.technique;
    let Pictures { mut hypotheses, stages, features } = match kind {
        Kind::StencilVolume => stencil_volume::sampling(&settings.get())?.pictures(&view, &guesses),
        Kind::StaticDecal => {
            static_decal::sampling(&settings.get(), &stage.draw_list)?.pictures(&view, &guesses)
        }
        Kind::InverseProjection => by_guess(&view, &guesses, |view, guess| {
            Ok((inverse_projection::picture(&settings.get(), view, guess), None))
        })?,
        Kind::Clipmap => by_guess(&view, &guesses, |view, guess| Ok((clipmap::picture(view, guess)?, None)))?,
        Kind::DynamicLine => by_guess(&view, &guesses, dynamic_line::picture)?,
        Kind::GeometryOverlay => {
            by_guess(&view, &guesses, |view, guess| Ok((geometry_overlay::picture(view, guess)?, None)))?
        }
    };
    hypotheses.iter_mut().zip(&guesses).for_each(|(hypothesis, guess)| hypothesis.says = guess.says());
    Ok(Allowed { width: frame.width(), height: frame.height(), hypotheses, stages, features })
}

/// What machines may choose once for a whole picture, from what is likely to what is coarse.
fn guesses(kind: Kind, device: &Device) -> Vec<Guess> {
    let has_blends = matches!(kind, Kind::StencilVolume | Kind::GeometryOverlay);
    let of_envelope = |envelope| {
        let guess = Guess::of(envelope);
        let coarse = has_blends.then(|| guess.clone().with_coarse_blends());
        std::iter::once(guess).chain(coarse)
    };
    Envelope::of(device).into_iter().flat_map(of_envelope).collect()
}

/// A picture by a guess, and another that is looked at with it.
type Drawn = ((Hypothesis, Vec<StageOfPicture>, Vec<FeatureRun>), Option<Hypothesis>);

/// The pictures by guesses one after the other; the last guess is the widest.
fn by_guess(
    view: &View,
    guesses: &[Guess],
    draw: impl Fn(&View, &Guess) -> Result<Drawn>,
) -> Result<Pictures> {
    let mut all = Pictures::default();
    let mut others = Vec::new();
    for (k, guess) in guesses.iter().enumerate() {
        let progress = |share: f64| (view.progress)((k as f64 + share) / guesses.len() as f64);
        let ((hypothesis, stages, features), other) = draw(&View { progress: &progress, ..*view }, guess)?;
        all.hypotheses.push(hypothesis);
        others.extend(other);
        (all.stages, all.features) = (stages, features);
    }
    all.hypotheses.append(&mut others);
    Ok(all)
}

/// What is allowed for a device, by name: numbers of the widest envelope.
pub fn envelope(device: &Device) -> Vec<(&'static str, f64)> {
    let widest = Envelope::of(device).into_iter().last();
    let of = |envelope: Envelope| {
        vec![
            ("shift_px", envelope.shift()),
            ("subpixel_bits", f64::from(envelope.subpixel_bits)),
            ("depth_steps", DEPTH_STEPS),
            ("filter_bits", f64::from(envelope.filter_bits)),
        ]
    };
    widest.map_or_else(Vec::new, of)
}
