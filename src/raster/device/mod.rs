//! The imitated machine's path from a triangle of the world to triangles of the screen.
//!
//! Input: triangles of a [`Mesh`] by number, a [`ViewFrame`], a [`Device`]. Output: [`Primitive`]s: snapped screen triangles
//! with depth, and [`Pipeline::draw`], which draws them into [`Samples`]; of segments [`LinePrimitive`]s and of triangles that are no
//! mesh's [`Face`]s, which draw themselves. What a graphics processor leaves open is chosen here, once:
//! - one matrix takes points to clip space (scene-local ones, or as [`Positions`](crate::scene::Positions) says; the way back is for local ones); it is composed in
//!   double precision and rounded to the device's;
//!   products are summed from left to right, without fused operations;
//! - clip space is that of zero-to-one depth (0 <= z <= w); an infinite far plane clips nothing, depth is clamped;
//! - beyond the near and the far plane a guard band of 2^16 pixels (or twice the picture's size) clips, so that all
//!   numbers stay in range; the crossing of a shared edge is the same for both of its triangles;
//! - vertices are snapped in *pixels of the screen*, to the nearest multiple of 2^-bits, ties to even, whatever the lattice:
//!   a finer lattice is more samples of the same picture; a sample lies at the nearest multiple of 2^-12 pixels;
//! - depth is a mean of the corners' weighted by the edge functions, so that it never leaves their range (with `interpolation = "unsnapped"` of the
//!   depths that the plane through the unsnapped corners has at the snapped ones); plan points, where a
//!   mesh has its own, are means by the edge functions of corners that have not been snapped.
//!
//! Refuses: nothing; a triangle whose numbers leave the range of the device's arithmetic is not drawn, so that neither
//! NaN nor infinity reaches a buffer.

mod clip;
mod convex;
mod depth;
mod face;
mod fragment;
mod line;
mod matrix;
mod number;
mod offset;
mod position;
mod scan;
mod surface;

pub use depth::DepthBuffer;
pub use face::Face;
pub use fragment::Fragment;
pub use line::{LinePrimitive, LineStyle, Stipple};
pub use number::Real;
pub use offset::PolygonOffset;
pub use scan::{Primitive, Window};
pub use surface::SurfaceDepth;

use super::{Lattice, Samples};
use crate::scene::{Device, Interpolation};
use crate::space::{Clip, Lens, Plan, Screen, ViewFrame, World};
use crate::terrain::Mesh;
use clip::Volume;
use matrix::{Matrix, Projection};
use number::GRID_BITS;
use position::Encoding;
use std::ops::Range;

/// The machine with its matrices, in one precision.
#[derive(Debug, Clone)]
pub struct Pipeline<T> {
    encoding: Encoding<T>,
    clip_from_position: Matrix<T>,
    world_from_clip: Matrix<T>,
    projection: Projection,
    volume: Volume<T>,
    /// Half the picture's width and height.
    half: [T; 2],
    depth: DepthBuffer,
    subpixel_bits: u32,
    interpolation: Interpolation,
    is_parallel: bool,
    offset: Option<PolygonOffset>,
}

/// No place on the screen lies farther from its zero point: the guard band ends before 2^17 pixels, but for rounding.
const FARTHEST: f64 = (1u32 << 18) as f64;

impl<T: Real> Pipeline<T> {
    /// The machine for a view of a terrain.
    ///
    /// A parallel lens has no linear depth up to infinity: an infinite far plane lies beyond the terrain then, by the terrain's diagonal.
    pub fn new(frame: &ViewFrame, mesh: &Mesh, device: &Device) -> Self {
        let depth = DepthBuffer(device.depth);
        let projection = projection(frame, mesh, device);
        let encoding = Encoding::new(device.position, frame);
        Self {
            clip_from_position: projection.clip_from_world(frame, encoding.eye(frame)),
            encoding,
            world_from_clip: projection.world_from_clip(frame),
            projection,
            volume: Volume::new(frame, depth.is_reversed()),
            half: [frame.width(), frame.height()].map(|size| T::of(size as f64 / 2.0)),
            depth,
            subpixel_bits: device.subpixel_bits.min(GRID_BITS),
            interpolation: device.interpolation,
            is_parallel: matches!(frame.lens(), Lens::Parallel { .. }),
            offset: None,
        }
    }

    /// The machine with the depth of all its [primitives](Self::primitives) moved, and so what its depth buffer says of
    /// places.
    #[must_use]
    pub fn with_polygon_offset(self, offset: PolygonOffset) -> Self {
        Self { offset: Some(offset), ..self }
    }

