//! `drapery new DEM [VECTOR]...`

use super::columns::offers;
use super::info::encoding_name;
use super::print::print;
use super::stop::Outcome;
use super::written::{harmless, quoted_text};
use drapery::crs::{Crs, PlanSpace};
use drapery::source::dem::{self, DemOptions, DemSummary, PngEncoding};
use drapery::source::load;
use drapery::source::vector::{self, VectorSummary};
use drapery::space::{Plan, PlanBox};
use drapery::{Error, Result};
use std::path::{Path, PathBuf};

#[derive(Debug, clap::Args)]
#[command(after_long_help = "\
Examples:
  drapery new dem.tif lakes.geojson roads.shp > scene.toml
  drapery render scene.toml

Paths are written as given: save the scene in the folder where you call this, or adapt them.")]
pub(super) struct Arguments {
    /// The terrain's file.
    dem: PathBuf,
    /// Vector files, drawn in this order.
    vectors: Vec<PathBuf>,
}

pub(super) fn run(arguments: &Arguments) -> Outcome {
    require(&arguments.dem)?;
    let mut vectors = Vec::new();
    for path in &arguments.vectors {
        require(path)?;
        let summaries = vector::describe(path)?;
        vectors.extend(summaries.into_iter().map(|summary| (path.as_path(), summary)));
    }
    let terrain = Terrain::of(&arguments.dem)?;
    print(&scene(&terrain, &vectors)?)
}

/// What is known of the terrain's file.
struct Terrain<'a> {
    path: &'a Path,
    summary: DemSummary,
    encoding: Option<PngEncoding>,
}

impl<'a> Terrain<'a> {
    fn of(path: &'a Path) -> Result<Self> {
        let (summary, encoding) = dem::describe_guessing(path, &DemOptions::default())?;
        Ok(Self { path, summary, encoding })
    }

    /// The plan that the scene will have, where the file states a CRS.
    fn plan(&self) -> Option<PlanSpace> {
        let crs = load::crs_of(self.summary.crs_hint.as_ref()?).ok()?;
        load::default_plan_space(crs, self.summary.bounds).ok()
    }

    /// The diagonal in plan metres.
    fn diagonal(&self) -> f64 {
        let [x0, y0, x1, y1] = self.summary.bounds;
        let plan = self.plan();
        let metre = plan.as_ref().and_then(|plan| plan.crs().metres_per_unit()).unwrap_or(1.0);
        let local = plan.as_ref().and_then(PlanSpace::metres_per_degree);
        let (east, north) = local.unwrap_or((metre, metre));
        let (x, y) = ((x1 - x0) * east, (y1 - y0) * north);
        (x * x + y * y).sqrt()
    }
}

/// The whole scene file.
fn scene(terrain: &Terrain<'_>, vectors: &[(&Path, VectorSummary)]) -> Result<String> {
    let mut text = head(terrain, vectors)?;
    let mut names: Vec<String> = Vec::new();
    let width = two_digits(terrain.diagonal() / 600.0);
    for (path, summary) in vectors {
        let name = unused(&summary.layer.clone().unwrap_or_else(|| name_of(path)), &names);
        text.push_str(&layer(&name, path, summary, (names.len(), width))?);
        names.push(name);
    }
    if names.is_empty() {
        text.push_str(NO_LAYER);
    }
    Ok(text)
}

const CAMERA: &str = r##"
# Without eye and target the camera looks from the south and frames the layers.
[camera]
# eye = [0.0, -5000.0, 3000.0]         # plan x, plan y, height in metres; or eye_geo = [longitude, latitude, height]
# target = [0.0, 0.0, 500.0]
fov_y_deg = 45.0
"##;

const NO_LAYER: &str = r##"
# [[layer]]
# name = "roads"
# source = "roads.shp"                 # .geojson .json .shp .fgb .gpkg
# line = { color = "#ff7f00", width_m = 12.0, join = "round", cap = "round" }
"##;

/// Colours of fill, outline and line, taken in turn.
const COLORS: [(&str, &str, &str); 5] = [
    ("#3388ff", "#1d4e79", "#ff7f00"),
    ("#6aa84f", "#38611f", "#cc0000"),
    ("#e3c567", "#7f6000", "#674ea7"),
    ("#b98a8f", "#8a5a62", "#1d4e79"),
    ("#93c47d", "#274e13", "#434343"),
];

