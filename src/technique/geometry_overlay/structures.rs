//! The triangle-clipping DAGs of the quads in use as buffers: tables that a graphics processor can have as its storage buffers.

use super::dag::Arrays;
use super::mesh::MeshInUse;
use super::{DECLARATION, Prepare};
use crate::buffer::{Plane, Values};
use crate::canvas::{FrameOptions, picture_plane};
use crate::error::Result;
use crate::space::ViewFrame;
use crate::terrain::lod::Quad;
use std::mem::take;

/// The structures that are wanted, of the quads whose data a view is drawn by; nothing is done where none is wanted.
///
/// # Errors
/// When there are more rows than can be numbered.
pub(super) fn planes(
    prepared: &Prepare,
    (mesh, view): (&MeshInUse, &ViewFrame),
    options: &FrameOptions,
) -> Result<Vec<Plane>> {
    let kinds = DECLARATION.planes.iter().filter(|kind| kind.is_structure && options.wants(kind.name));
    let mut wanted = kinds.map(|kind| kind.name).peekable();
    if wanted.peek().is_none() {
        return Ok(Vec::new());
    }
    let mut quads: Vec<Quad> = mesh.quads(view).iter().map(|of| of.data).collect();
    quads.sort_unstable();
    quads.dedup();
    let mut arrays = prepared.store.arrays(mesh, &quads)?;
    Ok(wanted.filter_map(|name| plane(name, &mut arrays)).collect())
}

/// A structure, taken out of the arrays.
fn plane(name: &'static str, arrays: &mut Arrays) -> Option<Plane> {
    Some(match name {
        "quads" => numbers(name, &mut arrays.quads),
        "polylines" => numbers(name, &mut arrays.polylines),
        "quad-clippings" => numbers(name, &mut arrays.quad_clippings),
        "triangle-clippings" => numbers(name, &mut arrays.triangle_clippings),
        "line-vertices" => places(name, &mut arrays.vertices),
        "crossings" => places(name, &mut arrays.crossings),
        "directions" => {
            let directions = take(&mut arrays.directions);
            picture_plane(name, [1, directions.len()], 1, Values::U8(directions))
        }
        _ => return None,
    })
}

/// A table of whole numbers.
fn numbers<const N: usize>(name: &'static str, rows: &mut Vec<[u32; N]>) -> Plane {
    picture_plane(name, [N, rows.len()], 1, Values::U32(take(rows).into_flattened()))
}

/// A table of places in columns and rows of posts.
fn places(name: &'static str, rows: &mut Vec<[f64; 2]>) -> Plane {
    picture_plane(name, [2, rows.len()], 1, Values::F64(take(rows).into_flattened()))
}