    /// The screen triangles, in order, of those of `ids` whose box holds a sample of the lattice.
    pub fn primitives(&self, mesh: &Mesh, ids: Range<u32>, lattice: &Lattice) -> Vec<Primitive<T>> {
        let mut out = Vec::new();
        for id in ids {
            let Some(corners) = mesh.triangle(id) else {
                continue;
            };
            let corners = corners.map(|p| self.clip(p));
            self.volume.clip(&corners, false, |triangle| {
                let corners = triangle.map(|c| self.screen_from_clip(c));
                let primitive = Primitive { id, corners: self.on_plane(&triangle, corners) };
                if primitive.window(lattice).is_some() {
                    out.push(self.offset.map_or(primitive, |offset| offset.applied(&primitive, self.depth)));
                }
            });
        }
        out
    }

    /// Calls `visit` with what a triangle that leaves the depth buffer alone covers of a window of the lattice: column and
    /// row, its facing (1: its corners run counter-clockwise as they are seen, else -1) and what it would store as depth.
    /// `is_clamped`: neither the near nor the far plane clips it, its fragments' depths are clamped instead.
    pub fn rasterize(
        &self,
        triangle: &[World; 3],
        is_clamped: bool,
        (lattice, window): (&Lattice, &Window),
        visit: &mut dyn FnMut((usize, usize), i32, f32),
    ) {
        let corners = triangle.map(|p| self.clip(p));
        self.volume.clip(&corners, is_clamped, |triangle| {
            let corners = triangle.map(|corner| {
                let [x, y, _] = self.screen_from_clip(corner);
                [x, y, corner.z / corner.w]
            });
            let primitive = Primitive { id: 0, corners: self.on_plane(&triangle, corners) };
            let mut store = |at, facing, depth| visit(at, facing, self.depth.store(depth));
            if self.subpixel_bits > 0 {
                scan::visit::<T, i128>(&primitive, (lattice, window), &mut store);
            } else {
                scan::visit::<T, T>(&primitive, (lattice, window), &mut store);
            }
        });
    }

    /// A segment on the screen: what the near plane, the far plane and the guard band leave of it. `None`: nothing, or
    /// it leaves the range of the machine's numbers.
    pub fn line(&self, ends: [World; 2]) -> Option<LinePrimitive<T>> {
        let ends =
            self.volume.clip_segment(ends.map(|p| self.clip(p)))?.map(|end| self.screen_from_clip(end));
        let is_near = |[x, y, _]: &[T; 3]| x.get().abs() <= FARTHEST && y.get().abs() <= FARTHEST;
        ends.iter().all(is_near).then_some(LinePrimitive { ends })
    }

    /// Calls `emit` with what the near plane, the far plane and the guard band leave of a triangle.
    pub fn faces(&self, triangle: [World; 3], mut emit: impl FnMut(Face<T>)) {
        let corners = triangle.map(|p| self.clip(p));
        self.volume.clip(&corners, false, |triangle| {
            let corners = triangle.map(|corner| self.screen_from_clip(corner));
            emit(Face::new(self.on_plane(&triangle, corners), self.subpixel_bits > 0));
        });
    }

    /// The depth buffer.
    pub fn depth(&self) -> DepthBuffer {
        self.depth
    }

    /// A point of the world in clip space.
    fn clip(&self, p: World) -> Clip<T> {
        let [x, y, z] = self.encoding.of(p);
        Clip::from_array(self.clip_from_position.times([x, y, z, T::of(1.0)]))
    }

    /// Perspective division, viewport transform and snapping; depth stays as the division left it, within 0..=1.
    fn screen_from_clip(&self, corner: Clip<T>) -> [T; 3] {
        let [x, y] = self.place(corner).map(|pixels| self.snapped(pixels));
        [x, y, number::clamp_to_unit(corner.z / corner.w)]
    }

    /// Snapped corners with the depths that the plane through the unsnapped ones has there, where the machine interpolates from those.
    fn on_plane(&self, triangle: &[Clip<T>; 3], corners: [[T; 3]; 3]) -> [[T; 3]; 3] {
        if self.subpixel_bits == 0 || self.interpolation == Interpolation::Snapped {
            return corners;
        }
        let places = triangle.map(|corner| self.place(corner));
        let from_first = |k: usize| [places[k][0] - places[0][0], places[k][1] - places[0][1]];
        let ([x1, y1], [x2, y2]) = (from_first(1), from_first(2));
        let (z1, z2) = (corners[1][2] - corners[0][2], corners[2][2] - corners[0][2]);
        let area = x1 * y2 - x2 * y1;
        let (along_x, along_y) = ((z1 * y2 - z2 * y1) / area, (z2 * x1 - z1 * x2) / area);
        std::array::from_fn(|k| {
            let [x, y, z] = corners[k];
            let moved = z + along_x * (x - places[k][0]) + along_y * (y - places[k][1]);
            // A triangle without area has no plane.
            [x, y, if moved.get().is_finite() { moved } else { z }]
        })
    }

