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
        /// How many places of the buffer, pixels or samples.
        pixels: usize,
        /// The first of them: column and row in the buffer.
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
    let finer = finer(range, width * height);
    let components = components(range);
    let expected = [width * finer, height * finer, components];
    let actual = [buffer.width(), buffer.height(), buffer.channels()];
    if expected != actual {
        return StageOutcome::AnotherSize { expected, actual };
    }
    let wrong: Vec<usize> = match range {
        StageRange::Between { lo, hi, .. } => {
            let ends = lo.chunks_exact(components).zip(hi.chunks_exact(components));
            let values = buffer.reals(components);
            let places = values.chunks_exact(components).zip(ends).enumerate();
            // What is not a number is nowhere.
            let fits = |v: &[f64], (lo, hi): (&[f64], &[f64])| {
                (0..components).all(|k| v[k] >= lo[k] && v[k] <= hi[k])
            };
            places.filter(|(_, (v, ends))| !fits(v, *ends)).map(|(at, _)| at).collect()
        }
        StageRange::OneOf(rows) => {
            let places = rows.chunk_by(|a, b| a.0 == b.0).map(|rows| (rows[0].0 as usize, rows));
            let is_one =
                |(at, rows): &(usize, &[(u32, f64)])| rows.iter().any(|row| row.1 == buffer.value(*at));
            places.filter(|found| !is_one(found)).map(|(at, _)| at).collect()
        }
    };
    let row = width * finer;
    let counts = |at: &usize| {
        let pixel = at / row / finer * width + at % row / finer;
        ignored.is_none_or(|ignored| !ignored[pixel])
    };
    let mut wrong = wrong.into_iter().filter(counts);
    match wrong.next() {
        None => StageOutcome::Fits,
        Some(first) => StageOutcome::Differs { pixels: 1 + wrong.count(), first: (first % row, first / row) },
    }
}

fn components(range: &StageRange) -> usize {
    match range {
        StageRange::Between { components, .. } => *components,
        StageRange::OneOf(_) => 1,
    }
}

/// How many times as wide and as high as the picture a buffer is: one of samples has some a pixel.
fn finer(range: &StageRange, pixels: usize) -> usize {
    let places = match range {
        StageRange::Between { components, lo, .. } => lo.len() / components,
        // As a rule the last places have values.
        StageRange::OneOf(rows) => rows.last().map_or(0, |row| row.0 as usize + 1),
    };
    let squared = places.div_ceil(pixels).max(1);
    let root = squared.isqrt();
    if root * root < squared { root + 1 } else { root }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(range: StageRange, buffer: Image, ignored: Option<&[bool]>) -> StageOutcome {
        let stage = Stage { buffer: "depth".into(), range };
        let given = BTreeMap::from([("depth".to_owned(), buffer)]);
        stages(&[stage], (2, 2), &given, ignored).remove(0).outcome
    }

    fn buffer(channels: usize, values: &[f64]) -> Image {
        Image::new(2, 2, channels, values.to_vec()).unwrap()
    }

    fn between(components: usize, lo: f64, hi: f64) -> StageRange {
        StageRange::Between { components, lo: vec![lo; 4 * components], hi: vec![hi; 4 * components] }
    }

    #[test]
    fn values_lie_between_two_ends_and_what_is_no_number_does_not() {
        let of = |values: [f64; 4]| found(between(1, 1.0, f64::INFINITY), buffer(1, &values), None);
        assert_eq!(of([1.0, 2.0, 3.0, f64::INFINITY]), StageOutcome::Fits);
        assert_eq!(of([1.0, 2.0, 0.5, f64::NAN]), StageOutcome::Differs { pixels: 2, first: (0, 1) });
        let pairs = found(between(2, 0.0, 1.0), buffer(2, &[0.0, 1.0, 0.0, 2.0, 3.0, 4.0, 0.0, 0.0]), None);
        assert_eq!(pairs, StageOutcome::Differs { pixels: 2, first: (1, 0) });
    }

    #[test]
    fn a_value_is_one_of_its_pixels_and_anything_where_there_are_none() {
        let rows = || StageRange::OneOf(vec![(1, 7.0), (1, 8.0), (2, 9.0)]);
        assert_eq!(found(rows(), buffer(1, &[5.0, 8.0, 9.0, f64::NAN]), None), StageOutcome::Fits);
        let wrong = buffer(1, &[5.0, 6.0, 6.0, 5.0]);
        assert_eq!(found(rows(), wrong.clone(), None), StageOutcome::Differs { pixels: 2, first: (1, 0) });
        let ignored = [false, true, false, false];
        assert_eq!(found(rows(), wrong, Some(&ignored)), StageOutcome::Differs { pixels: 1, first: (0, 1) });
    }

    #[test]
    fn a_buffer_of_samples_is_finer_than_the_picture() {
        let samples = |values: Vec<f64>| Image::new(4, 4, 1, values).unwrap();
        let one = |at: usize| (0..16).map(|k| if k == at { 1.0 } else { 0.0 }).collect::<Vec<f64>>();
        let range = || StageRange::Between { components: 1, lo: vec![0.0; 16], hi: vec![0.5; 16] };
        // In the third row, second column: in the pixel of the second row.
        let ignored = [false, false, true, false];
        assert_eq!(found(range(), samples(one(9)), None), StageOutcome::Differs { pixels: 1, first: (1, 2) });
        assert_eq!(found(range(), samples(one(9)), Some(&ignored)), StageOutcome::Fits);
        let rows = || StageRange::OneOf(vec![(9, 1.0), (14, 0.0)]);
        assert_eq!(found(rows(), samples(one(9)), None), StageOutcome::Fits);
        assert_eq!(found(rows(), samples(one(8)), None), StageOutcome::Differs { pixels: 1, first: (1, 2) });
        assert!(matches!(found(rows(), buffer(1, &[0.0; 4]), None), StageOutcome::AnotherSize { .. }));
    }

    #[test]
    fn another_size_is_told() {
        let wide = Image::new(4, 1, 1, vec![0.0; 4]).unwrap();
        let outcome = found(between(1, 0.0, 1.0), wide, None);
        assert_eq!(outcome, StageOutcome::AnotherSize { expected: [2, 2, 1], actual: [4, 1, 1] });
    }
}
