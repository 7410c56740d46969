//! Expanded areas as inverse projection has them (3.1, Fig. 4).

use super::super::shot::Tables;
use crate::error::Result;
use crate::space::Plan;
use glam::DVec2;

/// The buffers that edges are read from.
pub(super) const EDGES: [&str; 2] = ["area-edges", "edge-sides"];

/// An edge of an area.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    pub(super) from: Plan,
    pub(super) to: Plan,
    is_turned: bool,
}

impl Edge {
    /// A unit vector out of the area.
    pub(super) fn normal(&self) -> DVec2 {
        let along = self.to - self.from;
        let right = DVec2::new(along.y, -along.x) / crate::math::max(along.length(), 1e-12);
        if self.is_turned { -right } else { right }
    }

    /// Its middle.
    pub(super) fn middle(&self) -> Plan {
        self.from + (self.to - self.from) * 0.5
    }

    /// The foot of the perpendicular from a point, as a share of the edge: on it where 0..=1 (Fig. 9b).
    pub(super) fn foot(&self, point: Plan) -> f64 {
        let along = self.to - self.from;
        (point - self.from).dot(along) / crate::math::max(along.length_squared(), 1e-24)
    }

    /// Whether it has a point in the unit square with this south-western corner.
    pub(super) fn meets(&self, corner: [f64; 2]) -> bool {
        let (mut enters, mut leaves) = (0.0, 1.0);
        let (from, along) = (self.from.to_vec().to_array(), (self.to - self.from).to_array());
        for k in 0..2 {
            let sides = [corner[k], corner[k] + 1.0];
            if along[k] == 0.0 {
                if from[k] < sides[0] || from[k] > sides[1] {
                    return false;
                }
                continue;
            }
            let [a, b] = sides.map(|side| (side - from[k]) / along[k]);
            enters = crate::math::max(enters, crate::math::min(a, b));
            leaves = crate::math::min(leaves, crate::math::max(a, b));
        }
        enters <= leaves
    }

    /// What it adds to the index of a point, without the pedal rule (Code A).
    pub(super) fn vote(&self, point: Plan) -> i32 {
        let towards = (self.from - point) + (self.to - point);
        if towards.dot(self.normal()) >= 0.0 { 1 } else { -1 }
    }
}

/// The edges of a frame that was asked for [`EDGES`].
pub(super) fn edges(tables: &Tables) -> Result<Vec<Edge>> {
    let (edges, sides) = (tables.real::<4>("area-edges")?, tables.whole::<1>("edge-sides")?);
    let edge = |([a, b, c, d], [side]): (&[f64; 4], &[u32; 1])| Edge {
        from: Plan::new(*a, *b),
        to: Plan::new(*c, *d),
        is_turned: *side == 1,
    };
    Ok(edges.iter().zip(&sides).map(edge).collect())
}
