//! What looks wrong in a reference system for the features that are said to be in it.

use crate::crs::Crs;
use crate::scene::Feature;
use crate::space::Plan;

/// Longitudes of more turns than this nobody means.
pub(in crate::source) const MOST_TURNS: f64 = 10.0;

/// What a user should know of a CRS and the features in it: a datum without a shift, places off the globe. The CRS is the file's, or what
/// the scene says in its place.
pub fn doubts(crs: &Crs, features: &[Feature]) -> Vec<String> {
    let off_the_globe = crs.degrees_per_unit().and_then(|degrees| metres_under_degrees(features, degrees));
    crs.note().into_iter().chain(off_the_globe).collect()
}

fn metres_under_degrees(features: &[Feature], degrees: f64) -> Option<String> {
    // A degree beyond a pole is the outer edge of cells, or rounding.
    let off = |p: &Plan| p.x.abs() * degrees > 360.0 * MOST_TURNS || p.y.abs() * degrees > 91.0;
    let is_wrong = |feature: &&Feature| feature.shape.parts().flatten().any(off);
    let mut wrong = features.iter().filter(is_wrong).map(|feature| feature.index);
    let first = wrong.next()?;
    Some(format!(
        "the CRS is in degrees but {} of {} features (the first is feature {first}) are off the globe: metres, perhaps",
        1 + wrong.count(),
        features.len()
    ))
}
