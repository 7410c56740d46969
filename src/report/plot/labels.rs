//! The words beside points, and the legend.

use super::axes::{Axes, FIELD, fixed, polyline};
use super::series::{Mark, Series};
use maud::{Markup, html};

/// Where the legend begins.
const LEGEND: [f64; 2] = [752.0, 40.0];

/// Where a tag may stand: from its point to its nearer lower corner, and whether it runs to the left.
const PLACES: [([f64; 2], bool); 12] = [
    ([9.0, -7.0], false),
    ([9.0, 17.0], false),
    ([-9.0, -7.0], true),
    ([-9.0, 17.0], true),
    ([11.0, 4.0], false),
    ([-11.0, 4.0], true),
    ([9.0, -22.0], false),
    ([9.0, 32.0], false),
    ([-9.0, -22.0], true),
    ([-9.0, 32.0], true),
    ([26.0, -14.0], false),
    ([-26.0, -14.0], true),
];

/// The names of points, where there is room for them: on no mark, on no other words, in the field.
pub(super) fn tags(axes: &Axes, all: &[Series], words_there: &[[f64; 4]]) -> Markup {
    let points = all.iter().flat_map(|one| one.runs.iter()).map(|run| axes.at(run));
    let mut taken: Vec<[f64; 4]> = points.map(|[x, y]| [x - 5.0, y - 5.0, x + 5.0, y + 5.0]).collect();
    taken.extend(words_there);
    let mut tags = Vec::new();
    for (one, run) in all.iter().flat_map(|one| one.named().map(move |run| (one, run))) {
        let words = run.varied.first().map_or("", String::as_str);
        let (width, [x, y]) = (6.4 * words.len() as f64, axes.at(run));
        let boxed = PLACES.map(|([dx, dy], is_left)| {
            let left = x + dx - if is_left { width } else { 0.0 };
            [left - 3.0, y + dy - 11.0, left + width + 3.0, y + dy + 2.0]
        });
        let in_field = |[left, top, right, bottom]: &[f64; 4]| {
            *left > FIELD[0] && *top > FIELD[1] && *right < FIELD[2] && *bottom < FIELD[3]
        };
        let is_free = |place: &&[f64; 4]| in_field(place) && !taken.iter().any(|other| meets(place, other));
        if let Some(place) = boxed.iter().find(is_free).copied() {
            taken.push(place);
            tags.push((one.color.as_str(), words, place));
        }
    }
    html! {
        @for (color, words, [x, _, _, bottom]) in tags {
            text.tag.halo x=(fixed(x + 3.0)) y=(fixed(bottom - 2.0)) style={ "fill:" (color) } { (words) }
        }
    }
}

/// Whether two rectangles meet.
fn meets(a: &[f64; 4], b: &[f64; 4]) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// The most letters of a line of the legend.
const LETTERS: usize = 36;

/// A name in lines that fit beside the field.
fn lines_of(name: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in name.split(' ') {
        let last = lines.len() - 1;
        if lines[last].is_empty() {
            lines[last].push_str(word);
        } else if lines[last].len() + 1 + word.len() <= LETTERS {
            lines[last] = format!("{} {word}", lines[last]);
        } else {
            lines.push(word.to_owned());
        }
    }
    lines
}

/// The distance of the legend's rows.
const ROW: f64 = 22.0;

/// Below which height nothing of the legend lies: its series, and three rows that every plot has.
pub(super) fn legend_bottom(series: &[Series]) -> f64 {
    let rows: usize = series.iter().map(|one| lines_of(&one.name).len()).sum();
    LEGEND[1] + ROW * (rows + 3) as f64
}

/// What the marks and lines stand for.
pub(super) fn legend(series: &[Series]) -> Markup {
    let row = |k: usize| LEGEND[1] + ROW * k as f64;
    let x = LEGEND[0];
    let names: Vec<Vec<String>> = series.iter().map(|one| lines_of(&one.name)).collect();
    // A name's further lines take rows of their own.
    let first = |k: usize| names[..k].iter().map(Vec::len).sum::<usize>();
    let n = first(series.len());
    html! {
        @for (k, one) in series.iter().enumerate() {
            @let y = row(first(k));
            g style={ "--c:" (one.color) } {
                @if one.is_line {
                    path.s stroke-dasharray=(one.dash) d=(polyline(&[[x, y], [x + 26.0, y]])) {}
                }
                path class=(if one.is_open { "m open" } else { "m" }) d=(one.mark.path(x + 13.0, y)) {}
            }
            @for (line, words) in names[k].iter().enumerate() {
                text x=(fixed(x + 34.0)) y=(fixed(row(first(k) + line) + 4.0)) { (words) }
            }
        }
        path.m style="--c:var(--soft)" d=(Mark::Star.path(x + 13.0, row(n + 2))) {}
        text x=(fixed(x + 34.0)) y=(fixed(row(n + 2) + 4.0)) { "the scene's own settings" }
        path.front d=(polyline(&[[x, row(n) - 4.0], [x + 13.0, row(n) - 4.0], [x + 13.0, row(n) + 4.0], [x + 26.0, row(n) + 4.0]])) {}
        text x=(fixed(x + 34.0)) y=(fixed(row(n) + 4.0)) { "Pareto front" }
        path.frame d=(polyline(&[[x + 2.0, row(n + 1)], [x + 24.0, row(n + 1)]])) {}
        text x=(fixed(x + 34.0)) y=(fixed(row(n + 1) + 4.0)) { "shortest to longest time" }
    }
}
