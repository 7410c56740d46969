//! The projections by name, with their origins and false coordinates.

use super::conic::{Lambert, Mercator, parallel_radius};
use super::degrees::wrapped;
use super::ellipsoid::Ellipsoid;
use super::imported::Imported;
use super::proj_string::Definition;
use super::transverse_mercator::TransverseMercator;
use crate::error::{Error, Result};
use glam::DVec2;

/// How longitude and latitude become coordinates.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Projection {
    /// They stay what they are.
    Geographic,
    Transverse(Origin, TransverseMercator),
    Lambert(Origin, Lambert),
    Mercator(Origin, Mercator),
    /// Not our own.
    Imported(Box<Imported>),
}

/// Where a projection's zero is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Origin {
    /// The central meridian, degrees from the CRS's prime meridian.
    pub(crate) lon_0: f64,
    /// False easting and northing in metres.
    pub(crate) offset: DVec2,
}

impl Origin {
    fn new(definition: &Definition) -> Result<Self> {
        Ok(Self {
            lon_0: definition.number_or("lon_0", 0.0)?,
            offset: DVec2::new(definition.number_or("x_0", 0.0)?, definition.number_or("y_0", 0.0)?),
        })
    }

    fn agrees_with(&self, other: &Self) -> bool {
        (self.lon_0 - other.lon_0).abs() < 1e-9 && (self.offset - other.offset).length() < 1e-3
    }
}

impl Projection {
    pub(crate) fn new(definition: &Definition, ellipsoid: Ellipsoid) -> Result<Self> {
        let plain = matches!(definition.text("axis"), None | Some("enu"));
        match definition.text("proj").unwrap_or("") {
            "longlat" | "latlong" | "latlon" | "lonlat" => Ok(Self::Geographic),
            "geocent" | "cart" => Err(Error::unsupported("geocentric coordinates have no plan")
                .help("reproject the data to longitude and latitude or to a projected CRS")),
            "tmerc" | "etmerc" if plain => transverse(definition, ellipsoid),
            "utm" if plain => utm(definition, ellipsoid),
            "lcc" if plain => lambert(definition, ellipsoid),
            "merc" | "webmerc" if plain => mercator(definition, ellipsoid),
            _ => Ok(Self::Imported(Box::new(Imported::new(definition, &ellipsoid)?))),
        }
    }

    /// Degrees of Greenwich to metres, for our own projections; `None` out of the domain.
    pub(crate) fn forward(&self, p: DVec2, prime_meridian: f64) -> Option<DVec2> {
        let origin = self.origin()?;
        let lam = wrapped(p.x - prime_meridian - origin.lon_0).to_radians();
        let lat = p.y.to_radians();
        let q = match self {
            Self::Transverse(_, t) => t.forward(lam, lat),
            Self::Lambert(_, l) => l.forward(lam, lat),
            Self::Mercator(_, m) => m.forward(lam, lat),
            Self::Geographic | Self::Imported(_) => None,
        };
        q.map(|q| q + origin.offset)
    }

    /// Metres to degrees of Greenwich, for our own projections; `None` out of the domain.
    pub(crate) fn inverse(&self, p: DVec2, prime_meridian: f64) -> Option<DVec2> {
        let origin = self.origin()?;
        let q = p - origin.offset;
        let (lam, lat) = match self {
            Self::Transverse(_, t) => t.inverse(q),
            Self::Lambert(_, l) => l.inverse(q),
            Self::Mercator(_, m) => m.inverse(q),
            Self::Geographic | Self::Imported(_) => None,
        }?;
        let lon = wrapped(lam.to_degrees() + origin.lon_0 + prime_meridian);
        Some(DVec2::new(lon, lat.to_degrees()))
    }

    /// The sphere of Web Mercator, which is not the ellipsoid of its datum.
    pub(crate) fn own_ellipsoid(&self) -> Option<Ellipsoid> {
        match self {
            Self::Mercator(_, m) => Some(m.ellipsoid),
            _ => None,
        }
    }

