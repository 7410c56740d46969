//! The features of a file -> local coordinates of the plan: unrolled on the globe, cut off beyond the horizon of the projection, their
//! edges followed.
//!
//! Input: features in the file's coordinates, the map to the plan, the rectangle of the terrain. Output: the same in local coordinates.
//! Refuses: coordinates that are no place in the file's CRS; features without a place in the plan are left out, and only where that is
//! so for all of them it is an error.
//!
//! 1. In degrees and on Mercator's cylinder, rings and lines are unrolled ([`unroll`]), their edges made geodesics or rhumb lines where
//!    the layer says so ([`GroundCurves`]), and taken on those turns on which they come near the terrain.
//! 2. Into another projection, what lies beyond its horizon ([`Region::horizon`]) is cut off: it may have no place in the plan, or a
//!    wrong one. The cut runs farther from the terrain than any stroke reaches. Around a pole, where all meridians meet, it is a parallel.
//! 3. An edge that is straight in the file is a curve in the plan: it is followed ([`Follow`]).

use super::changes::Changes;
use super::cut::{self, Side};
use super::extent::{REACH, in_reach};
use super::follow::{Follow, long};
use super::ground_curve::GroundCurves;
use super::place::Map;
use super::unroll::{self, Unrolled};
use super::window::{Region, on_the_globe};
use crate::crs::{CurveKind, Geodesy, Turn};
use crate::error::{Error, Result};
use crate::math::max;
use crate::parallel;
use crate::scene::{Feature, Shape};
use crate::scene_file::Edges;
use crate::source::vector::MOST_TURNS;
use crate::space::{Plan, PlanBox};
use glam::DVec2;

/// Latitudes of a file may be so many quarter turns: what is beyond a pole is drawn nowhere.
const MOST_QUARTERS: f64 = 2.0;

/// Longitudes of more turns are told.
const USUAL_TURNS: f64 = 1.5;

/// Degrees beyond a pole that rounding and the outer edges of cells explain.
const BEYOND_A_POLE: f64 = 1.0;

/// Vertices of a parallel around a pole.
const PARALLEL: usize = 64;

/// What features are taken to.
pub(super) struct Onto {
    /// The terrain's rectangle, local.
    pub(super) terrain: PlanBox,
    /// What makes plan coordinates local ones.
    pub(super) shift: DVec2,
    /// How far features may cover beyond their vertices; `None` where that depends on the view.
    pub(super) reach: Option<f64>,
    /// Metres that a chord may be off a curve.
    pub(super) tolerance: f64,
    /// What edges are, ...
    pub(super) edges: Edges,
    /// ... and on the ground, where they are curves there.
    pub(super) on_the_ground: Option<(Geodesy, CurveKind)>,
    /// Metres of the plan in one on the ground, in the middle of the terrain.
    pub(super) stretch: f64,
}

/// Takes features to local coordinates; those of which nothing is near are left out. Notes tell what was changed.
pub(super) fn reproject(
    features: Vec<Feature>,
    map: &Map,
    onto: &Onto,
    notes: &mut Vec<String>,
) -> Result<Vec<Feature>> {
    let way = Way::new(map, onto);
    let numbers: Vec<usize> = features.iter().map(|feature| feature.index).collect();
    let count = numbers.chunk_by(|one, next| one == next).count();
    let taken = parallel::map_owned(features, |feature| way.taken(feature));
    let mut all = Vec::with_capacity(taken.len());
    let (mut changes, mut lost, mut first) = (Changes::default(), 0, None);
    for (k, feature) in taken.into_iter().enumerate() {
        // On a globe a feature's stroke follows its fill: what is told of features is told of one.
        let is_stroke_of_last = k > 0 && numbers[k - 1] == numbers[k];
        match feature? {
            Taken::Near(feature, _) if is_stroke_of_last => all.push(feature),
            Taken::Away(_) | Taken::Nowhere(_) if is_stroke_of_last => {}
            Taken::Near(feature, own) => {
                changes.add(&own);
                all.push(feature);
            }
            Taken::Away(own) => changes.add(&own),
            Taken::Nowhere(error) => {
                lost += 1;
                first.get_or_insert(error);
            }
        }
    }
    if let Some(error) = first {
        if lost == count {
            return Err(error);
        }
        notes.push(format!("{lost} of {count} features have no place in the plan and are left out: {error}"));
    }
    let tolerance = way.follow.as_ref().map_or(0.0, |follow| follow.tolerance);
    changes.tell(tolerance, way.curves.as_ref().map_or(("", 0.0), GroundCurves::words), notes);
    Ok(all)
}

