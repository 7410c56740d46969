//! Values of parameters, as files have them and as code has them.

use super::{Named, Shape, choice};
use std::fmt;

/// The value of a parameter, whatever its type.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// One of the parameter's words.
    Word(&'static str),
    /// A whole number.
    Integer(i64),
    /// A finite number.
    Number(f64),
    /// Some finite numbers.
    Numbers(Vec<f64>),
}

/// As JSON, which is TOML too.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", serde_json::Value::from(self.clone()))
    }
}

/// Whole numbers have no point, whatever they are values of.
impl From<Value> for serde_json::Value {
    fn from(value: Value) -> Self {
        match value {
            Value::Word(word) => word.into(),
            Value::Integer(whole) => whole.into(),
            Value::Number(one) => number(one),
            Value::Numbers(several) => several.into_iter().map(number).collect(),
        }
    }
}

fn number(number: f64) -> serde_json::Value {
    /// From here on not every whole number is a double.
    const EXACT: f64 = 9_007_199_254_740_992.0;
    if number.floor() == number && number.abs() < EXACT { (number as i64).into() } else { number.into() }
}

/// A type that a parameter may have.
pub trait Setting: Sized {
    /// What its values look like where the declaration says no more.
    const SHAPE: Shape;

    /// The value of a parameter of this shape.
    fn to_value(&self, shape: &Shape) -> Value;

    /// What a value of a parameter of this shape stands for; `None` where the shape does not allow it.
    fn from_value(value: &Value, shape: &Shape) -> Option<Self>;
}

impl<T: Named> Setting for T {
    const SHAPE: Shape = choice::<T>();

    fn to_value(&self, _: &Shape) -> Value {
        Value::Word(self.word())
    }

    fn from_value(value: &Value, _: &Shape) -> Option<Self> {
        if let Value::Word(word) = value { T::from_name(word) } else { None }
    }
}

impl Setting for u32 {
    const SHAPE: Shape = Shape::Integer(0, u32::MAX as i64);

    fn to_value(&self, _: &Shape) -> Value {
        Value::Integer(i64::from(*self))
    }

    fn from_value(value: &Value, _: &Shape) -> Option<Self> {
        if let Value::Integer(whole) = value { u32::try_from(*whole).ok() } else { None }
    }
}

impl Setting for f64 {
    const SHAPE: Shape = Shape::Number(super::Range::Finite);

    fn to_value(&self, _: &Shape) -> Value {
        Value::Number(*self)
    }

    fn from_value(value: &Value, _: &Shape) -> Option<Self> {
        if let Value::Number(number) = value { Some(*number) } else { None }
    }
}

impl<const N: usize> Setting for [f64; N] {
    const SHAPE: Shape = Shape::Numbers(N);

    fn to_value(&self, _: &Shape) -> Value {
        Value::Numbers(self.to_vec())
    }

    fn from_value(value: &Value, _: &Shape) -> Option<Self> {
        if let Value::Numbers(numbers) = value { numbers[..].try_into().ok() } else { None }
    }
}

/// What may be absent has a word for that, which the declaration says: [`Shape::Or`].
impl<T: Setting> Setting for Option<T> {
    const SHAPE: Shape = panic!("a parameter that may be absent needs `or(word, shape)`");

    fn to_value(&self, shape: &Shape) -> Value {
        let (word, inner) = if let Shape::Or(word, inner) = shape { (*word, *inner) } else { ("", shape) };
        self.as_ref().map_or(Value::Word(word), |value| value.to_value(inner))
    }

    fn from_value(value: &Value, shape: &Shape) -> Option<Self> {
        match (value, shape) {
            (Value::Word(said), Shape::Or(word, _)) if said == word => Some(None),
            (value, Shape::Or(_, inner)) => T::from_value(value, inner).map(Some),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_written_as_json_and_whole_numbers_without_a_point() {
        let values = [
            Value::Word("4a-adjacency"),
            Value::Integer(-3),
            Value::Number(1024.0),
            Value::Number(-0.25),
            Value::Number(1e300),
            Value::Numbers(vec![10.0, 20.5]),
        ];
        let texts = values.map(|value| value.to_string());
        assert_eq!(texts, ["\"4a-adjacency\"", "-3", "1024", "-0.25", "1e300", "[10,20.5]"]);
    }

    #[test]
    fn what_may_be_absent_has_a_word() {
        const SHAPE: Shape = Shape::Or("all", &Shape::Integer(0, 9));
        assert_eq!(None::<u32>.to_value(&SHAPE), Value::Word("all"));
        assert_eq!(Some(7).to_value(&SHAPE), Value::Integer(7));
        assert_eq!(Option::<u32>::from_value(&Value::Word("all"), &SHAPE), Some(None));
        assert_eq!(Option::<u32>::from_value(&Value::Integer(7), &SHAPE), Some(Some(7)));
        assert_eq!(Option::<u32>::from_value(&Value::Word("some"), &SHAPE), None);
        assert_eq!(Option::<u32>::from_value(&Value::Integer(-1), &SHAPE), None);
    }
}
