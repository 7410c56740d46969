//! The features of a layer on a globe: in longitude and latitude of its CRS, their strokes as areas.

use super::super::blame::of_key;
use super::super::changes::Changes;
use super::super::follow::Follow;
use super::super::ground_curve::GroundCurves;
use super::super::place::Map;
use super::super::unroll::{self, Unrolled};
use super::super::window::on_the_globe;
use super::stroke::Brush;
use crate::crs::{PlanFrom, Turn};
use crate::error::{Error, Result};
use crate::math::{cos, max};
use crate::parallel;
use crate::scene::{Cap, Feature, Fill, Line, OutlineMode, Rule, Shape, Style, Swath, Width};
use crate::scene_file::{Edges, LayerSpec, SceneFile};
use crate::space::{Ellipsoid, Globe, Plan, PlanBox};
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
            if spec.style.fill.as_ref().is_some_and(|fill| fill.is_inverted) {
                return refuse(
                    part,
                    "a stroke on a globe is an area, and would be left out of an inverted fill",
                    "draw the strokes in a layer of their own",
                );
            }
        }
        let dashed = [("line", style.line_dash), ("outline", style.outline_dash)];
        if let Some((part, _)) = dashed.into_iter().find(|(_, dash)| dash.is_some()) {
            return refuse(
                &format!("{part}.dash"),
                "dashes are measured in metres of the plan, and a globe's plan has its true length nowhere but along the equator",
                "leave the dashes out",
            );
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
    let place = |p: Plan| placed(p, from, own);
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
            // Of files there are none.
            Shape::Swath { .. } => Ok(feature.shape.clone()),
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

/// A place of another CRS in the globe's plan: on the turn that it is written on, and as far beyond a pole.
fn placed(p: Plan, from: &PlanFrom, own: &PlanFrom) -> Result<Plan> {
    let turns = from.file().turn().zip(own.file().turn()).zip(own.affine());
    let Some(((turn, own_turn), affine)) = turns else { return from.apply(p.to_vec()).map(Plan::from) };
    let on_globe = on_the_globe(p.to_vec(), Some(turn));
    let placed = from.apply_unrolled(on_globe)?;
    let length = own_turn.length * affine.scale.x;
    let turns_off = p.x / turn.length - placed.x / length;
    let beyond = if turn.pole.is_finite() { (p.y - on_globe.y) / turn.pole } else { 0.0 };
    Ok(Plan::from(placed + DVec2::new(length * turns_off.round(), own_turn.pole * affine.scale.y * beyond)))
}

/// A rectangle of the plan from beyond which no stroke that reaches so far from its line, metres on the ground, gets to the terrain; near a pole, where that
/// is any longitude, up to 64 times as far.
pub(in crate::source::load) fn near_strokes(globe: &Globe, terrain: &PlanBox, reach: f64) -> PlanBox {
    let [south, north] = [terrain.min, terrain.max].map(|at| globe.geographic(at).1.abs());
    terrain.grown(reach / max(cos(max(south, north)), 1.0 / 64.0))
}

/// Features whose strokes are areas on the ground, each after its feature's fill, and the styles of both.
pub(in crate::source::load) fn stroked(
    features: Vec<Feature>,
    styles: Vec<Style>,
    ground: &Strokes,
) -> (Vec<Feature>, Vec<Style>) {
    let area = |(line, is_of_points): (Line, bool)| Style {
        fill: Some(Fill { color: line.color, rule: Rule::NonZero }),
        swath: width_m(line).map(|width_m| Swath { width_m, is_of_points }),
        ..Style::default()
    };
    let fills = styles.iter().map(|style| Style { fill: style.fill, ..Style::default() });
    let mut all: Vec<Style> = fills.collect();
    // Of each style its outline's, its line's, its points', where it has them.
    let mut strokes = Vec::with_capacity(styles.len());
    for style in &styles {
        let kinds = [style.outline.map(|outline| outline.line), style.line, style.point];
        strokes.push([(kinds[0], false), (kinds[1], false), (kinds[2], true)].map(|(line, is_of_points)| {
            line.map(|line| {
                all.push(area((line, is_of_points)));
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
            Shape::Swath { .. } => None,
        };
        let stroke = used.map(|(line, style)| {
            let shape = ground.swath(&feature.shape, line);
            Feature { index: feature.index, style, shape }
        });
        let fill = Some(feature).filter(|feature| feature.shape.is_area());
        [fill, stroke]
    });
    (made.into_iter().flatten().flatten().collect(), all)
}

fn width_m(line: Line) -> Option<f64> {
    match line.width {
        Width::Metres(width) => Some(width),
        Width::Pixels(_) => None,
    }
}

/// What strokes lie on, and what the edges are that they follow.
pub(in crate::source::load) struct Strokes {
    /// The ground.
    pub(in crate::source::load) ellipsoid: Ellipsoid,
    /// A turn of longitude in the features' unit.
    pub(in crate::source::load) turn: Turn,
    /// Curves of the ground; `None`: edges are straight in longitude and latitude.
    pub(in crate::source::load) curves: Option<GroundCurves>,
}

impl Strokes {
    fn followed(&self, part: Unrolled, is_ring: bool) -> Unrolled {
        match &self.curves {
            // The fill, or what is drawn instead, tells how many vertices that takes.
            Some(curves) => curves.followed(part, is_ring, &mut Changes::default()),
            None => part,
        }
    }

    /// The area of a shape's stroke, each member a ring, and what it is along.
    fn swath(&self, shape: &Shape, line: Line) -> Shape {
        let mut swath = (Vec::new(), Vec::new());
        if let Some(width) = width_m(line) {
            let brush = Brush::new(self.ellipsoid, width, line.join, line.cap);
            match shape {
                Shape::Polygon(of) => self.outline(of, &brush, &mut swath),
                Shape::MultiPolygon(members) => {
                    members.iter().for_each(|of| self.outline(of, &brush, &mut swath));
                }
                Shape::Line(lines) => {
                    for line in lines {
                        let line = self.followed(unroll::line(line.clone(), self.turn), false);
                        let places = self.radians(line.moved(0));
                        let is_ring = brush.is_ring(&places);
                        self.add(brush.stroke(&places, is_ring), &places, &mut swath);
                    }
                }
                Shape::Points(points) => {
                    let mut dots = Vec::new();
                    self.radians(points.iter().copied()).into_iter().for_each(|at| brush.dot(at, &mut dots));
                    self.add(dots, &[], &mut swath);
                }
                Shape::Swath { .. } => {}
            }
        }
        let (members, lines) = swath;
        Shape::Swath { members, lines }
    }

    fn outline(&self, rings: &[Vec<Plan>], brush: &Brush, swath: &mut Parts) {
        for ring in unroll::rings(rings.to_vec(), self.turn) {
            let ring = self.followed(ring, true);
            let mut places = self.radians(ring.moved(0));
            if let Some(first) = places.first().copied() {
                places.push(first + DVec2::new(ring.way_around() * self.radian(), 0.0));
            }
            self.add(brush.stroke(&places, true), &places, swath);
        }
    }

    fn radian(&self) -> f64 {
        std::f64::consts::TAU / self.turn.length
    }

    fn radians(&self, part: impl Iterator<Item = Plan>) -> Vec<DVec2> {
        part.map(|p| p.to_vec() * self.radian()).collect()
    }

    /// Adds rings and what they are the stroke of, in radians.
    fn add(&self, rings: Vec<Vec<DVec2>>, along: &[DVec2], (members, lines): &mut Parts) {
        let own = |part: &[DVec2]| part.iter().map(|p| Plan::from(*p / self.radian())).collect::<Vec<_>>();
        members.extend(rings.iter().map(|ring| vec![own(ring)]));
        lines.extend((!along.is_empty()).then(|| own(along)));
    }
}

/// Members, and lines.
type Parts = (Vec<Vec<Vec<Plan>>>, Vec<Vec<Plan>>);
