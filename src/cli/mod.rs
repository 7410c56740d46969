//! The command line, a file a subcommand: the only code that prints or exits.
//!
//! Data goes to stdout, messages to stderr. Exit status: 0 done, 1 judged and failed, 2 the call or an input is wrong,
//! 3 a bug of ours.

mod bar;
mod calibrate;
mod columns;
mod compare;
mod completions;
mod device_argument;
mod explain;
mod export;
mod figures;
mod golden;
mod hard_cases;
mod info;
mod judge_test;
mod lines;
mod new;
mod pixel;
mod print;
mod reduce;
mod refusal;
mod render;
mod report;
mod scene_input;
mod schema;
mod stop;
mod truth_arguments;
mod written;

use clap::{ColorChoice, CommandFactory, FromArgMatches, Parser, Subcommand};
use std::ffi::OsString;
use std::process::ExitCode;
use stop::Outcome;

const EXAMPLES: &str = "\
Examples:
  drapery render                                   a built-in scene, into out/
  drapery new dem.tif lakes.geojson roads.shp > scene.toml
  drapery render scene.toml -o pictures            every technique that applies, and the truth
  drapery render scene.toml -t truth -t clipmap --set image.width=600
  drapery report scene.toml                        speed against error, as a page in report/
  drapery compare expected.png actual.png --tolerance 1/255
  drapery compare bundle my-frames                 is what my program drew from the bundle right?
  drapery export scene.toml -t clipmap -o bundle   mesh, features, matrices, pictures for a GPU client
  drapery explain scene.toml --pixel 640,420       why this pixel has its colour
  drapery figures she-13                           a paper's figure, made again
  drapery golden check
  drapery schema > scene.schema.json               for completion in an editor

Exit status: 0 done and passed, 1 judged and failed, 2 the call or an input is wrong, 3 a bug in drapery.
Data goes to stdout, messages to stderr; `-` is stdin. NO_COLOR is honoured.";

/// The reference renderer for 2D vector data draped over 3D terrain.
///
/// Drapery computes the right picture of roads, lakes and fields on a terrain as certified intervals, and imitates the
/// published GPU techniques so that their pictures can be judged against it.
#[derive(Debug, Parser)]
#[command(version, after_long_help = EXAMPLES, arg_required_else_help = true, max_term_width = 110)]
struct Cli {
    #[command(subcommand)]
    command: Command,
    /// Whether messages are coloured.
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto")]
    color: ColorChoice,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Render a scene by one technique or by all.
    Render(render::Arguments),
    /// Compare every technique, over its settings, with the truth: error, time, memory.
    Report(report::Arguments),
    /// Write a starter scene for your own files, commented, ready to render.
    New(new::Arguments),
    /// Write a scene and its pictures for a program on a graphics processor that is to draw the same.
    Export(export::Arguments),
    /// Tell why a pixel has its colour.
    Explain(explain::Arguments),
    /// Find out how a graphics processor rounds, so that it can be imitated.
    Calibrate(calibrate::Arguments),
    /// Judge a frame by a bundle, or a picture by another.
    Compare(compare::Arguments),
    /// Find the smallest scene that a program still draws wrong.
    Reduce(reduce::Arguments),
    /// Make the papers' figures again, and some of our own.
    Figures(figures::Arguments),
    /// Replay goldens: small scenes whose every buffer is known.
    Golden(golden::Arguments),
    /// Draw failures that users of real systems reported, with their known answers.
    HardCases(hard_cases::Arguments),
    /// Tell what a data file holds.
    Info(info::Arguments),
    /// Print the JSON Schema of the scene file.
    Schema,
    /// Test the judge itself: planted bugs have to fail, other right pictures have to pass.
    #[command(hide = true)]
    JudgeTest(judge_test::Arguments),
    /// Print completions for a shell.
    Completions(completions::Arguments),
}

/// Runs the program.
pub(crate) fn main() -> ExitCode {
    stop::guarded(call)
}

fn call() -> ExitCode {
    let arguments: Vec<OsString> = std::env::args_os().collect();
    let parsed = Cli::command().color(wanted_color(&arguments)).try_get_matches_from(arguments);
    let cli = match parsed.and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => cli,
        Err(usage) => return stop::usage(&usage),
    };
    stop::exit(run(cli.command), cli.color)
}

fn run(command: Command) -> Outcome {
    match command {
        Command::Render(arguments) => render::run(&arguments),
        Command::Report(arguments) => report::run(&arguments),
        Command::Export(arguments) => export::run(&arguments),
        Command::Explain(arguments) => explain::run(&arguments),
        Command::Calibrate(arguments) => calibrate::run(&arguments),
        Command::New(arguments) => new::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Reduce(arguments) => reduce::run(&arguments),
        Command::Figures(arguments) => figures::run(&arguments),
        Command::Golden(arguments) => golden::run(&arguments),
        Command::HardCases(arguments) => hard_cases::run(&arguments),
        Command::Info(arguments) => info::run(&arguments),
        Command::Schema => schema::run(),
        Command::JudgeTest(arguments) => judge_test::run(&arguments),
        Command::Completions(arguments) => completions::run(&arguments, &mut Cli::command()),
    }
}

/// The colour choice for the parser's own messages, which are printed before there are parsed arguments.
fn wanted_color(arguments: &[OsString]) -> ColorChoice {
    let words: Vec<&str> = arguments.iter().filter_map(|argument| argument.to_str()).collect();
    let after = words.iter().position(|word| *word == "--color").and_then(|at| words.get(at + 1).copied());
    let joined = words.iter().find_map(|word| word.strip_prefix("--color="));
    joined.or(after).and_then(|word| word.parse().ok()).unwrap_or(ColorChoice::Auto)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }
}