/// All but the layers.
fn head(terrain: &Terrain<'_>, vectors: &[(&Path, VectorSummary)]) -> Result<String> {
    Ok(format!(
        r##"# A scene for drapery. `drapery schema` describes every key; paths are relative to this file.
schema = 1
name = {name}
{plan}
[image]
width = 1200
height = 800
background = "#dce9f2"
{CAMERA}
[terrain]
source = {source}
{crs}{encoding}# window = [x0, y0, x1, y1]            # read only this part, in the file's own coordinates
vertical_scale = 1.0
color = "#efe6d2"
shade = "hillshade"
"##,
        name = quoted_text(&name_of(terrain.path)),
        plan = plan_lines(terrain),
        source = quoted(terrain.path)?,
        crs = crs_lines(terrain, vectors)?,
        encoding = encoding_lines(terrain),
    ))
}

/// What the plan is.
fn plan_lines(terrain: &Terrain<'_>) -> String {
    let what = match terrain.plan() {
        Some(plan) => harmless(&plan.describe()),
        None => "the terrain's coordinates, in metres".into(),
    };
    format!(
        "# The plan: {what}.\n# crs = \"EPSG:32733\"                   # another plan space; the terrain is resampled\n"
    )
}

/// The terrain's CRS, where its file does not state one.
fn crs_lines(terrain: &Terrain<'_>, vectors: &[(&Path, VectorSummary)]) -> Result<String> {
    if terrain.plan().is_some() {
        return Ok(String::new());
    }
    let ground = bounds(&terrain.summary);
    let guess = vectors.iter().find_map(|(path, summary)| {
        let crs = summary.crs.as_ref()?;
        let code = crs.epsg()?;
        (summary.bounds.meets(&ground) && can_hold(crs, &ground)).then_some((*path, code))
    });
    Ok(match guess {
        Some((path, code)) => format!(
            "crs = \"EPSG:{code}\"                    # the file does not say it: taken from {}, which lies on it\n",
            quoted(path)?
        ),
        None => "# crs = \"EPSG:32733\"                   # the file does not say it\n".into(),
    })
}

/// Whether a rectangle can be in a CRS: one in degrees ends at the poles. (A GeoJSON of metres still counts as degrees.)
fn can_hold(crs: &Crs, bounds: &PlanBox) -> bool {
    let on_globe = |p: Plan| p.x.abs() <= 360.0 && p.y.abs() <= 90.0;
    !crs.is_geographic() || (on_globe(bounds.min) && on_globe(bounds.max))
}

fn bounds(summary: &DemSummary) -> PlanBox {
    let [x0, y0, x1, y1] = summary.bounds;
    PlanBox { min: Plan::new(x0, y0), max: Plan::new(x1, y1) }
}

/// What a PNG does not say itself.
fn encoding_lines(terrain: &Terrain<'_>) -> String {
    let Some(encoding) = terrain.encoding else {
        return String::new();
    };
    let [low, high] = terrain.summary.heights.unwrap_or_default();
    format!(
        "encoding = \"{}\"{:<18}# its heights are then {low:.1} to {high:.1}; the other encoding gives none on Earth\n\
         # bounds = [x0, y0, x1, y1]            # the rectangle that the PNG covers, in the terrain's crs\n",
        encoding_name(encoding),
        ""
    )
}

/// The table of a layer; `(number, width)`: its place among the layers, and how wide a line is to be seen.
fn layer(name: &str, path: &Path, summary: &VectorSummary, (number, width): (usize, f64)) -> Result<String> {
    if summary.features > 0 && summary.polygons + summary.lines == 0 {
        let what =
            summary.layer.as_ref().map_or(String::new(), |layer| format!(", layer {}", quoted_text(layer)));
        return Ok(format!(
            "\n# {}{what} holds nothing that is drawn: polygons and lines are.\n",
            quoted(path)?
        ));
    }
    let (fill, border, line) = COLORS[number % COLORS.len()];
    let mut text = format!("\n[[layer]]\nname = {}\nsource = {}\n", quoted_text(name), quoted(path)?);
    if let Some(layer) = &summary.layer {
        text += &format!("layer = {}\n", quoted_text(layer));
    }
    let neither = summary.polygons + summary.lines == 0;
    if summary.polygons > 0 || neither {
        text += &format!("fill = {{ color = \"{fill}\", opacity = 0.6 }}\n");
        let thin = two_digits(width / 3.0);
        text += &format!("outline = {{ color = \"{border}\", width_m = {thin}, mode = \"inset\" }}\n");
    }
    if summary.lines > 0 || neither {
        text += &format!(
            "line = {{ color = \"{line}\", width_m = {width}, join = \"round\", cap = \"round\" }}   # or width_px = 3.0\n"
        );
    }
    text += &offers(summary);
    Ok(text)
}

