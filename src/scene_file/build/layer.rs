//! The tables of layers.

use super::by_column::{conditions, order};
use super::style::style;
use super::{data_file, rectangle, stem};
use crate::error::Result;
use crate::parameter::Named;
use crate::scene::Shape;
use crate::scene_file::case_study::{Group, Study};
use crate::scene_file::names::VectorName;
use crate::scene_file::section::{Section, Taken, as_scalar, bug};
use crate::scene_file::spec::{InlineFeature, LayerSource, LayerSpec, VectorGenerator, VectorKind};
use crate::scene_file::tree::Node;
use crate::space::Plan;
use glam::DVec2;
use std::path::Path;

/// The most generated polygons.
const MOST_POLYGONS: usize = 1_000_000;

pub(super) fn layers(root: &mut Section<'_>) -> Result<Vec<LayerSpec>> {
    let mut layers: Vec<LayerSpec> = Vec::new();
    for node in root.tables("layer")?.unwrap_or_default() {
        let place = node.place.clone();
        let index = layers.len();
        let layer = Section::read(root.origin(), node, |section| layer(section, index))?;
        if layers.iter().any(|earlier| earlier.name == layer.name) {
            let what = format!("two layers are called `{}`", layer.name);
            return Err(root.error_at(&place, what).help("give each a `name` of its own"));
        }
        layers.push(layer);
    }
    Ok(layers)
}

fn layer(section: &mut Section<'_>, index: usize) -> Result<LayerSpec> {
    let name = section.text("name")?;
    let source = source(section)?;
    let default = match &source {
        LayerSource::File { file, layer } => default_name(Some(&file.written), layer.as_deref(), index),
        _ => default_name(None, None, index),
    };
    Ok(LayerSpec {
        name: name.unwrap_or(default),
        source,
        crs: section.text("crs")?,
        edges: section.name("edges")?.unwrap_or_default(),
        offset: section.numbers("offset")?.map_or(DVec2::ZERO, DVec2::from_array),
        style: style(section)?,
        opacity: section.number("opacity")?.unwrap_or(1.0),
        conditions: conditions(section)?,
        order: order(section)?,
    })
}

/// The name of a layer that states none.
pub(in crate::scene_file) fn default_name(source: Option<&str>, layer: Option<&str>, index: usize) -> String {
    // As errors and overrides name it.
    let otherwise = || index.to_string();
    match (source, layer) {
        (Some(_), Some(layer)) => layer.into(),
        (Some(source), None) => stem(Some(Path::new(source)), &otherwise()),
        (None, _) => otherwise(),
    }
}

fn source(section: &mut Section<'_>) -> Result<LayerSource> {
    if let Some(taken) = section.text_at("source")? {
        let file = data_file(section.origin(), taken);
        return Ok(LayerSource::File { file, layer: section.text("layer")? });
    }
    if let Some((key, place)) = section.first_of(&["layer", "crs", "edges"]) {
        return Err(section.error_at(place, format!("`{key}` goes with a layer's `source` only")));
    }
    if let Some(features) = section.tables("features")? {
        let feature = |node| Section::read(section.origin(), node, inline);
        return features.into_iter().map(feature).collect::<Result<_>>().map(LayerSource::Inline);
    }
    let node = section.take_or_empty("generate");
    Section::read(section.origin(), node, generator).map(LayerSource::Generate)
}

/// A feature that is written in the scene file.
fn inline(section: &mut Section<'_>) -> Result<InlineFeature> {
    let (polygon, points) = (section.paths("polygon")?, section.paths("points")?);
    let shape = match (polygon, points) {
        (Some(rings), _) => Shape::Polygon(rings.into_iter().map(open).collect()),
        (None, Some(points)) => Shape::Points(points.concat()),
        (None, None) => Shape::Line(section.paths("line")?.unwrap_or_default()),
    };
    let value = |node: Node| as_scalar(node.value).ok_or_else(|| bug("properties"));
    Ok(InlineFeature { shape, properties: section.map("properties", value)?.unwrap_or_default() })
}

