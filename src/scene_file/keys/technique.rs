//! The tables of the techniques' parameters.

use super::clipmap::CLIPMAP;
use crate::scene::{Corners, PointInPolygon, Silhouette};
use crate::scene::{Counting, FarPlane, Grouping, Overflow, VolumeCaps, VolumeJoins};
use crate::scene_file::shape::{Shape, TableShape, choice, key};

pub(super) static TECHNIQUE: TableShape = TableShape {
    keys: &[
        key("clipmap", Shape::Table(&CLIPMAP), "Taibo et al. 2014."),
        key("inverse-projection", Shape::Table(&INVERSE_PROJECTION), "She 2016."),
        key("stencil-volume", Shape::Table(&STENCIL_VOLUME), "Schneider & Klein 2007."),
    ],
    rules: &[],
};

static INVERSE_PROJECTION: TableShape = TableShape {
    keys: &[
        key("samples", Shape::Integer(1, 64), "n: n x n samples in each P pixel. Default: 3."),
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

static STENCIL_VOLUME: TableShape = TableShape {
    keys: &[
        key(
            "method",
            choice::<Counting>(),
            "Towards which end of the line of sight faces are counted. Default: \"automatic\".",
        ),
        key("overflow", choice::<Overflow>(), "What the stencil does beyond its range. Default: \"wrap\"."),
        key(
            "far",
            choice::<FarPlane>(),
            "Whether near and far plane cut volumes or their depths are clamped. Default: \"clamp\".",
        ),
        key(
            "caps",
            choice::<VolumeCaps>(),
            "\"bottom\" leaves the top caps out, which is wrong. Default: \"both\".",
        ),
        key(
            "joins",
            choice::<VolumeJoins>(),
            "How the segments of a line meet; \"style\": as `join` and `cap` say. Default: \"none\".",
        ),
        key("grouping", choice::<Grouping>(), "What shares a mask. Default: \"object\"."),
        key("samples", Shape::Integer(1, 16), "n: n x n samples a pixel. Default: 1."),
        key(
            "object",
            Shape::Integer(0, u32::MAX as i64),
            "The object whose counts the buffers show, from 0 in draw order. Default: all of them.",
        ),
    ],
    rules: &[],
};
