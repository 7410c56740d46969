//! The parameters of geometry overlay, and what they stand for.

use crate::parameter::{Range, Shape, settings, words};

settings! {
    /// Parameters of geometry overlay.
    pub struct Settings of "geometry-overlay" {
        /// How lines are rasterized.
        "Wartell et al. 3.2.1" lines: Lines = Lines::Gl;
        /// What of polygons is drawn.
        "Wartell et al. 3.1" polygons: Polygons = Polygons::Outlines;
        /// How wide lines are.
        "Wartell et al. 3.1" widths: Widths = Widths::Style;
        /// Polygon offset of the mesh: how much of a triangle's depth slope it is moved back by.
        "Wartell et al. 3.2.1" offset_factor: f64 = 1.0, Shape::Number(Range::Finite);
        /// Polygon offset of the mesh: of how many of the depth buffer's smallest steps.
        "Wartell et al. 3.2.1" offset_units: f64 = 1.0, Shape::Number(Range::Finite);
        /// Which fragments along a line are drawn: 16 bits, the lowest first.
        "Wartell et al. 3.1" stipple: u32 = 0xffff, Shape::Integer(0, 0xffff);
        /// How many fragments a bit of the stipple stands for.
        "Wartell et al. 3.1" stipple_factor: u32 = 1, Shape::Integer(1, 256);
        /// What a quad clipping is drawn as: a stipple starts again in each line, or runs through.
        "Wartell et al. 3.2.1" primitives: Primitives = Primitives::Lines;
        /// How the triangle clippings of borrowed regions are found.
        "Wartell et al. 3.2.1" borrowed: Borrowed = Borrowed::Cached;
        /// How far a line may be simplified within a triangle, pixels: what a BLG tree's tolerance in metres is at the distance of the triangle; 0: not
        /// at all.
        "Wartell et al. 3.2.2" tolerance_px: f64 = 0.0, Shape::Number(Range::NotNegative);
    }
}

words! {
    /// How lines are rasterized.
    pub enum Lines {
        /// As OpenGL does: the diamond-exit rule, wide ones by copies of each fragment.
        Gl = "gl",
        /// By the share of each pixel that they cover.
        Antialiased = "antialiased",
    }
}

words! {
    /// What of polygons is drawn.
    pub enum Polygons {
        /// Their borders, as lines (the paper, which has lines alone).
        Outlines = "outlines",
        /// Fills as triangles on the mesh: of each pixel whose centre they cover.
        Filled = "filled",
        /// Fills as triangles on the mesh, by the share of each pixel that they cover.
        Antialiased = "antialiased",
    }
}

words! {
    /// How wide lines are.
    pub enum Widths {
        /// As the layer says; metres are turned to pixels where a quad clipping comes nearest to the eye.
        Style = "style",
        /// One pixel.
        One = "one",
    }
}

words! {
    /// What a quad clipping is drawn as.
    pub enum Primitives {
        /// `GL_LINES`: each segment by itself (the paper).
        Lines = "lines",
        /// `GL_LINE_STRIP`: a stipple runs through.
        Strips = "strips",
    }
}

words! {
    /// How the triangle clippings of borrowed regions are found.
    pub enum Borrowed {
        /// Where a line enters each region is kept from frame to frame.
        Cached = "cached",
        /// By a walk over the whole quad that was borrowed from, each time.
        Searched = "searched",
    }
}
