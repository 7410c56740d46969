//! The paper's experiments: scenes, settings, and what it found (Tables 2 to 5, Fig. 14).

use crate::technique::Kind;

/// A table of the paper.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Table {
    /// Blocks of threads: here tiles of a picture.
    Blocks,
    /// Sizes of the window.
    Window,
    /// Triangles of the terrain.
    Terrain,
    /// Vertices of expanded lines.
    Vertices,
    /// Methods and samples (Fig. 14).
    Methods,
}

impl Table {
    /// All, in the paper's order.
    pub const ALL: [Self; 5] = [Self::Blocks, Self::Window, Self::Terrain, Self::Vertices, Self::Methods];

    /// Its number in the paper.
    pub const fn number(self) -> &'static str {
        match self {
            Self::Blocks => "Table 2",
            Self::Window => "Table 3",
            Self::Terrain => "Table 4",
            Self::Vertices => "Table 5",
            Self::Methods => "Fig. 14",
        }
    }

    /// What it varies.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Blocks => "Blocks of threads; here the side of a tile in pixels",
            Self::Window => "The window's size, with vectors and without them",
            Self::Terrain => "Triangles of the terrain",
            Self::Vertices => "Vertices of lines after expansion",
            Self::Methods => {
                "Stencil volumes with one sample a pixel, with n x n in all pixels (full-screen anti-aliasing), and inverse projection"
            }
        }
    }
}

/// A scene of the experiments.
#[derive(Debug)]
pub struct Study {
    /// The scene's name.
    pub name: &'static str,
    /// How it differs from [`SCENE`] (`path=value`).
    pub changes: &'static [&'static str],
    /// Which tables it is measured for.
    pub tables: &'static [Table],
    /// What the paper found in Tables 4 and 5, frames a second.
    pub(super) paper_fps: Option<f64>,
}

/// The scene that all studies vary: a scene file.
pub const SCENE: &str = include_str!("roads.toml");

const fn study(
    name: &'static str,
    changes: &'static [&'static str],
    tables: &'static [Table],
    paper_fps: f64,
) -> Study {
    Study { name, changes, tables, paper_fps: Some(paper_fps) }
}

/// The experiments.
pub const STUDIES: [Study; 9] = [
    Study { name: "base", changes: &[], tables: &[Table::Blocks, Table::Window], paper_fps: None },
    study(
        "468 triangles",
        &["name=\"468 triangles\"", "terrain.generate.posts=[19, 14]", "terrain.generate.cell_m=300"],
        &[Table::Terrain],
        22.7,
    ),
    study("3,042 triangles", &["name=\"3,042 triangles\""], &[Table::Terrain], 22.7),
    study(
        "10,368 triangles",
        &["name=\"10,368 triangles\"", "terrain.generate.posts=[73, 73]", "terrain.generate.cell_m=54"],
        &[Table::Terrain],
        22.5,
    ),
    study(
        "22,472 triangles",
        &["name=\"22,472 triangles\"", "terrain.generate.posts=[107, 107]", "terrain.generate.cell_m=37"],
        &[Table::Terrain],
        22.1,
    ),
    study(
        "1,640 vertices",
        &["name=\"1,640 vertices\"", "layer.roads.generate.count=792"],
        &[Table::Vertices, Table::Methods],
        25.4,
    ),
    study(
        "2,601 vertices",
        &["name=\"2,601 vertices\"", "layer.roads.generate.count=1261"],
        &[Table::Vertices],
        21.3,
    ),
    study(
        "4,101 vertices",
        &["name=\"4,101 vertices\"", "layer.roads.generate.count=1992"],
        &[Table::Vertices, Table::Methods],
        17.5,
    ),
    study(
        "10,171 vertices",
        &["name=\"10,171 vertices\"", "layer.roads.generate.count=4948"],
        &[Table::Vertices],
        7.8,
    ),
];

/// What is measured of a scene of one's own.
pub(super) const OF_ANY: &[Table] = &[Table::Blocks, Table::Window, Table::Methods];

/// Sides of tiles in pixels.
pub(super) const TILES: [usize; 5] = [16, 32, 64, 128, 256];

/// Width, height, and the paper's frames a second: terrain alone, and with vectors.
pub(super) const WINDOWS: [(usize, usize, [f64; 2]); 4] = [
    (600, 400, [75.9, 31.9]),
    (800, 600, [73.7, 28.6]),
    (1024, 768, [68.3, 25.0]),
    (1200, 800, [60.8, 22.7]),
];

/// Methods of Fig. 14: what they are, and the change that makes them so.
pub(super) const METHODS: [(Kind, &str, &str); 9] = [
    (Kind::StencilVolume, "stencil volumes, 1", "technique.stencil-volume.samples=1"),
    (Kind::StencilVolume, "stencil volumes, 2 x 2 everywhere", "technique.stencil-volume.samples=2"),
    (Kind::StencilVolume, "stencil volumes, 3 x 3 everywhere", "technique.stencil-volume.samples=3"),
    (Kind::StencilVolume, "stencil volumes, 4 x 4 everywhere", "technique.stencil-volume.samples=4"),
    (Kind::StencilVolume, "stencil volumes, 5 x 5 everywhere", "technique.stencil-volume.samples=5"),
    (Kind::InverseProjection, "inverse projection, 2 x 2", "technique.inverse-projection.samples=2"),
    (Kind::InverseProjection, "inverse projection, 3 x 3", "technique.inverse-projection.samples=3"),
    (Kind::InverseProjection, "inverse projection, 4 x 4", "technique.inverse-projection.samples=4"),
    (Kind::InverseProjection, "inverse projection, 5 x 5", "technique.inverse-projection.samples=5"),
];
