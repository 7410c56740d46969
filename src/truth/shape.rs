//! Primitives of footprints as they lie on a pixel: straight ones as lines, round ones by bounds of their distance.

use super::facet::{Facet, Hit};
use super::form::{Form, Line, Side};
use super::polygon::middle;
use super::tile_rays::TileRays;
use crate::footprint::{HalfPlane, MOST_SIDES, PixelSize, Primitive};
use crate::interval::Ball;
use crate::math;
use crate::space::{Plan, PlanBox};
use glam::{DVec2, DVec3};

/// A primitive on a pixel.
#[derive(Debug, Clone, Copy)]
pub(super) enum PixelPrimitive {
    /// A polygon's edge: the line along it, and those across it at its ends (the edge lies on their inner sides).
    Edge { along: Line, ends: [Line; 2] },
    /// A convex part of a stroke; `is_sure` is false for one that may not be there.
    Convex { sides: [Line; MOST_SIDES], count: usize, is_sure: bool },
    /// All within a distance of a segment.
    Near(Near),
}

/// A primitive on a triangle: the same for all pixels of a tile that see the triangle.
#[derive(Debug, Clone, Copy)]
pub(super) enum FacetPrimitive {
    /// As [`PixelPrimitive::Edge`]: along it, and at its ends.
    Edge([Form; 3]),
    /// As [`PixelPrimitive::Convex`].
    Convex { sides: [Form; MOST_SIDES], count: usize, is_sure: bool },
    /// As [`PixelPrimitive::Near`].
    Near(Near),
}

/// The plan points within `reach + growth * r` of a segment, r their distance from the eye.
#[derive(Debug, Clone, Copy)]
pub(super) struct Near {
    /// Its ends, scaled.
    from: Plan,
    to: Plan,
    /// Coordinates are so many times as large.
    scale: DVec2,
    reach: f64,
    growth: f64,
}

/// Where a piece lies of a primitive, and how it is best cut.
#[derive(Debug, Clone, Copy)]
pub(super) enum Verdict {
    /// All of it in the stroke's part.
    In,
    /// None of it; or no edge crosses it.
    Out,
    /// It is best cut.
    Cut(Cut),
    /// It cannot be told.
    Stuck,
}

/// How a piece is best cut.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cut {
    /// Here.
    pub(super) line: Line,
    /// About how far the piece's middle lies within the primitive, pixels; negative: beyond it.
    pub(super) depth: f64,
}

/// What is needed to bring plan geometry to a pixel.
#[derive(Debug, Clone, Copy)]
pub(super) struct PixelGround<'a> {
    pub(super) rays: &'a TileRays,
    pub(super) facet: &'a Facet,
    /// The pixel's corner in the tile.
    pub(super) pixel: [f64; 2],
    pub(super) size: PixelSize,
}

