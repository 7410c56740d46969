//! Runs that are drawn alike, and how: lines, marks, spreads.

use super::super::axis::{duration, short};
use super::super::{Run, SUPERSAMPLING, TRUTH};
use super::axes::{Axes, fixed, polyline};
use maud::{Markup, html};

/// The most runs of a line whose every point is named.
const NAMED_POINTS: usize = 8;

/// The shapes of marks, so that colour is never all that tells them apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mark {
    Circle,
    Square,
    Triangle,
    Diamond,
    Star,
}

/// Runs that look alike: a technique's line, or its other settings.
pub(super) struct Series<'a> {
    pub(super) name: String,
    pub(super) color: String,
    pub(super) mark: Mark,
    pub(super) is_open: bool,
    pub(super) dash: &'static str,
    pub(super) is_line: bool,
    pub(super) runs: Vec<&'a Run>,
}

/// The series in the order of their first runs.
pub(super) fn series<'a>(runs: &[&'a Run]) -> Vec<Series<'a>> {
    let mut all: Vec<Series> = Vec::new();
    let mut techniques: Vec<&str> = Vec::new();
    for run in runs {
        if !techniques.contains(&run.technique.as_str())
            && run.technique != TRUTH
            && run.technique != SUPERSAMPLING
        {
            techniques.push(&run.technique);
        }
        let number = techniques.iter().position(|name| *name == run.technique).unwrap_or(0);
        let name = series_name(run);
        match all.iter_mut().find(|series| series.name == name) {
            Some(series) => series.runs.push(run),
            None => {
                let lines = all.iter().filter(|s| s.is_line && s.runs[0].technique == run.technique).count();
                all.push(Series::new(name, run, (number, lines)));
            }
        }
    }
    all
}

fn series_name(run: &Run) -> String {
    match &run.line {
        Some(line) if line.is_empty() => run.technique.clone(),
        Some(line) => format!("{}, {line}", run.technique),
        None if run.technique == TRUTH => "truth (half its width)".into(),
        None if run.is_own => format!("{}, as in the scene", run.technique),
        None => format!("{}, other settings", run.technique),
    }
}

impl<'a> Series<'a> {
    /// A series of one run, the technique's number and how many lines the technique has before it.
    fn new(name: String, run: &'a Run, (number, lines): (usize, usize)) -> Self {
        let marks = [Mark::Circle, Mark::Square, Mark::Triangle];
        let (color, mark) = match run.technique.as_str() {
            TRUTH => ("var(--ink)".to_owned(), Mark::Star),
            SUPERSAMPLING => ("var(--soft)".to_owned(), Mark::Diamond),
            _ => (format!("var(--c{})", number % 7), marks[number % 3]),
        };
        Self {
            name,
            color,
            mark,
            is_open: run.line.is_none() && run.technique != TRUTH && !run.is_own,
            dash: ["none", "6 4", "2 3", "8 3 2 3"][lines % 4],
            is_line: run.line.is_some(),
            runs: vec![run],
        }
    }

    pub(super) fn lines(&self, axes: &Axes) -> Markup {
        let points: Vec<[f64; 2]> = self.runs.iter().map(|run| axes.at(run)).collect();
        html! {
            @if self.is_line && points.len() > 1 {
                path.s style={ "--c:" (self.color) } stroke-dasharray=(self.dash) d=(polyline(&points)) {}
            }
        }
    }

    /// A mark for each run, with the spread of its times and what it is when one points at it.
    pub(super) fn marks(&self, axes: &Axes) -> Markup {
        // The scene's own settings lie above the others.
        let own = self.runs.iter().filter(|run| run.is_own);
        html! {
            g style={ "--c:" (self.color) } {
                @for run in self.runs.iter().filter(|run| !run.is_own).chain(own) {
                    @let [x, y] = axes.at(run);
                    g {
                        title { (told(run)) }
                        @if run.frame_ms.max > run.frame_ms.min { path.bar d=(bar(axes, run, y)) {} }
                        path class=(if self.is_open { "m open" } else { "m" }) d=(self.mark_of(run).path(x, y)) {}
                    }
                }
            }
        }
    }

    /// The scene's own settings stand out.
    fn mark_of(&self, run: &Run) -> Mark {
        if run.is_own { Mark::Star } else { self.mark }
    }

    /// The runs whose points are named: all of a short line of supersampling, the ends of any other.
    pub(super) fn named(&self) -> impl Iterator<Item = &'a Run> {
        let last = self.runs.len() - 1;
        let is_named = move |k: usize, run: &Run| match run.technique.as_str() {
            SUPERSAMPLING => last < NAMED_POINTS,
            _ => self.is_line && (k == 0 || k == last),
        };
        self.runs.iter().enumerate().filter(move |(k, run)| is_named(*k, run)).map(|(_, run)| *run)
    }
}

impl Mark {
    /// The outline of a mark at a point.
    pub(super) fn path(self, x: f64, y: f64) -> String {
        let closed = |offsets: &[[f64; 2]]| {
            let points: Vec<[f64; 2]> = offsets.iter().map(|[dx, dy]| [x + dx, y + dy]).collect();
            polyline(&points) + "Z"
        };
        match self {
            Self::Circle => {
                format!("M{} {}a4 4 0 1 0 8 0a4 4 0 1 0 -8 0Z", fixed(x - 4.0), fixed(y))
            }
            Self::Square => closed(&[[-3.6, -3.6], [3.6, -3.6], [3.6, 3.6], [-3.6, 3.6]]),
            Self::Triangle => closed(&[[0.0, -4.8], [4.6, 3.4], [-4.6, 3.4]]),
            Self::Diamond => closed(&[[0.0, -5.0], [4.4, 0.0], [0.0, 5.0], [-4.4, 0.0]]),
            Self::Star => closed(&[
                [0.0, -7.5],
                [1.8, -2.4],
                [7.1, -2.3],
                [2.8, 0.9],
                [4.4, 6.1],
                [0.0, 3.0],
                [-4.4, 6.1],
                [-2.8, 0.9],
                [-7.1, -2.3],
                [-1.8, -2.4],
            ]),
        }
    }
}

/// What one reads of a run when one points at it.
fn told(run: &Run) -> String {
    let [min, median, max] = [run.frame_ms.min, run.frame_ms.median, run.frame_ms.max].map(duration);
    format!(
        "{}\nframe {median} ({min} to {max}), prepare {}\nrmse {}, mean {}, p99 {}, largest {}\noff by more than 1/255: {} % of the pixels",
        run.label(),
        duration(run.prepare_ms.median),
        short(run.error.rmse),
        short(run.error.mean),
        short(run.error.p99),
        short(run.error.max),
        short(100.0 * run.error.over_one_code_value),
    )
}

/// The spread of a run's times.
fn bar(axes: &Axes, run: &Run, y: f64) -> String {
    let (from, to) = (axes.x(run.frame_ms.min), axes.x(run.frame_ms.max));
    let cap = |x: f64| polyline(&[[x, y - 3.5], [x, y + 3.5]]);
    polyline(&[[from, y], [to, y]]) + &cap(from) + &cap(to)
}
