//! A tile of a frame: its surface points, its stencil, what has been painted.

use super::block::{Block, COLUMNS, ROWS, SIZE};
use super::context::FrameContext;
use super::face::{Face, SampleFrame, Setup};
use super::points;
use super::stencil::{Stencil, Traces};
use super::view::Entry;
use crate::buffer::Touches;
use crate::canvas::LastGround;
use crate::raster::TileView;
use crate::resolve::{Mix, Paint};
use crate::scene::Group;
use crate::technique::stencil_volume::VolumeCaps;

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
pub struct Tile<'a, R = ()> {
    /// What all tiles are drawn with.
    pub context: &'a FrameContext<'a>,
    /// Which tile.
    pub view: TileView,
    /// Its samples and the surface points that they see.
    pub blocks: Vec<Block>,
    /// Blocks a row.
    pub blocks_a_row: usize,
    /// Where the surface points lie.
    pub place: SampleFrame,
    /// Its stencil planes.
    pub stencil: Stencil,
    /// What each sample has been painted with, by block; empty: nothing.
    painted: Vec<Vec<Option<Paint>>>,
    /// The group that is being drawn, and what lies below it at the samples that it has painted, by block.
    group: Option<(Group, Vec<Vec<Option<Paint>>>)>,
    /// Planes to look at.
    pub traces: Option<Traces>,
    /// Which items have been drawn on its pixels.
    pub touches: Touches,
    /// What was done.
    pub counts: Counts,
    /// Room for the faces of a volume.
    pub faces: Vec<Face>,
    /// Room for the blocks that a volume may meet.
    pub met: Vec<usize>,
    /// What takes the steps on the way to the samples' colours.
    pub record: R,
    ground: LastGround,
}

impl<'a, R> Tile<'a, R> {
    /// A tile before anything is drawn into it; `entries` are the volumes that will be.
    pub fn new(context: &'a FrameContext, view: TileView, entries: &[Entry], record: R) -> Self {
        let size = (view.width, view.height);
        let (place, blocks) = points::seen(context, &view, entries);
        let count = blocks.len();
        Self {
            context,
            blocks,
            blocks_a_row: size.0.div_ceil(COLUMNS),
            place,
            stencil: Stencil::new(count, context.stencil_width()),
            painted: vec![Vec::new(); count],
            group: None,
            traces: context.wants_traces.then(|| Traces::new(count)),
            touches: Touches::new(context.view.width(), context.wants_items),
            counts: Counts::default(),
            faces: Vec::new(),
            met: Vec::new(),
            record,
            ground: context.backdrop.no_ground(),
            view,
        }
    }

    /// Paints a sample.
    #[inline]
    pub fn paint(&mut self, (block, at): (usize, usize), paint: Paint) {
        let below = match self.painted[block].get(at) {
            Some(Some(below)) => *below,
            _ => self.ground_at((block, at)),
        };
        if let Some((_, kept)) = &mut self.group {
            put(&mut kept[block], at, |known| known.unwrap_or(below));
        }
        let above = self.context.backdrop.compositor.over(below, paint);
        put(&mut self.painted[block], at, |_| above);
    }

    /// An item has been drawn on a sample; of an even number of samples a side the last before the pixel's middle counts as that.
    pub fn touch(&mut self, at: (usize, usize), item: u32) {
        if self.touches.is_wanted() {
            let n = self.context.samples();
            let [c, r] = sample_of(&self.blocks, at);
            let (column, row) = (self.view.column + c, self.view.row + r);
            let is_central = column % n == (n - 1) / 2 && row % n == (n - 1) / 2;
            self.touches.push([column / n, row / n], item, is_central);
        }
    }

    /// Begins to draw a group, or none: what was drawn of another is mixed with what lies below it.
    pub fn enter(&mut self, group: Option<Group>) {
        if self.group.as_ref().map(|(open, _)| *open) == group {
            return;
        }
        if let Some((done, kept)) = self.group.take() {
            for (painted, kept) in self.painted.iter_mut().zip(&kept) {
                for (painted, below) in painted.iter_mut().zip(kept) {
                    if let (Some(painted), Some(below)) = (painted, below) {
                        *painted = below.mixed(*painted, done.opacity);
                    }
                }
            }
        }
        self.group = group.map(|group| (group, vec![Vec::new(); self.blocks.len()]));
    }

    /// The paint of a sample, where features have been drawn on it.
    #[inline]
    pub fn painted(&self, column: usize, row: usize) -> Option<Paint> {
        let (block, at) = self.index(column, row);
        self.painted[block].get(at).copied().flatten()
    }

    /// How many samples of a row, from one on, surely show the same triangle's ground and nothing else; 0 where that is not known.
    pub fn bare_samples(&self, column: usize, row: usize) -> usize {
        let (block, at) = self.index(column, row);
        if !self.painted[block].is_empty() || !self.context.backdrop.is_constant_on_triangles() {
            return 0;
        }
        let columns = self.context.sight.lattice().columns;
        let first = (self.view.row + row) * columns + self.view.column + column;
        let count = (COLUMNS - at % COLUMNS).min(self.view.width - column);
        let triangles = &self.context.sight.triangles()[first..first + count];
        triangles.iter().take_while(|triangle| **triangle == triangles[0]).count()
    }

    /// Block, and sample in it, of the tile's sample (column, row).
    #[inline(always)]
    pub fn index(&self, column: usize, row: usize) -> (usize, usize) {
        let block = row / ROWS * self.blocks_a_row + column / COLUMNS;
        (block, row % ROWS * COLUMNS + column % COLUMNS)
    }

    fn ground_at(&mut self, at: (usize, usize)) -> Paint {
        let [c, r] = sample_of(&self.blocks, at);
        self.context.ground_paint(&mut self.ground, (self.view.column + c, self.view.row + r))
    }

    /// What sets up faces for the tile.
    pub fn setup(&self) -> Setup<'_> {
        let is_open_above = self.context.settings.caps == VolumeCaps::Bottom;
        Setup { view: &self.view, place: self.place, is_open_above }
    }
}

/// Puts a paint at a sample of a block, whose samples have none as long as it is empty.
fn put(block: &mut Vec<Option<Paint>>, at: usize, paint: impl FnOnce(Option<Paint>) -> Paint) {
    if block.is_empty() {
        *block = vec![None; SIZE];
    }
    block[at] = Some(paint(block[at]));
}

/// Column and row in the tile of a block's sample.
#[inline(always)]
pub fn sample_of(blocks: &[Block], (block, at): (usize, usize)) -> [usize; 2] {
    [blocks[block].column + at % COLUMNS, blocks[block].row + at / COLUMNS]
}
