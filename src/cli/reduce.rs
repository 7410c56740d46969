//! `drapery reduce BUNDLE --with CMD`

mod client;
mod folder;

use super::bar::Bar;
use super::print::print;
use super::stop::{Outcome, Status, Stop};
use client::{Client, Drawing};
use drapery::compare::Judge;
use drapery::measure::Watch;
use drapery::output::write_whole;
use drapery::reduce::{Draft, Failing, SCENE_FILE, reduce};
use drapery::scene_file::SceneText;
use drapery::source::load;
use drapery::technique::Kind;
use drapery::{Error, Result, parallel};
use std::io::Write;
use std::path::PathBuf;
use std::time::Duration;

const EXAMPLES: &str = "\
Examples:
  drapery reduce scene.toml -t clipmap --with ./my-renderer
  drapery reduce bundle --with './my-renderer --bundle {} --frames {out}' -o smallest.toml

CMD is called by the shell with a bundle's folder and an empty folder, as its last two arguments, or in place of {} and {out}. It draws \
the bundle's scene and leaves TECHNIQUE.png there.

Exit status: 0 the smallest scene that fails was written, 1 what CMD draws of the scene is right, 2 the call is wrong, or CMD fails or does \
not end.";

#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub(super) struct Arguments {
    /// A scene file, or a bundle.
    input: PathBuf,
    /// What draws a bundle: a command of the shell.
    #[arg(long, value_name = "CMD")]
    with: String,
    /// The technique that is drawn; a bundle says it.
    #[arg(short, long, value_name = "T", value_parser = technique)]
    technique: Option<Kind>,
    /// Where the smallest scene goes.
    #[arg(short, long, value_name = "FILE", default_value = "reduced.toml")]
    output: PathBuf,
    /// How long CMD may take for a picture, seconds.
    #[arg(long, value_name = "S", default_value_t = 60.0, value_parser = seconds)]
    timeout: f64,
    /// How many scenes are tried at most.
    #[arg(long, value_name = "N", default_value_t = 400)]
    tries: usize,
    /// How many threads; 0: as many as the machine has.
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
}

/// A technique by its name.
pub(super) fn technique(text: &str) -> std::result::Result<Kind, String> {
    let names = || Kind::ALL.iter().map(|kind| kind.name()).collect::<Vec<_>>().join(", ");
    let found = Kind::ALL.iter().copied().find(|kind| kind.name() == text);
    found.ok_or_else(|| format!("there is no technique `{text}`; one of {}", names()))
}

fn seconds(text: &str) -> std::result::Result<f64, String> {
    let seconds = text.parse::<f64>().ok().filter(|s| *s > 0.0 && *s <= 86400.0);
    seconds.ok_or_else(|| "it is no number of seconds, from above 0 to a day".to_owned())
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let (text, kind) = input(arguments)?;
    // Not opened: of a stage the layers have no features any more.
    let (scene, _) = load::load(&text.file, &|_| {})?;
    let draft = Draft::of(&text, &scene)?;
    let (features, vertices) = (draft.features(), draft.vertices());
    let client = Client::new(&arguments.with, kind, Duration::from_secs_f64(arguments.timeout))?;
    let bar = Bar::new();
    bar.start("drawing the scene");
    let reduced = parallel::with_threads(arguments.threads, || -> Result<_> {
        let failing = match client.drawn(&draft)? {
            Drawing::Judged(failing) => failing,
            // The first one has to work: what is wrong with the client is not what is looked for.
            Drawing::Broken(error) => return Err(error),
        };
        let Some(failing) = failing else { return Ok(None) };
        bar.start("leaving things out");
        let mut tries = 0;
        let reduced = reduce(draft, failing, arguments.tries, &mut |draft| {
            tries += 1;
            bar.done(tries as f64 / arguments.tries.max(1) as f64);
            Ok(match client.drawn(draft)? {
                Drawing::Judged(failing) => failing,
                Drawing::Broken(_) => None,
            })
        })?;
        Ok(Some(reduced))
    })??;
    drop(bar);
    let Some(reduced) = reduced else {
        return told("what the command draws is right: there is nothing to reduce\n", Status::Failed);
    };
    let text = reduced.draft.text();
    write_whole(&arguments.output, |to: &mut dyn Write| to.write_all(text.as_bytes()))?;
    let (image, Failing { pixels, .. }) = (reduced.draft.image, reduced.failing);
    let said = format!(
        "{}: {} of {features} features, {} of {vertices} vertices, {} x {} pixels of which {pixels} are wrong; {} scenes were tried\n",
        arguments.output.display(),
        reduced.draft.features(),
        reduced.draft.vertices(),
        image.width,
        image.height,
        reduced.tries
    );
    told(&said, Status::Passed)
}

/// Prints what was found; where nobody reads it, the exit status still tells.
fn told(text: &str, status: Status) -> Outcome {
    match print(&super::refusal::harmless(text)) {
        Ok(_) | Err(Stop::PipeClosed) => Ok(status),
        Err(stop) => Err(stop),
    }
}

/// The scene and the technique.
fn input(arguments: &Arguments) -> Result<(SceneText, Kind)> {
    let Arguments { input, technique, .. } = arguments;
    if !input.is_dir() {
        let kind = technique.ok_or_else(|| {
            Error::usage("a scene file does not say what draws it")
                .help("name a technique, such as -t clipmap")
        })?;
        return Ok((SceneText::read(input, &[])?, kind));
    }
    let scene = input.join(SCENE_FILE);
    if !scene.is_file() {
        return Err(Error::new(format!("this bundle has no {SCENE_FILE}"))
            .in_file(input)
            .help("name the scene file"));
    }
    let of_bundle = || {
        let judge = Judge::read(input)?;
        self::technique(judge.technique()).map_err(|what| Error::new(what).in_file(input))
    };
    let kind = technique.map_or_else(of_bundle, Ok)?;
    Ok((SceneText::read(&scene, &[])?, kind))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_timeout_is_a_number_of_seconds() {
        assert_eq!(seconds("0.5"), Ok(0.5));
        for wrong in ["", "0", "-1", "nan", "inf", "1e9"] {
            assert!(seconds(wrong).is_err(), "{wrong}");
        }
    }
}
