//! The description of the scene file as a JSON Schema, for editors.

use super::keys::{ROOT, SCHEMA};
use crate::parameter::{Key, Range, Rule, Shape, TableShape};
use serde_json::{Map, Value, json};

/// The forms of a colour; which names there are is left to the program.
const COLOR: &str = "^(#([0-9a-fA-F]{3,4}|[0-9a-fA-F]{6}|[0-9a-fA-F]{8})|[a-zA-Z]+|([rR][gG][bB][aA]?|[hH][sS][lL][aA]?|[hH][wW][bB])\\(.*\\))$";

/// The scene file's JSON Schema (draft 2020-12).
pub fn schema() -> Value {
    let mut root = table(&ROOT);
    root["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    root["title"] = json!(format!("Drapery scene file, schema {SCHEMA}"));
    root
}

fn table(shape: &TableShape) -> Value {
    let properties: Map<String, Value> =
        shape.keys.iter().map(|key| (key.name.into(), described(key))).collect();
    let required: Vec<_> = shape.keys.iter().filter(|key| key.required).map(|key| key.name).collect();
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
    value["description"] = json!(key.description());
    value
}

fn value(shape: &Shape) -> Value {
    match shape {
        Shape::Text => json!({ "type": "string", "minLength": 1 }),
        Shape::Texts => {
            let text = value(&Shape::Text);
            json!({ "anyOf": [text.clone(), { "type": "array", "items": text, "minItems": 1 }] })
        }
        Shape::Color => json!({ "type": "string", "pattern": COLOR }),
        Shape::Flag => json!({ "type": "boolean" }),
        Shape::Choice(names, _) => json!({ "enum": names() }),
        Shape::Integer(low, high) => json!({ "type": "integer", "minimum": low, "maximum": high }),
        Shape::IntegerOf(numbers) => json!({ "enum": numbers }),
        Shape::Integers(count, low, high) => list(value(&Shape::Integer(*low, *high)), *count, *count),
        Shape::Number(range) => number(*range),
        Shape::Numbers(count) => list(number(Range::Finite), *count, *count),
        Shape::Pattern(most, range) => {
            let pairs = (1..=most / 2).map(|pairs| list(number(*range), 2 * pairs, 2 * pairs));
            json!({ "anyOf": pairs.collect::<Vec<_>>() })
        }
        Shape::PairOrTriple => list(number(Range::Finite), 2, 3),
        Shape::Or(word, shape) => json!({ "anyOf": [value(shape), { "enum": [word] }] }),
        Shape::Paths => paths(),
        Shape::Scalar => scalar(),
        Shape::Scalars => {
            json!({ "anyOf": [scalar(), { "type": "array", "items": scalar(), "minItems": 1 }] })
        }
        Shape::Stops(shape) => json!({ "type": "array", "items": pair(value(shape)), "minItems": 1 }),
        Shape::Map(shape) => json!({ "type": "object", "additionalProperties": value(shape) }),
        Shape::OrTable(shape, inner) => json!({ "anyOf": [value(shape), table(inner)] }),
        Shape::Table(shape) => table(shape),
        Shape::Tables(shape) => json!({ "type": "array", "items": table(shape) }),
    }
}

fn list(items: Value, least: usize, most: usize) -> Value {
    json!({ "type": "array", "items": items, "minItems": least, "maxItems": most })
}

fn scalar() -> Value {
    json!({ "anyOf": [{ "type": "string" }, { "type": "number" }, { "type": "boolean" }] })
}

/// A number and a value.
fn pair(second: Value) -> Value {
    json!({ "type": "array", "prefixItems": [number(Range::Finite), second], "minItems": 2, "maxItems": 2 })
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
        Range::UpTo(most) => json!({ "type": "number", "exclusiveMinimum": 0, "maximum": most }),
    }
}

