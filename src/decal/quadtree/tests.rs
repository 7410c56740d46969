use super::borders::Borders;
use super::*;
use crate::decal::LeafPolygons;
use crate::space::{Plan, PlanBox};
use dashu::rational::RBig;
use proptest::prelude::*;

/// The winding number by all edges and rational numbers: what `docs/semantics.md` says of a point that lies on no edge, and the half-open rule
/// of those that lie on one.
fn truth(path: &[Plan], at: Plan) -> i32 {
    let exact = |v: f64| RBig::try_from(v).unwrap();
    let mut turns = 0;
    for (a, b) in path.iter().zip(&path[1..]) {
        if (a.y <= at.y) == (b.y <= at.y) {
            continue;
        }
        // Where the edge is at the point's height.
        let x =
            exact(a.x) + (exact(b.x) - exact(a.x)) * (exact(at.y) - exact(a.y)) / (exact(b.y) - exact(a.y));
        if exact(at.x) < x {
            turns += if a.y <= at.y { 1 } else { -1 };
        }
    }
    turns
}

/// The same for coordinates that are small multiples of 2^-19.
fn truth_on_lattice(path: &[Plan], at: Plan) -> i32 {
    let whole = |p: Plan| {
        let scaled = [p.x * 524288.0, p.y * 524288.0];
        assert!(scaled.iter().all(|v| v.fract() == 0.0 && v.abs() < 1e9), "{p:?}");
        scaled.map(|v| v as i64)
    };
    let [x, y] = whole(at);
    let crossing = |(a, b): (&Plan, &Plan)| {
        let ([ax, ay], [bx, by]) = (whole(*a), whole(*b));
        let is_up = ay <= y;
        let east = (bx - ax) * (y - ay) - (by - ay) * (x - ax);
        match is_up != (by <= y) {
            true if is_up => i32::from(east > 0),
            true => -i32::from(east < 0),
            false => 0,
        }
    };
    path.iter().zip(&path[1..]).map(crossing).sum()
}

/// A closed ring behind a few vertices of others.
fn among_others(ring: &[(f64, f64)]) -> (Vec<Plan>, u32) {
    let ring = ring.iter().chain(&ring[..1]).map(|(x, y)| Plan::new(*x, *y));
    ([(7.0, -3.0), (1e6, 2.0)].map(|(x, y)| Plan::new(x, y)).into_iter().chain(ring).collect(), 2)
}

fn tree_of(vertices: &[Plan], first: u32, limits: Limits, closing: LeafPolygons) -> Quadtree {
    Quadtree::new(&vertices[first as usize..], first, limits, closing)
}

/// The points at which it may go wrong: the lattice and its halves, the ring's vertices and the middles of its edges, the corners and middles
/// of nodes.
fn delicate_points(path: &[Plan], tree: &Quadtree) -> Vec<Plan> {
    let mut all = path.to_vec();
    all.extend(path.windows(2).map(|e| Plan::new(0.5 * (e[0].x + e[1].x), 0.5 * (e[0].y + e[1].y))));
    for x in -1..=17 {
        all.extend((-1..=17).map(|y| Plan::new(0.5 * f64::from(x), 0.5 * f64::from(y))));
    }
    // Those of the deep levels are many.
    let nodes = tree.nodes();
    for (PlanBox { min, max }, _) in nodes.iter().step_by(nodes.len() / 64 + 1) {
        for (x, y) in [(min.x, min.y), (max.x, min.y), (min.x, max.y), (max.x, max.y)] {
            all.extend([
                Plan::new(x, y),
                Plan::new(0.5 * (min.x + max.x), y),
                Plan::new(x, 0.5 * (min.y + max.y)),
            ]);
        }
    }
    all
}

fn limits() -> impl Strategy<Value = Limits> {
    let capacity = prop_oneof![Just(1u32), Just(2), 1..8u32, 1..65u32];
    // Deep trees over edges that lie over one another are large.
    let depth = prop_oneof![8 => 0..8u32, 1 => 8..17u32];
    (capacity, depth).prop_map(|(capacity, depth)| Limits { capacity, depth })
}

