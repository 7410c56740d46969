//! Strokes on the ground against brute force: how far a place is from a path that is walked in small steps.

use super::super::unroll;
use super::stroke::Brush;
use super::way::{OverTheGround, evenly};
use crate::crs::Turn;
use crate::scene::{Cap, Dash, Dashed, Join, Measure};
use crate::space::{Ellipsoid, Plan};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

const WGS84: Ellipsoid = Ellipsoid { a: 6_378_137.0, f: 1.0 / 298.257_223_563 };

fn radians(points: &[(f64, f64)]) -> Vec<DVec2> {
    points.iter().map(|(lon, lat)| DVec2::new(lon.to_radians(), lat.to_radians())).collect()
}

fn at(place: DVec2) -> DVec3 {
    WGS84.geocentric(place.x, place.y)
}

/// Whether a place is in a ring, by its turns around it on all turns of longitude.
fn is_in(ring: &[DVec2], place: DVec2) -> bool {
    let degrees: Vec<Plan> = ring.iter().map(|p| Plan::from(*p * (360.0 / TAU))).collect();
    let place = place * (360.0 / TAU);
    let turn = Turn { length: 360.0, pole: 90.0 };
    let turns = |ring: &[Plan]| {
        let mut all = 0;
        for (k, a) in ring.iter().enumerate() {
            let b = ring[(k + 1) % ring.len()];
            let (a, b) = (*a - Plan::from(place), b - Plan::from(place));
            if (a.y <= 0.0) != (b.y <= 0.0) {
                let side = a.perp_dot(b);
                all += i32::from(b.y > 0.0 && side > 0.0) - i32::from(b.y <= 0.0 && side < 0.0);
            }
        }
        all
    };
    unroll::rings(vec![degrees], turn).iter().any(|ring| match ring.around {
        0 => (-3..=3).any(|k| turns(&ring.moved(k).collect::<Vec<_>>()) != 0),
        _ => turns(&ring.chain(-400.0, 400.0)) != 0,
    })
}

/// The distance through the earth from a place to a path's segments.
fn distance(path: &[DVec2], place: DVec2) -> f64 {
    let from = at(place);
    let mut nearest = f64::INFINITY;
    for pair in path.windows(2) {
        let off = |share: f64| (at(pair[0] + (pair[1] - pair[0]) * share.clamp(0.0, 1.0)) - from).length();
        // Walked, then walked again around the nearest step.
        let mut around = 0.5;
        for step in [1e-3, 1e-6] {
            let shares = (-500..=500).map(|k| around + f64::from(k) * step);
            around = shares.min_by(|a, b| off(*a).total_cmp(&off(*b))).unwrap_or(around);
        }
        nearest = crate::math::min(nearest, off(around));
    }
    nearest
}

/// Places around places of a path, near its stroke's border.
fn around(path: &[DVec2], half: f64) -> Vec<DVec2> {
    let mut all = Vec::new();
    for pair in path.windows(2) {
        for (share, bearing, reach) in (0..63)
            .map(|k| (f64::from(k % 9) / 8.0, f64::from(k) * 0.37, [0.3, 0.97, 1.03, 1.4][k as usize % 4]))
        {
            let p = pair[0] + (pair[1] - pair[0]) * share;
            let [east, north, _] = Ellipsoid::directions(p.x, p.y);
            let aside = east * crate::math::cos(bearing) + north * crate::math::sin(bearing);
            all.push(DVec2::from(WGS84.geographic(at(p) + aside * (half * reach))));
        }
    }
    all
}

#[test]
fn a_round_stroke_is_what_lies_within_half_its_width() {
    let paths = [
        radians(&[(10.0, 40.0), (12.0, 41.0), (11.0, 43.0)]),
        radians(&[(170.0, 72.0), (183.0, 75.0), (200.0, 74.0)]),
        radians(&[(-3.0, -1.0), (4.0, 1.0), (4.5, 1.01), (4.6, 1.2)]),
        // To the pole and over it, past it, and around it.
        radians(&[(20.0, 86.0), (20.0, 90.0)]),
        radians(&[(30.0, -87.0), (30.0, -90.0), (150.0, -90.0), (150.0, -86.0)]),
        radians(&[(-10.0, 89.5), (100.0, 89.2), (240.0, 89.4)]),
    ];
    for path in &paths {
        for width in [1000.0, 120_000.0] {
            let half = 0.5 * width;
            let rings = Brush::new(WGS84, width, Join::Round, Cap::Round).stroke(path, false);
            let (mut inside, mut outside) = (0, 0);
            for place in around(path, half) {
                let off = distance(path, place);
                // The chord is shorter than the way over the ground; the walk has steps.
                let known = if off < half * 0.985 {
                    true
                } else if off > half * 1.015 {
                    false
                } else {
                    continue;
                };
                assert_eq!(
                    rings.iter().any(|ring| is_in(ring, place)),
                    known,
                    "{path:?}, {width} m: {:?} is {off} m off",
                    place * (360.0 / TAU)
                );
                if known { inside += 1 } else { outside += 1 }
            }
            assert!(inside > 20 && outside > 5, "{inside} {outside}");
        }
    }
}

