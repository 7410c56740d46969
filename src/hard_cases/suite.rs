//! All cases, drawn by all whom they concern.

use super::case::{Case, Row, Verdict};
use super::figure::Figure;
use super::hand::{Hand, Truths, Who, certified};
use super::machine::F64;
use super::setup::Setup;
use super::stability::Curve;
use super::{camera, polygons, precision, real_files, strokes, surface, tiles};
use crate::buffer::Buffer;
use crate::error::{Error, ErrorKind, Result};
use crate::parallel;
use crate::technique::{FrameOptions, Kind};
use crate::truth;

/// What is asked for.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Plan {
    /// The numbers of the cases; none: all.
    pub only: Vec<u32>,
    /// Whether no machine is imitated: exact mathematics alone.
    pub is_quick: bool,
}

/// A picture, and by whom.
pub type Shown = (&'static str, Buffer<[u8; 4]>);

/// A case and how all did.
#[derive(Debug)]
pub struct CaseResult {
    /// The case.
    pub case: Case,
    /// A row a technique, machine and setting; the truth first.
    pub rows: Vec<Row>,
    /// Its scene by the truth and by each technique that draws it.
    pub pictures: Vec<Shown>,
}

/// The suite.
#[derive(Debug)]
pub struct Suite {
    /// The cases in the order of their numbers.
    pub cases: Vec<CaseResult>,
    /// How errors grow.
    pub curves: Vec<Curve>,
}

/// Every case, in the order of their numbers.
pub fn cases() -> Vec<Case> {
    let chapters = [
        camera::CASES,
        surface::CASES,
        precision::CASES,
        strokes::CASES,
        tiles::CASES,
        polygons::CASES,
        real_files::CASES,
    ];
    let mut all = chapters.concat();
    all.sort_by_key(|case| case.number);
    all
}

/// Draws the cases that are asked for. `progress` is told the share that is done (0..=1), from any thread.
///
/// # Errors
/// When there is no case of a number, or a case's own scene is wrong (a bug of ours).
pub fn run(plan: &Plan, progress: &(dyn Fn(f64) + Sync)) -> Result<Vec<CaseResult>> {
    let all = cases();
    if let Some(unknown) = plan.only.iter().find(|number| all.iter().all(|case| case.number != **number)) {
        let last = all.last().map_or(0, |case| case.number);
        return Err(Error::usage(format!("there is no hard case {unknown}"))
            .help(format!("cases are numbered from 1 to {last}")));
    }
    let wanted: Vec<Case> =
        all.into_iter().filter(|case| plan.only.is_empty() || plan.only.contains(&case.number)).collect();
    parallel::map_telling(wanted.len(), progress, |k| result(wanted[k], plan.is_quick)).into_iter().collect()
}

/// A case, drawn by all whom it concerns.
fn result(case: Case, is_quick: bool) -> Result<CaseResult> {
    let truths = Truths::default();
    let hand = |who, machine, settings| Hand { who, machine, settings, truths: &truths };
    let mut rows = vec![row(&case, &hand(Who::Truth, F64, &[]))?];
    for kind in case.concerns {
        for machine in case.machines.iter().filter(|machine| !is_quick || **machine == F64) {
            let row = row(&case, &hand(Who::Technique(*kind), *machine, &[]))?;
            // What refuses a scene does so on any machine.
            let is_refused = row.verdict == Verdict::Refused;
            rows.push(if is_refused { Row { machine: "any", ..row } } else { row });
            if is_refused {
                break;
            }
        }
        for variant in case.variants.iter().filter(|variant| variant.kind == *kind) {
            let row = row(&case, &hand(Who::Technique(*kind), F64, variant.keys))?;
            rows.push(Row { settings: variant.keys, ..excused(row, variant.says) });
        }
    }
    Ok(CaseResult { pictures: pictures(&case, &truths)?, case, rows })
}

/// A technique on a machine.
fn row(case: &Case, hand: &Hand) -> Result<Row> {
    let technique = hand.kind().map_or(truth::NAME, Kind::name);
    let row = |figures, verdict, note| Row {
        technique,
        machine: hand.machine.name,
        settings: &[],
        figures,
        verdict,
        note,
    };
    let figures = match (case.measure)(hand) {
        Ok(figures) => figures,
        Err(error) if error.kind() == ErrorKind::Unsupported => {
            return Ok(row(Vec::new(), Verdict::Refused, error.what().to_owned()));
        }
        Err(error) => {
            let number = case.number;
            return Err(error.reworded(|what| format!("hard case {number}, {technique}: {what}")));
        }
    };
    let verdict = if figures.iter().all(Figure::is_met) { Verdict::Pass } else { Verdict::Fail };
    let says = hand
        .kind()
        .filter(|_| hand.settings.is_empty())
        .and_then(|kind| case.artifact_of(kind, hand.machine));
    Ok(excused(row(figures, verdict, String::new()), says))
}

/// A row that fails as a paper says is that of a known artifact.
fn excused(row: Row, says: Option<&str>) -> Row {
    match says {
        Some(says) if row.verdict == Verdict::Fail => {
            Row { verdict: Verdict::Artifact, note: says.to_owned(), ..row }
        }
        _ => row,
    }
}

/// The case's scene by the truth and the techniques that draw it, in exact mathematics.
fn pictures(case: &Case, truths: &Truths) -> Result<Vec<Shown>> {
    let setup: Setup = (case.shown)();
    let mut pictures = vec![(truth::NAME, certified(&setup, &[])?.image())];
    for kind in case.concerns {
        let hand = Hand { who: Who::Technique(*kind), machine: F64, settings: &[], truths };
        if let Ok(frame) = hand.frame(&setup, &[], &FrameOptions::default()) {
            pictures.push((kind.name(), frame.image));
        }
    }
    Ok(pictures)
}

impl Suite {
    /// The rows that fail, with the numbers of their cases.
    pub fn failed(&self) -> impl Iterator<Item = (u32, &Row)> {
        let of = |result: &'_ CaseResult| result.case.number;
        self.cases.iter().flat_map(move |result| {
            let failed = result.rows.iter().filter(|row| row.verdict == Verdict::Fail);
            failed.map(move |row| (of(result), row))
        })
    }
}
