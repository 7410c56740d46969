//! `figures.html`: all figures of a run, one page that needs no network.

use super::figure::{Content, Figure, Panel, Paper};
use super::made::{Made, letter};
use super::unmade::{UNMADE, Unmade};
use crate::error::{Error, Result};
use crate::output::document;
use crate::output::{base64, small_png};
use maud::{Markup, PreEscaped, html};

const STYLE: &str = include_str!("page.css");

/// The text of the page.
///
/// # Errors
/// Internal errors only.
pub(super) fn page(made: &[Made]) -> Result<String> {
    let of = |paper: Paper| made.iter().filter(move |one| one.figure.paper == paper);
    let papers: Vec<Paper> = Paper::ALL.into_iter().filter(|paper| of(*paper).next().is_some()).collect();
    let mut sections = Vec::new();
    for paper in &papers {
        let figures: Vec<Markup> = of(*paper).map(section).collect::<Result<_>>()?;
        sections.push(html! { h2 { (paper.title()) } @for figure in &figures { (figure) } });
    }
    let body = html! {
        body {
            header {
                h1 { "The papers' figures, made again" }
                p.lead {
                    "What the papers on vector data over terrain show, drawn by their own techniques as this program imitates them, on data "
                    "that is generated: landscapes are not the papers', what happens in them is. Drawings show the program's own structures. "
                    "The same bits on every machine."
                }
                nav aria-label="figures" { @for paper in &papers {
                    p { (paper.title()) }
                    ul { @for one in of(*paper) { li { a href={ "#" (one.figure.name) } { (one.figure.name) } } } }
                } }
            }
            @for section in &sections { (section) }
            @if !UNMADE.is_empty() { (unmade()) }
        }
    };
    Ok(document("The papers' figures, made again", STYLE, &body))
}

/// A figure.
fn section(made: &Made) -> Result<Markup> {
    let Figure { name, number, title, caption, look_for, .. } = made.figure;
    let mut panels = Vec::new();
    for (k, panel) in made.panels.iter().enumerate() {
        let letter = (made.panels.len() > 1).then(|| format!("({}) ", letter(k)));
        let shown = shown(panel)?;
        panels.push(html! {
            figure { (shown) figcaption { @if let Some(letter) = letter { strong { (letter) } } (panel.caption) } }
        });
    }
    Ok(html! {
        section.figure id=(name) {
            header { h3 { (title) } span { @if !number.is_empty() { (number) " · " } code { (name) } } }
            p { (caption) }
            p.look { strong { "Look for: " } (look_for) }
            div.panels { @for panel in &panels { (panel) } }
        }
    })
}

fn shown(panel: &Panel) -> Result<Markup> {
    Ok(match &panel.content {
        Content::Drawing(svg) => html! { (PreEscaped(svg)) },
        Content::Picture(picture) => {
            let png = small_png(picture)
                .map_err(|error| Error::internal(format!("figures.html: {error}")).caused_by(error))?;
            html! { img src={ "data:image/png;base64," (base64(&png)) } alt=(panel.caption) width=(picture.width()) height=(picture.height()); }
        }
    })
}

/// What is not made, and why.
fn unmade() -> Markup {
    html! {
        h2 { "Not made here" }
        section.figure { table {
            thead { tr { th { "paper" } th { "figures" } th { "why, or where instead" } } }
            tbody { @for Unmade { paper, number, what, why } in UNMADE {
                tr { td { (paper.name()) } td { (number) ": " (what) } td { (why) } }
            } }
        } }
    }
}
