//! The features of a layer on a globe: in longitude and latitude of its CRS, their strokes as areas.

use super::super::blame::of_key;
use super::super::follow::Follow;
use super::super::place::Map;
use super::super::unroll;
use super::stroke::Brush;
use crate::crs::{PlanFrom, Turn};
use crate::error::{Error, Result};
use crate::parallel;
use crate::scene::{Cap, Feature, Fill, Line, OutlineMode, Rule, Shape, Style, Width};
use crate::scene_file::{Edges, LayerSpec, SceneFile};
use crate::space::{Ellipsoid, Plan, PlanBox};
use glam::DVec2;

/// Refuses a style that a globe does not have.
pub(in crate::source::load) fn check_styles(
    scene: &SceneFile,
    spec: &LayerSpec,
    styles: &[Style],
) -> Result<()> {
    let refuse = |part: &str, what: &str, help: &str| {
        let key = format!("layer.{}.{part}", spec.name);
        Err(of_key(scene, &key, Error::unsupported(what).help(help)))
    };
    for style in styles {
        let strokes =
            [("line", style.line), ("point", style.point), ("outline", style.outline.map(|o| o.line))];
        let strokes = strokes.into_iter().filter_map(|(part, line)| Some((part, line?)));
        for (part, line) in strokes {
            if matches!(line.width, Width::Pixels(_)) {
                return refuse(
                    &format!("{part}.width_px"),
                    "strokes on a globe are areas on the ground, which do not depend on the view",
                    "give a width in metres: width_m",
                );
            }
            if matches!(spec.edges, Edges::Geodesic | Edges::Rhumb) {
                return refuse(
                    part,
                    "strokes on a globe follow edges that are straight in longitude and latitude, not curves of the ground",
                    "give the layer a fill alone, or leave `edges` out",
                );
            }
            if spec.style.fill.as_ref().is_some_and(|fill| fill.is_inverted) {
                return refuse(
                    part,
                    "a stroke on a globe is an area, and would be left out of an inverted fill",
                    "draw the strokes in a layer of their own",
                );
            }
        }
        if style.outline.is_some_and(|outline| outline.mode != OutlineMode::Normal) {
            return refuse(
                "outline.mode",
                "an outline on a globe is an area of its own, which is not cut to the polygon's",
                "leave the mode out",
            );
        }
    }
    Ok(())
}

/// Features in the coordinates of the globe's CRS; `map` leads from their own to the plan, `own` from the globe's.
pub(in crate::source::load) fn in_degrees(
    features: Vec<Feature>,
    (map, own): (&Map, &PlanFrom),
    (terrain, shift): (PlanBox, DVec2),
    tolerance: f64,
    edges: Edges,
) -> Result<Vec<Feature>> {
    let Map::From(from) = map else { return Ok(features) };
    let (None, Some(affine)) = (from.affine(), own.affine()) else { return Ok(features) };
    let near = PlanBox { min: terrain.min + -shift, max: terrain.max + -shift };
    let follow = Follow { tolerance, near, long: 0.0 };
    let place = |p: Plan| map.apply(p);
    let part = |part: &Vec<Plan>, is_ring: bool| -> Result<Vec<Plan>> {
        let mut all = Vec::with_capacity(part.len());
        for (k, &here) in part.iter().enumerate() {
            all.push(place(here)?);
            let next = part.get(k + 1).or_else(|| part.first().filter(|_| is_ring));
            if let (Some(&next), true) = (next, edges != Edges::Straight) {
                follow.between((here, place(here)?), (next, place(next)?), &place, &mut all)?;
            }
        }
        Ok(all.into_iter().map(|p| Plan::from(p.to_vec() / affine.scale + affine.origin)).collect())
    };
    let rings = |rings: &[Vec<Plan>]| rings.iter().map(|ring| part(ring, true)).collect::<Result<Vec<_>>>();
    let moved = parallel::map_owned(features, |feature| {
        let shape = match &feature.shape {
            Shape::Polygon(of) => rings(of).map(Shape::Polygon),
            Shape::MultiPolygon(members) => {
                members.iter().map(|of| rings(of)).collect::<Result<_>>().map(Shape::MultiPolygon)
            }
            Shape::Line(lines) => {
                lines.iter().map(|line| part(line, false)).collect::<Result<_>>().map(Shape::Line)
            }
            Shape::Points(points) => points
                .iter()
                .map(|p| Ok(Plan::from(place(*p)?.to_vec() / affine.scale + affine.origin)))
                .collect::<Result<_>>()
                .map(Shape::Points),
        };
        shape.map(|shape| Feature { shape, ..feature }).map_err(|error| error.in_feature(feature.index))
    });
    moved.into_iter().collect()
}

