//! The projections by name, with their origins and false coordinates.

use super::authalic::{Albers, AzimuthalEqualArea};
use super::conic::{Lambert, Mercator, parallel_radius};
use super::degrees::wrapped;
use super::ellipsoid::Ellipsoid;
use super::gauss::{Krovak, SwissMercator};
use super::imported::Imported;
use super::proj_string::Definition;
use super::stereographic::{ObliqueStereographic, PolarStereographic};
use super::transverse_mercator::TransverseMercator;
use crate::error::{Error, Result};
use glam::DVec2;

/// How longitude and latitude become coordinates.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Projection {
    /// They stay what they are.
    Geographic,
    /// Our own.
    Own(Origin, Box<Form>),
    /// Not our own.
    Imported(Box<Imported>),
}

/// A projection of our own, with its zero at the central meridian.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Form {
    Transverse(TransverseMercator),
    Lambert(Lambert),
    Mercator(Mercator),
    Albers(Albers),
    AzimuthalEqualArea(AzimuthalEqualArea),
    PolarStereographic(PolarStereographic),
    ObliqueStereographic(ObliqueStereographic),
    Swiss(SwissMercator),
    Krovak(Krovak),
}

/// Where a projection's zero is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Origin {
    /// The central meridian, degrees from the CRS's prime meridian.
    pub(crate) lon_0: f64,
    /// False easting and northing in metres.
    pub(crate) offset: DVec2,
    pub(crate) axes: Axes,
}

impl Origin {
    fn new(definition: &Definition) -> Result<Self> {
        Ok(Self {
            lon_0: definition.number_or("lon_0", 0.0)?,
            offset: DVec2::new(definition.number_or("x_0", 0.0)?, definition.number_or("y_0", 0.0)?),
            axes: Axes::new(definition).unwrap_or(Axes::EAST_NORTH),
        })
    }

    fn agrees_with(&self, other: &Self) -> bool {
        (self.lon_0 - other.lon_0).abs() < 1e-9
            && (self.offset - other.offset).length() < 1e-3
            && self.axes == other.axes
    }
}

/// Which ways x and y count: east and north, but for some surveys.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Axes {
    /// Whether x runs along the meridian.
    swapped: bool,
    /// 1 for east and north, -1 for west and south, in the order of x and y.
    signs: DVec2,
}

impl Axes {
    const EAST_NORTH: Self = Self { swapped: false, signs: DVec2::ONE };

    /// `None` for axes that are not two in the plane and one up.
    fn new(definition: &Definition) -> Option<Self> {
        let mut letters = definition.text("axis").unwrap_or("enu").chars();
        let mut next = || match letters.next()? {
            'e' => Some((false, 1.0)),
            'w' => Some((false, -1.0)),
            'n' => Some((true, 1.0)),
            's' => Some((true, -1.0)),
            _ => None,
        };
        let ((swapped, x), (other, y)) = (next()?, next()?);
        (swapped != other && letters.eq(['u'])).then(|| Self { swapped, signs: DVec2::new(x, y) })
    }

    fn ordered(&self, p: DVec2) -> DVec2 {
        if self.swapped { DVec2::new(p.y, p.x) } else { p }
    }

    fn of_east_north(&self, p: DVec2) -> DVec2 {
        self.ordered(p) * self.signs
    }

    fn east_north(&self, q: DVec2) -> DVec2 {
        self.ordered(q * self.signs)
    }
}

impl Projection {
    pub(crate) fn new(definition: &Definition, ellipsoid: Ellipsoid) -> Result<Self> {
        let plain = Axes::new(definition).is_some();
        match definition.text("proj").unwrap_or("") {
            "longlat" | "latlong" | "latlon" | "lonlat" => Ok(Self::Geographic),
            "geocent" | "cart" => Err(Error::unsupported("geocentric coordinates have no plan")
                .help("reproject the data to longitude and latitude or to a projected CRS")),
            "tmerc" | "etmerc" if plain => transverse(definition, ellipsoid),
            "utm" if plain => utm(definition, ellipsoid),
            "lcc" if plain => lambert(definition, ellipsoid),
            "merc" | "webmerc" if plain => mercator(definition, ellipsoid),
            "aea" if plain => albers(definition, ellipsoid),
            "laea" if plain => azimuthal(definition, ellipsoid),
            "stere" if plain && is_polar(definition)? => stereographic(definition, ellipsoid),
            "sterea" if plain => double_stereographic(definition, ellipsoid),
            "somerc" if plain => swiss(definition, ellipsoid),
            "krovak" if plain && definition.text("czech").is_none() => krovak(definition, ellipsoid),
            _ => Ok(Self::Imported(Box::new(Imported::new(definition, &ellipsoid)?))),
        }
    }

