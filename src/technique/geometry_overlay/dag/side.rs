//! On which side of what a moved point lies: east by an infinitesimal step, north by a still smaller one, the same for all points of chains.
//!
//! Posts stay where they are. So no moved point lies on an edge, and no post on the line through two moved points.

use super::grid::GridPoint;
use crate::predicate::orient2d;
use crate::space::Plan;
use crate::terrain::lod::Post;

/// Whether a post lies left of the way from one moved point to another, which is elsewhere.
///
/// The determinant's terms in the step: (q.y - p.y) east - (q.x - p.x) north.
pub fn is_left_of_way(p: GridPoint, q: GridPoint, post: Post) -> bool {
    let side = orient2d(plan(p), plan(q), plan(post.map(f64::from)));
    if side != 0.0 {
        side > 0.0
    } else if p[1] != q[1] {
        q[1] > p[1]
    } else {
        q[0] < p[0]
    }
}

/// Whether a moved point lies left of the edge from one post to another.
///
/// The determinant's terms in the step: -(b.y - a.y) east + (b.x - a.x) north.
pub fn is_left_of_edge([a, b]: [Post; 2], point: GridPoint) -> bool {
    let side = orient2d(plan(a.map(f64::from)), plan(b.map(f64::from)), plan(point));
    if side != 0.0 {
        side > 0.0
    } else if a[1] != b[1] {
        b[1] < a[1]
    } else {
        b[0] > a[0]
    }
}

/// The predicates speak of points of the plan; any plane will do.
fn plan([x, y]: GridPoint) -> Plan {
    Plan::new(x, y)
}
