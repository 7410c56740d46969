//! Polygons that lie over one another made one: the border of their union.
//!
//! Input: the members of a multi-polygon as rings, and which windings are inside one. Output: [`union_border`]: rings of which the same
//! windings are inside what any member holds; `None` where no point is in two members, so that the rings as they are already tell;
//! [`border_outside`]: those of what no member holds, within a frame. Refuses: members that cross more often than can be held.
//!
//! Whether members overlap is decided exactly. Where edges cross, the border has a corner at the crossing, rounded to doubles: the edges
//! that meet there bend by the last digit of their coordinates. What such a bend makes cross anew is cut again, until edges meet at their
//! ends alone; then each edge's sides are told exactly by the windings along a line to the east.

mod contact;
mod edge;
mod edges;
mod planar;

use crate::error::Result;
use crate::space::{Plan, PlanBox};
use edges::{Edges, Rings};

/// The border of the union of some polygons, each given as rings (closed, the first vertex once) of which `is_inside` tells what windings
/// are inside; `None` where no two of them overlap. Where members overlap the union is on the left of its rings; members away from them
/// keep theirs.
///
/// # Errors
/// When they cross too often.
pub fn union_border(members: &[Rings], is_inside: &(dyn Fn(i32) -> bool + Sync)) -> Result<Option<Rings>> {
    let entangled = edges::entangled(members);
    if entangled.is_empty() {
        return Ok(None);
    }
    let edges = Edges::new(entangled.iter().flat_map(|&member| edges::of_member(members, member)).collect());
    if !edges.are_in_contact() && !edges.lie_in_another(members, &entangled, is_inside) {
        return Ok(None);
    }
    let sides = planar::sides(&planar::cut(edges)?, is_inside);
    if !sides.overlap() {
        return Ok(None);
    }
    let mut border = sides.border();
    let others = (0..members.len()).filter(|member| entangled.binary_search(member).is_err());
    border.extend(others.flat_map(|member| members[member].iter().cloned()));
    Ok(Some(border))
}

/// The rings around all that is outside of every one of some polygons, within a frame, on their left: around points of the frame they turn
/// once, or not at all, whatever the polygons' own rings do. What polygons have beyond the frame they have with them.
///
/// # Errors
/// When they cross too often.
pub fn border_outside(
    members: &[Rings],
    frame: &PlanBox,
    is_inside: &(dyn Fn(i32) -> bool + Sync),
) -> Result<Rings> {
    let PlanBox { min, max } = *frame;
    let mut border = vec![vec![min, Plan::new(max.x, min.y), max, Plan::new(min.x, max.y)]];
    let edges = (0..members.len()).flat_map(|member| edges::of_member(members, member)).collect();
    let union = planar::sides(&planar::cut(Edges::new(edges))?, is_inside).border();
    border.extend(union.into_iter().map(|ring| ring.into_iter().rev().collect()));
    Ok(border)
}

#[cfg(test)]
mod tests;
