//! What all grid files share: a header, a way to hand on heights, and where those go.
//!
//! A file's rows usually run from north to south, [`Posts`] from south to north. Here columns and rows are counted as
//! the file stores them; [`Sheet`] alone turns them.

use super::failure::too_many_posts;
use super::frame::{Frame, PostRange, Turn};
use super::geo_keys::CrsHint;
use super::vertical::VerticalUnit;
use crate::error::{Error, Result};
use crate::scene::Posts;
use crate::space::Plan;
use glam::DVec2;

/// A grid file that has been opened: its header is read and judged, its heights are not.
pub(super) trait GridFile {
    /// What the header says.
    fn header(&self) -> &Header;

    /// Refuses a file that is too short for the heights it promises for `part`; called before memory is set aside for
    /// them.
    fn check_promise(&mut self, part: &PostRange) -> Result<()>;

    /// Hands each post of `part` to `sink` once, in runs along rows; it may hand posts outside, too.
    fn scan(&mut self, part: &PostRange, sink: &mut dyn RowSink) -> Result<()>;
}

/// Takes heights in the order in which a file stores them.
pub(super) trait RowSink {
    /// The heights of the posts from `column` on in `row`, NaN where there is no data.
    fn take(&mut self, row: usize, column: usize, heights: &[f64]);
}

/// What a grid file's header says.
#[derive(Debug, Clone)]
pub(super) struct Header {
    pub(super) format: &'static str,
    /// The kind of number stored, like `int16`.
    pub(super) sample: String,
    pub(super) compression: String,
    /// How the samples are laid out, like `tiles of 256 x 256`.
    pub(super) layout: String,
    pub(super) nodata: Option<String>,
    pub(super) frame: Frame,
    /// Whether the file, or what lies beside it, says where the frame is.
    pub(super) is_placed: bool,
    pub(super) crs_hint: Option<CrsHint>,
    /// What the samples count in, once scaled; the metre where nothing is said.
    pub(super) unit: Option<VerticalUnit>,
    /// Factor and offset from samples to heights in that unit.
    pub(super) scaling: Option<(f64, f64)>,
    /// What the user should know; a scan may add to it.
    pub(super) notes: Vec<String>,
}

/// Heights on their way to become [`Posts`].
pub(super) struct Sheet {
    part: PostRange,
    turn: Turn,
    /// Where the south-west post stands.
    first: DVec2,
    heights: Vec<f64>,
    infinite: usize,
}

impl Sheet {
    /// Sets memory aside for a part of a frame; all of it without data yet.
    pub(super) fn new(frame: &Frame, part: PostRange) -> Result<Self> {
        let turn = frame.turn();
        let column = part.column + if turn.columns { part.columns - 1 } else { 0 };
        let row = part.row + if turn.rows { part.rows - 1 } else { 0 };
        let count = part.count();
        let mut heights = Vec::new();
        heights.try_reserve_exact(count).map_err(|_| too_many_posts(&part))?;
        heights.resize(count, f64::NAN);
        Ok(Self { part, turn, first: frame.at(column as f64, row as f64), heights, infinite: 0 })
    }

    /// The posts, with notes on what a user should know of them.
    pub(super) fn finish(self, notes: &mut Vec<String>) -> Result<Posts> {
        if self.infinite > 0 {
            notes.push(format!("{} infinite heights are taken as no data", self.infinite));
        }
        if self.heights.iter().all(|h| h.is_nan()) {
            return Err(Error::new("no post of the wanted part holds data")
                .help("choose another window, or check the file's nodata value and masks with gdalinfo"));
        }
        Posts::new(
            (self.part.columns, self.part.rows),
            Plan::from(self.first),
            (self.turn.east, self.turn.north),
            self.heights,
        )
    }
}

impl RowSink for Sheet {
    fn take(&mut self, row: usize, column: usize, heights: &[f64]) {
        let part = self.part;
        let (from, inside) = part.clip(row, column, heights);
        if inside.is_empty() {
            return;
        }
        let row = row - part.row;
        let row = if self.turn.rows { part.rows - 1 - row } else { row };
        let line = &mut self.heights[row * part.columns..][..part.columns];
        for (c, mut height) in (from - part.column..).zip(inside.iter().copied()) {
            if height.is_infinite() {
                self.infinite += 1;
                height = f64::NAN;
            }
            let c = if self.turn.columns { part.columns - 1 - c } else { c };
            line[c] = height;
        }
    }
}
