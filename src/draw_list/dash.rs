//! A dashed stroke is several strokes: each dash is a chain of its own.
//!
//! Lengths are measured along the chain from its first vertex, in doubles, segment after segment, so that a dash lies where it lies whatever
//! a technique makes of joints, tiles or the distance.

use super::vertices::SAME_VERTEX;
use crate::error::{Error, Result};
use crate::scene::{Feature, Layer, Measure, Shape};
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

/// Lengths in the plan.
pub(super) struct InThePlan;

impl Measure for InThePlan {
    type Place = Plan;

    const SHORTEST: f64 = SAME_VERTEX;

    fn length(&self, from: Plan, to: Plan) -> f64 {
        (to - from).length()
    }

    fn place(&self, [from, to]: [Plan; 2], length: f64, at: f64) -> Plan {
        from + (to - from) / length * at
    }

    fn is_same(&self, one: Plan, other: Plan) -> bool {
        (other - one).length() <= SAME_VERTEX
    }

    fn after_the_end(&self, place: Plan, _: Plan, _: Plan) -> Plan {
        place
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::min;
    use crate::scene::{Dash, Dashed};

    fn plan(points: &[(f64, f64)]) -> Vec<Plan> {
        points.iter().map(|&(x, y)| Plan::new(x, y)).collect()
    }

    fn parts(path: &[(f64, f64)], is_closed: bool, lengths: &[f64], offset: f64) -> Vec<Vec<Plan>> {
        let dash = Dash::new(lengths, offset).expect("a pattern");
        match dash.along(&plan(path), is_closed, &InThePlan) {
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
