//! `tables.html`: the tables and figures on one page that needs no network.

use super::super::super::axis::{duration, short};
use super::super::super::page::{STYLE, size};
use super::super::grouped::grouped;
use super::Tables;
use super::amounts::Amount;
use super::figures::{FIGURES, Figure};
use super::rows::{DataSet, Row};
use super::trends::{METRICS, Sign, Trend};
use crate::math::max;
use crate::output::document;
use maud::{Markup, html};
use std::collections::BTreeMap;

/// What the thesis's text says of itself and its tables do not.
const SLIPS: [&str; 2] = [
    "5.2.4 says that HORA RLL has the most line vertices of all studies (4,802,375). By Table 5.2 it is HORA RC (14,213,384), then HORA FA (9,790,961).",
    "5.1.7 says that the flood areas have no outlines. Table 5.3 has one group of polygons with outlines in HORA FA, and Tables 5.1 and 5.2 agree with it: its \
     116,317 lines with 9,790,961 vertices are the rings of the floods (116,305 with 9,740,882, what is left when the 22,989 lakes of HORA RLL are taken from \
     the polygons) and the 12 borders with 50,079 vertices that HORA RC has, too.",
];

/// The text of the page.
pub fn page(tables: &Tables) -> String {
    let body = html! {
        body {
            header {
                h1 { "Vector data on heightfields" }
                p.lead {
                    "Chapter 5 of Zechmeister 2020, measured anew in software: static decals (after Thöny 2017 and Frasson 2018) and dynamic lines, beside "
                    "stencil volumes. Memory is bytes of structures and work counts what a frame looks at; they are the same in every run. Times are "
                    "this machine's. "
                    @if tables.repeat == 1 { "Each is of one run." } @else { "Each is the median of " (tables.repeat) " runs." }
                }
            }
            (data(&tables.data_sets))
            (trend_table(&tables.trends))
            @for figure in &FIGURES { (section(figure, &tables.data_sets)) }
            (footer())
        }
    };
    document("Vector data on heightfields: the tables", STYLE, &body)
}

/// Tables 5.1 to 5.3.
fn data(sets: &[DataSet]) -> Markup {
    let amount = |ours: Amount, thesis: Option<Amount>| {
        html! {
            td.n { (grouped(ours.decals)) @if let Some(of) = thesis { small { (grouped(of.decals)) } } }
            td.n { (grouped(ours.vertices)) @if let Some(of) = thesis { small { (grouped(of.vertices)) } } }
        }
    };
    html! {
        section.scene {
            h2 { "The data: Tables 5.1, 5.2 and 5.3" }
            p.facts { "Decals and vertices of each kind, data groups and draw calls, and in small print the thesis's." }
            div.scroll { table {
                thead { tr {
                    th { "data set" }
                    @for head in ["exterior", "vertices", "interior", "vertices", "lines", "vertices"] { th.n { (head) } }
                    @for head in ["draw calls", "polygons with outlines", "polygons", "lines", "in several colours: polygons", "lines", "grid"] { th.n { (head) } }
                } }
                tbody { @for set in sets {
                    @let thesis = set.thesis.map(|study| study.amounts);
                    tr {
                        td { (set.scene.name) }
                        (amount(set.amounts.exterior, thesis.map(|of| of.exterior)))
                        (amount(set.amounts.interior, thesis.map(|of| of.interior)))
                        (amount(set.amounts.lines, thesis.map(|of| of.lines)))
                        @let ours = set.groups;
                        @let of = set.thesis.map(|study| study.groups);
                        @for (ours, of) in [
                            (ours.draw_calls(), of.map(|of| of.draw_calls())),
                            (ours.outlined, of.map(|of| of.outlined)),
                            (ours.areas, of.map(|of| of.areas)),
                            (ours.lines, of.map(|of| of.lines)),
                            (ours.colored_areas, of.map(|of| of.colored_areas)),
                            (ours.colored_lines, of.map(|of| of.colored_lines)),
                            (set.grid as usize, set.thesis.map(|_| 500)),
                        ] { td.n { (ours) @if let Some(of) = of { small { (of) } } } }
                    }
                } }
            } }
            h3 { "Two slips of the thesis's text" }
            @for slip in SLIPS { p.note { (slip) } }
            @if sets.iter().any(|set| set.thesis.is_some()) {
                p.note {
                    "Studies that have the thesis's numbers beside them are generated: as many polygons, holes, lines and vertices as there, times a scale, of the same "
                    "character, on as much less area. The thesis's data is not published."
                }
            }
        }
    }
}