/// Rings through few places: they cross and touch themselves, go twice around and back, and run along nodes' borders.
fn ring_on_lattice() -> impl Strategy<Value = Vec<(f64, f64)>> {
    let vertex = prop_oneof![
        (0..9i32, 0..9i32).prop_map(|(x, y)| (f64::from(x), f64::from(y))),
        (0..5i32, 0..5i32).prop_map(|(x, y)| (f64::from(2 * x), f64::from(2 * y))),
        (0..3i32, 0..17i32).prop_map(|(x, y)| (f64::from(4 * x), 0.5 * f64::from(y))),
        (0..17i32, 0..3i32).prop_map(|(x, y)| (0.5 * f64::from(x), f64::from(4 * y))),
    ];
    prop::collection::vec(vertex, 1..40)
}

/// Coordinates a few units in the last place apart, or far apart.
fn coordinate() -> impl Strategy<Value = f64> {
    let near = (0..6i32, -2..3i64).prop_map(|(k, ulps)| {
        let base = f64::from(k) * 0.1;
        f64::from_bits((base.to_bits() as i64 + if base == 0.0 { 0 } else { ulps }) as u64)
    });
    prop_oneof![near, -1.0..1.0f64]
}

fn point() -> impl Strategy<Value = (f64, f64)> {
    (coordinate(), coordinate())
}

fn cell_on_lattice() -> impl Strategy<Value = PlanBox> {
    let corner =
        || (-2..20i32, -2..20i32).prop_map(|(x, y)| Plan::new(0.5 * f64::from(x), 0.5 * f64::from(y)));
    (corner(), corner()).prop_map(|(a, b)| PlanBox::around([a, b]))
}

fn winding(tree: &Quadtree, vertices: &[Plan], at: Plan) -> i32 {
    tree.winding(vertices, Start::ROOT, at, &mut Counts::default())
}

