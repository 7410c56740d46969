//! The stencil's count against the footprint in rational arithmetic, sample by sample.

use super::extrusion::{Extrusion, Object, Volume};
use crate::buffer::Values;
use crate::scene::{
    Cap, Color, Feature, Fill, Join, Layer, Line, Outline, OutlineMode, Projection, Rule, Shape, Style,
    Surface, Width,
};
use crate::scene_file::SceneFile;
use crate::space::{Plan, Ray, World};
use crate::stage::Stage;
use crate::technique::stencil_volume::{Counting, Settings, VolumeJoins};
use crate::technique::{self, FrameOptions, Kind};
use crate::terrain::SKY;
use dashu::rational::RBig;
use proptest::prelude::*;

fn rational(v: f64) -> RBig {
    RBig::try_from(v).unwrap()
}

/// Where a ray meets a triangle's plane, exactly.
fn hit(ray: &Ray, t: &[World; 3]) -> [RBig; 2] {
    let v = |p: World, q: World| {
        [p.x, p.y, p.z].into_iter().zip([q.x, q.y, q.z]).map(|(a, b)| rational(a) - rational(b))
    };
    let vector = |p, q| v(p, q).collect::<Vec<RBig>>();
    let (u, w, s, d) =
        (vector(t[1], t[0]), vector(t[2], t[0]), vector(t[0], ray.from), vector(ray.through, ray.from));
    let minor = |i: usize, j: usize| &u[i] * &w[j] - &u[j] * &w[i];
    let normal = [minor(1, 2), minor(2, 0), minor(0, 1)];
    let dot = |a: &[RBig]| &a[0] * &normal[0] + &a[1] * &normal[1] + &a[2] * &normal[2];
    let at = dot(&s) / dot(&d);
    [rational(ray.from.x) + &d[0] * &at, rational(ray.from.y) + &d[1] * &at]
}

/// How often rings turn around a point that is moved a little east and a still smaller step north.
fn winding<'a>(rings: impl Iterator<Item = &'a [Plan]>, [x, y]: &[RBig; 2]) -> i32 {
    let mut turns = 0;
    for ring in rings {
        for (k, a) in ring.iter().enumerate() {
            let b = ring[(k + 1) % ring.len()];
            let is_above = |p: Plan| rational(p.y) > *y;
            if is_above(*a) == is_above(b) {
                continue;
            }
            let (ax, ay) = (rational(a.x), rational(a.y));
            let side = (rational(b.x) - &ax) * (y - &ay) - (rational(b.y) - &ay) * (x - &ax);
            // On the line: east of it, that is right of an edge that runs up.
            if is_above(b) && side > RBig::ZERO {
                turns += 1;
            } else if is_above(*a) && side < RBig::ZERO {
                turns -= 1;
            }
        }
    }
    turns
}

/// The count that a sample should have: the sum of the windings of the volumes.
fn expected(extrusion: &Extrusion, volumes: &[Volume], at: &[RBig; 2]) -> i32 {
    volumes.iter().filter(|v| v.high > v.low).map(|v| winding(extrusion.rings_of(v), at)).sum()
}

/// The stencil plane of one object, drawn with these parameters.
fn stencil(
    stage: &mut Stage,
    settings: Settings,
    buffers: &[&str],
) -> (Vec<u16>, crate::buffer::Buffer<[u8; 4]>) {
    stage.scene.technique.set(settings);
    let buffers: Vec<String> = buffers.iter().map(|b| (*b).to_owned()).collect();
    let prepared = technique::prepare(Kind::StencilVolume, stage).unwrap();
    let frame = prepared
        .frame(&stage.view().unwrap(), &FrameOptions { tile: 40, buffers: &buffers, progress: &|_| {} })
        .unwrap();
    let plane = frame.planes.iter().find(|p| p.name == "stencil").unwrap();
    let Values::U16(values) = &plane.values else { panic!("counts are 16 bits") };
    (values.clone(), frame.image)
}

