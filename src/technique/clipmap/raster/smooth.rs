//! Polygons anti-aliased by tiny-skia.

use super::fixed::without_far;
use super::rows::RowCoverage;
use super::weight::Weight;
use crate::scene::Rule;
use crate::space::Texel;
use std::ops::Range;
use tiny_skia::{FillRule, Mask, PathBuilder, Transform};

/// How far around a tile's first texel paths may reach: single precision resolves a 256th of a texel there.
const REACH: f64 = 32_768.0;

/// An item's path, and its mask once it is asked for.
#[derive(Debug)]
pub(super) struct Smooth {
    origin: (i64, i64),
    size: (usize, usize),
    path: PathBuilder,
    /// West, north, east, south of the path, texels of the tile.
    bounds: [f64; 4],
    mask: Option<Mask>,
    ring: Vec<Texel>,
    near: Vec<Texel>,
}

const EMPTY: [f64; 4] = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];

impl Smooth {
    /// A tile whose first texel is `origin`.
    pub(super) fn new(origin: (i64, i64), size: (usize, usize)) -> Self {
        let path = PathBuilder::new();
        Self { origin, size, path, bounds: EMPTY, mask: None, ring: Vec::new(), near: Vec::new() }
    }

    /// Moves to another tile of the same size.
    pub(super) fn move_to(&mut self, origin: (i64, i64)) {
        self.start();
        self.origin = origin;
    }

    /// Starts an item.
    pub(super) fn start(&mut self) {
        self.path.clear();
        self.bounds = EMPTY;
        self.mask = None;
    }

    /// The rows that the item may have a part in.
    pub(super) fn rows(&self) -> Range<usize> {
        let [_, rows] = self.window();
        rows
    }

    /// Adds a ring.
    pub(super) fn ring(&mut self, ring: &[Texel]) {
        let local = |p: &Texel| Texel::new(p.x - self.origin.0 as f64, p.y - self.origin.1 as f64);
        self.ring.clear();
        self.ring.extend(ring.iter().map(local));
        let near = without_far(&self.ring, REACH, &mut self.near);
        for (k, p) in near.iter().enumerate() {
            let (x, y) = (p.x as f32, p.y as f32);
            if k == 0 {
                self.path.move_to(x, y)
            } else {
                self.path.line_to(x, y)
            }
            let [west, north, east, south] = self.bounds;
            self.bounds = [
                crate::math::min(p.x, west),
                crate::math::min(p.y, north),
                crate::math::max(p.x, east),
                crate::math::max(p.y, south),
            ];
        }
        if !near.is_empty() {
            self.path.close();
        }
    }

    /// Columns and rows of the tile around the path.
    fn window(&self) -> [Range<usize>; 2] {
        let [west, north, east, south] = self.bounds;
        let range = |low: f64, high: f64, size: usize| {
            // Casts saturate; an empty path has no columns.
            let (low, high) = (low.floor() as usize, (high.ceil() as usize).min(size));
            low.min(high)..high
        };
        [range(west, east, self.size.0), range(north, south, self.size.1)]
    }

    /// The coverage of a row. False where the item has no part in it.
    pub(super) fn take_row(&mut self, row: usize, weight: Weight, out: &mut RowCoverage) -> bool {
        out.coverage.clear();
        let [columns, rows] = self.window();
        if columns.is_empty() || !rows.contains(&row) {
            return false;
        }
        if self.mask.is_none() {
            self.mask = self.draw(&columns, &rows, weight);
        }
        let Some(mask) = &self.mask else { return false };
        let start = (row - rows.start) * columns.len();
        out.first = columns.start;
        out.coverage.extend(mask.data()[start..start + columns.len()].iter().map(|v| f32::from(*v) / 255.0));
        true
    }

    /// The mask of the path's window; `None` where it has no texels.
    fn draw(&mut self, columns: &Range<usize>, rows: &Range<usize>, weight: Weight) -> Option<Mask> {
        let mut mask = Mask::new(columns.len() as u32, rows.len() as u32)?;
        let rule = match weight {
            Weight::Rule(Rule::EvenOdd) => FillRule::EvenOdd,
            Weight::Rule(Rule::NonZero) | Weight::Layers { .. } => FillRule::Winding,
        };
        if let Some(path) = std::mem::take(&mut self.path).finish() {
            let moved = Transform::from_translate(-(columns.start as f32), -(rows.start as f32));
            mask.fill_path(&path, rule, true, moved);
        }
        Some(mask)
    }
}
