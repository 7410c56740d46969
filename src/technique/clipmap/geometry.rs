//! What is kept in memory of the layers: lines, polygons, both, lines with adjacency or with offsets (Taibo et al. 2014, 4.1 to 4.4),
//! and the rings of areas.
//!
//! Items are fills, outlines and lines, feature by feature in draw order; an item is one thing to be blended. Lines are cut into
//! chunks of up to 32 segments, which the index finds; each chunk keeps its own strips.

use super::quadtree::Quadtree;
use super::raster::{Folded, Ink};
use super::simple;
use super::tessellation::{OffsetVertex, Pair, Polyline, Rule as Tessellation, Sagitta, Strips};
use crate::error::{Error, Result};
use crate::math;
use crate::parallel;
use crate::resolve::Compositor;
use crate::scene::{
    Clipmap, Compositing, Feature, Joints, Layer, Line, OffsetForm, OutlineMode, PolygonRaster, Rule, Shape,
    Solution, Width, distinct_vertices,
};
use crate::space::{Plan, PlanBox};
use glam::DVec2;

/// Segments of a chunk.
const CHUNK: usize = 32;

/// Features that are prepared as one piece of work.
const FEATURES_AT_A_TIME: usize = 1024;

/// A width at which inner boundaries meet wherever they can: for lines whose width is not known when offsets are made.
const THIN_M: f64 = 1e-3;

/// What a stroke's layer keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Keep {
    /// Vertices (solution 1).
    Lines,
    /// Strips (solutions 2 and 3b).
    Strips,
    /// Both (solution 3a).
    Both,
    /// Vertices with those before and after a line (solution 4a).
    Adjacency,
    /// Vertices with offsets (solution 4b).
    Offsets,
}

/// How the strokes of a layer look.
#[derive(Debug, Clone)]
pub(super) struct StrokeStyle {
    /// How they are tessellated.
    pub(super) tessellation: Tessellation,
    /// How wide they are.
    pub(super) width: Width,
    /// What they are painted with.
    pub(super) ink: Ink,
    /// What is kept of them.
    pub(super) keep: Keep,
    /// What their polygon cuts off.
    pub(super) mode: OutlineMode,
    /// How far from their vertices they may reach, in half widths.
    pub(super) reach: f64,
}

/// How the areas of a layer look.
#[derive(Debug, Clone, Copy)]
pub(super) struct FillStyle {
    pub(super) ink: Ink,
    pub(super) rule: Rule,
}

/// The items of a layer.
#[derive(Debug, Clone)]
pub(super) struct LayerItems {
    first_item: u32,
    /// The layer's number in the scene.
    pub(super) layer: u32,
    pub(super) fill: Option<FillStyle>,
    pub(super) outline: Option<StrokeStyle>,
    pub(super) line: Option<StrokeStyle>,
}

/// Items of a feature where polygons are drawn: its fill, its outline, its line, most of them empty.
const OF_POLYGONS: u32 = 3;

impl LayerItems {
    /// How many items a feature has.
    fn per_feature(&self) -> u32 {
        if self.fill.is_some() || self.outline.is_some() { OF_POLYGONS } else { 1 }
    }

    /// The items of a feature: its fill's, its outline's, its line's.
    fn items(&self, feature: usize) -> [u32; 3] {
        let first = self.first_item + self.per_feature() * feature as u32;
        [first, first + 1, first + self.per_feature() - 1]
    }
}

