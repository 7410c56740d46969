//! Reading the texture: what a pixel may find there.
//!
//! A mean of texels is affine in each texel, each level's share and, within four texels, nearly so in the place. What may stray is the same for all probes of a
//! pixel (a shift of the picture, of the depth), or differs from probe to probe (the weights' rounding): the first moves all of them together, so that its
//! effects are summed before their sizes are taken ([`Reading`]).

use super::surface::Look;
use super::texels::Tile;
use super::texture::{Key, Texture, Window};
use crate::certainty::{Known, PaintRange};
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

/// Places that stray farther than this, in texels of a level, may find anything there.
const FARTHEST: f64 = 12.0;

/// How sums in single precision may be rounded.
const SUMS: f64 = 1e-5;

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

/// What is read, as it changes with the three ways in which the place may stray.
#[derive(Debug, Clone, Copy)]
struct Reading {
    low: [f64; 4],
    high: [f64; 4],
    /// How the least and the most change along each way.
    low_by: [[f64; 4]; 3],
    high_by: [[f64; 4]; 3],
    /// What else they may be off.
    off: [f64; 4],
}

/// The probes of a pixel.
#[derive(Debug, Clone, Copy)]
struct Probes {
    count: u32,
    /// The level, at least and at most.
    levels: [f64; 2],
}

impl Reading {
    const NOTHING: Self =
        Self { low: [0.0; 4], high: [0.0; 4], low_by: [[0.0; 4]; 3], high_by: [[0.0; 4]; 3], off: [0.0; 4] };
    const ANY: Self = Self { high: [1.0; 4], ..Self::NOTHING };

    fn add(&mut self, other: &Self, share: f64) {
        for k in 0..4 {
            self.low[k] += share * other.low[k];
            self.high[k] += share * other.high[k];
            self.off[k] += share * other.off[k];
            for way in 0..3 {
                self.low_by[way][k] += share * other.low_by[way][k];
                self.high_by[way][k] += share * other.high_by[way][k];
            }
        }
    }

    fn range(&self) -> PaintRange {
        let by = |ways: &[[f64; 4]; 3], k: usize| ways.iter().map(|way| way[k].abs()).sum::<f64>();
        PaintRange {
            low: std::array::from_fn(|k| self.low[k] - by(&self.low_by, k) - self.off[k]),
            high: std::array::from_fn(|k| self.high[k] + by(&self.high_by, k) + self.off[k]),
        }
    }

    fn of_range(range: &PaintRange) -> Self {
        Self { low: range.low, high: range.high, ..Self::NOTHING }
    }
}

