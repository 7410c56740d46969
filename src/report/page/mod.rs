//! `report.html`: one page that needs no network.

mod rows;

use super::plot::{self, View};
use super::{Exhibit, Metric, Report, SceneReport, exhibit};
use crate::error::Result;
use crate::output::base64;
use crate::output::document;
use maud::{Markup, PreEscaped, html};
pub(super) use rows::size;
use rows::table;

/// How pages of reports look.
pub(super) const STYLE: &str = include_str!("style.css");
const SCRIPT: &str = include_str!("script.js");

/// The bytes of PNG files that a page carries at most: a third more as text.
const MOST_BYTES: usize = 14 << 20;

/// A scene's part of the page.
#[derive(Debug)]
pub struct Section<'a> {
    /// The numbers.
    pub scene: &'a SceneReport,
    /// The pictures, the most important first.
    pub exhibits: &'a [Exhibit],
    /// The files of the plots, in the order of [`View::all`].
    pub plots: &'a [String],
}

/// The text of the page.
///
/// # Errors
/// Internal errors only.
pub fn page(report: &Report, sections: &[Section]) -> Result<String> {
    let scale = exhibit::scale()?;
    let (share, mut room) = (MOST_BYTES / sections.len().max(1), 0);
    let body = html! {
        body {
            header {
                h1 { "Speed against error" }
                p.lead {
                    "Every technique over its settings, measured against the certified truth. Error is the distance of a "
                    "channel (0 to 1) from the interval that provably holds the right value; 0 inside it. "
                    @if report.repeat == 1 { "Times are of one run." }
                    @else { "Times are medians of " (report.repeat) " runs, with the shortest and the longest." }
                }
            }
            @for section in sections { (section.markup(&mut room, share, &scale)) }
            (footer())
            script { (PreEscaped(SCRIPT)) }
        }
    };
    Ok(document(&format!("Speed against error: {}", names(report)), STYLE, &body))
}

fn names(report: &Report) -> String {
    let names: Vec<&str> = report.scenes.iter().map(|scene| scene.scene.name.as_str()).collect();
    names.join(", ")
}

impl Section<'_> {
    /// A scene; `room` is what the scenes before it left of their bytes of pictures, `share` its own.
    fn markup(&self, room: &mut usize, share: usize, scale: &[u8]) -> Markup {
        *room += share;
        let (scene, mut shown, mut left_out) = (self.scene, Vec::new(), Vec::new());
        for exhibit in self.exhibits {
            match room.checked_sub(exhibit.bytes()) {
                Some(rest) => (*room, _) = (rest, shown.push(exhibit)),
                None => left_out.push(exhibit.name.as_str()),
            }
        }
        html! {
            section.scene {
                h2 { (scene.scene.name) }
                (facts(scene))
                @if scene.feature_pixels > 0 {
                    (self.plots())
                    h3 { "Runs" }
                    (table(scene))
                }
                @if !shown.is_empty() {
                    h3 { "Two pictures, one over the other" }
                    (slider())
                    h3 { "Pictures and where they are wrong" }
                    (legend(scale))
                    div.gallery { @for exhibit in &shown { (figures(exhibit)) } }
                }
                @if !left_out.is_empty() {
                    p.note { "Left out to keep the page small: " (left_out.join(", ")) "." }
                }
            }
        }
    }

    /// All plots, the first to be seen first.
    fn plots(&self) -> Markup {
        html! {
            div.plots {
                (buttons("which error", &Metric::ALL.map(Metric::word)))
                (buttons("which runs", &["only techniques", "all runs"]))
                @for (k, (view, file)) in View::all().zip(self.plots).enumerate() {
                    figure.plotted hidden[k > 0] {
                        (PreEscaped(plot::svg(self.scene, view)))
                        figcaption {
                            "Down and left is better. Point at a mark for its numbers. As a file: " a href=(file) { (file) }
                        }
                    }
                }
            }
        }
    }
}

/// Buttons of which one is pressed, first the first.
fn buttons(what: &str, words: &[&str]) -> Markup {
    html! {
        div.tabs role="group" aria-label=(what) {
            @for (k, word) in words.iter().enumerate() {
                button type="button" aria-pressed=(k == 0) { (word) }
            }
        }
    }
}

