//! The structures as buffers: tables that a graphics processor can have as its storage buffers (Fig. 4.2).

use super::DECLARATION;
use crate::buffer::{Plane, Values};
use crate::canvas::{FrameOptions, picture_plane, table};
use crate::decal::{Arrays, Decals};
use crate::error::Result;
use std::mem::take;

/// The structures that are wanted, which are built for that; none are built where none is wanted. `progress` is told the share that is done.
///
/// # Errors
/// When there are more rows than can be numbered.
pub(super) fn planes(
    decals: &Decals,
    options: &FrameOptions,
    progress: &(dyn Fn(f64) + Sync),
) -> Result<Vec<Plane>> {
    let kinds = DECLARATION.planes.iter().filter(|kind| kind.is_structure && options.wants(kind.name));
    let mut wanted = kinds.map(|kind| kind.name).peekable();
    if wanted.peek().is_none() {
        return Ok(Vec::new());
    }
    let mut arrays = decals.arrays(progress)?;
    Ok(wanted.filter_map(|name| plane(name, &mut arrays)).collect())
}

/// A structure, taken out of the arrays.
fn plane(name: &'static str, arrays: &mut Arrays) -> Option<Plane> {
    Some(match name {
        "grid" => table(name, &mut arrays.grid.to_vec(), Values::F64),
        "cells" => table(name, &mut arrays.cells, Values::U32),
        "line-nodes" => column(name, &mut arrays.line_nodes),
        "line-boxes" => table(name, &mut arrays.line_boxes, Values::F64),
        "segments" => table(name, &mut arrays.segments, Values::U32),
        "polygon-nodes" => column(name, &mut arrays.polygon_nodes),
        "polygon-boxes" => table(name, &mut arrays.polygon_boxes, Values::F64),
        "polygons" => table(name, &mut arrays.polygons, Values::U32),
        "areas" => table(name, &mut arrays.areas, Values::U32),
        "ring-parts" => table(name, &mut arrays.ring_parts, Values::U32),
        "rings" => table(name, &mut arrays.rings, Values::U32),
        "quadtree-boxes" => table(name, &mut arrays.quadtree_boxes, Values::F64),
        "quadtree-nodes" => table(name, &mut arrays.quadtree_nodes, Values::U32),
        "quadtree-leaves" => table(name, &mut arrays.quadtree_leaves, Values::U32),
        "quadtree-edges" => table(name, &mut arrays.quadtree_edges, Values::U32),
        "decal-vertices" => table(name, &mut arrays.vertices, Values::F64),
        "items" => table(name, &mut arrays.items, Values::U32),
        "styles" => table(name, &mut arrays.styles, Values::U32),
        "style-values" => table(name, &mut arrays.style_values, Values::F64),
        _ => return None,
    })
}

/// A table of one column.
fn column(name: &'static str, values: &mut Vec<u32>) -> Plane {
    picture_plane(name, [1, values.len()], 1, Values::U32(take(values)))
}