fn too_far(p: Plan) -> Error {
    Error::new(format!("the place ({:e}, {:e}) is more than {REACH:e} m off", p.x, p.y))
        .help("check the file's coordinates, its CRS and the offsets; `where` leaves features out")
}

/// With the vertices of edges that are curves of the ground.
fn followed(part: Unrolled, is_ring: bool, curves: Option<&GroundCurves>, changes: &mut Changes) -> Unrolled {
    match curves {
        Some(curves) => curves.followed(part, is_ring, changes),
        None => part,
    }
}

/// What became of a feature.
enum Taken {
    Near(Feature, Changes),
    /// Nothing of it is near the terrain.
    Away(Changes),
    /// It has no place in the plan.
    Nowhere(Error),
}

/// What is known of a feature's coordinates.
enum Checked {
    /// They are places; whether one lies beyond a pole, and one unusually many turns off.
    Place { beyond: bool, turned: bool },
    /// One is so many turns off that nobody can have meant it.
    Nowhere(Error),
}

/// The way of a layer's features.
struct Way<'a> {
    map: &'a Map,
    shift: DVec2,
    /// What a turn of longitude is in the file's coordinates, where they have one and the plan has a CRS.
    turn: Option<Turn>,
    /// The box in the file's coordinates of what features must come near to be seen; `None`: unknown.
    near: Option<Region>,
    /// Where the map can be used; `None`: everywhere, or nobody knows.
    horizon: Option<Region>,
    follow: Option<Follow>,
    curves: Option<GroundCurves>,
}

impl<'a> Way<'a> {
    fn new(map: &'a Map, onto: &Onto) -> Self {
        let shift = onto.shift;
        let plain = Self { map, shift, turn: None, near: None, horizon: None, follow: None, curves: None };
        let Map::From(from) = map else { return plain };
        let turn = from.file().turn();
        let terrain = PlanBox { min: onto.terrain.min + -shift, max: onto.terrain.max + -shift };
        let size = onto.terrain.max - onto.terrain.min;
        let longest = max(size.x, size.y);
        let reach = onto.reach.unwrap_or(longest);
        // A hundredth, lest a feature that just touches be thrown away by rounding.
        let near = Region::of(from, &terrain.grown(reach + 0.01 * longest));
        // Where edges are followed twice, both may be off by half.
        let is_twice = onto.on_the_ground.is_some() && from.affine().is_none();
        let tolerance = onto.tolerance * if is_twice { 0.5 } else { 1.0 };
        let curves = onto.on_the_ground.clone().zip(turn);
        let curves = curves
            .map(|(kind, turn)| GroundCurves::new(kind, turn, tolerance / max(1.0, onto.stretch), near));
        if from.affine().is_some() {
            return Self { turn, near: near.filter(|_| turn.is_some()), curves, ..plain };
        }
        let horizon = Region::horizon(from, &terrain, reach + 0.1 * longest);
        let seam = || turn.map(|turn| Region::between_seams(from.central_meridian(), turn));
        let horizon = horizon.or_else(seam);
        let follow = (onto.edges != Edges::Straight).then(|| Follow {
            tolerance,
            near: terrain.grown(reach),
            long: long(from, horizon.as_ref(), turn),
        });
        Self { turn, near: near.filter(|_| onto.reach.is_some()), horizon, follow, curves, ..plain }
    }

    fn taken(&self, feature: Feature) -> Result<Taken> {
        let Feature { index, style, shape } = feature;
        let (mut changes, curves) = (Changes::default(), self.curves.as_ref());
        let (beyond, turned) = match self.checked(&shape).map_err(|error| error.in_feature(index))? {
            Checked::Place { beyond, turned } => (beyond, turned),
            Checked::Nowhere(error) => return Ok(Taken::Nowhere(error.in_feature(index))),
        };
        self.within_reach(&shape).map_err(|error| error.in_feature(index))?;
        let shape = match shape {
            Shape::Polygon(rings) => self.rings(rings, curves, &mut changes).map(Shape::Polygon),
            Shape::MultiPolygon(members) => {
                self.members(members, curves, &mut changes).map(Shape::MultiPolygon)
            }
            // Made here, and its edges with it: nothing that a person would look for in the file.
            Shape::Swath { members, lines } => {
                let own = &mut Changes::default();
                self.members(members, None, own).and_then(|members| {
                    self.lines(lines, None, own).map(|lines| Shape::Swath { members, lines })
                })
            }
            Shape::Line(lines) => self.lines(lines, curves, &mut changes).map(Shape::Line),
            Shape::Points(points) => self.points(points, &mut changes).map(Shape::Points),
        };
        changes.cut = changes.cut.min(1);
        changes.beyond = usize::from(beyond);
        changes.turned = usize::from(turned);
        Ok(match shape {
            Err(error) => Taken::Nowhere(error.in_feature(index)),
            Ok(shape) if shape.parts().all(Vec::is_empty) => Taken::Away(changes),
            Ok(shape) => Taken::Near(Feature { index, style, shape }, changes),
        })
    }

