//! The pictures of a technique that a report shows: that of the scene's own settings, the best, the worst.

use super::{Exhibit, Run};
use crate::buffer::Buffer;
use crate::compare::Difference;
use crate::error::Result;

/// A run with its picture.
#[derive(Clone)]
struct Shown {
    run: Run,
    picture: Buffer<[u8; 4]>,
    difference: Difference,
}

/// The notable runs so far.
#[derive(Default)]
pub(super) struct Notable {
    own: Option<Shown>,
    best: Option<Shown>,
    worst: Option<Shown>,
}

impl Notable {
    /// Keeps a run's picture where it is notable.
    pub(super) fn offer(&mut self, run: &Run, picture: &Buffer<[u8; 4]>, difference: &Difference) {
        let shown =
            || Some(Shown { run: run.clone(), picture: picture.clone(), difference: difference.clone() });
        let is_new = |known: &Option<Shown>, is_further: &dyn Fn(&Run) -> bool| {
            known.as_ref().is_none_or(|known| is_further(&known.run))
        };
        if run.is_own {
            self.own = shown();
        }
        if is_new(&self.best, &|best| run.by_error(best).is_lt()) {
            self.best = shown();
        }
        if is_new(&self.worst, &|worst| run.by_error(worst).is_gt()) {
            self.worst = shown();
        }
    }

    /// The notable runs, each once.
    pub(super) fn exhibits(self) -> Result<Vec<Exhibit>> {
        let all = [(self.own, "as in the scene"), (self.best, "most right"), (self.worst, "least right")];
        let mut kept: Vec<(Shown, String)> = Vec::new();
        for (shown, why) in all {
            let Some(shown) = shown else { continue };
            match kept.iter_mut().find(|(known, _)| known.run.label() == shown.run.label()) {
                Some((_, reasons)) => *reasons = format!("{reasons}, {why}"),
                None => kept.push((shown, why.to_owned())),
            }
        }
        let exhibit = |(shown, why): (Shown, String)| {
            let caption = format!("{why} · root mean square error {:.5}", shown.run.error.rmse);
            Exhibit::new((shown.run.label(), caption), &shown.picture, &shown.difference)
        };
        kept.into_iter().map(exhibit).collect()
    }
}
