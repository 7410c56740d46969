//! The parameters of dynamic lines, and what they stand for.

use crate::parameter::{Range, Shape, settings, words};

settings! {
    /// Parameters of dynamic lines.
    pub struct Settings of "dynamic-line" {
        /// The longest part that a segment is divided into, metres of the plan; "automatic": half the terrain's resolution.
        "Zechmeister 3.2.2" l_max: Option<f64> = None, Shape::Or("automatic", &Shape::Number(Range::Positive));
        /// When lines are matched with the terrain: where a view first sees them, or all at once.
        "Zechmeister 3.2.2" preparation: Preparation = Preparation::Seen;
        /// Which vertices a view leaves out.
        "Zechmeister 3.3.1" simplification: Simplification = Simplification::SamePixel;
        /// How far a vertex that is left out may lie from the line that remains, pixels; of simplification = "screen-error".
        "Not in the paper" error_px: f64 = 0.5, Shape::Number(Range::Positive);
        /// Which segments are kept.
        "Zechmeister 4.3.1" culling: Culling = Culling::Vertices;
        /// How the boxes of segments meet.
        "Zechmeister 3.3.2, Fig. 4.4" boxes: Boxes = Boxes::Mitred;
        /// What is near enough to a segment to be in the line; "style": as `join` and `cap` say.
        "Zechmeister 3.6" corners: Corners = Corners::Round;
        /// In which order the lines of a pixel are composed.
        "Zechmeister 3.3.3, Fig. 3.7" sorting: Sorting = Sorting::Selection;
        /// Whether a line that covers a pixel by several segments is drawn once.
        "Zechmeister 4.4.2" overlaps: LineOverlaps = LineOverlaps::Once;
        /// What is done about lines that are thinner than a pixel.
        "Zechmeister 4.5, Fig. 4.9" thin_lines: ThinLines = ThinLines::Correction;
        /// How edges are smoothed.
        "Zechmeister 3.5" antialiasing: Antialiasing = Antialiasing::Fxaa;
    }
}

words! {
    /// When lines are matched with the terrain.
    pub enum Preparation {
        /// Each piece of a line when a view first sees it.
        Seen = "seen",
        /// All at once, before the first frame.
        Whole = "whole",
    }
}

words! {
    /// Which vertices a view leaves out.
    pub enum Simplification {
        /// Those in the same pixel as the vertex before them (3.3.1: proposed, and left out of the thesis's program, 4.3.1).
        SamePixel = "same-pixel",
        /// None.
        None = "none",
        /// Those that are no farther than `error_px` from what remains.
        ScreenError = "screen-error",
    }
}

words! {
    /// Which segments are kept.
    pub enum Culling {
        /// Those with a vertex in the frustum.
        Vertices = "vertices",
        /// Those whose box meets the picture.
        Boxes = "boxes",
    }
}

words! {
    /// How the boxes of segments meet.
    pub enum Boxes {
        /// In common faces along the mitre (Fig. 4.4b).
        Mitred = "mitred",
        /// Each runs on by half its width at both ends (Fig. 4.4a).
        Overlapping = "overlapping",
        /// As overlapping, and wide enough for the widest place of the line.
        Enclosing = "enclosing",
    }
}

words! {
    /// What is near enough to a segment to be in the line.
    pub enum Corners {
        /// All within half the width: round joins and caps, the footprint by definition.
        Round = "round",
        /// As the layer's `join` and `cap` say.
        Style = "style",
    }
}

words! {
    /// In which order the lines of a pixel are composed.
    pub enum Sorting {
        /// The draw order, by a selection sort that ends where what lies on top is opaque.
        Selection = "selection",
        /// That in which a parallel machine might find them (Fig. 3.7a).
        None = "none",
    }
}

words! {
    /// Whether a line that covers a pixel by several segments is drawn once.
    pub enum LineOverlaps {
        /// Once.
        Once = "once",
        /// Once for each segment (Fig. 4.4b).
        Double = "double",
    }
}

words! {
    /// What is done about lines that are thinner than a pixel.
    pub enum ThinLines {
        /// Nothing: they are dashed (Fig. 4.9b).
        None = "none",
        /// In top-down views pixels within half a pixel of a segment's picture are in the line (Fig. 4.9c).
        Correction = "correction",
        /// That in every view, but where the segment is hidden.
        SecondDepth = "second-depth",
    }
}

words! {
    /// How edges are smoothed.
    pub enum Antialiasing {
        /// By a filter over the finished picture (FXAA).
        Fxaa = "fxaa",
        /// Not at all.
        None = "none",
        /// By how much of a pixel's reach in the plan the line covers.
        Analytic = "analytic",
    }
}
