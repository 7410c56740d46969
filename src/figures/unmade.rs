//! The papers' figures that are not made, and why.

use super::figure::Paper;

/// Figures that are not made.
#[derive(Debug)]
pub struct Unmade {
    /// Whose they are.
    pub paper: Paper,
    /// Their numbers.
    pub number: &'static str,
    /// What they show.
    pub what: &'static str,
    /// Why there is none, or which command has the same.
    pub why: &'static str,
}

/// All of them.
pub const UNMADE: &[Unmade] = &[
    Unmade {
        paper: Paper::She,
        number: "Fig. 11",
        what: "how work is shared between processor and graphics processor",
        why: "a flow chart of a program: there is nothing in it to draw anew",
    },
];
