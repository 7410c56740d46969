//! 2,000, 20,000 and 200,000 segments over 100,000 triangles at 1200 x 800, in one colour and in a hundred, each colour's segments
//! sharing a mask: the scene on which a graphics pipeline in software was timed for the README.
//!
//! `cargo bench --bench stencil_volume`

mod peers;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use drapery::scene::{Cap, Color, Diagonal, Feature, Join, Layer, Line, Shape, Style, Width};
use drapery::scene_file::SceneFile;
use drapery::space::Plan;
use drapery::stage::Stage;
use drapery::technique::stencil_volume::{Grouping, Settings};
use drapery::technique::{self, FrameOptions, Kind};
use glam::DVec2;
use peers::hills;
use std::hint::black_box;

/// Segments, their length, their width.
const ROADS: [(usize, f64, f64); 3] =
    [(2_000, 0.02, 0.004), (20_000, 0.02, 0.0015), (200_000, 0.006, 0.0005)];
/// Segments of a line.
const CHAIN: usize = 20;

/// Chains of segments that wander from random points of the unit square.
fn chains(count: usize, length: f64) -> Vec<Feature> {
    let mut state = 88_172_645_463_325_252_u64;
    let mut random = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut chain = |index| {
        let mut at = Plan::new(random(), random());
        let mut angle = random() * std::f64::consts::TAU;
        let mut points = vec![at];
        for _ in 0..CHAIN {
            angle += random() - 0.5;
            at = at + DVec2::new(drapery::math::cos(angle), drapery::math::sin(angle)) * length;
            points.push(at);
        }
        Feature { index, style: 0, shape: Shape::Line(vec![points]) }
    };
    (0..count / CHAIN).map(&mut chain).collect()
}

/// `colors` layers of equal size.
fn layers((count, length, width): (usize, f64, f64), colors: usize) -> Vec<Layer> {
    let features = chains(count, length);
    let style = |k: usize| {
        let color = Color([1.0, (k % 10) as f64 / 10.0, (k / 10) as f64 / 10.0, 1.0]);
        let line = Line { color, width: Width::Metres(width), join: Join::Bevel, cap: Cap::Butt };
        Style { line: Some(line), ..Style::default() }
    };
    let parts = features.chunks(features.len() / colors).enumerate();
    parts.map(|(k, part)| Layer::uniform(k.to_string(), style(k), part.to_vec())).collect()
}

fn stage(roads: (usize, f64, f64), colors: usize) -> Stage {
    let text = r##"
schema = 1
image = { width = 1200, height = 800, background = "#000000" }
camera = { eye = [0.5, -0.30, 0.42], target = [0.5, 0.42, 0.05], fov_y_deg = 50.0, near_m = 0.05 }
terrain = { generate = { kind = "plane", posts = [2, 2], cell_m = 1.0, height_m = 0.0 }, color = "#80997f" }
"##;
    let file = SceneFile::parse(text, None, &[]).expect("a valid scene");
    let (mut scene, _) = drapery::source::load::load(&file, &|_| {}).expect("a plane");
    scene.diagonal = Diagonal::NwSe;
    scene.layers = layers(roads, colors);
    scene.technique.set(Settings { grouping: Grouping::Color, ..Settings::default() });
    Stage::new(scene, hills(224)).expect("few triangles")
}

fn stencil_volume(c: &mut Criterion) {
    let mut group = c.benchmark_group("stencil-volume");
    group.sample_size(10);
    let options = FrameOptions { tile: 128, buffers: &[], progress: &|_| {} };
    for roads in ROADS {
        for colors in [1, 100] {
            let stage = stage(roads, colors);
            let view = stage.view().expect("a view");
            let name = format!("{} segments, {colors} colours", roads.0);
            group.bench_function(BenchmarkId::new("prepare", &name), |b| {
                b.iter(|| black_box(technique::prepare(Kind::StencilVolume, &stage).expect("metres")));
            });
            let prepared = technique::prepare(Kind::StencilVolume, &stage).expect("metres");
            group.bench_function(BenchmarkId::new("frame", &name), |b| {
                b.iter(|| black_box(prepared.frame(&view, &options).expect("no buffers")));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, stencil_volume);
criterion_main!(benches);
