//! A tile's volumes counted and its masks applied in draw order (Fig. 4).
//!
//! Input: the volumes that may touch the tile. Output: the tile's colours and, where they are asked for, its stencil planes. Refuses: nothing.
//!
//! Counting is done in one of three ways, all with the same mask where they all apply:
//! - *in passing* ([`Way::Sparse`]): the filter and the exact predicates, only in blocks whose surface points may lie in the volume, and
//!   of a volume of one convex ring only near its faces. Elsewhere the faces that a line crosses before (or behind) its point cancel, or
//!   leave one in the volume, so that nothing is lost while counts wrap;
//! - *in full* ([`Way::Full`]): the same in every block that the volume's picture touches, fragment by fragment in order, the
//!   mask applied through the boxes of the volumes (4.2.2). For planes to look at, and wherever something is asked for that does not cancel;
//! - *on a machine* ([`Way::Machine`]): fragments and depth test of the imitated graphics processor.

use super::block::{COLUMNS, ROWS, SIZE};
use super::context::Way;
use super::face::{Face, Fragment, Outline};
use super::fragments::{Convex, Sparse};
use super::solid::Solid;
use super::stencil::{Method, passes};
use super::step::Step;
use super::tile::{Tile, sample_of};
use super::view::Entry;
use crate::canvas::Record;
use crate::scene::Rule;
use crate::technique::stencil_volume::VolumeCaps;

