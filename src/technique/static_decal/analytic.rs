//! Edges by distance instead of samples (`edges = "analytic"`): one look at each pixel.

use crate::decal::{Decals, Palette, PlanPixel, Shares};
use crate::resolve::Paint;
use crate::space::{Plan, Screen, ViewFrame};
use crate::terrain::{Mesh, SKY};
use crate::visibility::FootprintPlane;
use glam::DVec2;

/// Paints pixels by the shares that items cover.
pub(super) struct EdgePainter<'a> {
    view: &'a ViewFrame,
    mesh: &'a Mesh,
    decals: &'a Decals<'a>,
    palette: &'a Palette<'a>,
}

impl<'a> EdgePainter<'a> {
    /// Over a view of a terrain.
    pub(super) fn new(
        view: &'a ViewFrame,
        mesh: &'a Mesh,
        decals: &'a Decals<'a>,
        palette: &'a Palette<'a>,
    ) -> Self {
        Self { view, mesh, decals, palette }
    }

    /// What a pixel shows whose centre sees a plan point of a triangle, over the ground there; and which items it found.
    pub(super) fn paint(
        &self,
        (triangle, at, [x, y]): (u32, Plan, [usize; 2]),
        ground: Paint,
        shares: &mut Shares,
    ) -> Paint {
        if triangle == SKY || !at.is_finite() {
            return ground;
        }
        let surface = self.mesh.surface_triangle(triangle);
        let centre = Screen::new(x as f64 + 0.5, y as f64 + 0.5);
        let reach = surface.and_then(|surface| FootprintPlane::new(self.view, &surface).footprint(centre));
        // A plane that is seen edge-on has no footprint: its point tells.
        let steps = reach.map_or([DVec2::ZERO; 2], |reach| [reach.dx, reach.dy]);
        self.decals.cover(&PlanPixel { at, steps }, shares);
        self.palette.over_shares(ground, shares)
    }
}
