//! `drapery new FILE...`

mod files;
mod framing;
mod place;
mod rounding;
mod style;
mod text;
mod theme;

use super::bar::Bar;
use super::print::print;
use super::refusal::harmless;
use super::stop::{Outcome, Status};
use drapery::measure::Watch;
use drapery::output::write_whole;
use drapery::scene_file::SceneFile;
use drapery::source::load;
use drapery::{Error, Result};
use files::Files;
use framing::Framing;
use place::Place;
use std::path::{Path, PathBuf};
use text::{Starter, Told};

#[derive(Debug, clap::Args)]
#[command(after_long_help = "\
Examples:
  drapery new dem.tif lakes.geojson roads.shp -o scene.toml
  drapery render scene.toml
  drapery new roads.shp dem.tif | drapery render -

Terrain and vector files are told apart by what they are; several terrain files are one terrain. Areas are drawn first, then lines, then points, each in the order of the call.
Without -o the scene goes to stdout, with paths as they are given: save it in the folder where you call this. With -o paths start at
the folder of that file.")]
pub(super) struct Arguments {
    /// Terrain and vector files, in any order and number.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Where the scene goes; `-`, and without it: stdout.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let output = arguments.output.as_deref().filter(|path| *path != Path::new("-"));
    if let Some(output) = output {
        keep(output, &arguments.files)?;
    }
    let bar = Bar::new();
    let files = Files::of(&arguments.files, &|what| bar.start(what))?;
    let (text, notes) = starter(&files, output, &|what| bar.start(what))?;
    notes.iter().for_each(|note| bar.note(note));
    let Some(output) = output else {
        drop(bar);
        return print(&text);
    };
    write_whole(output, |to| to.write_all(text.as_bytes()))?;
    bar.say(&harmless(&format!("{}: a scene; next: drapery render {0}", output.display())));
    Ok(Status::Passed)
}

/// Refuses to write over what the scene is made of.
fn keep(output: &Path, files: &[PathBuf]) -> Result<()> {
    let place = |path: &Path| std::fs::canonicalize(path).ok();
    let target = place(output);
    match files.iter().find(|file| target.is_some() && place(file) == target) {
        None => Ok(()),
        Some(_) => {
            let refusal = Error::usage("the scene would be written over a file that it is to show");
            Err(refusal.in_file(output).help("name another file for -o"))
        }
    }
}

/// The scene's text, and what the user should know: all that drawing it would say.
fn starter(files: &Files, output: Option<&Path>, progress: &dyn Fn(&str)) -> Result<(String, Vec<String>)> {
    // Nobody sees the draft: a place in it tells nothing.
    let load = |text: &str| {
        let scene = SceneFile::parse(text, None, &[])?;
        load::load(&scene, progress)
    };
    let load = |text: &str| load(text).map_err(Error::without_scene);
    let draft = Starter { files, place: &Place::here(), told: None };
    let (scene, surface) = load(&draft.text()?)?;
    let framing = Framing::of(&scene, &surface, draft.knows_crs());
    let mut told = Told { scene: &scene, framing: &framing, notes: &scene.notes };
    // What lies off the terrain depends on the widths, which the draft did not have.
    let with_widths = match scene.notes.iter().any(|note| load::is_about_extent(note)) {
        true => load(&Starter { told: Some(told), ..draft }.text()?)?.0.notes,
        false => scene.notes.clone(),
    };
    told.notes = &with_widths;
    let place = output.map_or_else(|| Ok(Place::here()), Place::beside)?;
    let text = Starter { files, place: &place, told: Some(told) }.text()?;
    let scale = framing.scale_note().map(|note| format!("terrain: {note}"));
    let notes = with_widths
        .iter()
        .cloned()
        .chain(scale)
        .chain(draft.note_of_globe())
        .chain(draft.notes_of_left_out());
    Ok((text, notes.collect()))
}

#[cfg(test)]
mod tests;
