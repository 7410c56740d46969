//! How positions reach the machine: as numbers of its precision, small or large.
//!
//! Single precision has 24 bits. Geocentric metres leave half a metre as the last of them: vertices jitter as the eye moves. Positions relative to something near lose
//! next to nothing; split in a multiple of 65536 and a rest, and so the eye, absolute ones lose a few millimetres, wherever they are.

use super::number::Real;
use crate::scene::Positions;
use crate::space::{ViewFrame, World};
use glam::DVec3;

/// What positions are split by (Cozzi & Ring 2011, "3D Engine Design for Virtual Globes", 5.4).
const SPLIT: f64 = 65_536.0;

/// How scene-local points become the machine's.
#[derive(Debug, Clone)]
pub(super) enum Encoding<T> {
    /// As they are.
    Local,
    /// With the coordinates of local zero.
    Absolute(DVec3),
    /// Absolute; the eye is subtracted part by part.
    RelativeToEye {
        /// The coordinates of local zero.
        origin: DVec3,
        /// The eye, axis by axis.
        eye: [[T; 2]; 3],
    },
}

impl<T: Real> Encoding<T> {
    pub(super) fn new(positions: Positions, frame: &ViewFrame) -> Self {
        let origin = frame.origin();
        match positions {
            Positions::Local => Self::Local,
            Positions::Absolute => Self::Absolute(origin),
            Positions::RelativeToEye => {
                let eye = (frame.eye().to_vec() + origin).to_array().map(split);
                Self::RelativeToEye { origin, eye }
            }
        }
    }

    /// Where the eye is among these positions: what a matrix for them is composed with.
    pub(super) fn eye(&self, frame: &ViewFrame) -> DVec3 {
        match self {
            Self::Local => frame.eye().to_vec(),
            Self::Absolute(origin) => frame.eye().to_vec() + *origin,
            Self::RelativeToEye { .. } => DVec3::ZERO,
        }
    }

    /// A point as the machine multiplies it by the matrix.
    #[inline]
    pub(super) fn of(&self, p: World) -> [T; 3] {
        match self {
            Self::Local => [p.x, p.y, p.z].map(T::of),
            Self::Absolute(origin) => (p.to_vec() + *origin).to_array().map(T::of),
            Self::RelativeToEye { origin, eye } => {
                let point = (p.to_vec() + *origin).to_array().map(split::<T>);
                [0, 1, 2].map(|k| (point[k][0] - eye[k][0]) + (point[k][1] - eye[k][1]))
            }
        }
    }
}

/// A coordinate as a multiple of 65536 and what is left.
fn split<T: Real>(v: f64) -> [T; 2] {
    let high = (v / SPLIT).trunc() * SPLIT;
    [T::of(high), T::of(v - high)]
}

#[cfg(test)]
mod tests {
    use super::super::Pipeline;
    use crate::scene::{Device, Positions, Precision};
    use crate::space::{Screen, ViewFrame, Viewpoint, World};
    use crate::terrain::Mesh;
    use glam::{DVec2, DVec3};

    fn mesh() -> Mesh {
        let first = crate::space::Plan::new(-50.0, -50.0);
        let posts =
            crate::scene::Posts::new((2, 2), first, (DVec2::X * 100.0, DVec2::Y * 100.0), vec![0.0; 4]);
        Mesh::new(crate::scene::Surface::Grid(posts.unwrap()), Default::default()).unwrap()
    }

    /// How far from its place, at most, a machine sees a point while the eye moves by centimetres, pixels.
    fn farthest(position: Positions, origin: DVec3) -> f64 {
        let (mesh, device) = (mesh(), Device { precision: Precision::F32, position, ..Device::default() });
        let ends = [World::new(3.3, -7.1, 1.7), World::new(-11.3, 20.9, 0.3)];
        let mut most = 0.0;
        for step in 0..50 {
            let eye = World::new(40.0 + 0.01 * f64::from(step), -70.0, 55.0);
            let view =
                Viewpoint { eye, target: World::default(), up: DVec3::Z, near: 1.0, far: f64::INFINITY };
            let frame = ViewFrame::perspective(&view, 45.0, (400, 300)).unwrap().with_origin(origin);
            let line = Pipeline::<f32>::new(&frame, &mesh, &device).line(ends).unwrap();
            for (seen, at) in line.ends.iter().zip(ends) {
                let on = frame.screen_from_world(at).unwrap();
                let off = Screen::new(f64::from(seen[0]) - on.x, f64::from(seen[1]) - on.y);
                most = crate::math::max(most, crate::math::max(off.x.abs(), off.y.abs()));
            }
        }
        most
    }

    #[test]
    fn absolute_single_precision_jitters_on_a_globe_and_what_is_relative_to_the_eye_does_not() {
        // Hard case 17: 6.4e6 m from zero, a last bit of half a metre, a pixel of 0.3 m.
        let far = DVec3::new(4_510_731.3, 4_510_731.7, -1_200_000.9);
        let [local, absolute, relative] =
            [Positions::Local, Positions::Absolute, Positions::RelativeToEye].map(|form| farthest(form, far));
        assert!(local < 1e-3 && relative < 0.02 && absolute > 0.3, "{local} {relative} {absolute}");
        // At zero they are the same but for roundings.
        assert!(farthest(Positions::Absolute, DVec3::ZERO) < 1e-3);
    }
}
