//! `drapery calibrate export|read`

use super::print::{print, say};
use super::stop::{Outcome, Status};
use drapery::calibrate;
use drapery::output::Batch;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  drapery calibrate export -o calibration           what to draw, with a README
  drapery calibrate read pictures > device.toml
  drapery export scene.toml -t clipmap --device device.toml
  drapery render scene.toml --device swiftshader

A few small pictures tell how a graphics processor rounds: sub-pixel bits, sample positions, who owns an edge, the depth format, bits of \
filter weights, and whether it interpolates from snapped corners. `read` prints a table [device], with what was seen as comments; of a \
picture that is missing the keys are left out. Pictures that contradict one another are refused (2).";

#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub(super) struct Arguments {
    #[command(subcommand)]
    action: Action,
}

#[derive(Debug, clap::Subcommand)]
enum Action {
    /// Write what is to be drawn.
    Export {
        /// Where the files go; made where it is missing.
        #[arg(short, long, value_name = "DIR", default_value = "calibration")]
        output: PathBuf,
    },
    /// Read what has been drawn, and print the device's table.
    Read {
        /// The folder of the pictures.
        folder: PathBuf,
    },
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    match &arguments.action {
        Action::Export { output } => {
            calibrate::write_instructions(Batch::into(output)?)?;
            say(&format!("what to draw: {}", output.join("README.md").display()));
            Ok(Status::Passed)
        }
        Action::Read { folder } => print(&calibrate::read(folder)?),
    }
}
