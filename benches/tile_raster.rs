//! Tiles of the texture beside other rasterizers: 256 tiles of 256 x 256 texels, one thread, opaque colours.
//!
//! `cargo bench --bench tile_raster` prints, before the times, how far each one's coverage is from the exact area: single lines,
//! polygons and slivers, and crowds of lines that overlap within texels.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use drapery::math;
use drapery::resolve::Paint;
use drapery::scene::{BlendMode, Rule};
use drapery::space::Texel;
use drapery::technique::clipmap::raster::{Area, Folded, Ink, RasterSettings, TexelRect, TileRaster};
use drapery::technique::clipmap::tessellation::Pair;
use drapery::technique::clipmap::{LineFilter, LinePrimitives, Overlaps, PolygonRaster, TexelFormat};
use std::hint::black_box;

/// Tiles a side.
const TILES: usize = 16;
/// Texels a side of a tile.
const TILE: usize = 256;

const EXACT: RasterSettings = RasterSettings {
    polygons: PolygonRaster::Exact,
    lines: LinePrimitives::Coverage,
    line_filter: LineFilter::Gaussian,
    overlaps: Overlaps::Once,
    texel: TexelFormat::F32,
};

/// What is drawn: strips of lines, or rings of polygons, each with a colour.
struct Items {
    name: &'static str,
    segments: u64,
    strips: Vec<Vec<Pair<Texel>>>,
    rings: Vec<Vec<Texel>>,
    /// The items of each tile.
    of_tiles: Vec<Vec<u32>>,
}

/// Numbers that look random.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

fn direction(angle: f64) -> glam::DVec2 {
    glam::DVec2::new(math::cos(angle), math::sin(angle))
}

/// Which items' boxes meet each tile.
fn of_tiles<'a>(shapes: impl Iterator<Item = Vec<Texel>> + 'a) -> Vec<Vec<u32>> {
    let mut tiles = vec![Vec::new(); TILES * TILES];
    for (k, shape) in shapes.enumerate() {
        let range = |of: &dyn Fn(&Texel) -> f64| {
            let low = shape.iter().map(of).fold(f64::INFINITY, math::min);
            let high = shape.iter().map(of).fold(f64::NEG_INFINITY, math::max);
            let tile = |v: f64| (v / TILE as f64).clamp(0.0, TILES as f64 - 1.0) as usize;
            tile(low)..=tile(high)
        };
        let rows = range(&|p| p.y);
        for column in range(&|p| p.x) {
            for row in rows.clone() {
                tiles[row * TILES + column].push(k as u32);
            }
        }
    }
    tiles
}

/// Lines of 20 segments that wander.
fn lines(name: &'static str, segments: usize, length: f64) -> Items {
    let mut random = Random(88_172_645_463_325_252);
    let side = (TILES * TILE) as f64;
    let mut line = |_| {
        let (mut at, mut angle) =
            (Texel::new(side * random.unit(), side * random.unit()), random.between(0.0, 6.3));
        let half = 0.5 * random.between(1.0, 8.0);
        let mut points = vec![at];
        for _ in 0..20 {
            angle += random.between(-0.4, 0.4);
            at = at + direction(angle) * (length * random.between(0.6, 1.4));
            points.push(at);
        }
        let normal = |k: usize| (points[k + 1] - points[k]).normalize().perp();
        let pair = |k: usize| {
            let (before, after) = (normal(k.saturating_sub(1)), normal(k.min(points.len() - 2)));
            let offset = (before + after) / (1.0 + before.dot(after)) * half;
            // y points south: left on the map is against the perpendicular.
            Pair { left: points[k] + -offset, right: points[k] + offset }
        };
        (0..points.len()).map(pair).collect::<Vec<Pair<Texel>>>()
    };
    let strips: Vec<Vec<Pair<Texel>>> = (0..segments / 20).map(&mut line).collect();
    let tiles = of_tiles(strips.iter().map(|s| s.iter().flat_map(|p| [p.left, p.right]).collect()));
    Items { name, segments: segments as u64, strips, rings: Vec::new(), of_tiles: tiles }
}