impl PixelGround<'_> {
    /// The line on the pixel where the visible points' plan points cross a half plane's border.
    pub(super) fn line(&self, of: &HalfPlane) -> Line {
        self.on_pixel(&self.form(of))
    }

    /// The function whose sign tells on which side of a half plane's border a visible point's plan point lies.
    fn form(&self, of: &HalfPlane) -> Form {
        self.facet.half_plane(self.rays, of).plain(self.rays.span)
    }

    #[inline]
    fn on_pixel(&self, form: &Form) -> Line {
        form.seen_from(self.pixel).line()
    }

    /// Where a point of the pixel lies in the plan.
    pub(super) fn hit(&self, [x, y]: [f64; 2]) -> Hit {
        self.facet.hit(self.rays, [self.pixel[0] + x, self.pixel[1] + y])
    }

    /// A box of the plan around what a piece sees.
    pub(super) fn plan_box(&self, piece: &[[f64; 2]]) -> PlanBox {
        let mut plan = PlanBox::EMPTY;
        for p in piece {
            let hit = self.hit(*p);
            if hit.error >= MOST_ERROR {
                return self.facet.plan();
            }
            let margin = DVec2::splat(hit.error * 2.0);
            plan.include(hit.plan + margin);
            plan.include(hit.plan + -margin);
        }
        plan
    }

    /// A line through the middle of a piece, across the direction in which more of the plan is seen.
    pub(super) fn halving_line(&self, piece: &[[f64; 2]]) -> Line {
        let size = PlanBox::around(piece.iter().map(|p| Plan::new(p[0], p[1])));
        let (middle, half) = ((size.min.to_vec() + size.max.to_vec()) / 2.0, (size.max - size.min) / 2.0);
        let seen = |by: DVec2| {
            (self.hit((middle + by).to_array()).plan - self.hit((middle - by).to_array()).plan).length()
        };
        let (across, down) = (seen(half * DVec2::X), seen(half * DVec2::Y));
        if across > down { Line::upright(middle.x) } else { Line::level(middle.y) }
    }

    /// A primitive on the triangle.
    pub(super) fn on_facet(&self, of: &Primitive) -> FacetPrimitive {
        let convex = |sides: &[HalfPlane], is_sure| {
            let mut forms = [self.form(&sides[0]); MOST_SIDES];
            for (form, side) in forms[1..].iter_mut().zip(&sides[1..]) {
                *form = self.form(side);
            }
            FacetPrimitive::Convex { sides: forms, count: sides.len(), is_sure }
        };
        match of {
            Primitive::Edge { from, to } => {
                FacetPrimitive::Edge(Primitive::edge_sides(*from, *to).map(|side| self.form(&side)))
            }
            Primitive::Convex(shape) => convex(shape.sides(), true),
            Primitive::Perhaps(shape) => convex(shape.sides(), false),
            Primitive::Near { from, to, scale, reach, growth } => {
                let [from, to] = [from, to].map(|p| Plan::from(p.to_vec() * *scale));
                FacetPrimitive::Near(Near { from, to, scale: *scale, reach: *reach, growth: *growth })
            }
        }
    }

    /// A primitive on the pixel.
    pub(super) fn shape(&self, of: &FacetPrimitive) -> PixelPrimitive {
        match of {
            FacetPrimitive::Edge([along, start, end]) => PixelPrimitive::Edge {
                along: self.on_pixel(along),
                ends: [self.on_pixel(start), self.on_pixel(end)],
            },
            FacetPrimitive::Convex { sides, count, is_sure } => {
                let mut lines = [self.on_pixel(&sides[0]); MOST_SIDES];
                for (line, form) in lines[1..*count].iter_mut().zip(&sides[1..]) {
                    *line = self.on_pixel(form);
                }
                PixelPrimitive::Convex { sides: lines, count: *count, is_sure: *is_sure }
            }
            FacetPrimitive::Near(near) => PixelPrimitive::Near(*near),
        }
    }
}

impl PixelPrimitive {
    /// Where a piece lies. `slop` grows by the area that the lines' uncertainty makes doubtful.
    pub(super) fn verdict(&self, ground: &PixelGround, piece: &[[f64; 2]], slop: &mut f64) -> Verdict {
        match self {
            Self::Edge { along, ends } => {
                for end in ends {
                    if end.side(piece, slop) == Side::Out {
                        return Verdict::Out;
                    }
                }
                match along.side(piece, slop) {
                    Side::Both => Verdict::Cut(Cut { line: *along, depth: along.at(middle(piece)) }),
                    Side::Unknown => Verdict::Stuck,
                    Side::In | Side::Out => Verdict::Out,
                }
            }
            Self::Convex { sides, count, is_sure } => {
                let verdict = convex_verdict(&sides[..*count], piece, slop);
                if !is_sure && matches!(verdict, Verdict::In) { Verdict::Stuck } else { verdict }
            }
            Self::Near(near) => near.verdict(ground, piece),
        }
    }
}

fn convex_verdict(sides: &[Line], piece: &[[f64; 2]], slop: &mut f64) -> Verdict {
    let mut verdict = Verdict::In;
    for side in sides {
        match side.side(piece, slop) {
            Side::Out => return Verdict::Out,
            Side::In => {}
            Side::Both => {
                let depth = side.at(middle(piece));
                let before = match verdict {
                    Verdict::Cut(cut) => cut.depth,
                    _ => f64::INFINITY,
                };
                verdict = Verdict::Cut(Cut { line: *side, depth: math::min(depth, before) });
            }
            Side::Unknown => verdict = if matches!(verdict, Verdict::In) { Verdict::Stuck } else { verdict },
        }
    }
    verdict
}

