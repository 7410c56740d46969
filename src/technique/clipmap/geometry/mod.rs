//! What is kept in memory of the layers: lines, polygons, both, lines with adjacency or with offsets (Taibo et al. 2014, 4.1 to 4.4),
//! and the rings of areas.
//!
//! Items are fills, outlines and lines, feature by feature in draw order; an item is one thing to be blended. Lines are cut into
//! chunks of up to 32 segments, which the index finds; each chunk keeps its own strips.

mod areas;
mod limit;
mod strokes;
mod style;

pub(super) use areas::AreaRings;
pub(super) use strokes::Chunk;
pub(super) use style::{LayerItems, Role, StrokeStyle};

use super::quadtree::Quadtree;
use super::raster::Folded;
use super::tessellation::Polyline;
use crate::error::Result;
use crate::math;
use crate::parallel;
use crate::scene::{
    Clipmap, Compositing, Feature, Joints, Layer, OutlineMode, Rule, Shape, Solution, Width,
    distinct_vertices,
};
use crate::space::{Plan, PlanBox};
use areas::Areas;
use strokes::Strokes;

/// Features that are prepared as one piece of work.
const FEATURES_AT_A_TIME: usize = 1024;

/// Everything that tiles are made of.
#[derive(Debug)]
pub(super) struct Geometry {
    layers: Vec<LayerItems>,
    strokes: Strokes,
    stroke_index: Quadtree,
    areas: Areas,
    area_index: Quadtree,
    joints: Joints,
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
        let mut items = LayerItems::of_layers(layers, settings, compositing)?;
        let offsets = (settings.solution == Solution::Offsets).then_some(settings.offsets);
        let (mut strokes, mut areas) = (Strokes::new(offsets), Areas::default());
        for (styles, layer) in items.iter_mut().zip(layers) {
            let blocks = layer.features.len().div_ceil(FEATURES_AT_A_TIME);
            let made = parallel::map_indices(blocks, |block| {
                let first = block * FEATURES_AT_A_TIME;
                let end = layer.features.len().min(first + FEATURES_AT_A_TIME);
                let mut made =
                    Block { strokes: Strokes::new(offsets), areas: Areas::default(), reach: [1.0; 2] };
                made.add(styles, settings, first, &layer.features[first..end]);
                made
            });
            let reach = |role: usize| made.iter().map(|block| block.reach[role]).fold(1.0, math::max);
            let [of_lines, of_outlines] = [reach(0), reach(1)];
            styles.line.iter_mut().for_each(|style| style.reach = of_lines);
            styles.outline.iter_mut().for_each(|style| style.reach = of_outlines);
            for block in made {
                strokes.append(block.strokes)?;
                areas.append(block.areas)?;
            }
        }
        strokes.finish();
        // Boxes are the index's.
        let (of_strokes, of_areas) = (std::mem::take(&mut strokes.boxes), std::mem::take(&mut areas.boxes));
        Ok(Self {
            layers: items,
            strokes,
            stroke_index: Quadtree::new(&of_strokes, *square),
            areas,
            area_index: Quadtree::new(&of_areas, *square),
            joints: settings.joints,
        })
    }

    /// How strips draw folded quadrilaterals.
    pub(super) fn folded(&self) -> Folded {
        if self.joints == Joints::BevelQuads { Folded::Polygon } else { Folded::Triangles }
    }

    /// All layers.
    pub(super) fn layers(&self) -> &[LayerItems] {
        &self.layers
    }

    /// Bytes of what the solution keeps of lines and areas, without the index.
    pub(super) fn bytes(&self) -> usize {
        self.strokes.bytes() + self.areas.bytes()
    }

    /// Bytes of what the solution keeps of lines and outlines.
    pub(super) fn stroke_bytes(&self) -> usize {
        self.strokes.bytes()
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

    /// The filled areas whose boxes meet one, in draw order.
    pub(super) fn areas_near(&self, wanted: &PlanBox) -> Vec<AreaRings> {
        let mut found = Vec::new();
        self.area_index.query(wanted, &mut found);
        found.sort_unstable();
        found.into_iter().map(|area| self.areas.get(area)).collect()
    }

    /// A chunk.
    pub(super) fn chunk(&self, chunk: u32) -> Chunk<'_> {
        self.strokes.chunk(chunk)
    }

    /// What an item is.
    pub(super) fn role(&self, item: u32) -> Option<Role<'_>> {
        let at = self.layers.partition_point(|layer| layer.first_item <= item).checked_sub(1)?;
        self.layers[at].role(item)
    }

    /// The polygon that an outline is cut to.
    pub(super) fn cut_of(&self, outline: u32) -> Option<AreaRings> {
        self.areas.of_item(outline.checked_sub(1)?)
    }

    /// The rings of an area.
    pub(super) fn rings(&self, area: &AreaRings) -> impl Iterator<Item = &[Plan]> {
        self.areas.rings(area)
    }

    /// Changes all widths in metres. Pairs are scaled about their middles where the method allows it, or made anew from the lines that are
    /// kept beside them; everything else is tessellated whenever it is drawn. False where only making all anew would do.
    pub(super) fn change_width(&mut self, factor: f64) -> bool {
        let styles = self.layers.iter_mut().flat_map(|layer| layer.outline.iter_mut().chain(&mut layer.line));
        let mut keeps_strips_alone = false;
        let mut keeps_strips = false;
        for style in styles {
            if let Width::Metres(width) = &mut style.width {
                *width *= factor;
            }
            keeps_strips_alone |= style.keep == style::Keep::Strips;
            keeps_strips |= matches!(style.keep, style::Keep::Strips | style::Keep::Both);
        }
        let is_scaled = match self.joints {
            Joints::Isolated | Joints::Corner | Joints::BevelStrip | Joints::BevelQuads => true,
            Joints::Combined | Joints::BevelInner | Joints::Style => false,
        };
        match (keeps_strips, is_scaled, keeps_strips_alone) {
            (false, ..) => true,
            (true, true, _) => {
                self.strokes.scale_pairs(factor);
                true
            }
            (true, false, true) => false,
            (true, false, false) => {
                let layers = &self.layers;
                self.strokes.retessellate(|item| {
                    let at = layers.partition_point(|layer| layer.first_item <= item).checked_sub(1)?;
                    match layers[at].role(item)? {
                        Role::Stroke(style) => Some(style.clone()),
                        Role::Fill(_) => None,
                    }
                });
                true
            }
        }
    }
}

