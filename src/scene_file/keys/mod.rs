//! Every key of the scene file, said once: the check, the JSON Schema and the suggestions all read it here.

mod by_column;
mod layer;
mod technique;
mod terrain;

use super::names::ProjectionName;
use super::spec::PlanKind;
use crate::parameter::{Range, Rule as Keys, Settings, Shape, TableShape, choice, key};
use crate::scene::{Compositing, Device};
use layer::LAYER;
use technique::TECHNIQUE;
use terrain::TERRAIN;

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
        key("schema", Shape::Integer(SCHEMA, SCHEMA), "The format of this file: 1.").required(),
        key("name", Shape::Text, "The scene's name. Default: the file's name without its extension."),
        key(
            "crs",
            Shape::Text,
            "The plan space, such as \"EPSG:32733\". Default: the terrain's own if it is projected, else the local plane at its centre.",
        ),
        key(
            "plan",
            choice::<PlanKind>(),
            "What the plan is. \"globe\": longitude and latitude on the ellipsoid of the terrain's CRS, heights along its normals. Default: \"plane\".",
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
        key("compositing", Shape::Table(Compositing::TABLE), "How colours are composed."),
        key("device", Shape::Table(Device::TABLE), "Which machine to imitate. Default: exact mathematics."),
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
        key(
            "up",
            Shape::Numbers(3),
            "The direction that is up in the picture. Default: [0, 0, 1]; on a globe the normal at the eye, or north of there when looking down.",
        ),
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
