//! What other right programs draw: machines within the envelope of a scene's device, and the same scene written otherwise.

use super::edit::Edit::{self, Scene, Target, Tiles};
use super::geometry as g;
use crate::scene::{DepthFormat, Device};
use crate::technique::Kind;

/// A legitimate variant.
pub(super) struct Variant {
    /// Its name.
    pub(super) name: &'static str,
    /// Techniques of which it is no right picture.
    pub(super) not: &'static [Kind],
    /// What is otherwise; `None`: the machine alone.
    pub(super) edit: Option<Edit>,
}

/// A machine that may draw for a device, by the keys that make it.
pub(super) struct Machine {
    /// Its name.
    pub(super) name: &'static str,
    /// Keys of the scene file.
    pub(super) keys: &'static [&'static str],
    /// The devices that it may draw for.
    fits: fn(&Device) -> bool,
}

/// Whether a device's envelope holds machines of so many subpixel bits.
const fn holds(device: &Device, bits: u32) -> bool {
    device.subpixel_bits <= bits
}

/// Whether depths are kept at least as coarsely as in single precision, reversed.
fn is_coarse(device: &Device) -> bool {
    device.depth != DepthFormat::F32Reversed
}

/// Machines; the scene's own device is one of them.
pub(super) const MACHINES: &[Machine] = &[
    Machine { name: "its own", keys: &[], fits: |_| true },
    Machine {
        name: "exact mathematics",
        keys: &["device.subpixel_bits=0", "device.precision=\"f64\"", "device.depth=\"f32-reversed\""],
        fits: |_| true,
    },
    Machine {
        name: "8 bits, double precision",
        keys: &["device.subpixel_bits=8", "device.precision=\"f64\""],
        fits: |device| holds(device, 8),
    },
    Machine {
        name: "8 bits, single precision",
        keys: &["device.subpixel_bits=8", "device.precision=\"f32\""],
        fits: |device| holds(device, 8),
    },
    Machine {
        name: "unsnapped, single precision",
        keys: &["device.subpixel_bits=0", "device.precision=\"f32\""],
        fits: |_| true,
    },
    Machine {
        name: "4 bits, double precision",
        keys: &["device.subpixel_bits=4", "device.precision=\"f64\""],
        fits: |device| holds(device, 4),
    },
    Machine {
        name: "8 bits, single precision, finer depths",
        keys: &["device.subpixel_bits=8", "device.precision=\"f32\"", "device.depth=\"f32-reversed\""],
        fits: |device| is_coarse(device) && holds(device, 8),
    },
];

impl Machine {
    /// Whether it may draw for a device.
    pub(super) fn fits(&self, device: &Device) -> bool {
        (self.fits)(device)
    }
}

/// Lines of the screen begin and end at vertices: other vertices are other lines. Dynamic lines are simplified from one end to the other:
/// other vertices are left out from the other end.
const FROM_END_TO_END: &[Kind] = &[Kind::GeometryOverlay, Kind::DynamicLine];

/// Those, and what looks at segments one by one: a clipmap blends strips where they meet, and inverse projection asks the nearest edge.
const BY_SEGMENTS: &[Kind] =
    &[Kind::GeometryOverlay, Kind::DynamicLine, Kind::Clipmap, Kind::InverseProjection];

/// All but stencil volumes compose in a shader.
const SHADERS: &[Kind] = &[
    Kind::Clipmap,
    Kind::InverseProjection,
    Kind::StaticDecal,
    Kind::DynamicLine,
    Kind::GeometryOverlay,
    Kind::Analytic,
];

/// The variants; each is drawn by the first machines ([`MACHINES`]) too.
pub(super) const VARIANTS: &[Variant] = &[
    Variant { name: "as it is", not: &[], edit: None },
    Variant { name: "blended into codes", not: SHADERS, edit: Some(Target) },
    Variant { name: "tiles of 32 pixels", not: &[], edit: Some(Tiles(32)) },
    Variant { name: "tiles of 48 pixels", not: &[], edit: Some(Tiles(48)) },
    Variant { name: "segments split", not: BY_SEGMENTS, edit: Some(Scene(g::segments_split)) },
    Variant { name: "rings begin elsewhere", not: FROM_END_TO_END, edit: Some(Scene(g::rings_rotated)) },
    Variant { name: "rings run the other way", not: FROM_END_TO_END, edit: Some(Scene(g::rings_reversed)) },
    Variant { name: "lines run the other way", not: FROM_END_TO_END, edit: Some(Scene(g::lines_reversed)) },
    Variant { name: "vertices repeated", not: &[], edit: Some(Scene(g::vertices_repeated)) },
    Variant { name: "features far away", not: &[], edit: Some(Scene(g::far_features_added)) },
    Variant { name: "clear layers", not: &[], edit: Some(Scene(g::clear_layers_added)) },
    Variant { name: "layers cut in two", not: &[], edit: Some(Scene(g::layers_cut_in_two)) },
    Variant { name: "another zero point", not: &[], edit: Some(Scene(g::another_origin)) },
    Variant { name: "the grid from its other corner", not: &[], edit: Some(Scene(g::grid_turned)) },
];
