//! `drapery render [SCENE]`

pub(super) mod draw;
pub(super) mod techniques;

use super::bar::Bar;
use super::measure::{Certified, TruthArguments, scene_result};
use super::scene_input::SceneInput;
use super::stop::{Outcome, Status};
use drapery::output::{Batch, RESULT_SCHEMA, RenderResult, RunResult};
use drapery::truth::Budget;
use drapery::{Result, parallel};
use draw::{Drawing, Wish};
use std::path::PathBuf;
use techniques::Asked;

const EXAMPLES: &str = "\
Examples:
  drapery render                                        the built-in scene, every technique
  drapery render scene.toml -t truth -o pictures        only the right picture
  drapery render scene.toml -t inverse-projection --set technique.inverse-projection.samples=5
  drapery render scene.toml --set layer.roads.line.width_m=20 --set 'camera.eye=[0,-5000,3000]'
  drapery render scene.toml -t truth --buffers depth,lo,hi
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
    /// Change the scene: a dotted path and a TOML value; may be repeated. No value removes the key.
    #[arg(long = "set", value_name = "PATH=VALUE")]
    overrides: Vec<String>,
    /// Where the pictures and result.json go; made where it is missing.
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    output: PathBuf,
    /// Intermediate buffers to write beside the picture: names such as depth,lo, or all.
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    buffers: Vec<String>,
    /// How many threads; 0: as many as the machine has. The pictures are the same.
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
    /// Time so many runs and tell the median.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    repeat: u32,
    #[command(flatten)]
    truth: TruthArguments,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let asked = techniques::asked(&arguments.techniques)?;
    let budget = arguments.truth.budget()?;
    let scene = SceneInput::read(arguments.scene.as_deref(), &arguments.overrides)?;
    let batch = Batch::into(&arguments.output)?;
    let bar = Bar::new();
    let runs = parallel::with_threads(arguments.threads, || {
        render(arguments, (&asked, &budget), &scene, batch, &bar)
    })?;
    for run in runs.map_err(|error| scene.blame(error))? {
        bar.say(&told(arguments, &run));
    }
    Ok(Status::Passed)
}

/// Renders a scene; the files are in their places when it returns.
fn render(
    arguments: &Arguments,
    (asked, budget): (&Asked, &Budget),
    input: &SceneInput,
    mut batch: Batch,
    bar: &Bar,
) -> Result<Vec<RunResult>> {
    let stage = input.stage(bar)?;
    let view = stage.view()?;
    let kinds = techniques::applying(asked, &stage, bar)?;
    let wish = Wish {
        buffers: techniques::buffers(&arguments.buffers, asked.truth, &kinds)?,
        repeat: arguments.repeat,
    };
    let certified = Certified::of((&stage, &view), budget, if asked.truth { wish.repeat } else { 1 }, bar)?;

    let mut drawing = Drawing { stage: &stage, view: &view, certified: &certified, batch: &mut batch, bar };
    let truth = if asked.truth { Some(drawing.truth(&wish)) } else { None };
    let techniques = kinds.iter().map(|kind| Ok(drawing.run(*kind, &wish)?.0));
    let runs: Result<Vec<RunResult>> = truth.into_iter().chain(techniques).collect();

    let result = RenderResult {
        schema: RESULT_SCHEMA,
        scene: scene_result(&stage, &input.file),
        notes: stage.scene.notes.clone(),
        runs: runs?,
    };
    let text = result.to_json()?;
    batch.stage("result.json", |to| to.write_all(text.as_bytes()))?;
    batch.commit()?;
    Ok(result.runs)
}

/// A run in a line, for people.
fn told(arguments: &Arguments, run: &RunResult) -> String {
    format!(
        "{}  {}  prepare {:.0} ms  frame {:.0} ms  error max {:.4} mean {:.6}",
        run.technique,
        arguments.output.join(&run.image.path).display(),
        run.prepare_ms,
        run.frame_ms,
        run.error.max.unwrap_or_default(),
        run.error.mean.unwrap_or_default(),
    )
}
