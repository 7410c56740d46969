//! The texels of a tile while items are drawn into it, each with all paints that it may have, and the finished tile.
//!
//! A texel's paint is affine in the share of each item that covers it: with shares between bounds it lies in the hull of what it is with all shares at a
//! bound. So a texel is one paint, or the corners of a hull.

use crate::math;
use crate::resolve::Paint;
use crate::scene::{BlendMode, Group};
use crate::technique::clipmap::TexelFormat;
use std::collections::{BTreeMap, BTreeSet};

/// A texel of more corners than this is boxed.
const MOST_CORNERS: usize = 12;

/// How far from a half a value may be rounded either way, of a step of 8 bits.
const TIE: f64 = 0.1;

/// Steps of 8 bits.
const STEPS: f64 = 255.0;

/// A paint that a texel may have: now, and before the group that is being drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Corner {
    now: [f64; 4],
    before: [f64; 4],
}

/// A set of items.
type SetId = u32;

/// Marks a texel that has several corners.
const OPEN: SetId = 1 << 31;

/// Texels being drawn.
#[derive(Debug)]
pub(super) struct Texels {
    known: Vec<Corner>,
    open: BTreeMap<u32, Vec<Corner>>,
    /// Texels that may be anything between their corners.
    ranges: BTreeSet<u32>,
    sets: Vec<SetId>,
    /// Each set's items; which set a set becomes with another item.
    items: Vec<Vec<u32>>,
    grown: BTreeMap<(SetId, u32), SetId>,
    /// What was asked for last: neighbours mostly ask for the same.
    last: Option<((SetId, u32), SetId)>,
    group: Option<Group>,
    format: TexelFormat,
    mode: BlendMode,
}

/// A finished tile.
#[derive(Debug)]
pub(super) struct Tile {
    size: usize,
    known: Vec<[f32; 4]>,
    open: BTreeMap<u32, Vec<[f32; 4]>>,
    sets: Vec<SetId>,
    items: Vec<Vec<u32>>,
}

impl Texels {
    /// An empty tile of some texels a side.
    pub(super) fn new(size: usize, format: TexelFormat, mode: BlendMode) -> Self {
        let nothing = Corner { now: [0.0; 4], before: [0.0; 4] };
        Self {
            known: vec![nothing; size * size],
            open: BTreeMap::new(),
            ranges: BTreeSet::new(),
            sets: vec![0; size * size],
            items: vec![Vec::new()],
            grown: BTreeMap::new(),
            last: None,
            group: None,
            format,
            mode,
        }
    }

    /// Begins to draw a group, or none.
    pub(super) fn enter(&mut self, group: Option<Group>) {
        if self.group == group {
            return;
        }
        let done = std::mem::replace(&mut self.group, group);
        let share = done.map_or(1.0, |group| group.opacity);
        let change = |corner: &Corner| {
            let mixed = |k: usize| corner.before[k] * (1.0 - share) + corner.now[k] * share;
            let now = if done.is_some() { std::array::from_fn(mixed) } else { corner.now };
            Corner { now, before: now }
        };
        if done.is_none() && group.is_none() {
            return;
        }
        let is_rounded = done.is_some() && self.format == TexelFormat::Unorm8;
        for (texel, known) in (0u32..).zip(&mut self.known) {
            let corners = match self.open.get(&texel) {
                Some(corners) => corners.iter().map(change).collect(),
                None => vec![change(known)],
            };
            let corners = if is_rounded { rounded(&corners, self.ranges.contains(&texel)) } else { corners };
            let corners: Vec<Corner> = corners.iter().map(|one| Corner { before: one.now, ..*one }).collect();
            match corners[..] {
                [one] => *known = one,
                _ => {
                    self.sets[texel as usize] |= OPEN;
                    self.open.insert(texel, corners);
                }
            }
        }
    }