impl Near {
    /// By bounds of `f = distance - reach - growth * r` over the piece, each exact to the second order: on the triangle's plane the distance
    /// and r are convex functions, so each is at least its tangent and at most what its corners say.
    fn verdict(&self, ground: &PixelGround, piece: &[[f64; 2]]) -> Verdict {
        let centre = ground.hit(middle(piece));
        if !self.is_known(&centre) {
            return Verdict::Stuck;
        }
        let tangent = self.tangent(ground, &centre);
        let mut spread = Spread::default();
        for p in piece {
            let hit = ground.hit(*p);
            if !self.is_known(&hit) {
                return Verdict::Stuck;
            }
            let error = self.error(&hit, &centre, ground);
            let away = (hit.plan - centre.plan) * self.scale;
            let eye = ground.size.eye;
            let r = eye.map_or(0.0, |eye| (hit.world - eye).length());
            let r_tangent = eye.map_or(0.0, |eye| tangent.to_eye.dot(hit.world - eye));
            let nearest = tangent.distance + tangent.gradient.dot(away) - tangent.doubt * away.length();
            spread.include(Corner {
                least: nearest - self.reach - self.growth * r - error,
                most: distance(self.from, self.to, self.scaled(hit.plan))
                    - self.reach
                    - self.growth * r_tangent
                    + error,
                linear: tangent.value + tangent.slope.dot(hit.plan - centre.plan),
                across: tangent.slope.perp_dot(hit.plan - centre.plan),
            });
        }
        match (spread.most <= 0.0, spread.least > 0.0) {
            (true, _) => Verdict::In,
            (_, true) => Verdict::Out,
            _ => {
                let line = ground.line(&cut(&tangent, centre.plan, &spread));
                let (low, high) = spread.linear;
                Verdict::Cut(Cut { line, depth: -tangent.value / (high - low) * extent(piece) })
            }
        }
    }

    fn tangent(&self, ground: &PixelGround, centre: &Hit) -> Tangent {
        let at = self.scaled(centre.plan);
        let away = at - nearest(self.from, self.to, at);
        let distance = away.length();
        let gradient = if distance > 0.0 { away / distance } else { DVec2::ZERO };
        let rounding = 16.0 * f64::EPSILON * self.size(centre);
        let doubt = if distance > 0.0 { rounding / distance } else { 0.0 };
        let eye = ground.size.eye.filter(|_| self.growth > 0.0);
        let from_eye = eye.map_or(DVec3::ZERO, |eye| centre.world - eye);
        let r = from_eye.length();
        let to_eye = if r > 0.0 { from_eye / r } else { DVec3::ZERO };
        let slope = gradient * self.scale - ground.facet.slope(to_eye) * self.growth;
        Tangent { distance, gradient, doubt, to_eye, slope, value: distance - self.reach - self.growth * r }
    }

    /// A place where distances are measured.
    fn scaled(&self, p: Plan) -> Plan {
        Plan::from(p.to_vec() * self.scale)
    }

    /// What hits' errors and the roundings here can do to the bounds, metres.
    fn error(&self, hit: &Hit, centre: &Hit, ground: &PixelGround) -> f64 {
        let depth = ground.size.eye.map_or(0.0, |eye| (hit.world - eye).length());
        (2.0 * math::max(1.0, self.scale.max_element()) + 2.0 * self.growth) * (hit.error + centre.error)
            + 64.0 * f64::EPSILON * (self.size(hit) + (1.0 + self.growth) * depth)
    }

    /// Whether it is worth to go on with a plan point: bounds count its error, whatever it is.
    fn is_known(&self, hit: &Hit) -> bool {
        hit.error < math::max(MOST_ERROR, MOST_ERROR_SHARE * self.size(hit))
    }

    /// How large the coordinates are that a distance is computed from, metres.
    fn size(&self, hit: &Hit) -> f64 {
        hit.plan.to_vec().abs().max_element()
            + self.from.to_vec().abs().max_element()
            + self.to.to_vec().abs().max_element()
            + self.reach
    }
}

/// The larger of a piece's width and height, pixels.
fn extent(piece: &[[f64; 2]]) -> f64 {
    let plan = PlanBox::around(piece.iter().map(|p| Plan::new(p[0], p[1])));
    (plan.max - plan.min).max_element()
}

