//! One frame: what the samples see, volumes to tiles, tiles to a picture (Fig. 4).

use super::block::SIZE;
use super::context::{FrameContext, Way};
use super::extrusion::Extrusion;
use super::stencil::{Method, TRACES, Traces};
use super::step::Step;
use super::structures;
use super::tile::{Counts, Tile};
use super::view::Entry;
use crate::buffer::{Buffer, Plane, Touches, Values};
use crate::canvas::{
    Frame, FrameOptions, LastGround, Pixels, Record, mean, picture_plane, sight_counts, surface_plane,
};
use crate::index::bins;
use crate::parallel;
use crate::raster::TileView;
use crate::resolve::Paint;
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::terrain::SKY;
use crate::tiling::Tiling;
use crate::visibility::TILE;

/// The most samples a side of a tile: single precision resolves them (see [`TileView`]).
const MOST: usize = 512;

/// A frame cut into tiles: its pixels and its samples.
struct Tilings {
    pixels: Tiling,
    samples: Tiling,
}

/// A finished tile.
struct Drawn {
    pixels: Pixels,
    /// The planes of [`TRACES`], where they are wanted; rows from the top.
    traces: Option<[Vec<u32>; 4]>,
    touches: Touches,
    counts: Counts,
}

/// Draws a frame of a view.
pub fn draw((stage, view): (&Stage, &ViewFrame), extrusion: &Extrusion, options: &FrameOptions) -> Frame {
    let mesh = &*stage.mesh_for(view);
    let context = FrameContext::new((stage, mesh, view), extrusion, options);
    (options.progress)(0.3);
    let (n, lattice) = (context.samples(), context.sight.lattice());
    let side = options.tile.clamp(1, MOST / n);
    let tilings = Tilings {
        pixels: Tiling::new(view.width(), view.height(), side),
        samples: Tiling::new(lattice.columns, lattice.rows, side * n),
    };
    let entries = context.looks.entries(extrusion);
    let windows = entries.iter().map(|entry| {
        let [c0, r0, c1, r1] = entry.window.map(|v| v as usize);
        (*entry, [c0..c1 + 1, r0..r1 + 1])
    });
    let bins = bins(&tilings.samples, windows);
    let progress = |share: f64| (options.progress)(0.3 + 0.7 * share);
    let wants_colors = options.wants("color");
    let mut tiles = parallel::map_telling(tilings.pixels.count(), &progress, |k| {
        let [column, row] = tilings.samples.place(k).corner;
        let tile = TileView::new(view, lattice, (column, row), side * n);
        draw_tile(&context, tile, bins.of(k), wants_colors)
    });
    let codes = tilings.pixels.assembled([0; 4], tiles.iter().map(|tile| tile.pixels.codes()));
    let mut planes = structures::planes(&context, options);
    planes.extend(options.buffers.iter().filter_map(|name| plane(name, &context, &tilings, &tiles)));
    if context.wants_items {
        let mut touches = options.touches(view.width());
        tiles.iter_mut().for_each(|tile| touches.take(std::mem::take(&mut tile.touches)));
        planes.extend(touches.planes(view.height(), &|name| options.wants(name)));
    }
    Frame {
        image: Buffer::from_values(view.width(), view.height(), codes),
        planes,
        counts: counts(&context, &tiles),
    }
}

/// Decides single pixels of a view as a frame does: of each its steps and its code values. A tile of each pixel alone is drawn; where a
/// frame counts in passing, every face is counted here, which makes the same masks.
pub fn explain(
    (stage, view): (&Stage, &ViewFrame),
    extrusion: &Extrusion,
    pixels: &[[usize; 2]],
) -> Vec<(Vec<Step>, [u8; 4])> {
    let options = FrameOptions { tile: TILE, buffers: &[], progress: &|_| {} };
    let mesh = &*stage.mesh_for(view);
    let mut context = FrameContext::new((stage, mesh, view), extrusion, &options);
    if context.way == Way::Sparse {
        context.way = Way::Full;
    }
    let entries = context.looks.entries(extrusion);
    pixels.iter().map(|pixel| explained(&context, &entries, *pixel)).collect()
}

/// Decides one pixel of a frame, of whose volumes these are in the picture.
fn explained(context: &FrameContext, entries: &[Entry], [x, y]: [usize; 2]) -> (Vec<Step>, [u8; 4]) {
    let n = context.samples();
    let (column, row) = (x * n, y * n);
    let is_near = |entry: &&Entry| {
        let [c0, r0, c1, r1] = entry.window.map(|v| v as usize);
        c0 < column + n && column <= c1 && r0 < row + n && row <= r1
    };
    let entries: Vec<Entry> = entries.iter().filter(is_near).copied().collect();
    let pixel = TileView::new(context.view, context.sight.lattice(), (column, row), n);
    let mut tile = Tile::new(context, pixel, &entries, Vec::new());
    tile.draw(&entries);
    let pixels = pixels(&mut tile, false);
    (tile.record, pixels.codes()[0])
}

