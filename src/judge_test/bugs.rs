//! Bugs, as programs have had them: name, class, what goes wrong.

mod bug;
mod colour;
mod geometry;
mod lists;
mod sampling;
mod stencil;
mod visibility;

pub(super) use bug::{Bug, CLASSES, Class};

/// All of them, class by class.
pub(super) fn all() -> Vec<&'static Bug> {
    [geometry::BUGS, stencil::BUGS, visibility::BUGS, sampling::BUGS, colour::BUGS, lists::BUGS]
        .into_iter()
        .flatten()
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn there_are_at_least_sixty_of_different_names() {
        let names: BTreeSet<&str> = all().iter().map(|bug| bug.name).collect();
        assert_eq!(names.len(), all().len());
        assert!(names.len() >= 60, "{}", names.len());
    }
}
