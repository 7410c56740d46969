//! The heights of a terrain, but for those that are nonsense.

use drapery::math::{max, min};
use drapery::space::World;

/// One in so many points may be nonsense.
pub(super) const FEW: usize = 200;
/// A gap between heights that is a greater share of the relief has nonsense beyond it.
const GAP: f64 = 1.0 / 3.0;
/// A tail of heights that is a greater share of the relief is nonsense.
const TAIL: f64 = 2.0;

/// Takes heights that are far out (a few posts of nonsense) to those that are not. Summits rise from what is below them: of the few
/// highest and lowest those are nonsense that lie beyond a gap, or in a tail longer than all the rest.
pub(super) fn trim(points: &mut [World]) {
    let mut all: Vec<f64> = points.iter().map(|p| p.z).collect();
    all.sort_by(f64::total_cmp);
    let [low, high] = heights(points);
    let few = all.len() / FEW;
    let relief = high - low;
    let end = |tail: &mut dyn Iterator<Item = f64>, from: f64| {
        let mut last = from;
        for z in tail {
            if (z - last).abs() > GAP * relief || (z - from).abs() > TAIL * relief {
                return last;
            }
            last = z;
        }
        last
    };
    let top = end(&mut all[all.len() - few..].iter().copied(), high);
    let bottom = end(&mut all[..few].iter().rev().copied(), low);
    points.iter_mut().for_each(|p| p.z = min(max(p.z, bottom), top));
}

/// The heights that one in 200 points is below, and above.
pub(super) fn heights(points: &[World]) -> [f64; 2] {
    let mut heights: Vec<f64> = points.iter().map(|p| p.z).collect();
    heights.sort_by(f64::total_cmp);
    let few = heights.len() / FEW;
    let at = |k: usize| heights.get(k).copied().unwrap_or(0.0);
    [at(few), at(heights.len().saturating_sub(1 + few))]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Heights of a hundred metres, and a few others, and the least and the greatest of them that are framed.
    fn framed(others: &[f64]) -> [f64; 2] {
        let heights = (0..2000).map(|k| f64::from(k) / 20.0).chain(others.iter().copied());
        let mut points: Vec<World> = heights.map(|z| World { z, ..World::default() }).collect();
        trim(&mut points);
        points
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| [min(low, p.z), max(high, p.z)])
    }

    #[test]
    fn summits_are_framed_and_nonsense_is_not() {
        assert_eq!(framed(&[110.0, 115.0, 130.0, 150.0]), [0.0, 150.0], "a summit");
        assert_eq!(framed(&[9999.0]), [0.0, 99.95], "a height of nonsense");
        assert_eq!(framed(&[-9999.0, -9998.0, 105.0]), [0.0, 105.0], "data that is none");
    }
}
