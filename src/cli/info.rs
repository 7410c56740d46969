//! `drapery info FILE`

use super::bar::Bar;
use super::columns::told;
use super::print::print;
use super::stop::Outcome;
use clap::ValueEnum;
use drapery::crs::PlanSpace;
use drapery::measure::Watch;
use drapery::scene_file::{
    CameraSpec, GroundColorsSpec, LayerSource, PlanKind, SceneFile, Spot, TerrainSource, ViewSpec,
};
use drapery::source::dem::{self, DemOptions, DemSummary, PngEncoding};
use drapery::source::load;
use drapery::source::vector::{self, ColumnSummary, VectorSummary};
use drapery::{Error, Result};
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  drapery info dem.tif
  drapery info --encoding mapbox tile.png
  drapery info scene.toml";

#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub(super) struct Arguments {
    /// A terrain, vector or scene file.
    file: PathBuf,
    /// How a PNG encodes heights. Default: the encoding that gives heights which the Earth has.
    #[arg(long, value_name = "NAME")]
    encoding: Option<Encoding>,
}

/// How a PNG encodes heights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Encoding {
    /// R * 256 + G + B / 256 - 32768 metres.
    Terrarium,
    /// (R * 65536 + G * 256 + B) / 10 - 10000 metres.
    Mapbox,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    let path = &arguments.file;
    std::fs::metadata(path).map_err(|error| Error::io("this file cannot be read", error).in_file(path))?;
    let bar = Bar::new();
    bar.start(&format!("reading {}", path.display()));
    let tables = match extension(path).as_str() {
        "toml" => vec![of_scene(&SceneFile::read(path, &[])?)],
        _ if vector::is_vector(path) => of_vectors(path)?,
        _ => vec![of_terrain(path, arguments.encoding)?],
    };
    drop(bar);
    let text: Vec<String> = tables.iter().map(Table::text).collect();
    print(&text.join("\n"))
}

fn extension(path: &Path) -> String {
    let extension = path.extension().unwrap_or_default();
    extension.to_string_lossy().to_ascii_lowercase()
}

/// A headline, and rows of a name and what is said of it.
struct Table {
    headline: String,
    rows: Vec<(&'static str, String)>,
}

impl Table {
    fn new(headline: String) -> Self {
        Self { headline, rows: Vec::new() }
    }

    fn row(&mut self, name: &'static str, text: impl Into<String>) {
        self.rows.push((name, text.into()));
    }

    fn notes(&mut self, notes: &[String]) {
        notes.iter().for_each(|note| self.row("note", note.clone()));
    }

    fn text(&self) -> String {
        let line = |(name, text): &(&str, String)| format!("  {name:<11} {text}\n");
        format!("{}\n{}", self.headline, self.rows.iter().map(line).collect::<String>())
    }
}

fn of_terrain(path: &Path, encoding: Option<Encoding>) -> Result<Table> {
    let options = DemOptions {
        encoding: encoding.map(|encoding| match encoding {
            Encoding::Terrarium => PngEncoding::Terrarium,
            Encoding::Mapbox => PngEncoding::Mapbox,
        }),
        ..DemOptions::default()
    };
    let (summary, guessed) = dem::describe_guessing(path, &options)?;
    let mut table = Table::new(format!("{}: terrain, {}", path.display(), summary.format));
    match summary.size {
        Some((columns, rows)) => table.row("posts", format!("{columns} x {rows} ({})", summary.count)),
        None => table.row("points", summary.count.to_string()),
    }
    let packed = summary.compression.replace("none", "uncompressed");
    let stored = [&summary.sample, &packed, &summary.layout].map(String::as_str);
    table.row("stored as", stored.join(", "));
    if let Some(encoding) = guessed {
        let name = encoding_name(encoding);
        let how = if options.encoding.is_some() {
            "as told"
        } else {
            "the one that gives heights which the Earth has"
        };
        table.row("encoding", format!("{name}, {how}"));
    }
    if let Some([x, y]) = summary.cell {
        table.row("cell", format!("{} x {}", number(x), number(y)));
    }
    table.row("posts span", spans(summary.bounds));
    if summary.size.is_some() {
        table.row("cells span", spans(summary.edges));
    }
    match summary.heights {
        Some([low, high]) => table.row("heights", format!("{} to {}", number(low), number(high))),
        None => table.row("heights", "none: no post holds data"),
    }
    table.row("no data", no_data(&summary));
    plan(&summary, &mut table);
    table.notes(&summary.notes);
    Ok(table)
}

/// The word of a scene file for an encoding.
pub(super) fn encoding_name(encoding: PngEncoding) -> &'static str {
    match encoding {
        PngEncoding::Terrarium => "terrarium",
        PngEncoding::Mapbox => "mapbox",
    }
}

