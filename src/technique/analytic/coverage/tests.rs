//! Areas against rational arithmetic.

use super::*;
use crate::scene::Rule;
use dashu::rational::RBig;
use proptest::prelude::*;
use std::collections::BTreeMap;

type Exact = [RBig; 2];

/// A stroke's pieces, or the rings of an area with the rule and the side that count.
#[derive(Debug, Clone)]
struct Item {
    rings: Vec<Vec<DVec2>>,
    area: Option<Inside>,
    pieces: Vec<Vec<DVec2>>,
    has_stroke: bool,
}

fn exact(p: DVec2) -> Exact {
    [p.x, p.y].map(|v| RBig::try_from(v).unwrap())
}

/// Twice the area that a line's direction and a point span.
fn turn(a: &Exact, b: &Exact, p: &Exact) -> RBig {
    (&b[0] - &a[0]) * (&p[1] - &a[1]) - (&b[1] - &a[1]) * (&p[0] - &a[0])
}

fn area_of(ring: &[Exact]) -> RBig {
    let twice = (1..ring.len().max(2) - 1).map(|k| turn(&ring[0], &ring[k], &ring[k + 1]));
    twice.fold(RBig::ZERO, |sum, v| sum + v) / RBig::from(2)
}

/// The part of a convex ring on the left of a line.
fn left_part(ring: &[Exact], a: &Exact, b: &Exact) -> Vec<Exact> {
    let mut part = Vec::new();
    for k in 0..ring.len() {
        let (p, q) = (&ring[k], &ring[(k + 1) % ring.len()]);
        let (s, t) = (turn(a, b, p), turn(a, b, q));
        if s >= RBig::ZERO {
            part.push(p.clone());
        }
        if (s > RBig::ZERO && t < RBig::ZERO) || (s < RBig::ZERO && t > RBig::ZERO) {
            let share = &s / (&s - &t);
            part.push([&p[0] + (&q[0] - &p[0]) * &share, &p[1] + (&q[1] - &p[1]) * &share]);
        }
    }
    part
}

fn turns_around(rings: &[Vec<DVec2>], at: &Exact) -> i32 {
    let mut turns = 0;
    for ring in rings {
        for k in 0..ring.len() {
            let (a, b) = (exact(ring[k]), exact(ring[(k + 1) % ring.len()]));
            if (a[1] <= at[1]) != (b[1] <= at[1]) {
                let side = turn(&a, &b, at);
                match a[1] <= at[1] {
                    true if side > RBig::ZERO => turns += 1,
                    false if side < RBig::ZERO => turns -= 1,
                    _ => {}
                }
            }
        }
    }
    turns
}

fn covers(item: &Item, at: &Exact) -> bool {
    let is_in = |area: Inside| area.rule.contains(turns_around(&item.rings, at)) == area.is_wanted;
    let has = |piece: &Vec<DVec2>| turns_around(std::slice::from_ref(piece), at) != 0;
    item.area.is_none_or(is_in) && (!item.has_stroke || item.pieces.iter().any(has))
}

/// The area of each set of items in a fragment: it is cut along all edges' lines; a cell is in or out as a whole.
fn expected(fragment: &[DVec2], items: &[Item]) -> BTreeMap<u64, f64> {
    let mut whole: Vec<Exact> = fragment.iter().map(|p| exact(*p)).collect();
    if area_of(&whole) < RBig::ZERO {
        whole.reverse();
    }
    let mut cells = vec![whole];
    for ring in items.iter().flat_map(|item| item.rings.iter().chain(&item.pieces)) {
        for k in 0..ring.len() {
            let (a, b) = (exact(ring[k]), exact(ring[(k + 1) % ring.len()]));
            let halves = |cell: &Vec<Exact>| [left_part(cell, &a, &b), left_part(cell, &b, &a)];
            if a != b {
                cells = cells.iter().flat_map(halves).filter(|cell| area_of(cell) > RBig::ZERO).collect();
            }
        }
    }
    let mut areas = BTreeMap::new();
    for cell in cells {
        let count = RBig::from(cell.len());
        let middle = [0, 1].map(|axis| cell.iter().fold(RBig::ZERO, |sum, p| sum + &p[axis]) / &count);
        let set = (0..).zip(items).fold(0, |set, (k, item)| set | u64::from(covers(item, &middle)) << k);
        *areas.entry(set).or_insert(0.0) += area_of(&cell).to_f64().value();
    }
    areas
}

fn measured(fragment: &[DVec2], items: &[Item], cover: &mut Coverage) -> Option<Class> {
    cover.begin(fragment);
    let numbers: Vec<u32> = items
        .iter()
        .map(|item| cover.item(Membership { area: item.area, has_stroke: item.has_stroke }).unwrap())
        .collect();
    for (item, number) in items.iter().zip(&numbers) {
        for ring in &item.rings {
            (0..ring.len()).for_each(|k| cover.edge(*number, ring[k], ring[(k + 1) % ring.len()]));
        }
        item.pieces.iter().for_each(|piece| cover.piece(*number, piece));
    }
    let at = exact(cover.reference()?);
    for (item, number) in items.iter().zip(&numbers) {
        cover.winding(*number, turns_around(&item.rings, &at));
    }
    cover.measure(1000)
}

