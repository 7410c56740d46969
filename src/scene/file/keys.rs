//! Every key of the scene file, said once: the check, the JSON Schema and the suggestions all read it here.

use super::names::{JoinName, ProjectionName, ShadeName, TerrainName, VectorName};
use super::shape::{Range, Rule as Keys, Shape, TableShape, choice, key};
use super::spec::HeightEncoding;
use crate::scene::{
    BlendMode, BlendSpace, Cap, Corners, DepthFormat, Diagonal, OutlineMode, PointInPolygon, Precision, Rule,
    Silhouette,
};

/// The number of the scene file's format that this program reads.
pub const SCHEMA: i64 = 1;

/// The longest side of an image in pixels.
pub(super) const LONGEST_SIDE: i64 = 65536;

const SEED: Shape = Shape::Integer(0, i64::MAX);
const POSITIVE: Shape = Shape::Number(Range::Positive);
const SHARE: Shape = Shape::Number(Range::Share);

/// The whole file.
pub(super) static ROOT: TableShape = TableShape {
    keys: &[
        key(
            "schema",
            Shape::Integer(SCHEMA, SCHEMA),
            "The format of this file: 1.",
        )
        .required(),
        key(
            "name",
            Shape::Text,
            "The scene's name. Default: the file's name without its extension.",
        ),
        key(
            "crs",
            Shape::Text,
            "The plan space, such as \"EPSG:32733\". Default: the terrain's own if it is projected, else the local plane at its centre.",
        ),
        key(
            "image",
            Shape::Table(&IMAGE),
            "Size and background of the picture.",
        ),
        key(
            "camera",
            Shape::Table(&CAMERA),
            "From where the terrain is seen. Without eye and target: from the south, framing the layers.",
        ),
        key(
            "terrain",
            Shape::Table(&TERRAIN),
            "The heights and the colour of the ground.",
        )
        .required(),
        key(
            "layer",
            Shape::Tables(&LAYER),
            "Vector layers, drawn in this order.",
        ),
        key(
            "technique",
            Shape::Table(&TECHNIQUE),
            "Parameters of the techniques.",
        ),
        key(
            "compositing",
            Shape::Table(&COMPOSITING),
            "How colours are composed.",
        ),
        key(
            "device",
            Shape::Table(&DEVICE),
            "Which machine to imitate. Default: exact mathematics.",
        ),
    ],
    rules: &[],
};

static IMAGE: TableShape = TableShape {
    keys: &[
        key(
            "width",
            Shape::Integer(1, LONGEST_SIDE),
            "Pixels a row. Default: 1200. At most 2^28 pixels in all.",
        ),
        key("height", Shape::Integer(1, LONGEST_SIDE), "Rows. Default: 800."),
        key("background", Shape::Color, "The sky. Default: \"#ffffff\"."),
    ],
    rules: &[],
};

static CAMERA: TableShape = TableShape {
    keys: &[
        key(
            "eye",
            Shape::Numbers(3),
            "Plan x, plan y, height of the eye: metres in the scene's plan space.",
        ),
        key(
            "eye_geo",
            Shape::Numbers(3),
            "Longitude, latitude (degrees), height (metres) of the eye.",
        ),
        key(
            "target",
            Shape::Numbers(3),
            "A point in the middle of the picture: plan x, plan y, height.",
        ),
        key(
            "target_geo",
            Shape::Numbers(3),
            "The same as longitude, latitude, height.",
        ),
        key(
            "up",
            Shape::Numbers(3),
            "The direction that is up in the picture. Default: [0, 0, 1].",
        ),
        key(
            "projection",
            choice::<ProjectionName>(),
            "Default: \"perspective\".",
        ),
        key(
            "fov_y_deg",
            Shape::Number(Range::Between(0.0, 180.0)),
            "Perspective: the whole vertical angle of view. Default: 45.",
        ),
        key(
            "height_m",
            POSITIVE,
            "Orthographic: what the picture's height spans.",
        ),
        key(
            "near_m",
            POSITIVE,
            "Nothing nearer than this (view depth) is seen. Default: 1.",
        ),
        key(
            "far_m",
            POSITIVE,
            "Nothing farther than this is seen. Default: no limit.",
        ),
    ],
    rules: &[
        Keys::AtMostOne(&["eye", "eye_geo"]),
        Keys::AtMostOne(&["target", "target_geo"]),
    ],
};

