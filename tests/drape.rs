//! Meshes whose vertices have plan points and an up of their own: the same pictures however the world is turned, and a cap of a sphere
//! against brute force.
#![cfg(feature = "render")]

mod drawing;

use drapery::buffer::{Plane, Values};
use drapery::compare::Image;
use drapery::math;
use drapery::raster::Lattice;
use drapery::sampling::sample;
use drapery::scene::{Camera, Color, Device, Projection, Scene, Shape, Surface, Width};
use drapery::space::{Plan, Screen, ViewFrame, World};
use drapery::stage::Stage;
use drapery::technique::inverse_projection::{self, Corners};
use drapery::technique::{self, Frame, Kind};
use drapery::terrain::{Drape, Mesh, SurfaceTriangle, SurfaceVertex};
use drapery::truth::Truth;
use drapery::visibility::{Planes, Sight};
use glam::{DQuat, DVec3};
use std::sync::Arc;

const TERRAIN: &str = r#"kind = "fbm", seed = 5, posts = [41, 37], cell_m = 31.0, height_m = 260.0"#;
const CAMERA: &str = "eye = [-213.7, -911.3, 517.1], target = [17.3, 41.9, 83.7]";

/// A lake with an island and an inset outline, a road.
const LAYERS: &str = r##"
[[layer]]
features = [{ polygon = [[[-311.3, -207.1], [287.9, -251.7], [341.1, 173.3], [-39.7, 77.1], [-227.9, 311.3]], [[-61.1, -97.3], [83.9, -121.7], [41.3, -17.9]]] }]
fill = { color = "#3388ff", opacity = 0.6 }
outline = { color = "#113355", width_m = 23.7, mode = "inset", join = "miter" }
[[layer]]
features = [{ line = [[-443.1, 51.7], [-113.9, -57.3], [43.7, 239.9], [147.1, -193.3], [451.3, 23.9]] }]
line = { color = "#ff7f00", opacity = 0.8, width_m = 37.3, join = "round", cap = "square" }
"##;

/// A line whose width is in pixels.
const TRACK: &str = r##"
[[layer]]
features = [{ line = [[-403.3, -271.1], [97.7, 3.1], [351.9, 263.3]] }]
line = { color = "#cc00cc", width_px = 2.7 }
"##;

/// A machine that snaps, keeps singles as depths, and calculates in doubles.
const MACHINE: [&str; 2] = ["device.subpixel_bits=8", "device.depth=f32-reversed"];

fn surface_of(mesh: &Mesh) -> (Vec<SurfaceVertex>, Vec<[u32; 3]>) {
    let triangles = (0..mesh.triangle_ids()).filter_map(|id| mesh.corners(id));
    (mesh.vertices().collect(), triangles.collect())
}

/// A stage over another mesh.
fn on(stage: Stage, mesh: Mesh) -> Stage {
    Stage::of_draw_list(stage.scene, stage.draw_list, Arc::new(mesh)).unwrap()
}

/// The hills, their triangles numbered along the plan.
fn hills(more: &str, changes: &[&str]) -> Stage {
    let text = drawing::scene(TERRAIN, CAMERA, more);
    let stage = drawing::stage(&text, &[&["terrain.shade=hillshade"], changes].concat());
    let (vertices, triangles) = surface_of(&stage.mesh);
    on(stage, Mesh::of_surface(vertices, triangles).unwrap())
}

/// The same stage with its world turned and shifted: terrain, camera, what is up; plan points stay.
fn turned(stage: &Stage, turn: DQuat) -> Stage {
    let shift = DVec3::new(1371.3, -2903.9, 417.1);
    let place = |p: World| World::from(turn * p.to_vec() + shift);
    let (vertices, triangles) = surface_of(&stage.mesh);
    let vertices = vertices.into_iter().map(|vertex| SurfaceVertex {
        world: place(vertex.world),
        up: (turn * vertex.up).normalize(),
        ..vertex
    });
    let mesh = Mesh::of_surface(vertices.collect(), triangles).unwrap();
    assert_eq!(mesh.drape(), Drape::Affine);
    let mut scene = stage.scene.clone();
    let camera = stage.scene.camera;
    let (eye, target, up) = (place(camera.eye), place(camera.target), turn * camera.up);
    scene.camera = Camera { eye, target, up, ..camera };
    Stage::of_draw_list(scene, stage.draw_list.clone(), Arc::new(mesh)).unwrap()
}

