//! One pixel: where it reads the texture, and the paint that it finds there.

use super::sampling::{Probes, Quad, Sampler};
use super::step::Step;
use super::table::Table;
use super::texture::{TileKey, VirtualTexture};
use crate::canvas::{Backdrop, LastGround, Record};
use crate::resolve::Paint;
use crate::space::{Plan, ViewFrame};
use crate::terrain::{Mesh, SKY};
use crate::visibility::{FootprintPlane, Sight};

/// A tile that no pixel has.
pub(super) const NO_TILE: TileKey = TileKey { level: u32::MAX, row: 0, column: 0 };

/// Everything that pixels are made from but the tiles.
pub(super) struct PixelPainter<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) view: &'a ViewFrame,
    pub(super) texture: VirtualTexture,
    /// What the pixels' centres see.
    pub(super) sight: Sight<'a>,
    pub(super) sampler: Sampler,
    pub(super) backdrop: Backdrop<'a>,
}

/// What a pixel sees, and where it reads the texture.
#[derive(Clone, Copy)]
pub(super) struct Reading {
    triangle: u32,
    plan: Plan,
    pub(super) probes: Probes,
}

/// The triangle whose plane was asked for last: neighbours often see the same.
pub(super) type LastPlane<'a> = Option<(u32, Option<FootprintPlane<'a>>)>;

impl<'a> PixelPainter<'a> {
    /// Where a pixel whose centre sees a plan point reads the texture; `None`: it sees the sky.
    #[inline(always)]
    pub(super) fn reading(
        &self,
        (x, y): (usize, usize),
        plan: Plan,
        last: &mut LastPlane<'a>,
        record: &mut impl Record<Step>,
    ) -> Option<Reading> {
        let triangle = self.sight.triangle(x, y);
        if triangle == SKY || !plan.is_finite() {
            record.step(|| Step::Sky);
            return None;
        }
        record.step(|| Step::Seen { triangle, plan });
        if last.as_ref().is_none_or(|(of, _)| *of != triangle) {
            let seen = self.mesh.surface_triangle(triangle);
            *last = Some((triangle, seen.map(|seen| FootprintPlane::new(self.view, &seen))));
        }
        let at = self.sight.lattice().at(x, y);
        let footprint = last.as_ref().and_then(|(_, plane)| plane.as_ref()?.footprint(at));
        let probes = self.sampler.probes(plan, footprint.as_ref());
        record.step(|| {
            let Probes { level, first, step, count } = probes;
            Step::Probes { level, count, first, step }
        });
        Some(Reading { triangle, plan, probes })
    }

    /// Calls `visit` with the tiles that a pixel reads, some of them several times; returns whether it reads a coarser level than it
    /// asks for.
    #[inline(always)]
    pub(super) fn tiles(
        &self,
        reading: &Reading,
        mut visit: impl FnMut(TileKey),
        record: &mut impl Record<Step>,
    ) -> bool {
        let mut is_coarser = false;
        self.sampler.quads(&reading.probes, &mut |quad| {
            is_coarser |= quad.is_fallback;
            record.step(|| Step::Level { level: quad.level, is_fallback: quad.is_fallback });
            let tiles = self.sampler.tiles_of(&quad);
            for row in tiles.rows.0..=tiles.rows.1 {
                for column in tiles.columns.0..=tiles.columns.1 {
                    visit(TileKey { level: quad.level, row, column });
                }
            }
        });
        is_coarser
    }

    /// A pixel's paint, and how many texels it reads; `last` is the ground of the pixel before.
    #[inline(always)]
    pub(super) fn paint(
        &self,
        reading: &Reading,
        table: &Table,
        last: &mut LastGround,
        record: &mut impl Record<Step>,
    ) -> (Paint, u32) {
        let ground = self.backdrop.paint_at(last, reading.triangle, || reading.plan);
        let (texture, texels) = self.texture_at(&reading.probes, table, record);
        let paint = self.backdrop.compositor.over(ground, texture);
        record.step(|| Step::Texture(texture));
        record.step(|| Step::Ground(ground));
        record.step(|| Step::Composed(paint));
        (paint, texels)
    }

    /// The finest tile that a pixel reads at its centre.
    pub(super) fn shown_tile(&self, reading: &Reading, table: &Table) -> TileKey {
        let mut finest: Option<Quad> = None;
        self.sampler.quads(&reading.probes, &mut |quad| {
            finest = Some(finest.filter(|known| known.level <= quad.level).unwrap_or(quad));
        });
        let finest = finest.map_or(0, |quad| quad.level);
        let tile_of = |level: u32| {
            let texel = self.texture.texel(level, reading.plan);
            self.sampler.tile_of(level, texel.x.floor() as i64, texel.y.floor() as i64).0
        };
        // Where only probes aside read the finest level, the middle's tile is coarser.
        let levels = finest..self.texture.levels();
        levels.map(tile_of).find(|key| table.get(*key).is_some()).unwrap_or(NO_TILE)
    }

    /// The texture's paint where a pixel reads it, and how many texels it reads.
    #[inline(always)]
    fn texture_at(&self, probes: &Probes, table: &Table, record: &mut impl Record<Step>) -> (Paint, u32) {
        let (mut sum, mut texels) = ([0.0; 4], 0);
        let mut add = |tile: TileKey, at: (usize, usize), value: [f32; 4], weight: f64| {
            for k in 0..4 {
                sum[k] += weight * f64::from(value[k]);
            }
            record.step(|| Step::Texel { tile, at, plan: self.texture.centre_of(tile, at), weight, value });
        };
        self.sampler.quads(probes, &mut |Quad { level, at: (column, row), shares, weight, .. }| {
            let (key, (c, r)) = self.sampler.tile_of(level, column, row);
            let Some((east, south)) = shares else {
                texels += 1;
                table.get(key).into_iter().for_each(|tile| add(key, (c, r), tile.at(c, r), weight));
                return;
            };
            texels += 4;
            let weights = [
                weight * (1.0 - east) * (1.0 - south),
                weight * east * (1.0 - south),
                weight * (1.0 - east) * south,
                weight * east * south,
            ];
            // Mostly all four lie in one tile, away from the texture's rim.
            if column >= 0
                && row >= 0
                && let Some(tile) = table.get(key)
                && c + 1 < tile.size
                && r + 1 < tile.size
            {
                let places = [(c, r), (c + 1, r), (c, r + 1), (c + 1, r + 1)];
                let read = places.into_iter().zip(weights);
                read.for_each(|((c, r), weight)| add(key, (c, r), tile.at(c, r), weight));
                return;
            }
            for ((dx, dy), weight) in [(0, 0), (1, 0), (0, 1), (1, 1)].into_iter().zip(weights) {
                let (key, (c, r)) = self.sampler.tile_of(level, column + dx, row + dy);
                table.get(key).into_iter().for_each(|tile| add(key, (c, r), tile.at(c, r), weight));
            }
        });
        (Paint(sum), texels)
    }
}
