//! The layers: read, written or generated, in local coordinates.

use super::blame::{Named, of_key};
use super::columns::Columns;
use super::filter::fulfilling;
use super::globe;
use super::ground_curve::GroundCurves;
use super::off_terrain::{leave_out, reach_of};
use super::order::ordered;
use super::place::{Map, stretch};
use super::reproject::{Onto, reproject};
use super::styling::{outside, styled};
use super::terrain::Terrain;
use super::window::Region;
use crate::crs::{Crs, CurveKind, Geodesy, PlanFrom};
use crate::error::{Error, Result};
use crate::scene::{Feature, Layer, Shape};
use crate::scene_file::{DataFile, Edges, InlineFeature, LayerSource, LayerSpec, SceneFile, VectorGenerator};
use crate::source::vector::{VectorFile, is_drawable};
use crate::source::{generate, vector};
use crate::space::PlanBox;
use glam::DVec2;

/// A chord may be off the curve that it stands for by this share of the terrain's cell.
const OFF_A_CURVE: f64 = 0.01;

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
    let Found { features, columns, map, shift } = match &spec.source {
        LayerSource::File { file, layer } => {
            progress(&format!("reading {}", file.written));
            from_file(scene, spec, (Named::new(scene, file), layer.as_deref()), terrain, notes)?
        }
        LayerSource::Inline(features) => inline(scene, spec, features, terrain)?,
        LayerSource::Generate(generator) => {
            progress(&format!("making {}", spec.name));
            generated(scene, spec, generator, terrain)
        }
    };
    columns.require(spec)?;
    let mut features = fulfilling(features, spec, &columns, notes)?;
    let count = features.len();
    let mut styles = styled(&mut features, spec, &columns)?;
    let outside = outside(spec);
    let mut map = map;
    if let Some(ground) = terrain.globe() {
        globe::check_styles(scene, spec, &styles)?;
        let own = degrees_of(terrain)?;
        let tolerance = terrain.cell() * OFF_A_CURVE;
        let place = (terrain.bounds, shift);
        features = globe::in_degrees(features, (&map, &own), place, tolerance, spec.edges)
            .map_err(|error| columns.blame(error))?;
        let turn = own.file().turn().ok_or_else(|| Error::internal("a globe without turns"))?;
        let near = globe::near_strokes(&ground.globe, &terrain.bounds, reach_of(&styles).unwrap_or_default());
        let near = Region::of(&own, &PlanBox { min: near.min + -shift, max: near.max + -shift });
        let own = Map::From(Box::new(own));
        let curves = on_the_ground(scene, spec, &own)?;
        let curves = curves.map(|kind| GroundCurves::new(kind, turn, tolerance, near));
        let strokes = globe::Strokes { ellipsoid: ground.globe.ellipsoid, turn, curves };
        (features, styles) =
            globe::stroked(features, styles, &strokes).map_err(|error| columns.blame(error))?;
        map = own;
    }
    let middle = (terrain.bounds.min.to_vec() + terrain.bounds.max.to_vec()) * 0.5;
    let middle = middle - terrain.place.shift(DVec2::ZERO);
    let onto = Onto {
        terrain: terrain.bounds,
        shift,
        reach: reach_of(&styles),
        tolerance: terrain.cell() * OFF_A_CURVE,
        edges: spec.edges,
        on_the_ground: on_the_ground(scene, spec, &map)?,
        stretch: terrain.place.space.as_ref().and_then(|space| stretch(space, middle)).unwrap_or(1.0),
    };
    let features = reproject(features, &map, &onto, notes).map_err(|error| columns.blame(error))?;
    let mut layer = Layer { name: spec.name.clone(), styles, features, opacity: spec.opacity, outside };
    leave_out(terrain, &mut layer, count, notes);
    layer.features = ordered(layer.features, spec, &columns);
    Ok(layer)
}

/// The features of a source, their attributes, and how their coordinates become local ones.
struct Found<'a> {
    features: Vec<Feature>,
    columns: Columns<'a>,
    map: Map,
    shift: DVec2,
}

/// Features that the scene file writes.
fn inline<'a>(
    scene: &'a SceneFile,
    spec: &LayerSpec,
    written: &[InlineFeature],
    terrain: &Terrain,
) -> Result<Found<'a>> {
    let is_broken = |InlineFeature { shape, .. }: &_| !shape.parts().all(|part| is_drawable(shape, part));
    if let Some(index) = written.iter().position(is_broken) {
        let what = "a ring of fewer than 3 points or a line of fewer than 2 can not be drawn";
        let error = Error::new(what).help("write all corners of the ring, all points of the line");
        return Err(of_key(scene, &format!("layer.{}.features.{index}", spec.name), error));
    }
    let numbered = written.iter().enumerate();
    let features =
        numbered.map(|(index, written)| Feature { index, style: 0, shape: written.shape.clone() }).collect();
    let columns = Columns::of_inline(written, scene);
    // On a globe they are in its degrees.
    let map = match terrain.globe() {
        Some(_) => Map::From(Box::new(degrees_of(terrain)?)),
        None => Map::AsIs,
    };
    Ok(Found { features, columns, map, shift: terrain.place.shift(spec.offset) })
}

