//! Drawing a tile: layers in order, thin lines as line primitives, the others as polygons, with what may be of each texel.

use super::count::{Windings, between};
use super::edges::{Edge, Outline};
use super::items::{Drawn, Items, Near, ROUND_TEXELS, StrokeStyle, Way};
use super::lines;
use super::share::share;
use super::texels::{Texels, Tile};
use super::texture::{Key, Texture};
use crate::certainty::Known;
use crate::draw_list::Side;
use crate::math;
use crate::resolve::Paint;
use crate::scene::{BlendMode, Rule};
use crate::space::{Plan, Texel};
use crate::technique::clipmap::{LinePrimitives, Overlaps, PolygonRaster, Settings, WideLines};

/// Fixed-point coordinates of exact areas, and roundings in single precision within a tile, texels.
const FIXED: f64 = 1.0 / (1 << 14) as f64;

/// What a stored vertex in single precision may be off, of its coordinates, after roundings of its tessellation.
const SINGLE: f64 = 4.0 / (1 << 24) as f64;

/// What a device's area of a texel may be off besides.
const AREA: f64 = 1.0 / 1024.0;

/// What all tiles are drawn from.
pub(super) struct TileMaker<'a> {
    pub(super) items: Items<'a>,
    pub(super) texture: Texture,
    pub(super) settings: Settings,
    pub(super) mode: BlendMode,
    /// How far a vertex may be snapped along each axis, texels.
    pub(super) snap: f64,
    /// The widest line primitive, texels.
    pub(super) widest: f64,
    /// The largest coordinate of the plan, metres.
    pub(super) extent: f64,
}

/// A tile being drawn.
struct Drawing<'a> {
    maker: &'a TileMaker<'a>,
    key: Key,
    size: usize,
    texel_m: f64,
    /// How far corners may lie elsewhere along each axis, texels.
    slack: f64,
}

/// What counts of a polygon's texel that is wound around so often.
#[derive(Clone, Copy)]
enum Weight {
    Inside(Rule),
    /// The union of pieces.
    Once,
    /// Each piece is blended; over all that lies below with an alpha, or added.
    Each(Option<f64>),
}

impl Weight {
    fn of(self, winding: i32) -> f64 {
        match self {
            Self::Inside(rule) => f64::from(u8::from(rule.contains(winding))),
            Self::Once => f64::from(u8::from(winding > 0)),
            Self::Each(None) => f64::from(winding.max(0)),
            // What so many layers hide, in layers.
            Self::Each(Some(alpha)) => {
                let step = |(sum, left): (f64, f64), _| (sum + left, left * (1.0 - alpha));
                (0..winding.clamp(0, 4096)).fold((0.0, 1.0), step).0
            }
        }
    }

    /// The least and the most between two windings.
    fn between(self, least: i32, most: i32) -> [f64; 2] {
        (least..=most.min(least.saturating_add(4096)))
            .map(|winding| self.of(winding))
            .fold([f64::INFINITY, 0.0], |[low, high], weight| {
                [math::min(low, weight), math::max(high, weight)]
            })
    }
}

impl TileMaker<'_> {
    /// Draws a tile.
    pub(super) fn make(&self, key: Key) -> Tile {
        let size = self.texture.tile_size(key.0);
        let texel_m = self.texture.texel_m(key.0);
        let slack = self.snap + FIXED + SINGLE * self.extent / texel_m;
        let drawing = Drawing { maker: self, key, size, texel_m, slack };
        let mut texels = Texels::new(size, self.settings.texel, self.mode);
        self.items.near(&self.texture.bounds(key), texel_m, &mut |near| {
            let (Near::Area(item) | Near::Stroke(item, _)) = near;
            texels.enter(self.items.list.style_of(item).group);
            let (drawn, paint) = self.items.drawn(item);
            match (drawn, near) {
                (Drawn::Fill(rule), _) => drawing.fill(item, *rule, paint, &mut texels),
                (Drawn::Stroke(style), Near::Stroke(item, chunks)) => {
                    drawing.stroke((item, style), chunks, paint, &mut texels);
                }
                (Drawn::Stroke(_), Near::Area(_)) => {}
            }
        });
        texels.finish(size)
    }
}

