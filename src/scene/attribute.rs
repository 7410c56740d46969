//! What features carry beside their geometry: values by column.

use std::cmp::Ordering;
use std::fmt;

/// A feature's value in a column.
///
/// Values are ordered: no value, then `false`, `true`, then numbers by their size, then texts by their characters' codes. A whole
/// number and another number are compared exactly, so that 2 and 2.0 are equal, and so are both zeros.
///
/// # Guarantees (kept by the sources)
/// A number is not NaN: what is not a number is no value. Dates are texts, `2026-01-31` or `2026-01-31T12:00:00`.
#[derive(Debug, Clone)]
pub enum Attribute {
    /// No value.
    Null,
    /// Yes or no.
    Boolean(bool),
    /// A whole number.
    Integer(i64),
    /// Any number.
    Number(f64),
    /// A text, possibly empty.
    Text(String),
}

impl Attribute {
    /// A number; no value where it is not one.
    pub fn of_number(number: f64) -> Self {
        if number.is_nan() { Self::Null } else { Self::Number(number) }
    }

    /// The number that it is.
    pub fn number(&self) -> Option<f64> {
        match self {
            Self::Integer(number) => Some(*number as f64),
            Self::Number(number) => Some(*number),
            Self::Null | Self::Boolean(_) | Self::Text(_) => None,
        }
    }

    /// The text that it is.
    pub fn text(&self) -> Option<&str> {
        if let Self::Text(text) = self { Some(text) } else { None }
    }

    /// Whether there is none.
    pub fn is_null(&self) -> bool {
        matches!(self, Self::Null)
    }

    fn rank(&self) -> u8 {
        match self {
            Self::Null => 0,
            Self::Boolean(_) => 1,
            Self::Integer(_) | Self::Number(_) => 2,
            Self::Text(_) => 3,
        }
    }
}

impl Ord for Attribute {
    fn cmp(&self, other: &Self) -> Ordering {
        match (self, other) {
            (Self::Boolean(a), Self::Boolean(b)) => a.cmp(b),
            (Self::Integer(a), Self::Integer(b)) => a.cmp(b),
            (Self::Integer(a), Self::Number(b)) => whole_against(*a, *b),
            (Self::Number(a), Self::Integer(b)) => whole_against(*b, *a).reverse(),
            // Adding 0 makes both zeros one.
            (Self::Number(a), Self::Number(b)) => (a + 0.0).total_cmp(&(b + 0.0)),
            (Self::Text(a), Self::Text(b)) => a.cmp(b),
            (a, b) => a.rank().cmp(&b.rank()),
        }
    }
}

/// A whole number against another number, without rounding either.
fn whole_against(whole: i64, number: f64) -> Ordering {
    let floor = number.floor();
    let fraction = if number > floor { Ordering::Less } else { Ordering::Equal };
    // The conversion saturates: what is beyond 128 bits is beyond 64 too.
    i128::from(whole).cmp(&(floor as i128)).then(fraction)
}

impl PartialOrd for Attribute {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Attribute {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Attribute {}

/// As a scene file writes it; texts in quotes.
impl fmt::Display for Attribute {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Null => f.write_str("no value"),
            Self::Boolean(flag) => write!(f, "{flag}"),
            Self::Integer(number) => write!(f, "{number}"),
            Self::Number(number) => write!(f, "{number}"),
            Self::Text(text) => write!(f, "{text:?}"),
        }
    }
}

/// A column of attributes.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its name, as the source spells it.
    pub name: String,
    /// The value of each feature of the source by its number ([`super::Feature::index`]), those that are not drawn
    /// counted; where it ends, features have no value. The members of a geometry collection share their feature's.
    pub values: Vec<Attribute>,
}

impl Column {
    /// The value of the feature with this number.
    pub fn value(&self, index: usize) -> &Attribute {
        self.values.get(index).unwrap_or(&Attribute::Null)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn values_are_ordered_by_kind_then_size() {
        let text = |text: &str| Attribute::Text(text.into());
        let ascending = [
            Attribute::Null,
            Attribute::Boolean(false),
            Attribute::Boolean(true),
            Attribute::Number(f64::NEG_INFINITY),
            Attribute::Integer(i64::MIN),
            Attribute::Integer(-1),
            Attribute::Number(-0.5),
            Attribute::Integer(0),
            Attribute::Number(1.5),
            Attribute::Number(9_007_199_254_740_992.0),
            Attribute::Integer(9_007_199_254_740_993),
            Attribute::Integer(i64::MAX),
            Attribute::Number(9.3e18),
            Attribute::Number(f64::INFINITY),
            text(""),
            text("2"),
            text("a"),
        ];
        for (i, a) in ascending.iter().enumerate() {
            for (j, b) in ascending.iter().enumerate() {
                assert_eq!(a.cmp(b), i.cmp(&j), "{a} against {b}");
            }
        }
    }

    #[test]
    fn a_number_is_equal_however_it_is_written() {
        assert_eq!(Attribute::Integer(2), Attribute::Number(2.0));
        assert_eq!(Attribute::Number(0.0), Attribute::Number(-0.0));
        assert_ne!(Attribute::Integer(2), Attribute::Text("2".into()));
        assert!(Attribute::of_number(f64::NAN).is_null());
    }

    /// Values of all kinds; half of them where doubles are coarser than whole numbers.
    fn value() -> impl Strategy<Value = Attribute> {
        let large = || (i64::MAX - 3)..=i64::MAX;
        prop_oneof![
            1 => Just(Attribute::Null),
            1 => any::<bool>().prop_map(Attribute::Boolean),
            1 => (-3..3_i64).prop_map(Attribute::Integer),
            1 => (-6..6_i64).prop_map(|whole| Attribute::Number(whole as f64 / 2.0)),
            1 => any::<f64>().prop_map(Attribute::of_number),
            1 => ".{0,2}".prop_map(Attribute::Text),
            3 => large().prop_map(Attribute::Integer),
            3 => large().prop_map(|whole| Attribute::Number(whole as f64)),
        ]
    }

    proptest! {
        #[test]
        fn the_order_of_any_three_values_is_one(a in value(), b in value(), c in value()) {
            prop_assert_eq!(a.cmp(&b), b.cmp(&a).reverse());
            if a <= b && b <= c {
                prop_assert!(a <= c);
            }
        }
    }
}
