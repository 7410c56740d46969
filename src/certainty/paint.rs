//! Paints that are known between bounds, and what they are over, under and on average.

use super::known::Known;
use crate::resolve::{Compositor, Mix, Paint};
use crate::scene::BlendMode;

/// Premultiplied paint in the working space, between two bounds a channel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaintRange {
    /// What each channel is at least.
    pub low: [f64; 4],
    /// What each channel is at most.
    pub high: [f64; 4],
}

impl PaintRange {
    /// Any paint.
    pub const ANY: Self = Self { low: [0.0; 4], high: [1.0; 4] };

    /// A paint that is known.
    pub fn exact(paint: Paint) -> Self {
        Self { low: paint.0, high: paint.0 }
    }

    /// The smallest range around two.
    #[must_use]
    pub fn hull(&self, other: &Self) -> Self {
        let mut all = *self;
        for c in 0..4 {
            all.low[c] = crate::math::min(self.low[c], other.low[c]);
            all.high[c] = crate::math::max(self.high[c], other.high[c]);
        }
        all
    }

    /// With `source` drawn over it. Every channel grows with what is below, so that bounds go to bounds.
    #[must_use]
    pub fn under(&self, source: Paint, mode: BlendMode) -> Self {
        let over = |below: [f64; 4]| {
            let mut out = [0.0; 4];
            for (c, v) in out.iter_mut().enumerate() {
                *v = match mode {
                    BlendMode::Over => source.0[c] + below[c] * (1.0 - source.0[3]),
                    BlendMode::Additive => crate::math::min(below[c] + source.0[c], 1.0),
                };
            }
            out
        };
        Self { low: over(self.low), high: over(self.high) }
    }

    /// With `source` drawn over it where the point is known to lie in what it paints.
    #[must_use]
    pub fn under_known(&self, known: Known, source: Paint, mode: BlendMode) -> Self {
        match known {
            Known::In => self.under(source, mode),
            Known::Out => *self,
            Known::Open => self.under(source, mode).hull(self),
        }
    }

    /// With any number of sources drawn over it in any order, or none. `straight`: around the sources' colours at full alpha,
    /// between which and what is below all that is drawn stays.
    #[must_use]
    pub fn under_any_of(&self, straight: &Self, mode: BlendMode) -> Self {
        match mode {
            BlendMode::Over => self.hull(straight),
            BlendMode::Additive => Self { low: self.low, high: [1.0; 4] },
        }
    }

    /// The widest channel.
    pub fn width(&self) -> f64 {
        (0..4).fold(0.0, |widest, c| crate::math::max(self.high[c] - self.low[c], widest))
    }
}

impl Mix for PaintRange {
    fn mixed(self, other: Self, share: f64) -> Self {
        let mix = |a: [f64; 4], b: [f64; 4]| Paint(a).mixed(Paint(b), share).0;
        Self { low: mix(self.low, other.low), high: mix(self.high, other.high) }
    }
}

/// The sum of the paints of a pixel's pieces, each times its area.
#[derive(Debug, Clone, Copy)]
pub struct PaintMean {
    sum: PaintRange,
    open: [f64; 4],
}

impl PaintMean {
    /// Of no pieces yet.
    pub const NOTHING: Self = Self { sum: PaintRange { low: [0.0; 4], high: [0.0; 4] }, open: [0.0; 4] };

    /// Adds a piece's paint.
    pub fn add(&mut self, paint: &PaintRange, area: f64) {
        for c in 0..4 {
            self.sum.low[c] += area * paint.low[c];
            self.sum.high[c] += area * paint.high[c];
            self.open[c] += area * (paint.high[c] - paint.low[c]);
        }
    }

    /// Takes away a piece's paint that was added before: its bounds are sharpened. (What rounding leaves is within the slop
    /// of its cut.)
    pub fn remove(&mut self, paint: &PaintRange, area: f64) {
        self.add(paint, -area);
    }

    /// Adds the pieces of another sum.
    pub fn join(&mut self, other: &Self) {
        for c in 0..4 {
            self.sum.low[c] += other.sum.low[c];
            self.sum.high[c] += other.sum.high[c];
            self.open[c] += other.open[c];
        }
    }

    /// How much of the widest channel is open.
    pub fn open(&self) -> f64 {
        self.open.iter().fold(0.0, |most, v| crate::math::max(*v, most))
    }

