//! What of a globe lies beyond the horizon.
//!
//! Input: a view, a ball that lies inside of the globe's surface, whatever its mesh is. Output: [`Horizon`]. Refuses: nothing; in doubt it hides less.
//!
//! A line of sight that enters the ball has crossed the surface before: what of the mesh is neither beyond the horizon nor beside the picture is no farther from the
//! full surface than the view allows where that line is, and the ball lies deeper than that.

use super::hull::Hull;
use crate::space::{Lens, ViewFrame, World};
use glam::DVec3;

/// Share of distances by which roundings may be off.
const SLACK: f64 = 1e-9;

/// The shadow of a ball, as seen from an eye.
#[derive(Debug, Clone, Copy)]
pub(super) struct Horizon {
    eye: World,
    lens: Lens,
    /// From the eye to the ball's middle.
    middle: DVec3,
    forward: DVec3,
    radius: f64,
}

impl Horizon {
    /// That of a globe whose surface is so far from its middle at least, with a mesh of which no triangle in view is farther from it than so many pixels; `None`: nothing is
    /// hidden.
    pub fn of(view: &ViewFrame, (middle, least): (World, f64), error_px: f64) -> Option<Self> {
        let to_middle = middle - view.eye();
        let distance = to_middle.length();
        let radius = match view.lens() {
            Lens::Parallel { pixel } => least - error_px * pixel,
            Lens::Central { pixel } => {
                // Where lines of sight touch the ball, they are so long; a smaller ball is touched farther away.
                let touched = |radius: f64| {
                    let square = distance * distance - radius * radius;
                    if square > 0.0 { square.sqrt() } else { 0.0 }
                };
                let within = |length: f64| least - error_px * pixel * length;
                let first = within(distance);
                if first > 0.0 && distance > least { within(touched(first)) } else { first }
            }
        };
        let radius = radius * (1.0 - SLACK);
        let is_outside = matches!(view.lens(), Lens::Parallel { .. }) || distance > least;
        (radius > 0.0 && is_outside).then(|| Self {
            eye: view.eye(),
            lens: view.lens(),
            middle: to_middle,
            forward: view.forward(),
            radius,
        })
    }

    /// Whether all of a hull is hidden: the shadow is convex.
    pub fn hides(&self, hull: &Hull) -> bool {
        let slack = SLACK * (self.middle.length() + self.eye.to_vec().length());
        hull.corners.iter().all(|corner| self.depth(*corner - self.eye) >= hull.reach + slack)
    }

    /// How deep a point, given from the eye, lies in the shadow; negative outside.
    fn depth(&self, point: DVec3) -> f64 {
        match self.lens {
            Lens::Parallel { .. } => {
                let off = point - self.middle;
                let behind = off.dot(self.forward);
                crate::math::min(behind, self.radius - (off - self.forward * behind).length())
            }
            Lens::Central { .. } => {
                let distance = self.middle.length();
                let axis = self.middle / distance;
                let along = point.dot(axis);
                let across = (point - axis * along).length();
                let touched = (distance * distance - self.radius * self.radius).sqrt();
                let behind = along - touched * touched / distance;
                let inside = (along * self.radius - across * touched) / distance;
                crate::math::min(behind, inside)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Viewpoint;

    fn views() -> [ViewFrame; 2] {
        let (eye, target) = (World::new(2.0, -3.0, 1.0), World::default());
        let view = Viewpoint { eye, target, up: DVec3::Z, near: 0.01, far: f64::INFINITY };
        [
            ViewFrame::perspective(&view, 60.0, (300, 300)).unwrap(),
            ViewFrame::orthographic(&view, 3.0, (300, 300)).unwrap(),
        ]
    }

    #[test]
    fn what_is_hidden_lies_behind_a_ball_below_the_surface() {
        for view in views() {
            let horizon = Horizon::of(&view, (World::default(), 1.0), 1.0).unwrap();
            assert!(horizon.radius < 1.0 && horizon.radius > 0.95);
            let at = |k: i32| f64::from(k) / 4.0;
            let mut hidden = 0;
            for k in 0..17 * 17 * 9 {
                let corner = World::new(at(k % 17 - 8), at(k / 17 % 17 - 8), at(k / 289 - 4));
                // Where the line of sight comes nearest to the middle.
                let from = match view.lens() {
                    Lens::Central { .. } => view.eye().to_vec(),
                    Lens::Parallel { .. } => corner.to_vec() - view.forward() * 20.0,
                };
                let along = corner.to_vec() - from;
                let share = (-from.dot(along) / along.length_squared()).clamp(0.0, 1.0);
                let passes = (from + along * share).length();
                if horizon.hides(&Hull { corners: [corner; 3], reach: 0.1 }) {
                    hidden += 1;
                    assert!(passes < horizon.radius, "{corner:?}");
                } else {
                    assert!(passes > 0.75 || share > 0.75, "{corner:?}");
                }
            }
            assert!(hidden > 100, "{hidden}");
        }
    }

    #[test]
    fn nothing_is_hidden_from_an_eye_below_the_surface_or_where_the_mesh_may_be_anywhere() {
        let [view, _] = views();
        assert!(Horizon::of(&view, (World::default(), 5.0), 1.0).is_none());
        assert!(Horizon::of(&view, (World::default(), 1.0), 200.0).is_none());
    }
}
