//! `drapery report SCENE...`

mod measuring;
mod notable;
mod tables;

use super::bar::Bar;
use super::measure::TruthArguments;
use super::scene_input::SceneInput;
use super::stop::{Outcome, Status};
use drapery::output::Batch;
use drapery::report::page::{Section, page};
use drapery::report::plot::{self, View};
use drapery::report::tables::DATA_SETS;
use drapery::report::{Exhibit, REPORT_SCHEMA, Report, SceneReport, table};
use drapery::truth::Budget;
use drapery::{Result, parallel};
use measuring::{Measured, Measuring};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  drapery report scene.toml                             a page about one scene, in report/
  drapery report alps.toml coast.toml -o paper          both on one page
  drapery report scene.toml --repeat 9 --threads 1      steadier times, of one thread
  drapery report scene.toml --set image.width=600 --set image.height=400
  drapery report scene.toml --truth-width 0.01          a coarser truth, sooner there
  drapery report --tables --repeat 1                    Taibo's tables on 1.2 to 11 million segments, minutes
  drapery report --tables roads.toml -o tables          the same for your own lines

Measured are the truth, every technique that applies over the settings of its sweep (the scene's own among them), and plain
supersampling with 1, 4, 16, ... samples a pixel. Each row tells what differs from the scene: `drapery render --set` draws
it again.

Writes DIR/report.html (one file, readable without a network), DIR/report.csv, DIR/report.json and the plots as
DIR/NAME-METRIC.svg: all of them, or none when something fails. All numbers but the times are the same in every run.

A whole sweep takes minutes: the truth and each setting are computed --repeat times.

With --tables, memory, generation and rendering of the clipmap's solutions are measured instead (Taibo et al. 2014, section 5),
without a SCENE on generated data sets of the paper's three kinds; it writes tables.html, tables.csv and tables.json.";

#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub(super) struct Arguments {
    /// The scene files, `-` for stdin; without one, a built-in generated scene.
    #[arg(value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Measure the papers' own tables instead of speed against error.
    #[arg(long)]
    tables: bool,
    /// Change every scene: a dotted path and a TOML value; may be repeated. No value removes the key.
    #[arg(long = "set", value_name = "PATH=VALUE")]
    overrides: Vec<String>,
    /// Where the report goes; made where it is missing.
    #[arg(short, long, value_name = "DIR", default_value = "report")]
    output: PathBuf,
    /// Time each run so often; told are the median, the shortest and the longest.
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..))]
    repeat: u32,
    /// How many threads; 0: as many as the machine has. The pictures are the same, the times are not.
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
    #[command(flatten)]
    truth: TruthArguments,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    if arguments.tables {
        return run_tables(arguments);
    }
    let budget = arguments.truth.budget()?;
    let paths: Vec<Option<&PathBuf>> = match arguments.scenes.is_empty() {
        true => vec![None],
        false => arguments.scenes.iter().map(Some).collect(),
    };
    let read = |path: &Option<&PathBuf>| SceneInput::read(path.map(PathBuf::as_path), &arguments.overrides);
    let inputs: std::result::Result<Vec<SceneInput>, _> = paths.iter().map(read).collect();
    let inputs = inputs?;
    let batch = Batch::into(&arguments.output)?;
    let bar = Bar::new();
    let mut measured = Vec::new();
    for input in &inputs {
        let scene =
            parallel::with_threads(arguments.threads, || measure(input, &budget, arguments.repeat, &bar))?;
        measured.push(scene.map_err(|error| input.blame(error))?);
    }
    let (reports, exhibits) = measured.into_iter().map(|m| (m.report, m.exhibits)).unzip();
    let report = Report { schema: REPORT_SCHEMA, repeat: arguments.repeat, scenes: reports };
    write(&report, exhibits, batch)?;
    for scene in &report.scenes {
        bar.say(&told(scene));
    }
    bar.say(&format!("{}", arguments.output.join(PAGE).display()));
    Ok(Status::Passed)
}

