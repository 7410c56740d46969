//! The samples of P pixels, eight at a time: where they lie (She 3.4) and which areas hold them (3.5).
//!
//! Input: a quadrilateral, the areas that are partly in it, their edges made ready. Output: a bit for each sample and area. A sample has
//! the sums that it would have alone, in the same order; loops over eight are compiled for the widest vectors at hand. Refuses: nothing.

use super::edge_index::EdgeIndex;
use super::judgment::{NearEdge, Part, flags};
use super::quadrilateral::Quadrilateral;
use crate::space::Plan;

/// Samples at once.
const LANES: usize = 8;
/// Areas that have a bit in a word.
const AREAS: usize = 64;

/// The n x n positions of mean sampling in any quadrilateral, rows from the lower edge.
#[derive(Debug)]
pub struct Places {
    count: usize,
    /// Eight by eight; what fills up the last eight is nobody's.
    u: Vec<[f64; LANES]>,
    v: Vec<[f64; LANES]>,
    arch: pulp::Arch,
}

impl Places {
    /// n x n.
    pub fn new(n: u32) -> Self {
        let at = |k: u32| (f64::from(k) + 0.5) / f64::from(n);
        let starts = || (0..n * n).step_by(LANES);
        let eight = |of: &dyn Fn(u32) -> u32, start| std::array::from_fn(|lane| at(of(start + lane as u32)));
        Self {
            count: (n * n) as usize,
            u: starts().map(|start| eight(&|k| k % n, start)).collect(),
            v: starts().map(|start| eight(&|k| k / n, start)).collect(),
            arch: pulp::Arch::new(),
        }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Sample `k` of a quadrilateral.
    pub fn at(&self, quad: &Quadrilateral, k: usize) -> Plan {
        quad.sample(self.u[k / LANES][k % LANES], self.v[k / LANES][k % LANES])
    }
}

/// Which of a pixel's parts hold each sample.
#[derive(Debug, Default)]
pub struct Within {
    /// A word for each sample, eight by eight; those of the next [`AREAS`] parts come after all samples'.
    words: Vec<[u64; LANES]>,
    /// How many eights of samples there are.
    eights: usize,
}

impl Within {
    /// By She's Codes A and B (Fig. 9).
    pub fn judge(&mut self, (places, quad): (&Places, &Quadrilateral), parts: &[Part], near: &[NearEdge]) {
        self.clear(places);
        for parts in parts.chunks(AREAS) {
            places.arch.dispatch(Judge { places, quad, parts, near, words: &mut self.words });
        }
    }

    /// By the areas' winding numbers, exactly.
    pub fn wind(&mut self, (places, quad): (&Places, &Quadrilateral), parts: &[Part], index: &EdgeIndex) {
        self.clear(places);
        let is_within = |area, k| index.rule_of(area).contains(index.winding_of(area, places.at(quad, k)));
        for parts in parts.chunks(AREAS) {
            let word = |k: usize| {
                let bits =
                    parts.iter().enumerate().map(|(bit, part)| u64::from(is_within(part.area, k)) << bit);
                bits.sum()
            };
            let lane = |k: usize| if k < places.count { word(k) } else { 0 };
            self.words.extend((0..self.eights).map(|e| std::array::from_fn(|l| lane(LANES * e + l))));
        }
    }

    fn clear(&mut self, places: &Places) {
        self.words.clear();
        self.eights = places.u.len();
    }

    /// The first [`AREAS`] parts that hold sample `k`, as bits.
    #[inline(always)]
    pub fn first_parts(&self, k: usize) -> u64 {
        self.words[k / LANES][k % LANES]
    }

    /// Whether a part holds sample `k`.
    #[inline]
    pub fn holds(&self, part: usize, k: usize) -> bool {
        self.words[part / AREAS * self.eights + k / LANES][k % LANES] >> (part % AREAS) & 1 == 1
    }

    /// Whether the same parts hold samples `j` and `k`.
    pub fn are_alike(&self, j: usize, k: usize) -> bool {
        let of = |words: &[[u64; LANES]], k: usize| words[k / LANES][k % LANES];
        self.words.chunks(self.eights).all(|words| of(words, j) == of(words, k))
    }
}

/// [`Within::judge`] of up to [`AREAS`] parts.
struct Judge<'a> {
    places: &'a Places,
    quad: &'a Quadrilateral,
    parts: &'a [Part],
    near: &'a [NearEdge],
    words: &'a mut Vec<[u64; LANES]>,
}

impl pulp::WithSimd for Judge<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let Self { places, quad, parts, near, words } = self;
        for (u, v) in places.u.iter().zip(&places.v) {
            let mut samples = [Plan::default(); LANES];
            for ((sample, u), v) in samples.iter_mut().zip(u).zip(v) {
                *sample = quad.sample(*u, *v);
            }
            let mut word = [0; LANES];
            for (bit, part) in parts.iter().enumerate() {
                let flags = flags(&samples, &near[part.near.clone()]);
                for lane in 0..LANES {
                    word[lane] |= u64::from(flags[lane] > 0) << bit;
                }
            }
            words.push(word);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::technique::inverse_projection::expansion::{AreaId, Edge};

    fn quad(points: [(f64, f64); 4]) -> Quadrilateral {
        Quadrilateral(points.map(|(x, y)| Plan::new(x, y)))
    }

    #[test]
    fn the_samples_of_a_square_are_the_middles_of_its_parts() {
        let (places, square) = (Places::new(2), quad([(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]));
        let samples: Vec<(f64, f64)> =
            (0..places.count()).map(|k| places.at(&square, k)).map(|p| (p.x, p.y)).collect();
        assert_eq!(samples, [(0.5, 0.5), (1.5, 0.5), (0.5, 1.5), (1.5, 1.5)]);
    }

    #[test]
    fn many_parts_hold_the_samples_that_each_would_hold_alone() {
        let (places, square) = (Places::new(3), quad([(0.0, 0.0), (1.0, 0.0), (1.1, 1.0), (0.0, 1.2)]));
        // Half-planes left of upright lines, more than a word has bits.
        let line = |k: usize| {
            let x = k as f64 / 70.0;
            let area = AreaId::stroke_of(k as u32);
            Edge { a: Plan::new(x, -9.0), b: Plan::new(x, 9.0), area, outside_is_left: false }
        };
        let edges: Vec<NearEdge> = (0..70).map(|k| NearEdge::new(&line(k))).collect();
        let parts: Vec<Part> = (0..70).map(|k| Part { area: line(k).area, near: k..k + 1 }).collect();
        let mut within = Within::default();
        within.judge((&places, &square), &parts, &edges);
        for k in 0..9 {
            let at = places.at(&square, k);
            for (part, edge) in edges.iter().enumerate() {
                let alone = flags(&[at], std::slice::from_ref(edge))[0] > 0;
                assert_eq!(alone, at.x <= part as f64 / 70.0);
                assert_eq!(within.holds(part, k), alone, "sample {k}, part {part}");
            }
            let alike = |j: usize| (0..70).all(|part| within.holds(part, j) == within.holds(part, k));
            assert!((0..9).all(|j| within.are_alike(j, k) == alike(j)));
        }
    }
}
