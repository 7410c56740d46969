//! How a line is drawn: its width, its stipple, whether it is anti-aliased.

use crate::math;
use crate::scene::Device;

/// The pattern of a line of dashes (LineStipple).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stipple {
    /// What is drawn, from the lowest bit on.
    pub pattern: u16,
    /// How many fragments a bit stands for, from 1 to 256; what lies beyond is clamped.
    pub factor: u32,
}

impl Stipple {
    /// A line without gaps.
    pub const SOLID: Self = Self { pattern: 0xffff, factor: 1 };

    /// Whether what the counter has reached is drawn (2.1, section 3.4.2 "Line Stipple").
    pub(super) fn is_on(self, counter: u64) -> bool {
        let bit = counter / u64::from(self.factor.clamp(1, 256)) % 16;
        self.pattern >> bit & 1 == 1
    }
}

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineStyle {
    width: f64,
    stipple: Stipple,
    is_smooth: bool,
}

impl LineStyle {
    /// A line as wide as the device can draw it: at most `device.max_line_width_px`. `is_smooth` (LINE_SMOOTH):
    /// anti-aliased, by exact areas.
    pub fn new(width_px: f64, stipple: Stipple, is_smooth: bool, device: &Device) -> Self {
        Self { width: math::min(width_px, device.max_line_width_px), stipple, is_smooth }
    }

    /// Whether a device draws lines of such a width less wide.
    pub fn is_clamped(width_px: f64, device: &Device) -> bool {
        width_px > device.max_line_width_px
    }

    pub(super) fn width(&self) -> f64 {
        self.width
    }

    /// The width of an aliased line: rounded, at least 1 (2.1, section 3.4.2 "Wide Lines").
    pub(super) fn whole_width(&self) -> u32 {
        // The cast saturates.
        (self.width.round() as u32).max(1)
    }

    pub(super) fn stipple(&self) -> Stipple {
        self.stipple
    }

    pub(super) fn is_smooth(&self) -> bool {
        self.is_smooth
    }

    /// A bound of the distance, along either axis, from the segment to the border of a pixel that it covers.
    pub(super) fn reach(&self) -> f64 {
        if self.is_smooth { self.width / 2.0 + 1.0 } else { f64::from(self.whole_width()) / 2.0 + 2.0 }
    }
}
