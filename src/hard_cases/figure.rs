//! A number that a case finds, and what it should be.

use serde::Serialize;

/// What a figure should be.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Bound {
    /// Anything: it is told.
    Told,
    /// No more than this.
    AtMost(f64),
    /// No less than this: a bug that has to be seen.
    AtLeast(f64),
}

/// A number that a case finds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Figure {
    /// What it is, with its unit.
    pub name: &'static str,
    /// The number.
    pub value: f64,
    /// What it should be.
    pub bound: Bound,
}

impl Figure {
    /// A number that is told.
    pub(super) const fn told(name: &'static str, value: f64) -> Self {
        Self { name, value, bound: Bound::Told }
    }

    /// A number that should be no more than `most`.
    pub(super) const fn at_most(most: f64, name: &'static str, value: f64) -> Self {
        Self { name, value, bound: Bound::AtMost(most) }
    }

    /// A number that should be no less than `least`.
    pub(super) const fn at_least(least: f64, name: &'static str, value: f64) -> Self {
        Self { name, value, bound: Bound::AtLeast(least) }
    }

    /// A count of pixels that should be 0.
    pub(super) const fn none(name: &'static str, count: usize) -> Self {
        Self::at_most(0.0, name, count as f64)
    }

    /// Whether it is as it should be.
    pub fn is_met(&self) -> bool {
        match self.bound {
            Bound::Told => true,
            Bound::AtMost(most) => self.value <= most,
            Bound::AtLeast(least) => self.value >= least,
        }
    }
}
