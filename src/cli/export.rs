//! `drapery export [SCENE]`

use super::bar::Bar;
use super::render::techniques::{self, Name};
use super::scene_input;
use super::stop::{Outcome, Status};
use super::truth_arguments::TruthArguments;
use drapery::export::Bundle;
use drapery::measure::Watch;
use drapery::output::Batch;
use drapery::source::load;
use drapery::{Error, parallel};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  drapery export scene.toml -t clipmap -o bundle
  drapery export scene.toml -t stencil-volume --set image.width=800 -o bundle
  drapery compare bundle mine.png

Writes the mesh and vertex sequences as .npy, features as GeoJSON, matrices and parameters as JSON, the technique's picture with all its
buffers, a clipmap's tiles as z/x/y, and the truth with what each pixel may be. DIR/README.md tells what is where.";

#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub(super) struct Arguments {
    /// The scene file, `-` for stdin; without it, a built-in generated scene.
    scene: Option<PathBuf>,
    /// What the client draws by.
    #[arg(short, long, value_name = "T")]
    technique: Name,
    /// Change the scene: a dotted path and a TOML value; may be repeated. No value removes the key.
    #[arg(long = "set", value_name = "PATH=VALUE")]
    overrides: Vec<String>,
    /// Where the files go; made where it is missing.
    #[arg(short, long, value_name = "DIR", default_value = "bundle")]
    output: PathBuf,
    /// How many threads; 0: as many as the machine has. The files are the same.
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
    #[command(flatten)]
    truth: TruthArguments,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let budget = arguments.truth.budget()?;
    if arguments.technique == Name::Truth {
        let refusal = Error::usage("a client cannot draw by `truth`: it is in every bundle, to judge by");
        return Err(refusal.help("name a technique, such as -t clipmap").into());
    }
    let technique = techniques::built(arguments.technique)?;
    let text = scene_input::read(arguments.scene.as_deref(), &arguments.overrides)?;
    let batch = Batch::into(&arguments.output)?;
    let bar = Bar::new();
    let export = || {
        let scene = scene_input::open(&text, &bar)?;
        let attributes = load::attributes(&text.file, &|told| bar.note(told));
        let hash = &text.file.hash;
        let stage = &scene.stage;
        Bundle { stage, hash, attributes: &attributes, technique, budget }.write(batch, &bar)
    };
    let done = parallel::with_threads(arguments.threads, export)?;
    done.map_err(|error| scene_input::blame(&text, error))?;
    bar.say(&format!("what is where: {}", arguments.output.join("README.md").display()));
    Ok(Status::Passed)
}
