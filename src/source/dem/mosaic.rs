//! Several grid files as one: their posts stand on one grid, and each part is put together from the files that it meets.
//!
//! A band of rows is held at a time, so that a mosaic is read in little memory beside what is made of it; a file is opened when a
//! band meets it. Where files overlap (tiles share the posts on their seams) heights are averaged, or the later file's win. Where no
//! file has data there are no posts. It refuses files of other grids, and files that do not say their place.

use super::content::MAX_POSTS;
use super::failure::too_many_posts;
use super::frame::{Frame, PostRange};
use super::grid::{GridFile, Header, RowSink};
use super::nodata::Nodata;
use super::virtual_band::{Agreement, Storage};
use crate::error::{Error, Result};
use std::path::{Path, PathBuf};

/// The most posts of a band of rows that are held.
const MOST_HELD: usize = 1 << 23;

/// The longest row that is held.
const LONGEST_ROW: usize = 1 << 26;

/// The most posts that are looked at: a few words can promise more than anyone waits for.
const MOST_POSTS: u64 = 1 << 36;

/// Of a large mosaic, the most posts for each that a file has.
const MOST_GAPS: usize = 64;

/// How many files may lie on one another, in the mean.
const MOST_ABOVE: usize = 64;

/// The most notes of the files that are handed on.
const MOST_NOTES: usize = 5;

/// Opens a file of a mosaic.
pub(super) type Opener = Box<dyn Fn(&Piece) -> Result<Box<dyn GridFile>>>;

/// A file of a mosaic.
#[derive(Debug, Clone)]
pub(super) struct Piece {
    pub(super) path: PathBuf,
    /// Its band of heights, from 1; `None`: the first.
    pub(super) band: Option<usize>,
    /// The posts that are taken from it, in its own columns and rows.
    pub(super) source: PostRange,
    /// The column and row of the mosaic where the first of them stands.
    pub(super) at: (usize, usize),
    /// Factor and offset from its samples to the mosaic's.
    pub(super) scaling: Option<(f64, f64)>,
    /// The samples that are not taken: what lies below shows.
    pub(super) nodata: Option<Nodata>,
    /// Whether what lies below shows where the file itself holds no data.
    pub(super) lets_through: bool,
}

/// Whose heights count where files overlap.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Overlap {
    /// The mean of all that have data.
    Mean,
    /// The last one's; where it lets through, the one's below it.
    Last,
}

/// Several grid files as one.
pub(super) struct Mosaic {
    header: Header,
    pieces: Vec<Piece>,
    overlap: Overlap,
    /// `None`: heights are taken as they are.
    virtual_raster: Option<(Storage, Agreement)>,
    open: Opener,
}

impl Mosaic {
    /// A mosaic whose header is known: later pieces lie on earlier ones.
    pub(super) fn layered(
        header: Header,
        pieces: Vec<Piece>,
        virtual_raster: (Storage, Agreement),
        open: Opener,
    ) -> Self {
        Self { header, pieces, overlap: Overlap::Last, virtual_raster: Some(virtual_raster), open }
    }

    /// Files that must stand on one grid, with seams averaged.
    pub(super) fn of_files(paths: &[PathBuf], open: Opener) -> Result<Self> {
        let mut headers = Vec::new();
        for path in paths {
            let piece = Piece {
                path: path.clone(),
                band: None,
                source: PostRange { column: 0, row: 0, columns: 0, rows: 0 },
                at: (0, 0),
                scaling: None,
                nodata: None,
                lets_through: true,
            };
            headers.push((open(&piece)?.header().clone(), piece));
        }
        let (header, pieces) = united(headers)?;
        Ok(Self { header, pieces, overlap: Overlap::Mean, virtual_raster: None, open })
    }

    /// Puts the rows of a part together, and hands them on.
    fn scan_band(&self, part: &PostRange, seams: &mut Seams, sink: &mut dyn RowSink) -> Result<()> {
        let mut band = Band::new(*part, self.overlap)?;
        for piece in &self.pieces {
            let Some((wanted, to)) = piece.meeting(part) else {
                continue;
            };
            let mut scan = |seams: &mut Seams| {
                let mut file = (self.open)(piece)?;
                let of_file = file.header().frame;
                piece.check_size(&of_file)?;
                let storage = self.virtual_raster.as_ref().map(|(storage, _)| *storage);
                if let Some((_, agreement)) = &self.virtual_raster {
                    agreement.check(file.header().unit.as_ref(), piece.own_scaling(file.header()))?;
                }
                file.check_promise(&wanted)?;
                let mut placing = Placing { band: &mut band, wanted, to, piece, storage, seams: &mut *seams };
                file.scan(&wanted, &mut placing)?;
                seams.remember(&file.header().notes);
                Ok(())
            };
            scan(seams).map_err(|error: Error| error.in_file(&piece.path))?;
        }
        for (row, heights) in (part.row..).zip(band.heights.chunks_exact(part.columns)) {
            sink.take(row, part.column, heights);
        }
        Ok(())
    }
}