/// The way from a globe's own degrees to its plan.
fn degrees_of(terrain: &Terrain) -> Result<PlanFrom> {
    let space = terrain.place.space.as_ref().ok_or_else(|| Error::internal("a globe without a plan"))?;
    space.plan_from(space.crs())
}

/// Generated features, made in local coordinates: the same bits wherever the scene lies.
fn generated<'a>(
    scene: &'a SceneFile,
    spec: &LayerSpec,
    generator: &VectorGenerator,
    terrain: &Terrain,
) -> Found<'a> {
    let shift = terrain.place.shift(DVec2::ZERO);
    let local = |[x0, y0, x1, y1]: [f64; 4]| [x0 + shift.x, y0 + shift.y, x1 + shift.x, y1 + shift.y];
    let generator = VectorGenerator { window: generator.window.map(local), ..*generator };
    let features = generate::features(&generator, terrain.bounds);
    let is_asked = !spec.columns().is_empty();
    let columns =
        if is_asked { generate::columns(&generator, terrain.bounds, &features) } else { Vec::new() };
    let columns = Columns::of_generator(columns, scene);
    Found { features, columns, map: Map::AsIs, shift: spec.offset }
}

fn from_file<'a>(
    scene: &'a SceneFile,
    spec: &LayerSpec,
    (named, layer): (Named<'a>, Option<&str>),
    terrain: &Terrain,
    notes: &mut Vec<String>,
) -> Result<Found<'a>> {
    named.require()?;
    let blame = |error| named.blame(error);
    let mut file = vector::read_columns(named.path(), layer, &spec.columns()).map_err(blame)?;
    leave_out_points(spec, &mut file);
    if !file.features.iter().any(|f| f.shape.parts().any(|part| is_drawable(&f.shape, part))) {
        let told = if file.notes.is_empty() { "it is empty".into() } else { file.notes.join("; ") };
        let error = Error::new(format!("nothing in this layer can be drawn: {told}"));
        return Err(blame(
            error.help("leave the layer out, or say how it looks: fill, outline, line or point"),
        ));
    }
    let columns = Columns::of_file(&mut file, named);
    if spec.crs.is_some() {
        file.notes.retain(|note| note != vector::NO_PRJ);
    }
    let crs = stated_crs(scene, spec)?.or(file.crs);
    notes.append(&mut file.notes);
    if let Some(words) = file.crs_not_read {
        // Without a CRS of the terrain all coordinates are taken as they are.
        if crs.is_none() && terrain.place.space.is_some() {
            return Err(blame(Error::unsupported(words).help(
                "say in the scene as the layer's `crs` what its coordinates are in (an EPSG code, a PROJ string or WKT), or reproject it",
            )));
        }
        notes.push(words);
    }
    notes.extend(crs.iter().flat_map(|crs| vector::doubts(crs, &file.features)));
    let map = map(crs, terrain, named.file, notes).map_err(blame)?;
    Ok(Found { features: file.features, columns, map, shift: terrain.place.shift(spec.offset) })
}

/// Where a layer's edges are curves of the ground, which.
fn on_the_ground(scene: &SceneFile, spec: &LayerSpec, map: &Map) -> Result<Option<(Geodesy, CurveKind)>> {
    let kind = match spec.edges {
        Edges::Projected | Edges::Straight => return Ok(None),
        Edges::Geodesic => CurveKind::Geodesic,
        Edges::Rhumb => CurveKind::RhumbLine,
    };
    let geodesy = match map {
        Map::From(map) => Geodesy::of(map.file()).map_err(|error| {
            error.help("edges on the ground are for data in degrees: leave `edges` out, or name the data's own CRS as the layer's `crs`")
        }),
        Map::AsIs => Err(Error::new("of the terrain no CRS is known: coordinates are taken as they are")
            .help("say what they are in: terrain.crs = \"EPSG:...\", or leave `edges` out")),
    };
    let edges = |error| of_key(scene, &format!("layer.{}.edges", spec.name), error);
    geodesy.map(|geodesy| Some((geodesy, kind))).map_err(edges)
}

/// The CRS that the scene says a layer is in.
fn stated_crs(scene: &SceneFile, spec: &LayerSpec) -> Result<Option<Crs>> {
    let stated = spec.crs.as_ref().map(|text| Crs::parse(text)).transpose();
    stated.map_err(|error| of_key(scene, &format!("layer.{}.crs", spec.name), error))
}

/// Leaves out points where a layer says nothing of how they look, and tells how many.
fn leave_out_points(spec: &LayerSpec, file: &mut VectorFile) {
    if spec.style.point.is_some() {
        return;
    }
    let points = |feature: &Feature| match &feature.shape {
        Shape::Points(points) => points.len(),
        _ => 0,
    };
    let count: usize = file.features.iter().map(points).sum();
    file.features.retain(|feature| points(feature) == 0);
    if count > 0 {
        let plural = if count == 1 { "" } else { "s" };
        file.notes.insert(
            0,
            format!("{count} point{plural} left out: the layer has no `point` that says how they look"),
        );
    }
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
        notes.extend(map.note());
    }
    Ok(Map::From(Box::new(map)))
}

/// The box around a shape.
pub(super) fn bounds(shape: &Shape) -> PlanBox {
    PlanBox::around(shape.parts().flatten().copied())
}
