//! Each sample sees the triangle that exact rational ray casting finds, whatever the tiles, the camera and the terrain.
#![cfg(feature = "render")]

use dashu::rational::RBig;
use drapery::math;
use drapery::raster::Lattice;
use drapery::scene::{Detail, Diagonal, LevelOfDetail, Posts, Surface};
use drapery::space::{Plan, Ray, ViewFrame, Viewpoint, World};
use drapery::terrain::lod::Hierarchy;
use drapery::terrain::{Grid, Lattice as Posted, Mesh, SKY};
use drapery::visibility::Visible;
use glam::{DVec2, DVec3};
use proptest::prelude::*;
use std::sync::Arc;

type V = [RBig; 3];

fn exact(p: World) -> V {
    [p.x, p.y, p.z].map(|v| RBig::try_from(v).unwrap())
}

fn minus(a: &V, b: &V) -> V {
    [0, 1, 2].map(|k| a[k].clone() - b[k].clone())
}

fn det(a: &V, b: &V, c: &V) -> RBig {
    let m = |i: usize, j: usize| b[i].clone() * c[j].clone() - b[j].clone() * c[i].clone();
    a[0].clone() * m(1, 2) + a[1].clone() * m(2, 0) + a[2].clone() * m(0, 1)
}

/// The parameter at which the ray meets the closed triangle, in rational arithmetic (Cramer's rule).
fn meets(ray: &Ray, [a, b, c]: &[World; 3]) -> Option<RBig> {
    let (from, a, b, c) = (exact(ray.from), exact(*a), exact(*b), exact(*c));
    let (along, u, v, s) =
        (minus(&exact(ray.through), &from), minus(&b, &a), minus(&c, &a), minus(&from, &a));
    // s + t along = p u + q v
    let d = det(&along, &u, &v);
    if d == RBig::ZERO {
        return None;
    }
    let t = -det(&s, &u, &v) / d.clone();
    let p = det(&along, &s, &v) / d.clone();
    let q = det(&along, &u, &s) / d;
    (p >= RBig::ZERO && q >= RBig::ZERO && p + q <= RBig::ONE).then_some(t)
}

/// Every triangle that an exact brute-force ray caster accepts as the first.
fn firsts(frame: &ViewFrame, mesh: &Mesh, ray: &Ray) -> Vec<u32> {
    let unit = RBig::try_from(frame.reach()).unwrap();
    let (near, far) = (RBig::try_from(frame.near()).unwrap(), RBig::try_from(frame.far()).ok());
    let mut best: Option<RBig> = None;
    let mut ids = Vec::new();
    for id in 0..mesh.triangle_ids() {
        let Some(t) = mesh.triangle(id).and_then(|t| meets(ray, &t)) else {
            continue;
        };
        let depth = t.clone() * unit.clone();
        if depth < near || far.as_ref().is_some_and(|f| depth > *f) {
            continue;
        }
        match &best {
            Some(b) if t > *b => {}
            Some(b) if t == *b => ids.push(id),
            _ => {
                best = Some(t);
                ids = vec![id];
            }
        }
    }
    ids
}

/// Whether the ray meets the triangle's border, so that the half-open rule may give the sample to a neighbour or to none.
fn is_on_border(ray: &Ray, [a, b, c]: [World; 3]) -> bool {
    let (from, through) = (exact(ray.from), exact(ray.through));
    [(a, b), (b, c), (c, a)].iter().any(|&(p, q)| {
        det(&minus(&exact(p), &from), &minus(&exact(q), &from), &minus(&through, &from)) == RBig::ZERO
    })
}

fn check(frame: &ViewFrame, mesh: &Mesh, tile: usize) -> Result<(), TestCaseError> {
    let lattice = Lattice::centres(frame, 0);
    let mut visible = Visible::new(&lattice, tile);
    visible.see(frame, mesh);
    let (ids, keys) = (visible.triangles(), visible.keys());
    for r in 0..lattice.rows {
        for c in 0..lattice.columns {
            let ray = frame.ray(lattice.at(c, r));
            let expected = firsts(frame, mesh, &ray);
            let seen = ids[r * lattice.columns + c];
            let agrees = expected.contains(&seen) || expected.is_empty() && seen == SKY;
            let fine = agrees || expected.iter().any(|&id| is_on_border(&ray, mesh.triangle(id).unwrap()));
            prop_assert!(fine, "sample ({}, {}) sees {}, exact ray casting {:?}", c, r, seen, expected);
            prop_assert_eq!(seen == SKY, keys[r * lattice.columns + c] == f32::NEG_INFINITY);
        }
    }
    Ok(())
}

