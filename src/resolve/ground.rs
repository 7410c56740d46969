//! The terrain's own colour.

use super::{Compositor, Paint};
use crate::scene::{Color, Ground};
use crate::space::Plan;
use crate::terrain::Mesh;
use glam::DVec3;

/// The paint of the terrain's surface.
#[derive(Debug)]
pub struct GroundPaint<'a> {
    ground: &'a Ground,
    mesh: &'a Mesh,
    compositor: Compositor,
    flat: Paint,
}

impl<'a> GroundPaint<'a> {
    /// The ground of a terrain.
    pub fn new(ground: &'a Ground, mesh: &'a Mesh, compositor: Compositor) -> Self {
        let flat = match ground {
            Ground::Color(color) | Ground::Hillshade(color) => compositor.paint(*color),
            Ground::Imagery(_) => Paint::CLEAR,
        };
        Self { ground, mesh, compositor, flat }
    }

    /// Whether the paint depends on the triangle alone.
    pub fn is_constant_on_triangles(&self) -> bool {
        !matches!(self.ground, Ground::Imagery(_))
    }

    /// The paint at a plan point of a triangle.
    #[inline]
    pub fn at(&self, triangle: u32, plan: Plan) -> Paint {
        match self.ground {
            Ground::Color(_) => self.flat,
            Ground::Hillshade(color) => {
                let light = self.mesh.normal(triangle).map_or(1.0, lambert);
                let [r, g, b, a] = color.0;
                self.compositor.paint(Color([r * light, g * light, b * light, a]))
            }
            Ground::Imagery(imagery) => {
                let (texels, extent) = (&imagery.texels, &imagery.extent);
                let size = extent.max - extent.min;
                let across = (plan.x - extent.min.x) / size.x * texels.width() as f64;
                let down = (extent.max.y - plan.y) / size.y * texels.height() as f64;
                // Casts saturate: a point on or off the rim takes the outermost texel.
                let (x, y) =
                    ((across as usize).min(texels.width() - 1), (down as usize).min(texels.height() - 1));
                self.compositor.paint(*texels.at(x, y))
            }
        }
    }
}

/// Lambert's cosine of a normal's components east, north and up, for light from the north-west at 45 degrees above the horizon; 0 in
/// the attached shadow.
fn lambert(normal: DVec3) -> f64 {
    let to_light = DVec3::new(-0.5, 0.5, std::f64::consts::FRAC_1_SQRT_2);
    crate::math::max(normal.dot(to_light), 0.0)
}