fn no_data(summary: &DemSummary) -> String {
    let share = 100.0 * summary.nodata_count as f64 / summary.count as f64;
    let declared = summary.nodata.as_deref().unwrap_or("no value declared");
    match summary.nodata_count {
        0 => format!("{declared}; all posts hold data"),
        count => format!("{declared}; {} ({share:.1} %) without data", counted(count, "post")),
    }
}

/// The CRS, and the plan that a scene of this terrain has.
fn plan(summary: &DemSummary, table: &mut Table) {
    let Some(hint) = &summary.crs_hint else {
        return table
            .row("CRS", "not stated: say it in the scene (terrain.crs), or coordinates are taken as metres");
    };
    let crs = match load::crs_of(hint) {
        Ok(crs) => crs,
        Err(error) => {
            let why = error.what();
            let text = format!(
                "stated, but cannot be used: {why} (say in the scene as terrain.crs what its coordinates are in, or they are taken as \
                 metres)"
            );
            return table.row("CRS", text);
        }
    };
    table.row("CRS", crs.name());
    if let Some(note) = crs.note() {
        table.row("note", note);
    }
    match load::default_plan_space(crs, summary.bounds) {
        Ok(space) => local_plane(&space, summary, table),
        Err(error) => table.row("plan", error.what()),
    }
}

fn local_plane(space: &PlanSpace, summary: &DemSummary, table: &mut Table) {
    let [_, south, _, north] = summary.bounds;
    let (Some((east_error, north_error)), Some((east, northward))) =
        (load::scale_error(space, south, north), space.metres_per_degree())
    else {
        return;
    };
    table.row("plan", space.describe());
    table.row("", format!("a degree is {east:.3} m east, {northward:.3} m north"));
    table.row(
        "",
        format!(
            "at the edges lengths are up to {:.3} % off east-west, {:.3} % north-south",
            100.0 * east_error,
            100.0 * north_error
        ),
    );
    if let Some([x, y]) = summary.cell {
        table.row("", format!("a cell is {:.3} m x {:.3} m", x * east, y * northward));
    }
}

fn of_vectors(path: &Path) -> Result<Vec<Table>> {
    let summaries = vector::describe(path)?;
    Ok(summaries.iter().map(|summary| of_layer(path, summary)).collect())
}

fn of_layer(path: &Path, summary: &VectorSummary) -> Table {
    let layer = summary.layer.as_ref().map_or(String::new(), |name| format!(", layer `{name}`"));
    let mut table = Table::new(format!("{}: vectors, {}{layer}", path.display(), summary.format));
    let counts = [(summary.polygons, "polygon"), (summary.lines, "line"), (summary.points, "point")];
    let counts = counts.iter().filter(|(count, _)| *count > 0);
    let kinds: Vec<String> = counts.map(|(count, kind)| counted(*count, kind)).collect();
    let kinds = if kinds.is_empty() { "none that is drawn".into() } else { kinds.join(", ") };
    table.row("features", format!("{} ({kinds})", summary.features));
    table.row("parts", summary.parts.to_string());
    table.row("vertices", summary.vertices.to_string());
    let (low, high) = (summary.bounds.min, summary.bounds.max);
    if !summary.bounds.is_empty() {
        table.row("span", spans([low.x, low.y, high.x, high.y]));
    }
    match (&summary.crs, &summary.crs_not_read) {
        (Some(crs), _) => table.row("CRS", crs.name()),
        (None, Some(words)) => {
            table.row(
                "CRS",
                format!("{words} (say in the scene as the layer's crs what its coordinates are in)"),
            );
        }
        (None, None) => table.row("CRS", "not stated: taken for the scene's"),
    }
    columns(summary, &mut table);
    table.notes(&summary.notes);
    if summary.polygons + summary.lines + summary.points == 0 {
        table.row("note", "nothing in it can be drawn: a scene that names it is refused");
    }
    table
}

/// The most columns that are told.
const MOST_COLUMNS: usize = 40;