fn turns() -> [DQuat; 3] {
    let turn = |x, y, z, w| DQuat::from_xyzw(x, y, z, w).normalize();
    // Upside down, on its side, anyhow.
    [turn(1.0, 0.01, 0.02, 0.0), turn(0.0, 0.7, 0.0, 0.7), turn(0.31, -0.57, 0.23, 0.71)]
}

fn plane<'a>(frame: &'a Frame, name: &str) -> &'a Plane {
    frame.planes.iter().find(|plane| plane.name == name).unwrap()
}

fn doubles<'a>(frame: &'a Frame, name: &str) -> &'a [f64] {
    let Values::F64(values) = &plane(frame, name).values else { panic!("{name} holds no doubles") };
    values
}

/// The largest difference of two buffers; two infinities are equal.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let off = |(a, b): (&f64, &f64)| if a == b { 0.0 } else { (a - b).abs() };
    a.iter().zip(b).map(off).fold(0.0, |most, off| math::max(off, most))
}

fn supersampled(stage: &Stage, n: usize) -> Vec<f64> {
    sample(stage, &stage.view().unwrap(), n, &|_| {}).colors.values().as_flattened().to_vec()
}

/// The hashes of a technique's picture and buffers.
fn hashes(kind: Kind, stage: &Stage) -> Vec<String> {
    let names: Vec<&str> = kind.declaration().planes.iter().map(|plane| plane.name).collect();
    let frame = drawing::frame_of(kind, stage, &names);
    let planes = frame.planes.iter().map(|plane| format!("{} {}", plane.name, plane.hash()));
    planes.chain([frame.image.hash()]).collect()
}

#[test]
fn a_network_whose_plan_points_lie_below_it_has_the_bits_of_a_plain_one() {
    for changes in [&[][..], &MACHINE] {
        let text = drawing::scene(TERRAIN, CAMERA, LAYERS);
        let stage = drawing::stage(&text, &[&["terrain.shade=hillshade"], changes].concat());
        let points = stage.mesh.vertices().map(|vertex| vertex.world);
        let points = points.map(|p| World::new(p.x + 0.03 * p.z, p.y - 0.02 * p.z, p.z)).collect();
        let plain = Stage::new(stage.scene.clone(), Surface::Points(points)).unwrap();
        let plain = Stage::of_draw_list(plain.scene, stage.draw_list.clone(), plain.mesh).unwrap();
        let (vertices, mut triangles) = surface_of(&plain.mesh);
        triangles.reverse();
        let given = on(stage, Mesh::of_surface(vertices, triangles).unwrap());
        assert_eq!(given.mesh.drape(), Drape::Vertical);
        for kind in Kind::ALL.into_iter().filter(|kind| drapery::technique::applies(*kind, &plain).is_ok()) {
            assert_eq!(hashes(kind, &given), hashes(kind, &plain), "{kind:?}");
        }
        assert_eq!(supersampled(&given, 3), supersampled(&plain, 3));
        let (own, other) = (drawing::truth_of(&given), drawing::truth_of(&plain));
        for kind in Truth::PLANES {
            let hash = |truth: &Truth| truth.plane(kind.name).unwrap().hash();
            assert_eq!(hash(&own), hash(&other), "{}", kind.name);
        }
    }
}

#[test]
fn techniques_draw_the_same_picture_however_the_world_is_turned() {
    let still = hills(LAYERS, &[]);
    for turn in turns() {
        let moved = turned(&still, turn);
        for kind in [Kind::InverseProjection, Kind::Clipmap] {
            let names = ["triangle", "depth", "plan", "color"];
            let [a, b] = [&still, &moved].map(|stage| drawing::frame_of(kind, stage, &names));
            assert_eq!(plane(&a, "triangle").values, plane(&b, "triangle").values, "{kind:?}, {turn}");
            for (name, most) in [("depth", 1e-9), ("plan", 1e-9), ("color", 1e-10)] {
                let off = difference(doubles(&a, name), doubles(&b, name));
                assert!(off < most, "{kind:?}, {turn}, {name}: {off}");
            }
        }
        let off = difference(&supersampled(&still, 4), &supersampled(&moved, 4));
        assert!(off < 1e-9, "{turn}, supersampling: {off}");
    }
}

