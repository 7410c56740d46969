//! The truth: each pixel's right colour as a certified interval.
//!
//! Input: a scene, its terrain and the view. Output: [`Truth`], for each pixel and channel two bounds around the mean over the
//! pixel's square of the composed colour (`docs/semantics.md`, Colour), and an estimate between them. Refuses: nothing; what
//! cannot be told within the [`Budget`] is in the interval.
//!
//! ```text
//!   seen.rs     which boxes of the plan a view may see
//!   tile.rs     a tile's triangles, by the terrain's hierarchy; squares down to pixels
//!   tile_rays.rs the tile's rays, with bounds of their errors
//!   facet.rs    a triangle on the tile: sides, nearness, its map to the plan (draped.rs), with bounds of their errors (form.rs)
//!   look.rs     single pixels, with what each sees
//!   probe.rs    the same of small squares around samples: what each may see (outcome.rs)
//!   touched.rs  which items touch each pixel (holding.rs: which hold its centre)
//!   visible.rs  the pixel cut into convex fragments that see one triangle (polygon.rs), and sky
//!   near.rs     the parts of borders near a fragment (around.rs remembers them, kept.rs what they are made of)
//!   refine.rs   fragments cut along footprints' borders (shape.rs) until little is unknown of which items hold them
//!               (knowledge.rs); colours between bounds (crate::certainty)
//! ```
//!
//! How it is certified: a border that is straight in the plan is straight on the screen within one triangle. Its line is computed
//! with a bound of its error; pieces are cut along the computed line, and the strip between it and where the exact line may be
//! counts as doubtful: its area times all possible colours is added to the interval. Round borders are never approximated: a piece
//! is in or out by bounds of the distance, or open. No decision is shared with a technique but the signs of
//! `crate::predicate`.

mod around;
mod draped;
mod facet;
mod form;
mod kept;
mod knowledge;
mod look;
mod near;
mod outcome;
mod polygon;
mod probe;
mod refine;
mod seen;
mod setting;
mod shape;
mod shapes;
mod tile;
mod tile_rays;
mod touched;
mod visible;

pub use look::{footprints_seen, look};
pub use outcome::{Outcome, PixelLook, Sample, SeenPiece};
pub use probe::{Probe, probe, probe_around};
pub use touched::Touched;

use crate::buffer::{Buffer, Look, Plane, PlaneKind, Values};
use crate::error::{Error, Result};
use crate::footprint::{Footprints, PixelSize};
use crate::math;
use crate::parallel;
use crate::resolve::code_values;
use crate::space::{Plan, ViewFrame, World};
use crate::stage::Stage;
use crate::terrain::SKY;
use crate::tiling::Tiling;
use seen::SeenPlan;
use setting::Setting;
use tile::{TILE, TileTruth, certify_tile};

/// The truth's name among the techniques', on the command line and in files.
pub const NAME: &str = "truth";

/// How exact the truth has to be, and how much work may go into a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Budget {
    /// A pixel is refined until no channel's interval is wider than this (units of 1).
    pub width: f64,
    /// A pixel is cut into at most 2^depth pieces.
    pub depth: u32,
    /// Whether the coverage of each item is kept, to the same width.
    pub coverage: bool,
}

impl Budget {
    /// The deepest that [`Budget::new`] takes: a million pieces.
    pub const MOST_DEPTH: u32 = 20;

    /// A budget without coverage.
    ///
    /// # Errors
    /// When the width is not in 0..=1 or the depth is over [`Budget::MOST_DEPTH`].
    pub fn new(width: f64, depth: u32) -> Result<Self> {
        if !(0.0..=1.0).contains(&width) {
            return Err(Error::usage(format!("a truth of width {width} cannot be asked for"))
                .help("give a width from 0 (as narrow as the depth allows) to 1, such as 0.002"));
        }
        if depth > Self::MOST_DEPTH {
            return Err(Error::usage(format!("2^{depth} pieces a pixel are too many"))
                .help(format!("give a depth of at most {}", Self::MOST_DEPTH)));
        }
        Ok(Self { width, depth, coverage: false })
    }
}

impl Default for Budget {
    /// Half a code value wide, 4,096 pieces.
    fn default() -> Self {
        Self { width: 1.0 / 510.0, depth: 12, coverage: false }
    }
}

