//! Parts and vertices of a feature.

use crate::scene::Shape;
use crate::space::Plan;

/// Where a vertex is: in which part, and where in it.
pub(super) type Place = (usize, usize);

/// The places of all vertices.
pub(super) fn places(shape: &Shape) -> Vec<Place> {
    shape.parts().enumerate().flat_map(|(part, points)| (0..points.len()).map(move |k| (part, k))).collect()
}

/// The shape with some of its vertices, sorted; `None`: too few are left to draw anything.
pub(super) fn with(shape: &Shape, kept: &[Place]) -> Option<Shape> {
    let least = match shape {
        Shape::Polygon(_) | Shape::MultiPolygon(_) | Shape::Swath { .. } => 3,
        Shape::Line(_) => 2,
        Shape::Points(_) => 1,
    };
    let mut left: Vec<Vec<Plan>> = shape.parts().map(|_| Vec::new()).collect();
    for (part, k) in kept {
        let point = shape.parts().nth(*part)?.get(*k)?;
        left[*part].push(*point);
    }
    // A part is whole enough, or gone.
    if left.iter().any(|part| !part.is_empty() && part.len() < least) {
        return None;
    }
    left.retain(|part| !part.is_empty());
    match shape {
        _ if left.is_empty() => None,
        Shape::Polygon(_) | Shape::MultiPolygon(_) | Shape::Swath { .. } => Some(Shape::Polygon(left)),
        Shape::Line(_) => Some(Shape::Line(left)),
        Shape::Points(_) => left.pop().map(Shape::Points),
    }
}

/// The shape in whole metres; `None`: it is already.
pub(super) fn in_whole_metres(shape: &Shape) -> Option<Shape> {
    let whole = |part: &Vec<Plan>| part.iter().map(|p| Plan::new(p.x.round(), p.y.round())).collect();
    let parts: Vec<Vec<Plan>> = shape.parts().map(whole).collect();
    let is_whole = parts.iter().eq(shape.parts());
    let new = match shape {
        Shape::Polygon(_) => Shape::Polygon(parts),
        Shape::MultiPolygon(_) | Shape::Swath { .. } => return None,
        Shape::Line(_) => Shape::Line(parts),
        Shape::Points(_) => Shape::Points(parts.concat()),
    };
    (!is_whole).then_some(new)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ring_has_three_vertices_at_least_and_a_hole_may_go() {
        let ring = |n: usize| (0..n).map(|k| Plan::new(k as f64, (k * k) as f64)).collect::<Vec<_>>();
        let polygon = Shape::Polygon(vec![ring(5), ring(4)]);
        let all = places(&polygon);
        assert_eq!(all.len(), 9);
        assert_eq!(with(&polygon, &all), Some(polygon.clone()));
        assert_eq!(with(&polygon, &all[..5]), Some(Shape::Polygon(vec![ring(5)])));
        assert_eq!(with(&polygon, &all[..6]), None);
        assert_eq!(with(&polygon, &[]), None);
    }
}
