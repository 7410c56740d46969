//! Frames by all bundles of a conformance set.

use super::arguments::Arguments;
use super::bundle::{check_own, judged_frame};
use super::judged::{Call, Judged, Pictures};
use drapery::compare::{Case, ConformanceCase, ConformanceSet, Judge, Submitted};
use drapery::{Error, Result};
use std::path::{Path, PathBuf};

pub(super) fn judged(arguments: &Arguments, folder: &Path) -> Result<Call> {
    let frames = &arguments.actual;
    let set = ConformanceSet::read(folder)?;
    if !frames.is_dir() {
        return Err(Error::usage("frames of a conformance set are in a folder")
            .in_file(frames)
            .help("name the folder that has a folder or a picture for each case"));
    }
    if !set.cases.iter().any(|case| set.frame(case, frames).is_ok()) {
        return Err(Error::usage(format!("none of the {} cases has a frame here", set.cases.len()))
            .in_file(frames)
            .help(format!("the first is called `{}`, or `{0}.png`", set.cases[0].name)));
    }
    let (mut judged, mut inputs) = (Vec::new(), Vec::new());
    for case in &set.cases {
        judged.push(judged_case(arguments, &set, case, &mut inputs)?);
    }
    let names = (folder.display().to_string(), frames.display().to_string());
    Ok(Call::of(judged, Some(names), inputs))
}

/// A case. A bundle that is wrong ends the call; a frame that is missing or cannot be read fails its case.
fn judged_case(
    arguments: &Arguments,
    set: &ConformanceSet,
    case: &ConformanceCase,
    inputs: &mut Vec<PathBuf>,
) -> Result<Judged> {
    let bundle = set.bundle(case);
    let judge = Judge::read(&bundle)?;
    let found = set.frame(case, &arguments.actual).and_then(|frame| {
        let picture = Submitted::picture_in(&frame, judge.technique())?;
        Ok((frame, picture))
    });
    inputs.extend(judge.files());
    let submitted = found.and_then(|(frame, picture)| {
        inputs.push(picture.clone());
        Ok((judge.frame(&frame)?, picture))
    });
    let mut judged = match submitted {
        Ok((submitted, picture)) => {
            check_own(&judge, &picture)?;
            judged_frame(arguments, &judge, &bundle, submitted)?
        }
        Err(error) => {
            let (expected, actual) = (bundle.display().to_string(), arguments.actual.join(&case.name));
            let case = Case::unread(&expected, &actual.display().to_string(), &error);
            Judged { case, pictures: Pictures::default() }
        }
    };
    judged.case = judged.case.of_set(&case.name, &case.exposes);
    Ok(judged)
}
