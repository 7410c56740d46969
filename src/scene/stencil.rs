//! The parameters of stencil volumes (Schneider & Klein 2007).

/// Parameters of stencil volumes (Schneider & Klein 2007).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StencilVolume {
    /// Towards which end of the line of sight faces are counted (4.2.1).
    pub method: Counting,
    /// What the stencil does beyond its largest and smallest value (4.2.1).
    pub overflow: Overflow,
    /// What a finite far plane does to volumes (4.2.1).
    pub far: FarPlane,
    /// Which caps volumes have.
    pub caps: VolumeCaps,
    /// How the segments of a line meet.
    pub joins: VolumeJoins,
    /// What shares a mask (4.2).
    pub grouping: Grouping,
    /// n: n x n samples a pixel.
    pub samples: u32,
    /// The object whose stencil plane the buffers show; `None`: all of them.
    pub object: Option<u32>,
}

impl Default for StencilVolume {
    fn default() -> Self {
        Self {
            method: Counting::default(),
            overflow: Overflow::default(),
            far: FarPlane::default(),
            caps: VolumeCaps::default(),
            joins: VolumeJoins::default(),
            grouping: Grouping::default(),
            samples: 1,
            object: None,
        }
    }
}

/// Towards which end of the line of sight faces are counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Counting {
    /// Z-pass, but z-fail for volumes that the near plane may cut.
    #[default]
    Automatic,
    /// Faces before the terrain, always.
    ZPass,
    /// Faces behind the terrain, always.
    ZFail,
}

/// What the stencil does beyond its largest and smallest value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Overflow {
    /// It starts again at the other end (EXT_stencil_wrap).
    #[default]
    Wrap,
    /// It stays.
    Saturate,
}

/// What the near plane and a finite far plane do to volumes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FarPlane {
    /// Nothing: their depths are clamped (NV_depth_clamp).
    #[default]
    Clamp,
    /// They cut them.
    Clip,
}

/// Which caps volumes have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum VolumeCaps {
    /// Both.
    #[default]
    Both,
    /// The bottom alone, as shadow volumes have under an occluder: wrong here (4.2.1, "we need a top cap").
    Bottom,
}

/// How the segments of a line meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum VolumeJoins {
    /// Each segment is a box of its own and nothing more (4.1).
    #[default]
    None,
    /// By further volumes, as the layer's `join` and `cap` say.
    Style,
}

/// What shares a mask.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Grouping {
    /// Each object has its own.
    #[default]
    Object,
    /// Objects of one colour, in the order in which the colours first appear.
    Color,
}
