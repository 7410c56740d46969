//! What a target of premultiplied codes adds to what a picture with translucent pixels may be.

use super::picture::CODES;
use super::pixel::BLEND;
use crate::compare::Hypothesis;
use crate::math;

/// An alpha that reaches what is opaque, and is no less than this share of it, is that of an opaque pixel, rounded some times.
const OPAQUE: f64 = 0.96;

/// The same picture out of a target that holds premultiplied codes, whose colours are divided by their alpha; `None` where all is opaque.
pub(super) fn premultiplied(of: &Hypothesis) -> Option<Hypothesis> {
    if of.lo.iter().zip(&of.hi).all(|(lo, hi)| is_opaque(lo[3], hi[3])) {
        return None;
    }
    let mut picture = of.clone();
    picture.name += "-premultiplied";
    picture.says += ", in a target that holds premultiplied codes";
    picture.lo.iter_mut().zip(&mut picture.hi).for_each(|(lo, hi)| divide_by_alpha(lo, hi));
    picture.choices.iter_mut().for_each(|choice| divide_by_alpha(&mut choice.lo, &mut choice.hi));
    Some(picture)
}

fn is_opaque(lo: u16, hi: u16) -> bool {
    hi == u16::MAX && f64::from(lo) >= OPAQUE * CODES
}

/// Widens a pixel's colours: what is held of them is off by as much as its alpha is said to be, as the alpha is; the quotient by twice that over the
/// least alpha; and it is rounded once more.
fn divide_by_alpha(lo: &mut [u16; 4], hi: &mut [u16; 4]) {
    if is_opaque(lo[3], hi[3]) {
        return;
    }
    let (least, slack) = (f64::from(lo[3]), f64::from(hi[3].saturating_sub(lo[3])) / 2.0);
    let off = if least > 0.0 { (2.0 * slack / least + BLEND) * CODES } else { CODES };
    for c in 0..3 {
        lo[c] = math::max(f64::from(lo[c]) - off, 0.0).floor() as u16;
        hi[c] = math::min(f64::from(hi[c]) + off, CODES).ceil() as u16;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_half_transparent_colour_loses_as_much_again_four_times_and_an_opaque_one_nothing() {
        let opaque = Hypothesis {
            lo: vec![[257, 514, 771, 65004]],
            hi: vec![[300, 600, 900, 65535]],
            ..Hypothesis::default()
        };
        assert_eq!(premultiplied(&opaque), None);
        // An alpha of 128 of 255, half a code value off.
        let sky = Hypothesis {
            lo: vec![[20000, 20000, 20000, 32765]],
            hi: vec![[20260, 20260, 20260, 33027]],
            ..opaque
        };
        let wider = premultiplied(&sky).unwrap();
        assert_eq!(wider.name, "-premultiplied");
        // 2 (131 / 32765) + 0.51 / 255, of 65535.
        assert_eq!((wider.lo[0], wider.hi[0]), ([19344, 19344, 19344, 32765], [20916, 20916, 20916, 33027]));
    }
}
