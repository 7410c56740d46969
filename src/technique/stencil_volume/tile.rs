//! A tile: its volumes counted and its masks applied in draw order (Fig. 4).
//!
//! Input: the volumes that may touch the tile. Output: the tile's colours and, where they are asked for, its stencil planes. Refuses: nothing.
//!
//! Counting is done in one of three ways, all with the same mask where they all apply:
//! - *in passing* ([`Way::Sparse`]): the filter and the exact predicates, only in blocks whose surface points may lie in the volume.
//!   Elsewhere the faces that a line crosses before (or behind) its point cancel, so that nothing is lost while counts wrap;
//! - *in full* ([`Way::Full`]): the same in every block that the volume's picture touches, fragment by fragment in order, the
//!   mask applied through the boxes of the volumes (4.2.2). For planes to look at, and wherever something is asked for that does not cancel;
//! - *on a machine* ([`Way::Machine`]): fragments and depth test of the imitated graphics processor.

mod fragments;
mod points;

use super::block::{Block, COLUMNS, ROWS, SIZE};
use super::face::{Face, Fragment, Outline, Place, Setup};
use super::frame::Drawing;
use super::stencil::{Method, Stencil, Traces, Width, passes};
use super::view::Entry;
use crate::raster::TileView;
use crate::resolve::Paint;
use crate::scene::Rule;
use crate::technique::stencil_volume::VolumeCaps;
use fragments::Sparse;

/// How fragments are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Only where a volume's fragments do not cancel.
    Sparse,
    /// Everywhere.
    Full,
    /// By the imitated machine.
    Machine,
}

/// What was done in a tile.
#[derive(Debug, Clone, Copy, Default)]
pub struct Counts {
    /// Faces that were set up.
    pub faces: u64,
    /// Samples that faces covered.
    pub fragments: u64,
    /// Fragments that needed exact arithmetic.
    pub exact_decisions: u64,
    /// Masks that were applied.
    pub masks: u64,
}

impl Counts {
    /// The sum of two counts.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            faces: self.faces + other.faces,
            fragments: self.fragments + other.fragments,
            exact_decisions: self.exact_decisions + other.exact_decisions,
            masks: self.masks + other.masks,
        }
    }
}

/// A tile being drawn.
pub struct Tile<'a> {
    drawing: &'a Drawing<'a>,
    /// Which tile.
    pub view: TileView,
    blocks: Vec<Block>,
    blocks_a_row: usize,
    place: Place,
    stencil: Stencil,
    /// What each sample has been painted with, by block; empty: nothing.
    painted: Vec<Vec<Option<Paint>>>,
    /// Planes to look at.
    pub traces: Option<Traces>,
    /// What was done.
    pub counts: Counts,
    faces: Vec<Face>,
}

impl<'a> Tile<'a> {
    /// A tile before anything is drawn into it; `entries` are the volumes that will be.
    pub fn new(drawing: &'a Drawing, view: TileView, entries: &[Entry]) -> Self {
        let size = (view.width, view.height);
        let (place, blocks) = points::seen(drawing, &view, entries);
        let count = blocks.len();
        Self {
            drawing,
            blocks,
            blocks_a_row: size.0.div_ceil(COLUMNS),
            place,
            stencil: Stencil::new(count, drawing.width()),
            painted: vec![Vec::new(); count],
            traces: drawing.wants_traces.then(|| Traces::new(count)),
            counts: Counts::default(),
            faces: Vec::new(),
            view,
        }
    }

    /// Draws volumes in order, each pass's mask once (4.2).
    pub fn draw(&mut self, entries: &[Entry]) {
        for pass in entries.chunk_by(|a, b| a.pass == b.pass) {
            let stroke = pass.partition_point(|e| e.is_cutter);
            let (cutters, volumes) = pass.split_at(stroke);
            let cut = self.drawing.cut_of(pass[0].pass);
            if let Some((rule, _)) = cut {
                self.stencil.inside = vec![[false; SIZE]; self.blocks.len()];
                self.count_all(cutters);
                self.cut(cutters, rule);
                self.stencil.width.bits -= 1;
            }
            self.count_all(volumes);
            self.apply(volumes, cut.map(|(_, keeps_inside)| keeps_inside));
            self.stencil.width = self.drawing.width();
            self.counts.masks += 1;
        }
    }

