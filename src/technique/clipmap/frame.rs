//! A frame: which tiles its pixels touch, those tiles, their colours.

use super::Prepare;
use super::cache::CacheCounts;
use super::pixel::{NO_TILE, PixelPainter, Reading};
use super::sampling::Sampler;
use super::step::Step;
use super::table::Table;
use super::texture::{ClipRegion, TILE, TileKey};
use super::tile::{Tile, TileCounts, TileMaker, Workbench};
use crate::buffer::{Buffer, Plane, Values};
use crate::canvas::{
    Backdrop, Frame, FrameOptions, Kept, Pixels, joined, picture_plane, sight_counts, surface_plane,
};
use crate::error::Result;
use crate::parallel::{self, Progress};
use crate::raster::Lattice;
use crate::resolve::{Paint, code_values};
use crate::space::{Plan, ViewFrame, World};
use crate::terrain::Mesh;
use crate::visibility::{self, Hit, Planes, Sight};
use std::sync::Arc;

/// Draws a frame of a view; says what the cache did.
///
/// # Errors
/// Internal errors only.
pub(super) fn draw(
    prepared: &Prepare,
    view: &ViewFrame,
    options: &FrameOptions,
) -> Result<(Frame, CacheCounts)> {
    let mesh = &*prepared.stage.mesh_for(view);
    let sight = see(prepared, (mesh, view), options.tile);
    (options.progress)(0.2);
    FramePainter::new(prepared, (mesh, view), sight).frame(options)
}

/// Decides single pixels of a view as a frame does, with the tiles that they read: of each its steps and its code values.
pub(super) fn explain(
    prepared: &Prepare,
    view: &ViewFrame,
    pixels: &[[usize; 2]],
) -> Vec<(Vec<Step>, [u8; 4])> {
    let mesh = &*prepared.stage.mesh_for(view);
    let drawing = FramePainter::new(prepared, (mesh, view), see(prepared, (mesh, view), visibility::TILE));
    pixels.iter().map(|pixel| explained(prepared, &drawing, *pixel)).collect()
}

fn explained(prepared: &Prepare, drawing: &FramePainter, [x, y]: [usize; 2]) -> (Vec<Step>, [u8; 4]) {
    let (painter, mut steps) = (&drawing.painter, Vec::new());
    let plan = painter.sight.hit(x, y).map_or(Plan::new(f64::INFINITY, f64::INFINITY), |hit| hit.plan);
    let reading = painter.reading((x, y), plan, &mut None, &mut steps);
    let paint = reading.map_or(painter.backdrop.sky, |reading| {
        let mut keys = Vec::new();
        painter.tiles(&reading, |key| keys.push(key), &mut steps);
        keys.sort_unstable();
        keys.dedup();
        let mut cache = prepared.take_cache();
        cache.prepare(drawing.maker.followed_pixel_m(), &drawing.region);
        let make = |missing: &[TileKey]| drawing.make(missing, &|_| {});
        let tiles = cache.tiles(&keys, prepared.budget(), &mut CacheCounts::default(), make);
        prepared.return_cache(cache);
        let table = Table::new(&keys, tiles, prepared.texture.levels());
        painter.paint(&reading, &table, &mut painter.backdrop.no_ground(), &mut steps).0
    });
    (steps, code_values(painter.backdrop.compositor.encoded(paint)))
}

/// What the pixels' centres see, found in tiles of `tile` samples a side.
fn see<'a>(prepared: &Prepare, (mesh, view): (&'a Mesh, &'a ViewFrame), tile: usize) -> Sight<'a> {
    let device = &prepared.stage.scene.device;
    let mut sight = Sight::new(view, mesh, device, Lattice::centres(view, 0), tile);
    sight.see();
    sight
}

/// What a frame is made from.
struct FramePainter<'a> {
    prepared: &'a Prepare<'a>,
    view: &'a ViewFrame,
    painter: PixelPainter<'a>,
    maker: TileMaker<'a>,
    region: ClipRegion,
}

/// Where a row of pixels reads the texture.
#[derive(Default)]
struct RowReadings {
    /// Its pixels.
    readings: Vec<Option<Reading>>,
    /// Their tiles, each once, in order.
    keys: Vec<TileKey>,
    /// Pixels that read a coarser level than they ask for.
    fallbacks: u64,
}

