//! Where the records of a shapefile lie.
//!
//! Editing leaves gaps: a record that has grown is written again at the end, and its old bytes stay. Only the .shx tells them
//! from records. It is followed where it is consistent: each of its entries points at a record of the length that it states, none
//! overlaps another, and their number is the one that its own header or the .dbf states. Otherwise records are read one after the
//! other, and a note says so. The length in the header of the .shp is believed where nothing else speaks against it.

use crate::error::{Error, Result};
use crate::source::vector::bytes::{Cursor, Endian};

/// Of the .shp and of the .shx.
pub(super) const HEADER_BYTES: usize = 100;
/// Before each record: its number, from 1, and its length.
const RECORD_HEADER_BYTES: usize = 8;
/// What both files begin with.
const MAGIC: u32 = 9994;

/// The records of a shapefile, in the order of its features.
pub(super) struct Records {
    places: Vec<Place>,
    /// What the user should know.
    pub(super) notes: Vec<String>,
}

/// Where a record begins, with its header, and the bytes of its content.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    start: usize,
    content: usize,
}

impl Place {
    /// A feature without a shape has an entry of zeros in some .shx.
    const NOWHERE: Self = Self { start: 0, content: 0 };

    fn end(self) -> usize {
        self.start + RECORD_HEADER_BYTES + self.content
    }
}

impl Records {
    /// Finds the records; `rows` is how many the .dbf has, where that is known.
    pub(super) fn of(shp: &[u8], shx: Option<&[u8]>, rows: Option<usize>) -> Result<Self> {
        let stated = stated_length(shp)?;
        let walk = Walk::over(shp);
        let walked = walk.believed(stated, rows);
        let Some(index) = shx.and_then(Index::of) else {
            return walked.map(|records| records.with_note(walk.note_of_numbers()));
        };
        if let Ok(records) = &walked
            && records.places == index.places
        {
            return walked;
        }
        let other = walked.as_ref().map_or(0, |records| records.places.len());
        let is_counted = index.is_counted && rows != Some(other);
        if index.is_sound(shp) && (rows == Some(index.places.len()) || is_counted) {
            return Ok(index.followed(shp.len(), stated));
        }
        walked.map(|records| {
            let note = index.note_of_damage(&records.places);
            records.with_note(Some(note)).with_note(walk.note_of_numbers())
        })
    }

    fn with_note(mut self, note: Option<String>) -> Self {
        self.notes.extend(note);
        self
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.places.len()
    }

    /// The contents of the records, one after the other.
    pub(super) fn contents<'a>(&self, shp: &'a [u8]) -> impl Iterator<Item = &'a [u8]> {
        let content = move |place: &Place| match *place {
            Place::NOWHERE => NO_SHAPE,
            place => shp.get(place.start + RECORD_HEADER_BYTES..place.end()).unwrap_or_default(),
        };
        self.places.iter().map(content)
    }
}

/// The content of a record without a shape.
const NO_SHAPE: &[u8] = &[0; 4];

/// The length of the file as its header states it, in bytes.
fn stated_length(shp: &[u8]) -> Result<usize> {
    let header = shp.get(..HEADER_BYTES).and_then(|header| {
        let mut at_length = Cursor::new(header.get(24..)?);
        let words = at_length.u32(Endian::Big)? as usize;
        let version = at_length.u32(Endian::Little)?;
        Some((words.checked_mul(2)?, version))
    });
    match header {
        Some((length, 1000)) => Ok(length),
        Some(_) => Err(damaged("the header is not one of a shapefile")),
        None => Err(damaged("the file ends within its header")),
    }
}

/// What the header states and the file does not bear out.
fn note_of_length(stated: usize, file: usize) -> String {
    format!(
        "the header states {stated} bytes and the file has {file}: its records are whole, and all are read"
    )
}

