//! The description of the scene file as a JSON Schema, for editors.

use super::keys::{ROOT, SCHEMA};
use super::shape::{Key, Range, Rule, Shape, TableShape};
use serde_json::{Map, Value, json};

/// The scene file's JSON Schema (draft 2020-12).
pub fn schema() -> Value {
    let mut root = table(&ROOT);
    root["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    root["title"] = json!(format!("Drapery scene file, schema {SCHEMA}"));
    root
}

fn table(shape: &TableShape) -> Value {
    let properties: Map<String, Value> = shape
        .keys
        .iter()
        .map(|key| (key.name.into(), described(key)))
        .collect();
    let required: Vec<_> = shape
        .keys
        .iter()
        .filter(|key| key.required)
        .map(|key| key.name)
        .collect();
    let mut table = json!({ "type": "object", "properties": properties, "additionalProperties": false });
    if !required.is_empty() {
        table["required"] = json!(required);
    }
    if !shape.rules.is_empty() {
        table["allOf"] = shape.rules.iter().map(rule).collect();
    }
    table
}

fn described(key: &Key) -> Value {
    let mut value = value(&key.shape);
    value["description"] = json!(key.doc);
    value
}

fn value(shape: &Shape) -> Value {
    match shape {
        Shape::Text => json!({ "type": "string", "minLength": 1 }),
        Shape::Color => json!({ "type": "string", "pattern": "^#([0-9a-fA-F]{6}|[0-9a-fA-F]{8})$" }),
        Shape::Choice(names) => json!({ "enum": names() }),
        Shape::Integer(low, high) => json!({ "type": "integer", "minimum": low, "maximum": high }),
        Shape::IntegerOf(numbers) => json!({ "enum": numbers }),
        Shape::Integers(count, low, high) => list(value(&Shape::Integer(*low, *high)), *count),
        Shape::Number(range) => number(*range),
        Shape::Numbers(count) => list(number(Range::Finite), *count),
        Shape::Paths => paths(),
        Shape::Table(shape) => table(shape),
        Shape::Tables(shape) => json!({ "type": "array", "items": table(shape) }),
    }
}

fn list(items: Value, count: usize) -> Value {
    json!({ "type": "array", "items": items, "minItems": count, "maxItems": count })
}

fn number(range: Range) -> Value {
    match range {
        Range::Finite => json!({ "type": "number" }),
        Range::Positive => json!({ "type": "number", "exclusiveMinimum": 0 }),
        Range::NotNegative => json!({ "type": "number", "minimum": 0 }),
        Range::FromOne => json!({ "type": "number", "minimum": 1 }),
        Range::Share => json!({ "type": "number", "minimum": 0, "maximum": 1 }),
        Range::Between(low, high) => {
            json!({ "type": "number", "exclusiveMinimum": low, "exclusiveMaximum": high })
        }
    }
}

fn paths() -> Value {
    let points = json!({ "type": "array", "items": list(number(Range::Finite), 2), "minItems": 1 });
    json!({ "anyOf": [points, { "type": "array", "items": points, "minItems": 1 }] })
}

fn rule(rule: &Rule) -> Value {
    let each =
        |keys: &[&str]| -> Vec<Value> { keys.iter().map(|key| json!({ "required": [key] })).collect() };
    match rule {
        Rule::One(keys) => json!({ "oneOf": each(keys) }),
        Rule::Some(keys) => json!({ "anyOf": each(keys) }),
        Rule::AtMostOne(keys) => json!({ "not": { "required": keys } }),
    }
}
