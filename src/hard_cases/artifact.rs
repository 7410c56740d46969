//! What is known not to give the answer, with the place of the paper that says so.

use crate::technique::Kind;

/// A technique's known artifact in a case.
#[derive(Debug, Clone, Copy)]
pub(super) struct Artifact {
    /// Whose.
    pub(super) kind: Kind,
    /// Whether exact mathematics does not have it.
    pub(super) is_of_machines: bool,
    /// What it is, and where the paper says so.
    pub(super) says: &'static str,
}

/// Other settings of a technique.
#[derive(Debug, Clone, Copy)]
pub(super) struct Variant {
    /// Whose.
    pub(super) kind: Kind,
    /// The settings.
    pub(super) keys: &'static [&'static str],
    /// What they are known for, where they do not give the answer.
    pub(super) says: Option<&'static str>,
}

impl Artifact {
    /// One that exact mathematics has, too.
    pub(super) const fn of(kind: Kind, says: &'static str) -> Self {
        Self { kind, is_of_machines: false, says }
    }

    /// One of imitated machines.
    pub(super) const fn of_machines(kind: Kind, says: &'static str) -> Self {
        Self { kind, is_of_machines: true, says }
    }
}

impl Variant {
    /// Settings that should give the answer.
    pub(super) const fn right(kind: Kind, keys: &'static [&'static str]) -> Self {
        Self { kind, keys, says: None }
    }

    /// Settings that are known not to give it.
    pub(super) const fn known(kind: Kind, keys: &'static [&'static str], says: &'static str) -> Self {
        Self { kind, keys, says: Some(says) }
    }
}
