//! Table 5.4 as a test: for each factor, whether memory, preparing and drawing take more or less when it grows, beside the thesis's signs.

use super::rows::{DataSet, Row};
use crate::math::{exp, ln};
use std::collections::BTreeMap;

/// How something behaves when a factor grows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub enum Sign {
    /// It grows.
    #[serde(rename = "+")]
    More,
    /// It shrinks.
    #[serde(rename = "-")]
    Less,
    /// No significant effect.
    #[serde(rename = "~")]
    Same,
}

/// What is told of each factor: memory, update and render time.
pub const METRICS: [&str; 3] = ["memory", "update", "render"];

/// A row of Table 5.4.
#[derive(Debug, Clone, Copy)]
struct Factor {
    decals: &'static str,
    name: &'static str,
    thesis: [Option<Sign>; 3],
    /// The figures and decals whose rows tell it.
    of: &'static [(&'static str, &'static str)],
    /// Which of their factors, and whether it runs the other way.
    factor: (&'static str, bool),
    /// Whether scenes are compared with one another, not settings of one.
    is_between: bool,
    /// Why our numbers may run against the thesis's.
    why: &'static str,
}

/// A row of the table with our signs.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Trend {
    /// The thesis's group of rows.
    pub decals: &'static str,
    /// The factor.
    pub factor: &'static str,
    /// The thesis's signs; none: no effect.
    pub thesis: [Option<Sign>; 3],
    /// Ours; none: there are no measurements of it.
    pub ours: [Option<Sign>; 3],
    /// How many times as much the largest value of the factor takes as the smallest: the geometric mean of all series.
    pub ratios: [Option<f64>; 3],
    /// The work of a frame (counts of what was looked at, the same in every run).
    pub work: Option<Sign>,
    /// Its ratio.
    pub work_ratio: Option<f64>,
    /// Where ours contradicts the thesis: of which metrics, and what explains it.
    pub contradicts: Vec<&'static str>,
    /// The explanation; empty where nothing is contradicted.
    pub explanation: &'static str,
}

use Sign::{Less, More, Same};

const STATIC: &str = "static decals";
const DYNAMIC: &str = "dynamic lines";

