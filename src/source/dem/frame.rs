//! Where the posts of a grid file stand, and which of them cover a window.
//!
//! Columns and rows are counted as the file stores them, its rows usually from north to south. Refuses places that are not
//! finite or not distinct, and windows that miss.

use crate::error::{Error, Result};
use glam::DVec2;

/// Where the posts of a file stand: post (c, r) at `first + c * column + r * row`.
///
/// # Guarantees
/// At least 2 x 2 posts; all posts at finite, distinct places.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::source) struct Frame {
    pub(super) columns: usize,
    pub(super) rows: usize,
    /// The first post in the file: usually the north-west one.
    first: DVec2,
    column: DVec2,
    row: DVec2,
}

impl Frame {
    /// A frame of posts.
    pub(super) fn new(
        (columns, rows): (usize, usize),
        first: DVec2,
        (column, row): (DVec2, DVec2),
    ) -> Result<Self> {
        if columns < 2 || rows < 2 {
            return Err(Error::new(format!(
                "a terrain needs at least 2 x 2 posts, this one has {columns} x {rows}"
            )));
        }
        if columns > MOST || rows > MOST {
            return Err(Error::new(format!(
                "{columns} x {rows} posts are absurdly many: the header is damaged"
            )));
        }
        let frame = Self { columns, rows, first, column, row };
        frame.check_place()?;
        Ok(frame)
    }

    /// A frame with axes along the plan's, from its outer edges x0, y0, x1, y1: posts at the cells' centres.
    pub(super) fn within(size: (usize, usize), [x0, y0, x1, y1]: [f64; 4]) -> Result<Self> {
        if !(x0 < x1 && y0 < y1) {
            return Err(Error::new(format!("the bounds [{x0}, {y0}, {x1}, {y1}] enclose nothing"))
                .help("bounds are [west, south, east, north]"));
        }
        let column = DVec2::new((x1 - x0) / size.0 as f64, 0.0);
        let row = DVec2::new(0.0, -(y1 - y0) / size.1 as f64);
        Self::new(size, DVec2::new(x0, y1) + (column + row) * 0.5, (column, row))
    }

    /// A frame by GDAL's six numbers: cell (c, r) has its corner at `x = a + b c + d r`, `y = e + f c + g r`.
    pub(super) fn of_geo_transform(size: (usize, usize), [a, b, d, e, f, g]: [f64; 6]) -> Result<Self> {
        let (column, row) = (DVec2::new(b, f), DVec2::new(d, g));
        Self::new(size, DVec2::new(a, e) + (column + row) * 0.5, (column, row))
    }

    /// A frame for a file that says nothing of its place: cell 1, the south-west post at (0, 0).
    pub(super) fn local(size: (usize, usize)) -> Result<Self> {
        let first = DVec2::new(0.0, size.1 as f64 - 1.0);
        Self::new(size, first, (DVec2::X, DVec2::NEG_Y))
    }

    /// Refuses places that are not finite, or that do not differ in double precision.
    fn check_place(&self) -> Result<()> {
        let corners = self.corners();
        if !corners.iter().all(|c| c.is_finite()) {
            return Err(
                Error::new("the grid's position or cell size is not a finite number").help(GEOREFERENCE)
            );
        }
        let furthest = corners.iter().fold(0.0, |far, c| crate::math::max(c.abs().max_element(), far));
        let area = self.column.perp_dot(self.row).abs();
        let longest = crate::math::max(self.column.length(), self.row.length());
        let narrow = area / longest;
        if !narrow.is_finite() || narrow <= furthest * SMALLEST_STEP {
            return Err(Error::new(format!(
                "the grid's columns {} and rows {} do not span a plane at this position",
                show(self.column),
                show(self.row)
            ))
            .help(GEOREFERENCE));
        }
        Ok(())
    }

