//! All edges of items' areas and all segments of their strokes, and which of them may lie near a place of the plan.

use super::boxes::comes_near;
use super::pieces::{Segment, segment_box};
use crate::draw_list::{Chain, DrawList};
use crate::index::BoxTree;
use crate::predicate::orient2d;
use crate::scene::{Line, Width};
use crate::space::{Plan, PlanBox};

/// Edges or segments that have a box together.
const RUN: usize = 16;

/// Consecutive edges or segments of a chain.
#[derive(Debug, Clone, Copy)]
struct Run {
    item: u32,
    /// The chain's place among those of the item.
    chain: u32,
    /// The first of its edges.
    first: u32,
    count: u32,
}

/// Runs and a tree of their boxes.
#[derive(Debug, Default)]
struct Runs {
    runs: Vec<Run>,
    tree: BoxTree,
}

impl Runs {
    fn new(runs: Vec<Run>, bounds: impl Fn(&Run) -> PlanBox) -> Self {
        let boxes: Vec<PlanBox> = runs.iter().map(bounds).collect();
        Self { tree: BoxTree::new(&boxes), runs }
    }

    /// The runs that may meet a box, in draw order.
    fn near(&self, plan: &PlanBox) -> impl Iterator<Item = &Run> {
        self.tree.found(plan).into_iter().map(|number| &self.runs[number as usize])
    }
}

/// An edge of the border of an item's area.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    pub(super) item: u32,
    pub(super) from: Plan,
    pub(super) to: Plan,
    pub(super) bounds: PlanBox,
}

impl Edge {
    fn new(item: u32, from: Plan, to: Plan) -> Self {
        Self { item, from, to, bounds: PlanBox::around([from, to]) }
    }

    /// Whether it may meet a box.
    #[inline]
    pub(super) fn meets(&self, plan: &PlanBox) -> bool {
        self.bounds.meets(plan) && comes_near([self.from, self.to], 0.0, plan)
    }
}

/// A segment of an item's stroke.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stroked {
    pub(super) item: u32,
    pub(super) segment: Segment,
    /// What it may reach; of a width in pixels its centre line alone.
    pub(super) bounds: PlanBox,
}

impl Stroked {
    /// Whether it may reach into a box.
    pub(super) fn meets(&self, plan: &PlanBox) -> bool {
        let Segment { from, to, .. } = self.segment;
        let reach = crate::math::min(from.x, to.x) - self.bounds.min.x;
        self.bounds.meets(plan) && comes_near([from, to], reach, plan)
    }
}

impl Stroked {
    /// Whether a point of a box may be no farther from it than so many metres.
    pub(super) fn comes_within(&self, reach: f64, plan: &PlanBox) -> bool {
        let Segment { from, to, .. } = self.segment;
        // Far more than rounding.
        let reach = reach * (1.0 + 1e-9);
        PlanBox::around([from, to]).grown(reach).meets(plan) && comes_near([from, to], reach, plan)
    }

    /// Whether all of a convex polygon is clearly no farther from it than so many metres.
    pub(super) fn holds_within(&self, reach: f64, polygon: &[Plan]) -> bool {
        let Segment { from, to, .. } = self.segment;
        let reach = reach * (1.0 - 1e-9);
        let (along, squared) = (to - from, (to - from).length_squared());
        reach > 0.0
            && polygon.iter().all(|p| {
                let share =
                    if squared > 0.0 { ((*p - from).dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
                (*p - from - along * share).length_squared() < reach * reach
            })
    }
}

/// What items are made of.
#[derive(Debug)]
pub(super) struct Features<'s> {
    list: &'s DrawList,
    areas: Runs,
    /// Strokes as wide as so many metres.
    strokes: Runs,
    /// The centre lines of strokes as wide as so many pixels.
    dynamic: Runs,
}

impl<'s> Features<'s> {
    /// Indexes a list's items.
    pub(super) fn new(list: &'s DrawList) -> Self {
        let (mut areas, mut strokes, mut dynamic) = (Vec::new(), Vec::new(), Vec::new());
        for (number, item) in list.numbered() {
            add_runs(number, list.border(item), &mut areas);
            match list.style_of(number).stroke.map(|line| line.width) {
                Some(Width::Metres(_)) => add_runs(number, list.strokes(item), &mut strokes),
                Some(Width::Pixels(_)) => add_runs(number, list.strokes(item), &mut dynamic),
                None => {}
            }
        }
        let stroke_box = |run: &Run| {
            let mut bounds = PlanBox::EMPTY;
            segments(list, run).for_each(|stroked| bounds.include_box(&stroked.bounds));
            bounds
        };
        Self {
            list,
            areas: Runs::new(areas, |run| {
                PlanBox::around(edges(list, run).flat_map(|edge| [edge.from, edge.to]))
            }),
            strokes: Runs::new(strokes, stroke_box),
            dynamic: Runs::new(dynamic, stroke_box),
        }
    }

    /// Whether there are strokes whose width is in pixels.
    pub(super) fn has_dynamic(&self) -> bool {
        !self.dynamic.runs.is_empty()
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        let of = |runs: &Runs| size_of_val(&runs.runs[..]) + runs.tree.bytes();
        of(&self.areas) + of(&self.strokes) + of(&self.dynamic)
    }

