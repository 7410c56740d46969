//! Point-in-line tests (3.6, 4.3.2, Figs. 3.10 and 3.11), analytic edges (3.5 leaves them open) and thin lines (4.5, Fig. 4.9).
//!
//! Input: a segment and the surface point of a pixel's centre. Output: how much of the pixel the segment's line covers: 0 or 1, with analytic edges
//! anything between. The width at a pixel is that of its surface point (4.3.2), not of the segment's vertices. Where a line is round and the device computes in
//! doubles, whether it holds a point is decided exactly ([`Border`]); corners by style, analytic edges and thin lines are as good as doubles are. Refuses: nothing.
//!
//! 4.5 corrects "top-down views" and does not say which those are: here a view whose direction is within ten degrees of straight down.

use super::border::Border;
use super::camera::{Camera, P2, P3};
use super::segment_box::miter;
use super::update::Segment;
use crate::math;
use crate::raster::device::Real;
use crate::scene::{Cap, Join, Line};
use crate::space::{Lens, Plan, ViewFrame};
use crate::technique::dynamic_line::{Antialiasing, Corners, Settings, ThinLines};
use crate::visibility::PixelFootprint;

/// The cosine of ten degrees.
const TOP_DOWN: f64 = 0.984_807_753_012_208;

/// Half a pixel: a pixel whose centre is no farther from a segment's picture is in a thin line.
const THIN: f64 = 0.5;

/// What is done about thin lines in a view.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Thin {
    /// Nothing.
    Nothing,
    /// Pixels near a segment's picture are in the line.
    Near,
    /// Those of them that do not hide the segment.
    NearAndSeen,
}

impl Thin {
    /// By the settings. Analytic edges need no correction.
    pub fn of(settings: &Settings, view: &ViewFrame) -> Self {
        match (settings.thin_lines, settings.antialiasing) {
            (ThinLines::None, _) | (_, Antialiasing::Analytic) => Self::Nothing,
            (ThinLines::Correction, _) if view.forward().z > -TOP_DOWN => Self::Nothing,
            (ThinLines::Correction, _) => Self::Near,
            (ThinLines::SecondDepth, _) => Self::NearAndSeen,
        }
    }
}

/// A segment made ready for the tests of many pixels.
#[derive(Debug, Clone, Copy)]
pub struct ReadySegment<T> {
    half_px: T,
    start: P2<T>,
    end: P2<T>,
    along: P2<T>,
    length_squared: T,
    border: Option<Border>,
    style: Option<StyledSegment<T>>,
    picture: Option<Picture>,
}

/// A segment's picture before the near plane.
#[derive(Debug, Clone, Copy)]
struct Picture {
    ends: [Plan; 2],
    /// The view depths of its ends; 1 where rays are parallel.
    depths: [f64; 2],
    plan: [Plan; 2],
}

/// A segment whose corners are as its layer says.
#[derive(Debug, Clone, Copy)]
struct StyledSegment<T> {
    unit: P2<T>,
    ends: [End<T>; 2],
}

/// How a segment ends; vectors for a line of half width 1.
#[derive(Debug, Clone, Copy)]
enum End<T> {
    /// Straight.
    Butt,
    /// Straight, half a width on.
    Square,
    /// With a disc.
    Round,
    /// With the part of a disc between the ends of two segments, which run along these.
    Arc(P2<T>, P2<T>),
    /// Where its left side meets that of its neighbour, and the right side opposite.
    Miter(P2<T>),
    /// With a triangle between the vertex and these two places.
    Bevel(P2<T>, P2<T>),
}

/// The surface point of a pixel's centre.
#[derive(Debug, Clone, Copy)]
pub struct Fragment<T> {
    /// It.
    pub point: P3<T>,
    /// The size of a pixel there, metres.
    pub pixel: T,
}

impl<T: Real> ReadySegment<T> {
    /// Makes a segment of a line ready; `half_px`: half the line's width in pixels; `border`: the line's, where it is to be decided exactly.
    pub fn new(
        segment: &Segment<T>,
        (line, half_px, border): (&Line, T, Option<Border>),
        (camera, view): (&Camera<T>, &ViewFrame),
        (corners, thin): (Corners, Thin),
    ) -> Self {
        let (start, end) = (segment.start.plan(), segment.end.plan());
        let along = end.minus(start);
        let style = (corners == Corners::Style).then(|| StyledSegment::new(segment, line));
        let picture = if thin == Thin::Nothing { None } else { Picture::new(segment, camera, view) };
        Self { half_px, start, end, along, length_squared: along.dot(along), border, style, picture }
    }