/// All columns, or those that most features have a value in (of equals the first ones), in the file's order.
fn columns(summary: &VectorSummary, table: &mut Table) {
    let mut columns: Vec<(usize, &ColumnSummary)> = summary.columns.iter().enumerate().collect();
    columns.sort_by_key(|(_, column)| std::cmp::Reverse(column.values));
    let others = columns.split_off(columns.len().min(MOST_COLUMNS));
    columns.sort_by_key(|(place, _)| *place);
    for (_, column) in columns {
        table.row("column", told(column, summary.features));
    }
    if let Some((_, most)) = others.first() {
        let (more, values) = (others.len(), counted(most.values, "feature"));
        table.row("columns", format!("and {more} more, in at most {values} each"));
    }
}

fn of_scene(scene: &SceneFile) -> Table {
    let mut table = Table::new(format!("{}: scene", scene.name));
    table.row("image", format!("{} x {}", scene.image.width, scene.image.height));
    table.row("camera", camera(&scene.camera));
    let plan = match scene.plan {
        PlanKind::Plane => scene.crs.clone().unwrap_or_else(|| "the terrain's".into()),
        PlanKind::Globe => "the globe of the terrain's longitudes and latitudes".into(),
    };
    table.row("plan", plan);
    table.row(
        "terrain",
        match &scene.terrain.source {
            TerrainSource::Files(files) => {
                files.iter().map(|file| file.written.as_str()).collect::<Vec<_>>().join(", ")
            }
            TerrainSource::Generate(terrain) => {
                format!("generated, {} x {} posts", terrain.posts.0, terrain.posts.1)
            }
        },
    );
    if let GroundColorsSpec::Imagery(file) = &scene.terrain.ground.colors {
        table.row("imagery", file.written.clone());
    }
    for layer in &scene.layers {
        let source = match &layer.source {
            LayerSource::File { file, layer: None } => file.written.clone(),
            LayerSource::File { file, layer: Some(layer) } => format!("{}, layer `{layer}`", file.written),
            LayerSource::Inline(shapes) => format!("{} features", shapes.len()),
            LayerSource::Generate(_) => "generated".into(),
        };
        table.row("layer", format!("{} ({source})", layer.name));
    }
    table
}

fn camera(camera: &CameraSpec) -> String {
    let spot = |spot: Spot| {
        let (at, what) = match spot {
            Spot::Plan(at) => (at, ""),
            Spot::Geo(at) => (at, " (longitude, latitude, height)"),
        };
        format!("{}, {}, {}{what}", number(at.x), number(at.y), number(at.z))
    };
    match camera.view {
        Some(ViewSpec { eye, target }) => format!("from {} to {}", spot(eye), spot(target)),
        None => "from the south, framing the layers".into(),
    }
}

fn counted(count: usize, what: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {what}{plural}")
}

fn spans([x0, y0, x1, y1]: [f64; 4]) -> String {
    format!("x {} to {}, y {} to {}", number(x0), number(x1), number(y0), number(y1))
}

/// A number with at most eight decimals.
fn number(v: f64) -> String {
    let text = format!("{v:.8}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" { "0".into() } else { short.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_end_where_they_say_nothing_more() {
        assert_eq!([1200.0, -0.5, 1e-12, -1e-12].map(number), ["1200", "-0.5", "0", "0"]);
        assert_eq!(number(1.0 / 1200.0), "0.00083333");
    }

    /// What is told of a layer of such features.
    fn told_of(features: &str) -> String {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.json");
        std::fs::write(&path, format!(r#"{{"type":"FeatureCollection","features":[{features}]}}"#)).unwrap();
        of_vectors(&path).unwrap()[0].text()
    }

    #[test]
    fn points_are_something_that_is_drawn() {
        let feature =
            |geometry: &str| format!(r#"{{"type":"Feature","properties":null,"geometry":{geometry}}}"#);
        let points = told_of(&feature(r#"{"type":"Point","coordinates":[1,2]}"#));
        assert!(points.contains("1 point") && !points.contains("nothing in it"), "{points}");
        let empty = told_of(&feature("null"));
        assert!(empty.contains("nothing in it can be drawn"), "{empty}");
    }

    #[test]
    fn of_many_columns_that_all_features_have_the_first_are_told() {
        let properties: Vec<String> = (0..50).map(|number| format!(r#""c{number:02}":1"#)).collect();
        let feature = format!(
            r#"{{"type":"Feature","properties":{{{}}},"geometry":{{"type":"Point","coordinates":[1,2]}}}}"#,
            properties.join(",")
        );
        let told = told_of(&feature);
        assert!(told.contains("c00: ") && told.contains("c39: ") && !told.contains("c40: "), "{told}");
        assert!(told.contains("and 10 more, in at most 1 feature each"), "{told}");
    }
}
