//! What stands in the place of the reader of GeoPackages in a build without the feature `gpkg`: its refusal.

use super::attributes::Wanted;
use super::collector::Collector;
use crate::error::{Error, Result};
use std::path::Path;

/// Refuses to read a layer.
pub(super) fn read(_: &Path, _: Option<&str>, _: Wanted) -> Result<Collector> {
    Err(missing())
}

/// Refuses to list the layers.
pub(super) fn layer_names(_: &Path) -> Result<Vec<String>> {
    Err(missing())
}

fn missing() -> Error {
    Error::unsupported("this build of drapery reads no GeoPackages: it lacks the feature `gpkg`").help(
        "build it with `--features gpkg`, or convert the file: ogr2ogr -f FlatGeobuf out.fgb in.gpkg LAYER",
    )
}