/// Stars of 11 edges.
fn polygons(name: &'static str, count: usize) -> Items {
    let mut random = Random(88_172_645_463_325_252);
    let side = (TILES * TILE) as f64;
    let mut star = |_| {
        let middle = Texel::new(side * random.unit(), side * random.unit());
        let radius = random.between(3.0, 8.0);
        (0..11)
            .map(|k| {
                let angle = -std::f64::consts::TAU * f64::from(k) / 11.0;
                middle + direction(angle) * (radius * random.between(0.6, 1.4))
            })
            .collect::<Vec<Texel>>()
    };
    let rings: Vec<Vec<Texel>> = (0..count).map(&mut star).collect();
    let tiles = of_tiles(rings.iter().cloned());
    Items { name, segments: 11 * count as u64, strips: Vec::new(), rings, of_tiles: tiles }
}

/// An opaque colour of an item.
fn color(k: u32) -> [u8; 3] {
    let [r, g, b, _] = k.wrapping_mul(0x9e37_79b9).to_le_bytes();
    [r, g, b]
}

impl Items {
    /// An item's outline: that of its strip, or its ring.
    fn outline(&self, k: u32) -> Vec<Texel> {
        match self.strips.get(k as usize) {
            None => self.rings[k as usize].clone(),
            Some(strip) => {
                let left = strip.iter().rev().map(|p| p.left);
                strip.iter().map(|p| p.right).chain(left).collect()
            }
        }
    }
}

fn place(tile: usize) -> TexelRect {
    let origin = ((tile % TILES * TILE) as i64, (tile / TILES * TILE) as i64);
    TexelRect { origin, size: (TILE, TILE) }
}

fn ours(items: &Items, settings: RasterSettings) -> f32 {
    let mut sum = 0.0;
    let mut raster = TileRaster::new(place(0), settings);
    for (tile, own) in items.of_tiles.iter().enumerate() {
        raster.start(place(tile).origin);
        for &k in own {
            let [r, g, b] = color(k).map(|v| f64::from(v) / 255.0);
            let ink = Ink::new(Paint([r, g, b, 1.0]), BlendMode::Over);
            match items.strips.get(k as usize) {
                Some(strip) => raster.strips([&strip[..]].into_iter(), Folded::Triangles, None, &ink),
                None => {
                    let area =
                        Area { rings: &[&items.rings[k as usize]], rule: Rule::NonZero, is_simple: true };
                    raster.fill(&area, &ink);
                }
            }
        }
        sum += raster.row(0)[77][0];
    }
    sum
}

fn skia_path(outline: &[Texel], (x, y): (i64, i64)) -> Option<tiny_skia::Path> {
    let mut path = tiny_skia::PathBuilder::new();
    for (k, p) in outline.iter().enumerate() {
        let (x, y) = ((p.x - x as f64) as f32, (p.y - y as f64) as f32);
        if k == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
    }
    path.close();
    path.finish()
}

fn skia(items: &Items) -> u32 {
    let mut sum = 0;
    for (tile, own) in items.of_tiles.iter().enumerate() {
        let mut pixmap = tiny_skia::Pixmap::new(TILE as u32, TILE as u32).expect("a tile");
        for &k in own {
            let [r, g, b] = color(k);
            let mut paint = tiny_skia::Paint { anti_alias: true, ..tiny_skia::Paint::default() };
            paint.set_color_rgba8(r, g, b, 255);
            if let Some(path) = skia_path(&items.outline(k), place(tile).origin) {
                let rule = tiny_skia::FillRule::Winding;
                pixmap.fill_path(&path, &paint, rule, tiny_skia::Transform::identity(), None);
            }
        }
        sum += u32::from(pixmap.data()[308]);
    }
    sum
}

fn vello_path(outline: &[Texel], (x, y): (i64, i64)) -> vello_cpu::kurbo::BezPath {
    let mut path = vello_cpu::kurbo::BezPath::new();
    for (k, p) in outline.iter().enumerate() {
        let at = (p.x - x as f64, p.y - y as f64);
        if k == 0 { path.move_to(at) } else { path.line_to(at) }
    }
    path.close_path();
    path
}

