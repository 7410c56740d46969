//! Which vertices of a line a view keeps, as far as that is known: a vertex goes that lies in the pixel of the one before it (3.3.1), and single
//! precision leaves open in which pixel one lies whose picture is near a border.
//!
//! Input: the pixels that each vertex may lie in. Output: [`Stretch`]es between vertices that are surely kept, each with all rows of vertices that may
//! be kept there. Refuses: nothing; where there are too many rows of a stretch, that is said.

use crate::space::Plan;

/// A pixel by its column and row.
type Pixel = (i64, i64);

/// What a vertex may lie in: one pixel or more; none: it is not before the eye, and always kept.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Pixels(Vec<Pixel>);

impl Pixels {
    /// Those of a screen point that is known within `doubt`; `None`: it has none.
    pub(super) fn of(at: Option<Plan>, doubt: f64) -> Self {
        let range = |v: f64| (v - doubt).floor() as i64..=(v + doubt).floor() as i64;
        Self(
            at.map_or_else(Vec::new, |at| {
                range(at.x).flat_map(|x| range(at.y).map(move |y| (x, y))).collect()
            }),
        )
    }

    fn count(&self) -> usize {
        self.0.len().max(1)
    }

    fn pick(&self, k: usize) -> Option<Pixel> {
        self.0.get(k).copied()
    }

    /// Whether a vertex is kept that lies in this after one that lies in the other, whatever pixels those are.
    fn surely_differs(&self, before: &Self) -> bool {
        before.0.is_empty() || !self.0.iter().any(|pixel| before.0.contains(pixel))
    }
}

/// The vertices that may be kept from one that surely is to the next one, or to the line's end.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Stretch {
    /// Each row of them, both ends included; a closed line's first vertex comes after its last as one more.
    pub(super) rows: Vec<Vec<u32>>,
    /// There are too many rows: these are all vertices, of which any may be left out.
    pub(super) is_wild: bool,
}

/// More rows than these are not listed.
const MOST_ROWS: usize = 16;

/// The stretches of a line; `is_closed`: its last vertex is followed by its first.
pub(super) fn stretches(vertices: &[Pixels], is_closed: bool) -> Vec<Stretch> {
    let count = vertices.len();
    let mut sure: Vec<usize> = vec![0];
    sure.extend((1..count).filter(|&k| vertices[k].surely_differs(&vertices[k - 1])));
    let ends = sure.iter().skip(1).copied().map(Some).chain([is_closed.then_some(count)]);
    let mut all: Vec<Stretch> =
        sure.iter().zip(ends).map(|(&start, end)| stretch(vertices, start, end)).collect();
    // A line that keeps one vertex vanishes.
    if let [alone] = &mut all[..] {
        alone.rows.retain(|row| row.len() > if is_closed { 2 } else { 1 } || count == 1);
    }
    all
}

fn stretch(vertices: &[Pixels], start: usize, end: Option<usize>) -> Stretch {
    let between = start + 1..end.unwrap_or(vertices.len());
    let asked = start..between.end;
    let count = asked
        .clone()
        .try_fold(1usize, |count, k| Some(count * vertices[k].count()).filter(|count| *count <= MOST_ROWS));
    let whole = |rows: Vec<Vec<u32>>, is_wild: bool| Stretch { rows, is_wild };
    let with_ends = |inner: Vec<u32>| {
        let mut row = vec![start as u32];
        row.extend(inner);
        row.extend(end.map(|end| end as u32));
        row
    };
    let Some(count) = count else { return whole(vec![with_ends(between.map(|k| k as u32).collect())], true) };
    let mut rows: Vec<Vec<u32>> = Vec::new();
    for mut k in 0..count {
        let picked: Vec<Option<Pixel>> = asked
            .clone()
            .map(|at| {
                let pick = vertices[at].pick(k % vertices[at].count());
                k /= vertices[at].count();
                pick
            })
            .collect();
        let is_kept = |at: &usize| {
            let pair = [picked[at - start - 1], picked[at - start]];
            pair[0].is_none() || pair[0] != pair[1]
        };
        let row = with_ends(between.clone().filter(is_kept).map(|at| at as u32).collect());
        if !rows.contains(&row) {
            rows.push(row);
        }
    }
    whole(rows, false)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64, y: f64) -> Pixels {
        Pixels::of(Some(Plan::new(x, y)), 0.01)
    }

    fn rows(vertices: &[Pixels], is_closed: bool) -> Vec<Vec<Vec<u32>>> {
        stretches(vertices, is_closed).into_iter().map(|of| of.rows).collect()
    }

    #[test]
    fn vertices_in_the_pixel_of_the_one_before_go_and_one_on_a_border_may() {
        assert_eq!(
            rows(&[at(0.2, 0.5), at(0.8, 0.5), at(1.5, 0.5)], false),
            [vec![vec![0, 2]], vec![vec![2]]]
        );
        let open = rows(&[at(0.2, 0.5), at(0.999, 0.5), at(1.5, 0.5), at(2.5, 0.5)], false);
        assert_eq!(open, [vec![vec![0, 2, 3], vec![0, 1, 3]], vec![vec![3]]]);
        let behind = Pixels::of(None, 0.01);
        assert_eq!(rows(&[at(0.2, 0.5), behind, at(0.5, 0.5)], false).len(), 3);
    }

    #[test]
    fn a_line_in_one_pixel_vanishes_and_a_dot_does_not() {
        assert_eq!(rows(&[at(0.2, 0.5), at(0.8, 0.5)], false), [Vec::<Vec<u32>>::new()]);
        assert_eq!(rows(&[at(0.2, 0.5)], false), [vec![vec![0]]]);
        assert_eq!(rows(&[at(0.2, 0.5), at(0.8, 0.5), at(0.4, 0.4)], true), [Vec::<Vec<u32>>::new()]);
        assert_eq!(rows(&[at(0.2, 0.5), at(1.8, 0.5)], true), [vec![vec![0, 1]], vec![vec![1, 2]]]);
    }

    #[test]
    fn too_many_rows_are_all_vertices() {
        let many: Vec<Pixels> = (0..6).map(|_| at(1.0, 0.5)).collect();
        let found = stretches(&many, false);
        assert!(found[0].is_wild && found[0].rows == [vec![0, 1, 2, 3, 4, 5]]);
    }
}
