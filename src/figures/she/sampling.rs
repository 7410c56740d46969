//! Figs. 2, 7 and 8: one sample a pixel, and many in those that need them.

use super::super::drawing::Drawing;
use super::super::figure::{Figure, Panel, Paper, Scale};
use super::super::pixel_grid::PixelGrid;
use super::super::shot::Shot;
use super::areas::{EDGES, edges};
use crate::error::Result;
use crate::technique::Kind;

const PIXELS: &str = include_str!("pixels.toml");
/// Units of a pixel in a drawing.
const SIDE: f64 = 40.0;

/// A line of more than a pixel's width, and one of less.
const WIDTHS: [(&str, &str); 2] = [("2.6", "wider than a pixel"), ("0.55", "narrower than a pixel")];

pub(super) const FIGURE_2: Figure = Figure {
    name: "she-2",
    paper: Paper::She,
    number: "Fig. 2",
    title: "One sample a pixel",
    caption: "A line that is wider than a pixel and one that is narrower; whether stencil volumes hold the centre of each pixel; what becomes of it.",
    look_for: "stairs where the line is wide, gaps where it is narrow: between two centres it is not seen.",
    draw: figure_2,
};

pub(super) const FIGURE_7: Figure = Figure {
    name: "she-7",
    paper: Paper::She,
    number: "Fig. 7",
    title: "Classes of pixels, and samples in those on a border",
    caption: "The same lines by inverse projection: pixels without the line (N), on its border (P) and wholly in it (F); 3 x 3 samples in P pixels; the picture.",
    look_for: "borders are blended, the narrow line is whole and faint. No F pixel where it is narrow.",
    draw: figure_7,
};

pub(super) const FIGURE_8: Figure = Figure {
    name: "she-8",
    paper: Paper::She,
    number: "Fig. 8",
    title: "Where samples lie",
    caption: "3 x 3 samples of a pixel on the screen, and in the pixel's quadrilateral in the plan, between whose corners (what the centres of four \
              neighbours see) they are interpolated.",
    look_for: "the quadrilateral is long: the pixel sees the ground at a low angle. The samples are even in it, as they are on the screen.",
    draw: figure_8,
};

fn width(metres: &str) -> String {
    format!("layer.line.line.width_m={metres}")
}

fn figure_2(_: Scale) -> Result<Vec<Panel>> {
    let mut panels = Vec::new();
    for (metres, words) in WIDTHS {
        let width = width(metres);
        let shot = Shot::of(PIXELS, &[&width])?;
        let grid = PixelGrid::new(&shot, SIDE);
        panels.push(Panel::drawing(format!("a line {words}"), outlined(&shot, &grid)?.svg()));
        let mut sampled = outlined(&shot, &grid)?;
        grid.samples(&mut sampled, [PIXELS, &width], 1, &|_| true)?;
        panels.push(Panel::drawing("its pixels' centres", sampled.svg()));
        let mut drawn = grid.drawing("the picture");
        grid.picture(&mut drawn, &shot.by(Kind::StencilVolume)?)?;
        grid.lines(&mut drawn);
        panels.push(Panel::drawing("stencil volumes, one sample a pixel", drawn.svg()));
    }
    Ok(panels)
}

/// The line's borders over the pixels.
fn outlined(shot: &Shot, grid: &PixelGrid) -> Result<Drawing> {
    let mut drawing = grid.drawing("a line over pixels");
    grid.lines(&mut drawing);
    for edge in edges(&shot.frame(Kind::InverseProjection, &EDGES)?)? {
        drawing.line(&grid.all(&[edge.from, edge.to]), "orange edge");
    }
    Ok(drawing)
}

fn figure_7(_: Scale) -> Result<Vec<Panel>> {
    let mut panels = Vec::new();
    for (metres, words) in WIDTHS {
        let width = width(metres);
        let shot = Shot::of(PIXELS, &[&width])?;
        let grid = PixelGrid::new(&shot, SIDE);
        let frame = shot.frame(Kind::InverseProjection, &["class"])?;
        let classes = frame.whole::<1>("class")?;
        let columns = shot.view.width();
        let class = |[x, y]: [usize; 2]| classes[y * columns + x][0];
        let mut classed = grid.drawing("the classes of pixels");
        for k in 0..classes.len() {
            let pixel = [k % columns, k / columns];
            let (look, word) = [("grid area faint", "N"), ("orange area", "P"), ("blue area", "F")]
                .get(class(pixel) as usize)
                .copied()
                .unwrap_or_default();
            let square = grid.square(pixel);
            classed.ring(&square, look);
            classed.small([square[0][0] + 0.5 * SIDE, square[0][1] + 0.6 * SIDE], "middle", word);
        }
        panels.push(Panel::drawing(format!("a line {words}: classes"), with_borders(classed, &shot, &grid)?));
        let mut sampled = grid.drawing("samples of pixels on the border");
        grid.samples(&mut sampled, [PIXELS, &width], 3, &|pixel| class(pixel) == 1)?;
        panels.push(Panel::drawing("3 x 3 samples in P pixels", with_borders(sampled, &shot, &grid)?));
        let mut drawn = grid.drawing("the picture");
        grid.picture(&mut drawn, frame.image())?;
        grid.lines(&mut drawn);
        panels.push(Panel::drawing("inverse projection, 3 x 3 samples", drawn.svg()));
    }
    Ok(panels)
}

/// A drawing with the pixels' lines and the line's borders over it.
fn with_borders(mut drawing: Drawing, shot: &Shot, grid: &PixelGrid) -> Result<String> {
    grid.lines(&mut drawing);
    for edge in edges(&shot.frame(Kind::InverseProjection, &EDGES)?)? {
        drawing.line(&grid.all(&[edge.from, edge.to]), "ink edge");
    }
    Ok(drawing.svg())
}

fn figure_8(_: Scale) -> Result<Vec<Panel>> {
    super::quads::sample_spaces()
}