    /// Blends paint into a texel, a share of it between two.
    pub(super) fn blend(&mut self, texel: usize, item: u32, [least, most]: [f64; 2], paint: Paint) {
        if most <= 0.0 {
            return;
        }
        let covers = least == 1.0 && most == 1.0 && paint.0[3] == 1.0 && self.mode == BlendMode::Over;
        if covers {
            self.ranges.remove(&(texel as u32));
        }
        let set = self.sets[texel] & !OPEN;
        self.sets[texel] = self.grow(if covers { 0 } else { set }, item) | (self.sets[texel] & OPEN);
        let drawn =
            |corner: &Corner, share: f64| Corner { now: self.over(corner.now, paint.0, share), ..*corner };
        let is_open = self.sets[texel] & OPEN != 0;
        if !is_open && least == most && self.format == TexelFormat::F32 {
            self.known[texel] = drawn(&self.known[texel], most);
            return;
        }
        let before = if is_open { &self.open[&(texel as u32)][..] } else { &self.known[texel..=texel] };
        let mut after: Vec<Corner> = Vec::new();
        for corner in before {
            for share in [least, most] {
                let one = drawn(corner, share);
                if !after.contains(&one) {
                    after.push(one);
                }
            }
        }
        let is_rounded = self.format == TexelFormat::Unorm8;
        // What is between two shares stays between them, but for its rounding.
        if is_rounded && least != most && (least != 0.0 || most != 1.0) {
            self.ranges.insert(texel as u32);
        }
        let is_range = self.ranges.contains(&(texel as u32));
        let mut after = match is_rounded {
            true => rounded(&after, is_range),
            false => after,
        };
        if after.len() > MOST_CORNERS {
            after = boxed(&after);
            self.ranges.insert(texel as u32);
        }
        match after[..] {
            [one] => {
                self.known[texel] = one;
                self.open.remove(&(texel as u32));
                self.ranges.remove(&(texel as u32));
                self.sets[texel] &= !OPEN;
            }
            _ => {
                self.sets[texel] |= OPEN;
                self.open.insert(texel as u32, after);
            }
        }
    }

    fn over(&self, below: [f64; 4], paint: [f64; 4], share: f64) -> [f64; 4] {
        let keep = 1.0 - paint[3] * share;
        std::array::from_fn(|k| match self.mode {
            BlendMode::Over => paint[k] * share + below[k] * keep,
            BlendMode::Additive => math::min(below[k] + paint[k] * share, 1.0),
        })
    }

    /// The set with an item more.
    fn grow(&mut self, set: SetId, item: u32) -> SetId {
        if self.items[set as usize].last() == Some(&item) {
            return set;
        }
        if let Some((_, grown)) = self.last.filter(|(of, _)| *of == (set, item)) {
            return grown;
        }
        let grown = *self.grown.entry((set, item)).or_insert_with(|| {
            let with = self.items[set as usize].iter().copied().chain([item]).collect();
            self.items.push(with);
            self.items.len() as SetId - 1
        });
        self.last = Some(((set, item), grown));
        grown
    }

    /// The finished tile.
    pub(super) fn finish(mut self, size: usize) -> Tile {
        self.enter(None);
        let single = |corner: &Corner| corner.now.map(|v| v as f32);
        Tile {
            size,
            known: self.known.iter().map(single).collect(),
            open: self.open.iter().map(|(at, all)| (*at, all.iter().map(single).collect())).collect(),
            sets: self.sets,
            items: self.items,
        }
    }
}

/// Corners of boxes around all: colours and alpha each at their least and most.
fn boxed(corners: &[Corner]) -> Vec<Corner> {
    let Some(first) = corners.first() else { return Vec::new() };
    let (mut low, mut high) = (*first, *first);
    for corner in corners {
        for k in 0..4 {
            low.now[k] = math::min(low.now[k], corner.now[k]);
            high.now[k] = math::max(high.now[k], corner.now[k]);
            low.before[k] = math::min(low.before[k], corner.before[k]);
            high.before[k] = math::max(high.before[k], corner.before[k]);
        }
    }
    let with = |colors: &Corner, alpha: &Corner| {
        let [r, g, b, _] = colors.now;
        let [p, q, s, _] = colors.before;
        Corner { now: [r, g, b, alpha.now[3]], before: [p, q, s, alpha.before[3]] }
    };
    vec![low, with(&low, &high), with(&high, &low), high]
}