/// What an item covers of a pixel, as a share of the pixel's area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ItemCoverage {
    /// The item's number in the draw list.
    pub item: u32,
    /// At least.
    pub low: f64,
    /// At most.
    pub high: f64,
}

/// What the items cover of a pixel.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PixelCoverage {
    /// Those that were looked at, in draw order.
    pub items: Vec<ItemCoverage>,
    /// What any other item covers at most.
    pub others: f64,
}

impl PixelCoverage {
    /// The same with one entry an item.
    fn joined(mut self) -> Self {
        self.items.sort_by_key(|entry| entry.item);
        let mut all: Vec<ItemCoverage> = Vec::new();
        for entry in &self.items {
            match all.last_mut().filter(|last| last.item == entry.item) {
                Some(last) => (last.low, last.high) = (last.low + entry.low, last.high + entry.high),
                None => all.push(*entry),
            }
        }
        for entry in &mut all {
            entry.low = math::max(entry.low - self.others, 0.0);
            entry.high = math::min(entry.high + self.others, 1.0);
        }
        Self { items: all, others: math::min(self.others, 1.0) }
    }
}

/// What a pixel's centre sees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Centre {
    /// The triangle's number.
    pub triangle: u32,
    /// The visible point, in plain doubles.
    pub world: World,
    /// Its place in the plan.
    pub plan: Plan,
}

/// What was done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Tally {
    /// Triangles looked at, once for each tile.
    pub triangles: u64,
    /// Fragments of one triangle in one pixel.
    pub fragments: u64,
    /// Pieces that fragments were cut into.
    pub pieces: u64,
    /// Pixels wider than the budget.
    pub wide_pixels: u64,
}

/// Each pixel's right colour between two bounds: RGBA, straight alpha, encoded values 0..=1.
#[derive(Debug)]
pub struct Truth {
    /// Lower bounds.
    pub low: Buffer<[f64; 4]>,
    /// Upper bounds.
    pub high: Buffer<[f64; 4]>,
    /// An estimate between the two.
    pub estimate: Buffer<[f64; 4]>,
    /// What each item covers of each pixel, when the budget asks for it.
    pub coverage: Option<Buffer<PixelCoverage>>,
    /// What each pixel's centre sees; `None`: the sky.
    pub centres: Buffer<Option<Centre>>,
    /// The centres' view depths, metres; infinite in the sky.
    pub depth: Buffer<f64>,
    /// What was done.
    pub tally: Tally,
    /// Bytes of the footprints and their index.
    pub structure_bytes: usize,
}

impl Truth {
    /// The truth of a stage from its scene's own camera. ([`certify`] takes any view, and tells how far it is.)
    ///
    /// # Errors
    /// When the camera shows nothing.
    pub fn of(stage: &Stage, budget: &Budget) -> Result<Self> {
        Ok(certify(stage, &stage.view()?, budget, &|_| {}))
    }

    /// The estimate as 8-bit code values.
    pub fn image(&self) -> Buffer<[u8; 4]> {
        let codes = self.estimate.values().iter().map(|c| code_values(*c)).collect();
        Buffer::from_values(self.estimate.width(), self.estimate.height(), codes)
    }

    /// The widest interval of any channel.
    pub fn widest(&self) -> f64 {
        let widths = self.low.values().iter().zip(self.high.values());
        widths.flat_map(|(l, h)| (0..4).map(|c| h[c] - l[c])).fold(0.0, |most, w| math::max(w, most))
    }

    /// The buffers that [`Truth::plane`] gives, from the first stage to the last.
    pub const PLANES: [PlaneKind; 6] = [
        PlaneKind::DEPTH,
        PlaneKind::TRIANGLE,
        PlaneKind::PLAN,
        PlaneKind::new("lo", Look::Color),
        PlaneKind::new("hi", Look::Color),
        PlaneKind::COLOR,
    ];

