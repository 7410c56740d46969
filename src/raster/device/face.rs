//! A triangle on the screen -> fragments: the pixels whose centres it covers, by the rules of [`super::scan`]; or, anti-aliased, those of which it covers
//! some, by the exact area.
//!
//! Input: a [`Face`] (clipped, in pixels of the screen, snapped as the device snaps), a [`Window`] of pixels. Output: [`Fragment`]s, row by row; what is
//! drawn does not depend on the window. Refuses: nothing; a triangle without area has no fragments.

use super::convex::{area, cut, extent, pixels};
use super::fragment::Fragment;
use super::number::Real;
use super::scan::{self, Primitive, Window};
use crate::raster::Lattice;
use std::ops::Range;

/// A triangle on the screen that is no mesh's.
#[derive(Debug, Clone, Copy)]
pub struct Face<T> {
    primitive: Primitive<T>,
    is_snapped: bool,
}

impl<T: Real> Face<T> {
    pub(super) fn new(corners: [[T; 3]; 3], is_snapped: bool) -> Self {
        Self { primitive: Primitive { id: 0, corners }, is_snapped }
    }

    /// The face with its depth moved, the same all over it.
    #[must_use]
    pub fn moved(self, by: T) -> Self {
        let corners = self.primitive.corners.map(|[x, y, depth]| [x, y, depth + by]);
        Self { primitive: Primitive { corners, ..self.primitive }, ..self }
    }

    /// The pixels of a window among which all fragments are (a few more may be in it), of an anti-aliased face (`is_smooth`) or of another; `None`: there are
    /// none.
    pub fn window(&self, is_smooth: bool, within: &Window) -> Option<Window> {
        if !is_smooth {
            return self
                .primitive
                .window(&centres(within))
                .map(|all| all.shared_with(within))
                .filter(is_some);
        }
        let corners = self.places()?;
        let span = |axis: usize, range: &Range<usize>| {
            let [low, high] = extent(corners.iter().map(|corner| corner[axis]));
            pixels(low, high, range)
        };
        Some(Window { columns: span(0, &within.columns), rows: span(1, &within.rows) }).filter(is_some)
    }

    /// Calls `visit` with the fragments in a window of the picture's pixels; those of an anti-aliased face (`is_smooth`) by area, in doubles on every machine.
    pub fn draw(&self, is_smooth: bool, window: &Window, visit: &mut dyn FnMut(Fragment)) {
        if is_smooth {
            return self.draw_smooth(window, visit);
        }
        let lattice = centres(window);
        let mut emit = |(column, row): (usize, usize), _: i32, depth: T| {
            visit(Fragment { column, row, depth: depth.get(), coverage: 1.0 });
        };
        if self.is_snapped {
            scan::visit::<T, i128>(&self.primitive, (&lattice, window), &mut emit);
        } else {
            scan::visit::<T, T>(&self.primitive, (&lattice, window), &mut emit);
        }
    }

    /// The corners' places, if they have some.
    fn places(&self) -> Option<[[f64; 2]; 3]> {
        let corners = self.primitive.corners.map(|[x, y, _]| [x.get(), y.get()]);
        corners.iter().flatten().all(|v| v.is_finite()).then_some(corners)
    }

    fn draw_smooth(&self, window: &Window, visit: &mut dyn FnMut(Fragment)) {
        let (Some(corners), Some(part)) = (self.places(), self.window(true, window)) else { return };
        let plane = Plane::new(corners, self.primitive.corners.map(|corner| corner[2].get()));
        for row in part.rows {
            let band = between(&corners, 1, row as f64);
            let [low, high] = extent(band.iter().map(|p| p[0]));
            for column in pixels(low, high, &part.columns) {
                let covered = between(&band, 0, column as f64);
                let coverage = crate::math::min(area(&covered).abs(), 1.0);
                if coverage > 0.0 {
                    let depth = plane.depth_at(middle(&covered));
                    visit(Fragment { column, row, depth, coverage });
                }
            }
        }
    }
}

/// The centres of all pixels up to a window's end.
fn centres(window: &Window) -> Lattice {
    Lattice { x: 0.5, y: 0.5, step: 1.0, columns: window.columns.end, rows: window.rows.end }
}

fn is_some(window: &Window) -> bool {
    !window.columns.is_empty() && !window.rows.is_empty()
}