    /// The first sub-step of an outline that is cut: what the polygon's mask says is kept in a bit.
    fn cut(&mut self, cutters: &[Entry], rule: Rule) {
        self.for_each_masked(cutters, |tile, at| {
            let is_inside = passes(tile.stencil.take(at), rule);
            tile.stencil.inside[at.0][at.1] |= is_inside;
        });
    }

    /// Generates the mask (4.2.1).
    fn count_all(&mut self, entries: &[Entry]) {
        for entry in entries {
            match self.drawing.way {
                Way::Sparse => self.count_sparsely(entry),
                Way::Full => self.count_fully(entry),
                Way::Machine => self.count_on_machine(entry),
            }
        }
    }

    /// Applies the mask (4.2.2); `keeps_inside`: only inside, or only outside, of what was cut to.
    fn apply(&mut self, entries: &[Entry], keeps_inside: Option<bool>) {
        let Some(entry) = entries.first() else { return };
        let (paint, rule) = self.drawing.paint_of(entry.pass);
        let is_traced = self.drawing.is_traced(entry.pass);
        let is_picked = self.drawing.settings.object.is_some();
        self.for_each_masked(entries, |tile, at| {
            let value = tile.stencil.take(at);
            if let (Some(traces), true) = (&mut tile.traces, is_traced) {
                let trace = &mut traces.stencil[at.0][at.1];
                // A mask is applied through several boxes: only the first finds it.
                if value != 0 || is_picked && *trace == 0 {
                    *trace = value;
                }
            }
            let is_kept = keeps_inside.is_none_or(|keep| tile.stencil.inside[at.0][at.1] == keep);
            if is_kept && passes(value, rule) {
                tile.paint(at, paint);
            }
        });
    }

    /// Calls `visit` with each sample that the mask is applied to.
    fn for_each_masked(&mut self, entries: &[Entry], mut visit: impl FnMut(&mut Self, (usize, usize))) {
        if self.drawing.way == Way::Sparse {
            for block in 0..self.blocks.len() {
                if !std::mem::take(&mut self.stencil.touched[block]) {
                    continue;
                }
                for at in 0..SIZE {
                    if self.stencil.counts[block][at] != 0 {
                        visit(self, (block, at));
                    }
                }
            }
            return;
        }
        for entry in entries {
            let method = self.drawing.method_of(entry.volume);
            for outline in self.drawing.box_of(entry.volume) {
                self.for_each_fragment(&outline, entry, &mut |tile, at, fragment| {
                    // Fronts with the depth test for z-pass, backs without for z-fail.
                    let is_drawn = match method {
                        Method::ZPass => fragment.facing == 1 && !fragment.is_behind,
                        Method::ZFail => fragment.facing == -1,
                    };
                    if is_drawn {
                        visit(tile, at);
                    }
                });
            }
        }
    }

    fn paint(&mut self, (block, at): (usize, usize), paint: Paint) {
        let below = match self.painted[block].get(at) {
            Some(Some(below)) => *below,
            _ => self.ground_at((block, at)),
        };
        if self.painted[block].is_empty() {
            self.painted[block] = vec![None; SIZE];
        }
        self.painted[block][at] = Some(self.drawing.compositor.over(below, paint));
    }

    /// The paint of a sample, where features have been drawn on it.
    #[inline]
    pub fn painted(&self, column: usize, row: usize) -> Option<Paint> {
        let (block, at) = self.index(column, row);
        self.painted[block].get(at).copied().flatten()
    }

    /// Block, and sample in it, of the tile's sample (column, row).
    #[inline(always)]
    pub fn index(&self, column: usize, row: usize) -> (usize, usize) {
        let block = row / ROWS * self.blocks_a_row + column / COLUMNS;
        (block, row % ROWS * COLUMNS + column % COLUMNS)
    }

