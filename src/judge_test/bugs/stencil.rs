//! Stencil volumes that are counted wrong.

use super::super::edit::Edit::Keys;
use super::bug::{Bug, Class::Stencil as Here};
use crate::technique::Kind;

const VOLUMES: &[Kind] = &[Kind::StencilVolume];

/// The bugs.
pub(super) const BUGS: &[Bug] = &[
    Bug::of(
        VOLUMES,
        Here,
        "z-pass with the eye inside",
        Keys(&["technique.stencil-volume.method=\"z-pass\""]),
    ),
    Bug::of(
        VOLUMES,
        Here,
        "top caps missing",
        Keys(&["technique.stencil-volume.caps=\"bottom\"", "technique.stencil-volume.method=\"z-fail\""]),
    ),
    Bug::of(
        VOLUMES,
        Here,
        "top caps missing where z-fail is chosen",
        Keys(&["technique.stencil-volume.caps=\"bottom\""]),
    ),
    Bug::of(
        VOLUMES,
        Here,
        "stencil that saturates",
        Keys(&["technique.stencil-volume.overflow=\"saturate\"", "device.stencil_bits=2"]),
    ),
    Bug::of(
        VOLUMES,
        Here,
        "stencil of 8 bits that saturates",
        Keys(&["technique.stencil-volume.overflow=\"saturate\""]),
    ),
    Bug::of(
        VOLUMES,
        Here,
        "saturates, z-fail",
        Keys(&[
            "technique.stencil-volume.overflow=\"saturate\"",
            "technique.stencil-volume.method=\"z-fail\"",
            "device.stencil_bits=3",
        ]),
    ),
    Bug::of(VOLUMES, Here, "stencil of too few bits", Keys(&["device.stencil_bits=1"])),
    Bug::of(
        VOLUMES,
        Here,
        "volumes cut by the near plane",
        Keys(&["technique.stencil-volume.far=\"clip\"", "technique.stencil-volume.method=\"z-pass\""]),
    ),
    Bug::of(
        VOLUMES,
        Here,
        "volumes cut by the far plane",
        Keys(&["technique.stencil-volume.far=\"clip\"", "technique.stencil-volume.method=\"z-fail\""]),
    ),
    Bug::of(VOLUMES, Here, "masks of a colour", Keys(&["technique.stencil-volume.grouping=\"color\""])),
    Bug::of(VOLUMES, Here, "a mask an object", Keys(&["technique.stencil-volume.grouping=\"object\""])),
    Bug::of(
        VOLUMES,
        Here,
        "joins that nobody asked for",
        Keys(&["technique.stencil-volume.joins=\"style\""]),
    ),
    Bug::of(VOLUMES, Here, "boxes without joins", Keys(&["technique.stencil-volume.joins=\"none\""])),
];
