//! A checked tree -> [`SceneFile`]: defaults, and the checks that need several values.

mod camera;
mod layer;
mod technique;
mod terrain;
mod values;

use super::place::Origin;
use super::section::{Section, Taken};
use super::spec::SceneFile;
use super::tree::Node;
use crate::error::Result;
use crate::scene::{Color, Compositing, Device, ImageSettings};
use std::path::Path;
use values::stem;

pub(super) use camera::check_view;
pub(super) use layer::default_name;

/// The most pixels that an image may have.
const MOST_PIXELS: usize = 1 << 26;

/// Builds the whole scene file.
pub(super) fn scene(origin: &Origin<'_>, root: Node) -> Result<SceneFile> {
    Section::read(origin, root, |root| {
        root.integer::<i64>("schema")?;
        let child = |root: &mut Section<'_>, key: &str| root.take_or_empty(key);
        Ok(SceneFile {
            path: origin.path.map(Path::to_path_buf),
            name: root.text("name")?.unwrap_or_else(|| stem(origin.path, "scene")),
            crs: root.text("crs")?,
            image: Section::read(origin, child(root, "image"), image)?,
            camera: Section::read(origin, child(root, "camera"), camera::camera)?,
            terrain: Section::read(origin, child(root, "terrain"), terrain::terrain)?,
            layers: layer::layers(root)?,
            compositing: Section::read(origin, child(root, "compositing"), compositing)?,
            device: Section::read(origin, child(root, "device"), device)?,
            technique: Section::read(origin, child(root, "technique"), technique::technique)?,
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

fn compositing(section: &mut Section<'_>) -> Result<Compositing> {
    Ok(Compositing {
        space: section.name("space")?.unwrap_or_default(),
        mode: section.name("mode")?.unwrap_or_default(),
    })
}

fn device(section: &mut Section<'_>) -> Result<Device> {
    let exact = Device::default();
    Ok(Device {
        precision: section.name("precision")?.unwrap_or(exact.precision),
        subpixel_bits: section.integer("subpixel_bits")?.unwrap_or(exact.subpixel_bits),
        depth: section.name("depth")?.unwrap_or(exact.depth),
        stencil_bits: section.integer("stencil_bits")?.unwrap_or(exact.stencil_bits),
        max_line_width_px: section.number("max_line_width_px")?.unwrap_or(exact.max_line_width_px),
        filter_bits: section.integer("filter_bits")?.unwrap_or(exact.filter_bits),
    })
}