#[test]
fn the_truth_is_the_same_however_the_world_is_turned() {
    for changes in [&[][..], &["camera.projection=orthographic", "camera.height_m=640.3"]] {
        let still = hills(&[LAYERS, TRACK].concat(), changes);
        let truth = drawing::truth_of(&still);
        for turn in turns() {
            let moved = drawing::truth_of(&turned(&still, turn));
            assert!(truth.widest() <= 1.0 / 510.0 && moved.widest() <= 1.0 / 510.0, "{}", moved.widest());
            for (k, (low, high)) in truth.low.values().iter().zip(truth.high.values()).enumerate() {
                let (other_low, other_high) = (moved.low.values()[k], moved.high.values()[k]);
                for c in 0..4 {
                    let overlap = math::min(high[c], other_high[c]) - math::max(low[c], other_low[c]);
                    assert!(overlap >= -1e-9, "{turn}, pixel {k}, channel {c}: {overlap}");
                }
            }
            let pieces = moved.tally.pieces as f64 / truth.tally.pieces as f64;
            assert!((pieces - 1.0).abs() < 0.02, "{turn}: {pieces} times as many pieces");
            for (own, other) in truth.centres.values().iter().zip(moved.centres.values()) {
                let same = match (own, other) {
                    (Some(a), Some(b)) => a.triangle == b.triangle && (a.plan - b.plan).length() < 1e-7,
                    (None, None) => true,
                    _ => false,
                };
                assert!(same, "{turn}: {own:?} {other:?}");
            }
        }
    }
}

#[test]
fn supersampling_of_widths_in_pixels_is_the_same_however_the_world_is_turned() {
    let still = hills(TRACK, &[]);
    for turn in turns() {
        let off = difference(&supersampled(&still, 4), &supersampled(&turned(&still, turn), 4));
        assert!(off < 1e-9, "{turn}: {off}");
    }
}

#[test]
fn an_imitated_machine_interpolates_the_plan_points_that_it_would_find_by_a_matrix() {
    let still = hills(LAYERS, &["device.precision=f32"]);
    let moved = turned(&still, turns()[2]);
    let names = ["triangle", "depth", "plan"];
    let [a, b] = [&still, &moved].map(|stage| drawing::frame_of(Kind::InverseProjection, stage, &names));
    let triangles = [&a, &b].map(|frame| match &plane(frame, "triangle").values {
        Values::U32(ids) => ids.clone(),
        other => panic!("{other:?}"),
    });
    let mut compared = 0;
    for (k, depth) in doubles(&a, "depth").iter().enumerate().filter(|(_, depth)| depth.is_finite()) {
        // Rounding may give a sample beside an edge to the neighbour.
        if triangles[0][k] == triangles[1][k] {
            let off = difference(&doubles(&a, "plan")[2 * k..][..2], &doubles(&b, "plan")[2 * k..][..2]);
            assert!(off < 2e-5 * depth, "pixel {k}: {off} at {depth}");
            compared += 1;
        }
    }
    assert!(compared > 3500, "{compared}");
}

#[test]
fn a_row_of_plan_points_has_the_bits_of_its_samples() {
    let p = |x: f64, y: f64| World::new(x, y, 0.25 * y);
    let needle = vec![p(-100.0, -0.05), p(-100.0, 0.05), p(100.0, 0.0), p(0.0, 300.0), p(0.0, -300.0)];
    let mut scene = hills("", &[]).scene;
    // Near the needle's broad end: a row is a thirtieth of a metre.
    (scene.camera.eye, scene.camera.target) = (World::new(-90.0, -20.0, 40.0), World::new(-90.0, 0.0, 0.0));
    scene.camera.projection = Projection::Orthographic { height_m: 2.0 };
    let still = Stage::new(scene, drapery::scene::Surface::Points(needle)).unwrap();
    for stage in [hills("", &[]), still].iter().map(|still| turned(still, turns()[2])) {
        let view = stage.view().unwrap();
        let lattice = Lattice::corners(&view);
        let mut sight = Sight::new(&view, &stage.mesh, &Device::default(), lattice, 64);
        sight.see();
        let (mut seen, mut planes) = (0, Planes::default());
        for row in 0..lattice.rows {
            let mut points = vec![Plan::default(); lattice.columns];
            sight.plan_of_row(row, &mut points, &mut planes);
            for (column, point) in points.into_iter().enumerate() {
                let hit =
                    sight.hit(column, row).map_or(Plan::new(f64::INFINITY, f64::INFINITY), |hit| hit.plan);
                assert_eq!(point, hit, "({column}, {row})");
                seen += usize::from(point.is_finite());
            }
        }
        assert!(seen > 1000, "{seen}");
    }
}

