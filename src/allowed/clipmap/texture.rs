//! The virtual texture as the judge reads it: a square of the plan in levels of texels, cut into tiles, and the part of each level at hand.

use crate::certainty::Known;
use crate::math;
use crate::space::{Plan, PlanBox, Texel};
use crate::technique::clipmap::TILE_TEXELS;
use glam::DVec2;

/// A tile of a level: level, column, row.
pub(super) type Key = (u32, u32, u32);

/// A square of the plan as a texture.
#[derive(Debug, Clone, Copy)]
pub(super) struct Texture {
    /// The north-western corner.
    corner: Plan,
    /// Metres a side.
    side: f64,
    /// Texels a side of level 0: a power of two.
    size: u32,
}

impl Texture {
    /// The square around a terrain, from its north-western corner.
    pub(super) fn over(bounds: &PlanBox, size: u32) -> Self {
        let extent = bounds.max - bounds.min;
        Self { corner: Plan::new(bounds.min.x, bounds.max.y), side: math::max(extent.x, extent.y), size }
    }

    /// How many levels there are; the last has one texel.
    pub(super) fn levels(&self) -> u32 {
        self.size.trailing_zeros() + 1
    }

    /// Texels a side of a level.
    pub(super) fn size(&self, level: u32) -> i64 {
        i64::from(self.size >> level)
    }

    /// Tiles a side of a level.
    fn tiles(&self, level: u32) -> i64 {
        (self.size(level) + i64::from(TILE_TEXELS) - 1) / i64::from(TILE_TEXELS)
    }

    /// Texels a side of a level's tiles.
    pub(super) fn tile_size(&self, level: u32) -> usize {
        math::min(self.size(level) as f64, f64::from(TILE_TEXELS)) as usize
    }

    /// Metres a side of a level's texels.
    pub(super) fn texel_m(&self, level: u32) -> f64 {
        self.side / self.size(level) as f64
    }

    /// A plan point in the texels of a level, from the tile's corner.
    pub(super) fn in_tile(&self, (level, column, row): Key, at: Plan) -> Texel {
        let scale = 1.0 / self.texel_m(level);
        let origin = |tile: u32| f64::from(tile) * f64::from(TILE_TEXELS);
        let (x, y) = ((at.x - self.corner.x) * scale, (self.corner.y - at.y) * scale);
        Texel::new(x - origin(column), y - origin(row))
    }

    /// A plan point in the texels of level 0.
    pub(super) fn finest(&self, at: Plan) -> Texel {
        self.in_tile((0, 0, 0), at)
    }

    /// A way in the plan in the texels of level 0.
    pub(super) fn way(&self, way: DVec2) -> DVec2 {
        DVec2::new(way.x, -way.y) / self.texel_m(0)
    }

    /// What a tile covers of the plan.
    pub(super) fn bounds(&self, (level, column, row): Key) -> PlanBox {
        let texel = self.texel_m(level);
        let tile = f64::from(TILE_TEXELS) * texel;
        let (west, north) = (self.corner.x + f64::from(column) * tile, self.corner.y - f64::from(row) * tile);
        let side = self.tile_size(level) as f64 * texel;
        PlanBox { min: Plan::new(west, north - side), max: Plan::new(west + side, north) }
    }
}

/// The tiles of a level that are at hand, as far as it is known where the middle of the region is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    /// The first column and row, at least and at most.
    first: [(i64, i64); 2],
    /// Columns and rows.
    side: i64,
    /// Texels a side of the level.
    size: i64,
}

impl Window {
    /// The window of a level of a region of some texels a side around a point of a box.
    pub(super) fn of(texture: &Texture, level: u32, middle: &PlanBox, clip_size: u32) -> Self {
        let tiles = texture.tiles(level);
        let side = i64::from(clip_size.div_ceil(TILE_TEXELS)).min(tiles);
        let scale = f64::from(TILE_TEXELS) * (1u64 << level) as f64;
        let first = |at: f64| {
            let first = (at / scale - 0.5 * side as f64 + 0.5).floor();
            (first as i64).clamp(0, tiles - side)
        };
        // A hair wider, for rounding.
        let (a, b) = (texture.finest(middle.min), texture.finest(middle.max));
        let hair = 1e-6 * scale;
        let along = |p: f64, q: f64| (first(math::min(p, q) - hair), first(math::max(p, q) + hair));
        Self { first: [along(a.x, b.x), along(a.y, b.y)], side, size: texture.size(level) }
    }

    /// Whether all texels from one to another are at hand.
    pub(super) fn holds(&self, from: [i64; 2], to: [i64; 2]) -> Known {
        let tile = |v: i64| v.clamp(0, self.size - 1) / i64::from(TILE_TEXELS);
        let along = |axis: usize| {
            let (least, most) = self.first[axis];
            let within = |first: i64| first <= tile(from[axis]) && tile(to[axis]) < first + self.side;
            match (least..=most).filter(|first| within(*first)).count() as i64 {
                0 => Known::Out,
                count if count == most - least + 1 => Known::In,
                _ => Known::Open,
            }
        };
        along(0).and(along(1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_whose_middle_is_not_known_is_open_at_its_rim() {
        let plan = PlanBox { min: Plan::new(0.0, 0.0), max: Plan::new(4096.0, 4096.0) };
        let texture = Texture::over(&plan, 4096);
        let middle = PlanBox { min: Plan::new(2000.0, 2048.0), max: Plan::new(2300.0, 2048.0) };
        let window = Window::of(&texture, 0, &middle, 1024);
        let at = |x: i64| window.holds([x, 2048], [x + 1, 2049]);
        // Tiles 6 to 9, or 7 to 10.
        assert_eq!([2048, 1536, 2559, 2600].map(at), [Known::In, Known::Open, Known::Open, Known::Open]);
        assert_eq!([100, 1500, 2816].map(at), [Known::Out; 3]);
    }
}
