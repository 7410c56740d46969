//! What a picture is drawn of: rectangles at exact places.

/// A rectangle of two triangles, in pixels from the upper left corner, x to the right and y down.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rectangle {
    /// Left, top, right, bottom.
    pub(super) sides: [f64; 4],
    /// The depth at the left side and at the right side: 0..=1.
    pub(super) depths: [f64; 2],
    /// Its colour: red, green, blue.
    pub(super) color: [u8; 3],
}

/// White.
pub(super) const WHITE: [u8; 3] = [255; 3];

impl Rectangle {
    /// A white one, half way between near and far.
    pub(super) fn white(sides: [f64; 4]) -> Self {
        Self { sides, depths: [0.5; 2], color: WHITE }
    }

    /// Its corners: x, y, depth; upper left, lower left, lower right, upper right.
    pub(super) fn corners(&self) -> [[f64; 3]; 4] {
        let ([left, top, right, bottom], [near, far]) = (self.sides, self.depths);
        [[left, top, near], [left, bottom, near], [right, bottom, far], [right, top, far]]
    }
}

/// How a picture is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Way {
    /// Rectangles in their colours, one over the other, without a depth test.
    Flat,
    /// The same with so many samples a pixel, resolved to their mean.
    Samples(u32),
    /// With the depth test: 0 is near, a fragment that is nearer is drawn.
    Depth,
    /// With the depth test: 1 is near.
    DepthReversed,
    /// The interpolated depth as two code values (see [`told`]).
    Interpolated,
    /// No rectangles: texture reads as two code values.
    Filtered,
}

/// A picture that asks a question.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Picture {
    /// Its name, and that of its files.
    pub(super) name: &'static str,
    /// Pixels a side.
    pub(super) side: usize,
    /// How it is drawn.
    pub(super) way: Way,
    /// What is drawn, in order, on black.
    pub(super) rectangles: Vec<Rectangle>,
}

/// The number 0..=1 that a pixel tells: red its 255ths, rounded down, green how many 255ths of such a step remain.
pub(super) fn told([red, green, _]: [f64; 3]) -> f64 {
    (red * 255.0 + green) / 255.0
}

/// A step of a number that is told by two code values.
pub(super) const STEP: f64 = 1.0 / (255.0 * 255.0);
