//! The truth beside plain supersampling of n x n samples a pixel, in one run: about 2,000 vertices and a million segments on the
//! same hills, 300 x 200 pixels. (`drapery report` draws the whole curve, up to 64 x 64 samples.)
//!
//! `cargo bench --bench truth` also tells, for each, the error: for the truth half its widest and its mean interval, for n x n
//! samples how far they are out of the truth's intervals, at most and on average. The README has the figures.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use drapery::compare::Difference;
use drapery::measure;
use drapery::sampling::sample;
use drapery::scene_file::SceneFile;
use drapery::stage::Stage;
use drapery::truth::{Budget, Truth, certify};
use std::hint::black_box;

fn stage(segments: usize) -> Stage {
    let text = format!(
        r##"
schema = 1
name = "segments"
[image]
width = 300
height = 200
[terrain]
generate = {{ kind = "fbm", seed = 3, posts = [225, 225], cell_m = 60.0, height_m = 1600.0 }}
shade = "hillshade"
[[layer]]
name = "roads"
generate = {{ kind = "roads", seed = 5, count = {segments}, segment_m = 12.0 }}
line = {{ color = "#ff7f00", width_m = 4.0, join = "miter" }}
"##
    );
    let file = SceneFile::parse(&text, None, &[]).expect("a valid scene");
    let (scene, surface) = drapery::source::load::load(&file, &|_| {}).expect("generated data");
    Stage::new(scene, surface).expect("a mesh")
}

fn certified(stage: &Stage) -> Truth {
    certify(stage, &stage.view().expect("a view"), &Budget::default(), &|_| {})
}

/// Largest and mean error of n x n samples, as distances out of the truth's intervals.
fn errors(stage: &Stage, truth: &Truth, n: usize) -> (f64, f64) {
    let sampled = sample(stage, &stage.view().expect("a view"), n, &|_| {});
    let image = measure::image(&sampled.colors).expect("pixels");
    let expected = measure::expected(truth).expect("bounds in order");
    let metrics = Difference::of(&expected, &image).expect("one size").metrics(0.0);
    (metrics.max, metrics.mean)
}

fn truth(c: &mut Criterion) {
    let mut group = c.benchmark_group("truth");
    group.sample_size(10);
    for segments in [1_000, 1_000_000] {
        let stage = stage(segments);
        let truth = certified(&stage);
        let mean = measure::half_widths(&truth).expect("pixels");
        let mean = mean.values().sum::<f64>() / mean.values().len() as f64;
        #[allow(clippy::print_stderr, reason = "a bench's figures are for people")]
        {
            eprintln!(
                "{segments} segments: truth, half widths: at most {:.6}, mean {mean:.8}",
                truth.widest() / 2.0
            );
        }
        group.bench_function(BenchmarkId::new("certified", segments), |b| {
            b.iter(|| black_box(certified(&stage)));
        });
        for n in [1, 4, 16] {
            let (max, mean) = errors(&stage, &truth, n);
            #[allow(clippy::print_stderr, reason = "a bench's figures are for people")]
            {
                eprintln!("{segments} segments: {n} x {n} samples: off by at most {max:.6}, mean {mean:.8}");
            }
            group.bench_function(BenchmarkId::new(format!("{n}x{n}"), segments), |b| {
                b.iter(|| black_box(sample(&stage, &stage.view().expect("a view"), n, &|_| {})));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, truth);
criterion_main!(benches);