const fn sign(sign: Option<Sign>) -> &'static str {
    match sign {
        None => "",
        Some(Sign::More) => "+",
        Some(Sign::Less) => "−",
        Some(Sign::Same) => "~",
    }
}

/// Table 5.4.
fn trend_table(trends: &[Trend]) -> Markup {
    let told = |ours: Option<Sign>, ratio: Option<f64>| {
        html! { (sign(ours)) @if let Some(ratio) = ratio { small { "× " (short(ratio)) } } }
    };
    let known: Vec<&Trend> = trends.iter().filter(|trend| trend.ours.iter().any(Option::is_some)).collect();
    html! {
        section.scene {
            h2 { "Table 5.4 as a test of trends" }
            p.facts {
                "What happens when a factor grows: + it grows, − it shrinks, ~ no significant effect, nothing: no effect. Of each pair the thesis's sign is the first, ours the "
                "second, and below it how many times as much the largest value takes as the smallest. Of data complexity it is how many pairs of data sets rise for each that falls. Times that differ by less than a tenth count as the same."
            }
            div.scroll { table {
                thead { tr {
                    th { "decals" } th { "factor" }
                    @for metric in METRICS { th.n { (metric) } th.n { "ours" } }
                    th.n { "work" } th { "contradicted" }
                } }
                tbody { @for trend in &known {
                    tr {
                        td { (trend.decals) } td { (trend.factor) }
                        @for k in 0..3 {
                            td.n { (sign(trend.thesis[k])) }
                            td.n { @if trend.contradicts.contains(&METRICS[k]) { strong { (told(trend.ours[k], trend.ratios[k])) } } @else { (told(trend.ours[k], trend.ratios[k])) } }
                        }
                        td.n { (told(trend.work, trend.work_ratio)) }
                        td { (trend.contradicts.join(", ")) }
                    }
                } }
            } }
            @for trend in known.iter().filter(|trend| !trend.contradicts.is_empty()) {
                p.note {
                    strong { (trend.decals) ", " (trend.factor) " (" (trend.contradicts.join(", ")) "): " }
                    @if trend.explanation.is_empty() { "No explanation is known: look at the rows." } @else { (trend.explanation) }
                }
            }
        }
    }
}

/// A figure's rows with the name of their data set.
fn rows<'a>(figure: &Figure, sets: &'a [DataSet]) -> Vec<(&'a DataSet, &'a Row)> {
    let of = |set: &'a DataSet| set.rows.iter().map(move |row| (set, row));
    sets.iter().flat_map(of).filter(|(_, row)| row.figure == figure.number).collect()
}

fn section(figure: &Figure, sets: &[DataSet]) -> Markup {
    let rows = rows(figure, sets);
    if rows.is_empty() {
        return html! {};
    }
    let number =
        if figure.number == "5.4" { "Table 5.4".to_owned() } else { format!("Figure {}", figure.number) };
    html! {
        section.scene {
            h2 { (number) ": " (figure.title) }
            @match figure.number {
                "5.6" => (shares(&rows)),
                "5.8" => (frames(&rows)),
                "5.5" | "5.7" => (plain(&rows)),
                _ => {
                    (pivot(figure, &rows))
                    @if figure.number == "5.9" { (smoothing(&rows)) }
                },
            }
        }
    }
}

/// Each row as it is, with bars.
fn plain(rows: &[(&DataSet, &Row)]) -> Markup {
    let most = |of: &dyn Fn(&Row) -> f64| rows.iter().map(|(_, row)| of(row)).fold(0.0, max);
    let bar = |of: &dyn Fn(&Row) -> f64, row: &Row, text: String| {
        let share = if most(of) > 0.0 { 100.0 * of(row) / most(of) } else { 0.0 };
        html! { td { div.bar style=(format!("width:{share:.1}%")) {} (text) } }
    };
    html! {
        div.scroll { table {
            thead { tr {
                th { "data set" } th { "decals" } th.n { "vertices" }
                @for head in ["memory", "update", "render"] { th { (head) } }
                th.n { "work" }
            } }
            tbody { @for (set, row) in rows {
                tr {
                    td { (set.scene.name) } td { (row.decals) }
                    td.n { (grouped(row.factors.get("vertices").map_or(0, |count| *count as usize))) }
                    (bar(&|row| row.memory_bytes as f64, row, size(row.memory_bytes as usize)))
                    (bar(&|row| row.update_ms.median, row, duration(row.update_ms.median)))
                    (bar(&|row| row.render_ms.median, row, duration(row.render_ms.median)))
                    td.n { (grouped(row.work as usize)) }
                }
            } }
        } }
        @if rows.iter().any(|(_, row)| row.figure == "5.5") {
            p.note { "Dynamic lines lie over static polygons: their sum is the thesis's third bar." }
        }
    }
}

