//! The parameters of inverse projection, and what they stand for.

use crate::parameter::{Shape, settings, words};

settings! {
    /// Parameters of inverse projection.
    pub struct Settings of "inverse-projection" {
        /// n: n x n samples in each P pixel.
        "She 3.4" samples: u32 = 3, Shape::Integer(1, 64);
        /// Which points make a pixel's quadrilateral.
        "She 3.2" corners: Corners = Corners::Centres;
        /// How a sample is judged.
        "She 3.5" point_in_polygon: PointInPolygon = PointInPolygon::EdgeNormals;
        /// What is done with a pixel whose quadrilateral spans the sky or a silhouette.
        "Not in the paper" silhouette: Silhouette = Silhouette::Centre;
    }
}

words! {
    /// Which points make a pixel's quadrilateral.
    pub enum Corners {
        /// The centres of the pixel and of its right, upper right and upper neighbours (She Fig. 6b: half a pixel's shift).
        Centres = "centres",
        /// The pixel's own four corners.
        True = "true",
    }
}

words! {
    /// How a sample is judged.
    pub enum PointInPolygon {
        /// By the normals of the edges that meet the pixel, with the pedal rule (She Codes A and B).
        EdgeNormals = "edge-normals",
        /// By the winding number, exactly.
        Winding = "winding",
    }
}

words! {
    /// What is done with a pixel whose quadrilateral has no meaning.
    pub enum Silhouette {
        /// One sample at the pixel's centre, counted in `counts.refused`.
        Centre = "centre",
        /// The quadrilateral is used all the same where its corners see terrain (the paper's smear).
        Smear = "smear",
    }
}