    /// Degrees of Greenwich to metres, for our own projections; `None` out of the domain.
    pub(crate) fn forward(&self, p: DVec2, prime_meridian: f64) -> Option<DVec2> {
        let Self::Own(origin, form) = self else { return None };
        let lam = wrapped(p.x - prime_meridian - origin.lon_0).to_radians();
        form.forward(lam, p.y.to_radians()).map(|q| origin.axes.of_east_north(q + origin.offset))
    }

    /// Metres to degrees of Greenwich, for our own projections; `None` out of the domain.
    pub(crate) fn inverse(&self, p: DVec2, prime_meridian: f64) -> Option<DVec2> {
        let Self::Own(origin, form) = self else { return None };
        let (lam, lat) = form.inverse(origin.axes.east_north(p) - origin.offset)?;
        let lon = wrapped(lam.to_degrees() + origin.lon_0 + prime_meridian);
        Some(DVec2::new(lon, lat.to_degrees()))
    }

    /// Whether x counts east and y north.
    pub(crate) fn counts_east_north(&self) -> bool {
        match self {
            Self::Geographic => true,
            Self::Own(origin, _) => origin.axes == Axes::EAST_NORTH,
            Self::Imported(imported) => imported.counts_east_north(),
        }
    }

    /// The central meridian, degrees from the CRS's prime meridian; 0 where that is not told.
    pub(crate) fn central_meridian(&self) -> f64 {
        match self {
            Self::Geographic => 0.0,
            Self::Own(origin, _) => origin.lon_0,
            Self::Imported(imported) => imported.central_meridian(),
        }
    }

    /// Of Mercator's cylinder, which goes on east and west for ever: the x of the central meridian and the length of a turn, metres.
    pub(crate) fn cylinder(&self) -> Option<(f64, f64)> {
        let Self::Own(origin, form) = self else { return None };
        match **form {
            Form::Mercator(m) if origin.axes == Axes::EAST_NORTH => {
                Some((origin.offset.x, std::f64::consts::TAU * m.ellipsoid.a * m.k_0))
            }
            _ => None,
        }
    }

    /// The sphere of Web Mercator, which is not the ellipsoid of its datum.
    pub(crate) fn own_ellipsoid(&self) -> Option<Ellipsoid> {
        let Self::Own(_, form) = self else { return None };
        match **form {
            Form::Mercator(m) => Some(m.ellipsoid),
            _ => None,
        }
    }

    /// Whether two projections of one ellipsoid give the same coordinates, to the millimetre.
    pub(crate) fn agrees_with(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Geographic, Self::Geographic) => true,
            (Self::Own(a, one), Self::Own(b, two)) => a.agrees_with(b) && one.agrees_with(two),
            (Self::Imported(a), Self::Imported(b)) => a.agrees_with(b),
            _ => false,
        }
    }
}

impl Form {
    /// Longitude from the central meridian and latitude (radians) to metres.
    fn forward(&self, lam: f64, lat: f64) -> Option<DVec2> {
        match self {
            Self::Transverse(p) => p.forward(lam, lat),
            Self::Lambert(p) => p.forward(lam, lat),
            Self::Mercator(p) => p.forward(lam, lat),
            Self::Albers(p) => p.forward(lam, lat),
            Self::AzimuthalEqualArea(p) => p.forward(lam, lat),
            Self::PolarStereographic(p) => p.forward(lam, lat),
            Self::ObliqueStereographic(p) => p.forward(lam, lat),
            Self::Swiss(p) => p.forward(lam, lat),
            Self::Krovak(p) => p.forward(lam, lat),
        }
    }

    /// Metres to longitude from the central meridian and latitude (radians).
    fn inverse(&self, q: DVec2) -> Option<(f64, f64)> {
        match self {
            Self::Transverse(p) => p.inverse(q),
            Self::Lambert(p) => p.inverse(q),
            Self::Mercator(p) => p.inverse(q),
            Self::Albers(p) => p.inverse(q),
            Self::AzimuthalEqualArea(p) => p.inverse(q),
            Self::PolarStereographic(p) => p.inverse(q),
            Self::ObliqueStereographic(p) => p.inverse(q),
            Self::Swiss(p) => p.inverse(q),
            Self::Krovak(p) => p.inverse(q),
        }
    }

    /// What tells it from others of its kind on one ellipsoid: degrees and ratios.
    fn numbers(&self) -> [f64; 4] {
        match self {
            Self::Transverse(p) => [p.lat_0, p.k_0, 0.0, 0.0],
            Self::Lambert(p) => [p.lat_0, p.k_0, p.parallels[0], p.parallels[1]],
            Self::Mercator(p) => [p.k_0, 0.0, 0.0, 0.0],
            Self::Albers(p) => [p.lat_0, p.parallels[0], p.parallels[1], 0.0],
            Self::AzimuthalEqualArea(p) => [p.lat_0, 0.0, 0.0, 0.0],
            Self::PolarStereographic(p) => [p.lat_ts, p.k_0, 0.0, 0.0],
            Self::ObliqueStereographic(p) => [p.lat_0, p.k_0, 0.0, 0.0],
            Self::Swiss(p) => [p.lat_0, p.k_0, 0.0, 0.0],
            Self::Krovak(p) => [p.lat_0, p.k_0, 0.0, 0.0],
        }
    }

