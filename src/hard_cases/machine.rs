//! The machines that cases are drawn on.

/// A machine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Machine {
    /// Its name in tables.
    pub(super) name: &'static str,
    /// The keys of `[device]` that make it.
    pub(super) keys: &'static [&'static str],
}

/// Exact mathematics.
pub(super) const F64: Machine = Machine { name: "f64", keys: &[] };
/// Single precision.
pub(super) const F32: Machine = Machine { name: "f32", keys: &["device.precision=f32"] };
/// Single precision, vertices on 1/256 of a pixel.
pub(super) const SNAPPED_8: Machine =
    Machine { name: "snapped 8", keys: &["device.precision=f32", "device.subpixel_bits=8"] };
/// Single precision, vertices on 1/16 of a pixel.
pub(super) const SNAPPED_4: Machine =
    Machine { name: "snapped 4", keys: &["device.precision=f32", "device.subpixel_bits=4"] };
/// Fixed-point depth of 24 bits.
pub(super) const UNORM24: Machine = Machine {
    name: "unorm24",
    keys: &["device.precision=f32", "device.subpixel_bits=8", "device.depth=unorm24"],
};
/// Fixed-point depth of 16 bits.
pub(super) const UNORM16: Machine = Machine {
    name: "unorm16",
    keys: &["device.precision=f32", "device.subpixel_bits=8", "device.depth=unorm16"],
};
/// Depth in single precision that is not reversed.
pub(super) const F32_DEPTH: Machine = Machine {
    name: "f32 depth",
    keys: &["device.precision=f32", "device.subpixel_bits=8", "device.depth=f32"],
};

/// What every case is drawn on.
pub(super) const MACHINES: &[Machine] = &[F64, F32, SNAPPED_8, SNAPPED_4];
/// These, and depth formats: where depths decide.
pub(super) const DEPTHS: &[Machine] = &[F64, F32, SNAPPED_8, SNAPPED_4, F32_DEPTH, UNORM24, UNORM16];
