//! Which model is asked of a technique's pictures, by which guesses.

use super::envelope::Envelope;
use super::model::{Guess, View};
use super::sampled::Pictures;
use super::{
    analytic, clipmap, dynamic_line, geometry_overlay, inverse_projection, static_decal, stencil_volume,
};
use crate::compare::{FeatureRun, Hypothesis, Stage};
use crate::error::Result;
use crate::scene::Device;
use crate::space::ViewFrame;
use crate::technique::Kind;

/// The pictures of a technique by guesses, and the buffers behind them by the last.
///
/// # Errors
/// When nobody knows what its picture may be.
pub(super) fn pictures(kind: Kind, view: &View, guesses: &[Guess]) -> Result<Pictures> {
    let (settings, list) = (&view.stage.scene.technique, &view.stage.draw_list);
    let mut all = match kind {
        Kind::StencilVolume => stencil_volume::sampling(&settings.get())?.pictures(view, guesses),
        Kind::StaticDecal => static_decal::sampling(&settings.get(), list)?.pictures(view, guesses),
        Kind::InverseProjection => by_guess(view, guesses, |view, guess| {
            Ok((inverse_projection::picture(&settings.get(), view, guess), None))
        })?,
        Kind::Clipmap => by_guess(view, guesses, |view, guess| Ok((clipmap::picture(view, guess)?, None)))?,
        Kind::DynamicLine => by_guess(view, guesses, dynamic_line::picture)?,
        Kind::GeometryOverlay => {
            by_guess(view, guesses, |view, guess| Ok((geometry_overlay::picture(view, guess)?, None)))?
        }
        Kind::Analytic => analytic::pictures(&settings.get(), view, guesses),
    };
    all.hypotheses.iter_mut().zip(guesses).for_each(|(hypothesis, guess)| hypothesis.says = guess.says());
    Ok(all)
}

/// What machines may choose once for a whole picture, from what is likely to what is coarse; at least one.
pub(super) fn guesses(kind: Kind, device: &Device, view: &ViewFrame) -> Vec<Guess> {
    if kind == Kind::Analytic {
        // No rasterizer draws it.
        return Envelope::of(device).into_iter().take(1).map(|of| Guess::of(of.unsnapped())).collect();
    }
    let has_blends = matches!(kind, Kind::StencilVolume | Kind::GeometryOverlay);
    let has_far_plane = kind == Kind::StencilVolume && view.far().is_finite();
    let of_envelope = |envelope| {
        let guess = Guess::of(envelope);
        let coarse = has_blends.then(|| guess.clone().with_coarse_blends());
        let bare: Vec<Guess> = std::iter::once(guess).chain(coarse).collect();
        let painted = bare.clone().into_iter().filter(|_| has_far_plane).map(Guess::with_painted_sky);
        bare.iter().cloned().chain(painted).collect::<Vec<Guess>>()
    };
    Envelope::of(device).into_iter().flat_map(of_envelope).collect()
}

/// A picture by a guess, and another that is looked at with it.
type Drawn = ((Hypothesis, Vec<Stage>, Vec<FeatureRun>), Option<Hypothesis>);

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
