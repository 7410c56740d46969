//! What is told of a pixel, as data.

use super::margin::{Margin, Silhouette};
use super::scenery::Scenery;
use crate::buffer::Buffer;
use serde::Serialize;
use std::collections::BTreeMap;

/// What rounding to a code value may take a right colour away from the truth, and a little more.
pub(super) const ROUNDING: f64 = 0.501 / 255.0;

/// The version of the JSON document.
const SCHEMA: u32 = 1;

/// All that is told of a pixel. Plan coordinates are those of the scene's plan space, colours RGBA with straight alpha, encoded values 0..=1.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Account {
    /// Column and row.
    pub pixel: [usize; 2],
    /// The line of sight of its centre.
    pub ray: Ray,
    /// What the centre sees; none: the sky.
    pub centre: Option<Centre>,
    /// What the pixel and its surroundings see.
    pub scenery: Scenery,
    /// What items that are spoken of are called, by their numbers in the draw list.
    pub items: BTreeMap<u32, String>,
    /// What items cover of the pixel, hidden ones too, in draw order.
    pub covering: Vec<Covering>,
    /// What any other item covers at most: more than 0 where there are too many to tell.
    pub others: f64,
    /// The right colour.
    pub truth: Right,
    /// What is composed at the pixel's centre, from the ground up.
    pub ladder: Vec<Rung>,
    /// What each technique did.
    pub techniques: Vec<ByTechnique>,
    /// Techniques that do not draw the scene, and why.
    pub left_out: Vec<LeftOut>,
    /// The pixel and half a pixel around it through a microscope, where that was asked for.
    #[serde(skip)]
    pub close_up: Option<Buffer<[u8; 4]>>,
    /// Why the features that were asked for are not there, or that they are.
    pub feature: Option<Presence>,
}

impl Account {
    /// It as a JSON document.
    pub fn document(&self) -> impl Serialize + '_ {
        #[derive(Serialize)]
        struct Document<'a> {
            schema: u32,
            kind: &'static str,
            #[serde(flatten)]
            account: &'a Account,
        }
        Document { schema: SCHEMA, kind: "explanation", account: self }
    }
}

/// A line of sight.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Ray {
    /// Where it starts.
    pub from: [f64; 3],
    /// Its direction, of length 1.
    pub direction: [f64; 3],
}

/// What a pixel's centre sees.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Centre {
    /// The triangle's number.
    pub triangle: u32,
    /// The plan point.
    pub plan: [f64; 2],
    /// The surface point.
    pub world: [f64; 3],
    /// Its view depth, metres.
    pub depth: f64,
    /// How the plan point moves by a pixel to the right and one down, metres; none where the triangle is seen edge-on.
    pub pixel: Option<[[f64; 2]; 2]>,
    /// The nearest borders of items.
    pub margins: Vec<Margin>,
    /// The nearest silhouette.
    pub silhouette: Option<Silhouette>,
}

/// What an item covers of a pixel, as shares of its area.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Covering {
    /// The item's number in the draw list.
    pub item: u32,
    /// What it is called.
    pub name: String,
    /// Its colour.
    pub color: [f64; 4],
    /// At least.
    pub low: f64,
    /// At most.
    pub high: f64,
}

/// The right colour between two bounds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Right {
    /// Lower bounds.
    pub low: [f64; 4],
    /// Upper bounds.
    pub high: [f64; 4],
    /// An estimate between the two.
    pub estimate: [f64; 4],
}

impl Right {
    /// How far a colour is from it: the largest distance of a channel from its interval.
    pub fn distance(&self, color: [f64; 4]) -> f64 {
        use crate::math::max;
        (0..4).map(|c| max(self.low[c] - color[c], color[c] - self.high[c])).fold(0.0, max)
    }

    /// The width of the widest interval.
    pub fn width(&self) -> f64 {
        (0..4).map(|c| self.high[c] - self.low[c]).fold(0.0, crate::math::max)
    }
}

/// A rung of the composition's ladder.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Rung {
    /// What is drawn: the ground, the sky, an item.
    pub name: String,
    /// Its own colour.
    pub color: [f64; 4],
    /// The colour with it.
    pub after: [f64; 4],
}

/// What a technique did.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ByTechnique {
    /// Its name.
    pub technique: &'static str,
    /// Its paper.
    pub paper: &'static str,
    /// The pixel's code values.
    pub code: [u8; 4],
    /// How far they are from the truth, in units of 1.
    pub error: f64,
    /// What it did, in order.
    pub steps: Vec<Step>,
    /// Other settings that were tried; nothing where none were.
    pub tried: Vec<Tried>,
}

/// A step of a technique.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Step {
    /// Where the paper says so.
    pub section: &'static str,
    /// What was done.
    pub text: String,
    /// The items that it is about: their numbers in the draw list.
    pub items: Vec<u32>,
    /// The plan point that it is about.
    pub plan: Option<[f64; 2]>,
    /// Where that lies on the screen.
    pub screen: Option<[f64; 2]>,
    /// The nearest borders of items.
    pub margins: Vec<Margin>,
    /// The nearest silhouette.
    pub silhouette: Option<Silhouette>,
}

/// Other settings, and what they make of the pixel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Tried {
    /// The changes to the scene file: `path=value`.
    pub changes: Vec<String>,
    /// The pixel's code values.
    pub code: [u8; 4],
    /// How far they are from the truth.
    pub error: f64,
}

/// A technique that does not draw the scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LeftOut {
    /// Its name.
    pub technique: &'static str,
    /// Why.
    pub reason: String,
}

/// Where the features are that were asked for.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Presence {
    /// What was asked for.
    pub asked: String,
    /// Whether one of them has a share of the pixel's colour.
    pub shows: bool,
    /// What is to be said of them, a sentence each.
    pub reasons: Vec<String>,
}

/// A colour as `#rrggbb`, with its alpha where it is not opaque.
pub(super) fn hex(color: [f64; 4]) -> String {
    let [r, g, b, a] = crate::resolve::code_values(color);
    let alpha = if a == 255 { String::new() } else { format!("{a:02x}") };
    format!("#{r:02x}{g:02x}{b:02x}{alpha}")
}

/// Code values as a colour.
pub(super) fn color_of(code: [u8; 4]) -> [f64; 4] {
    code.map(|v| f64::from(v) / 255.0)
}
