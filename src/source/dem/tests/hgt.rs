//! SRTM tiles.

use super::super::DemOptions;
use super::{posts, read_bytes, refusal, window};
use crate::space::Plan;

/// A 3-arc-second tile that rises 1 m a row to the south, a void in its north-east corner.
fn tile() -> Vec<u8> {
    let mut bytes: Vec<u8> =
        (0..1201_i16).flat_map(|row| [(row - 300).to_be_bytes(); 1201]).flatten().collect();
    bytes[2400..2402].copy_from_slice(&[0x80, 0]);
    bytes
}

#[test]
fn a_tile_covers_its_degree_and_its_voids_hold_no_data() {
    let posts = posts(read_bytes("s34w070.hgt", &tile(), &DemOptions::default()).unwrap());
    assert_eq!((posts.columns(), posts.rows()), (1201, 1201));
    assert!((posts.first - Plan::new(-70.0, -34.0)).length() < 1e-12);
    assert!((posts.plan(1200, 1200) - Plan::new(-69.0, -33.0)).length() < 1e-12);
    assert_eq!((posts.world(0, 0).z, posts.world(0, 1200).z), (900.0, -300.0));
    assert!(posts.world(1200, 1200).z.is_nan());
    assert_eq!(posts.heights().iter().filter(|h| h.is_nan()).count(), 1);
}

#[test]
fn a_window_of_a_tile_is_cut_out() {
    let half = window([6.5, 43.5, 6.5 + 2.0 / 1200.0, 43.5 + 1.0 / 1200.0]);
    let posts = posts(read_bytes("N43E006.hgt", &tile(), &half).unwrap());
    assert_eq!((posts.columns(), posts.rows()), (3, 2));
    assert_eq!(posts.heights(), [300.0, 300.0, 300.0, 299.0, 299.0, 299.0]);
}

#[test]
fn a_cut_tile_is_refused() {
    let message = refusal("N43E006.hgt", &tile()[..100_000], &DemOptions::default());
    assert!(message.contains("100000 bytes"), "{message}");
}

#[test]
fn a_tile_of_two_arc_seconds_by_one_covers_its_degree() {
    let bytes: Vec<u8> =
        (0..3601_i16).flat_map(|row| (0..1801_i16).flat_map(move |c| (row - c).to_be_bytes())).collect();
    let posts = posts(read_bytes("N61E006.hgt", &bytes, &DemOptions::default()).unwrap());
    assert_eq!((posts.columns(), posts.rows()), (1801, 3601));
    assert!((posts.plan(1800, 3600) - Plan::new(7.0, 62.0)).length() < 1e-12);
    assert_eq!((posts.world(0, 0).z, posts.world(1800, 3600).z), (3600.0, -1800.0));
}