fn distance(path: &[Plan], at: Plan) -> f64 {
    let of = |edge: &[Plan]| {
        let (dx, dy) = (edge[1].x - edge[0].x, edge[1].y - edge[0].y);
        let (px, py) = (at.x - edge[0].x, at.y - edge[0].y);
        let length = dx * dx + dy * dy;
        let along = if length > 0.0 { ((px * dx + py * dy) / length).clamp(0.0, 1.0) } else { 0.0 };
        let (x, y) = (px - along * dx, py - along * dy);
        (x * x + y * y).sqrt()
    };
    path.windows(2).map(of).fold(f64::INFINITY, |a, b| if a < b { a } else { b })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn every_point_has_the_winding_number_of_all_edges(ring in ring_on_lattice(), limits in limits()) {
        let (vertices, first) = among_others(&ring);
        let path = &vertices[first as usize..];
        let tree = tree_of(&vertices, first, limits, LeafPolygons::Corner);
        for at in delicate_points(path, &tree) {
            prop_assert_eq!(winding(&tree, &vertices, at), truth_on_lattice(path, at), "{:?}", at);
        }
    }

    #[test]
    fn points_and_edges_a_rounding_apart_have_the_winding_number_of_rational_arithmetic(
        ring in prop::collection::vec(point(), 1..20), limits in limits(), points in prop::collection::vec(point(), 40),
    ) {
        let (vertices, first) = among_others(&ring);
        let path = &vertices[first as usize..];
        let tree = tree_of(&vertices, first, limits, LeafPolygons::Corner);
        let nodes = tree.nodes();
        let corners = nodes.iter().step_by(nodes.len() / 32 + 1).flat_map(|(plan, _)| [plan.min, plan.max]);
        for at in points.iter().map(|(x, y)| Plan::new(*x, *y)).chain(path.iter().copied()).chain(corners) {
            prop_assert_eq!(winding(&tree, &vertices, at), truth(path, at), "{:?}", at);
        }
    }

    /// A point next to a border is in the node on its side, whatever the division by the size of a column rounds to.
    #[test]
    fn the_node_that_holds_a_point_is_the_one_between_whose_borders_it_is(
        low in -1e3..1e3f64, size in prop_oneof![1e-13..1e-9f64, 1e-3..1e3f64], column in 0..65536u32, level in 0..17u8,
    ) {
        let (high, part) = (low + size, f64::from(column) / 65536.0);
        prop_assume!(low < high);
        let borders = Borders::new(&PlanBox { min: Plan::new(low, low), max: Plan::new(high, high) });
        let near = low + part * (high - low);
        for at in [near, near.next_up(), near.next_down(), low, high].into_iter().filter(|at| (low..=high).contains(at)) {
            let PlanBox { min, max } = borders.of(borders.place(Plan::new(at, at)).quad(level));
            prop_assert!(min.x <= at && (at < max.x || max.x == high), "{} between {} and {}", at, min.x, max.x);
            prop_assert_eq!((min.x, max.x), (min.y, max.y));
        }
    }

    #[test]
    fn a_culled_tree_has_all_that_the_whole_one_has_in_the_cell(
        ring in ring_on_lattice(), limits in limits(), cells in prop::collection::vec(cell_on_lattice(), 8),
    ) {
        let (vertices, first) = among_others(&ring);
        let path = &vertices[first as usize..];
        let tree = tree_of(&vertices, first, limits, LeafPolygons::Corner);
        let points = delicate_points(path, &tree);
        for cell in cells {
            let start = tree.start_in(&cell);
            for at in points.iter().filter(|at| cell.contains(&PlanBox::around([**at]))) {
                let got = start.map_or(0, |start| tree.winding(&vertices, start, *at, &mut Counts::default()));
                prop_assert_eq!(got, truth_on_lattice(path, *at), "{:?} in {:?}", at, cell);
            }
        }
    }

    #[test]
    fn clipped_leaves_say_something_else_at_most_next_to_edges(ring in ring_on_lattice(), limits in limits()) {
        let (vertices, first) = among_others(&ring);
        let path = &vertices[first as usize..];
        let tree = tree_of(&vertices, first, limits, LeafPolygons::Clipped);
        for at in delicate_points(path, &tree).into_iter().filter(|at| distance(path, *at) > 1e-13) {
            prop_assert_eq!(winding(&tree, &vertices, at), truth_on_lattice(path, at), "{:?}", at);
        }
    }

    /// All products of small multiples of 1/32 are exact in single precision.
    #[test]
    fn single_precision_is_right_where_it_rounds_nothing(
        ring in ring_on_lattice(), capacity in 1..9u32, depth in 0..4u32, clips in any::<bool>(), cell in cell_on_lattice(),
    ) {
        let mut ring = ring;
        ring.extend([(0.0, 0.0), (8.0, 8.0)]);
        let (vertices, first) = among_others(&ring);
        let path = &vertices[first as usize..];
        let tree = tree_of(&vertices, first, Limits { capacity, depth }, LeafPolygons::Corner);
        let other = tree_of(&vertices, first, Limits { capacity, depth }, LeafPolygons::Clipped);
        for at in delicate_points(path, &tree) {
            let expected = truth_on_lattice(path, at);
            let single = [at.x as f32, at.y as f32];
            let counts = &mut Counts::default();
            if cell.contains(&PlanBox::around([at])) {
                let got = tree.start_in(&cell).map_or(0, |start| tree.winding_f32(&vertices, start, single, counts));
                prop_assert_eq!(got, expected, "{:?} in {:?}", at, cell);
            }
            prop_assert_eq!(tree.winding_f32(&vertices, Start::ROOT, single, counts), expected, "{:?}", at);
            if clips && distance(path, at) > 1e-4 {
                prop_assert_eq!(other.winding_f32(&vertices, Start::ROOT, single, counts), expected, "{:?}", at);
            }
        }
    }

    /// An edge along the diagonal of the ring's box goes through the corners of leaves, at every depth.
    #[test]
    fn in_single_precision_an_edge_through_a_leafs_corner_turns_nothing_inside_out(
        ring in proptest::collection::vec((0.0..1.0, 0.0..1.0), 4..30), origin in (-99.0..99.0, -99.0..99.0), size in (1.0..99.0, 1.0..99.0),
        depth in 1..6u32, points in proptest::collection::vec((0.0..1.0, 0.0..1.0), 20),
    ) {
        let placed = |(x, y): (f64, f64)| (origin.0 + size.0 * x, origin.1 + size.1 * y);
        let ring: Vec<_> = ring.into_iter().chain([(0.0, 0.0), (1.0, 1.0)]).map(placed).collect();
        let (vertices, first) = among_others(&ring);
        let path = &vertices[first as usize..];
        let tree = tree_of(&vertices, first, Limits { capacity: 4, depth }, LeafPolygons::Corner);
        let points = points.into_iter().map(placed).map(|(x, y)| Plan::new(x, y));
        for at in points.filter(|at| distance(path, *at) > 1e-3) {
            let got = tree.winding_f32(&vertices, Start::ROOT, [at.x as f32, at.y as f32], &mut Counts::default());
            prop_assert_eq!(got, truth(path, at), "{:?}", at);
        }
    }

    #[test]
    fn leaves_have_no_more_edges_than_the_limits_say_and_all_that_meet_them(ring in ring_on_lattice(), limits in limits()) {
        let (vertices, first) = among_others(&ring);
        let path = &vertices[first as usize..];
        let tree = tree_of(&vertices, first, limits, LeafPolygons::Corner);
        let (nodes, whole) = (tree.nodes(), tree.bounds());
        // Too many edges that lie over one another are not divided to the end.
        prop_assume!(tree.bytes() < 1 << 18);
        for (plan, kind) in &nodes {
            match kind {
                Kind::Internal(children) => {
                    let quarter = |k: u32| nodes[(children + k) as usize].0;
                    prop_assert_eq!((quarter(0).min, quarter(3).max), (plan.min, plan.max));
                    prop_assert_eq!((quarter(0).max, quarter(1).min.x, quarter(2).min.y), (quarter(3).min, quarter(3).min.x, quarter(3).min.y));
                }
                Kind::Full(_) => {
                    let meets = path.windows(2).any(|e| e[0] != e[1] && plan.contains(&PlanBox::around([e[0]])));
                    prop_assert!(whole.min.x == whole.max.x || whole.min.y == whole.max.y || !meets, "{:?}", plan);
                }
                Kind::Partial(leaf) => {
                    let Some(LeafEdges::Numbers(numbers)) = tree.leaf_edges() else { continue };
                    let own = &numbers[tree.leaf(*leaf).unwrap().0];
                    let is_deepest = (plan.max.x - plan.min.x) * f64::from(1 << limits.depth) <= whole.max.x - whole.min.x;
                    prop_assert!(own.len() <= limits.capacity as usize || is_deepest, "{} in {:?}", own.len(), plan);
                    for k in (first..).zip(path.windows(2)).filter(|(_, e)| e[0] != e[1] && plan.contains(&PlanBox::around([e[0]]))).map(|(k, _)| k) {
                        prop_assert!(own.contains(&k), "{} is not in {:?}", k, plan);
                    }
                }
            }
        }
    }
}

