//! Heights over a globe's longitudes and latitudes.

use super::Posts;
use crate::space::{Globe, Plan, PlanBox};

/// Heights above an ellipsoid at posts along its meridians and parallels.
///
/// # Guarantees (kept by the sources)
/// The posts' rows run along parallels, their columns along meridians, none of them at a pole, and all within a turn.
#[derive(Debug, Clone, PartialEq)]
pub struct GlobePosts {
    /// The posts, in the globe's plan, local.
    pub posts: Posts,
    /// Where their places are.
    pub globe: Globe,
    /// Whether the last column's eastern neighbour is the first one, a turn on.
    pub is_closed: bool,
    /// The heights of the southern and the northern pole, where the surface reaches them: from the first row, and from the last.
    pub poles: [Option<f64>; 2],
}

impl GlobePosts {
    /// The rectangle of the plan that the surface covers.
    pub fn plan_bounds(&self) -> PlanBox {
        let posts = &self.posts;
        let last = posts.plan(posts.columns() - 1, posts.rows() - 1);
        let [south, north] = self.pole_rows();
        let east = if self.is_closed { posts.first.x + self.globe.turn() } else { last.x };
        PlanBox {
            min: Plan::new(posts.first.x, self.poles[0].map_or(posts.first.y, |_| south)),
            max: Plan::new(east, self.poles[1].map_or(last.y, |_| north)),
        }
    }

    /// The plan's y of the southern and of the northern pole.
    pub fn pole_rows(&self) -> [f64; 2] {
        [-1.0, 1.0].map(|side: f64| self.globe.plan(0.0, side * std::f64::consts::FRAC_PI_2).y)
    }

    /// Where column i stands in the plan; behind the last one of a closed grid is the first one, a turn on.
    pub fn column(&self, i: usize) -> f64 {
        let turns = if i < self.posts.columns() { 0.0 } else { self.globe.turn() };
        self.posts.plan(i % self.posts.columns(), 0).x + turns
    }
}
