//! Which features can be seen at all: a footprint ends where the terrain does.

use super::terrain::Terrain;
use crate::math::max;
use crate::scene::{Feature, Join, Layer, Line, Rule, Shape, Style, Width};
use crate::space::{Plan, PlanBox};

/// Keeps the features of a layer that can touch the terrain, in their order. `count` is how many there were before any were left out.
pub(super) fn leave_out(terrain: &Terrain, layer: &mut Layer, count: usize, notes: &mut Vec<String>) {
    let (styles, outside) = (&layer.styles, layer.outside);
    layer.features.retain(|feature| {
        let style = styles[feature.style as usize];
        can_touch(feature, &Style { fill: style.fill.or(outside), ..style }, &terrain.bounds)
    });
    // On a globe a feature's stroke follows its fill.
    let kept = layer.features.chunk_by(|one, next| one.index == next.index).count();
    if kept == 0 && count > 0 {
        notes.push(format!("none of its {count} features meets the terrain"));
    } else if kept < count {
        notes.push(format!("{} of {count} features lie off the terrain and are left out", count - kept));
    }
}

/// Whether a note is on features that lie off the terrain: which ones do depends on how wide they are drawn.
pub fn is_about_extent(note: &str) -> bool {
    note.ends_with("meets the terrain") || note.ends_with("lie off the terrain and are left out")
}

/// How far beyond their vertices features of some styles may cover the plan; `None` where that depends on the view.
pub(super) fn reach_of(styles: &[Style]) -> Option<f64> {
    let lines = |style: &Style| [style.line, style.point, style.outline.map(|outline| outline.line)];
    styles.iter().flat_map(lines).flatten().try_fold(0.0, |far, line| Some(max(far, reach(line)?)))
}

/// How far from its segments a stroke may cover the plan.
fn reach(line: Line) -> Option<f64> {
    match line.width {
        Width::Pixels(_) => None,
        Width::Metres(width) => {
            let corner = match line.join {
                Join::Miter { limit } => max(limit, 2.0),
                Join::Round | Join::Bevel => 2.0,
            };
            Some(width * 0.5 * corner)
        }
    }
}

fn can_touch(feature: &Feature, style: &Style, terrain: &PlanBox) -> bool {
    let stroke = match &feature.shape {
        Shape::Polygon(_) | Shape::MultiPolygon(_) => style.outline.map(|outline| outline.line),
        Shape::Line(_) => style.line,
        Shape::Points(_) => style.point,
        Shape::Swath { .. } => None,
    };
    let Some(reach) = stroke.map_or(Some(0.0), reach) else { return true };
    let around = terrain.grown(reach);
    let is_area = feature.shape.is_area();
    let encloses = |rings: &[Vec<Plan>]| style.fill.is_some_and(|fill| holds(rings, fill.rule, around.min));
    let follows = !matches!(feature.shape, Shape::Points(_));
    follows && feature.shape.parts().any(|part| edges(part, is_area).any(|edge| meets(edge, &around)))
        || match &feature.shape {
            Shape::Polygon(rings) => encloses(rings),
            Shape::MultiPolygon(members) | Shape::Swath { members, .. } => {
                members.iter().any(|rings| encloses(rings))
            }
            Shape::Line(_) => false,
            Shape::Points(points) => points.iter().any(|point| meets((*point, *point), &around)),
        }
}

/// The segments of a part; a lone point is one.
fn edges(part: &[Plan], is_ring: bool) -> impl Iterator<Item = (Plan, Plan)> + '_ {
    let closing = part.last().zip(part.first()).filter(|_| is_ring || part.len() == 1);
    part.windows(2).map(|pair| (pair[0], pair[1])).chain(closing.map(|(a, b)| (*a, *b)))
}

/// Whether a segment may meet a rectangle; wrong only where it passes a corner within rounding.
fn meets((a, b): (Plan, Plan), rectangle: &PlanBox) -> bool {
    if !rectangle.meets(&PlanBox::around([a, b])) {
        return false;
    }
    let PlanBox { min: low, max: high } = *rectangle;
    let along = b - a;
    let sides =
        [low, Plan::new(high.x, low.y), high, Plan::new(low.x, high.y)].map(|p| along.perp_dot(p - a));
    let slack = 1e-9 * (along.x.abs() + along.y.abs()) * (high - low).length();
    !(sides.iter().all(|side| *side > slack) || sides.iter().all(|side| *side < -slack))
}

