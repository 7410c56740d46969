//! The triangles of a tile, and the tile's pixels.

use super::facet::{Facet, TileRays};
use super::polygon::{self, Pieces};
use super::refine::{Pixel, Refinery};
use super::setting::Setting;
use super::visible::Sight;
use super::{Centre, PixelCoverage, Tally};
use crate::space::{Lens, PlanBox, ViewFrame, World};
use crate::terrain::{Mesh, Node};
use glam::DVec3;

/// Side of a tile in pixels: a power of two, so that it halves down to pixels.
pub(super) const TILE: usize = 32;

/// A square with more triangles than this is quartered, down to a sixteenth of a pixel.
const MOST_TRIANGLES: usize = 24;
const SMALLEST: f64 = 1.0 / 16.0;

/// The half spaces of what a rectangle of the screen sees: through the eye, or along the view.
#[derive(Debug)]
pub(super) struct Frustum {
    /// Inward normals of the sides, each with a point of its plane.
    sides: [(DVec3, World); 4],
    forward: DVec3,
    eye: World,
    near: f64,
    far: f64,
}

/// What rounding may do to the place of a box, as a share of the coordinates.
const BOX_SHARE: f64 = 1e-9;

impl Frustum {
    /// What a rectangle of the screen sees.
    pub(super) fn new(frame: &ViewFrame, [x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> Self {
        let pixel = frame.lens().pixel();
        let (half_width, half_height) = (frame.width() as f64 / 2.0, frame.height() as f64 / 2.0);
        let (right, up, forward) = (frame.right(), frame.up(), frame.forward());
        let (west, east) = ((x0 - half_width) * pixel, (x1 - half_width) * pixel);
        let (top, bottom) = ((half_height - y0) * pixel, (half_height - y1) * pixel);
        let eye = frame.eye();
        let sides = match frame.lens() {
            Lens::Central { .. } => [
                (right - forward * west, eye),
                (forward * east - right, eye),
                (up - forward * bottom, eye),
                (forward * top - up, eye),
            ],
            Lens::Parallel { .. } => [
                (right, eye + right * west),
                (-right, eye + right * east),
                (up, eye + up * bottom),
                (-up, eye + up * top),
            ],
        };
        Self { sides, forward, eye, near: frame.near(), far: frame.far() }
    }

    /// Whether a box may be seen; `center` and half extents as of [`crate::terrain::Bounds`].
    fn meets(&self, center: World, axes: &[DVec3; 3]) -> bool {
        let reach = |normal: DVec3| axes.iter().fold(0.0, |sum, axis| sum + normal.dot(*axis).abs());
        let size = center.to_vec().abs().max_element() + self.eye.to_vec().abs().max_element();
        let margin =
            |normal: DVec3| BOX_SHARE * normal.length() * (size + axes[0].length() + axes[1].length());
        let depth = self.forward.dot(center - self.eye);
        let span = reach(self.forward) + margin(self.forward);
        depth + span >= self.near
            && depth - span <= self.far
            && self.sides.iter().all(|(n, at)| n.dot(center - *at) + reach(*n) + margin(*n) >= 0.0)
    }

    /// Whether terrain between two heights over a box of the plan may be seen.
    pub(super) fn meets_plan(&self, plan: &PlanBox, (low, high): (f64, f64)) -> bool {
        let middle = plan.min.to_vec() / 2.0 + plan.max.to_vec() / 2.0;
        let half = plan.max.to_vec() / 2.0 - plan.min.to_vec() / 2.0;
        if !half.is_finite() {
            return true;
        }
        let center = World::new(middle.x, middle.y, (low + high) / 2.0);
        self.meets(center, &[DVec3::X * half.x, DVec3::Y * half.y, DVec3::Z * ((high - low) / 2.0)])
    }
}

/// A tile's answers: lower bounds, upper bounds, estimates of its pixels, rows from the top.
pub(super) struct TileTruth {
    pub(super) colors: Vec<[[f64; 4]; 3]>,
    pub(super) coverage: Vec<PixelCoverage>,
    pub(super) centres: Vec<Option<Centre>>,
    pub(super) tally: Tally,
}

/// A tile at work.
struct Work<'a> {
    setting: &'a Setting<'a>,
    rays: TileRays,
    facets: Vec<Facet>,
    /// The tile's pixels that are in the picture.
    size: [usize; 2],
    pieces: Pieces,
    sight: Sight,
    refinery: Refinery,
    out: TileTruth,
}

/// The truth of a tile whose first pixel is `corner` and which has `size` pixels in the picture.
pub(super) fn certify_tile(
    setting: &Setting,
    mesh: &Mesh,
    frame: &ViewFrame,
    (corner, size): ([usize; 2], [usize; 2]),
) -> TileTruth {
    let mut work = Work::new(setting, mesh, frame, (corner, size));
    let all = work.all();
    work.block([0, 0], TILE, &all);
    work.out.tally.pieces = work.refinery.pieces;
    work.out
}

/// The triangles that a tile may see.
fn gather(mesh: &Mesh, frustum: &Frustum, rays: &TileRays, node: Node, out: &mut Vec<Facet>) {
    if !mesh.bounds(node).is_some_and(|b| frustum.meets(b.center, &b.axes)) {
        return;
    }
    if node.level > 0 {
        return mesh.for_each_child(node, |child| gather(mesh, frustum, rays, child, out));
    }
    let mut offer = |id: u32| {
        let facet = mesh.triangle(id).and_then(|corners| Facet::new(rays, id, corners));
        out.extend(facet.filter(|facet| may_cover(facet, [0.0, 0.0], rays.span)));
    };
    match mesh {
        Mesh::Grid(grid) => {
            let (columns, rows) = grid.cells(node);
            for (i, j) in rows.flat_map(|j| columns.clone().map(move |i| (i, j))) {
                let first = grid.first_triangle(i, j);
                offer(first);
                offer(first + 1);
            }
        }
        Mesh::Tin(tin) => tin.leaf(node).for_each(offer),
    }
}

/// Whether a facet may cover some of a square.
fn may_cover(facet: &Facet, corner: [f64; 2], side: f64) -> bool {
    facet.bounds().iter().all(|form| form.range(corner, side).1 >= -form.error)
}

/// Whether a facet surely covers all of a square.
fn covers(facet: &Facet, corner: [f64; 2], side: f64) -> bool {
    facet.bounds().iter().all(|form| form.range(corner, side).0 >= form.error)
}

/// Those of some facets that a square may see: not beside it, and not behind one that covers all of it.
fn narrowed(facets: &[Facet], from: &[u32], corner: [f64; 2], side: f64) -> Vec<u32> {
    let mut near: Vec<u32> =
        from.iter().copied().filter(|&k| may_cover(&facets[k as usize], corner, side)).collect();
    let mut cover = f64::NEG_INFINITY;
    for &k in &near {
        let facet = &facets[k as usize];
        let farthest = facet.nearness_range(corner, side).0;
        if farthest > cover && covers(facet, corner, side) {
            cover = farthest;
        }
    }
    near.retain(|&k| facets[k as usize].nearness_range(corner, side).1 >= cover);
    near
}

impl<'a> Work<'a> {
    fn new(
        setting: &'a Setting<'a>,
        mesh: &Mesh,
        frame: &ViewFrame,
        (corner, size): ([usize; 2], [usize; 2]),
    ) -> Self {
        let start = corner.map(|v| v as f64);
        let rays = TileRays::new(frame, start, TILE as f64);
        let frustum = Frustum::new(frame, start, [start[0] + size[0] as f64, start[1] + size[1] as f64]);
        let mut facets = Vec::new();
        gather(mesh, &frustum, &rays, mesh.root(), &mut facets);
        let count = size[0] * size[1];
        let kept = if setting.budget.coverage { count } else { 0 };
        let out = TileTruth {
            colors: vec![[[0.0; 4]; 3]; count],
            coverage: vec![PixelCoverage::default(); kept],
            centres: vec![None; count],
            tally: Tally { triangles: facets.len() as u64, ..Tally::default() },
        };
        let (pieces, sight, refinery) = (Pieces::default(), Sight::default(), Refinery::default());
        Self { setting, rays, facets, size, pieces, sight, refinery, out }
    }

