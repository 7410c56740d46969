//! Which triangle each sample sees, and the surface point it sees there.
//!
//! Input: a [`ViewFrame`], a [`Mesh`], a [`Lattice`] of samples. Output: [`Visible`]: the triangle of each sample and a depth
//! key; [`Hit`]: the exact plan point and view depth of a sample. Tiles are drawn in parallel, each from the nearest node of
//! the terrain's hierarchy to the farthest, leaving out what lies outside the tile or behind what has been drawn, so that
//! the cost follows what is seen. [`Sight`] hides whether that or an imitated machine ([`Machine`]) found it. Refuses: nothing; a sample that sees no terrain has triangle [`SKY`].

mod device;
mod footprint;
mod hit;
mod sight;
#[cfg(test)]
mod tests;

pub use device::Machine;
pub use footprint::{FootprintPlane, PixelFootprint};
pub use hit::{Hit, hit};
pub use sight::{Planes, Sight};

use crate::parallel;
use crate::raster::{Counts, Facet, Lattice, MISSING, Patch, Samples, Tile, TileView, outcodes};
use crate::space::ViewFrame;
use crate::terrain::{Grid, Leaf, MOST_CHILDREN, Mesh, Node, SKY};
use crate::tiling::{TilePlace, Tiling};

/// The default side of a tile in samples: its keys and triangles fit the second-level cache.
pub const TILE: usize = 128;

/// What the samples of a lattice see, tile by tile: memory that is used again from frame to frame.
#[derive(Debug, Clone)]
pub struct Visible {
    /// The lattice.
    pub lattice: Lattice,
    /// The side of a tile in samples (the last ones of a row or column may be smaller).
    pub tile: usize,
    /// What each tile sees, row by row of tiles.
    pub tiles: Vec<VisibleTile>,
}

/// What the samples of one tile see.
#[derive(Debug, Clone, Default)]
pub struct VisibleTile {
    /// Lattice column of the first sample.
    pub column: usize,
    /// Lattice row of the first sample.
    pub row: usize,
    /// Samples a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Triangles and keys.
    pub samples: Samples,
    /// What was done.
    pub counts: Counts,
}

impl Visible {
    /// Room for a lattice in tiles of `tile` samples a side (1 to 512).
    pub fn new(lattice: &Lattice, tile: usize) -> Self {
        let tile = tile.clamp(1, 512);
        let tiling = Tiling::new(lattice.columns, lattice.rows, tile);
        let tiles = (0..tiling.count()).map(|k| {
            let TilePlace { corner: [column, row], size: [width, height] } = tiling.place(k);
            VisibleTile { column, row, width, height, ..VisibleTile::default() }
        });
        Self { lattice: *lattice, tile, tiles: tiles.collect() }
    }

    /// How the lattice is cut into tiles.
    fn tiling(&self) -> Tiling {
        Tiling::new(self.lattice.columns, self.lattice.rows, self.tile)
    }

    /// Finds what each sample sees.
    pub fn see(&mut self, frame: &ViewFrame, mesh: &Mesh) {
        let (lattice, size) = (self.lattice, self.tile);
        parallel::for_each(&mut self.tiles, |tile| {
            let view = TileView::new(frame, &lattice, (tile.column, tile.row), size);
            let mut drawn = Tile::new(view, mesh, &mut tile.samples);
            draw_node(&mut drawn, mesh, mesh.root());
            tile.counts = drawn.counts;
        });
    }

    /// The triangles of all samples, rows from the top.
    pub fn triangles(&self) -> Vec<u32> {
        let mut all = vec![SKY; self.lattice.columns * self.lattice.rows];
        self.write_triangles(&mut all);
        all
    }

    /// Writes the triangles of all samples, rows from the top.
    pub(super) fn write_triangles(&self, all: &mut [u32]) {
        self.gather(all, |samples| &samples.ids);
    }

    /// The depth keys of all samples (see [`Tile`]), rows from the top.
    pub fn keys(&self) -> Vec<f32> {
        let mut all = vec![f32::NEG_INFINITY; self.lattice.columns * self.lattice.rows];
        self.gather(&mut all, |samples| &samples.keys);
        all
    }

    /// What was done in all tiles.
    pub fn counts(&self) -> Counts {
        self.tiles.iter().fold(Counts::default(), |sum, tile| sum.plus(tile.counts))
    }

