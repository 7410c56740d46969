//! The scene's plan: a projected CRS in metres, or the local plane or the globe of data in degrees.

use super::degrees::wrapped;
use super::{Crs, Ellipsoid};
use crate::error::{Error, Result};
use crate::math::cos;
use glam::DVec2;

/// The scene's plan plane, in metres east and north.
///
/// The **local plane** at (lon0, lat0) is x = (lon - lon0) N cos(lat0), y = (lat - lat0) M, angles in radians, with
/// the ellipsoid's radii of curvature in the prime vertical, N, and in the meridian, M, at lat0: a regular grid in degrees
/// stays a regular grid.
///
/// The plan of a **globe** is longitude and latitude as metres on the equator's circle: x = lon a, y = lat a.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanSpace(Kind);

#[derive(Debug, Clone, PartialEq)]
enum Kind {
    Projected(Crs),
    Local(LocalPlane),
    Globe(GlobePlan),
}

#[derive(Debug, Clone, PartialEq)]
struct LocalPlane {
    crs: Crs,
    center: DVec2,
    metres_per_degree: DVec2,
}

#[derive(Debug, Clone, PartialEq)]
struct GlobePlan {
    crs: Crs,
    /// The longitude within half a turn of which places are taken, degrees.
    middle: f64,
    metres_per_degree: f64,
}

/// A map that keeps grids regular: p becomes (p - origin) * scale, by components.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Affine {
    /// What becomes (0, 0).
    pub origin: DVec2,
    /// Plan metres in a unit of the file.
    pub scale: DVec2,
}

/// The map from a file's coordinates to plan coordinates, and back.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanFrom {
    file: Crs,
    plan: PlanSpace,
    same: bool,
}

impl PlanSpace {
    /// The plane of a projected CRS. Its coordinates in the plan are metres, also where the CRS counts in feet.
    ///
    /// # Errors
    /// When the CRS is geographic: its degrees are no plane. When it counts west or south: its plane is turned, or mirrored.
    pub fn projected(crs: Crs) -> Result<Self> {
        if crs.is_geographic() {
            return Err(Error::new(format!("{} is in degrees, not a plane", crs.name()))
                .help("name a projected CRS such as 'EPSG:32733', or leave crs out: a DEM in degrees gets its local plane"));
        }
        if !crs.projection.counts_east_north() {
            return Err(Error::unsupported(format!("{} counts west or south, a plan counts east and north", crs.name()))
                .help("name another CRS as the scene's crs (for EPSG:5513 it is EPSG:5514; +axis=enu turns the axes of a PROJ string)"));
        }
        Ok(Self(Kind::Projected(crs)))
    }

    /// The local plane of a geographic CRS at a centre, given in that CRS's own degrees.
    ///
    /// # Errors
    /// When the CRS is not geographic, or the centre is within a tenth of a degree of a pole or not on the globe.
    pub fn local_plane(center_lon: f64, center_lat: f64, crs: Crs) -> Result<Self> {
        if !crs.is_geographic() {
            return Err(Error::new(format!("{} is a plane already", crs.name()))
                .help("the local plane is for data in degrees"));
        }
        if !(center_lat.abs() <= 89.9 && center_lon.abs() <= 540.0) {
            return Err(Error::new(format!(
                "there is no local plane at longitude {center_lon}, latitude {center_lat}"
            ))
            .help("name a polar projection as the scene's crs"));
        }
        let metres_per_degree = metres_per_degree_at(&crs, center_lat);
        let center = DVec2::new(center_lon, center_lat);
        Ok(Self(Kind::Local(LocalPlane { crs, center, metres_per_degree })))
    }

