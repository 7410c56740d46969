//! The frame of a page: one file that needs no network.

use maud::{DOCTYPE, Markup, PreEscaped, html};

/// The text of a page, `body` with its element.
pub fn document(title: &str, style: &str, body: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { (title) }
                style { (PreEscaped(style)) }
            }
            (body)
        }
    };
    page.into_string() + "\n"
}
