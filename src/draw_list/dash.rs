//! A dashed stroke is several strokes: each dash is a chain of its own.
//!
//! Lengths are measured along the chain from its first vertex, in doubles, segment after segment, so that a dash lies where it lies whatever
//! a technique makes of joints, tiles or the distance.

use super::vertices::SAME_VERTEX;
use crate::error::{Error, Result};
use crate::math::{max, min};
use crate::scene::{Dash, Feature, Layer, Shape};
use crate::space::Plan;

/// The most dashes of all layers.
const MOST: f64 = (1 << 25) as f64;

/// Refuses layers with more dashes than may be made.
pub(super) fn check(layers: &[Layer]) -> Result<()> {
    let mut all = 0.0;
    for (k, layer) in layers.iter().enumerate() {
        for feature in &layer.features {
            all += most_dashes(layer, feature);
            if all > MOST {
                let error = Error::unsupported("more than 2^25 dashes up to here");
                let help = "make the numbers of `dash` larger, or give the terrain a `window`";
                return Err(error.help(help).in_feature(feature.index).in_layer(k, &layer.name));
            }
        }
    }
    Ok(())
}

/// No feature has more dashes.
fn most_dashes(layer: &Layer, feature: &Feature) -> f64 {
    let style = layer.style_of(feature);
    let is_area = feature.shape.is_area();
    let dash = match &feature.shape {
        Shape::Line(_) => style.line.and(style.line_dash),
        _ if is_area => style.outline.and(style.outline_dash),
        _ => None,
    };
    let Some(dash) = dash else { return 0.0 };
    let closing = |part: &[Plan]| match part {
        [first, .., last] if is_area => (*last - *first).length(),
        _ => 0.0,
    };
    let of_part = |part: &Vec<Plan>| {
        let length = part.windows(2).map(|ends| (ends[1] - ends[0]).length()).sum::<f64>() + closing(part);
        (length / dash.period() + 2.0) * dash.lengths().len() as f64 / 2.0
    };
    feature.shape.parts().map(of_part).sum()
}

/// What is drawn of a path, whose consecutive vertices are distinct.
pub(super) enum Dashed {
    /// All of it.
    Whole,
    /// These, each at least two distinct vertices.
    Parts(Vec<Vec<Plan>>),
}

/// The dashes along a path. Those of a closed one, which ends where it begins, that meet at its first vertex are one. A dash of no more than the
/// distance of vertices that are the same is none.
pub(super) fn dashed(path: &[Plan], is_closed: bool, dash: &Dash) -> Dashed {
    let along = lengths_along(path);
    let length = along[along.len() - 1];
    if length == 0.0 {
        return Dashed::Whole;
    }
    let mut stretches = stretches(length, dash);
    let joins = |stretches: &[Stretch]| {
        is_closed
            && stretches.first().is_some_and(|of| of.from <= 0.0)
            && stretches.last().is_some_and(|of| of.to >= length)
    };
    if let [only] = &stretches[..]
        && only.from <= 0.0
        && only.to >= length
    {
        return Dashed::Whole;
    }
    let over_the_start = if stretches.len() > 1 && joins(&stretches) { stretches.pop() } else { None };
    let part = |of: &Stretch| part(path, &along, of);
    let mut parts: Vec<Vec<Plan>> = stretches.iter().map(part).collect();
    if let (Some(last), Some(first)) = (over_the_start, parts.first_mut()) {
        let mut whole = part(&last);
        first.drain(1..).for_each(|p| push(&mut whole, p));
        *first = whole;
    }
    parts.retain(|part| part.len() > 1);
    Dashed::Parts(parts)
}

/// A dash from one length along a path to another.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Stretch {
    from: f64,
    to: f64,
}

/// Of each vertex how far along a path it lies.
fn lengths_along(path: &[Plan]) -> Vec<f64> {
    let mut along = 0.0;
    let steps = path.windows(2).map(|ends| {
        along += (ends[1] - ends[0]).length();
        along
    });
    std::iter::once(0.0).chain(steps).collect()
}

/// The dashes of a path of a length, in their order, ends not cut off.
fn stretches(length: f64, dash: &Dash) -> Vec<Stretch> {
    let period = dash.period();
    let into = dash.offset().rem_euclid(period);
    let mut found = Vec::new();
    for turn in 0_u32.. {
        let mut at = f64::from(turn) * period - into;
        if at >= length {
            break;
        }
        for lengths in dash.lengths().chunks(2) {
            let stretch = Stretch { from: at, to: at + lengths[0] };
            if min(stretch.to, length) - max(stretch.from, 0.0) > SAME_VERTEX {
                found.push(stretch);
            }
            at = stretch.to + lengths[1];
        }
    }
    found
}

/// The vertices of a stretch of a path.
fn part(path: &[Plan], along: &[f64], of: &Stretch) -> Vec<Plan> {
    let mut part = vec![place(path, along, of.from)];
    let first = along.partition_point(|at| *at <= of.from);
    let end = along.partition_point(|at| *at < of.to);
    path[first..end.max(first)].iter().for_each(|p| push(&mut part, *p));
    push(&mut part, place(path, along, of.to));
    part
}

