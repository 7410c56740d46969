//! A frame: which tiles its pixels touch, those tiles, their colours.

use super::cache::CacheCounts;
use super::prepare::Prepare;
use super::sampling::{Probes, Quad, Sampler};
use super::texture::{ClipRegion, TILE, TileKey};
use super::tile::{Tile, TileCounts, TileMaker, Workbench};
use crate::buffer::{Buffer, Plane, Values};
use crate::error::Result;
use crate::parallel;
use crate::raster::Lattice;
use crate::resolve::{Compositor, GroundPaint, Paint, code_values};
use crate::space::{Plan, ViewFrame, World};
use crate::technique::{Frame, FrameOptions};
use crate::terrain::SKY;
use crate::visibility::{FootprintPlane, Hit, Sight};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Draws a frame of a view; says what the cache did.
///
/// # Errors
/// Internal errors only.
pub(super) fn draw(
    prepared: &Prepare,
    view: &ViewFrame,
    options: &FrameOptions,
) -> Result<(Frame, CacheCounts)> {
    let stage = prepared.stage;
    let lattice = Lattice::centres(view, 0);
    let mut sight = Sight::new(view, &stage.mesh, &stage.scene.device, lattice, options.tile);
    sight.see();
    (options.progress)(0.2);
    let drawing = Drawing::new(prepared, view, sight, options);
    drawing.frame(options)
}

/// Everything that pixels are made from.
struct Drawing<'a> {
    prepared: &'a Prepare<'a>,
    view: &'a ViewFrame,
    sight: Sight<'a>,
    sampler: Sampler,
    maker: TileMaker<'a>,
    region: ClipRegion,
    compositor: Compositor,
    ground: GroundPaint<'a>,
    sky: Paint,
    wants: Wanted,
}

/// The tiles at hand while pixels are coloured, by level, row and column.
struct Table {
    levels: Vec<LevelTiles>,
}

/// A rectangle of a level's tiles, with gaps.
#[derive(Clone, Default)]
struct LevelTiles {
    west: u32,
    north: u32,
    columns: u32,
    tiles: Vec<Option<Arc<Tile>>>,
}

/// What a row of pixels sees, and asks of the texture.
#[derive(Default)]
struct Seen {
    /// Its pixels.
    looks: Vec<Option<Look>>,
    /// Their tiles, each once, in order.
    keys: Vec<TileKey>,
    /// Pixels that read a coarser level than they ask for.
    fallbacks: u64,
}

/// What a pixel sees, and where it reads the texture.
#[derive(Clone, Copy)]
struct Look {
    triangle: u32,
    plan: Plan,
    probes: Probes,
}

/// A row of finished pixels.
#[derive(Default)]
struct Row {
    image: Vec<[u8; 4]>,
    colors: Vec<f64>,
    levels: Vec<f64>,
    tiles: Vec<TileKey>,
    texels: Vec<u32>,
    texels_read: u64,
}

/// A tile that a frame has touched.
struct Made {
    key: TileKey,
    counts: TileCounts,
    /// The tile, where its texels are to be looked at.
    tile: Option<Arc<Tile>>,
}

/// Which buffers are kept on the way because someone asked for them.
struct Wanted {
    colors: bool,
    levels: bool,
    tile: bool,
    texels: bool,
    tiles: bool,
}

/// Pixels whose [`Look`]s are in memory together, unless a row has more.
const PIXELS_AT_A_TIME: usize = 1 << 20;

/// A tile that no pixel has.
const NO_TILE: TileKey = TileKey { level: u32::MAX, row: 0, column: 0 };

/// Tiles a row of the picture of all tiles.
const TILES_A_ROW: usize = 16;

/// The most tiles in a picture of all tiles: 1 GiB while they are held.
const MOST_SHOWN: usize = 1024;

impl Wanted {
    fn of(options: &FrameOptions) -> Self {
        let is_wanted = |wanted: &str| options.buffers.iter().any(|name| name == wanted);
        Self {
            colors: is_wanted("color"),
            levels: is_wanted("level"),
            tile: is_wanted("tile"),
            texels: is_wanted("texels"),
            tiles: is_wanted("tiles"),
        }
    }
}

