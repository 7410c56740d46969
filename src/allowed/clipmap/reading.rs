//! Reading the texture: what a pixel may find there.
//!
//! A mean of texels is affine in each texel, each level's share and, within four texels, nearly so in the place. What may stray is the same for all probes of a
//! pixel (a shift of the picture, of the depth), or differs from probe to probe (the weights' rounding): the first moves all of them together, so that its
//! effects are summed before their sizes are taken ([`Reading`]).

use super::reader::{Place, Probes, Reader, Tiles};
use super::surface::Look;
use crate::certainty::{Known, PaintRange};
use crate::math;
use crate::scene::BlendMode;
use crate::space::Texel;
use crate::technique::clipmap::TextureFilter;
use glam::DVec2;

/// Places that stray farther than this, in texels of a level, may find anything there.
const FARTHEST: f64 = 12.0;

/// How sums in single precision may be rounded.
const SUMS: f64 = 1e-5;

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

/// What a pixel may find, composed over its ground: one range, or few.
pub(super) fn read(reader: &Reader, look: &Look, tiles: &Tiles) -> Vec<PaintRange> {
    let middle: [f64; 4] = std::array::from_fn(|k| 0.5 * (look.ground.low[k] + look.ground.high[k]));
    let scene = Scene { reader, look, tiles, ground: middle };
    let mut found: Vec<PaintRange> = Vec::new();
    for probes in reader.probes(look) {
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
