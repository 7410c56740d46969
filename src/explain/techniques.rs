//! What techniques did at pixels, with margins; and what other settings make of them.

use super::account::{Account, ByTechnique, LeftOut, ROUNDING, Right, Step, Tried, color_of};
use super::bench::{Bench, Near};
use super::margin::{margins, silhouette};
use crate::error::Result;
use crate::scene_file::SceneText;
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::technique::{self, Explanation, Kind, Prepared};

/// More margins than these of a step are not told.
const MOST_MARGINS: usize = 2;

/// Borders that are farther away are no matter of a step, pixels.
const FAR: f64 = 0.5;

/// The techniques that draw a scene, prepared, and the others with their reasons.
pub(super) struct Prepare<'a> {
    pub(super) prepared: Vec<(Kind, Box<dyn Prepared + 'a>)>,
    pub(super) left_out: Vec<LeftOut>,
}

impl<'a> Prepare<'a> {
    /// Prepares those that are asked for, each of which has to draw the scene; or all that do.
    pub(super) fn new(stage: &'a Stage, asked: Option<&[Kind]>) -> Result<Self> {
        let (mut prepared, mut left_out) = (Vec::new(), Vec::new());
        for kind in asked.unwrap_or(&Kind::ALL) {
            match technique::applies(*kind, stage) {
                Ok(()) => prepared.push((*kind, technique::prepare(*kind, stage)?)),
                Err(error) if asked.is_some() || error.is_internal() => return Err(error),
                Err(error) => {
                    left_out.push(LeftOut { technique: kind.name(), reason: error.what().to_owned() })
                }
            }
        }
        Ok(Self { prepared, left_out })
    }
}

/// What a technique did at a pixel.
pub(super) fn told(
    bench: &Bench,
    near: &Near,
    right: &Right,
    kind: Kind,
    explained: &Explanation,
) -> ByTechnique {
    let steps = explained.steps.iter().map(|step| told_step(bench, near, step.as_ref())).collect();
    ByTechnique {
        technique: kind.name(),
        paper: kind.declaration().paper,
        code: explained.code,
        error: right.distance(color_of(explained.code)),
        steps,
        tried: Vec::new(),
    }
}

fn told_step(bench: &Bench, near: &Near, step: &dyn technique::Step) -> Step {
    let seen = step.place().and_then(|plan| bench.seen_over(near, plan));
    let mut margins = seen.map(|seen| margins(bench, &seen)).unwrap_or_default();
    margins.retain(|margin| margin.pixels <= FAR);
    margins.truncate(MOST_MARGINS);
    let mut items = step.items();
    items.sort_unstable();
    items.dedup();
    Step {
        section: step.section(),
        text: step.to_string(),
        items,
        plan: step.place().map(|plan| bench.absolute(plan)),
        screen: seen.map(|seen| [seen.at.x, seen.at.y]),
        margins,
        silhouette: seen.and_then(|seen| silhouette(near, &seen)).filter(|edge| edge.pixels <= FAR),
    }
}

/// Tries other settings of each technique that was asked and is off by more than rounding, and keeps what they make of the pixel. Those that are
/// refused are left out.
///
/// # Errors
/// Internal errors only.
pub(super) fn try_others(
    account: &mut Account,
    (text, stage): (&SceneText, &mut Stage),
    view: &ViewFrame,
) -> Result<()> {
    let own = (stage.scene.technique.clone(), stage.scene.device);
    let off = account.techniques.iter_mut().filter(|told| told.error > ROUNDING);
    for told in off {
        let Some(kind) = Kind::ALL.into_iter().find(|kind| kind.name() == told.technique) else { continue };
        for changes in kind.declaration().sweep.remedies {
            let changed = text.changed(changes)?;
            if changed.technique == own.0 {
                continue;
            }
            stage.scene.technique = changed.technique;
            if let Some(code) = code_with(stage, view, kind, account.pixel)? {
                let error = account.truth.distance(color_of(code));
                let changes = changes.iter().map(|change| (*change).to_owned()).collect();
                told.tried.push(Tried { changes, code, error });
            }
        }
        stage.scene.technique = own.0.clone();
    }
    Ok(())
}

/// A pixel's code values by a technique as a stage now sets it; `None` where it refuses that.
fn code_with(stage: &Stage, view: &ViewFrame, kind: Kind, pixel: [usize; 2]) -> Result<Option<[u8; 4]>> {
    let draw = || -> Result<[u8; 4]> {
        technique::applies(kind, stage)?;
        let prepared = technique::prepare(kind, stage)?;
        Ok(technique::explain(prepared.as_ref(), view, pixel)?.code)
    };
    match draw() {
        Ok(code) => Ok(Some(code)),
        Err(error) if error.is_internal() => Err(error),
        Err(_) => Ok(None),
    }
}
