//! What a frame draws: strips of points on the mesh become segments on the screen, each with its style (3.2.1); patches of fills become faces.
//!
//! Input: strips and patches, each in the order in which they are drawn. Output: [`Piece`]s and their fragments. Refuses: nothing.

use super::fill::Patch;
use super::settings::{Lines, Polygons, Primitives, Settings, Widths};
use crate::draw_list::DrawList;
use crate::parallel;
use crate::raster::device::{
    Face, Fragment, LinePrimitive, LineStyle, Pipeline, PolygonOffset, Real, Stipple, Window,
};
use crate::scene::{Device, Width};
use crate::space::{ViewFrame, World};
use crate::terrain::lod::RightTriangle;
use std::ops::Range;

/// Patches that become faces at a time.
const PATCHES: usize = 4096;

/// What is drawn of a quad clipping.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Strip {
    /// The item that it is of.
    pub item: u32,
    /// Its triangle clippings: the triangle of each, and which of `points` it has.
    pub clippings: Vec<(RightTriangle, Range<u32>)>,
    /// Points on the mesh.
    pub points: Vec<World>,
}

/// A segment or a face on the screen.
#[derive(Debug, Clone)]
pub(super) struct Piece<T> {
    /// The item that it is of.
    pub item: u32,
    /// The number of its triangle clipping among those that the frame draws; [`NO_CLIPPING`] of a face.
    pub clipping: u32,
    /// The triangle that it lies on.
    pub triangle: RightTriangle,
    /// The pixels that it may cover.
    pub window: Window,
    /// Whether its shares of pixels and those of the item's other pieces add up.
    pub is_smooth: bool,
    form: Form<T>,
}

/// No triangle clipping.
pub(super) const NO_CLIPPING: u32 = u32::MAX;

#[derive(Debug, Clone)]
enum Form<T> {
    Segment {
        line: LinePrimitive<T>,
        style: LineStyle,
        /// The stipple's counter at its start.
        counter: u64,
    },
    Face(Face<T>),
}

/// How lines and faces are drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct LineDrawing {
    settings: Settings,
    device: Device,
}

impl LineDrawing {
    pub(super) fn new(settings: &Settings, device: &Device) -> Self {
        Self { settings: *settings, device: *device }
    }

    /// Whether a line covers shares of pixels.
    fn is_antialiased(&self) -> bool {
        self.settings.lines == Lines::Antialiased
    }

    /// The faces of patches, in their order.
    pub(super) fn faces<T: Real>(
        &self,
        patches: &[Patch],
        (view, pipeline): (&ViewFrame, &Pipeline<T>),
    ) -> Vec<Piece<T>> {
        let picture = Window { columns: 0..view.width(), rows: 0..view.height() };
        let is_smooth = self.settings.polygons == Polygons::Antialiased;
        let of_patches = |patches: &&[Patch]| {
            let mut out = Vec::new();
            for patch in *patches {
                let forward = if is_smooth { self.forward(patch, (view, pipeline)) } else { T::of(0.0) };
                for corners in patch.fan() {
                    pipeline.faces(corners, |face| {
                        let face = face.moved(forward);
                        let Some(window) = face.window(is_smooth, &picture) else { return };
                        let (item, triangle, form) = (patch.item, patch.triangle, Form::Face(face));
                        out.push(Piece { item, clipping: NO_CLIPPING, triangle, window, is_smooth, form });
                    });
                }
            }
            out
        };
        parallel::map(&patches.chunks(PATCHES).collect::<Vec<_>>(), of_patches).concat()
    }

    /// How far a patch that covers shares of pixels is moved towards the eye. What it covers lies beside the pixel's centre, on another triangle perhaps: by the
    /// slope of its own, as the mesh is moved back by that of the triangle at the centre.
    fn forward<T: Real>(&self, patch: &Patch, (view, pipeline): (&ViewFrame, &Pipeline<T>)) -> T {
        let nearest = patch.ground.iter().map(|at| view.depth(*at)).fold(f64::INFINITY, crate::math::min);
        let surface = pipeline.surface_depth(view, &patch.ground, crate::math::max(nearest, view.near()));
        let offset = PolygonOffset { factor: -self.settings.offset_factor, units: 0.0 };
        offset.at(surface.slope, surface.depth, pipeline.depth())
    }

