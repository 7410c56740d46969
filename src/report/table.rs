//! `report.csv`: a row a run, every number.

use super::{Report, Run, SceneReport};
use crate::output::ByName;
use serde_json::Value;

/// A column of values that only some runs have.
struct Column<'a> {
    title: String,
    name: &'a str,
    group: Group,
}

/// Where a column's values are found.
#[derive(Debug, Clone, Copy)]
enum Group {
    Device,
    Parameter,
    Count,
}

impl Group {
    fn of(self, run: &Run) -> &ByName {
        match self {
            Self::Device => &run.device,
            Self::Parameter => &run.parameters,
            Self::Count => &run.counts,
        }
    }
}

/// The text of the file (RFC 4180, lines end in a line feed): fixed columns, then one for each device setting, parameter and
/// count that any run has.
pub fn csv(report: &Report) -> String {
    let columns = columns(report);
    let titles = FIXED.iter().map(|title| (*title).to_owned());
    let mut text = line(titles.chain(columns.iter().map(|column| column.title.clone())));
    for scene in &report.scenes {
        for run in &scene.runs {
            let more = columns.iter().map(|column| value(column.group.of(run), column.name));
            text.push_str(&line(fixed(scene, run).into_iter().chain(more)));
        }
    }
    text
}

/// The columns after the fixed ones, in the order in which they are met.
fn columns(report: &Report) -> Vec<Column<'_>> {
    let mut columns: Vec<Column> = Vec::new();
    for (prefix, group) in
        [("device", Group::Device), ("parameter", Group::Parameter), ("count", Group::Count)]
    {
        for run in report.scenes.iter().flat_map(|scene| &scene.runs) {
            for (name, _) in &group.of(run).0 {
                let title = format!("{prefix}.{name}");
                if !columns.iter().any(|known| known.title == title) {
                    columns.push(Column { title, name, group });
                }
            }
        }
    }
    columns
}

const FIXED: [&str; 31] = [
    "scene",
    "scene_hash",
    "width",
    "height",
    "technique",
    "varied",
    "is_own",
    "rmse",
    "mean",
    "p99",
    "max",
    "over_one_code_value",
    "flip_mean",
    "reference_width_max",
    "is_rounded",
    "frame_ms",
    "frame_ms_min",
    "frame_ms_max",
    "prepare_ms",
    "prepare_ms_min",
    "prepare_ms_max",
    "on_front",
    "structure_bytes",
    "image_hash",
    "plan_space",
    "feature_pixels",
    "feature_rmse",
    "feature_mean",
    "feature_p99",
    "feature_max",
    "feature_over_one_code_value",
];

fn fixed(scene: &SceneReport, run: &Run) -> [String; FIXED.len()] {
    let (error, frame, prepare) = (&run.error, &run.frame_ms, &run.prepare_ms);
    [
        scene.scene.name.clone(),
        scene.scene.hash.clone(),
        scene.width.to_string(),
        scene.height.to_string(),
        run.technique.clone(),
        run.varied.join(" "),
        run.is_own.to_string(),
        error.rmse.to_string(),
        error.mean.to_string(),
        error.p99.to_string(),
        error.max.to_string(),
        error.over_one_code_value.to_string(),
        error.flip_mean.map_or(String::new(), |mean| mean.to_string()),
        scene.reference_width_max.to_string(),
        run.is_rounded.to_string(),
        frame.median.to_string(),
        frame.min.to_string(),
        frame.max.to_string(),
        prepare.median.to_string(),
        prepare.min.to_string(),
        prepare.max.to_string(),
        run.on_front.to_string(),
        run.structure_bytes.to_string(),
        run.image_hash.clone(),
        scene.scene.plan_space.clone(),
        scene.feature_pixels.to_string(),
        run.error_on_features.rmse.to_string(),
        run.error_on_features.mean.to_string(),
        run.error_on_features.p99.to_string(),
        run.error_on_features.max.to_string(),
        run.error_on_features.over_one_code_value.to_string(),
    ]
}

/// The value of a name; empty where there is none.
fn value(of: &ByName, name: &str) -> String {
    match of.0.iter().find(|(known, _)| known == name) {
        Some((_, Value::String(text))) => text.clone(),
        Some((_, value)) => value.to_string(),
        None => String::new(),
    }
}

fn line(cells: impl Iterator<Item = String>) -> String {
    let cells: Vec<String> = cells.map(|cell| escaped(&cell)).collect();
    cells.join(",") + "\n"
}

/// A cell; quoted where it holds what would end it.
pub(super) fn escaped(cell: &str) -> String {
    if cell.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_that_holds_a_separator_a_quote_or_a_line_end_is_quoted() {
        assert_eq!(["a b", "a,b", "a\"b", "a\nb"].map(escaped), ["a b", "\"a,b\"", "\"a\"\"b\"", "\"a\nb\""]);
    }
}