impl<R: Record<Step>> Tile<'_, R> {
    /// Draws volumes in order, each pass's mask once (4.2).
    pub fn draw(&mut self, entries: &[Entry]) {
        for pass in entries.chunk_by(|a, b| a.pass == b.pass) {
            let stroke = pass.partition_point(|e| e.is_cutter);
            let (cutters, volumes) = pass.split_at(stroke);
            self.enter(self.context.group_of(pass[0].pass));
            let cut = self.context.cut_of(pass[0].pass);
            if let Some((rule, _)) = cut {
                self.stencil.inside = vec![[false; SIZE]; self.blocks.len()];
                self.count_all(cutters);
                self.cut(cutters, rule);
                self.stencil.width.bits -= 1;
            }
            self.count_all(volumes);
            self.apply(volumes, cut.map(|(_, keeps_inside)| keeps_inside));
            self.stencil.width = self.context.stencil_width();
            self.counts.masks += 1;
        }
        self.enter(None);
    }

    /// The first sub-step of an outline that is cut: what the polygon's mask says is kept in a bit.
    fn cut(&mut self, cutters: &[Entry], rule: Rule) {
        self.for_each_masked(cutters, |tile, at| {
            let value = tile.stencil.take(at);
            let is_inside = passes(value, rule);
            tile.stencil.inside[at.0][at.1] |= is_inside;
            tile.record.step(|| Step::Cut { sample: sample_of(&tile.blocks, at), value, is_inside });
        });
    }

    /// Generates the mask (4.2.1).
    fn count_all(&mut self, entries: &[Entry]) {
        for entry in entries {
            match self.context.way {
                Way::Sparse => self.count_sparsely(entry),
                Way::Full => self.count_fully(entry),
                Way::Machine => self.count_on_machine(entry),
            }
        }
    }

    /// Applies the mask (4.2.2); `keeps_inside`: only inside, or only outside, of what was cut to.
    fn apply(&mut self, entries: &[Entry], keeps_inside: Option<bool>) {
        let Some(entry) = entries.first() else { return };
        let (paint, rule) = self.context.paint_of(entry.pass);
        let (item, is_traced) = (self.context.item_of(entry.pass), self.context.is_traced(entry.pass));
        let is_picked = self.context.settings.object.is_some();
        self.for_each_masked(entries, |tile, at| {
            let value = tile.stencil.take(at);
            if let (Some(traces), true) = (&mut tile.traces, is_traced) {
                let trace = &mut traces.stencil[at.0][at.1];
                // A mask is applied through several boxes: only the first finds it.
                if value != 0 || is_picked && *trace == 0 {
                    *trace = value;
                }
            }
            let is_kept = keeps_inside.is_none_or(|keep| tile.stencil.inside[at.0][at.1] == keep);
            let is_painted = is_kept && passes(value, rule);
            if is_painted {
                tile.paint(at, paint);
                tile.touch(at, item);
            }
            tile.record.step(|| {
                let sample = sample_of(&tile.blocks, at);
                let items = tile.context.extrusion.passes[entry.pass as usize].objects.clone();
                Step::Mask { sample, pass: entry.pass, items, value, paint: is_painted.then_some(paint) }
            });
        });
    }

    /// Calls `visit` with each sample that the mask is applied to.
    fn for_each_masked(&mut self, entries: &[Entry], mut visit: impl FnMut(&mut Self, (usize, usize))) {
        if self.context.way == Way::Sparse {
            for block in 0..self.blocks.len() {
                if !std::mem::take(&mut self.stencil.touched[block]) {
                    continue;
                }
                for at in 0..SIZE {
                    if self.stencil.counts[block][at] != 0 {
                        visit(self, (block, at));
                    }
                }
            }
            return;
        }
        for entry in entries {
            let method = self.context.method_of(entry.volume);
            for outline in self.context.box_of(entry.volume) {
                self.for_each_fragment(&outline, entry, &mut |tile, at, fragment| {
                    // Fronts with the depth test for z-pass, backs without for z-fail.
                    let is_drawn = match method {
                        Method::ZPass => fragment.facing == 1 && !fragment.is_behind,
                        Method::ZFail => fragment.facing == -1,
                    };
                    if is_drawn {
                        visit(tile, at);
                    }
                });
            }
        }
    }

    /// Sets up the faces of a volume.
    fn set_up(&mut self, entry: &Entry) -> Vec<Face> {
        let mut faces = std::mem::take(&mut self.faces);
        let (extrusion, volume) = (self.context.extrusion, self.context.volume(entry.volume));
        self.setup().faces(extrusion, volume, self.context.is_cut(entry.volume), &mut faces);
        self.counts.faces += faces.len() as u64;
        faces
    }

    fn count_sparsely(&mut self, entry: &Entry) {
        let volume = self.context.volume(entry.volume);
        let o = self.place.origin;
        let low = [volume.plan.min.x - o.x, volume.plan.min.y - o.y, volume.low - o.z];
        let high = [volume.plan.max.x - o.x, volume.plan.max.y - o.y, volume.high - o.z];
        let slack = 2.0 * self.place.error + self.place.reach * f64::from(f32::EPSILON);
        let ((c0, r0), (c1, r1)) = entry.samples_in(&self.view);
        let mut met = std::mem::take(&mut self.met);
        met.clear();
        for y in r0 / ROWS..=r1 / ROWS {
            let row = y * self.blocks_a_row;
            let blocks = row + c0 / COLUMNS..=row + c1 / COLUMNS;
            met.extend(blocks.filter(|&b| self.blocks[b].meets(&low, &high, slack)));
        }
        if !met.is_empty() {
            self.count_in_blocks(entry, &met, (r0, r1));
        }
        self.met = met;
    }

    /// Counts a volume in the blocks that it may meet.
    fn count_in_blocks(&mut self, entry: &Entry, blocks: &[usize], rows: (usize, usize)) {
        let volume = self.context.volume(entry.volume);
        let method = self.context.method_of(entry.volume);
        let arch = self.context.arch;
        let ring = self.context.extrusion.rings_of(volume).next().filter(|_| volume.is_box);
        if let Some(ring) = ring {
            self.counts.faces += ring.len() as u64 + 2;
            let solid = Solid::new(&self.setup(), ring, (volume.low, volume.high));
            return arch.dispatch(Convex { tile: self, volume, solid, method, blocks, rows });
        }
        let faces = self.set_up(entry);
        arch.dispatch(Sparse { tile: self, faces: &faces, method, blocks });
        self.faces = faces;
    }

    fn count_fully(&mut self, entry: &Entry) {
        let faces = self.set_up(entry);
        let method = self.context.method_of(entry.volume);
        for face in &faces {
            self.visit_face(face, &mut |tile, at, fragment| {
                tile.count_one(entry, at, method, fragment);
            });
        }
        self.faces = faces;
    }

    fn count_on_machine(&mut self, entry: &Entry) {
        let is_open_above = self.context.settings.caps == VolumeCaps::Bottom;
        let method = self.context.method_of(entry.volume);
        let volume = self.context.volume(entry.volume);
        Outline::for_each(self.context.extrusion, volume, is_open_above, |outline| {
            self.counts.faces += 1;
            self.visit_on_machine(&outline, &mut |tile, at, fragment| {
                tile.count_one(entry, at, method, fragment);
            });
        });
    }

    /// Counts a fragment and notes it in the planes to look at.
    fn count_one(&mut self, entry: &Entry, at: (usize, usize), method: Method, fragment: Fragment) {
        self.counts.fragments += 1;
        let step = self.stencil.count(at, method, fragment);
        self.record.step(|| Step::Crossing {
            sample: sample_of(&self.blocks, at),
            pass: entry.pass,
            item: self.context.extrusion.object_of(entry.volume),
            volume: entry.volume,
            is_z_fail: method == Method::ZFail,
            is_front: fragment.facing > 0,
            is_behind: fragment.is_behind,
            step,
            count: self.stencil.counts[at.0][at.1],
        });
        if let (Some(traces), true) = (&mut self.traces, self.context.is_traced(entry.pass)) {
            traces.overdraw[at.0][at.1] += 1;
            if step != 0 && !entry.is_cutter {
                let side = if fragment.facing > 0 { &mut traces.front } else { &mut traces.back };
                side[at.0][at.1] += 1;
            }
        }
    }
}
