//! What lies below the features: the terrain's own paint, and the sky.

use crate::resolve::{Compositor, GroundPaint, Paint};
use crate::space::Plan;
use crate::stage::Stage;
use crate::terrain::SKY;

/// How a scene composes colours, and what features are composed over.
#[derive(Debug)]
pub struct Backdrop<'a> {
    /// Composes colours.
    pub compositor: Compositor,
    /// The sky's paint.
    pub sky: Paint,
    ground: GroundPaint<'a>,
}

/// The triangle that was asked for last, and its paint: neighbours often see the same.
#[derive(Debug, Clone, Copy)]
pub struct LastGround {
    triangle: u32,
    paint: Paint,
}

impl<'a> Backdrop<'a> {
    /// The backdrop of a stage.
    pub fn of(stage: &'a Stage) -> Self {
        let compositor = Compositor::new(stage.scene.compositing);
        Self {
            compositor,
            sky: compositor.paint(stage.scene.image.background),
            ground: GroundPaint::new(&stage.scene.ground, &stage.mesh, compositor),
        }
    }

    /// Nothing was asked for yet.
    pub fn no_ground(&self) -> LastGround {
        LastGround { triangle: SKY, paint: self.sky }
    }

    /// The paint of a triangle at a plan point, which is asked for only where the paint depends on it; the sky's for [`SKY`].
    #[inline(always)]
    pub fn paint_at(&self, last: &mut LastGround, triangle: u32, plan: impl FnOnce() -> Plan) -> Paint {
        if triangle == SKY {
            return self.sky;
        }
        if triangle != last.triangle || !self.ground.is_constant_on_triangles() {
            let plan = if self.ground.is_constant_on_triangles() { Plan::default() } else { plan() };
            *last = LastGround { triangle, paint: self.ground.at(triangle, plan) };
        }
        last.paint
    }
}
