//! Draw list -> the index that cells are built from, and cells.

use super::cell::LineLeaf;
use super::quadtree::{Limits, Quadtree};
use super::settings::{LeafPolygons, Outlines, Settings};
use super::stroke::{Segment, SingleSegment, StrokeRules};
use crate::draw_list::{Chain, DrawList, Role};
use crate::index::BoxTree;
use crate::parallel;
use crate::space::{Plan, PlanBox};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Segments that are indexed together: a cell is built from the runs whose boxes meet it.
pub(super) const SEGMENTS_OF_A_RUN: u32 = 32;

/// Items that one piece of parallel work looks at.
const ITEMS_AT_A_TIME: usize = 512;

/// Some consecutive segments of a stroke.
#[derive(Debug, Clone, Copy)]
pub(super) struct Run {
    pub(super) item: u32,
    /// Its chain's place among those of the item.
    pub(super) chain: u32,
    /// The first of them in the chain.
    pub(super) first: u32,
}

/// A ring of an area.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ring {
    /// The item that owns the area.
    pub(super) owner: u32,
    /// The ring's place among the area's.
    place: u32,
}

/// All that cells are built from.
#[derive(Debug)]
pub(super) struct Source<'l> {
    pub(super) list: &'l DrawList,
    limits: Limits,
    closing: LeafPolygons,
    /// Of which side of outlines samples are asked.
    pub(super) outlines: Outlines,
    /// How strokes of each style are drawn; none of what is no stroke in metres.
    pub(super) rules: Vec<Option<StrokeRules>>,
    pub(super) runs: Vec<Run>,
    pub(super) run_boxes: BoxTree,
    rings: Vec<Ring>,
    pub(super) ring_boxes: BoxTree,
    quadtrees: Vec<OnceLock<Box<Quadtree>>>,
    /// The bytes of those that have been built.
    quadtree_bytes: AtomicUsize,
    /// What is outside of a layer's polygons: in every cell.
    pub(super) everywhere: Vec<u32>,
    /// Around all decals.
    pub(super) bounds: PlanBox,
}

impl<'l> Source<'l> {
    /// Looks at each vertex once.
    pub(super) fn new(list: &'l DrawList, settings: &Settings) -> Self {
        let rules = list.styles().iter().map(|style| StrokeRules::of(style.stroke.as_ref()?, settings.joins));
        let rules: Vec<Option<StrokeRules>> = rules.collect();
        let items = list.items().len();
        let parts = parallel::map_indices(items.div_ceil(ITEMS_AT_A_TIME), |k| {
            let mut part = IndexPart::default();
            for item in k * ITEMS_AT_A_TIME..items.min((k + 1) * ITEMS_AT_A_TIME) {
                part.add(list, &rules, item as u32);
            }
            part
        });
        let mut all = IndexPart::default();
        parts.into_iter().for_each(|part| all.append(part));
        let mut bounds = PlanBox::EMPTY;
        all.run_boxes.iter().chain(&all.ring_boxes).for_each(|plan| bounds.include_box(plan));
        Self {
            list,
            limits: Limits { capacity: settings.leaf_capacity, depth: settings.depth },
            closing: settings.leaf_polygons,
            outlines: settings.outlines,
            rules,
            runs: all.runs,
            run_boxes: BoxTree::new(&all.run_boxes),
            quadtrees: all.rings.iter().map(|_| OnceLock::new()).collect(),
            quadtree_bytes: AtomicUsize::new(0),
            rings: all.rings,
            ring_boxes: BoxTree::new(&all.ring_boxes),
            everywhere: all.everywhere,
            bounds,
        }
    }

    /// Whether something is to be found outside of the box around all strokes and rings.
    pub(super) fn is_everywhere(&self) -> bool {
        !self.everywhere.is_empty()
    }

    /// Whether no stroke and no ring meets a box, as far as their boxes tell.
    pub(super) fn is_bare(&self, plan: &PlanBox) -> bool {
        !self.is_everywhere()
            && self.run_boxes.query(plan, |_| false)
            && self.ring_boxes.query(plan, |_| false)
    }

    /// The rings of the area that an item owns.
    pub(super) fn rings_of(&self, owner: u32) -> impl Iterator<Item = u32> {
        let place = |end: u32| self.rings.partition_point(|ring| ring.owner < end) as u32;
        place(owner)..place(owner + 1)
    }

