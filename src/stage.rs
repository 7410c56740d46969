//! A scene, what is painted of it, and its terrain as a mesh: what the truth, supersampling and every technique draw, from any view.
//!
//! Input: a [`Scene`] and its [`Surface`], or a mesh. Output: a [`Stage`]. The view is no part of it: one stage, and whatever is prepared of
//! it, serves many frames. Refuses: a surface without a triangle, more than can be numbered.

use crate::draw_list::DrawList;
use crate::error::{Error, Result};
use crate::scene::{LevelOfDetail, Scene, Surface};
use crate::space::ViewFrame;
use crate::terrain::Mesh;
use crate::terrain::lod::Hierarchy;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A scene ready to be drawn.
#[derive(Debug)]
pub struct Stage {
    /// The scene. Its layers have no features any more: those are in the draw list.
    pub scene: Scene,
    /// What is painted.
    pub draw_list: DrawList,
    /// The terrain: what structures that serve any view are made for. What a view shows is [`Stage::mesh_for`].
    pub mesh: Arc<Mesh>,
    /// What views' meshes are made from, where they have a level of detail of their own.
    detail: Option<ByView>,
}

/// Meshes that are made for views.
#[derive(Debug)]
struct ByView {
    hierarchy: Hierarchy,
    wanted: LevelOfDetail,
    /// The last one, so that all that draw a view take the same; no result depends on it.
    last: Mutex<Last>,
}

/// A view and its mesh.
type Last = Option<(ViewFrame, Arc<Mesh>)>;

impl Stage {
    /// Decides what is painted and triangulates the terrain. On a globe a note tells how far its triangles stray from the ellipsoid's normals.
    ///
    /// # Errors
    /// When the surface has no triangle, or too many, or the layers have more than can be numbered; when the scene wants a level of detail
    /// that the terrain does not have.
    pub fn new(mut scene: Scene, surface: Surface) -> Result<Self> {
        let mesh = Mesh::new(surface, scene.diagonal)?;
        if let Some(globe) = &scene.globe {
            let distance = |at, plan| globe.distance_on_the_ground(at, plan);
            // A level of detail is had without the triangles of all posts.
            let (which, deviation) = match scene.lod {
                None => ("its triangles", mesh.largest_deviation(distance)),
                Some(_) => ("the triangles of all posts", mesh.most_deviation(distance)),
            };
            scene.notes.push(format!(
                "globe: inside of {which} the terrain strays by up to {deviation:.3} m on the ground from where the ellipsoid's normals have it"
            ));
        }
        Self::of_mesh(scene, mesh)
    }

    /// A scene over a mesh.
    ///
    /// # Errors
    /// When there are more features than can be numbered; when the scene wants a level of detail that the mesh does not have.
    pub fn of_mesh(mut scene: Scene, mesh: Mesh) -> Result<Self> {
        let draw_list = DrawList::new(&mut scene.layers, &mesh.plan_bounds())?;
        Self::of_draw_list(scene, draw_list, Arc::new(mesh))
    }

    /// A scene that is painted as a list says, over a mesh.
    ///
    /// # Errors
    /// When the scene wants a level of detail that the mesh does not have.
    pub fn of_draw_list(scene: Scene, draw_list: DrawList, mesh: Arc<Mesh>) -> Result<Self> {
        let detail = scene.lod.map(|wanted| ByView::new(&mesh, wanted)).transpose()?;
        Ok(Self { scene, draw_list, mesh, detail })
    }

    /// The mesh that a view shows; the truth, supersampling, techniques and bundles draw it. It is the same for every view, or one with a level of
    /// detail for this one, which lies within the bounds of [`Stage::mesh`], in the plan and in height.
    pub fn mesh_for(&self, view: &ViewFrame) -> Arc<Mesh> {
        self.detail.as_ref().map_or_else(|| Arc::clone(&self.mesh), |detail| detail.mesh_for(view))
    }

    /// The view of the scene's own camera on its own picture.
    ///
    /// # Errors
    /// When the camera shows nothing (eye = target, `up` along the view, an angle out of range).
    pub fn view(&self) -> Result<ViewFrame> {
        let view = self.scene.camera.view(&self.scene.image)?;
        Ok(view.with_origin(self.scene.world_origin()))
    }
}

impl ByView {
    fn new(mesh: &Mesh, wanted: LevelOfDetail) -> Result<Self> {
        let lattice = mesh.lattice().ok_or_else(|| {
            Error::unsupported("only a grid of posts has a level-of-detail mesh")
                .help("leave `terrain.lod` out for scattered points and surfaces that are given as triangles")
        })?;
        let hierarchy = Hierarchy::new(lattice)?;
        hierarchy.check(&wanted)?;
        Ok(Self { hierarchy, wanted, last: Mutex::new(None) })
    }

    fn mesh_for(&self, view: &ViewFrame) -> Arc<Mesh> {
        if let Some(kept) = kept(&self.last(), view) {
            return kept;
        }
        // Nobody waits for a mesh: two threads may make the same one, and then take the first.
        let mesh = Arc::new(Mesh::Lod(Box::new(self.hierarchy.mesh_for(view, &self.wanted))));
        let mut last = self.last();
        kept(&last, view).unwrap_or_else(|| {
            *last = Some((*view, Arc::clone(&mesh)));
            mesh
        })
    }

    /// The last mesh; a thread that failed while it held the lock has left what was there.
    fn last(&self) -> MutexGuard<'_, Last> {
        self.last.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The mesh that is kept, if it is this view's.
fn kept(last: &Last, view: &ViewFrame) -> Option<Arc<Mesh>> {
    last.as_ref().filter(|(seen, _)| seen == view).map(|(_, mesh)| Arc::clone(mesh))
}
