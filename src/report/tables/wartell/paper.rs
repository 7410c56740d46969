//! What the paper found (Table 1; 3.3).

/// A row of Table 1, for the first picture of Fig. 4.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found {
    /// Frames of the render thread a second.
    pub(super) render_fps: f64,
    /// Turns of the level-of-detail thread a second.
    pub(super) lod_fps: f64,
    /// OpenGL primitives: 82 triangle strips of the mesh, the rest lines.
    pub(super) primitives: usize,
    /// Vertices of all of them.
    pub(super) vertices: usize,
}

/// With polylines and without them.
pub(super) const TABLE_1: [Found; 2] = [
    Found { render_fps: 45.0, lod_fps: 1.7, primitives: 489, vertices: 241_605 },
    Found { render_fps: 60.0, lod_fps: 2.0, primitives: 82, vertices: 1820 },
];

/// Points of the Georgia county borders.
pub(super) const POINTS: usize = 240_000;

/// Triangles of a quad's legal meshes that cover a point: one of each layer.
pub(super) const COVERING_TRIANGLES: u32 = 15;

/// Bytes of the quad that holds all of them, estimated as points times 12 bytes times covering triangles; measured, in megabytes: 41.8.
pub(super) const QUAD_BYTES: usize = POINTS * 12 * COVERING_TRIANGLES as usize;