    /// From the nearest point of the segment to a point.
    #[inline(always)]
    fn offset(&self, at: P2<T>) -> P2<T> {
        let from = at.minus(self.start);
        let t = from.dot(self.along);
        if t <= T::of(0.0) {
            from
        } else if t >= self.length_squared {
            at.minus(self.end)
        } else {
            let across = self.along.cross(from) / self.length_squared;
            self.along.left().times(across)
        }
    }

    /// Half the line's width at a pixel, metres.
    #[inline(always)]
    pub fn half_width(&self, at: &Fragment<T>) -> T {
        self.half_px * at.pixel
    }

    /// The distance of a pixel's plan point from the segment, metres.
    #[inline(always)]
    pub fn distance(&self, at: &Fragment<T>) -> T {
        let offset = self.offset(at.point.plan());
        offset.dot(offset).sqrt()
    }

    /// Whether a pixel's plan point is in the line.
    #[inline(always)]
    pub fn holds(&self, at: &Fragment<T>) -> bool {
        let half = self.half_width(at);
        if let Some(style) = &self.style {
            return style.holds((self.start, self.end), at.point.plan(), half);
        }
        let offset = self.offset(at.point.plan());
        let square = offset.dot(offset);
        let Some(border) = &self.border else { return square <= half * half };
        let (square, half) = (square.get(), half.get());
        let tolerance = border.tolerance(at.point.plan().minus(self.start), half);
        let [inner, outer] = [half - tolerance, half + tolerance];
        if square > outer * outer {
            return false;
        }
        (inner > 0.0 && square < inner * inner) || half == f64::INFINITY || border.holds(at.point.get())
    }

    /// How much of a pixel lies in the line, 0..=1: the share of the pixel's reach, along the way to the segment, that does; `footprint`: how the plan point
    /// moves from pixel to pixel.
    pub fn share(&self, at: &Fragment<T>, footprint: Option<PixelFootprint>) -> f64 {
        let half = self.half_width(at).get();
        let offset = self.offset(at.point.plan());
        let distance = offset.dot(offset).sqrt().get();
        let across = if distance > 0.0 { offset } else { self.along.left() };
        let way = across.normalized().map(|way| way.get().to_vec());
        let reach = footprint.zip(way).map(|(footprint, way)| {
            let (x, y) = (footprint.dx.dot(way), footprint.dy.dot(way));
            (x * x + y * y).sqrt()
        });
        match reach {
            Some(reach) if reach > 0.0 && reach.is_finite() => {
                let (low, high) = (distance - reach / 2.0, distance + reach / 2.0);
                math::max((math::min(high, half) - math::max(low, -half)) / reach, 0.0)
            }
            _ => f64::from(u8::from(distance <= half)),
        }
    }

    /// The plan point of the place of the segment's picture that is nearest to a pixel's centre, if that is near enough for a thin line.
    pub fn near(&self, (column, row): (usize, usize)) -> Option<Plan> {
        let picture = self.picture.as_ref()?;
        let at = Plan::new(column as f64 + 0.5, row as f64 + 0.5);
        let (along, from) = (picture.ends[1] - picture.ends[0], at - picture.ends[0]);
        let length = along.length_squared();
        let t = if length > 0.0 { math::min(math::max(from.dot(along) / length, 0.0), 1.0) } else { 0.0 };
        let is_near = (from - along * t).length_squared() <= THIN * THIN;
        is_near.then(|| {
            // The perspective: shares of the picture weigh with the depth of the other end.
            let [first, last] = picture.depths;
            let share = t * first / ((1.0 - t) * last + t * first);
            picture.plan[0] + (picture.plan[1] - picture.plan[0]) * share
        })
    }
}

impl Picture {
    fn new<T: Real>(segment: &Segment<T>, camera: &Camera<T>, view: &ViewFrame) -> Option<Self> {
        let plan = [segment.start, segment.end].map(|p| p.plan().get());
        let seen = [segment.start, segment.end].map(|p| camera.view(p));
        let before = seen.map(|p| camera.is_before(p));
        let cut = |from: usize, to: usize| {
            let at = camera.at_near(seen[from], seen[to]);
            let share = (at.z - seen[from].z) / (seen[to].z - seen[from].z);
            (at, plan[from] + (plan[to] - plan[from]) * share.get())
        };
        let [(first, from), (last, to)] = match before {
            [true, true] => [(seen[0], plan[0]), (seen[1], plan[1])],
            [true, false] => [(seen[0], plan[0]), cut(0, 1)],
            [false, true] => [cut(1, 0), (seen[1], plan[1])],
            [false, false] => return None,
        };
        let depth = |p: P3<T>| if matches!(view.lens(), Lens::Central { .. }) { p.z.get() } else { 1.0 };
        let ends = [first, last].map(|p| camera.screen(p).get());
        Some(Self { ends, depths: [depth(first), depth(last)], plan: [from, to] })
    }
}

