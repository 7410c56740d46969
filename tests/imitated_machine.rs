//! The imitated machine sees what exact mathematics sees, but for what its precision, snapping and depth buffer explain.
#![cfg(feature = "render")]

mod drawing;

use drapery::parallel;
use drapery::raster::device::{Pipeline, Real, Window};
use drapery::raster::{Lattice, Samples};
use drapery::scene::{DepthFormat, Device, Diagonal, Interpolation, Positions, Posts, Precision, Surface};
use drapery::space::{Plan, Screen, View, ViewFrame, Viewpoint, World};
use drapery::terrain::{Mesh, SKY, SurfaceVertex};
use drapery::visibility::{Hit, Machine, Sight, Visible};
use glam::{DVec2, DVec3};
use proptest::prelude::*;

const FORMATS: [DepthFormat; 4] =
    [DepthFormat::F32Reversed, DepthFormat::F32, DepthFormat::Unorm24, DepthFormat::Unorm16];
const DOUBLE: Device = device(Precision::F64, 0, DepthFormat::F32Reversed);

const fn device(precision: Precision, subpixel_bits: u32, depth: DepthFormat) -> Device {
    Device {
        precision,
        position: Positions::Local,
        subpixel_bits,
        interpolation: Interpolation::Snapped,
        depth,
        stencil_bits: 8,
        max_line_width_px: 10.0,
        filter_bits: 0,
        level_bits: 0,
    }
}

/// Every precision, snapping and depth buffer.
fn devices() -> impl Iterator<Item = Device> {
    let precisions = [Precision::F64, Precision::F32].into_iter();
    precisions.flat_map(|p| [0, 4, 8].into_iter().flat_map(move |bits| FORMATS.map(|f| device(p, bits, f))))
}

fn grid(n: usize, at: DVec2, cell: f64, height: impl Fn(usize, usize) -> f64) -> Mesh {
    let heights = (0..n * n).map(|k| height(k % n, k / n)).collect();
    let half = (n - 1) as f64 / 2.0 * cell;
    let first = Plan::new(at.x - half, at.y - half);
    let posts = Posts::new((n, n), first, (DVec2::X * cell, DVec2::Y * cell), heights).unwrap();
    Mesh::new(Surface::Grid(posts), Diagonal::Alternating).unwrap()
}

fn viewpoint(eye: [f64; 3], target: [f64; 3], near: f64, far: f64) -> Viewpoint {
    let point = |p: [f64; 3]| World::new(p[0], p[1], p[2]);
    Viewpoint { eye: point(eye), target: point(target), up: DVec3::new(0.01, 0.02, 1.0), near, far }
}

fn seen_exactly(frame: &ViewFrame, mesh: &Mesh) -> Visible {
    let mut visible = Visible::new(&Lattice::centres(frame, 0), 64);
    visible.see(frame, mesh);
    visible
}

fn seen_on(frame: &ViewFrame, mesh: &Mesh, device: &Device, tile: usize) -> Visible {
    let mut visible = Visible::new(&Lattice::centres(frame, 0), tile);
    Machine::new(frame, mesh, device).see(&mut visible, mesh);
    visible
}

/// The part of a triangle between the near and the far plane, on the screen.
fn outline(frame: &ViewFrame, triangle: [World; 3]) -> Vec<Screen> {
    let mut polygon: Vec<View> = triangle.iter().map(|p| frame.view_from_world(*p)).collect();
    for (sign, limit) in [(-1.0, frame.near()), (1.0, -frame.far())] {
        let inside = |v: &View| sign * v.z - limit;
        let mut cut = Vec::new();
        for (k, a) in polygon.iter().enumerate() {
            let b = &polygon[(k + 1) % polygon.len()];
            let (d, e) = (inside(a), inside(b));
            if d >= 0.0 {
                cut.push(*a);
            }
            if (d >= 0.0) != (e >= 0.0) {
                cut.push(*a + (*b - *a) * (d / (d - e)));
            }
        }
        polygon = cut;
    }
    let to_world = |v: &View| frame.eye() + (frame.right() * v.x + frame.up() * v.y - frame.forward() * v.z);
    polygon.iter().filter_map(|v| frame.screen_from_world(to_world(v))).collect()
}

