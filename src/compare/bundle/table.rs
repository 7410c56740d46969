//! Tables of a bundle -> rows that can be relied on: sorted, within the picture, the right way up.

use crate::compare::allowed::{Choice, Extremes, FeatureRun};
use crate::compare::read::Array;
use crate::error::{Error, Result};

/// A row: pixel, four channels, four channels.
type Row = [u32; 9];
/// The same, read: a pixel and two colours.
type Colors = (u32, [u16; 4], [u16; 4]);

/// The pixels of a picture of a size.
#[derive(Debug, Clone, Copy)]
pub(super) struct Size {
    pub width: usize,
    pub height: usize,
}

impl Size {
    fn holds(self, pixel: u32) -> bool {
        (pixel as usize) < self.width * self.height
    }
}

pub(super) fn choices(bytes: &[u8], size: Size) -> Result<Vec<Choice>> {
    let choices = rows(bytes, size)?.into_iter();
    let choices: Vec<Choice> = choices.map(|(pixel, lo, hi)| Choice { pixel, lo, hi }).collect();
    let is_upright = |choice: &Choice| choice.lo.iter().zip(choice.hi).all(|(lo, hi)| *lo <= hi);
    match choices.iter().find(|choice| !is_upright(choice)) {
        Some(wrong) => Err(Error::new(format!("a choice of pixel {} is upside down", wrong.pixel))),
        None => Ok(choices),
    }
}

pub(super) fn extremes(bytes: &[u8], size: Size) -> Result<Vec<Extremes>> {
    let extremes = rows(bytes, size)?.into_iter();
    let extremes: Vec<Extremes> =
        extremes.map(|(pixel, least, most)| Extremes { pixel, least, most }).collect();
    match extremes.windows(2).find(|pair| pair[0].pixel == pair[1].pixel) {
        Some(pair) => Err(Error::new(format!("pixel {} has its two ends twice", pair[0].pixel))),
        None => Ok(extremes),
    }
}

fn rows(bytes: &[u8], size: Size) -> Result<Vec<Colors>> {
    let rows = Array::of(bytes)?.whole_rows::<9>()?;
    check_pixels(rows.iter().map(|row| row[0]), size)?;
    let read = |row: &Row| {
        let codes = |from: usize| -> Option<[u16; 4]> {
            let mut codes = [0; 4];
            for (code, value) in codes.iter_mut().zip(&row[from..]) {
                *code = u16::try_from(*value).ok()?;
            }
            Some(codes)
        };
        let wrong = || Error::new(format!("a colour of pixel {} is beyond 65535", row[0]));
        Ok((row[0], codes(1).ok_or_else(wrong)?, codes(5).ok_or_else(wrong)?))
    };
    rows.iter().map(read).collect()
}

/// Places in a buffer, which may be finer than the picture, and their values.
pub(super) fn one_of(bytes: &[u8]) -> Result<Vec<(u32, f64)>> {
    let rows = Array::of(bytes)?.real_rows::<2>()?;
    if let Some([pixel, value]) =
        rows.iter().find(|[pixel, value]| f64::from(*pixel as u32) != *pixel || value.is_nan())
    {
        return Err(Error::new(format!("a row of the pixel {pixel} and the value {value} is none")));
    }
    // A cast keeps a whole number.
    let rows: Vec<(u32, f64)> = rows.into_iter().map(|[pixel, value]| (pixel as u32, value)).collect();
    check_sorted(rows.iter().map(|(pixel, _)| *pixel))?;
    Ok(rows)
}

pub(super) fn runs(bytes: &[u8], size: Size) -> Result<Vec<FeatureRun>> {
    let rows = Array::of(bytes)?.whole_rows::<5>()?;
    let run = |[row, first, last, layer, feature]: [u32; 5]| FeatureRun { row, first, last, layer, feature };
    let runs: Vec<FeatureRun> = rows.into_iter().map(run).collect();
    let is_inside = |run: &FeatureRun| {
        (run.row as usize) < size.height && run.first <= run.last && (run.last as usize) < size.width
    };
    match runs.iter().find(|run| !is_inside(run)) {
        Some(FeatureRun { row, first, last, .. }) => {
            Err(Error::new(format!("row {row} has no pixels from {first} to {last}")))
        }
        None => Ok(runs),
    }
}