/// A width to two digits.
fn two_digits(width: f64) -> f64 {
    let rounded = format!("{width:.1e}").parse().unwrap_or(width);
    if rounded > 0.0 { rounded } else { 1.0 }
}

fn require(path: &Path) -> Result<()> {
    let refuse = |error| Error::io("this file cannot be read", error).in_file(path);
    std::fs::metadata(path).map(drop).map_err(refuse)
}

fn name_of(path: &Path) -> String {
    path.file_stem().map_or_else(|| "layer".into(), |stem| stem.to_string_lossy().into_owned())
}

/// The name, or the name with a number where it is taken.
fn unused(name: &str, taken: &[String]) -> String {
    let numbered = (2..).map(|number| format!("{name}-{number}"));
    let mut candidates = std::iter::once(name.to_owned()).chain(numbered);
    candidates.find(|candidate| !taken.contains(candidate)).unwrap_or_default()
}

/// A path as a TOML string.
fn quoted(path: &Path) -> Result<String> {
    let refuse = || {
        Error::new("a scene file is UTF-8 text and cannot name this path")
            .in_file(path)
            .help("rename the file")
    };
    path.to_str().map(quoted_text).ok_or_else(refuse)
}

#[cfg(test)]
mod tests {
    use super::*;
    use drapery::scene_file::{LayerSource, SceneFile};

    const GRID: &str = "ncols 3\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 100\n1 2 3\n4 5 6\n";
    const BOTH: &str = r#"{"type":"FeatureCollection","features":[
        {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[0,0],[100,50]]}},
        {"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[0,0],[100,50],[0,50],[0,0]]]}}]}"#;

    #[test]
    fn a_starter_scene_parses_whatever_its_files_are_called() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["dem", "a \"b\" 'c' \\ #", "höhen", "'''\"\"\"", "new\nline\ttab"] {
            let grid = folder.path().join(format!("{name}.asc"));
            let json = folder.path().join(format!("{name}.json"));
            std::fs::write(&grid, GRID).unwrap();
            std::fs::write(&json, BOTH).unwrap();
            let summary = || vector::describe(&json).unwrap().remove(0);
            let vectors = [(json.as_path(), summary()), (json.as_path(), summary())];
            let text = scene(&Terrain::of(&grid).unwrap(), &vectors).unwrap();
            let parsed = SceneFile::parse(&text, None, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
            assert_eq!(parsed.layers[1].name, format!("{name}-2"));
            let LayerSource::File { file, .. } = &parsed.layers[0].source else { panic!("no file") };
            assert_eq!(file.path, json);
        }
    }

    #[test]
    fn a_terrain_in_metres_does_not_get_the_degrees_of_a_geojson_that_lies_on_it() {
        let folder = tempfile::tempdir().unwrap();
        let (grid, json) = (folder.path().join("dem.asc"), folder.path().join("both.json"));
        std::fs::write(&json, BOTH).unwrap();
        let line = |cell: &str| {
            std::fs::write(&grid, GRID.replace("cellsize 100", cell)).unwrap();
            let summary = vector::describe(&json).unwrap().remove(0);
            crs_lines(&Terrain::of(&grid).unwrap(), &[(json.as_path(), summary)]).unwrap()
        };
        assert!(line("cellsize 100").starts_with("# crs"), "{}", line("cellsize 100"));
        assert!(line("cellsize 10").starts_with("crs = \"EPSG:4326\""), "{}", line("cellsize 10"));
    }

    #[test]
    fn names_that_are_taken_get_a_number() {
        assert_eq!(unused("a", &["a".into(), "a-2".into()]), "a-3");
    }

    #[test]
    fn widths_have_two_digits() {
        assert_eq!([145.6, 0.0123, 9.96, 0.0].map(two_digits), [150.0, 0.012, 10.0, 1.0]);
    }
}
