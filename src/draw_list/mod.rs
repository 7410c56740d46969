//! What is painted, decided once: every room that draws or judges reads the same items, in the same order, under the same numbers.
//!
//! Input: the layers of a scene, whose features it takes, and the terrain's bounds. Output: a [`DrawList`]: items in draw order, the chains of vertices that they are
//! made of, the styles that they share. Refuses: more items, chains or vertices than can be numbered. It holds data and decides nothing
//! about coverage, so that the truth may stand on it and yet share no decision with what it judges. What it does decide:
//! - *Items.* A polygon makes a fill, if its style has one, and over it an outline, if it has one; a line makes a line; a swath makes a fill; points make one item, a dot of
//!   round caps for each. A feature whose
//!   style has nothing for it makes nothing. An item's number is its place in the list.
//! - *Outsides.* A layer that paints what lies outside of its polygons makes one item for that, before all others of it. Its area is
//!   that of all its polygons' members, its border that of what none of them holds, within a frame around the terrain.
//! - *Areas.* An area has its feature's rings as they are, member by member, without those of fewer than three vertices, which enclose
//!   nothing. What is inside of any member is inside.
//! - *Borders.* Techniques know no members: where some overlap or lie side by side they draw what one border bounds (`overlay`), else the
//!   rings as they are. Who judges them reads the members.
//! - *Strokes.* Consecutive vertices that are [the same](SAME_VERTEX) are one. A line that ends where it begins and has three distinct vertices
//!   is a ring: joined there, without caps; with fewer it runs there and back. A ring of an outline is closed, one of two vertices there
//!   and back; one of a single vertex is a dot, and so is a line of one.
//! - *Dashes.* A chain with a pattern of dashes becomes an open chain for each dash, of the same item and with the same part and member.
//! - *Cuts.* An outline that is inset or offset has the area that it is cut to: its feature's, by the fill's rule (even-odd without a fill).
//!
//! Each vertex is held once: a border whose vertices are all distinct is its outline's chain too.

mod build;
mod dash;
mod style;
mod vertices;

pub use style::{ItemStyle, Role, Side};
pub use vertices::SAME_VERTEX;

use crate::error::Result;
use crate::scene::Layer;
use crate::space::{Plan, PlanBox};
use std::ops::Range;

/// A set of plan points that is painted in one go.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Item {
    /// The number of its feature's layer in the scene.
    pub layer: u32,
    /// Its feature's place in the layer, from 0; [`NO_FEATURE`] of what lies outside of all.
    pub feature: u32,
    /// Its feature's number in the file, from 0; [`NO_FEATURE`] of what lies outside of all.
    pub number: u32,
    /// Its style, among [`DrawList::styles`].
    pub style: u32,
    /// The rings of its area, one member after the other; none where it has none.
    pub area: Range<u32>,
    /// The rings that bound its area, taken together: those of the area, but where members overlap or lie side by side.
    pub border: Range<u32>,
    /// The chains that its stroke follows; none of a fill.
    pub strokes: Range<u32>,
    /// The lines that it is along where these are not its strokes: of a fill that is a stroke's area on a globe, and of dashes the lines or rings
    /// that these are parts of.
    pub centre_lines: Range<u32>,
}

/// The number of no feature.
pub const NO_FEATURE: u32 = u32::MAX;

/// Consecutive vertices: a ring of a border, or what a stroke follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Chain {
    /// Its first vertex, among [`DrawList::vertices`].
    pub first: u32,
    /// How many there are, each counted once: at least one.
    pub count: u32,
    /// Which ring or polyline of its feature it is, from 0; of a border that is not its area's own, which ring of the border.
    pub part: u32,
    /// Which member of its feature's polygons it is a ring of, from 0.
    pub member: u32,
    /// Whether the last vertex is joined to the first, which then stands once more after it.
    pub is_closed: bool,
}

impl Chain {
    /// How many segments it has; a dot has none.
    #[inline]
    pub fn segments(&self) -> u32 {
        if self.is_closed { self.count } else { self.count - 1 }
    }
}

/// The items of a scene, in draw order.
#[derive(Debug, Clone, Default)]
pub struct DrawList {
    items: Vec<Item>,
    styles: Vec<ItemStyle>,
    chains: Vec<Chain>,
    vertices: Vec<Plan>,
}

impl DrawList {
    /// The list of some layers, whose features it takes: their geometry is held once, here. `terrain` is what the terrain covers of the
    /// plan: nothing else is painted.
    ///
    /// # Errors
    /// When there is more than can be numbered.
    ///
    /// # Panics
    /// When a feature names a style that its layer does not have.
    pub fn new(layers: &mut [Layer], terrain: &PlanBox) -> Result<Self> {
        build::of_layers(layers, terrain)
    }

    /// The items in draw order; an item's number is its place.
    #[inline]
    pub fn items(&self) -> &[Item] {
        &self.items
    }

    /// The items with their numbers.
    pub fn numbered(&self) -> impl Iterator<Item = (u32, &Item)> {
        (0..).zip(&self.items)
    }

    /// How items look: each style that an item has, once.
    pub fn styles(&self) -> &[ItemStyle] {
        &self.styles
    }

    /// How an item looks.
    #[inline]
    pub fn style_of(&self, item: u32) -> &ItemStyle {
        &self.styles[self.items[item as usize].style as usize]
    }

    /// The rings of an item's area as they are: what its style's rule has inside of those of any member is inside.
    pub fn area(&self, item: &Item) -> &[Chain] {
        &self.chains[item.area.start as usize..item.area.end as usize]
    }

    /// The rings that bound an item's area, for who knows no members: inside is what its style's rule says of all of them.
    pub fn border(&self, item: &Item) -> &[Chain] {
        &self.chains[item.border.start as usize..item.border.end as usize]
    }

    /// The chains that an item's stroke follows.
    pub fn strokes(&self, item: &Item) -> &[Chain] {
        &self.chains[item.strokes.start as usize..item.strokes.end as usize]
    }

    /// The lines that an item is along whose area is that of a stroke, or whose strokes are dashes; none of other items.
    pub fn centre_lines(&self, item: &Item) -> &[Chain] {
        &self.chains[item.centre_lines.start as usize..item.centre_lines.end as usize]
    }

    /// All vertices, scene-local.
    #[inline]
    pub fn vertices(&self) -> &[Plan] {
        &self.vertices
    }

    /// A chain's vertices, each once.
    #[inline]
    pub fn vertices_of(&self, chain: &Chain) -> &[Plan] {
        &self.vertices[chain.first as usize..(chain.first + chain.count) as usize]
    }

    /// A chain's vertices from its start to its end: those of a closed one run back to the first.
    #[inline]
    pub fn path_of(&self, chain: &Chain) -> &[Plan] {
        let count = chain.count + u32::from(chain.is_closed);
        &self.vertices[chain.first as usize..(chain.first + count) as usize]
    }

    /// The first item that has an item's area: its feature's fill, or itself where there is none.
    #[inline]
    pub fn area_owner(&self, item: u32) -> u32 {
        let feature = |item: u32| {
            let item = &self.items[item as usize];
            (item.layer, item.feature)
        };
        // Of a feature, only its fill comes before another item.
        item.checked_sub(1).filter(|before| feature(*before) == feature(item)).unwrap_or(item)
    }
}

#[cfg(test)]
mod tests;
