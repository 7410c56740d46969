//! Which features of a layer are drawn: those that fulfil all of its conditions.

use super::columns::Columns;
use crate::error::{Error, Result};
use crate::scene::{Attribute, Feature};
use crate::scene_file::{Condition, LayerSpec, Test, nearest};
use std::collections::BTreeSet;

/// The features that fulfil the layer's conditions, in their order; notes tell of values that no feature has.
pub(super) fn fulfilling(
    features: Vec<Feature>,
    spec: &LayerSpec,
    columns: &Columns<'_>,
    notes: &mut Vec<String>,
) -> Result<Vec<Feature>> {
    if spec.conditions.is_empty() {
        return Ok(features);
    }
    for condition in &spec.conditions {
        note_values_that_nobody_has(condition, columns, notes);
    }
    let count = features.len();
    let mut kept = Vec::new();
    for feature in features {
        if fulfils(&feature, spec, columns).map_err(|e| columns.blame(e.in_feature(feature.index)))? {
            kept.push(feature);
        }
    }
    if kept.is_empty() && count > 0 {
        notes.push(format!("none of its {count} features fulfils `where`"));
    }
    Ok(kept)
}

fn fulfils(feature: &Feature, spec: &LayerSpec, columns: &Columns<'_>) -> Result<bool> {
    for Condition { column, test } in &spec.conditions {
        let value = columns.value(column, feature.index);
        let holds = match (test, value) {
            (_, Attribute::Null) => false,
            (Test::OneOf(values), value) => values.contains(value),
            (Test::Within(bounds), value) => match value.number() {
                Some(number) => bounds.contain(number),
                None => return Err(no_number(column, value, &spec.name)),
            },
        };
        if !holds {
            return Ok(false);
        }
    }
    Ok(true)
}

fn no_number(column: &str, value: &Attribute, layer: &str) -> Error {
    Error::new(format!("the column `{column}` holds {value}, and `layer.{layer}.where` compares numbers"))
        .help("list the values that are wanted, such as [\"a\", \"b\"]")
}

fn note_values_that_nobody_has(condition: &Condition, columns: &Columns<'_>, notes: &mut Vec<String>) {
    let Test::OneOf(wanted) = &condition.test else {
        return;
    };
    let column = &condition.column;
    let there: BTreeSet<&Attribute> = columns.values(column).iter().collect();
    let texts: Vec<&str> = there.iter().filter_map(|value| value.text()).collect();
    for value in wanted.iter().filter(|value| !there.contains(value)) {
        let near = value.text().and_then(|text| nearest(text, &texts));
        let help = near.map_or_else(String::new, |near| format!("; did you mean {near:?}?"));
        notes.push(format!("`where`: no feature has {value} in the column `{column}`{help}"));
    }
}