/// Features whose strokes are areas on the ground, each after its feature's fill, and the styles of both.
pub(in crate::source::load) fn stroked(
    features: Vec<Feature>,
    styles: Vec<Style>,
    ellipsoid: Ellipsoid,
    turn: Turn,
) -> (Vec<Feature>, Vec<Style>) {
    let area = |line: Line| Style {
        fill: Some(Fill { color: line.color, rule: Rule::NonZero }),
        ..Style::default()
    };
    let fills = styles.iter().map(|style| Style { fill: style.fill, ..Style::default() });
    let mut all: Vec<Style> = fills.collect();
    // Of each style its outline's, its line's, its points', where it has them.
    let mut strokes = Vec::with_capacity(styles.len());
    for style in &styles {
        strokes.push([style.outline.map(|outline| outline.line), style.line, style.point].map(|line| {
            line.map(|line| {
                all.push(area(line));
                (line, all.len() as u32 - 1)
            })
        }));
    }
    let made = parallel::map_owned(features, |feature| {
        let [outline, line, point] = strokes[feature.style as usize];
        let used = match &feature.shape {
            Shape::Polygon(_) | Shape::MultiPolygon(_) => outline,
            Shape::Line(_) => line,
            Shape::Points(_) => point.map(|(point, style)| (Line { cap: Cap::Round, ..point }, style)),
        };
        let stroke = used.map(|(line, style)| {
            let shape = Shape::MultiPolygon(members(&feature.shape, line, ellipsoid, turn));
            Feature { index: feature.index, style, shape }
        });
        let fill = Some(feature).filter(|feature| feature.shape.is_area());
        [fill, stroke]
    });
    (made.into_iter().flatten().flatten().collect(), all)
}

/// The members of a shape's stroke, each a ring.
fn members(shape: &Shape, line: Line, ellipsoid: Ellipsoid, turn: Turn) -> Vec<Vec<Vec<Plan>>> {
    let Width::Metres(width) = line.width else { return Vec::new() };
    let brush = Brush::new(ellipsoid, width, line.join, line.cap);
    let radians = std::f64::consts::TAU / turn.length;
    let path = |part: &mut dyn Iterator<Item = Plan>| part.map(|p| p.to_vec() * radians).collect::<Vec<_>>();
    let mut rings = Vec::new();
    let mut outlines = |of: &[Vec<Plan>]| {
        for ring in unroll::rings(of.to_vec(), turn) {
            let mut places = path(&mut ring.moved(0));
            if let Some(first) = places.first().copied() {
                places.push(first + DVec2::new(ring.way_around() * radians, 0.0));
            }
            rings.extend(brush.stroke(&places, true));
        }
    };
    match shape {
        Shape::Polygon(of) => outlines(of),
        Shape::MultiPolygon(members) => members.iter().for_each(|of| outlines(of)),
        Shape::Line(lines) => {
            for line in lines {
                let places = path(&mut unroll::line(line.clone(), turn).moved(0));
                rings.extend(brush.stroke(&places, brush.is_ring(&places)));
            }
        }
        Shape::Points(points) => {
            path(&mut points.iter().copied()).into_iter().for_each(|place| brush.dot(place, &mut rings))
        }
    }
    let own = |ring: Vec<DVec2>| vec![ring.into_iter().map(|p| Plan::from(p / radians)).collect()];
    rings.into_iter().map(own).collect()
}
