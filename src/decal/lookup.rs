//! Samples -> the items that hold them (3.4.1, Algorithm 3.5).
//!
//! A pixel's samples are looked up together: nodes are compared with the box around those that lie in one cell, leaves are asked about each.
//! That leaves out no more and no less than asking for each sample alone.

use super::decals::Decals;
use super::hits::{Hits, MOST_TOGETHER};
use super::packet::{LookupCounts, Packet};
use super::palette::Palette;
use super::settings::{Hierarchy, Overlaps};
use crate::space::{Plan, PlanBox};

impl Decals<'_> {
    /// Finds the items that hold any of some points, at most [`MOST_TOGETHER`]; points that are infinite lie in none. `hits` is emptied first.
    ///
    /// # Panics
    /// With more points.
    #[inline]
    pub fn find(&self, points: &[Plan], palette: &Palette, hits: &mut Hits, counts: &mut LookupCounts) {
        assert!(points.len() <= MOST_TOGETHER, "too many points are looked up together");
        hits.clear();
        if let [at] = points {
            // A point alone needs no box.
            if let Some(cell) = self.cell_of(*at) {
                self.find_in((cell, &PlanBox { min: *at, max: *at }), points, 1, palette, (hits, counts));
            }
            return;
        }
        let mut bounds = PlanBox::EMPTY;
        let mut finite = 0u64;
        for (k, at) in points.iter().enumerate() {
            if at.is_finite() {
                bounds.include(*at);
                finite |= 1 << k;
            }
        }
        if finite == 0 {
            return;
        }
        // Cells are found by monotone functions of coordinates: what lies between two points of a cell lies in it.
        let corners = (self.cell_of(bounds.min), self.cell_of(bounds.max));
        if corners.0 == corners.1
            && let Some(cell) = corners.0
        {
            self.find_in((cell, &bounds), points, finite, palette, (hits, counts));
            return;
        }
        if let (Some(first), Some(last)) = corners
            && self
                .grid
                .cells_between(first, last)
                .is_some_and(|mut cells| cells.all(|cell| self.cell(cell).is_none()))
        {
            // Most are empty where decals are sparse.
            return;
        }
        self.find_apart(points, finite, palette, (hits, counts));
    }

    /// As [`Decals::find`], of points that do not all lie in one cell.
    fn find_apart(
        &self,
        points: &[Plan],
        mut left: u64,
        palette: &Palette,
        (hits, counts): (&mut Hits, &mut LookupCounts),
    ) {
        let mut cells = 0;
        while left != 0 {
            let first = self.cell_of(points[left.trailing_zeros() as usize]);
            let mut bounds = PlanBox::EMPTY;
            let mut here = 0u64;
            for k in (0..points.len()).filter(|k| left >> k & 1 == 1) {
                if self.cell_of(points[k]) == first {
                    here |= 1 << k;
                    bounds.include(points[k]);
                }
            }
            left &= !here;
            if let Some(cell) = first {
                self.find_in((cell, &bounds), points, here, palette, (hits, counts));
                cells += 1;
            }
        }
        if cells > 1 {
            hits.sort();
            if self.settings.overlaps == Overlaps::Once {
                hits.join();
            }
        }
    }

    /// Finds the items that hold any of some points of a cell, and adds them.
    #[inline]
    fn find_in(
        &self,
        (number, bounds): (u32, &PlanBox),
        points: &[Plan],
        samples: u64,
        palette: &Palette,
        (hits, counts): (&mut Hits, &mut LookupCounts),
    ) {
        let Some(cell) = self.cell(number) else { return };
        let packet = Packet::new(points, samples, bounds);
        let found = match self.settings.hierarchy {
            Hierarchy::Binary | Hierarchy::Wide => self.search(cell, packet, palette, hits),
            Hierarchy::Curve => self.search_unordered(cell, packet, palette, hits),
        };
        *counts = counts.plus(found);
    }
}
