//! What is drawn now, made what is expected.

use super::case::{Case, pictures, selected};
use super::check::{parts_of, picture_of, variants};
use super::failure::Failure;
use super::manifest::{Entry, MANIFEST, Manifest};
use super::replay::{Cut, Replay, replay};
use super::selection::Selection;
use crate::compare::{Expected, Image, Limits, Verdict};
use crate::error::{Error, Result};
use crate::output::{Batch, write_png};
use std::path::Path;

/// What blessing changed, by the names of case and technique.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Blessed {
    /// Goldens that were not known.
    pub added: Vec<String>,
    /// Goldens that were other.
    pub changed: Vec<String>,
    /// Entries and pictures that nothing makes any more.
    pub removed: Vec<String>,
    /// How many are as they were.
    pub unchanged: usize,
}

impl Blessed {
    /// Whether anything was written.
    pub fn is_change(&self) -> bool {
        !(self.added.is_empty() && self.changed.is_empty() && self.removed.is_empty())
    }
}

/// Replays the selected cases and makes what is drawn the golden: manifest and pictures change together or not at all.
/// Entries and pictures that nothing makes any more go where all cases are selected.
///
/// # Errors
/// When a scene cannot be drawn or a variant of it differs: nothing is written then.
pub fn bless(folder: &Path, selection: &Selection, progress: &dyn Fn(&str)) -> Result<Blessed> {
    let before = Manifest::read(folder)?;
    let after = if selection.is_all() { Manifest::default() } else { before.clone() };
    let batch = Batch::into(folder)?;
    let mut blessing = Blessing { folder, before, after, batch, blessed: Blessed::default() };
    for case in selected(folder, selection)? {
        progress(&case.name);
        blessing.case(&case)?;
    }
    blessing.finish(selection)
}

/// A blessing at work.
struct Blessing<'f> {
    folder: &'f Path,
    before: Manifest,
    after: Manifest,
    batch: Batch,
    blessed: Blessed,
}

impl Blessing<'_> {
    /// Draws a case and stages what changes.
    fn case(&mut self, case: &Case) -> Result<()> {
        let replays = replay(case, &[], Cut::Usual)?;
        if let Some((technique, fault)) = variants(case, &replays)?.into_iter().next() {
            let technique = technique.map(str::to_owned);
            let failure = Failure { case: case.name.clone(), technique, fault };
            return Err(Error::new(failure.to_string()).help("what depends on that cannot be a golden"));
        }
        self.after.retain(|entry| entry.case != case.name);
        replays.iter().try_for_each(|replay| self.picture(&case.name, replay))
    }

    /// Stages a picture where the stored one is another, and notes what changes.
    fn picture(&mut self, case: &str, replay: &Replay) -> Result<()> {
        let picture = picture_of(case, replay.technique);
        let is_stored = is_stored(&self.folder.join(&picture), replay)?;
        if !is_stored {
            self.batch.stage(&picture, |to| write_png(&replay.image, to))?;
        }
        let entry = replay.entry(case);
        match self.before.find(case, replay.technique) {
            None => self.blessed.added.push(label(&entry)),
            Some(known) if is_stored && *known == entry => self.blessed.unchanged += 1,
            Some(_) => self.blessed.changed.push(label(&entry)),
        }
        self.after.set(entry);
        Ok(())
    }

    /// Puts everything in its place and removes what belongs to nothing any more.
    fn finish(self, selection: &Selection) -> Result<Blessed> {
        let Self { folder, before, after, mut batch, mut blessed } = self;
        let gone = gone(folder, &before, &after, selection)?;
        if after != before {
            batch.stage(MANIFEST, |to| to.write_all(after.text().as_bytes()))?;
        }
        batch.commit()?;
        gone.iter().try_for_each(|picture| remove(&folder.join(picture)))?;
        let is_gone = |entry: &&Entry| after.find(&entry.case, &entry.technique).is_none();
        blessed.removed = before.entries().iter().filter(is_gone).map(label).collect();
        blessed.removed.extend(gone);
        Ok(blessed)
    }
}

fn label(entry: &Entry) -> String {
    format!("{} by {}", entry.case, entry.technique)
}

/// Whether the stored picture has these pixels; one that is missing or cannot be read has not.
fn is_stored(path: &Path, replay: &Replay) -> Result<bool> {
    let Ok(stored) = Image::read(path) else { return Ok(false) };
    let actual = Image::from_rgba8(&replay.image)?;
    Ok(Verdict::on(&actual, &Expected::exactly(stored), Limits::default()).passed())
}

/// The pictures that belong to nothing any more.
fn gone(folder: &Path, before: &Manifest, after: &Manifest, selection: &Selection) -> Result<Vec<String>> {
    let is_gone = |picture: &String| {
        let (case, technique) = parts_of(picture);
        let is_known = after.find(case, technique).is_some();
        !is_known && (selection.is_all() || before.find(case, technique).is_some())
    };
    Ok(pictures(folder)?.into_iter().filter(is_gone).collect())
}

fn remove(path: &Path) -> Result<()> {
    std::fs::remove_file(path)
        .map_err(|error| Error::io("this picture cannot be removed", error).in_file(path))
}
