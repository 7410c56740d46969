//! The right triangles that a restricted quadtree triangulation is made of, as posts of its grid.
//!
//! Input: nothing. Output: [`RightTriangle`], its halves and what it is a half of. Refuses: nothing.
//!
//! A triangle is halved from its right angle to the middle of its longest side (Wartell et al. 2003, 2.1: the triangle-split relation). Which
//! triangles there are is a matter of coordinates alone: cells of 2^k posts a side have diagonals that alternate like a chessboard
//! ([`splits_sw_ne`]), as [`Diagonal::Alternating`](crate::scene::Diagonal) has them at the finest level.

/// A post of a grid: column and row. Posts beyond the grid's last are numbered on.
pub type Post = [u32; 2];

/// Which way the cell of `size` posts a side at column and row (in such cells) is split: true from south-west to north-east.
#[inline]
pub fn splits_sw_ne([column, row]: [u32; 2]) -> bool {
    (column + row).is_multiple_of(2)
}

/// A triangle of the hierarchy: apex, left and right run counter-clockwise; the right angle is at the apex.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct RightTriangle {
    /// Where the right angle is.
    pub apex: Post,
    /// The end of the longest side that follows the apex, counter-clockwise.
    pub left: Post,
    /// The other end of the longest side.
    pub right: Post,
}

impl RightTriangle {
    /// The two halves of the cell of `size` posts a side (a power of two) at column and row, in such cells: the lower one first.
    pub fn of_cell([column, row]: [u32; 2], size: u32) -> [Self; 2] {
        let [west, south] = [column * size, row * size];
        let (sw, se) = ([west, south], [west + size, south]);
        let (ne, nw) = ([west + size, south + size], [west, south + size]);
        if splits_sw_ne([column, row]) {
            [Self { apex: se, left: ne, right: sw }, Self { apex: nw, left: sw, right: ne }]
        } else {
            [Self { apex: sw, left: se, right: nw }, Self { apex: ne, left: nw, right: se }]
        }
    }

    /// Its corners, counter-clockwise from the apex.
    #[inline]
    pub fn corners(&self) -> [Post; 3] {
        [self.apex, self.left, self.right]
    }

    /// How often halves of halves are smaller: 0 where no half has posts for corners. Legs are along the grid's lines, 2^(n/2) posts
    /// long, where it is even; of odd ones the longest side is, 2^((n+1)/2) posts long.
    #[inline]
    pub fn layer(&self) -> u32 {
        let [x, y] = [0, 1].map(|k| self.apex[k].abs_diff(self.left[k]));
        let is_diagonal = x == y;
        2 * x.max(y).trailing_zeros() + u32::from(is_diagonal)
    }

    /// The post in the middle of its longest side; `None` for the smallest, whose middle is no post.
    #[inline]
    pub fn middle(&self) -> Option<Post> {
        let [x, y] = [0, 1].map(|k| self.left[k] + self.right[k]);
        (x % 2 == 0 && y % 2 == 0).then_some([x / 2, y / 2])
    }

    /// Whether another one, no larger and of the same hierarchy, is a part of it.
    pub fn holds(&self, other: &Self) -> bool {
        // The smaller one's middle, times three, is strictly on the left of all sides.
        let corners = self.corners().map(|post| post.map(|at| 3 * i64::from(at)));
        let [a, b, c] = other.corners().map(|post| post.map(i64::from));
        let middle = [0, 1].map(|k| a[k] + b[k] + c[k]);
        (0..3).all(|k| {
            let (from, to) = (corners[k], corners[(k + 1) % 3]);
            (to[0] - from[0]) * (middle[1] - from[1]) > (to[1] - from[1]) * (middle[0] - from[0])
        })
    }

    /// Its halves, that of its left end first; `None` for the smallest.
    #[inline]
    pub fn halves(&self) -> Option<[Self; 2]> {
        let middle = self.middle()?;
        let Self { apex, left, right } = *self;
        Some([
            Self { apex: middle, left: apex, right: left },
            Self { apex: middle, left: right, right: apex },
        ])
    }

    /// What it is a half of. Its apex is the middle of that one's longest side, which goes on from one of its legs: of the two legs,
    /// the one that the chessboard of diagonals has.
    pub fn whole(&self) -> Self {
        let Self { apex, left, right } = *self;
        let is_kept = if self.layer().is_multiple_of(2) {
            // Legs along the grid's lines: the whole's apex is the middle of a cell that is as wide as its longest side.
            let half = [0, 1].map(|k| apex[k].abs_diff(left[k])).into_iter().max().unwrap_or(0);
            left.iter().all(|at| at / half % 2 == 1)
        } else {
            // Legs along diagonals of a cell: the whole's longest side is the one that splits the cell.
            let half = apex[0].abs_diff(left[0]);
            let along = (right[0] > apex[0]) == (right[1] > apex[1]);
            splits_sw_ne(apex.map(|at| at / (2 * half))) == along
        };
        let beyond = |end: Post| [0, 1].map(|k| (2 * apex[k]).wrapping_sub(end[k]));
        if is_kept {
            // A left half read backwards: `left` is the whole's apex.
            Self { apex: left, left: right, right: beyond(right) }
        } else {
            Self { apex: right, left: beyond(left), right: left }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all_below(triangle: RightTriangle, visit: &mut impl FnMut(RightTriangle)) {
        visit(triangle);
        if let Some(halves) = triangle.halves() {
            halves.into_iter().for_each(|half| all_below(half, visit));
        }
    }

    fn doubled_area(triangle: &RightTriangle) -> i64 {
        let [a, b, c] = triangle.corners().map(|post| post.map(i64::from));
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }

    #[test]
    fn halves_have_half_the_area_the_next_layer_and_know_what_they_are_halves_of() {
        for cell in [[0, 0], [1, 0], [2, 3], [5, 2]] {
            for root in RightTriangle::of_cell(cell, 8) {
                assert_eq!(root.layer(), 6);
                all_below(root, &mut |triangle| {
                    for half in triangle.halves().into_iter().flatten() {
                        assert_eq!(2 * doubled_area(&half), doubled_area(&triangle));
                        assert_eq!(half.layer() + 1, triangle.layer());
                        assert_eq!(half.whole(), triangle, "{half:?}");
                    }
                });
            }
        }
    }

    #[test]
    fn the_smallest_are_the_halves_of_alternating_cells() {
        let mut smallest = Vec::new();
        for root in RightTriangle::of_cell([0, 0], 4) {
            all_below(root, &mut |triangle| smallest.extend((triangle.layer() == 0).then_some(triangle)));
        }
        let cells = (0..16).map(|k| [k % 4, k / 4]);
        let mut expected: Vec<_> = cells.flat_map(|cell| RightTriangle::of_cell(cell, 1)).collect();
        smallest.sort_unstable();
        expected.sort_unstable();
        assert_eq!(smallest, expected);
    }
}