    fn agrees_with(&self, other: &Self) -> bool {
        let mut pairs = self.numbers().into_iter().zip(other.numbers());
        std::mem::discriminant(self) == std::mem::discriminant(other)
            && pairs.all(|(a, b)| (a - b).abs() < 1e-9)
    }
}

fn transverse(definition: &Definition, ellipsoid: Ellipsoid) -> Result<Projection> {
    let lat_0 = latitude(definition, "lat_0", 0.0)?;
    let projection = TransverseMercator::new(ellipsoid, lat_0, definition.scale()?);
    own(definition, Form::Transverse(projection))
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
        axes: Axes::new(definition).unwrap_or(Axes::EAST_NORTH),
    };
    Ok(Projection::Own(origin, Box::new(Form::Transverse(TransverseMercator::new(ellipsoid, 0.0, 0.9996)))))
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
    own(definition, Form::Lambert(made))
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
    own(definition, Form::Mercator(Mercator::new(ellipsoid, k_0)))
}

fn albers(definition: &Definition, ellipsoid: Ellipsoid) -> Result<Projection> {
    let first = latitude(definition, "lat_1", 0.0)?;
    let second = latitude(definition, "lat_2", 0.0)?;
    let made = Albers::new(ellipsoid, [first, second], latitude(definition, "lat_0", 0.0)?);
    let made = made.ok_or_else(|| {
        Error::new(format!("the parallels {first} and {second} do not span a cone"))
            .help("Albers' projection takes standard parallels that are not opposite to each other")
    })?;
    own(definition, Form::Albers(made))
}

fn azimuthal(definition: &Definition, ellipsoid: Ellipsoid) -> Result<Projection> {
    let lat_0 = latitude(definition, "lat_0", 0.0)?;
    own(definition, Form::AzimuthalEqualArea(AzimuthalEqualArea::new(ellipsoid, lat_0)))
}

fn is_polar(definition: &Definition) -> Result<bool> {
    Ok(latitude(definition, "lat_0", 0.0)?.abs() > 90.0 - 1e-9)
}

/// Of a pole: `+lat_ts` tells the scale, and only where it tells nothing does `+k_0` (PROJ's rule).
fn stereographic(definition: &Definition, ellipsoid: Ellipsoid) -> Result<Projection> {
    let pole = latitude(definition, "lat_0", 90.0)?;
    let true_scale = latitude(definition, "lat_ts", pole)?.abs().copysign(pole);
    let k_0 = if true_scale.abs() > 90.0 - 1e-9 { definition.scale()? } else { 1.0 };
    let made = PolarStereographic::new(ellipsoid, true_scale, k_0);
    own(definition, Form::PolarStereographic(made))
}

fn double_stereographic(definition: &Definition, ellipsoid: Ellipsoid) -> Result<Projection> {
    let lat_0 = latitude(definition, "lat_0", 0.0)?;
    let made = ObliqueStereographic::new(ellipsoid, lat_0, definition.scale()?);
    let made = made.ok_or_else(|| {
        Error::new("the double stereographic projection has its origin off the poles")
            .help("a pole has +proj=stere")
    })?;
    own(definition, Form::ObliqueStereographic(made))
}

fn swiss(definition: &Definition, ellipsoid: Ellipsoid) -> Result<Projection> {
    let lat_0 = latitude(definition, "lat_0", 0.0)?;
    own(definition, Form::Swiss(SwissMercator::new(ellipsoid, lat_0, definition.scale()?)))
}

/// What a text leaves out is that of the survey of Czechoslovakia (PROJ's rule).
fn krovak(definition: &Definition, ellipsoid: Ellipsoid) -> Result<Projection> {
    let lat_0 = latitude(definition, "lat_0", 49.5)?;
    let k_0 = if definition.text("k_0").is_some() { definition.scale()? } else { 0.9999 };
    let mut origin = Origin::new(definition)?;
    origin.lon_0 = definition.number_or("lon_0", 24.0 + 5.0 / 6.0)?;
    Ok(Projection::Own(origin, Box::new(Form::Krovak(Krovak::new(ellipsoid, lat_0, k_0)))))
}

fn own(definition: &Definition, form: Form) -> Result<Projection> {
    Ok(Projection::Own(Origin::new(definition)?, Box::new(form)))
}

fn latitude(definition: &Definition, key: &str, default: f64) -> Result<f64> {
    let lat = definition.number_or(key, default)?;
    if lat.abs() <= 90.0 {
        return Ok(lat);
    }
    Err(Error::new(format!("+{key}={lat} is not a latitude")))
}