fn paths() -> Value {
    let points = json!({ "type": "array", "items": list(number(Range::Finite), 2, 2), "minItems": 1 });
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

#[cfg(test)]
mod tests {
    use super::super::tests::EVERY_KEY;
    use super::*;

    /// Whether a value fits a schema, for the words that our schema uses.
    fn fits(schema: &Value, value: &Value) -> bool {
        let list = |word: &str| schema[word].as_array().cloned().unwrap_or_default();
        let fitting = |word: &str| list(word).iter().filter(|inner| fits(inner, value)).count();
        let has = |key: &Value| key.as_str().is_some_and(|key| value.get(key).is_some());
        fits_type(schema, value)
            && (schema["enum"].is_null() || list("enum").contains(value))
            && list("required").iter().all(has)
            && fitting("allOf") == list("allOf").len()
            && (schema["oneOf"].is_null() || fitting("oneOf") == 1)
            && (schema["anyOf"].is_null() || fitting("anyOf") > 0)
            && (schema["not"].is_null() || !fits(&schema["not"], value))
            && fits_number(schema, value)
            && fits_pattern(schema, value)
            && fits_parts(schema, value)
    }

    fn fits_type(schema: &Value, value: &Value) -> bool {
        match schema["type"].as_str() {
            Some("object") => value.is_object(),
            Some("array") => value.is_array(),
            Some("string") => {
                value.as_str().is_some_and(|text| !text.is_empty() || schema["minLength"].is_null())
            }
            Some("boolean") => value.is_boolean(),
            Some("integer") => value.is_i64(),
            Some("number") => value.is_number(),
            _ => true,
        }
    }

    /// Colours have the only pattern.
    fn fits_pattern(schema: &Value, value: &Value) -> bool {
        schema["pattern"].is_null()
            || value.as_str().is_some_and(|text| crate::parameter::color(text).is_some())
    }

    fn fits_number(schema: &Value, value: &Value) -> bool {
        let Some(number) = value.as_f64() else { return true };
        let limit = |word: &str, otherwise| schema[word].as_f64().unwrap_or(otherwise);
        limit("minimum", number) <= number
            && number <= limit("maximum", number)
            && limit("exclusiveMinimum", f64::NEG_INFINITY) < number
            && number < limit("exclusiveMaximum", f64::INFINITY)
    }

    fn fits_parts(schema: &Value, value: &Value) -> bool {
        let properties = &schema["properties"];
        let known = |(key, value): (&String, &Value)| match properties.get(key) {
            Some(schema) => fits(schema, value),
            None if schema["additionalProperties"].is_object() => {
                fits(&schema["additionalProperties"], value)
            }
            None => schema["additionalProperties"] != json!(false),
        };
        let first = schema["prefixItems"].as_array().cloned().unwrap_or_default();
        let items = value.as_array().map_or(&[][..], Vec::as_slice);
        let count = items.len() as u64;
        let counted = !value.is_array()
            || (schema["minItems"].as_u64().unwrap_or(0)..=schema["maxItems"].as_u64().unwrap_or(u64::MAX))
                .contains(&count);
        value.as_object().is_none_or(|object| object.iter().all(known))
            && counted
            && first.iter().zip(items).all(|(schema, item)| fits(schema, item))
            && items.iter().all(|item| fits(&schema["items"], item))
    }

    fn as_json(text: &str) -> Value {
        serde_json::to_value(toml::from_str::<toml::Value>(text).unwrap()).unwrap()
    }

    #[test]
    fn scenes_that_parse_fit_the_schema() {
        for text in EVERY_KEY.into_iter().chain([super::super::DEFAULT_SCENE]) {
            assert!(fits(&schema(), &as_json(text)), "{text}");
        }
    }

    #[test]
    fn scenes_that_are_refused_do_not_fit_the_schema() {
        let terrain = "schema = 1\nterrain.generate = { kind = \"plane\" }\n";
        assert!(fits(&schema(), &as_json(terrain)));
        for wrong in [
            "image.width = 0",
            "image.wide = 3",
            "terrain.source = \"a.tif\"",
            "camera.eye = [1, 2]",
            "terrain.offset = [1]",
            "terrain.offset = [1, 2, 3, 4]",
            "camera.projection = \"flat\"",
            "camera.fov_y_deg = 180",
            "camera = { eye = [1, 2, 3], eye_geo = [1, 2, 3] }",
            "[[layer]]\nsource = \"a.shp\"",
            "[[layer]]\nsource = \"a.shp\"\nline = { color = \"#ff0000\" }",
            "[[layer]]\nfeatures = [{ line = [] }]\nline = { color = \"#ff0000\", width_m = 1 }",
            "[[layer]]\nsource = \"a.shp\"\nfill = { color = \"reddish\" }",
            "[[layer]]\nsource = \"a.shp\"\nfill = { color = { by = \"A\", map = { x = 3 } } }",
            "[[layer]]\nsource = \"a.shp\"\nfill = { color = { by = \"A\", stops = [[\"#000000\", 0]] } }",
            "[[layer]]\nsource = \"a.shp\"\nfill = { color = { by = \"A\" } }",
            "[[layer]]\nsource = \"a.shp\"\nfill = { color = \"#000000\" }\nwhere = { A = [] }",
            "[[layer]]\nsource = \"a.shp\"\nfill = { color = \"#000000\" }\nwhere = { A = { least = 3 } }",
            "[[layer]]\nsource = \"a.shp\"\nfill = { color = \"#000000\" }\norder = \"sise\"",
            "[[layer]]\nsource = \"a.shp\"\nfill = { color = \"#000000\" }\norder = { by = \"A\", descending = 1 }",
        ] {
            assert!(!fits(&schema(), &as_json(&format!("{terrain}{wrong}"))), "{wrong}");
            assert!(
                super::super::SceneFile::parse(&format!("{terrain}{wrong}"), None, &[]).is_err(),
                "{wrong}"
            );
        }
    }
}
