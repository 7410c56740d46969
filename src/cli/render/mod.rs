//! `drapery render [SCENE]`

mod pick;
pub(super) mod techniques;

use super::bar::Bar;
use super::device_argument::DeviceArgument;
use super::pixel::pixel;
use super::print::print;
use super::scene_input;
use super::stop::{Outcome, Status};
use super::truth_arguments::TruthArguments;
use drapery::buffer::PlaneKind;
use drapery::export::{Buffers, Pictures};
use drapery::measure::Watch;
use drapery::output::{Batch, ErrorResult, RenderResult, RunResult};
use drapery::scene_file::SceneText;
use drapery::source::load;
use drapery::truth::Budget;
use drapery::{Result, parallel};
use std::path::PathBuf;
use techniques::Asked;

const EXAMPLES: &str = "\
Examples:
  drapery render                                        the built-in scene, every technique
  drapery render scene.toml -t truth -o pictures        only the right picture
  drapery render scene.toml -t clipmap                  this picture alone, without the truth: soon there
  drapery render scene.toml -t clipmap --errors         and how far it is from the truth
  drapery render scene.toml -t inverse-projection --set technique.inverse-projection.samples=5
  drapery render scene.toml --set layer.roads.line.width_m=20 --set 'camera.eye=[0,-5000,3000]'
  drapery render scene.toml -t truth --buffers depth,lo,hi
  drapery render scene.toml --pick 310,205              which features there are at a pixel
  drapery new dem.tif roads.shp | drapery render -

Writes DIR/T.png for each technique T, DIR/result.json, and DIR/T.NAME.npy and DIR/T.NAME.png for each buffer: all of
them, or none when something fails.";

#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub(super) struct Arguments {
    /// The scene file, `-` for stdin; without it, a built-in generated scene.
    scene: Option<PathBuf>,
    /// How to render; may be repeated. Default: the truth and every technique that applies.
    #[arg(short, long = "technique", value_name = "T")]
    techniques: Vec<techniques::Name>,
    /// Tell how far pictures are from the truth, which takes its time. Told in any case where `-t` is left out or names the truth.
    #[arg(long)]
    errors: bool,
    /// Change the scene: a dotted path and a TOML value; may be repeated. No value removes the key.
    #[arg(long = "set", value_name = "PATH=VALUE")]
    overrides: Vec<String>,
    /// Where the pictures and result.json go; made where it is missing.
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    output: PathBuf,
    /// Intermediate buffers to write beside the picture: names such as depth,lo, or all.
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    buffers: Vec<String>,
    /// Tell which features there are at a pixel (column, row, from 0 at the upper left), by the truth and each technique; also in result.json.
    #[arg(long, value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true)]
    pick: Option<[usize; 2]>,
    /// How many threads; 0: as many as the machine has. The pictures are the same.
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
    /// Time so many runs and tell the median.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    repeat: u32,
    #[command(flatten)]
    device: DeviceArgument,
    #[command(flatten)]
    truth: TruthArguments,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let asked = techniques::asked(&arguments.techniques);
    let budget = arguments.truth.budget()?;
    let changes = arguments.device.before(&arguments.overrides)?;
    let scene = scene_input::read(arguments.scene.as_deref(), &changes)?;
    let batch = Batch::into(&arguments.output)?;
    let bar = Bar::new();
    if !asked.truth && !arguments.errors && budget != Budget::default() {
        bar.note(
            "the truth is not computed, so how exact it is to be means nothing: say --errors, or -t truth",
        );
    }
    let result = parallel::with_threads(arguments.threads, || {
        render(arguments, (&asked, &budget), &scene, batch, &bar)
    })?;
    let result = result.map_err(|error| scene_input::blame(&scene, error))?;
    if let Some(error) = result.scene.surface_error.filter(|error| error.left_out > 0) {
        bar.note(&format!(
            "{} triangles in view are left out of the terrain: posts in them are missing, and the level of detail does not let them be split",
            error.left_out
        ));
    }
    for run in &result.runs {
        bar.say(&told(arguments, run));
    }
    if let Some(pick) = &result.pick {
        print(&pick::text(pick, result.items.as_deref().unwrap_or_default()))?;
    }
    Ok(Status::Passed)
}

/// Renders a scene; the files are in their places when it returns.
fn render(
    arguments: &Arguments,
    (asked, budget): (&Asked, &Budget),
    text: &SceneText,
    batch: Batch,
    bar: &Bar,
) -> Result<RenderResult> {
    let scene = scene_input::open(text, bar)?;
    let stage = &scene.stage;
    let kinds = techniques::applying(asked, stage, bar)?;
    let buffers = Buffers::named(&arguments.buffers, asked.truth, &kinds)?;
    let names_items =
        arguments.pick.is_some() || PlaneKind::PICKS.iter().any(|kind| buffers.wants(kind.name));
    let attributes =
        if names_items { load::attributes(&text.file, &|told| bar.note(told)) } else { Vec::new() };
    let pictures = Pictures {
        stage,
        hash: &text.file.hash,
        truth: asked.truth,
        errors: arguments.errors,
        techniques: &kinds,
        buffers: &buffers,
        pick: arguments.pick,
        attributes: &attributes,
        budget,
        repeat: arguments.repeat,
    };
    pictures.write(batch, bar)
}

/// A run in a line, for people.
fn told(arguments: &Arguments, run: &RunResult) -> String {
    let told = |error: &ErrorResult| format!("  error max {:.4} mean {:.6}", error.max, error.mean);
    format!(
        "{}  {}  prepare {:.0} ms  frame {:.0} ms{}",
        run.technique,
        arguments.output.join(&run.image.path).display(),
        run.prepare_ms,
        run.frame_ms,
        run.error.as_ref().map(told).unwrap_or_default(),
    )
}
