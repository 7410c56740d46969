//! A checked tree -> [`SceneFile`]: defaults, and the checks that need several values.

mod by_column;
mod camera;
mod layer;
mod style;
mod technique;
mod terrain;

use super::place::Origin;
use super::section::{Section, Taken};
use super::spec::{DataFile, SceneFile};
use super::tree::Node;
use crate::error::Result;
use crate::scene::{Color, ImageSettings};
use std::path::Path;

pub(super) use camera::check_view;
pub(super) use layer::default_name;

/// The most pixels that an image may have.
const MOST_PIXELS: usize = 1 << 26;

/// Builds the whole scene file.
pub(super) fn scene(origin: &Origin<'_>, root: Node) -> Result<SceneFile> {
    Section::read(origin, root, |root| {
        root.integer::<i64>("schema")?;
        let child = |root: &mut Section<'_>, key: &str| root.take_or_empty(key);
        let plan = root.name("plan")?.unwrap_or_default();
        Ok(SceneFile {
            path: origin.path.map(Path::to_path_buf),
            name: root.text("name")?.unwrap_or_else(|| stem(origin.path, "scene")),
            crs: root.text("crs")?,
            plan,
            image: Section::read(origin, child(root, "image"), image)?,
            camera: Section::read(origin, child(root, "camera"), |section| camera::camera(section, plan))?,
            terrain: Section::read(origin, child(root, "terrain"), terrain::terrain)?,
            layers: layer::layers(root)?,
            compositing: root.settings()?,
            device: root.settings()?,
            technique: Section::read(origin, child(root, "technique"), technique::techniques)?,
            // Of the whole tree, which is being taken apart here.
            hash: String::new(),
        })
    })
}

fn image(section: &mut Section<'_>) -> Result<ImageSettings> {
    let width = section.integer("width")?.unwrap_or(1200);
    let (height, place) = match section.integer_at("height")? {
        Some(Taken { value, place }) => (value, place),
        None => (800, section.place().clone()),
    };
    if width * height > MOST_PIXELS {
        let what = format!("`image` of {width} x {height} pixels is too large: at most 2^26 in all");
        return Err(section.error_at(&place, what));
    }
    let background = section.color("background")?.unwrap_or(Color([1.0; 4]));
    Ok(ImageSettings { width, height, background })
}

/// A rectangle x0, y0, x1, y1 that is not empty.
fn rectangle(section: &mut Section<'_>, key: &str) -> Result<Option<[f64; 4]>> {
    let Some(Taken { value, place }) = section.numbers_at::<4>(key)? else {
        return Ok(None);
    };
    let [x0, y0, x1, y1] = value;
    if !((x1 - x0).is_finite() && (y1 - y0).is_finite()) {
        return Err(section.error_at(&place, format!("`{key}` is larger than numbers can tell")));
    }
    if x0 < x1 && y0 < y1 {
        return Ok(Some(value));
    }
    let what = format!("`{key}` is empty: x0 < x1 and y0 < y1 must hold in [x0, y0, x1, y1]");
    Err(section.error_at(&place, what))
}

/// A data file beside the scene file.
fn data_file(origin: &Origin<'_>, taken: Taken<String>) -> DataFile {
    let folder = origin.path.and_then(Path::parent).unwrap_or(Path::new(""));
    DataFile {
        path: folder.join(&taken.value),
        position: origin.position(&taken.place),
        written: taken.value,
    }
}

/// A file's name without its extension.
fn stem(path: Option<&Path>, otherwise: &str) -> String {
    let stem = path.and_then(Path::file_stem).map(|stem| stem.to_string_lossy().into_owned());
    stem.filter(|stem| !stem.is_empty() && !stem.starts_with('<')).unwrap_or_else(|| otherwise.into())
}
