//! The plot of speed against error, as SVG: crisp at any size, light or dark as the reader's screen is.

mod axes;
mod labels;
mod series;

use super::axis::{LogAxis, duration, short};
use super::{Metric, Run, SUPERSAMPLING, SceneReport, TRUTH};
use axes::{Axes, FIELD, fixed, polyline};
use labels::{legend, legend_bottom, tags};
use maud::{Markup, PreEscaped, html};
use series::series;

const WIDTH: f64 = 1040.0;
const HEIGHT: f64 = 560.0;
/// The room that a word of an axis takes along it.
const TIME_WORD: f64 = 58.0;
const ERROR_WORD: f64 = 19.0;
/// How rounding to 8-bit code values alone can move a channel.
const ROUNDING: f64 = 1.0 / 510.0;

/// What is written at that line.
const LIMIT: &str = "half an 8-bit code value";

/// Colours that people who do not tell red from green tell apart (M. Okabe and K. Ito, *Color Universal Design*, 2008), for light and dark.
const STYLE: &str = include_str!("style.css");

/// Which plot of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct View {
    /// What the upright axis shows.
    pub metric: Metric,
    /// Which runs are shown.
    pub scope: Scope,
}

/// Which runs a plot shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scope {
    /// All.
    All,
    /// Without the truth and supersampling, whose slow frames press the others together.
    Techniques,
}

impl Scope {
    /// Both, the one that is shown first at the front.
    pub const ALL: [Self; 2] = [Self::Techniques, Self::All];
}

impl View {
    /// Every plot of a scene, the one that is shown first at the front.
    pub fn all() -> impl Iterator<Item = Self> {
        let of = |scope| Metric::ALL.into_iter().map(move |metric| Self { metric, scope });
        Scope::ALL.into_iter().flat_map(of)
    }

    /// A short name, for files.
    pub fn name(self) -> String {
        match self.scope {
            Scope::All => self.metric.name().to_owned(),
            Scope::Techniques => format!("{}-techniques", self.metric.name()),
        }
    }

    fn shows(self, run: &Run) -> bool {
        self.scope == Scope::All || (run.technique != TRUTH && run.technique != SUPERSAMPLING)
    }
}

/// A plot of a scene's runs: a whole SVG document, which may stand in a page as it is.
pub fn svg(scene: &SceneReport, view: View) -> String {
    let metric = view.metric;
    let runs: Vec<&Run> = scene.runs.iter().filter(|run| view.shows(run)).collect();
    let times = runs.iter().flat_map(|run| [run.frame_ms.min, run.frame_ms.median, run.frame_ms.max]);
    // A frame that no clock could tell from nothing took a little.
    let times: Vec<f64> = times.map(|ms| crate::math::max(ms, 1e-3)).collect();
    let errors: Vec<f64> = runs.iter().map(|run| metric.of(run)).collect();
    let axes = Axes { time: LogAxis::around(&times), error: LogAxis::around(&errors), metric };
    let series = series(&runs);
    let height = crate::math::max(HEIGHT, legend_bottom(&series));
    let title = format!("{}: {} against the time of a frame", scene.scene.name, metric.title());
    let drawn = html! {
        svg.plot xmlns="http://www.w3.org/2000/svg" viewBox={ "0 0 " (WIDTH) " " (height) } role="img" aria-label=(title) {
            style { (PreEscaped(STYLE)) }
            rect.paper width=(WIDTH) height=(height) {}
            (grid(&axes))
            (front(&axes, &runs))
            @for one in &series { (one.lines(&axes)) }
            @for one in &series { (one.marks(&axes)) }
            (tags(&axes, &series, &limit_box(&axes)))
            (legend(&series))
        }
    };
    drawn.into_string()
}

/// The front of the plot's own metric, as steps: everything right of and above it is beaten.
fn front(axes: &Axes, runs: &[&Run]) -> Markup {
    let points: Vec<[f64; 2]> = runs.iter().map(|run| [run.frame_ms.median, axes.metric.of(run)]).collect();
    let mut steps: Vec<[f64; 2]> = Vec::new();
    for k in super::front(&points) {
        let [x, y] = [axes.x(points[k][0]), axes.y(points[k][1])];
        steps.push([x, steps.last().map_or(FIELD[1], |last| last[1])]);
        steps.push([x, y]);
    }
    if let Some(last) = steps.last().copied() {
        steps.push([FIELD[2], last[1]]);
    }
    html! { path.front d=(polyline(&steps)) {} }
}

/// The rectangles of the words in the field besides the tags.
fn limit_box(axes: &Axes) -> Vec<[f64; 4]> {
    let width = 6.4 * LIMIT.len() as f64;
    limit(axes).map(|y| [FIELD[0], y - 17.0, FIELD[0] + 6.0 + width, y]).into_iter().collect()
}

/// Where the line of the rounding to code values lies, if it is in the field.
fn limit(axes: &Axes) -> Option<f64> {
    (axes.metric != Metric::OverOne && axes.error.holds(ROUNDING)).then(|| axes.y(ROUNDING))
}

fn grid(axes: &Axes) -> Markup {
    let [left, top, right, bottom] = FIELD;
    let class = |is_decade: bool| if is_decade { "grid" } else { "faint" };
    html! {
        @for tick in axes.time.ticks(TIME_WORD / (right - left)) {
            @let x = axes.x(tick.value);
            path class=(class(tick.is_decade)) d=(polyline(&[[x, top], [x, bottom]])) {}
            @if tick.is_labelled {
                path.frame d=(polyline(&[[x, bottom], [x, bottom + 5.0]])) {}
                text x=(fixed(x)) y=(fixed(bottom + 20.0)) text-anchor="middle" { (duration(tick.value)) }
            }
        }
        @for tick in axes.error.ticks(ERROR_WORD / (bottom - top)) {
            @let y = axes.y(tick.value);
            path class=(class(tick.is_decade)) d=(polyline(&[[left, y], [right, y]])) {}
            @if tick.is_labelled {
                path.frame d=(polyline(&[[left - 5.0, y], [left, y]])) {}
                text x=(fixed(left - 8.0)) y=(fixed(y + 4.0)) text-anchor="end" { (short(tick.value)) }
            }
        }
        @if axes.error.has_zero() {
            text x=(fixed(left - 8.0)) y=(fixed(bottom + 4.0)) text-anchor="end" { "0" }
        }
        @if let Some(y) = limit(axes) {
            path.limit d=(polyline(&[[left, y], [right, y]])) {}
            text.tag.halo x=(fixed(left + 6.0)) y=(fixed(y - 5.0)) { (LIMIT) }
        }
        path.frame d=(polyline(&[[left, top], [left, bottom], [right, bottom]])) {}
        text.strong x=(fixed(0.5 * (left + right))) y=(fixed(bottom + 46.0)) text-anchor="middle" { "time of a frame" }
        text.strong text-anchor="middle" transform={ "translate(14 " (fixed(0.5 * (top + bottom))) ") rotate(-90)" } {
            (axes.metric.title())
        }
    }
}

#[cfg(test)]
mod tests;
