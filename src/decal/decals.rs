//! The structures: the grid's cells, and the index that they are built from.

use super::build::Source;
use super::cell::Cell;
use super::grid::DecalGrid;
use super::memory::{Built, Memory};
use super::packet::single;
use super::settings::{Preparation, Settings};
use super::side::Sides;
use crate::draw_list::DrawList;
use crate::parallel;
use crate::space::{Plan, PlanBox};
use std::sync::OnceLock;

/// Static decals: which items hold which points of the plan.
#[derive(Debug)]
pub struct Decals<'l> {
    pub(super) source: Source<'l>,
    pub(super) grid: DecalGrid,
    pub(super) cells: Vec<OnceLock<Option<Box<Cell>>>>,
    /// The sum of what is in the cells that have been built.
    built: Built,
    pub(super) sides: Sides,
    pub(super) settings: Settings,
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
        // Where the terrain is not, nothing is seen; what paints everywhere needs all of it.
        let bounds = match source.is_everywhere() {
            true => *terrain,
            false => source.bounds.common(terrain),
        };
        let grid = DecalGrid::new(&bounds, settings.grid);
        let cells = (0..grid.count()).map(|_| OnceLock::new()).collect();
        let decals = Self {
            sides: Sides::of(list),
            source,
            grid,
            cells,
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
    pub(super) fn build_all(&self, progress: &(dyn Fn(f64) + Sync)) {
        let side = self.grid.side();
        parallel::map_telling(side as usize, progress, |row| {
            for column in 0..side {
                self.cell(column + side * row as u32);
            }
        });
    }

    /// The draw list.
    pub fn list(&self) -> &'l DrawList {
        self.source.list
    }

    /// A cell, built when it is first asked for.
    #[inline(always)]
    pub(super) fn cell(&self, number: u32) -> Option<&Cell> {
        let build = || {
            let cell = self.cell_around(&self.grid.box_of(number));
            cell.iter().for_each(|cell| self.built.add(cell));
            cell
        };
        self.cells[number as usize].get_or_init(build).as_deref()
    }

    /// A cell that is built of what meets a box.
    pub(super) fn cell_around(&self, plan: &PlanBox) -> Option<Box<Cell>> {
        self.source.contents(plan).into_cell(self.settings.hierarchy, plan)
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
            grid: size_of_val(&self.cells[..]) + cells * size_of::<Cell>(),
            lines: self.built.line_bytes(),
            polygons: self.built.polygon_bytes(),
            quadtrees: self.source.quadtree_bytes(),
            index: self.source.index_bytes(),
        }
    }
}
