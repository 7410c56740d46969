//! The suite as text: a line a technique and machine.

use super::case::{Row, Verdict};
use super::figure::{Bound, Figure};
use super::suite::{CaseResult, Suite};
use std::fmt::Write;

impl Suite {
    /// A table a case, then how many rows passed.
    pub fn text(&self) -> String {
        let mut text = String::new();
        self.cases.iter().for_each(|result| {
            // Writing to a text does not fail.
            let _ = writeln!(text, "{}", table(result));
        });
        text + &self.counted() + "\n"
    }

    /// How many rows have each verdict.
    pub(super) fn counted(&self) -> String {
        let all = [Verdict::Pass, Verdict::Artifact, Verdict::Refused, Verdict::Fail];
        let rows = || self.cases.iter().flat_map(|result| &result.rows);
        let count = |verdict: Verdict| rows().filter(|row| row.verdict == verdict).count();
        let counted = all.map(|verdict| format!("{} {}", count(verdict), verdict.word())).join(", ");
        format!("{} cases, {} rows: {counted}", self.cases.len(), rows().count())
    }
}

fn table(result: &CaseResult) -> String {
    let case = &result.case;
    let mut text = format!("{} {}", case.number, case.title);
    if !case.reports.is_empty() {
        text += &format!(" ({})", case.reports);
    }
    text += &format!("\n  {}\n", case.answer);
    result.rows.iter().for_each(|row| text += &line(row));
    text
}

fn line(row: &Row) -> String {
    let mut text = format!("  {:20} {:10} {:15}", row.technique, row.machine, row.verdict.word());
    let figures: Vec<String> = row.figures.iter().map(told).collect();
    text += &figures.join(", ");
    if !row.settings.is_empty() {
        text += &format!("  [{}]", row.settings.join(" "));
    }
    if !row.note.is_empty() {
        text += &format!("\n  {:32}{}", "", row.note);
    }
    text.trim_end().to_owned() + "\n"
}

/// A figure with what it should be.
pub(super) fn told(figure: &Figure) -> String {
    let value = number(figure.value);
    match figure.bound {
        Bound::Told => format!("{} {value}", figure.name),
        Bound::AtMost(most) if figure.is_met() || most == 0.0 => format!("{} {value}", figure.name),
        Bound::AtMost(most) => format!("{} {value} > {}", figure.name, number(most)),
        Bound::AtLeast(least) if figure.is_met() => format!("{} {value} >= {}", figure.name, number(least)),
        Bound::AtLeast(least) => format!("{} {value} < {}", figure.name, number(least)),
    }
}

/// A number in at most four digits.
pub(super) fn number(value: f64) -> String {
    match value.abs() {
        size if size >= 1e6 || (size > 0.0 && size < 1e-3) => format!("{value:.2e}"),
        _ if value.fract() == 0.0 => format!("{value:.0}"),
        size if size >= 100.0 => format!("{value:.1}"),
        _ => format!("{value:.4}"),
    }
}
