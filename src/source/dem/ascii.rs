//! Esri ASCII grids (`.asc`): a few keys, then all heights from the north-west.
//!
//! Keys in any order and letter case: `ncols`, `nrows`; `xllcorner` or `xllcenter`, `yllcorner` or `yllcenter`; `cellsize`, or
//! `dx` and `dy`; `NODATA_value`, which is -9999 where it is left out (Esri's rule), and may be a word (`*`, `NA`) that then stands
//! among the heights, too. A `.prj` file beside it gives the CRS.
//! It refuses words that are no numbers, and too few or too many of them, each by line and column.

use super::failure::unreadable;
use super::frame::{Frame, PostRange};
use super::geo_keys::CrsHint;
use super::grid::{GridFile, Header, RowSink};
use super::nodata::{Nodata, Precision};
use super::site::Site;
use super::text::{Word, Words, number_help};
use super::vertical::VerticalUnit;
use crate::error::{Error, Position, Result};
use glam::DVec2;
use std::collections::BTreeMap;
use std::io::{BufReader, Read, Seek, SeekFrom};

/// An Esri ASCII grid.
pub(super) struct AsciiGrid<R> {
    words: Words<BufReader<R>>,
    /// The first height, which ended the header.
    first: Option<(f64, Position)>,
    length: u64,
    header: Header,
    nodata: Nodata,
    /// The word that stands where there is no data.
    no_height: Option<String>,
}

impl<R: Read + Seek> AsciiGrid<R> {
    /// Reads the header, and the `.prj` file beside it.
    pub(super) fn open(mut input: R, site: Option<&Site>, more_nodata: [Option<f64>; 2]) -> Result<Self> {
        let length = input.seek(SeekFrom::End(0)).map_err(unreadable)?;
        input.rewind().map_err(unreadable)?;
        let mut words = Words::new(BufReader::with_capacity(1 << 16, input));
        let (keys, first) = Keys::read(&mut words)?;
        let prj = site.map(prj_beside).transpose()?.flatten();
        let declared = keys.get("nodata_value").unwrap_or(-9999.0);
        let no_height = keys.no_height.clone();
        let header = Header {
            format: "Esri ASCII grid",
            sample: "text".into(),
            compression: "none".into(),
            layout: "rows".into(),
            nodata: Some(no_height.clone().unwrap_or_else(|| declared.to_string())),
            frame: keys.frame()?,
            is_placed: true,
            unit: prj.as_deref().and_then(unit_of_prj),
            crs_hint: prj.as_deref().map(crs_of_prj),
            scaling: None,
            notes: Vec::new(),
        };
        let [beside, user] = more_nodata;
        Ok(Self {
            words,
            first: Some(first),
            length,
            header,
            nodata: Nodata::new([Some(declared), beside, user], Precision::Double),
            no_height,
        })
    }

    /// The next height, where `read` of them have been read.
    fn next_height(&mut self, read: usize) -> Result<f64> {
        if let Some((height, _)) = self.first.take() {
            return Ok(self.nodata.height(height));
        }
        let Some(word) = self.words.next()? else {
            let Frame { columns, rows, .. } = self.header.frame;
            return Err(Error::new(format!(
                "the file ends after {read} of the {} heights that {columns} x {rows} posts need",
                columns * rows
            ))
            .help("it may be half a download: fetch it again, or correct ncols and nrows")
            .at(self.words.end()));
        };
        Ok(self.nodata.height(height_of(&word, self.no_height.as_deref())?))
    }

    fn refuse_more(&mut self) -> Result<()> {
        let Frame { columns, rows, .. } = self.header.frame;
        match self.words.next()? {
            None => Ok(()),
            Some(word) => Err(Error::new(format!(
                "`{}` comes after the {} heights that {columns} x {rows} posts need",
                word.text(),
                columns * rows
            ))
            .help("correct ncols and nrows, or cut what follows")
            .at(word.position())),
        }
    }
}

impl<R: Read + Seek> GridFile for AsciiGrid<R> {
    fn header(&self) -> &Header {
        &self.header
    }

