//! The files of a run: panels, the page, the index.

use super::figure::{Content, Figure, Scale};
use super::made::{Made, hash};
use super::page::page;
use super::unmade::{UNMADE, Unmade};
use crate::error::{Error, Result};
use crate::output::{Batch, write_png};

/// The version of `figures.json`.
const SCHEMA: u32 = 1;

/// The page, in the folder of the figures.
pub const PAGE: &str = "figures.html";

#[derive(serde::Serialize)]
struct Index<'a> {
    schema: u32,
    scale: Scale,
    figures: Vec<FigureRow<'a>>,
    unmade: Vec<UnmadeRow<'a>>,
}

#[derive(serde::Serialize)]
struct FigureRow<'a> {
    name: &'a str,
    paper: &'a str,
    number: &'a str,
    title: &'a str,
    caption: &'a str,
    look_for: &'a str,
    panels: Vec<PanelRow<'a>>,
}

#[derive(serde::Serialize)]
struct PanelRow<'a> {
    file: String,
    caption: &'a str,
    hash: String,
}

#[derive(serde::Serialize)]
struct UnmadeRow<'a> {
    paper: &'a str,
    number: &'a str,
    what: &'a str,
    why: &'a str,
}

/// Makes figures and writes `NAME.png` or `NAME.svg` of each panel (`NAME-a` and so on where there are several), `figures.html` ([`PAGE`]) and
/// `figures.json`; they are in their places when it returns. `telling` is called with the name of each figure before it is made, and the share that
/// is done.
///
/// # Errors
/// When a file cannot be written: then none is.
pub fn write(
    figures: &[&'static Figure],
    scale: Scale,
    mut batch: Batch,
    telling: &dyn Fn(&str, f64),
) -> Result<()> {
    let mut made = Vec::new();
    for (k, figure) in figures.iter().enumerate() {
        telling(figure.name, k as f64 / figures.len() as f64);
        let panels = figure
            .panels(scale)
            .map_err(|error| error.reworded(|what| format!("{}: {what}", figure.name)))?;
        made.push(Made { figure, panels });
    }
    for one in &made {
        for (k, panel) in one.panels.iter().enumerate() {
            batch.stage(&one.file(k), |to| match &panel.content {
                Content::Picture(picture) => write_png(picture, to),
                Content::Drawing(svg) => to.write_all(svg.as_bytes()),
            })?;
        }
    }
    let page = page(&made)?;
    batch.stage(PAGE, |to| to.write_all(page.as_bytes()))?;
    let json = json(&made, scale)?;
    batch.stage("figures.json", |to| to.write_all(json.as_bytes()))?;
    batch.commit()
}

fn json(made: &[Made], scale: Scale) -> Result<String> {
    let figures = made.iter().map(|one| {
        let Figure { name, paper, number, title, caption, look_for, .. } = one.figure;
        let panels = one.panels.iter().enumerate().map(|(k, panel)| PanelRow {
            file: one.file(k),
            caption: &panel.caption,
            hash: hash(panel),
        });
        FigureRow { name, paper: paper.title(), number, title, caption, look_for, panels: panels.collect() }
    });
    let unmade = UNMADE.iter().map(|Unmade { paper, number, what, why }| UnmadeRow {
        paper: paper.title(),
        number,
        what,
        why,
    });
    let index = Index { schema: SCHEMA, scale, figures: figures.collect(), unmade: unmade.collect() };
    let text = serde_json::to_string_pretty(&index);
    Ok(text.map_err(|error| Error::internal(format!("figures.json: {error}")).caused_by(error))? + "\n")
}
