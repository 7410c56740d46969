//! Static decals: looking points up, beside the plain ways to do that; preparing and drawing data like that of Zechmeister's largest case
//! study.
//!
//! `cargo bench --bench static_decal`

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use drapery::decal::{Decals, Hits, LookupCounts, Palette, Preparation, Settings};
use drapery::index::CellLists;
use drapery::resolve::Compositor;
use drapery::scene_file::SceneFile;
use drapery::space::{Plan, PlanBox};
use drapery::stage::Stage;
use drapery::technique::{self, FrameOptions, Kind};
use rstar::{AABB, RTree, RTreeObject};
use std::hint::black_box;

fn stage(layers: &str, camera: &str, extent: f64) -> Stage {
    let cell = extent / 512.0;
    let text = format!(
        "schema = 1\nimage = {{ width = 1920, height = 1080 }}\ncamera = {{ {camera} }}\n\
         terrain = {{ generate = {{ kind = \"fbm\", seed = 3, posts = [513, 513], cell_m = {cell}, height_m = 160.0 }} }}\n{layers}"
    );
    let file = SceneFile::parse(&text, None, &[]).expect("a valid scene");
    let (scene, surface) = drapery::source::load::load(&file, &|_| {}).expect("generated data");
    Stage::new(scene, surface).expect("a mesh")
}

/// Points of a map in raster order, `per_pixel` near to each other.
fn points(extent: f64, per_pixel: usize) -> Vec<Plan> {
    let side = 1000;
    let step = extent / side as f64;
    let place = |k: usize| {
        let (x, y) = ((k % side) as f64 * step - 0.5 * extent, (k / side) as f64 * step - 0.5 * extent);
        (0..per_pixel).map(move |s| {
            let part = |n: usize| step * (n % per_pixel) as f64 / per_pixel as f64;
            Plan::new(x + part(s), y + part(3 * s + 1))
        })
    };
    (0..side * side).flat_map(place).collect()
}

/// Rings by their boxes: in cells, and in an R-tree.
struct Rings {
    rings: Vec<Vec<Plan>>,
    cells: CellLists<u32>,
    tree: RTree<Boxed>,
    bounds: PlanBox,
}

struct Boxed(AABB<[f64; 2]>, u32);

impl RTreeObject for Boxed {
    type Envelope = AABB<[f64; 2]>;

    fn envelope(&self) -> Self::Envelope {
        self.0
    }
}

const SIDE: usize = 512;

impl Rings {
    fn of(stage: &Stage) -> Self {
        let list = &stage.draw_list;
        let rings: Vec<Vec<Plan>> = list
            .items()
            .iter()
            .flat_map(|item| list.area(item).iter().map(|ring| list.path_of(ring).to_vec()))
            .collect();
        let bounds = stage.mesh.plan_bounds();
        let boxes: Vec<PlanBox> = rings.iter().map(|ring| PlanBox::around(ring.iter().copied())).collect();
        let cell =
            |v: f64, low: f64, high: f64| (((v - low) / (high - low) * SIDE as f64) as usize).min(SIDE - 1);
        let cells = CellLists::new(SIDE * SIDE, |entries| {
            for (k, plan) in (0..).zip(&boxes) {
                for row in cell(plan.min.y, bounds.min.y, bounds.max.y)
                    ..=cell(plan.max.y, bounds.min.y, bounds.max.y)
                {
                    for column in cell(plan.min.x, bounds.min.x, bounds.max.x)
                        ..=cell(plan.max.x, bounds.min.x, bounds.max.x)
                    {
                        entries.put(row * SIDE + column, k);
                    }
                }
            }
        });
        let boxed = |(k, plan): (u32, &PlanBox)| {
            Boxed(AABB::from_corners([plan.min.x, plan.min.y], [plan.max.x, plan.max.y]), k)
        };
        let tree = RTree::bulk_load((0..).zip(&boxes).map(boxed).collect());
        Self { rings, cells, tree, bounds }
    }

    fn holds(&self, ring: u32, at: Plan) -> bool {
        let mut is_inside = false;
        for edge in self.rings[ring as usize].windows(2) {
            let (a, b) = (edge[0], edge[1]);
            if (a.y <= at.y) != (b.y <= at.y) && at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x) {
                is_inside = !is_inside;
            }
        }
        is_inside
    }

    fn in_grid(&self, at: Plan) -> usize {
        let size = self.bounds.max - self.bounds.min;
        let d = at - self.bounds.min;
        let cell = |v: f64, size: f64| ((v / size * SIDE as f64) as usize).min(SIDE - 1);
        let near = self.cells.of(cell(d.y, size.y) * SIDE + cell(d.x, size.x));
        near.iter().filter(|ring| self.holds(**ring, at)).count()
    }

    fn in_tree(&self, at: Plan) -> usize {
        let at_point = AABB::from_point([at.x, at.y]);
        self.tree.locate_in_envelope_intersecting(&at_point).filter(|boxed| self.holds(boxed.1, at)).count()
    }
}

