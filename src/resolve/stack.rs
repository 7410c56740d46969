//! Items composed one by one, and layers that are composed as a whole.

use super::Paint;
use crate::scene::Group;

/// What can be drawn over and mixed.
pub trait Mix: Copy {
    /// `share` of one and the rest of another.
    #[must_use]
    fn mixed(self, other: Self, share: f64) -> Self;
}

impl Mix for Paint {
    #[inline]
    fn mixed(self, other: Self, share: f64) -> Self {
        self.times(1.0 - share).plus(other.times(share))
    }
}

/// What is drawn at a place, item by item in draw order. The items of a group are drawn in full; then the place is mixed from what it was
/// before them and what it is with them, by the group's opacity. With `over` that is the same as to compose the group over nothing,
/// to lessen it by the opacity, and to draw it over what lies below.
#[derive(Debug, Clone, Copy)]
pub struct Stack<P> {
    now: P,
    open: Option<(Group, P)>,
}

impl<P: Mix> Stack<P> {
    /// With nothing yet on what lies below all items.
    #[inline]
    pub fn on(below: P) -> Self {
        Self { now: below, open: None }
    }

    /// Draws an item of a group, or of none.
    #[inline]
    pub fn draw(&mut self, group: Option<Group>, over: impl FnOnce(P) -> P) {
        if self.open.map(|(open, _)| open) != group {
            self.close();
            self.open = group.map(|group| (group, self.now));
        }
        self.now = over(self.now);
    }

    /// With all items drawn.
    #[inline]
    #[must_use]
    pub fn finished(mut self) -> P {
        self.close();
        self.now
    }

    fn close(&mut self) {
        if let Some((group, below)) = self.open.take() {
            self.now = below.mixed(self.now, group.opacity);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::resolve::Compositor;
    use crate::scene::Compositing;

    #[test]
    fn a_group_is_what_lies_over_nothing_lessened_by_its_opacity() {
        let compositor = Compositor::new(Compositing::default());
        let (ground, a, b) =
            (Paint([0.2, 0.4, 0.6, 1.0]), Paint([0.5, 0.0, 0.0, 0.5]), Paint([0.0, 0.3, 0.0, 0.6]));
        let group = Group { layer: 1, opacity: 0.25 };
        let mut stack = Stack::on(ground);
        stack.draw(Some(group), |below| compositor.over(below, a));
        stack.draw(Some(group), |below| compositor.over(below, b));
        stack.draw(Some(Group { layer: 2, opacity: 0.25 }), |below| compositor.over(below, a));
        stack.draw(None, |below| compositor.over(below, b));
        let whole = compositor.over(compositor.over(Paint::CLEAR, a), b).times(0.25);
        let expected = [whole, a.times(0.25), b].into_iter().fold(ground, |p, q| compositor.over(p, q));
        let off = stack.finished().0.iter().zip(expected.0).fold(0.0, |off: f64, (p, q)| off + (p - q).abs());
        assert!(off < 1e-15, "{off}");
    }
}
