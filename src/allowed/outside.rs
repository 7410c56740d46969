//! Which pixels of a picture are not as they may be.

use crate::compare::{Allowed, Hypothesis, Image};

/// The pixels (column + width * row) of a picture that lie outside of what the hypothesis allows that fits it best; all of them where the
/// picture is of another size, or not of red, green, blue and alpha.
pub fn outside(allowed: &Allowed, picture: &Image) -> Vec<usize> {
    let pixels = allowed.width * allowed.height;
    let is_such =
        (picture.width(), picture.height(), picture.channels()) == (allowed.width, allowed.height, 4);
    let of = |hypothesis: &Hypothesis| outside_of(hypothesis, picture);
    let best = allowed.hypotheses.iter().filter(|_| is_such).map(of).min_by_key(Vec::len);
    best.unwrap_or_else(|| (0..pixels).collect())
}

/// The largest code of 16 bits.
const CODES: f64 = 65535.0;

/// A hair of a code, for the division by the largest one.
const HAIR: f64 = 1e-6;

fn outside_of(hypothesis: &Hypothesis, picture: &Image) -> Vec<usize> {
    let is_within = |values: &[f64], lo: &[u16; 4], hi: &[u16; 4]| {
        (0..4).all(|c| {
            let code = values[c] * CODES;
            code >= f64::from(lo[c]) - HAIR && code <= f64::from(hi[c]) + HAIR
        })
    };
    let mut choices = hypothesis.choices.chunk_by(|a, b| a.pixel == b.pixel).peekable();
    let wrong = picture.values().chunks_exact(4).enumerate().filter(|(k, values)| {
        let of_pixel = choices.next_if(|of| of[0].pixel as usize == *k);
        let is_chosen = of_pixel.is_none_or(|of| of.iter().any(|c| is_within(values, &c.lo, &c.hi)));
        !(is_chosen && is_within(values, &hypothesis.lo[*k], &hypothesis.hi[*k]))
    });
    wrong.map(|(k, _)| k).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::Choice;

    #[test]
    fn a_pixel_lies_within_its_range_and_in_one_of_its_choices() {
        let hypothesis = Hypothesis {
            lo: vec![[257 * 10; 4]; 4],
            hi: vec![[257 * 20; 4]; 4],
            choices: [10, 20].map(|v| Choice { pixel: 2, lo: [257 * v; 4], hi: [257 * v; 4] }).to_vec(),
            ..Hypothesis::default()
        };
        let allowed = Allowed { width: 4, height: 1, hypotheses: vec![hypothesis], ..Allowed::default() };
        let picture = |codes: [u8; 4]| {
            Image::new(4, 1, 4, codes.iter().flat_map(|v| [f64::from(*v) / 255.0; 4]).collect()).unwrap()
        };
        assert_eq!(outside(&allowed, &picture([10, 20, 20, 15])), [0; 0]);
        assert_eq!(outside(&allowed, &picture([9, 21, 15, 15])), [0, 1, 2]);
        assert_eq!(outside(&allowed, &Image::new(1, 1, 4, vec![0.0; 4]).unwrap()), [0, 1, 2, 3]);
    }
}
