//! Scattered points (`.xyz`): x, y and z a line.
//!
//! Separated by spaces, tabs, commas or semicolons; `#` begins a comment; the first line that is no comment may be a header.
//! A point that repeats another is dropped; two heights at one place are refused, naming both lines: which one is the
//! terrain's is not ours to guess. Every other line that is not three finite numbers is refused by line and column.

use super::content::{Dem, MAX_POINTS};
use super::extremes::Extremes;
use super::failure::unreadable;
use super::frame::show_box;
use super::text::{BYTE_ORDER_MARK, characters, number, number_help};
use crate::error::{Error, Position, Result};
use crate::scene::Surface;
use crate::space::World;
use std::io::{BufRead, BufReader, Read};

/// The longest line, in bytes.
const LONGEST: usize = 1 << 12;

/// A file of points.
pub(super) struct Xyz<R> {
    input: BufReader<R>,
    /// A height that means no data.
    nodata: Option<f64>,
}

/// A point and the line that gives it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sighting {
    pub(super) point: World,
    line: usize,
}

impl<R: Read> Xyz<R> {
    /// Takes a file that stands at its beginning.
    #[expect(clippy::unnecessary_wraps, reason = "opens like the other formats")]
    pub(super) fn open(input: R, nodata: Option<f64>) -> Result<Self> {
        Ok(Self { input: BufReader::with_capacity(1 << 16, input), nodata })
    }

    /// Reads the points inside the window (its edges included).
    pub(super) fn read(&mut self, window: Option<[f64; 4]>) -> Result<Dem> {
        let [x0, y0, x1, y1] =
            window.unwrap_or([f64::NEG_INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::INFINITY]);
        let mut seen = Vec::new();
        let mut extremes = Extremes::NONE;
        let mut all = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
        self.each(&mut |sighting| {
            let World { x, y, .. } = sighting.point;
            all = include(all, x, y);
            if x >= x0 && x <= x1 && y >= y0 && y <= y1 {
                if seen.len() == MAX_POINTS {
                    return Err(too_many());
                }
                extremes.take(sighting.point.z);
                seen.push(sighting);
            }
            Ok(())
        })?;
        let (points, repeated) = distinct(&seen)?;
        if points.len() < 3 {
            return Err(too_few(points.len(), all));
        }
        let mut notes = vec!["points say nothing of their CRS".to_owned()];
        notes.extend(extremes.note());
        if repeated > 0 {
            notes.push(format!("{repeated} points that repeat others are left out"));
        }
        Ok(Dem { surface: Surface::Points(points), crs_hint: None, states_unit: false, notes })
    }

    /// Hands on each point of the file that has a height.
    pub(super) fn each(&mut self, take: &mut dyn FnMut(Sighting) -> Result<()>) -> Result<()> {
        let mut bytes = Vec::new();
        let mut may_be_header = true;
        for line in 1.. {
            bytes.clear();
            let read = (&mut self.input)
                .take(LONGEST as u64 + 1)
                .read_until(b'\n', &mut bytes)
                .map_err(unreadable)?;
            if read == 0 {
                break;
            }
            if read > LONGEST {
                return Err(endless(line));
            }
            // As part of the first number it would make a header of the first point.
            let fields = Fields(bytes.strip_prefix(BYTE_ORDER_MARK).filter(|_| line == 1).unwrap_or(&bytes));
            let Some((first, _)) = fields.iter().next() else {
                continue;
            };
            let header = std::mem::take(&mut may_be_header) && number(first).is_none();
            if !header {
                let point = point(&fields, line)?;
                if Some(point.z) != self.nodata {
                    take(Sighting { point, line })?;
                }
            }
        }
        Ok(())
    }
}

/// The fields of a line up to its comment, with their byte offsets.
struct Fields<'a>(&'a [u8]);

impl<'a> Fields<'a> {
    fn iter(&self) -> impl Iterator<Item = (&'a [u8], usize)> {
        let line = self.0;
        let end = line.iter().position(|b| *b == b'#').unwrap_or(line.len());
        let line = &line[..end];
        let mut at = 0;
        std::iter::from_fn(move || {
            at += line[at..].iter().take_while(|b| is_separator(**b)).count();
            let field = &line[at..];
            let length = field.iter().take_while(|b| !is_separator(**b)).count();
            let found = (&field[..length], at);
            at += length;
            (length > 0).then_some(found)
        })
    }

