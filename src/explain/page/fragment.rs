//! A pixel's part of a page.

use super::super::account::{Account, ByTechnique, Rung, Step, color_of, hex};
use super::super::text::{covered, distance, notes, right};
use super::drawing::{bars, color_of_item, drawn_items, plan, screen, swatch};
use crate::error::Result;
use maud::{Markup, html};

/// Steps of a technique that are shown.
const MOST_STEPS: usize = 80;

/// All that is told of a pixel.
///
/// # Errors
/// Internal errors only.
pub(super) fn fragment(account: &Account) -> Result<Markup> {
    let [x, y] = account.pixel;
    Ok(html! {
        article.pixel data-shown=(worst(account)) {
            h2 { "Pixel " (x) "," (y) }
            p.right { (swatch(account.truth.estimate)) "right: " (right(&account.truth)) }
            (sight(account))
            @if let Some(feature) = &account.feature {
                section.feature {
                    h3 { "“" (feature.asked) "” " (if feature.shows { "shows here" } else { "does not show here" }) }
                    ul { @for reason in &feature.reasons { li { (reason) } } }
                }
            }
            (tabs(account))
            div.views {
                figure { (screen(account)?) figcaption { "On the screen: the pixel, half a pixel around it, as the truth composes each point." } }
                figure { @if let Some(plan) = plan(account) { (plan) } figcaption { "The same in the plan, north up." } }
            }
            (key(account))
            (bars(account))
            div.columns { (ladder(&account.ladder)) (covering(account)) }
            @for by in &account.techniques { (technique(account, by)) }
            @for left_out in &account.left_out { p.note { (left_out.technique) " is left out: " (left_out.reason) "." } }
        }
    })
}

/// The technique that is farthest from the truth.
fn worst(account: &Account) -> &'static str {
    let worst = account.techniques.iter().max_by(|a, b| a.error.total_cmp(&b.error));
    worst.map_or("", |by| by.technique)
}

/// What the centre sees, in lines.
fn sight(account: &Account) -> Markup {
    let ([a, b, c], [u, v, w]) = (account.ray.from, account.ray.direction);
    html! {
        p.note { "Line of sight from " (format!("({a:.1}, {b:.1}, {c:.1})")) " along " (format!("({u:.4}, {v:.4}, {w:.4})")) ". "
            @match &account.centre {
                Some(centre) => {
                    "Its centre sees triangle " (centre.triangle) " at " (format!("({:.3}, {:.3})", centre.plan[0], centre.plan[1]))
                    ", " (format!("{:.1}", centre.depth)) " m deep."
                    @for margin in &centre.margins { " It is " (margin.text()) "." }
                    @if let Some(edge) = &centre.silhouette { " " (capital(&edge.text())) "." }
                }
                None => "Its centre sees the sky.",
            }
        }
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// The techniques, to choose one; numbered as bars have them.
fn tabs(account: &Account) -> Markup {
    html! {
        div.tabs role="group" aria-label="which technique" {
            @for (k, by) in account.techniques.iter().enumerate() {
                button type="button" data-of=(by.technique) aria-pressed=(by.technique == worst(account)) {
                    (swatch(color_of(by.code))) (k + 1) " " (by.technique) " " small { (distance(by.error)) }
                }
            }
        }
    }
}

/// Which item is drawn in which colour.
fn key(account: &Account) -> Markup {
    html! {
        ul.key {
            li { span.line style="--c:#fff;outline:1px solid #888" {} "triangles" }
            @for item in drawn_items(account) {
                li { span.line style=(format!("--c:{}", color_of_item(account, item))) {} "item " (item) ": " (account.items.get(&item).map_or("", String::as_str)) }
            }
            li { span.dot {} "what the technique looked at" }
        }
    }
}

/// The composition, the topmost first.
fn ladder(rungs: &[Rung]) -> Markup {
    html! {
        table.ladder {
            caption { "At its centre, the topmost first" }
            thead { tr { th scope="col" { "what" } th scope="col" { "its colour" } th scope="col" { "with it" } } }
            tbody {
                @for rung in rungs.iter().rev() {
                    tr { td { (rung.name) } td { (swatch(rung.color)) code { (hex(rung.color)) } } td { (swatch(rung.after)) code { (hex(rung.after)) } } }
                }
            }
        }
    }
}

/// What covers the pixel.
fn covering(account: &Account) -> Markup {
    html! {
        div {
            h3 { "What covers it, the topmost first" }
            @if account.covering.is_empty() { p.note { "Nothing but the ground or the sky." } }
            ul.covering { @for covering in account.covering.iter().rev() { li { (swatch(covering.color)) (covered(covering)) } } }
        }
    }
}

/// What a technique did.
fn technique(account: &Account, by: &ByTechnique) -> Markup {
    html! {
        section.technique data-of=(by.technique) hidden[by.technique != worst(account)] {
            h3 { (by.technique) ": " (swatch(color_of(by.code))) (hex(color_of(by.code))) ", " (distance(by.error)) }
            p.note { (by.paper) " The sections in the first column are its." }
            div.scroll {
                table.steps {
                    tbody { @for step in by.steps.iter().take(MOST_STEPS) { (told(step)) } }
                }
            }
            @if by.steps.len() > MOST_STEPS {
                p.note { "And " (by.steps.len() - MOST_STEPS) " more steps, which the command tells as text." }
            }
            @if !by.tried.is_empty() {
                h4 { "With other settings" }
                ul {
                    @for tried in &by.tried {
                        li { (swatch(color_of(tried.code))) code { (tried.changes.join(" ")) } ": " (distance(tried.error)) }
                    }
                }
            }
        }
    }
}

fn told(step: &Step) -> Markup {
    html! {
        tr {
            td.section { (step.section) }
            td { (step.text) @for note in notes(step) { small { (note) } } }
        }
    }
}
