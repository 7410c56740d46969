//! A volume of one convex ring as what its faces have on their inner sides, and which samples of a block lie in it.
//!
//! Input: a [`Setup`], a volume's ring and levels; a [`Block`] of surface points. Output: for each sample whether its surface point surely lies in the
//! volume, surely outside, or near a face. The faces that a line of sight crosses before (or behind) a point outside cancel; those of a point
//! inside leave one. So only what lies near a face needs to be counted face by face. Refuses: nothing.

use super::block::{Block, Row};
use super::face::{Outline, Setup};
use crate::math::max_f32;
use crate::space::Plan;

/// What the function of a wall that a triangular volume lacks has everywhere.
const NO_WALL: [f32; 3] = [0.0, 0.0, f32::MIN];

/// A convex volume in a tile.
#[derive(Debug, Clone, Copy)]
pub struct Solid {
    /// Functions of a surface point's place (x, y, constant), positive outside of each wall.
    walls: [[f32; 3]; 4],
    /// How high a point lies above the top cap, and how far below the bottom cap, is these plus and minus its height.
    caps: [f32; 2],
    /// Functions that are not farther from 0 than this do not tell.
    slack: f32,
}

/// What is known of the samples of a row of a block.
#[derive(Debug, Clone, Copy)]
pub struct Located {
    /// 1 where a sample surely lies in the volume, else 0.
    pub inside: Row,
    /// 1 where it lies near a face, else 0.
    pub near: Row,
}

impl Solid {
    /// The volume over a counter-clockwise ring of at most four corners.
    pub fn new(setup: &Setup, ring: &[Plan], (low, high): (f64, f64)) -> Self {
        let mut solid = Self { walls: [NO_WALL; 4], caps: [0.0; 2], slack: 0.0 };
        for (k, a) in ring.iter().enumerate() {
            let b = ring[if k + 1 < ring.len() { k + 1 } else { 0 }];
            let ([x, y, _, constant], slack) = setup.side(&Outline::wall(*a, b, (low, high)), 1);
            solid.walls[k] = [x, y, constant];
            solid.slack = max_f32(slack, solid.slack);
        }
        for (k, (height, up)) in [(high, 1), (low, -1)].into_iter().enumerate() {
            let ([.., constant], slack) = setup.side(&Outline::level(ring, height, up, 1.0), 1);
            solid.caps[k] = constant;
            solid.slack = max_f32(slack, solid.slack);
        }
        solid
    }

    /// Whether a block surely has no point in the volume, as one wall has all of them outside.
    #[inline(always)]
    pub fn misses(&self, block: &Block) -> bool {
        let ([west, south, _], [east, north, _]) = block.reaches();
        // The place where a wall's function is least.
        let least = |[x, y, constant]: [f32; 3]| {
            x * (if x > 0.0 { west } else { east }) + y * (if y > 0.0 { south } else { north }) + constant
        };
        self.walls.iter().any(|wall| least(*wall) > self.slack)
    }

    /// Where the samples of row `r` of a block lie; `false`: none lies near a face.
    #[inline(always)]
    pub fn locate(&self, block: &Block, r: usize, located: &mut Located) -> bool {
        let Some([px, py, pz]) = block.points(r) else { return false };
        let [w0, w1, w2, w3] = self.walls;
        let beyond = |[x, y, constant]: [f32; 3], lane: usize| x * px[lane] + y * py[lane] + constant;
        let mut any = 0;
        for (lane, z) in pz.iter().enumerate() {
            let walls = max_f32(
                max_f32(beyond(w0, lane), beyond(w1, lane)),
                max_f32(beyond(w2, lane), beyond(w3, lane)),
            );
            let caps = max_f32(z + self.caps[0], self.caps[1] - z);
            let beyond = max_f32(walls, caps);
            // The sky is NaN, and so neither: all faces lie before it.
            located.inside[lane] = i32::from(beyond < -self.slack);
            located.near[lane] = i32::from(beyond.abs() <= self.slack);
            any |= located.near[lane];
        }
        any != 0
    }
}