impl Table {
    fn new(keys: &[TileKey], tiles: Vec<Arc<Tile>>, levels: u32) -> Self {
        let mut table = Self { levels: vec![LevelTiles::default(); levels as usize] };
        let mut tiles = keys.iter().zip(tiles).peekable();
        for of_level in keys.chunk_by(|a, b| a.level == b.level) {
            let range = |of: fn(&TileKey) -> u32| {
                let values = || of_level.iter().map(of);
                (values().min().unwrap_or(0), values().max().unwrap_or(0))
            };
            let ((west, east), (north, south)) = (range(|key| key.column), range(|key| key.row));
            let columns = east - west + 1;
            let mut found = vec![None; (columns * (south - north + 1)) as usize];
            for (key, tile) in tiles.by_ref().take(of_level.len()) {
                found[((key.row - north) * columns + key.column - west) as usize] = Some(tile);
            }
            table.levels[of_level[0].level as usize] = LevelTiles { west, north, columns, tiles: found };
        }
        table
    }

    #[inline]
    fn get(&self, key: TileKey) -> Option<&Tile> {
        let level = self.levels.get(key.level as usize)?;
        let column = key.column.checked_sub(level.west).filter(|column| *column < level.columns)?;
        let row = key.row.checked_sub(level.north)?;
        level.tiles.get((row * level.columns + column) as usize)?.as_deref()
    }
}

impl<'a> Drawing<'a> {
    fn new(prepared: &'a Prepare, view: &'a ViewFrame, sight: Sight<'a>, options: &FrameOptions) -> Self {
        let stage = prepared.stage;
        let (scene, settings) = (&stage.scene, prepared.settings);
        let nearest = nearest(&sight, view);
        let center = match settings.center {
            Some([x, y]) => Plan::new(x - scene.origin.x, y - scene.origin.y),
            None => nearest.map_or_else(Plan::default, World::plan),
        };
        let region = ClipRegion::new(&prepared.texture, center, settings.clip_size);
        let middle = sight.hit(view.width() / 2, view.height() / 2);
        let middle = middle.map(|Hit { plan, height, .. }| World::new(plan.x, plan.y, height)).or(nearest);
        let compositor = Compositor::new(scene.compositing);
        Self {
            prepared,
            view,
            sampler: Sampler::new(prepared.texture, &region, &settings, &scene.device),
            maker: prepared.maker(middle.map_or(1.0, |at| view.pixel_m(at))),
            region,
            compositor,
            ground: GroundPaint::new(&scene.ground, &stage.mesh, compositor),
            sky: compositor.paint(scene.image.background),
            wants: Wanted::of(options),
            sight,
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
            let seen = parallel::map_indices(band.min(height - first), |k| self.seen(first + k));
            fallbacks += seen.iter().map(|row| row.fallbacks).sum::<u64>();
            for pass in passes(&seen, budget / self.prepared.settings.tile_bytes()) {
                let seen = &seen[pass.clone()];
                let keys = union(seen);
                let done = AtomicUsize::new(0);
                let tiles = cache.tiles(&keys, budget, &mut cached, |missing| {
                    self.make(missing, &|| {
                        let share = done.fetch_add(1, Ordering::Relaxed) as f64 / missing.len() as f64;
                        let before = (first + pass.start) as f64 + 0.8 * share * pass.len() as f64;
                        (options.progress)(0.2 + 0.8 * before / height as f64);
                    })
                });
                // Without a use for its texels, the cache may give a tile up; no more are shown than fit.
                let is_kept = self.wants.tiles;
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
                rows.extend(parallel::map(seen, |row| self.row(row, &table)));
            }
        }
        self.prepared.return_cache(cache);
        made.sort_by_key(|tile| tile.key);
        made.dedup_by_key(|tile| tile.key);
        Ok((self.finish(rows, &made, fallbacks, options)?, cached))
    }

    fn make(&self, keys: &[TileKey], done: &(dyn Fn() + Sync)) -> Vec<Tile> {
        let make = |bench: &mut Option<Workbench>, key: &TileKey| {
            let tile = self.maker.make_on(*key, bench);
            done();
            tile
        };
        parallel::map_with(keys, || None, make)
    }