    /// Perspective division and viewport transform.
    fn place(&self, Clip { x, y, w, .. }: Clip<T>) -> [T; 2] {
        let [half_width, half_height] = self.half;
        [half_width + x / w * half_width, half_height - y / w * half_height]
    }

    fn snapped(&self, pixels: T) -> T {
        if self.subpixel_bits == 0 {
            return pixels;
        }
        let units = f64::from(1u32 << self.subpixel_bits);
        T::of((pixels.get() * units).round_ties_even() / units)
    }

    /// Forgets what the samples saw.
    pub fn clear(&self, samples: &mut Samples, (width, height): (usize, usize)) {
        samples.reset(width, height);
        samples.keys.fill(self.depth.cleared());
    }

    /// Draws primitives in order into the samples of a window.
    pub fn draw<'p>(
        &self,
        primitives: impl Iterator<Item = &'p Primitive<T>>,
        (lattice, window): (&Lattice, &Window),
        samples: &mut Samples,
    ) {
        if self.subpixel_bits > 0 {
            scan::draw::<T, i128>(primitives, (lattice, window), self.depth, samples);
        } else {
            scan::draw::<T, T>(primitives, (lattice, window), self.depth, samples);
        }
    }

    /// The world point and its view depth that the depth buffer's content means at a screen point (She 3.2); `None`
    /// where the machine's arithmetic finds none.
    pub fn unproject(&self, at: Screen, stored: f32) -> Option<(World, f64)> {
        let ([x, y], z) = (self.divided(at), self.depth.load(stored));
        let divided = Clip { x, y, z, w: T::of(1.0) };
        let [x, y, up, w] = self.world_from_clip.times(divided.to_array());
        let point = World::new((x / w).get(), (y / w).get(), (up / w).get());
        let depth = self.projection.view_depth(z, self.is_parallel).get();
        (point.is_finite() && depth.is_finite() && depth > 0.0).then_some((point, depth))
    }

    /// The plan point that the machine interpolates at a screen point between a triangle's corners, with the perspective; `None` where
    /// its arithmetic finds none. The weights are edge functions of the corners in clip space as they are before snapping, seen from the
    /// screen point: so a triangle that is cut is interpolated as a whole.
    pub fn plan_at(&self, at: Screen, corners: &[World; 3], plan: &[Plan; 3]) -> Option<Plan> {
        let [x, y] = self.divided(at);
        let [a, b, c] = corners.map(|p| {
            let corner = self.clip(p);
            [corner.x - x * corner.w, corner.y - y * corner.w]
        });
        let edge = |p: [T; 2], q: [T; 2]| p[0] * q[1] - p[1] * q[0];
        let [of_a, of_b, of_c] = [edge(b, c), edge(c, a), edge(a, b)];
        let sum = of_a + of_b + of_c;
        let between = |corners: [f64; 3]| {
            let [first, second, third] = corners.map(T::of);
            (first + ((second - first) * of_b + (third - first) * of_c) / sum).get()
        };
        let point = Plan::new(between(plan.map(|p| p.x)), between(plan.map(|p| p.y)));
        point.is_finite().then_some(point)
    }

    /// A screen point's x and y in clip space, divided by w.
    fn divided(&self, at: Screen) -> [T; 2] {
        let (one, [half_width, half_height]) = (T::of(1.0), self.half);
        [T::of(at.x) / half_width - one, one - T::of(at.y) / half_height]
    }
}

/// Rows of the matrix from scene-local points to a machine's clip space, in double precision.
pub fn clip_from_world(frame: &ViewFrame, mesh: &Mesh, device: &Device) -> [[f64; 4]; 4] {
    projection(frame, mesh, device).clip_from_world::<f64>(frame, frame.eye().to_vec()).rows()
}

fn projection(frame: &ViewFrame, mesh: &Mesh, device: &Device) -> Projection {
    Projection::new(frame, far_plane(frame, mesh), DepthBuffer(device.depth).is_reversed())
}

/// The far plane that the projection is made for.
fn far_plane(frame: &ViewFrame, mesh: &Mesh) -> f64 {
    if frame.far().is_finite() || matches!(frame.lens(), Lens::Central { .. }) {
        return frame.far();
    }
    // Volumes reach beyond the terrain, below it and beside it: where they crossed the plane they were painted on the sky.
    let farthest = mesh.bounds(mesh.root()).map_or(0.0, |b| {
        let spread: f64 = b.axes.iter().map(|a| frame.forward().dot(*a).abs()).sum();
        let diagonal = 2.0 * b.axes.iter().map(|a| a.length_squared()).sum::<f64>().sqrt();
        frame.depth(b.center) + spread + diagonal
    });
    crate::math::max(2.0 * frame.near(), farthest * (1.0 + 1.0 / 1024.0))
}
