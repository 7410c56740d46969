//! The judge, as the judge's test asks it.

use super::edit::Picture;
use crate::compare::{Allowed, Choice, Hypothesis};

/// What the judge says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Judgement {
    /// Right.
    Pass,
    /// Within what is allowed, but all that is open resolved one way.
    Weak,
    /// Wrong.
    Fail,
}

/// Judges a picture.
pub(super) fn judge(allowed: &Allowed, picture: &Picture) -> Judgement {
    match allowed.hypotheses.iter().any(|hypothesis| fits(hypothesis, picture)) {
        true => Judgement::Pass,
        false => Judgement::Fail,
    }
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
    let is_wide = |(lo, hi): &(&[u16; 4], &[u16; 4])| (0..4).any(|c| hi[c].saturating_sub(lo[c]) > 2 * 257 + 2);
    let count = first.lo.iter().zip(&first.hi).filter(is_wide).count();
    count as f64 / first.lo.len().max(1) as f64
}

fn fits(hypothesis: &Hypothesis, picture: &Picture) -> bool {
    let is_within = |code: &[u8; 4], lo: &[u16; 4], hi: &[u16; 4]| {
        (0..4).all(|c| (lo[c]..=hi[c]).contains(&(u16::from(code[c]) * 257)))
    };
    let mut choices = hypothesis.choices.chunk_by(|a: &Choice, b: &Choice| a.pixel == b.pixel).peekable();
    picture.values().len() == hypothesis.lo.len()
        && (0u32..).zip(picture.values()).all(|(pixel, code)| {
            let of_pixel = choices.next_if(|of| of[0].pixel == pixel);
            let is_chosen = of_pixel.is_none_or(|of| of.iter().any(|c| is_within(code, &c.lo, &c.hi)));
            let k = pixel as usize;
            is_chosen && is_within(code, &hypothesis.lo[k], &hypothesis.hi[k])
        })
}
