//! The structures as buffers: tables that a graphics processor can have as its storage buffers (Fig. 4.2).

use super::DECLARATION;
use crate::buffer::{Plane, Values};
use crate::canvas::{FrameOptions, picture_plane};
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
        "grid" => numbers(name, &mut arrays.grid.to_vec()),
        "cells" => counts(name, &mut arrays.cells),
        "line-nodes" => column(name, &mut arrays.line_nodes),
        "line-boxes" => numbers(name, &mut arrays.line_boxes),
        "segments" => counts(name, &mut arrays.segments),
        "polygon-nodes" => column(name, &mut arrays.polygon_nodes),
        "polygon-boxes" => numbers(name, &mut arrays.polygon_boxes),
        "polygons" => counts(name, &mut arrays.polygons),
        "areas" => counts(name, &mut arrays.areas),
        "ring-parts" => counts(name, &mut arrays.ring_parts),
        "rings" => counts(name, &mut arrays.rings),
        "quadtree-boxes" => numbers(name, &mut arrays.quadtree_boxes),
        "quadtree-nodes" => counts(name, &mut arrays.quadtree_nodes),
        "quadtree-leaves" => counts(name, &mut arrays.quadtree_leaves),
        "quadtree-edges" => counts(name, &mut arrays.quadtree_edges),
        "decal-vertices" => numbers(name, &mut arrays.vertices),
        "items" => counts(name, &mut arrays.items),
        "styles" => counts(name, &mut arrays.styles),
        "style-values" => numbers(name, &mut arrays.style_values),
        _ => return None,
    })
}

/// A table of whole numbers.
fn counts<const N: usize>(name: &'static str, rows: &mut Vec<[u32; N]>) -> Plane {
    picture_plane(name, [N, rows.len()], 1, Values::U32(take(rows).into_flattened()))
}

/// A table of doubles.
fn numbers<const N: usize>(name: &'static str, rows: &mut Vec<[f64; N]>) -> Plane {
    picture_plane(name, [N, rows.len()], 1, Values::F64(take(rows).into_flattened()))
}

/// A table of one column.
fn column(name: &'static str, values: &mut Vec<u32>) -> Plane {
    picture_plane(name, [1, values.len()], 1, Values::U32(take(values)))
}
