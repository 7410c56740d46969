//! What a lattice of samples sees, exactly or as a machine would.

use super::{Hit, Visible, hit};
use crate::raster::Lattice;
use crate::scene::Device;
use crate::space::ViewFrame;
use crate::terrain::{Mesh, SKY};

/// A view of the terrain through a lattice of samples.
#[derive(Debug)]
pub struct Sight<'a> {
    frame: &'a ViewFrame,
    mesh: &'a Mesh,
    visible: Visible,
}

impl<'a> Sight<'a> {
    /// Room for a view; nothing has been seen yet.
    pub fn new(
        frame: &'a ViewFrame,
        mesh: &'a Mesh,
        _device: &Device,
        lattice: &Lattice,
        tile: usize,
    ) -> Self {
        Self {
            frame,
            mesh,
            visible: Visible::new(lattice, tile),
        }
    }

    /// Finds what each sample sees.
    pub fn see(&mut self) {
        self.visible.see(self.frame, self.mesh);
    }

    /// The triangle that a sample sees, [`SKY`] for none.
    #[inline]
    pub fn triangle(&self, column: usize, row: usize) -> u32 {
        self.visible.triangle(column, row)
    }

    /// Where a sample's ray meets the terrain.
    #[inline]
    pub fn hit(&self, column: usize, row: usize) -> Option<Hit> {
        let id = self.triangle(column, row);
        if id == SKY {
            return None;
        }
        let ray = self.frame.ray(self.visible.lattice.at(column, row));
        self.mesh
            .triangle(id)
            .map(|triangle| hit(self.frame, &ray, &triangle))
    }
}
