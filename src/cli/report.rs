//! `drapery report SCENE...`

use super::bar::Bar;
use super::scene_input;
use super::stop::{Outcome, Status, Stop};
use super::truth_arguments::TruthArguments;
use clap::ValueEnum;
use drapery::output::Batch;
use drapery::report::tables::{she, taibo, wartell, zechmeister};
use drapery::report::{self, SceneReport};
use drapery::scene_file::{DEFAULT_SCENE, SceneText};
use drapery::{Error, Opened, Result, parallel};
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  drapery report scene.toml                             a page about one scene, in report/
  drapery report alps.toml coast.toml -o paper          both on one page
  drapery report scene.toml --repeat 9 --threads 1      steadier times, of one thread
  drapery report scene.toml --set image.width=600 --set image.height=400
  drapery report scene.toml --truth-width 0.01          a coarser truth, sooner there
  drapery report --tables --repeat 1                    Taibo's tables on 1.2 to 11 million segments, minutes
  drapery report --tables=zechmeister --repeat 1        Zechmeister's on studies like the thesis's, minutes
  drapery report --tables=wartell                       Wartell's on borders like the paper's, a minute
  drapery report --tables=she                           She's on roads like the paper's, a minute
  drapery report --tables roads.toml -o tables          Taibo's for your own lines

Measured are the truth, every technique that applies over the settings of its sweep (the scene's own among them), and plain
supersampling with 1, 4, 16, ... samples a pixel. Each row tells what differs from the scene: `drapery render --set` draws
it again.

Writes DIR/report.html (one file, readable without a network), DIR/report.csv, DIR/report.json and the plots as
DIR/NAME-METRIC.svg: all of them, or none when something fails. All numbers but the times are the same in every run.

A whole sweep takes minutes: the truth and each setting are computed --repeat times.

With --tables, a paper's own tables are measured instead, without a SCENE on data that is generated in the likeness of the paper's; it writes
tables.html, tables.csv and tables.json. taibo (the default): memory, generation and rendering of the clipmap's solutions (Taibo et al.
2014, section 5). zechmeister: memory, update and render time of static decals and dynamic lines over what chapter 5 of Zechmeister
2020 varies, and whether its Table 5.4 holds. wartell: Table 1 and the storage of section 3.3 of Wartell et al. 2003 beside the paper's figures,
and geometry overlay over the mesh's screen error, borrowed quads, polygon offset and the tolerance of lines; a SCENE needs `terrain.lod`. she: \
Tables 2 to 5 and Fig. 14 of She et al. 2016, frames of inverse projection over tiles, sizes of the picture, terrains and lines, and beside stencil \
volumes; of a SCENE Tables 2 and 3 and Fig. 14.";

#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub(super) struct Arguments {
    /// The scene files, `-` for stdin; without one, a built-in generated scene.
    #[arg(value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Measure a paper's own tables instead of speed against error: taibo (the default), zechmeister, wartell, she.
    #[arg(long, value_name = "PAPER", num_args = 0..=1, require_equals = true, default_missing_value = "taibo")]
    tables: Option<Paper>,
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

/// A paper whose tables can be measured anew.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum Paper {
    /// Taibo et al. 2014, section 5.
    Taibo,
    /// Zechmeister 2020, chapter 5.
    Zechmeister,
    /// Wartell et al. 2003, Table 1 and section 3.3.
    Wartell,
    /// She et al. 2016, Tables 2 to 5 and Fig. 14.
    She,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    if let (Some(_), [scene, ..]) = (arguments.tables, &arguments.scenes[..]) {
        check_paper(scene)?;
    }
    match arguments.tables {
        None => run_report(arguments),
        Some(Paper::Taibo) => run_taibo(arguments),
        Some(Paper::Zechmeister) => run_zechmeister(arguments),
        Some(Paper::Wartell) => run_wartell(arguments),
        Some(Paper::She) => run_she(arguments),
    }
}

/// A paper's name is joined to `--tables`: after a space it is a scene, and is taken for a slip where there is no such file.
fn check_paper(scene: &Path) -> Result<()> {
    let Some(name) = scene.to_str() else { return Ok(()) };
    if scene.exists() || Paper::from_str(name, true).is_err() {
        return Ok(());
    }
    let error =
        Error::usage(format!("`{name}` after `--tables` and a space is a scene, and there is no such file"));
    Err(error.help(format!("say --tables={name}")))
}

