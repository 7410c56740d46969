//! The properties of features: a column of attributes each.

use crate::scene::Attribute;
use crate::source::vector::collector::Collector;
use serde::de::{self, DeserializeSeed, Deserializer, IgnoredAny, MapAccess, SeqAccess, Visitor};
use std::fmt;

/// The properties of the current feature, added one by one; those that are not wanted are passed over.
pub(super) struct Properties<'a>(pub(super) &'a mut Collector);

impl<'de> DeserializeSeed<'de> for Properties<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> std::result::Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Properties<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object of properties")
    }

    fn visit_unit<E>(self) -> std::result::Result<(), E> {
        Ok(())
    }

    /// Some writers write no properties as an empty list.
    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> std::result::Result<(), A::Error> {
        match seq.next_element::<IgnoredAny>()? {
            None => Ok(()),
            Some(_) => Err(de::Error::invalid_type(de::Unexpected::Seq, &self)),
        }
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> std::result::Result<(), A::Error> {
        let feature = self.0.current();
        let attributes = &mut self.0.attributes;
        while let Some(name) = map.next_key::<String>()? {
            let column = attributes.column(&name);
            if attributes.reads(column) {
                attributes.put(column, feature, value(map.next_value()?));
            } else {
                map.next_value::<IgnoredAny>()?;
            }
        }
        Ok(())
    }
}

fn value(json: serde_json::Value) -> Attribute {
    match json {
        serde_json::Value::Null => Attribute::Null,
        serde_json::Value::Bool(flag) => Attribute::Boolean(flag),
        serde_json::Value::String(text) => Attribute::Text(text),
        serde_json::Value::Number(number) => match number.as_i64() {
            Some(whole) => Attribute::Integer(whole),
            None => number.as_f64().map_or(Attribute::Null, Attribute::of_number),
        },
        nested => Attribute::Text(nested.to_string()),
    }
}
