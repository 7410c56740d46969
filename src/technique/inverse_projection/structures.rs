//! The expanded areas as buffers: what quadrilaterals and samples are compared with (3.1, 3.5).

use super::DECLARATION;
use super::edge_index::EdgeIndex;
use crate::buffer::{Plane, Values};
use crate::canvas::{FrameOptions, table};
use crate::draw_list::{Item, NO_FEATURE};
use crate::scene::Rule;

/// The tables, rows of `client.md`'s columns.
#[derive(Default)]
struct Tables {
    areas: Vec<[u32; 8]>,
    edges: Vec<[f64; 4]>,
    edge_areas: Vec<[u32; 1]>,
    edge_sides: Vec<[u8; 1]>,
}

/// The structures that are wanted; none are made where none is wanted.
pub(super) fn planes(index: &EdgeIndex, items: &[Item], options: &FrameOptions) -> Vec<Plane> {
    let kinds = DECLARATION.planes.iter().filter(|kind| kind.is_structure && options.wants(kind.name));
    let mut wanted = kinds.map(|kind| kind.name).peekable();
    if wanted.peek().is_none() {
        return Vec::new();
    }
    let mut tables = Tables::of(index, items);
    wanted.filter_map(|name| tables.plane(name)).collect()
}

impl Tables {
    fn of(index: &EdgeIndex, items: &[Item]) -> Self {
        let mut tables = Self::default();
        let mut areas = Vec::new();
        for edge in index.edges() {
            if areas.last() != Some(&edge.area) {
                areas.push(edge.area);
            }
            tables.edges.push([edge.a.x, edge.a.y, edge.b.x, edge.b.y]);
            tables.edge_areas.push([areas.len() as u32 - 1]);
            tables.edge_sides.push([u8::from(edge.outside_is_left)]);
        }
        for area in &areas {
            let item = &items[area.item() as usize];
            let cut = index.cut_of(*area);
            let kept = cut.map_or(0, |(_, keeps_inside)| if keeps_inside { 1 } else { 2 });
            let cutter = cut.and_then(|(cutter, _)| areas.binary_search(&cutter).ok());
            tables.areas.push([
                area.item(),
                item.layer,
                item.feature,
                u32::from(area.is_stroke()),
                u32::from(index.rule_of(*area) == Rule::NonZero),
                u32::from(index.painted_by(*area).is_some()),
                kept,
                cutter.map_or(NO_FEATURE, |row| row as u32),
            ]);
        }
        tables
    }

    /// A structure, taken out of the tables.
    fn plane(&mut self, name: &'static str) -> Option<Plane> {
        Some(match name {
            "areas" => table(name, &mut self.areas, Values::U32),
            "area-edges" => table(name, &mut self.edges, Values::F64),
            "edge-areas" => table(name, &mut self.edge_areas, Values::U32),
            "edge-sides" => table(name, &mut self.edge_sides, Values::U8),
            _ => return None,
        })
    }
}
