//! The plot of speed against error, as SVG: crisp at any size, light or dark as the reader's screen is.

use super::axis::{LogAxis, duration, short};
use super::{Metric, Run, SUPERSAMPLING, SceneReport, TRUTH};
use maud::{Markup, PreEscaped, html};

const WIDTH: f64 = 1040.0;
const HEIGHT: f64 = 560.0;
/// The plot's rectangle in the picture: left, top, right, bottom.
const FIELD: [f64; 4] = [74.0, 26.0, 724.0, 496.0];
/// Where the legend begins.
const LEGEND: [f64; 2] = [752.0, 40.0];

/// How rounding to 8-bit code values alone can move a channel.
const ROUNDING: f64 = 1.0 / 510.0;

/// The most runs of a line whose every point is named.
const NAMED_POINTS: usize = 8;

/// Colours that people who do not tell red from green tell apart (M. Okabe and K. Ito, *Color Universal Design*, 2008), for light and dark.
const STYLE: &str = "
.plot{--ink:#1c2430;--soft:#5b6675;--grid:#e3e7ec;--faint:#f1f3f6;--paper:#fff;
--c0:#0072b2;--c1:#d55e00;--c2:#009e73;--c3:#b0588f;--c4:#b07a00;--c5:#2f8fc4;--c6:#7a5bd0;
font:13px system-ui,-apple-system,'Segoe UI',Roboto,'Helvetica Neue',sans-serif}
@media(prefers-color-scheme:dark){.plot{--ink:#e6eaf0;--soft:#9aa6b5;--grid:#2c3440;--faint:#20262f;--paper:#14181e;
--c0:#56b4e9;--c1:#ff8a3d;--c2:#2fc79b;--c3:#e29bc8;--c4:#e9b949;--c5:#8fd0f5;--c6:#b39dff}}
.plot .paper{fill:var(--paper)}.plot text{fill:var(--soft)}.plot .strong{fill:var(--ink)}.plot .tag{font-size:11px}
.plot .grid{stroke:var(--grid);fill:none}.plot .faint{stroke:var(--faint);fill:none}
.plot .frame{stroke:var(--soft);fill:none}
.plot .front{stroke:var(--ink);stroke-width:4;stroke-linejoin:round;fill:none;opacity:.22}
.plot .limit{stroke:var(--soft);stroke-dasharray:2 4;fill:none}
.plot .s{stroke:var(--c);fill:none;stroke-width:1.6;opacity:.75}
.plot .bar{stroke:var(--c);stroke-width:1.2;fill:none;opacity:.8}
.plot .m{stroke:var(--paper);fill:var(--c);stroke-width:.8}.plot .m.open{stroke:var(--c);fill:var(--paper);stroke-width:1.8}
.plot .halo{paint-order:stroke;stroke:var(--paper);stroke-width:3px}
";

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
    /// Both.
    pub const ALL: [Self; 2] = [Self::All, Self::Techniques];
}

impl View {
    /// Every plot of a scene, those of all runs first.
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

/// The shapes of marks, so that colour is never all that tells them apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Mark {
    Circle,
    Square,
    Triangle,
    Diamond,
    Star,
}

/// Runs that look alike: a technique's line, or its other settings.
struct Series<'a> {
    name: String,
    color: String,
    mark: Mark,
    is_open: bool,
    dash: &'static str,
    is_line: bool,
    runs: Vec<&'a Run>,
}

/// Where a run lies.
struct Axes {
    time: LogAxis,
    error: LogAxis,
    metric: Metric,
}

impl Axes {
    fn x(&self, ms: f64) -> f64 {
        FIELD[0] + self.time.place(ms) * (FIELD[2] - FIELD[0])
    }

    fn y(&self, error: f64) -> f64 {
        FIELD[3] - self.error.place(error) * (FIELD[3] - FIELD[1])
    }

    fn at(&self, run: &Run) -> [f64; 2] {
        [self.x(run.frame_ms.median), self.y(self.metric.of(&run.error))]
    }
}

