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

use crate::compare::Allowed;
use crate::error::Result;
use crate::scene::Device;
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::technique::{self, Kind};
use envelope::DEPTH_STEPS;
use model::{Guess, View};

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
    let guesses: Vec<Guess> = Envelope::of(&stage.scene.device).into_iter().map(Guess::of).collect();
    let mut all = Allowed { width: frame.width(), height: frame.height(), ..Allowed::default() };
    // Of guesses that are looked at together, those beside the first.
    let mut others = Vec::new();
    let count = guesses.len() as f64;
    for (k, guess) in guesses.iter().enumerate() {
        let progress = |share: f64| progress((k as f64 + share) / count);
        let view = View { stage, frame, progress: &progress };
        let (mut hypothesis, stages, features) = match kind {
            Kind::StencilVolume => {
                stencil_volume::sampling(&stage.scene.technique.get()).picture(&view, guess)
            }
            Kind::DynamicLine => {
                let (judged, rounded) = dynamic_line::picture(&view, guess)?;
                others.extend(rounded);
                judged
            }
            Kind::GeometryOverlay => geometry_overlay::picture(&view, guess)?,
            Kind::StaticDecal => {
                let settings = stage.scene.technique.get();
                static_decal::sampling(&settings, &stage.draw_list)?.picture(&view, guess)
            }
            Kind::InverseProjection => {
                inverse_projection::picture(&stage.scene.technique.get(), &view, guess)
            }
            Kind::Clipmap => clipmap::picture(&view, guess)?,
        };
        hypothesis.says = guess.says();
        all.hypotheses.push(hypothesis);
        // The last envelope is the widest.
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
