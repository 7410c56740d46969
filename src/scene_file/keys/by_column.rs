//! The keys that ask for a column of attributes.

use super::{POSITIVE, SHARE};
use crate::parameter::{Key, Range, Rule as Keys, Shape, TableShape, choice, key};
use crate::scene_file::names::OrderName;

/// A colour, or which column tells it.
pub(super) const COLOR: Shape = Shape::OrTable(&Shape::Color, &COLOR_BY);
/// A share, or which column tells it.
pub(super) const OPACITY: Shape = Shape::OrTable(&SHARE, &SHARE_BY);
/// A width, or which column tells it.
pub(super) const WIDTH: Shape = Shape::OrTable(&POSITIVE, &WIDTH_BY);

static COLOR_BY: TableShape = by(&COLOR_KEYS);
static SHARE_BY: TableShape = by(&SHARE_KEYS);
static WIDTH_BY: TableShape = by(&WIDTH_KEYS);
static COLOR_KEYS: [Key; 4] = keys(&Shape::Color);
static SHARE_KEYS: [Key; 4] = keys(&SHARE);
static WIDTH_KEYS: [Key; 4] = keys(&POSITIVE);

const fn by(keys: &'static [Key]) -> TableShape {
    TableShape { keys, rules: &[Keys::One(&["map", "stops"])] }
}

const fn keys(setting: &'static Shape) -> [Key; 4] {
    [
        key("by", Shape::Text, "The column of attributes that tells it.").required(),
        key("map", Shape::Map(setting), "For each value of the column, as a key."),
        key(
            "stops",
            Shape::Stops(setting),
            "For some numbers in ascending order; linear between them, and beyond them as at the last one.",
        ),
        key(
            "default",
            *setting,
            "For other values and features without one. Without it such a feature is refused.",
        ),
    ]
}

/// What a column must hold.
pub(super) static CONDITION: Shape = Shape::OrTable(&Shape::Scalars, &BOUNDS);

static BOUNDS: TableShape = TableShape {
    keys: &[
        key("min", Shape::Number(Range::Finite), "This number or more."),
        key("max", Shape::Number(Range::Finite), "This number or less."),
        key("above", Shape::Number(Range::Finite), "More than this number."),
        key("below", Shape::Number(Range::Finite), "Less than this number."),
    ],
    rules: &[
        Keys::Some(&["min", "max", "above", "below"]),
        Keys::AtMostOne(&["min", "above"]),
        Keys::AtMostOne(&["max", "below"]),
    ],
};

pub(super) static ORDER_NAME: Shape = choice::<OrderName>();

pub(super) static ORDER: TableShape = TableShape {
    keys: &[
        key(
            "by",
            Shape::Text,
            "\"area\" (of polygons), \"length\" (of lines, of rings), or a column; the least is drawn first, below the others.",
        )
        .required(),
        key("descending", Shape::Flag, "The greatest is drawn first. Default: false."),
    ],
    rules: &[],
};