#[test]
fn stencil_volumes_refuse_a_world_that_is_turned() {
    let still = hills(LAYERS, &[]);
    assert!(technique::applies(Kind::StencilVolume, &still).is_ok());
    let refusal = technique::applies(Kind::StencilVolume, &turned(&still, turns()[0])).unwrap_err();
    assert!(refusal.to_string().contains("vertical"), "{refusal}");
}

/// A sphere the size of the Earth, and a place on it.
mod globe {
    use super::*;

    pub const RADIUS: f64 = 6.4e6;
    /// Longitude and latitude of the middle, degrees.
    pub const MIDDLE: [f64; 2] = [11.0, 48.0];

    /// The direction of a place from the sphere's centre.
    fn direction(longitude: f64, latitude: f64) -> DVec3 {
        let (x, y) = (longitude.to_radians(), latitude.to_radians());
        DVec3::new(math::cos(y) * math::cos(x), math::cos(y) * math::sin(x), math::sin(y))
    }

    /// What is up in the middle, and the way to the north.
    pub fn up_and_north() -> (DVec3, DVec3) {
        let up = direction(MIDDLE[0], MIDDLE[1]);
        (up, (DVec3::Z - up * up.z).normalize())
    }

    /// The point of the world over a plan point: metres along the parallel and the meridian of the middle.
    pub fn surface(plan: Plan, height: f64) -> SurfaceVertex {
        let degrees = (plan.to_vec() / RADIUS).map(f64::to_degrees);
        let up = direction(MIDDLE[0] + degrees.x / math::cos(MIDDLE[1].to_radians()), MIDDLE[1] + degrees.y);
        let world = (up - up_and_north().0) * RADIUS + up * height;
        SurfaceVertex { world: World::from(world), plan, up }
    }

    /// The plan point below a point of the world, towards the sphere's centre.
    pub fn plan_below(p: World) -> Plan {
        let up = (p.to_vec() + up_and_north().0 * RADIUS).normalize();
        let latitude = math::asin(up.z) - MIDDLE[1].to_radians();
        let longitude = math::atan2(up.y, up.x) - MIDDLE[0].to_radians();
        Plan::new(longitude * math::cos(MIDDLE[1].to_radians()) * RADIUS, latitude * RADIUS)
    }

    /// n x n vertices over a square of the plan.
    pub fn cap(n: u32, half: f64, height: impl Fn(f64, f64) -> f64) -> Mesh {
        let at = |k: u32| (f64::from(k) / f64::from(n - 1) * 2.0 - 1.0) * half;
        let place = |k: u32| Plan::new(at(k % n), at(k / n));
        let vertices = (0..n * n).map(|k| surface(place(k), height(place(k).x, place(k).y)));
        let cells = (0..(n - 1) * (n - 1)).map(|k| k / (n - 1) * n + k % (n - 1));
        let triangles = cells.flat_map(|c| [[c, c + 1, c + n + 1], [c, c + n + 1, c + n]]);
        Mesh::of_surface(vertices.collect(), triangles.collect()).unwrap()
    }
}

