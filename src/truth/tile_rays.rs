//! The rays of a tile, with bounds of their errors.

use super::form::BallForm;
use crate::interval::{Ball, BallVec};
use crate::space::{Lens, ViewFrame, World};
use glam::DVec3;

/// The rays of a tile of pixels: from `from + x * step` along `along + x * step`, the steps in the one or the other
/// (orthographic or perspective), x and y from the tile's corner.
#[derive(Debug)]
pub(super) struct TileRays {
    pub(super) is_central: bool,
    /// The eye, or the start of the corner's ray.
    pub(super) from: BallVec,
    /// The direction of the corner's ray: view depth 1.
    pub(super) along: BallVec,
    /// What a pixel to the right adds, and one down.
    pub(super) steps: [BallVec; 2],
    /// The tile's side in pixels.
    pub(super) span: f64,
    pub(super) plain: PlainRays,
    pub(super) near: f64,
    pub(super) far: f64,
    /// The tile's corner on the screen.
    pub(super) corner: [f64; 2],
    pub(super) frame: ViewFrame,
}

/// The same rays in plain doubles.
#[derive(Debug)]
pub(super) struct PlainRays {
    pub(super) from: DVec3,
    pub(super) along: DVec3,
    pub(super) steps: [DVec3; 2],
    /// The largest coordinate of where rays start.
    pub(super) size: f64,
    /// The longest direction.
    pub(super) reach: f64,
}

impl PlainRays {
    fn new(from: BallVec, along: BallVec, steps: &[BallVec; 2], span: f64) -> Self {
        let (from, along, steps) = (from.middle(), along.middle(), steps.map(BallVec::middle));
        let widest = span * (steps[0].length() + steps[1].length());
        Self { from, along, steps, size: from.length() + widest, reach: along.length() + widest }
    }
}

impl TileRays {
    pub(super) fn new(frame: &ViewFrame, corner: [f64; 2], span: f64) -> Self {
        let pixel = Ball::exact(frame.lens().pixel());
        let x = (Ball::exact(corner[0]) - Ball::exact(frame.width() as f64 / 2.0)) * pixel;
        let y = (Ball::exact(frame.height() as f64 / 2.0) - Ball::exact(corner[1])) * pixel;
        let (right, up) = (BallVec::exact(frame.right()), BallVec::exact(frame.up()));
        let offset = right.times(x) + up.times(y);
        let eye = BallVec::exact(frame.eye().to_vec());
        let forward = BallVec::exact(frame.forward());
        let is_central = matches!(frame.lens(), Lens::Central { .. });
        let (from, along) = if is_central { (eye, forward + offset) } else { (eye + offset, forward) };
        let steps = [right.times(pixel), up.times(-pixel)];
        let plain = PlainRays::new(from, along, &steps, span);
        let (near, far) = (frame.near(), frame.far());
        Self { is_central, from, along, steps, span, plain, near, far, corner, frame: *frame }
    }

    /// A constant vector's product with the rays' directions.
    pub(super) fn dot_along(&self, v: BallVec) -> BallForm {
        let c = v.dot(self.along);
        match self.is_central {
            true => BallForm { c, x: v.dot(self.steps[0]), y: v.dot(self.steps[1]) },
            false => BallForm::constant(c),
        }
    }

    /// A constant vector's product with the rays' starts, seen from a point.
    pub(super) fn dot_from(&self, v: BallVec, at: BallVec) -> BallForm {
        let c = v.dot(self.from - at);
        match self.is_central {
            true => BallForm::constant(c),
            false => BallForm { c, x: v.dot(self.steps[0]), y: v.dot(self.steps[1]) },
        }
    }

    /// On which side of the edge from `a` to `b` a ray passes.
    pub(super) fn edge(&self, a: World, b: World) -> BallForm {
        // The same edge of two triangles has the same bits: it is taken in one direction.
        if (a.x, a.y, a.z) > (b.x, b.y, b.z) {
            return self.edge(b, a).signed(-1.0);
        }
        // (a - from) x (b - from), but without the square of the distance in its error.
        let edge = BallVec::difference(b.to_vec(), a.to_vec());
        let normal = (BallVec::exact(a.to_vec()) - self.from).cross(edge);
        let mut side = BallForm::constant(normal.dot(self.along));
        let turned = match self.is_central {
            true => normal,
            false => self.along.cross(edge),
        };
        (side.x, side.y) = (turned.dot(self.steps[0]), turned.dot(self.steps[1]));
        side
    }
}
