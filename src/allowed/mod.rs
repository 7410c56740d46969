//! What a technique's picture may be, of whatever right program draws it: for each pixel the colours that machines within a declared envelope
//! may come to.
//!
//! Input: a stage, a view, a technique at the scene's settings. Output: an [`Allowed`], which bundles carry and [`crate::compare`] judges by; and, for
//! who fails, what pictures would be by other choices ([`alternatives()`]). No technique's own code decides: what may be seen and held within a sample's square is found with the truth's certified pieces
//! ([`crate::truth::probe`]) over the technique's footprints. Refuses: techniques without a model, machines with absolute positions.

mod alternatives;
mod analytic;
mod by_kind;
mod clipmap;
mod composition;
mod dynamic_line;
mod encoding;
mod envelope;
mod far_plane;
mod geometry_overlay;
mod inverse_projection;
mod model;
mod picture;
mod pixel;
mod polygon;
mod premultiplied;
mod sampled;
mod stages;
mod static_decal;
mod stencil_volume;
mod surface;

pub use alternatives::alternatives;
pub use envelope::Envelope;

use crate::compare::{Allowed, Hypothesis};
use crate::error::{Error, Result};
use crate::scene::{Device, Positions};
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::technique::{self, Kind};
use by_kind::{guesses, pictures};
use encoding::{encoded_by_tables, encoding};
use envelope::DEPTH_STEPS;
use model::View;
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
    if stage.scene.device.position != Positions::Local {
        return Err(Error::unsupported(
            "nobody knows what a picture may be of a machine that rounds absolute positions",
        )
        .help("set device.position to \"local\", or judge it by its picture and a tolerance"));
    }
    let guesses = guesses(kind, &stage.scene.device, frame);
    let Pictures { mut hypotheses, stages, features } =
        pictures(kind, &View { stage, frame, progress }, &guesses)?;
    if let Some(by) = encoding(kind, stage.scene.compositing.space) {
        let coarse: Vec<Hypothesis> = hypotheses.iter().map(|of| encoded_by_tables(of, by)).collect();
        hypotheses.extend(coarse);
    }
    let premultiplied: Vec<Hypothesis> = hypotheses.iter().filter_map(premultiplied::premultiplied).collect();
    hypotheses.extend(premultiplied);
    let (width, height) = (frame.width(), frame.height());
    Ok(Allowed { width, height, hypotheses, stages, features, alternatives: Vec::new() })
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
