//! The arguments of `render`, `report` and `export` that say how exact the truth is.

use drapery::Result;
use drapery::truth::Budget;

/// How exact the truth is; every run's error is its distance from it.
#[derive(Debug, Clone, Copy, clap::Args)]
pub(super) struct TruthArguments {
    /// Refine each pixel of the truth until no channel's interval is wider than this (units of 1, not of 255).
    #[arg(long = "truth-width", value_name = "W", default_value_t = Budget::default().width)]
    width: f64,
    /// Cut a pixel of the truth into at most 2^D pieces; what is open then stays in the interval.
    #[arg(long = "truth-depth", value_name = "D", default_value_t = Budget::default().depth)]
    depth: u32,
}

impl TruthArguments {
    pub(super) fn budget(&self) -> Result<Budget> {
        Budget::new(self.width, self.depth)
    }
}