/// What an item is of its feature.
#[derive(Debug, Clone, Copy)]
pub(super) enum Role<'g> {
    Fill(&'g FillStyle),
    Stroke(&'g StrokeStyle),
}

/// Solution 4b with offsets in polar coordinates: a length and an angle each.
#[derive(Debug, Clone, Copy, PartialEq)]
struct PolarVertex {
    at: Plan,
    left: [f64; 2],
    right: [f64; 2],
}

/// Strokes' memory.
#[derive(Debug, Default)]
struct Strokes {
    /// The item of each part, and whether it is a loop.
    part_items: Vec<(u32, bool)>,
    /// Where the vertices of each part begin, and where the last ones end.
    part_starts: Vec<u32>,
    vertices: Vec<Plan>,
    /// The part of each chunk and its place there.
    chunks: Vec<(u32, u32)>,
    boxes: Vec<PlanBox>,
    /// Where the strips of each chunk begin in `strip_ends`, where chunks have strips.
    chunk_strips: Vec<u32>,
    strip_ends: Vec<u32>,
    pairs: Vec<Pair<Plan>>,
    offsets: Vec<OffsetVertex>,
    polar: Vec<PolarVertex>,
}

/// A polygon.
#[derive(Debug, Clone, Copy)]
pub(super) struct AreaRings {
    /// The item of its feature's fill, whether it is filled or not.
    item: u32,
    rings: (u32, u32),
    pub(super) is_simple: bool,
}

impl AreaRings {
    /// The item of its feature's fill.
    pub(super) fn item(&self) -> u32 {
        self.item
    }
}

/// Polygons' memory.
#[derive(Debug, Default)]
struct Areas {
    areas: Vec<AreaRings>,
    boxes: Vec<PlanBox>,
    ring_ends: Vec<u32>,
    points: Vec<Plan>,
}

/// Everything that tiles are made of.
#[derive(Debug)]
pub(super) struct Geometry {
    layers: Vec<LayerItems>,
    strokes: Strokes,
    stroke_index: Quadtree,
    areas: Areas,
    area_index: Quadtree,
    folded: Folded,
}

/// Segments of a part.
#[derive(Debug, Clone, Copy)]
pub(super) struct ChunkOf<'g> {
    geometry: &'g Geometry,
    chunk: u32,
}

impl Geometry {
    /// Keeps what a solution needs of the layers, indexed by the cells of a square.
    ///
    /// # Errors
    /// When there is more than can be numbered.
    pub(super) fn new(
        layers: &[Layer],
        settings: &Clipmap,
        compositing: Compositing,
        square: &PlanBox,
    ) -> Result<Self> {
        let mut items = layer_items(layers, settings, compositing)?;
        let (mut strokes, mut areas) = (Strokes::default(), Areas::default());
        for (styles, layer) in items.iter_mut().zip(layers) {
            let blocks = layer.features.len().div_ceil(FEATURES_AT_A_TIME);
            let made = parallel::map_indices(blocks, |block| {
                let first = block * FEATURES_AT_A_TIME;
                let features = &layer.features[first..layer.features.len().min(first + FEATURES_AT_A_TIME)];
                Block::of(styles, settings, first, features)
            });
            let reach = |of: fn(&Block) -> f64| made.iter().map(of).fold(1.0, math::max);
            let (of_lines, of_outlines) =
                (reach(|block| block.line_reach), reach(|block| block.outline_reach));
            styles.line.iter_mut().for_each(|style| style.reach = of_lines);
            styles.outline.iter_mut().for_each(|style| style.reach = of_outlines);
            for block in made {
                strokes.append(block.strokes)?;
                areas.append(block.areas)?;
            }
        }
        strokes.finish();
        let stroke_index = Quadtree::new(&strokes.boxes, *square);
        let area_index = Quadtree::new(&areas.boxes, *square);
        // The index has them.
        (strokes.boxes, areas.boxes) = (Vec::new(), Vec::new());
        let folded = match settings.joints {
            Joints::BevelQuads => Folded::Polygon,
            _ => Folded::Triangles,
        };
        Ok(Self { layers: items, strokes, stroke_index, areas, area_index, folded })
    }

    /// How strips draw folded quadrilaterals.
    pub(super) fn folded(&self) -> Folded {
        self.folded
    }

    /// All layers.
    pub(super) fn layers(&self) -> &[LayerItems] {
        &self.layers
    }

    /// Bytes of what the solution keeps of lines and areas, without the index.
    pub(super) fn bytes(&self) -> usize {
        self.strokes.bytes() + self.areas.bytes()
    }