/// The records one after the other, to the end of the file.
struct Walk {
    places: Vec<Place>,
    /// The length of the file.
    file: usize,
    /// Whether the file ends with a record's end.
    is_whole: bool,
    /// Bytes of zeros that are passed over.
    zeros: usize,
    /// The first record that does not have the number after the one before.
    out_of_sequence: Option<usize>,
}

impl Walk {
    fn over(shp: &[u8]) -> Self {
        let mut walk =
            Self { places: Vec::new(), file: shp.len(), is_whole: true, zeros: 0, out_of_sequence: None };
        let (mut at, mut expected) = (HEADER_BYTES, None);
        while at < shp.len() {
            let Some((number, content)) = record_header(shp, at) else {
                walk.is_whole = false;
                break;
            };
            if (number, content) == (0, 0) {
                let next = after_zeros(shp, at, expected.unwrap_or(1));
                walk.zeros += next - at;
                at = next;
                continue;
            }
            let place = Place { start: at, content };
            if place.end() > shp.len() {
                walk.is_whole = false;
                break;
            }
            if expected.is_some_and(|expected| number != expected) {
                walk.out_of_sequence.get_or_insert(walk.places.len());
            }
            expected = Some(number.wrapping_add(1));
            walk.places.push(place);
            at = place.end();
        }
        walk
    }

    /// The records that there are by the length which the header states, by what the file holds, and by the rows of the .dbf.
    fn believed(&self, stated: usize, rows: Option<usize>) -> Result<Records> {
        let all = |notes| Ok(Records { places: self.places.clone(), notes });
        let header_is_wrong = || vec![note_of_length(stated, self.file)];
        if stated > self.file {
            // Cut between two records, it would else look whole. Some writers state bytes, not words.
            let bears_out = rows == Some(self.places.len()) || stated / 2 == self.file;
            return match self.is_whole && bears_out && !self.places.is_empty() {
                true => all(header_is_wrong()),
                false => Err(self.cut_off(stated)),
            };
        }
        let notes = self.note_of_zeros();
        if stated == self.file {
            return if self.is_whole { all(notes) } else { Err(self.unfinished()) };
        }
        match self.count_up_to(stated) {
            Some(count) if !self.goes_on_after(count, rows) => {
                let extra = self.file - stated;
                let note = format!("{extra} bytes after the end that the header states are not read");
                Ok(Records { places: self.places[..count].to_vec(), notes: vec![note] })
            }
            _ if self.is_whole => all([header_is_wrong(), notes].concat()),
            _ => Err(self.unfinished()),
        }
    }

    /// Whether the records go on where the header says that they end, after so many of them.
    fn goes_on_after(&self, count: usize, rows: Option<usize>) -> bool {
        let is_numbered_on = self.out_of_sequence.is_none_or(|first| first != count);
        let is_told = rows != Some(count) || count == 0;
        self.is_whole && (rows == Some(self.places.len()) || (is_told && is_numbered_on))
    }

    /// How many records there are before this place, if one ends there.
    fn count_up_to(&self, end: usize) -> Option<usize> {
        if end == HEADER_BYTES {
            return Some(0);
        }
        self.places.binary_search_by_key(&end, |place| place.end()).ok().map(|last| last + 1)
    }

    fn cut_off(&self, stated: usize) -> Error {
        let missing = stated - self.file;
        match self.file {
            HEADER_BYTES => damaged("the file ends after its header"),
            _ => {
                damaged(&format!("the file ends here, {missing} bytes before the end that its header states"))
                    .in_feature(self.places.len())
            }
        }
    }

    fn unfinished(&self) -> Error {
        damaged("its record reaches past the end of the file").in_feature(self.places.len())
    }

    fn note_of_zeros(&self) -> Vec<String> {
        let zeros = self.zeros;
        let note = || format!("{zeros} bytes of zeros between the records of the .shp are passed over");
        if zeros > 0 { vec![note()] } else { Vec::new() }
    }

