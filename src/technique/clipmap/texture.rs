//! The virtual texture: its place in the plan, its levels and tiles, and the part of each level that is at hand.
//!
//! Level 0 is the finest; each further level has half as many texels a side, down to one. A level is cut into tiles of 256 texels
//! (5); smaller ones are a tile of their own.

use crate::space::{Plan, PlanBox, Texel};
use crate::technique::clipmap::TILE_TEXELS;

/// Texels a side of a tile.
pub const TILE: usize = TILE_TEXELS as usize;

/// A tile of the texture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct TileKey {
    /// The level, 0 the finest.
    pub level: u32,
    /// The row of tiles from the north.
    pub row: u32,
    /// The column of tiles from the west.
    pub column: u32,
}

/// A square of the plan as a texture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VirtualTexture {
    /// The north-west corner.
    corner: Plan,
    /// Its side in metres.
    side: f64,
    /// Texels a side of level 0: a power of two.
    size: u32,
}

impl VirtualTexture {
    /// The texture of a terrain: the square around its box, from the north-west corner.
    pub fn over(bounds: &PlanBox, size: u32) -> Self {
        let extent = bounds.max - bounds.min;
        let side = crate::math::max(extent.x, extent.y);
        Self { corner: Plan::new(bounds.min.x, bounds.max.y), side, size }
    }

    /// How many levels it has.
    pub fn levels(&self) -> u32 {
        self.size.trailing_zeros() + 1
    }

    /// Texels a side of a level.
    pub fn size(&self, level: u32) -> u32 {
        self.size >> level
    }

    /// Tiles a side of a level.
    pub fn tiles(&self, level: u32) -> u32 {
        self.size(level).div_ceil(TILE_TEXELS)
    }

    /// Texels a side of a tile of a level.
    pub fn tile_size(&self, level: u32) -> usize {
        TILE.min(self.size(level) as usize)
    }

    /// A texel's side in metres. Exactly twice as long in each further level.
    pub fn texel_m(&self, level: u32) -> f64 {
        self.side / f64::from(self.size) * power_of_two(level)
    }

    /// A plan point in the texels of a level. Exactly half as far in each further level.
    #[inline]
    pub fn texel(&self, level: u32, at: Plan) -> Texel {
        let scale = f64::from(self.size) / self.side / power_of_two(level);
        Texel::new((at.x - self.corner.x) * scale, (self.corner.y - at.y) * scale)
    }

    /// The plan point of a texel of a level.
    pub fn plan(&self, level: u32, at: Texel) -> Plan {
        let texel = self.texel_m(level);
        Plan::new(self.corner.x + at.x * texel, self.corner.y - at.y * texel)
    }

    /// The plan point of the centre of a tile's texel (column, row).
    pub fn centre_of(&self, tile: TileKey, (column, row): (usize, usize)) -> Plan {
        let side = self.tile_size(tile.level) as f64;
        let along = |tile: u32, texel: usize| f64::from(tile) * side + texel as f64 + 0.5;
        self.plan(tile.level, Texel::new(along(tile.column, column), along(tile.row, row)))
    }

    /// The square that it covers.
    pub fn bounds(&self) -> PlanBox {
        PlanBox {
            min: Plan::new(self.corner.x, self.corner.y - self.side),
            max: Plan::new(self.corner.x + self.side, self.corner.y),
        }
    }

    /// The square that a tile covers.
    pub fn tile_bounds(&self, key: TileKey) -> PlanBox {
        let side = self.tile_size(key.level) as f64;
        let (x, y) = (f64::from(key.column) * side, f64::from(key.row) * side);
        let corners = [Texel::new(x, y), Texel::new(x + side, y + side)];
        PlanBox::around(corners.map(|corner| self.plan(key.level, corner)))
    }
}

/// 2^k, exactly.
pub(super) fn power_of_two(k: u32) -> f64 {
    (1u64 << k) as f64
}

/// The part of each level that is at hand: a square of tiles around a centre, which a clipmap keeps in memory of a fixed size by
/// addressing it as a torus (Tanner, Migdal, Jones 1998). Those of coarser levels contain those of finer ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClipRegion {
    /// The centre in the texels of level 0.
    center: Texel,
    /// Tiles a side.
    side: u32,
}

/// Tiles of a level: columns and rows, the last ones excluded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TileWindow {
    /// The first column and row.
    pub first: (u32, u32),
    /// The column and row after the last.
    pub end: (u32, u32),
}

impl ClipRegion {
    /// The region of `size` texels a side around a point of the plan.
    pub fn new(texture: &VirtualTexture, center: Plan, size: u32) -> Self {
        Self { center: texture.texel(0, center), side: size.div_ceil(TILE_TEXELS) }
    }

    /// Tiles a side of the region.
    pub fn side(&self) -> u32 {
        self.side
    }

