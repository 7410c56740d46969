//! Depths as depth buffers compare them: 0 at the near plane, 1 at the far one, affine over the picture on each plane.

use crate::allowed::model::{Guess, View};
use crate::math;
use crate::scene::DepthFormat;
use crate::space::{Lens, Plan, ViewFrame, World};
use crate::terrain::Mesh;

/// An interval of depths.
pub(super) type Range = [f64; 2];

/// How a view's depths become those of a buffer.
#[derive(Debug, Clone, Copy)]
pub(super) struct Depths<'a> {
    frame: &'a ViewFrame,
    guess: &'a Guess,
    format: DepthFormat,
    far: f64,
    is_central: bool,
}

/// What single precision does to a view depth, as a share of the coordinates that go into it: some roundings.
const SHARE: f64 = 1.0 / (1 << 21) as f64;

impl<'a> Depths<'a> {
    pub(super) fn new(view: &View<'a>, guess: &'a Guess, mesh: &Mesh) -> Self {
        let frame = view.frame;
        let is_central = matches!(frame.lens(), Lens::Central { .. });
        // A parallel lens has no linear depth up to infinity.
        let beyond = || {
            let farthest = mesh.bounds(mesh.root()).map_or(0.0, |b| {
                let spread: f64 = b.axes.iter().map(|axis| frame.forward().dot(*axis).abs()).sum();
                frame.depth(b.center) + spread
            });
            math::max(2.0 * frame.near(), farthest * (1.0 + 1.0 / 1024.0))
        };
        let far = if is_central || frame.far().is_finite() { frame.far() } else { beyond() };
        Self { frame, guess, format: view.stage.scene.device.depth, far, is_central }
    }

    /// The depth of a view depth.
    pub(super) fn of(&self, view_depth: f64) -> f64 {
        let near = self.frame.near();
        let whole = 1.0 - near / self.far;
        if self.is_central {
            (1.0 - near / view_depth) / whole
        } else {
            (view_depth - near) / self.far / whole
        }
    }

    /// The view depth of a point.
    pub(super) fn depth_of(&self, at: World) -> f64 {
        self.frame.depth(at)
    }

    /// The view depth of a depth.
    pub(super) fn view_depth(&self, depth: f64) -> f64 {
        let near = self.frame.near();
        let whole = 1.0 - near / self.far;
        if self.is_central { near / (1.0 - depth * whole) } else { near + depth * self.far * whole }
    }

    /// How far a machine's depth of a point of a view depth may be off, by rounding.
    pub(super) fn doubt(&self, at: World) -> f64 {
        let view_depth = self.frame.depth(at);
        let size = |p: World| p.to_vec().abs().max_element();
        let metres =
            self.guess.envelope.along(self.frame, view_depth) + SHARE * (size(at) + size(self.frame.eye()));
        let growth =
            if self.is_central { self.frame.near() / (view_depth * view_depth) } else { 1.0 / self.far };
        metres * growth / (1.0 - self.frame.near() / self.far)
    }

    /// The least and the most that the smallest step of the depth buffer may be at depths up to one.
    pub(super) fn step(&self, largest: f64) -> Range {
        let of_single = |largest: f64| {
            let largest = math::min(math::max(largest, 0.0), 1.0) as f32;
            f64::from(largest.next_up()) - f64::from(largest)
        };
        match self.format {
            DepthFormat::Unorm16 => [1.0 / 65_536.0, 1.0 / 65_535.0],
            DepthFormat::Unorm24 => [1.0 / 16_777_216.0, 1.0 / 16_777_215.0],
            // The exponent may be that of a neighbour.
            DepthFormat::F32 => [of_single(largest * 0.999), of_single(largest * 1.001)],
            DepthFormat::F32Reversed => {
                [of_single((1.0 - largest) * 0.999), of_single((1.0 - largest) * 1.001)]
            }
        }
    }

    /// A point of a line or a mesh on the screen, with its depth; `None`: it is not before the near plane.
    pub(super) fn on_screen(&self, at: World) -> Option<(Plan, f64)> {
        let view_depth = self.frame.depth(at);
        let on =
            self.frame.screen_from_world(at).filter(|_| view_depth >= self.frame.near() * (1.0 - 1e-9))?;
        Some((Plan::new(on.x, on.y), self.of(view_depth)))
    }
}