impl GridFile for Mosaic {
    fn header(&self) -> &Header {
        &self.header
    }

    fn check_promise(&mut self, part: &PostRange) -> Result<()> {
        let met = self.pieces.iter().filter_map(|piece| piece.meeting(part));
        let covered = met.fold(0_usize, |sum, (wanted, _)| sum.saturating_add(wanted.count()));
        if covered == 0 {
            return Err(
                Error::new("none of the files has posts in the wanted part").help("choose another window")
            );
        }
        let is_mostly_gaps = part.count() > MAX_POSTS && part.count() / MOST_GAPS > covered;
        if part.columns > LONGEST_ROW || part.count() as u64 > MOST_POSTS || is_mostly_gaps {
            return Err(too_many_posts(part));
        }
        if covered / MOST_ABOVE > part.count() {
            return Err(Error::unsupported(format!(
                "its files lie on one another more than {MOST_ABOVE} times"
            ))
            .help("name those that are to be seen"));
        }
        Ok(())
    }

    fn scan(&mut self, part: &PostRange, sink: &mut dyn RowSink) -> Result<()> {
        let rows = (MOST_HELD / part.columns).clamp(1, part.rows);
        let mut seams = Seams::default();
        for first in (part.row..part.row + part.rows).step_by(rows) {
            let rows = rows.min(part.row + part.rows - first);
            self.scan_band(&PostRange { row: first, rows, ..*part }, &mut seams, sink)?;
        }
        self.header.notes.extend(seams.into_notes());
        Ok(())
    }
}

impl Piece {
    /// The part of the file that meets a part of the mosaic, and where in the mosaic its first post stands.
    fn meeting(&self, part: &PostRange) -> Option<(PostRange, (usize, usize))> {
        let span = |at: usize, count: usize, from: usize, wanted: usize| {
            let (low, high) = (at.max(from), (at + count).min(from + wanted));
            (low < high).then(|| (low, high - low))
        };
        let (column, columns) = span(self.at.0, self.source.columns, part.column, part.columns)?;
        let (row, rows) = span(self.at.1, self.source.rows, part.row, part.rows)?;
        let wanted = PostRange {
            column: self.source.column + (column - self.at.0),
            row: self.source.row + (row - self.at.1),
            columns,
            rows,
        };
        Some((wanted, (column, row)))
    }

    /// Factor and offset that the file states for its samples and that are still to be applied once they are taken.
    pub(super) fn own_scaling(&self, header: &Header) -> (f64, f64) {
        // A source that is scaled as it is taken is scaled by that alone.
        header.scaling.filter(|_| self.scaling.is_none()).unwrap_or((1.0, 0.0))
    }

    /// Refuses a file that does not have the posts that are to be taken from it.
    fn check_size(&self, frame: &Frame) -> Result<()> {
        let PostRange { column, row, columns, rows } = self.source;
        if column + columns <= frame.columns && row + rows <= frame.rows {
            return Ok(());
        }
        Err(Error::new(format!(
            "{columns} x {rows} posts from column {column} and row {row} on are wanted, but the file has {} x {}",
            frame.columns, frame.rows
        ))
        .help("the mosaic was made for another file: make it anew"))
    }
}

/// What is found where files meet.
#[derive(Default)]
struct Seams {
    shared: usize,
    differing: usize,
    greatest: f64,
    notes: Vec<String>,
}

impl Seams {
    fn remember(&mut self, notes: &[String]) {
        for note in notes {
            if !self.notes.contains(note) && self.notes.len() <= MOST_NOTES {
                self.notes.push(note.clone());
            }
        }
    }

    fn into_notes(mut self) -> Vec<String> {
        if self.notes.len() > MOST_NOTES {
            self.notes[MOST_NOTES] =
                "there is more to tell of the files: `drapery info` on each of them does".into();
        }
        if self.differing > 0 {
            self.notes.push(format!(
                "{} of the {} heights where files meet differ, by up to {} m: they are averaged",
                self.differing, self.shared, self.greatest
            ));
        }
        self.notes
    }
}

/// Rows of a mosaic that are being put together.
struct Band {
    part: PostRange,
    heights: Vec<f64>,
    /// How many files each height is the mean of; empty where the last one wins.
    counts: Vec<u8>,
}

impl Band {
    fn new(part: PostRange, overlap: Overlap) -> Result<Self> {
        let mut heights = Vec::new();
        heights.try_reserve_exact(part.count()).map_err(|_| too_many_posts(&part))?;
        heights.resize(part.count(), f64::NAN);
        let counts = if overlap == Overlap::Mean { vec![0; part.count()] } else { Vec::new() };
        Ok(Self { part, heights, counts })
    }

