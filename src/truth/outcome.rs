//! What a sample may see and be held by, when it may lie anywhere in a small square; and what a whole pixel sees.

use super::{Centre, PixelCoverage};
use crate::certainty::{Known, PaintRange};
use crate::math;
use crate::space::{PlanBox, Screen};
use crate::terrain::SKY;

/// One thing that a sample may see, with what may hold it there.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// The triangle's number; [`SKY`]: none.
    pub triangle: u32,
    /// Around all paints that it may have.
    pub paint: PaintRange,
    /// Those of what lies below all items.
    pub ground: PaintRange,
    /// The items that hold it or may hold it, in draw order; `None`: any.
    pub items: Option<Vec<(u32, Known)>>,
    /// Around its places in the plan; empty in the sky.
    pub plan: PlanBox,
    /// Its least and largest view depth, metres; infinite in the sky.
    pub depth: (f64, f64),
}

impl Outcome {
    /// The sky.
    pub(super) fn of_sky(paint: PaintRange) -> Self {
        let depth = (f64::INFINITY, f64::INFINITY);
        Self { triangle: SKY, paint, ground: paint, items: Some(Vec::new()), plan: PlanBox::EMPTY, depth }
    }

    /// Whether it differs from another in nothing but where exactly it is.
    fn is_like(&self, other: &Self) -> bool {
        self.triangle == other.triangle && self.items == other.items && self.paint == other.paint
    }
}

/// All that a sample may see.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sample {
    /// Each different thing once; never empty once the sample has been looked at.
    pub outcomes: Vec<Outcome>,
}

impl Sample {
    pub(super) fn add(&mut self, outcome: Outcome) {
        match self.outcomes.iter_mut().find(|known| known.is_like(&outcome)) {
            Some(known) => {
                known.plan.include_box(&outcome.plan);
                known.depth =
                    (math::min(known.depth.0, outcome.depth.0), math::max(known.depth.1, outcome.depth.1));
            }
            None => self.outcomes.push(outcome),
        }
    }

    /// Around all paints that it may have.
    ///
    /// # Panics
    /// When it has not been looked at.
    pub fn paint(&self) -> PaintRange {
        let mut paints = self.outcomes.iter().map(|outcome| outcome.paint);
        let first = paints.next().unwrap_or(PaintRange::ANY);
        paints.fold(first, |all, paint| all.hull(&paint))
    }
}

/// A convex piece of a pixel that sees one triangle, or the sky.
#[derive(Debug, Clone, PartialEq)]
pub struct SeenPiece {
    /// The triangle's number; [`SKY`]: none.
    pub triangle: u32,
    /// Its corners on the screen, in order.
    pub corners: Vec<Screen>,
}

/// A pixel looked at closely.
#[derive(Debug, Clone, PartialEq)]
pub struct PixelLook {
    /// Lower bounds of its right colour: RGBA, straight alpha, encoded values 0..=1.
    pub low: [f64; 4],
    /// Upper bounds.
    pub high: [f64; 4],
    /// An estimate between the two.
    pub estimate: [f64; 4],
    /// What each item covers of it, hidden ones too; nothing where the budget does not ask for it.
    pub coverage: PixelCoverage,
    /// What its centre sees; `None`: the sky.
    pub centre: Option<Centre>,
    /// What it sees; none where it sees thousands of triangles.
    pub pieces: Vec<SeenPiece>,
}
