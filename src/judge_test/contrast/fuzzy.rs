//! A comparison as dEQP's fuzzy one: pictures are blurred a little, and each pixel may be found beside its place; what is left counts by its
//! fourth power.

use super::super::edit::Picture;

/// What it lets pass.
pub(super) const THRESHOLD: f64 = 0.05;

/// Codes of difference that do not count.
const FREE: f64 = 4.0;

/// Places between pixels that are looked at, a side; dEQP takes 32 at random.
const BETWEEN: usize = 6;

/// The sum of errors.
pub(super) fn error(expected: &Picture, actual: &Picture) -> f64 {
    let pictures = [Blurred::of(expected), Blurred::of(actual)];
    let inner = |n: usize| 1..n.saturating_sub(1);
    let places = inner(expected.height()).flat_map(|y| inner(expected.width()).map(move |x| (x, y)));
    let of = |(x, y): (usize, usize)| {
        let [a, b] = &pictures;
        let least = crate::math::min(b.nearest(a.at(x, y), x, y), a.nearest(b.at(x, y), x, y));
        least * least * least * least
    };
    places.map(of).sum()
}

/// A blurred picture.
struct Blurred {
    width: usize,
    height: usize,
    codes: Vec<[f64; 4]>,
}

impl Blurred {
    fn of(picture: &Picture) -> Self {
        let (width, height) = (picture.width(), picture.height());
        let codes: Vec<[f64; 4]> = picture.values().iter().map(|code| code.map(f64::from)).collect();
        let across = |codes: &[[f64; 4]], [dx, dy]: [usize; 2]| -> Vec<[f64; 4]> {
            let at = |x: usize, y: usize| codes[x.min(width - 1) + width * y.min(height - 1)];
            let blurred = |k: usize| {
                let (x, y) = (k % width, k / width);
                let [before, here, after] =
                    [at(x.saturating_sub(dx), y.saturating_sub(dy)), at(x, y), at(x + dx, y + dy)];
                std::array::from_fn(|c| (0.1 * before[c] + 0.8 * here[c] + 0.1 * after[c]).round())
            };
            (0..codes.len()).map(blurred).collect()
        };
        let codes = across(&across(&codes, [1, 0]), [0, 1]);
        Self { width, height, codes }
    }

    fn at(&self, x: usize, y: usize) -> [f64; 4] {
        self.codes[x.min(self.width - 1) + self.width * y.min(self.height - 1)]
    }

    /// Between pixels, from the centre of the first.
    fn between(&self, x: f64, y: f64) -> [f64; 4] {
        let (x, y) = (crate::math::max(x, 0.0), crate::math::max(y, 0.0));
        let (left, top) = (x.floor() as usize, y.floor() as usize);
        let (s, t) = (x.fract(), y.fract());
        let corners =
            [self.at(left, top), self.at(left + 1, top), self.at(left, top + 1), self.at(left + 1, top + 1)];
        let weights = [(1.0 - s) * (1.0 - t), s * (1.0 - t), (1.0 - s) * t, s * t];
        std::array::from_fn(|c| {
            corners.iter().zip(weights).map(|(corner, w)| corner[c] * w).sum::<f64>().round()
        })
    }

    /// The least difference of a colour from what is at a place and around it.
    fn nearest(&self, code: [f64; 4], x: usize, y: usize) -> f64 {
        let mut least = difference(code, self.at(x, y));
        if least == 0.0 {
            return least;
        }
        for (column, row) in (y - 1..=y + 1).flat_map(|row| (x - 1..=x + 1).map(move |column| (column, row)))
        {
            least = crate::math::min(least, difference(code, self.at(column, row)));
        }
        let step = |k: usize| (k as f64 + 0.5) / BETWEEN as f64 * 2.0 - 1.0;
        for (k, l) in (0..BETWEEN).flat_map(|l| (0..BETWEEN).map(move |k| (k, l))) {
            let sample = self.between(x as f64 + step(k), y as f64 + step(l));
            least = crate::math::min(least, difference(code, sample));
        }
        least
    }
}

fn difference(a: [f64; 4], b: [f64; 4]) -> f64 {
    let of = |c: usize| crate::math::max((a[c] - b[c]).abs() - FREE, 0.0) / (255.0 - FREE);
    (0..4).map(|c| of(c) * of(c)).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::buffer::Buffer;

    fn square(at: usize) -> Picture {
        let is_in = |k: usize| (at..at + 5).contains(&(k % 16)) && (4..9).contains(&(k / 16));
        let code = |k| if is_in(k) { [200, 30, 30, 255] } else { [255; 4] };
        Buffer::from_values(16, 16, (0..256).map(code).collect())
    }

    #[test]
    fn what_lies_a_pixel_beside_passes_and_what_is_missing_does_not() {
        assert!(error(&square(4), &square(5)) <= THRESHOLD);
        let blank = Buffer::from_values(16, 16, vec![[255; 4]; 256]);
        assert!(error(&square(4), &blank) > THRESHOLD);
    }
}