/// A row of finished pixels.
struct Row {
    pixels: Pixels,
    levels: Kept<f64>,
    tiles: Kept<TileKey>,
    texels: Kept<u32>,
    texels_read: u64,
}

/// A tile that a frame has touched.
struct Made {
    key: TileKey,
    counts: TileCounts,
    /// The tile, where its texels are to be looked at.
    tile: Option<Arc<Tile>>,
}

/// Pixels whose [`Reading`]s are in memory together, unless a row has more.
const PIXELS_AT_A_TIME: usize = 1 << 20;

/// Tiles a row of the picture of all tiles.
const TILES_A_ROW: usize = 16;

/// The most tiles in a picture of all tiles: 1 GiB while they are held.
const MOST_SHOWN: usize = 1024;

impl<'a> FramePainter<'a> {
    fn new(prepared: &'a Prepare, (mesh, view): (&'a Mesh, &'a ViewFrame), sight: Sight<'a>) -> Self {
        let (scene, settings) = (&prepared.stage.scene, prepared.settings);
        let nearest = nearest(&sight, view);
        let center = match settings.center {
            Some([x, y]) => Plan::new(x - scene.origin.x, y - scene.origin.y),
            None => nearest.map_or_else(Plan::default, |hit| hit.plan),
        };
        let region = ClipRegion::new(&prepared.texture, center, settings.clip_size);
        let middle = sight.hit(view.width() / 2, view.height() / 2).or(nearest);
        Self {
            prepared,
            view,
            painter: PixelPainter {
                mesh,
                view,
                texture: prepared.texture,
                sampler: Sampler::new(prepared.texture, &region, &settings, &scene.device),
                backdrop: Backdrop::of(scene, mesh),
                sight,
            },
            maker: prepared.maker(middle.map_or(1.0, |hit| view.pixel_m(hit.world))),
            region,
        }
    }

    fn frame(&self, options: &FrameOptions) -> Result<(Frame, CacheCounts)> {
        let budget = self.prepared.budget();
        let mut cache = self.prepared.take_cache();
        cache.prepare(self.maker.followed_pixel_m(), &self.region);
        let (mut cached, mut rows, mut made) = (CacheCounts::default(), Vec::new(), Vec::new());
        let mut fallbacks = 0;
        let (width, height) = (self.view.width(), self.view.height());
        let band = (PIXELS_AT_A_TIME / width).max(1);
        for first in (0..height).step_by(band) {
            let readings = parallel::map_indices(band.min(height - first), |k| self.readings(first + k));
            fallbacks += readings.iter().map(|row| row.fallbacks).sum::<u64>();
            for pass in passes(&readings, budget / self.prepared.settings.tile_bytes()) {
                let readings = &readings[pass.clone()];
                let keys = union(readings);
                let tell = |share: f64| {
                    let before = (first + pass.start) as f64 + 0.8 * share * pass.len() as f64;
                    (options.progress)(0.2 + 0.8 * before / height as f64);
                };
                let make = |missing: &[TileKey]| self.make(missing, &tell);
                let tiles = cache.tiles(&keys, budget, &mut cached, make);
                // Without a use for its texels, the cache may give a tile up; no more are shown than fit.
                let is_kept = options.wants("tiles");
                made.extend(keys.iter().zip(&tiles).map(|(key, tile)| Made {
                    key: *key,
                    counts: tile.counts,
                    tile: is_kept.then(|| Arc::clone(tile)),
                }));
                if is_kept {
                    made.sort_by_key(|tile| tile.key);
                    made.dedup_by_key(|tile| tile.key);
                    made.iter_mut().skip(MOST_SHOWN).for_each(|tile| tile.tile = None);
                }
                let table = Table::new(&keys, tiles, self.prepared.texture.levels());
                rows.extend(parallel::map(readings, |row| self.row(row, &table, options)));
            }
        }
        self.prepared.return_cache(cache);
        made.sort_by_key(|tile| tile.key);
        made.dedup_by_key(|tile| tile.key);
        Ok((self.finish(&rows, &made, fallbacks, options)?, cached))
    }