#[test]
fn rings_of_strokes_turn_counter_clockwise() {
    let path = radians(&[(10.0, 40.0), (12.0, 41.0), (11.0, 43.0), (11.0, 41.0), (13.0, 41.2)]);
    for join in [Join::Round, Join::Miter { limit: 4.0 }, Join::Bevel] {
        for cap in [Cap::Butt, Cap::Square, Cap::Round] {
            for ring in Brush::new(WGS84, 20_000.0, join, cap).stroke(&path, false) {
                let area: f64 = (0..ring.len()).map(|k| ring[k].perp_dot(ring[(k + 1) % ring.len()])).sum();
                assert!(area > 0.0, "{join:?} {cap:?} {ring:?}");
            }
        }
    }
}

#[test]
fn joins_and_caps_are_those_of_the_style() {
    // East, then north: the corner is in the south-east.
    let path = radians(&[(-1.0, 0.0), (0.0, 0.0), (0.0, 1.0)]);
    let has = |join, cap, (east, north): (f64, f64)| {
        let rings = Brush::new(WGS84, 20_000.0, join, cap).stroke(&path, false);
        let place = DVec2::new(east, north) * 10_000.0 / WGS84.a;
        rings.iter().any(|ring| is_in(ring, place))
    };
    let miter = Join::Miter { limit: 2.0 };
    for (join, [corner, arc, chord]) in [
        (miter, [true, true, true]),
        (Join::Miter { limit: 1.2 }, [false, false, true]),
        (Join::Round, [false, true, true]),
        (Join::Bevel, [false, false, true]),
    ] {
        assert_eq!(has(join, Cap::Butt, (0.95, -0.95)), corner, "{join:?}");
        assert_eq!(has(join, Cap::Butt, (0.65, -0.65)), arc, "{join:?}");
        assert_eq!(has(join, Cap::Butt, (0.45, -0.45)), chord, "{join:?}");
    }
    let degree = WGS84.a.to_radians() / 10_000.0;
    for (cap, [on, corner]) in
        [(Cap::Butt, [false, false]), (Cap::Square, [true, true]), (Cap::Round, [true, false])]
    {
        assert_eq!(has(miter, cap, (-degree - 0.9, 0.0)), on, "{cap:?}");
        assert_eq!(has(miter, cap, (-degree - 0.9, 0.9)), corner, "{cap:?}");
        assert!(has(miter, cap, (-degree + 0.1, 0.9)), "{cap:?}");
    }
}

#[test]
fn a_ring_has_no_caps_and_is_one_that_ends_where_it_begins_a_turn_on() {
    let brush = Brush::new(WGS84, 1000.0, Join::Bevel, Cap::Square);
    let equator = radians(&[(-180.0, 0.0), (180.0, 0.0)]);
    let is_ring = |path: &[DVec2]| OverTheGround(WGS84).is_ring(path);
    assert!(is_ring(&equator));
    assert!(is_ring(&radians(&[(0.0, 1.0), (2.0, 3.0), (4.0, 1.0), (0.0, 1.0)])));
    assert!(!is_ring(&radians(&[(0.0, 1.0), (2.0, 3.0), (0.0, 1.0)])), "there and back");
    assert!(!is_ring(&radians(&[(0.0, 1.0), (2.0, 3.0), (4.0, 1.0)])));
    let area = |rings: &[Vec<DVec2>]| {
        let of = |ring: &Vec<DVec2>| -> f64 {
            (0..ring.len()).map(|k| ring[k].perp_dot(ring[(k + 1) % ring.len()])).sum()
        };
        rings.iter().map(of).sum::<f64>() * 0.5
    };
    let expected = TAU * 1000.0 / WGS84.meridian(0.0);
    assert!((area(&brush.stroke(&equator, true)) / expected - 1.0).abs() < 1e-6);
}

#[test]
fn a_place_alone_is_a_dot_by_its_cap() {
    let place = radians(&[(33.0, 60.0)]);
    let corners = |cap| Brush::new(WGS84, 2000.0, Join::Round, cap).stroke(&place, false);
    assert!(corners(Cap::Butt).is_empty());
    let [square] = &corners(Cap::Square)[..] else { panic!("one square") };
    assert_eq!(square.len(), 4);
    let [disc] = &corners(Cap::Round)[..] else { panic!("one disc") };
    for corner in disc {
        assert!(((at(*corner) - at(place[0])).length() - 1000.0).abs() < 0.01);
    }
}

