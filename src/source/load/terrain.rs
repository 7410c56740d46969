//! The terrain: read or generated, in local coordinates.

use super::blame::{Named, of_key};
use super::extent::{bounds, grid_bounds, middle, within_reach};
use super::place::{Map, PlanFrame, crs_of, default_plan_space, scale_error};
use super::{globe, place, resample};
use crate::crs::{Affine, Crs, PlanSpace};
use crate::error::{Error, Result};
use crate::math::{max, min};
use crate::scene::{GlobePosts, Posts, Surface};
use crate::scene_file::{DataFile, HeightEncoding, PlanKind, SceneFile, TerrainSource};
use crate::source::dem::{self, Dem, DemOptions, PngEncoding, VerticalUnit};
use crate::source::generate;
use crate::source::vector::is_vector;
use crate::space::{Plan, PlanBox, World};
use glam::DVec2;
use std::path::PathBuf;

/// The terrain in local coordinates, and where those are.
pub(super) struct Terrain {
    pub(super) surface: Surface,
    pub(super) place: PlanFrame,
    /// The rectangle of the plan that it lies in, local.
    pub(super) bounds: PlanBox,
}

impl Terrain {
    /// The posts of a globe's terrain.
    pub(super) fn globe(&self) -> Option<&GlobePosts> {
        match &self.surface {
            Surface::Globe(posts) => Some(posts),
            Surface::Grid(_) | Surface::Points(_) => None,
        }
    }

    /// The size of its detail: the shorter side of a grid's cells, the mean distance of points.
    pub(super) fn cell(&self) -> f64 {
        match &self.surface {
            Surface::Grid(posts) | Surface::Globe(GlobePosts { posts, .. }) => {
                min(posts.east().length(), posts.north().length())
            }
            Surface::Points(points) => {
                let size = self.bounds.max - self.bounds.min;
                (size.x * size.y / points.len() as f64).sqrt()
            }
        }
    }
}

/// Reads or makes the terrain of a scene.
pub(super) fn terrain(
    scene: &SceneFile,
    progress: &dyn Fn(&str),
    notes: &mut Vec<String>,
) -> Result<Terrain> {
    if scene.plan == PlanKind::Globe {
        globe::check(scene)?;
    }
    let (mut surface, space, anchor) = match &scene.terrain.source {
        TerrainSource::Generate(generator) => {
            progress("making the terrain");
            let blame = |error| of_key(scene, "terrain.generate", error);
            let posts = generate::terrain(generator).map_err(blame)?;
            match scene.plan {
                PlanKind::Plane if generator.is_in_degrees => {
                    return Err(blame(
                        Error::new("`cell_deg` is of a globe").help("write plan = \"globe\", or `cell_m`"),
                    ));
                }
                PlanKind::Plane => (Surface::Grid(posts), asked_plan(scene, notes)?, DVec2::ZERO),
                PlanKind::Globe => {
                    let note = &mut |text: String| notes.push(format!("terrain: {text}"));
                    let placed =
                        globe::generated(posts).and_then(|(surface, crs)| on_a_globe(surface, crs, note));
                    placed.map_err(blame)?
                }
            }
        }
        TerrainSource::Files(files) => from_files(scene, files, progress, notes)?,
    };
    stretch(&mut surface, scene.terrain.vertical_scale)?;
    let blame = |error: Error| match scene.terrain.source.files() {
        [file, ..] => Named::new(scene, file).blame(error),
        [] => of_key(scene, "terrain", error),
    };
    if let Surface::Globe(posts) = &surface {
        globe::above_the_middle(posts).map_err(blame)?;
    }
    let offset = scene.terrain.offset;
    let bounds = bounds(&surface);
    let place = PlanFrame { space, anchor, offset };
    within_reach(&surface, &bounds, place.origin()).map_err(blame)?;
    Ok(Terrain { bounds, surface, place })
}