    /// Bytes of the index.
    pub(super) fn index_bytes(&self) -> usize {
        self.stroke_index.bytes() + self.area_index.bytes()
    }

    /// The chunks of strokes whose vertices' boxes meet one, in draw order.
    pub(super) fn chunks_near(&self, wanted: &PlanBox) -> Vec<u32> {
        let mut found = Vec::new();
        self.stroke_index.query(wanted, &mut found);
        found.sort_unstable();
        found
    }

    /// The filled areas whose boxes meet one, in draw order: their items and their numbers.
    pub(super) fn areas_near(&self, wanted: &PlanBox) -> Vec<(u32, u32)> {
        let mut found = Vec::new();
        self.area_index.query(wanted, &mut found);
        found.sort_unstable();
        found.into_iter().map(|k| (self.areas.areas[k as usize].item, k)).collect()
    }

    /// A chunk.
    pub(super) fn chunk(&self, chunk: u32) -> ChunkOf<'_> {
        ChunkOf { geometry: self, chunk }
    }

    /// What an item is, and its layer's and its feature's number.
    pub(super) fn role(&self, item: u32) -> Option<(Role<'_>, (u32, u32))> {
        let at = self.layers.partition_point(|layer| layer.first_item <= item).checked_sub(1)?;
        let layer = &self.layers[at];
        let (place, per_feature) = (item - layer.first_item, layer.per_feature());
        let role = match (per_feature, place % per_feature) {
            (OF_POLYGONS, 0) => layer.fill.as_ref().map(Role::Fill),
            (OF_POLYGONS, 1) => layer.outline.as_ref().map(Role::Stroke),
            _ => layer.line.as_ref().map(Role::Stroke),
        };
        Some((role?, (layer.layer, place / per_feature)))
    }

    /// The polygon that an outline is cut to.
    pub(super) fn cut_of(&self, outline: u32) -> Option<AreaRings> {
        let item = outline.checked_sub(1)?;
        let at = self.areas.areas.binary_search_by_key(&item, |area| area.item).ok()?;
        Some(self.areas.areas[at])
    }

    /// An area by its number.
    pub(super) fn area(&self, area: u32) -> AreaRings {
        self.areas.areas[area as usize]
    }

    /// The rings of an area.
    pub(super) fn rings(&self, area: &AreaRings) -> impl Iterator<Item = &[Plan]> {
        (area.rings.0 as usize..area.rings.1 as usize).map(|ring| {
            let start = if ring == 0 { 0 } else { self.areas.ring_ends[ring - 1] };
            &self.areas.points[start as usize..self.areas.ring_ends[ring] as usize]
        })
    }
}

impl<'g> ChunkOf<'g> {
    fn part(&self) -> (usize, usize) {
        let (part, place) = self.geometry.strokes.chunks[self.chunk as usize];
        (part as usize, place as usize)
    }

    /// The item that it is a part of.
    pub(super) fn item(&self) -> u32 {
        self.geometry.strokes.part_items[self.part().0].0
    }

    fn is_loop(&self) -> bool {
        self.geometry.strokes.part_items[self.part().0].1
    }

