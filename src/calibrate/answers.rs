//! What the pictures of triangles say: edges, samples, depth, what is interpolated.

use super::drawing::told;
use super::pictures::{
    ALONG_ROWS, CELL, DEPTH_BITS, EDGE_PLACES, INTERPOLATED_PLACES, PARTS, SAMPLES_SIDE, SIDE, SIXTEENTHS,
    TIES, WIDE_CELL, corner,
};
use super::sheet::Sheet;
use crate::canvas::SamplePattern;
use crate::error::Result;

/// What edges say.
#[derive(Debug)]
pub(super) struct Edges {
    /// Sub-pixel bits, 0: none were seen; `None`: the picture cannot tell.
    pub(super) bits: Option<u32>,
    /// How that was seen.
    pub(super) seen: String,
    /// Who owns what lies on an edge.
    pub(super) owners: String,
}

/// Reads the picture of edges.
///
/// # Errors
/// When it contradicts itself.
pub(super) fn edges(sheet: &Sheet) -> Result<Edges> {
    let [x, y] = corner(TIES, SIDE, CELL);
    let is_white = |dx: usize, dy: usize| sheet.is_white([x + dx, y + dy]);
    if !is_white(1, 1)? {
        return Err(sheet.contradiction("the middle of the last cell is not covered"));
    }
    let [left, right, top, bottom] = [is_white(0, 1)?, is_white(2, 1)?, is_white(1, 0)?, is_white(1, 2)?];
    if left == right || top == bottom {
        return Err(
            sheet.contradiction("an edge through a pixel's centre gives it to both sides, or to none")
        );
    }
    let rule = (if top { "top" } else { "bottom" }, if left { "left" } else { "right" });
    let owners = format!(
        "edges: what lies on an edge belongs to the {}-{} one; imitated is top-left.",
        rule.0, rule.1
    );
    let columns = if left { Some(reach(sheet, 0, [2, 1])?) } else { None };
    let rows = if top { Some(reach(sheet, ALONG_ROWS, [1, 2])?) } else { None };
    let bits = [columns, rows].map(|reach| reach.map(bits_of));
    if let [Some(of_columns), Some(of_rows)] = bits
        && of_columns != of_rows
    {
        return Err(sheet.contradiction(&format!(
            "columns are snapped as by {of_columns} sub-pixel bits, rows as by {of_rows}"
        )));
    }
    let [of_columns, of_rows] = bits;
    let seen = match (of_columns.or(of_rows), columns.or(rows)) {
        (Some(0), _) => "edges: no snapping was seen.".to_owned(),
        (Some(bits), Some(reach)) => format!(
            "edges: snapped to 2^-{bits} pixels: an edge comes back from {reach} of {PARTS} parts of a pixel, and from no more."
        ),
        _ => "edges: how they are snapped cannot be seen where neither left nor upper edges own what lies on them.".to_owned(),
    };
    Ok(Edges { bits: of_columns.or(of_rows), seen, owners })
}

/// The last of the places from which snapping takes an edge back to the pixel's centre; `beside`: a pixel that is covered in any case.
fn reach(sheet: &Sheet, first: usize, beside: [usize; 2]) -> Result<usize> {
    let mut covered = Vec::new();
    for place in 0..EDGE_PLACES {
        let [x, y] = corner(first + place, SIDE, CELL);
        if !sheet.is_white([x + beside[0], y + beside[1]])? {
            return Err(sheet.contradiction(&format!("nothing is drawn in the cell at {x},{y}")));
        }
        covered.push(sheet.is_white([x + 1, y + 1])?);
    }
    let count = covered.iter().take_while(|is_covered| **is_covered).count();
    if count == 0 || covered[count..].contains(&true) {
        return Err(sheet.contradiction("an edge covers a pixel's centre again, further away from it"));
    }
    Ok(count - 1)
}

/// Sub-pixel bits by how far an edge comes back: half a step, or a part less where halves go the other way.
fn bits_of(reach: usize) -> u32 {
    // Half of 2^-b is 2^(10 - b) parts.
    (1..=10).rev().find(|bits| reach <= 1 << (10 - bits)).filter(|_| reach > 0).unwrap_or(0)
}

