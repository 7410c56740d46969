//! `drapery figures [NAME]...`

use super::bar::Bar;
use super::print::print;
use super::stop::{Outcome, Status, Stop};
use drapery::figures::{self, Figure, Scale, UNMADE, Unmade};
use drapery::measure::Watch;
use drapery::output::Batch;
use drapery::parallel;
use std::fmt::Write;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  drapery figures                        all, into figures/; open figures/figures.html
  drapery figures she-13 taibo -o out    one of She et al.'s, and all of Taibo et al.'s
  drapery figures --list                 which there are, and which papers' figures are not made, and why

Writes DIR/NAME.png or DIR/NAME.svg of each panel (NAME-a, NAME-b, ... of several), DIR/figures.html (one page, readable without a network) and
DIR/figures.json: all of them, or none when something fails. The same bits in every run, on every machine.

Tables and what is measured in times: drapery report --tables=taibo, zechmeister, wartell, she.";

#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub(super) struct Arguments {
    /// Which figures; the name of a paper means all of its. Without one, all.
    #[arg(value_name = "NAME")]
    names: Vec<String>,
    /// Tell which figures there are, and which of the papers' are not made.
    #[arg(long)]
    list: bool,
    /// Where they go; made where it is missing.
    #[arg(short, long, value_name = "DIR", default_value = "figures")]
    output: PathBuf,
    /// How large pictures of landscapes are: full, or small, a quarter as wide and high.
    #[arg(long, value_name = "SCALE", default_value = "full")]
    scale: Size,
    /// How many threads; 0: as many as the machine has. The figures are the same.
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
}

#[derive(Debug, Clone, Copy, clap::ValueEnum)]
enum Size {
    Full,
    Small,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let figures = figures::chosen(&arguments.names)?;
    if arguments.list {
        return match print(&list(&figures)) {
            Ok(_) | Err(Stop::PipeClosed) => Ok(Status::Passed),
            Err(stop) => Err(stop),
        };
    }
    let scale = match arguments.scale {
        Size::Full => Scale::Full,
        Size::Small => Scale::Small,
    };
    let batch = Batch::into(&arguments.output)?;
    let bar = Bar::new();
    let telling = |name: &str, share: f64| {
        bar.start(name);
        bar.done(share);
    };
    parallel::with_threads(arguments.threads, || figures::write(&figures, scale, batch, &telling))??;
    bar.say(&format!("{}", arguments.output.join(figures::PAGE).display()));
    Ok(Status::Passed)
}

/// The figures, a line each, and what is not made.
fn list(figures: &[&Figure]) -> String {
    let mut text = String::new();
    for figure in figures {
        let _ = writeln!(text, "{:<18} {:<10} {}", figure.name, figure.number, figure.title);
    }
    let papers: Vec<_> = figures.iter().map(|figure| figure.paper).collect();
    for Unmade { paper, number, what, why } in UNMADE.iter().filter(|one| papers.contains(&one.paper)) {
        let whose = format!("{} {number}", paper.name());
        let _ = writeln!(text, "not made: {}, {what}: {why}", whose.trim_end());
    }
    text
}