    /// Whether columns run straight east and rows straight south.
    pub(in crate::source) fn is_upright(&self) -> bool {
        self.column.x > 0.0 && self.column.y == 0.0 && self.row.x == 0.0 && self.row.y < 0.0
    }

    /// Where the post in column `c` and row `r` stands (both may be fractions).
    pub(super) fn at(&self, c: f64, r: f64) -> DVec2 {
        self.first + self.column * c + self.row * r
    }

    /// The step from a column to the next.
    pub(super) fn column(&self) -> DVec2 {
        self.column
    }

    /// The step from a row to the next.
    pub(super) fn row(&self) -> DVec2 {
        self.row
    }

    fn corners(&self) -> [DVec2; 4] {
        self.corners_grown(0.0)
    }

    fn corners_grown(&self, by: f64) -> [DVec2; 4] {
        let (c, r) = (self.columns as f64 - 1.0 + by, self.rows as f64 - 1.0 + by);
        [(-by, -by), (c, -by), (-by, r), (c, r)].map(|(c, r)| self.at(c, r))
    }

    /// The box around all posts: x0, y0, x1, y1.
    pub(super) fn bounds(&self) -> [f64; 4] {
        bounding(self.corners())
    }

    /// The box around all cells, half a cell larger than the posts': what GIS programs show.
    pub(in crate::source) fn edges(&self) -> [f64; 4] {
        bounding(self.corners_grown(0.5))
    }

    /// All posts.
    pub(super) fn whole(&self) -> PostRange {
        PostRange { column: 0, row: 0, columns: self.columns, rows: self.rows }
    }

    /// The posts that cover a window, with a note where the window leaves the file.
    pub(super) fn part(&self, window: Option<[f64; 4]>) -> Result<(PostRange, Option<String>)> {
        let Some(window) = window else {
            return Ok((self.whole(), None));
        };
        let [x0, y0, x1, y1] = window;
        if !window.iter().all(|v| v.is_finite()) || x0 >= x1 || y0 >= y1 {
            return Err(Error::new(format!("the window [{x0}, {y0}, {x1}, {y1}] encloses nothing"))
                .help("a window is [west, south, east, north] in the file's own coordinates"));
        }
        let [c0, r0, c1, r1] = self.window_in_posts(window);
        let columns = span(c0, c1, self.columns);
        let rows = span(r0, r1, self.rows);
        let (Some((column, columns)), Some((row, rows))) = (columns, rows) else {
            return Err(self.missed_by(window));
        };
        let part = PostRange { column, row, columns, rows };
        let leaves = c0 < 0.0 || r0 < 0.0 || c1 > self.columns as f64 - 1.0 || r1 > self.rows as f64 - 1.0;
        let note = leaves.then(|| {
            format!("the window reaches beyond the terrain, whose posts span {}", show_box(self.bounds()))
        });
        Ok((part, note))
    }

    /// How many columns and rows another frame's first post lies off; `None` where its posts do not stand on this frame's grid.
    pub(super) fn steps_to(&self, other: &Self) -> Option<(i64, i64)> {
        /// A share of a cell that a post may be off.
        const SLACK: f64 = 0.01;
        let cells = |v: DVec2| {
            let det = self.column().perp_dot(self.row());
            DVec2::new(v.perp_dot(self.row()) / det, self.column().perp_dot(v) / det)
        };
        let offset = cells(other.at(0.0, 0.0) - self.at(0.0, 0.0));
        let whole = offset.round();
        let drift = |step: DVec2, unit: DVec2, count: usize| (cells(step) - unit).length() * count as f64;
        let is_same = (offset - whole).length() <= SLACK
            && drift(other.column(), DVec2::X, other.columns) <= SLACK
            && drift(other.row(), DVec2::Y, other.rows) <= SLACK
            && whole.length() < 1e9;
        is_same.then_some((whole.x as i64, whole.y as i64))
    }

