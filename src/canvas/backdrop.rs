//! What lies below the features: the terrain's own paint, and the sky.

use crate::resolve::{Compositor, GroundPaint, Paint};
use crate::scene::Scene;
use crate::space::Plan;
use crate::terrain::{Mesh, SKY};

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
    /// The backdrop of a scene over the terrain that a view shows.
    pub fn of(scene: &'a Scene, mesh: &'a Mesh) -> Self {
        let compositor = Compositor::new(scene.compositing);
        Self {
            compositor,
            sky: compositor.paint(scene.image.background),
            ground: GroundPaint::new(&scene.ground, mesh, compositor),
        }
    }

    /// Nothing was asked for yet.
    pub fn no_ground(&self) -> LastGround {
        LastGround { triangle: SKY, paint: self.sky }
    }

    /// Whether all points of a triangle have one paint.
    #[inline(always)]
    pub fn is_constant_on_triangles(&self) -> bool {
        self.ground.is_constant_on_triangles()
    }

    /// The paint of a triangle at a plan point, which is asked for only where the paint depends on it; the sky's for [`SKY`].
    #[inline(always)]
    pub fn paint_at(&self, last: &mut LastGround, triangle: u32, plan: impl FnOnce() -> Plan) -> Paint {
        if triangle == SKY {
            return self.sky;
        }
        if !self.ground.is_constant_on_triangles() {
            return self.ground.at(triangle, plan());
        }
        if triangle != last.triangle {
            *last = LastGround { triangle, paint: self.ground.at(triangle, Plan::default()) };
        }
        last.paint
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene_file::SceneFile;
    use crate::stage::Stage;

    fn stage(shade: &str) -> Stage {
        let text = format!(
            "schema = 1\nimage = {{ width = 8, height = 8, background = \"#0000ff\" }}\n\
             terrain = {{ generate = {{ kind = \"cone\", posts = [9, 9], cell_m = 10.0, height_m = 40.0 }}, {shade} }}"
        );
        let (scene, surface) =
            crate::source::load::load(&SceneFile::parse(&text, None, &[]).unwrap(), &|_| {}).unwrap();
        Stage::new(scene, surface).unwrap()
    }

    #[test]
    fn each_triangle_has_its_own_paint_whatever_was_asked_before() {
        let stage = stage("shade = \"hillshade\", color = \"#808080\"");
        let backdrop = Backdrop::of(&stage.scene, &stage.mesh);
        let mut last = backdrop.no_ground();
        let alone = |triangle| backdrop.paint_at(&mut backdrop.no_ground(), triangle, Plan::default);
        for triangle in [3, 3, 90, SKY, 90, 3, SKY, SKY, 17] {
            assert_eq!(backdrop.paint_at(&mut last, triangle, Plan::default), alone(triangle));
        }
        assert_ne!(alone(3), alone(90));
        assert_eq!(alone(SKY), backdrop.sky);
    }
}
