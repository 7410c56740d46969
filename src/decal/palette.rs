//! What was found for samples -> the colour that makes (3.4.1, the composition of Algorithm 3.5).

use super::hits::Hits;
use super::share::Shares;
use crate::draw_list::DrawList;
use crate::resolve::{Compositor, Paint, Stack};
use crate::scene::BlendMode;

/// How items paint.
#[derive(Debug)]
pub struct Palette<'a> {
    list: &'a DrawList,
    compositor: Compositor,
    /// The paint of each style of items.
    paints: Vec<Paint>,
    /// Whether nothing shows below an item of a style.
    is_opaque: Vec<bool>,
}

impl<'a> Palette<'a> {
    /// The items of a list, composed so.
    pub fn new(list: &'a DrawList, compositor: Compositor, mode: BlendMode) -> Self {
        let styles = list.styles().iter();
        let is_opaque = |style: &crate::draw_list::ItemStyle| {
            mode == BlendMode::Over && style.paint.0[3] >= 1.0 && style.group.is_none()
        };
        Self {
            list,
            compositor,
            is_opaque: styles.clone().map(is_opaque).collect(),
            paints: styles.map(|style| compositor.paint(style.paint)).collect(),
        }
    }

    /// Whether nothing shows below an item.
    #[inline(always)]
    pub fn is_opaque(&self, item: u32) -> bool {
        self.is_opaque_style(self.list.items()[item as usize].style)
    }

    /// Whether nothing shows below items of a style.
    #[inline(always)]
    pub(super) fn is_opaque_style(&self, style: u32) -> bool {
        self.is_opaque[style as usize]
    }

    /// What a sample shows: the ground, and over it the items that hold the sample. (They are searched from the front; composed from the back,
    /// as groups need it, they make the same colour.)
    #[inline(always)]
    pub fn over(&self, ground: Paint, hits: &Hits, sample: usize) -> Paint {
        let mut stack = Stack::on(ground);
        for hit in hits.found().iter().rev().filter(|hit| hit.samples >> sample & 1 == 1) {
            let style = self.list.items()[hit.item as usize].style as usize;
            let over = |below| self.compositor.over(below, self.paints[style]);
            stack.draw(self.list.styles()[style].group, over);
        }
        stack.finished()
    }

    /// What a pixel shows of which items cover shares: each is composed by its share of its opacity, as if the shares lay in the pixel
    /// independently of one another.
    pub fn over_shares(&self, ground: Paint, shares: &Shares) -> Paint {
        let mut stack = Stack::on(ground);
        for (item, share) in shares.found() {
            let style = self.list.items()[*item as usize].style as usize;
            let over = |below| self.compositor.over(below, self.paints[style].times(*share));
            stack.draw(self.list.styles()[style].group, over);
        }
        stack.finished()
    }
}

/// The mean of samples' paints.
#[derive(Debug)]
pub struct Mean {
    sum: Paint,
    first: Paint,
    count: usize,
    /// Whether all have been the same so far: then that is their mean, without a rounding.
    is_same: bool,
}

impl Default for Mean {
    fn default() -> Self {
        Self { sum: Paint::CLEAR, first: Paint::CLEAR, count: 0, is_same: true }
    }
}

impl Mean {
    /// Adds a sample.
    #[inline(always)]
    pub fn add(&mut self, paint: Paint) {
        if self.count == 0 {
            self.first = paint;
        }
        self.is_same &= paint == self.first;
        self.sum = self.sum.plus(paint);
        self.count += 1;
    }

    /// Adds what some samples show: their grounds, and over these the items that hold them.
    #[inline]
    pub fn add_over(&mut self, grounds: &[Paint], hits: &Hits, palette: &Palette) {
        if hits.is_empty() {
            grounds.iter().for_each(|ground| self.add(*ground));
            return;
        }
        // Neighbours are often held by the same items.
        let mut last = None;
        for (k, ground) in grounds.iter().enumerate() {
            let held = hits.pattern(k);
            let paint = match last {
                Some((same, below, paint)) if held == Some(same) && below == *ground => paint,
                _ => palette.over(*ground, hits, k),
            };
            last = held.map(|held| (held, *ground, paint));
            self.add(paint);
        }
    }

    /// The mean of what was added.
    #[inline(always)]
    pub fn paint(&self) -> Paint {
        if self.is_same { self.first } else { self.sum.divided_by(self.count as f64) }
    }
}
