//! What a fill's piece on the mesh may cover of a pixel's centre, when its corners may stray.
//!
//! Input: the piece's corners in space and the mesh's triangle that it lies on. Output: [`ScreenFace`]. Refuses: nothing. A machine moves the corners that pieces
//! share alike, so that a fill moves as one: where all places near a centre lie in its pieces that face one way, one of them covers it, and once; but what is so thin that it may turn over
//! is drawn on the other side, too, and what it turns over twice.

use super::depth::{Depths, Range};
use crate::allowed::polygon::{area_of, cut};
use crate::math;
use crate::space::{Screen, ViewFrame, World};
use glam::DVec2;

/// A piece on the screen.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ScreenFace {
    polygon: Vec<DVec2>,
    stray: f64,
    /// The mesh's triangle.
    triangle: [World; 3],
    doubt: f64,
    /// Between which depths its corners lie.
    corners: Range,
}

/// What of a piece lies near a pixel's centre.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Near {
    /// The share of a square around the centre, as wide as corners may stray, and diagonally.
    pub(super) share: f64,
    /// Whether some of the piece there may turn over.
    pub(super) may_turn: bool,
    /// Whether its corners run with the clock on the screen: of a surface that folds there two sheets face one way, and one the other.
    pub(super) is_clockwise: bool,
}

/// What single precision does to a place on the screen, as a share of its coordinates.
const SHARE: f64 = 1.0 / (1 << 21) as f64;

impl ScreenFace {
    /// What the near and the far plane leave of a piece; `None`: nothing.
    pub(super) fn new(
        depths: &Depths,
        (corners, triangle): (&[World], [World; 3]),
        [near, far]: Range,
        shift: f64,
    ) -> Option<Self> {
        let mut world: Vec<World> = corners.to_vec();
        for (plane, sign) in [(near, 1.0), (far, -1.0)] {
            if plane.is_finite() {
                world = cut(&world, |p| (depths.depth_of(p) - plane) * sign);
            }
        }
        let placed: Option<Vec<_>> = world.iter().map(|p| depths.on_screen(*p)).collect();
        let placed = placed.filter(|all| all.len() > 2)?;
        let polygon: Vec<DVec2> = placed.iter().map(|(at, _)| at.to_vec()).collect();
        let [low, high] =
            placed.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], (_, depth)| {
                [math::min(low, *depth), math::max(high, *depth)]
            });
        let farthest = polygon.iter().map(|p| math::max(p.x.abs(), p.y.abs())).fold(0.0, math::max);
        let doubt = world.iter().map(|p| depths.doubt(*p)).fold(0.0, math::max);
        let corners = [low - doubt, high + doubt];
        Some(Self { polygon, stray: shift + SHARE * farthest, triangle, doubt, corners })
    }

    /// Calls `visit` with the pixels of a picture near whose centres it lies, and with what is near.
    pub(super) fn for_each_centre(&self, size: [usize; 2], visit: &mut dyn FnMut([usize; 2], Near)) {
        let reach = self.stray * std::f64::consts::SQRT_2;
        let thin = self.thin(2.0 * reach);
        let fan = self
            .polygon
            .windows(2)
            .map(|pair| (pair[0] - self.polygon[0]).perp_dot(pair[1] - self.polygon[0]));
        let is_clockwise = fan.sum::<f64>() > 0.0;
        let range = |axis: usize| {
            let of = self.polygon.iter().map(|p| p[axis]);
            let (low, high) = of.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
                (math::min(low, v), math::max(high, v))
            });
            // Casts saturate.
            (low - reach - 0.5).ceil() as usize..((high + reach + 0.5).floor() as usize).min(size[axis])
        };
        let columns = range(0);
        for y in range(1) {
            for x in columns.clone() {
                let centre = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                let mut near: Vec<DVec2> = self.polygon.iter().map(|p| *p - centre).collect();
                for side in [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y] {
                    near = cut(&near, |p| reach - p.dot(side));
                }
                // It is as high as twice the reach at most, and strays by that once.
                let may_turn = thin.iter().any(|ends| distance(centre, *ends) <= 3.0 * reach);
                if !near.is_empty() || may_turn {
                    let share = area_of(&near) / (4.0 * reach * reach);
                    visit([x, y], Near { share, may_turn, is_clockwise });
                }
            }
        }
    }

    /// The longest sides of triangles of three of its corners that are no higher than this: whichever triangles a program makes of it.
    fn thin(&self, height: f64) -> Vec<[DVec2; 2]> {
        let count = self.polygon.len();
        let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| [i, j]));
        let triples = pairs.flat_map(|[i, j]| (j + 1..count).map(move |k| [i, j, k]));
        let triangles = triples.map(|corners| corners.map(|k| self.polygon[k]));
        let longest = |[a, b, c]: [DVec2; 3]| {
            let sides = [[a, b], [b, c], [c, a]];
            let length = |ends: &[DVec2; 2]| (ends[1] - ends[0]).length();
            let [first, rest @ ..] = sides;
            let ends = rest
                .into_iter()
                .fold(first, |best, ends| if length(&ends) > length(&best) { ends } else { best });
            ((b - a).perp_dot(c - a).abs() <= height * length(&ends)).then_some(ends)
        };
        triangles.filter_map(longest).collect()
    }

    /// Between which depths its fragment at a pixel's centre lies: what may turn over has any depth of its corners, others that of the mesh.
    pub(super) fn depth_at(
        &self,
        (depths, frame): (&Depths, &ViewFrame),
        [x, y]: [usize; 2],
        may_turn: bool,
    ) -> Range {
        if may_turn {
            return self.corners;
        }
        let [a, b, c] = self.triangle;
        let normal = (b - a).cross(c - a);
        let mut all = [f64::INFINITY, f64::NEG_INFINITY];
        for [dx, dy] in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]] {
            let place = |at: usize, by: f64| at as f64 + 0.5 + by * self.stray;
            let ray = frame.ray(Screen::new(place(x, dx), place(y, dy)));
            let along = ray.through - ray.from;
            let share = normal.dot(a - ray.from) / normal.dot(along);
            let view_depth = depths.depth_of(ray.from + along * share);
            // Its plane is seen edge-on, or from beyond the eye.
            if !(view_depth.is_finite() && view_depth > 0.0) {
                return [f64::NEG_INFINITY, f64::INFINITY];
            }
            let depth = depths.of(view_depth);
            all = [math::min(all[0], depth), math::max(all[1], depth)];
        }
        [all[0] - self.doubt, all[1] + self.doubt]
    }
}

