use super::*;
use crate::space::{Plan, PlanBox};
use proptest::prelude::*;

fn ring(points: &[(f64, f64)]) -> Vec<Plan> {
    points.iter().map(|(x, y)| Plan::new(*x, *y)).collect()
}

fn square(x: f64, y: f64, half: f64) -> Vec<Plan> {
    ring(&[(x - half, y - half), (x + half, y - half), (x + half, y + half), (x - half, y + half)])
}

fn even_odd(turns: i32) -> bool {
    turns % 2 != 0
}

fn non_zero(turns: i32) -> bool {
    turns != 0
}

/// How often rings turn around a point, by the crossings of a line to the east.
fn turns(rings: &[Vec<Plan>], p: Plan) -> i32 {
    let edges = rings.iter().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
    let crossed = edges.filter(|(a, b)| (a.y <= p.y) != (b.y <= p.y));
    let east = crossed.filter(|(a, b)| a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x);
    east.map(|(a, b)| if a.y < b.y { 1 } else { -1 }).sum()
}

fn is_near(rings: &[Vec<Plan>], p: Plan) -> bool {
    let edges = rings.iter().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
    edges.into_iter().any(|(a, b)| {
        let (along, to) = (*b - *a, p - *a);
        let share = (to.dot(along) / along.length_squared()).clamp(0.0, 1.0);
        // An edge of no length has no share.
        let share = if share.is_finite() { share } else { 0.0 };
        (to - along * share).length() < 1e-9
    })
}

fn border(members: &[Rings], rule: fn(i32) -> bool) -> Option<Rings> {
    union_border(members, &rule).unwrap()
}

fn area(rings: &[Vec<Plan>]) -> f64 {
    let twice = |ring: &Vec<Plan>| {
        let next = ring.iter().cycle().skip(1);
        ring.iter().zip(next).map(|(a, b)| a.x * b.y - b.x * a.y).sum::<f64>()
    };
    rings.iter().map(twice).sum::<f64>() / 2.0
}

#[test]
fn outside_of_polygons_rings_turn_once_or_not_at_all_however_the_polygons_turn() {
    let reversed = |ring: Vec<Plan>| ring.into_iter().rev().collect::<Vec<_>>();
    let twice = vec![square(-50.0, 0.0, 20.0), square(-50.0, 0.0, 20.0)];
    let members =
        [vec![reversed(square(0.0, 0.0, 10.0))], twice, vec![square(5.0, 0.0, 10.0), square(7.0, 0.0, 2.0)]];
    let frame = PlanBox { min: Plan::new(-100.0, -100.0), max: Plan::new(100.0, 100.0) };
    for (rule, inside) in [(even_odd as fn(i32) -> bool, 500.0), (non_zero, 500.0 + 1600.0)] {
        let border = border_outside(&members, &frame, &rule).unwrap();
        assert_eq!(area(&border), 40_000.0 - inside);
        let around = |x: f64, y: f64| turns(&border, Plan::new(x, y));
        let twice = i32::from(!rule(2));
        assert_eq!(
            [around(0.0, 1.0), around(-50.0, 1.0), around(12.0, 1.0), around(0.0, 50.0)],
            [0, twice, 0, 1]
        );
        assert_eq!(around(0.0, 150.0), 0);
    }
    assert_eq!(area(&border_outside(&[], &frame, &even_odd).unwrap()), 40_000.0);
}

#[test]
fn a_square_in_a_square_is_the_larger_one() {
    let members = [vec![square(0.0, 0.0, 200.0)], vec![square(0.0, 0.0, 100.0)]];
    for rule in [even_odd, non_zero] {
        assert_eq!(area(&border(&members, rule).unwrap()), 160_000.0);
    }
}

#[test]
fn members_that_turn_against_each_other_are_united_too() {
    let mut other = square(1.0, 1.0, 1.0);
    other.reverse();
    let members = [vec![square(0.0, 0.0, 1.0)], vec![other]];
    assert_eq!(border(&members, non_zero).map(|rings| area(&rings)), Some(7.0));
}