/// Measures speed against error.
fn run_report(arguments: &Arguments) -> Outcome {
    let budget = arguments.truth.budget()?;
    let texts = texts(arguments, &[DEFAULT_SCENE])?;
    let batch = Batch::into(&arguments.output)?;
    let bar = Bar::new();
    let measure = |scene| report::measure(scene, &budget, arguments.repeat, &bar);
    let report = report::write(of_each(arguments, &texts, &bar, measure)?, arguments.repeat, batch)?;
    for scene in &report.scenes {
        bar.say(&told(scene));
    }
    bar.say(&format!("{}", arguments.output.join(report::PAGE).display()));
    Ok(Status::Passed)
}

/// Measures Taibo's tables.
fn run_taibo(arguments: &Arguments) -> Outcome {
    let texts = texts(arguments, &taibo::DATA_SETS)?;
    let batch = Batch::into(&arguments.output)?;
    let bar = Bar::new();
    let data_sets = of_each(arguments, &texts, &bar, |scene| taibo::measure(scene, arguments.repeat, &bar))?;
    let tables = taibo::Tables { schema: taibo::TABLES_SCHEMA, repeat: arguments.repeat, data_sets };
    tables.write(batch)?;
    for set in &tables.data_sets {
        bar.say(&told_of_solutions(set));
    }
    bar.say(&format!("{}", arguments.output.join("tables.html").display()));
    Ok(Status::Passed)
}

/// Measures Zechmeister's tables.
fn run_zechmeister(arguments: &Arguments) -> Outcome {
    let texts = texts(arguments, &zechmeister::SCENES)?;
    let batch = Batch::into(&arguments.output)?;
    let (bar, is_generated) = (Bar::new(), arguments.scenes.is_empty());
    let measure = |scene| zechmeister::measure(scene, is_generated, arguments.repeat, &bar);
    let tables = zechmeister::Tables::of(of_each(arguments, &texts, &bar, measure)?, arguments.repeat);
    tables.write(batch)?;
    for trend in &tables.trends {
        bar.say(&told_of_trend(trend));
    }
    bar.say(&format!("{}", arguments.output.join("tables.html").display()));
    Ok(Status::Passed)
}

/// Measures Wartell's tables.
fn run_wartell(arguments: &Arguments) -> Outcome {
    let texts = texts(arguments, &wartell::SCENES)?;
    let batch = Batch::into(&arguments.output)?;
    let bar = Bar::new();
    let measure = |scene| wartell::measure(scene, arguments.repeat, &bar);
    let tables = wartell::Tables::of(of_each(arguments, &texts, &bar, measure)?, arguments.repeat);
    tables.write(batch)?;
    for set in &tables.data_sets {
        bar.say(&told_of_lines(set));
    }
    bar.say(&format!("{}", arguments.output.join("tables.html").display()));
    Ok(Status::Passed)
}

/// Measures She's tables.
fn run_she(arguments: &Arguments) -> Outcome {
    let study = |study: &she::Study| {
        let changes = study.changes.iter().map(|change| (*change).to_owned());
        let changes: Vec<String> = changes.chain(arguments.overrides.iter().cloned()).collect();
        scene_input::built_in(she::SCENE, &changes)
    };
    let texts = match arguments.scenes.is_empty() {
        true => she::STUDIES.iter().map(study).collect::<std::result::Result<_, Stop>>()?,
        false => texts(arguments, &[])?,
    };
    let batch = Batch::into(&arguments.output)?;
    let bar = Bar::new();
    let measure = |scene| she::measure(scene, arguments.repeat, &bar);
    let tables = she::Tables::of(of_each(arguments, &texts, &bar, measure)?, arguments.repeat);
    tables.write(batch)?;
    for set in &tables.data_sets {
        bar.say(&told_of_frames(set));
    }
    bar.say(&format!("{}", arguments.output.join("tables.html").display()));
    Ok(Status::Passed)
}

/// The scenes that are asked for, or the built-in ones.
fn texts(arguments: &Arguments, built_in: &[&str]) -> std::result::Result<Vec<SceneText>, Stop> {
    let overrides = &arguments.overrides;
    match arguments.scenes.is_empty() {
        true => built_in.iter().map(|text| scene_input::built_in(text, overrides)).collect(),
        false => arguments.scenes.iter().map(|path| scene_input::read(Some(path), overrides)).collect(),
    }
}

