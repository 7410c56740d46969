//! What of a scene file goes with planes alone.

use super::super::blame::of_key;
use crate::error::{Error, Result};
use crate::scene_file::{LayerSource, Order, OrderKey, SceneFile};
use glam::{DVec2, DVec3};

/// Refuses what a scene asks for that a globe does not have.
pub(in crate::source::load) fn check(scene: &SceneFile) -> Result<()> {
    let refuse =
        |key: &str, what: &str, help: &str| Err(of_key(scene, key, Error::unsupported(what).help(help)));
    if scene.crs.is_some() {
        return refuse(
            "crs",
            "`crs` names a plane, and the plan of a globe is that of the terrain's own CRS",
            "leave `crs` out; terrain.crs says what the terrain's degrees are of",
        );
    }
    if scene.terrain.offset != DVec3::ZERO {
        return refuse("terrain.offset", MOVED, "leave the offset out");
    }
    for layer in &scene.layers {
        let key = |key: &str| format!("layer.{}.{key}", layer.name);
        if layer.offset != DVec2::ZERO {
            return refuse(&key("offset"), MOVED, "leave the offset out");
        }
        if matches!(layer.source, LayerSource::Generate(_)) {
            return refuse(
                &key("generate"),
                "generated layers are made in metres of a plane",
                "name a file, or write features in longitude and latitude",
            );
        }
        let is_measured = match &layer.order {
            Order::File | Order::By { key: OrderKey::Column(_), .. } => false,
            Order::Size | Order::By { key: OrderKey::Area | OrderKey::Length, .. } => true,
        };
        if is_measured {
            return refuse(
                &key("order"),
                "areas and lengths are measured in the plan, where those of a globe are not true",
                "order by a column, or by the file",
            );
        }
    }
    Ok(())
}

const MOVED: &str =
    "what lies on a globe cannot be moved by metres of its plan, in which no place is as large as another";

/// The refusal of a terrain of which nobody knows what its degrees are of.
pub(in crate::source::load) fn without_crs() -> Error {
    Error::new("the terrain's CRS is not known, and with it the ellipsoid of the globe")
        .help("say it in the scene: terrain.crs = \"EPSG:4326\"")
}