static TERRAIN: TableShape = TableShape {
    keys: &[
        key(
            "source",
            Shape::Text,
            "A height file: .tif .hgt .asc .png .xyz. Relative to the scene file.",
        ),
        key(
            "generate",
            Shape::Table(&GENERATE_TERRAIN),
            "Heights by a formula instead.",
        ),
        key(
            "window",
            Shape::Numbers(4),
            "Read only this part: [x0, y0, x1, y1] in the file's own coordinates.",
        ),
        key(
            "offset",
            Shape::Numbers(2),
            "Moves the data in plan space: [dx, dy] in metres. Default: [0, 0].",
        ),
        key(
            "crs",
            Shape::Text,
            "The CRS of the data, over what the file says.",
        ),
        key(
            "bounds",
            Shape::Numbers(4),
            "The rectangle [x0, y0, x1, y1] that the data covers, for a file that does not say it (PNG).",
        ),
        key(
            "encoding",
            choice::<HeightEncoding>(),
            "How a PNG encodes heights.",
        ),
        key(
            "diagonal",
            choice::<Diagonal>(),
            "How cells are split. Default: \"sw-ne\".",
        ),
        key(
            "vertical_scale",
            Shape::Number(Range::NotNegative),
            "Heights are multiplied by this. Default: 1.",
        ),
        key(
            "color",
            Shape::Color,
            "The ground's colour. Default: \"#c8b89a\".",
        ),
        key(
            "shade",
            choice::<ShadeName>(),
            "\"hillshade\": the colour lit from the north-west. Default: \"flat\".",
        ),
        key(
            "imagery",
            Shape::Text,
            "An image over the terrain's rectangle instead of a colour.",
        ),
    ],
    rules: &[
        Keys::One(&["source", "generate"]),
        Keys::AtMostOne(&["imagery", "color"]),
        Keys::AtMostOne(&["imagery", "shade"]),
    ],
};

static GENERATE_TERRAIN: TableShape = TableShape {
    keys: &[
        key("kind", choice::<TerrainName>(), "The formula.").required(),
        key(
            "posts",
            Shape::Integers(2, 2, 32768),
            "Posts from west to east and from south to north, at most 2^28 in all. Default: [257, 257].",
        ),
        key(
            "cell_m",
            POSITIVE,
            "The distance of neighbouring posts. Default: 30.",
        ),
        key(
            "height_m",
            Shape::Number(Range::Finite),
            "The height of the highest forms; of the plane; of the southern edge of a ramp. Default: 500, plane and ramp 0.",
        ),
        key(
            "slope_deg",
            Shape::Number(Range::Between(-90.0, 90.0)),
            "ramp: its angle, rising to the north. Default: 10.",
        ),
        key(
            "wavelength_m",
            POSITIVE,
            "sine: from crest to crest; fbm: the size of the largest forms. Default: a quarter and a half of the longer side.",
        ),
        key(
            "radius_m",
            POSITIVE,
            "cone: the radius of its foot; tent: from the ridge to its foot. Default: a quarter of the shorter side.",
        ),
        key("seed", SEED, "fbm: picks the mountains. Default: 1."),
        key(
            "octaves",
            Shape::Integer(1, 16),
            "fbm: how many times the noise is added at half the size. Default: 9.",
        ),
    ],
    rules: &[],
};

static LAYER: TableShape = TableShape {
    keys: &[
        key(
            "name",
            Shape::Text,
            "The layer's name. Default: the file's name without its extension.",
        ),
        key(
            "source",
            Shape::Text,
            "A vector file: .geojson .json .shp .fgb .gpkg. Relative to the scene file.",
        ),
        key(
            "features",
            Shape::Tables(&FEATURE),
            "Features written here, in plan coordinates.",
        ),
        key(
            "generate",
            Shape::Table(&GENERATE_LAYER),
            "Features by a generator.",
        ),
        key(
            "layer",
            Shape::Text,
            "Which layer of a file that has several (GeoPackage).",
        ),
        key(
            "crs",
            Shape::Text,
            "The CRS of the data, over what the file says.",
        ),
        key(
            "offset",
            Shape::Numbers(2),
            "Moves the layer in plan space: [dx, dy] in metres. Default: [0, 0].",
        ),
        key("fill", Shape::Table(&FILL), "The inside of polygons."),
        key(
            "outline",
            Shape::Table(&OUTLINE),
            "The border of polygons, over the fill.",
        ),
        key("line", Shape::Table(&LINE), "Lines."),
    ],
    rules: &[
        Keys::One(&["source", "features", "generate"]),
        Keys::Some(&["fill", "outline", "line"]),
    ],
};

static FEATURE: TableShape = TableShape {
    keys: &[
        key(
            "polygon",
            Shape::Paths,
            "One ring [[x, y], ...] or several (the layer's rule says what is inside).",
        ),
        key("line", Shape::Paths, "One polyline [[x, y], ...] or several."),
    ],
    rules: &[Keys::One(&["polygon", "line"])],
};

