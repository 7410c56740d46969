//! Lines -> strips of triangles (Taibo et al. 2014, section 4.2).
//!
//! Input: a polyline, open or a loop, its width, and how joints are made. Output: [`Strips`]: pairs of vertices, left and right of the
//! line, in the order in which a triangle strip or a strip of quadrilaterals takes them. Each method has its name from the paper
//! (`joint`); joins and caps of the layer's style, which the paper does not have, are ours (`style`). Refuses: lines without two
//! distinct vertices, and widths and angles that are no such thing.

mod joint;
mod strip;
mod style;
#[cfg(test)]
mod tests;

pub use strip::{OffsetVertex, Pair, Sagitta, Strips};

use crate::error::{Error, Result};
use crate::scene::{Cap, Join, Line, Width};
use crate::space::Plan;
use crate::technique::clipmap::Joints;
use glam::DVec2;
use joint::Corner;

/// A polyline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Polyline<'a> {
    /// Its vertices, each another than the one before; of a loop, without the first again at the end.
    pub vertices: &'a [Plan],
    /// Whether the last vertex is joined to the first.
    pub is_loop: bool,
}

/// How lines are tessellated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rule {
    joints: Joints,
    /// Bevelled are joints whose angle has a greater cosine.
    threshold: f64,
    join: Join,
    cap: Cap,
}

/// An angle this near to the threshold (in its cosine) is the threshold: far above the rounding of directions, so that right angles
/// are right angles however a line is turned.
const SAME_COSINE: f64 = 1e-9;

impl Rule {
    /// The rule of one of the paper's methods, or of a layer's style. Joints of an angle below `angle_deg` are bevelled, which matters to
    /// Algorithm 1 alone.
    ///
    /// # Errors
    /// When the angle is not between 0 and 180 degrees.
    pub fn new(joints: Joints, angle_deg: f64, join: Join, cap: Cap) -> Result<Self> {
        if !(angle_deg > 0.0 && angle_deg < 180.0) {
            return Err(Error::new(format!("an angle threshold of {angle_deg} degrees"))
                .help("use an angle between 0 and 180, usually close to 90 (Taibo 4.2.3)"));
        }
        let threshold = crate::math::cos(angle_deg.to_radians()) + SAME_COSINE;
        Ok(Self { joints, threshold, join, cap })
    }

    /// The rule of a line: widths in pixels have round joins and caps by definition, whatever the style says.
    ///
    /// # Errors
    /// As [`Rule::new`].
    pub fn of_line(joints: Joints, angle_deg: f64, line: &Line) -> Result<Self> {
        match line.width {
            Width::Metres(_) => Self::new(joints, angle_deg, line.join, line.cap),
            Width::Pixels(_) => Self::new(joints, angle_deg, Join::Round, Cap::Round),
        }
    }

    /// Tessellates a whole polyline of a width in metres.
    ///
    /// # Errors
    /// When it has not two distinct vertices, or the width is not finite and greater than 0.
    pub fn tessellate(&self, line: &Polyline, width: f64, sagitta: Sagitta, out: &mut Strips) -> Result<()> {
        let n = line.vertices.len();
        let Some(first) = line.vertices.first() else {
            return Err(Error::new("a line without vertices cannot be tessellated").help("leave it out"));
        };
        if line.vertices.iter().all(|p| p == first) {
            let what = if n == 1 { "a line of one vertex" } else { "a line whose vertices are all the same" };
            return Err(
                Error::new(format!("{what} has no direction")).help("it is a dot: draw it by its cap")
            );
        }
        if !(width > 0.0 && width.is_finite()) {
            return Err(Error::new(format!("a line of a width of {width} m"))
                .help("use a finite width greater than 0"));
        }
        if let Some(at) = line.vertices.iter().position(|p| !p.is_finite()) {
            return Err(Error::new(format!("vertex {at} of a line is not finite")));
        }
        self.part(line, 0..line.segments(), 0.5 * width, sagitta, out);
        Ok(())
    }

    /// Tessellates some segments of a polyline that has passed [`Rule::tessellate`]'s checks: its joints with what is before and after
    /// them are made too, so that parts next to one another fit.
    pub fn part(
        &self,
        line: &Polyline,
        segments: std::ops::Range<usize>,
        half: f64,
        sagitta: Sagitta,
        out: &mut Strips,
    ) {
        if segments.is_empty() {
            return;
        }
        let corner = |vertex: usize| line.corner(vertex, half);
        let (from, to) = line.segment(segments.start);
        match corner(segments.start) {
            // Of the joint before the first segment, the pair that the segment starts with.
            Some(corner) => self.start_from_joint(&corner, sagitta, out),
            None => self.start(from, to, half, sagitta, out),
        }
        for segment in segments.clone() {
            match corner(segment + 1) {
                Some(corner) => self.joint(&corner, sagitta, out),
                None => {
                    let (from, to) = line.segment(segment);
                    self.finish(from, to, half, sagitta, out);
                }
            }
        }
        out.end();
    }

