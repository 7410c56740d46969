//! Figures that were made, and their files.

use super::figure::{Content, Figure, Panel, Scale};
use super::page::page;
use super::unmade::{UNMADE, Unmade};
use crate::error::{Error, Result};
use crate::output::{Batch, write_png};

/// The version of `figures.json`.
const SCHEMA: u32 = 1;

/// The page, in the folder of the figures.
pub const PAGE: &str = "figures.html";

/// A figure and its panels.
pub(super) struct Made {
    pub(super) figure: &'static Figure,
    pub(super) panels: Vec<Panel>,
}

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

impl Made {
    /// The name of a panel's file.
    fn file(&self, panel: usize) -> String {
        let ending = match self.panels[panel].content {
            Content::Picture(_) => "png",
            Content::Drawing(_) => "svg",
        };
        match self.panels.len() {
            1 => format!("{}.{ending}", self.figure.name),
            _ => format!("{}-{}.{ending}", self.figure.name, letter(panel)),
        }
    }
}

/// The letter of a panel: a, b, ...
pub(super) fn letter(panel: usize) -> char {
    u8::try_from(panel).map_or('z', |k| char::from(b'a' + k.min(25)))
}

/// The hash of what a panel shows: of a picture's pixels, of a drawing's text.
pub fn hash(panel: &Panel) -> String {
    match &panel.content {
        Content::Picture(picture) => picture.hash(),
        Content::Drawing(svg) => blake3::hash(svg.as_bytes()).to_hex().to_string(),
    }
}

fn json(made: &[Made], scale: Scale) -> Result<String> {
    let panel = |one: &Made, (k, panel): (usize, &'_ Panel)| (one.file(k), hash(panel));
    let figures = made.iter().map(|one| {
        let Figure { name, paper, number, title, caption, look_for, .. } = one.figure;
        let panels = one.panels.iter().enumerate().map(|(k, of)| {
            let (file, hash) = panel(one, (k, of));
            PanelRow { file, caption: &of.caption, hash }
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
