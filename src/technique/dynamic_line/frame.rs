//! One frame: indices are updated, boxes go to tiles, tiles to a picture, which is smoothed.

use super::camera::Camera;
use super::fxaa::{Picture, REACH};
use super::in_line::Thin;
use super::matching::MatchedLines;
use super::segment_box::BoxMaker;
use super::statics::Statics;
use super::step::Step;
use super::tile::{Counts, Drawn, FrameContext, MOST_ENTRIES, line_of, margin};
use super::update::{Segment, segments};
use crate::buffer::{Buffer, Plane, Values};
use crate::canvas::{Backdrop, Frame, FrameOptions, joined, picture_plane, sight_counts, surface_plane};
use crate::decal::Decals;
use crate::error::{Error, Result};
use crate::index::bins;
use crate::parallel;
use crate::raster::Lattice;
use crate::raster::device::Real;
use crate::resolve::code_values;
use crate::scene::Precision;
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::technique::dynamic_line::{Antialiasing, Culling, Settings};
use crate::terrain::Mesh;
use crate::tiling::{TilePlace, Tiling};
use crate::visibility::{Sight, TILE};
use std::ops::Range;

/// Segments that one piece of parallel work looks at.
const SEGMENTS_AT_A_TIME: usize = 1024;

/// The most tiles that boxes may touch, all together: a number each.
const MOST_TOUCHED: u64 = 1 << 30;

/// The most segments of a view: each takes some 200 bytes on the way to a tile.
const MOST_SEGMENTS: usize = 1 << 25;

/// What was prepared for any view.
#[derive(Debug)]
pub struct Prepared<'s> {
    /// The dynamic lines.
    pub lines: MatchedLines<'s>,
    /// Fills and widths in metres; `None`: there are none.
    pub decals: Option<Decals<'s>>,
}

/// Columns and rows of a picture.
type Window = [Range<usize>; 2];

/// A frame with its segments found, and the pixels around each one's box.
struct Setup<'a, T> {
    context: FrameContext<'a, T>,
    windows: Vec<Window>,
    vertices: u64,
    vanished: u64,
    kept: u64,
}

/// Draws a frame of a view.
///
/// # Errors
/// When there are more segments than there is room for, or boxes touch more tiles.
pub fn draw(
    (stage, view): (&Stage, &ViewFrame),
    prepared: &Prepared,
    options: &FrameOptions,
) -> Result<Frame> {
    match stage.scene.device.precision {
        Precision::F64 => draw_with::<f64>((stage, view), prepared, options),
        Precision::F32 => draw_with::<f32>((stage, view), prepared, options),
    }
}

/// Decides single pixels of a view as a frame does: of each its steps and its code values.
///
/// # Errors
/// When there are more segments than there is room for.
pub fn explain(
    (stage, view): (&Stage, &ViewFrame),
    prepared: &Prepared,
    pixels: &[[usize; 2]],
) -> Result<Vec<(Vec<Step>, [u8; 4])>> {
    match stage.scene.device.precision {
        Precision::F64 => explain_with::<f64>((stage, view), prepared, pixels),
        Precision::F32 => explain_with::<f32>((stage, view), prepared, pixels),
    }
}

fn draw_with<T: Real>(
    (stage, view): (&Stage, &ViewFrame),
    prepared: &Prepared,
    options: &FrameOptions,
) -> Result<Frame> {
    let mesh = &*stage.mesh_for(view);
    let setup = Setup::<T>::new(
        (stage, mesh, view),
        prepared,
        (options.tile, options.wants("boxes"), options.touches(0).is_wanted()),
    )?;
    let context = &setup.context;
    (options.progress)(0.4);
    let size = [view.width(), view.height()];
    let tiling = Tiling::new(size[0], size[1], options.tile);
    let touched = |window: &Window| tiling.tiles_in(window[0].clone(), window[1].clone()).count() as u64;
    let all: u64 = setup.windows.iter().map(touched).sum();
    if all > MOST_TOUCHED {
        return Err(Error::unsupported(format!(
            "dynamic-line: {} boxes cover so much of the picture that there is no room for their lists",
            setup.windows.len()
        ))
        .help("make the lines thinner, or leave some out by `where`"));
    }
    let bins = bins(&tiling, (0u32..).zip(setup.windows.iter().cloned()));
    let progress = |share: f64| (options.progress)(0.4 + 0.5 * share);
    let mut tiles = parallel::map_telling(tiling.count(), &progress, |k| {
        context.draw(tiling.place(k), bins.of(k), &mut ())
    });
    let colors = tiling.assembled([0.0; 4], tiles.iter().map(|tile| &tile.colors[..]));
    let colors = finished(size, colors, context.settings.antialiasing);
    let mut touches = options.touches(size[0]);
    tiles.iter_mut().for_each(|tile| touches.take(std::mem::take(&mut tile.touches)));
    let planes = options.buffers.iter().filter_map(|name| plane(name, context, &tiling, (&tiles, &colors)));
    let picks = touches.planes(size[1], &|name| options.wants(name));
    Ok(Frame {
        planes: planes.chain(picks).collect(),
        counts: setup.counts(&prepared.lines, &tiles),
        image: Buffer::from_values(size[0], size[1], colors.into_iter().map(code_values).collect()),
    })
}

