//! Types that may hold curves: read where all is straight, refused where it is not.

use super::*;
use crate::source::vector::bytes::Cursor;
use crate::source::vector::wkb;

/// A geometry of this type: a count, and then what is counted.
fn well_known(kind: u32, count: usize, content: &[u8]) -> Vec<u8> {
    [&[1][..], &kind.to_le_bytes(), &(count as u32).to_le_bytes(), content].concat()
}

fn points(points: &[(f64, f64)]) -> Vec<u8> {
    points.iter().flat_map(|(x, y)| [x.to_le_bytes(), y.to_le_bytes()].concat()).collect()
}

fn line(at: &[(f64, f64)]) -> Vec<u8> {
    well_known(2, at.len(), &points(at))
}

fn polygon() -> Vec<u8> {
    well_known(3, 1, &[&5_u32.to_le_bytes()[..], &points(&SQUARE)].concat())
}

fn shapes(bytes: &[u8]) -> Result<Vec<Shape>> {
    let mut found = Collector::default();
    wkb::read(&mut Cursor::new(bytes), &mut found)?;
    Ok(found.features.into_iter().map(|feature| feature.shape).collect())
}

/// The square as a ring of two lines, one after the other.
fn compound(kind: u32) -> Vec<u8> {
    let pieces = [line(&SQUARE[..3]), well_known(kind, 3, &points(&SQUARE[2..]))].concat();
    well_known(9, 2, &pieces)
}

#[test]
fn surfaces_and_curves_of_straight_pieces_are_polygons_and_lines() {
    let plain = shapes(&polygon()).unwrap();
    for same in [
        well_known(12, 1, &polygon()),
        well_known(10, 1, &line(&SQUARE)),
        well_known(12, 1, &well_known(10, 1, &compound(2))),
        well_known(17, 1, &[&5_u32.to_le_bytes()[..], &points(&SQUARE)].concat()),
    ] {
        assert_eq!(shapes(&same).unwrap(), plain);
    }
    let plain = shapes(&well_known(5, 1, &line(&SQUARE))).unwrap();
    for same in [well_known(11, 1, &line(&SQUARE)), well_known(11, 1, &compound(2)), compound(2)] {
        assert_eq!(shapes(&same).unwrap(), plain);
    }
}

#[test]
fn arcs_and_bodies_are_refused_with_the_command_that_makes_them_straight() {
    for (bytes, name) in [
        (well_known(8, 3, &points(&SQUARE[..3])), "CircularString"),
        (compound(8), "CircularString"),
        (well_known(12, 1, &well_known(10, 1, &compound(8))), "CircularString"),
        (well_known(11, 1, &well_known(8, 3, &points(&SQUARE[..3]))), "CircularString"),
        (well_known(15, 1, &polygon()), "PolyhedralSurface"),
    ] {
        let refused = shapes(&bytes).unwrap_err();
        assert!(refused.what().contains(name), "{refused}");
        assert!(refused.help_text().unwrap().contains("-nlt CONVERT_TO_LINEAR"), "{refused}");
    }
    assert!(shapes(&well_known(12, 1, &line(&SQUARE))).unwrap_err().what().contains("another type"));
}
