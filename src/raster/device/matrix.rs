//! The matrices between scene-local points and clip space.

use super::number::Real;
use crate::space::{Lens, ViewFrame};
use glam::{DVec3, DVec4};

/// Four rows.
#[derive(Debug, Clone)]
pub(super) struct Matrix<T>([[T; 4]; 4]);

impl<T: Real> Matrix<T> {
    fn of_rows(rows: [DVec4; 4]) -> Self {
        Self(rows.map(|row| row.to_array().map(T::of)))
    }

    fn of_columns(columns: [DVec4; 4]) -> Self {
        Self::of_rows([0, 1, 2, 3].map(|k| DVec4::from_array(columns.map(|c| c[k]))))
    }

    /// Its rows in double precision.
    pub(super) fn rows(&self) -> [[f64; 4]; 4] {
        self.0.map(|row| row.map(T::get))
    }

    /// The product with a column: four products, summed from the left.
    pub(super) fn times(&self, v: [T; 4]) -> [T; 4] {
        self.0.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2] + row[3] * v[3])
    }
}

/// How view depth D becomes clip depth: `z = slope * D + constant` (then divided by w, which is D for a central lens
/// and 1 for a parallel one), and half the picture's extent at depth 1.
#[derive(Debug, Clone, Copy)]
pub(super) struct Projection {
    pub(super) slope: f64,
    pub(super) constant: f64,
    half: [f64; 2],
}

impl Projection {
    /// Depth 0 at the near plane and 1 at the far one, or the other way round.
    pub(super) fn new(frame: &ViewFrame, far: f64, is_reversed: bool) -> Self {
        let near = frame.near();
        // 1 / (1 - near / far) is far / (far - near), for an infinite far plane too.
        let k = 1.0 / (1.0 - near / far);
        let (slope, constant) = match (frame.lens(), is_reversed) {
            (Lens::Central { .. }, false) => (k, -near * k),
            (Lens::Central { .. }, true) => (-near / far * k, near * k),
            (Lens::Parallel { .. }, false) => (k / far, -near / far * k),
            (Lens::Parallel { .. }, true) => (-k / far, k),
        };
        let half = [frame.width(), frame.height()].map(|size| size as f64 / 2.0 * frame.lens().pixel());
        Self { slope, constant, half }
    }

    /// `clip_from_view * view_from_world`, composed in double precision, for points of which the eye is that one.
    pub(super) fn clip_from_world<T: Real>(&self, frame: &ViewFrame, eye: DVec3) -> Matrix<T> {
        let row = |axis: DVec3| axis.extend(-axis.dot(eye));
        let depth = row(frame.forward());
        let w = match frame.lens() {
            Lens::Central { .. } => depth,
            Lens::Parallel { .. } => DVec4::W,
        };
        Matrix::of_rows([
            row(frame.right()) / self.half[0],
            row(frame.up()) / self.half[1],
            depth * self.slope + DVec4::W * self.constant,
            w,
        ])
    }

    /// The inverse of [`Projection::clip_from_world`], in closed form in double precision.
    pub(super) fn world_from_clip<T: Real>(&self, frame: &ViewFrame) -> Matrix<T> {
        let eye = frame.eye().to_vec().extend(1.0);
        let forward = frame.forward().extend(0.0);
        let (z, w) = match frame.lens() {
            // D = w and 1 = (z - slope * w) / constant.
            Lens::Central { .. } => (eye / self.constant, forward - eye * (self.slope / self.constant)),
            // D = (z - constant * w) / slope and 1 = w.
            Lens::Parallel { .. } => (forward / self.slope, eye - forward * (self.constant / self.slope)),
        };
        Matrix::of_columns([
            (frame.right() * self.half[0]).extend(0.0),
            (frame.up() * self.half[1]).extend(0.0),
            z,
            w,
        ])
    }

    /// The view depth of a depth after division.
    pub(super) fn view_depth<T: Real>(&self, z: T, is_parallel: bool) -> T {
        let (slope, constant) = (T::of(self.slope), T::of(self.constant));
        if is_parallel { (z - constant) / slope } else { constant / (z - slope) }
    }
}
