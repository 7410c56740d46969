//! What tests of judges share: pictures against what is allowed.

#![allow(dead_code, reason = "each test file uses its part")]
#![allow(clippy::unwrap_used, reason = "helpers of tests are no tests to the lint")]

use drapery::buffer::Buffer;
use drapery::buffer::Values;
use drapery::compare::{Allowed, Hypothesis, StageRange};
use drapery::stage::Stage;
use drapery::technique::{Frame, Kind};

/// How many pixels of a picture a hypothesis does not allow.
pub fn outside(hypothesis: &Hypothesis, image: &Buffer<[u8; 4]>) -> usize {
    strangers(hypothesis, image).len()
}

/// The pixels of a picture that a hypothesis does not allow.
pub fn strangers(hypothesis: &Hypothesis, image: &Buffer<[u8; 4]>) -> Vec<u32> {
    let fits = |code: &[u8; 4], lo: &[u16; 4], hi: &[u16; 4]| {
        (0..4).all(|c| (lo[c]..=hi[c]).contains(&(u16::from(code[c]) * 257)))
    };
    let mut choices = hypothesis.choices.chunk_by(|a, b| a.pixel == b.pixel).peekable();
    let pixels = (0u32..).zip(image.values()).filter(|(pixel, code)| {
        let k = *pixel as usize;
        let of_pixel = choices.next_if(|of| of[0].pixel == *pixel);
        let is_chosen = of_pixel.is_none_or(|of| of.iter().any(|c| fits(code, &c.lo, &c.hi)));
        !(is_chosen && fits(code, &hypothesis.lo[k], &hypothesis.hi[k]))
    });
    pixels.map(|(pixel, _)| pixel).collect()
}

/// What a stage's picture may be by a technique.
pub fn allowed_of(kind: Kind, stage: &Stage) -> Allowed {
    drapery::allowed::allowed(kind, (stage, &stage.view().unwrap()), &|_| {})
        .unwrap_or_else(|e| panic!("{e}"))
}

/// The fewest pixels outside of any hypothesis.
pub fn best(allowed: &Allowed, image: &Buffer<[u8; 4]>) -> usize {
    allowed.hypotheses.iter().map(|hypothesis| outside(hypothesis, image)).min().unwrap()
}

/// How many pixels may be more than two code values apart (and the hair that arithmetic in single precision is given).
pub fn wide(hypothesis: &Hypothesis) -> usize {
    let is_wide = |(lo, hi): (&[u16; 4], &[u16; 4])| (0..4).any(|c| hi[c] - lo[c] > 2 * 257 + 26);
    hypothesis.lo.iter().zip(&hypothesis.hi).filter(|pixel| is_wide(*pixel)).count()
}

/// Machines within the envelopes of exact mathematics.
pub const MACHINES: [&[&str]; 5] = [
    &[],
    &["device.subpixel_bits=8"],
    &["device.subpixel_bits=8", "device.precision=\"f32\""],
    &["device.subpixel_bits=4", "device.precision=\"f32\"", "device.depth=\"unorm24\""],
    &["device.subpixel_bits=4"],
];

/// How many values of a buffer lie out of what is allowed of it.
pub fn outside_of_stage(allowed: &Allowed, frame: &Frame, name: &str) -> usize {
    let plane = frame.planes.iter().find(|plane| plane.name == name).unwrap();
    let Values::F64(values) = &plane.values else { panic!("{name}") };
    let stage = allowed.stages.iter().find(|stage| stage.buffer == name).unwrap();
    let StageRange::Between { lo, hi, .. } = &stage.range else { panic!("{name}") };
    values.iter().zip(lo).zip(hi).filter(|((v, lo), hi)| !(*lo..=*hi).contains(v)).count()
}