    /// The vertices that are kept of its part.
    fn vertices(&self) -> &'g [Plan] {
        let strokes = &self.geometry.strokes;
        let part = self.part().0;
        &strokes.vertices[strokes.part_starts[part] as usize..strokes.part_starts[part + 1] as usize]
    }

    /// Calls `visit` with the segments that are drawn as line primitives.
    pub(super) fn segments(&self, style: &StrokeStyle, visit: &mut impl FnMut(Plan, Plan)) {
        let first = self.part().1 * CHUNK;
        let vertices = self.vertices();
        let mut along = |vertices: &[Plan]| {
            let windows = vertices.windows(2).skip(first).take(CHUNK);
            windows.for_each(|pair| visit(pair[0], pair[1]));
        };
        match style.keep {
            Keep::Lines | Keep::Both => {
                along(vertices);
                let (n, last) = (vertices.len(), vertices.len().saturating_sub(1));
                if self.is_loop() && n > 1 && (first..first + CHUNK).contains(&last) {
                    visit(vertices[last], vertices[0]);
                }
            }
            // Between the vertex before the line and the one after it.
            Keep::Adjacency if vertices.len() > 2 => along(&vertices[1..vertices.len() - 1]),
            Keep::Adjacency => {}
            // The duplicates of the offsets' vertices make segments of no length.
            Keep::Offsets => self.stored(1.0, &mut |strip| {
                for pair in strip.windows(2) {
                    if pair[0].0 != pair[1].0 {
                        visit(pair[0].0, pair[1].0);
                    }
                }
            }),
            // Wireframe: the sides of the quadrilaterals (4.3.2).
            Keep::Strips => self.stored(1.0, &mut |strip| {
                for pair in strip.windows(2) {
                    let (from, to) = (pair[0].1, pair[1].1);
                    visit(from.left, from.right);
                    visit(from.right, to.right);
                    visit(to.right, to.left);
                    visit(to.left, from.left);
                }
            }),
        }
    }

    /// Calls `visit` with the strips of polygons of half a width in metres.
    pub(super) fn strips(
        &self,
        style: &StrokeStyle,
        (half, sagitta): (f64, Sagitta),
        room: &mut Strips,
        visit: &mut impl FnMut(&mut dyn Iterator<Item = Pair<Plan>>),
    ) {
        match style.keep {
            Keep::Strips | Keep::Both => self.stored(1.0, &mut |strip| visit(&mut strip.iter().map(|v| v.1))),
            Keep::Offsets => self.stored(half, &mut |strip| visit(&mut strip.iter().map(|v| v.1))),
            Keep::Lines | Keep::Adjacency => {
                room.clear();
                self.tessellate(style, half, sagitta, room);
                for strip in room.iter() {
                    visit(&mut strip.iter().map(|v| v.pair(1.0)));
                }
            }
        }
    }

    /// Tessellates the vertices that are kept; offsets are scaled as they are.
    pub(super) fn tessellate(&self, style: &StrokeStyle, half: f64, sagitta: Sagitta, out: &mut Strips) {
        let (vertices, first) = (self.vertices(), self.part().1 * CHUNK);
        match style.keep {
            Keep::Adjacency if vertices.len() == 3 => style.tessellation.dot(vertices[1], half, sagitta, out),
            Keep::Adjacency => {
                // As many segments as windows of four.
                let windows = vertices.windows(4).skip(first).take(CHUNK);
                style.tessellation.adjacency(windows, half, sagitta, out);
            }
            Keep::Lines | Keep::Both if vertices.len() == 1 => {
                style.tessellation.dot(vertices[0], half, sagitta, out);
            }
            Keep::Lines | Keep::Both => {
                let line = Polyline { vertices, is_loop: self.is_loop() };
                let segments = first..line.segments().min(first + CHUNK);
                style.tessellation.part(&line, segments, half, sagitta, out);
            }
            Keep::Strips | Keep::Offsets => {}
        }
    }

    /// Calls `visit` with the stored strips: the lines' vertices (where they are kept) and the pairs.
    pub(super) fn stored(&self, scale: f64, visit: &mut impl FnMut(&[(Plan, Pair<Plan>)])) {
        let strokes = &self.geometry.strokes;
        let chunk = self.chunk as usize;
        let mut strip = Vec::new();
        for k in strokes.chunk_strips[chunk] as usize..strokes.chunk_strips[chunk + 1] as usize {
            let start = if k == 0 { 0 } else { strokes.strip_ends[k - 1] };
            strip.clear();
            strip.extend((start as usize..strokes.strip_ends[k] as usize).map(|at| strokes.pair(at, scale)));
            visit(&strip);
        }
    }
}

