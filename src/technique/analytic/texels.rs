//! Fragments cut where the ground's paint changes: at the borders of an image's texels.

use super::convex::{NOTHING, Side, area, cut};
use super::facet::Facet;
use crate::scene::{GroundColors, Scene};
use crate::space::{Plan, PlanBox};
use glam::{DVec2, DVec3};

/// The texels of an image over the plan, if the ground has one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Texels {
    extent: PlanBox,
    size: [usize; 2],
}

impl Texels {
    /// Those of a scene.
    pub(super) fn of(scene: &Scene) -> Option<Self> {
        let GroundColors::Imagery(imagery) = &scene.ground.colors else { return None };
        Some(Self { extent: imagery.extent, size: [imagery.texels.width(), imagery.texels.height()] })
    }

    /// The columns (or rows, from the north) from the first to the last that some plan points lie in.
    fn range(&self, axis: usize, plan: &[Plan]) -> [usize; 2] {
        let size = self.extent.max - self.extent.min;
        let place = |p: &Plan| match axis {
            0 => (p.x - self.extent.min.x) / size.x * self.size[0] as f64,
            _ => (self.extent.max.y - p.y) / size.y * self.size[1] as f64,
        };
        // Casts saturate: what lies off the rim has the outermost texel.
        let texels = plan.iter().map(|p| (place(p) as usize).min(self.size[axis] - 1));
        texels.fold([usize::MAX, 0], |[low, high], texel| [low.min(texel), high.max(texel)])
    }

    /// The border before a column (or row), as a line of the screen whose inside is before it.
    fn border(&self, axis: usize, number: usize, facet: &Facet) -> Side {
        let size = self.extent.max - self.extent.min;
        let share = number as f64 / self.size[axis] as f64;
        let at = match axis {
            0 => self.extent.min.x + share * size.x,
            _ => self.extent.max.y - share * size.y,
        };
        let row: DVec3 = facet.beyond(axis, at) * if axis == 0 { -1.0 } else { 1.0 };
        Side { normal: row.truncate(), offset: row.z }
    }

    /// The parts of a polygon that lie in one texel each; `None`: there are more than `most`.
    pub(super) fn parts(&self, facet: &Facet, polygon: &[DVec2], most: usize) -> Option<Vec<Vec<DVec2>>> {
        let plan: Vec<Plan> = polygon.iter().map(|p| facet.plan_at(*p)).collect();
        let ranges = [0, 1].map(|axis| self.range(axis, &plan));
        let [across, down] = ranges.map(|[low, high]| high - low + 1);
        if across.checked_mul(down).is_none_or(|texels| texels > most.max(1)) {
            return None;
        }
        let mut parts = vec![polygon.to_vec()];
        for (axis, [low, high]) in ranges.into_iter().enumerate() {
            for number in low + 1..=high {
                let border = self.border(axis, number, facet);
                // What lies before the border is done; only the last parts go on.
                let mut next = Vec::new();
                for part in parts {
                    let (mut before, mut behind) = (Vec::new(), Vec::new());
                    cut(&part, &border, &mut before);
                    cut(&part, &border.turned(), &mut behind);
                    next.extend([before, behind].into_iter().filter(|part| area(part) > NOTHING));
                }
                parts = next;
            }
        }
        Some(parts)
    }
}