    /// Refuses coordinates so far from 0, or from the terrain's, that nothing near them could be told apart; those that are projected are left out there.
    fn within_reach(&self, shape: &Shape) -> Result<()> {
        let (scale, unit) = match self.map {
            Map::From(map) => match (map.affine(), self.turn) {
                (Some(affine), None) => (affine.scale, affine.origin),
                _ => return Ok(()),
            },
            Map::AsIs => (DVec2::ONE, DVec2::ZERO),
        };
        let place = |p: &Plan| (p.to_vec() - unit) * scale;
        let is_far = |p: &&Plan| {
            let (absolute, local) = (place(p), place(p) + self.shift);
            ![absolute.x, absolute.y, local.x, local.y].into_iter().all(in_reach)
        };
        shape.parts().flatten().find(is_far).map_or(Ok(()), |far| Err(too_far(*far)))
    }

    /// Refuses latitudes that are none; tells whether a vertex lies beyond a pole, or many turns off.
    fn checked(&self, shape: &Shape) -> Result<Checked> {
        let (mut beyond, mut turned) = (false, false);
        let (Some(turn), Map::From(map)) = (self.turn, self.map) else {
            return Ok(Checked::Place { beyond, turned });
        };
        // Of a stroke the line is as it is written, and its area is not.
        let lines: Vec<&Vec<Plan>> = match shape {
            Shape::Swath { lines, .. } => lines.iter().collect(),
            shape => shape.parts().collect(),
        };
        for p in lines.into_iter().flatten() {
            let (quarters, turns) = (p.y.abs() / turn.pole, p.x.abs() / turn.length);
            if quarters > MOST_QUARTERS {
                map.apply(p.to_vec())?;
            }
            if turns > MOST_TURNS {
                let words = format!("({}, {}) is not a place in {}", p.x, p.y, map.file().name());
                let help =
                    format!("places may be {MOST_TURNS} turns of longitude off: check the coordinates");
                return Ok(Checked::Nowhere(Error::new(words).help(help)));
            }
            beyond |= quarters > 1.0 + BEYOND_A_POLE / 90.0;
            turned |= turns > USUAL_TURNS;
        }
        Ok(Checked::Place { beyond, turned })
    }

    fn members(
        &self,
        members: Vec<Vec<Vec<Plan>>>,
        curves: Option<&GroundCurves>,
        changes: &mut Changes,
    ) -> Result<Vec<Vec<Vec<Plan>>>> {
        let moved = members.into_iter().map(|rings| self.rings(rings, curves, changes));
        moved.filter(|rings| !matches!(rings, Ok(rings) if rings.is_empty())).collect()
    }

    fn rings(
        &self,
        rings: Vec<Vec<Plan>>,
        curves: Option<&GroundCurves>,
        changes: &mut Changes,
    ) -> Result<Vec<Vec<Plan>>> {
        let mut near: Vec<(Vec<Plan>, f64)> = Vec::new();
        match self.turn {
            None => {
                let kept = rings.into_iter().filter_map(|ring| self.cut_ring(ring, changes));
                near.extend(kept.map(|ring| (ring, 0.0)));
            }
            Some(turn) => {
                for ring in unroll::rings(rings, turn) {
                    let ring = followed(ring, true, curves, changes);
                    changes.around += usize::from(ring.around != 0);
                    self.near_rings(&ring, turn.length, (&mut near, changes));
                }
            }
        }
        near.iter().map(|(ring, around)| self.placed(ring, Some(*around), changes)).collect()
    }

    fn lines(
        &self,
        lines: Vec<Vec<Plan>>,
        curves: Option<&GroundCurves>,
        changes: &mut Changes,
    ) -> Result<Vec<Vec<Plan>>> {
        let mut near: Vec<Vec<Plan>> = Vec::new();
        for line in lines {
            match self.turn {
                None => near.extend(self.cut_line(line, changes)),
                Some(turn) => {
                    let line = followed(unroll::line(line, turn), false, curves, changes);
                    self.near_lines(&line, turn.length, (&mut near, changes));
                }
            }
        }
        near.iter().map(|line| self.placed(line, None, changes)).collect()
    }