fn explain_with<T: Real>(
    (stage, view): (&Stage, &ViewFrame),
    prepared: &Prepared,
    pixels: &[[usize; 2]],
) -> Result<Vec<(Vec<Step>, [u8; 4])>> {
    let mesh = &*stage.mesh_for(view);
    let setup = Setup::<T>::new((stage, mesh, view), prepared, (TILE, false, false))?;
    Ok(pixels.iter().map(|pixel| setup.explained(view, *pixel)).collect())
}

impl<T: Real> Setup<'_, T> {
    /// Decides one pixel.
    fn explained(&self, view: &ViewFrame, [x, y]: [usize; 2]) -> (Vec<Step>, [u8; 4]) {
        let draw = |place: TilePlace, record: &mut Vec<Step>| {
            let ([x, y], [width, height]) = (place.corner, place.size);
            let meets = |[columns, rows]: &Window| {
                columns.start < x + width && x < columns.end && rows.start < y + height && y < rows.end
            };
            let near: Vec<u32> =
                (0..).zip(&self.windows).filter(|(_, window)| meets(window)).map(|(k, _)| k).collect();
            self.context.draw(place, &near, record)
        };
        let mut steps = Vec::new();
        let own = draw(TilePlace { corner: [x, y], size: [1, 1] }, &mut steps);
        if self.context.settings.antialiasing != Antialiasing::Fxaa {
            return (steps, code_values(own.colors[0]));
        }
        let corner = [x.saturating_sub(REACH), y.saturating_sub(REACH)];
        let end = [(x + REACH + 1).min(view.width()), (y + REACH + 1).min(view.height())];
        let size = [end[0] - corner[0], end[1] - corner[1]];
        let around = draw(TilePlace { corner, size }, &mut Vec::new());
        let color = Picture::new(size, &around.colors).smoothed([x - corner[0], y - corner[1]]);
        steps.push(Step::Smoothed(color));
        (steps, code_values(color))
    }
}

/// The picture after the filter over it, if it is wanted.
fn finished(size: [usize; 2], colors: Vec<[f64; 4]>, antialiasing: Antialiasing) -> Vec<[f64; 4]> {
    if antialiasing != Antialiasing::Fxaa {
        return colors;
    }
    let picture = Picture::new(size, &colors);
    let rows = parallel::map_indices(size[1], |y| {
        (0..size[0]).map(|x| picture.smoothed([x, y])).collect::<Vec<_>>()
    });
    joined(rows.iter().map(Vec::as_slice))
}

