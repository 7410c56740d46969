//! The parameters of stencil volumes, and what they stand for.

use crate::parameter::{Shape, settings, words};

settings! {
    /// Parameters of stencil volumes.
    pub struct Settings of "stencil-volume" {
        /// Towards which end of the line of sight faces are counted.
        "Schneider & Klein 4.2.1" method: Counting = Counting::Automatic;
        /// What the stencil does beyond its largest and smallest value.
        "Schneider & Klein 4.2.1" overflow: Overflow = Overflow::Wrap;
        /// Whether near and far plane cut volumes or their depths are clamped.
        "Schneider & Klein 4.2.1" far: FarPlane = FarPlane::Clamp;
        /// Which caps volumes have; "bottom" leaves the top caps out, which is wrong.
        "Schneider & Klein 4.2.1" caps: VolumeCaps = VolumeCaps::Both;
        /// How the segments of a line meet; "style": as `join` and `cap` say.
        "Schneider & Klein 4.1" joins: VolumeJoins = VolumeJoins::None;
        /// What shares a mask.
        "Schneider & Klein 4.2" grouping: Grouping = Grouping::Object;
        /// n: n x n samples a pixel.
        "Not in the paper" samples: u32 = 1, Shape::Integer(1, 16);
        /// The object whose counts the buffers show, from 0 in draw order; "all": all of them.
        "Not in the paper" object: Option<u32> = None, Shape::Or("all", &Shape::Integer(0, u32::MAX as i64));
    }
}

words! {
    /// Towards which end of the line of sight faces are counted.
    pub enum Counting {
        /// Z-pass, but z-fail for volumes that the near plane may cut.
        Automatic = "automatic",
        /// Faces before the terrain, always.
        ZPass = "z-pass",
        /// Faces behind the terrain, always.
        ZFail = "z-fail",
    }
}

words! {
    /// What the stencil does beyond its largest and smallest value.
    pub enum Overflow {
        /// It starts again at the other end (EXT_stencil_wrap).
        Wrap = "wrap",
        /// It stays.
        Saturate = "saturate",
    }
}

words! {
    /// What the near plane and a finite far plane do to volumes.
    pub enum FarPlane {
        /// Nothing: their depths are clamped (NV_depth_clamp).
        Clamp = "clamp",
        /// They cut them.
        Clip = "clip",
    }
}

words! {
    /// Which caps volumes have.
    pub enum VolumeCaps {
        /// Both.
        Both = "both",
        /// The bottom alone, as shadow volumes have under an occluder: wrong here (4.2.1, "we need a top cap").
        Bottom = "bottom",
    }
}

words! {
    /// How the segments of a line meet.
    pub enum VolumeJoins {
        /// Each segment is a box of its own and nothing more (4.1).
        None = "none",
        /// By further volumes, as the layer's `join` and `cap` say.
        Style = "style",
    }
}

words! {
    /// What shares a mask.
    pub enum Grouping {
        /// Each object has its own.
        Object = "object",
        /// Objects of one colour, in the order in which the colours first appear.
        Color = "color",
    }
}