    /// A buffer by its name.
    pub fn plane(&self, name: &str) -> Option<Plane> {
        let colors = |buffer: &Buffer<[f64; 4]>| (4, Values::F64(buffer.values().as_flattened().to_vec()));
        let centres = || self.centres.values().iter();
        let index = Self::PLANES.iter().position(|known| known.name == name)?;
        let (components, values) = match name {
            "depth" => (1, Values::F64(self.depth.values().to_vec())),
            "triangle" => (1, Values::U32(centres().map(|c| c.map_or(SKY, |c| c.triangle)).collect())),
            "plan" => {
                let plan = |c: &Option<Centre>| c.map_or([f64::INFINITY; 2], |c| [c.plan.x, c.plan.y]);
                (2, Values::F64(centres().flat_map(plan).collect()))
            }
            "lo" => colors(&self.low),
            "hi" => colors(&self.high),
            _ => colors(&self.estimate),
        };
        let (width, height) = (self.estimate.width(), self.estimate.height());
        Some(Plane { name: Self::PLANES[index].name, width, height, components, values })
    }
}

/// Computes the truth of a view of a scene. `progress` is told the share that is done (0..=1), from any thread.
pub fn certify(stage: &Stage, view: &ViewFrame, budget: &Budget, progress: &(dyn Fn(f64) + Sync)) -> Truth {
    let (scene, draw_list, mesh) = (&stage.scene, &stage.draw_list, &*stage.mesh_for(view));
    let size = PixelSize::of(view, mesh);
    let (width, height) = (view.width(), view.height());
    let seen = SeenPlan::new(mesh, view);
    let footprints = Footprints::new(draw_list, size, &|plan| seen.meets(plan));
    let setting = Setting::new(scene, mesh, (&footprints, size), *budget);
    let tiling = Tiling::new(width, height, TILE);
    let tiles = parallel::map_telling(tiling.count(), progress, |k| {
        certify_tile(&setting, mesh, view, &tiling.place(k), None)
    });
    assembled(tiles, &tiling, view, &footprints, budget)
}

/// The tiles as one picture.
fn assembled(
    tiles: Vec<TileTruth>,
    tiling: &Tiling,
    view: &ViewFrame,
    footprints: &Footprints,
    budget: &Budget,
) -> Truth {
    let (width, height) = (view.width(), view.height());
    let count = width * height;
    let mut centres = vec![None; count];
    let mut bounds = [vec![[0.0; 4]; count], vec![[0.0; 4]; count], vec![[0.0; 4]; count]];
    let mut coverage = if budget.coverage { vec![PixelCoverage::default(); count] } else { Vec::new() };
    let mut tally = Tally::default();
    for (k, mut tile) in tiles.into_iter().enumerate() {
        let places = tiling.rows(k).flatten();
        for ((k, colors), at) in tile.colors.iter().enumerate().zip(places) {
            for (bound, color) in bounds.iter_mut().zip(colors) {
                bound[at] = *color;
            }
            centres[at] = tile.centres[k];
            let is_wide = (0..4).any(|c| colors[1][c] - colors[0][c] > budget.width);
            tally.wide_pixels += u64::from(is_wide);
            if let Some(of_pixel) = tile.coverage.get_mut(k) {
                coverage[at] = std::mem::take(of_pixel);
            }
        }
        tally.triangles += tile.tally.triangles;
        tally.fragments += tile.tally.fragments;
        tally.pieces += tile.tally.pieces;
    }
    let [low, high, estimate] = bounds.map(|values| Buffer::from_values(width, height, values));
    let depth = centres.iter().map(|c: &Option<Centre>| c.map_or(f64::INFINITY, |c| view.depth(c.world)));
    Truth {
        low,
        high,
        estimate,
        depth: Buffer::from_values(width, height, depth.collect()),
        centres: Buffer::from_values(width, height, centres),
        coverage: budget.coverage.then(|| Buffer::from_values(width, height, coverage)),
        tally,
        structure_bytes: footprints.bytes(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_an_item_covers_is_told_once_and_what_others_may_cover_widens_it() {
        let entry = |item, low, high| ItemCoverage { item, low, high };
        let items = vec![entry(7, 0.25, 0.5), entry(2, 0.0, 0.25), entry(7, 0.25, 0.25), entry(9, 0.75, 1.0)];
        let joined = PixelCoverage { items, others: 0.125 }.joined();
        assert_eq!(joined.items, [entry(2, 0.0, 0.375), entry(7, 0.375, 0.875), entry(9, 0.625, 1.0)]);
        assert_eq!(joined.others, 0.125);
        assert_eq!(PixelCoverage { items: Vec::new(), others: 1.5 }.joined().others, 1.0);
    }
}
