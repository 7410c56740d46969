//! Buffers behind a picture: which is the first that differs.

use crate::compare::allowed::{Stage, StageRange};
use crate::compare::image::Image;
use std::collections::BTreeMap;

/// A stage, and what became of it.
#[derive(Debug, Clone, PartialEq)]
pub struct StageFound {
    /// The buffer's name.
    pub buffer: String,
    /// What was found.
    pub outcome: StageOutcome,
}

/// What a buffer was found to be.
#[derive(Debug, Clone, PartialEq)]
pub enum StageOutcome {
    /// It was not handed in.
    NotGiven,
    /// Every value is allowed.
    Fits,
    /// Some pixels have a value that is not.
    Differs {
        /// How many.
        pixels: usize,
        /// The first: column and row.
        first: (usize, usize),
    },
    /// It has another size: columns, rows and values a pixel of what is expected, and of what was handed in.
    AnotherSize {
        /// What is expected.
        expected: [usize; 3],
        /// What was handed in.
        actual: [usize; 3],
    },
}

impl StageFound {
    /// Whether the buffer is not what it may be.
    pub fn differs(&self) -> bool {
        matches!(self.outcome, StageOutcome::Differs { .. } | StageOutcome::AnotherSize { .. })
    }
}

/// What became of each stage of a picture of `width` columns.
pub(super) fn stages(
    stages: &[Stage],
    (width, height): (usize, usize),
    buffers: &BTreeMap<String, Image>,
    ignored: Option<&[bool]>,
) -> Vec<StageFound> {
    let found = |stage: &Stage| {
        let outcome = match buffers.get(&stage.buffer) {
            None => StageOutcome::NotGiven,
            Some(buffer) => outcome(&stage.range, (width, height), buffer, ignored),
        };
        StageFound { buffer: stage.buffer.clone(), outcome }
    };
    stages.iter().map(found).collect()
}

fn outcome(
    range: &StageRange,
    (width, height): (usize, usize),
    buffer: &Image,
    ignored: Option<&[bool]>,
) -> StageOutcome {
    let components = match range {
        StageRange::Between { components, .. } => *components,
        StageRange::OneOf(_) => 1,
    };
    let (expected, actual) =
        ([width, height, components], [buffer.width(), buffer.height(), buffer.channels()]);
    if expected != actual {
        return StageOutcome::AnotherSize { expected, actual };
    }
    let wrong: Vec<usize> = match range {
        StageRange::Between { lo, hi, .. } => {
            let ends = lo.chunks_exact(components).zip(hi.chunks_exact(components));
            let pixels = buffer.values().chunks_exact(components).zip(ends).enumerate();
            // What is not a number is nowhere.
            let fits = |v: &[f64], (lo, hi): (&[f64], &[f64])| {
                (0..components).all(|k| v[k] >= lo[k] && v[k] <= hi[k])
            };
            pixels.filter(|(_, (v, ends))| !fits(v, *ends)).map(|(pixel, _)| pixel).collect()
        }
        StageRange::OneOf(rows) => {
            let pixels = rows.chunk_by(|a, b| a.0 == b.0);
            let pixels = pixels.map(|rows| (rows[0].0 as usize, rows));
            let is_one = |(pixel, rows): &(usize, &[(u32, f64)])| {
                rows.iter().any(|row| row.1 == buffer.values()[*pixel])
            };
            pixels.filter(|found| !is_one(found)).map(|(pixel, _)| pixel).collect()
        }
    };
    let counts = |pixel: &usize| ignored.is_none_or(|ignored| !ignored[*pixel]);
    let mut wrong = wrong.into_iter().filter(counts);
    match wrong.next() {
        None => StageOutcome::Fits,
        Some(first) => {
            StageOutcome::Differs { pixels: 1 + wrong.count(), first: (first % width, first / width) }
        }
    }
}