/// How far a point is from a segment.
fn distance(point: DVec2, [a, b]: [DVec2; 2]) -> f64 {
    let (along, from) = (b - a, point - a);
    let share = math::max(math::min(from.dot(along) / along.length_squared(), 1.0), 0.0);
    if share.is_nan() { from.length() } else { (from - along * share).length() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_a_centre_a_face_has_all_some_or_nothing() {
        let polygon =
            vec![DVec2::new(0.5, 0.5), DVec2::new(4.0, 0.5), DVec2::new(4.0, 3.0), DVec2::new(0.5, 3.0)];
        let face = ScreenFace {
            polygon,
            stray: 0.01,
            triangle: [World::default(); 3],
            doubt: 0.0,
            corners: [0.0; 2],
        };
        let mut shares = std::collections::BTreeMap::new();
        face.for_each_centre([8, 8], &mut |pixel, near| {
            assert!(!near.may_turn);
            shares.insert(pixel, near.share);
        });
        let of = |x, y| shares.get(&[x, y]).copied().unwrap_or(0.0);
        assert!((of(0, 0) - 0.25).abs() < 1e-9 && (of(2, 0) - 0.5).abs() < 1e-9, "{shares:?}");
        assert!((of(1, 1) - 1.0).abs() < 1e-9 && of(4, 1) == 0.0 && of(1, 3) == 0.0, "{shares:?}");
    }

    #[test]
    fn what_is_next_to_a_line_may_turn_over_along_it() {
        let polygon = [[0.5, 0.5], [6.5, 0.5], [3.0, 0.51]].map(DVec2::from).to_vec();
        let face = ScreenFace {
            polygon,
            stray: 0.01,
            triangle: [World::default(); 3],
            doubt: 0.0,
            corners: [0.0; 2],
        };
        let mut turning = Vec::new();
        face.for_each_centre([8, 8], &mut |pixel, near| turning.extend(near.may_turn.then_some(pixel)));
        assert_eq!(turning, [0, 1, 2, 3, 4, 5, 6].map(|x| [x, 0]));
    }
}
