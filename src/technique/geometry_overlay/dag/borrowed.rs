//! Walks along the polylines of a quad where only parts of it are drawn by its data: borrowed sub-quads (3.2.1).
//!
//! Input: the squares that borrow, which posts are vertices of the mesh in use. Output: clippings, and where in each square they start, for
//! the next time. Refuses: nothing.

use super::grid::Square;
use super::structure::{PolylineLod, PolylineLods, QuadClipping, TriangleClipping};
use super::traverse::Cost;
use crate::terrain::lod::{Post, RightTriangle};

/// Sub-quads that are drawn by the data of one quad.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Borrowed {
    /// Sorted by side, then by place.
    squares: Vec<Square>,
    /// Their different sides.
    sides: Vec<u32>,
}

/// Where the polylines of a borrowed quad's data enter a square that borrows (`sub_polyline_LODs_t`). As long as the square is drawn by the same
/// quad's data this stays valid, whatever its mesh.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SubPolylineLods {
    /// The square.
    pub square: Square,
    /// What lies in it, in the order of the data's polylines.
    pub polylines: Vec<SubPolylineLod>,
}

/// A polyline in a square that borrows (`sub_polyline_LOD_t`).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SubPolylineLod {
    /// Its number among the data's.
    pub polyline: u32,
    /// What of it lies in the square, in its order.
    pub sub_quad_clippings: Vec<SubQuadClipping>,
}

/// What of a quad clipping lies in a square that borrows (`sub_quad_clipping_t`).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SubQuadClipping {
    /// The quad clipping's number among its polyline's.
    pub quad_clipping: u32,
    /// The clipping of a smallest triangle by whose edge it enters the square, or in which it starts.
    pub start: u32,
}

impl Borrowed {
    /// Of squares that do not overlap. None may be smaller than the stride of the data that they borrow.
    pub fn new(squares: impl IntoIterator<Item = Square>) -> Self {
        let mut squares: Vec<Square> = squares.into_iter().collect();
        squares.sort_unstable();
        let mut sides: Vec<u32> = squares.iter().map(|square| square.side).collect();
        sides.dedup();
        Self { squares, sides }
    }

    /// The squares, in the order in which walks number them.
    pub fn squares(&self) -> &[Square] {
        &self.squares
    }

    /// The number of the square that holds a triangle; `None` where none borrows.
    fn holding(&self, triangle: &RightTriangle) -> Option<usize> {
        let found = |side: &u32| self.squares.binary_search(&Square::around(*side, triangle)).ok();
        self.sides.iter().find_map(found)
    }
}

impl PolylineLods {
    /// Algorithm 1 for squares of which it is not known where polylines enter them: a walk along all smallest triangles, which where it comes into a
    /// square climbs to the triangle in use and goes on as [`QuadClipping::traverse`]. Calls `draw` with the square's number, and returns for each
    /// square what saves this walk the next time.
    pub fn traverse_borrowed(
        &self,
        borrowed: &Borrowed,
        has_vertex: impl Fn(Post) -> bool,
        mut draw: impl FnMut(usize, &PolylineLod, &QuadClipping, &TriangleClipping),
    ) -> (Vec<SubPolylineLods>, Cost) {
        let empty = |square: &Square| SubPolylineLods { square: *square, polylines: Vec::new() };
        let mut subs: Vec<SubPolylineLods> = borrowed.squares.iter().map(empty).collect();
        let mut cost = Cost::default();
        for (polyline, line) in (0..).zip(&self.polylines) {
            for (quad_clipping, quad) in (0..).zip(&line.quad_clippings) {
                let mut finest = 0;
                while finest < quad.finest_count() {
                    let triangle = &quad.triangle_clippings[finest as usize].triangle;
                    let Some(number) = borrowed.holding(triangle) else {
                        cost.visited += 1;
                        finest += 1;
                        continue;
                    };
                    let sub = &mut subs[number];
                    sub.add(polyline, SubQuadClipping { quad_clipping, start: finest });
                    let draw = |clipping: &TriangleClipping| draw(number, line, quad, clipping);
                    finest = 1 + quad.traverse_square(finest, sub.square, &has_vertex, draw, &mut cost);
                }
            }
        }
        (subs, cost)
    }

    /// Algorithm 1 for a square of which it is known where polylines enter it; these are the data.
    pub fn traverse_cached(
        &self,
        sub: &SubPolylineLods,
        has_vertex: impl Fn(Post) -> bool,
        mut draw: impl FnMut(&PolylineLod, &QuadClipping, &TriangleClipping),
    ) -> Cost {
        let mut cost = Cost::default();
        for SubPolylineLod { polyline, sub_quad_clippings } in &sub.polylines {
            let line = &self.polylines[*polyline as usize];
            for clipping in sub_quad_clippings {
                let quad = &line.quad_clippings[clipping.quad_clipping as usize];
                let draw = |clipping: &TriangleClipping| draw(line, quad, clipping);
                quad.traverse_square(clipping.start, sub.square, &has_vertex, draw, &mut cost);
            }
        }
        cost
    }
}

impl SubPolylineLods {
    fn add(&mut self, polyline: u32, clipping: SubQuadClipping) {
        match self.polylines.last_mut() {
            Some(last) if last.polyline == polyline => last.sub_quad_clippings.push(clipping),
            _ => self.polylines.push(SubPolylineLod { polyline, sub_quad_clippings: vec![clipping] }),
        }
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        let lines = self.polylines.iter().map(|line| size_of_val(&line.sub_quad_clippings[..]));
        size_of_val(&self.polylines[..]) + lines.sum::<usize>()
    }
}

impl QuadClipping {
    /// From where it enters a square until it leaves it; returns the last smallest triangle's clipping that was drawn.
    fn traverse_square(
        &self,
        start: u32,
        square: Square,
        has_vertex: impl Fn(Post) -> bool,
        mut draw: impl FnMut(&TriangleClipping),
        cost: &mut Cost,
    ) -> u32 {
        let is_in = |clipping: &&TriangleClipping| Square::around(square.side, &clipping.triangle) == square;
        let (mut at, mut last) = (self.in_use(start, &has_vertex, cost), start);
        while let Some(clipping) = at {
            cost.visited += 1;
            cost.drawn += 1;
            draw(clipping);
            last = clipping.finest_exit_descendant;
            at = self.following(clipping, &has_vertex, cost).filter(is_in);
        }
        last
    }
}
