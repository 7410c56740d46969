//! The files that a scene is to be made of: which is the terrain, and what the others hold.

use drapery::crs::PlanSpace;
use drapery::source::dem::{self, DemOptions, DemSummary, PngEncoding};
use drapery::source::load;
use drapery::source::vector::{self, VectorSummary};
use drapery::{Error, Result};
use std::path::{Path, PathBuf};

/// What is known of the files.
pub(super) struct Files<'a> {
    pub(super) terrain: Terrain<'a>,
    /// Vector files, a layer each, in the order of drawing.
    pub(super) layers: Vec<Layer<'a>>,
}

/// What is known of the terrain's file.
pub(super) struct Terrain<'a> {
    pub(super) path: &'a Path,
    pub(super) summary: DemSummary,
    pub(super) encoding: Option<PngEncoding>,
}

/// A layer of a vector file.
pub(super) struct Layer<'a> {
    /// Its name, which no other has.
    pub(super) name: String,
    pub(super) path: &'a Path,
    pub(super) summary: VectorSummary,
}

impl<'a> Files<'a> {
    /// Looks into all files. `progress` is told which one is read.
    pub(super) fn of(paths: &'a [PathBuf], progress: &dyn Fn(&str)) -> Result<Self> {
        for path in paths {
            let refuse = |error| Error::io("this file cannot be read", error).in_file(path);
            std::fs::metadata(path).map_err(refuse)?;
        }
        let (mut terrains, mut vectors) = (Vec::new(), Vec::new());
        for path in paths {
            progress(&format!("reading {}", path.display()));
            if vector::is_vector(path) {
                vectors.extend(vector::describe(path)?.into_iter().map(|summary| (path.as_path(), summary)));
            } else {
                terrains.push(Terrain::of(path)?);
            }
        }
        Ok(Self { terrain: only(terrains)?, layers: layers(vectors) })
    }

    /// What to say of layers that a scene cannot have.
    pub(super) fn not_drawn(&self) -> impl Iterator<Item = String> {
        let told = |layer: &Layer<'_>| format!("layer `{}`: {}", layer.name, NOT_DRAWN);
        self.layers.iter().filter(|layer| !layer.is_drawn()).map(told)
    }
}

/// What is said of a layer in which nothing can be drawn.
pub(super) const NOT_DRAWN: &str = "it holds nothing that is drawn, and is left out";

/// The one terrain.
fn only(mut terrains: Vec<Terrain<'_>>) -> Result<Terrain<'_>> {
    match (terrains.pop(), terrains.last()) {
        (None, _) => Err(Error::usage("none of these files is a terrain, and vectors lie on one")
            .help("name a .tif, .hgt, .asc, .xyz or .png of heights too")),
        (Some(terrain), None) => Ok(terrain),
        (Some(second), Some(first)) => Err(Error::usage(format!(
            "{} and {} are terrains both, and a scene has one",
            first.path.display(),
            second.path.display()
        ))
        .help("merge them first, such as with: gdal_merge.py -o all.tif FILE...")),
    }
}

/// Layers with names of their own: areas, then lines.
fn layers(vectors: Vec<(&Path, VectorSummary)>) -> Vec<Layer<'_>> {
    let mut names: Vec<String> = Vec::new();
    let mut layers = Vec::new();
    for (path, summary) in vectors {
        let name = unused(&summary.layer.clone().unwrap_or_else(|| name_of(path)), &names);
        names.push(name.clone());
        layers.push(Layer { name, path, summary });
    }
    layers.sort_by_key(|layer| layer.summary.polygons == 0);
    layers
}

impl<'a> Terrain<'a> {
    fn of(path: &'a Path) -> Result<Self> {
        let (summary, encoding) = dem::describe_guessing(path, &DemOptions::default())?;
        Ok(Self { path, summary, encoding })
    }

    /// The plan that the scene will have, where the file states a CRS.
    pub(super) fn plan(&self) -> Option<PlanSpace> {
        let crs = load::crs_of(self.summary.crs_hint.as_ref()?).ok()?;
        load::default_plan_space(crs, self.summary.bounds).ok()
    }
}

impl Layer<'_> {
    /// Whether there is anything that can be drawn. (An empty file is not known to hold nothing: it is refused when it is loaded.)
    pub(super) fn is_drawn(&self) -> bool {
        self.summary.polygons + self.summary.lines > 0
    }
}

pub(super) fn name_of(path: &Path) -> String {
    path.file_stem().map_or_else(|| "layer".into(), |stem| stem.to_string_lossy().into_owned())
}

/// The name, or the name with a number where it is taken.
fn unused(name: &str, taken: &[String]) -> String {
    let numbered = (2..).map(|number| format!("{name}-{number}"));
    let mut candidates = std::iter::once(name.to_owned()).chain(numbered);
    candidates.find(|candidate| !taken.contains(candidate)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_are_taken_get_a_number() {
        assert_eq!(unused("a", &["a".into(), "a-2".into()]), "a-3");
    }
}
