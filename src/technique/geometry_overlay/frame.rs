//! One frame: lines over the mesh in use to segments, fills to faces, both to tiles, tiles to a picture.

use super::Prepare;
use super::drawing::{LineDrawing, Piece};
use super::mesh::MeshInUse;
use super::step::Step;
use super::strips::Overlay;
use super::structures;
use super::tile::{Drawn, FrameContext};
use crate::buffer::{Buffer, Plane, Touches, Values};
use crate::canvas::{Backdrop, Frame, FrameOptions, picture_plane, sight_counts, surface_plane};
use crate::error::{Error, Result};
use crate::index::bins;
use crate::parallel;
use crate::raster::Lattice;
use crate::raster::device::{Pipeline, PolygonOffset, Real};
use crate::resolve::code_values;
use crate::scene::Precision;
use crate::space::ViewFrame;
use crate::terrain::{Mesh, SKY};
use crate::tiling::{TilePlace, Tiling};
use crate::visibility::{Sight, TILE};

/// The most tiles that segments and faces may touch, all together: a number each.
const MOST_TOUCHED: u64 = 1 << 30;

/// No layer: the sky, or a mesh without levels.
const NO_LAYER: u32 = u32::MAX;

/// A frame with what it draws found.
struct Setup<'a, T> {
    context: FrameContext<'a, T>,
    overlay: Overlay,
    /// Strips that are to be wider than the device's lines.
    clamped: u64,
    /// Pieces of fills on triangles of the mesh.
    patches: u64,
}

/// Draws a frame of a view.
///
/// # Errors
/// When segments and faces touch more tiles than there is room for.
pub(super) fn draw(prepared: &Prepare, view: &ViewFrame, options: &FrameOptions) -> Result<Frame> {
    match prepared.stage.scene.device.precision {
        Precision::F64 => draw_with::<f64>(prepared, view, options),
        Precision::F32 => draw_with::<f32>(prepared, view, options),
    }
}

/// Decides single pixels of a view as a frame does: of each its steps and its code values.
pub(super) fn explain(
    prepared: &Prepare,
    view: &ViewFrame,
    pixels: &[[usize; 2]],
) -> Vec<(Vec<Step>, [u8; 4])> {
    match prepared.stage.scene.device.precision {
        Precision::F64 => explain_with::<f64>(prepared, view, pixels),
        Precision::F32 => explain_with::<f32>(prepared, view, pixels),
    }
}

fn draw_with<T: Real>(prepared: &Prepare, view: &ViewFrame, options: &FrameOptions) -> Result<Frame> {
    let mesh = &*prepared.stage.mesh_for(view);
    let setup = Setup::<T>::new(prepared, (mesh, view), options.tile);
    let context = &setup.context;
    (options.progress)(0.5);
    let tiling = Tiling::new(view.width(), view.height(), options.tile);
    let windows =
        context.pieces.iter().map(|piece| [piece.window.columns.clone(), piece.window.rows.clone()]);
    let touched =
        |[columns, rows]: [std::ops::Range<usize>; 2]| tiling.tiles_in(columns, rows).count() as u64;
    if windows.clone().map(touched).sum::<u64>() > MOST_TOUCHED {
        return Err(Error::unsupported(format!(
            "geometry-overlay: there is no room for {} segments and faces that cover so much of the picture",
            context.pieces.len()
        ))
        .help("make the lines thinner, or leave some out by `where`"));
    }
    let bins = bins(&tiling, (0u32..).zip(windows));
    let progress = |share: f64| (options.progress)(0.5 + 0.5 * share);
    let wants = || (options.wants("color"), options.wants("clipping"), options.touches(view.width()));
    let mut tiles = parallel::map_telling(tiling.count(), &progress, |k| {
        context.draw(tiling.place(k), bins.of(k), wants(), &mut ())
    });
    let mut touches = options.touches(view.width());
    tiles.iter_mut().for_each(|tile| touches.take(std::mem::take(&mut tile.touches)));
    let codes = tiling.assembled([0; 4], tiles.iter().map(|tile| tile.pixels.codes()));
    let structures = match MeshInUse::of(&prepared.stage.mesh, mesh) {
        Some(in_use) => structures::planes(prepared, (&in_use, view), options)?,
        None => Vec::new(),
    };
    let planes = options.buffers.iter().filter_map(|name| plane(name, context, (&tiling, &tiles)));
    Ok(Frame {
        image: Buffer::from_values(view.width(), view.height(), codes),
        planes: structures
            .into_iter()
            .chain(planes)
            .chain(touches.planes(view.height(), &|name| options.wants(name)))
            .collect(),
        counts: setup.counts(&tiles),
    })
}