impl<'a, T: Real> Setup<'a, T> {
    /// Finds what a view sees and the segments that it keeps.
    fn new(
        (stage, mesh, view): (&'a Stage, &'a Mesh, &'a ViewFrame),
        prepared: &'a Prepared<'a>,
        (tile, wants_boxes, wants_items): (usize, bool, bool),
    ) -> Result<Self> {
        let settings: Settings = stage.scene.technique.get();
        let mut sight = Sight::new(view, mesh, &stage.scene.device, Lattice::centres(view, 0), tile);
        sight.see();
        let camera = Camera::new(view);
        let mut found = segments((stage, mesh, view), &prepared.lines, &camera, MOST_SEGMENTS)?;
        let boxes = BoxMaker::new(camera, mesh, settings.boxes);
        let thin = Thin::of(&settings, view);
        let size = [view.width(), view.height()];
        let window = |segment: &Segment<T>| {
            let of = boxes.of(segment, line_of(stage, segment.item).1);
            boxes.outline(&of, margin(thin, settings.antialiasing))?.window(size)
        };
        let is_kept = |segment: &Segment<T>| settings.culling == Culling::Boxes || segment.is_inside;
        let chunks: Vec<&[Segment<T>]> = found.all.chunks(SEGMENTS_AT_A_TIME).collect();
        // Of those that are culled nothing is said.
        let said = parallel::map(&chunks, |chunk| {
            chunk.iter().map(|segment| is_kept(segment).then(|| window(segment))).collect::<Vec<_>>()
        });
        let kept = said.iter().flatten().flatten();
        let count = match settings.culling {
            Culling::Vertices => kept.count() as u64,
            Culling::Boxes => kept.flatten().count() as u64,
        };
        let mut each = said.iter().flatten();
        found.all.retain(|_| matches!(each.next(), Some(Some(Some(_)))));
        let windows = said.into_iter().flatten().filter_map(Option::flatten).collect();
        let backdrop = Backdrop::of(&stage.scene, mesh);
        let styles = stage.draw_list.styles().iter();
        let paints = styles.map(|style| backdrop.compositor.paint(style.paint)).collect();
        let statics = prepared.decals.as_ref().map(|decals| {
            let is_analytic = settings.antialiasing == Antialiasing::Analytic;
            Statics::new(decals, (&stage.draw_list, &backdrop, stage.scene.compositing.mode), is_analytic)
        });
        Ok(Self {
            context: FrameContext {
                stage,
                mesh,
                view,
                settings,
                sight,
                backdrop,
                camera,
                boxes,
                thin,
                segments: found.all,
                paints,
                statics,
                wants_boxes,
                wants_items,
                most_entries: MOST_ENTRIES,
            },
            windows,
            vertices: found.vertices,
            vanished: found.vanished,
            kept: count,
        })
    }

    fn counts(&self, lines: &MatchedLines, tiles: &[Drawn]) -> Vec<(&'static str, u64)> {
        let done = tiles.iter().fold(Counts::default(), |sum, tile| sum.plus(tile.counts));
        let own = [
            ("lines", lines.chains.len() as u64),
            ("vertices", lines.chain_vertices),
            ("parts", lines.parts),
            ("vertices_seen", self.vertices),
            ("vanished", self.vanished),
            ("segments", self.kept),
            ("boxes", self.windows.len() as u64),
            ("fragments", done.fragments),
            ("entries", done.entries),
            ("longest_list", done.longest),
        ];
        own.into_iter().chain(sight_counts(&self.context.sight.counts())).collect()
    }
}

fn plane<T: Real>(
    name: &str,
    context: &FrameContext<T>,
    tiling: &Tiling,
    (tiles, colors): (&[Drawn], &[[f64; 4]]),
) -> Option<Plane> {
    let size = [context.view.width(), context.view.height()];
    let counted = |name, of: fn(&Drawn) -> &Vec<u32>| {
        let values = tiling.assembled(0, tiles.iter().map(|tile| &of(tile)[..]));
        Some(picture_plane(name, size, 1, Values::U32(values)))
    };
    match name {
        "color" => Some(picture_plane("color", size, 4, Values::F64(colors.as_flattened().to_vec()))),
        "list-length" => counted("list-length", |tile| &tile.lengths),
        "boxes" => counted("boxes", |tile| &tile.boxes),
        _ => surface_plane(name, &context.sight, 0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene_file::SceneFile;

    #[test]
    fn a_tile_whose_lists_outgrow_their_room_is_drawn_in_parts_to_the_same_bits() {
        let text = "schema = 1\nimage = { width = 23, height = 17 }\ncamera = { eye = [0, -200, 160], target = [0, 0, 0] }\n\
                    terrain = { generate = { kind = \"sine\", posts = [17, 17], cell_m = 15.0, height_m = 20.0 } }\n[[layer]]\n\
                    features = [{ line = [[-90, -60], [80, 70]] }, { line = [[-80, 60], [0, 0], [90, -60]] }]\n\
                    line = { color = \"#aa0000\", opacity = 0.5, width_px = 5.0 }\n";
        let (scene, surface) =
            crate::source::load::load(&SceneFile::parse(text, None, &[]).unwrap(), &|_| {}).unwrap();
        let stage = Stage::new(scene, surface).unwrap();
        let view = stage.view().unwrap();
        let prepared =
            Prepared { lines: MatchedLines::new(&stage.draw_list, &stage.mesh, None).unwrap(), decals: None };
        let mut setup =
            Setup::<f64>::new((&stage, &stage.mesh, &view), &prepared, (64, true, false)).unwrap();
        let near: Vec<u32> = (0..setup.windows.len() as u32).collect();
        let place = TilePlace { corner: [0, 0], size: [23, 17] };
        let whole = setup.context.draw(place, &near, &mut ());
        assert!(whole.counts.entries > 100, "{:?}", whole.counts);
        for room in [200, 50, 3, 0] {
            setup.context.most_entries = room;
            let parts = setup.context.draw(place, &near, &mut ());
            assert_eq!(
                (&parts.colors, &parts.lengths, &parts.boxes),
                (&whole.colors, &whole.lengths, &whole.boxes)
            );
            assert_eq!(parts.counts, whole.counts);
        }
    }
}