    fn check_promise(&mut self, _part: &PostRange) -> Result<()> {
        let Frame { columns, rows, .. } = self.header.frame;
        let heights = columns as u64 * rows as u64;
        // A height is a digit and a space; the last one may lack the space.
        if heights > self.length.div_ceil(2) {
            return Err(Error::new(format!(
                "{columns} x {rows} posts need {heights} heights, more than the file's {} bytes can hold",
                self.length
            ))
            .help("it may be half a download: fetch it again, or correct ncols and nrows"));
        }
        Ok(())
    }

    fn scan(&mut self, _part: &PostRange, sink: &mut dyn RowSink) -> Result<()> {
        self.check_promise(&self.header.frame.whole())?;
        let Frame { columns, rows, .. } = self.header.frame;
        let mut heights = vec![0.0; columns];
        for row in 0..rows {
            for (c, height) in heights.iter_mut().enumerate() {
                *height = self.next_height(row * columns + c)?;
            }
            sink.take(row, 0, &heights);
        }
        self.refuse_more()
    }
}

/// The header's keys.
struct Keys {
    /// Where they stand and what they say; NaN where that is a word.
    numbers: BTreeMap<&'static str, (f64, Position)>,
    /// The word that stands for no data, where it is no number.
    no_height: Option<String>,
}

const KEYS: [&str; 10] = [
    "ncols",
    "nrows",
    "xllcorner",
    "xllcenter",
    "yllcorner",
    "yllcenter",
    "cellsize",
    "dx",
    "dy",
    "nodata_value",
];

impl Keys {
    /// Reads keys up to the first height, which it returns, too.
    fn read<R: Read>(words: &mut Words<BufReader<R>>) -> Result<(Self, (f64, Position))> {
        let mut keys = Self { numbers: BTreeMap::new(), no_height: None };
        loop {
            let Some(word) = words.next()? else {
                return Err(Error::new("the file ends before the first height")
                    .help("it may be half a download: fetch it again")
                    .at(words.end()));
            };
            let at = word.position();
            if word.number().is_some() || stands_for(&word, keys.no_height.as_deref()) {
                let height = height_of(&word, keys.no_height.as_deref())?;
                return Ok((keys, (height, at)));
            }
            let name = known_key(&word)?;
            let value = match key_value(words, name)? {
                Value::Number(value) => value,
                Value::NoHeight(word) => {
                    keys.no_height = Some(word);
                    f64::NAN
                }
            };
            if keys.numbers.insert(name, (value, at)).is_some() {
                return Err(Error::new(format!("`{name}` is given twice")).at(at));
            }
        }
    }

    fn get(&self, name: &str) -> Option<f64> {
        self.numbers.get(name).map(|(value, _)| *value)
    }

    fn need(&self, names: &[&str]) -> Result<f64> {
        names.iter().find_map(|n| self.get(n)).ok_or_else(|| {
            Error::new(format!("the header lacks `{}`", names.join("` or `")))
                .help("an Esri ASCII grid begins with ncols, nrows, xllcorner, yllcorner, cellsize")
        })
    }

    fn count(&self, name: &str) -> Result<usize> {
        let value = self.need(&[name])?;
        if value >= 1.0 && value <= f64::from(u32::MAX) && value.fract() == 0.0 {
            return Ok(value as usize);
        }
        let error = Error::new(format!("`{name} {value}` is not a count of posts"));
        Err(match self.numbers.get(name) {
            Some((_, at)) => error.at(*at),
            None => error,
        })
    }

    /// Where the posts stand: at the cells' centres.
    fn frame(&self) -> Result<Frame> {
        let size = (self.count("ncols")?, self.count("nrows")?);
        let dx = self.need(&["dx", "cellsize"])?;
        let dy = self.need(&["dy", "cellsize"])?;
        let x = self.lower_left("x", dx)?;
        let y = self.lower_left("y", dy)?;
        if !(dx > 0.0 && dy > 0.0) {
            return Err(Error::new(format!("the cell size {dx} x {dy} is not above 0"))
                .help("correct cellsize (or dx and dy) in the header"));
        }
        let first = DVec2::new(x, y + dy * (size.1 as f64 - 1.0));
        Frame::new(size, first, (DVec2::new(dx, 0.0), DVec2::new(0.0, -dy)))
    }

