//! What a layer asks of its columns: settings, conditions, order.

use crate::error::Result;
use crate::parameter::Named;
use crate::scene_file::by_column::{Bounds, ByColumn, Condition, Order, OrderKey, Scale, StyleSetting, Test};
use crate::scene_file::names::OrderName;
use crate::scene_file::section::{Section, Taken, as_scalar, bug};
use crate::scene_file::tree::{Node, Value};

/// A setting, or which column tells it.
pub(super) fn setting<T>(
    section: &mut Section<'_>,
    key: &str,
    convert: fn(Value) -> Option<T>,
) -> Result<Option<StyleSetting<T>>> {
    let Some(node) = section.take(key) else {
        return Ok(None);
    };
    if let Value::Table(_) = node.value {
        let by = |section: &mut Section<'_>| by_column(section, convert);
        return Section::read(section.origin(), node, by).map(StyleSetting::ByColumn).map(Some);
    }
    convert(node.value).map(StyleSetting::Constant).map(Some).ok_or_else(|| bug(key))
}

fn by_column<T>(section: &mut Section<'_>, convert: fn(Value) -> Option<T>) -> Result<ByColumn<T>> {
    let value = |node: Node| convert(node.value).ok_or_else(|| bug("a setting"));
    let map = section.map("map", value)?.map(Scale::Map);
    let stops = section.stops("stops", convert)?.map(|stops| ascending(section, stops)).transpose()?;
    Ok(ByColumn {
        column: section.text("by")?.ok_or_else(|| bug("by"))?,
        scale: map.or(stops).ok_or_else(|| bug("map"))?,
        default: section.take("default").map(value).transpose()?,
    })
}

fn ascending<T>(section: &Section<'_>, stops: Taken<Vec<(f64, T)>>) -> Result<Scale<T>> {
    let Taken { value: stops, place } = stops;
    match stops.windows(2).find(|pair| pair[0].0 >= pair[1].0) {
        None => Ok(Scale::Stops(stops)),
        Some(pair) => {
            let what = format!("`stops` must ascend; {} is followed by {}", pair[0].0, pair[1].0);
            Err(section.error_at(&place, what))
        }
    }
}

/// A number's value.
#[expect(clippy::needless_pass_by_value, reason = "as the other conversions")]
pub(super) fn as_number(value: Value) -> Option<f64> {
    value.number()
}

/// The conditions of a layer, by column.
pub(super) fn conditions(section: &mut Section<'_>) -> Result<Vec<Condition>> {
    let origin = section.origin();
    let test = |node: Node| match node.value {
        Value::Table(_) => Section::read(origin, node, bounds).map(Test::Within),
        Value::Array(items) => one_of(items.into_iter().map(|item| item.value)),
        value => one_of(std::iter::once(value)),
    };
    let conditions = section.map("where", test)?.unwrap_or_default();
    Ok(conditions.into_iter().map(|(column, test)| Condition { column, test }).collect())
}

fn one_of(values: impl Iterator<Item = Value>) -> Result<Test> {
    values.map(as_scalar).collect::<Option<_>>().map(Test::OneOf).ok_or_else(|| bug("a value"))
}

fn bounds(section: &mut Section<'_>) -> Result<Bounds> {
    Ok(Bounds {
        min: section.number("min")?,
        max: section.number("max")?,
        above: section.number("above")?,
        below: section.number("below")?,
    })
}

/// The draw order of a layer.
pub(super) fn order(section: &mut Section<'_>) -> Result<Order> {
    let Some(node) = section.take("order") else {
        return Ok(Order::File);
    };
    if let Some(name) = node.value.text() {
        return match OrderName::from_name(name).ok_or_else(|| bug("order"))? {
            OrderName::File => Ok(Order::File),
            OrderName::Size => Ok(Order::Size),
        };
    }
    Section::read(section.origin(), node, |section| {
        let key = match section.text("by")?.ok_or_else(|| bug("by"))?.as_str() {
            "area" => OrderKey::Area,
            "length" => OrderKey::Length,
            column => OrderKey::Column(column.into()),
        };
        Ok(Order::By { key, descending: section.flag("descending")?.unwrap_or(false) })
    })
}