fn check_pixels(pixels: impl Iterator<Item = u32> + Clone, size: Size) -> Result<()> {
    if let Some(outside) = pixels.clone().find(|pixel| !size.holds(*pixel)) {
        return Err(Error::new(format!("the picture has no pixel {outside}")));
    }
    check_sorted(pixels)
}

fn check_sorted(pixels: impl Iterator<Item = u32>) -> Result<()> {
    if !pixels.is_sorted() {
        return Err(Error::new("its rows are not sorted by pixel"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::buffer::{Plane, Values};
    use crate::output::Npy;
    use proptest::prelude::{ProptestConfig, any, prop};

    const SIZE: Size = Size { width: 4, height: 3 };

    fn file(columns: usize, values: Values, rows: usize) -> Vec<u8> {
        let plane = Plane { name: "table", width: columns, height: rows, components: 1, values };
        let mut file = Vec::new();
        Npy::new(&plane).unwrap().write(&mut file).unwrap();
        file
    }

    #[test]
    fn rows_are_read_as_they_are() {
        let row = vec![11, 0, 1, 2, 3, 4, 5, 6, 65535];
        let table = file(9, Values::U32(row), 1);
        let (lo, hi) = ([0, 1, 2, 3], [4, 5, 6, 65535]);
        assert_eq!(choices(&table, SIZE).unwrap(), [Choice { pixel: 11, lo, hi }]);
        assert_eq!(extremes(&table, SIZE).unwrap(), [Extremes { pixel: 11, least: lo, most: hi }]);
        let table = file(5, Values::U32(vec![2, 1, 3, 7, 8]), 1);
        let run = FeatureRun { row: 2, first: 1, last: 3, layer: 7, feature: 8 };
        assert_eq!(runs(&table, SIZE).unwrap(), [run]);
        let table = file(2, Values::F64(vec![3.0, f64::INFINITY, 3.0, -1.5]), 2);
        assert_eq!(one_of(&table).unwrap(), [(3, f64::INFINITY), (3, -1.5)]);
    }

    #[test]
    fn a_place_is_a_whole_number() {
        for place in [-1.0, 0.5, 4_294_967_296.0, f64::INFINITY] {
            let error = one_of(&file(2, Values::F64(vec![place, 0.0]), 1)).unwrap_err();
            assert!(error.what().starts_with("a row of the pixel"), "{error}");
        }
    }

    proptest::proptest! {
        #![proptest_config(ProptestConfig::with_cases(256))]

        #[test]
        fn damaged_tables_are_refused_or_hold_what_they_have_to(
            changes in prop::collection::vec((any::<u32>(), any::<u8>()), 1..6),
            cut in prop::option::of(any::<u32>()),
        ) {
            for columns in [9, 5, 2] {
                let mut table = match columns {
                    2 => file(2, Values::F64(vec![1.0; 4]), 2),
                    _ => file(columns, Values::U32(vec![1; 2 * columns]), 2),
                };
                for (at, byte) in &changes {
                    let at = *at as usize % table.len();
                    table[at] = *byte;
                }
                if let Some(cut) = cut {
                    table.truncate(cut as usize % table.len());
                }
                assert!(choices(&table, SIZE).map_or(true, |rows| rows.iter().all(|row| row.pixel < 12)));
                assert!(extremes(&table, SIZE).map_or(true, |rows| rows.iter().all(|row| row.pixel < 12)));
                assert!(one_of(&table).map_or(true, |rows| rows.is_sorted_by_key(|row| row.0)));
                assert!(runs(&table, SIZE).map_or(true, |runs| runs.iter().all(|run| run.row < 3 && run.last < 4)));
            }
        }
    }
}
