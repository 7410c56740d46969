//! On which sides of a tile posts surely lie, so that triangles beside the tile cost a comparison (Cohen & Sutherland's codes).

use super::TileView;
use super::strip::{GridLines, LANES};
use crate::terrain::{Grid, Node};

/// The post has no height: no triangle with it exists.
pub const MISSING: u8 = 1 << 7;

/// The codes of a node's posts, row by row from the south-west; bits 0 to 3: left, right, above, below the tile.
pub type Outcodes = [[u8; LANES]; LANES];

/// The codes of a node's posts; `slack` bounds the error of their homogeneous tile coordinates.
pub fn outcodes(view: &TileView, grid: &Grid, node: Node, slack: f64) -> Outcodes {
    let mut codes = [[0; LANES]; LANES];
    pulp::Arch::new().dispatch(Classify { view, grid, node, slack, codes: &mut codes });
    codes
}

struct Classify<'a> {
    view: &'a TileView,
    grid: &'a Grid,
    node: Node,
    slack: f64,
    codes: &'a mut Outcodes,
}

impl pulp::WithSimd for Classify<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) {
        let (columns, rows) = self.grid.cells(self.node);
        let lines = GridLines::new(self.view, self.grid, (columns.start, rows.start));
        let ((left, top), (right, bottom)) = (self.view.first, self.view.last());
        for (codes, j) in self.codes.iter_mut().zip(rows.start..=rows.end) {
            let line = lines.line(j);
            let heights = lines.heights(self.grid, &columns, j);
            for (k, (code, h)) in codes.iter_mut().zip(heights).enumerate() {
                let p = line.at(k as f64, h);
                let outside = -self.slack;
                *code = u8::from(p.x - left * p.z < outside)
                    | u8::from(right * p.z - p.x < outside) << 1
                    | u8::from(p.y - top * p.z < outside) << 2
                    | u8::from(bottom * p.z - p.y < outside) << 3
                    | if h.is_nan() { MISSING } else { 0 };
            }
        }
    }
}
