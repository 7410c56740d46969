//! Convex parts of the screen, and whether a pixel's centre is known to lie in them.

use super::patch::hull;
use crate::certainty::Known;
use crate::math;
use crate::space::{Lens, Plan, ViewFrame, World};

/// A convex part of the screen.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Outline {
    /// Its corners, in order; none: the whole screen.
    corners: Vec<Plan>,
    /// What single precision does to its corners, pixels.
    doubt: f64,
}

/// What single precision does to a screen point, as a share of the farthest coordinate.
const SHARE: f64 = 1.0 / (1 << 21) as f64;

/// A screen point that reaches farther leaves the numbers of machines.
const FARTHEST: f64 = 1e9;

/// The screen point of a point before the near plane.
pub(super) fn screen(frame: &ViewFrame, at: World) -> Option<Plan> {
    let is_before = frame.depth(at) >= frame.near();
    frame.screen_from_world(at).filter(|_| is_before).map(|at| Plan::new(at.x, at.y))
}

impl Outline {
    /// Around the picture of what some points span, as far as it lies before the near plane, and what is within `margin` pixels of it in both
    /// directions. `None`: nothing does.
    pub(super) fn of_solid(frame: &ViewFrame, points: &[World], margin: f64) -> Option<Self> {
        let mut before: Vec<World> = Vec::with_capacity(points.len() * 4);
        let depth = |p: &World| frame.depth(*p) - frame.near();
        before.extend(points.iter().filter(|p| depth(p) >= 0.0));
        let has_behind = before.len() < points.len();
        if before.is_empty() {
            return None;
        }
        if has_behind {
            for (k, p) in points.iter().enumerate() {
                for q in &points[..k] {
                    let (at_p, at_q) = (depth(p), depth(q));
                    if (at_p >= 0.0) != (at_q >= 0.0) {
                        before.push(*p + (*q - *p) * (at_p / (at_p - at_q)));
                    }
                }
            }
        }
        let central = matches!(frame.lens(), Lens::Central { .. });
        let mut on_screen = Vec::with_capacity(before.len() * 4);
        for p in before {
            let at = frame.screen_from_world(p).map(|at| Plan::new(at.x, at.y));
            let at = at.filter(|at| math::max(at.x.abs(), at.y.abs()) < FARTHEST);
            let Some(at) = at else { return Some(Self { corners: Vec::new(), doubt: 0.0 }) };
            let around = [-margin, margin].into_iter().flat_map(|x| [-margin, margin].map(|y| (x, y)));
            match margin > 0.0 {
                true => on_screen.extend(around.map(|(x, y)| Plan::new(at.x + x, at.y + y))),
                false => on_screen.push(at),
            }
        }
        let farthest = on_screen.iter().map(|p| math::max(p.x.abs(), p.y.abs())).fold(0.0, math::max);
        // What is cut at the near plane has been divided by what is left of a difference.
        let doubt = farthest * SHARE * if central && has_behind { 4.0 } else { 1.0 };
        Some(Self { corners: hull(on_screen), doubt })
    }

    /// Whether a place is in it, whose corners a machine has within `shift`.
    pub(super) fn holds(&self, at: Plan, shift: f64) -> Known {
        let count = self.corners.len();
        if count == 0 {
            return Known::In;
        }
        // A corner moves by the shift along both axes.
        let doubt = std::f64::consts::SQRT_2 * shift + self.doubt;
        let mut least = f64::INFINITY;
        for k in 0..count {
            let (a, b) = (self.corners[k], self.corners[(k + 1) % count]);
            let length = (b - a).length();
            let side = if length > 0.0 { (b - a).perp_dot(at - a) / length } else { f64::INFINITY };
            least = math::min(side, least);
        }
        if count < 3 {
            let near = super::patch::to_segment(at, [self.corners[0], self.corners[count - 1]]);
            return if near > doubt { Known::Out } else { Known::Open };
        }
        match least {
            _ if least > doubt => Known::In,
            _ if least < -doubt => Known::Out,
            _ => Known::Open,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Viewpoint;

    #[test]
    fn a_place_near_the_border_of_an_outline_is_open() {
        let viewpoint = Viewpoint {
            eye: World::new(0.0, 0.0, 100.0),
            target: World::default(),
            up: glam::DVec3::Y,
            near: 1.0,
            far: f64::INFINITY,
        };
        let frame = ViewFrame::orthographic(&viewpoint, 20.0, (20, 20)).unwrap();
        let corner = |x: f64, y: f64| World::new(x, y, 0.0);
        let square = [corner(-5.0, -5.0), corner(5.0, -5.0), corner(5.0, 5.0), corner(-5.0, 5.0)];
        let outline = Outline::of_solid(&frame, &square, 0.0).unwrap();
        let holds = |x: f64, y: f64| outline.holds(Plan::new(x, y), 0.01);
        assert_eq!(holds(10.0, 10.0), Known::In);
        assert_eq!(holds(14.95, 10.0), Known::In);
        assert_eq!(holds(15.005, 10.0), Known::Open);
        assert_eq!(holds(15.1, 10.0), Known::Out);
        let grown = Outline::of_solid(&frame, &square, 0.75).unwrap();
        assert_eq!(grown.holds(Plan::new(15.6, 15.6), 0.01), Known::In);
        assert_eq!(Outline::of_solid(&frame, &[World::new(0.0, 0.0, 200.0)], 0.0), None);
    }
}