/// Adds a vertex; one that is the same as that before it stands in its place, but never in that of the first.
fn push(part: &mut Vec<Plan>, p: Plan) {
    let is_same = |last: &Plan| (*last - p).length() <= SAME_VERTEX;
    while part.len() > 1 && part.last().is_some_and(is_same) {
        part.pop();
    }
    if !part.last().is_some_and(is_same) {
        part.push(p);
    }
}

/// The place at a length along a path; its ends beyond them.
fn place(path: &[Plan], along: &[f64], at: f64) -> Plan {
    let to = along.partition_point(|end| *end <= at);
    if to == 0 {
        return path[0];
    }
    let Some(end) = path.get(to) else { return path[path.len() - 1] };
    let (from, start) = (path[to - 1], along[to - 1]);
    from + (*end - from) / (along[to] - start) * (at - start)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan(points: &[(f64, f64)]) -> Vec<Plan> {
        points.iter().map(|&(x, y)| Plan::new(x, y)).collect()
    }

    fn parts(path: &[(f64, f64)], is_closed: bool, lengths: &[f64], offset: f64) -> Vec<Vec<Plan>> {
        let dash = Dash::new(lengths, offset).expect("a pattern");
        match dashed(&plan(path), is_closed, &dash) {
            Dashed::Whole => vec![plan(path)],
            Dashed::Parts(parts) => parts,
        }
    }

    const SQUARE: [(f64, f64); 5] = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0), (0.0, 0.0)];

    #[test]
    fn dashes_lie_by_the_length_along_the_line_whatever_vertices_it_has() {
        let straight = parts(&[(0.0, 0.0), (100.0, 0.0)], false, &[10.0, 5.0], 0.0);
        let with_a_vertex = parts(&[(0.0, 0.0), (37.3, 0.0), (100.0, 0.0)], false, &[10.0, 5.0], 0.0);
        assert_eq!(straight.len(), 7);
        for (k, (one, other)) in (0..).zip(straight.iter().zip(&with_a_vertex)) {
            let (from, to) = (15.0 * f64::from(k), 15.0 * f64::from(k) + 10.0);
            assert_eq!(*one, plan(&[(from, 0.0), (min(to, 100.0), 0.0)]));
            let ends = [other[0], other[other.len() - 1]];
            assert!((ends[0] - one[0]).length() < 1e-12 && (ends[1] - one[1]).length() < 1e-12, "{other:?}");
            assert_eq!(other.len(), if from < 37.3 && 37.3 < to { 3 } else { 2 });
        }
    }

    #[test]
    fn a_dash_turns_with_the_line() {
        let bent = parts(&[(0.0, 0.0), (6.0, 0.0), (6.0, 20.0)], false, &[10.0, 5.0], 0.0);
        assert_eq!(bent[0], plan(&[(0.0, 0.0), (6.0, 0.0), (6.0, 4.0)]));
        assert_eq!(bent[1], plan(&[(6.0, 9.0), (6.0, 19.0)]));
        assert_eq!(bent.len(), 2);
    }

    #[test]
    fn an_offset_begins_further_into_the_pattern_and_whole_turns_of_it_change_nothing() {
        let line = [(0.0, 0.0), (30.0, 0.0)];
        let by = |offset: f64| parts(&line, false, &[10.0, 5.0], offset);
        assert_eq!(by(4.0)[0], plan(&[(0.0, 0.0), (6.0, 0.0)]));
        assert_eq!(by(12.0)[0], plan(&[(3.0, 0.0), (13.0, 0.0)]));
        assert_eq!(by(-11.0), by(4.0));
        assert_eq!(by(4.0 + 15.0), by(4.0));
    }

    #[test]
    fn dashes_that_meet_at_a_rings_first_vertex_are_one() {
        let ring = parts(&SQUARE, true, &[6.0, 4.0], 3.0);
        assert_eq!(ring[0], plan(&[(0.0, 3.0), (0.0, 0.0), (3.0, 0.0)]));
        assert_eq!(ring.len(), 4);
        let line = parts(&SQUARE, false, &[6.0, 4.0], 3.0);
        assert_eq!(line[0], plan(&[(0.0, 0.0), (3.0, 0.0)]));
        assert_eq!(line.len(), 5);
        assert_eq!(parts(&SQUARE, true, &[50.0, 1.0], 2.0), [plan(&SQUARE)], "one dash all around");
    }

    #[test]
    fn lengths_of_dashes_add_up() {
        let path: Vec<(f64, f64)> = (0..40).map(|k| (f64::from(k), f64::from(k * k % 7))).collect();
        let length = |part: &[Plan]| part.windows(2).map(|ends| (ends[1] - ends[0]).length()).sum::<f64>();
        let whole = length(&plan(&path));
        // The second pattern draws what the first leaves out.
        let [drawn, left] = [([0.7, 0.4], 0.0), ([0.4, 0.7], 0.4)].map(|(lengths, offset)| {
            parts(&path, false, &lengths, offset).iter().map(|part| length(part)).sum::<f64>()
        });
        assert!(drawn > 0.5 * whole && left > 0.3 * whole);
        assert!((drawn + left - whole).abs() < 1e-9, "{drawn} {left} {whole}");
    }
}