/// The counts that all samples should have of each object, in as many bits as it is counted in.
fn expected_of_objects(stage: &Stage, settings: &Settings, points: &[Option<[RBig; 2]>]) -> Vec<Vec<u16>> {
    let extrusion = Extrusion::new(&stage.draw_list, (&stage.mesh, true), settings);
    let of_object = |(number, object): (u32, &Object)| {
        let volumes = &extrusion.volumes[object.volumes.start as usize..object.volumes.end as usize];
        let bits = if extrusion.cut_of(number).is_some() { 0x7fff } else { 0xffff };
        let count = |at: &[RBig; 2]| (expected(&extrusion, volumes, at) & bits) as u16;
        points.iter().map(|point| point.as_ref().map_or(0, count)).collect()
    };
    (0..).zip(&extrusion.objects).map(of_object).collect()
}

/// Compares the counts of all objects with the footprints; returns how many samples lie in one.
fn check(stage: &mut Stage, settings: Settings) -> usize {
    stage.scene.device.stencil_bits = 16;
    let n = f64::from(settings.samples);
    let ids = {
        stage.scene.technique.set(settings);
        let prepared = technique::prepare(Kind::StencilVolume, stage).unwrap();
        let wanted = ["triangle".to_owned()];
        let frame = prepared
            .frame(&stage.view().unwrap(), &FrameOptions { tile: 64, buffers: &wanted, progress: &|_| {} })
            .unwrap();
        match &frame.planes[0].values {
            Values::U32(ids) => ids.clone(),
            other => panic!("{other:?}"),
        }
    };
    let view = stage.view().unwrap();
    let columns = view.width() * settings.samples as usize;
    let points: Vec<Option<[RBig; 2]>> = ids
        .iter()
        .enumerate()
        .map(|(k, id)| {
            let (c, r) = ((k % columns) as f64, (k / columns) as f64);
            let ray = view.ray(crate::space::Screen::new((c + 0.5) / n, (r + 0.5) / n));
            (*id != SKY).then(|| hit(&ray, &stage.mesh.triangle(*id).unwrap()))
        })
        .collect();
    let counts = expected_of_objects(stage, &settings, &points);
    let mut inside = 0;
    for (number, counts) in counts.into_iter().enumerate() {
        let settings = Settings { object: Some(number as u32), ..settings };
        let (in_passing, picture) = stencil(stage, settings, &["stencil"]);
        let (in_full, full_picture) = stencil(stage, settings, &["stencil", "overdraw"]);
        assert_eq!(picture, full_picture, "the picture does not depend on the way");
        for (k, right) in counts.into_iter().enumerate() {
            let at = (k % columns, k / columns);
            assert_eq!(in_passing[k], right, "object {number}, sample {at:?}, in passing");
            assert_eq!(in_full[k], right, "object {number}, sample {at:?}, in full");
            inside += usize::from(right != 0);
        }
    }
    inside
}

#[derive(Debug, Clone)]
struct Setting {
    text: String,
    layers: Vec<Layer>,
    projection: Projection,
    settings: Settings,
    ground: GroundKind,
}

/// What becomes of the terrain's posts.
#[derive(Debug, Clone, Copy, PartialEq)]
enum GroundKind {
    /// A grid.
    Grid,
    /// A grid with a hole in it.
    Holed,
    /// Scattered points.
    Scattered,
}

/// Coordinates on a coarse lattice, so that edges meet samples and posts, or anywhere.
fn coordinate(reach: i32) -> impl Strategy<Value = f64> {
    prop_oneof![
        (-reach..=reach).prop_map(|v| f64::from(v) / 2.0),
        (-f64::from(reach)..f64::from(reach)).prop_map(|v| v / 2.0)
    ]
}

fn ring() -> impl Strategy<Value = Vec<Plan>> {
    prop::collection::vec((coordinate(30), coordinate(30)), 3..8)
        .prop_map(|points| points.into_iter().map(|(x, y)| Plan::new(x, y)).collect())
}

fn stroke() -> impl Strategy<Value = Line> {
    let join = prop_oneof![Just(Join::Round), Just(Join::Bevel), Just(Join::Miter { limit: 4.0 })];
    let cap = prop_oneof![Just(Cap::Butt), Just(Cap::Square), Just(Cap::Round)];
    (prop_oneof![Just(1.0), 0.1..6.0], join, cap).prop_map(|(width, join, cap)| Line {
        color: Color([0.0, 0.0, 0.0, 0.5]),
        width: Width::Metres(width),
        join,
        cap,
    })
}

