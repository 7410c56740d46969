//! The files that a scene is to be made of: which is the terrain, and what the others hold.

use drapery::crs::PlanSpace;
use drapery::source::dem::{self, DemOptions, DemSummary, PngEncoding};
use drapery::source::load;
use drapery::source::vector::{self, VectorSummary};
use drapery::space::{Plan, PlanBox};
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
    /// Its files, in the order of the call.
    pub(super) paths: Vec<&'a Path>,
    /// What the first one holds.
    pub(super) summary: DemSummary,
    /// The box around all posts, in the files' coordinates.
    pub(super) bounds: PlanBox,
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
        Ok(Self { terrain: joined(terrains)?, layers: layers(vectors) })
    }
}

/// One terrain of all files.
fn joined(terrains: Vec<Terrain<'_>>) -> Result<Terrain<'_>> {
    let mut terrains = terrains.into_iter();
    let mut all = terrains.next().ok_or_else(|| {
        Error::usage("none of these files is a terrain, and vectors lie on one")
            .help("name a .tif, .hgt, .asc, .xyz or .png of heights too")
    })?;
    for terrain in terrains {
        all.paths.extend(terrain.paths);
        all.bounds.include(terrain.bounds.min);
        all.bounds.include(terrain.bounds.max);
    }
    Ok(all)
}

/// Layers with names of their own: areas, then lines, then points.
fn layers(vectors: Vec<(&Path, VectorSummary)>) -> Vec<Layer<'_>> {
    let mut names: Vec<String> = Vec::new();
    let mut layers = Vec::new();
    for (path, summary) in vectors {
        let name = unused(&summary.layer.clone().unwrap_or_else(|| name_of(path)), &names);
        names.push(name.clone());
        layers.push(Layer { name, path, summary });
    }
    layers.sort_by_key(|layer| (layer.summary.polygons == 0, layer.summary.lines == 0));
    layers
}

impl<'a> Terrain<'a> {
    fn of(path: &'a Path) -> Result<Self> {
        let (summary, encoding) = dem::describe_guessing(path, &DemOptions::default())?;
        let [x0, y0, x1, y1] = summary.bounds;
        let bounds = PlanBox { min: Plan::new(x0, y0), max: Plan::new(x1, y1) };
        Ok(Self { paths: vec![path], summary, bounds, encoding })
    }

    /// The plan that the scene will have, where the file states a CRS.
    pub(super) fn plan(&self) -> Option<PlanSpace> {
        let crs = load::crs_of(self.summary.crs_hint.as_ref()?).ok()?;
        load::default_plan_space(crs, self.summary.bounds).ok()
    }

    /// How many degrees it spans, where it is in degrees: the larger side.
    pub(super) fn degrees(&self) -> Option<f64> {
        let crs = load::crs_of(self.summary.crs_hint.as_ref()?).ok()?;
        let size = self.bounds.max - self.bounds.min;
        Some(size.max_element() * crs.degrees_per_unit()?)
    }

    /// What is wrong with the CRS that the file states, where it cannot be used.
    pub(super) fn crs_not_read(&self) -> Option<String> {
        load::crs_of(self.summary.crs_hint.as_ref()?).err().map(|error| error.what().to_owned())
    }

    /// What the scene is called after.
    pub(super) fn name(&self) -> String {
        self.paths.first().map_or_else(String::new, |path| name_of(path))
    }
}

impl Layer<'_> {
    /// Whether there is anything that can be drawn. (An empty file is not known to hold nothing: it is refused when it is loaded.)
    pub(super) fn is_drawn(&self) -> bool {
        self.summary.polygons + self.summary.lines + self.summary.points > 0
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_are_taken_get_a_number() {
        assert_eq!(unused("a", &["a".into(), "a-2".into()]), "a-3");
    }
}
