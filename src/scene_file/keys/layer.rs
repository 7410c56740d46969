//! The keys of a layer.

use super::by_column::{COLOR, CONDITION, OPACITY, ORDER, ORDER_NAME, WIDTH};
use super::{POSITIVE, SEED, SHARE};
use crate::parameter::{Range, Rule as Keys, Shape, TableShape, choice, key};
use crate::scene::{Cap, Dash, OutlineMode, Rule};
use crate::scene_file::case_study::{Group, Study};
use crate::scene_file::names::{JoinName, VectorName};
use crate::scene_file::spec::Edges;

/// How many times as much as a whole case study a layer may hold.
const MOST_OF_A_STUDY: f64 = 8.0;

pub(super) static LAYER: TableShape = TableShape {
    keys: &[
        key("name", Shape::Text, "The layer's name. Default: the file's name without its extension."),
        key(
            "source",
            Shape::Text,
            "A vector file: .geojson .json .shp .fgb .gpkg. Relative to the scene file.",
        ),
        key("features", Shape::Tables(&FEATURE), "Features written here, in plan coordinates."),
        key("generate", Shape::Table(&GENERATE_LAYER), "Features by a generator."),
        key("layer", Shape::Text, "Which layer of a file that has several (GeoPackage)."),
        key("crs", Shape::Text, "The CRS of the data, over what the file says."),
        key(
            "edges",
            choice::<Edges>(),
            "What lies between two vertices of a file: \"projected\" (the straight line of the file's coordinates; in another projection a curve, followed by further vertices), \"straight\" (a chord in the plan), or of data in degrees \"geodesic\" (the shortest way on the ellipsoid) or \"rhumb\" (the way of constant bearing). Default: \"projected\".",
        ),
        key(
            "offset",
            Shape::Numbers(2),
            "Moves the layer in plan space: [dx, dy] in metres. Default: [0, 0].",
        ),
        key("fill", Shape::Table(&FILL), "The inside of polygons."),
        key("outline", Shape::Table(&OUTLINE), "The border of polygons, over the fill."),
        key("line", Shape::Table(&LINE), "Lines."),
        key("point", Shape::Table(&POINT), "Points, each a disc."),
        key(
            "opacity",
            SHARE,
            "How much of the layer as a whole is drawn: its features are composed with one another first. Default: 1.",
        ),
        key(
            "where",
            Shape::Map(&CONDITION),
            "Only the features that fulfil all of these conditions: a column, and the value or one of the values that it must have, or bounds.",
        ),
        key(
            "order",
            Shape::OrTable(&ORDER_NAME, &ORDER),
            "The draw order: \"file\", \"size\" (larger polygons and longer lines on top, polygons below lines), or by a key. Default: \"file\".",
        ),
    ],
    rules: &[
        Keys::One(&["source", "features", "generate"]),
        Keys::Some(&["fill", "outline", "line", "point"]),
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
        key("points", Shape::Paths, "Points [[x, y], ...]."),
        key("properties", Shape::Map(&Shape::Scalar), "Its attributes: a value for each column."),
    ],
    rules: &[Keys::One(&["polygon", "line", "points"])],
};

static GENERATE_LAYER: TableShape = TableShape {
    keys: &[
        key("kind", choice::<VectorName>(), "What is made.").required(),
        key("seed", SEED, "Picks the shapes. Default: 1."),
        key(
            "count",
            Shape::Integer(1, 30_000_000),
            "How many segments (roads, paths) or polygons (parcels; mosaic, of all classes; at most 10^6). Default: 1000.",
        ),
        key(
            "window",
            Shape::Numbers(4),
            "The rectangle [x0, y0, x1, y1] of the plan to fill. Default: the terrain's.",
        ),
        key(
            "segment_m",
            POSITIVE,
            "roads, paths: the length of a segment. Default: a 200th, a 5000th of the window's longer side.",
        ),
        key(
            "class",
            Shape::Integers(2, 0, 1000),
            "mosaic: [k, n]: only class k (from 0) of n classes. Default: all.",
        ),
        key("holes", SHARE, "mosaic: the share of polygons with a lake as a hole. Default: 0.1."),
        key("study", choice::<Study>(), "case-study: which of Zechmeister 2020, 5.1."),
        key("group", choice::<Group>(), "case-study: which of its data groups. Default: the lowest."),
        key(
            "scale",
            Shape::Number(Range::UpTo(MOST_OF_A_STUDY)),
            "case-study: how much of the study's data, 1 is all; at most 8. Default: 0.01.",
        ),
    ],
    rules: &[],
};

