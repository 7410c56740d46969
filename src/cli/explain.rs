//! `drapery explain [SCENE]`

use super::bar::Bar;
use super::device_argument::DeviceArgument;
use super::pixel::pixel;
use super::print::{check_files, deliver, print};
use super::render::techniques::{self, Name};
use super::scene_input;
use super::stop::{Outcome, Status, Stop};
use super::truth_arguments::TruthArguments;
use drapery::explain::{self, Account, Asking, page};
use drapery::measure::Watch;
use drapery::source::load;
use drapery::{Error, Result, parallel};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  drapery explain --pixel 640,420                          why a pixel of the built-in scene has its colour
  drapery explain scene.toml --pixel 12,30 -t clipmap      what one technique did there
  drapery explain scene.toml --pixel 12,30 --html why.html the pixel under the microscope, as a page
  drapery explain scene.toml --html why.html               the whole picture: click where it looks wrong
  drapery explain scene.toml --pixel 12,30 --feature A1    why the road A1 is not there
  drapery explain scene.toml --pixel 12,30 --json - | jq .truth

--feature takes a layer's name, LAYER/NUMBER, or what any column of a file says.";

#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub(super) struct Arguments {
    /// The scene file, `-` for stdin; without it, a built-in generated scene.
    scene: Option<PathBuf>,
    /// The pixel: column and row, from 0 at the upper left. Without it, a page of the whole picture is written, in which one clicks.
    #[arg(long, value_name = "X,Y", value_parser = pixel, allow_hyphen_values = true, required_unless_present = "html")]
    pixel: Option<[usize; 2]>,
    /// A technique to ask; may be repeated. Default: all that draw the scene.
    #[arg(short, long = "technique", value_name = "T")]
    techniques: Vec<Name>,
    /// A feature to look for: a layer, LAYER/NUMBER, or what a column says.
    #[arg(long, value_name = "NAME", requires = "pixel")]
    feature: Option<String>,
    /// Write all of it as JSON; `-`: on stdout in place of the text.
    #[arg(long, value_name = "FILE", requires = "pixel")]
    json: Option<PathBuf>,
    /// Write a page, one file that needs no network; `-`: on stdout in place of the text.
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// How many pixels a page of the whole picture tells of at most.
    #[arg(long, value_name = "N", default_value_t = 300, conflicts_with = "pixel", value_parser = clap::value_parser!(u32).range(1..=4000))]
    most: u32,
    /// Change the scene: a dotted path and a TOML value; may be repeated. No value removes the key.
    #[arg(long = "set", value_name = "PATH=VALUE")]
    overrides: Vec<String>,
    /// How many threads; 0: as many as the machine has.
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
    #[command(flatten)]
    device: DeviceArgument,
    #[command(flatten)]
    truth: TruthArguments,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    check_files(&[("--json", arguments.json.as_deref()), ("--html", arguments.html.as_deref())])?;
    let kinds = techniques::asked(&arguments.techniques).kinds;
    let budget = arguments.truth.budget()?;
    let changes = arguments.device.before(&arguments.overrides)?;
    let text = scene_input::read(arguments.scene.as_deref(), &changes)?;
    let bar = Bar::new();
    let answer = || -> Result<Answer> {
        let mut scene = scene_input::open(&text, &bar)?;
        let attributes = load::attributes(&text.file, &|told| bar.note(told));
        let asking = Asking {
            kinds: kinds.as_deref(),
            feature: arguments.feature.as_deref(),
            attributes: &attributes,
            close_up: if arguments.html.is_some() { CLOSE_UP } else { 0 },
            budget,
        };
        let name = scene.stage.scene.name.clone();
        let Some(pixel) = arguments.pixel else {
            let interesting = explain::picture(&scene, &asking, arguments.most as usize, &bar)?;
            return Ok((None, Some(page::of_picture(&name, &interesting)?)));
        };
        bar.start("explaining");
        let account = explain::pixel(&mut scene, &asking, pixel)?;
        let page = arguments.html.as_ref().map(|_| page::of_pixel(&name, &account)).transpose()?;
        Ok((Some(account), page))
    };
    let answer = parallel::with_threads(arguments.threads, answer)?;
    let (account, page) = answer.map_err(|error| scene_input::blame(&text, error))?;
    drop(bar);
    let mut is_told = false;
    if let (Some(path), Some(page)) = (&arguments.html, page) {
        is_told |= deliver(path, &page)?;
    }
    match account {
        Some(account) => write(arguments, &account, is_told),
        None => Ok(Status::Passed),
    }
}

/// What is told of a pixel, and the page that was asked for.
type Answer = (Option<Account>, Option<String>);

/// Samples a side of a close-up.
const CLOSE_UP: usize = 160;

/// Writes what is told of a pixel: as JSON where that is asked for, and as text where nothing else goes to stdout.
fn write(arguments: &Arguments, account: &Account, mut is_told: bool) -> Outcome {
    if let Some(path) = &arguments.json {
        let text = serde_json::to_string_pretty(&account.document());
        let text = text.map_err(|error| Error::internal("an account is no JSON").caused_by(error))?;
        is_told |= deliver(path, &(text + "\n"))?;
    }
    if is_told {
        return Ok(Status::Passed);
    }
    match print(&account.text()) {
        Ok(_) | Err(Stop::PipeClosed) => Ok(Status::Passed),
        Err(stop) => Err(stop),
    }
}
