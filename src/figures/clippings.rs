//! Triangle clippings as geometry overlay has them.

use super::shot::{Shot, Tables};
use crate::error::Result;
use crate::space::Plan;
use crate::technique::Kind;

/// A row that there is not.
const NONE: u32 = u32::MAX;

/// The part of a line in a triangle of some layer.
pub(super) struct Clipping {
    /// Its row.
    pub(super) row: usize,
    /// The triangle: apex, left and right corner, in columns and rows of posts.
    pub(super) corners: [Plan; 3],
    /// How often halves of halves are smaller.
    pub(super) layer: u32,
    /// The line in it.
    pub(super) line: Vec<Plan>,
    /// Where it goes on: `nextTriangle[0]`, `nextTriangle[1]`.
    pub(super) next: [Option<usize>; 2],
}

/// All clippings of a scene's lines.
pub(super) fn clippings(shot: &Shot) -> Result<Vec<Clipping>> {
    let buffers = ["triangle-clippings", "line-vertices", "crossings"];
    let frame = shot.frame(Kind::GeometryOverlay, &buffers)?;
    let (vertices, crossings) = (points(&frame, "line-vertices")?, points(&frame, "crossings")?);
    let clipping = |(row, told): (usize, &[u32; 16])| {
        let post = |k: usize| Plan::new(f64::from(told[k]), f64::from(told[k + 1]));
        let corners = [post(0), post(2), post(4)];
        let crossing = |at: u32| crossings.get(at as usize).copied();
        let within = vertices.get(told[8] as usize..told[9] as usize).unwrap_or_default();
        let line = crossing(told[10]).into_iter().chain(within.iter().copied()).chain(crossing(told[11]));
        let next = [told[12], told[13]].map(|next| (next != NONE).then_some(next as usize));
        Clipping { row, corners, layer: layer(&corners), line: line.collect(), next }
    };
    let rows = frame.whole::<16>("triangle-clippings")?;
    Ok(rows.iter().enumerate().map(clipping).collect())
}

/// The layer of a triangle: the square over its longest side doubles from one to the next.
fn layer(corners: &[Plan; 3]) -> u32 {
    let square = (corners[1] - corners[2]).length_squared();
    (1..64).find(|layer| f64::from(1u32 << layer.min(&31)) >= square).unwrap_or(1) - 1
}

fn points(frame: &Tables, name: &str) -> Result<Vec<Plan>> {
    Ok(frame.real::<2>(name)?.iter().map(|[column, row]| Plan::new(*column, *row)).collect())
}