fn layers() -> impl Strategy<Value = Vec<Layer>> {
    let mode = prop_oneof![Just(OutlineMode::Normal), Just(OutlineMode::Inset), Just(OutlineMode::Offset)];
    let rule = prop_oneof![Just(Rule::EvenOdd), Just(Rule::NonZero)];
    let polygon = (prop::collection::vec(ring(), 1..3), rule, stroke(), mode);
    let line = (prop::collection::vec((coordinate(30), coordinate(30)), 2..6), stroke());
    (polygon, line).prop_map(|((rings, rule, outline, mode), (points, line))| {
        let style = Style {
            fill: Some(Fill { color: Color([1.0, 0.0, 0.0, 0.5]), rule }),
            outline: Some(Outline { line: outline, mode }),
            line: Some(line),
            ..Style::default()
        };
        let points = points.into_iter().map(|(x, y)| Plan::new(x, y)).collect();
        let shapes = [Shape::Polygon(rings), Shape::Line(vec![points])];
        let features =
            shapes.into_iter().enumerate().map(|(index, shape)| Feature { index, style: 0, shape }).collect();
        vec![Layer::uniform("all", style, features)]
    })
}

fn setting() -> impl Strategy<Value = Setting> {
    let terrain = prop_oneof![
        Just(r#"kind = "plane", posts = [9, 9], cell_m = 4.0, height_m = 2.0"#),
        Just(r#"kind = "ramp", slope_deg = 45.0, posts = [9, 9], cell_m = 4.0, height_m = 0.0"#),
        Just(r#"kind = "tent", posts = [9, 9], cell_m = 4.0, height_m = 12.0"#),
        Just(r#"kind = "fbm", seed = 5, posts = [17, 17], cell_m = 2.0, height_m = 20.0"#),
    ];
    let eye = prop_oneof![
        Just((0.0, 0.0, 40.0)),
        (coordinate(30), coordinate(30), 3.0..40.0),
        (coordinate(10), coordinate(10), -5.0..15.0),
    ];
    let lens = prop_oneof![
        Just(Projection::Perspective { fov_y_deg: 60.0 }),
        Just(Projection::Perspective { fov_y_deg: 120.0 }),
        Just(Projection::Orthographic { height_m: 16.0 }),
        Just(Projection::Orthographic { height_m: 12.5 }),
    ];
    let method = prop_oneof![3 => Just(Counting::Automatic), 1 => Just(Counting::ZFail)];
    let joins = prop_oneof![Just(VolumeJoins::None), Just(VolumeJoins::Style)];
    let ground = prop_oneof![Just(GroundKind::Grid), Just(GroundKind::Holed), Just(GroundKind::Scattered)];
    let target = (coordinate(16), coordinate(16), ground);
    let near = prop_oneof![Just(0.01), Just(1.0), Just(6.0)];
    (terrain, eye, lens, layers(), (method, joins, 1..3u32), target, near).prop_map(
        |(terrain, eye, projection, layers, (method, joins, samples), target, near)| {
            let is_nadir = eye == (0.0, 0.0, 40.0);
            let (x, y, ground) = target;
            let target = if is_nadir { (0.0, 0.0) } else { (x, y) };
            let up = if is_nadir { "[0, 1, 0]" } else { "[0, 0, 1]" };
            let text = format!(
                "schema = 1\nimage = {{ width = 20, height = 16 }}\nterrain.generate = {{ {terrain} }}\n\
                 [camera]\neye = [{:?}, {:?}, {:?}]\ntarget = [{:?}, {:?}, 1.0]\nup = {up}\nnear_m = {near:?}\n",
                eye.0, eye.1, eye.2, target.0, target.1
            );
            let settings = Settings { method, joins, samples, ..Settings::default() };
            Setting { text, layers, projection, settings, ground }
        },
    )
}

/// `None`: the camera has no view (it looks along its own up).
fn stage(setting: &Setting) -> Option<Stage> {
    let file = SceneFile::parse(&setting.text, None, &[]).unwrap_or_else(|e| panic!("{e}"));
    let (mut scene, surface): (_, Surface) = crate::source::load::load(&file, &|_| {}).ok()?;
    scene.layers = setting.layers.clone();
    scene.camera.projection = setting.projection;
    let surface = match (surface, setting.ground) {
        (Surface::Grid(mut posts), GroundKind::Holed) => {
            let middle = posts.heights().len() / 2 + 1;
            posts.heights_mut()[middle] = f64::NAN;
            Surface::Grid(posts)
        }
        (Surface::Grid(posts), GroundKind::Scattered) => {
            let count = posts.columns() * posts.rows();
            let at = |k: usize| posts.world(k % posts.columns(), k / posts.columns());
            Surface::Points((0..count).filter(|k| k % 3 != 1).map(at).collect())
        }
        (surface, _) => surface,
    };
    Stage::new(scene, surface).ok().filter(|stage| stage.view().is_ok())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]
    #[test]
    fn the_count_of_every_sample_is_the_winding_of_the_footprint_around_it(setting in setting()) {
        if let Some(mut stage) = stage(&setting) {
            check(&mut stage, setting.settings);
        }
    }
}

/// A stage of filled polygons.
fn fixed(text: &str, polygons: Vec<Vec<Vec<Plan>>>) -> Stage {
    let fill = Fill { color: Color([1.0, 0.0, 0.0, 1.0]), rule: Rule::EvenOdd };
    let style = Style { fill: Some(fill), ..Style::default() };
    let shapes = polygons.into_iter().map(Shape::Polygon);
    let features = shapes.enumerate().map(|(index, shape)| Feature { index, style: 0, shape }).collect();
    let layer = Layer::uniform("polygons", style, features);
    let setting = Setting {
        text: text.into(),
        layers: vec![layer],
        projection: Projection::Perspective { fov_y_deg: 60.0 },
        settings: Settings::default(),
        ground: GroundKind::Grid,
    };
    stage(&setting).unwrap()
}

const HILL: &str = "schema = 1\nimage = { width = 48, height = 32 }\n\
    terrain.generate = { kind = \"fbm\", seed = 2, posts = [33, 33], cell_m = 4.0, height_m = 40.0 }\n\
    [camera]\neye = [0.0, -90.0, 60.0]\ntarget = [0.0, 0.0, 10.0]\n";

#[test]
fn a_concave_ring_with_a_hole_and_an_island_is_counted_by_its_fan() {
    let outer = vec![(-40.0, -40.0), (40.0, -40.0), (40.0, 40.0), (0.0, -10.0), (-40.0, 40.0)];
    let hole = vec![(-10.0, -35.0), (10.0, -35.0), (10.0, -15.0), (-10.0, -15.0)];
    let island = vec![(-4.0, -30.0), (4.0, -30.0), (0.0, -20.0)];
    let ring = |points: Vec<(f64, f64)>| points.into_iter().map(|(x, y)| Plan::new(x, y)).collect();
    let mut stage = fixed(HILL, vec![[outer, hole, island].map(ring).to_vec()]);
    assert!(check(&mut stage, Settings::default()) > 100);
}

#[test]
fn samples_on_corners_and_edges_of_neighbours_have_one_owner() {
    // Hard case 31: straight down, a metre a pixel, so that samples lie on half metres, as all corners do.
    let text = "schema = 1\nimage = { width = 20, height = 16 }\n\
        terrain.generate = { kind = \"plane\", posts = [9, 9], cell_m = 4.0, height_m = 2.0 }\n\
        [camera]\neye = [0, 0, 40]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\n";
    let half = |v: usize| -7.5 + 3.0 * v as f64;
    let mut triangles = Vec::new();
    for cell in 0..25 {
        let (x0, y0) = (half(cell % 5), half(cell / 5));
        let (x1, y1) = (half(cell % 5 + 1), half(cell / 5 + 1));
        let corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)].map(|(x, y)| Plan::new(x, y));
        let halves = [[0, 1, 2], [0, 2, 3]];
        for triangle in halves {
            triangles.push(vec![triangle.map(|k| corners[k]).to_vec()]);
        }
    }
    let mut stage = fixed(text, triangles);
    for projection in
        [Projection::Orthographic { height_m: 16.0 }, Projection::Perspective { fov_y_deg: 23.792_845 }]
    {
        stage.scene.camera.projection = projection;
        let inside = check(&mut stage, Settings::default());
        if matches!(projection, Projection::Orthographic { .. }) {
            assert_eq!(inside, 15 * 15, "each sample of the squares has one owner");
        }
    }
}