/// A plot of a scene's runs: a whole SVG document, which may stand in a page as it is.
pub fn svg(scene: &SceneReport, view: View) -> String {
    let metric = view.metric;
    let runs: Vec<&Run> = scene.runs.iter().filter(|run| view.shows(run)).collect();
    let times = runs.iter().flat_map(|run| [run.frame_ms.min, run.frame_ms.median, run.frame_ms.max]);
    // A frame that no clock could tell from nothing took a little.
    let times: Vec<f64> = times.map(|ms| crate::math::max(ms, 1e-3)).collect();
    let errors: Vec<f64> = runs.iter().map(|run| metric.of(&run.error)).collect();
    let axes = Axes { time: LogAxis::around(&times), error: LogAxis::around(&errors), metric };
    let series = series(&runs);
    let title = format!("{}: {} against the time of a frame", scene.scene.name, metric.title());
    let drawn = html! {
        svg.plot xmlns="http://www.w3.org/2000/svg" viewBox={ "0 0 " (WIDTH) " " (HEIGHT) } role="img" aria-label=(title) {
            style { (PreEscaped(STYLE)) }
            rect.paper width=(WIDTH) height=(HEIGHT) {}
            (grid(&axes))
            (front(&axes, &runs))
            @for one in &series { (one.lines(&axes)) }
            @for one in &series { (one.marks(&axes)) }
            (tags(&axes, &series, &runs))
            (legend(&series))
        }
    };
    drawn.into_string()
}

/// The series in the order of their first runs.
fn series<'a>(runs: &[&'a Run]) -> Vec<Series<'a>> {
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

    fn lines(&self, axes: &Axes) -> Markup {
        let points: Vec<[f64; 2]> = self.runs.iter().map(|run| axes.at(run)).collect();
        html! {
            @if self.is_line && points.len() > 1 {
                path.s style={ "--c:" (self.color) } stroke-dasharray=(self.dash) d=(polyline(&points)) {}
            }
        }
    }

    /// A mark for each run, with the spread of its times and what it is when one points at it.
    fn marks(&self, axes: &Axes) -> Markup {
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
    fn named(&self) -> impl Iterator<Item = &'a Run> {
        let last = self.runs.len() - 1;
        let is_named = move |k: usize, run: &Run| match run.technique.as_str() {
            SUPERSAMPLING => last < NAMED_POINTS,
            _ => self.is_line && (k == 0 || k == last),
        };
        self.runs.iter().enumerate().filter(move |(k, run)| is_named(*k, run)).map(|(_, run)| *run)
    }
}

/// The names of points, where there is room for them.
fn tags(axes: &Axes, all: &[Series], runs: &[&Run]) -> Markup {
    let marks: Vec<[f64; 4]> =
        runs.iter().map(|run| axes.at(run)).map(|[x, y]| [x - 5.0, y - 5.0, x + 5.0, y + 5.0]).collect();
    let mut taken: Vec<[f64; 4]> = Vec::new();
    let mut tags = Vec::new();
    for (one, run) in all.iter().flat_map(|one| one.named().map(move |run| (one, run))) {
        let words = run.varied.first().map_or("", String::as_str);
        let (width, [x, y]) = (6.4 * words.len() as f64, axes.at(run));
        let places = [[9.0, -7.0], [9.0, 17.0], [-9.0 - width, -7.0], [-9.0 - width, 17.0]];
        let boxed = places.map(|[dx, dy]| [x + dx, y + dy - 11.0, x + dx + width, y + dy + 2.0]);
        let is_free = |place: &[f64; 4], others: &[[f64; 4]]| !others.iter().any(|other| meets(place, other));
        let inside = |place: &&[f64; 4]| place[0] > FIELD[0] && is_free(place, &taken);
        let free: Vec<&[f64; 4]> = boxed.iter().filter(inside).collect();
        let best = free.iter().find(|place| is_free(place, &marks)).or(free.first());
        if let Some(place) = best.copied().copied() {
            taken.push(place);
            tags.push((one.color.as_str(), words, place));
        }
    }
    html! {
        @for (color, words, [x, _, _, bottom]) in tags {
            text.tag.halo x=(fixed(x)) y=(fixed(bottom - 2.0)) style={ "fill:" (color) } { (words) }
        }
    }
}

