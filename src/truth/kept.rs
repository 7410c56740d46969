//! What parts are made of, and their primitives on triangles, kept for a while: pixels side by side ask for the same.

use super::shape::{FacetPrimitive, PixelGround};
use crate::footprint::{BorderPart, Footprints, Primitive};

/// Places for parts, and for primitives on triangles: powers of two. What comes later to a place takes it.
const PARTS: usize = 512;
const SHAPES: usize = 512;

/// What parts are made of.
#[derive(Debug, Default)]
pub(super) struct KeptParts(Vec<(Option<BorderPart>, Vec<Primitive>)>);

impl KeptParts {
    /// What a part is made of.
    pub(super) fn of(&mut self, footprints: &Footprints, part: BorderPart) -> &[Primitive] {
        if self.0.is_empty() {
            self.0.resize_with(PARTS, Default::default);
        }
        let (kept, primitives) = &mut self.0[place_of(part.mixed(), PARTS)];
        if *kept != Some(part) {
            primitives.clear();
            footprints.primitives(part, primitives);
            *kept = Some(part);
        }
        primitives
    }
}

/// Which primitive of which part, on which triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Key {
    triangle: u32,
    part: BorderPart,
    number: usize,
}

/// Primitives on triangles of one tile.
#[derive(Debug, Default)]
pub(super) struct KeptShapes(Vec<Option<(Key, FacetPrimitive)>>);

impl KeptShapes {
    /// A part's primitive, by its number among them, on a triangle.
    pub(super) fn of(
        &mut self,
        ground: &PixelGround,
        (part, number): (BorderPart, usize),
        primitive: &Primitive,
    ) -> &FacetPrimitive {
        if self.0.is_empty() {
            self.0.resize(SHAPES, None);
        }
        let key = Key { triangle: ground.facet.id, part, number };
        let mixed = part.mixed().wrapping_add(u64::from(key.triangle) << 3).wrapping_add(number as u64);
        let kept = &mut self.0[place_of(mixed, SHAPES)];
        if kept.is_none_or(|(before, _)| before != key) {
            *kept = None;
        }
        &kept.get_or_insert_with(|| (key, ground.on_facet(primitive))).1
    }
}

/// One of `count` places for a number: numbers that follow one another get places far apart.
fn place_of(mixed: u64, count: usize) -> usize {
    (mixed.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - count.trailing_zeros())) as usize
}
