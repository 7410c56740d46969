//! The triangle-clipping DAGs of the quads in use and the triangles of fills as buffers: tables that a graphics processor can have as its storage buffers.

use super::dag::Arrays;
use super::fill::FillTriangle;
use super::mesh::MeshInUse;
use super::{DECLARATION, Prepare};
use crate::buffer::{Plane, Values};
use crate::canvas::{FrameOptions, picture_plane, table};
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
    let mut quads: Vec<Quad> = prepared.quads(mesh, view).iter().map(|of| of.data).collect();
    quads.sort_unstable();
    quads.dedup();
    let mut arrays = prepared.store.arrays(mesh, &quads)?;
    let of = |name| plane(name, &mut arrays).or_else(|| of_fills(name, prepared));
    Ok(wanted.filter_map(of).collect())
}

/// A table of the fills' triangles.
fn of_fills(name: &'static str, prepared: &Prepare) -> Option<Plane> {
    let fills = &prepared.fills;
    Some(match name {
        "fill-vertices" => table(name, &mut fills.vertices().to_vec(), Values::F64),
        "fill-triangles" => {
            let row = |of: &FillTriangle| [of.item, of.corners[0], of.corners[1], of.corners[2]];
            table(name, &mut fills.triangles().iter().map(row).collect(), Values::U32)
        }
        _ => return None,
    })
}

/// A structure, taken out of the arrays.
fn plane(name: &'static str, arrays: &mut Arrays) -> Option<Plane> {
    Some(match name {
        "quads" => table(name, &mut arrays.quads, Values::U32),
        "polylines" => table(name, &mut arrays.polylines, Values::U32),
        "quad-clippings" => table(name, &mut arrays.quad_clippings, Values::U32),
        "triangle-clippings" => table(name, &mut arrays.triangle_clippings, Values::U32),
        "line-vertices" => table(name, &mut arrays.vertices, Values::F64),
        "crossings" => table(name, &mut arrays.crossings, Values::F64),
        "directions" => {
            let directions = take(&mut arrays.directions);
            picture_plane(name, [1, directions.len()], 1, Values::U8(directions))
        }
        _ => return None,
    })
}
