//! What a scene file says, as plain data: checked, but no file that it names has been opened.

use super::by_column::{Condition, Order, OrderKey, StyleSpec};
use super::case_study::{DataGroup, Study};
use crate::error::Position;
use crate::parameter::words;
use crate::scene::{
    Attribute, Color, Compositing, Device, Diagonal, ImageSettings, LevelOfDetail, Light, Projection, Shape,
    TechniqueSettings,
};
use glam::{DVec2, DVec3};
use std::path::PathBuf;

/// A scene file's content.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneFile {
    /// The file it was read from, to name it where one of its lines is to blame.
    pub path: Option<PathBuf>,
    /// The scene's name; without one, the file's name without its extension, or `scene`.
    pub name: String,
    /// The plan space asked for.
    pub crs: Option<String>,
    /// What the plan is.
    pub plan: PlanKind,
    /// Size and background.
    pub image: ImageSettings,
    /// From where it is seen.
    pub camera: CameraSpec,
    /// The terrain.
    pub terrain: TerrainSpec,
    /// Vector layers in drawing order.
    pub layers: Vec<LayerSpec>,
    /// How colours are composed.
    pub compositing: Compositing,
    /// The machine to imitate.
    pub device: Device,
    /// Parameters of the techniques.
    pub technique: TechniqueSettings,
    /// BLAKE3 of what the file says, overrides made: of its keys and values in a fixed order and spelling, so that
    /// comments, layout, names and the file's own place do not matter. A default that is written out does, and so do
    /// paths as they are written; what the files there hold does not.
    pub hash: String,
}

words! {
    /// What the plan of a scene is, and the world over it.
    #[derive(Default)]
    pub enum PlanKind {
        /// A plane in metres, and heights straight over it.
        #[default]
        Plane = "plane",
        /// Longitude and latitude on an ellipsoid, and heights along its normals.
        Globe = "globe",
    }
}

/// A data file that the scene names.
#[derive(Debug, Clone, PartialEq)]
pub struct DataFile {
    /// The path as it is written.
    pub written: String,
    /// The path to open: relative ones start at the scene file's folder.
    pub path: PathBuf,
    /// Where it is written, to blame the line when the file cannot be read; `None` for an override.
    pub position: Option<Position>,
}

/// The camera as it is written.
#[derive(Debug, Clone, PartialEq)]
pub struct CameraSpec {
    /// Where it stands and looks; without it, a view from the south that frames the layers is to be chosen.
    pub view: Option<ViewSpec>,
    /// The direction that is up in the picture; `None`: z, on a globe the ellipsoid's normal at the eye.
    pub up: Option<DVec3>,
    /// Perspective or orthographic.
    pub projection: Projection,
    /// Nothing nearer than this (view depth in metres) is seen.
    pub near_m: f64,
    /// Nothing farther than this is seen; `None`: no limit.
    pub far_m: Option<f64>,
}

/// Where the camera stands and looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViewSpec {
    /// The eye.
    pub eye: Spot,
    /// A point in the middle of the picture.
    pub target: Spot,
}

/// A point in space as a person writes it (absolute, not scene-local).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spot {
    /// Plan x, plan y, height: metres in the scene's plan space.
    Plan(DVec3),
    /// Longitude and latitude in degrees (WGS 84), height in metres.
    Geo(DVec3),
}

/// The terrain as it is written.
#[derive(Debug, Clone, PartialEq)]
pub struct TerrainSpec {
    /// Where its heights come from.
    pub source: TerrainSource,
    /// Only this part: x0, y0, x1, y1 in the file's own coordinates, x0 < x1 and y0 < y1.
    pub window: Option<[f64; 4]>,
    /// Moves the data in plan space, and up.
    pub offset: DVec3,
    /// The CRS of the data, over what the file says.
    pub crs: Option<String>,
    /// The rectangle x0, y0, x1, y1 that the data covers, for a file that does not say it (PNG), x0 < x1 and y0 < y1.
    pub bounds: Option<[f64; 4]>,
    /// How a PNG encodes heights.
    pub encoding: Option<HeightEncoding>,
    /// Which band of a file with several holds the heights, from 1.
    pub band: Option<usize>,
    /// A stored value that means no data, beside those that the file declares.
    pub nodata: Option<f64>,
    /// How cells are split.
    pub diagonal: Diagonal,
    /// The level-of-detail mesh that each view draws; `None`: the whole grid.
    pub lod: Option<LevelOfDetail>,
    /// Heights are multiplied by this.
    pub vertical_scale: f64,
    /// The terrain's own colour.
    pub ground: GroundSpec,
}

/// Where heights come from.
#[derive(Debug, Clone, PartialEq)]
pub enum TerrainSource {
    /// A file, or several whose posts stand on one grid; never none.
    Files(Vec<DataFile>),
    /// A formula.
    Generate(TerrainGenerator),
}

impl TerrainSource {
    /// Its files; none where it is generated.
    pub fn files(&self) -> &[DataFile] {
        match self {
            Self::Files(files) => files,
            Self::Generate(_) => &[],
        }
    }
}

words! {
    /// How a PNG encodes heights.
    pub enum HeightEncoding {
        /// R * 256 + G + B / 256 - 32768 metres.
        Terrarium = "terrarium",
        /// (R * 65536 + G * 256 + B) / 10 - 10000 metres.
        Mapbox = "mapbox",
    }
}

/// The terrain's own colour.
#[derive(Debug, Clone, PartialEq)]
pub struct GroundSpec {
    /// The colours in full light.
    pub colors: GroundColorsSpec,
    /// The light of a hillshade; `None`: there is none.
    pub light: Option<Light>,
}

