//! Taibo et al. 2014: probes of the anisotropic filter with the paper's aliased polygons, with polygons that a library has smoothed, and
//! with exact areas and the style's joins; then one thing at a time: the virtual size, the solutions (4), joints (4.2), line primitives,
//! the filter, the clip size, the level and the machine.

use crate::technique::sweep::{Axis, MACHINES, Sweep};

pub(super) const SWEEP: Sweep = Sweep {
    crossed: &[ANISOTROPY, RASTER],
    alone: &[
        VIRTUAL_SIZE,
        SOLUTION,
        JOINTS,
        LINES,
        OVERLAPS,
        FILTER,
        CLIP_SIZE,
        LEVEL_BIAS,
        TEXEL,
        FILTER_BITS,
        MACHINES,
    ],
    remedies: REMEDIES,
};

const ANISOTROPY: Axis = &[
    &["technique.clipmap.anisotropy=1"],
    &["technique.clipmap.anisotropy=2"],
    &["technique.clipmap.anisotropy=4"],
    &["technique.clipmap.anisotropy=8"],
    &["technique.clipmap.anisotropy=16"],
];

const RASTER: Axis = &[
    &["technique.clipmap.polygons=aliased"],
    &["technique.clipmap.polygons=tiny-skia"],
    &[
        "technique.clipmap.polygons=exact",
        "technique.clipmap.joints=style",
        "technique.clipmap.overlaps=once",
        "technique.clipmap.threshold_texels=0",
    ],
];

const VIRTUAL_SIZE: Axis = &[
    &["technique.clipmap.virtual_size=1024"],
    &["technique.clipmap.virtual_size=2048"],
    &["technique.clipmap.virtual_size=4096"],
    &["technique.clipmap.virtual_size=8192"],
    &["technique.clipmap.virtual_size=16384"],
    &["technique.clipmap.virtual_size=65536"],
    &["technique.clipmap.virtual_size=262144"],
];

const SOLUTION: Axis = &[
    &["technique.clipmap.solution=1-lines"],
    &["technique.clipmap.solution=2-polygons"],
    &["technique.clipmap.solution=3a-both"],
    &["technique.clipmap.solution=3b-wireframe"],
    &["technique.clipmap.solution=4b-offsets"],
    &["technique.clipmap.solution=4b-offsets", "technique.clipmap.offsets=polar"],
];

const JOINTS: Axis = &[
    &["technique.clipmap.joints=method-1"],
    &["technique.clipmap.joints=method-2"],
    &["technique.clipmap.joints=method-3a-strip"],
    &["technique.clipmap.joints=method-3a-quads"],
    &["technique.clipmap.joints=method-3b"],
    &["technique.clipmap.joints=style"],
];

const LINES: Axis = &[
    &["technique.clipmap.lines=plain"],
    &["technique.clipmap.lines=prefiltered", "technique.clipmap.line_filter=disc"],
    &["technique.clipmap.lines=prefiltered", "technique.clipmap.line_filter=cone"],
    &["technique.clipmap.lines=prefiltered", "technique.clipmap.line_filter=gaussian"],
];

const OVERLAPS: Axis = &[&["technique.clipmap.overlaps=once"]];

const FILTER: Axis = &[
    &["technique.clipmap.filter=nearest"],
    &["technique.clipmap.filter=bilinear"],
    &["technique.clipmap.filter=trilinear"],
];

const CLIP_SIZE: Axis = &[
    &["technique.clipmap.clip_size=512"],
    &["technique.clipmap.clip_size=1024"],
    &["technique.clipmap.clip_size=8192"],
];

const LEVEL_BIAS: Axis = &[&["technique.clipmap.level_bias=-1"], &["technique.clipmap.level_bias=1"]];

const TEXEL: Axis = &[&["technique.clipmap.texel=unorm8"]];

/// What graphics processors have.
const FILTER_BITS: Axis = &[&["device.filter_bits=8"]];

const REMEDIES: Axis = &[
    &["technique.clipmap.virtual_size=1048576"],
    &[
        "technique.clipmap.polygons=exact",
        "technique.clipmap.joints=style",
        "technique.clipmap.overlaps=once",
        "technique.clipmap.threshold_texels=0",
    ],
    &["technique.clipmap.anisotropy=64"],
    &["technique.clipmap.level_bias=-1"],
];
