//! She's experiment (1200 x 800 pixels, 3,048 triangles, about 2,000 expanded vertices, 5 x 5 samples a P pixel) and the same
//! with up to 1.25 million segments on a terrain that grows with them, at last so long that lines are everywhere.
//!
//! `cargo bench --bench inverse_projection`

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use drapery::scene_file::SceneFile;
use drapery::stage::Stage;
use drapery::technique::inverse_projection::Settings;
use drapery::technique::{self, FrameOptions, Kind};
use std::hint::black_box;

/// Terrain of 30 m cells and roads of 5 m, as dense for any number of segments, seen from 900 m above its middle: what is seen stays
/// about the same while what there is grows a thousandfold, as long as segments are 10 m long.
fn stage(segments: usize, length_m: f64) -> Stage {
    // 40 x 40 posts make 3,042 triangles; 1,000 segments about 2,000 expanded vertices.
    let posts = (40.0 * (segments as f64 / 1000.0).sqrt()) as usize;
    let text = format!(
        r##"
schema = 1
name = "she"
[image]
width = 1200
height = 800
[camera]
eye = [0.0, -250.0, 900.0]
target = [0.0, 0.0, 60.0]
[terrain]
generate = {{ kind = "fbm", seed = 3, posts = [{posts}, {posts}], cell_m = 30.0, height_m = 160.0 }}
[[layer]]
name = "roads"
generate = {{ kind = "roads", seed = 5, count = {segments}, segment_m = {length_m:.1} }}
line = {{ color = "#ff7f00", width_m = 5.0 }}
"##
    );
    let file = SceneFile::parse(&text, None, &[]).expect("a valid scene");
    let (scene, surface) = drapery::source::load::load(&file, &|_| {}).expect("generated data");
    Stage::new(scene, surface).expect("a mesh")
}

fn inverse_projection(c: &mut Criterion) {
    let mut group = c.benchmark_group("inverse-projection");
    group.sample_size(10);
    let data = [(1_000, 10.0), (10_000, 10.0), (100_000, 10.0), (1_250_000, 10.0), (1_250_000, 170.0)];
    for (segments, length_m) in data {
        let mut stage = stage(segments, length_m);
        let name = format!("{segments} of {length_m} m");
        stage.scene.technique.set(Settings { samples: 5, ..Settings::default() });
        group.bench_function(BenchmarkId::new("prepare", &name), |b| {
            b.iter(|| {
                black_box(technique::prepare(Kind::InverseProjection, &stage).expect("widths in metres"))
            });
        });
        let prepared = technique::prepare(Kind::InverseProjection, &stage).expect("widths in metres");
        let view = stage.view().expect("a view");
        let options = FrameOptions { tile: 128, buffers: &[], progress: &|_| {} };
        group.bench_function(BenchmarkId::new("frame", &name), |b| {
            b.iter(|| black_box(prepared.frame(&view, &options).expect("no buffers")));
        });
    }
    group.finish();
}

criterion_group!(benches, inverse_projection);
criterion_main!(benches);
