//! Which triangles a view splits, and the mesh that comes of it.
//!
//! Input: a hierarchy, a view, what detail is wanted. Output: [`LodMesh`]. Refuses: a level that leaves no square of the grid.
//!
//! A triangle in view is split where its error may be more than so many pixels, seen from the nearest point of the box around it and
//! around the full surface over it (as Lindstrom et al. 1996 do with an approximation). One in which posts are missing is split down to the
//! smallest, so that holes and the grid's border are where they are. What is not in view is split only where that closes the mesh. On a globe nothing beyond
//! the horizon is in view, and the border of the posts is always where it is: a seam is none.

use super::errors::ErrorsInView;
use super::hierarchy::Hierarchy;
use super::horizon::Horizon;
use super::mesh::{Collected, Deviation, LodMesh};
use super::refinement::Refinement;
use super::right_triangle::RightTriangle;
use super::sight::Sight;
use super::tile::{MIXED, NOTHING, TILE};
use crate::error::{Error, Result};
use crate::math;
use crate::scene::{Detail, LevelOfDetail};
use crate::space::ViewFrame;
use crate::terrain::Lattice;

/// What a view is shown of a hierarchy.
struct Selection<'a> {
    hierarchy: &'a Hierarchy,
    errors: ErrorsInView<'a>,
    sight: Sight,
}

impl Hierarchy {
    /// Refuses what cannot be wanted of the grid.
    ///
    /// # Errors
    /// When the level leaves no square.
    pub fn check(&self, wanted: &LevelOfDetail) -> Result<()> {
        let [last_column, last_row] = self.extent().last;
        let most = last_column.min(last_row).ilog2();
        match wanted.detail {
            Detail::Level(level) if level > most => {
                let what = format!("every 2^{level}-th post of the terrain makes no mesh");
                Err(Error::new(what).help(format!("write a `terrain.lod.level` of at most {most}")))
            }
            _ => Ok(()),
        }
    }

    /// The mesh that a view shows.
    pub fn mesh_for(&self, view: &ViewFrame, wanted: &LevelOfDetail) -> LodMesh {
        // Where no mesh may keep to the error, the ball below it is not known.
        let horizon = match wanted.detail {
            Detail::ErrorPx(most) if wanted.borrow == 0.0 => {
                self.core().and_then(|core| Horizon::of(view, core, most))
            }
            _ => None,
        };
        let sight = Sight::of(view, horizon);
        let selection = Selection { hierarchy: self, errors: self.errors().in_view(), sight };
        let mut refinement = Refinement::new(self.extent(), wanted.borrow);
        if let Lattice::Globe(_) = self.lattice() {
            for root in self.extent().root().roots() {
                selection.close_border(root, &mut refinement);
            }
        }
        let mesh = match wanted.detail {
            Detail::ErrorPx(most) if most > 0.0 => selection.mesh_within(most, refinement),
            Detail::ErrorPx(_) => selection.mesh_at(0, refinement),
            Detail::Level(level) => selection.mesh_at(2 * level, refinement),
        };
        selection.errors.keep();
        mesh
    }
}

