//! Which edges a path from a point crosses.

use crate::predicate::orient2d;
use crate::space::Plan;

/// The numbers in which points are told apart.
pub(super) trait Arithmetic {
    type Number: Copy + PartialOrd;

    /// A coordinate as the machine holds it.
    fn number(of: f64) -> Self::Number;

    /// Whether a point, moved to the north-east as the module says, lies left of the line from one point to another that differs from it.
    fn is_left(from: [Self::Number; 2], to: [Self::Number; 2], at: [Self::Number; 2]) -> bool;
}

/// Doubles, and signs that are always right.
pub(super) struct Exact;

impl Arithmetic for Exact {
    type Number = f64;

    #[inline(always)]
    fn number(of: f64) -> f64 {
        of
    }

    #[inline(always)]
    fn is_left([ax, ay]: [f64; 2], [bx, by]: [f64; 2], [x, y]: [f64; 2]) -> bool {
        let side = orient2d(Plan::new(ax, ay), Plan::new(bx, by), Plan::new(x, y));
        // A step to the east comes first, and then one to the north.
        side > 0.0 || (side == 0.0 && (by < ay || (by == ay && bx > ax)))
    }
}

/// What a graphics processor has: single precision, for coordinates and products alike.
pub(super) struct Single;

impl Arithmetic for Single {
    type Number = f32;

    #[inline(always)]
    fn number(of: f64) -> f32 {
        of as f32
    }

    #[inline(always)]
    fn is_left([ax, ay]: [f32; 2], [bx, by]: [f32; 2], [x, y]: [f32; 2]) -> bool {
        let side = (bx - ax) * (y - ay) - (by - ay) * (x - ax);
        side > 0.0 || (side == 0.0 && (by < ay || (by == ay && bx > ax)))
    }
}

#[inline(always)]
fn sign(is_positive: bool) -> i32 {
    if is_positive { 1 } else { -1 }
}

/// What the winding number of a point is above that of a corner to its south-east: what the edges say that a path crosses which goes from the
/// point to the east until it is above the corner, and there south to it. `corner.x >= at.x`, `corner.y <= at.y`.
///
/// Point, bend and corner are all moved to the north-east by the same steps. So no end of an edge lies on the path, an edge is crossed or is
/// not, and all that are crossed meet the rectangle between the point and the corner, border included.
///
/// Where an edge lies of the corner does not depend on the point, and is exact in any arithmetic, as the corner's own winding number is: in single
/// precision an edge through the corner would turn all of a leaf inside out.
pub(super) fn turns_above<A: Arithmetic>(
    edges: impl Iterator<Item = (Plan, Plan)>,
    corner: Plan,
    at: Plan,
) -> i32 {
    let point = |p: Plan| [A::number(p.x), A::number(p.y)];
    let exact = |p: Plan| [p.x, p.y];
    let at = point(at);
    let bend = [A::number(corner.x), at[1]];
    let mut turns = 0;
    for (from, to) in edges {
        let (a, b) = (point(from), point(to));
        let (rises, is_level) = (a[1] <= at[1], (a[1] <= at[1]) == (b[1] <= at[1]));
        if is_level && (!rises || (from.y <= corner.y && to.y <= corner.y)) {
            // All of it is higher than the path, or all of it lower.
            continue;
        }
        let (goes_east, is_upright) = (from.x <= corner.x, (from.x <= corner.x) == (to.x <= corner.x));
        if is_upright {
            // It can be crossed on the way to the east only.
            if goes_east && !is_level && A::is_left(a, b, at) == rises {
                turns += sign(rises);
            }
            continue;
        }
        let bend_is_left = A::is_left(a, b, bend);
        if !is_level && bend_is_left != rises && A::is_left(a, b, at) == rises {
            turns += sign(rises);
        }
        if bend_is_left == goes_east && Exact::is_left(exact(from), exact(to), exact(corner)) != goes_east {
            turns += sign(goes_east);
        }
    }
    turns
}
