//! Sums of sines of even multiples of an angle, which auxiliary latitudes and geodesics are made of, and the polynomials of a small
//! number that their coefficients are.

/// The sum of `c[j] sin(2 (j + 1) x)` by Clenshaw's recurrence, of the sine and cosine of 2 x.
pub(super) fn sines(c: &[f64; 6], (sin_2x, cos_2x): (f64, f64)) -> f64 {
    let twice_cosine = 2.0 * cos_2x;
    let (next, _) = c.iter().rev().fold((0.0, 0.0), |(b, after), c| (c + twice_cosine * b - after, b));
    next * sin_2x
}

/// A polynomial, by its coefficients from the constant on.
pub(super) fn polynomial(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Several of them at one place.
pub(super) fn polynomials(rows: [&[f64]; 6], x: f64) -> [f64; 6] {
    rows.map(|row| polynomial(row, x))
}
