//! Areas in rational arithmetic, for tests.

use dashu::rational::RBig;

/// The area of a union of convex polygons in a window (least x, least y, greatest x, greatest y): slabs between all vertices and crossings
/// of the window's and the polygons' sides.
pub(super) fn union_area(shapes: &[Vec<[f64; 2]>], window: [f64; 4]) -> f64 {
    let exact = |v: f64| RBig::try_from(v).unwrap();
    let [west, north, east, south] = window.map(exact);
    let mut edges: Vec<[RBig; 4]> = vec![
        [west.clone(), north.clone(), west.clone(), south.clone()],
        [east.clone(), north.clone(), east.clone(), south.clone()],
    ];
    for shape in shapes {
        for k in 0..shape.len() {
            let (a, b) = (shape[k], shape[(k + 1) % shape.len()]);
            edges.push([exact(a[0]), exact(a[1]), exact(b[0]), exact(b[1])]);
        }
    }
    let mut heights = vec![north.clone(), south.clone()];
    for (k, [ax, ay, bx, by]) in edges.iter().enumerate() {
        heights.push(ay.clone());
        for [cx, cy, dx, dy] in &edges[..k] {
            let across = (bx - ax) * (dy - cy) - (by - ay) * (dx - cx);
            if across != RBig::ZERO {
                let t = ((cx - ax) * (dy - cy) - (cy - ay) * (dx - cx)) / across;
                heights.push(ay + (by - ay) * t);
            }
        }
    }
    heights.retain(|y| *y >= north && *y <= south);
    heights.sort();
    heights.dedup();
    let mut area = RBig::ZERO;
    for pair in heights.windows(2) {
        let middle = (&pair[0] + &pair[1]) / RBig::from(2);
        let mut spans: Vec<(RBig, RBig)> = Vec::new();
        for shape in shapes {
            let mut hits = Vec::new();
            for k in 0..shape.len() {
                let [a, b] = [shape[k], shape[(k + 1) % shape.len()]].map(|p| [exact(p[0]), exact(p[1])]);
                if (a[1] <= middle) != (b[1] <= middle) {
                    hits.push(&a[0] + (&b[0] - &a[0]) * (&middle - &a[1]) / (&b[1] - &a[1]));
                }
            }
            hits.sort();
            if let [first, .., last] = &hits[..] {
                let (low, high) = (first.max(&west).clone(), last.min(&east).clone());
                if low < high {
                    spans.push((low, high));
                }
            }
        }
        spans.sort();
        let (mut length, mut end) = (RBig::ZERO, west.clone());
        for (low, high) in spans {
            let low = low.max(end.clone());
            if high > low {
                length += &high - &low;
                end = high;
            }
        }
        area += length * (&pair[1] - &pair[0]);
    }
    area.to_f64().value()
}
