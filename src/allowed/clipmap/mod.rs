//! Clipmap texture (Taibo et al. 2014): a pixel is a mean of texels around its centre's plan point, over the ground.
//!
//! What may differ from machine to machine: where vertices lie in a level's texels (snapped, in single precision), hence which texels strips and areas
//! cover and how much of a texel a line does; where a pixel's centre lies in the plan; the level, the weights between texels and between levels, as filters
//! round them. Texels hold all paints that they may have (`texels`, `draw`), pixels read them wherever they may (`surface`, `reading`).
//!
//! ```text
//!   texture.rs  levels, tiles, what is at hand
//!   items.rs    what tiles are drawn from
//!   edges.rs    borders of what is drawn, without those inside
//!   count.rs    texels' centres: covered so often at least and at most
//!   share.rs    areas of texels
//!   lines.rs    line primitives
//!   texels.rs   what paints a texel may have
//!   draw.rs     a tile
//!   surface.rs  where a pixel reads, and its footprint
//!   reader.rs   probes and levels, and the texels that they may reach
//!   reading.rs  what it may find there
//! ```
//!
//! Refuses: `polygons = "tiny-skia"`, whose coverage is that of one program.

mod count;
mod draw;
mod edges;
mod items;
mod lines;
mod reader;
mod reading;
mod share;
mod surface;
mod texels;
mod texture;

use super::model::{Guess, View};
use super::picture;
use super::pixel::{BLEND, PixelRange, widened};
use super::stages::{Seen, stages};
use crate::buffer::Buffer;
use crate::certainty::{PaintMean, PaintRange};
use crate::compare::{FeatureRun, Hypothesis, Stage, StageRange};
use crate::draw_list::DrawList;
use crate::error::{Error, Result};
use crate::footprint::Strokes;
use crate::math;
use crate::parallel;
use crate::resolve::Compositor;
use crate::space::{PlanBox, Screen};
use crate::technique::clipmap::{PolygonRaster, Settings};
use crate::terrain::{Mesh, SKY};
use crate::truth::{Outcome, Probe, Sample, probe};
use draw::TileMaker;
use items::Items;
use reader::{Reader, Tiles};
use surface::{Look, Stray};
use texture::{Key, Texture, Window};

/// Rows of pixels whose tiles are in memory together.
const BAND: usize = 64;

/// A pixel of more possible readings than this has no list of them.
const MOST_CHOICES: usize = 8;

/// What a pixel's centre sees, before the texture is read.
#[derive(Debug, Clone, Default)]
struct Sight {
    looks: Vec<Look>,
    /// The sky's paint where it may be seen.
    sky: Option<PaintRange>,
    /// It may see a triangle edge-on.
    is_any: bool,
    seen: Seen,
    /// The least and the largest view depth; where the terrain is in the plan.
    depth: (f64, f64),
    plan: Option<PlanBox>,
}

/// The picture by one guess.
///
/// # Errors
/// When nobody knows what may be of a setting, or lines cannot be tessellated.
pub(super) fn picture(view: &View, guess: &Guess) -> Result<(Hypothesis, Vec<Stage>, Vec<FeatureRun>)> {
    let (scene, frame) = (&view.stage.scene, view.frame);
    let settings: Settings = scene.technique.get();
    if settings.polygons == PolygonRaster::TinySkia {
        return Err(Error::unsupported("nobody knows what polygons of another machine's tiny-skia may be")
            .help("set `technique.clipmap.polygons` to \"aliased\" or \"exact\""));
    }
    let mesh = &*view.stage.mesh_for(frame);
    let texture = Texture::over(&view.stage.mesh.plan_bounds(), settings.virtual_size);
    let sights = sights(view, guess, mesh, &texture);
    let middle = match settings.center {
        Some([x, y]) => PlanBox::around([crate::space::Plan::new(x - scene.origin.x, y - scene.origin.y)]),
        None => nearest(&sights),
    };
    let windows: Vec<Window> =
        (0..texture.levels()).map(|level| Window::of(&texture, level, &middle, settings.clip_size)).collect();
    let extent = texture.bounds((texture.levels() - 1, 0, 0));
    let extent = extent.min.to_vec().abs().max(extent.max.to_vec().abs()).max_element();
    let maker = TileMaker {
        items: Items::new(&view.stage.draw_list, scene, settings, pixel_m(view, mesh, &sights))?,
        texture,
        settings,
        mode: scene.compositing.mode,
        snap: 0.5 / f64::from(1u32 << guess.envelope.subpixel_bits),
        widest: scene.device.max_line_width_px,
        extent,
    };
    let reader = Reader {
        texture: &texture,
        windows: &windows,
        settings: &settings,
        mode: scene.compositing.mode,
        filter_bits: guess.envelope.filter_bits,
    };
    let ranges = pixels(view, &reader, &maker, &sights);
    let (width, height) = (sights.width(), sights.height());
    let seen = sights.values().iter().map(|sight| sight.seen.clone()).collect();
    let mut all = stages(&Buffer::from_values(width, height, seen));
    all.push(levels(&reader, &sights));
    Ok((
        picture::hypothesis(guess.name.clone(), &ranges),
        all,
        picture::feature_runs(&ranges, &view.stage.draw_list),
    ))
}

