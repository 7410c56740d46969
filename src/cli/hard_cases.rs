//! `drapery hard-cases`: failures that real systems' users reported, by every technique.

use super::bar::Bar;
use super::print::{check_files, deliver, print};
use super::stop::{Outcome, Status, Stop};
use drapery::hard_cases::{self, Plan, Suite};
use drapery::measure::Watch;
use drapery::output::Batch;
use drapery::parallel;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  drapery hard-cases                              every case, by every technique and machine, as text
  drapery hard-cases -o hard-cases                and a page with pictures and the curves of numerical stability
  drapery hard-cases --only 4 --only 27           two of them
  drapery hard-cases --json cases.json
  drapery hard-cases --stability -o stability     the curves alone

Exit status: 0 every technique gives the known answer, or fails as its paper says, or refuses; 1 one does not; 2 the call is wrong.";

#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub(super) struct Arguments {
    /// Only the case of this number; may be repeated.
    #[arg(long, value_name = "N")]
    only: Vec<u32>,
    /// No case: the curves of numerical stability alone, for -o or --json.
    #[arg(long, conflicts_with_all = ["only", "quick"])]
    stability: bool,
    /// Exact mathematics alone: no machine is imitated.
    #[arg(long)]
    quick: bool,
    /// Write hard-cases.html, hard-cases.json and hard-cases.txt into this folder, with curves of error against what makes scenes hard.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Write the numbers as JSON; `-`: on stdout in place of the text.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// How many threads work; 0: as many as there are processors.
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    check_files(&[("--json", arguments.json.as_deref())])?;
    if arguments.stability && arguments.output.is_none() && arguments.json.is_none() {
        return Err(drapery::Error::usage("the curves of numerical stability are not text")
            .help("say where they go: -o DIR or --json FILE")
            .into());
    }
    let batch = arguments.output.as_deref().map(Batch::into).transpose()?;
    let bar = Bar::new();
    let suite = parallel::with_threads(arguments.threads, || suite(arguments, &bar))??;
    drop(bar);
    let mut is_told = false;
    if let Some(path) = &arguments.json {
        is_told = deliver(path, &suite.json()?)?;
    }
    if let Some(batch) = batch {
        write(&suite, batch)?;
    }
    let status = if suite.failed().next().is_none() { Status::Passed } else { Status::Failed };
    if is_told {
        return Ok(status);
    }
    match print(&suite.text()) {
        Ok(_) | Err(Stop::PipeClosed) => Ok(status),
        Err(stop) => Err(stop),
    }
}

/// Draws the cases; the curves where files are wanted, of the whole suite.
fn suite(arguments: &Arguments, bar: &Bar) -> drapery::Result<Suite> {
    let mut cases = Vec::new();
    if !arguments.stability {
        bar.start("drawing the hard cases");
        let plan = Plan { only: arguments.only.clone(), is_quick: arguments.quick };
        cases = hard_cases::run(&plan, &|share| bar.done(share))?;
    }
    let wants_files = arguments.output.is_some() || arguments.json.is_some();
    if !wants_files || !arguments.only.is_empty() {
        return Ok(Suite { cases, curves: Vec::new() });
    }
    bar.start("drawing the curves");
    let curves = hard_cases::curves(&|share| bar.done(share))?;
    Ok(Suite { cases, curves })
}

fn write(suite: &Suite, mut batch: Batch) -> drapery::Result<()> {
    let files = [
        ("hard-cases.html", suite.page()?),
        ("hard-cases.json", suite.json()?),
        ("hard-cases.txt", suite.text()),
    ];
    for (name, text) in files {
        batch.stage(name, |to| to.write_all(text.as_bytes()))?;
    }
    batch.commit()
}