    fn position(&self, line: usize, at: usize, length: usize) -> Position {
        Position {
            line,
            column: characters(&self.0[..at]) + 1,
            length: characters(&self.0[at..at + length]).max(1),
        }
    }
}

fn is_separator(b: u8) -> bool {
    b.is_ascii_whitespace() || b == b',' || b == b';' || b == 0x0b
}

/// The point that a line gives.
fn point(fields: &Fields<'_>, line: usize) -> Result<World> {
    let mut numbers = [0.0; 3];
    let mut count = 0;
    for (field, at) in fields.iter() {
        let place = fields.position(line, at, field.len());
        let text = String::from_utf8_lossy(field);
        let Some(slot) = numbers.get_mut(count) else {
            return Err(Error::new(format!("`{text}` comes after x, y and z"))
                .help("keep three columns, with a decimal point: cut -d' ' -f1-3")
                .at(place));
        };
        *slot = number(field).filter(|n| n.is_finite()).ok_or_else(|| {
            Error::new(format!("`{text}` is not a finite number")).help(number_help(&text)).at(place)
        })?;
        count += 1;
    }
    let [x, y, z] = numbers;
    if count == 3 {
        return Ok(World::new(x, y, z));
    }
    Err(Error::new(format!("a point has x, y and z, this one {count} numbers"))
        .help("write three numbers a line")
        .at(fields.position(line, 0, 0)))
}

/// The points without those that repeat others, in file order, and how many do.
fn distinct(seen: &[Sighting]) -> Result<(Vec<World>, usize)> {
    let mut order: Vec<u32> = (0..seen.len() as u32).collect();
    let place = |i: u32| {
        let World { x, y, .. } = seen[i as usize].point;
        // Adding 0 makes the two zeros one.
        (x + 0.0, y + 0.0)
    };
    order.sort_by(|a, b| {
        let ((ax, ay), (bx, by)) = (place(*a), place(*b));
        ax.total_cmp(&bx).then(ay.total_cmp(&by)).then(a.cmp(b))
    });
    let mut repeats = vec![false; seen.len()];
    for pair in order.windows(2) {
        if place(pair[0]) == place(pair[1]) {
            check_height(&seen[pair[0] as usize], &seen[pair[1] as usize])?;
            repeats[pair[1] as usize] = true;
        }
    }
    let points: Vec<_> =
        seen.iter().zip(&repeats).filter(|(_, repeat)| !**repeat).map(|(s, _)| s.point).collect();
    let repeated = seen.len() - points.len();
    Ok((points, repeated))
}

/// Refuses two heights at one place.
fn check_height(a: &Sighting, b: &Sighting) -> Result<()> {
    if a.point.z == b.point.z {
        return Ok(());
    }
    Err(Error::new(format!(
        "the point ({}, {}) is {} high in line {} and {} high in line {}",
        a.point.x, a.point.y, a.point.z, a.line, b.point.z, b.line
    ))
    .help("keep one height a place")
    .at(Position { line: b.line, column: 1, length: 1 }))
}

/// A box grown to contain a point.
pub(super) fn include([x0, y0, x1, y1]: [f64; 4], x: f64, y: f64) -> [f64; 4] {
    use crate::math::{max, min};
    [min(x, x0), min(y, y0), max(x, x1), max(y, y1)]
}

fn too_few(count: usize, all: [f64; 4]) -> Error {
    let what = if all[0] > all[2] {
        "the file holds no points".to_owned()
    } else {
        format!(
            "{count} points are too few for a terrain (3 at least); the file's points span {}",
            show_box(all)
        )
    };
    Error::new(what).help("check the file, and the window if one is given")
}

fn too_many() -> Error {
    Error::unsupported(format!("more than the {MAX_POINTS} points that can be read at once"))
        .help("read a part of it: window = [x0, y0, x1, y1]")
}

fn endless(line: usize) -> Error {
    Error::new(format!("a line of more than {LONGEST} bytes: this is no file of points"))
        .help("check that the file is what its extension says")
        .at(Position { line, column: 1, length: 1 })
}