fn explain_with<T: Real>(
    prepared: &Prepare,
    view: &ViewFrame,
    pixels: &[[usize; 2]],
) -> Vec<(Vec<Step>, [u8; 4])> {
    let mesh = &*prepared.stage.mesh_for(view);
    let setup = Setup::<T>::new(prepared, (mesh, view), TILE);
    let explained = |corner: &[usize; 2]| {
        let [x, y] = *corner;
        let holds = |piece: &Piece<T>| piece.window.columns.contains(&x) && piece.window.rows.contains(&y);
        let pieces = (0..).zip(&setup.context.pieces);
        let near: Vec<u32> = pieces.filter(|(_, piece)| holds(piece)).map(|(number, _)| number).collect();
        let mut steps = Vec::new();
        let place = TilePlace { corner: *corner, size: [1, 1] };
        let drawn = setup.context.draw(place, &near, (true, false, Touches::default()), &mut steps);
        let code = drawn.pixels.colors().first().map_or([0; 4], |color| code_values(*color));
        (steps, code)
    };
    pixels.iter().map(explained).collect()
}

impl<'a, T: Real> Setup<'a, T> {
    fn new(prepared: &'a Prepare, (mesh, view): (&'a Mesh, &'a ViewFrame), tile: usize) -> Self {
        let stage = prepared.stage;
        let (scene, device) = (&stage.scene, &stage.scene.device);
        let settings = &prepared.settings;
        let offset = PolygonOffset { factor: settings.offset_factor, units: settings.offset_units };
        let (overlay, patches) = MeshInUse::of(&stage.mesh, mesh)
            .map(|in_use| (prepared.overlay(&in_use, view), prepared.patches(&in_use, view)))
            .unwrap_or_default();
        let pipeline = Pipeline::new(view, mesh, device);
        let drawing = LineDrawing::new(settings, device);
        let mut pieces = drawing.segments(&overlay.strips, (&stage.draw_list, view, &pipeline));
        pieces.extend(drawing.faces(&patches, (view, &pipeline)));
        pieces.sort_by_key(|piece| piece.item);
        let clamped = drawing.clamped(&overlay.strips, &stage.draw_list, view);
        let lattice = Lattice::centres(view, 0);
        let mut sight = Sight::new(view, mesh, device, lattice, tile).with_polygon_offset(offset);
        sight.see();
        let backdrop = Backdrop::of(scene, mesh);
        let paints = stage.draw_list.styles().iter().map(|style| backdrop.compositor.paint(style.paint));
        let context = FrameContext {
            stage,
            mesh,
            view,
            paints: paints.collect(),
            sight,
            backdrop,
            pipeline,
            offset,
            pieces,
        };
        Self { context, overlay, clamped, patches: patches.len() as u64 }
    }

    fn counts(&self, tiles: &[Drawn]) -> Vec<(&'static str, u64)> {
        let overlay = &self.overlay;
        let sum = |f: fn(&Drawn) -> u64| tiles.iter().map(f).sum();
        let faces = self.context.pieces.iter().filter(|piece| piece.is_face()).count() as u64;
        let drawn_points = overlay.strips.iter().map(|strip| strip.points.len() as u64).sum();
        let own = [
            ("quads", overlay.quads),
            ("borrowed_quads", overlay.borrowed),
            ("clippings_visited", overlay.cost.visited),
            ("clippings_tested", overlay.cost.tested),
            ("clippings_drawn", overlay.cost.drawn),
            ("primitives", overlay.strips.len() as u64),
            ("points", overlay.points),
            ("points_drawn", drawn_points),
            ("clamped", self.clamped),
            ("segments", self.context.pieces.len() as u64 - faces),
            ("fill_pieces", self.patches),
            ("fill_triangles", faces),
            ("fragments", sum(|tile| tile.counts.fragments)),
            ("fragments_drawn", sum(|tile| tile.counts.drawn)),
        ];
        own.into_iter().chain(sight_counts(&self.context.sight.counts())).collect()
    }
}

fn plane<T: Real>(
    name: &str,
    context: &FrameContext<T>,
    (tiling, tiles): (&Tiling, &[Drawn]),
) -> Option<Plane> {
    let size = tiling.size();
    match name {
        "color" => {
            let colors = tiling.assembled([0.0; 4], tiles.iter().map(|tile| tile.pixels.colors()));
            Some(picture_plane("color", size, 4, Values::F64(colors.into_flattened())))
        }
        "clipping" => {
            let clippings = tiling.assembled(0, tiles.iter().map(|tile| tile.clippings.values()));
            Some(picture_plane("clipping", size, 1, Values::U32(clippings)))
        }
        "layer" => {
            let layer = |triangle: &u32| match triangle {
                &SKY => NO_LAYER,
                triangle => context.mesh.layer_of(*triangle).unwrap_or(NO_LAYER),
            };
            let layers = context.sight.triangles().iter().map(layer).collect();
            Some(picture_plane("layer", size, 1, Values::U32(layers)))
        }
        _ => surface_plane(name, &context.sight, 0),
    }
}
