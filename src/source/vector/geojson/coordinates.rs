//! Coordinates: arrays in arrays, read straight into vertices.

use crate::space::Plan;
use serde::Deserialize;
use serde::de::{self, Deserializer, IgnoredAny, SeqAccess, Visitor};
use std::fmt;

/// Nested arrays of numbers, told apart as they are read.
pub(super) enum Coordinates {
    Number(f64),
    Point(Plan),
    Path(Vec<Plan>),
    Nest(Vec<Self>),
}

impl<'de> Deserialize<'de> for Coordinates {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> std::result::Result<Self, D::Error> {
        deserializer.deserialize_any(CoordinatesVisitor)
    }
}

struct CoordinatesVisitor;

impl<'de> Visitor<'de> for CoordinatesVisitor {
    type Value = Coordinates;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("coordinates")
    }

    fn visit_f64<E>(self, x: f64) -> std::result::Result<Coordinates, E> {
        Ok(Coordinates::Number(x))
    }

    fn visit_i64<E>(self, x: i64) -> std::result::Result<Coordinates, E> {
        Ok(Coordinates::Number(x as f64))
    }

    fn visit_u64<E>(self, x: u64) -> std::result::Result<Coordinates, E> {
        Ok(Coordinates::Number(x as f64))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> std::result::Result<Coordinates, A::Error> {
        match seq.next_element()? {
            None => Ok(Coordinates::Nest(Vec::new())),
            Some(Coordinates::Number(x)) => position(x, seq),
            Some(Coordinates::Point(p)) => path(p, seq),
            Some(first) => nest(first, seq),
        }
    }
}

/// x, y, and a height or more that are dropped.
fn position<'de, A: SeqAccess<'de>>(x: f64, mut seq: A) -> std::result::Result<Coordinates, A::Error> {
    let y = seq.next_element()?.ok_or_else(|| de::Error::custom("a position has one number only"))?;
    while seq.next_element::<IgnoredAny>()?.is_some() {}
    Ok(Coordinates::Point(Plan::new(x, y)))
}

fn path<'de, A: SeqAccess<'de>>(first: Plan, mut seq: A) -> std::result::Result<Coordinates, A::Error> {
    let mut points = vec![first];
    while let Some(next) = seq.next_element()? {
        let Coordinates::Point(p) = next else {
            return Err(de::Error::custom("a list of positions holds something else"));
        };
        points.push(p);
    }
    Ok(Coordinates::Path(points))
}

fn nest<'de, A: SeqAccess<'de>>(
    first: Coordinates,
    mut seq: A,
) -> std::result::Result<Coordinates, A::Error> {
    let mut inner = vec![first];
    while let Some(next) = seq.next_element()? {
        if matches!(next, Coordinates::Number(_) | Coordinates::Point(_)) {
            return Err(de::Error::custom("coordinates are nested unevenly"));
        }
        inner.push(next);
    }
    Ok(Coordinates::Nest(inner))
}
