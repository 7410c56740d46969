//! Which triangle each sample sees, and the surface point it sees there.
//!
//! Input: a [`ViewFrame`], a [`Mesh`], a [`Lattice`] of samples. Output: [`Visible`]: the triangle of each sample and a depth
//! key; [`Hit`]: the exact plan point and view depth of a sample. Tiles are drawn in parallel, each from the nearest node of
//! the terrain's hierarchy to the farthest, leaving out what lies outside the tile or behind what has been drawn, so that
//! the cost follows what is seen. Refuses: nothing; a sample that sees no terrain has triangle [`SKY`].

mod hit;

pub use hit::{Hit, hit};

use crate::parallel;
use crate::raster::{Counts, Facet, Lattice, Patch, Tile, TileView};
use crate::space::ViewFrame;
use crate::terrain::{Mesh, Node, SKY};

/// The default side of a tile in samples: its keys and triangles fit the second-level cache.
pub const TILE: usize = 128;

/// What the samples of one tile see.
#[derive(Debug)]
pub struct VisibleTile {
    /// Lattice column of the first sample.
    pub column: usize,
    /// Lattice row of the first sample.
    pub row: usize,
    /// Samples a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The triangle of each sample, rows from the top; [`SKY`] where none is seen.
    pub ids: Vec<u32>,
    /// The depth key of each sample (see [`Tile`]).
    pub keys: Vec<f32>,
    /// What was done.
    pub counts: Counts,
}

/// The first samples (column, row) of the tiles of a lattice, row by row.
pub fn tiles_of(lattice: &Lattice, size: usize) -> Vec<(usize, usize)> {
    let columns = (0..lattice.columns).step_by(size);
    (0..lattice.rows)
        .step_by(size)
        .flat_map(|r| columns.clone().map(move |c| (c, r)))
        .collect()
}

/// What one tile sees.
pub fn see_tile(
    frame: &ViewFrame,
    mesh: &Mesh,
    lattice: &Lattice,
    first: (usize, usize),
    size: usize,
) -> VisibleTile {
    let mut tile = Tile::new(TileView::new(frame, lattice, first, size), mesh);
    draw_node(&mut tile, mesh, mesh.root());
    let (width, height) = (tile.view.width, tile.view.height);
    let mut ids = Vec::with_capacity(width * height);
    let mut keys = Vec::with_capacity(width * height);
    for r in 0..height {
        let start = tile.row_start(r);
        ids.extend_from_slice(&tile.ids[start..start + width]);
        keys.extend_from_slice(&tile.keys[start..start + width]);
    }
    VisibleTile {
        column: first.0,
        row: first.1,
        width,
        height,
        ids,
        keys,
        counts: tile.counts,
    }
}

/// What a whole lattice sees: the triangle and the depth key of each sample, rows from the top.
pub fn see(frame: &ViewFrame, mesh: &Mesh, lattice: &Lattice, size: usize) -> (Vec<u32>, Vec<f32>, Counts) {
    let tiles = tiles_of(lattice, size);
    let seen = parallel::map(&tiles, |&first| see_tile(frame, mesh, lattice, first, size));
    let mut ids = vec![SKY; lattice.columns * lattice.rows];
    let mut keys = vec![f32::NEG_INFINITY; ids.len()];
    let mut counts = Counts::default();
    for tile in seen {
        counts = counts.plus(tile.counts);
        for r in 0..tile.height {
            let at = (tile.row + r) * lattice.columns + tile.column;
            ids[at..at + tile.width].copy_from_slice(&tile.ids[r * tile.width..(r + 1) * tile.width]);
            keys[at..at + tile.width].copy_from_slice(&tile.keys[r * tile.width..(r + 1) * tile.width]);
        }
    }
    (ids, keys, counts)
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
    let rectangle = if is_beyond_eye {
        Some(reach.rectangle())
    } else {
        None
    };
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
        let patch = rectangle
            .as_ref()
            .and_then(|r| Patch::new(&tile.view, reach.depth, reach.size, r));
        draw_leaf(tile, mesh, node, patch);
        if let Some((from, to)) = rectangle.and_then(|r| tile.samples_in(r)) {
            tile.touch(from, to);
        }
    }
}

fn draw_children(tile: &mut Tile, mesh: &Mesh, node: Node) {
    let mut children = [(0.0, node); 4];
    let mut count = 0;
    mesh.for_each_child(node, |child| {
        let depth = mesh
            .bounds(child)
            .map_or(f64::INFINITY, |b| tile.view.frame.depth(b.center));
        children[count] = (depth, child);
        count += 1;
    });
    children[..count].sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, child) in children.into_iter().take(count) {
        draw_node(tile, mesh, child);
    }
}

fn draw_leaf(tile: &mut Tile, mesh: &Mesh, node: Node, patch: Option<Patch>) {
    match (mesh, patch) {
        (Mesh::Grid(grid), Some(patch)) => patch.draw_grid(tile, grid, node),
        (Mesh::Tin(tin), Some(patch)) => patch.draw_tin(tile, tin, tin.leaf(node)),
        (Mesh::Grid(grid), None) => {
            let (columns, rows) = grid.cells(node);
            for j in rows {
                let first = grid.first_triangle(columns.start, j);
                draw_facets(tile, mesh, first..first + 2 * columns.len() as u32);
            }
        }
        (Mesh::Tin(tin), None) => draw_facets(tile, mesh, tin.leaf(node)),
    }
}

fn draw_facets(tile: &mut Tile, mesh: &Mesh, ids: std::ops::Range<u32>) {
    for id in ids {
        if let Some(corners) = mesh.triangle(id) {
            Facet::draw(tile, id, &corners);
        }
    }
}