/// What some features become.
struct Block {
    strokes: Strokes,
    areas: Areas,
    /// How far lines and outlines reach from their vertices, in half widths.
    reach: [f64; 2],
}

impl Block {
    /// Adds the items of features, of which the first has the number `first` in its layer.
    fn add(&mut self, styles: &LayerItems, settings: &Clipmap, first: usize, features: &[Feature]) {
        for (k, feature) in features.iter().enumerate() {
            let [fill, outline, line] = styles.items(first + k);
            match &feature.shape {
                Shape::Line(parts) => {
                    let Some(style) = &styles.line else { continue };
                    for part in parts {
                        let vertices = distinct_vertices(part);
                        let returns = vertices.len() > 3 && vertices.first() == vertices.last();
                        self.stroke(line, &vertices, returns, style, 0);
                    }
                }
                Shape::Polygon(rings) => {
                    let is_cut = styles.outline.as_ref().is_some_and(|o| o.mode != OutlineMode::Normal);
                    if styles.fill.is_some() || is_cut {
                        let rule = styles.fill.map_or(Rule::EvenOdd, |fill| fill.rule);
                        self.areas.push(fill, rings, rule, styles.fill.is_some(), settings);
                    }
                    let Some(style) = &styles.outline else { continue };
                    for ring in rings {
                        let mut vertices = distinct_vertices(ring);
                        let start = vertices.first().copied();
                        vertices.extend(start.filter(|start| vertices.last() != Some(start)));
                        self.stroke(outline, &vertices, vertices.len() > 2, style, 1);
                    }
                }
            }
        }
    }

    /// Adds a stroke along vertices, of which the last is the first again in a loop.
    fn stroke(&mut self, item: u32, vertices: &[Plan], is_loop: bool, style: &StrokeStyle, role: usize) {
        let vertices = if is_loop { &vertices[..vertices.len() - 1] } else { vertices };
        if !vertices.is_empty() {
            let line = Polyline { vertices, is_loop };
            self.strokes.push(item, &line, style);
            self.reach[role] = math::max(style.tessellation.reach(&line), self.reach[role]);
        }
    }
}
