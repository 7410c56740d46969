//! The parameters of analytic coverage.

use crate::parameter::{Shape, settings};

settings! {
    /// Parameters of analytic coverage.
    pub struct Settings of "analytic" {
        /// The most parts of triangles in a pixel (of an image's texels, too) that are told apart; pixels with more are sampled. 0: all are.
        "ours" fragments: u32 = 64, Shape::Integer(0, 65536);
        /// The most parts of edges in a part of a triangle that are told apart; pixels with more are sampled. 0: all pixels are.
        "ours" crowd: u32 = 256, Shape::Integer(0, 65536);
        /// Samples a side of a pixel that is sampled.
        "ours" samples: u32 = 4, Shape::Integer(1, 32);
    }
}