    /// The plan of a globe of which places are to lie within half a turn of a longitude, in the CRS's own degrees.
    ///
    /// # Errors
    /// When the CRS is not geographic.
    pub fn globe(middle: f64, crs: Crs) -> Result<Self> {
        if !crs.is_geographic() {
            return Err(Error::new(format!("{} is a plane, and a globe is in degrees", crs.name())).help(
                "give a terrain in longitude and latitude (gdalwarp -t_srs EPSG:4326), or leave out plan = \"globe\"",
            ));
        }
        let metres_per_degree = crs.ellipsoid.a.to_radians();
        Ok(Self(Kind::Globe(GlobePlan { crs, middle, metres_per_degree })))
    }

    /// The ellipsoid of a globe's plan; `None` of a plane.
    pub fn ellipsoid(&self) -> Option<Ellipsoid> {
        match &self.0 {
            Kind::Globe(globe) => Some(globe.crs.ellipsoid),
            Kind::Projected(_) | Kind::Local(_) => None,
        }
    }

    /// What the plane is, for people.
    pub fn describe(&self) -> String {
        match &self.0 {
            Kind::Projected(crs) => crs.name().to_owned(),
            Kind::Local(plane) => format!(
                "local plane at longitude {}, latitude {} of {}",
                plane.center.x,
                plane.center.y,
                plane.crs.name()
            ),
            Kind::Globe(globe) => {
                format!("globe: longitude and latitude of {}, as metres at the equator", globe.crs.name())
            }
        }
    }

    /// The CRS of the plane, or the geographic one that the local plane unrolls.
    pub fn crs(&self) -> &Crs {
        match &self.0 {
            Kind::Projected(crs) => crs,
            Kind::Local(plane) => &plane.crs,
            Kind::Globe(globe) => &globe.crs,
        }
    }

    /// The centre of the local plane: longitude and latitude in its CRS.
    pub fn center(&self) -> Option<(f64, f64)> {
        match &self.0 {
            Kind::Projected(_) | Kind::Globe(_) => None,
            Kind::Local(plane) => Some((plane.center.x, plane.center.y)),
        }
    }

    /// Plan metres in a degree of longitude and of latitude; `None` but for the local plane.
    pub fn metres_per_degree(&self) -> Option<(f64, f64)> {
        match &self.0 {
            Kind::Projected(_) | Kind::Globe(_) => None,
            Kind::Local(plane) => Some((plane.metres_per_degree.x, plane.metres_per_degree.y)),
        }
    }

    /// By how much the local plane is longer than the ground at a plan point, east and north: 0.01 is one per cent.
    /// Zero for a projected CRS, whose scale error is nobody's surprise.
    pub fn scale_error_at(&self, _x: f64, y: f64) -> (f64, f64) {
        match &self.0 {
            Kind::Projected(_) | Kind::Globe(_) => (0.0, 0.0),
            Kind::Local(plane) => {
                let lat = plane.center.y + y / plane.metres_per_degree.y;
                let ground = metres_per_degree_at(&plane.crs, lat);
                let error = plane.metres_per_degree / ground - DVec2::ONE;
                (error.x, error.y)
            }
        }
    }

    /// The map from a file's CRS to the plan.
    ///
    /// # Errors
    /// None today; a CRS that has no map to the plan is to be refused here.
    pub fn plan_from(&self, file: &Crs) -> Result<PlanFrom> {
        Ok(PlanFrom { file: file.clone(), plan: self.clone(), same: self.crs().is_same(file) })
    }

    /// The plan point of a longitude and latitude on WGS 84, degrees.
    ///
    /// # Errors
    /// When the place is outside the plane's domain.
    pub fn plan_from_geographic(&self, lon: f64, lat: f64) -> Result<DVec2> {
        self.plan_from_native(self.crs().native_from_geographic(DVec2::new(lon, lat))?)
    }

    /// The longitude and latitude on WGS 84, degrees, of a plan point.
    ///
    /// # Errors
    /// When the point is outside the plane's domain.
    pub fn geographic_from_plan(&self, p: DVec2) -> Result<DVec2> {
        self.crs().geographic_from_native(self.native_from_plan(p)?)
    }