    fn note_of_numbers(&self) -> Option<String> {
        let first = self.out_of_sequence?;
        Some(format!(
            "from feature {first} on the records are not numbered one after the other: some may be left over from editing, \
             which only a whole .shx index would tell"
        ))
    }
}

/// A record's number and the bytes of its content.
fn record_header(shp: &[u8], at: usize) -> Option<(u32, usize)> {
    let mut cursor = Cursor::new(shp.get(at..)?);
    let number = cursor.u32(Endian::Big)?;
    Some((number, (cursor.u32(Endian::Big)? as usize).checked_mul(2)?))
}

/// The place after zeros where a record with this number may begin: a number has up to three zeros before it.
fn after_zeros(shp: &[u8], at: usize, number: u32) -> usize {
    let rest = &shp[at..];
    let Some(zeros) = rest.iter().position(|byte| *byte != 0) else {
        return shp.len();
    };
    let spare = number.leading_zeros() as usize / 8;
    at + zeros.saturating_sub(spare).max(1)
}

/// The .shx: where it says that each record begins, and how long it is.
struct Index {
    places: Vec<Place>,
    /// Whether its header states its length.
    is_counted: bool,
}

impl Index {
    fn of(shx: &[u8]) -> Option<Self> {
        let entries = shx.get(HEADER_BYTES..)?;
        let mut header = Cursor::new(shx);
        let is_magic = header.u32(Endian::Big) == Some(MAGIC);
        let length = header.take(20).and_then(|_| header.u32(Endian::Big)).map(|words| words as usize);
        let is_counted = is_magic && length.and_then(|words| words.checked_mul(2)) == Some(shx.len());
        let entry = |entry: &[u8]| {
            let mut cursor = Cursor::new(entry);
            let mut bytes = || cursor.u32(Endian::Big).and_then(|words| (words as usize).checked_mul(2));
            Some(Place { start: bytes()?, content: bytes()? })
        };
        let places = entries.chunks_exact(8).map(entry).collect::<Option<_>>()?;
        Some(Self { places, is_counted })
    }

    /// Whether each entry points at a record of its length, and none at another's bytes.
    fn is_sound(&self, shp: &[u8]) -> bool {
        let is_record = |place: &Place| {
            place.start >= HEADER_BYTES
                && record_header(shp, place.start).is_some_and(|(_, content)| content == place.content)
                && place.end() <= shp.len()
        };
        let mut somewhere: Vec<Place> =
            self.places.iter().copied().filter(|place| *place != Place::NOWHERE).collect();
        somewhere.sort_unstable();
        somewhere.iter().all(is_record) && somewhere.windows(2).all(|two| two[0].end() <= two[1].start)
    }

    /// Its records, and what lies between them.
    fn followed(self, file: usize, stated: usize) -> Records {
        let length = |place: &Place| if *place == Place::NOWHERE { 0 } else { place.end() - place.start };
        let gaps = file - HEADER_BYTES - self.places.iter().map(length).sum::<usize>();
        let mut notes = Vec::new();
        if gaps > 0 {
            notes.push(format!(
                "{gaps} bytes of the .shp belong to no record by its .shx index and are passed over"
            ));
        }
        if stated != file {
            notes.push(note_of_length(stated, file));
        }
        Records { places: self.places, notes }
    }

    /// How it differs from the records that are read in its stead.
    fn note_of_damage(&self, read: &[Place]) -> String {
        let shorter = if read.len() < self.places.len() { read.len() } else { self.places.len() };
        let first_wrong = read.iter().zip(&self.places).position(|(read, listed)| read != listed);
        format!(
            "the .shx index is damaged: it lists {} features, points elsewhere from feature {} on, and is not used; the \
             .shp itself holds {} whole ones",
            self.places.len(),
            first_wrong.unwrap_or(shorter),
            read.len()
        )
    }
}

/// The refusal of a damaged .shp.
pub(super) fn damaged(why: &str) -> Error {
    Error::new(format!("the shapefile is damaged: {why}"))
        .help("write it again from its source, or repair it with a GIS")
}