    /// The centre of the lower left cell along an axis.
    fn lower_left(&self, axis: &str, step: f64) -> Result<f64> {
        let (corner, center) = (format!("{axis}llcorner"), format!("{axis}llcenter"));
        match self.get(&center) {
            Some(v) => Ok(v),
            None => Ok(self.need(&[&corner, &center])? + step * 0.5),
        }
    }
}

/// The key that a word names.
fn known_key(word: &Word<'_>) -> Result<&'static str> {
    let mut name = word.text().to_ascii_lowercase();
    if name == "nodata" {
        name = "nodata_value".into();
    }
    if let Some(known) = KEYS.into_iter().find(|k| *k == name) {
        return Ok(known);
    }
    let nearest = KEYS
        .into_iter()
        .filter(|k| strsim::damerau_levenshtein(k, &name) <= 2)
        .min_by_key(|k| strsim::damerau_levenshtein(k, &name));
    let error = Error::new(format!("`{}` is no key of an Esri ASCII grid", word.text())).at(word.position());
    Err(match nearest {
        Some(key) => error.help(format!("did you mean `{key}`?")),
        None => error.help("known keys: ncols nrows xllcorner yllcorner cellsize NODATA_value"),
    })
}

/// What a key says.
enum Value {
    Number(f64),
    /// A word for no data.
    NoHeight(String),
}

/// What stands after a key.
fn key_value<R: Read>(words: &mut Words<BufReader<R>>, name: &str) -> Result<Value> {
    let Some(word) = words.next()? else {
        return Err(Error::new(format!("the file ends after `{name}`")).at(words.end()));
    };
    let text = word.text();
    // What has digits is a number misspelled, but for C's names of NaN (`1.#QNAN`).
    let is_a_word = || text.contains('#') || !text.contains(|c: char| c.is_ascii_digit());
    match word.number() {
        Some(number) => Ok(Value::Number(number)),
        None if name == "nodata_value" && is_a_word() && known_key(&word).is_err() => {
            Ok(Value::NoHeight(text))
        }
        None => Err(Error::new(format!("`{name}` is followed by `{text}`, which is no number"))
            .help(number_help(&text))
            .at(word.position())),
    }
}

/// Whether a word is the one for no data, in any letter case.
fn stands_for(word: &Word<'_>, no_height: Option<&str>) -> bool {
    no_height.is_some_and(|wanted| word.text().eq_ignore_ascii_case(wanted))
}

/// A height; NaN is no data.
fn height_of(word: &Word<'_>, no_height: Option<&str>) -> Result<f64> {
    match word.number() {
        None if stands_for(word, no_height) => Ok(f64::NAN),
        Some(height) if !height.is_infinite() => Ok(height),
        _ => Err(Error::new(format!("`{}` is not a height", word.text()))
            .help(number_help(&word.text()))
            .at(word.position())),
    }
}

/// The text of the `.prj` file beside a grid.
fn prj_beside(site: &Site) -> Result<Option<String>> {
    const LONGEST: u64 = 1 << 16;
    let paths = ["prj", "PRJ"].map(|e| site.path().with_extension(e));
    let Some(file) = site.beside(paths)? else {
        return Ok(None);
    };
    let text = file.text(LONGEST).map_err(|error| error.in_file(file.path()))?;
    Ok(Some(text.trim().to_owned()))
}

fn crs_of_prj(text: &str) -> CrsHint {
    let is_wkt = ["PROJC", "GEOGC", "GEODC", "COMPD", "COMPOUNDCRS", "BOUNDCRS"]
        .iter()
        .any(|k| text.to_ascii_uppercase().starts_with(k));
    if is_wkt {
        CrsHint::Wkt(text.to_owned())
    } else {
        let first = text.lines().next().unwrap_or_default().to_owned();
        CrsHint::Unknown(format!("{}: {first}", "the .prj file beside it"))
    }
}

/// The unit of heights: of the vertical CRS, or of the line `Zunits` that older programs of Esri write.
fn unit_of_prj(text: &str) -> Option<VerticalUnit> {
    let zunits = text.lines().find_map(|line| {
        let (key, word) = line.trim().split_once(char::is_whitespace)?;
        key.eq_ignore_ascii_case("zunits").then(|| word.trim())
    });
    match zunits {
        Some(word) if word.eq_ignore_ascii_case("no") => None,
        Some(word) => VerticalUnit::of_word(word),
        None => VerticalUnit::of_wkt(text),
    }
}
