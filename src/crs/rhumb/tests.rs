use super::Rhumb;
use crate::crs::ellipsoid::Ellipsoid;
use crate::math::atan2;
use proptest::prelude::*;
use std::f64::consts::TAU;

/// Rhumb lines on WGS 84: both latitudes, degrees to the east; the length, and the place after three tenths of it (degrees to the east,
/// latitude). Computed with mpmath 1.3 in 40 digits from the meridian's integral and the closed form of the isometric latitude.
const REFERENCE: &str = include_str!("reference.txt");

fn between(from: f64, to: f64, east: f64) -> Rhumb {
    Rhumb::between(&Ellipsoid::WGS84, from, to, east)
}

/// Metres between two places (degrees to the east, latitude) that are close to one another.
fn apart(a: (f64, f64), b: (f64, f64)) -> f64 {
    let place =
        |(lon, lat): (f64, f64)| Ellipsoid::WGS84.geocentric(f64::to_radians(lon), f64::to_radians(lat));
    (place(a) - place(b)).length()
}

#[test]
fn lengths_and_places_are_those_of_the_integrals_to_some_nanometres() {
    let mut count = 0;
    for line in REFERENCE.lines().filter(|line| !line.starts_with('#')) {
        let mut numbers = line.split(' ').map(|word| word.parse::<f64>().unwrap());
        let [from, to, east, length, lon, lat] = std::array::from_fn(|_| numbers.next().unwrap());
        let line_found = between(from, to, east);
        let (off, place) = ((line_found.length() - length).abs(), apart(line_found.at(0.3), (lon, lat)));
        assert!(off < 1e-8 && place < 1e-8, "{line}: {off} {place} {:?}", line_found.at(0.3));
        count += 1;
    }
    assert_eq!(count, 49);
}

proptest! {
    #[test]
    fn a_line_keeps_its_bearing(from in -88.0..88.0f64, to in -88.0..88.0f64, east in -180.0..180.0f64, share in 0.01..0.99f64) {
        // The bearing on Mercator's map, of the isometric latitude that projections use.
        let bearing = |(a_lon, a_lat): (f64, f64), (b_lon, b_lat): (f64, f64)| {
            let psi = |lat: f64| Ellipsoid::WGS84.isometric(lat.to_radians());
            atan2((b_lon - a_lon).to_radians(), psi(b_lat) - psi(a_lat))
        };
        let line = between(from, to, east);
        let at = line.at(share);
        let (one, other) = (bearing((0.0, from), at), bearing(at, (east, to)));
        prop_assert!((one - other).abs() < 1e-9 || (one - other).abs() > TAU - 1e-9, "{} {}", one, other);
    }

    #[test]
    fn there_and_back_is_the_same_line(from in -89.0..89.0f64, log in -14.0..2.0f64, east in -180.0..180.0f64, share in 0.0..1.0f64) {
        let to = (from + crate::math::exp(log * std::f64::consts::LN_10)).clamp(-89.0, 89.0);
        let (there, back) = (between(from, to, east), between(to, from, -east));
        prop_assert!((there.length() - back.length()).abs() < 2e-8);
        prop_assert!(apart(there.at(1.0), (east, to)) < 1e-8);
        let (lon, lat) = back.at(1.0 - share);
        prop_assert!(apart(there.at(share), (lon + east, lat)) < 2e-8);
    }
}