    /// Points, each a line that goes nowhere.
    fn points(&self, points: Vec<Plan>, changes: &mut Changes) -> Result<Vec<Plan>> {
        let lines = self.lines(points.into_iter().map(|p| vec![p, p]).collect(), None, changes)?;
        Ok(lines.iter().filter_map(|line| line.first().copied()).collect())
    }

    /// Adds what of a line in degrees is near.
    fn near_lines(&self, line: &Unrolled, turn: f64, (near, changes): (&mut Vec<Vec<Plan>>, &mut Changes)) {
        let Some(horizon) = self.horizon.filter(|horizon| horizon.pole != 0.0) else {
            for k in self.turns(&line.bounds(), turn) {
                near.extend(self.cut_line(line.moved(k).collect(), changes));
            }
            return;
        };
        let line: Vec<Plan> = line.moved(0).collect();
        if self.is_near_on_a_turn(&line, turn) {
            let parts = cut::line_beside(&line, towards_the_pole(&horizon));
            changes.cut += usize::from(parts.len() != 1 || parts[0].len() != line.len());
            near.extend(parts);
        }
    }

    /// Adds what of a ring in degrees is near.
    fn near_rings(
        &self,
        ring: &Unrolled,
        turn: f64,
        (near, changes): (&mut Vec<(Vec<Plan>, f64)>, &mut Changes),
    ) {
        match &self.horizon {
            Some(horizon) if horizon.pole != 0.0 => {
                self.around_a_pole(ring, horizon, turn, (near, changes));
            }
            _ => self.turned_rings(ring, turn, (near, changes)),
        }
    }

    /// A ring on all turns that matter, where they lie side by side.
    fn turned_rings(
        &self,
        ring: &Unrolled,
        turn: f64,
        (near, changes): (&mut Vec<(Vec<Plan>, f64)>, &mut Changes),
    ) {
        if ring.around != 0 {
            let bounds = self.horizon.or(self.near).map_or(ring.bounds(), |region| region.bounds);
            let chain = ring.chain(bounds.min.x, bounds.max.x);
            near.extend(self.cut_ring(chain, changes).map(|ring| (ring, 0.0)));
            return;
        }
        let bounds = ring.bounds();
        let turns = self.turns(&bounds, turn);
        // Of more than a turn, copies would lie on one another.
        let is_too_wide = bounds.max.x - bounds.min.x > turn && turns.clone().count() > 1;
        let east = Side { is_level: false, at: bounds.min.x + turn, above: false };
        for k in turns {
            let copy: Vec<Plan> = if is_too_wide {
                let by = DVec2::new(k as f64 * turn, 0.0);
                let whole: Vec<Plan> = ring.moved(0).collect();
                cut::ring_beside(&whole, 0.0, east).iter().map(|p| *p + by).collect()
            } else {
                ring.moved(k).collect()
            };
            near.extend(self.cut_ring(copy, changes).map(|ring| (ring, 0.0)));
        }
    }

    /// A ring on the disc around a pole, where turns are no more.
    fn around_a_pole(
        &self,
        ring: &Unrolled,
        horizon: &Region,
        turn: f64,
        (near, changes): (&mut Vec<(Vec<Plan>, f64)>, &mut Changes),
    ) {
        let (side, around) = (towards_the_pole(horizon), ring.way_around());
        let whole: Vec<Plan> = ring.moved(0).collect();
        if around == 0.0 && !self.is_near_on_a_turn(&whole, turn) {
            return;
        }
        let kept = cut::ring_beside(&whole, around, side);
        changes.cut += usize::from(kept.len() != whole.len());
        if around == 0.0 {
            near.extend(Some((kept, 0.0)).filter(|(kept, _)| kept.len() > 2));
            return;
        }
        let is_out = kept.is_empty();
        if !is_out {
            near.push((kept, around));
        }
        // What encloses the other pole is all of the disc that the ring does not enclose.
        if is_out == (ring.pole == horizon.pole) {
            let length = if is_out { around } else { -around };
            let west = horizon.bounds.min.x;
            let at = |k: usize| Plan::new(west + length * k as f64 / PARALLEL as f64, side.at);
            near.push(((0..PARALLEL).map(at).collect(), length));
        }
    }

    /// The turns on which something in a box comes near; the nearest one where it comes near on none and nothing may be left out.
    fn turns(&self, bounds: &PlanBox, turn: f64) -> std::ops::RangeInclusive<i64> {
        let Some(near) = self.near.or(self.horizon) else { return 0..=0 };
        let first = ((near.bounds.min.x - bounds.max.x) / turn).ceil() as i64;
        let last = ((near.bounds.max.x - bounds.min.x) / turn).floor() as i64;
        if first > last && self.horizon.is_none() {
            let off = (near.bounds.min.x + near.bounds.max.x - bounds.min.x - bounds.max.x) * 0.5;
            let nearest = (off / turn).round() as i64;
            return nearest..=nearest;
        }
        first..=last
    }