/// What pixels' centres may see.
fn sights(view: &View, guess: &Guess, mesh: &Mesh, texture: &Texture) -> Buffer<Sight> {
    let frame = view.frame;
    let along = |depth: f64| guess.envelope.along(frame, depth);
    let shift = guess.envelope.shift();
    let stray = Stray { shift, along: &along };
    let look = |[x, y]: [usize; 2], outcome: &Outcome| {
        let triangle = mesh.surface_triangle(outcome.triangle)?;
        let centre = Screen::new(x as f64 + 0.5, y as f64 + 0.5);
        let at = (centre, &outcome.plan, outcome.paint);
        Look::of(frame, texture, (outcome.triangle, &triangle), at, &stray)
    };
    let judge = |pixel: [usize; 2], samples: &[Sample]| {
        let mut sight = Sight { seen: Seen::of(&samples[0], &along), ..Sight::default() };
        sight.depth = (f64::INFINITY, f64::NEG_INFINITY);
        for outcome in &samples[0].outcomes {
            sight.depth.0 = math::min(sight.depth.0, outcome.depth.0);
            sight.depth.1 = math::max(sight.depth.1, outcome.depth.1);
            if outcome.triangle == SKY {
                sight.sky = Some(sight.sky.map_or(outcome.paint, |sky| sky.hull(&outcome.paint)));
                continue;
            }
            sight.plan.get_or_insert(PlanBox::EMPTY).include_box(&outcome.plan);
            match look(pixel, outcome) {
                Some(look) => sight.looks.push(look),
                None => sight.is_any = true,
            }
        }
        sight
    };
    let nothing = DrawList::default();
    let of = Probe {
        list: &nothing,
        strokes: Strokes::Style,
        spots: &[[0.5; 2]],
        shifts: &[shift],
        depths_of_shifts: 0.0,
        along: &|_| 0.0,
        share: 0.0,
    };
    probe(view.stage, frame, &of, &judge, &|share| (view.progress)(0.3 * share))
}

/// The plan points that may be nearest to the eye.
fn nearest(sights: &Buffer<Sight>) -> PlanBox {
    let ground = || sights.values().iter().filter_map(|sight| Some((sight.depth, sight.plan?)));
    let least = ground().map(|((_, high), _)| high).fold(f64::INFINITY, math::min);
    // Rounding may make another of equals the first.
    let least = least * (1.0 + 1e-9);
    let mut all = PlanBox::EMPTY;
    ground().filter(|((low, _), _)| *low <= least).for_each(|(_, plan)| all.include_box(&plan));
    if all.is_empty() { PlanBox::around([crate::space::Plan::default()]) } else { all }
}

/// A pixel's size at the distance of what the middle of the picture shows, else of what is nearest, metres.
fn pixel_m(view: &View, mesh: &Mesh, sights: &Buffer<Sight>) -> f64 {
    let (width, height) = (sights.width(), sights.height());
    let middle = [width / 2, height / 2];
    let at = |[x, y]: [usize; 2]| {
        let look = sights.at(x, y).looks.first()?;
        let triangle = mesh.surface_triangle(look.triangle)?;
        surface::pixel_m(view.frame, &triangle, Screen::new(x as f64 + 0.5, y as f64 + 0.5))
    };
    let depth = |k: &usize| sights.values()[*k].depth.0;
    let nearest = (0..width * height).min_by(|a, b| depth(a).total_cmp(&depth(b)));
    let nearest = nearest.map(|k| [k % width, k / width]);
    at(middle).or_else(|| at(nearest?)).unwrap_or(1.0)
}

