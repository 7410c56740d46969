//! The questions: what each picture draws, and where its cells are.

use super::drawing::{Picture, Rectangle, WHITE, Way};

/// Pixels a side of the pictures of edges and of what is between them: a power of two, so that single precision holds all places exactly.
pub(super) const SIDE: usize = 256;
/// Pixels a side of the pictures of samples.
pub(super) const SAMPLES_SIDE: usize = 64;
/// Pixels a side of a small cell.
pub(super) const CELL: usize = 4;
/// Pixels a side of a cell in which something is interpolated.
pub(super) const WIDE_CELL: usize = 8;
/// Places are moved in so many parts of a pixel.
pub(super) const PARTS: f64 = 2048.0;
/// How many places an edge is tried at: from a pixel's centre on, a part further each.
pub(super) const EDGE_PLACES: usize = 128;
/// How many places something is interpolated at.
pub(super) const INTERPOLATED_PLACES: usize = 128;
/// The depth that depths are compared with.
pub(super) const DEPTH: f64 = 3.0 / 32.0;
/// Differences of depth are powers of two: from 2^-8 on.
pub(super) const DEPTH_BITS: std::ops::RangeInclusive<u32> = 8..=27;
/// Places of a sample along an axis are told in sixteenths of a pixel.
pub(super) const SIXTEENTHS: usize = 16;
/// Rows of a band of texture reads.
pub(super) const BAND: usize = SIDE / 4;
/// How far apart the reads of a band are: those of the first of a pair, and of the second.
pub(super) const BAND_STEPS: [f64; 2] = [1.0 / 4096.0, 1.0 / 256.0];

/// The upper left corner of a cell of a picture, row by row.
pub(super) fn corner(cell: usize, side: usize, size: usize) -> [usize; 2] {
    let a_row = side / size;
    [cell % a_row * size, cell / a_row * size]
}

/// The first cell of the edges that run along rows, and that of the rectangle whose corners are pixels' centres.
pub(super) const ALONG_ROWS: usize = EDGE_PLACES;
/// See [`ALONG_ROWS`].
pub(super) const TIES: usize = 2 * EDGE_PLACES;

/// All pictures.
pub(super) fn pictures() -> Vec<Picture> {
    vec![
        edges(),
        samples("samples-1", 1),
        samples("samples-4", 4),
        samples("samples-8", 8),
        depths("depth", Way::Depth),
        depths("depth-reversed", Way::DepthReversed),
        interpolated(),
        Picture { name: "filter", side: SIDE, way: Way::Filtered, rectangles: Vec::new() },
    ]
}

/// Left and upper edges that lie further and further behind a pixel's centre: covered is the pixel as long as snapping takes the edge back to it.
fn edges() -> Picture {
    let mut rectangles = Vec::new();
    for place in 0..EDGE_PLACES {
        let off = 1.5 + place as f64 / PARTS;
        let [x, y] = corner(place, SIDE, CELL).map(|v| v as f64);
        rectangles.push(Rectangle::white([x + off, y + 1.0, x + 3.0, y + 2.0]));
        let [x, y] = corner(ALONG_ROWS + place, SIDE, CELL).map(|v| v as f64);
        rectangles.push(Rectangle::white([x + 1.0, y + off, x + 2.0, y + 3.0]));
    }
    let [x, y] = corner(TIES, SIDE, CELL).map(|v| v as f64);
    rectangles.push(Rectangle::white([x + 0.5, y + 0.5, x + 2.5, y + 2.5]));
    Picture { name: "edges", side: SIDE, way: Way::Flat, rectangles }
}

/// Rectangles from a pixel's upper left corner to each sixteenth of it across and down: how many samples lie in them tells where samples are.
fn samples(name: &'static str, count: u32) -> Picture {
    let cells = 0..SIXTEENTHS * SIXTEENTHS;
    let rectangles = cells.map(|cell| {
        let [x, y] = corner(cell, SAMPLES_SIDE, CELL).map(|v| v as f64 + 1.0);
        let reach = |k: usize| (k + 1) as f64 / SIXTEENTHS as f64;
        Rectangle::white([x, y, x + reach(cell % SIXTEENTHS), y + reach(cell / SIXTEENTHS)])
    });
    Picture { name, side: SAMPLES_SIDE, way: Way::Samples(count), rectangles: rectangles.collect() }
}

/// A blue rectangle, and a green one that is nearer by less and less: it is seen as long as the depth buffer tells them apart.
fn depths(name: &'static str, way: Way) -> Picture {
    let mut rectangles = Vec::new();
    let sign = if way == Way::DepthReversed { 1.0 } else { -1.0 };
    let mut difference = 1.0 / f64::from(1u32 << DEPTH_BITS.start());
    for cell in 0..DEPTH_BITS.count() {
        let [x, y] = corner(cell, SAMPLES_SIDE, CELL).map(|v| v as f64);
        let sides = [x, y, x + 3.0, y + 3.0];
        rectangles.push(Rectangle { sides, depths: [DEPTH; 2], color: [0, 0, 255] });
        rectangles.push(Rectangle { sides, depths: [DEPTH + sign * difference; 2], color: [0, 255, 0] });
        difference /= 2.0;
    }
    Picture { name, side: SAMPLES_SIDE, way, rectangles }
}

/// Rectangles four pixels wide, over which depth goes from a quarter to three quarters, moved by a part of a pixel each.
fn interpolated() -> Picture {
    let rectangles = (0..INTERPOLATED_PLACES).map(|place| {
        let [x, y] = corner(place, SIDE, WIDE_CELL).map(|v| v as f64 + 1.0);
        let x = x + place as f64 / PARTS;
        Rectangle { sides: [x, y, x + 4.0, y + 4.0], depths: [0.25, 0.75], color: WHITE }
    });
    Picture { name: "interpolation", side: SIDE, way: Way::Interpolated, rectangles: rectangles.collect() }
}