static FILL: TableShape = TableShape {
    keys: &[
        key("color", COLOR, "The colour.").required(),
        key("opacity", OPACITY, "Multiplies the colour's alpha. Default: 1."),
        key("rule", choice::<Rule>(), "What rings enclose. Default: \"even-odd\"."),
        key(
            "invert",
            Shape::Flag,
            "Paints all of the terrain that lies outside of every one of the layer's polygons, once, in place of their insides. Default: false.",
        ),
    ],
    rules: &[],
};

/// The lengths of dashes.
const DASH: Shape = Shape::Pattern(Dash::MOST, Range::Between(Dash::SHORTEST, Dash::LONGEST));

static OUTLINE: TableShape = TableShape {
    keys: &[
        key("color", COLOR, "The colour.").required(),
        key("opacity", OPACITY, "Multiplies the colour's alpha. Default: 1."),
        key("width_m", WIDTH, "The whole width in metres of the plan."),
        key("width_px", WIDTH, "The whole width in pixels of the screen."),
        key(
            "mode",
            choice::<OutlineMode>(),
            "Which side of the border is drawn. Default: \"normal\" (both).",
        ),
        key("join", choice::<JoinName>(), "How segments meet. Default: \"round\"."),
        key(
            "miter_limit",
            Shape::Number(Range::FromOne),
            "join = \"miter\": the largest ratio of miter length to width. Default: 4.",
        ),
        key(
            "dash",
            DASH,
            "Lengths in metres of the plan along it: in turn drawn and left out. Default: all of it is drawn.",
        ),
        key(
            "dash_offset",
            Shape::Number(Range::Finite),
            "dash: how far into the pattern a ring begins, metres. Default: 0.",
        ),
        key("cap", choice::<Cap>(), "dash: how dashes end. Default: \"butt\"."),
    ],
    rules: &[Keys::One(&["width_m", "width_px"])],
};

static LINE: TableShape = TableShape {
    keys: &[
        key("color", COLOR, "The colour.").required(),
        key("opacity", OPACITY, "Multiplies the colour's alpha. Default: 1."),
        key("width_m", WIDTH, "The whole width in metres of the plan (static)."),
        key("width_px", WIDTH, "The whole width in pixels of the screen (dynamic)."),
        key("join", choice::<JoinName>(), "How segments meet. Default: \"round\"."),
        key(
            "miter_limit",
            Shape::Number(Range::FromOne),
            "join = \"miter\": the largest ratio of miter length to width. Default: 4.",
        ),
        key("cap", choice::<Cap>(), "How the line and its dashes end. Default: \"butt\"."),
        key(
            "dash",
            DASH,
            "Lengths in metres of the plan along it: in turn drawn and left out. Default: all of it is drawn.",
        ),
        key(
            "dash_offset",
            Shape::Number(Range::Finite),
            "dash: how far into the pattern each line begins, metres. Default: 0.",
        ),
    ],
    rules: &[Keys::One(&["width_m", "width_px"])],
};

static POINT: TableShape = TableShape {
    keys: &[
        key("color", COLOR, "The colour.").required(),
        key("opacity", OPACITY, "Multiplies the colour's alpha. Default: 1."),
        key("width_m", WIDTH, "The disc's diameter in metres of the plan."),
        key("width_px", WIDTH, "The disc's diameter in pixels of the screen."),
    ],
    rules: &[Keys::One(&["width_m", "width_px"])],
};