fn draw_tile(context: &FrameContext, view: TileView, entries: &[Entry], wants_colors: bool) -> Drawn {
    let mut tile = Tile::new(context, view, entries, ());
    tile.draw(entries);
    let pixels = pixels(&mut tile, wants_colors);
    let traces = tile.traces.as_ref().map(|traces| planes_of(&tile, traces));
    Drawn { pixels, traces, touches: tile.touches, counts: tile.counts }
}

/// The pixels of a tile that has been drawn.
fn pixels<R: Record<Step>>(tile: &mut Tile<R>, wants_colors: bool) -> Pixels {
    let (context, n) = (tile.context, tile.context.samples());
    let (width, height) = (tile.view.width / n, tile.view.height / n);
    let mut pixels = Pixels::new(context.backdrop.compositor, width * height, wants_colors);
    let mut last = context.backdrop.no_ground();
    for y in 0..height {
        let mut x = 0;
        while x < width {
            let (paint, is_painted) = if n > 1 {
                let paint = mean(n, |c, r| sample(tile, (x * n + c, y * n + r), &mut last).0);
                tile.record.step(|| Step::Mean(paint));
                (paint, true)
            } else {
                sample(tile, (x, y), &mut last)
            };
            if is_painted {
                pixels.push(paint);
                x += 1;
            } else {
                let bare = tile.bare_samples(x, y).max(1);
                pixels.push_grounds(paint, bare);
                x += bare;
            }
        }
    }
    pixels
}

/// The paint of a tile's sample, and whether features have been drawn on it; `last` is the ground of the sample before.
#[inline(always)]
fn sample<R: Record<Step>>(
    tile: &mut Tile<R>,
    (c, r): (usize, usize),
    last: &mut LastGround,
) -> (Paint, bool) {
    let (context, seen_at) = (tile.context, (tile.view.column + c, tile.view.row + r));
    let painted = tile.painted(c, r);
    let paint = painted.unwrap_or_else(|| context.ground_paint(last, seen_at));
    tile.record.step(|| {
        let triangle = context.sight.triangle(seen_at.0, seen_at.1);
        let plan = context.sight.hit(seen_at.0, seen_at.1).map(|hit| hit.plan);
        Step::Sample { sample: [c, r], triangle: (triangle != SKY).then_some(triangle), plan, paint }
    });
    (paint, painted.is_some())
}

/// The planes of a tile, rows from the top.
fn planes_of(tile: &Tile, traces: &Traces) -> [Vec<u32>; 4] {
    let (width, height) = (tile.view.width, tile.view.height);
    let gather = |of: &dyn Fn((usize, usize)) -> u32| {
        (0..width * height).map(|k| of(tile.index(k % width, k / width))).collect()
    };
    let of_counts = |plane: &Vec<[u32; SIZE]>| gather(&|(block, at)| plane[block][at]);
    [
        gather(&|(block, at)| u32::from(traces.stencil[block][at])),
        of_counts(&traces.front),
        of_counts(&traces.back),
        of_counts(&traces.overdraw),
    ]
}

fn plane(name: &str, context: &FrameContext, tilings: &Tilings, tiles: &[Drawn]) -> Option<Plane> {
    if name == "color" {
        let colors = tilings.pixels.assembled([0.0; 4], tiles.iter().map(|tile| tile.pixels.colors()));
        let size = [context.view.width(), context.view.height()];
        return Some(picture_plane("color", size, 4, Values::F64(colors.into_flattened())));
    }
    let Some(k) = TRACES.iter().position(|known| *known == name) else {
        return surface_plane(name, &context.sight, 0);
    };
    let traces = tiles.iter().map(|tile| tile.traces.as_ref().map_or(&[][..], |planes| &planes[k]));
    let counts = tilings.samples.assembled(0, traces);
    let values = match k {
        0 => Values::U16(counts.into_iter().map(|count| count as u16).collect()),
        _ => Values::U32(counts),
    };
    let lattice = context.sight.lattice();
    Some(picture_plane(TRACES[k], [lattice.columns, lattice.rows], 1, values))
}

fn counts(context: &FrameContext, tiles: &[Drawn]) -> Vec<(&'static str, u64)> {
    let done = tiles.iter().fold(Counts::default(), |sum, tile| sum.plus(tile.counts));
    let by = |method| context.looks.in_view().filter(|v| context.looks.methods[*v] == method).count() as u64;
    let own = [
        ("objects", context.extrusion.objects.len() as u64),
        ("volumes", context.extrusion.volumes.len() as u64),
        ("passes", context.extrusion.passes.len() as u64),
        ("z_pass", by(Method::ZPass)),
        ("z_fail", by(Method::ZFail)),
        ("faces", done.faces),
        ("fragments", done.fragments),
        ("masks", done.masks),
        ("exact_fragments", done.exact_decisions),
    ];
    own.into_iter().chain(sight_counts(&context.sight.counts())).collect()
}