/// Table 5.4 as it is printed.
static FACTORS: [Factor; 15] = [
    Factor {
        decals: "All decals",
        name: "Data complexity",
        thesis: [Some(More), Some(More), Some(More)],
        of: &[("5.5", STATIC), ("5.5", DYNAMIC)],
        factor: ("vertices", false),
        is_between: true,
        why: "Scenes differ in more than their size. A frame costs what its pixels see: a large scene that leaves most of the picture empty (FA, RLL) is drawn \
              faster than a small one that covers it. The thesis says the same of Fig. 5.5c (5.2.2). Lists of pixels, which depend on the picture, are most of \
              the memory of dynamic lines while there is little data.",
    },
    Factor {
        decals: "All decals",
        name: "Data distribution",
        thesis: [None, Some(Less), Some(Less)],
        of: &[("5.4", STATIC), ("5.4", DYNAMIC)],
        factor: ("spread", false),
        is_between: false,
        why: "The same data is drawn together towards the middle here. What is spread covers more pixels and more cells, and both cost. The thesis's \
              distribution is how evenly studies fill their own area, which shortens lists and trees and changes nothing else.",
    },
    Factor {
        decals: "All decals",
        name: "Anti-aliasing",
        thesis: [None, None, Some(More)],
        of: &[("5.9", STATIC), ("5.9", DYNAMIC)],
        factor: ("anti-aliasing", false),
        is_between: false,
        why: "",
    },
    Factor {
        decals: "Static decals",
        name: "Zooming in",
        thesis: [None, None, Some(Less)],
        of: &[("5.8", "polygons"), ("5.8", "static lines")],
        factor: ("zoom", false),
        is_between: false,
        why: "The first frames show the sky and the ground around the data, which cost nothing here; when the data fills the picture, every sample has to look. \
              The thesis starts with a view that is full of it.",
    },
    Factor {
        decals: "Static decals",
        name: "Grid resolution",
        thesis: [Some(More), Some(More), Some(Less)],
        of: &[("5.10", STATIC)],
        factor: ("grid", false),
        is_between: false,
        why: "The work of a frame shrinks as the thesis says. Its time is mostly the terrain's and that of finding each sample's cell, which more cells make no cheaper.",
    },
    Factor {
        decals: "Polygons",
        name: "Leaf capacity",
        thesis: [Some(Less), Some(Less), Some(More)],
        of: &[("5.12", "polygons")],
        factor: ("leaf capacity", false),
        is_between: false,
        why: "The work of a frame grows as the thesis says: more edges are tested. But a leaf's edges lie side by side in memory and are tested in a row, which a processor does \
              faster than it walks down a tree, so that the time hardly changes.",
    },
    Factor {
        decals: "Polygons",
        name: "Quad-tree depth",
        thesis: [Some(More), Some(More), Some(Less)],
        of: &[("5.13", "polygons")],
        factor: ("depth", false),
        is_between: false,
        why: "Few polygons are so complex that a deeper tree is used; the thesis sees the same of its simple studies.",
    },
    Factor {
        decals: "Static lines",
        name: "Width",
        thesis: [Some(More), Some(Same), Some(More)],
        of: &[("5.14", "static lines")],
        factor: ("width", false),
        is_between: false,
        why: "Wider lines are put into more cells, and here that is most of what preparing them takes; in the thesis the queue of its cells hides it. A frame's work grows, but \
              wide opaque lines also end the search of a sample sooner.",
    },
    Factor {
        decals: "Static lines",
        name: "Transparency",
        thesis: [None, None, Some(More)],
        of: &[("5.14", "static lines")],
        factor: ("opacity", true),
        is_between: false,
        why: "A search ends early only where several lines lie over a sample; elsewhere the whole cell is searched whatever the opacity.",
    },
    Factor {
        decals: "Static lines",
        name: "Corner style",
        thesis: [Some(More), Some(Same), Some(More)],
        of: &[("5.16", "static lines")],
        factor: ("corners", false),
        is_between: false,
        why: "Corners are made from their segments when a sample asks, and are not stored as positions (3.6). In exact mathematics a round corner takes no fewer tests than a \
              bevelled one, and covers a little more.",
    },
    Factor {
        decals: "Dynamic lines",
        name: "Zooming in",
        thesis: [None, None, Some(Less)],
        of: &[("5.8", DYNAMIC)],
        factor: ("zoom", false),
        is_between: false,
        why: "Most of a frame is the terrain's here. While the data fills only part of the picture at first, lists grow with each step until segments leave the view.",
    },
    Factor {
        decals: "Dynamic lines",
        name: "Width",
        thesis: [Some(More), None, Some(More)],
        of: &[("5.15", DYNAMIC)],
        factor: ("width", false),
        is_between: false,
        why: "",
    },
    Factor {
        decals: "Dynamic lines",
        name: "Transparency",
        thesis: [None, None, Some(More)],
        of: &[("5.15", DYNAMIC)],
        factor: ("opacity", true),
        is_between: false,
        why: "Making the lists takes most of the time, and they are the same for every opacity: only sorting and composing end sooner where lines are opaque.",
    },
    Factor {
        decals: "Dynamic lines",
        name: "Corner style",
        thesis: [None, None, Some(More)],
        of: &[("5.16", DYNAMIC)],
        factor: ("corners", false),
        is_between: false,
        why: "A corner costs a few signs of a pixel that a box covers anyway; on this processor they weigh less than finding the terrain's point.",
    },
    Factor {
        decals: "Dynamic lines",
        name: "Image resolution",
        thesis: [Some(More), None, Some(More)],
        of: &[("5.17", DYNAMIC)],
        factor: ("resolution", false),
        is_between: false,
        why: "",
    },
];

