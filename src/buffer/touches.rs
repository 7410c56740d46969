//! Which items touch which pixels, as buffers: for picking.

use super::{Plane, PlaneKind, Values};
use std::cmp::Reverse;

/// No item.
const NONE: u32 = u32::MAX;

/// Which items touch the pixels of a picture; kept only where somebody asked.
#[derive(Debug, Default)]
pub struct Touches {
    width: usize,
    found: Option<Vec<Touch>>,
}

/// An item in a pixel.
#[derive(Debug, Clone, Copy)]
struct Touch {
    /// The pixel's place in the picture, row by row.
    pixel: u32,
    item: u32,
    /// Whether it holds the middle of the pixel.
    is_central: bool,
}

impl Touches {
    /// Nothing yet, in a picture that is so wide.
    pub fn new(width: usize, is_wanted: bool) -> Self {
        Self { width, found: is_wanted.then(Vec::new) }
    }

    /// Whether anything is kept.
    #[inline(always)]
    pub fn is_wanted(&self) -> bool {
        self.found.is_some()
    }

    /// Adds an item of a pixel (column, row), once or several times; `is_central`: it holds the middle of the pixel, by whatever decides there.
    pub fn push(&mut self, [column, row]: [usize; 2], item: u32, is_central: bool) {
        if let Some(found) = &mut self.found {
            found.push(Touch { pixel: (row * self.width + column) as u32, item, is_central });
        }
    }

    /// Takes what was found in another part of the picture.
    pub fn take(&mut self, other: Self) {
        if let (Some(found), Some(more)) = (&mut self.found, other.found) {
            found.extend(more);
        }
    }

    /// The buffers of [`PlaneKind::PICKS`] that are wanted, of a picture that is so high.
    pub fn planes(self, height: usize, wants: &dyn Fn(&str) -> bool) -> Vec<Plane> {
        let count = self.width * height;
        let mut found = self.found.unwrap_or_default();
        // What is drawn last comes first.
        found.sort_unstable_by_key(|touch| (touch.pixel, Reverse(touch.item), !touch.is_central));
        found.dedup_by_key(|touch| (touch.pixel, touch.item));
        let mut topmost = vec![NONE; count];
        for touch in found.iter().rev().filter(|touch| touch.is_central) {
            topmost[touch.pixel as usize] = touch.item;
        }
        let ends =
            (0..=count).map(|pixel| found.partition_point(|touch| (touch.pixel as usize) < pixel) as u32);
        let plane = |kind: &PlaneKind| {
            let (width, height, values) = match kind.name {
                "id" => (self.width, height, topmost.clone()),
                "id-starts" => (1, count + 1, ends.clone().collect()),
                _ => (1, found.len(), found.iter().map(|touch| touch.item).collect()),
            };
            Plane { name: kind.name, width, height, components: 1, values: Values::U32(values) }
        };
        PlaneKind::PICKS.iter().filter(|kind| wants(kind.name)).map(plane).collect()
    }
}

/// What the buffers of [`PlaneKind::PICKS`] say of a pixel (column, row) of a picture: the topmost item at its middle, and all that touch it, the topmost first.
/// `None` where one of the buffers, or the pixel, is not there.
pub fn picked(planes: &[Plane], [column, row]: [usize; 2]) -> Option<(Option<u32>, &[u32])> {
    let of = |kind: PlaneKind| {
        let plane = planes.iter().find(|plane| plane.name == kind.name)?;
        if let Values::U32(values) = &plane.values { Some((plane.width, values)) } else { None }
    };
    let [(width, topmost), (_, starts), (_, items)] =
        [of(PlaneKind::ID)?, of(PlaneKind::ID_STARTS)?, of(PlaneKind::IDS)?];
    let pixel = row * width + column;
    let (first, end) = (*starts.get(pixel)?, *starts.get(pixel + 1)?);
    let item = Some(topmost[pixel]).filter(|item| *item != NONE);
    Some((item, items.get(first as usize..end as usize)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_topmost_item_at_a_pixels_middle_and_all_that_touch_it_are_read_back_whoever_found_them() {
        let mut touches = Touches::new(3, true);
        touches.push([2, 0], 4, false);
        touches.push([0, 1], 7, true);
        let mut others = Touches::new(3, true);
        others.push([2, 0], 1, true);
        others.push([2, 0], 4, false);
        others.push([2, 0], 3, true);
        others.push([2, 0], 3, false);
        touches.take(others);
        let planes = touches.planes(2, &|_| true);
        assert_eq!(picked(&planes, [2, 0]), Some((Some(3), &[4, 3, 1][..])));
        assert_eq!(picked(&planes, [0, 1]), Some((Some(7), &[7][..])));
        assert_eq!(picked(&planes, [1, 1]), Some((None, &[][..])));
        assert_eq!(picked(&planes[1..], [0, 1]), None);
        assert!(Touches::new(3, true).planes(2, &|name| name == "id").len() == 1);
    }
}
