//! Every key of the scene file, said once: the check, the JSON Schema and the suggestions all read it here.

mod clipmap;
mod layer;
mod technique;
mod terrain;

use super::names::ProjectionName;
use super::shape::{POSITIVE, Range, Rule as Keys, Shape, TableShape, choice, key};
use crate::scene::{BlendMode, BlendSpace, DepthFormat, Precision};
use layer::LAYER;
use technique::TECHNIQUE;
use terrain::TERRAIN;

/// The number of the scene file's format that this program reads.
pub const SCHEMA: i64 = 1;

/// The longest side of an image in pixels.
pub(super) const LONGEST_SIDE: i64 = 65536;

/// The whole file.
pub(super) static ROOT: TableShape = TableShape {
    keys: &[
        key("schema", Shape::Integer(SCHEMA, SCHEMA), "The format of this file: 1.").required(),
        key("name", Shape::Text, "The scene's name. Default: the file's name without its extension."),
        key(
            "crs",
            Shape::Text,
            "The plan space, such as \"EPSG:32733\". Default: the terrain's own if it is projected, else the local plane at its centre.",
        ),
        key("image", Shape::Table(&IMAGE), "Size and background of the picture."),
        key(
            "camera",
            Shape::Table(&CAMERA),
            "From where the terrain is seen. Without eye and target: from the south, framing the layers.",
        ),
        key("terrain", Shape::Table(&TERRAIN), "The heights and the colour of the ground.").required(),
        key("layer", Shape::Tables(&LAYER), "Vector layers, drawn in this order."),
        key("technique", Shape::Table(&TECHNIQUE), "Parameters of the techniques."),
        key("compositing", Shape::Table(&COMPOSITING), "How colours are composed."),
        key("device", Shape::Table(&DEVICE), "Which machine to imitate. Default: exact mathematics."),
    ],
    rules: &[],
};

static IMAGE: TableShape = TableShape {
    keys: &[
        key(
            "width",
            Shape::Integer(1, LONGEST_SIDE),
            "Pixels a row. Default: 1200. At most 2^26 pixels in all.",
        ),
        key("height", Shape::Integer(1, LONGEST_SIDE), "Rows. Default: 800."),
        key("background", Shape::Color, "The sky. Default: \"#ffffff\"."),
    ],
    rules: &[],
};

static CAMERA: TableShape = TableShape {
    keys: &[
        key("eye", Shape::Numbers(3), "Plan x, plan y, height of the eye: metres in the scene's plan space."),
        key("eye_geo", Shape::Numbers(3), "Longitude, latitude (degrees), height (metres) of the eye."),
        key("target", Shape::Numbers(3), "A point in the middle of the picture: plan x, plan y, height."),
        key("target_geo", Shape::Numbers(3), "The same as longitude, latitude, height."),
        key("up", Shape::Numbers(3), "The direction that is up in the picture. Default: [0, 0, 1]."),
        key("projection", choice::<ProjectionName>(), "Default: \"perspective\"."),
        key(
            "fov_y_deg",
            Shape::Number(Range::Between(0.0, 180.0)),
            "Perspective: the whole vertical angle of view. Default: 45.",
        ),
        key("height_m", POSITIVE, "Orthographic: what the picture's height spans."),
        key("near_m", POSITIVE, "Nothing nearer than this (view depth) is seen. Default: 1."),
        key("far_m", POSITIVE, "Nothing farther than this is seen. Default: no limit."),
    ],
    rules: &[Keys::AtMostOne(&["eye", "eye_geo"]), Keys::AtMostOne(&["target", "target_geo"])],
};

static COMPOSITING: TableShape = TableShape {
    keys: &[
        key("space", choice::<BlendSpace>(), "The values that are blended. Default: \"encoded\"."),
        key("mode", choice::<BlendMode>(), "The formula. Default: \"over\"."),
    ],
    rules: &[],
};

static DEVICE: TableShape = TableShape {
    keys: &[
        key("precision", choice::<Precision>(), "Arithmetic. Default: \"f64\"."),
        key(
            "subpixel_bits",
            Shape::IntegerOf(&[0, 4, 8]),
            "Fractional bits of vertex positions; 0: no snapping. Default: 0.",
        ),
        key("depth", choice::<DepthFormat>(), "What the depth buffer holds. Default: \"f32-reversed\"."),
        key("stencil_bits", Shape::Integer(1, 16), "Bits of the stencil buffer. Default: 8."),
        key(
            "max_line_width_px",
            POSITIVE,
            "The widest line primitive, in texels where it draws a texture. Default: 10.",
        ),
        key(
            "filter_bits",
            Shape::Integer(0, 16),
            "Fractional bits of a texture filter's weights, 8 on most; 0: exact. Default: 0.",
        ),
    ],
    rules: &[],
};