/// How far a screen point is from the outline of a triangle; infinite for none.
fn border_distance(frame: &ViewFrame, mesh: &Mesh, id: u32, at: Screen) -> f64 {
    if id == SKY {
        return f64::INFINITY;
    }
    let outline = outline(frame, mesh.triangle(id).unwrap());
    let distance = |k: usize| {
        let (a, b) = (outline[k], outline[(k + 1) % outline.len()]);
        let (along, to) = (b - a, at - a);
        let t = (along.dot(to) / along.length_squared()).clamp(0.0, 1.0);
        (to - along * if t.is_nan() { 0.0 } else { t }).length()
    };
    (0..outline.len()).map(distance).fold(f64::INFINITY, |m, d| if d < m { d } else { m })
}

/// The greatest distance from the borders of both triangles of a sample where two lattices see different ones.
fn farthest_difference(frame: &ViewFrame, mesh: &Mesh, one: &Visible, other: &Visible) -> (usize, f64) {
    let (lattice, first, second) = (one.lattice, one.triangles(), other.triangles());
    let (mut count, mut farthest) = (0, 0.0);
    for k in (0..first.len()).filter(|&k| first[k] != second[k]) {
        let at = lattice.at(k % lattice.columns, k / lattice.columns);
        let distances = [first[k], second[k]].map(|id| border_distance(frame, mesh, id, at));
        let nearest = drapery::math::min(distances[0], distances[1]);
        farthest = if nearest > farthest { nearest } else { farthest };
        count += 1;
    }
    (count, farthest)
}

fn height() -> impl Strategy<Value = f64> {
    prop_oneof![8 => (-8..8i32).prop_map(|h| f64::from(h) / 4.0), 8 => -2.0..2.0f64, 1 => Just(f64::NAN)]
}