/// The plan that the scene asks for.
fn asked_plan(scene: &SceneFile, notes: &mut Vec<String>) -> Result<Option<PlanSpace>> {
    let parse = |text: &String| Crs::parse(text).and_then(PlanSpace::projected);
    let parsed = scene.crs.as_ref().map(parse).transpose();
    let space = parsed.map_err(|error| of_key(scene, "crs", error))?;
    let note = space.as_ref().and_then(|space| space.crs().note());
    notes.extend(note.map(|text| format!("crs: {text}")));
    let vertical = scene.crs.as_deref().and_then(VerticalUnit::of_crs_text);
    if vertical.is_some_and(|unit| unit.metres() != 1.0) {
        notes.push(
            "crs: heights of a scene are in metres, upwards, whatever the vertical part of `crs` is in"
                .into(),
        );
    }
    Ok(space)
}

type Placed = (Surface, Option<PlanSpace>, DVec2);

fn from_files(
    scene: &SceneFile,
    files: &[DataFile],
    progress: &dyn Fn(&str),
    notes: &mut Vec<String>,
) -> Result<Placed> {
    let [file, more @ ..] = files else {
        return Err(Error::internal("a terrain of no files"));
    };
    let named = Named::new(scene, file);
    for file in files {
        let named = Named::new(scene, file);
        named.require()?;
        if is_vector(named.path()) {
            let error = Error::new("this file is one of vectors, and a terrain is of heights");
            return Err(named.blame(error.help("name it as the `source` of a [[layer]]")));
        }
    }
    let asked = asked_plan(scene, notes)?;
    let read = if more.is_empty() {
        progress(&format!("reading {}", file.written));
        dem::read(named.path(), &options(scene))
    } else {
        progress(&format!("reading {} and {} more", file.written, more.len()));
        let paths: Vec<PathBuf> = files.iter().map(|file| file.path.clone()).collect();
        dem::read_together(&paths, &options(scene))
    };
    let mut dem = read.map_err(|error| named.blame(error))?;
    let note = &mut |text: String| notes.push(format!("terrain: {text}"));
    dem.notes.iter().for_each(|text| note(text.clone()));
    let own = own_crs(scene, &dem, asked.is_some(), note).map_err(|error| named.blame(error))?;
    match scene.terrain.crs.as_deref().and_then(VerticalUnit::of_crs_text) {
        Some(unit) if dem.states_unit => {
            if unit.metres() != 1.0 {
                note(format!(
                    "the file says itself in which unit its heights are: that of `terrain.crs`, {}, is not used",
                    unit.words()
                ));
            }
        }
        Some(unit) => {
            unit.note().into_iter().for_each(&mut *note);
            stretch(&mut dem.surface, unit.metres())?;
        }
        None if dem.states_unit => {}
        None => own.as_ref().and_then(unit_of_heights).into_iter().for_each(&mut *note),
    }
    if scene.plan == PlanKind::Globe {
        let own = own.ok_or_else(|| named.blame(globe::without_crs()))?;
        return on_a_globe(dem.surface, own, note).map_err(|error| named.blame(error));
    }
    let extent = bounds(&dem.surface);
    let (space, map) = plan_and_map(asked, own, extent, note).map_err(|error| named.blame(error))?;
    let resampled =
        matches!((&map, &dem.surface), (Map::From(map), Surface::Grid(_)) if map.affine().is_none());
    if resampled {
        progress(&format!("resampling {}", file.written));
    }
    let (surface, anchor) =
        to_plan(dem.surface, &map, space.as_ref(), note).map_err(|error| named.blame(error))?;
    Ok((surface, space, anchor))
}

/// The surface over a globe, its plan and anchor.
fn on_a_globe(surface: Surface, crs: Crs, note: &mut dyn FnMut(String)) -> Result<Placed> {
    let (posts, space, anchor) = globe::terrain(surface, crs, note)?;
    Ok((Surface::Globe(posts), Some(space), anchor))
}

