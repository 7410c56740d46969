//! Words of the scene file that stand for no type of the scene's own.

use crate::parameter::words;

words! {
    /// The kinds of projection.
    pub(super) enum ProjectionName {
        Perspective = "perspective",
        Orthographic = "orthographic",
    }
}

words! {
    /// The kinds of join.
    pub(super) enum JoinName {
        Round = "round",
        Miter = "miter",
        Bevel = "bevel",
    }
}

words! {
    /// The terrain's shading.
    pub(super) enum ShadeName {
        Flat = "flat",
        Hillshade = "hillshade",
    }
}

words! {
    /// The generated terrains.
    pub(super) enum TerrainName {
        Plane = "plane",
        Ramp = "ramp",
        Sine = "sine",
        Cone = "cone",
        Tent = "tent",
        Fbm = "fbm",
    }
}

words! {
    /// The generated layers.
    pub(super) enum VectorName {
        Roads = "roads",
        Paths = "paths",
        Mosaic = "mosaic",
        Parcels = "parcels",
        CaseStudy = "case-study",
    }
}

words! {
    /// The draw orders that are a word.
    pub(super) enum OrderName {
        File = "file",
        Size = "size",
    }
}