/// Ratios of times that differ by less say nothing: other work on the machine changes them as much.
const NOISE: f64 = 1.1;
/// Ratios of counts and bytes, which are exact, that are so near to 1 are told as no effect.
const SLIGHT: f64 = 1.01;

/// All rows of the table.
pub fn trends(data_sets: &[DataSet]) -> Vec<Trend> {
    FACTORS.iter().map(|factor| trend(factor, data_sets)).collect()
}

/// A row's number, and the ratio from which it counts as another.
type Metric = (fn(&Row) -> f64, f64);

fn trend(factor: &Factor, data_sets: &[DataSet]) -> Trend {
    let all = series(factor, data_sets);
    let metrics: [Metric; 4] = [
        (|row| row.memory_bytes as f64, SLIGHT),
        (|row| row.update_ms.median, NOISE),
        (|row| row.render_ms.median, NOISE),
        (|row| row.work as f64, SLIGHT),
    ];
    let [memory, update, render, work] = metrics.map(|(of, slight)| {
        let found = if factor.is_between { concordance(&all, of) } else { ratio(&all, of) };
        let sign = match found {
            None => None,
            Some(ratio) if ratio > slight => Some(More),
            Some(ratio) if ratio < 1.0 / slight => Some(Less),
            Some(_) => Some(Same),
        };
        (sign, found)
    });
    let ours = [memory.0, update.0, render.0];
    let is_against = |k: &usize| contradicts(factor.thesis[*k], ours[*k]);
    let contradicted: Vec<&str> = (0..3).filter(is_against).map(|k| METRICS[k]).collect();
    Trend {
        decals: factor.decals,
        factor: factor.name,
        thesis: factor.thesis,
        ours,
        ratios: [memory.1, update.1, render.1],
        work: work.0,
        work_ratio: work.1,
        explanation: if contradicted.is_empty() { "" } else { factor.why },
        contradicts: contradicted,
    }
}

/// Whether our sign is another than the thesis's. It has none where it expects no effect, of which our numbers tell for information alone.
fn contradicts(thesis: Option<Sign>, ours: Option<Sign>) -> bool {
    thesis.zip(ours).is_some_and(|(thesis, ours)| thesis != ours)
}

/// What is the same of rows that differ in one factor: data set, kind of decals, the other factors.
type Others<'a> = (usize, &'a str, Vec<(&'a str, u64)>);

/// Rows that differ in the factor alone, in growing order of it.
fn series<'a>(factor: &Factor, data_sets: &'a [DataSet]) -> Vec<Vec<&'a Row>> {
    let mut all: BTreeMap<Others, Vec<&Row>> = BTreeMap::new();
    let (name, is_reversed) = factor.factor;
    for (number, set) in data_sets.iter().enumerate() {
        let rows = set.rows.iter().filter(|row| factor.of.contains(&(row.figure, row.decals)));
        for row in rows.filter(|row| row.factors.contains_key(name)) {
            let others = row.factors.iter().filter(|(other, _)| **other != name);
            let others = others.map(|(other, value)| (*other, value.to_bits())).collect();
            let of = if factor.is_between { 0 } else { number };
            all.entry((of, row.decals, others)).or_default().push(row);
        }
    }
    let mut all: Vec<Vec<&Row>> = all.into_values().filter(|rows| rows.len() > 1).collect();
    for rows in &mut all {
        rows.sort_by(|a, b| a.factors[name].total_cmp(&b.factors[name]));
        if is_reversed {
            rows.reverse();
        }
    }
    all
}

/// How many times as much the last of a series has as the first: the geometric mean over all series that have something.
fn ratio(all: &[Vec<&Row>], of: fn(&Row) -> f64) -> Option<f64> {
    let ends = all.iter().filter_map(|rows| Some((of(rows.first()?), of(rows.last()?))));
    let logs: Vec<f64> = ends.filter(|(a, b)| *a > 0.0 && *b > 0.0).map(|(a, b)| ln(b / a)).collect();
    (!logs.is_empty()).then(|| exp(logs.iter().sum::<f64>() / logs.len() as f64))
}