fn options(scene: &SceneFile) -> DemOptions {
    DemOptions {
        window: scene.terrain.window,
        encoding: scene.terrain.encoding.map(|encoding| match encoding {
            HeightEncoding::Terrarium => PngEncoding::Terrarium,
            HeightEncoding::Mapbox => PngEncoding::Mapbox,
        }),
        bounds: scene.terrain.bounds,
        band: scene.terrain.band,
        nodata: scene.terrain.nodata,
    }
}

/// The CRS of the terrain's data: what the scene says, else what the file says.
fn own_crs(
    scene: &SceneFile,
    dem: &Dem,
    plan_asked: bool,
    note: &mut dyn FnMut(String),
) -> Result<Option<Crs>> {
    let crs = match (&scene.terrain.crs, &dem.crs_hint) {
        (Some(text), _) => Some(Crs::parse(text).map_err(|error| of_key(scene, "terrain.crs", error))?),
        (None, None) => None,
        (None, Some(hint)) => match crs_of(hint) {
            Ok(crs) => Some(crs),
            Err(error) if plan_asked => {
                return Err(error.help("say it in the scene: terrain.crs = \"EPSG:...\""));
            }
            Err(error) => {
                note(format!(
                    "{}: its coordinates are taken as they are, in metres (`terrain.crs` says another CRS)",
                    error.what()
                ));
                None
            }
        },
    };
    if let Some(text) = crs.as_ref().and_then(Crs::note) {
        note(text);
    }
    Ok(crs)
}

/// What to say of heights of no stated unit in a CRS that does not count in metres.
fn unit_of_heights(crs: &Crs) -> Option<String> {
    let metres = crs.metres_per_unit().filter(|metres| *metres != 1.0)?;
    Some(format!(
        "{} counts in units of {metres} m, and nothing says in which its heights are: they are taken as metres \
         (`vertical_scale = {metres}` if they are in the CRS's unit)",
        crs.name()
    ))
}

/// The scene's plan, and how the terrain gets there.
fn plan_and_map(
    asked: Option<PlanSpace>,
    own: Option<Crs>,
    extent: PlanBox,
    note: &mut dyn FnMut(String),
) -> Result<(Option<PlanSpace>, Map)> {
    let PlanBox { min: low, max: high } = extent;
    let (space, own) = match (asked, own) {
        (None, None) => {
            note(without_crs(extent));
            return Ok((None, Map::AsIs));
        }
        (Some(space), None) => {
            note(format!("the file does not say its CRS: taken for the scene's, {}", space.describe()));
            let own = space.crs().clone();
            (space, own)
        }
        (Some(space), Some(own)) => (space, own),
        (None, Some(own)) => {
            let space = default_plan_space(own.clone(), [low.x, low.y, high.x, high.y])?;
            (space, own)
        }
    };
    if let Some((east, north)) = scale_error(&space, low.y, high.y) {
        note(format!(
            "in degrees: drawn in the {}, which is up to {:.3} % off east-west and {:.3} % off north-south at the edges",
            space.describe(),
            100.0 * east,
            100.0 * north
        ));
    }
    let map = space.plan_from(&own)?;
    if let Some(text) =
        map.apply((low.to_vec() + high.to_vec()) / 2.0).ok().and_then(|p| stretched(&space, p))
    {
        note(text);
    }
    if map.affine().is_none() {
        note(format!("reprojected from {} to {}", own.name(), space.describe()));
        if let Some(text) = map.note() {
            note(text);
        }
    }
    Ok((Some(space), Map::From(Box::new(map))))
}

/// What to say of a plan that shows the ground much longer or shorter than it is: heights look wrong beside it.
fn stretched(space: &PlanSpace, at: DVec2) -> Option<String> {
    let share = 100.0 * (place::stretch(space, at)? - 1.0);
    let longer = if share > 0.0 { "longer" } else { "shorter" };
    (share.abs() > 1.0).then(|| {
        format!(
            "lengths in {} are {:.1} % {longer} than the ground here, heights are not: `vertical_scale` makes up for it",
            space.describe(),
            share.abs()
        )
    })
}

