//! The list of EPSG codes, from `crs-definitions`, corrected.

use super::epsg_corrections::corrected;

/// What the list says of a code.
pub(crate) struct Known {
    /// The definition as a PROJ string.
    pub(crate) proj: String,
    /// The definition as WKT 1.
    pub(crate) wkt: &'static str,
}

/// Looks a code up.
pub(crate) fn known(code: u32) -> Option<Known> {
    let known = crs_definitions::from_code(u16::try_from(code).ok()?)?;
    // The list means Clarke 1880 (RGS) by PROJ's name of another Clarke 1880, whose pole lies 0.3 m off.
    let proj = known.proj4.replace("+ellps=clrk80 ", "+a=6378249.145 +rf=293.465 ");
    Some(Known { proj: corrected(code, &proj), wkt: known.wkt })
}
