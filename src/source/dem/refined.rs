//! A grid file as the rest of the house sees it: heights in metres, masked posts without data, notes on what was done.

use super::extremes::Extremes;
use super::frame::PostRange;
use super::grid::{GridFile, Header, RowSink};
use super::mask::Mask;
use super::sidecar::Sidecar;
use crate::error::{Error, Result};

/// A grid file and all that is said of its samples.
pub(super) struct Refined {
    file: Box<dyn GridFile>,
    header: Header,
    masks: Vec<Box<dyn GridFile>>,
    converts: bool,
}

impl Refined {
    /// A file with what lies beside it, and with its masks: rasters of the same size, 0 where there is no post. One that does not
    /// convert hands on samples as they are stored, and says in its header alone what they count in.
    pub(super) fn new(
        file: Box<dyn GridFile>,
        beside: Sidecar,
        masks: Vec<Box<dyn GridFile>>,
        converts: bool,
    ) -> Result<Self> {
        let mut header = file.header().clone();
        let size = (header.frame.columns, header.frame.rows);
        for mask in &masks {
            let of_mask = (mask.header().frame.columns, mask.header().frame.rows);
            if of_mask != size {
                return Err(Error::new(format!(
                    "its mask has {} x {} samples, its heights have {} x {}",
                    of_mask.0, of_mask.1, size.0, size.1
                ))
                .help("remove the mask, or write the file anew: gdal_translate FILE OUT.tif"));
            }
        }
        if let Some(crs) = beside.crs {
            let other = header.crs_hint.as_ref().is_some_and(|own| *own != crs);
            if other {
                header.notes.push("its CRS is the one that the .aux.xml beside it states".into());
            }
            header.crs_hint = Some(crs);
        }
        header.unit = beside.unit.or(header.unit);
        header.scaling = beside.scaling.or(header.scaling).filter(|s| *s != (1.0, 0.0));
        if let Some((factor, offset)) = header.scaling.filter(|_| converts) {
            header.notes.push(format!("heights are samples x {factor} + {offset}, as the file declares"));
        }
        header.notes.extend(header.unit.as_ref().filter(|_| converts).and_then(|unit| unit.note()));
        if !masks.is_empty() {
            header.notes.push("posts that the file's mask or alpha band leaves out hold no data".into());
        }
        Ok(Self { file, header, masks, converts })
    }

    /// From samples to heights.
    fn conversion(&self) -> Conversion {
        if !self.converts {
            return Conversion::NONE;
        }
        let (factor, offset) = self.header.scaling.unwrap_or((1.0, 0.0));
        let metres = self.header.unit.as_ref().map_or(1.0, |unit| unit.metres());
        Conversion { factor, offset, metres }
    }

    /// Notes heights that the Earth does not have, and such as often stand for no data.
    fn note_extremes(&mut self, extremes: &Extremes) {
        let Some(range) = extremes.range().filter(|_| self.converts) else {
            return;
        };
        let conversion = self.conversion();
        let [a, b] = range.map(|sample| conversion.height(sample));
        let (low, high) = if a < b { (a, b) } else { (b, a) };
        if let Some(note) = extremes.note() {
            self.header.notes.push(note);
        } else if low < DEEPEST || high > HIGHEST {
            self.header.notes.push(format!(
                "heights run from {low} to {high}: if that is a nodata value, declare it (`terrain.nodata = VALUE`, or \
                 gdal_edit.py -a_nodata VALUE)"
            ));
        }
    }
}

/// Below the deepest sea floor, in metres.
const DEEPEST: f64 = -11_500.0;

/// Above the highest summit, in metres or feet.
const HIGHEST: f64 = 30_000.0;

impl GridFile for Refined {
    fn header(&self) -> &Header {
        &self.header
    }

    fn check_promise(&mut self, part: &PostRange) -> Result<()> {
        self.file.check_promise(part)
    }

    fn scan(&mut self, part: &PostRange, sink: &mut dyn RowSink) -> Result<()> {
        self.file.check_promise(part)?;
        let mask = Mask::read(&mut self.masks, part)?;
        let conversion = self.conversion();
        let mut refining =
            Refining { part: *part, mask, conversion, extremes: Extremes::NONE, heights: Vec::new(), sink };
        self.file.scan(part, &mut refining)?;
        let extremes = refining.extremes;
        // What the scan found out.
        let known = self.file.header().notes.clone();
        for note in known {
            if !self.header.notes.contains(&note) {
                self.header.notes.push(note);
            }
        }
        self.note_extremes(&extremes);
        Ok(())
    }
}

/// Height = (sample * factor + offset) * metres.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Conversion {
    factor: f64,
    offset: f64,
    metres: f64,
}

impl Conversion {
    const NONE: Self = Self { factor: 1.0, offset: 0.0, metres: 1.0 };

    fn height(self, sample: f64) -> f64 {
        (sample * self.factor + self.offset) * self.metres
    }
}

/// Refines samples on their way to another sink, and hands on those of the part alone.
struct Refining<'a> {
    part: PostRange,
    mask: Option<Mask>,
    conversion: Conversion,
    extremes: Extremes,
    heights: Vec<f64>,
    sink: &'a mut dyn RowSink,
}

impl RowSink for Refining<'_> {
    fn take(&mut self, row: usize, column: usize, samples: &[f64]) {
        let (column, samples) = self.part.clip(row, column, samples);
        if samples.is_empty() {
            return;
        }
        self.heights.clear();
        self.heights.extend_from_slice(samples);
        if let Some(mask) = &self.mask {
            mask.apply(row, column, &mut self.heights);
        }
        self.heights.iter().for_each(|h| self.extremes.take(*h));
        if self.conversion != Conversion::NONE {
            self.heights.iter_mut().for_each(|h| *h = self.conversion.height(*h));
        }
        self.sink.take(row, column, &self.heights);
    }
}