/// A country on the sphere: a lake with an island, a road, a track as wide as some pixels; all black on white.
fn country(size: [usize; 2]) -> Scene {
    let layers = r##"
[[layer]]
features = [{ polygon = [[[-13100, -9100], [12700, -11300], [14900, 7300], [-1700, 3100], [-9700, 13700]], [[-2900, -5300], [4100, -6100], [1900, -700]]] }]
fill = { color = "#000000" }
[[layer]]
features = [{ line = [[-19300, 2100], [-4900, 9100], [1700, 14300], [19100, 11300]] }]
line = { color = "#000000", width_m = 900, join = "round", cap = "round" }
[[layer]]
features = [{ line = [[-17700, -17100], [3100, -14900], [18300, -1300]] }]
line = { color = "#000000", width_px = 1.7 }
"##;
    let plane = r#"kind = "plane", posts = [2, 2], cell_m = 60000.0"#;
    let text = drawing::scene(plane, "eye = [0, -10, 9], target = [0, 0, 0]", layers);
    let changes = [format!("image.width={}", size[0]), format!("image.height={}", size[1])];
    let (mut scene, _) = drawing::loaded(&text, &changes.each_ref().map(String::as_str));
    scene.image.background = Color([1.0; 4]);
    let (up, north) = globe::up_and_north();
    scene.camera.eye = World::from(up * 17_000.0 - north * 31_000.0);
    scene.camera.target = World::from(north * 2000.0);
    scene.camera.up = up;
    scene
}

/// Over hills of the sphere.
fn on_hills(scene: Scene) -> Stage {
    let hills = |x: f64, y: f64| 700.0 * math::sin(x / 4100.0) * math::cos(y / 5300.0);
    Stage::of_mesh(scene, globe::cap(17, 22_000.0, hills)).unwrap()
}

mod brute_force {
    //! Every ray against every triangle, in plain doubles.

    use super::*;

    /// Where a ray meets a triangle: the view depth, the point, its plan point.
    fn meet(view: &ViewFrame, at: Screen, triangle: &SurfaceTriangle) -> Option<(f64, World, Plan)> {
        let ray = view.ray(at);
        let along = (ray.through - ray.from) / view.reach();
        let ([a, b, c], [p, q, r]) = (triangle.world, triangle.plan());
        let (u, v, s) = (b - a, c - a, ray.from - a);
        let whole = along.dot(u.cross(v));
        let (of_b, of_c) = (along.dot(s.cross(v)) / whole, along.dot(u.cross(s)) / whole);
        let depth = -s.dot(u.cross(v)) / whole;
        let is_met = of_b >= 0.0 && of_c >= 0.0 && of_b + of_c <= 1.0 && depth >= view.near();
        is_met.then(|| (depth, ray.from + along * depth, p + ((q - p) * of_b + (r - p) * of_c)))
    }

    fn is_inside(rings: &[Vec<Plan>], p: Plan) -> bool {
        let sides = rings.iter().flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)));
        let crossed = sides.filter(|(a, b)| {
            (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
        });
        crossed.count() % 2 == 1
    }

    fn distance(line: &[Plan], p: Plan) -> f64 {
        let to = |pair: &[Plan]| {
            let (d, v) = (pair[1] - pair[0], p - pair[0]);
            (v - d * (v.dot(d) / d.length_squared()).clamp(0.0, 1.0)).length()
        };
        line.windows(2).map(to).fold(f64::INFINITY, |least, d| math::min(d, least))
    }

    /// Whether a point of the screen is black.
    fn is_black(scene: &Scene, triangles: &[SurfaceTriangle], view: &ViewFrame, at: Screen) -> bool {
        let met = triangles.iter().filter_map(|triangle| meet(view, at, triangle));
        let Some((_, world, plan)) = met.min_by(|a, b| a.0.total_cmp(&b.0)) else { return false };
        scene.layers.iter().any(|layer| match &layer.features[0].shape {
            Shape::Polygon(rings) => is_inside(rings, plan),
            Shape::Points(_) => false,
            Shape::MultiPolygon(members) | Shape::Swath { members, .. } => {
                members.iter().any(|rings| is_inside(rings, plan))
            }
            Shape::Line(lines) => {
                let width = match layer.styles[0].line.unwrap().width {
                    Width::Metres(width) => width,
                    Width::Pixels(width) => width * view.pixel_m(world),
                };
                distance(&lines[0], plan) <= width / 2.0
            }
        })
    }

    /// The white share of a pixel by n x n jittered samples.
    fn white(
        scene: &Scene,
        triangles: &[SurfaceTriangle],
        (x, y): (usize, usize),
        n: u32,
        dice: &mut u32,
    ) -> f64 {
        let view = scene.camera.view(&scene.image).unwrap();
        let mut next = || {
            *dice = dice.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(*dice >> 8) / f64::from(1 << 24)
        };
        let place = |cell: u32, within: f64| (f64::from(cell) + within) / f64::from(n);
        let black = (0..n * n)
            .map(|k| Screen::new(x as f64 + place(k % n, next()), y as f64 + place(k / n, next())))
            .filter(|at| is_black(scene, triangles, &view, *at));
        1.0 - black.count() as f64 / f64::from(n * n)
    }

    #[test]
    fn samples_of_a_cap_of_a_sphere_agree_with_the_truth_as_far_as_chance_allows() {
        const N: u32 = 16;
        let scene = country([36, 24]);
        let stage = on_hills(scene.clone());
        let truth = drawing::truth_of(&stage);
        assert!(truth.widest() <= 1.0 / 510.0, "{}", truth.widest());
        let mesh = &stage.mesh;
        let triangles: Vec<_> = (0..mesh.triangle_ids()).filter_map(|id| mesh.surface_triangle(id)).collect();
        let (mut dice, mut signed, mut square, mut black) = (7, 0.0, 0.0, 0.0);
        for k in 0..36 * 24 {
            let at = (k % 36, k / 36);
            let white = white(&scene, &triangles, at, N, &mut dice);
            let (low, high) = (truth.low.at(at.0, at.1)[0], truth.high.at(at.0, at.1)[0]);
            let off = math::max(white - high, 0.0) - math::max(low - white, 0.0);
            // Hoeffding: 256 independent samples of 0..=1 stray by more than this once in 10^8 pixels.
            assert!(off.abs() < 0.19, "pixel {at:?}: {white} is not in [{low}, {high}]");
            (signed, square, black) = (signed + off, square + off * off, black + 1.0 - white);
        }
        let pixels = 36.0 * 24.0;
        assert!((square / pixels).sqrt() < 0.5 / f64::from(N), "{}", (square / pixels).sqrt());
        assert!((signed / pixels).abs() < 0.003, "{}", signed / pixels);
        assert!(black > 0.15 * pixels && black < 0.6 * pixels, "{black} pixels of black");
    }
}

