//! Which features have a say in the pixels that fail.

use crate::compare::allowed::FeatureRun;
use std::collections::BTreeMap;

/// A feature, and in how many failing pixels it has a say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Involved {
    /// The layer's place in the scene.
    pub layer: u32,
    /// The feature's place in its layer.
    pub feature: u32,
    /// The failing pixels.
    pub pixels: usize,
}

/// The features that are involved, most first.
pub(super) fn involved(runs: &[FeatureRun], fails: &[bool], width: usize) -> Vec<Involved> {
    if runs.is_empty() || !fails.contains(&true) {
        return Vec::new();
    }
    // How many fail before each pixel.
    let mut before = Vec::with_capacity(fails.len() + 1);
    let mut sum = 0;
    before.push(sum);
    before.extend(fails.iter().map(|fails| {
        sum += usize::from(*fails);
        sum
    }));
    let mut pixels: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    for run in runs {
        let row = run.row as usize * width;
        let failing = before[row + run.last as usize + 1] - before[row + run.first as usize];
        if failing > 0 {
            *pixels.entry((run.layer, run.feature)).or_default() += failing;
        }
    }
    let found = pixels.into_iter().map(|((layer, feature), pixels)| Involved { layer, feature, pixels });
    let mut found: Vec<Involved> = found.collect();
    found.sort_by_key(|involved| std::cmp::Reverse(involved.pixels));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn features_are_counted_over_their_runs_most_first() {
        let run = |row, first, last, feature| FeatureRun { row, first, last, layer: 0, feature };
        let runs = [run(0, 0, 0, 3), run(0, 0, 2, 1), run(1, 1, 2, 1), run(1, 0, 0, 2)];
        let fails = [true, false, true, false, false, true];
        let found: Vec<(u32, usize)> =
            involved(&runs, &fails, 3).iter().map(|f| (f.feature, f.pixels)).collect();
        assert_eq!(found, [(1, 3), (3, 1)]);
    }
}
