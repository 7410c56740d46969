//! The judge, as the judge's test asks it.

use super::edit::Picture;
use crate::compare::{Allowed, Gates, Hypothesis, Image, Judgement, Ruling, Submitted};
use crate::error::Result;
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

/// The share of pixels that may be more than two code values apart, by the first hypothesis.
pub(super) fn wide(allowed: &Allowed) -> f64 {
    let Some(first) = allowed.hypotheses.first() else { return 0.0 };
    // A code value is 257 of these; the rounding of both ends is one each.
    let is_wide =
        |(lo, hi): &(&[u16; 4], &[u16; 4])| (0..4).any(|c| hi[c].saturating_sub(lo[c]) > 2 * 257 + 26);
    let count = first.lo.iter().zip(&first.hi).filter(is_wide).count();
    count as f64 / first.lo.len().max(1) as f64
}