impl Selection<'_> {
    /// Splits what reaches beyond the posts until nothing does.
    fn close_border(&self, triangle: RightTriangle, refinement: &mut Refinement) {
        let extent = self.hierarchy.extent();
        let Some((middle, halves)) = triangle.middle().zip(triangle.halves()) else { return };
        if extent.holds(&triangle) && extent.is_beyond(&triangle) && refinement.add(middle) {
            halves.into_iter().for_each(|half| self.close_border(half, refinement));
        }
    }

    /// Splits all triangles above a layer.
    fn split_to(&self, triangle: RightTriangle, layer: u32, refinement: &mut Refinement) {
        if triangle.layer() > layer && self.hierarchy.extent().holds(&triangle) {
            triangle.middle().into_iter().for_each(|middle| _ = refinement.add(middle));
            let halves = triangle.halves().into_iter().flatten();
            halves.for_each(|half| self.split_to(half, layer, refinement));
        }
    }

    /// The mesh of all triangles of a layer.
    fn mesh_at(&self, layer: u32, mut refinement: Refinement) -> LodMesh {
        let extent = self.hierarchy.extent();
        for root in extent.root().roots() {
            self.split_to(root, layer, &mut refinement);
        }
        let mut deviation = Deviation::default();
        let is_drawn = &mut |triangle: &RightTriangle| self.is_drawn(triangle, &mut deviation);
        let collected = Collected::of(extent, refinement.vertices(), is_drawn);
        LodMesh::new(self.hierarchy.lattice(), refinement, collected, deviation)
    }

    /// The triangles as large as half a tile that are too coarse, of those below one.
    fn coarse_tiles(&self, triangle: RightTriangle, most: f64, found: &mut Vec<RightTriangle>) {
        if !self.is_too_coarse(&triangle, most) {
            return;
        }
        if triangle.layer() == 2 * TILE {
            found.push(triangle);
        } else if triangle.layer() > 2 * TILE {
            let halves = triangle.halves().into_iter().flatten();
            halves.for_each(|half| self.coarse_tiles(half, most, found));
        }
    }

    /// The mesh of which no triangle in view is more than so many pixels off.
    fn mesh_within(&self, most: f64, mut refinement: Refinement) -> LodMesh {
        let extent = self.hierarchy.extent();
        let mut coarse = Vec::new();
        for root in extent.root().roots() {
            self.coarse_tiles(root, most, &mut coarse);
        }
        self.errors.look_into(&coarse);
        for root in extent.root().roots() {
            self.split_seen(root, most, &mut refinement);
        }
        loop {
            let (mut deviation, mut coarse) = (Deviation::default(), Vec::new());
            let is_drawn = &mut |triangle: &RightTriangle| {
                if self.is_too_coarse(triangle, most) {
                    coarse.push(*triangle);
                }
                self.is_drawn(triangle, &mut deviation)
            };
            let collected = Collected::of(extent, refinement.vertices(), is_drawn);
            // The box around a half may reach a little out of its whole's, so that it is split though its whole was only because of a neighbour.
            let mut is_split = false;
            for triangle in coarse {
                is_split |= self.split_seen(triangle, most, &mut refinement);
            }
            if !is_split {
                return LodMesh::new(self.hierarchy.lattice(), refinement, collected, deviation);
            }
        }
    }

    /// Splits what may be more than so many pixels off; returns whether it did.
    fn split_seen(&self, triangle: RightTriangle, most: f64, refinement: &mut Refinement) -> bool {
        let Some((middle, halves)) = triangle.middle().zip(triangle.halves()) else { return false };
        let is_split = self.is_too_coarse(&triangle, most) && refinement.add(middle);
        if is_split {
            halves.into_iter().for_each(|half| _ = self.split_seen(half, most, refinement));
        }
        is_split
    }

    fn is_too_coarse(&self, triangle: &RightTriangle, most: f64) -> bool {
        if triangle.layer() == 0 || !self.hierarchy.extent().holds(triangle) {
            return false;
        }
        let error = self.errors.of(triangle);
        if error == NOTHING {
            return false;
        }
        let around = self.hierarchy.around(triangle, error);
        self.sight.may_show(&around) && f64::from(error) > most * self.sight.pixel_m(&around)
    }

    /// Whether a triangle of the mesh is drawn: where all posts in it are there. Adds up what is told of it.
    fn is_drawn(&self, triangle: &RightTriangle, told: &mut Deviation) -> bool {
        if triangle.layer() == 0 {
            return self.hierarchy.has_corners(triangle);
        }
        let error = self.errors.of(triangle);
        if error == NOTHING {
            return false;
        }
        let around = self.hierarchy.around(triangle, error);
        if self.sight.may_show(&around) {
            if error == MIXED {
                told.left_out += 1;
            } else {
                let metres = f64::from(error);
                told.metres = math::max(metres, told.metres);
                told.pixels = math::max(metres / self.sight.pixel_m(&around), told.pixels);
            }
        }
        error < MIXED
    }
}
