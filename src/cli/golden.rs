//! `drapery golden check|bless|list`

use super::bar::Bar;
use super::print::print;
use super::refusal::harmless;
use super::stop::{Outcome, Status, Stop};
use drapery::Result;
use drapery::golden::{self, Checked, Failure, Fault, IMAGE, Manifest, Selection};
use drapery::measure::Watch;
use drapery::output::{Batch, write_png};
use std::fmt::Write;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  drapery golden check                       replay everything below golden/
  drapery golden check --only 'device/*' -o differences
  drapery golden check --partition 2/4       one of four machines
  drapery golden bless --only device/f32     make what is drawn now the golden
  drapery golden list

A golden is a small scene DIR/TOPIC/CASE.toml with its pictures CASE.TECHNIQUE.png beside it and the hashes of all its \
buffers in DIR/manifest.toml. A check replays it by every technique that applies, twice, with other tiles and threads; \
the first buffer that differs, in the order of the technique's stages, is named.

Exit status of check: 0 all are as they were, 1 one is not, 2 the call or the folder is wrong. Of bless: 0 nothing had to \
change, 1 something was changed (so that no script blesses unseen), 2 nothing was written.";

#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub(super) struct Arguments {
    #[command(subcommand)]
    action: Action,
}

#[derive(Debug, clap::Subcommand)]
enum Action {
    /// Replay goldens and say what differs.
    Check {
        #[command(flatten)]
        which: Which,
        /// Write the picture and its heat map of each golden that differs: DIR/TOPIC/CASE.TECHNIQUE.actual.png and .heat.png.
        #[arg(short, long, value_name = "DIR")]
        output: Option<PathBuf>,
    },
    /// Make what is drawn now the golden; exits with 1 when that changed something.
    Bless {
        #[command(flatten)]
        which: Which,
    },
    /// List goldens: case, technique, size, hash of the picture.
    List {
        #[command(flatten)]
        which: Which,
    },
}

/// Which goldens are meant.
#[derive(Debug, clap::Args)]
struct Which {
    /// The folder of goldens.
    #[arg(long, value_name = "DIR", default_value = "golden")]
    dir: PathBuf,
    /// Only cases TOPIC/CASE that match; `*` is any text, `?` any character.
    #[arg(long, value_name = "GLOB")]
    only: Option<String>,
    /// Only the I-th of N parts of the cases, to share the work.
    #[arg(long, value_name = "I/N", default_value = "1/1", value_parser = part)]
    partition: (usize, usize),
}

impl Which {
    fn selection(&self) -> Result<Selection> {
        Selection::new(self.only.as_deref(), self.partition)
    }
}

/// `I/N`.
fn part(text: &str) -> std::result::Result<(usize, usize), String> {
    let numbers = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
    let (part, parts) = numbers.ok_or("it is not of the form I/N, such as 1/4")?;
    Selection::new(None, (part, parts)).map_err(|error| error.what().to_owned())?;
    Ok((part, parts))
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    match &arguments.action {
        Action::Check { which, output } => check(which, output.as_deref()),
        Action::Bless { which } => bless(which),
        Action::List { which } => list(which),
    }
}

fn check(which: &Which, output: Option<&Path>) -> Outcome {
    let selection = which.selection()?;
    let batch = output.map(Batch::into).transpose()?;
    let bar = Bar::new();
    let checked = golden::check(&which.dir, &selection, &|case| bar.start(case))?;
    drop(bar);
    if let Some(batch) = batch.filter(|_| !checked.failures.is_empty()) {
        write_pictures(batch, &checked.failures)?;
    }
    let status = if checked.failures.is_empty() { Status::Passed } else { Status::Failed };
    told(&checked_text(&checked), status)
}

/// The failures, and how many there are.
fn checked_text(checked: &Checked) -> String {
    let mut text = String::new();
    for failure in &checked.failures {
        // Writing to a string does not fail.
        let _ = writeln!(text, "FAIL: {}", harmless(&failure.to_string()));
    }
    let verdict = if checked.failures.is_empty() { "PASS" } else { "FAIL" };
    let (count, pictures) = (checked.failures.len(), checked.replayed);
    text + &format!("{verdict}: {pictures} pictures with their buffers were replayed, {count} failures\n")
}

/// Writes the picture of each golden that differs, and where it differs from the stored one.
fn write_pictures(mut batch: Batch, failures: &[Failure]) -> Result<()> {
    for failure in failures {
        let technique = failure.technique.as_deref().unwrap_or_default();
        let file = |what: &str| format!("{}.{technique}.{what}.png", failure.case);
        let (actual, verdict) = match &failure.fault {
            Fault::Differs { actual, verdict, .. } => (Some(actual), verdict.as_deref()),
            Fault::OtherPicture { verdict } => (None, Some(&**verdict)),
            _ => (None, None),
        };
        if let Some(actual) = actual {
            batch.stage(&file("actual"), |to| write_png(actual, to))?;
        }
        if let Some(map) = verdict.and_then(|verdict| verdict.heat_map()) {
            batch.stage(&file("heat"), |to| write_png(&map, to))?;
        }
    }
    batch.commit()
}

fn bless(which: &Which) -> Outcome {
    let bar = Bar::new();
    let blessed = golden::bless(&which.dir, &which.selection()?, &|case| bar.start(case))?;
    drop(bar);
    let mut text = String::new();
    for (what, names) in
        [("added", &blessed.added), ("changed", &blessed.changed), ("removed", &blessed.removed)]
    {
        names.iter().for_each(|name| text += &format!("{what}: {}\n", harmless(name)));
    }
    text += &match blessed.is_change() {
        true => format!(
            "the goldens have changed ({} are as they were): look at the pictures\n",
            blessed.unchanged
        ),
        false => format!("nothing has changed: {} goldens are as they were\n", blessed.unchanged),
    };
    told(&text, if blessed.is_change() { Status::Failed } else { Status::Passed })
}

fn list(which: &Which) -> Outcome {
    let selection = which.selection()?;
    let manifest = Manifest::read(&which.dir)?;
    let cases = golden::selected(&which.dir, &selection)?;
    let mut text = String::new();
    for case in cases {
        let mut entries = manifest.entries().iter().filter(|entry| entry.case == case.name).peekable();
        if entries.peek().is_none() {
            text += &format!("{}  not blessed\n", harmless(&case.name));
        }
        for entry in entries {
            let hash = entry.hashes.iter().find(|hash| hash.buffer == IMAGE);
            let hash = hash.map_or("", |hash| &hash.blake3);
            let (width, height) = entry.size;
            text += &format!("{}  {}  {width} x {height}  {hash}\n", harmless(&entry.case), entry.technique);
        }
    }
    told(&text, Status::Passed)
}

/// Prints what was found; where nobody reads it, the exit status still tells.
fn told(text: &str, status: Status) -> Outcome {
    match print(text) {
        Ok(_) | Err(Stop::PipeClosed) => Ok(status),
        Err(stop) => Err(stop),
    }
}

#[cfg(test)]
mod tests {
    use super::part;

    #[test]
    fn a_part_is_one_of_its_number() {
        assert_eq!(part("2/3"), Ok((2, 3)));
        for wrong in ["", "1", "0/3", "4/3", "1/2/3", "-1/2", "a/b"] {
            assert!(part(wrong).is_err(), "{wrong}");
        }
    }
}
