//! Another surface, or from elsewhere.

use super::super::edit::Edit::{Keys, Scene};
use super::super::geometry as g;
use super::bug::{Bug, Class::Visibility as Here};
use crate::technique::Kind;

/// The bugs.
pub(super) const BUGS: &[Bug] = &[
    Bug::any(Here, "wrong diagonal", Keys(&["terrain.diagonal=\"nw-se\""])),
    Bug::any(Here, "diagonals that alternate", Keys(&["terrain.diagonal=\"alternating\""])),
    Bug::any(Here, "heights a fiftieth more", Scene(g::heights_a_fiftieth_more)),
    Bug::any(Here, "heights in steps", Scene(g::heights_in_steps)),
    Bug::any(Here, "heights in feet", Scene(g::heights_in_feet)),
    Bug::any(Here, "heights smoothed", Scene(g::heights_smoothed)),
    Bug::any(Here, "posts half a cell off", Scene(g::posts_half_a_cell_off)),
    Bug::any(Here, "a post without height", Scene(g::a_post_without_height)),
    Bug::any(Here, "rows from the north", Scene(g::rows_from_the_north)),
    Bug::any(Here, "eye a hundredth higher", Scene(g::eye_higher)),
    Bug::any(Here, "eye a hundredth beside", Scene(g::eye_beside)),
    Bug::any(Here, "a fiftieth wider an angle", Scene(g::wider_angle)),
    Bug::any(Here, "parallel rays", Scene(g::parallel_rays)),
    Bug::any(Here, "near plane too far", Scene(g::near_plane_too_far)),
    Bug::any(Here, "near plane ignored", Scene(g::near_plane_ignored)),
    Bug::any(Here, "far plane ignored", Scene(g::far_plane_ignored)),
    Bug::any(Here, "far plane too near", Scene(g::far_plane_too_near)),
    Bug::any(Here, "mesh of a coarser level", Keys(&["terrain.lod.error_px=6"])),
    Bug::any(Here, "no level of detail", Keys(&["terrain.lod="])),
    Bug::any(Here, "depths of 16 bits before a near plane at 0.1 m", Scene(g::depths_of_16_bits)),
    Bug::of(
        &[Kind::GeometryOverlay],
        Here,
        "hidden lines shown",
        Keys(&[
            "technique.geometry-overlay.offset_factor=4000",
            "technique.geometry-overlay.offset_units=1e7",
        ]),
    ),
    Bug::of(
        &[Kind::GeometryOverlay],
        Here,
        "no polygon offset",
        Keys(&["technique.geometry-overlay.offset_factor=0", "technique.geometry-overlay.offset_units=0"]),
    ),
    Bug::of(
        &[Kind::GeometryOverlay],
        Here,
        "polygon offset towards the eye",
        Keys(&["technique.geometry-overlay.offset_factor=-1", "technique.geometry-overlay.offset_units=-1"]),
    ),
];
