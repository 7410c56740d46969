//! Scattered points.

use super::super::{Dem, DemOptions, describe};
use super::{read_bytes, window, with_file};
use crate::scene::Surface;
use crate::space::World;

const POINTS: &str = "x,y,z\n# a comment\n0 0 1\n\n10;0;2 # corner\n10\t10\t3\r\n0,10,4\n5, 5, 9\n";

fn points(dem: Dem) -> Vec<World> {
    match dem.surface {
        Surface::Points(points) => points,
        Surface::Grid(_) | Surface::Globe(_) => panic!("points were expected"),
    }
}

fn refusal(text: &str) -> String {
    super::refusal("a.xyz", text.as_bytes(), &DemOptions::default())
}

#[test]
fn separators_comments_and_a_header_are_understood() {
    let points = points(read_bytes("a.xyz", POINTS.as_bytes(), &DemOptions::default()).unwrap());
    assert_eq!(points.len(), 5);
    assert_eq!(points[1], World::new(10.0, 0.0, 2.0));
    assert_eq!(points[4], World::new(5.0, 5.0, 9.0));
}

#[test]
fn a_byte_order_mark_does_not_make_a_header_of_the_first_point() {
    let text = "\u{feff}0 0 1\n10 0 2\n10 10 3\n";
    assert_eq!(points(read_bytes("a.xyz", text.as_bytes(), &DemOptions::default()).unwrap()).len(), 3);
}

#[test]
fn a_window_filters_points() {
    let few = points(read_bytes("a.xyz", POINTS.as_bytes(), &window([0.0, 0.0, 10.0, 9.0])).unwrap());
    assert_eq!(few.len(), 3);
    let message = super::refusal("a.xyz", POINTS.as_bytes(), &window([50.0, 50.0, 60.0, 60.0]));
    assert!(message.contains("0 points") && message.contains("[0, 0, 10, 10]"), "{message}");
}

#[test]
fn a_repeated_point_is_dropped_but_two_heights_are_refused() {
    let dem = read_bytes("a.xyz", format!("{POINTS}-0.0 0 1\n").as_bytes(), &DemOptions::default()).unwrap();
    assert!(dem.notes.iter().any(|n| n.starts_with("1 point")), "{:?}", dem.notes);
    assert_eq!(points(dem).len(), 5);
    let message = refusal(&format!("{POINTS}0 0 1.5\n"));
    assert!(message.contains("1 high in line 3 and 1.5 high in line 9"), "{message}");
}

#[test]
fn errors_name_line_and_column() {
    for (line, expected) in [
        ("1 2", "a.xyz:9:1: a point has x, y and z, this one 2 numbers"),
        ("1 2 3 4", "a.xyz:9:7: `4` comes after"),
        ("1 zwei 3", "a.xyz:9:3: `zwei`"),
        ("1 nan 3", "a.xyz:9:3: `nan` is not a finite"),
        ("1 2 1e999", "a.xyz:9:5:"),
    ] {
        let message = refusal(&format!("{POINTS}{line}\n"));
        assert!(message.contains(expected), "{message}");
    }
    assert!(refusal("# nothing\n").contains("no points"));
    assert!(refusal(&"1".repeat(10_000)).contains("a.xyz:1:1: a line of more than"));
}

#[test]
fn describe_tells_their_extent() {
    let summary = with_file("a.xyz", POINTS.as_bytes(), |p| describe(&p, &DemOptions::default())).unwrap();
    assert_eq!((summary.count, summary.size), (5, None));
    assert_eq!((summary.bounds, summary.heights), ([0.0, 0.0, 10.0, 10.0], Some([1.0, 9.0])));
}