    /// What a row of pixels sees and asks for.
    fn seen(&self, y: usize) -> Seen {
        let width = self.view.width();
        let mut points = vec![Plan::default(); width];
        self.sight.plan_of_row(y, &mut points);
        let mut seen = Seen { looks: Vec::with_capacity(width), ..Seen::default() };
        // Neighbours often see the same triangle, and touch the same tiles.
        let mut plane = None;
        let mut last = [NO_TILE; 4];
        for (x, plan) in points.into_iter().enumerate() {
            let triangle = self.sight.triangle(x, y);
            if triangle == SKY || !plan.is_finite() {
                seen.looks.push(None);
                continue;
            }
            if plane.as_ref().is_none_or(|(of, _)| *of != triangle) {
                let corners = self.prepared.stage.mesh.triangle(triangle);
                plane = Some((triangle, corners.map(|corners| FootprintPlane::new(self.view, &corners))));
            }
            let at = self.sight.lattice().at(x, y);
            let footprint = plane.as_ref().and_then(|(_, plane)| plane.as_ref()?.footprint(at));
            let probes = self.sampler.probes(plan, footprint.as_ref());
            let mut is_coarser = false;
            self.sampler.quads(&probes, &mut |quad| {
                is_coarser |= quad.is_fallback;
                let tiles = self.sampler.tiles_of(&quad);
                for row in tiles.rows.0..=tiles.rows.1 {
                    for column in tiles.columns.0..=tiles.columns.1 {
                        let key = TileKey { level: quad.level, row, column };
                        if !last.contains(&key) {
                            seen.keys.push(key);
                            last = [key, last[0], last[1], last[2]];
                        }
                    }
                }
            });
            seen.fallbacks += u64::from(is_coarser);
            seen.looks.push(Some(Look { triangle, plan, probes }));
        }
        seen.keys.sort_unstable();
        seen.keys.dedup();
        seen
    }

    fn row(&self, seen: &Seen, table: &Table) -> Row {
        let mut row = Row::default();
        row.image.reserve(seen.looks.len());
        let mut last = (self.sky, code_values(self.compositor.encoded(self.sky)));
        for look in &seen.looks {
            let (mut paint, mut texels) = (self.sky, 0);
            if let Some(Look { triangle, plan, probes }) = look {
                let texture = self.texture_at(probes, table, &mut texels);
                paint = self.compositor.over(self.ground.at(*triangle, *plan), texture);
            }
            if paint != last.0 {
                last = (paint, code_values(self.compositor.encoded(paint)));
            }
            row.image.push(last.1);
            row.texels_read += u64::from(texels);
            if self.wants.texels {
                row.texels.push(texels);
            }
            if self.wants.levels {
                row.levels.push(look.map_or(f64::INFINITY, |look| look.probes.level));
            }
            if self.wants.tile {
                row.tiles.push(look.map_or(NO_TILE, |look| self.shown_tile(&look, table)));
            }
            if self.wants.colors {
                row.colors.extend(self.compositor.encoded(paint));
            }
        }
        row
    }

    /// The finest tile that a pixel reads at its centre.
    fn shown_tile(&self, look: &Look, table: &Table) -> TileKey {
        let mut finest: Option<Quad> = None;
        self.sampler.quads(&look.probes, &mut |quad| {
            finest = Some(finest.filter(|known| known.level <= quad.level).unwrap_or(quad));
        });
        let finest = finest.map_or(0, |quad| quad.level);
        let tile_of = |level: u32| {
            let texel = self.prepared.texture.texel(level, look.plan);
            self.sampler.tile_of(level, texel.x.floor() as i64, texel.y.floor() as i64).0
        };
        // Where only probes aside read the finest level, the middle's tile is coarser.
        let levels = finest..self.prepared.texture.levels();
        levels.map(tile_of).find(|key| table.get(*key).is_some()).unwrap_or(NO_TILE)
    }

