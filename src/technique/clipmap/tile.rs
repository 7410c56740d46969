//! One tile of the texture: its items in draw order, thin lines as line primitives, the others as polygons (Algorithm 2).

use super::geometry::{AreaRings, Chunk, Drawn, Geometry, StrokeStyle};
use super::raster::{Area, Cut, RasterSettings, TexelRect, TileRaster};
use super::tessellation::{Pair, Sagitta, Strips};
use super::texture::{TILE, TileKey, VirtualTexture};
use crate::draw_list::Side;
use crate::math;
use crate::scene::{Device, Precision, Width};
use crate::space::{Plan, PlanBox, Texel};
use crate::technique::clipmap::{PixelWidth, Settings, Solution, TexelFormat, WideLines};

/// Vertices of a ring that are looked at together: where all lie on one side of the tile, only the first is kept.
const RING_CHUNK: usize = 64;

/// How far a circle's sides may stay within it, texels: together with that of fixed-point coordinates less than half a code value.
const ROUND_TEXELS: f64 = 1.0 / 640.0;

/// A finished tile.
#[derive(Debug, Clone, PartialEq)]
pub struct Tile {
    /// Texels a side.
    pub size: usize,
    /// Its texels, rows from the north: premultiplied paint of the working space.
    pub texels: Texels,
    /// What was drawn.
    pub counts: TileCounts,
}

/// A tile's texels.
#[derive(Debug, Clone, PartialEq)]
pub enum Texels {
    /// Single-precision numbers.
    F32(Vec<[f32; 4]>),
    /// Code values.
    Unorm8(Vec<[u8; 4]>),
}

/// What was drawn into a tile.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct TileCounts {
    /// Line primitives.
    pub lines: u64,
    /// Items whose line primitives were wider than the device draws: clamped or left out.
    pub wide_items: u64,
    /// Quadrilaterals of tessellated lines.
    pub quads: u64,
    /// Filled areas.
    pub areas: u64,
}

impl TileCounts {
    /// The sum of both.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            lines: self.lines + other.lines,
            wide_items: self.wide_items + other.wide_items,
            quads: self.quads + other.quads,
            areas: self.areas + other.areas,
        }
    }
}

impl Tile {
    /// A texel.
    #[inline(always)]
    pub fn at(&self, column: usize, row: usize) -> [f32; 4] {
        let k = row * self.size + column;
        match &self.texels {
            Texels::F32(texels) => texels[k],
            Texels::Unorm8(texels) => texels[k].map(|v| f32::from(v) / 255.0),
        }
    }

    /// Bytes of its texels.
    pub fn bytes(&self) -> usize {
        match &self.texels {
            Texels::F32(texels) => size_of_val(&texels[..]),
            Texels::Unorm8(texels) => size_of_val(&texels[..]),
        }
    }
}

/// Makes tiles.
#[derive(Debug, Clone, Copy)]
pub struct TileMaker<'a> {
    pub(super) geometry: &'a Geometry<'a>,
    pub(super) texture: VirtualTexture,
    pub(super) settings: Settings,
    pub(super) device: Device,
    /// A pixel's size at the distance of what the middle of the picture shows, metres: what widths in pixels are multiples of where
    /// they follow the distance.
    pub(super) pixel_m: f64,
}

/// Memory that is used again from tile to tile.
#[derive(Debug)]
pub(super) struct Workbench {
    size: usize,
    raster: TileRaster,
    strips: Strips,
    pairs: Vec<Pair<Texel>>,
    ends: Vec<usize>,
    segments: Vec<[Texel; 2]>,
    rings: Rings,
}

/// Rings of an area in texels.
#[derive(Debug, Default)]
struct Rings {
    points: Vec<Texel>,
    ends: Vec<usize>,
}

impl Rings {
    fn slices(&self) -> Vec<&[Texel]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, end)| &self.points[start..*end]).collect()
    }
}

