//! The tiles at hand while pixels are coloured.

use super::texture::TileKey;
use super::tile::Tile;
use std::sync::Arc;

/// Tiles by level, row and column.
pub(super) struct Table {
    levels: Vec<LevelTiles>,
}

/// A rectangle of a level's tiles, with gaps.
#[derive(Clone, Default)]
struct LevelTiles {
    west: u32,
    north: u32,
    columns: u32,
    tiles: Vec<Option<Arc<Tile>>>,
}

impl Table {
    /// The tiles of some keys, which are in order, in a texture of so many levels.
    pub(super) fn new(keys: &[TileKey], tiles: Vec<Arc<Tile>>, levels: u32) -> Self {
        let mut table = Self { levels: vec![LevelTiles::default(); levels as usize] };
        let mut tiles = keys.iter().zip(tiles).peekable();
        for of_level in keys.chunk_by(|a, b| a.level == b.level) {
            let range = |of: fn(&TileKey) -> u32| {
                let values = || of_level.iter().map(of);
                (values().min().unwrap_or(0), values().max().unwrap_or(0))
            };
            let ((west, east), (north, south)) = (range(|key| key.column), range(|key| key.row));
            let columns = east - west + 1;
            let mut found = vec![None; (columns * (south - north + 1)) as usize];
            for (key, tile) in tiles.by_ref().take(of_level.len()) {
                found[((key.row - north) * columns + key.column - west) as usize] = Some(tile);
            }
            table.levels[of_level[0].level as usize] = LevelTiles { west, north, columns, tiles: found };
        }
        table
    }

    /// A tile, if it is at hand.
    #[inline]
    pub(super) fn get(&self, key: TileKey) -> Option<&Tile> {
        let level = self.levels.get(key.level as usize)?;
        let column = key.column.checked_sub(level.west).filter(|column| *column < level.columns)?;
        let row = key.row.checked_sub(level.north)?;
        level.tiles.get((row * level.columns + column) as usize)?.as_deref()
    }
}
