//! The keys of the terrain.

use super::{POSITIVE, SEED};
use crate::parameter::{Range, Rule as Keys, Shape, TableShape, choice, key};
use crate::scene::Diagonal;
use crate::scene_file::names::{ShadeName, TerrainName};
use crate::scene_file::spec::HeightEncoding;

pub(super) static TERRAIN: TableShape = TableShape {
    keys: &[
        key(
            "source",
            Shape::Texts,
            "A height file: .tif .hgt .asc .png .xyz .vrt, or one of them in a .zip; or a list of files that stand on one grid. \
             Relative to the scene file.",
        ),
        key("generate", Shape::Table(&GENERATE_TERRAIN), "Heights by a formula instead."),
        key(
            "window",
            Shape::Numbers(4),
            "Read only this part: [x0, y0, x1, y1] in the file's own coordinates.",
        ),
        key(
            "offset",
            Shape::PairOrTriple,
            "Moves the data in plan space, and up: [dx, dy] or [dx, dy, dz] in metres. Default: [0, 0, 0].",
        ),
        key("crs", Shape::Text, "The CRS of the data, over what the file says."),
        key(
            "bounds",
            Shape::Numbers(4),
            "The rectangle [x0, y0, x1, y1] that the data covers, for a file that does not say it (PNG).",
        ),
        key("encoding", choice::<HeightEncoding>(), "How a PNG encodes heights."),
        key(
            "band",
            Shape::Integer(1, 4096),
            "Which band of a file with several holds the heights. Default: the first; a picture of colours is refused.",
        ),
        key(
            "nodata",
            Shape::Number(Range::Finite),
            "A stored value that means no data, beside those that the file declares.",
        ),
        key("diagonal", choice::<Diagonal>(), "How cells are split. Default: \"sw-ne\"."),
        key(
            "lod",
            Shape::Table(&LOD),
            "A level-of-detail mesh of the grid instead of all of it, with diagonal = \"alternating\".",
        ),
        key(
            "vertical_scale",
            Shape::Number(Range::NotNegative),
            "Heights are multiplied by this. Default: 1.",
        ),
        key("color", Shape::Color, "The ground's colour. Default: \"#c8b89a\"."),
        key(
            "shade",
            choice::<ShadeName>(),
            "\"hillshade\": the colour, or the imagery, lit from the north-west or as `light` says. Default: \"flat\".",
        ),
        key("light", Shape::Table(&LIGHT), "shade = \"hillshade\": where its light comes from."),
        key(
            "imagery",
            Shape::Text,
            "An image (PNG, JPEG, WebP) over the terrain's rectangle instead of a colour.",
        ),
    ],
    rules: &[Keys::One(&["source", "generate"]), Keys::AtMostOne(&["imagery", "color"])],
};

static LIGHT: TableShape = TableShape {
    keys: &[
        key(
            "azimuth_deg",
            Shape::Number(Range::Finite),
            "From where: degrees from north over east. Default: 315, the north-west.",
        ),
        key(
            "elevation_deg",
            Shape::Number(Range::UpTo(90.0)),
            "How high above the horizon, in degrees. Default: 45.",
        ),
    ],
    rules: &[],
};

static LOD: TableShape = TableShape {
    keys: &[
        key(
            "error_px",
            Shape::Number(Range::NotNegative),
            "No triangle in view is farther from the full surface, in pixels at its distance. 0: all posts.",
        ),
        key("level", Shape::Integer(0, 20), "Every 2^n-th post of every 2^n-th row, in every view."),
        key(
            "borrow",
            Shape::Number(Range::Share),
            "The share of quads that are drawn by the vertices of one that holds them. Default: 0.",
        ),
    ],
    rules: &[Keys::One(&["error_px", "level"])],
};

static GENERATE_TERRAIN: TableShape = TableShape {
    keys: &[
        key("kind", choice::<TerrainName>(), "The formula.").required(),
        key(
            "posts",
            Shape::Integers(2, 2, 32768),
            "Posts from west to east and from south to north, at most 2^28 in all. Default: [257, 257].",
        ),
        key("cell_m", POSITIVE, "The distance of neighbouring posts. Default: 30."),
        key(
            "cell_deg",
            POSITIVE,
            "The same in degrees, with plan = \"globe\": the middle is at longitude and latitude 0.",
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
    rules: &[Keys::AtMostOne(&["cell_m", "cell_deg"])],
};
