//! What is drawn: terrain data, vector layers, camera, styles and the machine to imitate.
//!
//! Input: nothing (plain data). Output: [`Scene`], which every later room reads and none changes. It refuses nothing
//! itself; [`crate::scene_file`] checks what a person wrote and `source` checks what the files hold.

mod attribute;
mod camera;
mod dash;
mod detail;
mod globe;
mod ground;
mod layer;
mod settings;

pub use attribute::{Attribute, Column};
pub use camera::{Camera, Projection};
pub use dash::{Dash, Dashed, Measure};
pub use detail::{Detail, LevelOfDetail};
pub use globe::GlobePosts;
pub use ground::{Ground, GroundColors, Imagery, Light};
pub use layer::{
    Cap, Feature, Fill, Group, Join, Layer, Line, Outline, OutlineMode, Rule, Shape, StrokeForm, Style,
    Swath, Width,
};
pub use settings::{
    BlendMode, BlendSpace, Color, Compositing, DepthFormat, Device, ImageSettings, Interpolation, Positions,
    Precision, TechniqueSettings,
};

use crate::parameter::words;
use crate::space::{Globe, Plan, World};
use glam::{DVec2, DVec3};

/// Everything a picture depends on but the terrain's heights (a [`Surface`], which becomes the mesh), in memory, in
/// scene-local coordinates.
#[derive(Debug, Clone)]
pub struct Scene {
    /// The scene's name.
    pub name: String,
    /// Absolute plan coordinates (metres in the scene's CRS) and height of the local zero point.
    pub origin: DVec3,
    /// What the plan space is, in words (`EPSG:32733`, or the local plane and its centre).
    pub plan_space: String,
    /// The globe that the terrain is a surface over; `None`: the plan is a plane, and the world stands straight over it.
    pub globe: Option<Globe>,
    /// Size and background.
    pub image: ImageSettings,
    /// From where it is seen.
    pub camera: Camera,
    /// How cells of a grid are split.
    pub diagonal: Diagonal,
    /// The level-of-detail mesh that each view draws; `None`: the whole grid.
    pub lod: Option<LevelOfDetail>,
    /// The terrain's own colour.
    pub ground: Ground,
    /// Vector layers, drawn in this order.
    pub layers: Vec<Layer>,
    /// How colours are composed.
    pub compositing: Compositing,
    /// The machine to imitate.
    pub device: Device,
    /// Parameters of the techniques.
    pub technique: TechniqueSettings,
    /// What the user should know about the input (a layer in another CRS, points left out, ...).
    pub notes: Vec<String>,
}

impl Scene {
    /// Absolute world coordinates of the local zero point: on a globe geocentric.
    pub fn world_origin(&self) -> DVec3 {
        self.globe.map_or(self.origin, |globe| globe.world_origin)
    }

    /// A scene that no file says: local coordinates are plan coordinates, all else is as in a scene file that says nothing.
    pub fn new(camera: Camera, layers: Vec<Layer>) -> Self {
        Self {
            name: "scene".into(),
            origin: DVec3::ZERO,
            plan_space: "metres".into(),
            globe: None,
            image: ImageSettings {
                width: 1200,
                height: 800,
                background: Color::from_rgba8([0xff, 0xff, 0xff, 0xff]),
            },
            camera,
            diagonal: Diagonal::default(),
            lod: None,
            ground: Ground::flat(Color::from_rgba8([0xc8, 0xb8, 0x9a, 0xff])),
            layers,
            compositing: Compositing::default(),
            device: Device::default(),
            technique: TechniqueSettings::default(),
            notes: Vec::new(),
        }
    }
}

/// The terrain's heights, before triangulation.
#[derive(Debug, Clone)]
pub enum Surface {
    /// Heights at the posts of a regular grid.
    Grid(Posts),
    /// Scattered points, to be triangulated (Delaunay).
    Points(Vec<World>),
    /// Heights above an ellipsoid, at posts along its meridians and parallels.
    Globe(GlobePosts),
}

/// Heights at the posts of a regular, possibly sheared or rotated grid.
///
/// Post (i, j) stands at `first + i * east + j * north`; `heights[j * columns + i]` is its height in metres, NaN where
/// there is no data. `first` is relative to whatever origin the owner says: absolute file coordinates as a source
/// returns them, scene-local ones in a [`Scene`].
///
/// # Guarantees (kept by the sources, checked by [`Posts::new`])
/// At least 2 x 2 posts, finite steps with `east x north > 0`, and no infinite height.
#[derive(Debug, Clone, PartialEq)]
pub struct Posts {
    columns: usize,
    rows: usize,
    /// Where post (0, 0) stands.
    pub first: Plan,
    east: DVec2,
    north: DVec2,
    heights: Vec<f64>,
}

impl Posts {
    /// A grid of posts.
    ///
    /// # Errors
    /// When a guarantee does not hold; the message names it.
    pub fn new(
        (columns, rows): (usize, usize),
        first: Plan,
        (east, north): (DVec2, DVec2),
        heights: Vec<f64>,
    ) -> crate::Result<Self> {
        let refuse = |what: String| Err(crate::Error::new(what));
        if columns < 2 || rows < 2 {
            return refuse(format!("a terrain needs at least 2 x 2 posts, this one has {columns} x {rows}"));
        }
        if heights.len() != columns * rows {
            return refuse(format!("{columns} x {rows} posts need as many heights, not {}", heights.len()));
        }
        if !(first.is_finite() && east.is_finite() && north.is_finite()) {
            return refuse("the grid's position or spacing is not finite".into());
        }
        if east.perp_dot(north) <= 0.0 {
            return refuse("the grid's rows and columns do not span the plan (spacing 0 or mirrored)".into());
        }
        if let Some(at) = heights.iter().position(|h| h.is_infinite()) {
            return refuse(format!("post ({}, {}) is infinitely high", at % columns, at / columns));
        }
        Ok(Self { columns, rows, first, east, north, heights })
    }

    /// Posts from west to east.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Posts from south to north.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The step from a post to its eastern neighbour.
    pub fn east(&self) -> DVec2 {
        self.east
    }

    /// The step from a post to its northern neighbour.
    pub fn north(&self) -> DVec2 {
        self.north
    }

    /// The heights, row by row from the first (southern) row; NaN is no data.
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// The heights to change; the caller keeps them finite or NaN.
    pub fn heights_mut(&mut self) -> &mut [f64] {
        &mut self.heights
    }

    /// The heights, without the grid.
    pub fn into_heights(self) -> Vec<f64> {
        self.heights
    }

    /// Where post (i, j) stands.
    #[inline(always)]
    pub fn plan(&self, i: usize, j: usize) -> Plan {
        let (i, j) = (i as f64, j as f64);
        Plan::new(
            self.first.x + (i * self.east.x + j * self.north.x),
            self.first.y + (i * self.east.y + j * self.north.y),
        )
    }

    /// Post (i, j) in space.
    #[inline(always)]
    pub fn world(&self, i: usize, j: usize) -> World {
        let p = self.plan(i, j);
        World::new(p.x, p.y, self.heights[j * self.columns + i])
    }
}

words! {
    /// How a cell of the grid is split into two triangles.
    #[derive(Default)]
    pub enum Diagonal {
        /// From its south-west to its north-east corner.
        #[default]
        SwNe = "sw-ne",
        /// From its north-west to its south-east corner.
        NwSe = "nw-se",
        /// `SwNe` where column + row is even, else `NwSe`.
        Alternating = "alternating",
    }
}
