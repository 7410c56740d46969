//! Which settings of a technique a report tries: a table of data a technique.
//!
//! A setting is a list of changes to the scene file (`path=value`), so that every row of a report can be drawn again by
//! `drapery render --set`.

/// The changes of one setting: `path=value`.
pub type Step = &'static [&'static str];

/// Settings of one thing, in the order of a line of the plot.
pub type Axis = &'static [Step];

/// What is tried of a technique. (The scene's own settings are tried always.)
#[derive(Debug, Clone, Copy)]
pub struct Sweep {
    /// Every step of the first with every step of the others; each combination of the others is a line of the plot.
    pub crossed: &'static [Axis],
    /// One at a time, all else as in the scene.
    pub alone: &'static [Axis],
    /// What is tried at a pixel that is explained: what may bring it nearer to the truth.
    pub remedies: Axis,
}

/// The machines that are imitated: single precision, then what graphics processors add to it.
pub const MACHINES: Axis = &[
    &["device.precision=f32"],
    &["device.precision=f32", "device.subpixel_bits=8"],
    &["device.precision=f32", "device.subpixel_bits=8", "device.depth=unorm24"],
    &["device.precision=f32", "device.subpixel_bits=4", "device.depth=unorm16"],
];
