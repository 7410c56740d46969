//! Rasterizing a tile of the texture.
//!
//! Input: rings, strips of vertex pairs and segments in the texels of a level, each item with its paint. Output: a tile's texels. Three
//! ways for polygons: texel centres (`centres`), tiny-skia (`smooth`), exact areas (`exact`, `winding`, `pieces`); three for
//! line primitives (`line`, `prefilter`). With all but tiny-skia a tile has the bits of the same part of a larger tile. Refuses: nothing;
//! what lies outside the tile has no part in it.

mod canvas;
mod centres;
mod exact;
mod fixed;
mod lanes;
mod line;
mod mask;
mod pieces;
mod prefilter;
mod rows;
mod smooth;
mod sweep;
#[cfg(test)]
mod tests;
mod weight;
mod winding;

pub use canvas::Ink;
pub use pieces::Folded;

use super::tessellation::Pair;
use crate::scene::{Group, Rule};
use crate::space::Texel;
use crate::technique::clipmap::{LineFilter, LinePrimitives, Overlaps, PolygonRaster, TexelFormat};
use canvas::Canvas;
use centres::Centres;
use exact::{Accumulator, Rings};
use line::Segment;
use mask::Mask;
use prefilter::Table;
use rows::{ByRows, RowCoverage};
use smooth::Smooth;
use weight::Weight;
use winding::Texel as Winding;

/// A tile's place in its level.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TexelRect {
    /// Column and row of its first texel.
    pub origin: (i64, i64),
    /// Columns and rows.
    pub size: (usize, usize),
}

/// How tiles are rasterized.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RasterSettings {
    /// Polygons.
    pub polygons: PolygonRaster,
    /// Line primitives.
    pub lines: LinePrimitives,
    /// What prefiltered lines are filtered with.
    pub line_filter: LineFilter,
    /// What happens where an item covers a texel twice.
    pub overlaps: Overlaps,
    /// What a texel holds.
    pub texel: TexelFormat,
}

/// A polygon, or the polygon that an outline is cut to.
#[derive(Debug, Clone, Copy)]
pub struct Area<'a> {
    /// Its rings; the last vertex is followed by the first.
    pub rings: &'a [&'a [Texel]],
    /// What is inside.
    pub rule: Rule,
    /// Whether its winding numbers are known to be 0 and 1 (rings turn counter-clockwise on the map around what is inside).
    pub is_simple: bool,
}

/// What a stroke is cut to.
#[derive(Debug, Clone, Copy)]
pub struct Cut<'a> {
    /// A polygon.
    pub area: Area<'a>,
    /// Whether its inside is kept, or its outside.
    pub keeps_inside: bool,
}

/// Draws a tile, item after item.
#[derive(Debug)]
pub struct TileRaster {
    settings: RasterSettings,
    canvas: Canvas,
    /// The group that is being drawn, and the texels before it.
    group: Option<(Group, Vec<[f32; 4]>)>,
    /// Fills and the polygons of lines.
    polygons: Polygons,
    /// The polygon that a stroke is cut to.
    cut: Polygons,
    /// The rectangles of smooth line primitives.
    rectangles: Accumulator,
    /// The texels of other line primitives.
    mask: Mask,
    place: TexelRect,
    table: Option<(f64, Table)>,
    rows: Rows,
    ring: Vec<Texel>,
}

/// Where a stroke's parts are blended one after another, each is cut in each of its texels: with more edges of the polygon in a texel than
/// this, by the polygon's share of it alone, or coarse levels of long outlines would take minutes.
const MOST_CUT_EDGES: usize = 64;

/// Rows that are used again.
#[derive(Debug, Default)]
struct Rows {
    stroke: RowCoverage,
    /// What is inside of the polygon that the item at hand is cut to; `None`: not asked for yet.
    cut: Vec<Option<RowCoverage>>,
    /// Of rows of items before.
    spare: Vec<RowCoverage>,
    winding: Winding,
}

/// What a stroke's coverage comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Source {
    Polygons,
    Rectangles,
    Mask,
}

impl TileRaster {
    /// An empty tile.
    pub fn new(place: TexelRect, settings: RasterSettings) -> Self {
        Self {
            settings,
            canvas: Canvas::new(place.size, settings.texel),
            group: None,
            polygons: Polygons::new(place, settings.polygons, false),
            cut: Polygons::new(place, settings.polygons, true),
            rectangles: Accumulator::new(place.origin, place.size, false),
            mask: Mask::new(place.size),
            place,
            table: None,
            rows: Rows::default(),
            ring: Vec::new(),
        }
    }

    /// A row of texels, from the north: premultiplied paint.
    pub fn row(&self, row: usize) -> &[[f32; 4]] {
        self.canvas.row(row)
    }

    /// All texels, rows from the north.
    #[cfg(test)]
    fn texels(&self) -> Vec<[f32; 4]> {
        (0..self.place.size.1).flat_map(|row| self.row(row)).copied().collect()
    }