    /// The tiles of a level that are at hand: those nearest to the centre; at the texture's rim the square is moved inside.
    pub fn window(&self, texture: &VirtualTexture, level: u32) -> TileWindow {
        let tiles = texture.tiles(level);
        let side = self.side.min(tiles);
        let first = |center: f64| {
            let middle = center / power_of_two(level) / f64::from(TILE_TEXELS);
            let first = (middle - 0.5 * f64::from(side) + 0.5).floor();
            // A cast keeps within 0 and the largest number.
            (first as u32).min(tiles - side)
        };
        let (column, row) = (first(self.center.x), first(self.center.y));
        TileWindow { first: (column, row), end: (column + side, row + side) }
    }

    /// The slot of a tile in its level's memory: column and row are taken modulo the region's side, so that a region that moves
    /// replaces only what leaves it.
    pub fn slot(&self, key: TileKey) -> (u32, u32, u32) {
        (key.level, key.row % self.side, key.column % self.side)
    }
}

impl TileWindow {
    /// The keys of its tiles in a level.
    pub fn keys(self, level: u32) -> impl Iterator<Item = TileKey> {
        let columns = self.first.0..self.end.0;
        (self.first.1..self.end.1)
            .flat_map(move |row| columns.clone().map(move |column| TileKey { level, row, column }))
    }

    /// Whether it holds a tile.
    #[inline]
    pub fn contains(&self, column: i64, row: i64) -> bool {
        let within = |v: i64, first: u32, end: u32| i64::from(first) <= v && v < i64::from(end);
        within(column, self.first.0, self.end.0) && within(row, self.first.1, self.end.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn texture(size: u32) -> VirtualTexture {
        let bounds = PlanBox { min: Plan::new(-100.0, -50.0), max: Plan::new(412.0, 50.0) };
        VirtualTexture::over(&bounds, size)
    }

    #[test]
    fn a_texture_has_levels_down_to_one_texel() {
        let t = texture(1024);
        assert_eq!(t.levels(), 11);
        assert_eq!(
            [0, 2, 3, 10].map(|level| (t.size(level), t.tiles(level), t.tile_size(level))),
            [(1024, 4, 256), (256, 1, 256), (128, 1, 128), (1, 1, 1)]
        );
        assert_eq!([0, 1, 10].map(|level| t.texel_m(level)), [0.5, 1.0, 512.0]);
    }

    #[test]
    fn texels_count_from_the_north_western_corner() {
        let t = texture(1024);
        assert_eq!(t.texel(0, Plan::new(-100.0, 50.0)), Texel::new(0.0, 0.0));
        assert_eq!(t.texel(1, Plan::new(-90.0, 30.0)), Texel::new(10.0, 20.0));
        let key = TileKey { level: 1, row: 1, column: 0 };
        let bounds = t.tile_bounds(key);
        assert_eq!((bounds.min, bounds.max), (Plan::new(-100.0, -462.0), Plan::new(156.0, -206.0)));
    }

    #[test]
    fn a_region_keeps_its_size_at_the_rim() {
        let t = texture(4096);
        let region = |x: f64, y: f64| ClipRegion::new(&t, Plan::new(x, y), 512);
        let window = |x, y, level| region(x, y).window(&t, level);
        assert_eq!(window(-1e9, 1e9, 0), TileWindow { first: (0, 0), end: (2, 2) });
        assert_eq!(window(1e9, -1e9, 0), TileWindow { first: (14, 14), end: (16, 16) });
        assert_eq!(window(0.0, 0.0, 3), TileWindow { first: (0, 0), end: (2, 2) }, "all of a small level");
    }

    #[test]
    fn a_region_that_moves_by_a_tile_keeps_the_slots_of_all_others() {
        let t = texture(1 << 14);
        let tile = t.texel_m(0) * 256.0;
        let slots = |x: f64| {
            let region = ClipRegion::new(&t, Plan::new(x, -200.0), 1024);
            let window = region.window(&t, 0);
            window.keys(0).map(|key| (region.slot(key), key)).collect::<std::collections::BTreeMap<_, _>>()
        };
        let (before, after) = (slots(100.0), slots(100.0 + tile));
        assert_eq!((before.len(), after.len()), (16, 16), "no two tiles share a slot");
        let kept = before.iter().filter(|(slot, key)| after.get(slot) == Some(key)).count();
        assert_eq!(kept, 12);
    }

    proptest! {
        #[test]
        fn regions_of_coarser_levels_contain_those_of_finer_ones(
            x in -300.0..700.0f64, y in -800.0..300.0f64, bits in 8..13u32,
        ) {
            let t = texture(1 << 14);
            let region = ClipRegion::new(&t, Plan::new(x, y), 1 << bits);
            for level in 0..6 {
                let (fine, coarse) = (region.window(&t, level), region.window(&t, level + 1));
                prop_assert!(coarse.first.0 * 2 <= fine.first.0 && coarse.first.1 * 2 <= fine.first.1);
                prop_assert!(fine.end.0 <= coarse.end.0 * 2 && fine.end.1 <= coarse.end.1 * 2);
            }
        }
    }
}
