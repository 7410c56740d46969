//! In, out or open.

use std::ops::Not;

/// Whether a point lies in a set, as far as it is known: the three values of Kleene's strong logic.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Known {
    /// It does.
    In,
    /// It does not.
    Out,
    /// It may or may not.
    Open,
}

impl Known {
    /// What is known when it is known.
    pub fn of(is_in: bool) -> Self {
        if is_in { Self::In } else { Self::Out }
    }

    /// Whether it lies in both of two sets.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Out, _) | (_, Self::Out) => Self::Out,
            (Self::In, Self::In) => Self::In,
            _ => Self::Open,
        }
    }

    /// Whether it lies in one of two sets, or in both.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        match (self, other) {
            (Self::In, _) | (_, Self::In) => Self::In,
            (Self::Out, Self::Out) => Self::Out,
            _ => Self::Open,
        }
    }
}

impl Not for Known {
    type Output = Self;

    /// Whether it lies out of the set.
    fn not(self) -> Self {
        match self {
            Self::In => Self::Out,
            Self::Out => Self::In,
            Self::Open => Self::Open,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Known::{self, In, Open, Out};
    use proptest::prelude::*;

    #[test]
    fn the_tables_are_those_of_kleenes_strong_logic() {
        let all = [In, Open, Out];
        let table = |f: fn(Known, Known) -> Known| all.map(|a| all.map(|b| f(a, b)));
        assert_eq!(table(Known::and), [[In, Open, Out], [Open, Open, Out], [Out, Out, Out]]);
        assert_eq!(table(Known::or), [[In, In, In], [In, Open, Open], [In, Open, Out]]);
        assert_eq!(all.map(|a| !a), [Out, Open, In]);
        assert_eq!([true, false].map(Known::of), [In, Out]);
    }

    /// A set made of others.
    #[derive(Debug, Clone)]
    enum Set {
        Leaf(usize),
        Not(Box<Set>),
        And(Box<Set>, Box<Set>),
        Or(Box<Set>, Box<Set>),
    }

    impl Set {
        fn known(&self, leaves: &[Known]) -> Known {
            match self {
                Self::Leaf(k) => leaves[*k],
                Self::Not(a) => !a.known(leaves),
                Self::And(a, b) => a.known(leaves).and(b.known(leaves)),
                Self::Or(a, b) => a.known(leaves).or(b.known(leaves)),
            }
        }

        fn holds(&self, leaves: &[bool]) -> bool {
            match self {
                Self::Leaf(k) => leaves[*k],
                Self::Not(a) => !a.holds(leaves),
                Self::And(a, b) => a.holds(leaves) && b.holds(leaves),
                Self::Or(a, b) => a.holds(leaves) || b.holds(leaves),
            }
        }
    }

    const LEAVES: usize = 5;

    fn set() -> impl Strategy<Value = Set> {
        (0..LEAVES).prop_map(Set::Leaf).prop_recursive(5, 40, 2, |part| {
            let two = || (part.clone(), part.clone()).prop_map(|(a, b)| (Box::new(a), Box::new(b)));
            prop_oneof![
                part.clone().prop_map(|a| Set::Not(Box::new(a))),
                two().prop_map(|(a, b)| Set::And(a, b)),
                two().prop_map(|(a, b)| Set::Or(a, b)),
            ]
        })
    }

    proptest! {
        #[test]
        fn what_is_known_holds_however_the_open_answers_turn_out(
            set in set(),
            leaves in prop::collection::vec(prop::sample::select(vec![In, Out, Open]), LEAVES),
        ) {
            let known = set.known(&leaves);
            for answers in 0..1 << LEAVES {
                let holds: Vec<bool> = (0..LEAVES).map(|k| answers >> k & 1 == 1).collect();
                let is_possible = leaves.iter().zip(&holds).all(|(l, h)| *l == Open || *l == Known::of(*h));
                prop_assert!(!is_possible || known == Open || known == Known::of(set.holds(&holds)));
            }
        }
    }
}
