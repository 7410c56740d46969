//! Boxes of the plan in half the memory.

use super::{Plan, PlanBox};

/// West, south, east, north of a box, rounded outwards to single precision: it may meet what the box just misses, never miss what
/// the box meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmallBox([f32; 4]);

impl SmallBox {
    /// The box around a box.
    pub fn around(plan: &PlanBox) -> Self {
        let down = |v: f64| if f64::from(v as f32) > v { (v as f32).next_down() } else { v as f32 };
        let up = |v: f64| if f64::from(v as f32) < v { (v as f32).next_up() } else { v as f32 };
        Self([down(plan.min.x), down(plan.min.y), up(plan.max.x), up(plan.max.y)])
    }

    /// The box around two.
    #[must_use]
    pub fn joined(self, other: Self) -> Self {
        let (Self([w, s, e, n]), Self([a, b, c, d])) = (self, other);
        let least = |p: f32, q: f32| if p < q { p } else { q };
        let most = |p: f32, q: f32| if p > q { p } else { q };
        Self([least(w, a), least(s, b), most(e, c), most(n, d)])
    }

    /// The box as it has been rounded.
    pub fn bounds(&self) -> PlanBox {
        let [w, s, e, n] = self.0.map(f64::from);
        PlanBox { min: Plan::new(w, s), max: Plan::new(e, n) }
    }

    /// Its middle.
    pub fn middle(&self) -> Plan {
        let [w, s, e, n] = self.0.map(f64::from);
        Plan::new(0.5 * (w + e), 0.5 * (s + n))
    }

    /// Whether two boxes share a point.
    #[inline(always)]
    pub fn meets(&self, other: &Self) -> bool {
        let (Self([w, s, e, n]), Self([a, b, c, d])) = (self, other);
        // No short circuit: four comparisons cost less than a branch.
        (w <= c) & (a <= e) & (s <= d) & (b <= n)
    }
}
