//! A picture cut into square tiles, and put together again.
//!
//! Input: a size and the side of a tile. Output: where each tile lies, and the tiles' values as one picture. It decides nothing of what a
//! pixel shows, so that those who must not share a decision may share it. Refuses: nothing; tiles have a side of at least 1.

use std::ops::Range;

/// A picture cut into tiles, row by row of tiles; the last ones of a row or column may be smaller.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tiling {
    width: usize,
    height: usize,
    side: usize,
}

/// Where a tile lies in the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TilePlace {
    /// Column and row of its first pixel.
    pub corner: [usize; 2],
    /// Its columns and rows.
    pub size: [usize; 2],
}

impl Tiling {
    /// A picture of `width` x `height` in tiles of `side` pixels a side, at least 1.
    pub fn new(width: usize, height: usize, side: usize) -> Self {
        Self { width, height, side: side.max(1) }
    }

    /// Columns and rows of the picture.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.height]
    }

    /// Tiles a row.
    pub fn across(&self) -> usize {
        self.width.div_ceil(self.side)
    }

    /// How many tiles there are.
    pub fn count(&self) -> usize {
        self.across() * self.height.div_ceil(self.side)
    }

    /// Where tile `k` lies.
    pub fn place(&self, k: usize) -> TilePlace {
        let corner = [k % self.across() * self.side, k / self.across() * self.side];
        let size = [self.side.min(self.width - corner[0]), self.side.min(self.height - corner[1])];
        TilePlace { corner, size }
    }

    /// The tiles that have a pixel in a window of the picture, which is not empty.
    pub fn tiles_in(&self, columns: Range<usize>, rows: Range<usize>) -> impl Iterator<Item = usize> {
        let tiles = |range: Range<usize>| range.start / self.side..range.end.div_ceil(self.side);
        let (across, columns) = (self.across(), tiles(columns));
        tiles(rows).flat_map(move |row| columns.clone().map(move |column| row * across + column))
    }

    /// The rows of tile `k` as ranges of the picture's pixels, from the top.
    pub fn rows(&self, k: usize) -> impl Iterator<Item = Range<usize>> {
        let TilePlace { corner: [x, y], size: [width, height] } = self.place(k);
        let stride = self.width;
        (y..y + height).map(move |row| row * stride + x..row * stride + x + width)
    }

    /// The picture, rows from the top, of whose tiles these are the pixels, in order; `empty` where tiles are missing.
    ///
    /// # Panics
    /// When a tile has pixels, but not as many as its place.
    pub fn assembled<'t, T: Copy + 't>(&self, empty: T, tiles: impl IntoIterator<Item = &'t [T]>) -> Vec<T> {
        let mut all = vec![empty; self.width * self.height];
        for (k, tile) in tiles.into_iter().enumerate().filter(|(_, tile)| !tile.is_empty()) {
            let width = self.place(k).size[0];
            for (to, from) in self.rows(k).zip(tile.chunks(width)) {
                all[to].copy_from_slice(from);
            }
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_lies_in_one_tile_and_comes_back_to_its_place() {
        for (width, height, side) in [(7, 5, 3), (1, 9, 4), (8, 8, 8), (6, 4, 100), (3, 2, 0)] {
            let tiling = Tiling::new(width, height, side);
            let tiles: Vec<Vec<usize>> =
                (0..tiling.count()).map(|k| tiling.rows(k).flatten().collect()).collect();
            let picture = tiling.assembled(usize::MAX, tiles.iter().map(Vec::as_slice));
            assert_eq!(picture, (0..width * height).collect::<Vec<_>>(), "{width} x {height} by {side}");
        }
    }

    #[test]
    fn the_last_tiles_of_a_row_and_a_column_are_smaller() {
        let tiling = Tiling::new(7, 5, 3);
        assert_eq!((tiling.across(), tiling.count()), (3, 6));
        assert_eq!(tiling.place(5), TilePlace { corner: [6, 3], size: [1, 2] });
    }

    #[test]
    fn a_window_names_the_tiles_that_it_touches() {
        let tiling = Tiling::new(7, 5, 3);
        assert_eq!(tiling.tiles_in(2..4, 2..3).collect::<Vec<_>>(), [0, 1]);
        assert_eq!(tiling.tiles_in(3..7, 0..5).collect::<Vec<_>>(), [1, 2, 4, 5]);
    }
}
