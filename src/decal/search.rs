//! A cell's two trees, searched for what holds samples.

use super::bvh::Walk;
use super::cell::Cell;
use super::decals::Decals;
use super::hits::Hits;
use super::packet::{LookupCounts, Packet};
use super::palette::Palette;
use super::settings::Overlaps;

impl Decals<'_> {
    /// Looks at lines and polygons together in draw order, from the front, until nothing more shows.
    pub(super) fn search(
        &self,
        cell: &Cell,
        mut packet: Packet,
        palette: &Palette,
        hits: &mut Hits,
    ) -> LookupCounts {
        let mut counts = LookupCounts::default();
        let mut lines = Walk::new(&cell.lines, packet.bounds);
        let mut polygons = Walk::new(&cell.polygons, packet.bounds);
        let mut line = lines.next().map(|leaf| cell.segments[leaf as usize]);
        let mut fill = polygons.next().map(|leaf| cell.fills[leaf as usize]);
        // Samples that the line at hand holds already.
        let mut of_line = (u32::MAX, 0u64);
        while packet.open != 0 {
            let is_line = match (line, fill) {
                (None, None) => break,
                (Some(line), Some(fill)) => line.item > fill.item,
                (is_there, None) => is_there.is_some(),
                (None, Some(_)) => false,
            };
            let (item, style, held) = if is_line {
                let leaf = line.unwrap_or_default();
                line = lines.next().map(|leaf| cell.segments[leaf as usize]);
                if of_line.0 != leaf.item {
                    of_line = (leaf.item, 0);
                }
                let is_once = self.settings.overlaps == Overlaps::Once;
                let wanted = if is_once { packet.open & !of_line.1 } else { packet.open };
                if wanted == 0 {
                    continue;
                }
                let held = self.held_by_line(cell, leaf, &packet, wanted, &mut counts);
                of_line.1 |= held;
                (leaf.item, self.list().items()[leaf.item as usize].style, held)
            } else {
                let leaf = fill.unwrap_or_default();
                fill = polygons.next().map(|leaf| cell.fills[leaf as usize]);
                (leaf.item, leaf.style, self.held_by_fill(cell, leaf, &packet, packet.open, &mut counts))
            };
            if held != 0 {
                if is_line && self.settings.overlaps == Overlaps::Double {
                    hits.push(item, held);
                } else {
                    hits.push_once(item, held);
                }
                if palette.is_opaque_style(style) {
                    packet.open &= !held;
                }
            }
        }
        counts.nodes += lines.visited + polygons.visited;
        counts
    }

    /// Looks at all that is near, in any order, and sorts what is found.
    pub(super) fn search_unordered(
        &self,
        cell: &Cell,
        packet: Packet,
        palette: &Palette,
        hits: &mut Hits,
    ) -> LookupCounts {
        let mut counts = LookupCounts::default();
        let mut found = Hits::default();
        let mut lines = Walk::new(&cell.lines, packet.bounds);
        for leaf in lines.by_ref() {
            let leaf = cell.segments[leaf as usize];
            let held = self.held_by_line(cell, leaf, &packet, packet.open, &mut counts);
            if held != 0 {
                found.push(leaf.item, held);
            }
        }
        let mut polygons = Walk::new(&cell.polygons, packet.bounds);
        for leaf in polygons.by_ref() {
            let leaf = cell.fills[leaf as usize];
            let held = self.held_by_fill(cell, leaf, &packet, packet.open, &mut counts);
            if held != 0 {
                found.push(leaf.item, held);
            }
        }
        counts.nodes += lines.visited + polygons.visited;
        found.sort();
        if self.settings.overlaps == Overlaps::Once {
            found.join();
        }
        // What lies below what is opaque is left out, as where the order is known beforehand.
        let mut open = packet.open;
        for hit in found.found() {
            let held = hit.samples & open;
            if held != 0 {
                hits.push(hit.item, held);
            }
            if palette.is_opaque(hit.item) {
                open &= !held;
            }
        }
        counts
    }
}
