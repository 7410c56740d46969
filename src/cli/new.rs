//! `drapery new DEM [VECTOR]...`

use super::stop::Outcome;
use drapery::scene::Shape;
use drapery::{Error, Result};
use std::fmt::Write;
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
    let mut text = head(&name_of(&arguments.dem), &arguments.dem)?;
    let mut names: Vec<String> = Vec::new();
    for path in &arguments.vectors {
        let name = unused(&name_of(path), &names);
        text.push_str(&layer(&name, path, Kinds::of(path)?, names.len())?);
        names.push(name);
    }
    if names.is_empty() {
        text.push_str(NO_LAYER);
    }
    super::print(&text)
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

/// Colours of fill and line, taken in turn.
const COLORS: [(&str, &str); 5] = [
    ("#3388ff", "#ff7f00"),
    ("#6aa84f", "#cc0000"),
    ("#e3c567", "#674ea7"),
    ("#b98a8f", "#1d4e79"),
    ("#93c47d", "#434343"),
];

/// All but the layers.
fn head(name: &str, dem: &Path) -> Result<String> {
    let source = quoted(dem)?;
    let is_png = dem
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("png"));
    let encoding = if is_png { "" } else { "# " };
    Ok(format!(
        r##"# A scene for drapery. `drapery schema` describes every key; paths are relative to this file.
schema = 1
name = {name}
# crs = "EPSG:32733"                   # the plan space; default: the terrain's own if it is projected

[image]
width = 1200
height = 800
background = "#dce9f2"
{CAMERA}
[terrain]
source = {source}
{encoding}encoding = "terrarium"             # how a PNG encodes heights: or "mapbox"
# bounds = [x0, y0, x1, y1]            # the rectangle that a PNG covers
# window = [x0, y0, x1, y1]            # read only this part, in the file's own coordinates
vertical_scale = 1.0
color = "#efe6d2"
shade = "hillshade"
"##,
        name = quoted_text(name),
    ))
}

fn layer(name: &str, path: &Path, kinds: Kinds, number: usize) -> Result<String> {
    let (fill, line) = COLORS[number % COLORS.len()];
    let mut text = format!(
        "\n[[layer]]\nname = {}\nsource = {}\n",
        quoted_text(name),
        quoted(path)?
    );
    let mut push = |style: String| {
        // Writing into a string cannot fail.
        let _ = writeln!(text, "{style}");
    };
    if kinds.polygons {
        push(format!("fill = {{ color = \"{fill}\", opacity = 0.6 }}"));
        push(format!(
            "# outline = {{ color = \"{line}\", width_m = 4.0, mode = \"inset\" }}"
        ));
    }
    if kinds.lines {
        push(format!(
            "line = {{ color = \"{line}\", width_m = 12.0, join = \"round\", cap = \"round\" }}   # or width_px = 3.0"
        ));
    }
    Ok(text)
}

/// What a vector file holds, as far as it decides which styles a layer needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Kinds {
    polygons: bool,
    lines: bool,
}

impl Kinds {
    const BOTH: Self = Self {
        polygons: true,
        lines: true,
    };

    /// Looks into the file; one that is empty gets both styles.
    fn of(path: &Path) -> Result<Self> {
        require(path)?;
        match drapery::source::vector::read(path, None) {
            Ok(file) => Ok(Self::of_shapes(
                file.features.iter().map(|feature| &feature.shape),
            )),
            Err(error) if error.is_internal() => Ok(Self::BOTH),
            Err(error) => Err(error),
        }
    }

    fn of_shapes<'a>(shapes: impl Iterator<Item = &'a Shape>) -> Self {
        let mut kinds = Self {
            polygons: false,
            lines: false,
        };
        shapes.for_each(|shape| match shape {
            Shape::Polygon(_) => kinds.polygons = true,
            Shape::Line(_) => kinds.lines = true,
        });
        if kinds.polygons || kinds.lines {
            kinds
        } else {
            Self::BOTH
        }
    }
}

fn require(path: &Path) -> Result<()> {
    let refuse = |error| Error::new(format!("this file cannot be read: {error}")).in_file(path);
    std::fs::metadata(path).map(drop).map_err(refuse)
}

fn name_of(path: &Path) -> String {
    path.file_stem()
        .map_or_else(|| "layer".into(), |stem| stem.to_string_lossy().into_owned())
}

/// The name, or the name with a number where it is taken.
fn unused(name: &str, taken: &[String]) -> String {
    let numbered = (2..).map(|number| format!("{name}-{number}"));
    let mut candidates = std::iter::once(name.to_owned()).chain(numbered);
    candidates
        .find(|candidate| !taken.contains(candidate))
        .unwrap_or_default()
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

fn quoted_text(text: &str) -> String {
    toml::Value::from(text).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use drapery::scene::file::SceneFile;

    #[test]
    fn a_starter_scene_parses_whatever_its_files_are_called() {
        for name in [
            "dem.tif",
            "dem.PNG",
            "a \"b\" 'c' \\ #.tif",
            "höhen.asc",
            "'''\"\"\".hgt",
        ] {
            let path = Path::new(name);
            let mut text = head(&name_of(path), path).unwrap();
            text.push_str(&layer("x\"y", path, Kinds::BOTH, 0).unwrap());
            text.push_str(
                &layer(
                    "z",
                    path,
                    Kinds {
                        polygons: true,
                        lines: false,
                    },
                    7,
                )
                .unwrap(),
            );
            let scene = SceneFile::parse(&text, None, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
            assert_eq!(scene.layers.len(), 2);
        }
    }

    #[test]
    fn names_that_are_taken_get_a_number() {
        assert_eq!(unused("a", &["a".into(), "a-2".into()]), "a-3");
    }

    #[test]
    fn styles_follow_what_the_file_holds() {
        let (polygon, line) = (Shape::Polygon(Vec::new()), Shape::Line(Vec::new()));
        assert_eq!(
            Kinds::of_shapes([&polygon].into_iter()),
            Kinds {
                polygons: true,
                lines: false
            }
        );
        assert_eq!(Kinds::of_shapes([&polygon, &line].into_iter()), Kinds::BOTH);
        assert_eq!(Kinds::of_shapes([].into_iter()), Kinds::BOTH);
    }
}