/// The map from the plan to a level's texels, as the device computes it.
#[derive(Debug, Clone, Copy)]
struct TexelMap {
    texture: VirtualTexture,
    level: u32,
    origin: (i64, i64),
    is_single: bool,
    /// Positions a texel; 0: any.
    steps: f64,
}

impl TexelMap {
    #[inline]
    fn texel(&self, at: Plan) -> Texel {
        let mut texel = self.texture.texel(self.level, at);
        if self.is_single {
            // Vertex buffers and the tile's own coordinates are single precision.
            let stored = Plan::new(f64::from(at.x as f32), f64::from(at.y as f32));
            let exact = self.texture.texel(self.level, stored);
            let local = |v: f64, origin: i64| f64::from((v - origin as f64) as f32) + origin as f64;
            texel = Texel::new(local(exact.x, self.origin.0), local(exact.y, self.origin.1));
        }
        if self.steps > 0.0 {
            let snapped = |v: f64| (v * self.steps + 0.5).floor() / self.steps;
            texel = Texel::new(snapped(texel.x), snapped(texel.y));
        }
        texel
    }

    fn pair(&self, pair: &Pair<Plan>) -> Pair<Texel> {
        Pair { left: self.texel(pair.left), right: self.texel(pair.right) }
    }
}

impl Workbench {
    /// For tiles of a size.
    fn new(size: usize, settings: &Settings) -> Self {
        let place = TexelRect { origin: (0, 0), size: (size, size) };
        let raster = RasterSettings {
            polygons: settings.polygons,
            lines: settings.lines,
            line_filter: settings.line_filter,
            overlaps: settings.overlaps,
            texel: settings.texel,
        };
        Self {
            size,
            raster: TileRaster::new(place, raster),
            strips: Strips::default(),
            pairs: Vec::new(),
            ends: Vec::new(),
            segments: Vec::new(),
            rings: Rings::default(),
        }
    }
}

/// An item to be drawn: an area, or the chunks of a stroke.
#[derive(Debug, Clone, Copy)]
enum ItemPiece<'c> {
    Area(AreaRings),
    Stroke(u32, &'c [u32]),
}

impl TileMaker<'_> {
    /// How wide a stroke is in a level, metres.
    fn width_m(&self, width: Width, level: u32) -> f64 {
        match (width, self.settings.pixel_width) {
            (Width::Metres(width), _) => width,
            (Width::Pixels(pixels), PixelWidth::Distance) => pixels * self.pixel_m,
            (Width::Pixels(texels), PixelWidth::Texels) => texels * self.texture.texel_m(level),
        }
    }

    /// A pixel's size, if the width of any stroke follows it.
    pub(super) fn followed_pixel_m(&self) -> Option<f64> {
        let [_, of_pixels] = self.geometry.styles().reach();
        let is_followed = self.settings.pixel_width == PixelWidth::Distance && of_pixels.is_some();
        is_followed.then_some(self.pixel_m)
    }

    /// How far from their vertices strokes may reach in a level, metres.
    fn reach_m(&self, level: u32) -> f64 {
        let [metres, pixels] = self.geometry.styles().reach();
        let pixels = pixels.map(|pixels| self.width_m(Width::Pixels(pixels), level));
        // A filter around a texel's centre, and a texel for rounding.
        math::max(metres.unwrap_or(0.0), pixels.unwrap_or(0.0)) + 4.0 * self.texture.texel_m(level)
    }

    /// Makes a tile on a workbench, which is set up anew where tiles are of another size.
    pub(super) fn make_on(&self, key: TileKey, bench: &mut Option<Workbench>) -> Tile {
        let size = self.texture.tile_size(key.level);
        let bench = match bench {
            Some(known) if known.size == size => known,
            other => other.insert(Workbench::new(size, &self.settings)),
        };
        self.make(key, bench)
    }

    /// Makes a tile.
    fn make(&self, key: TileKey, bench: &mut Workbench) -> Tile {
        let size = self.texture.tile_size(key.level);
        let origin = (i64::from(key.column) * TILE as i64, i64::from(key.row) * TILE as i64);
        bench.raster.start(origin);
        let map = TexelMap {
            texture: self.texture,
            level: key.level,
            origin,
            is_single: self.device.precision == Precision::F32,
            steps: if self.device.subpixel_bits > 0 {
                f64::from(1u32 << self.device.subpixel_bits)
            } else {
                0.0
            },
        };
        let drawing = TilePainter { maker: self, map, window: self.texture.tile_bounds(key) };
        let counts = drawing.draw(bench);
        let rows = (0..size).flat_map(|row| bench.raster.row(row).iter().copied());
        let texels = match self.settings.texel {
            TexelFormat::F32 => Texels::F32(rows.collect()),
            TexelFormat::Unorm8 => Texels::Unorm8(rows.map(|t| t.map(|v| (v * 255.0 + 0.5) as u8)).collect()),
        };
        Tile { size, texels, counts }
    }
}

