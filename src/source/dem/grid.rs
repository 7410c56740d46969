//! What all grid files share: a header, a way to hand on heights, and where those go.
//!
//! A file's rows usually run from north to south, [`Posts`] from south to north. Here columns and rows are counted as
//! the file stores them; [`Sheet`] alone turns them.

use super::failure::too_many_posts;
use super::frame::{Frame, PostRange, Turn};
use super::geo_keys::CrsHint;
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
    pub(super) crs_hint: Option<CrsHint>,
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
        note_range(&self.heights, notes)?;
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
        if row < part.row || row >= part.row + part.rows {
            return;
        }
        let from = part.column.max(column);
        let to = (part.column + part.columns).min(column + heights.len());
        let row = row - part.row;
        let row = if self.turn.rows { part.rows - 1 - row } else { row };
        let line = &mut self.heights[row * part.columns..][..part.columns];
        for c in from..to {
            let mut height = heights[c - column];
            if height.is_infinite() {
                self.infinite += 1;
                height = f64::NAN;
            }
            let c = c - part.column;
            let c = if self.turn.columns { part.columns - 1 - c } else { c };
            line[c] = height;
        }
    }
}

/// Refuses a part without any data; notes heights that the Earth does not have.
fn note_range(heights: &[f64], notes: &mut Vec<String>) -> Result<()> {
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for &h in heights {
        range = [crate::math::min(h, range[0]), crate::math::max(h, range[1])];
    }
    let [low, high] = range;
    if low > high {
        return Err(Error::new("no post of the wanted part holds data")
            .help("choose another window, or check the file's nodata value with gdalinfo"));
    }
    if low < DEEPEST || high > HIGHEST {
        notes.push(format!(
            "heights run from {low} to {high}: if that is a nodata value, declare it (gdal_edit.py -a_nodata VALUE)"
        ));
    }
    Ok(())
}

/// Below the deepest sea floor, in metres.
const DEEPEST: f64 = -11_500.0;

/// Above the highest summit, in metres or feet.
const HIGHEST: f64 = 30_000.0;