    /// Column and row in the tile of a block's sample.
    fn sample(&self, (block, at): (usize, usize)) -> (usize, usize) {
        (self.blocks[block].column + at % COLUMNS, self.blocks[block].row + at / COLUMNS)
    }

    fn ground_at(&self, at: (usize, usize)) -> Paint {
        let (c, r) = self.sample(at);
        self.drawing.ground_paint(self.view.column + c, self.view.row + r)
    }

    fn setup(&self) -> Setup<'_> {
        let is_open_above = self.drawing.settings.caps == VolumeCaps::Bottom;
        Setup { view: &self.view, place: self.place, is_open_above }
    }

    /// Sets up the faces of a volume.
    fn set_up(&mut self, entry: &Entry) -> Vec<Face> {
        let mut faces = std::mem::take(&mut self.faces);
        let (extrusion, volume) = (self.drawing.extrusion, self.drawing.volume(entry.volume));
        self.setup().faces(extrusion, volume, self.drawing.is_cut(entry.volume), &mut faces);
        self.counts.faces += faces.len() as u64;
        faces
    }

    fn count_sparsely(&mut self, entry: &Entry) {
        let volume = self.drawing.volume(entry.volume);
        let o = self.place.origin;
        let low = [volume.plan.min.x - o.x, volume.plan.min.y - o.y, volume.low - o.z];
        let high = [volume.plan.max.x - o.x, volume.plan.max.y - o.y, volume.high - o.z];
        let slack = 2.0 * self.place.error + self.place.reach * f64::from(f32::EPSILON);
        let ((c0, r0), (c1, r1)) = entry.samples_in(&self.view);
        let met: Vec<usize> = (r0 / ROWS..=r1 / ROWS)
            .flat_map(|y| (c0 / COLUMNS..=c1 / COLUMNS).map(move |x| (x, y)))
            .map(|(x, y)| y * self.blocks_a_row + x)
            .filter(|&b| self.blocks[b].meets(&low, &high, slack))
            .collect();
        if met.is_empty() {
            return;
        }
        let faces = self.set_up(entry);
        let method = self.drawing.method_of(entry.volume);
        let arch = self.drawing.arch;
        arch.dispatch(Sparse { tile: self, faces: &faces, method, blocks: &met });
        self.faces = faces;
    }

    fn count_fully(&mut self, entry: &Entry) {
        let faces = self.set_up(entry);
        let method = self.drawing.method_of(entry.volume);
        for face in &faces {
            self.visit_face(face, &mut |tile, at, fragment| {
                tile.count_one(entry, at, method, fragment);
            });
        }
        self.faces = faces;
    }

    fn count_on_machine(&mut self, entry: &Entry) {
        let is_open_above = self.drawing.settings.caps == VolumeCaps::Bottom;
        let method = self.drawing.method_of(entry.volume);
        let volume = self.drawing.volume(entry.volume);
        Outline::for_each(self.drawing.extrusion, volume, is_open_above, |outline| {
            self.counts.faces += 1;
            self.visit_on_machine(&outline, &mut |tile, at, fragment| {
                tile.count_one(entry, at, method, fragment);
            });
        });
    }

    /// Counts a fragment and notes it in the planes to look at.
    fn count_one(&mut self, entry: &Entry, at: (usize, usize), method: Method, fragment: Fragment) {
        self.counts.fragments += 1;
        let step = self.stencil.count(at, method, fragment);
        if let (Some(traces), true) = (&mut self.traces, self.drawing.is_traced(entry.pass)) {
            traces.overdraw[at.0][at.1] += 1;
            if step != 0 && !entry.is_cutter {
                let side = if fragment.facing > 0 { &mut traces.front } else { &mut traces.back };
                side[at.0][at.1] += 1;
            }
        }
    }
}

impl Drawing<'_> {
    fn width(&self) -> Width {
        Width { bits: self.stage.scene.device.stencil_bits, overflow: self.settings.overflow }
    }
}
