//! The terrain's own colour.

use super::Color;
use crate::buffer::Buffer;
use crate::math;
use crate::space::PlanBox;
use glam::DVec3;

/// The terrain's own colour: constant on a triangle or on a triangle's part of a texel, so that the right picture stays computable.
#[derive(Debug, Clone)]
pub struct Ground {
    /// The colours in full light.
    pub colors: GroundColors,
    /// Hillshade: each triangle's colours times Lambert's cosine for this light; `None`: they are as they are.
    pub light: Option<Light>,
}

/// The terrain's colours in full light.
#[derive(Debug, Clone)]
pub enum GroundColors {
    /// One colour.
    Constant(Color),
    /// The nearest texel of an image.
    Imagery(Imagery),
}

/// An image over the plan.
#[derive(Debug, Clone)]
pub struct Imagery {
    /// The texels, from the north-west.
    pub texels: Buffer<Color>,
    /// The rectangle they cover, scene-local.
    pub extent: PlanBox,
}

/// The light of a hillshade, from infinitely far away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Light {
    /// Where it comes from: degrees from north over east.
    pub azimuth_deg: f64,
    /// How high it stands above the horizon, degrees.
    pub elevation_deg: f64,
}

impl Default for Light {
    /// From the north-west at 45 degrees, as maps have it.
    fn default() -> Self {
        Self { azimuth_deg: 315.0, elevation_deg: 45.0 }
    }
}

impl Light {
    /// The unit vector towards the light: east, north, up.
    pub fn direction(&self) -> DVec3 {
        if *self == Self::default() {
            return DVec3::new(-0.5, 0.5, std::f64::consts::FRAC_1_SQRT_2);
        }
        let (azimuth, elevation) = (self.azimuth_deg.to_radians(), self.elevation_deg.to_radians());
        let level = math::cos(elevation);
        DVec3::new(level * math::sin(azimuth), level * math::cos(azimuth), math::sin(elevation))
    }
}

impl Ground {
    /// One colour everywhere, whatever the slope.
    pub fn flat(color: Color) -> Self {
        Self { colors: GroundColors::Constant(color), light: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn azimuths_are_counted_from_north_over_east_and_elevations_from_the_horizon() {
        for (azimuth_deg, elevation_deg, direction) in [
            (0.0, 30.0, [0.0, 0.75f64.sqrt(), 0.5]),
            (90.0, 30.0, [0.75f64.sqrt(), 0.0, 0.5]),
            (200.0, 90.0, [0.0, 0.0, 1.0]),
            (315.0, 45.0, [-0.5, 0.5, 0.5f64.sqrt()]),
            (-45.0, 45.0, [-0.5, 0.5, 0.5f64.sqrt()]),
        ] {
            let light = Light { azimuth_deg, elevation_deg };
            assert!((light.direction() - DVec3::from_array(direction)).length() < 1e-12, "{light:?}");
        }
    }
}