#[test]
fn a_hole_is_a_hole_of_its_member_alone() {
    let members = [vec![square(0.0, 0.0, 4.0), square(0.0, 0.0, 2.0)], vec![square(1.5, 0.0, 1.0)]];
    // The second reaches from 0.5 to 2.5: three quarters of it lie in the hole.
    assert_eq!(border(&members, even_odd).map(|rings| area(&rings)), Some(64.0 - 16.0 + 3.0));
}

#[test]
fn members_beside_one_another_in_holes_and_at_corners_stay_as_they_are() {
    let in_a_hole = [vec![square(0.0, 0.0, 4.0), square(0.0, 0.0, 2.0)], vec![square(0.0, 0.0, 1.0)]];
    let at_a_corner = [vec![square(0.0, 0.0, 1.0)], vec![square(2.0, 2.0, 1.0)]];
    let on_an_edge = [vec![square(0.0, 0.0, 1.0)], vec![ring(&[(1.0, 0.0), (2.0, -1.0), (2.0, 1.0)])]];
    let around_a_corner = [vec![ring(&[(0.0, 0.0), (4.0, 0.0), (0.0, 4.0)])], vec![square(4.0, 4.0, 2.0)]];
    for members in [in_a_hole, at_a_corner, on_an_edge, around_a_corner] {
        assert_eq!(border(&members, even_odd), None, "{members:?}");
    }
}

#[test]
fn members_on_both_sides_of_an_edge_are_united_and_the_edge_is_gone() {
    let beside = [vec![square(0.0, 0.0, 1.0)], vec![square(2.0, 0.0, 1.0)]];
    let filling_a_hole = [vec![square(0.0, 0.0, 4.0), square(0.0, 0.0, 2.0)], vec![square(0.0, 0.0, 2.0)]];
    let along_a_part = [vec![square(-1.0, 0.0, 1.0)], vec![ring(&[(0.0, -0.5), (2.0, 3.0), (0.0, 0.5)])]];
    for (members, total) in [(beside, 8.0), (filling_a_hole, 64.0), (along_a_part, 5.0)] {
        for rule in [even_odd, non_zero] {
            let rings = border(&members, rule).unwrap();
            assert_eq!((rings.len(), area(&rings)), (1, total), "{members:?}");
        }
    }
}

#[test]
fn what_touches_a_union_at_a_point_keeps_its_rings() {
    // From the upper left corner, with the clock.
    let corner = vec![ring(&[(3.0, 3.0), (5.0, 3.0), (5.0, 1.0), (3.0, 1.0)])];
    let members = [vec![square(0.0, 0.0, 1.0)], corner.clone(), vec![square(2.0, 0.0, 1.0)]];
    let rings = border(&members, even_odd).unwrap();
    assert_eq!((rings.len(), &rings[1..]), (2, &corner[..]));
}

#[test]
fn a_sheet_of_squares_side_by_side_is_one_ring() {
    let members: Vec<Rings> =
        (0..400).map(|k| vec![square(f64::from(k % 20) * 30.0, f64::from(k / 20) * 30.0, 15.0)]).collect();
    let rings = border(&members, even_odd).unwrap();
    assert_eq!((rings.len(), area(&rings)), (1, 360_000.0));
}

/// Bars of a comb, as one ring.
fn comb(bars: i32, is_upright: bool) -> Vec<Plan> {
    let length = f64::from(2 * bars) + 1.0;
    let tooth = |k: i32| {
        let at = f64::from(2 * k) + 0.25;
        [(at, 0.0), (at, length), (at + 1.0, length), (at + 1.0, 0.0)]
    };
    let teeth = (0..bars).flat_map(tooth).chain([(length, -1.0), (0.25, -1.0)]);
    teeth.map(|(x, y)| if is_upright { Plan::new(x, y) } else { Plan::new(y, x) }).collect()
}

