//! A stroke's segment as convex shapes and discs: its rectangle, the join at its start, its caps.

use super::primitive::{Convex, HalfPlane, Primitive};
use super::{Away, PixelSize, grows_with_distance};
use crate::draw_list::Role;
use crate::interval::Ball;
use crate::math;
use crate::predicate::orient2d;
use crate::scene::{Cap, Join, Line, Width};
use crate::space::{DISC_CORNERS, Plan, disc_corners};
use glam::DVec2;

/// What strokes are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Strokes {
    /// What their style says: the definition (`docs/semantics.md`).
    #[default]
    Style,
    /// A rectangle a segment, square caps, and nothing else (Schneider & Klein 2007, 4.1: "each line segment separately"). Points have no
    /// segments: they are as in [`Strokes::Polygons`].
    Rectangles,
    /// What their style says, of polygons: a disc has [`DISC_CORNERS`] corners.
    Polygons,
    /// Those of static decals (Zechmeister 2020).
    Decals {
        /// Miters without a limit down to 40 degrees between segments, below that and at ends discs (4.2.1); else what the style says.
        is_round_below_40: bool,
        /// Outlines are cut to their polygon by the side of each segment (Fig. 4.8); else by the polygon.
        is_cut_by_side: bool,
        /// Those whose widths are in pixels are left out: they are no static lines (3.4.1).
        in_metres_alone: bool,
    },
}

impl Strokes {
    fn is_round_below_40(self) -> bool {
        matches!(self, Self::Decals { is_round_below_40: true, .. })
    }

    /// Those of items of a role.
    pub(super) fn of(self, role: Role) -> Self {
        match (self, role) {
            (Self::Rectangles, Role::Point) => Self::Polygons,
            _ => self,
        }
    }

    /// Whether a stroke is left out.
    fn leaves_out(self, line: &Line) -> bool {
        matches!((self, line.width), (Self::Decals { in_metres_alone: true, .. }, Width::Pixels(_)))
    }

    /// Whether outlines are cut by the sides of segments.
    pub(super) fn is_cut_by_side(self) -> bool {
        matches!(self, Self::Decals { is_cut_by_side: true, .. })
    }
}

/// A segment of a stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Segment {
    /// The vertex before it; `None` at a line's start.
    pub(super) before: Option<Plan>,
    /// Where it starts.
    pub(super) from: Plan,
    /// Where it ends; where it starts for a line of one point.
    pub(super) to: Plan,
    /// Whether the line ends with it.
    pub(super) is_last: bool,
}

/// Half the width in metres, and by how much it grows with the distance from the eye.
fn half_width(line: &Line, pixel: &PixelSize) -> (f64, f64) {
    match line.width {
        Width::Metres(width) => (width / 2.0, 0.0),
        Width::Pixels(width) if pixel.eye.is_some() => (0.0, width / 2.0 * pixel.pixel),
        Width::Pixels(width) => (width / 2.0 * pixel.pixel, 0.0),
    }
}

/// How far from the bare segment all that [`primitives`] gives may lie, in each coordinate; `None`: there is nothing.
pub(super) fn reach(
    segment: &Segment,
    line: &Line,
    (pixel, strokes): (&PixelSize, Strokes),
) -> Option<DVec2> {
    if strokes.leaves_out(line) {
        return None;
    }
    let (half, growth) = half_width(line, pixel);
    let reach = match (line.join, line.width) {
        (_, Width::Pixels(_)) if grows_with_distance(line, pixel) => dynamic_reach(segment, growth, pixel),
        (Join::Miter { .. }, Width::Metres(_)) if strokes.is_round_below_40() => half * REACH_OF_40,
        (Join::Miter { limit }, Width::Metres(_)) => half * math::max(limit, std::f64::consts::SQRT_2),
        _ => half * std::f64::consts::SQRT_2,
    };
    // The rounding of these few operations is far below this share.
    let reach = reach * (1.0 + 1e-9) + 1e-9;
    Some(match line.width {
        Width::Metres(_) => DVec2::splat(reach),
        Width::Pixels(_) => pixel.in_plan(reach, segment.from, segment.to),
    })
}

/// How far a stroke reaches whose half width is `growth` times the distance r of the surface point from the eye.
fn dynamic_reach(segment: &Segment, growth: f64, pixel: &PixelSize) -> f64 {
    match pixel.away {
        Away::Within(farthest) => growth * farthest,
        Away::Over(height) => {
            // r <= distance of the segment + reach + height, and reach = growth * r.
            let eye = pixel.eye.unwrap_or_default().plan();
            let farthest = math::max((segment.from - eye).length(), (segment.to - eye).length());
            let reach = growth * (farthest + height) / (1.0 - growth);
            if growth < 1.0 { reach } else { f64::INFINITY }
        }
    }
}

/// More than a miter of 40 degrees reaches, in half widths: 1 / sin(20 degrees).
const REACH_OF_40: f64 = 2.93;

/// The cosine of 40 degrees.
const COS_40: f64 = 0.766_044_443_118_978;