/// How far the areas are from the exact ones, and their sum from the fragment's area.
fn deviation(fragment: &[DVec2], items: &[Item], cover: &Coverage) -> [f64; 2] {
    let mut off = expected(fragment, items);
    let whole = 0.5 * convex::twice_area(fragment).abs();
    let sum: f64 = cover.areas().iter().map(|(_, area)| area).sum();
    for (set, area) in cover.areas() {
        *off.entry(*set).or_insert(0.0) -= area;
    }
    [off.values().fold(0.0, |most, v| crate::math::max(v.abs(), most)), (sum - whole).abs()]
}

fn points(list: &[[f64; 2]]) -> Vec<DVec2> {
    list.iter().copied().map(DVec2::from_array).collect()
}

fn square() -> Vec<DVec2> {
    points(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
}

fn stroke(pieces: &[&[[f64; 2]]]) -> Item {
    let pieces = pieces.iter().map(|piece| points(piece)).collect();
    Item { rings: Vec::new(), area: None, pieces, has_stroke: true }
}

fn fill(rings: &[&[[f64; 2]]], rule: Rule, is_wanted: bool) -> Item {
    let rings = rings.iter().map(|ring| points(ring)).collect();
    Item { rings, area: Some(Inside { rule, is_wanted }), pieces: Vec::new(), has_stroke: false }
}

fn check(items: &[Item], class: Class) {
    let mut cover = Coverage::default();
    assert_eq!(measured(&square(), items, &mut cover), Some(class));
    let off = deviation(&square(), items, &cover);
    assert!(off[0] < 1e-12 && off[1] < 1e-12, "{off:?} {:?}", cover.areas());
}

#[test]
fn a_fragment_without_an_edge_is_covered_by_what_is_around_it() {
    let around: &[[f64; 2]] = &[[-1.0, -1.0], [3.0, -1.0], [3.0, 3.0], [-1.0, 3.0]];
    check(
        &[fill(&[around], Rule::NonZero, true), stroke(&[around]), fill(&[], Rule::EvenOdd, true)],
        Class::Point,
    );
    check(&[fill(&[], Rule::EvenOdd, false)], Class::Point);
}

#[test]
fn one_edge_divides_a_fragment_in_two() {
    let east: &[[f64; 2]] = &[[0.25, -4.0], [9.0, -4.0], [9.0, 5.0], [0.75, 5.0]];
    check(&[fill(&[east], Rule::EvenOdd, true)], Class::Half);
    check(&[fill(&[east], Rule::EvenOdd, false)], Class::Half);
    check(&[stroke(&[east])], Class::Half);
}

#[test]
fn both_sides_of_a_stroke_leave_what_is_between_them() {
    let band: &[[f64; 2]] = &[[-2.0, -1.75], [-1.75, -2.0], [3.0, 2.75], [2.75, 3.0]];
    check(&[stroke(&[band])], Class::Band);
    check(&[fill(&[&[[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0]]], Rule::EvenOdd, true)], Class::Half);
    let east: &[[f64; 2]] = &[[0.8, -4.0], [9.0, -4.0], [9.0, 5.0], [0.8, 5.0]];
    let west: &[[f64; 2]] = &[[0.2, -4.0], [-9.0, -4.0], [-9.0, 5.0], [0.1, 5.0]];
    check(&[stroke(&[east]), fill(&[west], Rule::EvenOdd, true)], Class::Band);
    check(&[stroke(&[west]), fill(&[east], Rule::EvenOdd, false)], Class::Band);
}

#[test]
fn equal_features_have_one_area_and_neighbours_leave_nothing_between_them() {
    let west: &[[f64; 2]] = &[[0.3, -1.0], [0.6, 2.0], [-1.0, 2.0], [-1.0, -1.0]];
    let east: &[[f64; 2]] = &[[0.6, 2.0], [0.3, -1.0], [2.0, -1.0], [2.0, 2.0]];
    let item = |ring| fill(&[ring], Rule::EvenOdd, true);
    check(&[item(west), item(west)], Class::Slabs);
    check(&[item(west), item(east), item(west)], Class::Slabs);
    let mut cover = Coverage::default();
    measured(&square(), &[item(west), item(east)], &mut cover);
    assert!(
        cover.areas().iter().all(|(set, area)| *area < 1e-15 || *set == 1 || *set == 2),
        "{:?}",
        cover.areas()
    );
}

#[test]
fn edges_along_the_border_of_the_fragment_count_nowhere() {
    let inner: &[[f64; 2]] = &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let outer: &[[f64; 2]] = &[[0.0, 0.0], [0.0, 1.0], [-1.0, 1.0], [-1.0, 0.0]];
    let mut cover = Coverage::default();
    let items = [
        fill(&[inner], Rule::EvenOdd, true),
        fill(&[outer], Rule::NonZero, true),
        stroke(&[inner]),
        stroke(&[outer]),
    ];
    measured(&square(), &items, &mut cover).unwrap();
    let off = deviation(&square(), &items, &cover);
    assert!(off[0] < 1e-12 && off[1] < 1e-12, "{off:?} {:?}", cover.areas());
}

#[test]
fn a_side_of_no_length_to_speak_of_cuts_nothing_off() {
    // Two corners that are one but for rounding, so that the side between them runs across the fragment.
    let corners = points(&[[0.0, 0.5], [1e-15, 0.5 - 1e-15], [0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]);
    let west: &[[f64; 2]] = &[[0.25, -1.0], [0.25, 2.0], [-1.0, 2.0], [-1.0, -1.0]];
    let items = [fill(&[west], Rule::EvenOdd, true)];
    let mut cover = Coverage::default();
    assert_eq!(measured(&corners, &items, &mut cover), Some(Class::Half));
    let off = deviation(&corners, &items, &cover);
    assert!(off[0] < 1e-9 && off[1] < 1e-9, "{off:?} {:?}", cover.areas());
}

#[test]
fn a_union_of_pieces_covers_a_point_once() {
    let a: &[[f64; 2]] = &[[-1.0, 0.25], [0.75, 0.25], [0.75, 0.5], [-1.0, 0.5]];
    let b: &[[f64; 2]] = &[[0.5, 0.25], [0.75, 0.25], [0.75, 2.0], [0.5, 2.0]];
    check(&[stroke(&[a, b, a])], Class::Slabs);
    let cut = Item {
        area: Some(Inside { rule: Rule::EvenOdd, is_wanted: false }),
        rings: vec![points(b)],
        ..stroke(&[a])
    };
    check(&[cut], Class::Slabs);
}

#[test]
fn more_edges_than_the_limit_and_more_items_than_bits_are_refused() {
    let mut cover = Coverage::default();
    let across = stroke(&[&[[-1.0, 0.25], [2.0, 0.25], [2.0, 0.5], [-1.0, 0.5]]]);
    measured(&square(), &[across], &mut cover).unwrap();
    assert_eq!((cover.measure(1), cover.measure(0), cover.edges()), (None, None, 2));
    cover.begin(&square());
    let of = Membership { area: None, has_stroke: true };
    assert!((0..64).all(|k| cover.item(of) == Some(k)));
    assert_eq!(cover.item(of), None);
}

/// Coordinates of a coarse lattice, so that edges meet, run through corners and lie upon one another; some have any place.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![3 => (-3..8_i32).prop_map(|k| f64::from(k) * 0.25), 1 => -0.7..1.7_f64]
}

fn point() -> impl Strategy<Value = DVec2> {
    [coordinate(), coordinate()].prop_map(DVec2::from_array)
}

/// A triangle or a rectangle along the axes.
fn convex_ring() -> impl Strategy<Value = Vec<DVec2>> {
    prop_oneof![
        prop::collection::vec(point(), 3),
        [point(), point()].prop_map(|[a, b]| vec![a, DVec2::new(b.x, a.y), b, DVec2::new(a.x, b.y)]),
    ]
}

fn item() -> impl Strategy<Value = Item> {
    let rule = prop_oneof![Just(Rule::EvenOdd), Just(Rule::NonZero)];
    let area = (rule, any::<bool>()).prop_map(|(rule, is_wanted)| Inside { rule, is_wanted });
    let rings = || prop::collection::vec(prop::collection::vec(point(), 3..6), 1..3);
    let pieces = || prop::collection::vec(convex_ring(), 1..3);
    prop_oneof![
        (rings(), area.clone()).prop_map(|(rings, area)| Item {
            rings,
            area: Some(area),
            pieces: Vec::new(),
            has_stroke: false
        }),
        pieces().prop_map(|pieces| Item { rings: Vec::new(), area: None, pieces, has_stroke: true }),
        (rings(), area, pieces()).prop_map(|(rings, area, pieces)| Item {
            rings,
            area: Some(area),
            pieces,
            has_stroke: true
        }),
    ]
}

fn fragment() -> impl Strategy<Value = Vec<DVec2>> {
    prop_oneof![Just(square()), convex_ring().prop_filter("an area", |ring| convex::twice_area(ring) != 0.0)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn areas_are_those_of_rational_arithmetic(fragment in fragment(), items in prop::collection::vec(item(), 1..4)) {
        let mut cover = Coverage::default();
        measured(&fragment, &items, &mut cover).unwrap();
        let off = deviation(&fragment, &items, &cover);
        prop_assert!(off[0] < 1e-9 && off[1] < 1e-12, "{:?} {:?}", off, cover.areas());
    }
}
