//! What a terrain file holds, for `drapery info`: read block by block, without holding it.

use super::extremes::Extremes;
use super::grid::{GridFile, RowSink};
use super::open::{self, DemFile};
use super::xyz::{self, Xyz};
use super::{CrsHint, DemOptions, PngEncoding};
use crate::error::{Error, Result};
use crate::math::{max, min};
use std::io::Read;
use std::path::Path;

/// What a terrain file holds.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct DemSummary {
    /// The file format, like `GeoTIFF`.
    pub format: &'static str,
    /// Columns and rows of posts; `None` for scattered points.
    pub size: Option<(usize, usize)>,
    /// How many posts or points there are.
    pub count: usize,
    /// The kind of number stored, like `int16`.
    pub sample: String,
    /// How it is packed, like `deflate`.
    pub compression: String,
    /// How it is laid out, like `tiles of 256 x 256`.
    pub layout: String,
    /// The box around all posts, x0, y0, x1, y1: what a terrain made of them covers.
    pub bounds: [f64; 4],
    /// The box around all cells, half a cell larger on each side: what GIS programs show.
    pub edges: [f64; 4],
    /// The distances between columns and between rows; `None` for scattered points.
    pub cell: Option<[f64; 2]>,
    /// The value that means no data, as the file writes it.
    pub nodata: Option<String>,
    /// How many posts hold no data.
    pub nodata_count: usize,
    /// The least and the greatest height; `None` where no post holds data.
    pub heights: Option<[f64; 2]>,
    /// What the file says of its CRS.
    pub crs_hint: Option<CrsHint>,
    /// What the user should know.
    pub notes: Vec<String>,
}

/// Reads through a terrain file and says what it holds, in little memory. (A PNG needs its `encoding`.)
///
/// # Errors
/// As [`read`](super::read), but any number of posts is fine.
pub fn describe(path: &Path, options: &DemOptions) -> Result<DemSummary> {
    let describe = || match open::open(path, options)? {
        DemFile::Grid(mut file) => describe_grid(&mut *file),
        DemFile::Points(mut file) => describe_points(&mut file),
    };
    describe().map_err(|error| error.in_file(path))
}

/// As [`describe`], but for a PNG without an encoding it tries both, and tells which gives heights that the Earth has.
///
/// # Errors
/// As [`describe`]; and for a PNG that makes sense in neither encoding or in both.
pub fn describe_guessing(path: &Path, options: &DemOptions) -> Result<(DemSummary, Option<PngEncoding>)> {
    let is_png = options.encoding.is_none() && open::is_png(path);
    if !is_png {
        return describe(path, options).map(|summary| (summary, options.encoding));
    }
    let mut plausible = Vec::new();
    for encoding in [PngEncoding::Terrarium, PngEncoding::Mapbox] {
        let encoded = DemOptions { encoding: Some(encoding), ..*options };
        let summary = describe(path, &encoded)?;
        if summary.heights.is_some_and(|[low, high]| low >= -11_500.0 && high <= 9_000.0) {
            plausible.push((summary, Some(encoding)));
        }
    }
    match plausible.pop() {
        Some(found) if plausible.is_empty() => Ok(found),
        _ => Err(Error::new("its colours do not tell how they encode heights")
            .help("say it: encoding = \"terrarium\" or encoding = \"mapbox\"")
            .in_file(path)),
    }
}

fn describe_grid(file: &mut dyn GridFile) -> Result<DemSummary> {
    let frame = file.header().frame;
    let mut tally = Tally::new(frame.columns);
    file.scan(&frame.whole(), &mut tally)?;
    let header = file.header().clone();
    Ok(DemSummary {
        format: header.format,
        size: Some((frame.columns, frame.rows)),
        count: frame.columns * frame.rows,
        sample: header.sample,
        compression: header.compression,
        layout: header.layout,
        bounds: frame.bounds(),
        edges: frame.edges(),
        cell: Some([frame.column().length(), frame.row().length()]),
        nodata: header.nodata,
        nodata_count: tally.nodata,
        heights: tally.heights(),
        crs_hint: header.crs_hint,
        notes: header.notes,
    })
}

fn describe_points<R: Read>(file: &mut Xyz<R>) -> Result<DemSummary> {
    let mut tally = Tally::new(1);
    let mut extremes = Extremes::NONE;
    let mut bounds = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    let mut count = 0;
    file.each(&mut |sighting| {
        bounds = xyz::include(bounds, sighting.point.x, sighting.point.y);
        tally.take(0, 0, &[sighting.point.z]);
        extremes.take(sighting.point.z);
        count += 1;
        Ok(())
    })?;
    Ok(DemSummary {
        format: "points",
        size: None,
        count,
        sample: "text".into(),
        compression: "none".into(),
        layout: "lines".into(),
        bounds,
        edges: bounds,
        cell: None,
        nodata: None,
        nodata_count: 0,
        heights: tally.heights(),
        crs_hint: None,
        notes: extremes.note().into_iter().collect(),
    })
}

/// Counts heights without keeping them.
struct Tally {
    columns: usize,
    nodata: usize,
    low: f64,
    high: f64,
}

impl Tally {
    fn new(columns: usize) -> Self {
        Self { columns, nodata: 0, low: f64::INFINITY, high: f64::NEG_INFINITY }
    }

    fn heights(&self) -> Option<[f64; 2]> {
        (self.low <= self.high).then_some([self.low, self.high])
    }
}

impl RowSink for Tally {
    fn take(&mut self, _row: usize, column: usize, heights: &[f64]) {
        let inside = heights.len().min(self.columns - column);
        for &height in &heights[..inside] {
            if height.is_finite() {
                self.low = min(height, self.low);
                self.high = max(height, self.high);
            } else {
                self.nodata += 1;
            }
        }
    }
}