/// What a segment's stroke is made of.
pub(super) fn primitives(
    segment: &Segment,
    line: &Line,
    (pixel, strokes): (&PixelSize, Strokes),
    out: &mut Vec<Primitive>,
) {
    let (half, growth) = half_width(line, pixel);
    let (from, to) = (segment.from, segment.to);
    if let Width::Pixels(_) = line.width {
        // A dynamic line is all points near its centre line: caps and joins are round by definition.
        let scale = pixel.scale(from, to);
        out.push(Primitive::Near { from, to, scale, reach: half, growth });
        return;
    }
    let disc = |at: Plan, out: &mut Vec<Primitive>| match strokes {
        Strokes::Polygons => out.extend(disc_slabs(at, half).map(Primitive::Convex)),
        _ => out.push(Primitive::disc(at, half)),
    };
    let cap = match (strokes, line.cap) {
        _ if strokes.is_round_below_40() => Cap::Round,
        (Strokes::Rectangles, Cap::Round) => Cap::Butt,
        (_, cap) => cap,
    };
    if from == to {
        match cap {
            Cap::Square if strokes != Strokes::Rectangles => out.push(dot(from, half)),
            Cap::Round => disc(from, out),
            _ => {}
        }
        return;
    }
    let along = Direction::new(from, to);
    out.push(rectangle(segment, &along, half, cap));
    if cap == Cap::Round {
        if segment.before.is_none() {
            disc(from, out);
        }
        if segment.is_last {
            disc(to, out);
        }
    }
    let Some(before) = segment.before else { return };
    match (strokes, line.join) {
        (Strokes::Rectangles, _) => {}
        (_, Join::Round) => disc(from, out),
        (_, Join::Miter { .. }) if strokes.is_round_below_40() => round_below_40(before, from, to, half, out),
        (_, Join::Miter { limit }) => join(before, from, to, half, Some(limit), out),
        (_, Join::Bevel) => join(before, from, to, half, None, out),
    }
}

/// The part of a segment's stroke that lies on one side of it (Zechmeister 2020, 4.4.1: a sample is in the outline if it is on the polygon's side of a
/// segment that holds it). `is_left`: which; `None`: it is not known.
pub(super) fn side_primitives(
    segment: &Segment,
    line: &Line,
    of: (&PixelSize, Strokes),
    is_left: Option<bool>,
    out: &mut Vec<Primitive>,
) {
    let mut whole = Vec::new();
    primitives(segment, line, of, &mut whole);
    let (half, _) = half_width(line, of.0);
    if line.join == Join::Round && !segment.is_last {
        // A round join is of both segments, and each has a side of its own.
        whole.push(Primitive::disc(segment.to, half));
    }
    let [along, ..] = Primitive::edge_sides(segment.from, segment.to);
    let right = HalfPlane { normal: along.normal.map(|n| -n), ..along };
    for (side, is_wanted) in [(along, is_left != Some(false)), (right, is_left != Some(true))] {
        let mut add = |shape: &Convex, is_sure: bool| {
            let part = shape.cut(side);
            out.push(if is_sure && is_left.is_some() {
                Primitive::Convex(part)
            } else {
                Primitive::Perhaps(part)
            });
        };
        for primitive in whole.iter().filter(|_| is_wanted) {
            match primitive {
                Primitive::Convex(shape) => add(shape, true),
                Primitive::Perhaps(shape) => add(shape, false),
                Primitive::Near { from, reach, .. } => {
                    // A disc lies between two polygons.
                    let around = reach / math::cos(std::f64::consts::PI / DISC_CORNERS as f64) * (1.0 + 1e-9);
                    for (radius, is_sure) in [(*reach, true), (around, false)] {
                        disc_slabs(*from, radius).iter().for_each(|slab| add(slab, is_sure));
                    }
                }
                Primitive::Edge { .. } => {}
            }
        }
    }
}

/// A join of static decals.
fn round_below_40(before: Plan, at: Plan, after: Plan, half: f64, out: &mut Vec<Primitive>) {
    let (into, leaving) = (at - before, after - at);
    let lengths = into.length() * leaving.length();
    let excess = -into.dot(leaving) - COS_40 * lengths;
    let disc = Primitive::disc(at, half);
    // Far more than the rounding of these few operations.
    let doubt = 1e-12 * lengths;
    if excess > doubt {
        return out.push(disc);
    }
    let first = out.len();
    join(before, at, after, half, Some(4.0), out);
    if excess > -doubt {
        for primitive in &mut out[first..] {
            if let Primitive::Convex(shape) = *primitive {
                *primitive = Primitive::Perhaps(shape);
            }
        }
    }
}

