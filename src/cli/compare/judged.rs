//! What a call comes to, before it is told.

use drapery::buffer::Buffer;
use drapery::compare::{Case, Cases, Image};
use std::path::PathBuf;

/// A judged case.
pub(super) struct Judged {
    pub case: Case,
    pub pictures: Pictures,
}

/// The pictures of a case, where any are to be shown.
#[derive(Default)]
pub(super) struct Pictures {
    /// Where and how far the two differ; `None` where that cannot be measured.
    pub heat: Option<Buffer<[u8; 4]>>,
    /// What is expected and what was judged.
    pub both: Option<(Image, Image)>,
}

/// All that a call judged.
pub(super) struct Call {
    pub cases: Cases,
    /// Of each case.
    pub pictures: Vec<Pictures>,
    /// Files that were read, and must not be written over.
    pub inputs: Vec<PathBuf>,
}

impl Call {
    /// Of one case, or of those of a set, which has a name and its frames too.
    pub(super) fn of(judged: Vec<Judged>, set: Option<(String, String)>, inputs: Vec<PathBuf>) -> Self {
        let (cases, pictures) = judged.into_iter().map(|judged| (judged.case, judged.pictures)).unzip();
        Self { cases: Cases { set, cases }, pictures, inputs }
    }
}
