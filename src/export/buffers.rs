//! Which buffers are wanted beside a picture.

use crate::buffer::PlaneKind;
use crate::error::{Error, Result};
use crate::technique::Kind;
use crate::truth::Truth;

/// Every buffer that a technique has.
const ALL: &str = "all";

/// The buffers to make.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Buffers {
    /// All that a technique has.
    All,
    /// Those of these names that a technique has.
    Named(Vec<String>),
}

impl Buffers {
    /// The buffers of these names; `all` is every one.
    ///
    /// # Errors
    /// When neither the truth (if its picture is asked for) nor a technique has one of them: known before anything is drawn.
    pub fn named(asked: &[String], truth: bool, kinds: &[Kind]) -> Result<Self> {
        let of_truth = Truth::PLANES.iter().chain(&PlaneKind::PICKS).filter(|_| truth);
        let planes = of_truth.chain(kinds.iter().flat_map(|kind| kind.declaration().planes));
        let mut offered: Vec<&str> = Vec::new();
        planes.for_each(|plane| {
            if !offered.contains(&plane.name) {
                offered.push(plane.name)
            }
        });
        let unknown = asked.iter().find(|name| *name != ALL && !offered.contains(&name.as_str()));
        if let Some(name) = unknown {
            return Err(Error::usage(format!("there is no buffer `{name}`"))
                .help(format!("buffers here: {}, or {ALL}", offered.join(", "))));
        }
        Ok(if asked.iter().any(|name| name == ALL) { Self::All } else { Self::Named(asked.to_vec()) })
    }

    /// These and the buffers that say which items touch pixels.
    #[must_use]
    pub(super) fn with_picks(&self) -> Self {
        match self {
            Self::All => Self::All,
            Self::Named(names) => {
                let picks = PlaneKind::PICKS.iter().map(|kind| kind.name.to_owned());
                Self::Named(names.iter().cloned().chain(picks).collect())
            }
        }
    }

    /// Whether one of the buffers that say which items touch pixels is asked for.
    pub(super) fn wants_picks(&self) -> bool {
        PlaneKind::PICKS.iter().any(|kind| self.wants(kind.name))
    }

    /// Whether one of this name is asked for.
    pub fn wants(&self, name: &str) -> bool {
        match self {
            Self::All => true,
            Self::Named(names) => names.iter().any(|wanted| wanted == name),
        }
    }
}
