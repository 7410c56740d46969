//! Strips of vertex pairs: what tessellation makes.

use crate::space::Plan;
use glam::DVec2;

/// Two vertices of a strip: a vertex of the line, moved to both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair<P> {
    /// To the left of the line's direction.
    pub left: P,
    /// To the right.
    pub right: P,
}

/// A vertex of a line with the offsets of a strip's two vertices there (what solution 4b stores).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OffsetVertex {
    /// The line's vertex.
    pub at: Plan,
    /// From there to the left vertex, metres.
    pub left: DVec2,
    /// To the right one.
    pub right: DVec2,
}

impl OffsetVertex {
    /// The vertices, the offsets scaled.
    #[inline]
    pub fn pair(&self, scale: f64) -> Pair<Plan> {
        Pair { left: self.at + self.left * scale, right: self.at + self.right * scale }
    }
}

/// Strips of vertex pairs.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Strips {
    pub(super) vertices: Vec<OffsetVertex>,
    pub(super) ends: Vec<u32>,
}

impl Strips {
    /// Each strip: its vertices are first left, first right, second left, ...
    pub fn iter(&self) -> impl Iterator<Item = &[OffsetVertex]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, end)| &self.vertices[start as usize..*end as usize])
    }

    /// The vertices of all strips, one strip after the other.
    #[cfg(test)]
    pub(super) fn vertices(&self) -> impl Iterator<Item = Plan> {
        self.vertices.iter().map(|v| v.pair(1.0)).flat_map(|pair| [pair.left, pair.right])
    }

    /// Forgets all strips; their memory is used again.
    pub fn clear(&mut self) {
        self.vertices.clear();
        self.ends.clear();
    }

    /// Adds a pair.
    pub(super) fn push(&mut self, at: Plan, left: DVec2, right: DVec2) {
        self.vertices.push(OffsetVertex { at, left, right });
    }

    /// The strip ends here, if it has begun; one pair alone is none.
    pub(super) fn end(&mut self) {
        let start = self.ends.last().copied().unwrap_or(0) as usize;
        if self.vertices.len() < start + 2 {
            self.vertices.truncate(start);
        } else {
            self.ends.push(self.vertices.len() as u32);
        }
    }
}

/// How finely a round join or cap is cut, as a share of half the width: how far its sides stay within the circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sagitta(pub f64);

impl Sagitta {
    /// Where it is not known how large the circle will be seen: a hundred sides.
    pub const DEFAULT: Self = Self(1.0 / 2048.0);
}
