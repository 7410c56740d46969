//! What pixels' centres may see, before any line is drawn on the screen over it.

use super::envelope::COORDINATES;
use super::model::{Guess, View};
use super::stages::Seen;
use crate::buffer::Buffer;
use crate::certainty::{Known, PaintRange};
use crate::draw_list::DrawList;
use crate::footprint::Strokes;
use crate::space::PlanBox;
use crate::truth::{Probe, Sample, probe};

/// Something that a pixel's centre may see.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Surface {
    /// Its triangle; [`crate::terrain::SKY`]: none.
    pub(super) triangle: u32,
    /// The terrain's or the sky's own paint.
    pub(super) ground: PaintRange,
    /// With the items of the probe over it.
    pub(super) paint: PaintRange,
    /// These items; `None`: any.
    pub(super) items: Option<Vec<(u32, Known)>>,
    /// Around its places in the plan.
    pub(super) plan: PlanBox,
    /// Its least and largest view depth, metres.
    pub(super) depth: (f64, f64),
}

/// What centres see: all that each may, and the same for the stages.
pub(super) struct Surfaces {
    pub(super) of: Buffer<Vec<Surface>>,
    pub(super) seen: Buffer<Seen>,
}

/// Finds what centres see. `strokes`: what is painted on the terrain before; `None`: nothing. `depths_of_shifts`: as a [`Probe`] has it.
pub(super) fn surfaces(
    view: &View,
    guess: &Guess,
    (strokes, depths_of_shifts): (Option<Strokes>, f64),
) -> Surfaces {
    let nothing = DrawList::default();
    let along = |depth: f64| guess.envelope.along(view.frame, depth);
    let probed = |list: &DrawList, strokes: Strokes, (from, to): (f64, f64)| -> Buffer<Sample> {
        let shift = guess.envelope.shift();
        let share = if list.items().is_empty() { 0.0 } else { COORDINATES };
        let of = Probe {
            list,
            strokes,
            spots: &[[0.5; 2]],
            shifts: &[shift],
            depths_of_shifts,
            along: &along,
            share,
        };
        let progress = |share: f64| (view.progress)(from + (to - from) * share);
        probe(view.stage, view.frame, &of, &|_, samples| samples[0].clone(), &progress)
    };
    let bare = probed(&nothing, Strokes::Style, (0.0, 0.25));
    let painted = strokes.map(|strokes| probed(&view.stage.draw_list, strokes, (0.25, 0.5)));
    let of = |(k, sample): (usize, &Sample)| -> Vec<Surface> {
        let all = painted.as_ref().map_or(sample, |painted| &painted.values()[k]);
        let ground = |triangle: u32| {
            let same = sample.outcomes.iter().filter(|of| of.triangle == triangle).map(|of| of.paint);
            same.reduce(|all, paint| all.hull(&paint)).unwrap_or_else(|| sample.paint())
        };
        all.outcomes
            .iter()
            .map(|outcome| Surface {
                triangle: outcome.triangle,
                ground: if painted.is_some() { ground(outcome.triangle) } else { outcome.paint },
                paint: outcome.paint,
                items: outcome.items.clone(),
                plan: outcome.plan,
                depth: outcome.depth,
            })
            .collect()
    };
    let (width, height) = (bare.width(), bare.height());
    let all = bare.values().iter().enumerate().map(of).collect();
    let seen = bare.values().iter().map(|sample| Seen::of(sample, &along)).collect();
    Surfaces { of: Buffer::from_values(width, height, all), seen: Buffer::from_values(width, height, seen) }
}
