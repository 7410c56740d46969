//! What pixels' centres see of a mesh that is moved back by a polygon offset, and how deep.
//!
//! Input: what centres see of the mesh as it is. Output: for each the triangles that may be seen, and between which depths each lies then: exact mathematics moves what is
//! seen, a machine moves all before it compares. Refuses: nothing.

use super::depth::{Depths, Range};
use crate::allowed::model::{Guess, View};
use crate::allowed::surface::Surfaces;
use crate::buffer::Buffer;
use crate::math;
use crate::parallel;
use crate::space::{Plan, World};
use crate::technique::geometry_overlay::Settings;
use crate::terrain::{Mesh, SKY};

/// A triangle that a pixel's centre may see.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Moved {
    pub(super) triangle: u32,
    /// Between which depths it lies there once it is moved; infinite in the sky.
    pub(super) depth: Range,
    /// Between which it lies as it is.
    pub(super) own: Range,
}

/// The sky.
const SKY_BEYOND: Moved = Moved { triangle: SKY, depth: [f64::INFINITY; 2], own: [f64::INFINITY; 2] };

/// A depth that may be rounded to the far plane's.
const FAR: f64 = 1.0 - 1.0 / 65_535.0;

/// A triangle on the screen.
#[derive(Debug, Clone, Copy)]
struct OnScreen {
    corners: [Plan; 3],
    first: f64,
    /// How much its depth grows a pixel to the right and down.
    slope: [f64; 2],
    /// What is added to its depth.
    offset: Range,
    doubt: f64,
}

/// Triangles that are looked at at a time.
const CHUNK: u32 = 4096;

/// What centres see of a mesh.
pub(super) struct MovedMesh<'a> {
    depths: &'a Depths<'a>,
    mesh: &'a Mesh,
    settings: &'a Settings,
    shift: f64,
}

impl<'a> MovedMesh<'a> {
    pub(super) fn new(depths: &'a Depths<'a>, mesh: &'a Mesh, settings: &'a Settings, guess: &Guess) -> Self {
        Self { depths, mesh, settings, shift: guess.envelope.shift() }
    }

    /// What each centre may see.
    pub(super) fn seen(&self, view: &View, surfaces: &Surfaces) -> Buffer<Vec<Moved>> {
        let (width, height) = (view.frame.width(), view.frame.height());
        let rows = parallel::map_indices(height, |y| {
            (0..width)
                .map(|x| {
                    let of = surfaces.of.at(x, y).iter();
                    let mut all: Vec<Moved> = Vec::new();
                    for moved in of.map(|surface| self.at([x, y], surface.triangle, surface.depth)) {
                        if !all.iter().any(|known| known.triangle == moved.triangle) {
                            all.push(moved);
                        }
                    }
                    all
                })
                .collect::<Vec<_>>()
        });
        let mut seen: Vec<Vec<Moved>> = rows.into_iter().flatten().collect();
        // What is seen as it is lies nowhere deeper than this, and hides what does.
        let deepest: Vec<f64> =
            seen.iter().map(|of| of.iter().map(|moved| moved.depth[1]).fold(0.0, math::max)).collect();
        let ids = self.mesh.triangle_ids();
        let found = parallel::map_indices(ids.div_ceil(CHUNK) as usize, |k| {
            let first = k as u32 * CHUNK;
            let mut found = Vec::new();
            for id in first..ids.min(first.saturating_add(CHUNK)) {
                if let Some(triangle) = self.on_screen(id) {
                    triangle.for_each_centre([width, height], self.shift, &mut |pixel, depth, own| {
                        if depth[0] <= deepest[pixel] {
                            found.push((pixel, Moved { triangle: id, depth, own }));
                        }
                    });
                }
            }
            found
        });
        for (pixel, moved) in found.into_iter().flatten() {
            let of = &mut seen[pixel];
            if !of.iter().any(|known| known.triangle == moved.triangle) {
                of.push(moved);
            }
        }
        // What is moved to the far plane is as good as not there.
        for (of, deepest) in seen.iter_mut().zip(deepest) {
            if deepest >= FAR && of.iter().all(|moved| moved.triangle != SKY) {
                of.push(SKY_BEYOND);
            }
        }
        Buffer::from_values(width, height, seen)
    }