#[test]
fn lengths_over_the_ground_are_those_of_the_ellipsoid() {
    let ground = OverTheGround(WGS84);
    let of = |from: (f64, f64), to: (f64, f64)| {
        let ends = radians(&[from, to]);
        ground.length(ends[0], ends[1])
    };
    // reference: the quarter of a meridian of WGS 84 (EPSG:7030), by GeographicLib 2.3; a degree of longitude on the equator is a turn's 360th.
    assert!((of((33.0, 0.0), (33.0, 90.0)) - 10_001_965.729_312_7).abs() < 1e-6);
    assert!((of((0.0, 0.0), (360.0, 0.0)) - TAU * WGS84.a).abs() < 1e-6);
    assert!(of((20.0, 90.0), (80.0, 90.0)) < 1e-6 && of((5.0, 90.0), (5.0, 120.0)) == 0.0);
    for (from, to) in
        [((0.0, 0.0), (40.0, 60.0)), ((10.0, -70.0), (-80.0, 85.0)), ((0.0, 89.0), (120.0, 89.9))]
    {
        let ends = radians(&[from, to]);
        let place = |k: u32| at(ends[0] + (ends[1] - ends[0]) * (f64::from(k) / 100_000.0));
        let walked: f64 = (0..100_000).map(|k| (place(k + 1) - place(k)).length()).sum();
        assert!((of(from, to) / walked - 1.0).abs() < 1e-9, "{from:?} {to:?}");
    }
}

#[test]
fn dashes_lie_by_the_length_over_the_ground_whatever_the_latitude() {
    let ground = OverTheGround(WGS84);
    let dash = Dash::new(&[100e3, 50e3], 20e3).unwrap();
    for path in [
        radians(&[(10.0, 60.0), (40.0, 60.0)]),
        radians(&[(10.0, 0.0), (10.0, 55.0), (60.0, 80.0)]),
        radians(&[(200.0, -88.0), (200.0, -90.0), (20.0, -90.0), (20.0, -85.0)]),
    ] {
        let Dashed::Parts(parts) = dash.along(&path, false, &ground) else { panic!("there are gaps") };
        let length =
            |path: &[DVec2]| path.windows(2).map(|ends| ground.length(ends[0], ends[1])).sum::<f64>();
        let (first, last) = (length(&parts[0]), length(&parts[parts.len() - 1]));
        assert!((first - 80e3).abs() < 1e-5 && last < 100e3 + 1e-5, "{first} {last}");
        assert!(parts[1..parts.len() - 1].iter().all(|part| (length(part) - 100e3).abs() < 1e-5));
        // 130 km from its beginning the second one begins.
        let until = parts[1][0];
        let end = path.iter().position(|place| *place == path[path.len() - 1]).unwrap();
        let before = path[..end].iter().filter(|place| length_to(&ground, &path, **place) < 130e3);
        let walked: Vec<DVec2> = before.copied().chain([until]).collect();
        assert!((length(&walked) - 130e3).abs() < 1e-5, "{}", length(&walked));
    }
}

fn length_to(ground: &OverTheGround, path: &[DVec2], place: DVec2) -> f64 {
    let steps = path.windows(2).take_while(|ends| ends[0] != place);
    steps.map(|ends| ground.length(ends[0], ends[1])).sum()
}

#[test]
fn a_dash_over_the_beginning_of_a_ring_around_a_pole_is_one() {
    let ground = OverTheGround(WGS84);
    let ring = radians(&[(-30.0, 80.0), (90.0, 80.0), (210.0, 80.0), (330.0, 80.0)]);
    let quarter = 0.25 * ground.length(ring[0], ring[3]);
    let dash = Dash::new(&[quarter, quarter], 0.5 * quarter).unwrap();
    let Dashed::Parts(parts) = dash.along(&ring, true, &ground) else { panic!("there are gaps") };
    assert_eq!(parts.len(), 2);
    let [from, to] = [parts[0][0], parts[0][parts[0].len() - 1]].map(|place| place.x.to_degrees());
    assert!((from - 285.0).abs() < 1e-9 && (to - 375.0).abs() < 1e-9, "{from} {to}");
}

#[test]
fn a_path_of_a_stroke_in_pixels_has_places_where_degrees_become_shorter() {
    let even = evenly(&radians(&[(10.0, -20.0), (10.0, 90.0), (50.0, 90.0), (50.0, 3.0)]));
    assert!((100..2000).contains(&even.len()), "{}", even.len());
    for ends in even.windows(2) {
        let [from, to] = [ends[0], ends[1]].map(|place| crate::math::cos(place.y));
        let most = crate::math::max(from, to);
        let share = if most > 1.0 / 12.0 { 1.0 / 32.0 } else { 1.0 / 8.0 };
        assert!(most <= 1.0 / 4_096.0 || (from - to).abs() <= most * share + 1e-12);
    }
    let level = radians(&[(0.0, 40.0), (90.0, 40.0)]);
    assert_eq!(evenly(&level), level);
}
