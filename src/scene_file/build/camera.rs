//! The camera's table.

use crate::error::{Error, Result};
use crate::scene::Projection;
use crate::scene_file::names::ProjectionName;
use crate::scene_file::section::{Section, Taken};
use crate::scene_file::spec::{CameraSpec, PlanKind, Spot, ViewSpec};
use glam::DVec3;

pub(super) fn camera(section: &mut Section<'_>, plan: PlanKind) -> Result<CameraSpec> {
    let eye = spot(section, "eye", "eye_geo")?;
    let target = spot(section, "target", "target_geo")?;
    let up = section.numbers_at::<3>("up")?;
    let projection = projection(section)?;
    let (near_m, far_m) = range(section)?;
    let view = view(section, plan, (eye, target), up.as_ref())?;
    let up = up.map(|taken| DVec3::from_array(taken.value));
    Ok(CameraSpec { view, up, projection, near_m, far_m })
}

/// A point in plan or geographic coordinates.
fn spot(section: &mut Section<'_>, plan: &str, geo: &str) -> Result<Option<Taken<Spot>>> {
    if let Some(Taken { value, place }) = section.numbers_at::<3>(plan)? {
        return Ok(Some(Taken { value: Spot::Plan(DVec3::from_array(value)), place }));
    }
    let Some(Taken { value, place }) = section.numbers_at::<3>(geo)? else {
        return Ok(None);
    };
    if value[0].abs() > 360.0 || value[1].abs() > 90.0 {
        let what = format!(
            "`camera.{geo}` is [longitude, latitude, height]: latitude from -90 to 90, longitude from -360 to 360"
        );
        return Err(section.error_at(&place, what));
    }
    Ok(Some(Taken { value: Spot::Geo(DVec3::from_array(value)), place }))
}

fn view(
    section: &Section<'_>,
    plan: PlanKind,
    (eye, target): (Option<Taken<Spot>>, Option<Taken<Spot>>),
    up: Option<&Taken<[f64; 3]>>,
) -> Result<Option<ViewSpec>> {
    let direction = up.map_or(DVec3::Z, |taken| DVec3::from_array(taken.value));
    let (eye, target) = match (eye, target) {
        (Some(eye), Some(target)) => (eye, target),
        (None, None) => return up.map_or(Ok(None), |up| nonzero(section, up).map(|()| None)),
        (Some(eye), None) => return Err(section.error_at(&eye.place, "`camera` has an eye and no target")),
        (None, Some(target)) => {
            return Err(section.error_at(&target.place, "`camera` has a target and no eye"));
        }
    };
    let blamed = up.map_or(&target.place, |up| &up.place);
    match (eye.value, target.value) {
        // Plan coordinates are refused there as what they are.
        (Spot::Plan(_), Spot::Plan(_)) if plan == PlanKind::Globe => {}
        (Spot::Plan(from), Spot::Plan(to)) if from == to => {
            return Err(
                section.error_at(&target.place, "`camera.eye` and `camera.target` are the same point")
            );
        }
        (Spot::Plan(from), Spot::Plan(to)) => check_view(from, to, direction).map_err(|error| {
            let placed = section.error_at(blamed, error.what());
            error.help_text().map_or(placed.clone(), |help| placed.help(help))
        })?,
        _ => up.map_or(Ok(()), |up| nonzero(section, up))?,
    }
    Ok(Some(ViewSpec { eye: eye.value, target: target.value }))
}

fn nonzero(section: &Section<'_>, up: &Taken<[f64; 3]>) -> Result<()> {
    let what = "`camera.up` has no direction: all its numbers are 0";
    (up.value != [0.0; 3]).then_some(()).ok_or_else(|| section.error_at(&up.place, what))
}

/// Whether a camera at `eye` that looks at `target` has a picture with `up` upwards.
///
/// # Errors
/// When the eye is the target, or `up` is zero or parallel to the direction of view.
pub(in crate::scene_file) fn check_view(eye: DVec3, target: DVec3, up: DVec3) -> Result<()> {
    // Scale first: neither tiny nor huge numbers may under- or overflow in the products.
    let scaled = |v: DVec3| v / v.abs().max_element();
    if eye == target {
        return Err(Error::new("the camera's eye and target are the same point"));
    }
    if up == DVec3::ZERO {
        return Err(Error::new("`camera.up` has no direction: all its numbers are 0"));
    }
    let direction = scaled(target * 0.5 - eye * 0.5);
    let sine = direction.normalize().cross(scaled(up).normalize()).length();
    if sine > 1e-9 {
        return Ok(());
    }
    Err(Error::new("`camera.up` is parallel to the direction of view")
        .help("looking straight down, write up = [0, 1, 0] to have north upwards"))
}

fn projection(section: &mut Section<'_>) -> Result<Projection> {
    let kind = section.name("projection")?.unwrap_or(ProjectionName::Perspective);
    let stray = match kind {
        ProjectionName::Perspective => "height_m",
        ProjectionName::Orthographic => "fov_y_deg",
    };
    if let Some((_, place)) = section.first_of(&[stray]) {
        let other = if stray == "height_m" { "orthographic" } else { "perspective" };
        let what = format!("`camera.{stray}` goes with projection = \"{other}\" only");
        return Err(section.error_at(place, what));
    }
    match kind {
        ProjectionName::Perspective => {
            Ok(Projection::Perspective { fov_y_deg: section.number("fov_y_deg")?.unwrap_or(45.0) })
        }
        ProjectionName::Orthographic => {
            let height_m = section.number("height_m")?;
            let missing = || {
                section
                    .error("projection = \"orthographic\" needs `height_m`: what the picture's height spans")
            };
            Ok(Projection::Orthographic { height_m: height_m.ok_or_else(missing)? })
        }
    }
}

fn range(section: &mut Section<'_>) -> Result<(f64, Option<f64>)> {
    let near_m = section.number("near_m")?.unwrap_or(1.0);
    let far = section.number_at("far_m")?;
    match far {
        Some(Taken { value, place }) if value <= near_m => Err(section
            .error_at(&place, format!("`camera.far_m` must be greater than near_m, which is {near_m}"))),
        far => Ok((near_m, far.map(|taken| taken.value))),
    }
}
