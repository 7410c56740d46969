//! Which plan a scene has, where its local zero lies in it, and how files' coordinates get there.

use crate::crs::{Crs, PlanFrom, PlanSpace};
use crate::error::{Error, Result};
use crate::math::max;
use crate::source::dem::CrsHint;
use crate::space::{Plan, World};
use glam::{DVec2, DVec3};

/// The scene's plan and its local zero.
pub(super) struct PlanFrame {
    /// `None`: coordinates as they are.
    pub(super) space: Option<PlanSpace>,
    /// The place of the plan that the surface was made relative to.
    pub(super) anchor: DVec2,
    /// By how much the terrain is moved, and raised.
    pub(super) offset: DVec3,
}

impl PlanFrame {
    /// Absolute plan coordinates and height of the local zero.
    pub(super) fn origin(&self) -> DVec3 {
        self.anchor.extend(0.0) + self.offset
    }

    /// What makes plan coordinates, moved by an offset of their own, local ones.
    pub(super) fn shift(&self, moved: DVec2) -> DVec2 {
        // The offsets first: equal ones cancel without a rounding.
        (moved - self.offset.truncate()) - self.anchor
    }

    /// A place of the plan and a height above its zero, in local coordinates.
    pub(super) fn local(&self, at: DVec3) -> World {
        World::from((at.truncate() + self.shift(DVec2::ZERO)).extend(at.z - self.offset.z))
    }

    /// What the plan is, in words.
    pub(super) fn words(&self) -> String {
        self.space.as_ref().map_or_else(|| "metres without a CRS".into(), PlanSpace::describe)
    }
}

/// From a file's coordinates to the plan's.
pub(super) enum Map {
    /// They are the plan's.
    AsIs,
    /// Through CRSs.
    From(Box<PlanFrom>),
}

impl Map {
    pub(super) fn apply(&self, p: Plan) -> Result<Plan> {
        match self {
            Self::AsIs => Ok(p),
            Self::From(map) => map.apply(p.to_vec()).map(Plan::from),
        }
    }
}

/// The CRS that a terrain file states.
///
/// # Errors
/// When what it states is not supported or not understood.
pub fn crs_of(hint: &CrsHint) -> Result<Crs> {
    match hint {
        CrsHint::Epsg(code) => Crs::from_epsg(*code),
        CrsHint::Proj(text) => Crs::from_proj_string(text),
        CrsHint::Wkt(text) => Crs::parse(text),
        CrsHint::Unknown(words) => Err(Error::new(format!("the file's CRS is not understood: {words}"))
            .help("say it in the scene: terrain.crs = \"EPSG:...\"")),
    }
}

/// The plan of a terrain with a CRS and posts in a box (x0, y0, x1, y1 in that CRS) where the scene asks for none.
///
/// # Errors
/// When the terrain's middle is at a pole.
pub fn default_plan_space(crs: Crs, [x0, y0, x1, y1]: [f64; 4]) -> Result<PlanSpace> {
    if !crs.is_geographic() {
        return PlanSpace::projected(crs);
    }
    let middle = |low: f64, high: f64| ((low + high) / 2.0 * 1000.0).round() / 1000.0;
    PlanSpace::local_plane(middle(x0, x1), middle(y0, y1), crs)
}

/// By how much a local plane is longer than the ground, east and north, where that is worst between two latitudes (in
/// the CRS's own degrees): 0.01 is one per cent; `None` for a projected CRS.
pub fn scale_error(space: &PlanSpace, south: f64, north: f64) -> Option<(f64, f64)> {
    let (_, latitude) = space.center()?;
    let (_, metres) = space.metres_per_degree()?;
    let at = |degrees: f64| space.scale_error_at(0.0, (degrees - latitude) * metres);
    let ((a, b), (c, d)) = (at(south), at(north));
    Some((max(a.abs(), c.abs()), max(b.abs(), d.abs())))
}

/// How many times as long as the ground a plan is at a place; `None` where that cannot be told.
pub(super) fn stretch(space: &PlanSpace, at: DVec2) -> Option<f64> {
    const STEP: f64 = 1000.0;
    let here = space.geographic_from_plan(at).ok()?;
    let there = space.geographic_from_plan(at + DVec2::new(STEP, 0.0)).ok()?;
    let ground = PlanSpace::local_plane(here.x, here.y, Crs::crs84().ok()?).ok()?;
    let (east, north) = ground.metres_per_degree()?;
    let off = (there - here) * DVec2::new(east, north);
    let stretch = STEP / off.length();
    stretch.is_finite().then_some(stretch)
}
