//! The judge, as the judge's test asks it.

use super::edit::Picture;
use crate::compare::{Allowed, Gates, Hypothesis, Image, Judgement, Ruling, Submitted};
use crate::error::Result;
use serde::Serialize;
use std::path::PathBuf;

/// What the judge says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Said {
    /// Its verdict.
    pub(super) ruling: Ruling,
    /// How many pixels lie outside of what is allowed.
    pub(super) failing: usize,
}

/// Judges a picture.
///
/// # Errors
/// When it has no pixels.
pub(super) fn judge(allowed: &Allowed, picture: &Picture) -> Result<Said> {
    let frame = Submitted::picture(Image::from_rgba8(picture)?, PathBuf::new());
    let judgement = Judgement::on(allowed, &frame, Gates::default());
    let failing = judgement.outcome.as_ref().map_or(picture.values().len(), |fitted| fitted.metrics.failing);
    Ok(Said { ruling: judgement.ruling(), failing })
}

/// What a judge allows who looks at nothing.
pub(super) fn everything(allowed: &Allowed) -> Allowed {
    let pixels = allowed.width * allowed.height;
    let all = Hypothesis {
        name: "everything".into(),
        lo: vec![[0; 4]; pixels],
        hi: vec![[u16::MAX; 4]; pixels],
        ..Hypothesis::default()
    };
    Allowed { hypotheses: vec![all], ..allowed.clone() }
}

/// How narrow what is allowed is, as shares of pixels.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub(super) struct Narrowness {
    /// Those that may be more than two code values apart, in a range.
    pub(super) wide: f64,
    /// Those that may be as far apart, but have to be one of a few colours that are known to two code values.
    pub(super) one_of_few: f64,
}

/// How narrow the first hypothesis is.
pub(super) fn narrowness(allowed: &Allowed) -> Narrowness {
    let Some(first) = allowed.hypotheses.first() else { return Narrowness::default() };
    // A code value is 257 of these; the rounding of both ends is one each.
    let is_wide = |lo: &[u16; 4], hi: &[u16; 4]| (0..4).any(|c| hi[c].saturating_sub(lo[c]) > 2 * 257 + 26);
    let mut is_listed = vec![None; first.lo.len()];
    for of in &first.choices {
        let pixel = &mut is_listed[of.pixel as usize];
        *pixel = Some(pixel.unwrap_or(true) && !is_wide(&of.lo, &of.hi));
    }
    let wide = first.lo.iter().zip(&first.hi).zip(&is_listed).filter(|((lo, hi), _)| is_wide(lo, hi));
    let (few, ranges): (Vec<_>, Vec<_>) = wide.partition(|(_, is_listed)| **is_listed == Some(true));
    let share = |count: usize| count as f64 / first.lo.len().max(1) as f64;
    Narrowness { wide: share(ranges.len()), one_of_few: share(few.len()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::Choice;

    #[test]
    fn a_pixel_of_two_colours_is_not_as_open_as_one_of_all_between() {
        let open = |pixel: u32, lo: u16, hi: u16| Choice { pixel, lo: [lo; 4], hi: [hi; 4] };
        let first = Hypothesis {
            lo: vec![[0; 4]; 4],
            hi: vec![[300; 4], [9000; 4], [9000; 4], [9000; 4]],
            choices: vec![open(1, 0, 200), open(1, 8800, 9000), open(2, 0, 200), open(2, 300, 9000)],
            ..Hypothesis::default()
        };
        let allowed = Allowed { width: 2, height: 2, hypotheses: vec![first], ..Allowed::default() };
        assert_eq!(narrowness(&allowed), Narrowness { wide: 0.5, one_of_few: 0.25 });
    }
}
