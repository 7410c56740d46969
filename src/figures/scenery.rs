//! Terrain and what stands on it, as an observer beside the scene's camera sees it.

use super::drawing::{At, Drawing};
use crate::error::Result;
use crate::space::{Screen, ViewFrame, Viewpoint, World};
use crate::terrain::Mesh;
use glam::DVec3;

/// The observer's opening angle, degrees.
const ANGLE: f64 = 30.0;

/// A drawing in perspective.
pub(super) struct Scenery {
    view: ViewFrame,
    drawing: Drawing,
}

impl Scenery {
    /// An empty one: where the observer stands and looks to.
    pub(super) fn new(title: &str, size: (usize, usize), [eye, target]: [[f64; 3]; 2]) -> Result<Self> {
        let [eye, target] = [eye, target].map(|[x, y, z]| World::new(x, y, z));
        let viewpoint = Viewpoint { eye, target, up: DVec3::Z, near: 0.1, far: f64::INFINITY };
        let view = ViewFrame::perspective(&viewpoint, ANGLE, size)?;
        Ok(Self { view, drawing: Drawing::new(title, [size.0 as f64, size.1 as f64]) })
    }

    /// Where points lie; those behind the observer are left out.
    fn all(&self, points: &[World]) -> Vec<At> {
        let at = |point: &World| self.view.screen_from_world(*point).map(|at| [at.x, at.y]);
        points.iter().filter_map(at).collect()
    }

    /// Draws the triangles, far ones first, so that near ones hide them.
    pub(super) fn terrain(&mut self, mesh: &Mesh) {
        let mut triangles: Vec<[World; 3]> =
            (0..mesh.triangle_ids()).filter_map(|id| mesh.triangle(id)).collect();
        let depth = |corners: &[World; 3]| corners.iter().map(|corner| self.view.depth(*corner)).sum::<f64>();
        triangles.sort_by(|a, b| depth(b).total_cmp(&depth(a)));
        for corners in triangles {
            let ring = self.all(&corners);
            self.drawing.ring(&ring, "ground");
        }
    }

    /// Draws a ring.
    pub(super) fn ring(&mut self, ring: &[World], class: &str) {
        let ring = self.all(ring);
        self.drawing.ring(&ring, class);
    }

    /// Draws a line.
    pub(super) fn line(&mut self, points: &[World], class: &str) {
        let points = self.all(points);
        self.drawing.line(&points, class);
    }

    /// Draws a dot and a word beside it.
    pub(super) fn dot(&mut self, at: World, class: &str, word: &str) {
        for [x, y] in self.all(&[at]) {
            self.drawing.dot([x, y], 4.0, class);
            self.drawing.word([x + 8.0, y - 6.0], "start", word);
        }
    }

    /// Draws a camera: its eye, and its picture so far before it, divided into pixels.
    pub(super) fn camera(&mut self, view: &ViewFrame, distance: f64) {
        let [width, height] = [view.width(), view.height()];
        let at = |x: usize, y: usize| on_ray(view, Screen::new(x as f64, y as f64), distance);
        for x in 0..=width {
            self.line(&[at(x, 0), at(x, height)], "soft edge thin");
        }
        for y in 0..=height {
            self.line(&[at(0, y), at(width, y)], "soft edge thin");
        }
        for [x, y] in [[0, 0], [width, 0], [width, height], [0, height]] {
            self.line(&[view.eye(), at(x, y)], "soft edge thin");
        }
        self.dot(view.eye(), "ink dot", "eye");
    }

    /// The document.
    pub(super) fn svg(self) -> String {
        self.drawing.svg()
    }
}

/// The point of a screen point's ray at a view depth.
pub(super) fn on_ray(view: &ViewFrame, at: Screen, depth: f64) -> World {
    let ray = view.ray(at);
    ray.from + (ray.through - ray.from) * (depth / view.reach())
}