/// A tile being drawn.
struct TilePainter<'a> {
    maker: &'a TileMaker<'a>,
    map: TexelMap,
    window: PlanBox,
}

impl TilePainter<'_> {
    fn draw(&self, bench: &mut Workbench) -> TileCounts {
        let geometry = self.maker.geometry;
        let chunks = geometry.chunks_near(&self.window.grown(self.maker.reach_m(self.map.level)));
        let areas = geometry.areas_near(&self.window.grown(self.maker.texture.texel_m(self.map.level)));
        let mut counts = TileCounts::default();
        let mut areas = areas.into_iter().peekable();
        let strokes = chunks.chunk_by(|a, b| geometry.chunk(*a).item() == geometry.chunk(*b).item());
        for stroke in strokes {
            let item = geometry.chunk(stroke[0]).item();
            while let Some(area) = areas.next_if(|area| area.item < item) {
                self.piece(ItemPiece::Area(area), bench, &mut counts);
            }
            self.piece(ItemPiece::Stroke(item, stroke), bench, &mut counts);
        }
        for area in areas {
            self.piece(ItemPiece::Area(area), bench, &mut counts);
        }
        bench.raster.enter(None);
        counts
    }

    fn piece(&self, piece: ItemPiece, bench: &mut Workbench, counts: &mut TileCounts) {
        let geometry = self.maker.geometry;
        let (ItemPiece::Area(AreaRings { item, .. }) | ItemPiece::Stroke(item, _)) = piece;
        bench.raster.enter(geometry.group_of(item));
        match piece {
            ItemPiece::Area(area) => {
                let Drawn::Fill(fill) = geometry.drawn(area.item) else { return };
                self.load_rings(geometry.rings(&area), &mut bench.rings);
                let rings = bench.rings.slices();
                let shape = Area { rings: &rings, rule: fill.rule, is_simple: area.is_simple };
                bench.raster.fill(&shape, &fill.ink);
                counts.areas += 1;
            }
            ItemPiece::Stroke(item, chunks) => {
                let Drawn::Stroke(style) = geometry.drawn(item) else { return };
                self.stroke(item, chunks, style, bench, counts);
            }
        }
    }

    fn stroke(
        &self,
        item: u32,
        chunks: &[u32],
        style: &StrokeStyle,
        bench: &mut Workbench,
        counts: &mut TileCounts,
    ) {
        let maker = self.maker;
        let level = self.map.level;
        let width_m = maker.width_m(style.width, level);
        let width = width_m / maker.texture.texel_m(level);
        // What lies farther than this from the tile leaves nothing in it.
        let near = self.window.grown(0.5 * width_m * style.reach + 4.0 * maker.texture.texel_m(level));
        let chunks = chunks.iter().map(|chunk| maker.geometry.chunk(*chunk));

        let is_thin = width < maker.settings.threshold_texels;
        let as_lines = match maker.settings.solution {
            _ if style.is_point => false,
            Solution::Lines => true,
            Solution::Polygons => false,
            Solution::Both | Solution::Wireframe | Solution::Adjacency | Solution::Offsets => is_thin,
        };
        let cut = self.load_cut(item, style, bench);
        let Workbench { raster, strips, pairs, ends, segments, rings, .. } = bench;
        let rings = rings.slices();
        let cut = cut.map(|(side, is_simple)| Cut {
            area: Area { rings: &rings, rule: style.cut_rule, is_simple },
            keeps_inside: side == Side::Inside,
        });

        if as_lines {
            let limit = maker.device.max_line_width_px;
            let is_wide = width > limit;
            counts.wide_items += u64::from(is_wide);
            if is_wide && maker.settings.wide_lines == WideLines::Discard {
                return;
            }
            segments.clear();
            for chunk in chunks {
                self.load_segments(&chunk, style, &near, segments);
            }
            counts.lines += segments.len() as u64;
            let width = math::min(width, limit);
            return raster.segments(segments.iter().copied(), width, cut.as_ref(), &style.ink);
        }
        let half = 0.5 * width_m;
        let sagitta = Sagitta(math::min(2.0 * ROUND_TEXELS / math::max(width, 1e-9), 0.05));
        pairs.clear();
        ends.clear();
        for chunk in chunks {
            chunk.strips(style, (half, sagitta), strips, &mut |strip| {
                pairs.extend(strip.map(|pair| self.map.pair(&pair)));
                ends.push(pairs.len());
            });
        }
        counts.quads += (pairs.len() - ends.len()) as u64;
        let starts = std::iter::once(0).chain(ends.iter().copied());
        let strips = starts.zip(ends.iter()).map(|(start, end)| &pairs[start..*end]);
        raster.strips(strips, maker.geometry.folded(), cut.as_ref(), &style.ink);
    }

    /// Brings the polygon of an outline that is cut to it to texels; the side that counts, and whether the polygon is simple.
    fn load_cut(&self, item: u32, style: &StrokeStyle, bench: &mut Workbench) -> Option<(Side, bool)> {
        bench.rings.points.clear();
        bench.rings.ends.clear();
        let side = style.cut?;
        let geometry = self.maker.geometry;
        let area = geometry.cut_of(item)?;
        self.load_rings(geometry.rings(&area), &mut bench.rings);
        Some((side, area.is_simple))
    }

    /// Adds a chunk's segments that may touch the tile; those of wireframe, whose sides a chunk has too, with their neighbours.
    fn load_segments(&self, chunk: &Chunk, style: &StrokeStyle, near: &PlanBox, out: &mut Vec<[Texel; 2]>) {
        chunk.segments(style, &mut |from, to| {
            if PlanBox::around([from, to]).meets(near) {
                out.push([self.map.texel(from), self.map.texel(to)]);
            }
        });
    }

    /// Brings rings to texels; of vertices that lie on one side of the tile together, only the first.
    fn load_rings<'r>(&self, rings: impl Iterator<Item = &'r [Plan]>, out: &mut Rings) {
        out.points.clear();
        out.ends.clear();
        let near = self.window.grown(4.0 * self.maker.texture.texel_m(self.map.level));
        for ring in rings {
            for (k, chunk) in ring.chunks(RING_CHUNK).enumerate() {
                // With the vertex that follows, so that the edge to it is on that side too.
                let next = ring[(k * RING_CHUNK + chunk.len()) % ring.len()];
                let plan = PlanBox::around(chunk.iter().copied().chain([next]));
                let kept = if plan.meets(&near) { chunk } else { &chunk[..1] };
                out.points.extend(kept.iter().map(|p| self.map.texel(*p)));
            }
            out.ends.push(out.points.len());
        }
    }
}