    fn origin(&self) -> Option<&Origin> {
        match self {
            Self::Transverse(o, _) | Self::Lambert(o, _) | Self::Mercator(o, _) => Some(o),
            Self::Geographic | Self::Imported(_) => None,
        }
    }

    /// Whether two projections of one ellipsoid give the same coordinates, to the millimetre.
    pub(crate) fn agrees_with(&self, other: &Self) -> bool {
        let origins = match (self.origin(), other.origin()) {
            (Some(a), Some(b)) => a.agrees_with(b),
            _ => true,
        };
        let close = |a: f64, b: f64| (a - b).abs() < 1e-9;
        origins
            && match (self, other) {
                (Self::Geographic, Self::Geographic) => true,
                (Self::Transverse(_, a), Self::Transverse(_, b)) => {
                    close(a.lat_0, b.lat_0) && close(a.k_0, b.k_0)
                }
                (Self::Lambert(_, a), Self::Lambert(_, b)) => {
                    close(a.lat_0, b.lat_0)
                        && close(a.k_0, b.k_0)
                        && close(a.parallels[0], b.parallels[0])
                        && close(a.parallels[1], b.parallels[1])
                }
                (Self::Mercator(_, a), Self::Mercator(_, b)) => close(a.k_0, b.k_0),
                (Self::Imported(a), Self::Imported(b)) => a.agrees_with(b),
                _ => false,
            }
    }
}

fn transverse(definition: &Definition, ellipsoid: Ellipsoid) -> Result<Projection> {
    let lat_0 = latitude(definition, "lat_0", 0.0)?;
    let projection = TransverseMercator::new(ellipsoid, lat_0, definition.scale()?);
    Ok(Projection::Transverse(Origin::new(definition)?, projection))
}

fn utm(definition: &Definition, ellipsoid: Ellipsoid) -> Result<Projection> {
    let zone = definition.number_or("zone", f64::NAN)?;
    if !((1.0..=60.0).contains(&zone) && zone == zone.floor()) {
        return Err(Error::new("UTM needs a +zone= from 1 to 60"));
    }
    let south = definition.text("south").is_some();
    let origin = Origin {
        lon_0: zone * 6.0 - 183.0,
        offset: DVec2::new(500_000.0, if south { 10_000_000.0 } else { 0.0 }),
    };
    Ok(Projection::Transverse(origin, TransverseMercator::new(ellipsoid, 0.0, 0.9996)))
}

fn lambert(definition: &Definition, ellipsoid: Ellipsoid) -> Result<Projection> {
    let lat_0 = latitude(definition, "lat_0", 0.0)?;
    let first = latitude(definition, "lat_1", lat_0)?;
    let second = latitude(definition, "lat_2", first)?;
    let lat_0 = latitude(definition, "lat_0", first)?;
    let made = Lambert::new(ellipsoid, [first, second], lat_0, definition.scale()?);
    let made = made.ok_or_else(|| {
        Error::new(format!("the parallels {first} and {second} do not span a cone")).help(
            "Lambert's projection takes standard parallels off the poles that are not opposite to each other",
        )
    })?;
    Ok(Projection::Lambert(Origin::new(definition)?, made))
}

fn mercator(definition: &Definition, ellipsoid: Ellipsoid) -> Result<Projection> {
    let ellipsoid = match definition.text("proj") {
        Some("webmerc") => Ellipsoid::from_inverse_flattening(ellipsoid.a, 0.0),
        _ => ellipsoid,
    };
    let true_scale = latitude(definition, "lat_ts", 0.0)?;
    let k_0 = match true_scale {
        0.0 => definition.scale()?,
        lat => parallel_radius(&ellipsoid, lat.to_radians()),
    };
    Ok(Projection::Mercator(Origin::new(definition)?, Mercator::new(ellipsoid, k_0)))
}

fn latitude(definition: &Definition, key: &str, default: f64) -> Result<f64> {
    let lat = definition.number_or(key, default)?;
    if lat.abs() <= 90.0 {
        return Ok(lat);
    }
    Err(Error::new(format!("+{key}={lat} is not a latitude")))
}
