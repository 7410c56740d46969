//! Segments of lines on the screen, and how deep their fragments lie.

use super::depth::{Depths, Range};
use crate::math;
use crate::space::{Plan, World};

/// A segment on the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ScreenLine {
    /// Its ends.
    pub(super) ends: [Plan; 2],
    /// How far a machine's may lie from there along each axis, pixels.
    pub(super) stray: f64,
    depths: [f64; 2],
    doubt: f64,
}

/// What single precision does to a place on the screen, as a share of its coordinates.
const SHARE: f64 = 1.0 / (1 << 21) as f64;

/// No line is drawn farther beside the picture: machines clip there.
const GUARD: f64 = 65_536.0;

impl ScreenLine {
    /// What the near and the far plane leave of a segment on the mesh.
    pub(super) fn new(depths: &Depths, ends: [World; 2], [near, far]: Range, shift: f64) -> Option<Self> {
        let mut world = ends;
        for (plane, sign) in [(near, 1.0), (far, -1.0)] {
            if !plane.is_finite() {
                continue;
            }
            let inside = world.map(|p| (depths.depth_of(p) - plane) * sign);
            match inside.map(|v| v >= 0.0) {
                [true, true] => {}
                [false, false] => return None,
                [is_in, _] => {
                    let cut = world[0] + (world[1] - world[0]) * (inside[0] / (inside[0] - inside[1]));
                    world[usize::from(is_in)] = cut;
                }
            }
        }
        let [first, last] = world.map(|p| depths.on_screen(p));
        let ((a, from), (b, to)) = (first?, last?);
        let farthest = [a, b].iter().map(|p| math::max(p.x.abs(), p.y.abs())).fold(0.0, math::max);
        let doubt = world.iter().map(|p| depths.doubt(*p)).fold(0.0, math::max);
        (farthest <= GUARD).then_some(Self {
            ends: [a, b],
            stray: shift + SHARE * farthest,
            depths: [from, to],
            doubt,
        })
    }

    /// One of no depth.
    #[cfg(test)]
    pub(super) fn of_ends(ends: [Plan; 2], stray: f64) -> Self {
        Self { ends, stray, depths: [0.0; 2], doubt: 0.0 }
    }

    /// Between which depths its fragment at a pixel's centre lies: that of the centre, projected on it (OpenGL 2.1, 3.4.1) or, as machines have it that set up
    /// a wide line as a parallelogram, of the place as far along its longer axis.
    pub(super) fn depth_at(&self, centre: Plan) -> Range {
        let [a, b] = self.ends;
        let (along, from) = (b - a, centre - a);
        let (length, off) = (along.length(), 2.0 * std::f64::consts::SQRT_2 * self.stray);
        // A machine's segment is as long as a step of its grid, or has no fragment.
        let shortest = math::max(length - off, math::min(length, self.stray));
        let longest = length + off;
        let doubt = from.length() * off + 0.5 * off * longest;
        let product = from.dot(along);
        let ends = [product - doubt, product + doubt];
        let by = |v: f64| [v / (shortest * shortest), v / (longest * longest)];
        let mut shares = [by(ends[0]), by(ends[1])].concat();
        let longer = math::max(along.x.abs(), along.y.abs());
        for (from, along) in [(from.x, along.x), (from.y, along.y)] {
            let [least, most] =
                [math::max(along.abs() - off, math::min(along.abs(), self.stray)), along.abs() + off];
            if along != 0.0 && most >= longer {
                let from = from * along.signum();
                shares.extend([from - off, from + off].iter().flat_map(|from| [from / least, from / most]));
            }
        }
        let low = shares.iter().copied().fold(f64::INFINITY, math::min);
        let high = shares.iter().copied().fold(f64::NEG_INFINITY, math::max);
        let [first, last] = self.depths;
        let at = [low, high].map(|share| first + (last - first) * share);
        [math::min(at[0], at[1]) - self.doubt, math::max(at[0], at[1]) + self.doubt]
    }
}
