//! The table of a scene's runs; a click on a column's head sorts by it.

use super::super::axis::{duration, short};
use super::super::{Run, SceneReport};
use crate::measure::Times;
use maud::{Markup, html};

const HEADS: [(&str, &str); 13] = [
    ("technique", ""),
    ("setting", "what differs from the scene's own settings"),
    ("on features", "root of the mean square error over the pixels that features touch"),
    ("rmse", "root of the mean square error of all channels"),
    ("mean", "mean error of all channels"),
    ("p99", "what 99 of 100 channels do not exceed"),
    ("max", "the largest error"),
    ("> 1/255", "share of pixels with a channel off by more than 1/255"),
    ("FLIP", "mean of FLIP against the truth's picture, for information"),
    ("frame", "median of the times of a frame; below it the shortest and the longest"),
    (
        "prepare",
        "median of the times to build what does not depend on the camera; point at one for the spread",
    ),
    ("memory", "bytes of the technique's structures"),
    ("counts", "what was counted"),
];

/// The table of all runs.
pub(super) fn table(scene: &SceneReport) -> Markup {
    html! {
        div.scroll {
            table.runs {
                thead { tr {
                    @for (k, (head, told)) in HEADS.iter().enumerate() {
                        th scope="col" class=[(k > 1).then_some("n")] title=(told) { button type="button" { (head) } }
                    }
                } }
                tbody { @for run in &scene.runs { (row(run)) } }
            }
        }
    }
}

fn row(run: &Run) -> Markup {
    let error = &run.error;
    html! {
        tr class=[run.on_front.then_some("front")] {
            td data-v=(run.technique) { (run.technique) @if run.on_front { span.dot title="on the Pareto front" { " ●" } } }
            td data-v=(run.varied.join(" ")) { @if run.varied.is_empty() { "—" } @else { (run.varied.join(" ")) } }
            @for value in [run.error_on_features.rmse, error.rmse, error.mean, error.p99, error.max] { (number(value, short(value))) }
            (number(error.over_one_code_value, format!("{} %", short(100.0 * error.over_one_code_value))))
            @match error.flip_mean {
                Some(mean) => { (number(mean, short(mean))) }
                None => { td.n data-v="-1" { "—" } }
            }
            (time(&run.frame_ms))
            (prepare(&run.prepare_ms))
            (number(run.structure_bytes as f64, size(run.structure_bytes)))
            td.n data-v=(run.counts.0.len()) { @if !run.counts.0.is_empty() {
                details {
                    summary { (run.counts.0.len()) }
                    dl { @for (name, count) in &run.counts.0 { dt { (name) } dd { (count.to_string()) } } }
                }
            } }
        }
    }
}

fn number(value: f64, words: String) -> Markup {
    html! { td.n data-v=(value) { (words) } }
}

fn time(times: &Times) -> Markup {
    html! {
        td.n data-v=(times.median) {
            (duration(times.median))
            @if times.max > times.min { small { (duration(times.min)) " – " (duration(times.max)) } }
        }
    }
}

/// The time of preparing; what the truth and supersampling have none of.
fn prepare(times: &Times) -> Markup {
    let spread = format!("{} to {}", duration(times.min), duration(times.max));
    html! { td.n data-v=(times.median) title=(spread) { @if times.max > 0.0 { (duration(times.median)) } @else { "—" } } }
}

/// Bytes in words.
pub(in super::super) fn size(bytes: usize) -> String {
    match bytes as f64 {
        b if b >= (1 << 20) as f64 => format!("{} MiB", short(b / (1 << 20) as f64)),
        b if b >= 1024.0 => format!("{} KiB", short(b / 1024.0)),
        b => format!("{b} B"),
    }
}
