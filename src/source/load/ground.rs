//! The terrain's own colour.

use super::blame::Named;
use super::picture;
use super::terrain::Terrain;
use crate::error::{Error, Result};
use crate::scene::{Ground, GroundColors, Imagery};
use crate::scene_file::{GroundColorsSpec, SceneFile};
use crate::source::dem::site::Site;
use crate::source::dem::world_file;
use crate::space::{Plan, PlanBox};
use glam::DVec2;
use std::path::Path;

/// The ground that a scene asks for.
pub(super) fn ground(scene: &SceneFile, terrain: &Terrain, progress: &dyn Fn(&str)) -> Result<Ground> {
    let spec = &scene.terrain.ground;
    let colors = |colors| Ground { colors, light: spec.light };
    let file = match &spec.colors {
        GroundColorsSpec::Constant(color) => return Ok(colors(GroundColors::Constant(*color))),
        GroundColorsSpec::Imagery(file) => file,
    };
    let named = Named::new(scene, file);
    named.require()?;
    progress(&format!("reading {}", file.written));
    let imagery = imagery(named.path(), terrain).map_err(|error| named.blame(error))?;
    Ok(colors(GroundColors::Imagery(imagery)))
}

fn imagery(path: &Path, terrain: &Terrain) -> Result<Imagery> {
    let texels = picture::texels(path)?;
    let extent = extent(path, (texels.width(), texels.height()), terrain)?;
    Ok(Imagery { texels, extent })
}

/// What the image covers: what a world file beside it says, in the coordinates of the plan's CRS, else the terrain.
fn extent(path: &Path, size: (usize, usize), terrain: &Terrain) -> Result<PlanBox> {
    let Some(frame) = world_file::frame_beside(&Site::on_disk(path), size)? else {
        return Ok(terrain.bounds);
    };
    if !frame.is_upright() {
        return Err(Error::new("the world file beside the image turns or mirrors it")
            .help("warp it upright first: gdalwarp FILE OUT.tif"));
    }
    let [x0, y0, x1, y1] = frame.edges();
    let corners = [DVec2::new(x0, y0), DVec2::new(x1, y1)];
    // The image lies on the terrain wherever that is moved.
    let shift = -terrain.place.anchor;
    let place = |p: DVec2| -> Result<Plan> {
        let plan = match &terrain.place.space {
            Some(space) => space.plan_from(space.crs())?.apply(p)?,
            None => p,
        };
        Ok(Plan::from(plan + shift))
    };
    let [low, high] = corners.map(place);
    Ok(PlanBox { min: low?, max: high? })
}