/// The terrain's colours in full light.
#[derive(Debug, Clone, PartialEq)]
pub enum GroundColorsSpec {
    /// One colour.
    Constant(Color),
    /// An image stretched over the terrain's rectangle.
    Imagery(DataFile),
}

/// A generated terrain: posts on a square grid with its middle on plan (0, 0).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TerrainGenerator {
    /// The formula.
    pub kind: TerrainKind,
    /// Posts from west to east and from south to north, at least 2 each.
    pub posts: (usize, usize),
    /// The distance of neighbouring posts.
    pub cell_m: f64,
    /// Whether that was said in degrees of a globe: they are taken as metres on WGS 84's equator.
    pub is_in_degrees: bool,
    /// The formula's height (see [`TerrainKind`]).
    pub height_m: f64,
}

/// The formula of a generated terrain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TerrainKind {
    /// `height_m` everywhere.
    Plane,
    /// `height_m` on the southern edge, rising to the north.
    Ramp {
        /// The angle of the slope, in degrees.
        slope_deg: f64,
    },
    /// Waves in both directions between 0 and `height_m`.
    Sine {
        /// From crest to crest.
        wavelength_m: f64,
    },
    /// A cone of `height_m` in the middle of a plane at 0.
    Cone {
        /// The radius of its foot.
        radius_m: f64,
    },
    /// A ridge of `height_m` from west to east, falling to 0 on both sides.
    Tent {
        /// From the ridge to where it reaches 0.
        radius_m: f64,
    },
    /// Mountains between 0 and `height_m`: octaves of gradient noise, ridged where high.
    Fbm {
        /// Picks the mountains.
        seed: u64,
        /// The size of the largest forms.
        wavelength_m: f64,
        /// How many times the noise is added at half the size.
        octaves: u32,
    },
}

/// A layer as it is written.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerSpec {
    /// Its name; without one, the layer of the file, the file's name without its extension, or `layer-N` counted from 0.
    pub name: String,
    /// Where its features come from.
    pub source: LayerSource,
    /// The CRS of the data, over what the file says.
    pub crs: Option<String>,
    /// What its edges are.
    pub edges: Edges,
    /// Moves the layer in plan space.
    pub offset: DVec2,
    /// How its features look.
    pub style: StyleSpec,
    /// How much of the layer as a whole is drawn, 0..=1.
    pub opacity: f64,
    /// Which of its features are drawn: those that fulfil all of these.
    pub conditions: Vec<Condition>,
    /// In which order.
    pub order: Order,
}

impl LayerSpec {
    /// The columns that its style, conditions and order ask for, each once, by name.
    pub fn columns(&self) -> Vec<String> {
        let mut names: Vec<&str> = self.style.columns().collect();
        names.extend(self.conditions.iter().map(|condition| condition.column.as_str()));
        if let Order::By { key: OrderKey::Column(column), .. } = &self.order {
            names.push(column);
        }
        names.sort_unstable();
        names.dedup();
        names.into_iter().map(Into::into).collect()
    }
}

words! {
    /// What lies between two vertices of a file.
    #[derive(Default)]
    pub enum Edges {
        /// What is straight in the file's coordinates.
        #[default]
        Projected = "projected",
        /// What is straight in the plan.
        Straight = "straight",
        /// The shortest way on the ellipsoid, of data in degrees.
        Geodesic = "geodesic",
        /// The way of constant bearing on the ellipsoid, of data in degrees.
        Rhumb = "rhumb",
    }
}

/// Where features come from.
#[derive(Debug, Clone, PartialEq)]
pub enum LayerSource {
    /// A file.
    File {
        /// Which.
        file: DataFile,
        /// The layer of a file that has several (GeoPackage).
        layer: Option<String>,
    },
    /// Written in the scene file, in its plan space.
    Inline(Vec<InlineFeature>),
    /// A generator.
    Generate(VectorGenerator),
}

/// A feature that is written in the scene file.
#[derive(Debug, Clone, PartialEq)]
pub struct InlineFeature {
    /// Its geometry.
    pub shape: Shape,
    /// Its attributes: column and value.
    pub properties: Vec<(String, Attribute)>,
}

/// Generated features.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VectorGenerator {
    /// What is made.
    pub kind: VectorKind,
    /// Picks the shapes.
    pub seed: u64,
    /// How many segments (roads, paths) or polygons (parcels; mosaic, before its classes are told apart); a case study says itself how many.
    pub count: usize,
    /// The rectangle x0, y0, x1, y1 of the plan to fill; `None`: the terrain's.
    pub window: Option<[f64; 4]>,
}

/// What is generated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum VectorKind {
    /// Wandering roads.
    Roads {
        /// The length of a segment; `None`: a 200th of the window's longer side.
        segment_m: Option<f64>,
    },
    /// Short paths everywhere.
    Paths {
        /// The mean length of a segment; `None`: a 5000th of the window's longer side.
        segment_m: Option<f64>,
    },
    /// Parcels of land in towns along a coast.
    Parcels,
    /// Land use: polygons that share their edges exactly, some with lakes as holes.
    Mosaic {
        /// Only the polygons of this class, of so many.
        class: Option<(u32, u32)>,
        /// The share of polygons with a hole, 0..=1.
        holes: f64,
    },
    /// Data like a case study's of Zechmeister 2020, 5.1.
    CaseStudy {
        /// The study.
        study: Study,
        /// Which of its groups.
        data: &'static DataGroup,
        /// How much of it: 1 is as much as there, on the same window all the denser.
        scale: f64,
    },
}
