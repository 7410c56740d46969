//! What the structure would take in the forms that the paper compares (3.3), beside what it takes here.
//!
//! Input: the structure of quads. Output: [`Storage`]. Refuses: nothing.

use super::structure::{PolylineLods, QuadClipping, TriangleClipping};
use std::ops::{Add, AddAssign};

/// How points are stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointForm {
    /// Each clipping has its points in space: three floats each.
    Cartesian,
    /// Each vertex and each crossing once, as the line along which it is projected: two floats each, as all such lines are vertical.
    Projectors,
}

/// Which layers a quad stores.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StoredLayers {
    /// All.
    All,
    /// The two that its larger quads do not have; root quads all.
    TwoFinest,
}

/// Sizes of a form, bytes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Bytes {
    /// Coordinates alone.
    pub coordinates: u64,
    /// The rest: the clippings with their links.
    pub topology: u64,
}

/// What is to be stored of quads.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Storage {
    /// Vertices and crossings, each once a quad.
    pub points: u64,
    /// All layers.
    pub all: Counts,
    /// The two finest layers of a quad that is no root, all of a root's.
    pub two_finest: Counts,
}

/// Clippings, and the points that they have all together.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counts {
    /// Triangle clippings.
    pub clippings: u64,
    /// Points, as often as a clipping has them.
    pub points: u64,
}

/// A float in the paper's formats.
const FLOAT: u64 = 4;

/// A clipping's own members as 32-bit words: the triangle, its points' place and number, two next, parent, finest exit descendant, decision vertex.
const CLIPPING: u64 = 8 * 4;

impl Add for Counts {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { clippings: self.clippings + other.clippings, points: self.points + other.points }
    }
}

impl AddAssign for Storage {
    fn add_assign(&mut self, other: Self) {
        self.points += other.points;
        self.all = self.all + other.all;
        self.two_finest = self.two_finest + other.two_finest;
    }
}

impl Bytes {
    /// Coordinates and the rest.
    pub fn total(&self) -> u64 {
        self.coordinates + self.topology
    }
}

impl Storage {
    /// Of a quad; a root has no larger quad.
    pub fn of(lods: &PolylineLods, is_root: bool) -> Self {
        let finest = 2 * lods.block.stride.ilog2();
        let mut storage = Self::default();
        for quad in lods.polylines.iter().flat_map(|line| &line.quad_clippings) {
            let counted = |clippings: &[TriangleClipping]| Counts {
                clippings: clippings.len() as u64,
                points: clippings.iter().map(|clipping| clipping.point_count() as u64).sum(),
            };
            let all = &quad.triangle_clippings[..];
            let own = all.partition_point(|clipping| is_root || clipping.triangle.layer() < finest + 2);
            storage += Self {
                points: (quad.vertices.len() + quad.crossings.len()) as u64,
                all: counted(all),
                two_finest: counted(&all[..own]),
            };
        }
        storage
    }

    /// How large a form is.
    pub fn bytes(&self, form: PointForm, layers: StoredLayers) -> Bytes {
        let counts = match layers {
            StoredLayers::All => self.all,
            StoredLayers::TwoFinest => self.two_finest,
        };
        let coordinates = match form {
            PointForm::Cartesian => counts.points * 3 * FLOAT,
            PointForm::Projectors => self.points * 2 * FLOAT,
        };
        Bytes { coordinates, topology: counts.clippings * CLIPPING }
    }
}

impl PolylineLods {
    /// Bytes held in memory: points once, in double precision.
    pub fn bytes(&self) -> usize {
        let quads = self.polylines.iter().flat_map(|line| &line.quad_clippings);
        let points = |quad: &QuadClipping| size_of_val(&quad.vertices[..]) + size_of_val(&quad.crossings[..]);
        let own = |quad: &QuadClipping| {
            size_of_val(quad) + points(quad) + size_of_val(&quad.triangle_clippings[..])
        };
        size_of_val(&self.polylines[..]) + quads.map(own).sum::<usize>()
    }
}