    /// How often a ring turns around a point.
    pub(super) fn turns_around(&self, ring: u32, at: Plan) -> i32 {
        let quadtree = self.quadtree(ring);
        let start = quadtree.start_in(&PlanBox::around([at]));
        start.map_or(0, |start| quadtree.winding(self.list.vertices(), start, at, &mut Default::default()))
    }

    /// The chain of a ring.
    pub(super) fn chain_of(&self, ring: u32) -> &'l Chain {
        let Ring { owner, place } = self.rings[ring as usize];
        &self.list.area(&self.list.items()[owner as usize])[place as usize]
    }

    /// A ring's quadtree, built when it is first asked for.
    #[inline(always)]
    pub(super) fn quadtree(&self, ring: u32) -> &Quadtree {
        self.quadtrees[ring as usize].get_or_init(|| {
            let chain = self.chain_of(ring);
            let quadtree = Quadtree::new(self.list.path_of(chain), chain.first, self.limits, self.closing);
            self.quadtree_bytes.fetch_add(quadtree.bytes(), Ordering::Relaxed);
            Box::new(quadtree)
        })
    }

    /// All rings, owner by owner.
    pub(super) fn rings(&self) -> &[Ring] {
        &self.rings
    }

    /// The segment of a leaf, made ready.
    #[inline(always)]
    pub(super) fn segment(&self, leaf: LineLeaf) -> Option<Segment> {
        let (path, is_closed, rules) = self.stroke_of(leaf)?;
        Some(Segment::new(path, is_closed, leaf.vertex as usize, rules))
    }

    /// The same for tests in single precision.
    pub(super) fn single_segment(&self, leaf: LineLeaf) -> Option<SingleSegment> {
        let (path, is_closed, rules) = self.stroke_of(leaf)?;
        Some(SingleSegment::new(path, is_closed, leaf.vertex as usize, rules))
    }

    #[inline(always)]
    fn stroke_of(&self, leaf: LineLeaf) -> Option<(&'l [Plan], bool, &StrokeRules)> {
        let item = &self.list.items()[leaf.item as usize];
        let chain = &self.list.strokes(item)[leaf.chain as usize];
        Some((self.list.path_of(chain), chain.is_closed, self.rules[item.style as usize].as_ref()?))
    }

    /// Bytes of what finds the segments and rings that lie in a cell.
    pub(super) fn index_bytes(&self) -> usize {
        size_of_val(&self.runs[..])
            + size_of_val(&self.rings[..])
            + self.run_boxes.bytes()
            + self.ring_boxes.bytes()
    }

    /// Bytes of the quadtrees that have been built, and of the list of all.
    pub(super) fn quadtree_bytes(&self) -> usize {
        size_of_val(&self.quadtrees[..]) + self.quadtree_bytes.load(Ordering::Relaxed)
    }
}

/// The index of some items.
#[derive(Debug, Default)]
struct IndexPart {
    runs: Vec<Run>,
    run_boxes: Vec<PlanBox>,
    rings: Vec<Ring>,
    ring_boxes: Vec<PlanBox>,
    everywhere: Vec<u32>,
}

impl IndexPart {
    fn append(&mut self, other: Self) {
        self.runs.extend(other.runs);
        self.run_boxes.extend(other.run_boxes);
        self.rings.extend(other.rings);
        self.ring_boxes.extend(other.ring_boxes);
        self.everywhere.extend(other.everywhere);
    }

    fn add(&mut self, list: &DrawList, rules: &[Option<StrokeRules>], number: u32) {
        let item = &list.items()[number as usize];
        let around = |points: &[Plan]| PlanBox::around(points.iter().copied());
        if let Some(rules) = &rules[item.style as usize] {
            for (chain, place) in list.strokes(item).iter().zip(0..) {
                let path = list.path_of(chain);
                for first in (0..chain.segments().max(1)).step_by(SEGMENTS_OF_A_RUN as usize) {
                    let end = (first as usize + SEGMENTS_OF_A_RUN as usize + 1).min(path.len());
                    self.runs.push(Run { item: number, chain: place, first });
                    self.run_boxes.push(around(&path[first as usize..end]).grown(rules.reach()));
                }
            }
        }
        if list.style_of(number).role == Role::Outside {
            self.everywhere.push(number);
        }
        if list.area_owner(number) == number {
            for (ring, place) in list.area(item).iter().zip(0..) {
                self.rings.push(Ring { owner: number, place });
                self.ring_boxes.push(around(list.vertices_of(ring)));
            }
        }
    }
}
