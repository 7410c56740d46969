//! The Pareto front: what nothing else beats in both time and error.

/// The indices of the points (time, error) that no other point is at least as good as in both and better than in one, the fastest
/// first. Of equal points the first is on the front.
pub fn front(points: &[[f64; 2]]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by(|a, b| {
        let (p, q) = (points[*a], points[*b]);
        p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])).then(a.cmp(b))
    });
    let mut least = f64::INFINITY;
    order.retain(|k| {
        let error = points[*k][1];
        let is_better = error < least;
        least = if is_better { error } else { least };
        is_better
    });
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_slower_point_is_on_the_front_only_when_it_is_more_right() {
        assert_eq!(front(&[[1.0, 5.0], [2.0, 6.0], [3.0, 1.0], [3.0, 2.0], [9.0, 1.0]]), [0, 2]);
    }

    #[test]
    fn of_equal_points_the_first_is_on_the_front() {
        assert_eq!(front(&[[2.0, 1.0], [1.0, 1.0], [1.0, 1.0]]), [1]);
        assert_eq!(front(&[]), [0_usize; 0]);
    }

    proptest! {
        #[test]
        fn every_point_off_the_front_is_beaten_and_none_on_it(
            points in prop::collection::vec((0..8u8, 0..8u8), 1..30)
        ) {
            let points: Vec<[f64; 2]> = points.iter().map(|(t, e)| [f64::from(*t), f64::from(*e)]).collect();
            let front = front(&points);
            let beats = |a: usize, b: usize| {
                let (p, q) = (points[a], points[b]);
                p[0] <= q[0] && p[1] <= q[1] && (p != q || a < b)
            };
            for k in 0..points.len() {
                let is_beaten = (0..points.len()).any(|other| other != k && beats(other, k));
                prop_assert_eq!(front.contains(&k), !is_beaten);
            }
        }
    }
}
