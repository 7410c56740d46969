//! A frame by what a bundle allows.

use super::arguments::Arguments;
use super::files::{mask, place, read};
use super::judged::{Call, Judged, Pictures};
use drapery::compare::{Gates, Image, Judge, JudgementReport, Submitted};
use drapery::{Error, Result};
use std::path::Path;

pub(super) fn judged(arguments: &Arguments, folder: &Path) -> Result<Call> {
    let judge = Judge::read(folder)?;
    check_own(&judge, &arguments.actual)?;
    let frame = frame(&judge, &arguments.actual)?;
    let judged = judged_frame(arguments, &judge, folder, frame)?;
    let inputs = judge.files().chain([arguments.actual.clone()]).chain(arguments.ignore.clone()).collect();
    Ok(Call::of(vec![judged], None, inputs))
}

/// Refuses what a bundle has no use for.
pub(super) fn check_options(arguments: &Arguments) -> Result<()> {
    let Arguments { tolerance, relative, .. } = arguments;
    for (name, given) in [("--tolerance", tolerance), ("--relative", relative)] {
        if given.is_some() {
            return Err(Error::usage(format!(
                "{name} is of pictures: a bundle tells itself what each pixel may be"
            ))
            .help("--allow N lets some pixels lie outside"));
        }
    }
    Ok(())
}

/// Refuses a picture that belongs to the bundle.
pub(super) fn check_own(judge: &Judge, actual: &Path) -> Result<()> {
    let Some(file) = place(actual) else { return Ok(()) };
    let picture = Submitted::picture_in(file, judge.technique())?;
    if judge.is_its_own(&picture)? {
        return Err(Error::usage(format!(
            "the same file twice: {} is one of the bundle's own, which would pass whatever it shows",
            picture.display()
        ))
        .help("judge what your own program drew"));
    }
    Ok(())
}

/// What was handed in.
fn frame(judge: &Judge, actual: &Path) -> Result<Submitted> {
    match actual.is_dir() {
        true => judge.frame(actual),
        false => Ok(Submitted::picture(read(actual)?, actual.into())),
    }
}

/// Judges a frame by a bundle.
pub(super) fn judged_frame(
    arguments: &Arguments,
    judge: &Judge,
    folder: &Path,
    mut frame: Submitted,
) -> Result<Judged> {
    let (width, height) = (judge.allowed().width, judge.allowed().height);
    let allow = arguments.allow.map_or(0, |allow| allow.of(width * height));
    let densest = arguments.densest.unwrap_or(Gates::default().densest);
    let gates = Gates { allow, densest, strict: arguments.strict };
    frame.ignored = mask(arguments.ignore.as_deref(), (width, height))?;
    let judgement = judge.judge(&frame, gates);
    let (expected, actual) = (folder.display().to_string(), frame.path.display().to_string());
    let report = JudgementReport { expected: &expected, actual: &actual, judge, judgement: &judgement };
    let mut pictures = Pictures::default();
    if arguments.shows() {
        pictures.heat = judgement.heat_map();
        pictures.both = Some((Image::read(&judge.picture())?, frame.picture));
    }
    Ok(Judged { case: report.case()?, pictures })
}