/// Where scenes differ in all things, whether the larger one has more is asked of each pair of them (Kendall 1938): how many times as many pairs say so as
/// say the contrary.
fn concordance(all: &[Vec<&Row>], of: fn(&Row) -> f64) -> Option<f64> {
    let (mut more, mut less) = (0, 0);
    for rows in all {
        for (k, row) in rows.iter().enumerate() {
            more += rows[..k].iter().filter(|before| of(before) < of(row)).count();
            less += rows[..k].iter().filter(|before| of(before) > of(row)).count();
        }
    }
    (more + less > 0).then(|| (1 + more) as f64 / (1 + less) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Times;
    use crate::output::SceneResult;

    fn row(figure: &'static str, decals: &'static str, factors: &[(&'static str, f64)], bytes: u64) -> Row {
        let ms = Times::of(vec![bytes as f64]);
        let factors = factors.iter().copied().collect();
        Row { figure, decals, factors, memory_bytes: bytes, update_ms: ms, render_ms: ms, work: bytes }
    }

    fn data_set(rows: Vec<Row>) -> DataSet {
        let (origin, hash) = ([0.0; 2], String::new());
        let scene = SceneResult {
            name: "a".into(),
            hash,
            plan_space: String::new(),
            origin,
            origin_height: 0.0,
            surface_error: None,
        };
        let (amounts, groups) = Default::default();
        DataSet { scene, grid: 9, width: 1, height: 1, amounts, groups, thesis: None, rows }
    }

    fn of<'a>(all: &'a [Trend], name: &str) -> &'a Trend {
        all.iter().find(|trend| trend.factor == name).unwrap()
    }

    #[test]
    fn a_trend_is_told_by_rows_that_differ_in_its_factor_alone() {
        let wide = |width, opacity, bytes| {
            row("5.14", "static lines", &[("width", width), ("opacity", opacity)], bytes)
        };
        // Wider lines take three times as much, more transparent ones twice as much: whatever the order of the rows.
        let set = data_set(vec![
            wide(16.0, 0.5, 600),
            wide(1.0, 1.0, 100),
            wide(1.0, 0.5, 200),
            wide(16.0, 1.0, 300),
        ]);
        let all = trends(&[set]);
        let width =
            all.iter().find(|trend| (trend.decals, trend.factor) == ("Static lines", "Width")).unwrap();
        assert!((width.ratios[0].unwrap() - 3.0).abs() < 1e-9);
        assert_eq!(width.ours, [Some(More); 3]);
        assert_eq!((&width.contradicts[..], width.explanation.is_empty()), (&["update"][..], false));
        let transparency = of(&all, "Transparency");
        assert!((transparency.ratios[2].unwrap() - 2.0).abs() < 1e-9);
        assert!(transparency.contradicts.is_empty() && transparency.explanation.is_empty());
        assert_eq!(of(&all, "Leaf capacity").ours, [None; 3]);
    }

    #[test]
    fn complexity_is_told_by_pairs_of_scenes() {
        let set = |vertices, bytes| data_set(vec![row("5.5", STATIC, &[("vertices", vertices)], bytes)]);
        let rising = trends(&[set(1.0, 10), set(9.0, 40), set(3.0, 20), set(5.0, 15)]);
        assert_eq!(of(&rising, "Data complexity").ours[0], Some(More));
        let falling = trends(&[set(1.0, 40), set(2.0, 30), set(3.0, 20)]);
        assert_eq!(of(&falling, "Data complexity").ours[0], Some(Less));
        assert_eq!(of(&falling, "Data complexity").contradicts, METRICS);
    }

    #[test]
    fn every_factor_is_told_by_a_figure_that_varies_it() {
        for factor in &FACTORS {
            for (number, _) in factor.of {
                assert!(
                    super::super::FIGURES.iter().any(|figure| figure.number == *number),
                    "{}",
                    factor.name
                );
            }
        }
    }
}
