//! The layers: read, written or generated, in local coordinates.

use super::blame::{Named, of_key};
use super::place::Map;
use super::terrain::Terrain;
use crate::crs::Crs;
use crate::error::{Error, Result};
use crate::math::max;
use crate::parallel;
use crate::scene::{Feature, Join, Layer, Line, Shape, Style, Width};
use crate::scene_file::{DataFile, LayerSource, LayerSpec, SceneFile, VectorGenerator};
use crate::source::{generate, vector};
use crate::space::{Plan, PlanBox};
use glam::DVec2;

/// Reads the layers of a scene.
pub(super) fn layers(
    scene: &SceneFile,
    terrain: &Terrain,
    progress: &dyn Fn(&str),
    notes: &mut Vec<String>,
) -> Result<Vec<Layer>> {
    let layer = |spec: &LayerSpec| {
        let mut told = Vec::new();
        let layer = layer(scene, spec, terrain, progress, &mut told);
        notes.extend(told.into_iter().map(|text| format!("layer `{}`: {text}", spec.name)));
        layer
    };
    scene.layers.iter().map(layer).collect()
}

fn layer(
    scene: &SceneFile,
    spec: &LayerSpec,
    terrain: &Terrain,
    progress: &dyn Fn(&str),
    notes: &mut Vec<String>,
) -> Result<Layer> {
    let features = match &spec.source {
        LayerSource::File { file, layer } => {
            let named = Named::new(scene, file);
            progress(&format!("reading {}", file.written));
            from_file(scene, spec, (named, layer.as_deref()), terrain, notes)?
        }
        LayerSource::Inline(shapes) => {
            if let Some(index) =
                shapes.iter().position(|shape| !parts(shape).all(|part| is_drawable(shape, part)))
            {
                let what = "a ring of fewer than 3 points or a line of fewer than 2 can not be drawn";
                let error = Error::new(what).help("write all corners of the ring, all points of the line");
                return Err(of_key(scene, &format!("layer.{}.features.{index}", spec.name), error));
            }
            let shift = terrain.place.shift(spec.offset);
            let numbered = shapes.iter().cloned().enumerate();
            let features = numbered.map(|(index, shape)| Feature { index, style: 0, shape });
            features.map(|feature| moved(feature, &Map::AsIs, shift)).collect::<Result<_>>()?
        }
        LayerSource::Generate(generator) => {
            progress(&format!("making {}", spec.name));
            let features = generated(generator, terrain);
            features
                .into_iter()
                .map(|feature| moved(feature, &Map::AsIs, spec.offset))
                .collect::<Result<_>>()?
        }
    };
    let features = on_terrain(features, &spec.style, terrain, notes);
    Ok(Layer::uniform(&spec.name, spec.style, features))
}

/// Generated features, made in local coordinates: the same bits wherever the scene lies.
fn generated(generator: &VectorGenerator, terrain: &Terrain) -> Vec<Feature> {
    let shift = terrain.place.shift(DVec2::ZERO);
    let local = |[x0, y0, x1, y1]: [f64; 4]| [x0 + shift.x, y0 + shift.y, x1 + shift.x, y1 + shift.y];
    let generator = VectorGenerator { window: generator.window.map(local), ..*generator };
    generate::features(&generator, terrain.bounds)
}