impl Reader<'_> {
    fn coarsest(&self) -> u32 {
        self.texture.levels() - 1
    }

    /// What a weight may be off.
    fn weight_off(&self) -> f64 {
        WEIGHT_STEPS / f64::from(1u32 << self.filter_bits)
    }

    /// The numbers of probes that a pixel may take, each with its levels.
    fn probes(&self, look: &Look) -> Vec<Probes> {
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
    fn places(&self, look: &Look, count: u32, visit: &mut dyn FnMut(Texel, f64)) {
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
    fn levels_read(&self, probes: &Probes) -> (u32, u32) {
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
    fn rounded(&self, probes: &Probes) -> [f64; 2] {
        let [low, high] = probes.levels;
        let off = self.weight_off();
        [math::max(low - off, 0.0), math::min(high + off, f64::from(self.coarsest()))]
    }

    /// The texels that a place may read where a level is asked for: whether of this level, the level, and the first and the last. The last entry is sure if none before
    /// is.
    fn at_hand(
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
    fn square_off(&self) -> f64 {
        if self.settings.filter == TextureFilter::Nearest { 0.0 } else { self.weight_off() }
    }

    /// What a pixel may find, composed over its ground: one range, or few.
    pub(super) fn read(&self, look: &Look, tiles: &Tiles) -> Vec<PaintRange> {
        let middle: [f64; 4] = std::array::from_fn(|k| 0.5 * (look.ground.low[k] + look.ground.high[k]));
        let scene = Scene { reader: self, look, tiles, ground: middle };
        let mut found: Vec<PaintRange> = Vec::new();
        for probes in self.probes(look) {
            found.extend(scene.read(&probes));
        }
        for range in &mut found {
            for k in 0..4 {
                let off = SUMS + 0.5 * (look.ground.high[k] - look.ground.low[k]);
                range.low[k] = math::max(range.low[k] - off, 0.0);
                range.high[k] = math::min(range.high[k] + off, 1.0);
            }
        }
        found
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

    fn tile_of(&self, level: u32, column: i64, row: i64) -> (Key, [usize; 2]) {
        let tile = i64::from(TILE_TEXELS);
        let (column, row) = (self.clamped(level, column), self.clamped(level, row));
        (
            (level, (column / tile) as u32, (row / tile) as u32),
            [(column % tile) as usize, (row % tile) as usize],
        )
    }
}

/// Where a probe reads in a level, texels from its corner.
struct Place {
    at: Texel,
    ways: [DVec2; 3],
    /// How far it may lie elsewhere along each axis apart from the ways.
    off: f64,
    /// How far in all.
    reach: DVec2,
}

impl Place {
    fn of(look: &Look, (at, noise): (Texel, f64), level: u32, rounding: f64) -> Self {
        let scale = 1.0 / (1u64 << level) as f64;
        let ways = look.ways.map(|way| way * scale);
        let off = noise * scale + rounding;
        let reach = ways.iter().map(|way| way.abs()).sum::<DVec2>() + DVec2::splat(off);
        Self { at: Texel::new(at.x * scale, at.y * scale), ways, off, reach }
    }

    /// The first and the last texel that it may read.
    fn texels(&self, filter: TextureFilter) -> ([i64; 2], [i64; 2]) {
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

/// A pixel being read.
struct Scene<'a> {
    reader: &'a Reader<'a>,
    look: &'a Look,
    tiles: &'a Tiles,
    ground: [f64; 4],
}

impl Scene<'_> {
    fn read(&self, probes: &Probes) -> Vec<PaintRange> {
        let reader = self.reader;
        let (first, last) = reader.levels_read(probes);
        match reader.settings.filter {
            TextureFilter::Nearest => (first..=last).flat_map(|level| self.nearest(level)).collect(),
            TextureFilter::Bilinear => (first..=last)
                .map(|level| self.square((self.look.at, self.look.noise), level).0.range())
                .collect(),
            TextureFilter::Trilinear | TextureFilter::Anisotropic => vec![self.between(probes)],
        }
    }

    /// The mean of probes between two levels.
    fn between(&self, probes: &Probes) -> PaintRange {
        let [low, high] = self.reader.rounded(probes);
        let share = 1.0 / f64::from(probes.count);
        let mut all: Option<PaintRange> = None;
        for fine in low as u32..=high as u32 {
            let (mut of_fine, mut of_coarse) = (Reading::NOTHING, Reading::NOTHING);
            self.reader.places(self.look, probes.count, &mut |at, noise| {
                let (fine_reading, is_fallback) = self.square((at, noise), fine);
                let is_last = fine >= self.reader.coarsest();
                let coarse_reading = match (is_last, is_fallback) {
                    (true, _) | (_, Known::In) => fine_reading,
                    (_, Known::Out) => self.square((at, noise), fine + 1).0,
                    (_, Known::Open) => {
                        let coarse = self.square((at, noise), fine + 1).0;
                        Reading::of_range(&coarse.range().hull(&fine_reading.range()))
                    }
                };
                of_fine.add(&fine_reading, share);
                of_coarse.add(&coarse_reading, share);
            });
            let within = |level: f64| (level - f64::from(fine)).clamp(0.0, 1.0);
            for coarse in [within(low), within(high)] {
                let mut mixed = Reading::NOTHING;
                mixed.add(&of_fine, 1.0 - coarse);
                mixed.add(&of_coarse, coarse);
                let range = mixed.range();
                all = Some(all.map_or(range, |all| all.hull(&range)));
            }
        }
        all.unwrap_or(PaintRange::ANY)
    }

    /// Each texel that may be the nearest.
    fn nearest(&self, level: u32) -> Vec<PaintRange> {
        let mut found = Vec::new();
        for (_, level, from, to) in self.reader.at_hand(self.look, (self.look.at, self.look.noise), level) {
            if (to[0] - from[0]).max(to[1] - from[1]) as f64 > FARTHEST {
                return vec![PaintRange::ANY];
            }
            for row in from[1]..=to[1] {
                for column in from[0]..=to[0] {
                    let [low, high] = self.texel(level, column, row);
                    let range = PaintRange { low, high };
                    if !found.contains(&range) {
                        found.push(range);
                    }
                }
            }
        }
        found
    }

    /// Four texels around a place, of the first level from one on that is at hand; whether of a coarser one.
    fn square(&self, place: (Texel, f64), level: u32) -> (Reading, Known) {
        let found = self.reader.at_hand(self.look, place, level);
        let is_fallback = match found[..] {
            [(_, only, ..)] => Known::of(only != level),
            [(_, first, ..), ..] if first != level => Known::In,
            _ => Known::Open,
        };
        let mut readings = found.iter().map(|(_, level, ..)| self.square_of(place, *level));
        let first = readings.next().unwrap_or(Reading::ANY);
        let rest: Vec<Reading> = readings.collect();
        let all = match rest.is_empty() {
            true => first,
            false => {
                let hull = rest.iter().fold(first.range(), |all, one| all.hull(&one.range()));
                Reading::of_range(&hull)
            }
        };
        (all, is_fallback)
    }

    fn square_of(&self, place: (Texel, f64), level: u32) -> Reading {
        let place = Place::of(self.look, place, level, self.reader.square_off());
        let (from, to) = place.texels(TextureFilter::Bilinear);
        let at = DVec2::new(place.at.x - 0.5, place.at.y - 0.5);
        let span = [to[0] - from[0], to[1] - from[1]];
        if span.iter().any(|span| *span as f64 > FARTHEST) || !place.reach.is_finite() {
            return Reading::ANY;
        }
        if span == [1, 1] {
            return self.within(&place, at, level, from);
        }
        // Over borders between squares: extremes lie at the ends and on the borders.
        let stops = |axis: usize| {
            let (v, reach) = (at.to_array()[axis], place.reach.to_array()[axis]);
            let inner = (from[axis] + 1..to[axis]).map(|border| border as f64);
            std::iter::once(v - reach).chain(inner).chain([v + reach]).collect::<Vec<f64>>()
        };
        let (mut low, mut high) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4]);
        let across = stops(0);
        for y in stops(1) {
            for x in &across {
                let (column, row) = (
                    x.floor().clamp(from[0] as f64, to[0] as f64 - 1.0),
                    y.floor().clamp(from[1] as f64, to[1] as f64 - 1.0),
                );
                let [least, most] = self.bilinear(level, [column as i64, row as i64], [x - column, y - row]);
                for k in 0..4 {
                    low[k] = math::min(low[k], least[k]);
                    high[k] = math::max(high[k], most[k]);
                }
            }
        }
        Reading { low, high, ..Reading::NOTHING }
    }

    fn corners(&self, level: u32, [column, row]: [i64; 2]) -> [[[f64; 4]; 2]; 4] {
        [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| self.texel(level, column + x, row + y))
    }

    fn bilinear(&self, level: u32, texel: [i64; 2], [x, y]: [f64; 2]) -> [[f64; 4]; 2] {
        let corners = self.corners(level, texel);
        let weights = [(1.0 - x) * (1.0 - y), x * (1.0 - y), (1.0 - x) * y, x * y];
        [0, 1].map(|end| {
            std::array::from_fn(|k| (0..4).map(|corner| weights[corner] * corners[corner][end][k]).sum())
        })
    }

    /// Within one square: with its slopes.
    fn within(&self, place: &Place, at: DVec2, level: u32, texel: [i64; 2]) -> Reading {
        let corners = self.corners(level, texel);
        let (x, y) = (at.x - texel[0] as f64, at.y - texel[1] as f64);
        let mut reading = Reading::NOTHING;
        for k in 0..4 {
            let mut off = 0.0;
            for end in 0..2 {
                let [a, b, c, d] = corners.map(|corner| corner[end][k]);
                let (east, south, bend) =
                    ((b - a) * (1.0 - y) + (d - c) * y, (c - a) * (1.0 - x) + (d - b) * x, a + d - b - c);
                let value = (a * (1.0 - x) + b * x) * (1.0 - y) + (c * (1.0 - x) + d * x) * y;
                let by = place.ways.map(|way| east * way.x + south * way.y);
                let own = (east.abs() + south.abs()) * place.off + bend.abs() * place.reach.x * place.reach.y;
                off = math::max(off, own);
                let (of, slopes) = match end {
                    0 => (&mut reading.low, &mut reading.low_by),
                    _ => (&mut reading.high, &mut reading.high_by),
                };
                of[k] = value;
                (0..3).for_each(|way| slopes[way][k] = by[way]);
            }
            reading.off[k] = off;
        }
        reading
    }

    /// A texel over the ground: the least and the most of each channel.
    fn texel(&self, level: u32, column: i64, row: i64) -> [[f64; 4]; 2] {
        let (key, [c, r]) = self.reader.tile_of(level, column, row);
        let Some(tile) = self.tiles.get(&key) else { return [[0.0; 4], [1.0; 4]] };
        let (mut low, mut high) = ([f64::INFINITY; 4], [f64::NEG_INFINITY; 4]);
        for corner in tile.at(c, r) {
            let keep = match self.reader.mode {
                BlendMode::Over => 1.0 - f64::from(corner[3]),
                BlendMode::Additive => 1.0,
            };
            for k in 0..4 {
                let v = f64::from(corner[k]) + self.ground[k] * keep;
                low[k] = math::min(low[k], v);
                high[k] = math::max(high[k], v);
            }
        }
        [low, high]
    }
}