#[test]
fn a_ring_that_goes_twice_around_winds_twice_and_a_figure_of_eight_once_each_way() {
    let twice: Vec<(f64, f64)> = [(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)].repeat(2);
    let eight = [(0.0, 0.0), (8.0, 8.0), (8.0, 0.0), (0.0, 8.0)];
    for capacity in 1..10 {
        for closing in [LeafPolygons::Corner, LeafPolygons::Clipped] {
            let limits = Limits { capacity, depth: 5 };
            let (vertices, first) = among_others(&twice);
            let tree = tree_of(&vertices, first, limits, closing);
            assert_eq!(winding(&tree, &vertices, Plan::new(3.0, 5.0)), 2);
            assert_eq!(winding(&tree, &vertices, Plan::new(0.01, 7.99)), 2);
            let (vertices, first) = among_others(&eight);
            let tree = tree_of(&vertices, first, limits, closing);
            let at = [(1.0, 4.0), (7.0, 4.0), (4.0, 6.0), (4.0, 2.0)]
                .map(|(x, y)| winding(&tree, &vertices, Plan::new(x, y)));
            assert_eq!(at, [1, -1, 0, 0]);
        }
    }
}

#[test]
fn no_ring_is_too_degenerate() {
    let smallest = f64::from_bits(1);
    let rings: &[&[(f64, f64)]] = &[
        &[(1.0, 1.0)],
        &[(1.0, 1.0), (1.0, 1.0), (1.0, 1.0)],
        &[(1.0, 1.0), (5.0, 1.0), (3.0, 1.0)],
        &[(1.0, 1.0), (1.0, 9.0), (1.0, 3.0)],
        &[(1.0, 1.0), (2.0, 2.0), (3.0, 3.0)],
        &[(-f64::MAX, -f64::MAX), (f64::MAX, -f64::MAX), (f64::MAX, f64::MAX), (-f64::MAX, f64::MAX)],
        &[(0.0, 0.0), (smallest, 0.0), (0.0, smallest)],
        &[(0.0, 0.0), (3.0 * smallest, 0.0), (3.0 * smallest, 1e9), (0.0, 5.0)],
        &[(1e15, 1e15), (1e15 + 1.0, 1e15), (1e15 + 0.25, 1e15 + 2.0)],
    ];
    for ring in rings {
        for (capacity, depth) in [(0, 16), (1, 16), (1, 99), (8, 8)] {
            for closing in [LeafPolygons::Corner, LeafPolygons::Clipped] {
                let (vertices, first) = among_others(ring);
                let tree = tree_of(&vertices, first, Limits { capacity, depth }, closing);
                // A node that is a rounding wide has no quarters.
                let is_slight = ring.len() > 1 && ring[1].0 == 3.0 * smallest;
                assert!(!is_slight || tree.bytes() < 1 << 16, "{}", tree.bytes());
                for at in vertices.iter().copied().chain([Plan::new(f64::NAN, f64::INFINITY)]) {
                    let start =
                        tree.start_in(&PlanBox::around([at, Plan::new(0.0, 0.0)])).unwrap_or(Start::ROOT);
                    winding(&tree, &vertices, at);
                    tree.winding(&vertices, start, at, &mut Counts::default());
                    tree.winding_f32(&vertices, start, [at.x as f32, at.y as f32], &mut Counts::default());
                }
            }
        }
    }
    let none = Quadtree::new(&[], 0, Limits { capacity: 1, depth: 16 }, LeafPolygons::Clipped);
    assert_eq!(winding(&none, &[], Plan::new(0.0, 0.0)), 0);
    assert_eq!(none.start_in(&PlanBox::around([Plan::new(0.0, 0.0)])), None);
}