impl Drawing<'_> {
    fn texel(&self, at: Plan) -> Texel {
        self.maker.texture.in_tile(self.key, at)
    }

    fn fill(&self, item: u32, rule: Rule, paint: Paint, texels: &mut Texels) {
        let edges = self.ring_edges(item);
        self.polygon(&edges, self.slack, Weight::Inside(rule), &mut |texel, shares| {
            texels.blend(texel, item, shares, paint);
        });
    }

    /// The edges around an item's area that matter to the tile: not those beside its rows.
    fn ring_edges(&self, item: u32) -> Vec<Edge> {
        let mut outline = Outline::default();
        let size = self.size as f64;
        self.maker.items.rings(item, &mut |from, to| {
            let (from, to) = (self.texel(from), self.texel(to));
            let is_beside = (from.y < -2.0 && to.y < -2.0) || (from.y > size + 2.0 && to.y > size + 2.0);
            if !is_beside {
                outline.edge(from, to);
            }
        });
        outline.edges()
    }

    /// Calls `visit` with the texels that edges bound and their shares.
    fn polygon(&self, edges: &[Edge], slack: f64, weight: Weight, visit: &mut dyn FnMut(usize, [f64; 2])) {
        if self.maker.settings.polygons == PolygonRaster::Exact {
            return self.areas(edges, slack, weight, visit);
        }
        let windings = Windings::new(edges, (self.size, [0.5; 2]), slack);
        windings.for_each(&mut |texel, least, most| {
            let shares = weight.between(least, most);
            if shares[1] > 0.0 {
                visit(texel, shares);
            }
        });
    }

    /// The same by areas.
    fn areas(&self, edges: &[Edge], slack: f64, weight: Weight, visit: &mut dyn FnMut(usize, [f64; 2])) {
        // No edge is likely to run through such a point.
        const POINT: [f64; 2] = [0.483_713, 0.521_391];
        let size = self.size;
        let windings = Windings::new(edges, (size, POINT), 0.0);
        let mut touched: Vec<(u32, u32)> = Vec::new();
        for (number, edge) in (0u32..).zip(edges) {
            let (low, high) = edge.rows();
            for row in between(low - slack - 1.0, high + slack, 0.0, size) {
                let (north, south) = (row as f64 - slack, row as f64 + 1.0 + slack);
                let Some((west, east)) = edge.columns_within(north, south) else { continue };
                let columns = between(west - slack - 1.0, east + slack, 0.0, size);
                touched.extend(columns.map(|column| ((column + size * row) as u32, number)));
            }
        }
        touched.sort_unstable();
        let mut all: std::collections::BTreeMap<usize, [f64; 2]> = std::collections::BTreeMap::new();
        let mut near: Vec<Edge> = Vec::new();
        for of_one in touched.chunk_by(|a, b| a.0 == b.0) {
            let texel = of_one[0].0 as usize;
            let (column, row) = (texel % size, texel / size);
            near.clear();
            near.extend(of_one.iter().map(|(_, edge)| edges[*edge as usize]));
            let within = windings.columns.contains(&column) && windings.rows.contains(&row);
            let winding = if within { windings.at(column, row) } else { 0 };
            let corner = [column as f64, row as f64];
            let reference = Texel::new(corner[0] + POINT[0], corner[1] + POINT[1]);
            let count = near.len() as i32;
            let [least, most] = weight.between(winding - count, winding + count);
            let start = corner.map(|v| v - slack);
            let end = corner.map(|v| v + 1.0 + slack);
            let length: f64 = near.iter().map(|edge| edge.length_in(start, end)).sum();
            let off = length * slack * std::f64::consts::SQRT_2 + AREA;
            let [share, doubt] = share(&near, corner, (reference, winding), &|k| weight.of(k));
            // A step of windings counts as much as the weight's span at most.
            let off = (off + doubt) * math::max(most - least, 1.0);
            let shares = [math::max(share - off, least), math::min(share + off, most)];
            all.insert(texel, shares);
        }
        windings.for_each(&mut |texel, winding, _| {
            let shares = all.remove(&texel).unwrap_or([weight.of(winding); 2]);
            if shares[1] > 0.0 {
                visit(texel, shares);
            }
        });
        // Beside the rectangle of points.
        for (texel, shares) in all.into_iter().filter(|(_, shares)| shares[1] > 0.0) {
            visit(texel, shares);
        }
    }

    fn stroke(&self, (item, style): (u32, &StrokeStyle), chunks: &[u32], paint: Paint, texels: &mut Texels) {
        let maker = self.maker;
        let way = maker.items.way(style, self.texel_m);
        let cut = style.cut.map(|cut| self.cut(item, cut));
        let mut draw = |texel: usize, [least, most]: [f64; 2]| {
            let shares = match cut.as_ref().map_or(Known::In, |cut| cut[texel]) {
                Known::In => [least, most],
                Known::Open => [0.0, most],
                Known::Out => return,
            };
            texels.blend(texel, item, shares, paint);
        };
        if way.is_lines {
            return self.lines(style, &way, chunks, &mut draw);
        }
        let mut outline = Outline::default();
        let slack = self.slack + ROUND_TEXELS;
        let size = self.size as f64;
        maker.items.strips((style, &way), chunks, &mut |pairs| {
            let pairs: Vec<[Texel; 2]> = pairs.iter().map(|pair| pair.map(|p| self.texel(p))).collect();
            for quad in pairs.windows(2) {
                let corners = quad.as_flattened();
                let is_beside = |of: &dyn Fn(&Texel) -> f64| {
                    corners.iter().all(|p| of(p) < -2.0) || corners.iter().all(|p| of(p) > size + 2.0)
                };
                if !is_beside(&|p| p.x) && !is_beside(&|p| p.y) {
                    outline.strip(quad, maker.settings.joints, slack);
                }
            }
        });
        let edges = outline.edges();
        self.polygon(&edges, slack, self.weight(paint), &mut draw);
    }

    /// What counts of a stroke's pieces.
    fn weight(&self, paint: Paint) -> Weight {
        match (self.maker.settings.overlaps, self.maker.mode) {
            (Overlaps::Once, _) => Weight::Once,
            (Overlaps::Blend, BlendMode::Over) => Weight::Each(Some(paint.0[3])),
            (Overlaps::Blend, BlendMode::Additive) => Weight::Each(None),
        }
    }

    /// Which texels a stroke is cut to.
    fn cut(&self, item: u32, (side, rule): (Side, Rule)) -> Vec<Known> {
        let edges = self.ring_edges(self.maker.items.list.area_owner(item));
        let mut inside = vec![Known::Out; self.size * self.size];
        self.polygon(&edges, self.slack, Weight::Inside(rule), &mut |texel, [least, most]| {
            inside[texel] = match (least, most) {
                (1.0, _) => Known::In,
                (_, 0.0) => Known::Out,
                _ => Known::Open,
            };
        });
        match side {
            Side::Inside => inside,
            Side::Outside => inside.into_iter().map(|known| !known).collect(),
        }
    }

    /// Draws line primitives.
    fn lines(&self, style: &StrokeStyle, way: &Way, chunks: &[u32], draw: &mut dyn FnMut(usize, [f64; 2])) {
        let maker = self.maker;
        let width = way.width_m / self.texel_m;
        if width > maker.widest && maker.settings.wide_lines == WideLines::Discard {
            return;
        }
        let width = math::min(width, maker.widest);
        let is_once = maker.settings.overlaps == Overlaps::Once;
        let mut outline = Outline::default();
        let mut most: std::collections::BTreeMap<usize, [f64; 2]> = std::collections::BTreeMap::new();
        maker.items.segments((style, way), chunks, &mut |segment| {
            let segment = segment.map(|p| self.texel(p));
            let primitive = lines::Primitive { segment, width, slack: self.slack, size: self.size };
            match (maker.settings.lines, is_once) {
                (LinePrimitives::Coverage, true) => {
                    if let Some(ring) = primitive.ring(0.0) {
                        outline.ring(&ring);
                    }
                }
                (LinePrimitives::Coverage, false) => {
                    primitive.coverage(&mut |texel, shares| draw(texel, shares))
                }
                (kind, is_once) => {
                    let mut raise = |texel: usize, [a, b]: [f64; 2]| {
                        let known = most.entry(texel).or_insert([0.0; 2]);
                        *known = [math::max(known[0], a), math::max(known[1], b)];
                    };
                    let visit: &mut dyn FnMut(usize, [f64; 2]) = if is_once { &mut raise } else { draw };
                    match kind {
                        LinePrimitives::Plain => primitive.plain(visit),
                        _ => primitive.prefiltered(maker.settings.line_filter, visit),
                    }
                }
            }
        });
        if is_once && maker.settings.lines == LinePrimitives::Coverage {
            self.areas(&outline.edges(), self.slack, Weight::Once, draw);
        }
        most.into_iter().for_each(|(texel, shares)| draw(texel, shares));
    }
}