/// What is the same along a line of a table.
type Line<'a> = (&'a str, &'a str, Vec<(&'a str, u64)>);

/// Memory, update and render for each value of the factor, side by side.
fn pivot(figure: &Figure, rows: &[(&DataSet, &Row)]) -> Markup {
    let mut lines: Vec<(Line, BTreeMap<u64, &Row>)> = Vec::new();
    let mut values: Vec<f64> = Vec::new();
    for (set, row) in rows {
        let Some(value) = row.factors.get(figure.factor) else { continue };
        let others = row.factors.iter().filter(|(name, _)| **name != figure.factor);
        let line: Line =
            (&set.scene.name, row.decals, others.map(|(name, value)| (*name, value.to_bits())).collect());
        let at = lines.iter().position(|(known, _)| *known == line).unwrap_or_else(|| {
            lines.push((line, BTreeMap::new()));
            lines.len() - 1
        });
        lines[at].1.insert(value.to_bits(), row);
        if !values.contains(value) {
            values.push(*value);
        }
    }
    values.sort_by(f64::total_cmp);
    let metrics: [Words; 4] = [
        ("memory", |row| size(row.memory_bytes as usize)),
        ("update", |row| duration(row.update_ms.median)),
        ("render", |row| duration(row.render_ms.median)),
        ("work", |row| grouped(row.work as usize)),
    ];
    html! {
        div.scroll { table {
            thead { tr {
                th { "data set" } th { "decals" }
                @for (metric, _) in &metrics { @for value in &values { th.n { (metric) small { (figure.factor) " " (value_of(figure, *value)) } } } }
            } }
            tbody { @for ((set, decals, others), cells) in &lines {
                tr {
                    td { (set) }
                    td {
                        (decals)
                        @for (name, bits) in others { small { (other(name, f64::from_bits(*bits))) } }
                    }
                    @for (_, told) in &metrics { @for value in &values { td.n { @if let Some(row) = cells.get(&value.to_bits()) { (told(row)) } } } }
                }
            } }
        } }
    }
}

/// A value of a factor in words.
fn value_of(figure: &Figure, value: f64) -> String {
    match figure.factor {
        "anti-aliasing" => if value > 0.0 { "on" } else { "off" }.into(),
        "corners" => ["round", "miter", "bevel"].get(value as usize).copied().unwrap_or("").into(),
        "resolution" => format!("{} MP", short(value / 1e6)),
        _ => short(value),
    }
}

fn other(name: &str, value: f64) -> String {
    match name {
        "colors" => if value > 0.0 { "own colours, sorted" } else { "one colour, not sorted" }.into(),
        _ => format!("{name} {}", short(value)),
    }
}

