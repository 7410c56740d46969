//! One frame: rows of pixels, and the buffers of what was decided on the way.

use super::edge_index::EdgeIndex;
use super::pixel::{Counts, GUARD, PixelPainter};
use super::step::{PixelClass, Step};
use super::structures;
use super::touched::touch;
use crate::buffer::{Buffer, Plane, Touches, Values};
use crate::canvas::{Frame, FrameOptions, Kept, Pixels, joined, picture_plane, sight_counts, surface_plane};
use crate::parallel;
use crate::resolve::code_values;
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::technique::inverse_projection::Settings;
use crate::visibility::TILE;

/// The buffers in the order in which a frame has them.
const ORDER: [&str; 7] = ["depth", "triangle", "plan", "color", "class", "quad", "edges"];

/// A row of finished pixels.
struct Row {
    pixels: Pixels,
    classes: Kept<u8>,
    edges: Kept<u32>,
    quads: Kept<[f64; 8]>,
    touches: Touches,
    counts: Counts,
}

/// Draws a frame of a view.
pub fn draw(
    (stage, view): (&Stage, &ViewFrame),
    settings: &Settings,
    index: &EdgeIndex,
    options: &FrameOptions,
) -> Frame {
    let mesh = &*stage.mesh_for(view);
    let how = (options.tile, options.wants("quad"));
    let painter = PixelPainter::new((stage, mesh, view), settings, index, how);
    (options.progress)(0.5);
    let (width, height) = (view.width(), view.height());
    let progress = |share: f64| (options.progress)(0.5 + 0.5 * share);
    let mut rows = parallel::map_telling(height, &progress, |y| {
        row((&painter, settings.samples, index), y, width, options)
    });
    let mut touches = options.touches(width);
    rows.iter_mut().for_each(|row| touches.take(std::mem::take(&mut row.touches)));
    let codes = joined(rows.iter().map(|row| row.pixels.codes()));
    let wanted = ORDER.into_iter().filter(|name| options.wants(name));
    let mut planes = structures::planes(index, stage.draw_list.items(), options);
    planes.extend(wanted.filter_map(|name| plane(name, &painter, &rows, [width, height])));
    planes.extend(touches.planes(height, &|name| options.wants(name)));
    Frame { image: Buffer::from_values(width, height, codes), planes, counts: counts(&painter, index, &rows) }
}

/// Decides single pixels of a view as a frame does: of each its steps and its code values.
pub fn explain(
    (stage, view): (&Stage, &ViewFrame),
    settings: &Settings,
    index: &EdgeIndex,
    pixels: &[[usize; 2]],
) -> Vec<(Vec<Step>, [u8; 4])> {
    let mesh = &*stage.mesh_for(view);
    let painter = PixelPainter::new((stage, mesh, view), settings, index, (TILE, false));
    let explained = |[x, y]: &[usize; 2]| {
        let mut steps = Vec::new();
        let pixel = painter.pixel((*x, *y), &mut painter.lists(), &mut Counts::default(), &mut steps);
        (steps, code_values(painter.backdrop().compositor.encoded(pixel.paint)))
    };
    pixels.iter().map(explained).collect()
}

fn row(
    (painter, n, index): (&PixelPainter, u32, &EdgeIndex),
    y: usize,
    width: usize,
    options: &FrameOptions,
) -> Row {
    let mut row = Row {
        pixels: Pixels::new(painter.backdrop().compositor, width, options.wants("color")),
        classes: Kept::new(options.wants("class")),
        edges: Kept::new(options.wants("edges")),
        quads: Kept::new(options.wants("quad")),
        touches: options.touches(width),
        counts: Counts::default(),
    };
    let mut lists = painter.lists();
    for x in 0..width {
        let pixel = if row.touches.is_wanted() {
            let mut steps = Vec::new();
            let pixel = painter.pixel((x, y), &mut lists, &mut row.counts, &mut steps);
            touch((index, n), &steps, [x, y], &mut row.touches);
            pixel
        } else {
            painter.pixel((x, y), &mut lists, &mut row.counts, &mut ())
        };
        if pixel.class == PixelClass::N {
            row.pixels.push_ground(pixel.paint)
        } else {
            row.pixels.push(pixel.paint)
        }
        row.classes.push(|| pixel.class as u8);
        row.edges.push(|| pixel.edges);
        row.quads.push(|| {
            let [a, b, c, d] = pixel.quad.0;
            [a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y]
        });
        row.counts.classes[pixel.class as usize] += 1;
    }
    row
}

fn plane(name: &str, painter: &PixelPainter, rows: &[Row], size: [usize; 2]) -> Option<Plane> {
    Some(match name {
        "color" => {
            let colors = joined(rows.iter().map(|row| row.pixels.colors().as_flattened()));
            picture_plane("color", size, 4, Values::F64(colors))
        }
        "class" => {
            let classes = joined(rows.iter().map(|row| row.classes.values()));
            picture_plane("class", size, 1, Values::U8(classes))
        }
        "quad" => {
            let quads = joined(rows.iter().map(|row| row.quads.values().as_flattened()));
            picture_plane("quad", size, 8, Values::F64(quads))
        }
        "edges" => {
            let edges = joined(rows.iter().map(|row| row.edges.values()));
            picture_plane("edges", size, 1, Values::U32(edges))
        }
        _ => return surface_plane(name, painter.centres().sight(), GUARD),
    })
}

fn counts(painter: &PixelPainter, index: &EdgeIndex, rows: &[Row]) -> Vec<(&'static str, u64)> {
    let sum = |f: fn(&Counts) -> u64| rows.iter().map(|row| f(&row.counts)).sum();
    let own = [
        ("areas", index.area_count() as u64),
        ("edges", index.edge_count() as u64),
        ("pixels_n", sum(|c| c.classes[PixelClass::N as usize])),
        ("pixels_p", sum(|c| c.classes[PixelClass::P as usize])),
        ("pixels_f", sum(|c| c.classes[PixelClass::F as usize])),
        ("refused", sum(|c| c.refused)),
        ("samples", sum(|c| c.samples)),
        ("edge_tests", sum(|c| c.edge_tests)),
    ];
    own.into_iter().chain(sight_counts(&painter.centres().sight().counts())).collect()
}