fn queries(c: &mut Criterion) {
    let extent = 20_000.0;
    let mosaic = "[[layer]]\ngenerate = { kind = \"mosaic\", seed = 4, count = 100000 }\nfill = { color = \"#558855\", opacity = 0.5 }\n";
    let stage = stage(mosaic, "eye = [0, 0, 9000], target = [0, 1, 0]", extent);
    let settings = Settings { preparation: Preparation::Whole, ..Settings::default() };
    let decals = Decals::new(&stage.draw_list, &stage.mesh.plan_bounds(), &settings, false, &|_| {});
    let compositing = stage.scene.compositing;
    let palette = Palette::new(&stage.draw_list, Compositor::new(compositing), compositing.mode);
    let rings = Rings::of(&stage);
    let mut group = c.benchmark_group("point-in-polygon");
    group.sample_size(10);
    for per_pixel in [1, 8] {
        let points = points(extent, per_pixel);
        group.throughput(Throughput::Elements(points.len() as u64));
        group.bench_function(BenchmarkId::new("static decals", per_pixel), |b| {
            let mut hits = Hits::default();
            b.iter(|| {
                let mut found = 0;
                for pixel in points.chunks(per_pixel) {
                    decals.find(pixel, &palette, &mut hits, &mut LookupCounts::default());
                    found += hits.found().len();
                }
                black_box(found)
            });
        });
        group.bench_function(BenchmarkId::new("grid of 512 x 512 boxes", per_pixel), |b| {
            b.iter(|| black_box(points.iter().map(|at| rings.in_grid(*at)).sum::<usize>()));
        });
        group.bench_function(BenchmarkId::new("rstar", per_pixel), |b| {
            b.iter(|| black_box(points.iter().map(|at| rings.in_tree(*at)).sum::<usize>()));
        });
    }
    group.finish();
}

fn frames(c: &mut Criterion) {
    let mut group = c.benchmark_group("case study rc");
    group.sample_size(10);
    for scale in [0.01, 0.1] {
        let catchments = format!(
            "[[layer]]\ngenerate = {{ kind = \"case-study\", study = \"rc\", group = \"catchments\", scale = {scale} }}\n\
             fill = {{ color = \"#6688cc\", opacity = 0.6 }}\noutline = {{ color = \"#ffffff\", width_m = 20.0 }}\n"
        );
        let mut stage = stage(&catchments, "eye = [0, -24000, 16000], target = [0, -1000, 0]", 40_000.0);
        for (name, preparation) in [("whole", Preparation::Whole), ("seen", Preparation::Seen)] {
            stage.scene.technique.set(Settings { preparation, ..Settings::default() });
            group.bench_function(BenchmarkId::new(format!("prepare, {name}"), scale), |b| {
                b.iter(|| {
                    black_box(technique::prepare(Kind::StaticDecal, &stage).expect("widths in metres"))
                });
            });
        }
        let view = stage.view().expect("a view");
        let options = FrameOptions { tile: 128, buffers: &[], progress: &|_| {} };
        for samples in [1, 8] {
            stage.scene.technique.set(Settings { samples, ..Settings::default() });
            let prepared = technique::prepare(Kind::StaticDecal, &stage).expect("widths in metres");
            group
                .throughput(Throughput::Elements((view.width() * view.height()) as u64 * u64::from(samples)));
            group.bench_function(
                BenchmarkId::new(format!("frame of {samples} samples a pixel"), scale),
                |b| {
                    b.iter(|| black_box(prepared.frame(&view, &options).expect("no buffers")));
                },
            );
        }
    }
    group.finish();
}

/// A picture of a terrain with hardly anything on it: what a frame costs where cells are not crowded.
fn sparse(c: &mut Criterion) {
    let few = "[[layer]]\ngenerate = { kind = \"roads\", seed = 5, count = 3, segment_m = 200.0 }\nline = { color = \"#ffee88\", width_m = 6.0 }\n";
    let mut stage = stage(few, "eye = [0, -12000, 8000], target = [0, -500, 0]", 20_000.0);
    let view = stage.view().expect("a view");
    let mut group = c.benchmark_group("three roads");
    group.sample_size(10);
    for samples in [1, 8] {
        stage.scene.technique.set(Settings { samples, ..Settings::default() });
        let prepared = technique::prepare(Kind::StaticDecal, &stage).expect("widths in metres");
        group.throughput(Throughput::Elements((view.width() * view.height()) as u64 * u64::from(samples)));
        for tile in [32, 64] {
            let options = FrameOptions { tile, buffers: &[], progress: &|_| {} };
            group.bench_function(
                BenchmarkId::new(format!("frame of {samples} samples a pixel"), tile),
                |b| {
                    b.iter(|| black_box(prepared.frame(&view, &options).expect("no buffers")));
                },
            );
        }
    }
    group.finish();
}

criterion_group!(benches, queries, frames, sparse);
criterion_main!(benches);