    /// The segments of strips, in their order.
    pub(super) fn segments<T: Real>(
        &self,
        strips: &[Strip],
        (list, view, pipeline): (&DrawList, &ViewFrame, &Pipeline<T>),
    ) -> Vec<Piece<T>> {
        let mut first = 0;
        let numbered: Vec<(u32, &Strip)> = strips
            .iter()
            .map(|strip| {
                let own = first;
                first += strip.clippings.len() as u32;
                (own, strip)
            })
            .collect();
        let of = |(first, strip): &(u32, &Strip)| self.of_strip(*first, strip, (list, view, pipeline));
        parallel::map(&numbered, of).concat()
    }

    fn of_strip<T: Real>(
        &self,
        first: u32,
        strip: &Strip,
        (list, view, pipeline): (&DrawList, &ViewFrame, &Pipeline<T>),
    ) -> Vec<Piece<T>> {
        let picture = Window { columns: 0..view.width(), rows: 0..view.height() };
        let style = self.style(strip, list, view);
        let (mut out, mut counter) = (Vec::new(), 0);
        for (clipping, (triangle, points)) in (first..).zip(&strip.clippings) {
            for ends in strip.points[points.start as usize..points.end as usize].windows(2) {
                let Some(line) = pipeline.line([ends[0], ends[1]]) else { continue };
                if self.settings.primitives == Primitives::Lines {
                    counter = 0;
                }
                if let Some(window) = line.window(&style, &picture) {
                    let (item, triangle, is_smooth) = (strip.item, *triangle, self.is_antialiased());
                    let form = Form::Segment { line, style, counter };
                    out.push(Piece { item, clipping, triangle, window, is_smooth, form });
                }
                if self.settings.primitives == Primitives::Strips && self.settings.stipple != 0xffff {
                    counter += line.steps(&style);
                }
            }
        }
        out
    }

    /// How a strip is drawn.
    fn style(&self, strip: &Strip, list: &DrawList, view: &ViewFrame) -> LineStyle {
        let width = self.width(strip, list, view);
        let stipple = Stipple { pattern: self.settings.stipple as u16, factor: self.settings.stipple_factor };
        LineStyle::new(width, stipple, self.is_antialiased(), &self.device)
    }

    /// How wide a strip is to be, pixels. GL has one width for all of it: where it comes nearest to the eye.
    fn width(&self, strip: &Strip, list: &DrawList, view: &ViewFrame) -> f64 {
        let style = list.style_of(strip.item);
        let swath = style.swath.map(|of| Width::Metres(of.width_m));
        let stroke = style.stroke.map(|line| line.width).or(swath);
        let pixel = || {
            let sizes = strip.points.iter().map(|at| view.pixel_m(*at));
            sizes.fold(f64::INFINITY, crate::math::min)
        };
        match (self.settings.widths, stroke) {
            (Widths::One, _) | (_, None) => 1.0,
            (Widths::Style, Some(Width::Pixels(width))) => width,
            (Widths::Style, Some(Width::Metres(width))) => width / pixel(),
        }
    }

    /// How many strips are to be wider than the device draws lines.
    pub(super) fn clamped(&self, strips: &[Strip], list: &DrawList, view: &ViewFrame) -> u64 {
        let is_clamped = |strip: &&Strip| LineStyle::is_clamped(self.width(strip, list, view), &self.device);
        strips.iter().filter(is_clamped).count() as u64
    }
}

impl<T: Real> Piece<T> {
    /// Calls `visit` with its fragments in a window of the picture: of a segment from its start to its end.
    pub(super) fn fragments(&self, window: &Window, visit: &mut dyn FnMut(Fragment)) {
        match &self.form {
            Form::Segment { line, style, counter } => line.draw(style, *counter, window, visit),
            Form::Face(face) => face.draw(self.is_smooth, window, visit),
        }
    }

    /// Whether it is a face.
    pub(super) fn is_face(&self) -> bool {
        matches!(self.form, Form::Face(_))
    }
}