/// Measures the papers' own tables.
fn run_tables(arguments: &Arguments) -> Outcome {
    let read = |path: &PathBuf| SceneInput::read(Some(path), &arguments.overrides);
    let built_in = |text: &&str| SceneInput::built_in(text, &arguments.overrides);
    let inputs: std::result::Result<Vec<SceneInput>, _> = match arguments.scenes.is_empty() {
        true => DATA_SETS.iter().map(built_in).collect(),
        false => arguments.scenes.iter().map(read).collect(),
    };
    let inputs = inputs?;
    let batch = Batch::into(&arguments.output)?;
    let bar = Bar::new();
    let measured =
        parallel::with_threads(arguments.threads, || tables::measure(&inputs, arguments.repeat, &bar))?;
    let measured = measured?;
    tables::write(&measured, batch)?;
    for set in &measured.data_sets {
        bar.say(&tables::told(set));
    }
    bar.say(&format!("{}", arguments.output.join("tables.html").display()));
    Ok(Status::Passed)
}

const PAGE: &str = "report.html";

/// Measures all of a scene.
fn measure(input: &SceneInput, budget: &Budget, repeat: u32, bar: &Bar) -> Result<Measured> {
    let mut measuring = Measuring::new(input, budget, repeat, bar)?;
    measuring.truth()?;
    measuring.techniques()?;
    measuring.supersampling()?;
    Ok(measuring.finish())
}

/// Writes all files; they are in their places when it returns.
fn write(report: &Report, exhibits: Vec<Vec<Exhibit>>, mut batch: Batch) -> Result<()> {
    let names = file_names(report);
    for (scene, plots) in report.scenes.iter().zip(&names) {
        for (view, name) in View::all().zip(plots) {
            batch.stage(name, |to| to.write_all(plot::svg(scene, view).as_bytes()))?;
        }
    }
    let parts = report.scenes.iter().zip(&exhibits).zip(&names);
    let sections: Vec<Section> =
        parts.map(|((scene, exhibits), plots)| Section { scene, exhibits, plots }).collect();
    let page = page(report, &sections)?;
    batch.stage(PAGE, |to| to.write_all(page.as_bytes()))?;
    batch.stage("report.csv", |to| to.write_all(table::csv(report).as_bytes()))?;
    let json = report.to_json()?;
    batch.stage("report.json", |to| to.write_all(json.as_bytes()))?;
    batch.commit()
}

/// The names of each scene's plots: the scene's name, with a number where another scene has the same.
fn file_names(report: &Report) -> Vec<Vec<String>> {
    let mut stems: Vec<String> = Vec::new();
    for scene in &report.scenes {
        let plain = |c: char| if c.is_alphanumeric() || c == '-' || c == '_' { c } else { '-' };
        let stem: String = scene.scene.name.chars().map(plain).collect();
        let again = |k: usize| if k == 1 { stem.clone() } else { format!("{stem}-{k}") };
        let free = (1..).map(again).find(|name| !stems.contains(name));
        stems.push(free.unwrap_or(stem));
    }
    let plots = |stem: &String| View::all().map(|view| format!("{stem}-{}.svg", view.name())).collect();
    stems.iter().map(plots).collect()
}

/// A scene's front in some lines, for people.
fn told(scene: &SceneReport) -> String {
    let mut front: Vec<_> = scene.runs.iter().filter(|run| run.on_front).collect();
    front.sort_by(|a, b| a.frame_ms.median.total_cmp(&b.frame_ms.median));
    let mut text =
        format!("{}: {} runs; none is faster and more right than", scene.scene.name, scene.runs.len());
    for run in front {
        text.push_str(&format!(
            "\n  {:>9.1} ms  rmse {:.6}  {}",
            run.frame_ms.median,
            run.error.rmse,
            run.label()
        ));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use drapery::output::SceneResult;

    fn named(name: &str) -> SceneReport {
        let (hash, plan_space) = (String::new(), String::new());
        SceneReport {
            scene: SceneResult { name: name.into(), hash, plan_space, origin: [0.0; 2], origin_height: 0.0 },
            width: 1,
            height: 1,
            notes: Vec::new(),
            reference_width_max: 0.0,
            runs: Vec::new(),
        }
    }

    #[test]
    fn plots_of_scenes_of_one_name_have_names_of_their_own_and_stay_in_the_folder() {
        let scenes = ["valley", "../up", "valley", "valley-2", "valley"].map(named).to_vec();
        let report = Report { schema: REPORT_SCHEMA, repeat: 1, scenes };
        let first: Vec<String> = file_names(&report).into_iter().map(|names| names[0].clone()).collect();
        let expected = [
            "valley-rmse.svg",
            "---up-rmse.svg",
            "valley-2-rmse.svg",
            "valley-2-2-rmse.svg",
            "valley-3-rmse.svg",
        ];
        assert_eq!(first, expected);
    }
}