/// Reads a picture of samples: where they lie.
///
/// # Errors
/// When it contradicts itself.
pub(super) fn samples(sheet: &Sheet, count: u32) -> Result<String> {
    let mut within = Vec::new();
    for cell in 0..SIXTEENTHS * SIXTEENTHS {
        let [x, y] = corner(cell, SAMPLES_SIDE, CELL);
        let [white, ..] = sheet.at([x + 1, y + 1]);
        let samples = white * f64::from(count);
        if (samples - samples.round()).abs() > 0.05 {
            return Err(sheet.contradiction(&format!(
                "pixel {},{} is no mean of {count} samples",
                x + 1,
                y + 1
            )));
        }
        within.push(samples.round() as i64);
    }
    let of = |column: usize, row: usize| match (column.checked_sub(1), row.checked_sub(1)) {
        (Some(column), Some(row)) => within[row * SIXTEENTHS + column],
        _ => 0,
    };
    let mut places: Vec<[i8; 2]> = Vec::new();
    for row in 1..=SIXTEENTHS {
        for column in 1..=SIXTEENTHS {
            let here = of(column, row) - of(column - 1, row) - of(column, row - 1) + of(column - 1, row - 1);
            if here < 0 {
                return Err(sheet.contradiction("a larger rectangle covers fewer samples"));
            }
            if here > 1 {
                return Err(sheet.contradiction(&format!(
                    "{here} samples are at one place, so there are fewer than {count}"
                )));
            }
            let place = [column, row].map(|v| v as i8 - 9);
            places.extend((here == 1).then_some(place));
        }
    }
    if places.len() != count as usize {
        return Err(sheet.contradiction(&format!("{} samples of {count} are in the pixel", places.len())));
    }
    let mut usual = match SamplePattern::of(count) {
        Some(SamplePattern::Multisample(places)) => places.to_vec(),
        _ => vec![[0, 0]],
    };
    usual.sort_unstable_by_key(|[x, y]| [*y, *x]);
    let verdict =
        if places == usual { "where Direct3D and Vulkan put them" } else { "elsewhere than imitated" };
    Ok(format!("samples-{count}: {verdict}: {places:?} sixteenths of a pixel from its centre."))
}

/// Reads a picture of depths: the format, and how that was seen.
///
/// # Errors
/// When it contradicts itself, or no format that is imitated is so fine.
pub(super) fn depth(sheet: &Sheet, is_reversed: bool) -> Result<(&'static str, String)> {
    let seen: Vec<bool> = (0..DEPTH_BITS.count())
        .map(|cell| {
            let [x, y] = corner(cell, SAMPLES_SIDE, CELL);
            let [_, green, blue] = sheet.at([x + 1, y + 1]);
            match (green > 0.5, blue > 0.5) {
                (true, false) => Ok(true),
                (false, true) => Ok(false),
                _ => {
                    Err(sheet.contradiction(&format!("pixel {},{} is neither blue nor green", x + 1, y + 1)))
                }
            }
        })
        .collect::<Result<_>>()?;
    let count = seen.iter().take_while(|is_seen| **is_seen).count();
    if count == 0 || seen[count..].contains(&true) {
        return Err(sheet.contradiction("what is nearer by more is hidden by what is nearer by less"));
    }
    let bits = DEPTH_BITS.start() + count as u32 - 1;
    let (format, rounding) = match (bits, is_reversed) {
        (27, false) => ("f32", ""),
        (27, true) => ("f32-reversed", ""),
        (25, false) => ("unorm24", ", rounded to nearest"),
        (24, false) => ("unorm24", ", rounded down (imitated is to nearest)"),
        (17, false) => ("unorm16", ", rounded to nearest"),
        (16, false) => ("unorm16", ", rounded down (imitated is to nearest)"),
        _ => {
            return Err(sheet.contradiction(&format!(
                "depths around 3/32 are told apart down to 2^-{bits}, as by no format that is imitated this way round"
            )));
        }
    };
    Ok((format, format!("depth: depths around 3/32 are told apart down to 2^-{bits}{rounding}.")))
}

/// From which corners something is interpolated.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Corners {
    /// As they are.
    Unsnapped,
    /// Moved to multiples of 2^-bits.
    Snapped(u32),
}

/// How far a place that is read may lie from where it should, in parts of a pixel: the picture tells quarters of them.
const DOUBT: f64 = 0.75;

/// Reads the picture of what is interpolated.
///
/// # Errors
/// When no corners explain it.
pub(super) fn corners(sheet: &Sheet) -> Result<Corners> {
    let moved = |place: usize| {
        let [x, y] = corner(place, SIDE, WIDE_CELL);
        // A pixel's centre two and a half pixels from where the left side would be if it were not moved; half a unit over four pixels.
        (2.5 - (told(sheet.at([x + 3, y + 3])) - 0.25) * 8.0) * PARTS
    };
    let places: Vec<(f64, f64)> =
        (0..INTERPOLATED_PLACES).map(|place| (place as f64, moved(place))).collect();
    if places.iter().all(|(place, moved)| (place - moved).abs() <= DOUBT) {
        return Ok(Corners::Unsnapped);
    }
    let fits = |bits: &u32| {
        let step = PARTS / f64::from(1u32 << bits);
        places.iter().all(|(place, moved)| {
            let is_multiple = (moved / step - (moved / step).round()).abs() * step <= DOUBT;
            is_multiple && (place - moved).abs() <= step / 2.0 + DOUBT
        })
    };
    // The coarsest steps first: multiples of these are multiples of finer ones, too.
    (3..=9).find(fits).map(Corners::Snapped).ok_or_else(|| {
        sheet.contradiction(
            "what is interpolated is explained neither by corners as they are nor by snapped ones",
        )
    })
}