    /// Takes a height in; NaN, which is no post, only where the last file's wins.
    fn put(&mut self, at: usize, height: f64, seams: &mut Seams) {
        let held = self.heights[at];
        let Some(count) = self.counts.get_mut(at).filter(|_| !held.is_nan()) else {
            self.heights[at] = height;
            if let Some(count) = self.counts.get_mut(at) {
                *count = 1;
            }
            return;
        };
        *count = count.saturating_add(1);
        seams.shared += 1;
        if held != height {
            seams.differing += 1;
            seams.greatest = crate::math::max((held - height).abs(), seams.greatest);
            let share = 1.0 / f64::from(*count);
            // Of two it is the same whichever comes first.
            self.heights[at] = held * (1.0 - share) + height * share;
        }
    }
}

/// Puts what is read of a file into a band.
struct Placing<'a> {
    band: &'a mut Band,
    /// The part of the file.
    wanted: PostRange,
    /// Where its first post stands in the mosaic.
    to: (usize, usize),
    piece: &'a Piece,
    storage: Option<Storage>,
    seams: &'a mut Seams,
}

impl RowSink for Placing<'_> {
    fn take(&mut self, row: usize, column: usize, samples: &[f64]) {
        let (column, samples) = self.wanted.clip(row, column, samples);
        let part = self.band.part;
        let row = self.to.1 + (row - self.wanted.row.min(row)) - part.row;
        let (factor, offset) = self.piece.scaling.unwrap_or((1.0, 0.0));
        for (c, sample) in (self.to.0 + column - self.wanted.column..).zip(samples) {
            let shows_below = if sample.is_nan() {
                self.piece.lets_through
            } else {
                self.piece.nodata.is_some_and(|nodata| nodata.height(*sample).is_nan())
            };
            if shows_below {
                continue;
            }
            let height = if self.piece.scaling.is_some() { sample * factor + offset } else { *sample };
            let height = self.storage.map_or(height, |storage| storage.stored(height));
            self.band.put(row * part.columns + c - part.column, height, self.seams);
        }
    }
}

/// The header of files as one grid, and where each stands in it.
fn united(files: Vec<(Header, Piece)>) -> Result<(Header, Vec<Piece>)> {
    let Some(((first, _), rest)) = files.split_first().map(|((h, p), rest)| ((h, p), rest)) else {
        return Err(Error::new("no file is named"));
    };
    for (header, piece) in &files {
        if !header.is_placed {
            let error = Error::new("the file does not say its place, so it cannot be put beside others");
            return Err(error
                .in_file(&piece.path)
                .help("georeference it: a world file, or gdal_translate -a_ullr"));
        }
    }
    for (header, piece) in rest {
        if header.crs_hint != first.crs_hint {
            return Err(another(&piece.path, "CRS", &files[0].1.path)
                .help("warp them into one CRS and one file: gdalwarp -t_srs CRS FILES... OUT.tif"));
        }
    }
    // Counted from the file that begins first, so that the order of the files does not matter.
    let offsets = |from: &Frame| -> Result<Vec<(i64, i64)>> {
        let of = |(header, piece): &(Header, Piece)| {
            from.steps_to(&header.frame).ok_or_else(|| {
                another(&piece.path, "grid", &files[0].1.path)
                    .help("resample them into one file: gdalwarp -r bilinear -tr X Y FILES... OUT.tif")
            })
        };
        files.iter().map(of).collect()
    };
    let from_first = offsets(&first.frame)?;
    let order = |i: &usize| from_first[*i];
    let leader = (0..files.len()).min_by_key(order).unwrap_or(0);
    let frame = files[leader].0.frame;
    let offsets = offsets(&frame)?;
    let low = |of: fn(&(i64, i64)) -> i64| offsets.iter().map(of).min().unwrap_or(0);
    let (left, top) = (low(|o| o.0), low(|o| o.1));
    let mut pieces = Vec::new();
    let (mut columns, mut rows) = (0, 0);
    for ((header, mut piece), (c, r)) in files.iter().cloned().zip(&offsets) {
        piece.at = ((c - left) as usize, (r - top) as usize);
        piece.source = header.frame.whole();
        columns = columns.max(piece.at.0 + piece.source.columns);
        rows = rows.max(piece.at.1 + piece.source.rows);
        pieces.push(piece);
    }
    let corner = frame.at(left as f64, top as f64);
    let frame = Frame::new((columns, rows), corner, (frame.column(), frame.row()))?;
    let count = files.len();
    let stated = files.iter().all(|(header, _)| header.unit.is_some());
    let header = Header {
        format: "several files as one grid",
        layout: format!("{count} files"),
        frame,
        unit: first.unit.clone().filter(|_| stated),
        scaling: None,
        notes: vec![format!("{count} files as one grid of {columns} x {rows} posts")],
        ..first.clone()
    };
    Ok((header, pieces))
}

fn another(path: &Path, what: &str, first: &Path) -> Error {
    Error::new(format!("the file has another {what} than {}", first.display())).in_file(path)
}
