//! Goldens replayed and held against what is known.

use super::case::{Case, Variant, cases, pictures, selected};
use super::failure::{Failure, Fault};
use super::manifest::{Entry, Manifest};
use super::replay::{Cut, Replay, first_difference, is_of_the_judge, replay};
use super::selection::Selection;
use crate::compare::{Expected, Image, Limits, Verdict};
use crate::error::Result;
use crate::parallel;
use std::path::Path;

/// The variant that every case has: other tiles, another number of threads.
const OTHER_CUT: &str = "tiles of 24 pixels, 3 threads";

/// What a check comes to.
#[derive(Debug, Clone, Default)]
pub struct Checked {
    /// How many pictures were drawn and compared.
    pub replayed: usize,
    /// All that is wrong, in the order of the cases.
    pub failures: Vec<Failure>,
}

/// Replays the selected cases of a folder; `progress` is told which case is next.
///
/// # Errors
/// When the folder, its manifest or settings cannot be read, no case is selected by the pattern, or there is a bug. What is wrong
/// with a golden is no error but a failure.
pub fn check(folder: &Path, selection: &Selection, progress: &dyn Fn(&str)) -> Result<Checked> {
    let manifest = Manifest::read(folder)?;
    let cases = selected(folder, selection)?;
    let mut checked = Checked::default();
    if selection.is_first() {
        checked.failures = without_case(folder, &manifest, selection)?;
    }
    for case in cases {
        progress(&case.name);
        check_case(folder, &manifest, &case, &mut checked)?;
    }
    Ok(checked)
}

/// Entries without a case, and pictures without an entry.
fn without_case(folder: &Path, manifest: &Manifest, selection: &Selection) -> Result<Vec<Failure>> {
    let all = cases(folder)?;
    let failure = |case: &str, technique: &str, fault| Failure {
        case: case.into(),
        technique: Some(technique.into()),
        fault,
    };
    let is_lost = |entry: &&Entry| selection.matches(&entry.case) && all.iter().all(|c| c.name != entry.case);
    let lost = manifest.entries().iter().filter(is_lost);
    let mut failures: Vec<Failure> =
        lost.map(|entry| failure(&entry.case, &entry.technique, Fault::NoCase)).collect();
    for picture in pictures(folder)? {
        let (case, technique) = parts_of(&picture);
        if selection.matches(case) && manifest.find(case, technique).is_none() {
            failures.push(failure(case, technique, Fault::OrphanPicture));
        }
    }
    Ok(failures)
}

/// Case and technique of a picture's name.
pub(super) fn parts_of(picture: &str) -> (&str, &str) {
    let stem = picture.strip_suffix(".png").unwrap_or(picture);
    stem.rsplit_once('.').unwrap_or((stem, ""))
}

/// The picture's name in the golden folder.
pub(super) fn picture_of(case: &str, technique: &str) -> String {
    format!("{case}.{technique}.png")
}

fn check_case(folder: &Path, manifest: &Manifest, case: &Case, checked: &mut Checked) -> Result<()> {
    let mut fail = |technique: Option<&str>, fault| {
        let technique = technique.map(str::to_owned);
        checked.failures.push(Failure { case: case.name.clone(), technique, fault });
    };
    let replays = match replay(case, &[], Cut::Usual) {
        Ok(replays) => replays,
        Err(error) if error.is_internal() => return Err(error),
        Err(error) => {
            fail(None, Fault::Refused(error));
            return Ok(());
        }
    };
    for entry in manifest.entries().iter().filter(|entry| entry.case == case.name) {
        if !replays.iter().any(|replay| replay.technique == entry.technique) {
            fail(Some(&entry.technique), Fault::NoCase);
        }
    }
    for replay in &replays {
        if let Some(fault) = fault_of(folder, manifest.find(&case.name, replay.technique), case, replay) {
            fail(Some(replay.technique), fault);
        }
    }
    for (technique, fault) in variants(case, &replays)? {
        fail(technique, fault);
    }
    checked.replayed += replays.len();
    Ok(())
}

/// What is wrong with a replay.
fn fault_of(folder: &Path, entry: Option<&Entry>, case: &Case, replay: &Replay) -> Option<Fault> {
    let Some(entry) = entry else { return Some(Fault::NoEntry) };
    let actual = (replay.image.width(), replay.image.height());
    if entry.size != actual {
        return Some(Fault::Size { expected: entry.size, actual });
    }
    let path = folder.join(picture_of(&case.name, replay.technique));
    let stored = path.exists().then(|| on_stored(&path, replay));
    let differs = first_difference(&entry.hashes, &replay.hashes, |_| true);
    match (differs, stored) {
        (Some(buffer), stored) => {
            let verdict = stored.and_then(Result::ok).map(Box::new);
            Some(Fault::Differs { buffer, verdict, actual: replay.image.clone() })
        }
        (None, None) => Some(Fault::NoPicture),
        (None, Some(Err(error))) => Some(Fault::Refused(error)),
        (None, Some(Ok(verdict))) if verdict.passed() => {
            let ruling = replay.refusal.clone()?;
            Some(Fault::NotAllowed { ruling })
        }
        (None, Some(Ok(verdict))) => Some(Fault::OtherPicture { verdict: Box::new(verdict) }),
    }
}

/// The verdict on a replay by the stored picture: no pixel may differ.
fn on_stored(path: &Path, replay: &Replay) -> Result<Verdict> {
    let expected = Expected::exactly(Image::read(path)?);
    Ok(Verdict::on(&Image::from_rgba8(&replay.image)?, &expected, Limits::default()))
}

/// What must change nothing and does, with the technique to blame.
pub(super) fn variants<'a>(case: &Case, replays: &'a [Replay]) -> Result<Vec<(Option<&'a str>, Fault)>> {
    let mut faults = Vec::new();
    let cut =
        Variant { name: OTHER_CUT.into(), set: Vec::new(), buffers: Vec::new(), techniques: Vec::new() };
    let other = parallel::with_threads(3, || replay(case, &[], Cut::Small))?;
    faults.extend(unequal(replays, other, &cut)?);
    for variant in &case.variants {
        faults.extend(unequal(replays, replay(case, &variant.set, Cut::Usual), variant)?);
    }
    Ok(faults)
}

/// Where a variant differs from what it is a variant of.
fn unequal<'a>(
    replays: &'a [Replay],
    varied: Result<Vec<Replay>>,
    variant: &Variant,
) -> Result<Vec<(Option<&'a str>, Fault)>> {
    let varied = match varied {
        Ok(varied) => varied,
        Err(error) if error.is_internal() => return Err(error),
        Err(error) => return Ok(vec![(None, Fault::Refused(error))]),
    };
    let is_one_of = |name: &str, names: &[String]| names.is_empty() || names.iter().any(|n| n == name);
    let fault = |replay: &'a Replay| {
        let other = varied.iter().find(|other| other.technique == replay.technique);
        let hashes = other.map_or(&[][..], |other| &other.hashes);
        let is_asked = |name: &str| is_one_of(name, &variant.buffers) && !is_of_the_judge(name);
        let buffer = first_difference(&replay.hashes, hashes, is_asked)?;
        Some((Some(replay.technique), Fault::Variant { variant: variant.name.clone(), buffer }))
    };
    let asked = replays.iter().filter(|replay| is_one_of(replay.technique, &variant.techniques));
    Ok(asked.filter_map(fault).collect())
}
