//! The truth: each pixel's right colour as a certified interval.
//!
//! Input: a scene, its terrain and the view. Output: [`Truth`], for each pixel and channel two bounds around the mean over the
//! pixel's square of the composed colour (`docs/semantics.md`, Colour), and an estimate between them. Refuses: nothing; what
//! cannot be told within the [`Budget`] is in the interval.
//!
//! ```text
//!   tile.rs     a tile's triangles, by the terrain's hierarchy; squares down to pixels
//!   facet.rs    a triangle on the tile: sides, nearness, its map to the plan, with bounds of their errors (form.rs)
//!   visible.rs  the pixel cut into convex fragments that see one triangle (polygon.rs), and sky
//!   refine.rs   fragments cut along footprints' borders (shape.rs) until little is unknown of which items hold them
//!               (knowledge.rs); colours between bounds (color.rs)
//! ```
//!
//! How it is certified: a border that is straight in the plan is straight on the screen within one triangle. Its line is computed
//! with a bound of its error; pieces are cut along the computed line, and the strip between it and where the exact line may be
//! counts as doubtful: its area times all possible colours is added to the interval. Round borders are never approximated: a piece
//! is in or out by bounds of the distance, or open. No decision is shared with a technique but the signs of
//! [`crate::predicate`].

mod budget;
mod color;
mod coverage;
mod facet;
mod form;
mod knowledge;
mod polygon;
mod refine;
mod setting;
mod shape;
mod tile;
mod visible;

pub use budget::Budget;
pub use coverage::{ItemCoverage, PixelCoverage};
pub use tile::{Centre, Tally};

use crate::buffer::{Buffer, Plane, Values};
use crate::footprint::{Footprints, Item, PixelSize};
use crate::math;
use crate::parallel;
use crate::resolve::code_values;
use crate::space::ViewFrame;
use crate::stage::Stage;
use crate::terrain::SKY;
use setting::Setting;
use std::sync::atomic::{AtomicUsize, Ordering};
use tile::{Frustum, TILE, TileTruth, certify_tile};

/// The truth's name among the techniques', on the command line and in files.
pub const NAME: &str = "truth";

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
    items: Vec<Item>,
}

impl Truth {
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

    /// The sets of plan points that were drawn, in draw order.
    pub fn items(&self) -> &[Item] {
        &self.items
    }

    /// The names of the buffers that [`Truth::plane`] gives, from the first stage to the last.
    pub const BUFFERS: [&'static str; 6] = ["depth", "triangle", "plan", "lo", "hi", "color"];

    /// A buffer by its name.
    pub fn plane(&self, name: &str) -> Option<Plane> {
        let colors = |buffer: &Buffer<[f64; 4]>| (4, Values::F64(buffer.values().as_flattened().to_vec()));
        let centres = || self.centres.values().iter();
        let index = Self::BUFFERS.iter().position(|known| *known == name)?;
        let (components, values) = match name {
            "depth" => (1, Values::F64(self.depth.values().to_vec())),
            "triangle" => (1, Values::U32(centres().map(|c| c.map_or(SKY, |c| c.triangle)).collect())),
            "plan" => {
                let plan = |c: &Option<Centre>| c.map_or([f64::INFINITY; 2], |c| [c.world.x, c.world.y]);
                (2, Values::F64(centres().flat_map(plan).collect()))
            }
            "lo" => colors(&self.low),
            "hi" => colors(&self.high),
            _ => colors(&self.estimate),
        };
        let (width, height) = (self.estimate.width(), self.estimate.height());
        Some(Plane { name: Self::BUFFERS[index], width, height, components, values })
    }
}

/// Computes the truth of a view of a scene. `progress` is told the share that is done (0..=1), from any thread.
pub fn certify(stage: &Stage, view: &ViewFrame, budget: &Budget, progress: &(dyn Fn(f64) + Sync)) -> Truth {
    let Stage { scene, mesh } = stage;
    let heights = mesh.heights();
    let size = PixelSize::of(view, heights);
    let (width, height) = (view.width(), view.height());
    let whole = Frustum::new(view, [0.0, 0.0], [width as f64, height as f64]);
    let bounds = mesh.plan_bounds();
    let footprints =
        Footprints::new(&scene.layers, size, &|plan| plan.meets(&bounds) && whole.meets_plan(plan, heights));
    let setting = Setting::new(scene, mesh, (&footprints, size), *budget);
    let (columns, rows) = (width.div_ceil(TILE), height.div_ceil(TILE));
    let done = AtomicUsize::new(0);
    let tiles = parallel::map_indices(columns * rows, |k| {
        let corner = [k % columns * TILE, k / columns * TILE];
        let size = [TILE.min(width - corner[0]), TILE.min(height - corner[1])];
        let tile = certify_tile(&setting, mesh, view, (corner, size));
        progress((done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / (columns * rows) as f64);
        (corner, size, tile)
    });
    assembled(tiles, view, &footprints, budget)
}

/// The tiles as one picture.
fn assembled(
    tiles: Vec<([usize; 2], [usize; 2], TileTruth)>,
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
    for (corner, size, mut tile) in tiles {
        for (k, colors) in tile.colors.iter().enumerate() {
            let at = (corner[1] + k / size[0]) * width + corner[0] + k % size[0];
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
        items: footprints.items().to_vec(),
    }
}
