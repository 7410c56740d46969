//! Data like that of the case studies of Zechmeister 2020, 5.1: as many polygons, holes, lines and vertices of each as Tables 5.1 and 5.2
//! tell, times a scale, and of the same character.
//!
//! The data itself is not published; what its pictures (Figs. 5.1 to 5.4) and words say of it is kept, its places are not.

mod lakes;
mod partition;
mod ribbons;
mod rivers;
mod scatter;
mod towns;

use super::random::{scramble, unit};
use crate::scene::{Attribute, Column, Feature, Shape};
use crate::scene_file::{Amount, DataGroup, Group, Study};
use crate::space::PlanBox;
use ribbons::Ribbons;
use std::cmp::max;
use towns::Towns;

/// The three intensities of floods (5.1.7), which lie in one another.
const FLOODS: Ribbons = Ribbons { levels: 3, half_width: 0.12 };
/// Depths of water (5.1.1).
const ISOLINES: Ribbons = Ribbons { levels: 6, half_width: 0.2 };
/// Kinds of land, of roads.
const CLASSES: u32 = 8;
/// Towns in and around Cologne, and as many in the other studies.
const TOWNS: f64 = 400.0;

/// The shapes of a group in draw order.
pub(super) fn shapes(study: Study, data: &DataGroup, scale: f64, seed: u64, window: PlanBox) -> Vec<Shape> {
    let seed_of_group = scramble(seed ^ scramble(data.group as u64));
    let least = if data.group == Group::Buildings { 4 } else { 3 };
    let areas = data.exterior.scaled(scale, least);
    // Holes may vanish: a hundredth of three is none.
    let whole = Amount::scaled(data.interior, scale, 3);
    let holes = if data.interior.decals as f64 * scale < 0.5 { Amount::default() } else { whole };
    let lines = data.lines.scaled(scale, 2);
    let towns = || Towns::new((TOWNS * scale).round() as usize, seed, window);
    match data.group {
        Group::Isolines => ISOLINES.areas(areas, holes, seed_of_group, window),
        Group::Floods => FLOODS.areas(areas, holes, seed_of_group, window),
        Group::Catchments | Group::LandUse => partition::partition(areas, holes, seed_of_group, window),
        Group::Lakes | Group::Water => lakes::lakes(areas, holes, seed_of_group, window),
        Group::Rivers | Group::Streams | Group::Rails => rivers::rivers(lines, seed_of_group, window),
        Group::Borders => {
            let vertices = max(lines.vertices, 4 * lines.decals);
            lakes::borders(Amount { vertices, ..lines }, seed_of_group, window)
        }
        Group::Roads | Group::Tracks => towns().streets(lines),
        Group::Buildings => {
            let streets = study.group(Group::Roads).map_or(0, |roads| roads.lines.scaled(scale, 2).decals);
            towns().buildings(areas, streets)
        }
    }
}

/// The attributes of a group's features: `class`, of floods and isolines the level (0 the widest), of others a kind; `area_m2`, that of a polygon's outer
/// ring without its holes, for colours that follow the size (5.1.6, 5.1.8).
pub(super) fn columns(data: &DataGroup, seed: u64, features: &[Feature]) -> Vec<Column> {
    let seed = scramble(seed ^ scramble(1000 + data.group as u64));
    let class = |feature: &Feature| match data.group {
        Group::Floods => feature.index % FLOODS.levels,
        Group::Isolines => feature.index % ISOLINES.levels,
        _ => (unit(scramble(seed ^ feature.index as u64)) * f64::from(CLASSES)) as usize,
    };
    let classes = features.iter().map(|feature| Attribute::Integer(class(feature) as i64)).collect();
    let mut columns = vec![Column { name: "class".into(), values: classes }];
    if data.exterior.decals > 0 {
        let areas = features.iter().map(|feature| Attribute::of_number(area(&feature.shape))).collect();
        columns.push(Column { name: "area_m2".into(), values: areas });
    }
    columns
}

/// The area of the polygon's rings, holes run the other way.
fn area(shape: &Shape) -> f64 {
    let next = |ring: &[crate::space::Plan], k: usize| ring[(k + 1) % ring.len()];
    let twice = shape.parts().map(|ring| {
        // From a vertex of its own, lest areas far from the origin lose digits.
        let corners = (1..ring.len()).map(|k| (ring[k] - ring[0]).perp_dot(next(ring, k) - ring[0]));
        corners.sum::<f64>()
    });
    0.5 * twice.sum::<f64>()
}

#[cfg(test)]
mod tests;