impl Strokes {
    fn bytes(&self) -> usize {
        size_of_val(&self.part_items[..])
            + size_of_val(&self.part_starts[..])
            + size_of_val(&self.vertices[..])
            + size_of_val(&self.chunks[..])
            + size_of_val(&self.chunk_strips[..])
            + size_of_val(&self.strip_ends[..])
            + size_of_val(&self.pairs[..])
            + size_of_val(&self.offsets[..])
            + size_of_val(&self.polar[..])
    }

    /// A stored vertex and its pair: as it is, or its offsets scaled.
    fn pair(&self, at: usize, scale: f64) -> (Plan, Pair<Plan>) {
        if let Some(vertex) = self.offsets.get(at) {
            return (vertex.at, vertex.pair(scale));
        }
        if let Some(PolarVertex { at, left, right }) = self.polar.get(at) {
            let offset =
                |[length, angle]: [f64; 2]| DVec2::new(math::cos(angle), math::sin(angle)) * (length * scale);
            return (*at, Pair { left: *at + offset(*left), right: *at + offset(*right) });
        }
        let pair = self.pairs[at];
        (pair.left, pair)
    }

    /// Adds a part of a stroke; a line of one vertex is a dot.
    fn push(&mut self, item: u32, line: &Polyline, style: &StrokeStyle, form: OffsetForm) {
        let part = self.part_items.len() as u32;
        self.part_items.push((item, line.is_loop));
        self.part_starts.push(self.vertices.len() as u32);
        let n = line.vertices.len();
        match style.keep {
            Keep::Lines | Keep::Both => self.vertices.extend(line.vertices),
            Keep::Adjacency => {
                // A line that is open begins and ends twice; a loop is closed, and runs on by a vertex on both sides.
                let at = |k: usize| line.vertices[k % n];
                let (before, after) =
                    if line.is_loop { (at(n - 1), [at(0), at(1)]) } else { (at(0), [at(n - 1); 2]) };
                self.vertices.push(before);
                self.vertices.extend(line.vertices);
                self.vertices.extend(&after[..if line.is_loop { 2 } else { 1 }]);
            }
            Keep::Strips | Keep::Offsets => {}
        }
        let segments = line.segments();
        let mut room = Strips::default();
        for place in 0..segments.div_ceil(CHUNK).max(1) {
            let of_chunk = place * CHUNK..segments.min((place + 1) * CHUNK);
            self.chunks.push((part, place as u32));
            let vertices = (of_chunk.start..=of_chunk.end).map(|k| line.vertices[k % n]);
            self.boxes.push(PlanBox::around(vertices));
            self.chunk_strips.push(self.strip_ends.len() as u32);
            if matches!(style.keep, Keep::Strips | Keep::Both | Keep::Offsets) {
                let half = match style.width {
                    Width::Metres(width) => 0.5 * width,
                    Width::Pixels(_) => THIN_M,
                };
                room.clear();
                match n {
                    1 => style.tessellation.dot(line.vertices[0], half, Sagitta::DEFAULT, &mut room),
                    _ => style.tessellation.part(line, of_chunk, half, Sagitta::DEFAULT, &mut room),
                }
                self.store(&room, half, style.keep, form);
            }
        }
    }

    /// Keeps strips, or their offsets as shares of half the width.
    fn store(&mut self, strips: &Strips, half: f64, keep: Keep, form: OffsetForm) {
        for strip in strips.iter() {
            match (keep, form) {
                (Keep::Offsets, OffsetForm::Rectangular) => {
                    self.offsets.extend(strip.iter().map(|v| OffsetVertex {
                        at: v.at,
                        left: v.left / half,
                        right: v.right / half,
                    }))
                }
                (Keep::Offsets, OffsetForm::Polar) => self.polar.extend(strip.iter().map(|v| {
                    let polar = |offset: DVec2| [offset.length() / half, math::atan2(offset.y, offset.x)];
                    PolarVertex { at: v.at, left: polar(v.left), right: polar(v.right) }
                })),
                _ => self.pairs.extend(strip.iter().map(|v| v.pair(1.0))),
            }
            let stored = self.pairs.len() + self.offsets.len() + self.polar.len();
            self.strip_ends.push(stored as u32);
        }
    }

