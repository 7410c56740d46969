//! By which other choices a picture that fails would fail less, or not at all.

use super::fit::{Fit, Picture};
use super::gates::Gates;
use crate::compare::allowed::Allowed;
use crate::compare::metrics::densest;

/// Something chosen otherwise than the scene has it, and what a picture would be worth by that.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Otherwise {
    /// The key of the scene file and its value.
    pub choice: String,
    /// What that means.
    pub says: String,
    /// How many pixels would lie outside.
    pub failing: usize,
    /// Whether the picture would pass.
    pub passes: bool,
}

/// The choices by which fewer than so many pixels lie outside, fewest first.
pub(super) fn otherwise(
    allowed: &Allowed,
    picture: &Picture,
    gates: Gates,
    failing: usize,
) -> Vec<Otherwise> {
    let mut all: Vec<Otherwise> = Vec::new();
    for of in &allowed.alternatives {
        let fit = Fit::of(&of.hypothesis, picture);
        let window = densest(&fit.fails, allowed.width, allowed.height);
        let in_window = if fit.failing == 0 { 0 } else { window.map_or(0, |window| window.failing) };
        if fit.failing < failing {
            all.push(Otherwise {
                choice: of.choice.clone(),
                says: of.hypothesis.says.clone(),
                failing: fit.failing,
                passes: fit.failing <= gates.allow && in_window <= gates.densest,
            });
        }
    }
    all.sort_by_key(|of| (!of.passes, of.failing));
    all
}
