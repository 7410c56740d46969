//! A scene in pieces that can be left out.

use crate::error::{Error, Result};
use crate::scene::{Camera, Fill, ImageSettings, Layer, Scene, Shape, Style};
use crate::scene_file::SceneText;
use crate::space::{Plan, World};
use std::path::Path;
use toml::{Table, Value};

/// A scene whose features are all written in it.
#[derive(Debug, Clone, PartialEq)]
pub struct Draft {
    /// What stays as it is written: schema, CRS, terrain, device, compositing, techniques.
    pub(super) head: Table,
    /// Size and background.
    pub image: ImageSettings,
    /// Absolute.
    pub(super) camera: Camera,
    /// In drawing order.
    pub layers: Vec<DraftLayer>,
}

/// Features that look alike.
#[derive(Debug, Clone, PartialEq)]
pub struct DraftLayer {
    /// Its name.
    pub name: String,
    pub(super) opacity: f64,
    pub(super) style: Style,
    pub(super) outside: Option<Fill>,
    /// In absolute plan coordinates.
    pub features: Vec<Shape>,
}

/// The scene file with all features in it, as bundles have it.
pub const SCENE_FILE: &str = "scene.inline.toml";

/// The keys that stay as they are written.
const KEPT: [&str; 7] = ["schema", "name", "crs", "terrain", "compositing", "device", "technique"];

impl Draft {
    /// Of a scene file and what was loaded of it.
    ///
    /// # Errors
    /// On a globe.
    pub fn of(text: &SceneText, scene: &Scene) -> Result<Self> {
        if scene.globe.is_some() {
            return Err(Error::unsupported("a scene on a globe cannot be reduced")
                .help("reduce one over a plane, or leave things out by hand"));
        }
        let mut head: Table =
            text.table()?.into_iter().filter(|(key, _)| KEPT.contains(&key.as_str())).collect();
        let folder = text.file.path.as_deref().and_then(Path::parent);
        if let (Some(Value::Table(terrain)), Some(folder)) = (head.get_mut("terrain"), folder) {
            for key in ["source", "imagery"] {
                terrain.get_mut(key).into_iter().for_each(|path| make_absolute(path, folder));
            }
        }
        let (origin, camera) = (scene.origin, scene.camera);
        let absolute = |at: World| at + origin;
        Ok(Self {
            head,
            image: scene.image,
            camera: Camera { eye: absolute(camera.eye), target: absolute(camera.target), ..camera },
            layers: scene.layers.iter().flat_map(|layer| of_one_style(layer, origin.truncate())).collect(),
        })
    }

    /// How many features there are.
    pub fn features(&self) -> usize {
        self.layers.iter().map(|layer| layer.features.len()).sum()
    }

    /// How many vertices they have.
    pub fn vertices(&self) -> usize {
        let features = self.layers.iter().flat_map(|layer| &layer.features);
        features.flat_map(Shape::parts).map(Vec::len).sum()
    }
}

/// A layer's features, run by run of one style; points of the plan are moved by `origin`.
fn of_one_style(layer: &Layer, origin: glam::DVec2) -> Vec<DraftLayer> {
    let alone = |features: Vec<Shape>, style: Style| DraftLayer {
        name: layer.name.clone(),
        opacity: layer.opacity,
        style,
        outside: layer.outside,
        features,
    };
    let runs = layer.features.chunk_by(|a, b| a.style == b.style);
    let of_run = |run: &[crate::scene::Feature]| {
        let features = run.iter().map(|feature| moved(&feature.shape, origin)).collect();
        alone(features, *layer.style_of(&run[0]))
    };
    runs.map(of_run).collect()
}

fn moved(shape: &Shape, by: glam::DVec2) -> Shape {
    let part = |part: &Vec<Plan>| -> Vec<Plan> { part.iter().map(|p| *p + by).collect() };
    let parts = |parts: &[Vec<Plan>]| -> Vec<Vec<Plan>> { parts.iter().map(part).collect() };
    match shape {
        Shape::Polygon(rings) => Shape::Polygon(parts(rings)),
        // No scene file has one: globes are refused.
        Shape::MultiPolygon(members) | Shape::Swath { members, .. } => {
            Shape::MultiPolygon(members.iter().map(|member| parts(member)).collect())
        }
        Shape::Line(lines) => Shape::Line(parts(lines)),
        Shape::Points(points) => Shape::Points(part(points)),
    }
}

/// Paths from the scene's folder, one or several.
fn make_absolute(path: &mut Value, folder: &Path) {
    match path {
        Value::String(text) => {
            let joined = folder.join(&*text);
            let whole = std::path::absolute(&joined).unwrap_or(joined);
            *text = whole.display().to_string();
        }
        Value::Array(paths) => paths.iter_mut().for_each(|path| make_absolute(path, folder)),
        _ => {}
    }
}
