//! She's experiment (1200 x 800 pixels, 3,048 triangles, about 2,000 expanded vertices, 5 x 5 samples a P pixel) and the same
//! with up to 1.25 million segments; beside it the plain way, 5 x 5 samples in every pixel, in the same run.
//!
//! `cargo bench --bench inverse_projection`

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use drapery::scene::file::SceneFile;
use drapery::technique::{self, FrameOptions, Kind, Stage};
use std::hint::black_box;

fn stage(segments: usize) -> Stage {
    // 40 x 40 posts make 3,042 triangles.
    let text = format!(
        r##"
schema = 1
name = "she"
[image]
width = 1200
height = 800
[camera]
eye = [0.0, -900.0, 620.0]
target = [0.0, -60.0, 60.0]
[terrain]
generate = {{ kind = "fbm", seed = 3, posts = [40, 40], cell_m = 30.0, height_m = 160.0 }}
[[layer]]
name = "roads"
generate = {{ kind = "roads", seed = 5, count = {segments} }}
line = {{ color = "#ff7f00", width_m = {width} }}
"##,
        width = if segments > 10_000 { 0.2 } else { 5.0 },
    );
    let file = SceneFile::parse(&text, None, &[]).expect("a valid scene");
    let (scene, surface) = drapery::source::load::load(&file, &|_| {}).expect("generated data");
    Stage::new(scene, surface).expect("a mesh")
}

fn inverse_projection(c: &mut Criterion) {
    let mut group = c.benchmark_group("inverse-projection");
    group.sample_size(10);
    for segments in [1_000, 10_000, 100_000, 1_250_000] {
        let mut stage = stage(segments);
        stage.scene.technique.inverse_projection.samples = 5;
        group.bench_function(BenchmarkId::new("prepare", segments), |b| {
            b.iter(|| {
                black_box(technique::prepare(Kind::InverseProjection, &stage).expect("widths in metres"))
            });
        });
        let prepared = technique::prepare(Kind::InverseProjection, &stage).expect("widths in metres");
        let options = FrameOptions { tile: 128, buffers: &[], progress: &|_| {} };
        group.bench_function(BenchmarkId::new("frame", segments), |b| {
            b.iter(|| black_box(prepared.frame(&options).expect("no buffers")));
        });
    }
    group.finish();
}

criterion_group!(benches, inverse_projection);
criterion_main!(benches);