/// Whether two rectangles meet.
fn meets(a: &[f64; 4], b: &[f64; 4]) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

impl Mark {
    /// The outline of a mark at a point.
    fn path(self, x: f64, y: f64) -> String {
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

/// The front of the plot's own metric, as steps: everything right of and above it is beaten.
fn front(axes: &Axes, runs: &[&Run]) -> Markup {
    let points: Vec<[f64; 2]> =
        runs.iter().map(|run| [run.frame_ms.median, axes.metric.of(&run.error)]).collect();
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

fn grid(axes: &Axes) -> Markup {
    let [left, top, right, bottom] = FIELD;
    let class = |is_decade: bool| if is_decade { "grid" } else { "faint" };
    let has_limit = axes.metric != Metric::OverOne && axes.error.holds(ROUNDING);
    html! {
        @for tick in axes.time.ticks() {
            @let x = axes.x(tick.value);
            path class=(class(tick.is_decade)) d=(polyline(&[[x, top], [x, bottom]])) {}
            @if tick.is_labelled {
                text x=(fixed(x)) y=(fixed(bottom + 20.0)) text-anchor="middle" { (duration(tick.value)) }
            }
        }
        @for tick in axes.error.ticks() {
            @let y = axes.y(tick.value);
            path class=(class(tick.is_decade)) d=(polyline(&[[left, y], [right, y]])) {}
            @if tick.is_labelled {
                text x=(fixed(left - 8.0)) y=(fixed(y + 4.0)) text-anchor="end" { (short(tick.value)) }
            }
        }
        @if axes.error.has_zero() {
            text x=(fixed(left - 8.0)) y=(fixed(bottom + 4.0)) text-anchor="end" { "0" }
        }
        @if has_limit {
            @let y = axes.y(ROUNDING);
            path.limit d=(polyline(&[[left, y], [right, y]])) {}
            text.tag.halo x=(fixed(left + 6.0)) y=(fixed(y - 5.0)) { "half an 8-bit code value" }
        }
        path.frame d=(polyline(&[[left, top], [left, bottom], [right, bottom]])) {}
        text.strong x=(fixed(0.5 * (left + right))) y=(fixed(bottom + 46.0)) text-anchor="middle" { "time of a frame" }
        text.strong text-anchor="middle" transform={ "translate(20 " (fixed(0.5 * (top + bottom))) ") rotate(-90)" } {
            (axes.metric.title())
        }
    }
}

fn legend(series: &[Series]) -> Markup {
    let row = |k: usize| LEGEND[1] + 22.0 * k as f64;
    let x = LEGEND[0];
    let n = series.len();
    html! {
        @for (k, one) in series.iter().enumerate() {
            @let y = row(k);
            g style={ "--c:" (one.color) } {
                @if one.is_line {
                    path.s stroke-dasharray=(one.dash) d=(polyline(&[[x, y], [x + 26.0, y]])) {}
                }
                path class=(if one.is_open { "m open" } else { "m" }) d=(one.mark.path(x + 13.0, y)) {}
            }
            text x=(fixed(x + 34.0)) y=(fixed(y + 4.0)) { (one.name) }
        }
        path.m style="--c:var(--soft)" d=(Mark::Star.path(x + 13.0, row(n + 2))) {}
        text x=(fixed(x + 34.0)) y=(fixed(row(n + 2) + 4.0)) { "the scene's own settings" }
        path.front d=(polyline(&[[x, row(n) - 4.0], [x + 13.0, row(n) - 4.0], [x + 13.0, row(n) + 4.0], [x + 26.0, row(n) + 4.0]])) {}
        text x=(fixed(x + 34.0)) y=(fixed(row(n) + 4.0)) { "Pareto front" }
        path.frame d=(polyline(&[[x + 2.0, row(n + 1)], [x + 24.0, row(n + 1)]])) {}
        text x=(fixed(x + 34.0)) y=(fixed(row(n + 1) + 4.0)) { "shortest to longest time" }
    }
}

/// `M x y L x y ...`
fn polyline(points: &[[f64; 2]]) -> String {
    let point = |(k, [x, y]): (usize, &[f64; 2])| {
        format!("{}{} {}", if k == 0 { 'M' } else { 'L' }, fixed(*x), fixed(*y))
    };
    points.iter().enumerate().map(point).collect()
}

/// A coordinate to a hundredth.
fn fixed(v: f64) -> String {
    format!("{v:.2}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::{ByName, SceneResult};
    use crate::report::{Errors, Times};

    fn run(technique: &str, varied: &str, line: Option<&str>, (ms, error): (f64, f64)) -> Run {
        let error = Errors {
            max: error,
            mean: error,
            rmse: error,
            p99: error,
            over_one_code_value: 0.0,
            flip_mean: None,
        };
        Run {
            technique: technique.into(),
            varied: vec![varied.into()],
            is_own: false,
            line: line.map(Into::into),
            parameters: ByName::default(),
            device: ByName::default(),
            prepare_ms: Times::of(vec![]),
            frame_ms: Times::of(vec![ms, ms * 1.5]),
            structure_bytes: 0,
            counts: ByName::default(),
            error,
            is_rounded: true,
            image_hash: String::new(),
            on_front: false,
        }
    }

    fn scene(runs: Vec<Run>) -> SceneReport {
        let scene = SceneResult {
            name: "a <b> & c".into(),
            hash: String::new(),
            plan_space: String::new(),
            origin: [0.0; 2],
        };
        SceneReport { scene, width: 1, height: 1, notes: vec![], reference_width_max: 0.0, runs }
    }

    #[test]
    fn lines_are_series_of_their_own_and_what_is_on_none_is_another() {
        let runs = [
            run(TRUTH, "", None, (9.0, 0.1)),
            run("a", "n=1", Some("x=1"), (1.0, 0.5)),
            run("a", "n=2", Some("x=1"), (2.0, 0.4)),
            run("a", "n=1", Some("x=2"), (1.0, 0.3)),
            run("a", "y=1", None, (1.0, 0.2)),
        ];
        let names: Vec<String> =
            series(&runs.iter().collect::<Vec<_>>()).into_iter().map(|one| one.name).collect();
        assert_eq!(names, ["truth (half its width)", "a, x=1", "a, x=2", "a, other settings"]);
        let all: Vec<&Run> = runs.iter().collect();
        assert_ne!(series(&all)[1].dash, series(&all)[2].dash);
    }

    #[test]
    fn a_plot_of_zero_errors_and_of_no_time_is_drawn_in_the_field() {
        let view = View { metric: Metric::Rmse, scope: Scope::All };
        let svg = svg(&scene(vec![run("a", "", None, (0.0, 0.0)), run("b", "", None, (0.0, 0.0))]), view);
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        assert!(svg.contains("a &lt;b&gt; &amp; c"), "{svg}");
    }

    #[test]
    fn the_front_is_a_staircase_from_the_top_to_the_right() {
        let runs = vec![
            run("a", "", None, (1.0, 0.5)),
            run("b", "", None, (10.0, 0.1)),
            run("c", "", None, (20.0, 0.4)),
        ];
        let axes = Axes {
            time: LogAxis::around(&[1.0, 20.0]),
            error: LogAxis::around(&[0.1, 0.5]),
            metric: Metric::Rmse,
        };
        let path = front(&axes, &runs.iter().collect::<Vec<_>>()).into_string();
        let corners: Vec<&str> = path.split(['M', 'L']).skip(1).collect();
        assert_eq!(corners.len(), 5, "{path}");
        assert!(corners[0].ends_with(&fixed(FIELD[1])) && corners[4].starts_with(&fixed(FIELD[2])), "{path}");
    }
}
