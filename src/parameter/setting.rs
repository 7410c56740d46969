//! The types that parameters may have.

use super::{Named, Range, Shape, Value, choice};

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
    const SHAPE: Shape = Shape::Number(Range::Finite);

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