/// Corners as 8 bits hold them: where a value lies near a half, both ways; of those between which there may be more, what is half a step around them.
fn rounded(corners: &[Corner], is_range: bool) -> Vec<Corner> {
    let mut out: Vec<Corner> = Vec::with_capacity(corners.len());
    for corner in corners {
        let to = |off: f64, k: usize| {
            let v = corner.now[k] * STEPS;
            let v = if is_range { v + off } else { (v + 0.5 + off).floor() };
            (v / STEPS).clamp(0.0, 1.0)
        };
        let off = if is_range { 0.5 + TIE } else { TIE };
        for (colors, alpha) in [(-off, -off), (-off, off), (off, -off), (off, off)] {
            let now = [to(colors, 0), to(colors, 1), to(colors, 2), to(alpha, 3)];
            let one = Corner { now, ..*corner };
            if !out.contains(&one) {
                out.push(one);
            }
        }
    }
    out
}

impl Tile {
    /// All paints that a texel may have, as corners of their hull.
    #[inline]
    pub(super) fn at(&self, column: usize, row: usize) -> &[[f32; 4]] {
        let texel = column + self.size * row;
        match self.sets[texel] & OPEN {
            0 => &self.known[texel..=texel],
            _ => &self.open[&(texel as u32)],
        }
    }

    /// The set of items of a texel, and what is in it.
    pub(super) fn items_at(&self, column: usize, row: usize) -> (u32, &[u32]) {
        let set = self.sets[column + self.size * row] & !OPEN;
        (set, &self.items[set as usize])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HALF: Paint = Paint([0.5, 0.0, 0.0, 0.5]);

    fn drawn(format: TexelFormat, shares: &[[f64; 2]]) -> Vec<[f32; 4]> {
        let mut texels = Texels::new(1, format, BlendMode::Over);
        shares.iter().for_each(|shares| texels.blend(0, 7, *shares, HALF));
        texels.finish(1).at(0, 0).to_vec()
    }

    #[test]
    fn a_texel_has_the_corners_of_its_shares() {
        assert_eq!(drawn(TexelFormat::F32, &[[1.0, 1.0]]), [[0.5, 0.0, 0.0, 0.5]]);
        assert_eq!(drawn(TexelFormat::F32, &[[0.0, 1.0]]), [[0.0; 4], [0.5, 0.0, 0.0, 0.5]]);
        assert_eq!(drawn(TexelFormat::F32, &[[0.0, 1.0], [0.5, 1.0]]).len(), 4);
        let many: Vec<[f64; 2]> = (1..5).map(|k| [0.0, 0.1 * f64::from(k)]).collect();
        assert_eq!(drawn(TexelFormat::F32, &many).len(), 4, "boxed");
    }

    #[test]
    fn a_half_is_rounded_either_way() {
        let code =
            |codes: &[[f32; 4]]| codes.iter().map(|c| (c[0] * 255.0).round() as u8).collect::<Vec<_>>();
        let mut both = code(&drawn(TexelFormat::Unorm8, &[[1.0, 1.0]]));
        both.sort_unstable();
        both.dedup();
        assert_eq!(both, [127, 128]);
    }

    #[test]
    fn a_group_is_lessened_as_a_whole() {
        let mut texels = Texels::new(1, TexelFormat::F32, BlendMode::Over);
        let full = Paint([1.0, 0.0, 0.0, 1.0]);
        texels.enter(Some(Group { layer: 0, opacity: 0.25 }));
        texels.blend(0, 1, [1.0, 1.0], full);
        texels.blend(0, 2, [1.0, 1.0], full);
        let tile = texels.finish(1);
        assert_eq!(tile.at(0, 0), [[0.25, 0.0, 0.0, 0.25]]);
        assert_eq!(tile.items_at(0, 0).1, [2]);
    }
}
