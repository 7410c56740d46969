//! The numbers of a scene's view, as they stand in `parameters.json`.

use crate::error::{Error, Result};
use crate::measure::device_words;
use crate::output::ByName;
use crate::parameter::Named;
use crate::raster::device;
use crate::scene::{self, GroundColors, Scene};
use crate::space::{Lens, PlanBox, ViewFrame};
use crate::technique::{self, Kind};
use crate::terrain::{Lattice, Mesh};
use std::collections::BTreeMap;

/// The whole file. Everything is scene-local but `origin`, which is where the scene's zero point lies.
#[derive(Debug, serde::Serialize)]
pub struct Parameters {
    /// The version of the layout.
    pub schema: u32,
    /// The machine that the technique's pictures are of.
    pub device: ByName,
    /// The technique whose pictures are in the bundle.
    pub technique: &'static str,
    /// Its parameters, by their names in the scene file.
    pub settings: ByName,
    /// Those of other techniques that it draws by, too, by their names.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub further_settings: BTreeMap<&'static str, ByName>,
    /// What the plan space is.
    pub plan_space: String,
    /// Absolute plan coordinates of the zero point.
    pub origin: [f64; 2],
    /// Its absolute height.
    pub origin_height: f64,
    /// The globe that the world is geocentric on; absent where the world stands straight over the plan.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub globe: Option<GlobeParameters>,
    /// The picture.
    pub image: Canvas,
    /// From where it is seen.
    pub camera: Camera,
    /// The rectangle that the terrain lies in: west, south, east, north.
    pub terrain: [f64; 4],
    /// How far apart its posts are, metres of the plan: the smaller side of a grid's cells, whatever of it the view has; of scattered points the side of the
    /// square that two triangles cover on the average.
    pub terrain_resolution: f64,
    /// Where the posts of a grid are; absent of scattered points, and on a globe.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub posts: Option<PostParameters>,
    /// The terrain's own colour.
    pub ground: GroundParameters,
    /// On which values colours are composed: `encoded` or `linear`.
    pub compositing_space: &'static str,
    /// How: `over` or `additive`.
    pub compositing_mode: &'static str,
}

/// The posts of a grid over the plane, whatever of them a level-of-detail mesh has: columns eastwards, rows northwards.
#[derive(Debug, serde::Serialize)]
pub struct PostParameters {
    /// Posts in a row.
    pub columns: usize,
    /// Posts in a column.
    pub rows: usize,
    /// The plan point of the south-western post, column 0 and row 0.
    pub first: [f64; 2],
    /// The step to the next column.
    pub east: [f64; 2],
    /// The step to the next row.
    pub north: [f64; 2],
}

/// The ellipsoid of a scene on a globe, and where the world's zero is.
#[derive(Debug, serde::Serialize)]
pub struct GlobeParameters {
    /// The equatorial radius, metres.
    pub equatorial_radius: f64,
    /// The flattening.
    pub flattening: f64,
    /// The geocentric point that vertices and the camera are relative to.
    pub world_origin: [f64; 3],
}

/// The picture.
#[derive(Debug, serde::Serialize)]
pub struct Canvas {
    /// Pixels a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The sky: RGBA, straight alpha, encoded, 0..1.
    pub background: [f64; 4],
}

/// From where the terrain is seen.
#[derive(Debug, serde::Serialize)]
pub struct Camera {
    /// The eye.
    pub eye: [f64; 3],
    /// The direction to the right in the picture.
    pub right: [f64; 3],
    /// The direction upwards in the picture.
    pub up: [f64; 3],
    /// The direction of view.
    pub forward: [f64; 3],
    /// Whether rays are parallel.
    pub orthographic: bool,
    /// A pixel's side: at view depth 1 (perspective), or everywhere in metres (orthographic).
    pub pixel: f64,
    /// Nothing nearer is seen, metres of view depth.
    pub near_m: f64,
    /// Nothing farther is seen; null: no limit.
    pub far_m: Option<f64>,
    /// Rows of the matrix from world to view: x right, y up, z towards the viewer.
    pub view_from_world: [[f64; 4]; 4],
    /// Rows of the matrix from world to clip space, of the device's depth buffer.
    pub clip_from_world: [[f64; 4]; 4],
}

