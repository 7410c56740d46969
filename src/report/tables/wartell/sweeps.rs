//! What is varied, one parameter at a time (2.1, 3.2.1, 3.2.2).

/// A parameter and the values that are tried.
#[derive(Debug, Clone, Copy)]
pub struct Sweep {
    /// Its name in the tables.
    pub varied: &'static str,
    /// What it is.
    pub title: &'static str,
    /// Each setting with its words and the changes of the scene file that make it so. Pictures are compared with the first one's.
    pub settings: &'static [Setting],
}

/// A setting in words, and changes of the scene file.
pub type Setting = (&'static str, &'static [&'static str]);

macro_rules! error_px {
    ($value:literal) => {
        ($value, &[concat!("terrain.lod={ error_px = ", $value, " }")])
    };
}

macro_rules! borrow {
    ($share:literal, $found:literal) => {
        (
            concat!($share, ", ", $found),
            &[
                concat!("terrain.lod.borrow=", $share),
                concat!("technique.geometry-overlay.borrowed=", $found),
            ],
        )
    };
}

macro_rules! offset {
    ($factor:literal, $units:literal) => {
        (
            concat!("factor ", $factor, ", units ", $units),
            &[
                concat!("technique.geometry-overlay.offset_factor=", $factor),
                concat!("technique.geometry-overlay.offset_units=", $units),
            ],
        )
    };
}

macro_rules! tolerance_px {
    ($value:literal) => {
        ($value, &[concat!("technique.geometry-overlay.tolerance_px=", $value)])
    };
}

/// The mesh's screen error.
pub const ERROR_PX: Sweep = Sweep {
    varied: "error_px",
    title: "The mesh's largest error on the screen, pixels (2.1)",
    settings: &[error_px!("0.5"), error_px!("1"), error_px!("2"), error_px!("4"), error_px!("8")],
};

/// The share of quads that borrow.
pub const BORROW: Sweep = Sweep {
    varied: "borrow",
    title: "The share of quads that are drawn by the data of a larger one (3.2.1)",
    settings: &[
        borrow!("0", "cached"),
        borrow!("0.25", "cached"),
        borrow!("0.25", "searched"),
        borrow!("0.5", "cached"),
        borrow!("0.5", "searched"),
    ],
};

/// Polygon offset of the mesh.
pub const OFFSET: Sweep = Sweep {
    varied: "offset",
    title: "Polygon offset of the mesh (3.2.1)",
    settings: &[
        offset!("0", "0"),
        offset!("0", "1"),
        offset!("0", "4"),
        offset!("1", "0"),
        offset!("1", "1"),
        offset!("4", "0"),
        offset!("4", "4"),
    ],
};

/// How far lines are simplified within a triangle.
pub const TOLERANCE: Sweep = Sweep {
    varied: "tolerance_px",
    title: "Tolerance of the BLG tree of a triangle clipping, pixels (3.2.2)",
    settings: &[
        tolerance_px!("0"),
        tolerance_px!("0.25"),
        tolerance_px!("0.5"),
        tolerance_px!("1"),
        tolerance_px!("2"),
    ],
};

/// All of them.
pub const SWEEPS: [Sweep; 4] = [ERROR_PX, BORROW, OFFSET, TOLERANCE];