    /// Writes what tiles hold to where it lies in the lattice; a row of tiles is a piece of work.
    fn gather<T: Copy + Send + Sync>(&self, all: &mut [T], of: impl Fn(&Samples) -> &Vec<T> + Send + Sync) {
        let (columns, across) = (self.lattice.columns.max(1), self.tiling().across());
        parallel::for_each_chunk(all, self.tile * columns, |row, lattice_rows| {
            for tile in &self.tiles[row * across..(row + 1) * across] {
                // A tile that has not been drawn has a stride of 0, and no rows.
                let rows = of(&tile.samples).chunks(tile.samples.stride().max(1));
                for (to, from) in lattice_rows.chunks_mut(columns).zip(rows) {
                    to[tile.column..tile.column + tile.width].copy_from_slice(&from[..tile.width]);
                }
            }
        });
    }
}

/// Draws what a node holds, nearest child first.
fn draw_node(tile: &mut Tile, mesh: &Mesh, node: Node) {
    let Some(bounds) = mesh.bounds(node) else { return };
    let Some(reach) = tile.view.reach_of(&bounds) else {
        return;
    };
    tile.counts.nodes += 1;
    // A box that touches the eye's plane has no picture of bounded size: it can be neither hidden nor a patch.
    let is_beyond_eye = tile.view.is_parallel() || reach.depth.0 > tile.view.frame.near() / 2.0;
    let rectangle = if is_beyond_eye { Some(reach.rectangle()) } else { None };
    if let Some(rectangle) = rectangle {
        let nearest = tile.key_of_depth(reach.depth.0);
        if tile.hides(rectangle, nearest) {
            tile.counts.hidden_nodes += 1;
            return;
        }
    }
    if node.level > 0 {
        draw_children(tile, mesh, node);
    } else {
        let patch = rectangle.as_ref().and_then(|r| Patch::new(&tile.view, reach.depth, reach.size, r));
        draw_leaf(tile, mesh, node, patch, reach.slack);
        if let Some((from, to)) = rectangle.and_then(|r| tile.samples_in(r)) {
            tile.touch(from, to);
        }
    }
}

fn draw_children(tile: &mut Tile, mesh: &Mesh, node: Node) {
    let mut children = [(0.0, node); MOST_CHILDREN];
    let mut count = 0;
    mesh.for_each_child(node, |child| {
        let depth = mesh.bounds(child).map_or(f64::INFINITY, |b| tile.view.frame.depth(b.center));
        children[count] = (depth, child);
        count += 1;
    });
    children[..count].sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, child) in children.into_iter().take(count) {
        draw_node(tile, mesh, child);
    }
}

fn draw_leaf(tile: &mut Tile, mesh: &Mesh, node: Node, patch: Option<Patch>, slack: f64) {
    match (mesh.leaf(node), patch) {
        (Leaf::Cells(grid), Some(patch)) => patch.draw_grid(tile, grid, node),
        (Leaf::Triangles(ids), Some(patch)) => patch.draw_triangles(tile, ids),
        (Leaf::Cells(grid), None) => draw_cells(tile, grid, node, slack),
        (Leaf::Triangles(ids), None) => draw_facets(tile, mesh, ids),
    }
}

/// Draws the cells of a node that is too near or too large on the screen for a [`Patch`], leaving out triangles whose
/// corners all lie beside the tile on one side.
fn draw_cells(tile: &mut Tile, grid: &Grid, node: Node, slack: f64) {
    let (columns, rows) = grid.cells(node);
    let codes = outcodes(&tile.view, grid, node, slack);
    for j in rows.clone() {
        for i in columns.clone() {
            let code = |(di, dj): (usize, usize)| codes[j - rows.start + dj][i - columns.start + di];
            for second in [false, true] {
                let [a, b, c] = grid.half_corners(i, j, second).map(code);
                if a & b & c != 0 || (a | b | c) & MISSING != 0 {
                    continue;
                }
                let id = grid.first_triangle(i, j) + u32::from(second);
                draw_facets(tile, tile.mesh, id..id + 1);
            }
        }
    }
}

fn draw_facets(tile: &mut Tile, mesh: &Mesh, ids: std::ops::Range<u32>) {
    for id in ids {
        if let Some(corners) = mesh.triangle(id) {
            Facet::draw(tile, id, &corners);
        }
    }
}