    fn make(&self, keys: &[TileKey], tell: &(dyn Fn(f64) + Sync)) -> Vec<Tile> {
        let progress = Progress::new(keys.len(), tell);
        let make = |bench: &mut Option<Workbench>, key: &TileKey| {
            let tile = self.maker.make_on(*key, bench);
            progress.step();
            tile
        };
        parallel::map_with(keys, || None, make)
    }

    /// Where a row of pixels reads the texture.
    fn readings(&self, y: usize) -> RowReadings {
        let width = self.view.width();
        let mut points = vec![Plan::default(); width];
        self.painter.sight.plan_of_row(y, &mut points, &mut Planes::default());
        let mut row = RowReadings { readings: Vec::with_capacity(width), ..RowReadings::default() };
        // Neighbours often touch the same tiles.
        let (mut plane, mut last) = (None, [NO_TILE; 4]);
        for (x, plan) in points.into_iter().enumerate() {
            let reading = self.painter.reading((x, y), plan, &mut plane, &mut ());
            if let Some(reading) = &reading {
                let visit = |key| {
                    if !last.contains(&key) {
                        row.keys.push(key);
                        last = [key, last[0], last[1], last[2]];
                    }
                };
                let is_coarser = self.painter.tiles(reading, visit, &mut ());
                row.fallbacks += u64::from(is_coarser);
            }
            row.readings.push(reading);
        }
        row.keys.sort_unstable();
        row.keys.dedup();
        row
    }

    fn row(&self, row: &RowReadings, table: &Table, options: &FrameOptions) -> Row {
        let backdrop = &self.painter.backdrop;
        let mut done = Row {
            pixels: Pixels::new(backdrop.compositor, row.readings.len(), options.wants("color")),
            levels: Kept::new(options.wants("level")),
            tiles: Kept::new(options.wants("tile")),
            texels: Kept::new(options.wants("texels")),
            texels_read: 0,
        };
        let mut last = backdrop.no_ground();
        for reading in &row.readings {
            let (paint, texels) = match reading {
                Some(reading) => self.painter.paint(reading, table, &mut last, &mut ()),
                None => (backdrop.sky, 0),
            };
            done.pixels.push(paint);
            done.texels_read += u64::from(texels);
            done.texels.push(|| texels);
            done.levels.push(|| reading.map_or(f64::INFINITY, |reading| reading.probes.level));
            let shown = |reading: &Reading| self.painter.shown_tile(reading, table);
            done.tiles.push(|| reading.as_ref().map_or(NO_TILE, shown));
        }
        done
    }

    fn finish(&self, rows: &[Row], made: &[Made], fallbacks: u64, options: &FrameOptions) -> Result<Frame> {
        let planes = options.buffers.iter().filter_map(|name| self.plane(name, rows, made).transpose());
        let codes = joined(rows.iter().map(|row| row.pixels.codes()));
        Ok(Frame {
            image: Buffer::from_values(self.view.width(), self.view.height(), codes),
            planes: planes.collect::<Result<_>>()?,
            counts: self.counts(rows, made, fallbacks),
        })
    }

    fn counts(&self, rows: &[Row], made: &[Made], fallbacks: u64) -> Vec<(&'static str, u64)> {
        let drawn = made.iter().fold(TileCounts::default(), |sum, tile| sum.plus(tile.counts));
        let levels = made.iter().map(|tile| tile.key.level);
        let own = [
            ("tiles", made.len() as u64),
            ("finest_level", u64::from(levels.clone().min().unwrap_or(0))),
            ("coarsest_level", u64::from(levels.max().unwrap_or(0))),
            ("texels_read", rows.iter().map(|row| row.texels_read).sum()),
            ("fallbacks", fallbacks),
            ("line_primitives", drawn.lines),
            ("wide_items", drawn.wide_items),
            ("quads", drawn.quads),
            ("areas", drawn.areas),
            ("geometry_bytes", self.prepared.geometry.bytes() as u64),
        ];
        own.into_iter().chain(sight_counts(&self.painter.sight.counts())).collect()
    }

