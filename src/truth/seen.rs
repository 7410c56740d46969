//! Which boxes of the plan a view may see, so that footprints elsewhere are left out.

use super::tile::Frustum;
use crate::index::BoxTree;
use crate::space::{PlanBox, Screen, ViewFrame};
use crate::terrain::Mesh;

/// What a view may see of the plan.
pub(super) enum SeenPlan {
    /// What lies under the terrain, between its heights, in the view.
    Below { frustum: Box<Frustum>, bounds: PlanBox, heights: (f64, f64) },
    /// The boxes of the plan of those leaves of the terrain's hierarchy that may be seen.
    Leaves(BoxTree),
}

impl SeenPlan {
    /// What a view of a terrain may see.
    pub(super) fn new(mesh: &Mesh, view: &ViewFrame) -> Self {
        let end = Screen::new(view.width() as f64, view.height() as f64);
        Self::of_window(mesh, view, [Screen::default(), end])
    }

    /// What a window of a view, from its upper left to its lower right corner, may see of a terrain.
    pub(super) fn of_window(mesh: &Mesh, view: &ViewFrame, [from, to]: [Screen; 2]) -> Self {
        let frustum = Frustum::new(view, [from.x, from.y], [to.x, to.y]);
        if let Some(heights) = mesh.heights() {
            return Self::Below { frustum: Box::new(frustum), bounds: mesh.plan_bounds(), heights };
        }
        let mut leaves = Vec::new();
        frustum.for_each_leaf(mesh, mesh.root(), &mut |node, _| leaves.extend(mesh.plan_of(node)));
        Self::Leaves(BoxTree::new(&leaves))
    }

    /// Whether some terrain over a box may be seen.
    pub(super) fn meets(&self, plan: &PlanBox) -> bool {
        match self {
            Self::Below { frustum, bounds, heights } => {
                plan.meets(bounds) && frustum.meets_plan(plan, *heights)
            }
            Self::Leaves(leaves) => !leaves.query(plan, |_| false),
        }
    }
}
