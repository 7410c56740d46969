//! What of a body a view may see, and how large a length in it may be there.
//!
//! Input: a view, bodies around triangles. Output: [`Sight`]. Refuses: nothing. In doubt it sees more, and larger.

use super::horizon::Horizon;
use super::hull::{Around, Hull};
use crate::math;
use crate::space::{Lens, ViewFrame, World};
use crate::terrain::Bounds;
use glam::DVec3;

/// Share of the coordinates by which roundings may be off.
const SLACK: f64 = 1e-9;

/// The frustum of a view and the size of its pixels.
#[derive(Debug)]
pub(super) struct Sight {
    eye: World,
    lens: Lens,
    /// Planes through points relative to the eye: what is seen has `normal . point + offset >= 0`.
    planes: Vec<(DVec3, f64)>,
    horizon: Option<Horizon>,
}

impl Sight {
    /// What a view sees, this side of a horizon.
    pub fn of(view: &ViewFrame, horizon: Option<Horizon>) -> Self {
        let pixel = view.lens().pixel();
        let [across, down] = [view.width(), view.height()].map(|count| 0.5 * count as f64 * pixel);
        let forward = view.forward();
        let side = |normal: DVec3, reach: f64| match view.lens() {
            Lens::Central { .. } => (forward * reach + normal, 0.0),
            Lens::Parallel { .. } => (normal, reach),
        };
        let mut planes = vec![
            side(view.right(), across),
            side(-view.right(), across),
            side(view.up(), down),
            side(-view.up(), down),
            (forward, -view.near()),
        ];
        if view.far().is_finite() {
            planes.push((-forward, view.far()));
        }
        Self { eye: view.eye(), lens: view.lens(), planes, horizon }
    }

    /// Whether some of a body may be seen.
    pub fn may_show(&self, around: &Around) -> bool {
        match around {
            Around::Box(bounds) => self.may_show_box(bounds),
            Around::Hull(hull) => {
                self.may_show_hull(hull) && !self.horizon.is_some_and(|horizon| horizon.hides(hull))
            }
        }
    }

    fn may_show_box(&self, bounds: &Bounds) -> bool {
        let center = bounds.center - self.eye;
        self.planes.iter().all(|(normal, offset)| {
            let reach: f64 = bounds.axes.iter().map(|axis| normal.dot(*axis).abs()).sum();
            let size = normal.abs().dot(center.abs() + self.eye.to_vec().abs()) + offset.abs() + reach;
            normal.dot(center) + offset + reach >= -SLACK * size
        })
    }

    fn may_show_hull(&self, hull: &Hull) -> bool {
        self.planes.iter().all(|(normal, offset)| {
            let reach = hull.reach * normal.length();
            hull.corners.iter().any(|corner| {
                let at = *corner - self.eye;
                let size = normal.abs().dot(at.abs() + self.eye.to_vec().abs()) + offset.abs() + reach;
                normal.dot(at) + offset + reach >= -SLACK * size
            })
        })
    }

    /// A pixel's size where a body comes nearest to the eye, metres (see [`ViewFrame::pixel_m`]); it is not smaller anywhere in the body.
    pub fn pixel_m(&self, around: &Around) -> f64 {
        match (self.lens, around) {
            (Lens::Parallel { pixel }, _) => pixel,
            (Lens::Central { pixel }, Around::Box(bounds)) => {
                let center = bounds.center - self.eye;
                let half = bounds.axes.iter().fold(DVec3::ZERO, |sum, axis| sum + axis.abs());
                let beside = (center.abs() - half).to_array().map(|off| math::max(off, 0.0));
                pixel * DVec3::from(beside).length() * (1.0 - SLACK)
            }
            (Lens::Central { pixel }, Around::Hull(hull)) => {
                pixel * hull.distance_from(self.eye) * (1.0 - SLACK)
            }
        }
    }
}