    /// Adds another's strokes after these.
    fn append(&mut self, other: Self) -> Result<()> {
        let stored = |strokes: &Self| strokes.pairs.len() + strokes.offsets.len() + strokes.polar.len();
        let (vertices, pairs) = (self.vertices.len(), stored(self));
        if vertices + other.vertices.len() > MOST || pairs + stored(&other) > MOST {
            return Err(
                Error::new("more vertices than this program can number").help("give the terrain a `window`")
            );
        }
        let (parts, strips) = (self.part_items.len() as u32, self.strip_ends.len() as u32);
        self.part_items.extend(other.part_items);
        self.part_starts.extend(other.part_starts.iter().map(|start| start + vertices as u32));
        self.vertices.extend(other.vertices);
        self.chunks.extend(other.chunks.iter().map(|(part, place)| (part + parts, *place)));
        self.boxes.extend(other.boxes);
        self.chunk_strips.extend(other.chunk_strips.iter().map(|start| start + strips));
        self.strip_ends.extend(other.strip_ends.iter().map(|end| end + pairs as u32));
        self.pairs.extend(other.pairs);
        self.offsets.extend(other.offsets);
        self.polar.extend(other.polar);
        Ok(())
    }

    /// Ends the lists of beginnings, when all strokes are there.
    fn finish(&mut self) {
        self.part_starts.push(self.vertices.len() as u32);
        self.chunk_strips.push(self.strip_ends.len() as u32);
    }
}

/// The most vertices.
const MOST: usize = u32::MAX as usize / 2;

impl Areas {
    fn bytes(&self) -> usize {
        size_of_val(&self.areas[..]) + size_of_val(&self.ring_ends[..]) + size_of_val(&self.points[..])
    }

    /// Adds a polygon.
    fn push(&mut self, item: u32, rings: &[Vec<Plan>], rule: Rule, is_filled: bool, settings: &Clipmap) {
        let mut rings: Vec<Vec<Plan>> = rings.iter().filter(|ring| ring.len() > 2).cloned().collect();
        let plan = PlanBox::around(rings.iter().flatten().copied());
        let is_simple = settings.polygons == PolygonRaster::Exact && simple::orient(&mut rings, rule);
        let first = self.ring_ends.len() as u32;
        for ring in &rings {
            self.points.extend(ring);
            self.ring_ends.push(self.points.len() as u32);
        }
        self.areas.push(AreaRings { item, rings: (first, self.ring_ends.len() as u32), is_simple });
        self.boxes.push(if is_filled { plan } else { PlanBox::EMPTY });
    }

    /// Adds another's areas after these.
    fn append(&mut self, other: Self) -> Result<()> {
        let (rings, points) = (self.ring_ends.len() as u32, self.points.len());
        if points + other.points.len() > MOST {
            return Err(
                Error::new("more vertices than this program can number").help("give the terrain a `window`")
            );
        }
        let moved =
            |area: &AreaRings| AreaRings { rings: (area.rings.0 + rings, area.rings.1 + rings), ..*area };
        self.areas.extend(other.areas.iter().map(moved));
        self.boxes.extend(other.boxes);
        self.ring_ends.extend(other.ring_ends.iter().map(|end| end + points as u32));
        self.points.extend(other.points);
        Ok(())
    }
}

/// What some features become.
struct Block {
    strokes: Strokes,
    areas: Areas,
    line_reach: f64,
    outline_reach: f64,
}

