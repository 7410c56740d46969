//! Depth and triangle of each sample of a 1920 x 1080 picture, over terrains of 3 thousand to 8 million triangles, beside a
//! plain depth buffer (every triangle, double precision, one thread) in the same run.
//!
//! `cargo bench --bench visibility`; the README has the figures, and those of other programs.

mod peers;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use drapery::raster::Lattice;
use drapery::scene::Diagonal;
use drapery::space::{Screen, ViewFrame, Viewpoint, World};
use drapery::terrain::{Mesh, SKY};
use drapery::visibility::Visible;
use glam::DVec3;
use peers::hills;
use std::hint::black_box;

/// Posts a side and what they make.
const TERRAINS: [(usize, &str); 4] = [(40, "3k"), (224, "100k"), (1001, "2M"), (2001, "8M")];

fn terrain(n: usize) -> Mesh {
    Mesh::new(hills(n), Diagonal::NwSe).expect("few triangles")
}

fn view(target: World) -> ViewFrame {
    let eye = World::new(0.5, -0.30, 0.42);
    let view = Viewpoint { eye, target, up: DVec3::Z, near: 0.05, far: f64::INFINITY };
    ViewFrame::perspective(&view, 50.0, (1920, 1080)).expect("a camera that sees")
}

/// The plain way: each triangle in its bounding box, nearest wins, no hierarchy, no exactness.
fn plain(frame: &ViewFrame, mesh: &Mesh) -> Vec<u32> {
    let (width, height) = (frame.width(), frame.height());
    let mut nearest = vec![(f64::INFINITY, SKY); width * height];
    for id in 0..mesh.triangle_ids() {
        let Some(corners) = mesh.triangle(id) else { continue };
        let points = corners.map(|c| frame.screen_from_world(c).map(|s| (s, frame.depth(c))));
        let [Some(a), Some(b), Some(c)] = points else { continue };
        plain_triangle(&mut nearest, (width, height), id, [a, b, c]);
    }
    nearest.into_iter().map(|(_, id)| id).collect()
}

fn plain_triangle(nearest: &mut [(f64, u32)], size: (usize, usize), id: u32, [a, b, c]: [(Screen, f64); 3]) {
    let ordered = |p: f64, q: f64, r: f64| {
        let mut v = [p, q, r];
        v.sort_by(f64::total_cmp);
        (v[0], v[2])
    };
    let ((x0, x1), (y0, y1)) = (ordered(a.0.x, b.0.x, c.0.x), ordered(a.0.y, b.0.y, c.0.y));
    let edge = |p: Screen, q: Screen, x: f64, y: f64| (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
    let area = edge(a.0, b.0, c.0.x, c.0.y);
    for row in (y0 - 0.5).ceil() as usize..((y1 + 0.5) as usize).min(size.1) {
        for column in (x0 - 0.5).ceil() as usize..((x1 + 0.5) as usize).min(size.0) {
            let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
            let [e, f, g] =
                [edge(b.0, c.0, x, y), edge(c.0, a.0, x, y), edge(a.0, b.0, x, y)].map(|e| e / area);
            let depth = 1.0 / (e / a.1 + f / b.1 + g / c.1);
            let at = &mut nearest[row * size.0 + column];
            if e >= 0.0 && f >= 0.0 && g >= 0.0 && depth < at.0 {
                *at = (depth, id);
            }
        }
    }
}

fn visibility(c: &mut Criterion) {
    let mut group = c.benchmark_group("visibility");
    group.sample_size(10);
    for (n, name) in TERRAINS {
        let mesh = terrain(n);
        let frame = view(World::new(0.5, 0.42, 0.05));
        let mut visible = Visible::new(&Lattice::centres(&frame, 0), 128);
        group.bench_function(BenchmarkId::new("ours", name), |b| b.iter(|| visible.see(&frame, &mesh)));
        group.bench_function(BenchmarkId::new("plain", name), |b| b.iter(|| black_box(plain(&frame, &mesh))));
        // The same terrain outside the view: the cost must not follow its triangles.
        let away = view(World::new(0.5, -1.0, 0.2));
        let mut nothing = Visible::new(&Lattice::centres(&away, 0), 128);
        group.bench_function(BenchmarkId::new("ours, looking away", name), |b| {
            b.iter(|| nothing.see(&away, &mesh));
        });
    }
    group.finish();
}

criterion_group!(benches, visibility);
criterion_main!(benches);
