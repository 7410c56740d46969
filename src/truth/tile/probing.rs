//! What a pixel's samples may see and be held by, when each may lie anywhere in a small square.

use super::{MOST_SHIFT, Probes, Reach, Work, may_cover};
use crate::math;
use crate::truth::facet::Hit;
use crate::truth::knowledge::Pixel;
use crate::truth::outcome::Sample;
use crate::truth::polygon;
use crate::truth::refine::{Part, cross};

/// From so many samples on a pixel is looked at as a whole first, and cut into at most 2^depth pieces.
const TOGETHER_FROM: usize = 4;
const TOGETHER_DEPTH: u32 = 8;

/// A pixel and all that its samples may be shifted to.
const WITH_MARGIN: ([f64; 2], f64) = ([-MOST_SHIFT; 2], 1.0 + 2.0 * MOST_SHIFT);

/// The square in which a sample may lie.
fn square_around([x, y]: [f64; 2], shift: f64) -> ([f64; 2], f64) {
    ([x - shift, y - shift], 2.0 * shift)
}

impl Work<'_> {
    /// What a pixel's samples may see, as [`Work::pixel`].
    pub(super) fn probe(
        &mut self,
        [x, y]: [usize; 2],
        probes: &Probes,
        near: &[u32],
        rest: &[usize],
    ) -> bool {
        let pixel = [x as f64, y as f64];
        let mut samples = vec![None; probes.spots.len() * probes.shifts.len()];
        if probes.spots.len() >= TOGETHER_FROM {
            if !self.see(pixel, WITH_MARGIN, near, rest) {
                return false;
            }
            self.sample_together(pixel, probes, near, &mut samples);
        }
        for (k, sample) in samples.iter_mut().enumerate().filter(|(_, sample)| sample.is_none()) {
            let (spot, shift) = (probes.spots[k % probes.spots.len()], probes.shifts[k / probes.spots.len()]);
            if !self.see(pixel, square_around(spot, shift), near, rest) {
                return false;
            }
            let reach =
                self.sight.fragments.first().map_or(shift, |f| self.reach(f.facet, pixel, spot, shift));
            let square = square_around(spot, reach);
            if reach > shift && !self.see(pixel, square, near, rest) {
                return false;
            }
            *sample = Some(self.outcomes(pixel, square, near));
        }
        self.out.samples[y * self.size[0] + x] = samples.into_iter().flatten().collect();
        true
    }

    /// Samples of a pixel, the whole of which was looked at last, where what its pieces know tells all; the last spot, of which depth and place
    /// are wanted, is left out.
    fn sample_together(
        &mut self,
        pixel: [f64; 2],
        probes: &Probes,
        near: &[u32],
        samples: &mut [Option<Sample>],
    ) {
        let of = Pixel { setting: self.setting, rays: &self.rays, facets: &self.facets, corner: pixel };
        self.refinery.refine_further(&of, &mut self.pieces, &self.sight, TOGETHER_DEPTH);
        let parts = self.refinery.parts(&of, &self.pieces, &self.sight);
        let count = probes.spots.len();
        for (k, sample) in samples.iter_mut().enumerate().filter(|(k, _)| k % count + 1 < count) {
            let (spot, shift) = (probes.spots[k % count], probes.shifts[k / count]);
            let here = self.sight.fragments.iter().find(|f| polygon::holds(self.pieces.of(f.shape), spot));
            let reach = here.map_or(shift, |fragment| self.reach(fragment.facet, pixel, spot, shift));
            let (corner, side) = square_around(spot, reach);
            let met: Vec<&Part> = parts
                .iter()
                .filter(|part| polygon::meets_square(self.pieces.of(part.shape), corner, side))
                .collect();
            let is_known = !met.is_empty() && met.iter().all(|part| part.outcome.is_some());
            let at = [pixel[0] + corner[0], pixel[1] + corner[1]];
            if is_known && self.nearly_seen(at, side, near).is_empty() {
                let mut all = Sample::default();
                met.into_iter().filter_map(|part| part.outcome.clone()).for_each(|outcome| all.add(outcome));
                cross(self.setting, &mut all);
                *sample = Some(all);
            }
        }
    }

    /// What may be seen and held in the square of a pixel that was looked at last, of these facets.
    fn outcomes(&mut self, pixel: [f64; 2], (corner, side): ([f64; 2], f64), near: &[u32]) -> Sample {
        let hidden = self.nearly_seen([pixel[0] + corner[0], pixel[1] + corner[1]], side, near);
        let of = Pixel { setting: self.setting, rays: &self.rays, facets: &self.facets, corner: pixel };
        let square = (corner, side);
        let mut sample = self.refinery.outcomes(&of, &mut self.pieces, &self.sight, square);
        for facet in hidden {
            self.pieces.clear();
            self.sight.clear();
            self.sight.see(&mut self.pieces, &self.facets, &[facet], (pixel, corner, side));
            self.sight.sky.clear();
            let of_facet = self.refinery.outcomes(&of, &mut self.pieces, &self.sight, square);
            of_facet.outcomes.into_iter().for_each(|outcome| sample.add(outcome));
        }
        cross(self.setting, &mut sample);
        sample
    }

    /// The facets in a square that are hidden wherever one looks, but not behind everything that is seen in it: where vertices stray, some of
    /// them may come forth, such as the far side of a ridge.
    fn nearly_seen(&self, corner: [f64; 2], side: f64, near: &[u32]) -> Vec<u32> {
        let floor = match self.sight.sky.is_empty() {
            true => self.sight.farthest(),
            false => f64::NEG_INFINITY,
        };
        let square = Reach::of_square(corner, side);
        let is_hidden = |k: u32| {
            let facet = &self.facets[k as usize];
            self.boxes[k as usize].meets(&square)
                && may_cover(facet, corner, side)
                && facet.nearness_range(corner, side).1 >= floor
                && !self.sight.fragments.iter().any(|fragment| fragment.facet == k)
        };
        near.iter().copied().filter(|k| is_hidden(*k)).collect()
    }

    /// How far a spot's sample may be shifted for what it seems to see to be all that it may, pixels. What is seen may lie elsewhere along the
    /// ray; a face through it that stands upright on the plan is met as much sooner or later.
    fn reach(&self, facet: u32, pixel: [f64; 2], spot: [f64; 2], shift: f64) -> f64 {
        const STEP: f64 = 1.0 / 64.0;
        let Some(probes) = &self.probes else { return shift };
        let facet = &self.facets[facet as usize];
        let hit =
            |dx: f64, dy: f64| facet.hit(&self.rays, [pixel[0] + spot[0] + dx, pixel[1] + spot[1] + dy]);
        let at = hit(0.0, 0.0);
        let depth = |hit: &Hit| self.rays.frame.depth(hit.world);
        let (right, down) = ([hit(STEP, 0.0), hit(-STEP, 0.0)], [hit(0.0, STEP), hit(0.0, -STEP)]);
        let slope = |[a, b]: &[Hit; 2]| (depth(a) - depth(b)).abs() / (2.0 * STEP);
        let way = match self.rays.is_central {
            // View depth 1.
            true => (at.world - self.rays.frame.eye()) / depth(&at),
            false => self.rays.frame.forward(),
        };
        let [x, y] = [&right, &down].map(|[a, b]| (a.plan - b.plan) / (2.0 * STEP));
        let area = x.perp_dot(y);
        let pixels = |metres: f64| {
            let along = way.truncate() * metres;
            let far = math::max((along.perp_dot(y) / area).abs(), (x.perp_dot(along) / area).abs());
            // Seen edge-on: whatever is near.
            if far.is_finite() { far } else { MOST_SHIFT }
        };
        let of_shift = pixels(probes.depths_of_shifts * shift * (slope(&right) + slope(&down)));
        let size = at.world.to_vec().abs().max_element() + (at.world - self.rays.frame.eye()).length();
        let aside = probes.share * size * (x.length() + y.length()) / area.abs();
        let of_coordinates = if aside.is_finite() { aside } else { MOST_SHIFT };
        let all = math::max(shift, of_shift) + pixels((probes.along)(depth(&at))) + of_coordinates;
        math::min(all, MOST_SHIFT)
    }
}
