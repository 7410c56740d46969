//! `drapery schema`

use super::print::print;
use super::stop::Outcome;

pub(super) fn run() -> Outcome {
    print(&format!("{:#}\n", drapery::scene_file::schema()))
}
