//! Projections that are not our own: `proj4rs`, used for import only.
//!
//! Its results differ in the last bits between processors (it calls the platform's `sin`), by some 1e-9 m. They are
//! rounded to 2^-20 m (about a micrometre) and 2^-36 degrees (about 1.6 micrometres), so that the bits agree except
//! where a value falls within that error of a rounding boundary: about one coordinate in a thousand. A scene that
//! must be equal to the last bit everywhere uses one of our own projections or reprojected data.

use super::ellipsoid::Ellipsoid;
use super::proj_string::Definition;
use crate::error::{Error, Result};
use glam::DVec2;
use proj4rs::Proj;
use proj4rs::transform::transform;
use std::fmt;
use std::sync::Arc;

const METRE_QUANTA: f64 = 1_048_576.0;
const DEGREE_QUANTA: f64 = 68_719_476_736.0;

/// A projection of `proj4rs`, from degrees (Greenwich, own datum) to the CRS's own units and axes.
#[derive(Clone)]
pub(crate) struct Imported {
    definition: Definition,
    projected: Arc<Proj>,
    geographic: Arc<Proj>,
}

impl fmt::Debug for Imported {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Imported").field(&self.definition).finish()
    }
}

impl PartialEq for Imported {
    fn eq(&self, other: &Self) -> bool {
        self.definition == other.definition
    }
}

impl Imported {
    pub(crate) fn new(definition: &Definition, ellipsoid: &Ellipsoid) -> Result<Self> {
        let mut bare = definition.clone();
        bare.forget(&["towgs84", "nadgrids", "datum", "ellps", "a", "b", "rf", "f", "R", "type"]);
        let shape = format!("+a={} +b={}", ellipsoid.a, ellipsoid.b());
        Ok(Self {
            projected: load(&format!("{bare} {shape}"))?,
            geographic: load(&format!("+proj=longlat {shape}"))?,
            definition: bare,
        })
    }

    pub(crate) fn agrees_with(&self, other: &Self) -> bool {
        self.definition.agrees_with(&other.definition)
    }

    pub(crate) fn counts_east_north(&self) -> bool {
        matches!(self.definition.text("axis"), None | Some("enu"))
    }

    pub(crate) fn central_meridian(&self) -> f64 {
        self.definition.number_or("lon_0", 0.0).unwrap_or(0.0)
    }

    pub(crate) fn forward(&self, p: DVec2) -> Option<DVec2> {
        let mut q = (p.x.to_radians(), p.y.to_radians(), 0.0);
        transform(&self.geographic, &self.projected, &mut q).ok()?;
        Some(DVec2::new(rounded(q.0, METRE_QUANTA), rounded(q.1, METRE_QUANTA)))
    }

    pub(crate) fn inverse(&self, p: DVec2) -> Option<DVec2> {
        let mut q = (p.x, p.y, 0.0);
        transform(&self.projected, &self.geographic, &mut q).ok()?;
        Some(DVec2::new(rounded(q.0.to_degrees(), DEGREE_QUANTA), rounded(q.1.to_degrees(), DEGREE_QUANTA)))
    }
}

fn rounded(value: f64, quanta: f64) -> f64 {
    (value * quanta).round() / quanta
}

fn load(text: &str) -> Result<Arc<Proj>> {
    Proj::from_proj_string(text).map(Arc::new).map_err(|e| {
        Error::unsupported(format!("cannot set up the projection '{text}': {e}"))
            .caused_by(e)
            .help("reproject the data, for example to UTM, or name another CRS")
    })
}