    /// Begins to draw a group, or none: what was drawn of another is mixed with what lies below it.
    pub fn enter(&mut self, group: Option<Group>) {
        if self.group.as_ref().map(|(open, _)| *open) == group {
            return;
        }
        if let Some((done, before)) = self.group.take() {
            self.canvas.mix(&before, done.opacity as f32);
        }
        self.group = group.map(|group| (group, self.canvas.texels().to_vec()));
    }

    /// Starts another tile of the same size.
    pub fn start(&mut self, origin: (i64, i64)) {
        self.place.origin = origin;
        self.canvas.clear();
        self.group = None;
        self.polygons.move_to(origin);
        self.cut.move_to(origin);
        self.rectangles.move_to(origin);
    }

    /// Whether nothing is left of the items that were drawn.
    #[cfg(test)]
    fn is_idle(&self) -> bool {
        let is_empty = |polygons: &Polygons| match polygons {
            Polygons::Exact(accumulator) => accumulator.is_empty(),
            Polygons::Aliased(_) | Polygons::Smooth(_) => true,
        };
        is_empty(&self.polygons) && self.rectangles.is_empty()
    }

    /// Fills a polygon.
    pub fn fill(&mut self, area: &Area, ink: &Ink) {
        self.polygons.polygon(area);
        self.blend_item(Source::Polygons, Weight::Rule(area.rule), None, ink);
    }

    /// Fills the strips of a tessellated line, all of them one item.
    pub fn strips<'p>(
        &mut self,
        strips: impl Iterator<Item = &'p [Pair<Texel>]>,
        folded: Folded,
        cut: Option<&Cut>,
        ink: &Ink,
    ) {
        self.start_cut(cut);
        self.polygons.start(Rings::Pieces);
        for strip in strips {
            pieces::of_strip(strip, folded, &mut self.ring, &mut |ring| self.polygons.ring(ring));
        }
        self.blend_stroke(Source::Polygons, cut, ink);
    }

    /// Draws segments as line primitives of a width in texels, all of them one item.
    pub fn segments(
        &mut self,
        segments: impl Iterator<Item = [Texel; 2]>,
        width: f64,
        cut: Option<&Cut>,
        ink: &Ink,
    ) {
        let source = match self.settings.lines {
            LinePrimitives::Coverage => Source::Rectangles,
            LinePrimitives::Plain | LinePrimitives::Prefiltered => Source::Mask,
        };
        let is_each_blended = self.settings.overlaps == Overlaps::Blend;
        self.start_cut(cut);
        self.rectangles.start(Rings::Pieces);
        for segment in segments {
            self.segment(segment, width);
            if is_each_blended {
                self.blend_stroke(source, cut, ink);
                self.rectangles.start(Rings::Pieces);
            }
        }
        if !is_each_blended {
            self.blend_stroke(source, cut, ink);
        }
    }

    fn segment(&mut self, [from, to]: [Texel; 2], width: f64) {
        let segment = Segment { from, to, origin: self.place.origin };
        match self.settings.lines {
            LinePrimitives::Plain => line::plain(&segment, width, &mut self.mask),
            LinePrimitives::Coverage => {
                let Some(along) = (to - from).try_normalize() else { return };
                let aside = along.perp() * (0.5 * width);
                // y points south: counter-clockwise on the map.
                self.rectangles.ring(&[from + aside, to + aside, to + -aside, from + -aside]);
            }
            LinePrimitives::Prefiltered => {
                let table = match &mut self.table {
                    Some((known, table)) if *known == width => table,
                    other => &mut other.insert((width, Table::new(self.settings.line_filter, width))).1,
                };
                line::prefiltered(&segment, table, &mut self.mask);
            }
        }
    }

    /// Rasterizes the polygon that an item is cut to: once, however many parts the item has.
    fn start_cut(&mut self, cut: Option<&Cut>) {
        let Some(cut) = cut else { return };
        self.cut.polygon(&cut.area);
        self.rows.spare.extend(self.rows.cut.drain(..).flatten());
        self.rows.cut.resize(self.place.size.1, None);
    }

    /// Blends the stroke that has been collected.
    fn blend_stroke(&mut self, source: Source, cut: Option<&Cut>, ink: &Ink) {
        let weight = match self.settings.overlaps {
            Overlaps::Once => Weight::UNION,
            Overlaps::Blend => Weight::Layers { alpha: (!ink.adds()).then(|| ink.alpha()) },
        };
        self.blend_item(source, weight, cut, ink);
    }

    /// Blends an item that has been collected.
    fn blend_item(&mut self, source: Source, weight: Weight, cut: Option<&Cut>, ink: &Ink) {
        match (source, &mut self.polygons, cut) {
            (Source::Polygons, Polygons::Exact(item), None) => {
                return self.canvas.blend_item(&mut **item, weight, ink);
            }
            (Source::Polygons, Polygons::Aliased(item), None) => {
                return self.canvas.blend_item(item, weight, ink);
            }
            (Source::Rectangles, _, None) => {
                return self.canvas.blend_item(&mut self.rectangles, weight, ink);
            }
            (Source::Polygons, Polygons::Smooth(_), None) | (Source::Mask, _, None) | (_, _, Some(_)) => {}
        }
        let rows = match source {
            Source::Polygons => self.polygons.rows(),
            Source::Rectangles => self.rectangles.rows(),
            Source::Mask => self.mask.rows(),
        };
        for row in rows {
            let stroke = &mut self.rows.stroke;
            let has_part = match source {
                Source::Polygons => self.polygons.take_row(row, weight, stroke),
                Source::Rectangles => self.rectangles.take_coverage(row, weight, stroke),
                Source::Mask => self.mask.take_row(row, stroke),
            };
            if !has_part {
                continue;
            }
            if let Some(cut) = cut {
                self.cut_row(row, source, weight, cut);
            }
            self.canvas.blend(row, &self.rows.stroke, ink);
        }
    }

    /// Cuts a row of a stroke to what is inside or outside of a polygon.
    fn cut_row(&mut self, row: usize, source: Source, weight: Weight, cut: &Cut) {
        let Rows { stroke, cut: inside, spare, winding } = &mut self.rows;
        let rule = cut.area.rule;
        let inside = inside[row].get_or_insert_with(|| {
            let mut coverage = spare.pop().unwrap_or_default();
            if !self.cut.take_row(row, Weight::Rule(rule), &mut coverage) {
                coverage.coverage.clear();
            }
            coverage
        });
        let pieces = match (source, &mut self.polygons) {
            (Source::Polygons, Polygons::Exact(pieces)) => Some(&mut **pieces),
            (Source::Rectangles, _) => Some(&mut self.rectangles),
            _ => None,
        };
        let area = match &mut self.cut {
            Polygons::Exact(area) => Some(area),
            _ => None,
        };
        let mut both = pieces.zip(area);
        let is_each_blended = matches!(weight, Weight::Layers { .. });
        for (k, share) in stroke.coverage.iter_mut().enumerate() {
            let column = stroke.first + k;
            let covered = column.checked_sub(inside.first).and_then(|k| inside.coverage.get(k));
            let covered = covered.copied().unwrap_or(0.0);
            let is_partial = *share != 0.0 && *share != 1.0 && covered > 0.0 && covered < 1.0;
            match &mut both {
                // Only together do they say what they share.
                Some((pieces, area)) if is_partial => {
                    winding.clear([0, 0]);
                    area.gather(row, column, [0, 1], winding);
                    if is_each_blended && winding.fragments.len() > MOST_CUT_EDGES {
                        *share *= if cut.keeps_inside { covered } else { 1.0 - covered };
                        continue;
                    }
                    pieces.gather(row, column, [1, 0], winding);
                    let mut sum = 0.0;
                    winding.areas(&|_| false, &mut |[stroke, polygon], area| {
                        if rule.contains(polygon) == cut.keeps_inside {
                            sum += weight.of(stroke) * area;
                        }
                    });
                    *share = sum as f32;
                }
                _ => *share *= if cut.keeps_inside { covered } else { 1.0 - covered },
            }
        }
    }
}

