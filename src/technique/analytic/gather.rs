//! The triangles that a tile may see, from near to far, through the terrain's hierarchy.

use super::facet::{Corner, Facet};
use super::sheet::{Sheet, TILE};
use crate::math;
use crate::raster::{Lattice, TileView};
use crate::resolve::Paint;
use crate::space::{Plan, PlanBox, ViewFrame, World};
use crate::terrain::{Grid, Leaf, MOST_CHILDREN, Mesh, Node};
use crate::tiling::TilePlace;
use glam::DVec2;

/// Fills a sheet with what a tile of a picture sees; `ground` is the paint of a triangle.
pub(super) fn see(
    view: &ViewFrame,
    mesh: &Mesh,
    place: &TilePlace,
    ground: &dyn Fn(u32) -> Paint,
    sheet: &mut Sheet,
) {
    let lattice = Lattice::corners(view);
    let [column, row] = place.corner;
    let tile = TileView::new(view, &lattice, (column, row), TILE + 1);
    let origin = DVec2::new(column as f64, row as f64);
    Walk { view, mesh, tile, origin, ground, sheet, posts: Vec::new() }.node(mesh.root());
    sheet.finish();
}

struct Walk<'a> {
    view: &'a ViewFrame,
    mesh: &'a Mesh,
    tile: TileView,
    origin: DVec2,
    ground: &'a dyn Fn(u32) -> Paint,
    sheet: &'a mut Sheet,
    /// The posts of a leaf, row by row.
    posts: Vec<Post>,
}

/// A post of a grid in a view.
#[derive(Debug, Clone, Copy)]
struct Post {
    corner: Corner,
    world: World,
    /// A bit for each side of the tile that it lies beyond.
    beyond: u8,
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
            Leaf::Cells(grid) => self.cells(grid, node),
        }
    }

    /// Adds the cells of a leaf, each post projected once.
    fn cells(&mut self, grid: &Grid, node: Node) {
        let (columns, rows) = grid.cells(node);
        self.posts.clear();
        for j in rows.start..=rows.end {
            for i in columns.start..=columns.end {
                let world = grid.posts().world(i, j);
                let corner = Corner::new(self.view, self.origin, world);
                let beyond = if corner.is_before(self.view) { beyond(corner.screen) } else { 0 };
                self.posts.push(Post { corner, world, beyond });
            }
        }
        let across = columns.len() + 1;
        for (j, i) in rows.clone().flat_map(|j| columns.clone().map(move |i| (j, i))) {
            let at = (j - rows.start) * across + i - columns.start;
            let of = [at, at + 1, at + across, at + across + 1];
            if of.iter().fold(u8::MAX, |all, post| all & self.posts[*post].beyond) != 0 {
                continue;
            }
            let first = grid.first_triangle(i, j);
            for half in 0..2 {
                let of = grid.half_corners(i, j, half == 1);
                let of = of.map(|(di, dj)| self.posts[at + dj * across + di]);
                // A hole's post is no number.
                if of.iter().all(|post| post.world.z.is_finite()) {
                    let plan = || of.map(|post| post.world.plan());
                    self.add(first + half, of.map(|post| post.corner), plan);
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
        let corners = triangle.world.map(|corner| Corner::new(self.view, self.origin, corner));
        self.add(id, corners, || triangle.plan());
    }

    fn add(&mut self, id: u32, corners: [Corner; 3], plan: impl Fn() -> [Plan; 3]) {
        if corners.iter().all(|corner| corner.is_before(self.view)) {
            let screen = corners.map(|corner| corner.screen);
            let [a, b, c] = screen;
            let (low, high) = (a.min(b).min(c), a.max(b).max(c));
            let [p, q, r] = corners.map(|corner| corner.key);
            let keys = [math::min(math::min(p, q), r), math::max(math::max(p, q), r)];
            if self.sheet.hides([low.x, low.y, high.x, high.y], keys[1]) {
                return;
            }
            let is_whole = corners.iter().all(|corner| corner.is_between_planes(self.view));
            let (bounds, ground) = (|| PlanBox::around(plan()), || (self.ground)(id));
            if is_whole && self.sheet.add_speck(&screen, keys, bounds, ground) {
                return;
            }
        }
        if let Some(mut facet) = Facet::new(self.view, id, &corners, plan()) {
            facet.ground = (self.ground)(id);
            let outline = facet.outline(self.view, &corners);
            self.sheet.add(facet, &outline);
        }
    }
}

/// A bit for each side of a tile that a place of the screen lies beyond.
fn beyond(at: DVec2) -> u8 {
    // More than what is taken for touching.
    const HAIR: f64 = 1e-3;
    let most = TILE as f64 + HAIR;
    [at.x < -HAIR, at.x > most, at.y < -HAIR, at.y > most]
        .into_iter()
        .fold(0, |bits, is| bits << 1 | u8::from(is))
}