/// The point of a segment nearest to a plan point.
fn nearest(from: Plan, to: Plan, p: Plan) -> Plan {
    let (d, v) = (to - from, p - from);
    let squared = d.length_squared();
    let t = if squared > 0.0 { math::min(math::max(v.dot(d) / squared, 0.0), 1.0) } else { 0.0 };
    from + d * t
}

/// A plan point's distance from a segment, metres, up to a few roundings of the coordinates.
pub(super) fn distance(from: Plan, to: Plan, p: Plan) -> f64 {
    (p - nearest(from, to, p)).length()
}

/// The first-order picture of a distance at a piece's middle.
#[derive(Debug, Clone, Copy)]
struct Tangent {
    distance: f64,
    gradient: DVec2,
    /// By how much the gradient may be off: near the segment its direction is all rounding.
    doubt: f64,
    /// The unit vector from the eye.
    to_eye: DVec3,
    /// The gradient of f over the plan.
    slope: DVec2,
    /// f itself.
    value: f64,
}

/// Where to cut an undecided piece: where what lies beyond is surely out, or surely in, if that is much; else in half.
fn cut(tangent: &Tangent, centre: Plan, spread: &Spread) -> HalfPlane {
    let slope = tangent.slope;
    let along = |normal: DVec2, offset: f64| HalfPlane {
        at: centre,
        normal: [Ball::exact(normal.x), Ball::exact(normal.y)],
        offset: Ball::exact(offset),
    };
    if slope.length() < LEAST_STEEP {
        // At the segment itself there is no tangent: any cut makes the piece smaller.
        return along(DVec2::new(1.0, 0.618), 0.0);
    }
    let (low, high) = spread.linear;
    // Off the border by what the bounds lose, and a little for the cut itself.
    let margin = 1e-9 * (high - low);
    let (out, within) = (spread.bend_out + margin, -spread.bend_in - margin);
    let worth = WORTH * (high - low);
    if high - out > worth && low < out {
        return along(slope, tangent.value - out);
    }
    if within - low > worth && high > within {
        return along(slope, tangent.value - within);
    }
    let (west, east) = spread.across;
    match east - west > high - low {
        true => along(slope.perp(), -0.5 * (west + east)),
        false => along(slope, tangent.value - 0.5 * (low + high)),
    }
}

/// A piece's corner: bounds of f, and its place in the first-order picture.
#[derive(Debug, Clone, Copy)]
struct Corner {
    /// The tangents' f, which f is nowhere below in the piece if it is not here.
    least: f64,
    /// What f is at most.
    most: f64,
    /// f to the first order.
    linear: f64,
    /// How far along the border, times the slope.
    across: f64,
}

/// A piece's corners together.
#[derive(Debug, Clone, Copy)]
struct Spread {
    least: f64,
    most: f64,
    linear: (f64, f64),
    across: (f64, f64),
    /// How far the lower bound stays below the first order, and the upper bound above it.
    bend_out: f64,
    bend_in: f64,
}

impl Default for Spread {
    fn default() -> Self {
        let nothing = (f64::INFINITY, f64::NEG_INFINITY);
        let (least, most) = nothing;
        Self { least, most, linear: nothing, across: nothing, bend_out: 0.0, bend_in: 0.0 }
    }
}

impl Spread {
    fn include(&mut self, corner: Corner) {
        let wider = |(low, high), v| (math::min(v, low), math::max(v, high));
        self.least = math::min(corner.least, self.least);
        self.most = math::max(corner.most, self.most);
        self.linear = wider(self.linear, corner.linear);
        self.across = wider(self.across, corner.across);
        self.bend_out = math::max(corner.linear - corner.least, self.bend_out);
        self.bend_in = math::max(corner.most - corner.linear, self.bend_in);
    }
}

/// A plan point known no better than this, in metres, decides nothing.
const MOST_ERROR: f64 = 1e-3;

/// Nor one that is known no better than this share of the coordinates' size: those of a continent are known to some millimetres.
const MOST_ERROR_SHARE: f64 = 1.0 / (1 << 24) as f64;

/// Where f rises slower than this its tangent says nothing.
const LEAST_STEEP: f64 = 1e-6;

/// A cut is worth its two pieces when it takes off at least this share of the piece's extent.
const WORTH: f64 = 0.2;
