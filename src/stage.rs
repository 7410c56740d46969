//! A scene, what is painted of it, and its terrain as a mesh: what the truth, supersampling and every technique draw, from any view.
//!
//! Input: a [`Scene`] and its [`Surface`], or a mesh. Output: a [`Stage`]. The view is no part of it: one stage, and whatever is prepared of
//! it, serves many frames. Refuses: a surface without a triangle, more than can be numbered.

use crate::draw_list::DrawList;
use crate::error::Result;
use crate::scene::{Scene, Surface};
use crate::space::ViewFrame;
use crate::terrain::Mesh;
use std::sync::Arc;

/// A scene ready to be drawn.
#[derive(Debug)]
pub struct Stage {
    /// The scene. Its layers have no features any more: those are in the draw list.
    pub scene: Scene,
    /// What is painted.
    pub draw_list: DrawList,
    /// The terrain: what structures that serve any view are made for. What a view shows is [`Stage::mesh_for`].
    pub mesh: Arc<Mesh>,
}

impl Stage {
    /// Decides what is painted and triangulates the terrain.
    ///
    /// # Errors
    /// When the surface has no triangle, or too many, or the layers have more than can be numbered.
    pub fn new(scene: Scene, surface: Surface) -> Result<Self> {
        let mesh = Mesh::new(surface, scene.diagonal)?;
        Self::of_mesh(scene, mesh)
    }

    /// A scene over a mesh.
    ///
    /// # Errors
    /// When there are more features than can be numbered.
    pub fn of_mesh(mut scene: Scene, mesh: Mesh) -> Result<Self> {
        let draw_list = DrawList::new(&mut scene.layers, &mesh.plan_bounds())?;
        Ok(Self { scene, draw_list, mesh: Arc::new(mesh) })
    }

    /// The mesh that a view shows; the truth, supersampling, techniques and bundles draw it. Today it is the same for every view; what it may
    /// become for one lies within the bounds of [`Stage::mesh`], in the plan and in height.
    pub fn mesh_for(&self, _view: &ViewFrame) -> Arc<Mesh> {
        Arc::clone(&self.mesh)
    }

    /// The view of the scene's own camera on its own picture.
    ///
    /// # Errors
    /// When the camera shows nothing (eye = target, `up` along the view, an angle out of range).
    pub fn view(&self) -> Result<ViewFrame> {
        self.scene.camera.view(&self.scene.image)
    }
}