fn grid(n: usize, cell: f64, diagonal: Diagonal, heights: &[f64]) -> Mesh {
    let heights: Vec<f64> = heights.iter().copied().cycle().take(n * n).collect();
    let first = Plan::new(-((n - 1) as f64) / 2.0 * cell, -((n - 1) as f64) / 2.0 * cell);
    Mesh::new(
        Surface::Grid(Posts::new((n, n), first, (DVec2::X * cell, DVec2::Y * cell), heights).unwrap()),
        diagonal,
    )
    .unwrap()
}

fn camera(eye: [f64; 3], target: [f64; 3], near: f64, far: f64) -> Viewpoint {
    let point = |p: [f64; 3]| World::new(p[0], p[1], p[2]);
    Viewpoint { eye: point(eye), target: point(target), up: DVec3::new(0.01, 0.02, 1.0), near, far }
}

fn height() -> impl Strategy<Value = f64> {
    prop_oneof![8 => (-8..8i32).prop_map(|h| f64::from(h) / 4.0), 8 => -2.0..2.0f64, 1 => Just(f64::NAN)]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(30))]

    #[test]
    fn a_perspective_sample_sees_the_triangle_of_exact_ray_casting(
        heights in prop::collection::vec(height(), 49),
        eye in prop::array::uniform3(-6.0..6.0f64),
        target in prop::array::uniform3(-1.0..1.0f64),
        near in prop_oneof![Just(1e-3), 0.1..4.0f64],
        far in prop_oneof![Just(f64::INFINITY), 4.0..9.0f64],
        diagonal in prop_oneof![Just(Diagonal::SwNe), Just(Diagonal::NwSe), Just(Diagonal::Alternating)],
        tile in prop_oneof![Just(5usize), Just(8), Just(64)],
    ) {
        let mesh = grid(7, 1.0, diagonal, &heights);
        if let Ok(frame) = ViewFrame::perspective(&camera(eye, target, near, far), 60.0, (17, 13)) {
            check(&frame, &mesh, tile)?;
        }
    }

    #[test]
    fn an_orthographic_sample_on_or_a_hair_beside_posts_and_edges_sees_the_right_triangle(
        heights in prop::collection::vec((-8..8i32).prop_map(|h| f64::from(h) / 4.0), 49),
        shift in (-4..4i32, prop_oneof![Just(0.0), Just(1e-7), Just(-1e-9), Just(1e-12), Just(-1e-14)])
            .prop_map(|(quarters, hair)| f64::from(quarters) / 4.0 + hair),
        pixels_a_cell in prop_oneof![Just(2.0), Just(0.75)],
        cell in prop_oneof![Just(1.0), Just(0.3), Just(0.7)],
        tilt in prop_oneof![Just(0.0), Just(1.0), 0.0..3.0f64],
    ) {
        let mesh = grid(7, cell, Diagonal::SwNe, &heights);
        let view = Viewpoint {
            eye: World::new(shift * cell, shift * cell - tilt * 10.0, 10.0),
            target: World::new(shift * cell, shift * cell, 0.0),
            up: DVec3::Y,
            near: 0.5,
            far: f64::INFINITY,
        };
        // A pixel is a simple part of a cell: seen from straight above, samples fall on posts, edges and diagonals, or a hair beside.
        let frame = ViewFrame::orthographic(&view, 16.0 / pixels_a_cell * cell, (16, 16)).unwrap();
        check(&frame, &mesh, 8)?;
    }
}

/// A number between 10^low and 10^high, every order of magnitude alike.
fn magnitude(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low..high).prop_map(|exponent| math::pow(10.0, exponent))
}

/// The eye at a distance from the target, in a direction that is also steep or grazing.
fn eye_at(target: [f64; 3], direction: [f64; 3], distance: f64) -> [f64; 3] {
    let along = DVec3::from(direction).normalize_or(DVec3::Z);
    (DVec3::from(target) + along * distance).into()
}

