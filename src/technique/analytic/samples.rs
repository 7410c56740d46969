//! What the samples of a pixel see that is not told by areas.

use super::facet::{Corner, Facet};
use super::sheet::Sheet;
use crate::canvas::GBuffer;
use crate::space::{Plan, ViewFrame};
use crate::terrain::{Mesh, SKY};
use glam::DVec2;
use std::borrow::Cow;

/// What a sample sees: a triangle and a point of the plan; `None`: the sky.
type Sample<'a> = Option<(Cow<'a, Facet>, Plan)>;

/// What a sample sees that has been looked for.
pub(super) fn seen_sample<'s>(
    (view, mesh): (&ViewFrame, &Mesh),
    origin: DVec2,
    seen: &GBuffer,
    [column, row]: [usize; 2],
) -> Sample<'s> {
    let id = seen.triangle(column, row);
    if id == SKY {
        return None;
    }
    let triangle = mesh.surface_triangle(id)?;
    let corners = triangle.world.map(|corner| Corner::new(view, origin, corner));
    let facet = Facet::new(view, id, &corners, triangle.plan())?;
    Some((Cow::Owned(facet), seen.plan(column, row)))
}

/// What a point of a pixel sees by the pixel's fragments.
pub(super) fn fragment_at(sheet: &Sheet, at: [usize; 2], screen: DVec2) -> Sample<'_> {
    let fragment = sheet.fragments(at).find(|fragment| sheet.holds(fragment, screen))?;
    let facet = &sheet.facets[fragment.facet as usize];
    Some((Cow::Borrowed(facet), facet.plan_at(screen)))
}
