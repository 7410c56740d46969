//! `drapery judge-test`, which ordinary help does not list: whether the judge can be trusted.

use super::bar::Bar;
use super::print::print;
use super::reduce::technique;
use super::stop::{Outcome, Status, Stop};
use drapery::measure::Watch;
use drapery::output::write_whole;
use drapery::technique::Kind;
use drapery::{judge_test, parallel};
use std::io::Write;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  drapery judge-test                              every technique, scene, bug and variant
  drapery judge-test --only stencil-volume --json trial.json
  drapery judge-test --scene hills --every 5      a sample
  drapery judge-test --blind                      has to fail

Exit status: 0 the judge catches at least 99 % of all bugs and 95 % of each class and passes every right picture, 1 it does \
not, 2 the call is wrong.";

#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub(super) struct Arguments {
    /// Only this technique.
    #[arg(long, value_name = "TECHNIQUE", value_parser = technique)]
    only: Option<Kind>,
    /// Only this scene.
    #[arg(long, value_name = "NAME")]
    scene: Option<String>,
    /// Only each N-th bug and variant.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    every: u32,
    /// A judge that allows everything, to see that the test can fail.
    #[arg(long)]
    blind: bool,
    /// Write the numbers as JSON.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// How many threads work; 0: as many as there are processors.
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let plan = judge_test::Plan {
        kinds: arguments.only.map_or_else(|| Kind::ALL.to_vec(), |kind| vec![kind]),
        scene: arguments.scene.clone(),
        every: arguments.every as usize,
        blind: arguments.blind,
    };
    let bar = Bar::new();
    bar.start("testing the judge");
    let trial =
        parallel::with_threads(arguments.threads, || judge_test::run(&plan, &|share| bar.done(share)))??;
    drop(bar);
    if let Some(path) = &arguments.json {
        let text = trial.json()?;
        write_whole(path, |to: &mut dyn Write| to.write_all(text.as_bytes()))?;
    }
    let status = if trial.faults().is_empty() { Status::Passed } else { Status::Failed };
    match print(&trial.text()) {
        Ok(_) | Err(Stop::PipeClosed) => Ok(status),
        Err(stop) => Err(stop),
    }
}