/// A ring without its closing vertex.
fn open(mut ring: Vec<Plan>) -> Vec<Plan> {
    if ring.len() > 1 && ring.first() == ring.last() {
        ring.pop();
    }
    ring
}

/// Keys that some kinds of generator alone have, those kinds, and how they are told.
const GENERATOR_KEYS: [(&[&str], &[VectorName], &str); 4] = [
    (&["class", "holes"], &[VectorName::Mosaic], "kind = \"mosaic\" only"),
    (&["segment_m"], &[VectorName::Roads, VectorName::Paths], "kind = \"roads\" or \"paths\" only"),
    (&["study", "group", "scale"], &[VectorName::CaseStudy], "kind = \"case-study\" only"),
    (
        &["count"],
        &[VectorName::Roads, VectorName::Paths, VectorName::Mosaic, VectorName::Parcels],
        "other kinds than \"case-study\" only, which has `scale`",
    ),
];

fn generator(section: &mut Section<'_>) -> Result<VectorGenerator> {
    let name = section.name("kind")?.unwrap_or(VectorName::Roads);
    for (keys, of, with) in GENERATOR_KEYS {
        let foreign = if of.contains(&name) { None } else { section.first_of(keys) };
        if let Some((key, place)) = foreign {
            return Err(section.error_at(place, format!("`{key}` goes with {with}")));
        }
    }
    let kind = match name {
        VectorName::Roads => VectorKind::Roads { segment_m: section.number("segment_m")? },
        VectorName::Paths => VectorKind::Paths { segment_m: section.number("segment_m")? },
        VectorName::Parcels => VectorKind::Parcels,
        VectorName::CaseStudy => case_study(section)?,
        VectorName::Mosaic => {
            VectorKind::Mosaic { class: class(section)?, holes: section.number("holes")?.unwrap_or(0.1) }
        }
    };
    Ok(VectorGenerator {
        kind,
        seed: section.integer("seed")?.unwrap_or(1),
        count: count(section, name)?,
        window: rectangle(section, "window")?,
    })
}

/// Which data of which study, and how much of it.
fn case_study(section: &mut Section<'_>) -> Result<VectorKind> {
    let Some(study) = section.name::<Study>("study")? else {
        let words: Vec<&str> = Study::NAMES.iter().map(|(word, _)| *word).collect();
        let error = section.error_at(section.place(), "`kind = \"case-study\"` goes with a `study`");
        return Err(error.help(format!("say which: {}", words.join(", "))));
    };
    let named =
        section.text_at("group")?.and_then(|taken| Some((Group::from_name(&taken.value)?, taken.place)));
    let data = match named {
        None => &study.groups()[0],
        Some((group, place)) => study.group(group).ok_or_else(|| {
            let words: Vec<&str> = study.groups().iter().map(|data| data.group.word()).collect();
            let error =
                section.error_at(&place, format!("study `{}` has no group `{}`", study.word(), group.word()));
            error.help(format!("it has {}", words.join(", ")))
        })?,
    };
    Ok(VectorKind::CaseStudy { study, data, scale: section.number("scale")?.unwrap_or(0.01) })
}

/// Polygons have many vertices each: fewer of them fit into memory than segments of roads.
fn count(section: &mut Section<'_>, name: VectorName) -> Result<usize> {
    match section.integer_at("count")? {
        Some(Taken { value, place })
            if matches!(name, VectorName::Mosaic | VectorName::Parcels) && value > MOST_POLYGONS =>
        {
            let what = if name == VectorName::Mosaic { "a mosaic has" } else { "there are" };
            Err(section.error_at(&place, format!("{what} at most {MOST_POLYGONS} polygons")))
        }
        taken => Ok(taken.map_or(1000, |taken| taken.value)),
    }
}

fn class(section: &mut Section<'_>) -> Result<Option<(u32, u32)>> {
    match section.integers_at("class")? {
        Some(Taken { value: [class, of], place }) if class >= of => {
            Err(section.error_at(&place, format!("class {class} of {of}: classes are counted from 0")))
        }
        taken => Ok(taken.map(|taken| (taken.value[0] as u32, taken.value[1] as u32))),
    }
}
