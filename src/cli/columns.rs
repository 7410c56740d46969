//! Columns of attributes: told by `info`, offered by `new`.

use super::written::{harmless, key, quoted_text};
use drapery::scene::Attribute;
use drapery::source::vector::{ColumnKind, ColumnSummary, VectorSummary};

/// The most characters of a text that are shown.
const SHOWN: usize = 30;

/// What a column holds, in a line.
pub(super) fn told(column: &ColumnSummary, features: usize) -> String {
    let name = harmless(&column.name);
    let kind = column.kind;
    let is_number = matches!(kind, ColumnKind::Integer | ColumnKind::Number);
    let range = match column.range {
        Some([low, high]) if is_number && low < high => format!(" from {low} to {high}"),
        _ => String::new(),
    };
    let values = match &column.distinct {
        _ if kind == ColumnKind::Empty => String::new(),
        Some(distinct) if distinct.len() == 1 => format!(", always {}", shown(&distinct[0].0)),
        Some(distinct) if !is_number => {
            format!(", {} different: {}", distinct.len(), counted(&column.frequent))
        }
        _ => format!(", such as {}", listed(column.examples.iter().map(shown))),
    };
    let share = if kind == ColumnKind::Empty || column.values == features {
        String::new()
    } else {
        format!(", in {} of {features} features", column.values)
    };
    format!("{name}: {kind}{range}{values}{share}")
}

/// Values, and how often they are there.
fn counted(values: &[(Attribute, usize)]) -> String {
    listed(values.iter().map(|(value, count)| format!("{} ({count})", shown(value))))
}

fn listed(texts: impl Iterator<Item = String>) -> String {
    texts.collect::<Vec<_>>().join(", ")
}

fn shown(value: &Attribute) -> String {
    match value.text() {
        Some(text) if text.chars().count() > SHOWN => {
            let start: String = text.chars().take(SHOWN).collect();
            format!("{start:?}...")
        }
        _ => value.to_string(),
    }
}

/// The most columns of a kind that a starter scene offers.
const OFFERED: usize = 3;
/// Texts of more characters than these are no classes.
const LONGEST_CLASS: usize = 40;
/// Colours of classes, taken in turn: *Paired* of ColorBrewer, the strong ones first.
const CLASS_COLORS: [&str; 12] = [
    "#1f78b4", "#33a02c", "#e31a1c", "#ff7f00", "#6a3d9a", "#b15928", "#a6cee3", "#b2df8a", "#fb9a99",
    "#fdbf6f", "#cab2d6", "#ffff99",
];

/// Lines of a layer's table that its columns make possible, as comments.
pub(super) fn offers(summary: &VectorSummary) -> String {
    let mut columns: Vec<&ColumnSummary> = summary.columns.iter().collect();
    columns.sort_by_key(|column| !TAGS.contains(&&column.name[..]));
    let classes: Vec<_> = columns.into_iter().filter_map(classes).take(OFFERED).collect();
    let ramps = summary.columns.iter().filter_map(ramp).take(OFFERED);
    let maps = classes.iter().map(|(column, values)| map(column, values));
    let mut lines: Vec<String> = maps.chain(ramps).collect();
    let filter = classes.first().map(|(column, values)| {
        let written = |value: &Attribute| value.text().map_or_else(|| value.to_string(), quoted_text);
        let shown = if column.kind == ColumnKind::Boolean { 1 } else { 2 };
        let most: Vec<String> = values.iter().take(shown).map(|value| written(value)).collect();
        format!("where = {{ {} = [{}] }}", key(&column.name), most.join(", "))
    });
    lines.extend(filter.or_else(|| summary.columns.iter().find_map(bounds)));
    if lines.is_empty() {
        return String::new();
    }
    lines.push("order = \"size\"                         # larger polygons and longer lines on top".into());
    let comments: String = lines.iter().map(|line| format!("# {line}\n")).collect();
    format!(
        "# Its columns may tell a color (in place of one above; a width or an opacity, too), and what is drawn:\n{comments}"
    )
}

/// The columns of OpenStreetMap that say what a thing is, in many words.
pub(super) const TAGS: [&str; 5] = ["highway", "waterway", "natural", "building", "landuse"];

/// The different values of a column of classes, texts or flags, the most frequent first; of a column of tags the most frequent ones.
fn classes(column: &ColumnSummary) -> Option<(&ColumnSummary, Vec<&Attribute>)> {
    let is_short = |value: &&Attribute| value.text().is_none_or(|text| text.chars().count() <= LONGEST_CLASS);
    let is_class = matches!(column.kind, ColumnKind::Text | ColumnKind::Boolean);
    let is_known = column.distinct.is_some() && column.frequent.iter().all(|(value, _)| is_short(&value));
    if !is_class || column.frequent.len() < 2 || !(is_known || TAGS.contains(&&column.name[..])) {
        return None;
    }
    Some((column, column.frequent.iter().map(|(value, _)| value).filter(is_short).collect()))
}

