//! The terrain's own colour.

use super::{Compositor, Paint};
use crate::scene::{Color, Ground, GroundColors};
use crate::space::Plan;
use crate::terrain::Mesh;
use glam::DVec3;

/// The paint of the terrain's surface.
#[derive(Debug)]
pub struct GroundPaint<'a> {
    colors: &'a GroundColors,
    /// The direction to the light, where there is one.
    to_light: Option<DVec3>,
    mesh: &'a Mesh,
    compositor: Compositor,
}

impl<'a> GroundPaint<'a> {
    /// The ground of a terrain.
    pub fn new(ground: &'a Ground, mesh: &'a Mesh, compositor: Compositor) -> Self {
        let to_light = ground.light.map(|light| light.direction());
        Self { colors: &ground.colors, to_light, mesh, compositor }
    }

    /// Whether the paint depends on the triangle alone.
    pub fn is_constant_on_triangles(&self) -> bool {
        !matches!(self.colors, GroundColors::Imagery(_))
    }

    /// The paint at a plan point of a triangle.
    #[inline]
    pub fn at(&self, triangle: u32, plan: Plan) -> Paint {
        let color = match self.colors {
            GroundColors::Constant(color) => *color,
            GroundColors::Imagery(imagery) => {
                let (texels, extent) = (&imagery.texels, &imagery.extent);
                let size = extent.max - extent.min;
                let across = (plan.x - extent.min.x) / size.x * texels.width() as f64;
                let down = (extent.max.y - plan.y) / size.y * texels.height() as f64;
                // Casts saturate: a point on or off the rim takes the outermost texel.
                let (x, y) =
                    ((across as usize).min(texels.width() - 1), (down as usize).min(texels.height() - 1));
                *texels.at(x, y)
            }
        };
        self.lit(triangle, color)
    }

    /// The paint of a triangle that has a colour in full light.
    #[inline]
    pub fn lit(&self, triangle: u32, color: Color) -> Paint {
        let Some(to_light) = self.to_light else { return self.compositor.paint(color) };
        // Lambert's cosine; 0 in the attached shadow.
        let cosine = |normal: DVec3| crate::math::max(normal.dot(to_light), 0.0);
        let light = self.mesh.normal(triangle).map_or(1.0, cosine);
        let [r, g, b, a] = color.0;
        self.compositor.paint(Color([r * light, g * light, b * light, a]))
    }

    /// Whether a triangle's paint is darker than its colour in full light.
    pub fn is_lit(&self) -> bool {
        self.to_light.is_some()
    }
}