    /// Tessellates segments that are given with the vertices before and after them, as a geometry shader gets them
    /// (`LINE_STRIP_ADJACENCY`, 4.4.1); where a vertex is given twice, the line begins or ends. Each joint is computed for both
    /// segments, as there.
    pub(super) fn adjacency<'a>(
        &self,
        segments: impl Iterator<Item = &'a [Plan]>,
        half: f64,
        sagitta: Sagitta,
        out: &mut Strips,
    ) {
        let mut has_begun = false;
        for segment in segments {
            let &[before, from, to, after] = segment else { continue };
            let known = (out.vertices.len(), out.ends.len());
            match before == from {
                true => self.start(from, to, half, sagitta, out),
                false => self.start_from_joint(&Corner::new([before, from, to], half), sagitta, out),
            }
            if has_begun {
                // The segment before has ended with the same.
                out.vertices.truncate(known.0);
                out.ends.truncate(known.1);
            }
            match after == to {
                true => self.finish(from, to, half, sagitta, out),
                false => self.joint(&Corner::new([from, to, after], half), sagitta, out),
            }
            has_begun = true;
        }
        out.end();
    }

    /// Adds a joint's pairs (Algorithm 1, "newvertices").
    fn joint(&self, corner: &Corner, sagitta: Sagitta, out: &mut Strips) {
        match self.joints {
            Joints::Combined if corner.cosine() > self.threshold => corner.bevel_inner(out),
            Joints::Combined | Joints::Corner => corner.intersections(out),
            Joints::BevelInner => corner.bevel_inner(out),
            Joints::BevelStrip | Joints::BevelQuads => corner.bevel(out),
            Joints::Isolated => corner.isolated(out),
            Joints::Style => style::joint(corner, self.join, sagitta, out),
        }
    }

    /// Starts a strip with the last pair of a joint.
    fn start_from_joint(&self, corner: &Corner, sagitta: Sagitta, out: &mut Strips) {
        let (vertices, ends) = (out.vertices.len(), out.ends.len());
        self.joint(corner, sagitta, out);
        if let Some(last) = out.vertices.last().copied() {
            out.vertices.truncate(vertices);
            out.ends.truncate(ends);
            out.vertices.push(last);
        }
    }

    /// Starts an open line (method 1).
    fn start(&self, from: Plan, to: Plan, half: f64, sagitta: Sagitta, out: &mut Strips) {
        let aside = joint::offset(to - from, half);
        if self.joints == Joints::Style {
            if self.has_whole_disc(from, to, half) {
                style::dot(from, half, self.cap, sagitta, out);
            }
            style::start_cap(from, aside, self.cap, sagitta, out);
        }
        out.push(from, aside, -aside);
    }

    /// Ends an open line (method 1).
    fn finish(&self, from: Plan, to: Plan, half: f64, sagitta: Sagitta, out: &mut Strips) {
        let aside = joint::offset(to - from, half);
        out.push(to, aside, -aside);
        if self.joints == Joints::Style {
            style::end_cap(to, aside, self.cap, sagitta, out);
            if self.has_whole_disc(from, to, half) {
                out.end();
                style::dot(to, half, self.cap, sagitta, out);
            }
        }
    }

    /// Whether a round cap at the end of a segment is seen beyond its other end too.
    fn has_whole_disc(&self, from: Plan, to: Plan, half: f64) -> bool {
        self.cap == Cap::Round && half > (to - from).length()
    }

    /// The strips of a line of one vertex: a dot by its cap, which only a style has.
    pub fn dot(&self, at: Plan, half: f64, sagitta: Sagitta, out: &mut Strips) {
        if self.joints == Joints::Style {
            style::dot(at, half, self.cap, sagitta, out);
        }
    }

    /// How far from a polyline's vertices its strips may reach, in half widths.
    pub fn reach(&self, line: &Polyline) -> f64 {
        let has_corners = match self.joints {
            Joints::Combined | Joints::Corner => true,
            Joints::Style => matches!(self.join, Join::Miter { .. }),
            Joints::Isolated | Joints::BevelStrip | Joints::BevelQuads | Joints::BevelInner => false,
        };
        // A square cap's corners.
        let least = std::f64::consts::SQRT_2;
        if !has_corners {
            return least;
        }
        let corners = (0..line.vertices.len()).filter_map(|vertex| line.corner(vertex, 1.0));
        let is_cut = |corner: &Corner| self.joints == Joints::Combined && corner.cosine() > self.threshold;
        let ratios = corners.filter(|c| !is_cut(c)).filter_map(|c| c.intersection()).map(DVec2::length);
        let farthest = ratios.fold(least, crate::math::max);
        match (self.joints, self.join) {
            (Joints::Style, Join::Miter { limit }) => {
                crate::math::min(farthest, crate::math::max(limit, least))
            }
            _ => farthest,
        }
    }
}

impl Polyline<'_> {
    /// How many segments it has.
    pub fn segments(&self) -> usize {
        if self.is_loop { self.vertices.len() } else { self.vertices.len().saturating_sub(1) }
    }

    /// The ends of a segment.
    fn segment(&self, segment: usize) -> (Plan, Plan) {
        (self.vertices[segment], self.vertices[(segment + 1) % self.vertices.len()])
    }

    /// The corner at a vertex (those of a loop are counted round); `None` at the ends of an open line.
    fn corner(&self, vertex: usize, half: f64) -> Option<Corner> {
        let n = self.vertices.len();
        let is_end = !self.is_loop && (vertex == 0 || vertex + 1 == n);
        let at = |k: usize| self.vertices[k % n];
        (!is_end).then(|| Corner::new([at(vertex + n - 1), at(vertex), at(vertex + 1)], half))
    }
}
