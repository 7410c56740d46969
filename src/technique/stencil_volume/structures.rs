//! The volumes as buffers: tables that a graphics processor can draw from (4.1), with what this view makes of them (4.2.1).

use super::DECLARATION;
use super::context::FrameContext;
use super::stencil::Method;
use crate::buffer::{Plane, Values};
use crate::canvas::{FrameOptions, table};
use crate::draw_list::NO_FEATURE;
use crate::scene::Rule;

/// The tables, rows of `client.md`'s columns.
#[derive(Default)]
struct Tables {
    objects: Vec<[u32; 8]>,
    volumes: Vec<[u32; 6]>,
    levels: Vec<[f64; 2]>,
    rings: Vec<[u32; 2]>,
    corners: Vec<[f64; 2]>,
}

/// The structures that are wanted; none are made where none is wanted.
pub(super) fn planes(context: &FrameContext, options: &FrameOptions) -> Vec<Plane> {
    let kinds = DECLARATION.planes.iter().filter(|kind| kind.is_structure && options.wants(kind.name));
    let mut wanted = kinds.map(|kind| kind.name).peekable();
    if wanted.peek().is_none() {
        return Vec::new();
    }
    let mut tables = Tables::default();
    tables.add_volumes(context);
    tables.add_objects(context);
    wanted.filter_map(|name| tables.plane(name)).collect()
}

impl Tables {
    fn add_volumes(&mut self, context: &FrameContext) {
        let extrusion = context.extrusion;
        let mut is_in_view = vec![false; extrusion.volumes.len()];
        context.looks.in_view().for_each(|volume| is_in_view[volume] = true);
        for (number, volume) in extrusion.volumes.iter().enumerate() {
            let first = self.rings.len() as u32;
            for ring in extrusion.rings_of(volume) {
                self.rings.push([self.corners.len() as u32, ring.len() as u32]);
                self.corners.extend(ring.iter().map(|corner| [corner.x, corner.y]));
            }
            let is_failed = context.looks.methods[number] == Method::ZFail;
            let flags = [is_failed, volume.is_box, is_in_view[number]].map(u32::from);
            let [method, caps, seen] = flags;
            self.volumes.push([first, self.rings.len() as u32 - first, method, caps, seen, 0]);
            self.levels.push([volume.low, volume.high]);
        }
    }

    fn add_objects(&mut self, context: &FrameContext) {
        let (extrusion, items) = (context.extrusion, context.stage.draw_list.items());
        let mut passes = vec![NO_FEATURE; items.len()];
        for (number, pass) in (0..).zip(&extrusion.passes) {
            pass.objects.iter().for_each(|object| passes[*object as usize] = number);
        }
        for (number, (item, object)) in (0..).zip(items.iter().zip(&extrusion.objects)) {
            let is_even_odd = extrusion.rule_of(number) == Rule::EvenOdd;
            for volume in object.volumes.clone() {
                self.volumes[volume as usize][5] = u32::from(!is_even_odd);
            }
            let cut = extrusion.cut_of(number);
            let cutters = if cut.is_some() { object.cutters.clone() } else { 0..0 };
            let kept = cut.map_or(0, |(_, keeps_inside)| if keeps_inside { 1 } else { 2 });
            self.objects.push([
                item.layer,
                item.feature,
                passes[number as usize],
                object.volumes.start,
                object.volumes.end - object.volumes.start,
                cutters.start,
                cutters.end - cutters.start,
                kept,
            ]);
        }
    }

    /// A structure, taken out of the tables.
    fn plane(&mut self, name: &'static str) -> Option<Plane> {
        Some(match name {
            "objects" => table(name, &mut self.objects, Values::U32),
            "volumes" => table(name, &mut self.volumes, Values::U32),
            "volume-levels" => table(name, &mut self.levels, Values::F64),
            "volume-rings" => table(name, &mut self.rings, Values::U32),
            "volume-corners" => table(name, &mut self.corners, Values::F64),
            _ => return None,
        })
    }
}
