//! Edits of finished pictures.

use super::edit::Picture;
use crate::buffer::Buffer;
use crate::math;

/// The side of a tile that goes wrong alone, pixels.
const TILE: usize = 8;

/// A picture whose pixels are those at other places of another.
fn moved(of: &Picture, from: impl Fn(usize, usize) -> (usize, usize)) -> Picture {
    let (width, height) = (of.width(), of.height());
    let values = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| {
        let (x, y) = from(x, y);
        *of.at(x.min(width - 1), y.min(height - 1))
    });
    Buffer::from_values(width, height, values.collect())
}

/// A picture of other codes.
fn recoded(of: &Picture, code: impl Fn([u8; 4]) -> [u8; 4]) -> Picture {
    Buffer::from_values(of.width(), of.height(), of.values().iter().map(|c| code(*c)).collect())
}

pub(super) fn upside_down(of: &Picture) -> Picture {
    moved(of, |x, y| (x, of.height() - 1 - y))
}

pub(super) fn mirrored(of: &Picture) -> Picture {
    moved(of, |x, y| (of.width() - 1 - x, y))
}

pub(super) fn a_column_to_the_left(of: &Picture) -> Picture {
    moved(of, |x, y| (x + 1, y))
}

pub(super) fn a_row_up(of: &Picture) -> Picture {
    moved(of, |x, y| (x, y + 1))
}

/// From the middle on, each column is that before it.
pub(super) fn a_column_twice(of: &Picture) -> Picture {
    moved(of, |x, y| (if x > of.width() / 2 { x - 1 } else { x }, y))
}

/// From the middle on, each row is that before it.
pub(super) fn a_row_twice(of: &Picture) -> Picture {
    moved(of, |x, y| (x, if y > of.height() / 2 { y - 1 } else { y }))
}

/// Every second column and row, twice.
pub(super) fn half_the_resolution(of: &Picture) -> Picture {
    moved(of, |x, y| (x - x % 2, y - y % 2))
}

/// Quads of 2 x 2 pixels with rows for columns.
pub(super) fn quads_transposed(of: &Picture) -> Picture {
    moved(of, |x, y| (x - x % 2 + y % 2, y - y % 2 + x % 2))
}

/// The last row is that before it.
pub(super) fn last_row_missing(of: &Picture) -> Picture {
    moved(of, |x, y| (x, y.min(of.height().saturating_sub(2))))
}

/// Two tiles beside the middle change places.
pub(super) fn tiles_swapped(of: &Picture) -> Picture {
    let (left, top) = (of.width() / 2 / TILE * TILE, of.height() / 2 / TILE * TILE);
    let is_row = |y: usize| (top..top + TILE).contains(&y);
    moved(of, |x, y| match x {
        _ if !is_row(y) => (x, y),
        x if (left..left + TILE).contains(&x) => (x - TILE, y),
        x if (left - TILE..left).contains(&x) => (x + TILE, y),
        x => (x, y),
    })
}

/// The tile with most different colours is that of the upper left corner.
pub(super) fn a_tile_dropped(of: &Picture) -> Picture {
    let corner = *of.at(0, 0);
    let blank = recoded(of, |_| corner);
    most_changed_tile(of, &blank).unwrap_or(blank)
}

pub(super) fn red_for_blue(of: &Picture) -> Picture {
    recoded(of, |[r, g, b, a]| [b, g, r, a])
}

pub(super) fn green_twice(of: &Picture) -> Picture {
    recoded(of, |[_, g, b, a]| [g, g, b, a])
}

pub(super) fn encoded_twice(of: &Picture) -> Picture {
    let again = |v: u8| {
        let linear = f64::from(v) / 255.0;
        let encoded =
            if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * math::pow(linear, 1.0 / 2.4) - 0.055 };
        (encoded * 255.0 + 0.5) as u8
    };
    recoded(of, |[r, g, b, a]| [again(r), again(g), again(b), a])
}

/// Two codes less of what is not black.
pub(super) fn two_codes_darker(of: &Picture) -> Picture {
    recoded(of, |[r, g, b, a]| [r.saturating_sub(2), g.saturating_sub(2), b.saturating_sub(2), a])
}

/// Codes of seven bits.
pub(super) fn seven_bits(of: &Picture) -> Picture {
    recoded(of, |code| code.map(|v| v & 0xfe))
}

/// Codes of an ordered dither of a code: quads' opposite corners one more.
pub(super) fn dithered(of: &Picture) -> Picture {
    let codes = (0..).zip(of.values()).map(|(k, code): (usize, _)| {
        let more = u8::from((k % of.width() + k / of.width()).is_multiple_of(2));
        let [r, g, b, a] = *code;
        [r.saturating_add(more), g.saturating_add(more), b.saturating_add(more), a]
    });
    Buffer::from_values(of.width(), of.height(), codes.collect())
}

pub(super) fn opaque(of: &Picture) -> Picture {
    recoded(of, |[r, g, b, _]| [r, g, b, 255])
}

pub(super) fn almost_opaque(of: &Picture) -> Picture {
    recoded(of, |[r, g, b, a]| [r, g, b, a.saturating_sub(2)])
}

/// Each pixel is the mean of itself and its right neighbour: a filter that nobody asked for.
pub(super) fn smeared(of: &Picture) -> Picture {
    let next = a_column_to_the_left(of);
    let mean = |(a, b): (&[u8; 4], &[u8; 4])| {
        std::array::from_fn(|c| (u16::from(a[c]) + u16::from(b[c])).div_ceil(2) as u8)
    };
    Buffer::from_values(of.width(), of.height(), of.values().iter().zip(next.values()).map(mean).collect())
}

/// The right picture with one tile of the other, where most of its pixels differ; `None`: none differs.
pub(super) fn most_changed_tile(right: &Picture, other: &Picture) -> Option<Picture> {
    if (right.width(), right.height()) != (other.width(), other.height()) {
        return None;
    }
    let (columns, rows) = (right.width().div_ceil(TILE), right.height().div_ceil(TILE));
    let mut changed = vec![0_usize; columns * rows];
    let place = |k: usize| (k % right.width() / TILE) + columns * (k / right.width() / TILE);
    for (k, (a, b)) in right.values().iter().zip(other.values()).enumerate() {
        changed[place(k)] += usize::from(a != b);
    }
    let most = changed.iter().copied().max().filter(|most| *most > 0)?;
    let tile = changed.iter().position(|count| *count == most)?;
    let pixel = |(k, (a, b)): (usize, (&[u8; 4], &[u8; 4]))| if place(k) == tile { *b } else { *a };
    let values = right.values().iter().zip(other.values()).enumerate().map(pixel);
    Some(Buffer::from_values(right.width(), right.height(), values.collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture of different pixels.
    fn picture() -> Picture {
        Buffer::from_values(
            24,
            16,
            (0..24 * 16).map(|k| [(k % 256) as u8, (k / 256) as u8, 7, 200]).collect(),
        )
    }

    #[test]
    fn flips_and_swaps_undo_themselves() {
        for edit in [upside_down, mirrored, red_for_blue, quads_transposed, tiles_swapped] {
            let once = edit(&picture());
            assert!(once.values() != picture().values() && edit(&once).values() == picture().values());
        }
    }

    #[test]
    fn a_tile_that_goes_wrong_alone_leaves_the_others() {
        let one = most_changed_tile(&picture(), &opaque(&picture())).unwrap();
        let changed = one.values().iter().zip(picture().values()).filter(|(a, b)| a != b).count();
        assert_eq!(changed, TILE * TILE);
        assert!(most_changed_tile(&picture(), &picture()).is_none());
    }
}
