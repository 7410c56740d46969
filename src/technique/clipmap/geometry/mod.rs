//! What is kept in memory of the items: lines, polygons, both, lines with adjacency or with offsets (Taibo et al. 2014, 4.1 to 4.4),
//! and the rings of areas.
//!
//! An item of the draw list is one thing to be blended. Lines are cut into chunks of up to 32 segments, which the index finds; each
//! chunk keeps its own strips.

mod areas;
mod strokes;
mod style;

pub(super) use areas::AreaRings;
pub(super) use strokes::Chunk;
pub(super) use style::{Drawn, StrokeStyle, Styles};

use super::raster::Folded;
use super::tessellation::Polyline;
use crate::draw_list::{DrawList, Item};
use crate::error::{Error, Result};
use crate::index::BoxTree;
use crate::math;
use crate::parallel;
use crate::scene::{Compositing, Group};
use crate::space::{Plan, PlanBox};
use crate::technique::clipmap::{Joints, Settings, Solution};
use areas::Areas;
use std::ops::Range;
use strokes::Strokes;
use style::Keep;

/// Items that are prepared as one piece of work.
const ITEMS_AT_A_TIME: usize = 1024;

/// The most vertices.
const MOST: usize = u32::MAX as usize / 2;

fn too_many_vertices() -> Error {
    Error::unsupported("more vertices than this program can number").help("give the terrain a `window`")
}

/// Everything that tiles are made of.
#[derive(Debug)]
pub(super) struct Geometry<'l> {
    list: &'l DrawList,
    styles: Styles,
    strokes: Strokes,
    stroke_index: BoxTree,
    areas: Areas,
    area_index: BoxTree,
    joints: Joints,
}

impl<'l> Geometry<'l> {
    /// Keeps what a solution needs of the items.
    ///
    /// # Errors
    /// When there is more than can be numbered.
    pub(super) fn new(list: &'l DrawList, settings: &Settings, compositing: Compositing) -> Result<Self> {
        let mut styles = Styles::new(list, settings, compositing)?;
        let offsets = (settings.solution == Solution::Offsets).then_some(settings.offsets);
        let items = list.items().len();
        let made = parallel::map_indices(items.div_ceil(ITEMS_AT_A_TIME), |block| {
            let first = block * ITEMS_AT_A_TIME;
            let mut made =
                Block { strokes: Strokes::new(offsets), areas: Areas::default(), reaches: Vec::new() };
            made.add((list, &styles), settings, first..items.min(first + ITEMS_AT_A_TIME));
            made
        });
        styles.widen(made.iter().flat_map(|block| block.reaches.iter().copied()));
        let (mut strokes, mut areas) = (Strokes::new(offsets), Areas::default());
        for block in made {
            strokes.append(block.strokes)?;
            areas.append(block.areas)?;
        }
        strokes.finish();
        // Boxes are the index's.
        let (of_strokes, of_areas) = (std::mem::take(&mut strokes.boxes), std::mem::take(&mut areas.boxes));
        Ok(Self {
            list,
            styles,
            strokes,
            stroke_index: BoxTree::new(&of_strokes),
            areas,
            area_index: BoxTree::new(&of_areas),
            joints: settings.joints,
        })
    }

    /// How strips draw folded quadrilaterals.
    pub(super) fn folded(&self) -> Folded {
        if self.joints == Joints::BevelQuads { Folded::Polygon } else { Folded::Triangles }
    }

    /// How items are drawn.
    pub(super) fn styles(&self) -> &Styles {
        &self.styles
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
        self.stroke_index.found(wanted)
    }

    /// The filled areas whose boxes meet one, in draw order.
    pub(super) fn areas_near(&self, wanted: &PlanBox) -> Vec<AreaRings> {
        self.area_index.found(wanted).into_iter().map(|area| self.areas.get(area)).collect()
    }

    /// A chunk.
    pub(super) fn chunk(&self, chunk: u32) -> Chunk<'_> {
        self.strokes.chunk(chunk)
    }

    /// What an item is composed with first.
    pub(super) fn group_of(&self, item: u32) -> Option<Group> {
        self.list.style_of(item).group
    }

    /// How an item is drawn.
    pub(super) fn drawn(&self, item: u32) -> &Drawn {
        self.styles.get(self.list.items()[item as usize].style)
    }

    /// The polygon that an outline is cut to.
    pub(super) fn cut_of(&self, outline: u32) -> Option<AreaRings> {
        self.areas.of_item(self.list.area_owner(outline))
    }

    /// The rings of an area.
    pub(super) fn rings(&self, area: &AreaRings) -> impl Iterator<Item = &[Plan]> {
        self.areas.rings(area)
    }

    /// Changes all widths in metres. Pairs are scaled about their middles where the method allows it, or made anew from the lines that are
    /// kept beside them; everything else is tessellated whenever it is drawn. False where only making all anew would do.
    pub(super) fn change_width(&mut self, factor: f64) -> bool {
        self.styles.scale(factor);
        let keeps = |kept: &[Keep]| self.styles.strokes().any(|style| kept.contains(&style.keep));
        let keeps_strips = keeps(&[Keep::Strips, Keep::Both]);
        let keeps_strips_alone = keeps(&[Keep::Strips]);
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
                let (list, styles) = (self.list, &self.styles);
                self.strokes.retessellate(|item| match styles.get(list.items()[item as usize].style) {
                    Drawn::Stroke(style) => Some(style),
                    Drawn::Fill(_) => None,
                });
                true
            }
        }
    }
}

/// What some items become.
struct Block {
    strokes: Strokes,
    areas: Areas,
    /// How far strokes of a style reach from their vertices, in half widths: an entry for each run of items that have it.
    reaches: Vec<(u32, f64)>,
}

impl Block {
    /// Adds items.
    fn add(&mut self, (list, styles): (&DrawList, &Styles), settings: &Settings, items: Range<usize>) {
        for number in items {
            let item = &list.items()[number];
            let number = number as u32;
            match styles.get(item.style) {
                Drawn::Fill(fill) => {
                    self.areas.push(number, rings_of(list, item), fill.rule, true, settings);
                }
                Drawn::Stroke(style) => {
                    if style.cut.is_some() && list.area_owner(number) == number {
                        self.areas.push(number, rings_of(list, item), style.cut_rule, false, settings);
                    }
                    for chain in list.strokes(item) {
                        let line = Polyline { vertices: list.vertices_of(chain), is_loop: chain.is_closed };
                        self.strokes.push(number, &line, style);
                        self.reach(item.style, style.tessellation.reach(&line));
                    }
                }
            }
        }
    }

    fn reach(&mut self, style: u32, reach: f64) {
        match self.reaches.last_mut().filter(|last| last.0 == style) {
            Some(last) => last.1 = math::max(last.1, reach),
            None => self.reaches.push((style, reach)),
        }
    }
}

/// The rings that bound an item's area.
fn rings_of(list: &DrawList, item: &Item) -> Vec<Vec<Plan>> {
    list.border(item).iter().map(|ring| list.vertices_of(ring).to_vec()).collect()
}