fn map(column: &ColumnSummary, values: &[&Attribute]) -> String {
    let colors = CLASS_COLORS.iter().cycle();
    let name = |value: &Attribute| value.text().map_or_else(|| value.to_string(), key);
    let entries = values.iter().zip(colors).map(|(value, color)| format!("{} = \"{color}\"", name(value)));
    let (by, entries) = (quoted_text(&column.name), listed(entries));
    format!("color = {{ by = {by}, map = {{ {entries} }}, default = \"#808080\" }}")
}

/// The range of a column of numbers that measure something: they differ, and are no numbers of the features.
fn measured(column: &ColumnSummary) -> Option<[f64; 2]> {
    let is_number = matches!(column.kind, ColumnKind::Integer | ColumnKind::Number);
    let is_identifier = column.name.to_lowercase().ends_with("id");
    let differ = |[low, high]: &[f64; 2]| low < high && low.is_finite() && high.is_finite();
    column.range.filter(|range| is_number && !is_identifier && differ(range))
}

fn ramp(column: &ColumnSummary) -> Option<String> {
    let [low, high] = measured(column)?;
    let by = quoted_text(&column.name);
    Some(format!(
        "color = {{ by = {by}, stops = [[{low}, \"#ffffcc\"], [{high}, \"#800026\"]], default = \"#808080\" }}"
    ))
}

fn bounds(column: &ColumnSummary) -> Option<String> {
    let [low, high] = measured(column)?;
    Some(format!("where = {{ {} = {{ min = {low}, max = {high} }} }}", key(&column.name)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use drapery::scene_file::SceneFile;
    use drapery::source::load::load;
    use drapery::source::vector::describe;

    const LINES: &str = r#"{"type":"FeatureCollection","features":[
        {"type":"Feature","properties":{"is \"odd\"\n":"Feld = \"weg\"","fid":1,"h":-2.5,"name":null},"geometry":{"type":"LineString","coordinates":[[0,0],[30,20]]}},
        {"type":"Feature","properties":{"is \"odd\"\n":"b.c","fid":2,"h":1e3,"name":null},"geometry":{"type":"LineString","coordinates":[[0,0],[30,-20]]}},
        {"type":"Feature","properties":{"is \"odd\"\n":"b.c","fid":3,"name":null},"geometry":{"type":"LineString","coordinates":[[0,0],[30,0]]}}]}"#;

    fn summary() -> VectorSummary {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.json");
        std::fs::write(&path, LINES).unwrap();
        describe(&path).unwrap().remove(0)
    }

    #[test]
    fn a_column_is_told_in_a_line() {
        let told: Vec<String> = summary().columns.iter().map(|column| told(column, 3)).collect();
        assert_eq!(
            told,
            [
                "is \"odd\" : text, 2 different: \"b.c\" (2), \"Feld = \\\"weg\\\"\" (1)",
                "fid: whole numbers from 1 to 3, such as 1, 2, 3",
                "h: numbers from -2.5 to 1000, such as -2.5, 1000, in 2 of 3 features",
                "name: no values",
            ]
        );
        assert_eq!(shown(&Attribute::Text("é".repeat(31))), format!("\"{}\"...", "é".repeat(30)));
    }

    #[test]
    fn flags_are_offered_as_classes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.json");
        let flags = LINES.replace("\"fid\":1,", "\"open\":true,").replace("\"fid\":2,", "\"open\":false,");
        std::fs::write(&path, flags).unwrap();
        let offered = offers(&describe(&path).unwrap().remove(0));
        assert!(
            offered.contains("# color = { by = \"open\", map = { false = \"#1f78b4\", true = \"#33a02c\" }"),
            "{offered}"
        );
    }

    #[test]
    fn what_is_offered_can_be_drawn() {
        let offered = offers(&summary());
        let lines: Vec<&str> = offered.lines().filter_map(|line| line.strip_prefix("# ")).collect();
        let colors: Vec<&str> = lines.iter().copied().filter(|line| line.starts_with("color = ")).collect();
        let others: Vec<&str> =
            lines.iter().copied().filter(|l| l.starts_with("where") || l.starts_with("order")).collect();
        assert_eq!((colors.len(), others.len()), (2, 2), "{offered}");
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a.json"), LINES).unwrap();
        for color in colors {
            let others = others.join("\n");
            let text = format!(
                "schema = 1\nterrain.generate = {{ kind = \"plane\" }}\n[[layer]]\nsource = \"a.json\"\ncrs = \"EPSG:32733\"\n\
                 {others}\nline = {{ {color}, width_m = 3 }}\n"
            );
            let file = SceneFile::parse(&text, Some(&folder.path().join("s.toml")), &[]);
            let (scene, _) = load(&file.unwrap_or_else(|e| panic!("{e}\n{text}")), &|_| ()).unwrap();
            let layer = &scene.layers[0];
            let looks = if color.contains("stops") { 3 } else { 2 };
            assert_eq!((layer.features.len(), layer.styles.len()), (3, looks), "{text}");
        }
    }
}