/// What the scene is.
fn facts(scene: &SceneReport) -> Markup {
    html! {
        p.facts {
            (scene.width) " × " (scene.height) " pixels · " (scene.scene.plan_space)
            " · " (scene.feature_pixels) " of them touched by features · widest interval of the truth " (super::axis::short(scene.reference_width_max))
            @if let Some(error) = &scene.scene.surface_error {
                " · the terrain up to " (super::axis::short(error.metres)) " m, " (super::axis::short(error.pixels)) " pixels from the full surface"
            }
            " · scene " code { (scene.scene.hash.get(..12).unwrap_or(&scene.scene.hash)) }
        }
        @for note in &scene.notes { p.note { (note) } }
    }
}

/// The two pictures of the slider; the script puts them in.
fn slider() -> Markup {
    html! {
        div.compare {
            div.controls {
                label { "left " select.left {} }
                label { "right " select.right {} }
                label { "size " select.zoom {
                    option value="0" { "fit" }
                    option value="1" { "1 : 1" }
                    option value="2" { "2 : 1" }
                    option value="4" { "4 : 1" }
                    option value="8" { "8 : 1" }
                } }
            }
            div.frame {
                div.view { div.stage {
                    img.a alt="";
                    img.b alt="";
                    div.edge {}
                } }
                input type="range" min="0" max="1000" value="500" aria-label="border between the two pictures";
            }
        }
    }
}

/// The scale of all heat maps.
fn legend(scale: &[u8]) -> Markup {
    let place = |distance: f64| 100.0 * (1.0 + crate::math::ln(distance) / crate::math::ln(65535.0));
    let marks =
        [(1e-4, "0.0001"), (1e-3, "0.001"), (1.0 / 255.0, "1/255"), (1e-2, "0.01"), (0.1, "0.1"), (1.0, "1")];
    html! {
        div.scale {
            img src={ "data:image/png;base64," (base64(scale)) } alt="colours from small to large errors";
            div.marks {
                @for (distance, word) in marks {
                    span style={ "left:" (format!("{:.2}", place(distance))) "%" } { (word) }
                }
            }
        }
        p.note {
            "Heat maps, all on this scale: black is inside the truth's interval, blue is off by no more than one 8-bit code value, yellow to pink by more."
        }
    }
}

fn figures(exhibit: &Exhibit) -> Markup {
    let source = |png: &[u8]| format!("data:image/png;base64,{}", base64(png));
    html! {
        figure.exhibit {
            div.pair {
                img src=(source(&exhibit.picture)) alt=(exhibit.name);
                img src=(source(&exhibit.heat_map)) alt={ (exhibit.name) ": heat map" };
            }
            figcaption { strong { (exhibit.name) } " · " (exhibit.caption) }
        }
    }
}

fn footer() -> Markup {
    html! {
        footer {
            h3 { "How to read it" }
            dl {
                dt { "truth" }
                dd { "The certified intervals. As a run, its error is half the width of each interval: what its estimate may be off at most. Where it is wide, the errors of others are the least that they can be." }
                dt { "supersampling" }
                dd { "The mean of n × n point samples a pixel: the plain competitor of the truth. Its error, like the truth's, is of values before they are rounded." }
                dt { "on features" }
                dd { "The root mean square over the pixels that features touch. Over the whole picture it is the edges of the ground's own shading that may weigh most, of which a technique takes one sample a pixel." }
                dt { "techniques" }
                dd { "Their errors are of 8-bit code values; rounding alone moves a channel by up to half a code value (1/510)." }
                dt { "Pareto front" }
                dd { "The runs that no other beats in both time and error. In the table, ● is the front of frame time and root mean square error." }
                dt { "prepare, frame" }
                dd { "Prepare builds what does not depend on the camera; a frame is all the rest. The truth and supersampling do everything in the frame." }
                dt { "FLIP" }
                dd { "What a viewer sees who flips between the picture and the truth's (Andersson et al. 2020): for information." }
            }
        }
    }
}
