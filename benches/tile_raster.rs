//! Tiles of the texture beside other rasterizers: 256 tiles of 256 x 256 texels, one thread, opaque colours.
//!
//! `cargo bench --bench tile_raster` prints, before the times, how far each one's coverage is from the exact area: single lines,
//! polygons and slivers, and crowds of lines that overlap within texels.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use drapery::resolve::Paint;
use drapery::scene::{BlendMode, LineFilter, LinePrimitives, Overlaps, PolygonRaster, Rule, TexelFormat};
use drapery::space::Texel;
use drapery::technique::clipmap::raster::{Area, Folded, Ink, Pair, RasterSettings, TilePlace, TileRaster};
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
    glam::DVec2::new(drapery::math::cos(angle), drapery::math::sin(angle))
}

/// Which items' boxes meet each tile.
fn of_tiles<'a>(shapes: impl Iterator<Item = Vec<Texel>> + 'a) -> Vec<Vec<u32>> {
    let mut tiles = vec![Vec::new(); TILES * TILES];
    for (k, shape) in shapes.enumerate() {
        let range = |of: &dyn Fn(&Texel) -> f64| {
            let low = shape.iter().map(of).fold(f64::INFINITY, drapery::math::min);
            let high = shape.iter().map(of).fold(f64::NEG_INFINITY, drapery::math::max);
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

fn place(tile: usize) -> TilePlace {
    let origin = ((tile % TILES * TILE) as i64, (tile / TILES * TILE) as i64);
    TilePlace { origin, size: (TILE, TILE) }
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

fn tile_raster(c: &mut Criterion) {
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