fn direction() -> impl Strategy<Value = [f64; 3]> {
    let slope = prop_oneof![-1.0..1.0f64, -1e-9..1e-9f64, Just(0.0)];
    (slope.clone(), slope, prop_oneof![Just(1.0), -1.0..1.0f64, -1e-6..1e-6f64])
        .prop_map(|(x, y, z)| [x, y, z])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn a_sample_sees_the_right_triangle_at_every_scale_distance_and_angle_of_view(
        heights in prop::collection::vec(height(), 36),
        cell in magnitude(-3.0, 4.0),
        steepness in magnitude(-6.0, 5.0),
        away in magnitude(-1.0, 8.0),
        place in prop::array::uniform2(-2.5..2.5f64),
        direction in direction(),
        spread in prop_oneof![Just(1.0), magnitude(-4.0, 1.0)],
        lens in prop_oneof![Just(None), Just(Some(None)), Just(Some(Some(0.01))), Just(Some(Some(179.0)))],
        diagonal in prop_oneof![Just(Diagonal::SwNe), Just(Diagonal::NwSe), Just(Diagonal::Alternating)],
        tile in prop_oneof![Just(5usize), Just(8), Just(64)],
    ) {
        let n = 6;
        let heights: Vec<f64> = heights.iter().map(|h| h * cell * steepness).collect();
        let first = Plan::new(-2.5 * cell, -2.5 * cell);
        let posts = Posts::new((n, n), first, (DVec2::X * cell, DVec2::Y * cell), heights).unwrap();
        let mesh = Mesh::new(Surface::Grid(posts), diagonal);
        prop_assume!(mesh.is_ok());
        let target = [place[0] * cell, place[1] * cell, 0.0];
        let distance = away * cell;
        let view = camera(eye_at(target, direction, distance), target, distance * 1e-3, f64::INFINITY);
        let extent = 6.0 * cell * spread;
        let frame = match lens {
            None => ViewFrame::orthographic(&view, extent, (13, 11)),
            Some(None) => {
                let fov = 2.0 * math::atan(extent / 2.0 / distance).to_degrees();
                ViewFrame::perspective(&view, fov.clamp(1e-9, 179.9), (13, 11))
            }
            Some(Some(fov)) => ViewFrame::perspective(&view, fov, (13, 11)),
        };
        if let Ok(frame) = frame {
            check(&frame, &mesh.unwrap(), tile)?;
        }
    }

    #[test]
    fn a_sample_sees_the_right_triangle_of_a_network_of_slivers(
        points in prop::collection::vec((-3.0..3.0f64, -1.0..1.0f64, -1.0..1.0f64), 12..40),
        thin in magnitude(-9.0, 0.0),
        direction in direction(),
        away in magnitude(0.0, 7.0),
        spread in magnitude(-3.0, 1.0),
        orthographic in any::<bool>(),
    ) {
        let points = points.iter().map(|&(x, y, z)| World::new(x, y * thin, z)).collect();
        let mesh = Mesh::new(Surface::Points(points), Diagonal::SwNe);
        prop_assume!(mesh.is_ok());
        let target = [0.0, 0.0, 0.0];
        let view = camera(eye_at(target, direction, away), target, away * 1e-3, f64::INFINITY);
        let frame = if orthographic {
            ViewFrame::orthographic(&view, 8.0 * spread, (13, 11))
        } else {
            ViewFrame::perspective(&view, math::min(2.0 * math::atan(4.0 * spread / away).to_degrees(), 179.0), (13, 11))
        };
        if let Ok(frame) = frame {
            check(&frame, &mesh.unwrap(), 8)?;
        }
    }
}

/// The level-of-detail meshes of hills, of which some posts are missing.
fn hierarchy() -> Hierarchy {
    let n = 129;
    let height = |k: usize| {
        let (i, j) = ((k % n) as f64, (k / n) as f64);
        let is_hole = k % 4987 == 4986;
        if is_hole { f64::NAN } else { 9.0 * math::sin(i / 21.0) * math::sin(j / 13.0) }
    };
    let heights = (0..n * n).map(height).collect();
    let posts = Posts::new((n, n), Plan::new(-64.0, -64.0), (DVec2::X, DVec2::Y), heights).unwrap();
    Hierarchy::new(Posted::Plane(Arc::new(Grid::new(posts, Diagonal::Alternating).unwrap()))).unwrap()
}