#[test]
fn much_that_lies_over_much_is_united_soon() {
    // Each of these took the square of its number, or more.
    let nested: Vec<Rings> = (0..1500).map(|k| vec![square(0.0, 0.0, f64::from(k + 1))]).collect();
    assert_eq!(border(&nested, even_odd).map(|rings| area(&rings)), Some(9_000_000.0));
    let same: Vec<Rings> = (0..20_000)
        .map(|k| {
            let mut ring = square(0.5, 0.5, 3.0);
            ring.rotate_left(k % 4);
            if k % 3 == 0 {
                ring.reverse();
            }
            vec![ring]
        })
        .collect();
    assert_eq!(border(&same, non_zero).map(|rings| rings.len()), Some(1));
    let combs = [vec![comb(60, true)], vec![comb(60, false)]];
    assert!(border(&combs, even_odd).is_some_and(|rings| rings.len() > 3000));
}

#[test]
fn what_takes_no_part_keeps_its_rings() {
    let far = vec![square(90.0, 0.0, 3.0), square(90.0, 0.0, 1.0)];
    let members = [vec![square(0.0, 0.0, 1.0)], far.clone(), vec![square(1.0, 0.0, 1.0)]];
    let rings = border(&members, even_odd).unwrap();
    assert_eq!(rings[rings.len() - 2..], far);
    assert_eq!(area(&rings[..rings.len() - 2]), 6.0);
}

#[test]
fn a_member_twice_is_once() {
    let members = vec![vec![square(0.3, 0.7, 1.0)]; 5];
    assert_eq!(border(&members, even_odd).map(|rings| rings.len()), Some(1));
}

#[test]
fn a_member_that_crosses_itself_keeps_what_its_rule_says() {
    let bow = ring(&[(0.0, 0.0), (4.0, 4.0), (4.0, 0.0), (0.0, 4.0)]);
    let members = [vec![bow], vec![square(0.0, 2.0, 1.0)]];
    // Half of the square lies in no triangle of the bow; of the rest, a quarter square of side 1 twice, all of it.
    let rings = border(&members, even_odd).unwrap();
    let held = |p: Plan| members.iter().any(|rings| even_odd(turns(rings, p)));
    for p in [Plan::new(-0.5, 2.0), Plan::new(0.5, 1.5), Plan::new(2.0, 0.5), Plan::new(3.5, 2.0)] {
        assert_eq!(turns(&rings, p), i32::from(held(p)), "{p:?}");
    }
}

fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![(-6..7i32).prop_map(f64::from), -6.0..6.0f64, (-60..60i32).prop_map(|k| f64::from(k) / 10.0)]
}

fn polygon() -> impl Strategy<Value = Rings> {
    let point = (coordinate(), coordinate()).prop_map(|(x, y)| Plan::new(x, y));
    prop::collection::vec(prop::collection::vec(point, 1..8), 1..3)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]
    #[test]
    fn a_point_is_inside_by_the_rule_where_it_is_in_any_member_and_else_not(
        members in prop::collection::vec(polygon(), 2..5),
        is_even_odd in any::<bool>(),
        points in prop::collection::vec((-6.5..6.5f64, -6.5..6.5f64).prop_map(|(x, y)| Plan::new(x, y)), 60),
    ) {
        let rule = if is_even_odd { even_odd } else { non_zero };
        let rings = border(&members, rule);
        for p in points.into_iter().filter(|p| !is_near(&members.concat(), *p)) {
            let bounds = |rings: &Rings| rings.iter().filter(|ring| ring.len() > 2).cloned().collect::<Rings>();
            let holding = members.iter().filter(|rings| rule(turns(&bounds(rings), p))).count();
            match &rings {
                // What takes no part keeps its rings, however they turn.
                Some(rings) => prop_assert_eq!(rule(turns(rings, p)), holding > 0, "at {:?}", p),
                None => prop_assert!(holding < 2, "{} members at {:?}", holding, p),
            }
        }
    }
}
