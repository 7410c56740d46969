//! The terrain's own paint where a ray may end.

use crate::certainty::PaintRange;
use crate::resolve::{Compositor, GroundPaint};
use crate::scene::{Ground as SceneGround, GroundColors, Imagery};
use crate::space::{Plan, PlanBox};
use crate::terrain::Mesh;
use std::ops::RangeInclusive;

/// The paints of a terrain.
pub(super) struct Ground<'a> {
    paint: GroundPaint<'a>,
    imagery: Option<&'a Imagery>,
}

/// So many texels are told apart; more have a range of paints.
const MOST_APART: usize = 4;

/// More texels than this may have any paint.
const MOST_TEXELS: usize = 1024;

impl<'a> Ground<'a> {
    pub(super) fn new(ground: &'a SceneGround, mesh: &'a Mesh, compositor: Compositor) -> Self {
        let imagery = match &ground.colors {
            GroundColors::Imagery(imagery) => Some(imagery),
            GroundColors::Constant(_) => None,
        };
        Self { paint: GroundPaint::new(ground, mesh, compositor), imagery }
    }

    /// The paints that a triangle may have in a box of the plan.
    pub(super) fn paints(&self, triangle: u32, plan: &PlanBox) -> Vec<PaintRange> {
        let Some(imagery) = self.imagery else {
            return vec![PaintRange::exact(self.paint.at(triangle, Plan::default()))];
        };
        let (extent, texels) = (&imagery.extent, &imagery.texels);
        let size = extent.max - extent.min;
        let columns = between(
            [plan.min.x - extent.min.x, plan.max.x - extent.min.x].map(|v| v / size.x),
            texels.width(),
        );
        let rows = between(
            [extent.max.y - plan.max.y, extent.max.y - plan.min.y].map(|v| v / size.y),
            texels.height(),
        );
        if columns.clone().count() * rows.clone().count() > MOST_TEXELS {
            return vec![PaintRange::ANY];
        }
        let mut paints: Vec<PaintRange> = Vec::new();
        for y in rows {
            for x in columns.clone() {
                let paint = PaintRange::exact(self.paint.lit(triangle, *texels.at(x, y)));
                if !paints.contains(&paint) {
                    paints.push(paint);
                }
            }
        }
        if paints.len() > MOST_APART {
            let first = paints[0];
            paints = vec![paints.iter().fold(first, |all, paint| all.hull(paint))];
        }
        paints
    }
}

/// The texels between two shares of an axis; those at the rim reach beyond it.
fn between(shares: [f64; 2], count: usize) -> RangeInclusive<usize> {
    // Casts saturate.
    let [first, last] = shares.map(|share| ((share * count as f64) as usize).min(count - 1));
    first..=last
}

#[cfg(test)]
mod tests {
    use super::between;

    #[test]
    fn a_range_has_the_texels_that_it_touches_and_the_rim_those_beyond() {
        assert_eq!(between([0.3, 0.6], 4), 1..=2);
        assert_eq!(between([-0.5, 0.1], 4), 0..=0);
        assert_eq!(between([0.9, 1.5], 4), 3..=3);
    }
}