    fn plane(&self, name: &str, rows: &[Row], made: &[Made]) -> Result<Option<Plane>> {
        let size = [self.view.width(), self.view.height()];
        Ok(Some(match name {
            "vertices" => self.prepared.sequences(self.maker.pixel_m)?.vertices_plane(),
            "strips" => self.prepared.sequences(self.maker.pixel_m)?.strips_plane(),
            "level" => {
                let levels = joined(rows.iter().map(|row| row.levels.values()));
                picture_plane("level", size, 1, Values::F64(levels))
            }
            "tile" => {
                let number = |key: &TileKey| made.binary_search_by_key(key, |tile| tile.key);
                let tiles = rows.iter().flat_map(|row| row.tiles.values());
                let numbers = tiles.map(|key| number(key).map_or(u32::MAX, |at| at as u32));
                picture_plane("tile", size, 1, Values::U32(numbers.collect()))
            }
            "texels" => {
                let texels = joined(rows.iter().map(|row| row.texels.values()));
                picture_plane("texels", size, 1, Values::U32(texels))
            }
            "tile-keys" => {
                let keys = made.iter().flat_map(|Made { key, .. }| [key.level, key.column, key.row]);
                picture_plane("tile-keys", [3, made.len()], 1, Values::U32(keys.collect()))
            }
            "tiles" => self.tiles_plane(made),
            "color" => {
                let colors = joined(rows.iter().map(|row| row.pixels.colors().as_flattened()));
                picture_plane("color", size, 4, Values::F64(colors))
            }
            _ => return Ok(surface_plane(name, &self.painter.sight, 0)),
        }))
    }

    /// All tiles beside and below one another, in the order of their keys.
    fn tiles_plane(&self, made: &[Made]) -> Plane {
        let compositor = &self.painter.backdrop.compositor;
        let made = &made[..made.len().min(MOST_SHOWN)];
        let columns = made.len().clamp(1, TILES_A_ROW);
        let (width, height) = (columns * TILE, made.len().div_ceil(columns) * TILE);
        let mut values = vec![0; width * height * 4];
        for (k, tile) in made.iter().enumerate().filter_map(|(k, made)| Some((k, made.tile.as_ref()?))) {
            let (x, y) = (k % columns * TILE, k / columns * TILE);
            for row in 0..tile.size {
                for column in 0..tile.size {
                    let texel = Paint(tile.at(column, row).map(f64::from));
                    let code = code_values(compositor.encoded(texel));
                    values[((y + row) * width + x + column) * 4..][..4].copy_from_slice(&code);
                }
            }
        }
        picture_plane("tiles", [width, height], 4, Values::U8(values))
    }
}

/// The surface point that is nearest to the eye's plane, of equals the first.
fn nearest(sight: &Sight, view: &ViewFrame) -> Option<Hit> {
    let nearer = |best: Option<(f64, [usize; 2])>, (depth, at): (f64, [usize; 2])| match best {
        Some(best) if best.0 <= depth => Some(best),
        _ => Some((depth, at)),
    };
    let lattice = *sight.lattice();
    let rows = parallel::map_indices(lattice.rows, |row| {
        let mut points = vec![World::default(); lattice.columns];
        sight.world_of_row((0, row), &mut points, &mut Planes::default());
        let points = points.into_iter().enumerate().filter(|(_, at)| at.is_finite());
        points.map(|(column, at)| (view.depth(at), [column, row])).fold(None, nearer)
    });
    let (_, [column, row]) = rows.into_iter().flatten().fold(None, nearer)?;
    sight.hit(column, row)
}

/// The tiles of some rows, each once, in order.
fn union(rows: &[RowReadings]) -> Vec<TileKey> {
    let mut keys: Vec<TileKey> = rows.iter().flat_map(|row| row.keys.iter().copied()).collect();
    keys.sort_unstable();
    keys.dedup();
    keys
}

/// Rows of pixels that are coloured together: as many as touch no more than so many tiles, at least one.
fn passes(rows: &[RowReadings], tiles: usize) -> Vec<std::ops::Range<usize>> {
    let mut passes = Vec::new();
    let (mut start, mut keys): (usize, Vec<TileKey>) = (0, Vec::new());
    for (y, row) in rows.iter().enumerate() {
        let mut with_row = [&keys[..], &row.keys].concat();
        with_row.sort_unstable();
        with_row.dedup();
        if with_row.len() > tiles && y > start {
            passes.push(start..y);
            (start, with_row) = (y, row.keys.clone());
        }
        keys = with_row;
    }
    passes.push(start..rows.len());
    passes
}
