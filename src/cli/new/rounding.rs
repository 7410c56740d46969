//! Numbers of a starter scene, rounded for who reads them.

/// A number to two digits.
pub(super) fn two_digits(number: f64) -> f64 {
    let rounded = format!("{number:.1e}").parse().unwrap_or(number);
    if rounded > 0.0 { rounded } else { 1.0 }
}

/// The greatest power of ten that is no more than this.
pub(super) fn step(pixel: f64) -> f64 {
    let mut step = 1.0;
    while step > pixel && step > 1e-9 {
        step /= 10.0;
    }
    while step * 10.0 <= pixel {
        step *= 10.0;
    }
    step
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_two_digits() {
        assert_eq!([145.6, 0.0123, 9.96, 0.0].map(two_digits), [150.0, 0.012, 10.0, 1.0]);
    }
}