    /// A triangle at a pixel's centre which sees it somewhere between two view depths.
    fn at(&self, pixel: [usize; 2], triangle: u32, view_depth: (f64, f64)) -> Moved {
        if triangle == SKY {
            return SKY_BEYOND;
        }
        let own = [self.depths.of(view_depth.0), self.depths.of(view_depth.1)];
        match self.on_screen(triangle) {
            Some(of) => {
                let (depth, _) = of.depth_at(centre(pixel), self.shift);
                // Its plane tells, and where that is seen edge-on what it was seen at.
                let moved = [own[0] + of.offset[0] - of.doubt, own[1] + of.offset[1] + of.doubt];
                let depth = [math::max(depth[0], moved[0]), math::min(depth[1], moved[1])];
                Moved { triangle, depth: if depth[0] <= depth[1] { depth } else { moved }, own }
            }
            // It crosses the near plane: its slope is anything.
            None => Moved { triangle, depth: [own[0], f64::INFINITY], own },
        }
    }

    fn on_screen(&self, id: u32) -> Option<OnScreen> {
        let world = self.mesh.triangle(id)?;
        let [(a, first), (b, second), (c, third)] = {
            let [a, b, c] = world.map(|p: World| self.depths.on_screen(p));
            [a?, b?, c?]
        };
        let (u, v) = (b - a, c - a);
        let (by_u, by_v) = (second - first, third - first);
        let area = u.perp_dot(v);
        let slope = [(by_u * v.y - by_v * u.y) / area, (by_v * u.x - by_u * v.x) / area];
        let steepest = math::max(slope[0].abs(), slope[1].abs());
        let longest = [u.length(), v.length(), (c - b).length()].into_iter().fold(0.0, math::max);
        // Corners that stray change the slope by their way over the triangle's height.
        let stray = 2.0 * std::f64::consts::SQRT_2 * self.shift;
        let height = area.abs() / longest;
        let most = first.abs() + by_u.abs() + by_v.abs();
        let slopes = if area != 0.0 && steepest.is_finite() && height > 2.0 * stray {
            let share = stray / (height - stray) * std::f64::consts::SQRT_2;
            [steepest * math::max(1.0 - share, 0.0), steepest * (1.0 + share)]
        } else {
            [0.0, 2.0]
        };
        let times = |range: Range, by: f64| {
            if by < 0.0 { [range[1] * by, range[0] * by] } else { range.map(|v| v * by) }
        };
        let by_slope = times(slopes, self.settings.offset_factor);
        let by_step = times(self.depths.step(most), self.settings.offset_units);
        let offset =
            [by_slope[0] + by_step[0], by_slope[1] + by_step[1]].map(|v| math::max(-1.0, math::min(v, 1.0)));
        let doubt = world.iter().map(|p| self.depths.doubt(*p)).fold(0.0, math::max);
        Some(OnScreen { corners: [a, b, c], first, slope, offset, doubt })
    }
}

fn centre([x, y]: [usize; 2]) -> Plan {
    Plan::new(x as f64 + 0.5, y as f64 + 0.5)
}

impl OnScreen {
    /// Between which depths it lies at a place of the screen: moved, and as it is.
    fn depth_at(&self, at: Plan, shift: f64) -> (Range, Range) {
        let from = at - self.corners[0];
        let depth = self.first + self.slope[0] * from.x + self.slope[1] * from.y;
        let off = (self.slope[0].abs() + self.slope[1].abs()) * shift + self.doubt;
        if !(depth.is_finite() && off.is_finite()) {
            return ([f64::NEG_INFINITY, f64::INFINITY], [f64::NEG_INFINITY, f64::INFINITY]);
        }
        let own = [depth - off, depth + off];
        ([own[0] + self.offset[0], own[1] + self.offset[1]], own)
    }

    /// Calls `visit` with the pixels whose centres it may cover, and its depths there.
    fn for_each_centre(&self, size: [usize; 2], shift: f64, visit: &mut dyn FnMut(usize, Range, Range)) {
        let stray = std::f64::consts::SQRT_2 * shift;
        let [a, b, c] = self.corners;
        let range = |values: [f64; 3], count: usize| {
            let low = values.iter().copied().fold(f64::INFINITY, math::min) - stray;
            let high = values.iter().copied().fold(f64::NEG_INFINITY, math::max) + stray;
            // Casts saturate.
            let from = (low - 0.5).ceil() as usize;
            from..((high + 0.5).floor() as usize).min(count)
        };
        let (columns, rows) = (range([a.x, b.x, c.x], size[0]), range([a.y, b.y, c.y], size[1]));
        let turn = if (b - a).perp_dot(c - a) < 0.0 { -1.0 } else { 1.0 };
        let sides = [[a, b], [b, c], [c, a]];
        for y in rows {
            for x in columns.clone() {
                let at = centre([x, y]);
                let is_near = sides.iter().all(|[p, q]| {
                    let along = *q - *p;
                    along.perp_dot(at - *p) * turn >= -stray * along.length()
                });
                if is_near {
                    let (depth, own) = self.depth_at(at, shift);
                    visit(y * size[0] + x, depth, own);
                }
            }
        }
    }
}
