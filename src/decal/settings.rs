//! The parameters of static decals, and what they stand for.

use crate::parameter::{Shape, settings, words};
use crate::scene::{Join, Line, StrokeForm};

settings! {
    /// Parameters of static decals.
    pub struct Settings of "static-decal" {
        /// Samples in each pixel: 4 and 8 as multisampling places them, other squares as a grid.
        "Zechmeister 4.5, 5.2.1" samples: u32 = 8, Shape::IntegerOf(&[1, 4, 8, 9, 16, 25, 36, 64, 100, 144, 256, 400, 576, 1024]);
        /// How an edge becomes coverage.
        "Zechmeister 3.5, future work" edges: Edges = Edges::Sampled;
        /// Cells a side of the decal grid.
        "Zechmeister 4.2.1" grid: u32 = 500, Shape::Integer(1, 4096);
        /// The most edges of a polygon in a leaf of its quadtree that may still be divided.
        "Zechmeister 4.2.1, 5.2.3" leaf_capacity: u32 = 8, Shape::Integer(1, 65536);
        /// How often a quadtree's rectangle is divided at most.
        "Zechmeister 4.2.1, 5.2.3" depth: u32 = 8, Shape::Integer(0, 16);
        /// How the polygon of a leaf that is partly inside is closed.
        "Zechmeister 4.2.1" leaf_polygons: LeafPolygons = LeafPolygons::Corner;
        /// How what a cell holds is searched.
        "Zechmeister 4.2.1, 5.2.4" hierarchy: Hierarchy = Hierarchy::Binary;
        /// Which joins and ends lines have.
        "Zechmeister 3.6, 4.2.1" joins: Joins = Joins::Thesis;
        /// Of which side of an outline that is inset or offset a sample is asked.
        "Zechmeister 4.4.1, Fig. 4.8" outlines: Outlines = Outlines::Side;
        /// What the segments of a line that lie over one another do.
        "Zechmeister Fig. 4.7" overlaps: Overlaps = Overlaps::Once;
        /// When the structures of a cell are built.
        "Zechmeister 4.2" preparation: Preparation = Preparation::Seen;
    }
}

/// How far a miter of 40 degrees reaches, in half widths: 1 / sin(20 degrees).
pub(super) const REACH_OF_40: f64 = 2.923_804_400_163_087_6;

impl Settings {
    /// What is drawn of a stroke in metres.
    pub fn stroke_form(&self, line: &Line) -> StrokeForm {
        let form = StrokeForm::of_style(line);
        match (self.joins, line.join) {
            (Joins::Style, _) => form,
            (Joins::Thesis, Join::Miter { .. }) => {
                StrokeForm { join: "miter-round", miter_limit: Some(REACH_OF_40), cap: "round" }
            }
            (Joins::Thesis, _) => StrokeForm { cap: "round", ..form },
        }
    }
}

words! {
    /// How an edge becomes coverage.
    pub enum Edges {
        /// By the share of the samples that are inside.
        Sampled = "sampled",
        /// By the distance of the pixel's centre from the nearest edge, in pixels: one sample a pixel, whatever `samples` says.
        Analytic = "analytic",
    }
}

words! {
    /// How the polygon of a leaf that is partly inside is closed on the leaf's border.
    pub enum LeafPolygons {
        /// By the winding number of the leaf's corner, which says what the edges along the border would; nothing is rounded.
        Corner = "corner",
        /// By clipping: new vertices on the border, rounded, and edges along it (the thesis).
        Clipped = "clipped",
    }
}

words! {
    /// How what a cell holds is searched.
    pub enum Hierarchy {
        /// A full binary tree over what is sorted by draw order (the thesis).
        Binary = "binary",
        /// The same order, eight to a node.
        Wide = "wide",
        /// A binary tree over lines along a space-filling curve (Thöny et al. 2017); what is found is sorted.
        Curve = "curve",
    }
}

words! {
    /// Which joins and ends lines have.
    pub enum Joins {
        /// The layer's `join`, but miters sharper than 40 degrees are round; ends are round.
        Thesis = "thesis",
        /// The layer's `join` with its limit, and its `cap`.
        Style = "style",
    }
}

words! {
    /// Of which side of an outline that is inset or offset a sample is asked.
    pub enum Outlines {
        /// That of the segment it is near to: wrong where the outline is wide (Fig. 4.8).
        Side = "side",
        /// That of the whole polygon's border.
        Polygon = "polygon",
    }
}

words! {
    /// What the segments of a line that lie over one another do.
    pub enum Overlaps {
        /// They count once (Fig. 4.7b).
        Once = "once",
        /// Each is composed (Fig. 4.7a).
        Double = "double",
    }
}

words! {
    /// When the structures of a cell are built.
    pub enum Preparation {
        /// When a sample first lies in it.
        Seen = "seen",
        /// All before the first frame (the thesis).
        Whole = "whole",
    }
}
