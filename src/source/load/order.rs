//! The draw order of a layer's features.

use super::columns::Columns;
use super::size::{area, area_of_members, length};
use crate::parallel;
use crate::scene::{Attribute, Feature, Rule, Shape};
use crate::scene_file::{LayerSpec, Order, OrderKey};
use std::cmp::Ordering;

/// The features in draw order; equal ones keep theirs.
pub(super) fn ordered(features: Vec<Feature>, spec: &LayerSpec, columns: &Columns<'_>) -> Vec<Feature> {
    if spec.order == Order::File {
        return features;
    }
    let rule = spec.style.fill.as_ref().map_or_else(Rule::default, |fill| fill.rule);
    let descending = matches!(spec.order, Order::By { descending: true, .. });
    let key = |feature: Feature| (key(&spec.order, &feature, rule, columns), feature);
    let mut all = parallel::map_owned(features, key);
    all.sort_by(|(a, _), (b, _)| a.against(b, descending));
    all.into_iter().map(|(_, feature)| feature).collect()
}

/// Where a feature stands: first by its group, whatever the direction, then by its value.
struct Key {
    group: u8,
    value: Attribute,
}

impl Key {
    fn against(&self, other: &Self, descending: bool) -> Ordering {
        let by_value = self.value.cmp(&other.value);
        self.group.cmp(&other.group).then(if descending { by_value.reverse() } else { by_value })
    }
}

fn key(order: &Order, feature: &Feature, rule: Rule, columns: &Columns<'_>) -> Key {
    let own_area = || match &feature.shape {
        Shape::Polygon(rings) => area(rings, rule),
        Shape::MultiPolygon(members) | Shape::Swath { members, .. } => area_of_members(members, rule),
        Shape::Line(_) | Shape::Points(_) => 0.0,
    };
    let own_length = || length(&feature.shape);
    let (group, value) = match (order, &feature.shape) {
        (Order::File, _) => (0, Attribute::Null),
        // Zechmeister 2020, 3.2.1, Bounding Volume Hierarchies: by default the line lengths and polygon areas are used as
        // sorting criteria, because long lines and large polygons are usually more important (and important ones on top).
        (Order::Size, Shape::Polygon(_) | Shape::MultiPolygon(_) | Shape::Swath { .. }) => {
            (0, Attribute::of_number(own_area()))
        }
        (Order::Size, Shape::Line(_)) => (1, Attribute::of_number(own_length())),
        (Order::Size, Shape::Points(_)) => (2, Attribute::Null),
        (Order::By { key: OrderKey::Area, .. }, _) => (0, Attribute::of_number(own_area())),
        (Order::By { key: OrderKey::Length, .. }, _) => (0, Attribute::of_number(own_length())),
        (Order::By { key: OrderKey::Column(column), .. }, _) => {
            let value = columns.value(column, feature.index);
            (u8::from(!value.is_null()), value.clone())
        }
    };
    Key { group, value }
}
