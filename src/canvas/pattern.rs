//! Where a pixel's samples lie, and what the samples of a block of pixels see.

use super::GBuffer;
use crate::raster::Lattice;
use crate::scene::Device;
use crate::space::{Plan, PlanBox, ViewFrame};
use crate::terrain::Mesh;
use crate::tiling::TilePlace;

/// The most samples a pixel has.
pub const MOST_SAMPLES: u32 = 1024;

/// Where a pixel's samples lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SamplePattern {
    /// The pattern of a graphics processor's multisampling, in sixteenths of a pixel from its centre.
    Multisample(&'static [[i8; 2]]),
    /// n x n samples, in the middles of as many equal squares.
    Grid(usize),
}

/// The usual pattern of four samples (that of Direct3D 11, which Vulkan takes over).
const FOUR: &[[i8; 2]] = &[[-2, -6], [6, -2], [-6, 2], [2, 6]];

/// That of eight.
const EIGHT: &[[i8; 2]] = &[[1, -3], [-1, 3], [5, 1], [-3, -5], [-5, 5], [-7, -1], [3, 7], [7, -7]];

impl SamplePattern {
    /// So many samples: 4 and 8 as graphics processors place them, other squares of whole numbers up to [`MOST_SAMPLES`] as a grid; `None`: neither.
    pub fn of(samples: u32) -> Option<Self> {
        match samples {
            4 => Some(Self::Multisample(FOUR)),
            8 => Some(Self::Multisample(EIGHT)),
            1..=MOST_SAMPLES => {
                let side = samples.isqrt();
                (side * side == samples).then_some(Self::Grid(side as usize))
            }
            _ => None,
        }
    }

    /// How many there are.
    pub fn count(self) -> usize {
        match self {
            Self::Multisample(places) => places.len(),
            Self::Grid(side) => side * side,
        }
    }

    /// The number of the sample that lies nearest to the pixel's centre; of several the first.
    pub fn middle(self) -> usize {
        let mut nearest = (f64::INFINITY, 0);
        for (k, [x, y]) in self.places().into_iter().enumerate() {
            let distance = (x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5);
            if distance < nearest.0 {
                nearest = (distance, k);
            }
        }
        nearest.1
    }

    /// Where they lie in a pixel, from its upper left corner, 0..=1.
    pub fn places(self) -> Vec<[f64; 2]> {
        match self {
            Self::Multisample(places) => places.iter().map(|at| in_pixel(*at)).collect(),
            Self::Grid(side) => {
                let place = |k: usize| (k as f64 + 0.5) / side as f64;
                (0..side * side).map(|k| [place(k % side), place(k / side)]).collect()
            }
        }
    }
}

/// A place of a graphics processor's pattern in the pixel.
fn in_pixel([x, y]: [i8; 2]) -> [f64; 2] {
    [0.5 + f64::from(x) / 16.0, 0.5 + f64::from(y) / 16.0]
}

/// What the samples of a block of pixels see.
#[derive(Debug)]
pub struct BlockSamples<'a> {
    /// One of all samples, or one for each sample of the pattern.
    seen: Vec<GBuffer<'a>>,
    pattern: SamplePattern,
}

impl<'a> BlockSamples<'a> {
    /// Finds it.
    pub fn new(
        (view, mesh, device): (&'a ViewFrame, &'a Mesh, &Device),
        place: &TilePlace,
        pattern: SamplePattern,
    ) -> Self {
        let see = |lattice: Lattice| {
            let side = lattice.columns.max(lattice.rows).min(MOST_OF_A_TILE);
            GBuffer::new(view, mesh, device, lattice, side)
        };
        let seen = match pattern {
            SamplePattern::Grid(n) => vec![see(Lattice::samples(place.corner, place.size, n))],
            SamplePattern::Multisample(places) => {
                let lattices =
                    places.iter().map(|at| Lattice::one_each(place.corner, place.size, in_pixel(*at)));
                lattices.map(see).collect()
            }
        };
        Self { seen, pattern }
    }

    /// The triangle ([`crate::terrain::SKY`] for none) and the plan point (infinite there) of sample `k` of a pixel of the block.
    #[inline(always)]
    pub fn sample(&self, [x, y]: [usize; 2], k: usize) -> (u32, Plan) {
        let (seen, column, row) = self.place([x, y], k);
        (seen.triangle(column, row), seen.plan(column, row))
    }

    /// The box around the plan points of all samples; empty where all see the sky.
    pub fn plan_bounds(&self) -> PlanBox {
        let mut bounds = PlanBox::EMPTY;
        let points = self.seen.iter().flat_map(|seen| seen.plan_points());
        points.filter(|at| at.is_finite()).for_each(|at| bounds.include(*at));
        bounds
    }

    /// The G-buffer that has sample `k` of a pixel of the block, and the sample's column and row in it.
    #[inline(always)]
    pub fn place(&self, [x, y]: [usize; 2], k: usize) -> (&GBuffer<'a>, usize, usize) {
        match self.pattern {
            SamplePattern::Grid(n) => (&self.seen[0], x * n + k % n, y * n + k / n),
            SamplePattern::Multisample(_) => (&self.seen[k], x, y),
        }
    }
}

/// The most samples a side of a tile that is seen at once.
const MOST_OF_A_TILE: usize = 256;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_and_eight_are_a_processors_patterns_and_other_squares_grids() {
        let side = |samples| SamplePattern::of(samples).map(SamplePattern::count);
        assert_eq!([1, 4, 8, 9, 16, 1024].map(side), [1, 4, 8, 9, 16, 1024].map(Some));
        assert_eq!([0, 2, 3, 15, 1025, 1089, u32::MAX].map(side), [None; 7]);
        assert_eq!(SamplePattern::of(1), Some(SamplePattern::Grid(1)));
    }

    #[test]
    fn each_row_and_each_column_of_a_pattern_has_one_sample_and_their_mean_is_the_centre() {
        for pattern in [FOUR, EIGHT] {
            for axis in [0, 1] {
                let n = pattern.len() as i32;
                let mut taken: Vec<i32> =
                    pattern.iter().map(|at| (i32::from(at[axis]) + 8) * n / 16).collect();
                taken.sort_unstable();
                assert_eq!(taken, (0..n).collect::<Vec<i32>>());
                assert_eq!(pattern.iter().map(|at| i32::from(at[axis])).sum::<i32>(), 0);
            }
        }
    }
}
