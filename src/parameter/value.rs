//! Values of parameters, as files have them and as code has them.

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
        assert_eq!(texts, ["\"4a-adjacency\"", "-3", "1024", "-0.25", "1e+300", "[10,20.5]"]);
    }
}
