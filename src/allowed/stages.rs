//! What the buffers behind a picture may be.

use crate::buffer::Buffer;
use crate::compare::{Stage, StageRange};
use crate::terrain::SKY;
use crate::truth::Sample;

/// What a pixel's centre may see: triangles, and the view depths between two.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Seen {
    triangles: Vec<u32>,
    depth: (f64, f64),
}

/// Of a depth beside its own place, the share that rounding of its interpolation may amount to.
const DEPTH_SHARE: f64 = 1.0 / (1 << 20) as f64;

impl Seen {
    /// Any of some triangles, between two view depths.
    pub(super) fn any_of(mut triangles: Vec<u32>, depth: (f64, f64)) -> Self {
        triangles.sort_unstable();
        triangles.dedup();
        Self { triangles, depth }
    }

    /// What a sample at the centre may see; `along` is how far a view depth may be off by its format, metres.
    pub(super) fn of(sample: &Sample, along: &dyn Fn(f64) -> f64) -> Self {
        let triangles = sample.outcomes.iter().map(|outcome| outcome.triangle).collect();
        let doubt =
            |depth: f64| if depth.is_finite() { along(depth) + depth.abs() * DEPTH_SHARE } else { 0.0 };
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for outcome in &sample.outcomes {
            low = crate::math::min(low, outcome.depth.0 - doubt(outcome.depth.0));
            high = crate::math::max(high, outcome.depth.1 + doubt(outcome.depth.1));
        }
        Self::any_of(triangles, (low, high))
    }
}

/// The stages that all techniques share.
pub(super) fn stages(seen: &Buffer<Seen>) -> Vec<Stage> {
    let values = || seen.values().iter();
    let (lo, hi) = values().map(|of| of.depth).unzip();
    let depth = StageRange::Between { components: 1, lo, hi };
    let rows = (0..).zip(values()).filter(|(_, of)| !of.triangles.is_empty());
    let triangles = rows.flat_map(|(pixel, of)| of.triangles.iter().map(move |t| (pixel, f64::from(*t))));
    debug_assert!(values().all(|of| of.triangles != [SKY] || of.depth.0 == f64::INFINITY));
    vec![
        Stage { buffer: "depth".to_owned(), range: depth },
        Stage { buffer: "triangle".to_owned(), range: StageRange::OneOf(triangles.collect()) },
    ]
}
