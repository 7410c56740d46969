//! Geodesics: the shortest ways between places of an ellipsoid.
//!
//! C. F. F. Karney, *Algorithms for geodesics*, J. Geodesy 87 (2013): the direct and the inverse problem by series to the sixth order,
//! to some nanometres on ellipsoids like the Earth's and to a micrometre on those as flat as 1/50, for all pairs of places, nearly antipodal ones too.
//!
//! Input: an ellipsoid, two latitudes in degrees and by how much the second place lies east of the first one. Output: the length, and
//! the point at any share of the way. Nothing is refused. Where several ways are shortest, one is taken.
//!
//! - `inverse.rs`: which way leads from one place to the other (sections 4 and 5), from the first guess of `guess.rs`;
//! - `way.rs`: where one is after a distance (section 3);
//! - `triangle.rs`, `series.rs`, `angle.rs`: what both are made of.

mod angle;
mod guess;
mod inverse;
mod series;
mod triangle;
mod way;

pub(super) use way::Geodesic;

#[cfg(test)]
mod tests;