#[test]
fn on_a_cap_of_a_sphere_more_samples_come_nearer_to_the_truth_and_techniques_near_it() {
    let mut scene = country([96, 64]);
    let stage = on_hills(scene.clone());
    let rmse = |stage: &Stage, colors: Vec<f64>| {
        drawing::errors(&drawing::truth_of(stage), &Image::new(96, 64, 4, colors).unwrap()).rmse
    };
    let [one, four, sixteen] = [1, 4, 16].map(|n| rmse(&stage, supersampled(&stage, n)));
    assert!(one > 0.02 && four < 0.3 * one && sixteen < 0.2 * four, "{one} {four} {sixteen}");
    // Widths in pixels are none of inverse projection's, and the paper's quadrilateral is shifted.
    scene.layers.pop();
    let settings = inverse_projection::Settings { corners: Corners::True, samples: 5, ..Default::default() };
    scene.technique.set(settings);
    let stage = on_hills(scene);
    for (kind, most) in [(Kind::InverseProjection, 0.03), (Kind::Clipmap, 0.03)] {
        let frame = drawing::frame_of(kind, &stage, &["color"]);
        let rmse = rmse(&stage, doubles(&frame, "color").to_vec());
        assert!(rmse < most, "{kind:?}: {rmse}");
    }
}

#[test]
fn smaller_triangles_deviate_less_from_the_map_along_the_normal() {
    let deviation = |n| {
        globe::cap(n, 20_000.0, |_, _| 0.0).largest_deviation(|at, p| (globe::plan_below(at) - p).length())
    };
    let (coarse, fine) = (deviation(11), deviation(21));
    // Half the size, a quarter of the deviation: 4 km are off by about 4 km * 4 km / 9 / 6400 km times the tangent of the latitude.
    assert!(coarse > 0.1 && coarse < 2.0, "{coarse}");
    assert!((coarse / fine - 4.0).abs() < 0.2, "{coarse} {fine}");
    let place = Plan::new(3000.0, -7000.0);
    assert!((globe::plan_below(globe::surface(place, 500.0).world) - place).length() < 1e-6);
    assert!(hills(LAYERS, &[]).mesh.largest_deviation(|at, p| (at.plan() - p).length()) < 1e-9);
}