/// A disc as a polygon, in slabs between opposite sides.
fn disc_slabs(at: Plan, radius: f64) -> [Convex; DISC_CORNERS / 2 - 1] {
    let corners = disc_corners(at, radius);
    std::array::from_fn(|k| {
        let opposite = DISC_CORNERS - 1 - k;
        let ring = [corners[k], corners[k + 1], corners[opposite - 1], corners[opposite]];
        let side = |a: Plan, b: Plan| {
            let (x, y) = (Ball::exact(b.x) - Ball::exact(a.x), Ball::exact(b.y) - Ball::exact(a.y));
            HalfPlane { at: a, normal: [-y, x], offset: Ball::ZERO }
        };
        let turn = if orient2d(ring[0], ring[1], ring[2]) < 0.0 { [3, 2, 1, 0] } else { [0, 1, 2, 3] };
        let [a, b, c, d] = turn.map(|k| ring[k]);
        Convex::new(&[side(a, b), side(b, c), side(c, d), side(d, a)])
    })
}

/// A square whose sides lie along the axes: the dot of a line that has no direction.
fn dot(at: Plan, half: f64) -> Primitive {
    let side = |x: f64, y: f64| HalfPlane {
        at,
        normal: [Ball::exact(x), Ball::exact(y)],
        offset: Ball::exact(half),
    };
    Primitive::Convex(Convex::new(&[side(1.0, 0.0), side(-1.0, 0.0), side(0.0, 1.0), side(0.0, -1.0)]))
}

/// A unit direction in balls, and a point to measure from.
struct Direction {
    at: Plan,
    unit: [Ball; 2],
    length: Ball,
}

impl Direction {
    fn new(from: Plan, to: Plan) -> Self {
        let x = Ball::exact(to.x) - Ball::exact(from.x);
        let y = Ball::exact(to.y) - Ball::exact(from.y);
        let length = (x.squared() + y.squared()).sqrt();
        let by = length.recip();
        Self { at: from, unit: [x * by, y * by], length }
    }

    /// The normal on the left.
    fn left(&self) -> [Ball; 2] {
        [-self.unit[1], self.unit[0]]
    }
}

fn negated(v: [Ball; 2]) -> [Ball; 2] {
    v.map(|c| -c)
}

fn plus(a: [Ball; 2], b: [Ball; 2]) -> [Ball; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

fn dot_product(a: [Ball; 2], b: [Ball; 2]) -> Ball {
    a[0] * b[0] + a[1] * b[1]
}

/// The segment's rectangle, with its square caps.
fn rectangle(segment: &Segment, along: &Direction, half: f64, cap: Cap) -> Primitive {
    let cap_length = |ends: bool| Ball::exact(if ends && cap == Cap::Square { half } else { 0.0 });
    let side = |normal: [Ball; 2], offset: Ball| HalfPlane { at: along.at, normal, offset };
    Primitive::Convex(Convex::new(&[
        side(along.left(), Ball::exact(half)),
        side(negated(along.left()), Ball::exact(half)),
        side(along.unit, cap_length(segment.before.is_none())),
        side(negated(along.unit), along.length + cap_length(segment.is_last)),
    ]))
}

/// The join at a vertex: the wedge between the ends of two rectangles on the outer side of the turn, cut where the outer sides
/// meet (a miter within its limit) or by the chord between their corners (a bevel).
fn join(before: Plan, at: Plan, after: Plan, half: f64, limit: Option<f64>, out: &mut Vec<Primitive>) {
    let (into, leaving) = (Direction::new(before, at), Direction::new(at, after));
    let turn = orient2d(before, at, after);
    if turn == 0.0 {
        // Straight on: nothing between. Straight back: the bevel has no area, and a miter is over any limit.
        return;
    }
    let outer = |d: &Direction| if turn > 0.0 { negated(d.left()) } else { d.left() };
    let (n1, n2) = (outer(&into), outer(&leaving));
    let side = |normal: [Ball; 2], offset: Ball| HalfPlane { at, normal, offset };
    let wedge = [side(into.unit, Ball::ZERO), side(negated(leaving.unit), Ball::ZERO)];
    let cosine = dot_product(into.unit, leaving.unit);
    let bevel = {
        // The chord's normal is n1 + n2, or along d1 - d2, which does not vanish where the line turns back.
        let (normal, offset) = if cosine.mid > 0.0 {
            (negated(plus(n1, n2)), (Ball::exact(1.0) + cosine) * half)
        } else {
            let sine = into.unit[0] * leaving.unit[1] - into.unit[1] * leaving.unit[0];
            let sine = if turn > 0.0 { sine } else { -sine };
            (plus(leaving.unit, negated(into.unit)), sine * half)
        };
        Convex::new(&[wedge[0], wedge[1], side(normal, offset)])
    };
    let half = Ball::exact(half);
    let miter = Convex::new(&[wedge[0], wedge[1], side(negated(n1), half), side(negated(n2), half)]);
    // The ratio of miter length to width is 1 / cos(turn / 2), its square 2 / (1 + cos turn).
    let excess =
        limit.map(|limit| Ball::exact(2.0) - (Ball::exact(1.0) + cosine) * Ball::exact(limit).squared());
    match excess {
        Some(excess) if excess.is_negative() => out.push(Primitive::Convex(miter)),
        Some(excess) if !excess.is_positive() => {
            out.extend([Primitive::Convex(bevel), Primitive::Perhaps(miter)]);
        }
        _ => out.push(Primitive::Convex(bevel)),
    }
}