    /// The texture's paint where a pixel reads it.
    fn texture_at(&self, probes: &Probes, table: &Table, texels: &mut u32) -> Paint {
        let mut sum = [0.0; 4];
        let mut add = |texel: [f32; 4], weight: f64| {
            for k in 0..4 {
                sum[k] += weight * f64::from(texel[k]);
            }
        };
        self.sampler.quads(probes, &mut |Quad { level, at: (column, row), shares, weight, .. }| {
            let (key, (c, r)) = self.sampler.tile_of(level, column, row);
            let Some((east, south)) = shares else {
                *texels += 1;
                table.get(key).into_iter().for_each(|tile| add(tile.at(c, r), weight));
                return;
            };
            *texels += 4;
            let weights = [
                weight * (1.0 - east) * (1.0 - south),
                weight * east * (1.0 - south),
                weight * (1.0 - east) * south,
                weight * east * south,
            ];
            // Mostly all four lie in one tile, away from the texture's rim.
            if column >= 0
                && row >= 0
                && let Some(tile) = table.get(key)
                && c + 1 < tile.size
                && r + 1 < tile.size
            {
                let places = [(c, r), (c + 1, r), (c, r + 1), (c + 1, r + 1)];
                places.into_iter().zip(weights).for_each(|((c, r), weight)| add(tile.at(c, r), weight));
                return;
            }
            for ((dx, dy), weight) in [(0, 0), (1, 0), (0, 1), (1, 1)].into_iter().zip(weights) {
                let (key, (c, r)) = self.sampler.tile_of(level, column + dx, row + dy);
                table.get(key).into_iter().for_each(|tile| add(tile.at(c, r), weight));
            }
        });
        Paint(sum)
    }

    fn finish(&self, rows: Vec<Row>, made: &[Made], fallbacks: u64, options: &FrameOptions) -> Result<Frame> {
        let (width, height) = (self.view.width(), self.view.height());
        let planes: Result<Vec<Option<Plane>>> =
            options.buffers.iter().map(|name| self.plane(name, &rows, made)).collect();
        let counts = self.counts(&rows, made, fallbacks);
        let image = rows.into_iter().flat_map(|row| row.image).collect();
        let planes = planes?.into_iter().flatten().collect();
        Ok(Frame { image: Buffer::from_values(width, height, image), planes, counts })
    }

    fn counts(&self, rows: &[Row], made: &[Made], fallbacks: u64) -> Vec<(&'static str, u64)> {
        let drawn = made.iter().fold(TileCounts::default(), |sum, tile| sum.plus(tile.counts));
        let texels = rows.iter().map(|row| row.texels_read).sum();
        let seen = self.sight.counts();
        let levels = made.iter().map(|tile| tile.key.level);
        vec![
            ("tiles", made.len() as u64),
            ("finest_level", u64::from(levels.clone().min().unwrap_or(0))),
            ("coarsest_level", u64::from(levels.max().unwrap_or(0))),
            ("texels_read", texels),
            ("fallbacks", fallbacks),
            ("line_primitives", drawn.lines),
            ("wide_items", drawn.wide_items),
            ("quads", drawn.quads),
            ("areas", drawn.areas),
            ("geometry_bytes", self.prepared.geometry.bytes() as u64),
            ("triangles_drawn", seen.triangles),
            ("exact_decisions", seen.exact_decisions),
        ]
    }

    fn plane(&self, name: &str, rows: &[Row], made: &[Made]) -> Result<Option<Plane>> {
        let (width, height) = (self.view.width(), self.view.height());
        let of_pixels = |name, components, values| Plane { name, width, height, components, values };
        Ok(Some(match name {
            "vertices" => self.prepared.sequences(self.maker.pixel_m)?.vertices_plane(),
            "strips" => self.prepared.sequences(self.maker.pixel_m)?.strips_plane(),
            "triangle" => of_pixels("triangle", 1, Values::U32(self.sight.triangles().to_vec())),
            "depth" => of_pixels("depth", 1, Values::F64(self.of_hits(|hit| [hit.depth]))),
            "plan" => of_pixels("plan", 2, Values::F64(self.of_hits(|hit| [hit.plan.x, hit.plan.y]))),
            "level" => {
                let levels = rows.iter().flat_map(|row| row.levels.iter().copied()).collect();
                of_pixels("level", 1, Values::F64(levels))
            }
            "tile" => {
                let number = |key: &TileKey| made.binary_search_by_key(key, |tile| tile.key);
                let tiles = rows.iter().flat_map(|row| &row.tiles);
                let numbers = tiles.map(|key| number(key).map_or(u32::MAX, |at| at as u32)).collect();
                of_pixels("tile", 1, Values::U32(numbers))
            }
            "texels" => {
                let texels = rows.iter().flat_map(|row| row.texels.iter().copied()).collect();
                of_pixels("texels", 1, Values::U32(texels))
            }
            "tile-keys" => {
                let keys =
                    made.iter().flat_map(|Made { key, .. }| [key.level, key.column, key.row]).collect();
                Plane {
                    name: "tile-keys",
                    width: 3,
                    height: made.len(),
                    components: 1,
                    values: Values::U32(keys),
                }
            }
            "tiles" => self.tiles_plane(made),
            "color" => {
                let colors = rows.iter().flat_map(|row| row.colors.iter().copied()).collect();
                of_pixels("color", 4, Values::F64(colors))
            }
            _ => return Ok(None),
        }))
    }

