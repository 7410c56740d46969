//! What of a box a view may see, and how large a length in it may be there.
//!
//! Input: a view, boxes. Output: [`Sight`]. Refuses: nothing. In doubt it sees more, and larger.

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
}

impl Sight {
    /// What a view sees.
    pub fn of(view: &ViewFrame) -> Self {
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
        Self { eye: view.eye(), lens: view.lens(), planes }
    }

    /// Whether some of a box may be seen.
    pub fn may_show(&self, bounds: &Bounds) -> bool {
        let center = bounds.center - self.eye;
        self.planes.iter().all(|(normal, offset)| {
            let reach: f64 = bounds.axes.iter().map(|axis| normal.dot(*axis).abs()).sum();
            let size = normal.abs().dot(center.abs() + self.eye.to_vec().abs()) + offset.abs() + reach;
            normal.dot(center) + offset + reach >= -SLACK * size
        })
    }

    /// A pixel's size where a box comes nearest to the eye, metres (see [`ViewFrame::pixel_m`]); it is not smaller anywhere in the box.
    pub fn pixel_m(&self, bounds: &Bounds) -> f64 {
        match self.lens {
            Lens::Parallel { pixel } => pixel,
            Lens::Central { pixel } => {
                let center = bounds.center - self.eye;
                let half = bounds.axes.iter().fold(DVec3::ZERO, |sum, axis| sum + axis.abs());
                let beside = (center.abs() - half).to_array().map(|off| math::max(off, 0.0));
                pixel * DVec3::from(beside).length() * (1.0 - SLACK)
            }
        }
    }
}
