//! Polygons that lie over one another or side by side made one: the border of their union.
//!
//! Input: the members of a multi-polygon as rings, and which windings are inside one, either way around. Output: [`union_border`]: rings of which
//! the same windings are inside what any member holds; `None` where members share no more than points of their borders, so that the rings as they
//! are already tell; [`border_outside`]: those of what no member holds, within a frame; [`triangulated`]: what is inside of rings as triangles. Refuses: members that lie over one another more often than
//! can be held, or told in seconds.
//!
//! Whether members overlap or share a piece of an edge is decided exactly. Where edges cross, the border has a corner at the crossing, rounded to
//! doubles: the edges that meet there bend by the last digit of their coordinates. What such a bend makes cross anew is cut again, until edges
//! meet at their ends alone; then a walk from face to face tells each edge's sides exactly.

mod contact;
mod edge;
mod edges;
mod equal;
mod faces;
mod planar;
mod triangulation;

pub use triangulation::triangulated;

use crate::error::Result;
use crate::space::{Plan, PlanBox};
use edges::Rings;

/// The border of the union of some polygons, each given as rings (closed, the first vertex once) of which `is_inside` tells what windings
/// are inside, either way around; `None` where no two of them overlap, nor lie on both sides of an edge. The union is on the left of its
/// rings; members that share no more than points with others keep theirs.
///
/// # Errors
/// When too many lie over one another.
pub fn union_border(members: &[Rings], is_inside: &(dyn Fn(i32) -> bool + Sync)) -> Result<Option<Rings>> {
    let distinct = equal::distinct(members);
    let entangled = edges::entangled(members, &distinct);
    let edges =
        planar::cut(entangled.iter().flat_map(|&member| edges::of_member(members, member)).collect())?;
    let sides = faces::sides(&edges, members.len(), is_inside)?;
    if distinct.len() == members.len() && !sides.takes_part.contains(&true) {
        return Ok(None);
    }
    let mut border = planar::border(&edges, &sides, |member| sides.takes_part[member as usize]);
    let others = distinct.into_iter().filter(|member| !sides.takes_part[*member]);
    border.extend(others.flat_map(|member| members[member].iter().cloned()));
    Ok(Some(border))
}

/// The rings around all that is outside of every one of some polygons, within a frame, on their left: around points of the frame they turn
/// once, or not at all, whatever the polygons' own rings do. What polygons have beyond the frame they have with them.
///
/// # Errors
/// When too many lie over one another.
pub fn border_outside(
    members: &[Rings],
    frame: &PlanBox,
    is_inside: &(dyn Fn(i32) -> bool + Sync),
) -> Result<Rings> {
    let PlanBox { min, max } = *frame;
    let mut border = vec![vec![min, Plan::new(max.x, min.y), max, Plan::new(min.x, max.y)]];
    let distinct = equal::distinct(members);
    let edges = planar::cut(distinct.iter().flat_map(|&member| edges::of_member(members, member)).collect())?;
    let union = planar::border(&edges, &faces::sides(&edges, members.len(), is_inside)?, |_| true);
    border.extend(union.into_iter().map(|ring| ring.into_iter().rev().collect()));
    Ok(border)
}

#[cfg(test)]
mod tests;