/// What pixels may be, band by band.
fn pixels(view: &View, reader: &Reader, maker: &TileMaker, sights: &Buffer<Sight>) -> Buffer<PixelRange> {
    let (width, height) = (sights.width(), sights.height());
    let compositor = Compositor::new(view.stage.scene.compositing);
    let mut ranges = Vec::with_capacity(width * height);
    let mut tiles = Tiles::new();
    for band in sights.values().chunks(BAND * width.max(1)) {
        let of_rows: Vec<&[Sight]> = band.chunks(width.max(1)).collect();
        let mut keys: Vec<Key> = parallel::map(&of_rows, |row| keys(reader, row)).concat();
        keys.sort_unstable();
        keys.dedup();
        tiles.retain(|key, _| keys.binary_search(key).is_ok());
        keys.retain(|key| !tiles.contains_key(key));
        let made = parallel::map(&keys, |key| maker.make(*key));
        tiles.extend(keys.into_iter().zip(made));
        let rows = parallel::map(&of_rows, |row| {
            row.iter().map(|sight| pixel(reader, &compositor, &tiles, sight)).collect::<Vec<_>>()
        });
        ranges.extend(rows.into_iter().flatten());
        (view.progress)(0.3 + 0.7 * ranges.len() as f64 / (width * height) as f64);
    }
    Buffer::from_values(width, height, ranges)
}

/// The tiles that pixels may read.
fn keys(reader: &Reader, row: &[Sight]) -> Vec<Key> {
    let mut keys = Vec::new();
    for look in row.iter().flat_map(|sight| &sight.looks) {
        reader.tiles(look, &mut |key| {
            if keys.last() != Some(&key) {
                keys.push(key);
            }
        });
    }
    keys.sort_unstable();
    keys.dedup();
    keys
}

/// What a pixel may be.
fn pixel(reader: &Reader, compositor: &Compositor, tiles: &Tiles, sight: &Sight) -> PixelRange {
    let mut paints: Vec<PaintRange> = Vec::new();
    let mut items = Vec::new();
    for look in &sight.looks {
        paints.extend(reading::read(reader, look, tiles));
        reader.items(look, tiles, &mut |of| items.extend_from_slice(of));
    }
    items.sort_unstable();
    items.dedup();
    paints.extend(sight.sky);
    if sight.is_any || paints.is_empty() {
        paints.push(PaintRange::ANY);
    }
    let color = |paint: &PaintRange| {
        let mut mean = PaintMean::NOTHING;
        mean.add(paint, 1.0);
        let [low, high, _] = mean.colors(compositor, 1e-12);
        widened([low, high], BLEND)
    };
    let colors: Vec<_> = paints.iter().map(color).collect();
    let mut all = colors[0];
    for [low, high] in &colors {
        for k in 0..4 {
            all[0][k] = math::min(all[0][k], low[k]);
            all[1][k] = math::max(all[1][k], high[k]);
        }
    }
    let has_choices = (2..=MOST_CHOICES).contains(&colors.len());
    PixelRange { all, choices: if has_choices { colors } else { Vec::new() }, extremes: None, items }
}

/// The levels that pixels may ask for.
fn levels(reader: &Reader, sights: &Buffer<Sight>) -> Stage {
    let of = |sight: &Sight| {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for look in &sight.looks {
            let (least, most) = reader.levels(look);
            (low, high) = (math::min(low, least), math::max(high, most));
        }
        if sight.is_any {
            low = 0.0;
        }
        // The sky asks for none.
        if sight.sky.is_some() || sight.is_any {
            high = f64::INFINITY;
        }
        (low, high)
    };
    let (lo, hi) = sights.values().iter().map(of).unzip();
    Stage { buffer: "level".to_owned(), range: StageRange::Between { components: 1, lo, hi } }
}
