//! A checked scene file -> the scene in memory: the data files read, brought into one plan and made scene-local.
//!
//! Input: a [`SceneFile`]. Output: a [`Scene`] and its [`Surface`], with notes on all that a user should know of the
//! input. Refuses what the readers refuse, coordinates outside a projection's domain, and a camera without a view;
//! every refusal names the data file and the line of the scene that names it.
//!
//! # The plan
//! The scene's `crs`, else the CRS of the terrain, else (a terrain in degrees) the local plane at the middle of the part
//! that is read, rounded to a thousandth of a degree. A terrain without a CRS makes a plan without one: coordinates are
//! taken as they are, in metres. A terrain that its map to the plan leaves a regular grid stays one; any other is resampled
//! once. `window` and `bounds` count in the terrain file's own coordinates, whatever the plan.
//!
//! # The origin
//! A terrain has an *anchor*, an absolute place of the plan that depends on its data alone: (0, 0) for generated terrain
//! and on the local plane, else the middle rounded to whole metres. [`Scene::origin`] is the anchor plus the terrain's
//! `offset`; local coordinates are taken from the anchor, and never pass through the offset:
//! - the posts' local coordinates do not depend on the offset;
//! - a layer's shift is `(layer offset - terrain offset) - anchor`, so that a terrain and layers moved by the same offset
//!   keep every bit;
//! - what the scene file states in plan coordinates (camera, inline features, windows of generators) is shifted by
//!   `-terrain offset - anchor`: exact where the numbers are;
//! - heights are local too: those of the data stay as they are, what raises the terrain is taken from the camera's.

mod attributes;
mod blame;
mod camera;
mod changes;
mod columns;
mod cut;
mod extent;
mod filter;
mod follow;
mod globe;
mod ground;
mod ground_curve;
mod layer;
mod off_terrain;
mod order;
mod picture;
mod place;
mod reproject;
mod resample;
mod size;
mod styling;
mod terrain;
mod unroll;
mod window;

#[cfg(test)]
mod tests;

pub use attributes::attributes;
pub use off_terrain::is_about_extent;
pub use place::{crs_of, default_plan_space, scale_error};

use crate::error::Result;
use crate::scene::{Scene, Surface};
use crate::scene_file::SceneFile;

/// Reads everything that a scene names. `progress` is told what is being read.
///
/// ```
/// use drapery::scene_file::{DEFAULT_SCENE, SceneFile};
/// let file = SceneFile::parse(DEFAULT_SCENE, None, &[])?;
/// let (scene, surface) = drapery::source::load::load(&file, &|_| ())?;
/// let stage = drapery::stage::Stage::new(scene, surface)?;
/// assert_eq!(stage.scene.origin, glam::DVec3::ZERO);
/// # Ok::<(), drapery::Error>(())
/// ```
///
/// # Errors
/// See the module.
pub fn load(file: &SceneFile, progress: &dyn Fn(&str)) -> Result<(Scene, Surface)> {
    let mut notes = Vec::new();
    let terrain = terrain::terrain(file, progress, &mut notes)?;
    let layers = layer::layers(file, &terrain, progress, &mut notes)?;
    let camera = camera::camera(file, &terrain, &layers)?;
    let ground = ground::ground(file, &terrain, progress, &mut notes)?;
    let scene = Scene {
        name: file.name.clone(),
        origin: terrain.place.origin(),
        plan_space: terrain.place.words(),
        globe: terrain.globe().map(|posts| posts.globe),
        image: file.image,
        camera,
        diagonal: file.terrain.diagonal,
        lod: file.terrain.lod,
        ground,
        layers,
        compositing: file.compositing,
        device: file.device,
        technique: file.technique.clone(),
        notes,
    };
    Ok((scene, terrain.surface))
}
