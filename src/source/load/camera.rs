//! The camera: where the scene says, else from the south with the layers in view.

use super::blame::of_key;
use super::extent::{REACH, height_range, in_reach};
use super::terrain::Terrain;
use super::{globe, layer};
use crate::error::{Error, Result};
use crate::math::max;
use crate::scene::{Camera, Layer, Projection};
use crate::scene_file::{SceneFile, Spot, check_view};
use crate::space::{Plan, PlanBox, ViewFrame, World};
use glam::DVec3;

/// The least share of the terrain that a view chosen by the program shows.
const LEAST: f64 = 1.0 / 32.0;

/// The camera of a scene, in local coordinates.
pub(super) fn camera(scene: &SceneFile, terrain: &Terrain, layers: &[Layer]) -> Result<Camera> {
    let spec = &scene.camera;
    let (eye, target) = match spec.view {
        Some(view) => {
            let spot = |spot, name: &str| {
                let ending = if matches!(spot, Spot::Geo(_)) { "_geo" } else { "" };
                place(spot, terrain).map_err(|error| of_key(scene, &format!("camera.{name}{ending}"), error))
            };
            (spot(view.eye, "eye")?, spot(view.target, "target")?)
        }
        None => framing(scene, terrain, layers)?,
    };
    for (at, key) in [(eye, "camera.eye"), (target, "camera.target")] {
        if !at.to_vec().to_array().into_iter().all(in_reach) {
            let error = Error::new(format!("a place more than {REACH:e} m from the terrain"))
                .help("coordinates are metres in the scene's plan space");
            return Err(of_key(scene, key, error));
        }
    }
    let up = spec
        .up
        .unwrap_or_else(|| terrain.globe().map_or(DVec3::Z, |posts| globe::up(&posts.globe, eye, target)));
    check_view(eye.to_vec(), target.to_vec(), up).map_err(|error| of_key(scene, "camera", error))?;
    Ok(Camera { eye, target, up, projection: spec.projection, near_m: spec.near_m, far_m: spec.far_m })
}

/// A spot in local coordinates.
fn place(spot: Spot, terrain: &Terrain) -> Result<World> {
    if let (Some(posts), Some(space)) = (terrain.globe(), &terrain.place.space) {
        let Spot::Geo(at) = spot else {
            return Err(Error::new("plan coordinates are no place of a globe's world")
                .help("write eye_geo and target_geo: [longitude, latitude, height above the ellipsoid]"));
        };
        let own = space.crs().native_from_geographic(at.truncate())?
            * space.crs().degrees_per_unit().unwrap_or(1.0);
        return Ok(globe::place(&posts.globe, own.extend(at.z)));
    }
    let at: DVec3 = match spot {
        Spot::Plan(at) => at,
        Spot::Geo(at) => {
            let space = terrain.place.space.as_ref().ok_or_else(|| {
                Error::new("longitude and latitude have no place in a plan without a CRS")
                    .help("say the scene's `crs` or the terrain's, or write plan coordinates: eye, target")
            })?;
            space.plan_from_geographic(at.x, at.y)?.extend(at.z)
        }
    };
    Ok(terrain.place.local(at))
}

/// Eye and target of a view that shows the layers, or the terrain where there are none on it.
fn framing(scene: &SceneFile, terrain: &Terrain, layers: &[Layer]) -> Result<(World, World)> {
    let bounds = subject(terrain, layers);
    let aspect = scene.image.width as f64 / scene.image.height as f64;
    let heights = height_range(&terrain.surface, &bounds);
    if let Some(posts) = terrain.globe() {
        return globe::framing(posts, &bounds, heights, scene.camera.projection, aspect);
    }
    let fov_y_deg = match scene.camera.projection {
        Projection::Perspective { fov_y_deg } => fov_y_deg,
        Projection::Orthographic { .. } => 45.0,
    };
    Ok(ViewFrame::framing(&bounds, heights, fov_y_deg, aspect))
}

/// What is worth seeing: the layers' box as far as there is terrain.
fn subject(terrain: &Terrain, layers: &[Layer]) -> PlanBox {
    let whole = terrain.bounds;
    let mut seen = PlanBox::EMPTY;
    for feature in layers.iter().flat_map(|layer| &layer.features) {
        let of = layer::bounds(&feature.shape);
        if of.meets(&whole) {
            let (low, high) = (whole.min.to_vec(), whole.max.to_vec());
            seen.include(Plan::from(of.min.to_vec().clamp(low, high)));
            seen.include(Plan::from(of.max.to_vec().clamp(low, high)));
        }
    }
    if seen.is_empty() {
        return whole;
    }
    let (size, all) = (seen.max - seen.min, whole.max - whole.min);
    let lacking = max(all.x, all.y) * LEAST - max(size.x, size.y);
    seen.grown(max(0.5 * lacking, 0.0))
}
