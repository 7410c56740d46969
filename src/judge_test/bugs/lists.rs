//! Lists, cells and tiles.

use super::super::edit::Edit::{Keys, Picture, Scene, Tile};
use super::super::{geometry as g, picture};
use super::bug::{Bug, Class::Lists as Here};
use crate::technique::Kind;

/// The bugs.
pub(super) const BUGS: &[Bug] = &[
    Bug::any(Here, "layers reversed", Scene(g::layers_reversed)),
    Bug::any(Here, "features reversed", Scene(g::features_reversed)),
    Bug::any(Here, "lists of one", Scene(g::first_features_only)),
    Bug::any(Here, "everything listed twice", Scene(g::features_twice)),
    Bug::any(Here, "a tile's list truncated", Tile(&Scene(g::first_features_only))),
    Bug::any(Here, "a tile without lines", Tile(&Scene(g::line_missing))),
    Bug::any(Here, "a tile's list unsorted", Tile(&Scene(g::layers_reversed))),
    Bug::any(Here, "a tile's features reversed", Tile(&Scene(g::features_reversed))),
    Bug::any(Here, "a leaf taken for outside", Tile(&Scene(g::fills_missing))),
    Bug::any(Here, "a leaf's turn wrong", Tile(&Scene(g::inside_out))),
    Bug::any(Here, "a cell off by one", Tile(&Scene(g::data_half_a_cell_off))),
    Bug::any(Here, "a cell's hole forgotten", Tile(&Scene(g::holes_dropped))),
    Bug::any(Here, "a tile blended twice", Tile(&Scene(g::features_twice))),
    Bug::any(Here, "a tile dropped", Picture(picture::a_tile_dropped)),
    Bug::any(Here, "tiles swapped", Picture(picture::tiles_swapped)),
    Bug::any(Here, "a column twice", Picture(picture::a_column_twice)),
    Bug::any(Here, "a row twice", Picture(picture::a_row_twice)),
    Bug::any(Here, "last row missing", Picture(picture::last_row_missing)),
    Bug::of(
        &[Kind::DynamicLine],
        Here,
        "lists as they are found",
        Keys(&["technique.dynamic-line.sorting=\"none\""]),
    ),
    Bug::of(
        &[Kind::DynamicLine],
        Here,
        "an entry a segment",
        Keys(&["technique.dynamic-line.overlaps=\"double\""]),
    ),
    Bug::of(
        &[Kind::StaticDecal],
        Here,
        "a hit a segment",
        Keys(&["technique.static-decal.overlaps=\"double\""]),
    ),
    Bug::of(
        &[Kind::Clipmap],
        Here,
        "tiles of the wrong place",
        Keys(&["technique.clipmap.center=[1e5,1e5]", "technique.clipmap.clip_size=256"]),
    ),
];
