//! On which side of a line's border a surface point lies, exactly: whether the footprint by definition (`docs/semantics.md`, *Dynamic line*) holds it.
//!
//! Input: a segment of a line as the scene has it, half its width in pixels, a surface point, and what plain doubles say of it. Output: whether the point's
//! distance in the plan is at most `growth` times its distance from the eye (or `growth`, where rays are parallel), `growth` the double nearest to half the
//! width times a pixel's size, which is the truth's, too. Doubles decide by a bound ([`Border::tolerance`]), what is nearer is decided by
//! [`is_near_segment`]. Refuses: nothing; exactness holds for coordinates as static lines have them ([`crate::decal`]), and a `growth`
//! between 2^-100 and 2^60: of others no last bits are known.

use super::camera::{Camera, P2, P3};
use crate::predicate::{Expansion, distance_squared, is_near_segment};
use crate::raster::device::Real;
use crate::space::{Plan, World};

/// How far plain doubles may be off, in sizes of what goes into them. In roundings (half an epsilon): differences of coordinates are good to 1, so
/// the cross product of two is to 4 of the lengths' product, its share of the length's square to 9 of itself: 13 for a distance, of the
/// point's from the segment's start. Half a width is good to 7 of itself, squares of the limits to 3. So 32 are enough.
const TOLERANCE: f64 = 16.0 * f64::EPSILON;

/// How far a part's ends may lie from its segment, in sizes of the segment's coordinates: 4 roundings along each axis, of its coordinates and of its length,
/// which is at most theirs together.
const PART_TOLERANCE: f64 = 8.0 * f64::EPSILON;

/// The border of a segment's line.
#[derive(Debug, Clone, Copy)]
pub struct Border {
    segment: [Plan; 2],
    growth: f64,
    eye: Option<World>,
    /// How far what is tested may lie from the segment, metres.
    apart: f64,
}

impl Border {
    /// Of a segment, of which what is tested is a part; `half_px`: half the line's width.
    pub fn of_part<T: Real>(segment: [Plan; 2], half_px: T, camera: &Camera<T>) -> Self {
        let size = |p: Plan| p.x.abs() + p.y.abs();
        let apart = PART_TOLERANCE * (size(segment[0]) + size(segment[1]));
        Self { apart, ..Self::of_whole(segment, half_px, camera) }
    }

    /// Of a segment that is tested itself.
    pub fn of_whole<T: Real>(segment: [Plan; 2], half_px: T, camera: &Camera<T>) -> Self {
        let eye = camera.eye().map(P3::get);
        Self { segment, growth: half_px.get() * camera.pixel().get(), eye, apart: 0.0 }
    }

    /// How far plain doubles may be off, metres, of a point that is `from` away from the start of what is tested, and of half a width there.
    #[inline(always)]
    pub fn tolerance<T: Real>(&self, from: P2<T>, half: f64) -> f64 {
        TOLERANCE * (from.x.get().abs() + from.y.get().abs() + half) + self.apart
    }

    /// Whether the line holds a surface point.
    #[cold]
    pub fn holds(&self, at: World) -> bool {
        let growth_squared = Expansion::exactly(self.growth).scaled(self.growth);
        let reach_squared = match self.eye {
            None => growth_squared,
            Some(eye) => distance_squared(at, eye).times(&growth_squared),
        };
        is_near_segment(at.plan(), self.segment, &reach_squared)
    }
}