/// Whether a point is inside of rings.
fn holds(rings: &[Vec<Plan>], rule: Rule, at: Plan) -> bool {
    let turns = |ring: &Vec<Plan>| {
        let crossing = edges(ring, true).filter(|(a, b)| (a.y <= at.y) != (b.y <= at.y));
        let east = crossing.filter(|(a, b)| ((*b - *a).perp_dot(at - *a) > 0.0) == (a.y <= at.y));
        east.map(|(a, _)| if a.y <= at.y { 1 } else { -1 }).sum::<i32>()
    };
    rule.contains(rings.iter().map(turns).sum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Cap, Color, Fill, Outline, OutlineMode};

    fn plan(points: &[(f64, f64)]) -> Vec<Plan> {
        points.iter().map(|&(x, y)| Plan::new(x, y)).collect()
    }

    fn touches(shape: Shape, style: &Style) -> bool {
        let terrain = PlanBox { min: Plan::new(-10.0, -10.0), max: Plan::new(10.0, 10.0) };
        can_touch(&Feature { index: 0, style: 0, shape }, style, &terrain)
    }

    fn filled() -> Style {
        let fill = Fill { color: Color([0.0, 0.0, 0.0, 1.0]), rule: Rule::EvenOdd };
        Style { fill: Some(fill), ..Style::default() }
    }

    fn stroke(width: Width, join: Join) -> Line {
        Line { color: Color([0.0, 0.0, 0.0, 1.0]), width, join, cap: Cap::Butt }
    }

    #[test]
    fn a_shape_whose_box_alone_meets_the_terrain_is_off_it() {
        let bent = plan(&[(-30.0, 0.0), (-30.0, 30.0), (0.0, 30.0), (-20.0, 20.0)]);
        assert!(!touches(Shape::Polygon(vec![bent.clone()]), &filled()));
        let line = Style { line: Some(stroke(Width::Metres(2.0), Join::Round)), ..Style::default() };
        let passing = plan(&[(-30.0, 5.0), (5.0, 40.0)]);
        assert!(!touches(Shape::Line(vec![passing.clone()]), &line));
        let pixels = Style { line: Some(stroke(Width::Pixels(2.0), Join::Round)), ..Style::default() };
        assert!(touches(Shape::Line(vec![passing.clone()]), &pixels), "its width depends on the view");
        let wide = Style { line: Some(stroke(Width::Metres(40.0), Join::Round)), ..Style::default() };
        assert!(touches(Shape::Line(vec![passing]), &wide));
    }

    #[test]
    fn what_encloses_the_terrain_touches_it_and_what_has_it_in_a_hole_does_not() {
        let square = |r: f64| plan(&[(-r, -r), (r, -r), (r, r), (-r, r)]);
        assert!(touches(Shape::Polygon(vec![square(100.0)]), &filled()));
        assert!(!touches(Shape::Polygon(vec![square(100.0), square(50.0)]), &filled()));
        assert!(touches(Shape::MultiPolygon(vec![vec![square(100.0)], vec![square(50.0)]]), &filled()));
        let outlined = |width: f64| {
            let line = stroke(Width::Metres(width), Join::Miter { limit: 4.0 });
            Style { outline: Some(Outline { line, mode: OutlineMode::Normal }), ..Style::default() }
        };
        assert!(!touches(Shape::Polygon(vec![square(100.0)]), &outlined(10.0)));
        assert!(touches(Shape::Polygon(vec![square(100.0)]), &outlined(46.0)));
        assert!(touches(Shape::Polygon(vec![square(5.0)]), &filled()));
    }

    #[test]
    fn strokes_reach_as_far_as_their_miters() {
        let line = |width, join| Style { line: Some(stroke(width, join)), ..Style::default() };
        let (round, miter) = (Join::Round, Join::Miter { limit: 4.0 });
        let of = |styles: &[Style]| reach_of(styles);
        assert_eq!(of(&[filled()]), Some(0.0));
        assert_eq!(of(&[line(Width::Metres(3.0), round), line(Width::Metres(2.0), miter)]), Some(4.0));
        assert_eq!(of(&[line(Width::Metres(3.0), round), line(Width::Pixels(2.0), miter)]), None);
    }
}