/// Measures each scene; one after the other is loaded, and gone before the next.
fn of_each<T: Send>(
    arguments: &Arguments,
    texts: &[SceneText],
    bar: &Bar,
    measure: impl Fn(Opened) -> Result<T> + Sync,
) -> std::result::Result<Vec<T>, Stop> {
    let one = |text: &SceneText| {
        let measured = || measure(scene_input::open(text, bar)?);
        let measured = parallel::with_threads(arguments.threads, measured)?;
        measured.map_err(|error| scene_input::blame(text, error))
    };
    texts.iter().map(one).collect()
}

/// A scene's front in some lines, for people.
fn told(scene: &SceneReport) -> String {
    if scene.feature_pixels == 0 {
        return format!("{}: {}", scene.scene.name, scene.notes.last().map_or("", String::as_str));
    }
    let mut front: Vec<_> = scene.runs.iter().filter(|run| run.on_front).collect();
    front.sort_by(|a, b| a.frame_ms.median.total_cmp(&b.frame_ms.median));
    let mut text =
        format!("{}: {} runs; none is faster and more right than", scene.scene.name, scene.runs.len());
    for run in front {
        text.push_str(&format!(
            "\n  {:>9.1} ms  rmse {:.6}, on features {:.6}  {}",
            run.frame_ms.median,
            run.error.rmse,
            run.error_on_features.rmse,
            run.label()
        ));
    }
    text
}

/// A data set's frames in some lines, for people.
fn told_of_frames(set: &she::DataSet) -> String {
    let mut text = format!("{}: {} triangles, {} vertices", set.scene.name, set.triangles, set.vertices);
    for row in &set.rows {
        text.push_str(&format!("\n  {:<8} {:<34} {:>9.1} ms", row.table, row.setting, row.frame_ms.median));
    }
    text
}

/// A factor of Table 5.4 in a line, for people.
fn told_of_trend(trend: &zechmeister::Trend) -> String {
    let ratios = zechmeister::METRICS.iter().zip(trend.ratios);
    let ratios: Vec<String> =
        ratios.filter_map(|(name, ratio)| Some(format!("{name} x {:.2}", ratio?))).collect();
    let told = if ratios.is_empty() { "not measured".into() } else { ratios.join(", ") };
    let against = match trend.contradicts.is_empty() {
        true => String::new(),
        false => format!("  against the thesis: {}", trend.contradicts.join(", ")),
    };
    format!("{:<14} {:<18} {told}{against}", trend.decals, trend.factor)
}

/// A data set's Table 1 and storage in some lines, for people.
fn told_of_lines(set: &wartell::DataSet) -> String {
    let mut text = format!("{}: {} polylines, {} points", set.scene.name, set.polylines, set.points);
    for row in set.of(wartell::POLYLINES) {
        text.push_str(&format!(
            "\n  polylines {:<3}  mesh {:>7.1} ms  walks {:>7.1} ms  frame {:>7.1} ms  {} triangles, {} primitives, {} points",
            row.setting,
            row.mesh_ms.median,
            row.walk_ms.median,
            row.frame_ms.median,
            row.triangles,
            row.count("primitives"),
            row.count("points_drawn"),
        ));
    }
    for form in &set.storage.all.forms {
        text.push_str(&format!(
            "\n  storage {:<10} {:<10} {:>9.1} MiB  {:.0} % coordinates  smaller by {:.2}",
            form.points,
            form.layers,
            form.bytes() as f64 / 1_048_576.0,
            100.0 * form.coordinate_share(),
            form.factor,
        ));
    }
    text
}

/// A data set in some lines, for people.
fn told_of_solutions(set: &taibo::DataSet) -> String {
    let mut text = format!("{}: {} segments", set.scene.name, set.segments);
    for row in &set.solutions {
        text.push_str(&format!(
            "\n  {:<14} {:<8} {:>9.1} MiB  generation {:>8.0} ms  rendering {:>8.0} ms",
            row.solution,
            if row.is_combined { "combined" } else { "alone" },
            row.geometry_bytes as f64 / 1_048_576.0,
            row.generation_ms.median,
            row.rendering_ms.median,
        ));
    }
    for row in &set.width_changes {
        text.push_str(&format!("\n  width: {:>9.2} ms  {}", row.ms.median, row.name));
    }
    text
}
