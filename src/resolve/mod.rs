//! Colours of features and terrain -> the colour of a pixel -> code values.
//!
//! Input: the scene's compositing and colours. Output: [`Paint`]s composed in draw order, averaged over samples and encoded as
//! 8-bit code values. Refuses: nothing; out-of-range values are clamped when they are encoded.

mod ground;
mod stack;

pub use ground::GroundPaint;
pub use stack::{Mix, Stack};

use crate::math;
use crate::scene::{BlendMode, BlendSpace, Color, Compositing};
use std::fmt;

/// A colour in the working space (encoded or linear values, as the scene says), premultiplied by its alpha.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paint(pub [f64; 4]);

impl Paint {
    /// Nothing.
    pub const CLEAR: Self = Self([0.0; 4]);

    /// The mean of `count` paints whose sum this is.
    #[must_use]
    pub fn divided_by(self, count: f64) -> Self {
        Self(self.0.map(|v| v / count))
    }

    /// So many times this paint, as a part of a sum.
    #[must_use]
    pub fn times(self, count: f64) -> Self {
        Self(self.0.map(|v| v * count))
    }

    /// The sum of two paints.
    #[must_use]
    #[inline]
    pub fn plus(self, other: Self) -> Self {
        let ([a, b, c, d], [e, f, g, h]) = (self.0, other.0);
        Self([a + e, b + f, c + g, d + h])
    }
}

impl fmt::Display for Paint {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let [r, g, b, a] = self.0;
        write!(f, "[{r:.4} {g:.4} {b:.4} {a:.4}]")
    }
}

/// Composes paints by the scene's rules.
#[derive(Debug, Clone, Copy)]
pub struct Compositor {
    rules: Compositing,
}

impl Compositor {
    /// By these rules.
    pub fn new(rules: Compositing) -> Self {
        Self { rules }
    }

    /// A colour in the working space.
    pub fn paint(&self, color: Color) -> Paint {
        let [r, g, b, a] = color.0;
        let working = |v: f64| match self.rules.space {
            BlendSpace::Encoded => v,
            BlendSpace::Linear => linear_from_encoded(v),
        };
        Paint([working(r) * a, working(g) * a, working(b) * a, a])
    }

    /// `source` drawn over `below`.
    #[inline]
    pub fn over(&self, below: Paint, source: Paint) -> Paint {
        let ([r, g, b, a], [sr, sg, sb, sa]) = (below.0, source.0);
        match self.rules.mode {
            BlendMode::Over => {
                let keep = 1.0 - sa;
                Paint([sr + r * keep, sg + g * keep, sb + b * keep, sa + a * keep])
            }
            BlendMode::Additive => Paint([r + sr, g + sg, b + sb, a + sa].map(|v| math::min(v, 1.0))),
        }
    }

    /// The straight-alpha encoded colour of a paint, 0..=1.
    pub fn encoded(&self, paint: Paint) -> [f64; 4] {
        let [r, g, b, a] = paint.0;
        let [r, g, b] = [r, g, b].map(|v| self.encoded_channel(v, a));
        [r, g, b, math::min(math::max(a, 0.0), 1.0)]
    }

    /// The straight encoded value, 0..=1, of a colour channel of a paint of this alpha.
    #[inline]
    pub fn encoded_channel(&self, value: f64, alpha: f64) -> f64 {
        let v = if alpha > 0.0 { value / alpha } else { 0.0 };
        let v = match self.rules.space {
            BlendSpace::Encoded => v,
            BlendSpace::Linear => encoded_from_linear(v),
        };
        math::min(math::max(v, 0.0), 1.0)
    }
}

/// The 8-bit code values of an encoded colour, to nearest.
pub fn code_values(color: [f64; 4]) -> [u8; 4] {
    color.map(|v| (v * 255.0 + 0.5) as u8)
}

/// The sRGB transfer function (IEC 61966-2-1).
pub fn linear_from_encoded(v: f64) -> f64 {
    if v <= 0.040_45 { v / 12.92 } else { math::pow((v + 0.055) / 1.055, 2.4) }
}

/// The inverse of [`linear_from_encoded`].
pub fn encoded_from_linear(v: f64) -> f64 {
    if v <= 0.003_130_8 { v * 12.92 } else { 1.055 * math::pow(v, 1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn compositor(space: BlendSpace, mode: BlendMode) -> Compositor {
        Compositor::new(Compositing { space, mode })
    }

    #[test]
    fn red_at_half_over_blue_at_half_is_what_hard_case_41_says() {
        let c = compositor(BlendSpace::Encoded, BlendMode::Over);
        let below = c.over(Paint::CLEAR, c.paint(Color([0.0, 0.0, 1.0, 0.5])));
        let both = c.over(below, c.paint(Color([1.0, 0.0, 0.0, 0.5])));
        assert_eq!(both, Paint([0.5, 0.0, 0.25, 0.75]));
    }

    #[test]
    fn every_code_value_survives_the_linear_space() {
        let c = compositor(BlendSpace::Linear, BlendMode::Over);
        for v in 0..=255u8 {
            let color = Color::from_rgba8([v, 255 - v, 7, 255]);
            assert_eq!(code_values(c.encoded(c.paint(color))), [v, 255 - v, 7, 255]);
        }
    }

    #[test]
    fn additive_paint_stops_at_one() {
        let c = compositor(BlendSpace::Encoded, BlendMode::Additive);
        let one = c.paint(Color([0.75, 0.25, 0.0, 1.0]));
        assert_eq!(c.over(one, one), Paint([1.0, 0.5, 0.0, 1.0]));
    }
}
