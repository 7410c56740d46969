//! The camera from which points fill a picture: from the south, narrow.

use drapery::math::{max, min, tan};
use drapery::space::{PlanBox, World};
use glam::DVec3;

/// The horizontal angle of view: narrow, so that what is far is not much smaller than what is near.
const FOV_X_DEG: f64 = 24.0;
/// Pixels a row.
pub(in crate::cli::new) const WIDTH: usize = 1200;
/// The fewest and the most rows.
const HEIGHTS: [usize; 2] = [600, 1000];
/// What is left free at each side, as a share of the picture.
const MARGIN: f64 = 0.015;
/// Width over height of a picture that the terrain's foreshortened plan should have.
const ASPECT: f64 = 1.5;
/// Sines of the least and the greatest pitch: 30 and 60 degrees.
const SINES: [f64; 2] = [0.5, 0.866];

/// The tangent of half the horizontal angle of view.
fn across() -> f64 {
    tan(FOV_X_DEG.to_radians() / 2.0)
}

/// The tangent of half the vertical one.
pub(super) fn upright(height: usize) -> f64 {
    across() * height as f64 / WIDTH as f64
}

/// A camera, local.
pub(super) struct View {
    /// Rows of the picture.
    pub(super) height: usize,
    pub(super) eye: DVec3,
    pub(super) target: DVec3,
    /// How far from the eye the nearest point is.
    pub(super) nearest: f64,
    /// The width of a pixel at the target.
    pub(super) pixel: f64,
}

/// The camera that sees all points.
pub(super) fn camera(points: &[World], plan: &PlanBox) -> View {
    let size = plan.max - plan.min;
    // Foreshortened by the sine of the pitch, the plan is as wide to its height as the picture.
    let sine = min(max(size.x / (ASPECT * max(size.y, 1e-9)), SINES[0]), SINES[1]);
    let cosine = (1.0 - sine * sine).sqrt();
    let fit = Fit::new(points, DVec3::new(0.0, cosine, -sine));
    let [mut low, mut high] = HEIGHTS;
    // With more rows there is room above and below, with fewer at the sides.
    while high - low > 20 {
        let middle = (low + high) / 40 * 20;
        if fit.is_wide(middle) { high = middle } else { low = middle }
    }
    let height = if fit.is_wide(low) { low } else { high };
    let (eye, [nearest, depth]) = fit.eye(height);
    let target = eye + fit.forward * depth;
    View { height, eye, target, nearest, pixel: 2.0 * across() * depth / WIDTH as f64 }
}

/// Points along the axes of a camera: to the right, up, forward.
struct Fit {
    forward: DVec3,
    up: DVec3,
    along: Vec<DVec3>,
}

impl Fit {
    fn new(points: &[World], forward: DVec3) -> Self {
        let up = DVec3::X.cross(forward);
        let along = points.iter().map(|p| p.to_vec()).map(|p| DVec3::new(p.x, p.dot(up), p.dot(forward)));
        Self { forward, up, along: along.collect() }
    }

    /// How far one may go forward with the points between two sides of the picture, and where the eye then is along that axis.
    fn side(&self, tangent: f64, of: impl Fn(&DVec3) -> f64) -> (f64, f64) {
        let (mut right, mut left) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        for p in &self.along {
            right = max(right, of(p) - tangent * p.z);
            left = max(left, -of(p) - tangent * p.z);
        }
        (-(right + left) / (2.0 * tangent), (right - left) / 2.0)
    }

    fn sides(&self, height: usize) -> [(f64, f64); 2] {
        let within = 1.0 - 2.0 * MARGIN;
        [self.side(across() * within, |p| p.x), self.side(upright(height) * within, |p| p.y)]
    }

    /// Whether the points reach the sides of a picture before its top and bottom.
    fn is_wide(&self, height: usize) -> bool {
        let [across, upright] = self.sides(height);
        across.0 < upright.0
    }

    /// The nearest eye that sees all points, and how far the first of them and their middle are from it.
    fn eye(&self, height: usize) -> (DVec3, [f64; 2]) {
        let [across, upright] = self.sides(height);
        let depths = self.along.iter().map(|p| p.z);
        let (nearest, farthest) =
            depths.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| (min(low, z), max(high, z)));
        // Points in one place: any distance does.
        let size = max(farthest - nearest, 1e-6);
        let forward = min(min(across.0, upright.0), nearest - size);
        let eye = DVec3::X * across.1 + self.up * upright.1 + self.forward * forward;
        (eye, [nearest - forward, (nearest + farthest) / 2.0 - forward])
    }
}
