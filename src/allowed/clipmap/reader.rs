//! Where a pixel reads the texture: how many probes at which level, and the texels of each that it may reach.

use super::surface::Look;
use super::texels::Tile;
use super::texture::{Key, Texture, Window};
use crate::certainty::Known;
use crate::math;
use crate::scene::BlendMode;
use crate::space::Texel;
use crate::technique::clipmap::{Settings, TILE_TEXELS, TextureFilter};
use glam::DVec2;
use std::collections::BTreeMap;

/// A weight may be this much of its format's last step off: half of it by rounding, and a little for the coordinate that it comes from.
const WEIGHT_STEPS: f64 = 0.6;

/// What arithmetic in single precision may do to a level: its logarithm's last bits.
const LEVEL: f64 = 1.0 / 4096.0;

/// A ratio of axes may be over a whole number by so much without a further probe.
const SAME_RATIO: f64 = 1e-6;

/// How the texture is read.
pub(super) struct Reader<'a> {
    pub(super) texture: &'a Texture,
    pub(super) windows: &'a [Window],
    pub(super) settings: &'a Settings,
    pub(super) mode: BlendMode,
    /// Bits of a filter's weights.
    pub(super) filter_bits: u32,
}

/// Tiles by their keys, as far as they are made.
pub(super) type Tiles = BTreeMap<Key, Tile>;

/// The probes of a pixel.
#[derive(Debug, Clone, Copy)]
pub(super) struct Probes {
    pub(super) count: u32,
    /// The level, at least and at most.
    levels: [f64; 2],
}