static GENERATE_LAYER: TableShape = TableShape {
    keys: &[
        key("kind", choice::<VectorName>(), "What is made.").required(),
        key("seed", SEED, "Picks the shapes. Default: 1."),
        key(
            "count",
            Shape::Integer(1, 10_000_000),
            "How many segments (roads) or polygons (mosaic, of all classes; at most 10^6). Default: 1000.",
        ),
        key(
            "window",
            Shape::Numbers(4),
            "The rectangle [x0, y0, x1, y1] of the plan to fill. Default: the terrain's.",
        ),
        key(
            "segment_m",
            POSITIVE,
            "roads: the length of a segment. Default: a 200th of the window's longer side.",
        ),
        key(
            "class",
            Shape::Integers(2, 0, 1000),
            "mosaic: [k, n]: only class k (from 0) of n classes. Default: all.",
        ),
        key(
            "holes",
            SHARE,
            "mosaic: the share of polygons with a lake as a hole. Default: 0.1.",
        ),
    ],
    rules: &[],
};

static FILL: TableShape = TableShape {
    keys: &[
        key("color", Shape::Color, "The colour.").required(),
        key("opacity", SHARE, "Multiplies the colour's alpha. Default: 1."),
        key(
            "rule",
            choice::<Rule>(),
            "What rings enclose. Default: \"even-odd\".",
        ),
    ],
    rules: &[],
};

static OUTLINE: TableShape = TableShape {
    keys: &[
        key("color", Shape::Color, "The colour.").required(),
        key("opacity", SHARE, "Multiplies the colour's alpha. Default: 1."),
        key("width_m", POSITIVE, "The whole width in metres of the plan."),
        key("width_px", POSITIVE, "The whole width in pixels of the screen."),
        key(
            "mode",
            choice::<OutlineMode>(),
            "Which side of the border is drawn. Default: \"normal\" (both).",
        ),
        key(
            "join",
            choice::<JoinName>(),
            "How segments meet. Default: \"round\".",
        ),
        key(
            "miter_limit",
            Shape::Number(Range::FromOne),
            "join = \"miter\": the largest ratio of miter length to width. Default: 4.",
        ),
    ],
    rules: &[Keys::One(&["width_m", "width_px"])],
};

static LINE: TableShape = TableShape {
    keys: &[
        key("color", Shape::Color, "The colour.").required(),
        key("opacity", SHARE, "Multiplies the colour's alpha. Default: 1."),
        key(
            "width_m",
            POSITIVE,
            "The whole width in metres of the plan (static).",
        ),
        key(
            "width_px",
            POSITIVE,
            "The whole width in pixels of the screen (dynamic).",
        ),
        key(
            "join",
            choice::<JoinName>(),
            "How segments meet. Default: \"round\".",
        ),
        key(
            "miter_limit",
            Shape::Number(Range::FromOne),
            "join = \"miter\": the largest ratio of miter length to width. Default: 4.",
        ),
        key("cap", choice::<Cap>(), "How the line ends. Default: \"butt\"."),
    ],
    rules: &[Keys::One(&["width_m", "width_px"])],
};

static TECHNIQUE: TableShape = TableShape {
    keys: &[key(
        "inverse-projection",
        Shape::Table(&INVERSE_PROJECTION),
        "She 2016.",
    )],
    rules: &[],
};

static INVERSE_PROJECTION: TableShape = TableShape {
    keys: &[
        key(
            "samples",
            Shape::Integer(1, 64),
            "n: n x n samples in each P pixel. Default: 3.",
        ),
        key(
            "corners",
            choice::<Corners>(),
            "Which points make a pixel's quadrilateral. Default: \"centres\".",
        ),
        key(
            "point_in_polygon",
            choice::<PointInPolygon>(),
            "How a sample is judged. Default: \"edge-normals\".",
        ),
        key(
            "silhouette",
            choice::<Silhouette>(),
            "What is done with a pixel whose quadrilateral has no meaning. Default: \"centre\".",
        ),
    ],
    rules: &[],
};

static COMPOSITING: TableShape = TableShape {
    keys: &[
        key(
            "space",
            choice::<BlendSpace>(),
            "The values that are blended. Default: \"encoded\".",
        ),
        key("mode", choice::<BlendMode>(), "The formula. Default: \"over\"."),
    ],
    rules: &[],
};

static DEVICE: TableShape = TableShape {
    keys: &[
        key(
            "precision",
            choice::<Precision>(),
            "Arithmetic. Default: \"f64\".",
        ),
        key(
            "subpixel_bits",
            Shape::IntegerOf(&[0, 4, 8]),
            "Fractional bits of vertex positions; 0: no snapping. Default: 0.",
        ),
        key(
            "depth",
            choice::<DepthFormat>(),
            "What the depth buffer holds. Default: \"f32-reversed\".",
        ),
        key(
            "stencil_bits",
            Shape::Integer(1, 16),
            "Bits of the stencil buffer. Default: 8.",
        ),
        key(
            "max_line_width_px",
            POSITIVE,
            "The widest line primitive. Default: 10.",
        ),
    ],
    rules: &[],
};
