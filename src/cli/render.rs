//! `drapery render [SCENE]`

use super::stop::{Outcome, Stop};
use clap::ValueEnum;
use drapery::scene::file::{DEFAULT_SCENE, Override, SceneFile, decode};
use drapery::{Error, Result};
use std::io::Read;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  drapery render                                        the built-in scene, every technique
  drapery render scene.toml -t truth -o pictures        only the right picture
  drapery render scene.toml -t inverse-projection --set technique.inverse-projection.samples=5
  drapery render scene.toml --set layer.roads.line.width_m=20 --set 'camera.eye=[0,-5000,3000]'
  drapery render scene.toml -t truth --buffers depth,lo,hi
  drapery new dem.tif roads.shp | drapery render -";

#[derive(Debug, clap::Args)]
#[command(after_long_help = EXAMPLES)]
pub(super) struct Arguments {
    /// The scene file, `-` for stdin; without it, a built-in generated scene.
    scene: Option<PathBuf>,
    /// How to render; may be repeated. Default: the truth and every technique that applies.
    #[arg(short, long = "technique", value_name = "T")]
    techniques: Vec<TechniqueName>,
    /// Change the scene: a dotted path and a TOML value; may be repeated. No value removes the key.
    #[arg(long = "set", value_name = "PATH=VALUE")]
    overrides: Vec<String>,
    /// Where the pictures and result.json go.
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    output: PathBuf,
    /// Intermediate buffers to write beside the picture: names such as depth,lo, or all.
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    buffers: Vec<String>,
    /// How many threads; 0: as many as the machine has. The pictures are the same.
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
    /// Time so many runs and tell the median.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    repeat: u32,
}

/// The techniques of the contract.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum TechniqueName {
    /// The right picture, as certified intervals.
    Truth,
    /// Clipmap texture (Taibo).
    Clipmap,
    /// Geometry overlay (Wartell).
    GeometryOverlay,
    /// Stencil volumes (Schneider & Klein).
    StencilVolume,
    /// Inverse projection (She).
    InverseProjection,
    /// Static decals (Zechmeister, after Thöny and Frasson).
    StaticDecal,
    /// Dynamic lines (Zechmeister).
    DynamicLine,
    /// Hierarchical classification and closed-form coverage (ours).
    Analytic,
}

/// The techniques that this version has.
const BUILT: &[TechniqueName] = &[];

pub(super) fn run(arguments: &Arguments) -> Outcome {
    arguments
        .techniques
        .iter()
        .try_for_each(|technique| built(*technique))?;
    let overrides: Result<Vec<Override>> = arguments
        .overrides
        .iter()
        .map(|text| Override::parse(text))
        .collect();
    let scene = scene(arguments.scene.as_deref(), &overrides?)?;
    let what = format!(
        "`render` is not built yet (scene `{}`, into {}, {} threads, {} runs, {} buffers)",
        scene.name,
        arguments.output.display(),
        arguments.threads,
        arguments.repeat,
        arguments.buffers.len(),
    );
    Err(Error::internal(what).into())
}

fn built(technique: TechniqueName) -> Result<()> {
    if BUILT.contains(&technique) {
        return Ok(());
    }
    let name = technique
        .to_possible_value()
        .map_or(String::new(), |value| value.get_name().to_owned());
    Err(Error::new(format!(
        "this version of drapery does not have the technique `{name}` yet"
    )))
}

/// The scene that is asked for.
fn scene(path: Option<&Path>, overrides: &[Override]) -> std::result::Result<SceneFile, Stop> {
    match path {
        None => Ok(SceneFile::parse(DEFAULT_SCENE, None, overrides)?),
        Some(path) if path == Path::new("-") => from_stdin(overrides),
        Some(path) => Ok(SceneFile::read(path, overrides)?),
    }
}

/// Relative paths of a scene on stdin start at the current folder.
fn from_stdin(overrides: &[Override]) -> std::result::Result<SceneFile, Stop> {
    let name = Path::new("<stdin>");
    let mut bytes = Vec::new();
    std::io::stdin()
        .read_to_end(&mut bytes)
        .map_err(|error| Error::new(format!("stdin cannot be read: {error}")))?;
    let text = decode(bytes, name)?;
    let refuse = |error| Stop::Refused {
        error,
        text: Some(text.clone()),
    };
    SceneFile::parse(&text, Some(name), overrides).map_err(refuse)
}
