//! A camera for a first picture: from the south, the terrain (or what the layers show of it) as large as the picture.
//!
//! What is worth seeing (`subject`), the points of it that the picture is to hold (`points`, without nonsense: `heights`), how high they are
//! drawn (`exaggeration`), and from where (`camera`).

mod camera;
mod exaggeration;
mod heights;
mod points;
mod subject;

pub(super) use camera::WIDTH;

use super::rounding::{step, two_digits};
use camera::{View, camera, upright};
use drapery::math::atan;
use drapery::scene::{Scene, Surface};
use drapery::space::{PlanBox, World};
use exaggeration::{exaggeration, steepness};
use glam::DVec3;
use heights::trim;
use points::{add_summits, samples};
use subject::subject;

/// A picture and its camera.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Framing {
    /// Rows of the picture.
    pub(super) height: usize,
    /// The vertical angle of view.
    pub(super) fov_y_deg: f64,
    /// Nothing nearer than this is seen, where the terrain is so small that the default would hide it.
    pub(super) near_m: Option<f64>,
    /// Absolute plan coordinates and height of the eye.
    pub(super) eye: DVec3,
    /// What it looks at.
    pub(super) target: DVec3,
    /// How many times as high as they are heights are drawn.
    pub(super) exaggeration: f64,
    /// The relief as a multiple of the longer side of the plan.
    steepness: f64,
    /// Metres of the plan that a pixel's width shows in the middle of the picture.
    pub(super) pixel: f64,
    /// The part of the plan that is framed, local.
    pub(super) plan: PlanBox,
}

impl Framing {
    /// The framing of a scene's layers and terrain; `is_to_scale` where the plan is known to be in metres, as the heights are.
    pub(super) fn of(scene: &Scene, surface: &Surface, is_to_scale: bool) -> Self {
        let all = samples(surface, None);
        let whole = PlanBox::around(all.iter().map(|p| p.plan()));
        let seen = subject(&whole, scene.layers.iter().flat_map(|layer| &layer.features));
        let near = if seen == whole { Vec::new() } else { samples(surface, Some(&seen)) };
        let mut points = if near.len() > 8 { near } else { all };
        if points.is_empty() {
            // There is no height: whoever draws such a terrain will say so.
            points.push(World::default());
        }
        let steepness = steepness(&points);
        let exaggeration = exaggeration(steepness, is_to_scale);
        if let Surface::Grid(posts) = surface {
            let framed = PlanBox::around(points.iter().map(|p| p.plan()));
            add_summits(&mut points, posts, &framed);
        }
        trim(&mut points);
        points.iter_mut().for_each(|p| p.z *= exaggeration);
        let plan = PlanBox::around(points.iter().map(|p| p.plan()));
        let View { height, eye, target, nearest, pixel } = camera(&points, &plan);
        let step = step(pixel);
        let rounded = |at: DVec3| (((at + scene.origin) / step).round() + 0.0) * step;
        let fov_y_deg = (200.0 * atan(upright(height)).to_degrees()).ceil() / 100.0;
        let near_m = (nearest < 3.0).then(|| two_digits(nearest / 3.0));
        Self {
            height,
            fov_y_deg,
            near_m,
            eye: rounded(eye),
            target: rounded(target),
            exaggeration,
            steepness,
            pixel,
            plan,
        }
    }

    /// What to say of heights that are not drawn as they are.
    pub(super) fn scale_note(&self) -> Option<String> {
        let by = self.exaggeration;
        (by != 1.0).then(|| match by > 1.0 {
            true => format!("heights are low beside its extent, and drawn {by} times as high (vertical_scale; 1.0 is as they are)"),
            false => format!(
                "the size of its cells in metres is not known, and its heights are {:.1} times its extent: they are drawn {by} \
                 times as high (vertical_scale; with the right terrain.crs or bounds, 1.0 is as they are)",
                self.steepness
            ),
        })
    }

    /// How many decimals of its places matter.
    pub(super) fn decimals(&self) -> usize {
        let (mut decimals, mut step) = (1, step(self.pixel));
        while step < 0.09 && decimals < 9 {
            (decimals, step) = (decimals + 1, step * 10.0);
        }
        decimals
    }
}
