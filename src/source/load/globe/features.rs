//! The features of a layer on a globe: in longitude and latitude of its CRS, their strokes as areas.

use super::super::blame::of_key;
use super::super::changes::Changes;
use super::super::follow::Follow;
use super::super::ground_curve::GroundCurves;
use super::super::place::Map;
use super::super::unroll::{self, Unrolled};
use super::super::window::on_the_globe;
use super::stroke::Brush;
use super::way::{OverTheGround, evenly, in_steps};
use crate::crs::{PlanFrom, Turn};
use crate::error::{Error, Result};
use crate::math::{cos, max};
use crate::parallel;
use crate::scene::{Cap, Dash, Dashed, Feature, Fill, Line, OutlineMode, Rule, Shape, Style, Swath, Width};
use crate::scene_file::{Edges, LayerSpec, SceneFile};
use crate::space::{Ellipsoid, Globe, Plan, PlanBox};
use glam::DVec2;

/// The most dashes of a layer: each is an area, or a line.
const MOST_DASHES: f64 = (1 << 22) as f64;

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
            let is_area = matches!(line.width, Width::Metres(_));
            if is_area && spec.style.fill.as_ref().is_some_and(|fill| fill.is_inverted) {
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

/// Features with their strokes, each after its feature's fill, and the styles of both: of a width in metres an area on the ground, of one in pixels the lines
/// that it is along.
pub(in crate::source::load) fn stroked(
    features: Vec<Feature>,
    styles: Vec<Style>,
    ground: &Strokes,
) -> Result<(Vec<Feature>, Vec<Style>)> {
    let fills = styles.iter().map(|style| Style { fill: style.fill, ..Style::default() });
    let mut all: Vec<Style> = fills.collect();
    // Of each style its outline's, its line's, its points', where it has them.
    let mut strokes = Vec::with_capacity(styles.len());
    for style in &styles {
        let round = |point: Line| Line { cap: Cap::Round, ..point };
        let kinds = [
            (style.outline.map(|outline| outline.line), style.outline_dash),
            (style.line, style.line_dash),
            (style.point.map(round), None),
        ];
        strokes.push([0, 1, 2].map(|kind| {
            let (line, dash) = kinds[kind];
            line.map(|line| {
                all.push(style_of(line, kind == 2));
                Stroke { line, dash, style: all.len() as u32 - 1 }
            })
        }));
    }
    let used = |feature: &Feature| {
        let [outline, line, point] = strokes[feature.style as usize];
        match &feature.shape {
            Shape::Polygon(_) | Shape::MultiPolygon(_) => outline,
            Shape::Line(_) => line,
            Shape::Points(_) => point,
            Shape::Swath { .. } => None,
        }
    };
    ground.check_dashes(&features, used)?;
    let made = parallel::map_owned(features, |feature| {
        let stroke = used(&feature).map(|stroke| {
            let shape = ground.shape(&feature.shape, &stroke);
            Feature { index: feature.index, style: stroke.style, shape }
        });
        let fill = Some(feature).filter(|feature| feature.shape.is_area());
        [fill, stroke]
    });
    Ok((made.into_iter().flatten().flatten().collect(), all))
}

/// How a stroke looks on a globe.
fn style_of(line: Line, is_of_points: bool) -> Style {
    match line.width {
        Width::Metres(width_m) => Style {
            fill: Some(Fill { color: line.color, rule: Rule::NonZero }),
            swath: Some(Swath { width_m, is_of_points }),
            ..Style::default()
        },
        Width::Pixels(_) if is_of_points => Style { point: Some(line), ..Style::default() },
        Width::Pixels(_) => Style { line: Some(line), ..Style::default() },
    }
}

/// A stroke of a style.
#[derive(Clone, Copy)]
struct Stroke {
    line: Line,
    dash: Option<Dash>,
    /// The style of what it becomes.
    style: u32,
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

    /// Refuses features with more dashes than may be made.
    fn check_dashes(&self, features: &[Feature], used: impl Fn(&Feature) -> Option<Stroke>) -> Result<()> {
        let mut all = 0.0;
        for feature in features {
            let Some(Stroke { dash: Some(dash), .. }) = used(feature) else { continue };
            let is_area = feature.shape.is_area();
            for part in feature.shape.parts() {
                let closing = part.last().zip(part.first()).filter(|_| is_area);
                let steps =
                    part.windows(2).map(|ends| (ends[0], ends[1])).chain(closing.map(|(a, b)| (*a, *b)));
                // No radian of latitude or longitude is longer than that of a sphere around all of the ellipsoid, at a pole.
                let radian = self.ellipsoid.a / (1.0 - self.ellipsoid.f);
                let length = steps.map(|(a, b)| (b - a).length()).sum::<f64>() * self.radian() * radian;
                all += (length / dash.period() + 2.0) * dash.lengths().len() as f64 / 2.0;
            }
            if all > MOST_DASHES {
                let error = Error::unsupported(
                    "more than 2^22 dashes up to here, each of them an area on the ground",
                );
                let help = "make the numbers of `dash` larger, or leave features out with `where`";
                return Err(error.help(help).in_feature(feature.index));
            }
        }
        Ok(())
    }

    /// A shape's stroke: an area, each member a ring, and what it is along; or lines.
    fn shape(&self, shape: &Shape, stroke: &Stroke) -> Shape {
        let paths = self.paths(shape, stroke.dash);
        let own = |path: &[DVec2]| path.iter().map(|p| Plan::from(*p / self.radian())).collect::<Vec<_>>();
        let Width::Metres(width) = stroke.line.width else {
            return match shape {
                Shape::Points(_) => Shape::Points(paths.iter().flat_map(|path| own(&path.places)).collect()),
                _ => Shape::Line(paths.iter().map(|path| own(&in_steps(&evenly(&path.places)))).collect()),
            };
        };
        let brush = Brush::new(self.ellipsoid, width, stroke.line.join, stroke.line.cap);
        let (mut members, mut lines) = (Vec::new(), Vec::new());
        for Path { places, is_joined } in &paths {
            members.extend(brush.stroke(places, *is_joined).iter().map(|ring| vec![own(ring)]));
            if !matches!(shape, Shape::Points(_)) {
                lines.push(own(places));
            }
        }
        Shape::Swath { members, lines }
    }

    /// What a stroke is along.
    fn paths(&self, shape: &Shape, dash: Option<Dash>) -> Vec<Path> {
        let mut all = Vec::new();
        match shape {
            Shape::Polygon(of) => self.add_rings(of, dash, &mut all),
            Shape::MultiPolygon(members) => {
                members.iter().for_each(|of| self.add_rings(of, dash, &mut all));
            }
            Shape::Line(lines) => {
                for line in lines {
                    let line = self.followed(unroll::line(line.clone(), self.turn), false);
                    let places = self.radians(line.moved(0));
                    let is_joined = OverTheGround(self.ellipsoid).is_ring(&places);
                    self.add(Path { places, is_joined }, dash, &mut all);
                }
            }
            Shape::Points(points) => {
                let places = self.radians(points.iter().copied()).into_iter();
                all.extend(places.map(|place| Path { places: vec![place], is_joined: false }));
            }
            Shape::Swath { .. } => {}
        }
        all
    }

    fn add_rings(&self, rings: &[Vec<Plan>], dash: Option<Dash>, all: &mut Vec<Path>) {
        for ring in unroll::rings(rings.to_vec(), self.turn) {
            let ring = self.followed(ring, true);
            let mut places = self.radians(ring.moved(0));
            if let Some(first) = places.first().copied() {
                places.push(first + DVec2::new(ring.way_around() * self.radian(), 0.0));
            }
            self.add(Path { places, is_joined: true }, dash, all);
        }
    }

    /// Adds a path, or the dashes along it.
    fn add(&self, path: Path, dash: Option<Dash>, all: &mut Vec<Path>) {
        if path.places.is_empty() {
            return;
        }
        let measure = OverTheGround(self.ellipsoid);
        match dash.map(|dash| dash.along(&in_steps(&path.places), path.is_joined, &measure)) {
            None | Some(Dashed::Whole) => all.push(path),
            Some(Dashed::Parts(parts)) => {
                all.extend(parts.into_iter().map(|places| Path { places, is_joined: false }));
            }
        }
    }

    fn radian(&self) -> f64 {
        std::f64::consts::TAU / self.turn.length
    }

    fn radians(&self, part: impl Iterator<Item = Plan>) -> Vec<DVec2> {
        part.map(|p| p.to_vec() * self.radian()).collect()
    }
}

/// What a stroke is along, in radians.
struct Path {
    places: Vec<DVec2>,
    /// Whether it ends where it begins, maybe a turn on, and is joined there.
    is_joined: bool,
}
