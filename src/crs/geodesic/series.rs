//! The series of the geodesic's integrals to the sixth order: Karney (2013), section 2 and eqs. 40 to 43.
//!
//! They are in epsilon, by which the geodesic's k is small, those of the longitude in the third flattening n too.

use crate::crs::fourier::{polynomial, polynomials};

/// A1 - what distances are to arcs (eq. 17).
pub(super) fn a1(epsilon: f64) -> f64 {
    let e2 = epsilon * epsilon;
    (1.0 + e2 * (1.0 / 4.0 + e2 * (1.0 / 64.0 + e2 / 256.0))) / (1.0 - epsilon)
}

/// From an arc to the distance: C1 (eq. 18).
#[rustfmt::skip]
pub(super) fn c1(epsilon: f64) -> [f64; 6] {
    let rows: [&[f64]; 6] = [
        &[0.0, -1.0 / 2.0, 0.0, 3.0 / 16.0, 0.0, -1.0 / 32.0],
        &[0.0, 0.0, -1.0 / 16.0, 0.0, 1.0 / 32.0, 0.0, -9.0 / 2048.0],
        &[0.0, 0.0, 0.0, -1.0 / 48.0, 0.0, 3.0 / 256.0],
        &[0.0, 0.0, 0.0, 0.0, -5.0 / 512.0, 0.0, 3.0 / 512.0],
        &[0.0, 0.0, 0.0, 0.0, 0.0, -7.0 / 1280.0],
        &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -7.0 / 2048.0],
    ];
    polynomials(rows, epsilon)
}

/// From a distance to the arc: C1' (eq. 21).
#[rustfmt::skip]
pub(super) fn c1_inverse(epsilon: f64) -> [f64; 6] {
    let rows: [&[f64]; 6] = [
        &[0.0, 1.0 / 2.0, 0.0, -9.0 / 32.0, 0.0, 205.0 / 1536.0],
        &[0.0, 0.0, 5.0 / 16.0, 0.0, -37.0 / 96.0, 0.0, 1335.0 / 4096.0],
        &[0.0, 0.0, 0.0, 29.0 / 96.0, 0.0, -75.0 / 128.0],
        &[0.0, 0.0, 0.0, 0.0, 539.0 / 1536.0, 0.0, -2391.0 / 2560.0],
        &[0.0, 0.0, 0.0, 0.0, 0.0, 3467.0 / 7680.0],
        &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 38081.0 / 61440.0],
    ];
    polynomials(rows, epsilon)
}

/// A2, of the reduced length (eq. 42).
pub(super) fn a2(epsilon: f64) -> f64 {
    let e2 = epsilon * epsilon;
    (1.0 - epsilon) * (1.0 + e2 * (1.0 / 4.0 + e2 * (9.0 / 64.0 + e2 * (25.0 / 256.0))))
}

/// C2, of the reduced length (eq. 43).
#[rustfmt::skip]
pub(super) fn c2(epsilon: f64) -> [f64; 6] {
    let rows: [&[f64]; 6] = [
        &[0.0, 1.0 / 2.0, 0.0, 1.0 / 16.0, 0.0, 1.0 / 32.0],
        &[0.0, 0.0, 3.0 / 16.0, 0.0, 1.0 / 32.0, 0.0, 35.0 / 2048.0],
        &[0.0, 0.0, 0.0, 5.0 / 48.0, 0.0, 5.0 / 256.0],
        &[0.0, 0.0, 0.0, 0.0, 35.0 / 512.0, 0.0, 7.0 / 512.0],
        &[0.0, 0.0, 0.0, 0.0, 0.0, 63.0 / 1280.0],
        &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 77.0 / 2048.0],
    ];
    polynomials(rows, epsilon)
}

/// A3, of the longitude (eq. 24).
pub(super) fn a3(n: f64, epsilon: f64) -> f64 {
    let rows = [
        1.0,
        -(1.0 - n) / 2.0,
        -(1.0 / 4.0 + n * (1.0 / 8.0 - n * (3.0 / 8.0))),
        -(1.0 / 16.0 + n * (3.0 / 16.0 + n * (1.0 / 16.0))),
        -(3.0 / 64.0 + n / 32.0),
        -3.0 / 128.0,
    ];
    polynomial(&rows, epsilon)
}

/// C3, of the longitude (eq. 25); it ends at the fifth.
#[rustfmt::skip]
pub(super) fn c3(n: f64, epsilon: f64) -> [f64; 6] {
    let n2 = n * n;
    let rows: [&[f64]; 6] = [
        &[0.0, (1.0 - n) / 4.0, (1.0 - n2) / 8.0, (3.0 + 3.0 * n - n2) / 64.0, (5.0 + 2.0 * n) / 128.0, 3.0 / 128.0],
        &[0.0, 0.0, (2.0 - 3.0 * n + n2) / 32.0, (3.0 - 2.0 * n - 3.0 * n2) / 64.0, (3.0 + n) / 128.0, 5.0 / 256.0],
        &[0.0, 0.0, 0.0, (5.0 - 9.0 * n + 5.0 * n2) / 192.0, (9.0 - 10.0 * n) / 384.0, 7.0 / 512.0],
        &[0.0, 0.0, 0.0, 0.0, (7.0 - 14.0 * n) / 512.0, 7.0 / 512.0],
        &[0.0, 0.0, 0.0, 0.0, 0.0, 21.0 / 2560.0],
        &[],
    ];
    polynomials(rows, epsilon)
}