    fn all(&self) -> Vec<u32> {
        (0..self.facets.len() as u32).collect()
    }

    /// Does the pixels of a block, which sees some of these facets.
    fn block(&mut self, [x, y]: [usize; 2], side: usize, from: &[u32]) {
        if x >= self.size[0] || y >= self.size[1] {
            return;
        }
        let near = narrowed(&self.facets, from, [x as f64, y as f64], side as f64);
        if side == 1 {
            return self.pixel([x, y], &near);
        }
        let half = side / 2;
        for (dx, dy) in [(0, 0), (half, 0), (0, half), (half, half)] {
            self.block([x + dx, y + dy], half, &near);
        }
    }

    fn pixel(&mut self, [x, y]: [usize; 2], near: &[u32]) {
        self.pieces.clear();
        self.sight.clear();
        let corner = [x as f64, y as f64];
        self.square(corner, [0.0, 0.0], 1.0, near);
        let pixel = Pixel { setting: self.setting, rays: &self.rays, facets: &self.facets, corner };
        let colors = self.refinery.refine(&pixel, &mut self.pieces, &self.sight);
        let index = y * self.size[0] + x;
        self.out.colors[index] = colors;
        self.out.centres[index] = self.centre(corner);
        self.out.tally.fragments += self.sight.fragments.len() as u64;
        if self.setting.budget.coverage {
            self.out.coverage[index] = self.refinery.coverage();
        }
    }

    /// What the pixel's centre sees; where triangles meet there, one of them.
    fn centre(&self, pixel: [f64; 2]) -> Option<Centre> {
        const CENTRE: [f64; 2] = [0.5, 0.5];
        let mut fragments = self.sight.fragments.iter();
        let fragment = fragments.find(|f| polygon::holds(self.pieces.of(f.shape), CENTRE))?;
        let facet = &self.facets[fragment.facet as usize];
        let (world, _) = facet.hit(&self.rays, pixel.map(|v| v + 0.5));
        Some(Centre { triangle: facet.id, world })
    }

    /// Finds what a square of a pixel sees.
    fn square(&mut self, pixel: [f64; 2], corner: [f64; 2], side: f64, near: &[u32]) {
        if near.len() <= MOST_TRIANGLES || side <= SMALLEST {
            return self.sight.see(&mut self.pieces, &self.facets, near, (pixel, corner, side));
        }
        let half = side / 2.0;
        for (dx, dy) in [(0.0, 0.0), (half, 0.0), (0.0, half), (half, half)] {
            let corner = [corner[0] + dx, corner[1] + dy];
            let few = narrowed(&self.facets, near, [pixel[0] + corner[0], pixel[1] + corner[1]], half);
            self.square(pixel, corner, half, &few);
        }
    }
}

#[cfg(test)]
mod tests;
