//! The terrain's own colour.

use super::blame::Named;
use super::picture;
use super::place::crs_of;
use super::terrain::Terrain;
use crate::crs::PlanSpace;
use crate::error::{Error, Result};
use crate::scene::{Ground, GroundColors, Imagery};
use crate::scene_file::{GroundColorsSpec, SceneFile};
use crate::source::dem::CrsHint;
use crate::source::dem::image_place::{self, ImagePlace};
use crate::space::{Plan, PlanBox};
use glam::DVec2;
use std::path::Path;

/// What to do with an image that does not lie along the plan's axes.
const UPRIGHT: &str = "warp it upright into the CRS of the plan: gdalwarp -t_srs CRS FILE OUT.tif, then gdal_translate OUT.tif OUT.png";

/// How far an image's own CRS may place its corners from where the plan's CRS does, as a part of its shorter side.
const MOST_OFF: f64 = 1e-4;

/// The ground that a scene asks for.
pub(super) fn ground(
    scene: &SceneFile,
    terrain: &Terrain,
    progress: &dyn Fn(&str),
    notes: &mut Vec<String>,
) -> Result<Ground> {
    let spec = &scene.terrain.ground;
    let colors = |colors| Ground { colors, light: spec.light };
    let file = match &spec.colors {
        GroundColorsSpec::Constant(color) => return Ok(colors(GroundColors::Constant(*color))),
        GroundColorsSpec::Imagery(file) => file,
    };
    let named = Named::new(scene, file);
    named.require()?;
    progress(&format!("reading {}", file.written));
    let note = &mut |text: String| notes.push(format!("imagery: {text}"));
    let imagery = imagery(named.path(), terrain, note).map_err(|error| named.blame(error))?;
    Ok(colors(GroundColors::Imagery(imagery)))
}

fn imagery(path: &Path, terrain: &Terrain, note: &mut dyn FnMut(String)) -> Result<Imagery> {
    let texels = picture::texels(path)?;
    let size = (texels.width(), texels.height());
    let extent = match image_place::of_image(path, size)? {
        Some(place) => extent(&place, terrain, note)?,
        None => {
            note(
                "nothing beside it says its place (a world file or an .aux.xml would): it is stretched over the whole terrain"
                    .into(),
            );
            terrain.bounds
        }
    };
    Ok(Imagery { texels, extent })
}

/// What the image covers: its place, in the coordinates of the plan's CRS.
fn extent(place: &ImagePlace, terrain: &Terrain, note: &mut dyn FnMut(String)) -> Result<PlanBox> {
    if !place.frame.is_upright() {
        return Err(
            Error::new(format!("the {} beside the image turns or mirrors it", place.said_by)).help(UPRIGHT)
        );
    }
    let [x0, y0, x1, y1] = place.frame.edges();
    let stated = [DVec2::new(x0, y0), DVec2::new(x1, y1)];
    let [low, high] = match &terrain.place.space {
        Some(space) => in_plan(stated, space, place.crs.as_ref(), note)?,
        None => stated,
    };
    if terrain.globe().is_some() && low.x >= high.x {
        return Err(Error::unsupported(
            "the image lies on both sides of the seam of the globe's plan, where its longitudes begin anew",
        )
        .help(
            "cut it along the terrain's western edge, or give a terrain that begins where the image does",
        ));
    }
    // The image lies on the terrain wherever that is moved.
    let local = |p: DVec2| Plan::from(p - terrain.place.anchor);
    Ok(PlanBox { min: local(low), max: local(high) })
}

/// The corners of an image in the plan; refuses one whose own CRS places them elsewhere than the plan's.
fn in_plan(
    stated: [DVec2; 2],
    space: &PlanSpace,
    own: Option<&CrsHint>,
    note: &mut dyn FnMut(String),
) -> Result<[DVec2; 2]> {
    let onto = space.plan_from(space.crs())?;
    let corners = [onto.apply(stated[0])?, onto.apply(stated[1])?];
    let own = match own.map(crs_of) {
        None => return Ok(corners),
        Some(Ok(own)) => own,
        Some(Err(error)) => {
            note(format!(
                "the CRS that the .aux.xml beside it states is not followed, its place is taken as one in the plan's: {}",
                error.what()
            ));
            return Ok(corners);
        }
    };
    // A CRS may be written in many ways: what counts is where it places the image.
    let from_own = space.plan_from(&own)?;
    let most = (corners[1] - corners[0]).abs().min_element() * MOST_OFF;
    let is_same = |(at, expected): (&DVec2, &DVec2)| {
        from_own.apply(*at).is_ok_and(|placed| (placed - *expected).length() <= most)
    };
    if stated.iter().zip(&corners).all(is_same) {
        return Ok(corners);
    }
    Err(Error::new(format!(
        "the image is in another CRS than the plan: the .aux.xml beside it states {}, the plan is {}",
        own.name(),
        space.describe()
    ))
    .help(UPRIGHT))
}
