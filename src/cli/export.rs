//! `drapery export [SCENE_FILE]`, `drapery export --conformance`

use super::bar::Bar;
use super::device_argument::DeviceArgument;
use super::render::techniques::Name;
use super::scene_input;
use super::stop::{Outcome, Status};
use super::truth_arguments::TruthArguments;
use drapery::export::{Bundle, Conformance};
use drapery::measure::Watch;
use drapery::output::Batch;
use drapery::reduce::{Draft, SCENE_FILE};
use drapery::scene_file::Override;
use drapery::scene_file::SceneText;
use drapery::source::load;
use drapery::technique::Kind;
use drapery::truth::Budget;
use drapery::{Error, Result, parallel};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  drapery export scene.toml -t clipmap -o bundle
  drapery export scene.toml -t stencil-volume --set image.width=800 -o bundle
  drapery export scene.toml -t clipmap --device lavapipe -o bundle
  drapery export scene.toml -t static-decal --alternatives -o bundle
  drapery export --conformance -t stencil-volume -o set
  drapery compare bundle mine.png

Writes the mesh and vertex sequences as .npy, features as GeoJSON, matrices and parameters as JSON, the technique's picture with all its
buffers, a clipmap's tiles as z/x/y, and the truth with what each pixel may be. DIR/README.md tells what is where, and how the technique goes.

--conformance writes small scenes that expose what clients get wrong (missing caps, joins, draw order, coordinates in single
precision, ...), each as DIR/CASE/TECHNIQUE/, and DIR/conformance.json.";

#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub(super) struct Arguments {
    /// The scene file, `-` for stdin; without it, a built-in generated scene.
    scene: Option<PathBuf>,
    /// What the client draws by.
    #[arg(short, long, value_name = "T", required_unless_present = "conformance")]
    technique: Option<Name>,
    /// Write the conformance set: of the technique, or of all.
    #[arg(long, conflicts_with = "scene")]
    conformance: bool,
    /// Write what the picture would be by other choices, too (joins, sides, samples, filters, diagonals, blending): where a frame fails,
    /// `compare` tells by which it would not.
    #[arg(long)]
    alternatives: bool,
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
    device: DeviceArgument,
    #[command(flatten)]
    truth: TruthArguments,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let budget = arguments.truth.budget()?;
    if arguments.technique == Some(Name::Truth) {
        let refusal = Error::usage("a client cannot draw by `truth`: it is in every bundle, to judge by");
        return Err(refusal.help("name a technique, such as -t clipmap").into());
    }
    let technique = arguments.technique.and_then(Name::kind);
    match technique {
        Some(technique) if !arguments.conformance => bundle(arguments, technique, budget),
        _ => conformance(arguments, technique, budget),
    }
}

/// Writes the conformance set.
fn conformance(arguments: &Arguments, technique: Option<Kind>, budget: Budget) -> Outcome {
    let overrides = arguments.device.before(&arguments.overrides)?;
    let changes = overrides.iter().map(|text| Override::parse(text));
    let changes = changes.collect::<Result<Vec<Override>>>()?;
    let (batch, bar) = (Batch::into(&arguments.output)?, Bar::new());
    let alternatives = arguments.alternatives;
    let set = Conformance { technique, changes: &changes, budget, alternatives };
    let count = parallel::with_threads(arguments.threads, || set.write(batch, &bar))??;
    bar.say(&format!(
        "{count} bundles; what they expose: {}",
        arguments.output.join("conformance.json").display()
    ));
    Ok(Status::Passed)
}

/// Writes a scene's bundle.
fn bundle(arguments: &Arguments, technique: Kind, budget: Budget) -> Outcome {
    let text =
        scene_input::read(arguments.scene.as_deref(), &arguments.device.before(&arguments.overrides)?)?;
    let mut batch = Batch::into(&arguments.output)?;
    let bar = Bar::new();
    let export = || {
        let scene = scene_input::open(&text, &bar)?;
        let attributes = load::attributes(&text.file, &|told| bar.note(told));
        let hash = &text.file.hash;
        let stage = &scene.stage;
        if stage.draw_list.vertices().len() <= MOST_IN_A_SCENE_FILE {
            stage_scene_file(&text, &mut batch, &bar)?;
        } else {
            bar.note(&format!("the bundle has no {SCENE_FILE}: more than {MOST_IN_A_SCENE_FILE} vertices"));
        }
        let alternatives = arguments.alternatives;
        Bundle { stage, hash, attributes: &attributes, technique, budget, alternatives }.write(batch, &bar)
    };
    let done = parallel::with_threads(arguments.threads, export)?;
    done.map_err(|error| scene_input::blame(&text, error))?;
    bar.say(&format!("what is where: {}", arguments.output.join("README.md").display()));
    Ok(Status::Passed)
}

/// A scene of more vertices is not written into a bundle: a text of many megabytes is no small scene to start from.
const MOST_IN_A_SCENE_FILE: usize = 200_000;

/// Writes the scene file with all features in it, for `drapery reduce`; where there can be none, that is noted.
fn stage_scene_file(text: &SceneText, batch: &mut Batch, bar: &Bar) -> Result<()> {
    // Loaded once more: of a stage the layers have no features any more.
    let (scene, _) = load::load(&text.file, &|_| {})?;
    match Draft::of(text, &scene) {
        Ok(draft) => batch.stage(SCENE_FILE, |to| to.write_all(draft.text().as_bytes())),
        Err(error) => {
            bar.note(&format!("the bundle has no {SCENE_FILE}: {}", error.what()));
            Ok(())
        }
    }
}