    /// The smallest range of columns and rows around a window: c0, r0, c1, r1.
    fn window_in_posts(&self, [x0, y0, x1, y1]: [f64; 4]) -> [f64; 4] {
        let det = self.column.perp_dot(self.row);
        bounding([(x0, y0), (x1, y0), (x0, y1), (x1, y1)].map(|(x, y)| {
            let d = DVec2::new(x, y) - self.first;
            DVec2::new(snap(d.perp_dot(self.row) / det), snap(self.column.perp_dot(d) / det))
        }))
    }

    fn missed_by(&self, [x0, y0, x1, y1]: [f64; 4]) -> Error {
        Error::new(format!(
            "the window [{x0}, {y0}, {x1}, {y1}] misses the terrain, whose posts span {}",
            show_box(self.bounds())
        ))
        .help("give the window in the file's own coordinates")
    }

    /// How its rows and columns turn to run east and north.
    pub(super) fn turn(&self) -> Turn {
        let columns = self.column.x < 0.0;
        let east = if columns { -self.column } else { self.column };
        let rows = east.perp_dot(self.row) < 0.0;
        let north = if rows { -self.row } else { self.row };
        Turn { columns, rows, east, north }
    }
}

/// The help for a frame that is none.
const GEOREFERENCE: &str =
    "check the georeference with gdalinfo; set it with gdal_edit.py -a_ullr west north east south";

/// The most columns or rows that a file may promise; their product still fits 64 bits.
const MOST: usize = 1 << 31;

/// The smallest step of posts, relative to their coordinates, that double precision still tells well apart.
const SMALLEST_STEP: f64 = 1.0 / (1_u64 << 44) as f64;

/// Moves a position to the post it differs from by rounding only.
fn snap(v: f64) -> f64 {
    let nearest = v.round();
    if (v - nearest).abs() <= 1e-9 * crate::math::max(nearest.abs(), 1.0) { nearest } else { v }
}

/// The whole posts (first, count) around `low..=high` among `count`; at least two.
fn span(low: f64, high: f64, count: usize) -> Option<(usize, usize)> {
    let last = count as f64 - 1.0;
    if !(high >= 0.0 && low <= last) {
        return None;
    }
    let first = (crate::math::max(low.floor(), 0.0) as usize).min(count - 2);
    let end = (crate::math::min(high.ceil(), last) as usize).max(first + 1);
    Some((first, end - first + 1))
}

fn bounding(points: [DVec2; 4]) -> [f64; 4] {
    let [a, b, c, d] = points;
    let low = a.min(b).min(c.min(d));
    let high = a.max(b).max(c.max(d));
    [low.x, low.y, high.x, high.y]
}

fn show(v: DVec2) -> String {
    format!("({}, {})", v.x, v.y)
}

/// A box, for a message.
pub(super) fn show_box([x0, y0, x1, y1]: [f64; 4]) -> String {
    format!("[{x0}, {y0}, {x1}, {y1}]")
}

/// A rectangle of posts, in the file's columns and rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct PostRange {
    pub(super) column: usize,
    pub(super) row: usize,
    pub(super) columns: usize,
    pub(super) rows: usize,
}

impl PostRange {
    /// How many posts it has.
    pub(super) fn count(&self) -> usize {
        self.columns.saturating_mul(self.rows)
    }

    /// What lies in it of the samples from `column` on in `row`, and the column of the first of these.
    pub(super) fn clip<'a>(&self, row: usize, column: usize, samples: &'a [f64]) -> (usize, &'a [f64]) {
        let from = self.column.max(column);
        let to = (self.column + self.columns).min(column + samples.len());
        let inside = row >= self.row && row < self.row + self.rows && from < to;
        if inside { (from, &samples[from - column..to - column]) } else { (from, &[]) }
    }
}

/// How a file's order of posts turns into west to east, south to north.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turn {
    pub(super) columns: bool,
    pub(super) rows: bool,
    pub(super) east: DVec2,
    pub(super) north: DVec2,
}
