//! Fills, and strokes in metres, as tables that are searched from end to end: for bundles without structures of them.

use crate::frame::Frame;
use crate::geometry::{self, Item, Point};
use crate::tables::Tables;

const NONE: u32 = u32::MAX;

/// Joins and caps as `glsl/stroke.glsl` counts them.
fn style(item: &Item) -> [u32; 6] {
    let word = |key: &str| item.style[key].as_str().unwrap_or("");
    let join = match word("drawn-join") {
        "bevel" => 1,
        "miter" => 2,
        "miter-round" => 3,
        _ => 0,
    };
    let cap = match word("drawn-cap") {
        "square" => 1,
        "round" => 2,
        _ => 0,
    };
    [item.kind, item.rule, item.side, join, cap, NONE]
}

/// On which side of most of a chain's segments its polygon lies: 1 left, 2 right.
fn inside(item: &Item, points: &[Point]) -> u32 {
    let mut votes = 0;
    for (k, a) in points.iter().enumerate() {
        let b = points[(k + 1) % points.len()];
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let middle = [(a[0] + b[0]) / 2.0 - dy * 1e-6, (a[1] + b[1]) / 2.0 + dx * 1e-6];
        votes += if geometry::holds(item, middle) { 1 } else { -1 };
    }
    if votes > 0 { 1 } else { 2 }
}

/// The tables of `glsl/stroke.glsl` and `glsl/statics.glsl`.
pub fn tables(frame: &Frame, items: &[Item], by_side: bool, twice: bool) -> Tables {
    let mut vertices: Vec<Point> = Vec::new();
    let (mut segments, mut segments_of) = (Vec::new(), Vec::new());
    let (mut edges, mut members, mut polygon_of) = (Vec::new(), Vec::new(), Vec::new());
    for (number, item) in (0..).zip(items) {
        segments_of.extend([segments.len() as u32 / 6, 0]);
        for chain in item.chains.iter().filter(|_| item.width_m().is_some()) {
            let (first, n) = (vertices.len() as u32, chain.points.len() as u32);
            vertices.extend(&chain.points);
            let inside = if by_side && item.side != 0 { inside(item, &chain.points) } else { 0 };
            let side = if item.side == 2 && inside != 0 { 3 - inside } else { inside };
            let count = if n == 1 || chain.closed { n } else { n - 1 };
            for k in 0..count {
                let at = |k: u32| first + k % n;
                let before = if k > 0 || chain.closed { at(k + n - 1) } else { NONE };
                let after = if k + 2 < n || chain.closed { at(k + 2) } else { NONE };
                segments.extend([number, at(k), at(if n == 1 { 0 } else { k + 1 }), before, after, side]);
            }
        }
        let last = segments_of.len() - 1;
        segments_of[last] = segments.len() as u32 / 6 - segments_of[last - 1];
        polygon_of.extend([members.len() as u32 / 2, item.members.len() as u32]);
        for rings in &item.members {
            let first = edges.len() as u32 / 4;
            let skip = if frame.bug == "missing-hole" { 1 } else { rings.len() };
            for ring in rings.iter().take(skip) {
                for (k, a) in ring.iter().enumerate() {
                    edges.extend(a.iter().chain(&ring[(k + 1) % ring.len()]).map(|v| *v as f32));
                }
            }
            members.extend([first, edges.len() as u32 / 4 - first]);
        }
    }
    let mut tables = Tables::default();
    let wider = if frame.bug == "wide-lines" { 1.05 } else { 1.0 };
    let values = items.iter().flat_map(|item| {
        let limit = item.style["drawn-miter-limit"].as_f64().unwrap_or(0.0);
        [(item.width_m().unwrap_or(0.0) / 2.0 * wider) as f32, limit as f32]
    });
    tables.single("VALUES", values);
    tables.single("VERTICES", vertices.iter().flatten().map(|v| *v as f32));
    tables.single("RING_EDGES", edges);
    tables.whole("SEGMENTS", segments);
    tables.whole("SEGMENTS_OF", segments_of);
    tables.whole("MEMBERS", members);
    tables.whole("POLYGON_OF", polygon_of);
    tables.whole("STYLES", items.iter().flat_map(style));
    tables.whole("ITEM_STYLES", 0..items.len() as u32);
    tables.number("ITEM_COUNT", items.len() as i32);
    tables.number("TWICE", i32::from(twice));
    tables
}