    /// The pixel's straight-alpha encoded colour: lower bound, upper bound, estimate. `slop` is the doubtful share of its area.
    pub fn colors(&self, compositor: &Compositor, slop: f64) -> [[f64; 4]; 3] {
        let (mut low, mut high, mut middle) = (self.sum.low, self.sum.high, [0.0; 4]);
        for c in 0..4 {
            middle[c] = clamped(0.5 * (low[c] + high[c]));
            low[c] = clamped(low[c] - slop);
            high[c] = clamped(high[c] + slop);
        }
        if high[3] < NO_ALPHA {
            // As good as nothing is there, and nothing has no colour.
            return [[0.0; 4], [0.0, 0.0, 0.0, clamped(high[3] + ENCODING)], [0.0; 4]];
        }
        let (mut lo, mut hi) = ([0.0; 4], [0.0; 4]);
        for c in 0..4 {
            // The encoded straight colour grows with the channel and falls as the alpha grows.
            lo[c] = straight(compositor, low[c], if c == 3 { low[3] } else { high[3] }, c);
            hi[c] = match c {
                3 => straight(compositor, high[3], high[3], 3),
                _ if low[3] > 0.0 => straight(compositor, high[c], low[3], c),
                // Perhaps there is nothing there, or some of any colour.
                _ => 1.0,
            };
        }
        let estimate = compositor.encoded(Paint(middle));
        let mut out = [lo, hi, estimate];
        for c in 0..4 {
            out[0][c] = clamped(lo[c] - ENCODING);
            out[1][c] = clamped(hi[c] + ENCODING);
            out[2][c] = crate::math::min(crate::math::max(estimate[c], out[0][c]), out[1][c]);
        }
        out
    }
}

/// An alpha that is surely below this is none: far below any code value's, far above what rounding leaves.
const NO_ALPHA: f64 = 1e-9;

/// What the roundings of sums, of the transfer function and of the division to straight alpha can amount to.
const ENCODING: f64 = 1e-14;

fn clamped(v: f64) -> f64 {
    crate::math::min(crate::math::max(v, 0.0), 1.0)
}

/// One channel of the straight encoded colour.
fn straight(compositor: &Compositor, value: f64, alpha: f64, channel: usize) -> f64 {
    if channel == 3 { clamped(value) } else { compositor.encoded_channel(value, alpha) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Compositing;
    use proptest::prelude::*;

    #[test]
    fn a_pixel_without_alpha_has_no_colour_and_one_that_may_have_none_may_have_any() {
        let compositor = Compositor::new(Compositing::default());
        let mut mean = PaintMean::NOTHING;
        mean.add(&PaintRange::exact(Paint::CLEAR), 1.0);
        let [low, high, estimate] = mean.colors(&compositor, 1e-14);
        assert_eq!((low, estimate, high[0]), ([0.0; 4], [0.0; 4], 0.0));
        let [low, high, _] = mean.colors(&compositor, 1e-6);
        assert_eq!((low[0], high[0]), (0.0, 1.0));
    }

    #[test]
    fn bounds_of_paint_stay_around_what_is_drawn_over_it() {
        let half = Paint([0.5, 0.0, 0.0, 0.5]);
        let open = PaintRange { low: [0.0, 0.2, 0.4, 1.0], high: [0.2, 0.4, 0.4, 1.0] };
        let over = open.under(half, BlendMode::Over);
        assert_eq!((over.low, over.high), ([0.5, 0.1, 0.2, 1.0], [0.6, 0.2, 0.2, 1.0]));
        let more = open.under(half, BlendMode::Additive);
        assert_eq!((more.low, more.high), ([0.5, 0.2, 0.4, 1.0], [0.7, 0.4, 0.4, 1.0]));
    }

    fn paint() -> impl Strategy<Value = Paint> {
        prop::array::uniform4(0.0..=1.0f64).prop_map(|[r, g, b, a]| Paint([r * a, g * a, b * a, a]))
    }

    proptest! {
        #[test]
        fn a_range_has_every_paint_that_the_open_answers_allow(
            ground in paint(),
            layers in prop::collection::vec((paint(), prop::sample::select(vec![Known::In, Known::Out, Known::Open])), 0..6),
            is_additive: bool,
        ) {
            let mode = if is_additive { BlendMode::Additive } else { BlendMode::Over };
            let compositor = Compositor::new(Compositing { mode, ..Compositing::default() });
            let range = layers.iter().fold(PaintRange::exact(ground), |below, (paint, known)| {
                below.under_known(*known, *paint, mode)
            });
            for answers in 0..1 << layers.len() {
                let is_in = |k: usize| answers >> k & 1 == 1;
                let mut drawn = layers.iter().enumerate();
                if !drawn.all(|(k, (_, known))| *known == Known::Open || *known == Known::of(is_in(k))) {
                    continue;
                }
                let drawn = layers.iter().enumerate().filter(|(k, _)| is_in(*k));
                let all = drawn.fold(ground, |below, (_, (paint, _))| compositor.over(below, *paint));
                let fits = |c: usize| (range.low[c] - 1e-12..=range.high[c] + 1e-12).contains(&all.0[c]);
                prop_assert!((0..4).all(fits), "{all:?} {range:?}");
            }
        }
    }
}
