//! The pages from their first line to their last.

use super::super::account::Account;
use super::super::interesting::Interesting;
use super::drawing::data_url;
use super::fragment::fragment;
use crate::error::{Error, Result};
use crate::output::document;
use crate::output::small_png;
use maud::{Markup, PreEscaped, html};

const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("script.js");

/// The bytes of pictures that a page carries at most, as PNG.
const MOST_BYTES: usize = 12 << 20;

/// The page of one pixel of a scene.
///
/// # Errors
/// Internal errors only.
pub fn of_pixel(scene: &str, account: &Account) -> Result<String> {
    let [x, y] = account.pixel;
    let body = fragment(account)?;
    Ok(page(&format!("{scene}: pixel {x},{y}"), html! { main { (body) } }, false))
}

/// The page of a whole picture, in which one chooses among the pixels that were looked at.
///
/// # Errors
/// Internal errors only.
pub fn of_picture(scene: &str, interesting: &Interesting) -> Result<String> {
    let mut fragments = Vec::new();
    for account in &interesting.accounts {
        let [x, y] = account.pixel;
        fragments.push(serde_json::json!({ "x": x, "y": y, "html": fragment(account)?.into_string() }));
    }
    let data = serde_json::to_string(&fragments)
        .map_err(|error| Error::internal("accounts are no JSON").caused_by(error))?;
    let body = html! {
        header {
            h1 { (scene) }
            p.lead {
                "Why does a pixel have its colour? Click into the picture: the nearest of " (fragments.len())
                " pixels that were looked at is explained. They are those where a technique is farthest from the truth, or where the truth itself is wide, "
                "for each technique at most one of each square of " (interesting.square) " x " (interesting.square) " pixels. Arrow keys go to the next one in "
                "that direction, " kbd { "n" } " and " kbd { "p" } " through all: each technique's worst in turn."
            }
        }
        main.whole {
            (pictures(interesting)?)
            div #told aria-live="polite" {}
        }
        // A text that is not run, in which nothing ends the element.
        script #data type="application/json" { (PreEscaped(data.replace("</", "<\\/"))) }
    };
    Ok(page(&format!("Why? {scene}"), body, true))
}

/// The pictures, one over the other, and buttons to choose one.
fn pictures(interesting: &Interesting) -> Result<Markup> {
    let mut room = MOST_BYTES;
    let (mut shown, mut left_out) = (Vec::new(), Vec::new());
    for (name, picture) in &interesting.pictures {
        let png =
            small_png(picture).map_err(|error| Error::internal("a picture is no PNG").caused_by(error))?;
        match room.checked_sub(png.len()) {
            Some(rest) => (room, _) = (rest, shown.push((name, data_url(&png)))),
            None => left_out.push(name.as_str()),
        }
    }
    let [width, height] = interesting.size;
    Ok(html! {
        section.picture {
            div.tabs role="group" aria-label="which picture" {
                @for (k, (name, _)) in shown.iter().enumerate() {
                    button type="button" data-picture=(k) aria-pressed=(k == 0) { (name) }
                }
            }
            div #stage tabindex="0" role="application" aria-label="the picture: arrow keys choose a pixel" data-width=(width) data-height=(height) {
                @for (k, (name, url)) in shown.iter().enumerate() { img src=(url) alt=(name) hidden[k > 0] width=(width) height=(height); }
                span #mark hidden {}
            }
            @if !left_out.is_empty() { p.note { "Left out to keep the page small: " (left_out.join(", ")) "." } }
        }
    })
}

fn page(title: &str, body: Markup, is_wide: bool) -> String {
    let body = html! { body.wide[is_wide] { (body) script { (PreEscaped(SCRIPT)) } } };
    document(title, STYLE, &body)
}
