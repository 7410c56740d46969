//! The tiles that are in memory.
//!
//! Each level's part that is at hand is a torus of slots (Tanner, Migdal, Jones 1998): a tile's slot is its column and row modulo the
//! part's side, so that a part that moves replaces only the tiles that have left it. A budget of bytes bounds all levels together:
//! what has not been used for longest goes first. What is in the cache changes how long a frame takes, never what it shows.

use super::texture::{ClipRegion, TileKey};
use super::tile::Tile;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Tiles by the slots of their levels: level, row, column.
#[derive(Debug, Default)]
pub(super) struct TileCache {
    slots: BTreeMap<(u32, u32, u32), Slot>,
    bytes: usize,
    /// What all tiles depend on but their keys: a pixel's size in metres, if any width follows it; and the region of their slots.
    made_for: Option<(Option<f64>, ClipRegion)>,
    /// Counts uses, to know the oldest.
    clock: u64,
}

#[derive(Debug)]
struct Slot {
    key: TileKey,
    tile: Arc<Tile>,
    used: u64,
}

/// What a cache did.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CacheCounts {
    /// Tiles that were made.
    pub made: u64,
    /// Tiles that were there.
    pub found: u64,
    /// Tiles that were given up for others.
    pub evicted: u64,
}

impl TileCache {
    /// Gets ready for frames around a region, with a pixel's size in metres if any width follows it; tiles that were made for another size
    /// are of no use, nor are slots of a region of another size.
    pub(super) fn prepare(&mut self, pixel_m: Option<f64>, region: &ClipRegion) {
        if !self.made_for.is_some_and(|(known, of)| known == pixel_m && of.side() == region.side()) {
            self.slots.clear();
            self.bytes = 0;
        }
        self.made_for = Some((pixel_m, *region));
    }

    /// The tiles of some keys, in their order: those that are there, the others made by `make`, all at once. When they
    /// are there, others go until no more than `budget` bytes are held, if that can be.
    pub(super) fn tiles(
        &mut self,
        keys: &[TileKey],
        budget: usize,
        counts: &mut CacheCounts,
        make: impl FnOnce(&[TileKey]) -> Vec<Tile>,
    ) -> Vec<Arc<Tile>> {
        let Some((_, region)) = self.made_for else { return Vec::new() };
        self.clock += 1;
        let missing: Vec<TileKey> =
            keys.iter().copied().filter(|key| self.get(&region, *key).is_none()).collect();
        counts.found += (keys.len() - missing.len()) as u64;
        counts.made += missing.len() as u64;
        for (key, tile) in missing.iter().zip(make(&missing)) {
            self.bytes += tile.bytes();
            let slot = Slot { key: *key, tile: Arc::new(tile), used: self.clock };
            if let Some(left) = self.slots.insert(region.slot(*key), slot) {
                self.bytes -= left.tile.bytes();
                counts.evicted += 1;
            }
        }
        let found = keys.iter().filter_map(|key| self.get(&region, *key)).collect();
        self.evict(budget, counts);
        found
    }

    fn get(&mut self, region: &ClipRegion, key: TileKey) -> Option<Arc<Tile>> {
        let slot = self.slots.get_mut(&region.slot(key)).filter(|slot| slot.key == key)?;
        slot.used = self.clock;
        Some(Arc::clone(&slot.tile))
    }

    /// Gives up the tiles that have not been used for longest; those that are in use now stay.
    fn evict(&mut self, budget: usize, counts: &mut CacheCounts) {
        if self.bytes <= budget {
            return;
        }
        let old = self.slots.iter().filter(|(_, slot)| slot.used < self.clock);
        let mut old: Vec<(u64, (u32, u32, u32))> = old.map(|(place, slot)| (slot.used, *place)).collect();
        old.sort_unstable();
        for (_, place) in old {
            if self.bytes <= budget {
                break;
            }
            if let Some(slot) = self.slots.remove(&place) {
                self.bytes -= slot.tile.bytes();
                counts.evicted += 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::texture::VirtualTexture;
    use super::super::tile::{Texels, TileCounts};
    use super::*;
    use crate::space::{Plan, PlanBox};

    fn region(x: f64) -> ClipRegion {
        let bounds = PlanBox { min: Plan::new(0.0, 0.0), max: Plan::new(4096.0, 4096.0) };
        ClipRegion::new(&VirtualTexture::over(&bounds, 4096), Plan::new(x, 2048.0), 1024)
    }

    fn key(column: u32, row: u32) -> TileKey {
        TileKey { level: 0, row, column }
    }

    /// A tile of 16 bytes.
    fn tile() -> Tile {
        Tile { size: 1, texels: Texels::F32(vec![[0.0; 4]]), counts: TileCounts::default() }
    }

    fn ask(cache: &mut TileCache, keys: &[TileKey], budget: usize) -> CacheCounts {
        let mut counts = CacheCounts::default();
        let tiles =
            cache.tiles(keys, budget, &mut counts, |missing| missing.iter().map(|_| tile()).collect());
        assert_eq!(tiles.len(), keys.len());
        counts
    }

    #[test]
    fn a_tile_is_made_once() {
        let mut cache = TileCache::default();
        cache.prepare(Some(1.0), &region(2048.0));
        assert_eq!(
            ask(&mut cache, &[key(7, 7), key(8, 7)], 1000),
            CacheCounts { made: 2, found: 0, evicted: 0 }
        );
        assert_eq!(
            ask(&mut cache, &[key(7, 7), key(8, 8)], 1000),
            CacheCounts { made: 1, found: 1, evicted: 0 }
        );
        cache.prepare(Some(2.0), &region(2048.0));
        assert_eq!(ask(&mut cache, &[key(7, 7)], 1000).made, 1, "another width, another tile");
    }

    #[test]
    fn a_budget_keeps_what_was_used_last_and_all_that_is_in_use() {
        let mut cache = TileCache::default();
        cache.prepare(Some(1.0), &region(2048.0));
        ask(&mut cache, &[key(6, 6)], 32);
        ask(&mut cache, &[key(7, 7)], 32);
        ask(&mut cache, &[key(6, 6)], 32);
        assert_eq!(ask(&mut cache, &[key(8, 8)], 32).evicted, 1);
        assert_eq!(cache.bytes, 32);
        assert_eq!(ask(&mut cache, &[key(6, 6)], 32).found, 1, "used more lately than (7, 7)");
        let counts = ask(&mut cache, &[key(6, 7), key(7, 6), key(8, 6)], 32);
        assert_eq!((counts.made, cache.bytes), (3, 48), "a pass holds what it needs");
    }

    #[test]
    fn a_region_that_moves_replaces_the_tiles_that_leave_it() {
        let mut cache = TileCache::default();
        cache.prepare(Some(1.0), &region(2048.0));
        // Columns 6 to 9 are at hand; then 7 to 10, and column 10 has the slots of column 6.
        ask(&mut cache, &[key(6, 7), key(7, 7)], 1000);
        cache.prepare(Some(1.0), &region(2304.0));
        assert_eq!(
            ask(&mut cache, &[key(7, 7), key(10, 7)], 1000),
            CacheCounts { made: 1, found: 1, evicted: 1 }
        );
    }
}
