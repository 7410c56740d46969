//! The points of a terrain that a picture is to hold: samples, and the summits between them.

use super::heights::{FEW, heights};
use drapery::math::max;
use drapery::scene::{GlobePosts, Posts, Surface};
use drapery::space::{PlanBox, World};
use std::ops::Range;

/// Samples of a grid a side.
const SAMPLES: usize = 160;
/// A post is alone where no neighbour is nearer than this share of the relief.
const LONE: f64 = 1.0 / 3.0;

/// Points of a surface, within a box: enough of a grid to know its shape.
pub(super) fn samples(surface: &Surface, within: Option<&PlanBox>) -> Vec<World> {
    let is_inside = |p: &World| {
        let at = PlanBox { min: p.plan(), max: p.plan() };
        p.z.is_finite() && within.is_none_or(|within| within.meets(&at))
    };
    match surface {
        Surface::Points(points) => points.iter().copied().filter(is_inside).collect(),
        Surface::Grid(posts) | Surface::Globe(GlobePosts { posts, .. }) => {
            let (columns, rows) = (posts.columns(), posts.rows());
            let (i, j) = within.map_or((0..columns, 0..rows), |within| posts_within(posts, within));
            let every = |range: &Range<usize>| range.len().div_ceil(SAMPLES).max(1);
            let (east, north) = (every(&i), every(&j));
            let along = |range: Range<usize>, every: usize| range.clone().step_by(every).chain(range.last());
            let posts = along(j, north).flat_map(|j| along(i.clone(), east).map(move |i| posts.world(i, j)));
            posts.filter(is_inside).collect()
        }
    }
}

/// Columns and rows that may lie within a box.
fn posts_within(posts: &Posts, within: &PlanBox) -> (Range<usize>, Range<usize>) {
    let (east, north) = (posts.east(), posts.north());
    let whole = (0..posts.columns(), 0..posts.rows());
    if east.y != 0.0 || north.x != 0.0 {
        return whole;
    }
    let range = |low: f64, high: f64, step: f64, count: usize| {
        let first = max((low / step).floor(), 0.0) as usize;
        let last = max((high / step).ceil(), 0.0) as usize;
        first.min(count - 1)..(last + 1).min(count)
    };
    let (low, high) = (within.min - posts.first, within.max - posts.first);
    (range(low.x, high.x, east.x, posts.columns()), range(low.y, high.y, north.y, posts.rows()))
}

/// Adds the highest post around each sample: a summit is not to be cut off because it lies between samples.
pub(super) fn add_summits(points: &mut Vec<World>, posts: &Posts, within: &PlanBox) {
    let [low, high] = heights(points);
    // In a grid of few posts a peak is like nothing beside it.
    let far = if points.len() < FEW { f64::INFINITY } else { LONE * (high - low) };
    let is_isolated = |i: usize, j: usize, z: f64| {
        let beside = (j.saturating_sub(1)..(j + 2).min(posts.rows()))
            .flat_map(|j| (i.saturating_sub(1)..(i + 2).min(posts.columns())).map(move |i| (i, j)));
        let mut others = beside.filter(|at| *at != (i, j)).map(|(i, j)| posts.world(i, j).z);
        !others.any(|other| (other - z).abs() <= far)
    };
    let (columns, rows) = posts_within(posts, within);
    let blocks = |range: &Range<usize>| (range.len().div_ceil(SAMPLES).max(1), range.end);
    let ((east, last_column), (north, last_row)) = (blocks(&columns), blocks(&rows));
    points.retain(|p| p.z <= high + far && p.z >= low - far);
    for j0 in rows.step_by(north) {
        for i0 in columns.clone().step_by(east) {
            let mut summit: Option<World> = None;
            for j in j0..(j0 + north).min(last_row) {
                for i in i0..(i0 + east).min(last_column) {
                    let p = posts.world(i, j);
                    let is_higher = p.z.is_finite() && summit.is_none_or(|summit| p.z > summit.z);
                    if is_higher && !is_isolated(i, j, p.z) {
                        summit = Some(p);
                    }
                }
            }
            points.extend(summit);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    use drapery::space::Plan;

    #[test]
    fn a_summit_between_samples_is_framed_and_a_lone_post_is_not() {
        let summit = |height: fn(i32, i32) -> f64| {
            let heights = (0..400 * 400).map(|k| height(k % 400, k / 400)).collect();
            let steps = (glam::DVec2::X, glam::DVec2::Y);
            let posts = Posts::new((400, 400), Plan::new(0.0, 0.0), steps, heights).unwrap();
            let mut points = samples(&Surface::Grid(posts.clone()), None);
            let all = PlanBox::around(points.iter().map(|p| p.plan()));
            add_summits(&mut points, &posts, &all);
            points.iter().fold(0.0, |high, p| max(high, p.z))
        };
        let cone = |i: i32, j: i32| 300.0 - f64::from(((i - 202).abs() + (j - 202).abs()).min(300));
        assert_eq!(summit(cone), 300.0);
        assert_eq!(summit(|i, j| if (i, j) == (202, 202) { 4140.0 } else { f64::from(i) }), 399.0);
    }
}
