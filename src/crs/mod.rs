//! Coordinate reference systems: what a file's coordinates mean, and how they become plan coordinates.

/// A coordinate reference system.
#[derive(Debug, Clone, PartialEq)]
pub struct Crs {}