/// Needles one beside another, each as long as the ring: each would lie in the nodes of all levels along it.
#[test]
fn needles_need_no_memory_without_end() {
    let ring: Vec<(f64, f64)> = (0..4000)
        .map(|k| (f64::from(k % 2) * 1000.0 + f64::from(k) * 1e-7, f64::from(k % 2) * 999.0))
        .collect();
    let (vertices, first) = among_others(&ring);
    let tree = tree_of(&vertices, first, Limits { capacity: 1, depth: 16 }, LeafPolygons::Corner);
    assert!(tree.bytes() < 32 << 20, "{}", tree.bytes());
    let path = &vertices[first as usize..];
    for k in 0..50 {
        let at = Plan::new(10.0 * f64::from(k) + 3e-5, 9.99 * f64::from(k));
        assert_eq!(winding(&tree, &vertices, at), truth(path, at), "{at:?}");
    }
}

/// A wavy ring about a place.
fn wavy(count: u32) -> Vec<(f64, f64)> {
    let angle = |k: u32| f64::from(k) / f64::from(count) * std::f64::consts::TAU;
    let radius = |k: u32| {
        1000.0 + 100.0 * crate::math::sin(17.0 * angle(k)) + 3.0 * crate::math::sin(211.0 * angle(k))
    };
    (0..count)
        .map(|k| (radius(k) * crate::math::cos(angle(k)), radius(k) * crate::math::sin(angle(k))))
        .collect()
}

#[test]
fn a_small_ring_costs_no_more_than_its_bounds_and_a_large_one_a_few_bytes_a_vertex() {
    let limits = Limits { capacity: 8, depth: 8 };
    let (vertices, first) = among_others(&wavy(8));
    assert_eq!(tree_of(&vertices, first, limits, LeafPolygons::Corner).bytes(), size_of::<Quadtree>());
    assert!(size_of::<Quadtree>() <= 48);
    let (vertices, first) = among_others(&wavy(5000));
    let tree = tree_of(&vertices, first, limits, LeafPolygons::Corner);
    assert!(tree.bytes() < 5000 * 20, "{}", tree.bytes());
}

#[test]
fn few_nodes_and_edges_are_looked_at_and_from_a_cell_in_a_leaf_a_single_node() {
    let (vertices, first) = among_others(&wavy(5000));
    let limits = Limits { capacity: 8, depth: 10 };
    let tree = tree_of(&vertices, first, limits, LeafPolygons::Corner);
    for (plan, kind) in tree.nodes() {
        let at = Plan::new(0.5 * (plan.min.x + plan.max.x), 0.5 * (plan.min.y + plan.max.y));
        let (mut whole, mut culled) = (Counts::default(), Counts::default());
        let turns = tree.winding(&vertices, Start::ROOT, at, &mut whole);
        assert!(whole.nodes <= 11 && whole.edges <= 8, "{whole:?}");
        let Some(start) = tree.start_in(&PlanBox::around([at])) else {
            assert_eq!((turns, kind == Kind::Full(0) || matches!(kind, Kind::Internal(_))), (0, true));
            continue;
        };
        assert_eq!(tree.winding(&vertices, start, at, &mut culled), turns);
        assert_eq!((culled.nodes, culled.edges), (1, whole.edges), "{plan:?}");
    }
}
