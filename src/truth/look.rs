//! Single pixels looked at closely: what each sees, piece by piece, beside its right colour.

use super::Budget;
use super::outcome::PixelLook;
use super::seen::SeenPlan;
use super::setting::Setting;
use super::tile::seen_in_pixel;
use crate::draw_list::DrawList;
use crate::footprint::{Footprints, PixelSize};
use crate::parallel;
use crate::space::{Screen, ViewFrame};
use crate::stage::Stage;
use crate::terrain::Mesh;

/// The footprints of a list near what a window of a view sees; all that the window's pixels see may lie in others is left out.
pub fn footprints_seen<'l>(
    list: &'l DrawList,
    (mesh, view): (&Mesh, &ViewFrame),
    window: [Screen; 2],
) -> Footprints<'l> {
    let seen = SeenPlan::of_window(mesh, view, window);
    Footprints::new(list, PixelSize::of(view, mesh), &|plan| seen.meets(plan))
}

/// Looks at some pixels (column, row) of a view of a stage, whose mesh for it this is. The footprints are those near all that these pixels see.
pub fn look(
    stage: &Stage,
    (mesh, view): (&Mesh, &ViewFrame),
    footprints: &Footprints,
    (pixels, budget): (&[[usize; 2]], Budget),
) -> Vec<PixelLook> {
    let size = PixelSize::of(view, mesh);
    let setting = Setting::new(&stage.scene, mesh, (footprints, size), budget);
    parallel::map(pixels, |pixel| seen_in_pixel(&setting, (mesh, view), *pixel))
}
