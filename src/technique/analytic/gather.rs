//! The triangles that a tile may see, from near to far, through the terrain's hierarchy.

use super::facet::Facet;
use super::sheet::{Sheet, TILE};
use crate::raster::{Lattice, TileView};
use crate::space::ViewFrame;
use crate::terrain::{Leaf, MOST_CHILDREN, Mesh, Node};
use crate::tiling::TilePlace;
use glam::DVec2;

/// Fills a sheet with what a tile of a picture sees.
pub(super) fn see(view: &ViewFrame, mesh: &Mesh, place: &TilePlace, sheet: &mut Sheet) {
    let lattice = Lattice::corners(view);
    let [column, row] = place.corner;
    let tile = TileView::new(view, &lattice, (column, row), TILE + 1);
    let origin = DVec2::new(column as f64, row as f64);
    Walk { view, mesh, tile, origin, sheet }.node(mesh.root());
}

struct Walk<'a> {
    view: &'a ViewFrame,
    mesh: &'a Mesh,
    tile: TileView,
    origin: DVec2,
    sheet: &'a mut Sheet,
}

impl Walk<'_> {
    /// Adds what a node holds, the nearest child first.
    fn node(&mut self, node: Node) {
        let Some(reach) = self.mesh.bounds(node).and_then(|bounds| self.tile.reach_of(&bounds)) else {
            return;
        };
        // A box that touches the eye's plane has no picture of bounded size: it cannot be hidden.
        if self.tile.is_parallel() || reach.depth.0 > self.view.near() / 2.0 {
            let nearest = if self.tile.is_parallel() { -reach.depth.0 } else { 1.0 / reach.depth.0 };
            let [x0, y0, x1, y1] = reach.rectangle();
            let (x, y) = self.tile.first;
            if self.sheet.hides([x0 - x, y0 - y, x1 - x, y1 - y], nearest) {
                return;
            }
        }
        if node.level > 0 {
            self.children(node);
            return;
        }
        match self.mesh.leaf(node) {
            Leaf::Triangles(ids) => ids.for_each(|id| self.triangle(id)),
            Leaf::Cells(grid) => {
                let (columns, rows) = grid.cells(node);
                for (i, j) in rows.flat_map(|j| columns.clone().map(move |i| (i, j))) {
                    let first = grid.first_triangle(i, j);
                    self.triangle(first);
                    self.triangle(first + 1);
                }
            }
        }
    }

    fn children(&mut self, node: Node) {
        let mut children = [(0.0, node); MOST_CHILDREN];
        let mut count = 0;
        self.mesh.for_each_child(node, |child| {
            let depth = self.mesh.bounds(child).map_or(f64::INFINITY, |of| self.view.depth(of.center));
            children[count] = (depth, child);
            count += 1;
        });
        children[..count].sort_by(|a, b| a.0.total_cmp(&b.0));
        children[..count].iter().for_each(|(_, child)| self.node(*child));
    }

    fn triangle(&mut self, id: u32) {
        let Some(triangle) = self.mesh.surface_triangle(id) else { return };
        if let Some(facet) = Facet::new(self.view, self.origin, id, &triangle) {
            self.sheet.add(facet);
        }
    }
}
