//! One frame: its tiles, in parallel, and what is told of them.

use super::Prepare;
use super::look::Looks;
use super::sheet::TILE;
use super::step::Step;
use super::texels::Texels;
use super::tile::{Painter, Pixel, Room, SAMPLED};
use crate::buffer::{Buffer, Plane, Values};
use crate::canvas::{Backdrop, Frame, FrameOptions, GBuffer, Pixels, picture_plane, surface_plane};
use crate::parallel::{self, Progress};
use crate::raster::Lattice;
use crate::resolve::{Compositor, Paint, code_values};
use crate::space::ViewFrame;
use crate::terrain::Mesh;
use crate::tiling::Tiling;

/// The buffers, in the order in which a frame has them.
const ORDER: [&str; 8] = ["depth", "triangle", "plan", "fragments", "class", "edges", "fallback", "color"];

/// Draws a frame of a view.
pub(super) fn draw(prepared: &Prepare, view: &ViewFrame, options: &FrameOptions) -> Frame {
    let mesh = &*prepared.stage.mesh_for(view);
    let backdrop = Backdrop::of(&prepared.stage.scene, mesh);
    let looks = looks(prepared, &backdrop);
    let painter = painter(prepared, view, (mesh, &looks), backdrop);
    let tiling = Tiling::new(view.width(), view.height(), TILE);
    let numbers: Vec<usize> = (0..tiling.count()).collect();
    let progress = Progress::new(numbers.len(), options.progress);
    let is_told = ["fragments", "class", "edges", "fallback"].iter().any(|name| options.wants(name));
    let tiles = parallel::map_with(&numbers, Room::default, |room, k| {
        let mut touches = options.touches(view.width());
        let pixels = painter.tile(&tiling.place(*k), room, &mut touches);
        progress.step();
        (Tile::new(pixels, painter.backdrop.compositor, [options.wants("color"), is_told]), touches)
    });
    let (tiles, found): (Vec<_>, Vec<_>) = tiles.into_iter().unzip();
    let mut touches = options.touches(view.width());
    found.into_iter().for_each(|part| touches.take(part));
    let sky = Pixel { paint: painter.backdrop.sky, class: 0, edges: 0, fragments: 0, fallback: 0 };
    let pixels = match is_told {
        true => tiling.assembled(sky, tiles.iter().map(|tile| &tile.pixels[..])),
        false => Vec::new(),
    };
    let colors = match options.wants("color") {
        true => tiling.assembled([0.0; 4], tiles.iter().map(|tile| tile.coded.colors())),
        false => Vec::new(),
    };
    let wants_surface = ["depth", "triangle", "plan"].iter().any(|name| options.wants(name));
    let centres = wants_surface.then(|| {
        let lattice = Lattice::centres(view, 0);
        GBuffer::new(view, mesh, &prepared.stage.scene.device, lattice, options.tile)
    });
    let size = tiling.size();
    let wanted = ORDER.into_iter().filter(|name| options.wants(name));
    let own = wanted.filter_map(|name| plane(name, size, (&pixels, &colors), centres.as_ref()));
    let picks = touches.planes(view.height(), &|name| options.wants(name));
    Frame {
        image: Buffer::from_values(
            size[0],
            size[1],
            tiling.assembled([0; 4], tiles.iter().map(|tile| tile.coded.codes())),
        ),
        planes: own.chain(picks).collect(),
        counts: told(
            tiles.iter().fold([0; COUNTS], |sum, tile| std::array::from_fn(|k| sum[k] + tile.counts[k])),
        ),
    }
}

/// Decides one pixel of a view as a frame does: its steps and its code values.
pub(super) fn explain(prepared: &Prepare, view: &ViewFrame, [x, y]: [usize; 2]) -> (Vec<Step>, [u8; 4]) {
    let mesh = &*prepared.stage.mesh_for(view);
    let backdrop = Backdrop::of(&prepared.stage.scene, mesh);
    let looks = looks(prepared, &backdrop);
    let painter = painter(prepared, view, (mesh, &looks), backdrop);
    let tiling = Tiling::new(view.width(), view.height(), TILE);
    let place = tiling.place(y / TILE * tiling.across() + x / TILE);
    let mut steps = Vec::new();
    let paint: Paint = painter.one(&place, [x % TILE, y % TILE], &mut steps);
    (steps, code_values(painter.backdrop.compositor.encoded(paint)))
}

fn looks<'s>(prepared: &Prepare<'s>, backdrop: &Backdrop) -> Looks<'s> {
    let mode = prepared.stage.scene.compositing.mode;
    Looks::new(&prepared.stage.draw_list, &backdrop.compositor, mode)
}

fn painter<'a>(
    prepared: &'a Prepare,
    view: &'a ViewFrame,
    (mesh, looks): (&'a Mesh, &'a Looks<'a>),
    backdrop: Backdrop<'a>,
) -> Painter<'a> {
    Painter {
        features: &prepared.features,
        settings: prepared.settings,
        view,
        mesh,
        backdrop,
        looks,
        texels: Texels::of(&prepared.stage.scene),
    }
}

fn plane(
    name: &'static str,
    size: [usize; 2],
    (pixels, colors): (&[Pixel], &[[f64; 4]]),
    centres: Option<&GBuffer>,
) -> Option<Plane> {
    let numbers = |of: fn(&Pixel) -> u32| Values::U32(pixels.iter().map(of).collect());
    let bytes = |of: fn(&Pixel) -> u8| Values::U8(pixels.iter().map(of).collect());
    let (components, values) = match name {
        "fragments" => (1, numbers(|pixel| pixel.fragments)),
        "class" => (1, bytes(|pixel| pixel.class)),
        "edges" => (1, numbers(|pixel| pixel.edges)),
        "fallback" => (1, bytes(|pixel| pixel.fallback)),
        "color" => (4, Values::F64(colors.as_flattened().to_vec())),
        _ => return surface_plane(name, centres?.sight(), 0),
    };
    Some(picture_plane(name, size, components, values))
}

/// How many counts there are.
const COUNTS: usize = 10;

/// A finished tile: code values, colours where they are wanted, pixels where their buffers are wanted.
struct Tile {
    coded: Pixels,
    pixels: Vec<Pixel>,
    counts: [u64; COUNTS],
}

impl Tile {
    fn new(pixels: Vec<Pixel>, compositor: Compositor, [wants_colors, is_told]: [bool; 2]) -> Self {
        let mut coded = Pixels::new(compositor, pixels.len(), wants_colors);
        pixels.iter().for_each(|pixel| coded.push(pixel.paint));
        let counts = counts(&pixels);
        Self { coded, pixels: if is_told { pixels } else { Vec::new() }, counts }
    }
}

/// What is counted in some pixels, in the order in which it is [`told`].
fn counts(pixels: &[Pixel]) -> [u64; COUNTS] {
    let mut counts = [0; COUNTS];
    for pixel in pixels {
        counts[pixel.class as usize] += 1;
        if pixel.fallback > 0 {
            counts[usize::from(SAMPLED + pixel.fallback)] += 1;
        }
        counts[8] += u64::from(pixel.fragments);
        counts[9] += u64::from(pixel.edges);
    }
    counts
}

/// Counts with their names.
fn told(counts: [u64; COUNTS]) -> Vec<(&'static str, u64)> {
    let names = [
        "point_pixels",
        "half_plane_pixels",
        "band_pixels",
        "slab_pixels",
        "sampled_pixels",
        "crowded_by_fragments",
        "crowded_by_edges",
        "bent_widths",
        "fragments",
        "edges",
    ];
    names.into_iter().zip(counts).collect()
}