    fn is_near_on_a_turn(&self, part: &[Plan], turn: f64) -> bool {
        let Some(near) = self.near else { return true };
        let bounds = PlanBox::around(part.iter().copied());
        let is_level = if near.pole > 0.0 {
            bounds.max.y >= near.bounds.min.y
        } else if near.pole < 0.0 {
            bounds.min.y <= near.bounds.max.y
        } else {
            bounds.min.y <= near.bounds.max.y && near.bounds.min.y <= bounds.max.y
        };
        is_level && (near.pole != 0.0 || !self.turns(&bounds, turn).is_empty())
    }

    /// A ring inside the horizon; nothing of one that is not near.
    fn cut_ring(&self, ring: Vec<Plan>, changes: &mut Changes) -> Option<Vec<Plan>> {
        let Some(horizon) = &self.horizon else { return Some(ring) };
        let bounds = PlanBox::around(ring.iter().copied());
        if horizon.bounds.contains(&bounds) {
            return Some(ring).filter(|_| self.may_be_near(&bounds));
        }
        let is_there = horizon.bounds.meets(&bounds) && self.may_be_near(&bounds);
        let cut = Some(ring).filter(|_| is_there).map(|ring| cut::ring(ring, &horizon.bounds));
        let cut = cut.filter(|ring| ring.len() > 2);
        changes.cut += usize::from(cut.is_some());
        cut
    }

    fn cut_line(&self, line: Vec<Plan>, changes: &mut Changes) -> Vec<Vec<Plan>> {
        let Some(horizon) = &self.horizon else { return vec![line] };
        let bounds = PlanBox::around(line.iter().copied());
        if !(self.may_be_near(&bounds) && horizon.bounds.meets(&bounds)) {
            return Vec::new();
        }
        if horizon.bounds.contains(&bounds) {
            return vec![line];
        }
        let parts = cut::line(line, &horizon.bounds);
        changes.cut += usize::from(!parts.is_empty());
        parts
    }

    fn may_be_near(&self, bounds: &PlanBox) -> bool {
        self.near.is_none_or(|near| near.bounds.meets(bounds))
    }

    /// A part in local coordinates. `around`: of a ring, what its closing edge adds to the first vertex's longitude.
    fn placed(&self, part: &[Plan], around: Option<f64>, changes: &mut Changes) -> Result<Vec<Plan>> {
        let place = |p: Plan| self.place(p);
        let mut all = Vec::with_capacity(part.len());
        for (k, &from) in part.iter().enumerate() {
            let here = place(from)?;
            all.push(here);
            let Some(follow) = &self.follow else { continue };
            let to = match (part.get(k + 1), around) {
                (Some(next), _) => *next,
                (None, Some(around)) => part[0] + DVec2::new(around, 0.0),
                (None, None) => break,
            };
            let before = all.len();
            follow.between((from, here), (to, place(to)?), &place, &mut all)?;
            changes.edges += usize::from(all.len() > before);
            changes.along += all.len() - before;
        }
        let mut local = all.into_iter().map(|p| p + self.shift);
        let is_near = |p: Plan| in_reach(p.x) && in_reach(p.y);
        local.try_fold(Vec::with_capacity(part.len()), |mut all, p| {
            if !is_near(p) {
                return Err(too_far(p));
            }
            all.push(p);
            Ok(all)
        })
    }

    /// A place of the plan.
    fn place(&self, p: Plan) -> Result<Plan> {
        let Map::From(map) = self.map else { return Ok(p) };
        let (Some(turn), None) = (self.turn, map.affine()) else {
            return map.apply_unrolled(p.to_vec()).map(Plan::from);
        };
        let mut p = on_the_globe(p.to_vec(), Some(turn));
        if let Some(horizon) = self.horizon.filter(|horizon| horizon.pole != 0.0) {
            // Both ends of a turn are one place.
            p.x -= turn.length * ((p.x - horizon.bounds.min.x) / turn.length).floor();
        }
        map.apply_unrolled(p).map(Plan::from)
    }
}

/// The side of a horizon's parallel on which the pole is.
fn towards_the_pole(horizon: &Region) -> Side {
    let above = horizon.pole > 0.0;
    let at = if above { horizon.bounds.min.y } else { horizon.bounds.max.y };
    Side { is_level: true, at, above }
}
