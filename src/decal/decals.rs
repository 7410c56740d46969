//! The structures: the grid's cells, and the index that they are built from.

use super::build::Source;
use super::cell::Cell;
use super::contents::RingsAs;
use super::grid::DecalGrid;
use super::memory::{Built, Memory};
use super::packet::single;
use super::settings::{Edges, LeafPolygons, Preparation, Settings};
use super::side::Sides;
use crate::draw_list::DrawList;
use crate::parallel;
use crate::space::{Plan, PlanBox};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// How far the grid may reach beyond the terrain, as a share of its size: a plan point is good to 2^-30 of its distance from the eye
/// (`predicate`), so that a sample on the rim may lie a little outside. Eyes up to a thousand times as far away as the terrain is wide are well.
const RIM: f64 = 1.0 / (1u64 << 20) as f64;

/// Static decals: which items hold which points of the plan.
#[derive(Debug)]
pub struct Decals<'l> {
    pub(super) source: Source<'l>,
    pub(super) grid: DecalGrid,
    cells: Vec<OnceLock<Option<Arc<Cell>>>>,
    /// Cells that many places share: those in which all is covered by the same fills, whose items are the key.
    shared: Mutex<BTreeMap<Vec<u32>, Arc<Cell>>>,
    /// The sum of what is in the cells that have been built.
    built: Built,
    pub(super) sides: Sides,
    pub(super) settings: Settings,
    /// As what cells have rings.
    pub(super) rings_as: RingsAs,
    /// Whether points, vertices and tests are of single precision.
    pub(super) is_single: bool,
}

impl<'l> Decals<'l> {
    /// The decals of a list, above a terrain that covers `terrain` of the plan. Cells are built when a point is first looked up in them, or all
    /// at once, as the settings say; `progress` is told the share that is done then.
    pub fn new(
        list: &'l DrawList,
        terrain: &PlanBox,
        settings: &Settings,
        is_single: bool,
        progress: &(dyn Fn(f64) + Sync),
    ) -> Self {
        let source = Source::new(list, settings);
        let terrain = terrain.grown(RIM * (terrain.max - terrain.min).max_element());
        // Where the terrain is not, nothing is seen; what paints everywhere needs all of it.
        let bounds = match source.is_everywhere() {
            true => terrain,
            false => source.bounds.common(&terrain),
        };
        let grid = DecalGrid::new(&bounds, settings.grid);
        // A machine, leaves that are clipped and distances from edges are to find what the thesis's own structures have.
        let is_by_points =
            settings.edges == Edges::Sampled && settings.leaf_polygons == LeafPolygons::Corner && !is_single;
        let rings_as = if is_by_points { RingsAs::Turns } else { RingsAs::Trees };
        let cells = (0..grid.count()).map(|_| OnceLock::new()).collect();
        let decals = Self {
            sides: Sides::of(list),
            source,
            grid,
            cells,
            shared: Mutex::default(),
            rings_as,
            built: Built::default(),
            settings: *settings,
            is_single,
        };
        if settings.preparation == Preparation::Whole {
            decals.build_all(progress);
        }
        decals
    }

    /// Builds what has not been built.
    fn build_all(&self, progress: &(dyn Fn(f64) + Sync)) {
        let side = self.grid.side();
        parallel::map_telling(side as usize, progress, |row| {
            for column in 0..side {
                self.cell(column + side * row as u32);
            }
        });
    }

    /// Whether points of a box lie in cells that have nothing in them, as far as can be told without building these.
    pub fn is_bare(&self, plan: &PlanBox) -> bool {
        // A machine finds cells by other numbers.
        !self.is_single && self.grid.box_around(plan).is_none_or(|cells| self.source.is_bare(&cells))
    }

    /// The draw list.
    pub fn list(&self) -> &'l DrawList {
        self.source.list
    }

    /// A cell, built when it is first asked for.
    #[inline(always)]
    pub(super) fn cell(&self, number: u32) -> Option<&Cell> {
        self.cells[number as usize].get_or_init(|| self.build(number)).as_deref()
    }

    #[cold]
    fn build(&self, number: u32) -> Option<Arc<Cell>> {
        let plan = self.grid.box_of(number);
        let contents = self.source.contents(&plan, self.rings_as);
        let fills = contents.fills_throughout().filter(|_| self.rings_as == RingsAs::Turns);
        let new = || contents.into_cell(self.settings.hierarchy, &plan).map(|cell| self.built.added(cell));
        let cell = match fills {
            None => new(),
            Some(fills) => {
                let mut shared = self.shared.lock().unwrap_or_else(PoisonError::into_inner);
                match shared.get(&fills) {
                    Some(known) => Some(known.clone()),
                    None => new().inspect(|cell| drop(shared.insert(fills, cell.clone()))),
                }
            }
        };
        cell.inspect(|_| self.built.count())
    }

    /// A cell that is built of what meets a box.
    pub(super) fn cell_around(&self, plan: &PlanBox, rings_as: RingsAs) -> Option<Cell> {
        self.source.contents(plan, rings_as).into_cell(self.settings.hierarchy, plan)
    }

    /// The number of the cell that a point lies in; `None` outside the grid.
    #[inline(always)]
    pub fn cell_of(&self, at: Plan) -> Option<u32> {
        if self.is_single { self.grid.cell_of_f32(single(at)) } else { self.grid.cell_of(at) }
    }

    /// Bytes held, without the draw list: of what has been built.
    pub fn memory(&self) -> Memory {
        let cells = self.built.cells();
        Memory {
            cells,
            grid: size_of_val(&self.cells[..]) + self.built.cell_bytes(),
            lines: self.built.line_bytes(),
            polygons: self.built.polygon_bytes(),
            quadtrees: self.source.quadtree_bytes(),
            index: self.source.index_bytes(),
        }
    }
}