/// What of a convex polygon lies in a pixel's column (axis 0) or row (1).
fn between(polygon: &[[f64; 2]], axis: usize, from: f64) -> Vec<[f64; 2]> {
    cut(&cut(polygon, |p| p[axis] - from), |p| from + 1.0 - p[axis])
}

/// The mean of a polygon's corners: a point of it.
fn middle(polygon: &[[f64; 2]]) -> [f64; 2] {
    let sum = polygon.iter().fold([0.0; 2], |[x, y], p| [x + p[0], y + p[1]]);
    sum.map(|v| v / polygon.len() as f64)
}

/// Depth over the screen.
struct Plane {
    first: [f64; 3],
    slope: [f64; 2],
}

impl Plane {
    fn new([a, b, c]: [[f64; 2]; 3], depths: [f64; 3]) -> Self {
        let from_a = |p: [f64; 2], depth: f64| [p[0] - a[0], p[1] - a[1], depth - depths[0]];
        let ([ux, uy, uz], [vx, vy, vz]) = (from_a(b, depths[1]), from_a(c, depths[2]));
        let area = ux * vy - uy * vx;
        let slope = [(uz * vy - uy * vz) / area, (ux * vz - uz * vx) / area];
        // A triangle next to without area is as deep as its first corner.
        let slope = if slope.iter().all(|v| v.is_finite()) { slope } else { [0.0; 2] };
        Self { first: [a[0], a[1], depths[0]], slope }
    }

    fn depth_at(&self, [x, y]: [f64; 2]) -> f64 {
        self.first[2] + self.slope[0] * (x - self.first[0]) + self.slope[1] * (y - self.first[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(face: &Face<f64>, is_smooth: bool, window: &Window) -> Vec<Fragment> {
        let mut all = Vec::new();
        face.draw(is_smooth, window, &mut |fragment| all.push(fragment));
        all
    }

    fn whole() -> Window {
        Window { columns: 0..8, rows: 0..8 }
    }

    #[test]
    fn a_face_covers_centres_or_shares_of_pixels_that_add_up_to_its_area() {
        let corners = [[0.75, 0.5, 0.1], [6.5, 1.25, 0.6], [2.25, 7.0, 0.9]];
        let face = Face::new(corners, false);
        let twice = (6.5 - 0.75) * (7.0 - 0.5) - (1.25 - 0.5) * (2.25 - 0.75);
        let shares: f64 = drawn(&face, true, &whole()).iter().map(|fragment| fragment.coverage).sum();
        assert!((shares - twice / 2.0).abs() < 1e-12, "{shares}");
        let centres = drawn(&face, false, &whole());
        assert!((centres.len() as f64 - twice / 2.0).abs() < 3.0);
        for fragment in &centres {
            let plane = Plane::new([[0.75, 0.5], [6.5, 1.25], [2.25, 7.0]], [0.1, 0.6, 0.9]);
            let expected = plane.depth_at([fragment.column as f64 + 0.5, fragment.row as f64 + 0.5]);
            assert!((fragment.depth - expected).abs() < 1e-12);
        }
    }

    #[test]
    fn windows_take_nothing_away_and_two_faces_share_no_pixel() {
        let (a, b) = ([1.0, 1.5, 0.5], [6.5, 5.5, 0.5]);
        let faces = [Face::new([a, b, [6.5, 0.5, 0.5]], false), Face::new([a, [0.5, 6.5, 0.5], b], false)];
        for is_smooth in [false, true] {
            let mut shares = [0.0; 64];
            for face in &faces {
                let all = drawn(face, is_smooth, &whole());
                let halves = [0..3, 3..8].map(|columns| Window { columns, rows: 0..8 });
                let split: usize = halves.iter().map(|window| drawn(face, is_smooth, window).len()).sum();
                assert_eq!(split, all.len());
                let window = face.window(is_smooth, &whole()).unwrap();
                assert_eq!(drawn(face, is_smooth, &window), all);
                all.iter().for_each(|of| shares[of.row * 8 + of.column] += of.coverage);
            }
            assert!(shares.iter().all(|share| *share <= 1.0 + 1e-12), "{shares:?}");
        }
        let none = Face::new([a, a, b], false);
        assert!(drawn(&none, true, &whole()).iter().all(|fragment| fragment.coverage < 1e-12));
        assert_eq!(drawn(&none, false, &whole()), []);
    }
}