    /// Calls `visit` with the edges that meet a box, in draw order.
    pub(super) fn edges_near(&self, plan: &PlanBox, mut visit: impl FnMut(Edge)) {
        let near = self.areas.near(plan).flat_map(|run| edges(self.list, run));
        near.filter(|edge| edge.bounds.meets(plan)).for_each(&mut visit);
    }

    /// Calls `visit` with the segments whose strokes may meet a box, each list in draw order; `most` is half of how wide a stroke is at most
    /// there whose width is one pixel.
    pub(super) fn strokes_near(&self, plan: &PlanBox, most: f64, mut visit: impl FnMut(Stroked)) {
        let near = self.strokes.near(plan).flat_map(|run| segments(self.list, run));
        near.filter(|stroked| stroked.bounds.meets(plan)).for_each(&mut visit);
        if !self.has_dynamic() {
            return;
        }
        let widest = self.list.styles().iter().filter_map(|style| match style.stroke?.width {
            Width::Pixels(width) => Some(width),
            Width::Metres(_) => None,
        });
        let widest = widest.fold(0.0, |most, width| crate::math::max(width, most));
        let grown = plan.grown(most * widest);
        let near = self.dynamic.near(&grown).flat_map(|run| segments(self.list, run));
        let grown = near.map(|stroked| Stroked { bounds: stroked.bounds.grown(most * widest), ..stroked });
        grown.filter(|stroked| stroked.bounds.meets(plan)).for_each(&mut visit);
    }

    /// Calls `visit` with each edge that crosses the ray from a point to the east, and what it adds to the winding number there.
    pub(super) fn crossings_east_of(&self, at: Plan, mut visit: impl FnMut(u32, i32)) {
        let ray = PlanBox { min: at, max: Plan::new(f64::MAX, at.y) };
        for edge in self.areas.near(&ray).flat_map(|run| edges(self.list, run)) {
            let is_up = edge.from.y <= at.y && edge.to.y > at.y;
            let is_down = edge.from.y > at.y && edge.to.y <= at.y;
            if is_up && orient2d(edge.from, edge.to, at) >= 0.0 {
                visit(edge.item, 1);
            } else if is_down && orient2d(edge.from, edge.to, at) < 0.0 {
                visit(edge.item, -1);
            }
        }
    }
}

/// What is added to the winding number by going straight from one point to another over an edge whose box the way meets.
#[inline]
pub(super) fn crossing(edge: &Edge, from: Plan, to: Plan) -> i32 {
    let is_left = |p: Plan| orient2d(edge.from, edge.to, p) >= 0.0;
    let (was, is) = (is_left(from), is_left(to));
    if was == is {
        return 0;
    }
    // The edge's ends lie on both sides of the way.
    let side = |p: Plan| orient2d(from, to, p) >= 0.0;
    if side(edge.from) == side(edge.to) {
        return 0;
    }
    if is { 1 } else { -1 }
}

/// Adds the runs of an item's chains.
fn add_runs(item: u32, chains: &[Chain], out: &mut Vec<Run>) {
    for (number, chain) in (0..).zip(chains) {
        // A dot is a segment of no length.
        let count = chain.segments().max(1);
        for first in (0..count).step_by(RUN) {
            out.push(Run { item, chain: number, first, count: (count - first).min(RUN as u32) });
        }
    }
}

/// The edges of a run of a border.
fn edges<'a>(list: &'a DrawList, run: &'a Run) -> impl Iterator<Item = Edge> + 'a {
    let chain = &list.border(&list.items()[run.item as usize])[run.chain as usize];
    let first = (chain.first + run.first) as usize;
    let vertices = &list.vertices()[first..=first + run.count as usize];
    vertices.windows(2).map(|ends| Edge::new(run.item, ends[0], ends[1]))
}

/// The segments of a run of a stroke.
fn segments<'a>(list: &'a DrawList, run: &'a Run) -> impl Iterator<Item = Stroked> + 'a {
    let chain = &list.strokes(&list.items()[run.item as usize])[run.chain as usize];
    let path = list.path_of(chain);
    let line = list.style_of(run.item).stroke;
    (run.first..run.first + run.count).map(move |k| {
        let k = k as usize;
        let before = match k {
            0 => chain.is_closed.then(|| path[path.len() - 2]),
            _ => Some(path[k - 1]),
        };
        let to = path.get(k + 1).copied().unwrap_or(path[k]);
        let is_last = !chain.is_closed && k + 2 >= path.len();
        let segment = Segment { before, from: path[k], to, is_last };
        Stroked { item: run.item, segment, bounds: bounds_of(&segment, line.as_ref()) }
    })
}

/// What a segment may reach; of a width in pixels its centre line.
fn bounds_of(segment: &Segment, line: Option<&Line>) -> PlanBox {
    match line {
        Some(line) => match line.width {
            Width::Metres(width) => segment_box(segment, line, width / 2.0),
            Width::Pixels(_) => PlanBox::around([segment.from, segment.to]),
        },
        None => PlanBox::EMPTY,
    }
}
