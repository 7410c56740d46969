//! A picture by another, or by two that it has to lie between.

use super::arguments::Arguments;
use super::files::{is_one_file, mask, read, twice};
use super::judged::{Call, Judged, Pictures};
use drapery::compare::{Expected, Limits, Report, Verdict};
use drapery::{Error, Result};
use std::path::{Path, PathBuf};

pub(super) fn judged(arguments: &Arguments) -> Result<Call> {
    let Arguments { actual, lo, hi, expected, ignore, .. } = arguments;
    let ends: Vec<&PathBuf> = [expected, lo, hi].into_iter().flatten().collect();
    for end in &ends {
        if is_one_file(end, actual)? {
            return Err(twice(end, actual));
        }
    }
    let picture = read(actual)?;
    let wanted = expectation(&ends)?;
    let size = (wanted.lo().width(), wanted.lo().height());
    let limits = limits(arguments, size.0 * size.1)?;
    let mask = mask(ignore.as_deref(), size)?;
    // Where the sizes differ, that is the verdict.
    let mask = mask.filter(|_| size == (picture.width(), picture.height()));
    let verdict = match &mask {
        Some(ignored) => Verdict::on(&picture.clone().without(ignored), &wanted.ignoring(ignored), limits),
        None => Verdict::on(&picture, &wanted, limits),
    };
    let name = ends.iter().map(|end| end.display().to_string()).collect::<Vec<_>>().join(" to ");
    let report = Report { expected: &name, actual: &actual.display().to_string(), verdict: &verdict };
    let mut pictures = Pictures::default();
    if arguments.shows() {
        pictures = Pictures { heat: verdict.heat_map(), both: Some((wanted.lo().clone(), picture)) };
    }
    let judged = Judged { case: report.case(), pictures };
    let inputs = ends.into_iter().chain([actual]).chain(ignore).cloned().collect();
    Ok(Call::of(vec![judged], None, inputs))
}

/// What is expected.
fn expectation(ends: &[&PathBuf]) -> Result<Expected> {
    match ends {
        [lo, hi] => Expected::between(read(lo)?, read(hi)?).map_err(|error| error.in_file(hi)),
        ends => {
            let path: &Path = ends.first().map_or(Path::new("-"), |path| path);
            Ok(Expected::exactly(read(path)?))
        }
    }
}

fn limits(arguments: &Arguments, pixels: usize) -> Result<Limits> {
    if arguments.strict {
        return Err(Error::usage("--strict is of bundles").help("pictures alone never pass weakly"));
    }
    let allow = arguments.allow.map_or(0, |allow| allow.of(pixels));
    let limits = Limits::new(arguments.tolerance.unwrap_or(0.0), allow)?;
    let limits = limits.with_relative(arguments.relative.unwrap_or(0.0))?;
    Ok(arguments.densest.map_or(limits, |densest| limits.with_densest(densest)))
}