fn vello(items: &Items) -> u32 {
    let mut sum = 0;
    let mut context = vello_cpu::RenderContext::new(TILE as u16, TILE as u16);
    let mut resources = vello_cpu::Resources::new();
    for (tile, own) in items.of_tiles.iter().enumerate() {
        context.reset();
        let mut pixmap = vello_cpu::Pixmap::new(TILE as u16, TILE as u16);
        for &k in own {
            let [r, g, b] = color(k);
            context.set_paint(vello_cpu::color::AlphaColor::from_rgba8(r, g, b, 255));
            context.fill_path(&vello_path(&items.outline(k), place(tile).origin));
        }
        context.flush();
        context.render(&mut pixmap, &mut resources);
        sum += u32::from(pixmap.data()[77].r);
    }
    sum
}

fn zeno(items: &Items) -> u32 {
    use zeno::PathBuilder;
    let mut sum = 0;
    let mut mask = vec![0u8; TILE * TILE];
    for (tile, own) in items.of_tiles.iter().enumerate() {
        let mut path: Vec<zeno::Command> = Vec::new();
        let (x, y) = place(tile).origin;
        for &k in own {
            for (n, p) in items.outline(k).iter().enumerate() {
                let at = [(p.x - x as f64) as f32, (p.y - y as f64) as f32];
                if n == 0 {
                    path.move_to(at)
                } else {
                    path.line_to(at)
                };
            }
            path.close();
        }
        mask.fill(0);
        zeno::Mask::new(&path[..]).size(TILE as u32, TILE as u32).render_into(&mut mask, None);
        sum += u32::from(mask[77]);
    }
    sum
}

/// A rasterizer's alpha of some convex or star-shaped rings that are one path, in one tile.
type Coverage = Box<dyn Fn(&[Vec<Texel>]) -> Vec<f64>>;

fn coverage_of_ours(settings: RasterSettings) -> Coverage {
    Box::new(move |rings| {
        let mut raster = TileRaster::new(place(0), settings);
        let rings: Vec<&[Texel]> = rings.iter().map(|ring| &ring[..]).collect();
        let area = Area { rings: &rings, rule: Rule::NonZero, is_simple: rings.len() == 1 };
        raster.fill(&area, &Ink::new(Paint([1.0; 4]), BlendMode::Over));
        (0..TILE)
            .flat_map(|row| raster.row(row).iter().map(|texel| f64::from(texel[3])).collect::<Vec<_>>())
            .collect()
    })
}

fn coverage_of_skia(rings: &[Vec<Texel>]) -> Vec<f64> {
    let mut pixmap = tiny_skia::Pixmap::new(TILE as u32, TILE as u32).expect("a tile");
    let mut builder = tiny_skia::PathBuilder::new();
    rings.iter().filter_map(|ring| skia_path(ring, (0, 0))).for_each(|path| builder.push_path(&path));
    let mut paint = tiny_skia::Paint { anti_alias: true, ..tiny_skia::Paint::default() };
    paint.set_color_rgba8(255, 255, 255, 255);
    let path = builder.finish().expect("a path");
    pixmap.fill_path(&path, &paint, tiny_skia::FillRule::Winding, tiny_skia::Transform::identity(), None);
    pixmap.data().iter().skip(3).step_by(4).map(|alpha| f64::from(*alpha) / 255.0).collect()
}

fn coverage_of_vello(rings: &[Vec<Texel>]) -> Vec<f64> {
    let mut context = vello_cpu::RenderContext::new(TILE as u16, TILE as u16);
    let mut pixmap = vello_cpu::Pixmap::new(TILE as u16, TILE as u16);
    let path: vello_cpu::kurbo::BezPath = rings.iter().flat_map(|ring| vello_path(ring, (0, 0))).collect();
    context.set_paint(vello_cpu::color::AlphaColor::from_rgba8(255, 255, 255, 255));
    context.fill_path(&path);
    context.flush();
    context.render(&mut pixmap, &mut vello_cpu::Resources::new());
    pixmap.data().iter().map(|texel| f64::from(texel.a) / 255.0).collect()
}

fn coverage_of_zeno(rings: &[Vec<Texel>]) -> Vec<f64> {
    use zeno::PathBuilder;
    let mut path: Vec<zeno::Command> = Vec::new();
    for ring in rings {
        for (n, p) in ring.iter().enumerate() {
            let at = [p.x as f32, p.y as f32];
            if n == 0 {
                path.move_to(at)
            } else {
                path.line_to(at)
            };
        }
        path.close();
    }
    let mut mask = vec![0u8; TILE * TILE];
    zeno::Mask::new(&path[..]).size(TILE as u32, TILE as u32).render_into(&mut mask, None);
    mask.iter().map(|alpha| f64::from(*alpha) / 255.0).collect()
}