/// What to say of a terrain whose place is not known.
fn without_crs(extent: PlanBox) -> String {
    let PlanBox { min: low, max: high } = extent;
    let size = high - low;
    let on_the_globe = low.x >= -180.0 && high.x <= 360.0 && low.y >= -90.0 && high.y <= 90.0;
    let degrees = on_the_globe && low != Plan::default() && max(size.x, size.y) < 40.0;
    let hint = if degrees { " (they look like degrees: if so, say terrain.crs = \"EPSG:4326\")" } else { "" };
    format!("no CRS is known: coordinates are taken as they are, in metres{hint}")
}

/// A surface in its file's coordinates as one in local coordinates, and its anchor.
fn to_plan(
    surface: Surface,
    map: &Map,
    space: Option<&PlanSpace>,
    note: &mut dyn FnMut(String),
) -> Result<(Surface, DVec2)> {
    let on_local_plane = space.is_some_and(|space| space.center().is_some());
    let anchor = |bounds: PlanBox| {
        if on_local_plane { DVec2::ZERO } else { middle(bounds) }
    };
    match (surface, map) {
        (Surface::Globe(_), _) => Err(Error::internal("a file that is a globe")),
        (Surface::Points(points), map) => {
            let points = map_points(points, map)?;
            let anchor = anchor(PlanBox::around(points.iter().map(|p| p.plan())));
            let local = |p: World| World::new(p.x - anchor.x, p.y - anchor.y, p.z);
            Ok((Surface::Points(points.into_iter().map(local).collect()), anchor))
        }
        (Surface::Grid(posts), Map::From(map)) if map.affine().is_none() => {
            let resampled = resample::resample(&posts, map)?;
            let cell = DVec2::new(resampled.posts.east().x, resampled.posts.north().y);
            note(format!(
                "resampled (bilinear) to {} x {} posts, {} m x {} m apart",
                resampled.posts.columns(),
                resampled.posts.rows(),
                cell.x,
                cell.y
            ));
            Ok((Surface::Grid(resampled.posts), resampled.anchor))
        }
        (Surface::Grid(posts), map) => {
            let affine = match map {
                Map::From(map) => map.affine(),
                Map::AsIs => None,
            };
            let mut posts = scaled(posts, affine)?;
            let anchor = anchor(grid_bounds(&posts));
            posts.first = posts.first + -anchor;
            Ok((Surface::Grid(posts), anchor))
        }
    }
}

fn map_points(mut points: Vec<World>, map: &Map) -> Result<Vec<World>> {
    for (index, p) in points.iter_mut().enumerate() {
        let q = map.apply(p.plan()).map_err(|error| error.in_feature(index))?;
        *p = World::new(q.x, q.y, p.z);
    }
    Ok(points)
}

/// The grid, shifted and scaled by an affine map.
fn scaled(posts: Posts, affine: Option<Affine>) -> Result<Posts> {
    let Some(Affine { origin, scale }) = affine else {
        return Ok(posts);
    };
    let first = Plan::from((posts.first.to_vec() - origin) * scale);
    let steps = (posts.east() * scale, posts.north() * scale);
    Posts::new((posts.columns(), posts.rows()), first, steps, posts.into_heights())
}

/// Multiplies the heights.
fn stretch(surface: &mut Surface, by: f64) -> Result<()> {
    if by == 1.0 {
        return Ok(());
    }
    let mut infinite = false;
    let mut scale = |z: &mut f64| {
        *z *= by;
        infinite |= z.is_infinite();
    };
    match surface {
        Surface::Grid(posts) => posts.heights_mut().iter_mut().for_each(scale),
        Surface::Points(points) => points.iter_mut().for_each(|p| scale(&mut p.z)),
        Surface::Globe(GlobePosts { posts, poles, .. }) => {
            posts.heights_mut().iter_mut().chain(poles.iter_mut().flatten()).for_each(scale);
        }
    }
    if infinite {
        return Err(Error::new(format!("`terrain.vertical_scale` = {by} makes heights infinite")));
    }
    Ok(())
}
