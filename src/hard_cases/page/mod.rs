//! The suite as one page that needs no network.

mod plot;

use super::case::{Row, Verdict};
use super::suite::{CaseResult, Suite};
use super::text::told;
use crate::buffer::Buffer;
use crate::error::{Error, Result};
use crate::output::document;
use crate::output::{base64, small_png};
use maud::{Markup, html};

const STYLE: &str = include_str!("style.css");

impl Suite {
    /// The text of `hard-cases.html`.
    ///
    /// # Errors
    /// Internal errors only.
    pub fn page(&self) -> Result<String> {
        let cases = self.cases.iter().map(section).collect::<Result<Vec<Markup>>>()?;
        let body = html! {
            body {
                header {
                    h1 { "Hard cases" }
                    p.lead {
                        "Failures that users of real systems reported, as scenes with a known right answer: by the truth and by each technique that "
                        "they concern, as exact mathematics (f64) and on imitated machines. Features are white on black, so that a pixel is as bright as it is covered."
                    }
                    p.facts { (self.counted()) "." }
                    (contents(&self.cases))
                }
                @for case in &cases { (case) }
                @if !self.curves.is_empty() { (plot::section(&self.curves)) }
            }
        };
        Ok(document("Hard cases", STYLE, &body))
    }
}

/// Links to all cases, each marked by the worst verdict in it.
fn contents(cases: &[CaseResult]) -> Markup {
    html! {
        nav aria-label="cases" {
            @for result in cases {
                @let worst = worst(&result.rows);
                a class=(class(worst)) href={ "#case-" (result.case.number) } title={ (result.case.title) ": " (worst.word()) } {
                    (result.case.number) (sign(worst))
                }
            }
        }
    }
}

fn worst(rows: &[Row]) -> Verdict {
    let order = [Verdict::Fail, Verdict::Artifact, Verdict::Pass];
    let found = order.into_iter().find(|verdict| rows.iter().any(|row| row.verdict == *verdict));
    found.unwrap_or(Verdict::Refused)
}

fn class(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "pass",
        Verdict::Artifact => "artifact",
        Verdict::Refused => "refused",
        Verdict::Fail => "fail",
    }
}

/// A sign beside the colour.
fn sign(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "",
        Verdict::Artifact => " ◐",
        Verdict::Refused => " –",
        Verdict::Fail => " ✕",
    }
}

fn section(result: &CaseResult) -> Result<Markup> {
    let case = &result.case;
    let pictures = result.pictures.iter().map(|(name, picture)| figure(name, picture));
    let pictures = pictures.collect::<Result<Vec<Markup>>>()?;
    Ok(html! {
        section id={ "case-" (case.number) } {
            h2 { (case.number) ". " (case.title) }
            @if !case.reports.is_empty() { p.facts { "Reported: " (case.reports) } }
            p { (case.answer) }
            div.pictures { @for picture in &pictures { (picture) } }
            div.scroll {
                table {
                    thead { tr { th { "who" } th { "machine" } th { "verdict" } th { "found" } } }
                    tbody { @for row in &result.rows { (line(row)) } }
                }
            }
        }
    })
}

fn figure(name: &str, picture: &Buffer<[u8; 4]>) -> Result<Markup> {
    let png = small_png(picture);
    let png =
        png.map_err(|error| Error::internal(format!("a picture of {name}: {error}")).caused_by(error))?;
    Ok(html! {
        figure {
            img src={ "data:image/png;base64," (base64(&png)) } alt={ "by " (name) } width=(picture.width()) height=(picture.height());
            figcaption { (name) }
        }
    })
}

fn line(row: &Row) -> Markup {
    html! {
        tr {
            td {
                (row.technique)
                @for setting in row.settings { small { (setting) } }
            }
            td { (row.machine) }
            td { span class={ "verdict " (class(row.verdict)) } { (row.verdict.word()) (sign(row.verdict)) } }
            td {
                @for figure in &row.figures {
                    span class=(if figure.is_met() { "figure" } else { "figure unmet" }) { (told(figure)) }
                }
                @if !row.note.is_empty() { small { (row.note) } }
            }
        }
    }
}