fn scene() -> impl Strategy<Value = Option<(Mesh, ViewFrame)>> {
    let near = prop_oneof![Just(1e-2), 0.1..4.0f64];
    let far = prop_oneof![Just(f64::INFINITY), 5.0..9.0f64];
    let (eye, target) = (prop::array::uniform3(-6.0..6.0f64), prop::array::uniform3(-1.0..1.0f64));
    (prop::collection::vec(height(), 49), eye, target, near, far, any::<bool>()).prop_map(
        |(heights, eye, target, near, far, is_perspective)| {
            let mesh = grid(7, DVec2::ZERO, 1.0, |i, j| heights[j * 7 + i]);
            let view = viewpoint(eye, target, near, far);
            let frame = if is_perspective {
                ViewFrame::perspective(&view, 60.0, (48, 40))
            } else {
                ViewFrame::orthographic(&view, 8.0, (48, 40))
            };
            frame.ok().map(|frame| (mesh, frame))
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn in_double_precision_without_snapping_it_sees_what_exact_mathematics_sees(scene in scene()) {
        if let Some((mesh, frame)) = scene {
            let (_, distance) = farthest_difference(
                &frame,
                &mesh,
                &seen_exactly(&frame, &mesh),
                &seen_on(&frame, &mesh, &DOUBLE, 64),
            );
            prop_assert!(distance < 1e-9, "a sample {} px from every border differs", distance);
        }
    }

    #[test]
    fn with_8_bits_only_samples_within_a_snap_of_a_border_change(scene in scene()) {
        if let Some((mesh, frame)) = scene {
            let (_, distance) = farthest_difference(
                &frame,
                &mesh,
                &seen_exactly(&frame, &mesh),
                &seen_on(&frame, &mesh, &device(Precision::F64, 8, DepthFormat::F32Reversed), 64),
            );
            // Half a unit in x and in y.
            let snap = std::f64::consts::SQRT_2 / 2.0 / 256.0;
            prop_assert!(distance < snap + 1e-9, "a sample {} px from every border differs", distance);
        }
    }

    #[test]
    fn tiles_and_threads_change_nothing(scene in scene(), bits in prop_oneof![Just(0u32), Just(4), Just(8)]) {
        if let Some((mesh, frame)) = scene {
            let device = device(Precision::F32, bits, DepthFormat::Unorm24);
            let whole = seen_on(&frame, &mesh, &device, 512);
            for (tile, threads) in [(5, 1), (16, 3), (64, 1), (128, 2)] {
                let cut = parallel::with_threads(threads, || seen_on(&frame, &mesh, &device, tile)).unwrap();
                prop_assert_eq!(cut.triangles(), whole.triangles());
                prop_assert_eq!(cut.keys(), whole.keys());
            }
        }
    }
}

#[test]
fn snapping_changes_some_samples() {
    let mesh = grid(65, DVec2::ZERO, 1.0, |i, j| f64::from((i * 7 + j * 13) as u32 % 5) / 3.0);
    let view = viewpoint([3.0, -40.0, 25.0], [0.0, 0.0, 0.0], 0.1, f64::INFINITY);
    let frame = ViewFrame::perspective(&view, 60.0, (256, 256)).unwrap();
    let exact = seen_exactly(&frame, &mesh);
    for bits in [4, 8] {
        let snapped = seen_on(&frame, &mesh, &device(Precision::F64, bits, DepthFormat::F32Reversed), 64);
        let (count, distance) = farthest_difference(&frame, &mesh, &exact, &snapped);
        let snap = std::f64::consts::SQRT_2 / 2.0 / f64::from(1 << bits);
        assert!(count > 0 && distance < snap + 1e-9, "{bits} bits: {count} samples, {distance} px");
    }
}

/// How many triangles cover each sample when each is drawn alone.
fn cover_counts<T: Real>(frame: &ViewFrame, mesh: &Mesh, device: &Device, lattice: &Lattice) -> Vec<u32> {
    let pipeline = Pipeline::<T>::new(frame, mesh, device);
    let window = Window { columns: 0..lattice.columns, rows: 0..lattice.rows };
    let mut counts = vec![0; lattice.columns * lattice.rows];
    let mut samples = Samples::default();
    for id in 0..mesh.triangle_ids() {
        pipeline.clear(&mut samples, (lattice.columns, lattice.rows));
        let primitives = pipeline.primitives(mesh, id..id + 1, lattice);
        pipeline.draw(primitives.iter(), (lattice, &window), &mut samples);
        for (k, count) in counts.iter_mut().enumerate() {
            let at = k / lattice.columns * samples.stride() + k % lattice.columns;
            *count += u32::from(samples.ids[at] != SKY);
        }
    }
    counts
}

fn assert_covered_once(frame: &ViewFrame, mesh: &Mesh, lattice: &Lattice, bits: [u32; 2]) {
    for bits in bits {
        let single = device(Precision::F32, bits, DepthFormat::F32Reversed);
        let double = device(Precision::F64, bits, DepthFormat::F32Reversed);
        let counts = [
            cover_counts::<f32>(frame, mesh, &single, lattice),
            cover_counts::<f64>(frame, mesh, &double, lattice),
        ];
        for counts in counts {
            let wrong = counts.iter().filter(|n| **n != 1).count();
            assert_eq!(wrong, 0, "samples covered never or twice at {bits} bits");
        }
    }
}

#[test]
fn with_vertices_and_edges_on_samples_each_sample_is_covered_once() {
    let mesh = grid(13, DVec2::ZERO, 1.0, |_, _| 0.0);
    let mut view = viewpoint([0.0, 0.0, 10.0], [0.0, 0.0, 0.0], 0.5, f64::INFINITY);
    view.up = DVec3::Y;
    // Samples half a cell apart: on posts, on edges and on diagonals.
    let frame = ViewFrame::orthographic(&view, 10.0, (20, 20)).unwrap();
    assert_covered_once(&frame, &mesh, &Lattice::corners(&frame), [4, 8]);
    assert_covered_once(&frame, &mesh, &Lattice::corners(&frame), [0, 8]);
}

#[test]
fn samples_on_edges_and_vertices_belong_to_the_triangle_of_exact_mathematics() {
    let mesh = grid(13, DVec2::ZERO, 1.0, |_, _| 0.0);
    let mut view = viewpoint([0.0, 0.0, 10.0], [0.0, 0.0, 0.0], 0.5, 16.0);
    view.up = DVec3::Y;
    // All coordinates are small dyadic fractions: the machine adds no rounding.
    let frame = ViewFrame::orthographic(&view, 8.0, (16, 16)).unwrap();
    let lattice = Lattice::corners(&frame);
    let mut exact = Visible::new(&lattice, 8);
    exact.see(&frame, &mesh);
    for device in devices() {
        let mut seen = Visible::new(&lattice, 8);
        Machine::new(&frame, &mesh, &device).see(&mut seen, &mesh);
        assert_eq!(seen.triangles(), exact.triangles(), "{device:?}");
    }
}

#[test]
fn a_closed_surface_from_above_is_covered_once_with_snapping() {
    let mesh = grid(13, DVec2::ZERO, 1.0, |i, j| f64::from((i * 31 + j * 17) as u32 % 7) / 9.0);
    let view = viewpoint([0.3, -0.2, 12.0], [0.0, 0.0, 0.0], 0.5, f64::INFINITY);
    let frame = ViewFrame::perspective(&view, 40.0, (64, 64)).unwrap();
    // A fine lattice: a crack as narrow as a snap would show.
    let lattice = Lattice { x: 0.0, y: 0.0, step: 1.0 / 8.0, columns: 128, rows: 128 };
    assert_covered_once(&frame, &mesh, &lattice, [4, 8]);
    assert_covered_once(&frame, &mesh, &Lattice::centres(&frame, 0), [4, 8]);
}

#[test]
fn a_sixteen_bit_depth_buffer_fights_where_a_reversed_float_one_does_not() {
    let mesh = grid(101, DVec2::ZERO, 20.0, |i, j| 60.0 * f64::from((i / 3 + j / 2) as u32 % 2));
    // From the north: far triangles have the lower numbers and win where depths are equal.
    let view = viewpoint([0.0, 1500.0, 300.0], [0.0, 0.0, 0.0], 0.1, 1e6);
    let frame = ViewFrame::perspective(&view, 60.0, (256, 256)).unwrap();
    let exact = seen_exactly(&frame, &mesh);
    let differs = |format| {
        let seen = seen_on(&frame, &mesh, &device(Precision::F64, 0, format), 64);
        farthest_difference(&frame, &mesh, &exact, &seen)
    };
    let (_, distance) = differs(DepthFormat::F32Reversed);
    assert!(distance < 1e-9, "{distance} px");
    let (count, distance) = differs(DepthFormat::Unorm16);
    assert!(count > 1000 && distance > 1.0, "{count} samples, {distance} px");
    let (fewer, _) = differs(DepthFormat::Unorm24);
    assert!(fewer < count / 4, "{fewer} of {count}");
}

fn assert_sound(frame: &ViewFrame, mesh: &Mesh, what: &str) {
    for device in devices() {
        let mut sight = Sight::new(frame, mesh, &device, Lattice::centres(frame, 1), 16);
        sight.see();
        let Lattice { columns, rows, .. } = *sight.lattice();
        for (c, r) in (0..rows).flat_map(|r| (0..columns).map(move |c| (c, r))) {
            let id = sight.triangle(c, r);
            assert!(id == SKY || id < mesh.triangle_ids(), "{what}: {device:?}");
            if let Some(hit) = sight.hit(c, r) {
                let is_sound = hit.plan.is_finite() && hit.world.is_finite() && hit.depth > 0.0;
                assert!(is_sound && id != SKY, "{what}: {device:?} {hit:?}");
            }
        }
        let seen = seen_on(frame, mesh, &device, 16);
        let largest = match device.depth {
            DepthFormat::F32 | DepthFormat::F32Reversed => 1.0,
            DepthFormat::Unorm24 => 16_777_215.0,
            DepthFormat::Unorm16 => 65_535.0,
        };
        assert!(seen.keys().iter().all(|k| (0.0..=largest).contains(k)), "{what}: {device:?}");
    }
}

#[test]
fn no_camera_however_odd_brings_nan_into_a_buffer() {
    let rough = |at: DVec2| grid(9, at, 1.0, |i, j| f64::from((i * 5 + j * 3) as u32 % 4) / 2.0);
    for at in [DVec2::ZERO, DVec2::new(1e7, -1e7)] {
        let mesh = rough(at);
        let (x, y) = (at.x, at.y);
        let eyes = [
            ("above", [x, y - 6.0, 4.0]),
            ("inside", [x + 0.3, y + 0.2, 0.7]),
            ("below", [x, y, -10.0]),
            ("on a post", [x, y, 1.0]),
        ];
        for (what, eye) in eyes {
            for far in [f64::INFINITY, 7.0] {
                let view = viewpoint(eye, [x + 0.1, y + 3.0, 0.5], 0.1, far);
                for fov in [1.0, 60.0, 179.0] {
                    assert_sound(&ViewFrame::perspective(&view, fov, (23, 17)).unwrap(), &mesh, what);
                }
                assert_sound(&ViewFrame::orthographic(&view, 9.0, (23, 17)).unwrap(), &mesh, what);
            }
        }
    }
}

#[test]
fn a_near_plane_through_posts_cuts_the_terrain_there() {
    let mesh = grid(9, DVec2::ZERO, 1.0, |_, j| j as f64 / 4.0);
    // Level, looking north: the posts of the row y = -2 lie exactly on the near plane.
    let mut view = viewpoint([0.0, -5.0, 2.5], [0.0, 0.0, 2.5], 3.0, f64::INFINITY);
    view.up = DVec3::Z;
    let frame = ViewFrame::perspective(&view, 90.0, (64, 64)).unwrap();
    assert_sound(&frame, &mesh, "near plane through posts");
    let seen = seen_on(&frame, &mesh, &DOUBLE, 64).triangles();
    assert!(seen.iter().any(|id| *id != SKY));
    // Two triangles a cell, 16 a row: rows 0 and 1 lie before the near plane.
    assert!(seen.iter().all(|id| *id >= 32), "what lies before the near plane is not seen");
}

/// The greatest distance of plan points from the exact ones, over samples that see the same triangle, relative to depth.
fn worst_plan_point(frame: &ViewFrame, mesh: &Mesh, device: &Device) -> f64 {
    let lattice = Lattice::centres(frame, 0);
    let mut exact = Sight::new(frame, mesh, &Device::default(), lattice, 64);
    exact.see();
    let mut worst = 0.0;
    let seen = seen_on(frame, mesh, device, 64);
    let machine = drapery::visibility::Machine::new(frame, mesh, device);
    let (ids, keys) = (seen.triangles(), seen.keys());
    for (k, id) in ids.iter().enumerate().filter(|(_, id)| **id != SKY) {
        let (c, r) = (k % lattice.columns, k / lattice.columns);
        let (Some(truth), true) = (exact.hit(c, r), exact.triangle(c, r) == *id) else {
            continue;
        };
        let hit: Hit = machine.hit(lattice.at(c, r), keys[k], &mesh.surface_triangle(*id).unwrap()).unwrap();
        let off = ((hit.plan - truth.plan).length()
            + (hit.world.z - truth.world.z).abs()
            + (hit.depth - truth.depth).abs())
            / truth.depth;
        worst = if off > worst { off } else { worst };
    }
    worst
}

#[test]
fn plan_points_are_as_good_as_the_precision() {
    let mesh = grid(33, DVec2::ZERO, 30.0, |i, j| f64::from((i * 5 + j * 3) as u32 % 11) * 2.0);
    let view = viewpoint([10.0, -600.0, 350.0], [0.0, 0.0, 0.0], 1.0, f64::INFINITY);
    let frames = [
        ViewFrame::perspective(&view, 50.0, (96, 96)).unwrap(),
        ViewFrame::orthographic(&view, 700.0, (96, 96)).unwrap(),
    ];
    // The same with a plan that is turned: its points are interpolated.
    let turned = mesh.vertices().map(|vertex| {
        let Plan { x, y } = vertex.plan;
        SurfaceVertex { plan: Plan::new(0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y), ..vertex }
    });
    let triangles = (0..mesh.triangle_ids()).filter_map(|id| mesh.corners(id)).collect();
    let draped = Mesh::of_surface(turned.collect(), triangles).unwrap();
    for (frame, mesh) in frames.into_iter().flat_map(|frame| [&mesh, &draped].map(|mesh| (frame, mesh))) {
        let double = worst_plan_point(&frame, mesh, &DOUBLE);
        assert!(double < 1e-6, "double: {double}");
        let single = worst_plan_point(&frame, mesh, &device(Precision::F32, 0, DepthFormat::F32Reversed));
        assert!(single > double && single < 2e-5, "single: {single}");
    }
}

#[test]
fn single_precision_far_from_the_origin_is_off_by_what_its_spacing_explains() {
    let offset = DVec2::new(6_378_000.0, 0.0);
    let mesh = grid(33, offset, 30.0, |_, _| 0.0);
    let view = viewpoint([6_378_000.0, -600.0, 350.0], [6_378_000.0, 0.0, 0.0], 1.0, f64::INFINITY);
    let frame = ViewFrame::perspective(&view, 50.0, (96, 96)).unwrap();
    let double = worst_plan_point(&frame, &mesh, &device(Precision::F64, 8, DepthFormat::F32Reversed));
    let single = worst_plan_point(&frame, &mesh, &device(Precision::F32, 8, DepthFormat::F32Reversed));
    // A unit in the last place at 6.378e6 is half a metre, in about 1000 m of distance: off by metres, not more.
    assert!(double < 1e-3 && single > 1e-4 && single < 2e-2, "{double} {single}");
}

#[test]
fn the_default_device_is_seen_exactly_and_the_sky_is_infinitely_far() {
    let mesh = grid(9, DVec2::ZERO, 1.0, |i, _| i as f64 / 5.0);
    let view = viewpoint([0.0, -9.0, 4.0], [0.0, 0.0, 1.0], 0.1, f64::INFINITY);
    let frame = ViewFrame::perspective(&view, 60.0, (40, 30)).unwrap();
    for device in [Device::default(), device(Precision::F32, 8, DepthFormat::Unorm24)] {
        let mut sight = Sight::new(&frame, &mesh, &device, Lattice::centres(&frame, 0), 16);
        sight.see();
        let depths: Vec<_> = (0..1200).map(|k| sight.hit(k % 40, k / 40).map(|h| h.depth)).collect();
        assert!(depths.iter().any(Option::is_some) && depths.iter().any(Option::is_none));
        for (k, depth) in depths.iter().enumerate() {
            assert!(depth.is_none_or(f64::is_finite));
            assert_eq!(depth.is_none(), sight.triangles()[k] == SKY);
        }
        if device.is_exact() {
            assert_eq!(sight.triangles(), seen_exactly(&frame, &mesh).triangles());
        }
    }
}

#[test]
fn positions_relative_to_the_eye_draw_far_away_what_is_drawn_at_the_origin_and_absolute_ones_do_not() {
    // Hard case 17: the scene 6400 km from zero, on a machine of single precision, a pixel of some decimetres.
    let layer = "[[layer]]\noffset = [OX, OY]\nfeatures = [{ line = [[-40, -30], [0, 10], [45, -12]] }]\nline = { color = \"#aa0022\", width_px = 3 }\n";
    let text = |[x, y]: [f64; 2]| {
        let camera = format!("eye = [{}, {}, 35], target = [{x}, {y}, 2], near_m = 1.0", x - 12.0, y - 60.0);
        let terrain = "kind = \"fbm\", seed = 5, posts = [17, 17], cell_m = 8, height_m = 6";
        let layer = layer.replace("OX", &x.to_string()).replace("OY", &y.to_string());
        let scene = drawing::scene(terrain, &camera, &layer);
        scene.replace("color = \"#ffffff\" }", &format!("shade = \"hillshade\", offset = [{x}, {y}] }}"))
    };
    let off = |place: [f64; 2], position: &str| {
        let position = format!("device.position={position}");
        let machine = ["device.precision=f32", "device.subpixel_bits=8", &position];
        let draw = |place, changes: &[&str]| {
            drawing::frame_of(
                drapery::technique::Kind::GeometryOverlay,
                &drawing::stage(&text(place), changes),
                &[],
            )
        };
        let (here, there) =
            (draw([0.0; 2], &["device.precision=f32", "device.subpixel_bits=8"]), draw(place, &machine));
        here.image.values().iter().zip(there.image.values()).filter(|(a, b)| a != b).count()
    };
    let far = [6_378_137.0, 6_400_000.0];
    let [absolute, relative, local] = ["absolute", "relative-to-eye", "local"].map(|form| off(far, form));
    // A last bit of a few millimetres may still decide a pixel on an edge.
    assert!(local == 0 && relative < 25 && absolute > 400, "{local} {relative} {absolute}");
    assert!(off([0.0; 2], "absolute") < 5);
}
