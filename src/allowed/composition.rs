//! What a place may be painted when it is known which items are drawn there for sure, and which perhaps.

use crate::certainty::{Known, PaintRange};
use crate::draw_list::DrawList;
use crate::resolve::{Compositor, Paint, Stack};
use crate::scene::{BlendMode, Scene};

/// How often an item is drawn at a place, and with how much of its paint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Laid {
    pub(super) item: u32,
    /// At least so often.
    pub(super) least: u32,
    /// At most so often.
    pub(super) most: u32,
    /// Between which shares of its paint each time.
    pub(super) share: [f64; 2],
}

impl Laid {
    /// Drawn once where it is known to be.
    pub(super) fn once(item: u32, known: Known) -> Self {
        let (least, most) = (u32::from(known == Known::In), u32::from(known != Known::Out));
        Self { item, least, most, share: [1.0; 2] }
    }
}

/// What a place may be painted.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Composed {
    /// Around all.
    pub(super) range: PaintRange,
    /// All there are, those with the fewest items first; none where they are too many.
    pub(super) each: Vec<PaintRange>,
}

impl Composed {
    /// With what it may be otherwise.
    pub(super) fn join(&mut self, other: Self) {
        self.range = self.range.hull(&other.range);
        if self.each.is_empty() || other.each.is_empty() {
            self.each.clear();
            return;
        }
        for paint in other.each {
            if !self.each.contains(&paint) {
                self.each.push(paint);
            }
        }
    }
}

/// Composes a scene's items.
pub(super) struct Composer<'a> {
    list: &'a DrawList,
    pub(super) compositor: Compositor,
    mode: BlendMode,
    paints: Vec<Paint>,
}

/// A place of more combinations of open answers has no list of them.
const MOST_COMBINATIONS: usize = 16;

impl<'a> Composer<'a> {
    pub(super) fn new(scene: &Scene, list: &'a DrawList) -> Self {
        let compositor = Compositor::new(scene.compositing);
        let paints = list.styles().iter().map(|style| compositor.paint(style.paint)).collect();
        Self { list, compositor, mode: scene.compositing.mode, paints }
    }

    /// The ground with items over it, from the lowest on.
    pub(super) fn over(&self, ground: PaintRange, laid: &[Laid]) -> Composed {
        let choices = |one: &Laid| (one.most - one.least + 1) as usize;
        let count = laid.iter().try_fold(1usize, |count, one| {
            Some(count * choices(one)).filter(|count| *count <= MOST_COMBINATIONS)
        });
        let Some(count) = count else {
            return Composed { range: self.around(ground, laid), each: Vec::new() };
        };
        let mut each: Vec<(u32, PaintRange)> = Vec::with_capacity(count);
        for mut k in 0..count {
            let mut drawn = 0;
            let picked = laid.iter().map(|one| {
                let times = one.least + (k % choices(one)) as u32;
                k /= choices(one);
                drawn += times;
                (one, times)
            });
            let paint = self.drawn(ground, picked);
            if !each.iter().any(|(_, known)| *known == paint) {
                each.push((drawn, paint));
            }
        }
        each.sort_by_key(|(drawn, _)| *drawn);
        let each: Vec<PaintRange> = each.into_iter().map(|(_, paint)| paint).collect();
        let range = each.iter().skip(1).fold(each[0], |all, paint| all.hull(paint));
        Composed { range, each }
    }

    /// With each item drawn so many times.
    fn drawn<'l>(&self, ground: PaintRange, items: impl Iterator<Item = (&'l Laid, u32)>) -> PaintRange {
        let mut stack = Stack::on(ground);
        for (one, times) in items.filter(|(_, times)| *times > 0) {
            let draw = |below| (0..times).fold(below, |below, _| self.under(below, one));
            stack.draw(self.list.style_of(one.item).group, draw);
        }
        stack.finished()
    }

    /// Around all ways.
    fn around(&self, ground: PaintRange, laid: &[Laid]) -> PaintRange {
        let mut stack = Stack::on(ground);
        for one in laid {
            stack.draw(self.list.style_of(one.item).group, |below: PaintRange| {
                let mut now = (0..one.least).fold(below, |below, _| self.under(below, one));
                let mut all = now;
                for _ in one.least..one.most {
                    now = self.under(now, one);
                    all = all.hull(&now);
                }
                all
            });
        }
        stack.finished()
    }

    /// With an item drawn once over it.
    fn under(&self, below: PaintRange, one: &Laid) -> PaintRange {
        let paint = self.paints[self.list.items()[one.item as usize].style as usize];
        let with = |share: f64| below.under(if share < 1.0 { paint.times(share) } else { paint }, self.mode);
        let [low, high] = one.share;
        // What is drawn is linear in the share.
        if low < high { with(low).hull(&with(high)) } else { with(high) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{BlendSpace, Compositing};
    use crate::space::PlanBox;

    #[test]
    fn an_open_item_leaves_two_paints_and_many_leave_a_range() {
        let text = "schema = 1\nterrain = { generate = { kind = \"sine\", posts = [9, 9], cell_m = 10.0, height_m = 2.0 } }\n\
             [[layer]]\nfeatures = [{ line = [[-9, 0], [9, 0]] }, { line = [[0, -9], [0, 9]] }]\n\
             line = { color = \"#ff0000\", opacity = 0.5, width_m = 2.0 }\n";
        let file = crate::scene_file::SceneFile::parse(text, None, &[]).unwrap();
        let (mut scene, _) = crate::source::load::load(&file, &|_| {}).unwrap();
        scene.compositing = Compositing { space: BlendSpace::Encoded, mode: BlendMode::Over };
        let list = DrawList::new(
            &mut scene.layers,
            &PlanBox::around([crate::space::Plan::new(-40.0, -40.0), crate::space::Plan::new(40.0, 40.0)]),
        )
        .unwrap();
        let composer = Composer::new(&scene, &list);
        let ground = PaintRange::exact(Paint([0.0, 0.0, 0.0, 1.0]));
        let reds = |laid: &[Laid]| -> Vec<f64> {
            composer.over(ground, laid).each.iter().map(|paint| paint.high[0]).collect()
        };
        let open = |item| Laid::once(item, Known::Open);
        assert_eq!(reds(&[open(0)]), [0.0, 0.5]);
        assert_eq!(reds(&[Laid::once(0, Known::In), open(1)]), [0.5, 0.75]);
        let many = composer.over(ground, &[Laid { most: 30, ..open(0) }]);
        assert!(many.each.is_empty() && many.range.low[0] == 0.0 && many.range.high[0] > 0.99);
        let half = composer.over(ground, &[Laid { share: [0.0, 0.5], ..Laid::once(1, Known::In) }]);
        assert_eq!((half.range.low[0], half.range.high[0]), (0.0, 0.25));
    }
}