/// The area of a texel that rings cover together, exact but for rounding: between two heights at which an edge begins, ends or
/// meets another or a side of the texel, the covered length is linear.
fn exact_area(rings: &[Vec<Texel>], (column, row): (usize, usize)) -> f64 {
    let (west, north) = (column as f64, row as f64);
    let mut edges: Vec<[Texel; 2]> = Vec::new();
    for ring in rings {
        let ends = ring.iter().cycle().skip(1);
        edges.extend(ring.iter().zip(ends).map(|(a, b)| [*a, *b]).filter(|[a, b]| a.y != b.y));
    }
    edges.retain(|[a, b]| math::max(a.y, b.y) > north && math::min(a.y, b.y) < north + 1.0);
    let x_at = |[a, b]: &[Texel; 2], y: f64| a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
    let mut heights = vec![north, north + 1.0];
    for (k, edge) in edges.iter().enumerate() {
        heights.extend([edge[0].y, edge[1].y]);
        let (top, bottom) = (x_at(edge, north), x_at(edge, north + 1.0));
        let sides = [west, west + 1.0].map(|x| north + (x - top) / (bottom - top));
        heights.extend(sides.into_iter().filter(|y| y.is_finite()));
        for other in &edges[..k] {
            let (other_top, other_bottom) = (x_at(other, north), x_at(other, north + 1.0));
            let meet = north + (other_top - top) / (bottom - top - other_bottom + other_top);
            heights.extend(Some(meet).filter(|y| y.is_finite()));
        }
    }
    heights.retain(|y| (north..=north + 1.0).contains(y));
    heights.sort_by(f64::total_cmp);
    let mut area = 0.0;
    for pair in heights.windows(2) {
        let middle = 0.5 * (pair[0] + pair[1]);
        let is_crossed = |[a, b]: &&[Texel; 2]| (a.y <= middle) != (b.y <= middle);
        let mut crossings: Vec<(f64, i32)> = edges
            .iter()
            .filter(is_crossed)
            .map(|edge| (x_at(edge, middle), if edge[0].y < edge[1].y { 1 } else { -1 }))
            .collect();
        crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut turns = 0;
        for k in 0..crossings.len().saturating_sub(1) {
            turns += crossings[k].1;
            let [from, to] = [crossings[k].0, crossings[k + 1].0].map(|x| x.clamp(west, west + 1.0));
            area += if turns == 0 { 0.0 } else { (to - from) * (pair[1] - pair[0]) };
        }
    }
    area
}

/// Shapes of a kind: some are one path each.
struct Trial {
    name: &'static str,
    paths: Vec<Vec<Vec<Texel>>>,
}

/// A straight line as a ring.
fn bar(random: &mut Random, width: f64, length: f64) -> Vec<Texel> {
    let from = Texel::new(random.between(4.0, 28.0), random.between(4.0, 28.0));
    let along = direction(random.between(0.0, 6.3));
    let (to, across) = (from + along * length, along.perp() * (0.5 * width));
    vec![from + across, to + across, to + -across, from + -across]
}

fn trials() -> [Trial; 4] {
    let mut random = Random(2_463_534_242);
    let r = &mut random;
    let lines = (0..1800).map(|_| {
        let (width, length) = (r.between(0.1, 4.0), r.between(1.0, 24.0));
        vec![bar(r, width, length)]
    });
    let lines = lines.collect();
    let polygons = (0..600).map(|_| {
        let (middle, radius) = (Texel::new(16.0 + r.unit(), 16.0 + r.unit()), r.between(2.0, 9.0));
        let corner = |k| {
            middle + direction(-std::f64::consts::TAU * f64::from(k) / 9.0) * (radius * r.between(0.4, 1.4))
        };
        vec![(0..9).map(corner).collect()]
    });
    let polygons = polygons.collect();
    let slivers = (0..300).map(|_| {
        let (width, length) = (r.between(0.001, 0.1), r.between(4.0, 24.0));
        vec![bar(r, width, length)]
    });
    let slivers = slivers.collect();
    let crowds = (0..40).map(|_| (0..40).map(|_| bar(r, 1.0, 20.0)).collect());
    let crowds = crowds.collect();
    [("lines", lines), ("polygons", polygons), ("slivers", slivers), ("crowds", crowds)]
        .map(|(name, paths)| Trial { name, paths })
}