    /// All tiles beside and below one another, in the order of their keys.
    fn tiles_plane(&self, made: &[Made]) -> Plane {
        let made = &made[..made.len().min(MOST_SHOWN)];
        let columns = made.len().clamp(1, TILES_A_ROW);
        let (width, height) = (columns * TILE, made.len().div_ceil(columns) * TILE);
        let mut values = vec![0; width * height * 4];
        for (k, tile) in made.iter().enumerate().filter_map(|(k, made)| Some((k, made.tile.as_ref()?))) {
            let (x, y) = (k % columns * TILE, k / columns * TILE);
            for row in 0..tile.size {
                for column in 0..tile.size {
                    let texel = Paint(tile.at(column, row).map(f64::from));
                    let code = code_values(self.compositor.encoded(texel));
                    values[((y + row) * width + x + column) * 4..][..4].copy_from_slice(&code);
                }
            }
        }
        Plane { name: "tiles", width, height, components: 4, values: Values::U8(values) }
    }

    fn of_hits<const N: usize>(&self, f: impl Fn(Hit) -> [f64; N] + Sync) -> Vec<f64> {
        let rows = parallel::map_indices(self.view.height(), |y| {
            let hits = (0..self.view.width()).map(|x| self.sight.hit(x, y));
            hits.flat_map(|hit| hit.map_or([f64::INFINITY; N], &f)).collect::<Vec<_>>()
        });
        rows.concat()
    }
}

/// The surface point that is nearest to the eye's plane, of equals the first.
fn nearest(sight: &Sight, view: &ViewFrame) -> Option<World> {
    let nearer = |best: Option<(f64, World)>, (depth, at): (f64, World)| match best {
        Some(best) if best.0 <= depth => Some(best),
        _ => Some((depth, at)),
    };
    let lattice = *sight.lattice();
    let rows = parallel::map_indices(lattice.rows, |row| {
        let mut points = vec![World::default(); lattice.columns];
        sight.world_of_row((0, row), &mut points);
        let points = points.into_iter().filter(|at| at.is_finite());
        points.map(|at| (view.depth(at), at)).fold(None, nearer)
    });
    rows.into_iter().flatten().fold(None, nearer).map(|(_, at)| at)
}

/// The tiles of some rows, each once, in order.
fn union(seen: &[Seen]) -> Vec<TileKey> {
    let mut keys: Vec<TileKey> = seen.iter().flat_map(|row| row.keys.iter().copied()).collect();
    keys.sort_unstable();
    keys.dedup();
    keys
}

/// Rows of pixels that are coloured together: as many as touch no more than so many tiles, at least one.
fn passes(seen: &[Seen], tiles: usize) -> Vec<std::ops::Range<usize>> {
    let mut passes = Vec::new();
    let (mut start, mut keys): (usize, Vec<TileKey>) = (0, Vec::new());
    for (y, row) in seen.iter().enumerate() {
        let mut with_row = [&keys[..], &row.keys].concat();
        with_row.sort_unstable();
        with_row.dedup();
        if with_row.len() > tiles && y > start {
            passes.push(start..y);
            (start, with_row) = (y, row.keys.clone());
        }
        keys = with_row;
    }
    passes.push(start..seen.len());
    passes
}
