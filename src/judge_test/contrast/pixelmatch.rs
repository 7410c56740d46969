//! Differing pixels as pixelmatch counts them: by a distance of colours in YIQ (Kotsarenko & Ramos 2010, *Measuring perceived color difference
//! using YIQ NTSC transmission color space in mobile applications*), without those that look like anti-aliasing (Vysniauskas 2009,
//! *Anti-aliased pixel and intensity slope detector*).

use super::super::edit::Picture;

/// Its usual threshold.
const THRESHOLD: f64 = 0.1;

/// The largest distance there is.
const MOST: f64 = 35_215.0;

/// How many pixels differ.
pub(super) fn differing(expected: &Picture, actual: &Picture) -> usize {
    let limit = MOST * THRESHOLD * THRESHOLD;
    let places = (0..expected.height()).flat_map(|y| (0..expected.width()).map(move |x| (x, y)));
    let differs = |(x, y): &(usize, usize)| {
        distance(*expected.at(*x, *y), *actual.at(*x, *y)) > limit
            && !is_smooth(expected, actual, *x, *y)
            && !is_smooth(actual, expected, *x, *y)
    };
    places.filter(differs).count()
}

/// Red, green and blue over white.
fn over_white([r, g, b, a]: [u8; 4]) -> [f64; 3] {
    let share = f64::from(a) / 255.0;
    [r, g, b].map(|v| 255.0 + (f64::from(v) - 255.0) * share)
}

fn brightness(code: [u8; 4]) -> f64 {
    let [r, g, b] = over_white(code);
    r * 0.298_895_31 + g * 0.586_622_47 + b * 0.114_482_23
}

/// The square of the distance of two colours.
fn distance(a: [u8; 4], b: [u8; 4]) -> f64 {
    if a == b {
        return 0.0;
    }
    let (a, b) = (over_white(a), over_white(b));
    let [r, g, b] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let y = r * 0.298_895_31 + g * 0.586_622_47 + b * 0.114_482_23;
    let i = r * 0.595_977_99 - g * 0.274_176_10 - b * 0.321_801_89;
    let q = r * 0.211_470_17 - g * 0.522_617_11 + b * 0.311_146_94;
    0.5053 * y * y + 0.299 * i * i + 0.1957 * q * q
}

fn neighbours(of: &Picture, x: usize, y: usize) -> impl Iterator<Item = (usize, usize)> {
    let (right, bottom) = ((x + 1).min(of.width() - 1), (y + 1).min(of.height() - 1));
    let all = (y.saturating_sub(1)..=bottom)
        .flat_map(move |row| (x.saturating_sub(1)..=right).map(move |column| (column, row)));
    all.filter(move |place| *place != (x, y))
}

/// Whether a pixel looks anti-aliased: it lies between a darker and a brighter neighbour, one of which has many equals around it in both
/// pictures, and few neighbours are its equals.
fn is_smooth(picture: &Picture, other: &Picture, x: usize, y: usize) -> bool {
    let own = brightness(*picture.at(x, y));
    let is_border =
        |x: usize, y: usize| x == 0 || y == 0 || x == picture.width() - 1 || y == picture.height() - 1;
    let mut equal = usize::from(is_border(x, y));
    let mut ends = [(0.0, x, y); 2];
    for (column, row) in neighbours(picture, x, y) {
        let by = brightness(*picture.at(column, row)) - own;
        equal += usize::from(by == 0.0);
        if by < ends[0].0 {
            ends[0] = (by, column, row);
        }
        if by > ends[1].0 {
            ends[1] = (by, column, row);
        }
    }
    let has_equals = |of: &Picture, x: usize, y: usize| {
        let alike = neighbours(of, x, y).filter(|(column, row)| of.at(*column, *row) == of.at(x, y)).count();
        alike + usize::from(is_border(x, y)) > 2
    };
    equal <= 2
        && ends.iter().all(|(by, ..)| *by != 0.0)
        && ends.iter().any(|(_, x, y)| has_equals(picture, *x, *y) && has_equals(other, *x, *y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::buffer::Buffer;

    #[test]
    fn a_lonely_pixel_differs_and_a_slope_between_two_plains_does_not() {
        let plain = |edge: u8| {
            let row = |x: usize| {
                if x < 4 {
                    0
                } else if x == 4 {
                    edge
                } else {
                    255
                }
            };
            let pixels = (0..72).map(|k| row(k % 9)).map(|v| [v, v, v, 255]);
            Buffer::from_values(9, 8, pixels.collect())
        };
        assert_eq!(differing(&plain(100), &plain(180)), 0);
        let mut spot = plain(100).values().to_vec();
        spot[9 * 4 + 1] = [255, 0, 0, 255];
        assert_eq!(differing(&plain(100), &Buffer::from_values(9, 8, spot)), 1);
    }
}