    fn affine(&self) -> Affine {
        match &self.0 {
            Kind::Projected(crs) => Affine { origin: DVec2::ZERO, scale: DVec2::splat(crs.unit) },
            Kind::Local(plane) => Affine {
                origin: plane.center / plane.crs.unit,
                scale: plane.metres_per_degree * plane.crs.unit,
            },
            Kind::Globe(globe) => {
                Affine { origin: DVec2::ZERO, scale: DVec2::splat(globe.metres_per_degree * globe.crs.unit) }
            }
        }
    }

    /// From the plane's own CRS.
    fn plan_from_native(&self, p: DVec2) -> Result<DVec2> {
        let affine = self.affine();
        let mut off = p - affine.origin;
        let unit = self.crs().unit;
        let is_on_the_globe = || (p.y * unit).abs() <= 90.0 && (p.x * unit).abs() <= 540.0;
        if !matches!(self.0, Kind::Projected(_)) && !is_on_the_globe() {
            return Err(not_on_the_globe(p, self.crs()));
        }
        match &self.0 {
            Kind::Projected(_) => {}
            Kind::Local(_) => off.x = wrapped(off.x * unit) / unit,
            Kind::Globe(globe) => {
                let off_middle = p.x * unit - globe.middle;
                off.x += (wrapped(off_middle) - off_middle) / unit;
            }
        }
        Some(off * affine.scale).filter(|q| q.is_finite()).ok_or_else(|| not_on_the_globe(p, self.crs()))
    }

    /// To the plane's own CRS.
    fn native_from_plan(&self, p: DVec2) -> Result<DVec2> {
        let affine = self.affine();
        let q = p / affine.scale + affine.origin;
        let on_the_globe = match &self.0 {
            Kind::Projected(_) => q.is_finite(),
            Kind::Local(_) | Kind::Globe(_) => (q.y * self.crs().unit).abs() <= 90.0 && q.x.is_finite(),
        };
        on_the_globe.then_some(q).ok_or_else(|| {
            Error::new(format!("the plan point ({}, {}) is not on the globe", p.x, p.y))
                .help("the local plane ends at the poles")
        })
    }
}

fn not_on_the_globe(p: DVec2, crs: &Crs) -> Error {
    Error::new(format!("({}, {}) is not a place in {}", p.x, p.y, crs.name()))
        .help("check that the coordinates are in the CRS that the file states: metres may stand under a CRS in degrees")
}

fn metres_per_degree_at(crs: &Crs, lat: f64) -> DVec2 {
    let phi = lat.to_radians();
    DVec2::new(
        (crs.ellipsoid.prime_vertical(phi) * cos(phi)).to_radians(),
        crs.ellipsoid.meridian(phi).to_radians(),
    )
}

impl PlanFrom {
    /// The CRS of the file.
    pub fn file(&self) -> &Crs {
        &self.file
    }

    /// What the user should know before comparing bits of what the map places: that its projection is not our own.
    pub fn note(&self) -> Option<String> {
        let strange = [&self.file, self.plan.crs()].into_iter().find(|crs| crs.is_imported());
        strange
            .filter(|_| !self.same)
            .map(|crs| format!("coordinates of {} may differ by 2^-20 m between processors", crs.name()))
    }

    /// The map as shift and scale, where it is one (so that a grid stays a grid). For the local plane this holds for
    /// longitudes within half a turn of the centre.
    pub fn affine(&self) -> Option<Affine> {
        self.same.then(|| self.plan.affine())
    }

    /// The plan point of a point in the file's CRS.
    ///
    /// # Errors
    /// When the point lies outside the domain of either CRS or is not finite.
    pub fn apply(&self, p: DVec2) -> Result<DVec2> {
        if self.same {
            return self.plan.plan_from_native(p);
        }
        let to = self.plan.crs();
        let there = if self.file.has_datum_of(to) {
            to.project(self.file.own_geographic(p)?)?
        } else {
            to.native_from_geographic(self.file.geographic_from_native(p)?)?
        };
        self.plan.plan_from_native(there)
    }

