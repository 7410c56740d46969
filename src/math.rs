//! The transcendental functions, comparisons and the hash that give the same bits on every machine.
//!
//! std's `sin`, `exp`, ... call the C library, whose results differ between machines; std's `min` and `max` may
//! return either zero for `(-0, +0)`. Everything that can decide a pixel goes through here; `clippy.toml` refuses the rest.

pub use libm::{
    asin, asinh, atan, atan2, atanh, cbrt, cos, cosh, erf, exp, hypot, log as ln, log2, pow, sin, sinh, tan,
    tanh,
};

/// The smaller of two numbers; `b` where they compare equal or either is NaN.
#[inline(always)]
pub fn min(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The larger of two numbers; `b` where they compare equal or either is NaN.
#[inline(always)]
pub fn max(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The smaller of two single-precision numbers; `b` where they compare equal or either is NaN.
#[inline(always)]
pub fn min_f32(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The larger of two single-precision numbers; `b` where they compare equal or either is NaN.
#[inline(always)]
pub fn max_f32(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// Scrambles a number so that neighbours have nothing in common (the finalizer of SplitMix64: Steele, Lea, Flood 2014).
pub const fn scramble(number: u64) -> u64 {
    let mut z = number.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn transcendental_functions_keep_their_bits() {
        assert_eq!(sin(1.0).to_bits(), 0x3fea_ed54_8f09_0cee);
        assert_eq!(cos(1e6).to_bits(), 0x3fed_f9df_9906_d32c);
        assert_eq!(exp(-3.5).to_bits(), 0x3f9e_ec10_18e4_ff66);
    }
}