/// Prints how far each rasterizer's coverage is from the exact area, at most and in the mean of texels that are touched.
#[allow(clippy::print_stderr, reason = "a bench's figures are for people")]
fn print_accuracy() {
    let of = |polygons, texel| coverage_of_ours(RasterSettings { polygons, texel, ..EXACT });
    let rasterizers: [(&str, Coverage); 6] = [
        ("ours, exact", of(PolygonRaster::Exact, TexelFormat::F32)),
        ("ours, exact, 8 bits", of(PolygonRaster::Exact, TexelFormat::Unorm8)),
        ("ours, aliased", of(PolygonRaster::Aliased, TexelFormat::F32)),
        ("vello_cpu", Box::new(coverage_of_vello)),
        ("tiny-skia", Box::new(coverage_of_skia)),
        ("zeno", Box::new(coverage_of_zeno)),
    ];
    let trials = trials();
    // Nothing reaches farther than this.
    let side = 56;
    let near = |path: &[Vec<Texel>], column: usize, row: usize| {
        let range = |of: &dyn Fn(&Texel) -> f64| {
            let values = || path.iter().flatten().map(of);
            values().fold(f64::MAX, math::min) - 1.0..values().fold(f64::MIN, math::max) + 1.0
        };
        range(&|p| p.x).contains(&(column as f64)) && range(&|p| p.y).contains(&(row as f64))
    };
    let exact: Vec<Vec<(usize, usize, f64)>> = trials
        .iter()
        .flat_map(|trial| &trial.paths)
        .map(|path| {
            let texels = (0..side).flat_map(|row| (0..side).map(move |column| (column, row)));
            let texels = texels.filter(|(column, row)| near(path, *column, *row));
            texels.map(|(column, row)| (column, row, exact_area(path, (column, row)))).collect()
        })
        .collect();
    eprintln!("coverage against the exact area: largest and mean difference of texels that are touched");
    for (name, coverage) in &rasterizers {
        let mut exact = exact.iter();
        eprint!("{name:<20}");
        for trial in &trials {
            let (mut largest, mut sum, mut count) = (0.0, 0.0, 0);
            for (path, right) in trial.paths.iter().zip(&mut exact) {
                let drawn = coverage(path);
                for (column, row, area) in right {
                    let off = (drawn[row * TILE + column] - area).abs();
                    largest = math::max(largest, off);
                    sum += off;
                    count += usize::from(*area > 0.0);
                }
            }
            eprint!("  {} {largest:.5} {:.6}", trial.name, sum / count as f64);
        }
        eprintln!();
    }
}

fn tile_raster(c: &mut Criterion) {
    print_accuracy();
    let sets = [lines("L100k", 100_000, 20.0), lines("L1.25M", 1_250_000, 8.0), polygons("P150k", 150_000)];
    for items in &sets {
        let mut group = c.benchmark_group(items.name);
        group.sample_size(10).throughput(Throughput::Elements(items.segments));
        let aliased = RasterSettings { polygons: PolygonRaster::Aliased, ..EXACT };
        let code_values = RasterSettings { texel: TexelFormat::Unorm8, ..EXACT };
        for (name, settings) in [("exact", EXACT), ("exact, 8 bits", code_values), ("aliased", aliased)] {
            group.bench_function(BenchmarkId::new("ours", name), |b| {
                b.iter(|| black_box(ours(items, settings)))
            });
        }
        group.bench_function("vello_cpu", |b| b.iter(|| black_box(vello(items))));
        group.bench_function("tiny-skia", |b| b.iter(|| black_box(skia(items))));
        group.bench_function("zeno, one mask a tile", |b| b.iter(|| black_box(zeno(items))));
        group.finish();
    }
}

criterion_group!(benches, tile_raster);
criterion_main!(benches);