fn from_file(
    scene: &SceneFile,
    spec: &LayerSpec,
    (named, layer): (Named<'_>, Option<&str>),
    terrain: &Terrain,
    notes: &mut Vec<String>,
) -> Result<Vec<Feature>> {
    named.require()?;
    let blame = |error| named.blame(error);
    let file = vector::read(named.path(), layer).map_err(blame)?;
    if !file.features.iter().any(|f| parts(&f.shape).any(|part| is_drawable(&f.shape, part))) {
        let told = if file.notes.is_empty() { "it is empty".into() } else { file.notes.join("; ") };
        let error = Error::new(format!("nothing in this layer can be drawn: {told}"));
        return Err(blame(error.help("leave the layer out, or give a file with polygons or lines")));
    }
    notes.extend(file.notes);
    let key = format!("layer.{}.crs", spec.name);
    let stated = spec.crs.as_ref().map(|text| Crs::parse(text)).transpose();
    let stated = stated.map_err(|error| of_key(scene, &key, error))?;
    let map = map(stated.or(file.crs), terrain, named.file, notes).map_err(blame)?;
    let shift = terrain.place.shift(spec.offset);
    let moved = parallel::map_owned(file.features, |feature| moved(feature, &map, shift));
    moved.into_iter().collect::<Result<_>>().map_err(blame)
}

/// The rings or polylines of a shape.
fn parts(shape: &Shape) -> impl Iterator<Item = &Vec<Plan>> {
    let (Shape::Polygon(parts) | Shape::Line(parts)) = shape;
    parts.iter()
}

/// Whether a part has enough points to cover anything: 3 of a ring, 2 of a line.
fn is_drawable(shape: &Shape, part: &[Plan]) -> bool {
    part.len() >= if matches!(shape, Shape::Polygon(_)) { 3 } else { 2 }
}

/// How the layer's coordinates become plan coordinates, with a note where that is worth one.
fn map(own: Option<Crs>, terrain: &Terrain, file: &DataFile, notes: &mut Vec<String>) -> Result<Map> {
    let Some(space) = &terrain.place.space else {
        if let Some(crs) = own {
            notes.push(format!(
                "{} is in {}, but of the terrain no CRS is known: coordinates are taken as they are",
                file.written,
                crs.name()
            ));
        }
        return Ok(Map::AsIs);
    };
    let Some(own) = own else {
        notes.push(format!(
            "{} does not say its CRS: taken for the scene's, {}",
            file.written,
            space.crs().name()
        ));
        return space.plan_from(space.crs()).map(|map| Map::From(Box::new(map)));
    };
    let map = space.plan_from(&own)?;
    if map.affine().is_none() {
        notes.push(format!("reprojected from {} to {}", own.name(), space.describe()));
    }
    Ok(Map::From(Box::new(map)))
}

/// A feature taken to the plan, then shifted.
fn moved(mut feature: Feature, map: &Map, shift: DVec2) -> Result<Feature> {
    let place = |p: &mut Plan| {
        *p = map.apply(*p)? + shift;
        if p.is_finite() {
            return Ok(());
        }
        Err(Error::new("a vertex is moved out of what numbers can tell").help("check the offsets"))
    };
    let index = feature.index;
    let (Shape::Polygon(parts) | Shape::Line(parts)) = &mut feature.shape;
    let mut vertices = parts.iter_mut().flatten();
    vertices.try_for_each(place).map_err(|error| error.in_feature(index))?;
    Ok(feature)
}

/// The features that can touch the terrain, in their order: a footprint ends where the terrain does.
fn on_terrain(
    features: Vec<Feature>,
    style: &Style,
    terrain: &Terrain,
    notes: &mut Vec<String>,
) -> Vec<Feature> {
    let count = features.len();
    let touches = |feature: &Feature| {
        reach(style, &feature.shape)
            .is_none_or(|reach| bounds(&feature.shape).grown(reach).meets(&terrain.bounds))
    };
    let kept: Vec<Feature> = features.into_iter().filter(touches).collect();
    if kept.is_empty() && count > 0 {
        notes.push(format!("none of its {count} features meets the terrain"));
    } else if kept.len() < count {
        notes
            .push(format!("{} of {count} features lie off the terrain and are left out", count - kept.len()));
    }
    kept
}

/// How far from its vertices' box a feature may cover the plan; `None` where that depends on the view.
fn reach(style: &Style, shape: &Shape) -> Option<f64> {
    let line = match shape {
        Shape::Polygon(_) => style.outline.map(|outline| outline.line),
        Shape::Line(_) => style.line,
    };
    let reach = |line: Line| match line.width {
        Width::Pixels(_) => None,
        Width::Metres(width) => {
            let corner = match line.join {
                Join::Miter { limit } => max(limit, 2.0),
                Join::Round | Join::Bevel => 2.0,
            };
            Some(width * 0.5 * corner)
        }
    };
    line.map_or(Some(0.0), reach)
}

/// The box around a shape.
pub(super) fn bounds(shape: &Shape) -> PlanBox {
    let (Shape::Polygon(parts) | Shape::Line(parts)) = shape;
    PlanBox::around(parts.iter().flatten().copied())
}