#[test]
fn a_sample_sees_the_right_triangle_of_a_level_of_detail_mesh() {
    let hierarchy = hierarchy();
    let mut drawn = Vec::new();
    for (detail, eye, target, fov) in [
        (Detail::ErrorPx(1.5), [-90.0, -60.0, 35.0], [0.0, 0.0, 0.0], Some(50.0)),
        (Detail::ErrorPx(1.0), [10.0, 8.0, 14.0], [40.0, 60.0, -5.0], Some(80.0)),
        (Detail::ErrorPx(0.4), [5.0, -40.0, 90.0], [0.0, 10.0, 0.0], None),
        (Detail::Level(4), [-30.0, 20.0, 12.0], [64.0, 64.0, 0.0], Some(60.0)),
    ] {
        let view = camera(eye, target, 0.5, f64::INFINITY);
        let frame = match fov {
            Some(fov) => ViewFrame::perspective(&view, fov, (13, 11)),
            None => ViewFrame::orthographic(&view, 130.0, (13, 11)),
        };
        let frame = frame.unwrap();
        let mesh = Mesh::Lod(Box::new(hierarchy.mesh_for(&frame, &LevelOfDetail { detail, borrow: 0.0 })));
        check(&frame, &mesh, 8).unwrap();
        drawn.push(mesh.triangle_ids());
    }
    assert!(drawn.iter().all(|count| (100..2000).contains(count)), "{drawn:?}");
}

#[test]
fn every_sample_over_a_closed_surface_is_covered_once_from_straight_above() {
    let mesh = grid(33, 1.0, Diagonal::Alternating, &[0.0]);
    let view = Viewpoint {
        eye: World::new(0.0, 0.0, 10.0),
        target: World::new(0.0, 0.0, 0.0),
        up: DVec3::Y,
        near: 0.5,
        far: f64::INFINITY,
    };
    // 65 samples at a distance of half a metre, the first exactly on the rim, the last exactly on the opposite one.
    let frame = ViewFrame::orthographic(&view, 32.5, (65, 65)).unwrap();
    let mut visible = Visible::new(&Lattice::centres(&frame, 0), 32);
    visible.see(&frame, &mesh);
    let seen = visible.triangles().iter().filter(|id| **id != SKY).count();
    assert_eq!(seen, 64 * 64, "the half-open rule keeps one rim of two");
}

#[test]
fn a_camera_that_looks_along_a_line_of_posts_or_a_diagonal_sees_the_whole_plain() {
    let mesh = grid(33, 30.0, Diagonal::SwNe, &[0.0]);
    for target in
        [[100.0, 0.0, 5.0], [100.0, -100.0, 5.0], [100.0, 100.0, 5.0], [0.0, 100.0, 5.0], [-100.0, 0.0, 5.0]]
    {
        let view = Viewpoint { up: DVec3::Z, ..camera([0.0, 0.0, 5.0], target, 0.01, f64::INFINITY) };
        let frame = ViewFrame::perspective(&view, 120.0, (101, 67)).unwrap();
        let mut visible = Visible::new(&Lattice::centres(&frame, 0), 64);
        visible.see(&frame, &mesh);
        // From 5 m above a plain that reaches 480 m, the rows 2 below the horizon and more see it.
        let ids = visible.triangles();
        let missing =
            (36..67).flat_map(|r| (0..101).map(move |c| (c, r))).filter(|(c, r)| ids[r * 101 + c] == SKY);
        assert_eq!(missing.count(), 0, "towards {target:?}");
    }
}

#[test]
fn a_needle_whose_corners_fall_together_in_single_precision_is_seen() {
    let p = |x: f64, y: f64| World::new(x, y, 0.0);
    let points = vec![p(-100.0, -1e-7), p(-100.0, 1e-7), p(100.0, 0.0), p(0.0, 300.0), p(0.0, -300.0)];
    let mesh = Mesh::new(Surface::Points(points), Diagonal::SwNe).unwrap();
    let view =
        Viewpoint { up: DVec3::Y, ..camera([0.5, -20.0, 500.0], [0.5, -20.0, 0.0], 0.1, f64::INFINITY) };
    let frame = ViewFrame::orthographic(&view, 202.0, (91, 101)).unwrap();
    let mut visible = Visible::new(&Lattice::centres(&frame, 0), 64);
    visible.see(&frame, &mesh);
    let row = &visible.triangles()[40 * 91..41 * 91];
    assert!(row[10..80].iter().all(|id| *id != SKY), "{row:?}");
}
