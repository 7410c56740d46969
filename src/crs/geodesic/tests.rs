use super::Geodesic;
use crate::crs::ellipsoid::Ellipsoid;
use crate::math::{asin, cos, sin};
use proptest::prelude::*;

/// Ways on WGS 84: both latitudes, degrees to the east; the length, and the place after three tenths of it (degrees to the east, latitude).
/// Computed with mpmath 1.3 in 34 digits from the integrals of Karney (2013), eqs. 7 and 8, starting from what GeographicLib 2.1 for Python
/// gives; all lengths agree with that to 5e-8 m.
const REFERENCE: &str = include_str!("reference.txt");

fn between(from: f64, to: f64, east: f64) -> Geodesic {
    Geodesic::between(&Ellipsoid::WGS84, from, to, east)
}

/// Metres between two places (degrees to the east, latitude) that are close to one another.
fn apart(ellipsoid: &Ellipsoid, a: (f64, f64), b: (f64, f64)) -> f64 {
    let place = |(lon, lat): (f64, f64)| ellipsoid.geocentric(f64::to_radians(lon), f64::to_radians(lat));
    (place(a) - place(b)).length()
}

#[test]
fn lengths_and_places_are_the_published_ones_to_some_nanometres() {
    let mut count = 0;
    for line in REFERENCE.lines().filter(|line| !line.starts_with('#')) {
        let mut numbers = line.split(' ').map(|word| word.parse::<f64>().unwrap());
        let [from, to, east, length, lon, lat] = std::array::from_fn(|_| numbers.next().unwrap());
        let way = between(from, to, east);
        assert!((way.length() - length).abs() < 1e-8, "{line}: {}", way.length());
        // Towards an antipode azimuths fan out: all of these ways are as short to the last digit.
        let is_nearly_antipodal = (from + to).abs() < 1.0 && east.abs() > 179.0;
        let off = apart(&Ellipsoid::WGS84, way.at(0.3), (lon, lat));
        assert!(off < if is_nearly_antipodal { 1e-6 } else { 1e-8 }, "{line}: {:?}", way.at(0.3));
        count += 1;
    }
    assert_eq!(count, 133);
}

#[test]
fn antipodes_are_reached_over_a_pole() {
    let meridian = between(90.0, -90.0, 0.0).length();
    for latitude in [0.0, 1e-9, 30.0, -71.0, 90.0] {
        for east in [180.0, -180.0] {
            let way = between(latitude, -latitude, east);
            assert!((way.length() - meridian).abs() < 1e-8, "{latitude}: {}", way.length());
            let share = (90.0 - latitude.abs()) / 180.0;
            assert!(
                latitude.abs() == 90.0 || way.at(share).1.abs() > 89.5,
                "{latitude}: {:?}",
                way.at(share)
            );
        }
    }
}

#[test]
fn on_a_sphere_a_way_is_a_great_circle() {
    let sphere = Ellipsoid::from_inverse_flattening(6_371_000.0, 0.0);
    for (from, to, east) in
        [(10.0, -40.0, 123.0), (-70.0, -71.0, -160.0), (30.0, -30.0, 179.0), (0.0, 0.0, 100.0)]
    {
        let [a, b, lam] = [from, to, east].map(f64::to_radians);
        // The haversine formula.
        let square = |x: f64| x * x;
        let arc = 2.0 * asin((square(sin((b - a) / 2.0)) + cos(a) * cos(b) * square(sin(lam / 2.0))).sqrt());
        let way = Geodesic::between(&sphere, from, to, east);
        assert!((way.length() - 6_371_000.0 * arc).abs() < 1e-6, "{from} {to} {east}");
    }
}

/// Pairs of places, every other one nearly antipodal or close.
fn pairs() -> impl Strategy<Value = (f64, f64, f64)> {
    let small = || {
        (-9.0..0.0f64, any::<bool>())
            .prop_map(|(k, up)| crate::math::exp(k * 2.3) * if up { 1.0 } else { -1.0 })
    };
    prop_oneof![
        4 => (-90.0..90.0f64, -90.0..90.0f64, -180.0..180.0f64),
        2 => (-89.0..89.0f64, small(), small()).prop_map(|(lat, by, of)| (lat, by - lat, of + 180.0_f64.copysign(-of))),
        2 => (-89.0..89.0f64, small(), small()).prop_map(|(lat, by, east)| (lat, lat + by, east)),
        1 => (small(), small(), -180.0..180.0f64),
    ]
}

proptest! {
    #[test]
    fn a_way_ends_where_it_leads_to((from, to, east) in pairs(), rf in prop_oneof![Just(298.257_223_563), Just(0.0), 50.0..400.0f64]) {
        let ellipsoid = Ellipsoid::from_inverse_flattening(6_378_137.0, rf);
        let way = Geodesic::between(&ellipsoid, from, to, east);
        // On the flattest ellipsoids the series themselves are more than 100 nanometres off.
        let most = if rf == 0.0 || rf > 150.0 { 2e-8 } else { 1e-6 };
        prop_assert!(apart(&ellipsoid, way.at(0.0), (0.0, from)) < most);
        prop_assert!(apart(&ellipsoid, way.at(1.0), (east, to)) < most, "{:?}", way.at(1.0));
    }

    #[test]
    fn there_and_back_is_the_same_way((from, to, east) in pairs(), share in 0.0..1.0f64) {
        let (there, back) = (between(from, to, east), between(to, from, -east));
        prop_assert!((there.length() - back.length()).abs() < 1e-8);
        if (from + to).abs() > 1.0 || east.abs() < 179.0 {
            let (lon, lat) = back.at(1.0 - share);
            let off = apart(&Ellipsoid::WGS84, there.at(share), (lon + east, lat));
            prop_assert!(off < 2e-8, "{} {:?} {:?}", off, there.at(share), (lon + east, lat));
        }
    }

    #[test]
    fn no_detour_is_shorter((from, to, east) in pairs(), lat in -90.0..90.0f64, share in 0.0..1.0f64) {
        let straight = between(from, to, east).length();
        let by = between(from, lat, share * east).length() + between(lat, to, (1.0 - share) * east).length();
        prop_assert!(straight <= by + 2e-8, "{} {}", straight, by);
    }
}