impl<T: Real> StyledSegment<T> {
    fn new(segment: &Segment<T>, line: &Line) -> Self {
        let (start, end) = (segment.start.plan(), segment.end.plan());
        let unit = end.minus(start).normalized().unwrap_or(P2 { x: T::of(1.0), y: T::of(0.0) });
        let cap = match line.cap {
            Cap::Butt => End::Butt,
            Cap::Square => End::Square,
            Cap::Round => End::Round,
        };
        let join = |before: P2<T>, at: P2<T>, after: P2<T>| corner((before, at, after), line.join);
        let first = segment.before.map_or(cap, |before| join(before, start, end));
        let last = segment.after.map_or(cap, |after| join(start, end, after));
        Self { unit, ends: [first, last] }
    }

    fn holds(&self, (start, end): (P2<T>, P2<T>), at: P2<T>, half: T) -> bool {
        let normal = self.unit.left();
        let side = |of: &End<T>| (if let End::Miter(vector) = of { *vector } else { normal }).times(half);
        let on = |of: &End<T>| {
            if matches!(of, End::Square) { self.unit.times(half) } else { self.unit.times(T::of(0.0)) }
        };
        let ([first, last], [from, to]) =
            (&self.ends, [start.minus(on(&self.ends[0])), end.plus(on(&self.ends[1]))]);
        let [a, b] = [from.plus(side(first)), from.minus(side(first))];
        let [c, d] = [to.minus(side(last)), to.plus(side(last))];
        // 4.3.2: two triangles make the segment, a third one each bevelled corner.
        if in_triangle(at, [a, b, c]) || in_triangle(at, [a, c, d]) {
            return true;
        }
        [(start, first), (end, last)].into_iter().any(|(vertex, of)| match of {
            End::Round => {
                let d = at.minus(vertex);
                d.dot(d) <= half * half
            }
            End::Arc(into, out) => {
                let (d, zero) = (at.minus(vertex), T::of(0.0));
                d.dot(d) <= half * half && d.dot(*into) >= zero && d.dot(*out) <= zero
            }
            End::Bevel(p, q) => {
                in_triangle(at, [vertex, vertex.plus(p.times(half)), vertex.plus(q.times(half))])
            }
            End::Butt | End::Square | End::Miter(_) => false,
        })
    }
}

/// A corner between two segments (3.6). A miter that is longer than its limit is a bevel.
fn corner<T: Real>((before, at, after): (P2<T>, P2<T>, P2<T>), join: Join) -> End<T> {
    let vector = miter(before, at, after);
    let is_within = |limit: f64| vector.is_some_and(|v| v.dot(v) <= T::of(limit * limit));
    let (into, out) = (at.minus(before).normalized(), after.minus(at).normalized());
    let Some((into, out)) = into.zip(out) else { return End::Butt };
    match (join, vector) {
        (Join::Round, _) => End::Arc(into, out),
        (Join::Miter { limit }, Some(vector)) if is_within(limit) => End::Miter(vector),
        _ => {
            // The gap is on the side that the line does not turn to.
            let outer = T::of(if into.cross(out) > T::of(0.0) { -1.0 } else { 1.0 });
            End::Bevel(into.left().times(outer), out.left().times(outer))
        }
    }
}

/// Whether a point lies in a triangle or on its border.
fn in_triangle<T: Real>(at: P2<T>, corners: [P2<T>; 3]) -> bool {
    let zero = T::of(0.0);
    let sides: [T; 3] = std::array::from_fn(|k| {
        let (a, b) = (corners[k], corners[(k + 1) % 3]);
        b.minus(a).cross(at.minus(a))
    });
    let area = corners[1].minus(corners[0]).cross(corners[2].minus(corners[0]));
    area != zero && (sides.iter().all(|s| *s >= zero) || sides.iter().all(|s| *s <= zero))
}