    /// Whether a place a turn away is a turn away for [`Self::apply_unrolled`]: in the file's own CRS, and on Mercator's cylinder.
    pub fn keeps_turns(&self) -> bool {
        self.file.turn().is_some() && (self.same || self.plan.crs().projection.cylinder().is_some())
    }

    /// The same as [`Self::apply`] for coordinates that are on any turn around the globe ([`Crs::turn`]), which is kept where
    /// [`Self::keeps_turns`] says so; a latitude over a pole is beyond it on the local plane.
    ///
    /// # Errors
    /// When the point lies outside the domain of either CRS or is not finite.
    pub fn apply_unrolled(&self, p: DVec2) -> Result<DVec2> {
        if self.same {
            let Affine { origin, scale } = self.plan.affine();
            let placed = Some((p - origin) * scale).filter(|q| q.is_finite());
            return placed.ok_or_else(|| not_on_the_globe(p, self.plan.crs()));
        }
        let q = self.apply(self.file.on_a_known_turn(p))?;
        let Some((zero, turn, own)) = self.cylinder() else { return Ok(q) };
        let expected = zero + (p.x - self.central_meridian()) / own * turn;
        Ok(DVec2::new(q.x + turn * ((expected - q.x) / turn).round(), q.y))
    }

    /// The inverse of [`Self::apply_unrolled`].
    ///
    /// # Errors
    /// When the point lies outside the domain of either CRS or is not finite.
    pub fn invert_unrolled(&self, p: DVec2) -> Result<DVec2> {
        if self.same {
            let Affine { origin, scale } = self.plan.affine();
            let placed = Some(p / scale + origin).filter(|q| q.is_finite());
            return placed.ok_or_else(|| not_on_the_globe(p, self.plan.crs()));
        }
        let Some((zero, turn, own)) = self.cylinder() else { return self.invert(p) };
        let turns = ((p.x - zero) / turn).round();
        let q = self.invert(DVec2::new(p.x - turns * turn, p.y))?;
        let expected = self.central_meridian() + (p.x - zero) / turn * own;
        Ok(DVec2::new(q.x + own * ((expected - q.x) / own).round(), q.y))
    }

    /// The x of the plan's middle longitude in a file that counts turns ([`Crs::turn`]): half a turn from there a projection may have a
    /// seam.
    pub fn central_meridian(&self) -> f64 {
        let to = self.plan.crs();
        let central = match &self.plan.0 {
            Kind::Projected(crs) => crs.projection.central_meridian(),
            Kind::Local(plane) => plane.center.x,
            Kind::Globe(globe) => globe.middle,
        };
        let (zero, meridian) = self.file.middle();
        let per_degree = self.file.turn().map_or(1.0, |turn| turn.length / 360.0);
        zero + (central + to.prime_meridian - meridian) * per_degree
    }

    /// The x of the central meridian and the length of a turn, and that of a turn in the file, where turns are kept on a cylinder.
    fn cylinder(&self) -> Option<(f64, f64, f64)> {
        let (zero, turn) = self.plan.crs().projection.cylinder()?;
        Some((zero, turn, self.file.turn()?.length))
    }

    /// The point in the file's CRS of a plan point: the inverse of [`Self::apply`].
    ///
    /// # Errors
    /// When the point lies outside the domain of either CRS or is not finite.
    pub fn invert(&self, p: DVec2) -> Result<DVec2> {
        let there = self.plan.native_from_plan(p)?;
        if self.same {
            return Ok(there);
        }
        let from = self.plan.crs();
        if self.file.has_datum_of(from) {
            self.file.project(from.own_geographic(there)?)
        } else {
            self.file.native_from_geographic(from.geographic_from_native(there)?)
        }
    }
}
