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
        paper: Paper::SchneiderKlein,
        number: "Fig. 4",
        what: "the steps of rendering",
        why: "a flow chart: there is nothing in it to draw anew",
    },
    Unmade {
        paper: Paper::Wartell,
        number: "Table 1",
        what: "frame rates with and without lines",
        why: "times are measured by `drapery report --tables=wartell`",
    },
    Unmade {
        paper: Paper::Taibo,
        number: "Figs. 11, 12",
        what: "times of generation and rendering",
        why: "times are measured by `drapery report --tables=taibo`",
    },
    Unmade {
        paper: Paper::She,
        number: "Fig. 11",
        what: "how work is shared between processor and graphics processor",
        why: "a flow chart: there is nothing in it to draw anew",
    },
    Unmade {
        paper: Paper::She,
        number: "Fig. 14, Tables 2 to 6",
        what: "frame rates",
        why: "times are measured by `drapery report --tables=she`; Table 6 tells the data of a map, she-15 is on generated land",
    },
    Unmade {
        paper: Paper::Zechmeister,
        number: "Figs. 1.1, 2.1 to 2.3, 2.6, 2.13, 5.1 to 5.4",
        what: "photographs, other authors' pictures, the case studies' maps",
        why: "pictures of data or techniques that this program does not have",
    },
    Unmade {
        paper: Paper::Zechmeister,
        number: "Figs. 2.8, 2.10",
        what: "a line's polyhedron; inverse projection",
        why: "schneider-klein-3 and she-5 show the same",
    },
    Unmade {
        paper: Paper::Zechmeister,
        number: "Figs. 3.1, 3.8, 4.1 to 4.3, 4.5, 4.6",
        what: "steps and data of the program",
        why: "flow charts and tables of types: a bundle's README (`drapery export`) tells the same of each buffer",
    },
    Unmade {
        paper: Paper::Zechmeister,
        number: "Fig. 3.5",
        what: "segments divided and put on the terrain",
        why: "the vertices of dynamic lines are no buffer; zechmeister-2.5 shows a line on the mesh",
    },
    Unmade {
        paper: Paper::Zechmeister,
        number: "Figs. 5.5 to 5.10, 5.12 to 5.17",
        what: "memory, update and render time",
        why: "measured by `drapery report --tables=zechmeister`",
    },
    Unmade {
        paper: Paper::Ours,
        number: "",
        what: "speed against error, hard cases, stability",
        why: "`drapery report` and `drapery hard-cases` have pages of their own",
    },
];