impl Reader<'_> {
    pub(super) fn coarsest(&self) -> u32 {
        self.texture.levels() - 1
    }

    /// What a weight may be off.
    fn weight_off(&self) -> f64 {
        WEIGHT_STEPS / f64::from(1u32 << self.filter_bits)
    }

    /// The numbers of probes that a pixel may take, each with its levels.
    pub(super) fn probes(&self, look: &Look) -> Vec<Probes> {
        let coarsest = f64::from(self.coarsest());
        let level = |length: f64| math::log2(length) + self.settings.level_bias;
        let of = |count: u32, [short, long]: [f64; 2]| Probes {
            count,
            levels: [level(short) - LEVEL, level(long) + LEVEL].map(|level| level.clamp(0.0, coarsest)),
        };
        if self.settings.filter != TextureFilter::Anisotropic {
            return vec![of(1, look.longer)];
        }
        let count =
            |ratio: f64| (ratio - SAME_RATIO).ceil().clamp(1.0, f64::from(self.settings.anisotropy)) as u32;
        (count(look.ratio[0])..=count(look.ratio[1]))
            .map(|count| of(count, look.long.map(|long| long / f64::from(count))))
            .collect()
    }

    /// The level that a pixel asks for, at least and at most.
    pub(super) fn levels(&self, look: &Look) -> (f64, f64) {
        let probes = self.probes(look);
        let low = probes.iter().map(|probes| probes.levels[0]).fold(f64::INFINITY, math::min);
        let high = probes.iter().map(|probes| probes.levels[1]).fold(0.0, math::max);
        (low, high)
    }

    /// Calls `visit` with the places of probes, texels of level 0, and how far each may lie elsewhere along both axes.
    pub(super) fn places(&self, look: &Look, count: u32, visit: &mut dyn FnMut(Texel, f64)) {
        let step = look.axis / f64::from(count);
        for k in 0..count {
            let from_middle = f64::from(k) - 0.5 * f64::from(count - 1);
            let noise = look.noise + look.axis_off * (from_middle / f64::from(count)).abs();
            visit(look.at + step * from_middle, noise);
        }
    }

    /// Calls `visit` with the tiles that a pixel may read.
    pub(super) fn tiles(&self, look: &Look, visit: &mut dyn FnMut(Key)) {
        for probes in self.probes(look) {
            let (first, last) = self.levels_read(&probes);
            self.places(look, probes.count, &mut |at, noise| {
                for level in first..=last {
                    for (_, level, from, to) in self.at_hand(look, (at, noise), level) {
                        self.tiles_between(level, from, to, visit);
                    }
                }
            });
        }
    }

    fn tiles_between(&self, level: u32, from: [i64; 2], to: [i64; 2], visit: &mut dyn FnMut(Key)) {
        let tile = |v: i64| (self.clamped(level, v) / i64::from(TILE_TEXELS)) as u32;
        for row in tile(from[1])..=tile(to[1]) {
            for column in tile(from[0])..=tile(to[0]) {
                visit((level, column, row));
            }
        }
    }

    fn clamped(&self, level: u32, v: i64) -> i64 {
        v.clamp(0, self.texture.size(level) - 1)
    }

    /// The first and the last level that probes may ask for.
    pub(super) fn levels_read(&self, probes: &Probes) -> (u32, u32) {
        let [low, high] = probes.levels;
        match self.settings.filter {
            // The lower of two that are as near.
            TextureFilter::Nearest | TextureFilter::Bilinear => {
                let nearest = |level: f64| math::max((level + 0.5).ceil() - 1.0, 0.0) as u32;
                let off = self.weight_off();
                (nearest(math::max(low - off, 0.0)), nearest(high + off).min(self.coarsest()))
            }
            TextureFilter::Trilinear | TextureFilter::Anisotropic => {
                let [low, high] = self.rounded(probes);
                (low as u32, ((high as u32) + 1).min(self.coarsest()))
            }
        }
    }

    /// Levels with what the weight between two may be off.
    pub(super) fn rounded(&self, probes: &Probes) -> [f64; 2] {
        let [low, high] = probes.levels;
        let off = self.weight_off();
        [math::max(low - off, 0.0), math::min(high + off, f64::from(self.coarsest()))]
    }

    /// The texels that a place may read where a level is asked for: whether of this level, the level, and the first and the last. The last entry is sure if none before
    /// is.
    pub(super) fn at_hand(
        &self,
        look: &Look,
        (at, noise): (Texel, f64),
        level: u32,
    ) -> Vec<(Known, u32, [i64; 2], [i64; 2])> {
        let mut found = Vec::new();
        for level in level..=self.coarsest() {
            let place = Place::of(look, (at, noise), level, self.square_off());
            let (from, to) = place.texels(self.settings.filter);
            let known = match level == self.coarsest() {
                true => Known::In,
                false => self.windows[level as usize].holds(from, to),
            };
            if known != Known::Out {
                found.push((known, level, from, to));
            }
            if known == Known::In {
                break;
            }
        }
        found
    }

    /// What a place among four texels may be off by the weights' rounding.
    pub(super) fn square_off(&self) -> f64 {
        if self.settings.filter == TextureFilter::Nearest { 0.0 } else { self.weight_off() }
    }

    /// Calls `visit` with the items of the texels that a pixel may read.
    pub(super) fn items(&self, look: &Look, tiles: &Tiles, visit: &mut dyn FnMut(&[u32])) {
        let mut last = None;
        for probes in self.probes(look) {
            let (first, end) = self.levels_read(&probes);
            self.places(look, probes.count, &mut |at, noise| {
                for level in first..=end {
                    for (_, level, from, to) in self.at_hand(look, (at, noise), level) {
                        let (columns, rows) =
                            (from[0]..=to[0].min(from[0] + 3), from[1]..=to[1].min(from[1] + 3));
                        for (column, row) in
                            rows.flat_map(|row| columns.clone().map(move |column| (column, row)))
                        {
                            let (key, [c, r]) = self.tile_of(level, column, row);
                            let Some(tile) = tiles.get(&key) else { continue };
                            let (set, items) = tile.items_at(c, r);
                            if last != Some((key, set)) {
                                visit(items);
                                last = Some((key, set));
                            }
                        }
                    }
                }
            });
        }
    }

    pub(super) fn tile_of(&self, level: u32, column: i64, row: i64) -> (Key, [usize; 2]) {
        let tile = i64::from(TILE_TEXELS);
        let (column, row) = (self.clamped(level, column), self.clamped(level, row));
        (
            (level, (column / tile) as u32, (row / tile) as u32),
            [(column % tile) as usize, (row % tile) as usize],
        )
    }
}

/// Where a probe reads in a level, texels from its corner.
pub(super) struct Place {
    pub(super) at: Texel,
    pub(super) ways: [DVec2; 3],
    /// How far it may lie elsewhere along each axis apart from the ways.
    pub(super) off: f64,
    /// How far in all.
    pub(super) reach: DVec2,
}

impl Place {
    pub(super) fn of(look: &Look, (at, noise): (Texel, f64), level: u32, rounding: f64) -> Self {
        let scale = 1.0 / (1u64 << level) as f64;
        let ways = look.ways.map(|way| way * scale);
        let off = noise * scale + rounding;
        let reach = ways.iter().map(|way| way.abs()).sum::<DVec2>() + DVec2::splat(off);
        Self { at: Texel::new(at.x * scale, at.y * scale), ways, off, reach }
    }

    /// The first and the last texel that it may read.
    pub(super) fn texels(&self, filter: TextureFilter) -> ([i64; 2], [i64; 2]) {
        let (half, more) = if filter == TextureFilter::Nearest { (0.0, 0) } else { (0.5, 1) };
        let at = [self.at.x - half, self.at.y - half];
        let reach = self.reach.to_array();
        let texel = |v: f64| v.floor() as i64;
        (
            std::array::from_fn(|k| texel(at[k] - reach[k])),
            std::array::from_fn(|k| texel(at[k] + reach[k]) + more),
        )
    }
}