/// Polygons, by one of three ways.
#[derive(Debug)]
enum Polygons {
    Aliased(Centres),
    Smooth(Smooth),
    Exact(Box<Accumulator>),
}

impl Polygons {
    fn new(TexelRect { origin, size }: TexelRect, way: PolygonRaster, keeps_edges: bool) -> Self {
        match way {
            PolygonRaster::Aliased => Self::Aliased(Centres::new(origin, size)),
            PolygonRaster::TinySkia => Self::Smooth(Smooth::new(origin, size)),
            PolygonRaster::Exact => Self::Exact(Box::new(Accumulator::new(origin, size, keeps_edges))),
        }
    }

    fn move_to(&mut self, origin: (i64, i64)) {
        match self {
            Self::Aliased(centres) => centres.move_to(origin),
            Self::Smooth(smooth) => smooth.move_to(origin),
            Self::Exact(accumulator) => accumulator.move_to(origin),
        }
    }

    fn start(&mut self, rings: Rings) {
        match self {
            Self::Aliased(centres) => centres.start(),
            Self::Smooth(smooth) => smooth.start(),
            Self::Exact(accumulator) => accumulator.start(rings),
        }
    }

    fn ring(&mut self, ring: &[Texel]) {
        match self {
            Self::Aliased(centres) => centres.ring(ring),
            Self::Smooth(smooth) => smooth.ring(ring),
            Self::Exact(accumulator) => accumulator.ring(ring),
        }
    }

    /// Starts an item that is a polygon.
    fn polygon(&mut self, area: &Area) {
        self.start(if area.is_simple { Rings::Simple } else { Rings::Any });
        area.rings.iter().for_each(|ring| self.ring(ring));
    }

    fn rows(&self) -> std::ops::Range<usize> {
        match self {
            Self::Aliased(centres) => centres.rows(),
            Self::Smooth(smooth) => smooth.rows(),
            Self::Exact(accumulator) => accumulator.rows(),
        }
    }

    fn take_row(&mut self, row: usize, weight: Weight, out: &mut RowCoverage) -> bool {
        match self {
            Self::Aliased(centres) => centres.take_coverage(row, weight, out),
            Self::Smooth(smooth) => smooth.take_row(row, weight, out),
            Self::Exact(accumulator) => accumulator.take_coverage(row, weight, out),
        }
    }
}