impl Block {
    /// The items of features, of which the first has the number `first` in its layer.
    fn of(styles: &LayerItems, settings: &Clipmap, first: usize, features: &[Feature]) -> Self {
        let mut block = Self {
            strokes: Strokes::default(),
            areas: Areas::default(),
            line_reach: 1.0,
            outline_reach: 1.0,
        };
        for (k, feature) in features.iter().enumerate() {
            let [fill, outline, line] = styles.items(first + k);
            match (&feature.shape, &styles.line, &styles.outline) {
                (Shape::Line(parts), Some(style), _) => {
                    for part in parts {
                        let vertices = distinct_vertices(part);
                        let returns = vertices.len() > 3 && vertices.first() == vertices.last();
                        let reach = block.stroke(line, &vertices, returns, style, settings);
                        block.line_reach = math::max(reach, block.line_reach);
                    }
                }
                (Shape::Polygon(rings), _, style) => {
                    let is_cut = style.as_ref().is_some_and(|style| style.mode != OutlineMode::Normal);
                    if styles.fill.is_some() || is_cut {
                        let rule = styles.fill.map_or(Rule::EvenOdd, |fill| fill.rule);
                        block.areas.push(fill, rings, rule, styles.fill.is_some(), settings);
                    }
                    for ring in rings {
                        let Some(style) = style else { break };
                        let mut vertices = distinct_vertices(ring);
                        vertices.extend(vertices.first().copied().filter(|p| vertices.last() != Some(p)));
                        let reach = block.stroke(outline, &vertices, vertices.len() > 2, style, settings);
                        block.outline_reach = math::max(reach, block.outline_reach);
                    }
                }
                (Shape::Line(_), None, _) => {}
            }
        }
        block
    }

    /// Adds a stroke along vertices, of which the last is the first again in a loop; returns its reach.
    fn stroke(
        &mut self,
        item: u32,
        vertices: &[Plan],
        is_loop: bool,
        style: &StrokeStyle,
        settings: &Clipmap,
    ) -> f64 {
        let vertices = if is_loop { &vertices[..vertices.len() - 1] } else { vertices };
        if vertices.is_empty() {
            return 1.0;
        }
        let line = Polyline { vertices, is_loop };
        self.strokes.push(item, &line, style, settings.offsets);
        style.tessellation.reach(&line)
    }
}

/// The layers' styles and the numbers of their items.
fn layer_items(layers: &[Layer], settings: &Clipmap, compositing: Compositing) -> Result<Vec<LayerItems>> {
    let compositor = Compositor::new(compositing);
    let mut first_item = 0u64;
    let mut items = Vec::new();
    for (number, layer) in layers.iter().enumerate() {
        let stroke = |line: &Line, mode: OutlineMode| -> Result<StrokeStyle> {
            Ok(StrokeStyle {
                tessellation: Tessellation::new(settings.joints, settings.angle_deg, line.join, line.cap)?,
                width: line.width,
                ink: Ink::new(compositor.paint(line.color), compositing.mode),
                keep: keep(settings.solution, line.width),
                mode,
                reach: 1.0,
            })
        };
        let style = &layer.style;
        let of_layer = LayerItems {
            first_item: first_item as u32,
            layer: number as u32,
            fill: style.fill.map(|fill| FillStyle {
                ink: Ink::new(compositor.paint(fill.color), compositing.mode),
                rule: fill.rule,
            }),
            outline: style.outline.map(|o| stroke(&o.line, o.mode)).transpose()?,
            line: style.line.map(|line| stroke(&line, OutlineMode::Normal)).transpose()?,
        };
        first_item += u64::from(of_layer.per_feature()) * layer.features.len() as u64;
        if first_item > MOST as u64 {
            return Err(
                Error::new("more features than this program can number").help("give the terrain a `window`")
            );
        }
        items.push(of_layer);
    }
    Ok(items)
}

/// What is kept of lines. Polygons would have to be made anew for each width: lines whose width depends on the level or on the view are
/// tessellated whenever they are drawn.
fn keep(solution: Solution, width: Width) -> Keep {
    match (solution, width) {
        (Solution::Lines, _) => Keep::Lines,
        (Solution::Polygons | Solution::Wireframe, Width::Metres(_)) => Keep::Strips,
        (Solution::Both, Width::Metres(_)) => Keep::Both,
        (Solution::Polygons | Solution::Wireframe | Solution::Both, Width::Pixels(_)) => Keep::Adjacency,
        (Solution::Adjacency, _) => Keep::Adjacency,
        (Solution::Offsets, _) => Keep::Offsets,
    }
}