/// A metric's name, and a row's in words.
type Words = (&'static str, fn(&Row) -> String);

/// A metric's name, and a row's.
type Numbers = (&'static str, fn(&Row) -> f64);

/// Fig. 5.6: what exterior and interior polygons and lines have of all.
fn shares(rows: &[(&DataSet, &Row)]) -> Markup {
    let metrics: [Numbers; 3] = [
        ("memory", |row| row.memory_bytes as f64),
        ("update", |row| row.update_ms.median),
        ("render", |row| row.render_ms.median),
    ];
    let mut sets: Vec<&DataSet> = rows.iter().map(|(set, _)| *set).collect();
    sets.dedup_by_key(|set| &set.scene.name);
    let of = |set: &DataSet, decals: &str, metric: fn(&Row) -> f64| {
        let found = rows.iter().find(|(own, row)| own.scene.name == set.scene.name && row.decals == decals);
        found.map_or(0.0, |(_, row)| metric(row))
    };
    html! {
        div.scroll { table {
            thead { tr { th { "data set" } th { "lines" } th { "of" } th.n { "exterior" } th.n { "interior" } th.n { "lines" } } }
            tbody { @for set in sets { @for lines in ["static lines", "dynamic lines"] { @for (word, metric) in metrics {
                @let exterior = of(set, "exterior polygons", metric);
                @let interior = max(of(set, "polygons", metric) - exterior, 0.0);
                @let strokes = of(set, lines, metric);
                @let whole = max(exterior + interior + strokes, f64::MIN_POSITIVE);
                tr {
                    td { (set.scene.name) } td { (lines) } td { (word) }
                    @for share in [exterior, interior, strokes] { td.n { (format!("{:.0} %", 100.0 * share / whole)) } }
                }
            } } } }
        } }
        p.note { "Interior polygons: what polygons take more than they do without their holes. (Fig. 5.6 is of HORA IL.) A frame's share has the terrain's own in it each time." }
    }
}

/// Fig. 5.9: what smoothing has of a frame.
fn smoothing(rows: &[(&DataSet, &Row)]) -> Markup {
    let time = |set: &DataSet, decals: &str, on: f64| {
        let is = |own: &&DataSet, row: &&Row| own.scene.name == set.scene.name && row.decals == decals;
        let found =
            rows.iter().find(|(own, row)| is(own, row) && row.factors.get("anti-aliasing") == Some(&on));
        found.map_or(0.0, |(_, row)| row.render_ms.median)
    };
    let with = rows.iter().filter(|(_, row)| row.factors.get("anti-aliasing") == Some(&1.0));
    html! {
        @for (set, row) in with {
            @let (off, on) = (time(set, row.decals, 0.0), time(set, row.decals, 1.0));
            @if on > 0.0 {
                p.note { (set.scene.name) ", " (row.decals) ": anti-aliasing is " (format!("{:.0} %", 100.0 * max(1.0 - off / on, 0.0))) " of a frame." }
            }
        }
        p.note { "In the thesis it is 77 % of static decals (8 samples) and 6 % of dynamic lines (FXAA) on average." }
    }
}

const CHART: [f64; 2] = [640.0, 200.0];

/// Fig. 5.8: render time of each frame, a line for each kind of decals.
fn frames(rows: &[(&DataSet, &Row)]) -> Markup {
    let mut names: Vec<&str> = rows.iter().map(|(set, _)| set.scene.name.as_str()).collect();
    names.dedup();
    let [width, height] = CHART;
    html! {
        @for name in names {
            @let own: Vec<&Row> = rows.iter().filter(|(set, _)| set.scene.name == name).map(|(_, row)| *row).collect();
            @let most = own.iter().map(|row| row.render_ms.median).fold(f64::MIN_POSITIVE, max);
            @let last = own.iter().filter_map(|row| row.factors.get("zoom")).copied().fold(1.0, max);
            h3 { (name) }
            svg viewBox=(format!("-10 -10 {} {}", width + 200.0, height + 20.0)) style="width:100%;max-width:860px;height:auto" role="img"
                aria-label={ "render time of " (name) " while zooming in" } {
                path d=(format!("M0 0V{height}H{width}")) fill="none" stroke="currentColor" stroke-opacity="0.4" {}
                text x="6" y="6" font-size="12" fill="currentColor" { (duration(most)) }
                @for (k, (decals, color)) in [("polygons", "#0072b2"), ("static lines", "#009e73"), ("dynamic lines", "#d55e00")].into_iter().enumerate() {
                    @let points: Vec<String> = own.iter().filter(|row| row.decals == decals).map(|row| {
                        let at = row.factors.get("zoom").copied().unwrap_or(0.0);
                        format!("{:.1},{:.1}", width * at / last, height * (1.0 - row.render_ms.median / most))
                    }).collect();
                    polyline points=(points.join(" ")) fill="none" stroke=(color) stroke-width="2" {}
                    text x=(width + 12.0) y=(20.0 + 18.0 * k as f64) font-size="13" fill=(color) { (decals) }
                }
            }
        }
        p.note { "Thirty frames, each a tenth nearer to the point in the middle than the one before." }
    }
}

fn footer() -> Markup {
    html! {
        footer {
            h3 { "How to read it" }
            dl {
                dt { "memory" }
                dd { "Bytes of what is built of the scene, whole before the first frame as in the thesis. Dynamic lines: also 8 bytes a pixel and 12 an entry of its list, as in 4.3.2." }
                dt { "update, render" }
                dd { "Building what does not depend on the view, and a frame with all its samples (static decals: 8 a pixel unless told otherwise). The terrain's own visibility is part of each frame." }
                dt { "work" }
                dd { "Nodes, edges, boxes and entries that a frame looked at: an exact number that stands for what a machine without noise would need." }
                dt { "scale" }
                dd { "A study of a fiftieth has a fiftieth of the data on a fiftieth of the area, and a grid of 71 cells a side in place of 500: cells are as crowded as there." }
            }
        }
    }
}
