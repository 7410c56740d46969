//! `drapery schema`

use super::stop::Outcome;

pub(super) fn run() -> Outcome {
    super::print(&format!("{:#}\n", drapery::scene_file::schema()))
}