/// The terrain's own colour.
#[derive(Debug, serde::Serialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum GroundParameters {
    /// One colour.
    Color {
        /// RGBA.
        color: [f64; 4],
    },
    /// Times Lambert's cosine.
    Hillshade {
        /// RGBA.
        color: [f64; 4],
        /// The unit vector to the light: east, north, up.
        light: [f64; 3],
    },
    /// The nearest texel of `imagery.png` over a rectangle.
    Imagery {
        /// West, south, east, north.
        extent: [f64; 4],
        /// The unit vector to the light, whose cosine darkens the texels; null: they are as they are.
        light: Option<[f64; 3]>,
    },
}

impl Parameters {
    /// The numbers of a scene that a technique draws; its own and the device's as `result.json` has them.
    pub fn new((scene, mesh, view): (&Scene, &Mesh, &ViewFrame), technique: Kind) -> Self {
        let settings = |of: &technique::Parameters| ByName::from_pairs((of.values)(&scene.technique));
        let declaration = technique.declaration();
        let light = scene.ground.light.map(|light| light.direction().to_array());
        let ground = match (&scene.ground.colors, light) {
            (GroundColors::Constant(color), None) => GroundParameters::Color { color: color.0 },
            (GroundColors::Constant(color), Some(light)) => {
                GroundParameters::Hillshade { color: color.0, light }
            }
            (GroundColors::Imagery(imagery), light) => {
                GroundParameters::Imagery { extent: sides(&imagery.extent), light }
            }
        };
        Self {
            schema: 1,
            device: device_words(&scene.device),
            technique: technique.name(),
            settings: settings(&declaration.parameters),
            further_settings: declaration.further.iter().map(|of| (of.name, settings(of))).collect(),
            plan_space: scene.plan_space.clone(),
            origin: scene.origin.truncate().to_array(),
            origin_height: scene.origin.z,
            globe: scene.globe.map(|globe| GlobeParameters {
                equatorial_radius: globe.ellipsoid.a,
                flattening: globe.ellipsoid.f,
                world_origin: globe.world_origin.to_array(),
            }),
            image: Canvas {
                width: view.width(),
                height: view.height(),
                background: scene.image.background.0,
            },
            camera: Camera::new(view, mesh, &scene.device),
            terrain: sides(&mesh.plan_bounds()),
            terrain_resolution: mesh.resolution(),
            posts: PostParameters::of(mesh),
            ground,
            compositing_space: scene.compositing.space.word(),
            compositing_mode: scene.compositing.mode.word(),
        }
    }

    /// The text of the file.
    ///
    /// # Errors
    /// Internal errors only.
    pub fn to_json(&self) -> Result<String> {
        let text = serde_json::to_string_pretty(self);
        Ok(text.map_err(|error| Error::internal(format!("parameters.json: {error}")).caused_by(error))?
            + "\n")
    }
}

impl PostParameters {
    fn of(mesh: &Mesh) -> Option<Self> {
        let Lattice::Plane(grid) = mesh.lattice()? else { return None };
        let posts = grid.posts();
        Some(Self {
            columns: posts.columns(),
            rows: posts.rows(),
            first: [posts.first.x, posts.first.y],
            east: posts.east().to_array(),
            north: posts.north().to_array(),
        })
    }
}

/// West, south, east, north.
fn sides(rectangle: &PlanBox) -> [f64; 4] {
    let (min, max) = (rectangle.min, rectangle.max);
    [min.x, min.y, max.x, max.y]
}

impl Camera {
    fn new(view: &ViewFrame, mesh: &Mesh, machine: &scene::Device) -> Self {
        let (eye, axes) = (view.eye().to_vec(), [view.right(), view.up(), view.forward()]);
        let row = |axis: glam::DVec3| axis.extend(-axis.dot(eye)).to_array();
        let [right, up, forward] = axes;
        Self {
            eye: eye.to_array(),
            right: right.to_array(),
            up: up.to_array(),
            forward: forward.to_array(),
            orthographic: matches!(view.lens(), Lens::Parallel { .. }),
            pixel: view.lens().pixel(),
            near_m: view.near(),
            far_m: view.far().is_finite().then_some(view.far()),
            view_from_world: [row(right), row(up), row(-forward), [0.0, 0.0, 0.0, 1.0]],
            clip_from_world: device::clip_from_world(view, mesh, machine),
        }
    }
}
