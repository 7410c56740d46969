//! A rectangle of pixels: fragments of boxes, lists, sorting, composition (4.3.2, 4.3.3, 4.4.2).
//!
//! Input: a frame's segments that may touch the rectangle, in their row. Output: its pixels' encoded colours before they are smoothed, and what was counted. Each
//! pixel is decided by itself, so that neither tiles nor threads matter. Where lists outgrow [`MOST_ENTRIES`] the rectangle is drawn in parts, down to one
//! pixel, whose list is no longer than there are segments. Refuses: nothing.

use super::border::Border;
use super::camera::{Camera, P3};
use super::in_line::{Fragment, ReadySegment, Thin};
use super::lists::{Entry, PixelLists};
use super::segment_box::BoxMaker;
use super::statics::{Room, Statics, merged};
use super::step::{Step, Verdict};
use super::update::Segment;
use crate::buffer::Touches;
use crate::canvas::{Backdrop, Record};
use crate::raster::device::Real;
use crate::resolve::{Paint, Stack};
use crate::scene::{BlendMode, Line, Precision, Width};
use crate::space::{Plan, ViewFrame, World};
use crate::stage::Stage;
use crate::technique::dynamic_line::{Antialiasing, Corners, LineOverlaps, Settings};
use crate::terrain::{Mesh, SKY};
use crate::tiling::TilePlace;
use crate::visibility::{FootprintPlane, PixelFootprint, Planes, Sight};

/// The most entries of the lists of a tile (at 24 bytes).
pub const MOST_ENTRIES: usize = 1 << 23;

/// What all tiles of a frame are drawn with.
pub struct FrameContext<'a, T> {
    /// The scene.
    pub stage: &'a Stage,
    /// The terrain that the view shows.
    pub mesh: &'a Mesh,
    /// From where it is seen.
    pub view: &'a ViewFrame,
    /// The parameters.
    pub settings: Settings,
    /// What the pixels' centres see.
    pub sight: Sight<'a>,
    /// What lines are painted over.
    pub backdrop: Backdrop<'a>,
    /// The view in the device's numbers.
    pub camera: Camera<T>,
    /// Makes boxes.
    pub boxes: BoxMaker<T>,
    /// What is done about thin lines.
    pub thin: Thin,
    /// The segments of the view.
    pub segments: Vec<Segment<T>>,
    /// The paint of each style of items.
    pub paints: Vec<Paint>,
    /// Fills and widths in metres, where the scene has them.
    pub statics: Option<Statics<'a>>,
    /// Whether each pixel's number of boxes is wanted.
    pub wants_boxes: bool,
    /// Whether it is wanted which items touch pixels.
    pub wants_items: bool,
    /// The most entries of the lists of a tile: [`MOST_ENTRIES`].
    pub most_entries: usize,
}

/// What was counted.
#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
pub struct Counts {
    /// Point-in-line tests.
    pub fragments: u64,
    /// Entries of lists.
    pub entries: u64,
    /// Entries of the longest list.
    pub longest: u64,
}

impl Counts {
    /// Those of two parts.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self {
            fragments: self.fragments + other.fragments,
            entries: self.entries + other.entries,
            longest: self.longest.max(other.longest),
        }
    }
}

/// A finished rectangle of pixels, rows from the top.
#[derive(Debug, Default)]
pub struct Drawn {
    /// Encoded colours, straight alpha.
    pub colors: Vec<[f64; 4]>,
    /// How long each pixel's list is.
    pub lengths: Vec<u32>,
    /// How many boxes cover each pixel, where that is wanted.
    pub boxes: Vec<u32>,
    /// Which items are drawn on its pixels, where that is wanted.
    pub touches: Touches,
    /// What was counted.
    pub counts: Counts,
}

impl<T: Real> FrameContext<'_, T> {
    /// How the stroke of a segment is drawn, and half its width in pixels.
    pub fn line_of(&self, segment: &Segment<T>) -> (&Line, T) {
        line_of(self.stage, segment.item)
    }

    /// The border that decides what a segment's line holds, where it is the footprint's by definition and the device computes in doubles.
    fn border(&self, segment: &Segment<T>, half_px: T) -> Option<Border> {
        let is_defined =
            self.stage.scene.device.precision == Precision::F64 && self.settings.corners == Corners::Round;
        let vertices = self.stage.draw_list.vertices();
        is_defined.then(|| match segment.source.map(|source| source as usize) {
            Some(source) => Border::of_part([vertices[source], vertices[source + 1]], half_px, &self.camera),
            None => {
                Border::of_whole([segment.start, segment.end].map(|p| p.plan().get()), half_px, &self.camera)
            }
        })
    }

    /// How far beyond its box a segment may cover a pixel's centre, pixels.
    pub fn margin(&self) -> f64 {
        margin(self.thin, self.settings.antialiasing)
    }

    /// Draws a rectangle; `near`: the segments that may touch it.
    pub fn draw<R: Record<Step>>(&self, place: TilePlace, near: &[u32], record: &mut R) -> Drawn {
        let [width, height] = place.size;
        if let Some(drawn) = self.try_draw(place, near, record) {
            return drawn;
        }
        let is_wide = width >= height;
        let mut cut = |from: usize, size: usize| {
            let (axis, other) = if is_wide { (0, 1) } else { (1, 0) };
            let (mut corner, mut part) = (place.corner, place.size);
            corner[axis] += from;
            part[axis] = size;
            part[other] = place.size[other];
            self.draw(TilePlace { corner, size: part }, near, record)
        };
        let whole = if is_wide { width } else { height };
        let mut first = cut(0, whole / 2);
        let second = cut(whole / 2, whole - whole / 2);
        let rows = if is_wide { [whole / 2, whole - whole / 2] } else { [1, 1] };
        first.touches.take(second.touches);
        Drawn {
            touches: first.touches,
            colors: joined((&first.colors, &second.colors), rows, is_wide),
            lengths: joined((&first.lengths, &second.lengths), rows, is_wide),
            boxes: joined((&first.boxes, &second.boxes), rows, is_wide),
            counts: first.counts.plus(second.counts),
        }
    }

    /// Draws a rectangle, unless its lists outgrow their room and it can be drawn in parts.
    fn try_draw<R: Record<Step>>(&self, place: TilePlace, near: &[u32], record: &mut R) -> Option<Drawn> {
        let ([x, y], [width, height]) = (place.corner, place.size);
        let count = width * height;
        let mut lists = PixelLists::new(count);
        let mut boxes = vec![0; if self.wants_boxes { count } else { 0 }];
        let mut counts = Counts::default();
        let points = self.points(place);
        let (fragments, footprints) = match near {
            [] => (Vec::new(), Vec::new()),
            _ => (self.fragments(&points), self.footprints(place)),
        };
        for &number in near {
            let segment = &self.segments[number as usize];
            let (line, half_px) = self.line_of(segment);
            let of = self.boxes.of(segment, half_px);
            let Some(outline) = self.boxes.outline(&of, self.margin()) else { continue };
            let ready = ReadySegment::new(
                segment,
                (line, half_px, self.border(segment, half_px)),
                (&self.camera, self.view),
                (self.settings.corners, self.thin),
            );
            let Some([_, rows]) = outline.window([x + width, y + height]) else { continue };
            for row in rows.start.max(y)..rows.end.min(y + height) {
                let columns = outline.columns(row, x..x + width);
                let start = (row - y) * width;
                for column in columns {
                    let pixel = start + column - x;
                    if let Some(boxes) = boxes.get_mut(pixel) {
                        *boxes += 1;
                    }
                    let Some(fragment) = &fragments[pixel] else { continue };
                    counts.fragments += 1;
                    let verdict = self.test(
                        &ready,
                        (fragment, footprints.get(pixel).copied().flatten()),
                        (column, row),
                    );
                    record.step(|| Step::Tested {
                        item: segment.item,
                        from: segment.start.plan().get(),
                        to: segment.end.plan().get(),
                        distance: ready.distance(fragment).get(),
                        half_width: ready.half_width(fragment).get(),
                        verdict,
                    });
                    let share = match verdict {
                        Verdict::Outside => continue,
                        Verdict::Inside(share) => share,
                        Verdict::Thin => 1.0,
                    };
                    lists.push(pixel, Entry { item: segment.item, segment: number, share });
                }
            }
            if lists.len() > self.most_entries && count > 1 {
                return None;
            }
        }
        counts.entries = lists.len() as u64;
        let lengths: Vec<u32> = (0..count).map(|pixel| lists.count(pixel)).collect();
        counts.longest = lengths.iter().copied().max().unwrap_or(0).into();
        let mut touches = Touches::new(self.view.width(), self.wants_items);
        let colors = self.compose((place, &points), &mut lists, &mut touches, record);
        Some(Drawn { colors, lengths, boxes, touches, counts })
    }

    /// The surface points of a rectangle.
    fn points(&self, place: TilePlace) -> Vec<World> {
        let ([x, y], [width, height]) = (place.corner, place.size);
        let (mut points, mut planes) = (vec![World::default(); width * height], Planes::default());
        for (row, points) in points.chunks_mut(width).enumerate() {
            self.sight.world_of_row((x, y + row), points, &mut planes);
        }
        points
    }

    /// What is tested of each pixel that sees the terrain.
    fn fragments(&self, points: &[World]) -> Vec<Option<Fragment<T>>> {
        let fragment = |at: &World| {
            let point = P3::of(*at);
            at.is_finite().then(|| Fragment { point, pixel: self.camera.pixel_at(point) })
        };
        points.iter().map(fragment).collect()
    }

    /// How each pixel reaches over the plan, where edges are analytic; else none of them.
    fn footprints(&self, place: TilePlace) -> Vec<Option<PixelFootprint>> {
        let ([x, y], [width, height]) = (place.corner, place.size);
        let is_analytic = self.settings.antialiasing == Antialiasing::Analytic;
        let count = if is_analytic { width * height } else { 0 };
        (0..count).map(|k| self.footprint((x + k % width, y + k / width))).collect()
    }

    /// How a pixel reaches over the plan, on the plane of the triangle that its centre sees.
    fn footprint(&self, (column, row): (usize, usize)) -> Option<PixelFootprint> {
        let id = self.sight.triangle(column, row);
        let triangle = if id == SKY { None } else { self.mesh.surface_triangle(id) }?;
        FootprintPlane::new(self.view, &triangle).footprint(self.sight.lattice().at(column, row))
    }

    /// Whether a pixel that a segment's box covers is in its line.
    #[inline(always)]
    fn test(
        &self,
        ready: &ReadySegment<T>,
        (fragment, footprint): (&Fragment<T>, Option<PixelFootprint>),
        at: (usize, usize),
    ) -> Verdict {
        if self.settings.antialiasing == Antialiasing::Analytic {
            let share = ready.share(fragment, footprint);
            return if share > 0.0 { Verdict::Inside(share) } else { Verdict::Outside };
        }
        if ready.holds(fragment) {
            return Verdict::Inside(1.0);
        }
        let is_thin = self.thin != Thin::Nothing
            && ready.near(at).is_some_and(|place| self.thin == Thin::Near || self.is_seen(place, at));
        if is_thin { Verdict::Thin } else { Verdict::Outside }
    }

    /// Whether the surface over a plan point is no deeper than what a pixel and those around it see of the terrain (after Persson 2012, whose second depths tell
    /// silhouettes).
    fn is_seen(&self, place: Plan, (column, row): (usize, usize)) -> bool {
        let Some(height) = self.mesh.height_at(place) else { return false };
        let depth = self.view.depth(World::new(place.x, place.y, height));
        let lattice = self.sight.lattice();
        let rows = row.saturating_sub(1)..(row + 2).min(lattice.rows);
        let columns = column.saturating_sub(1)..(column + 2).min(lattice.columns);
        let around = rows.flat_map(|row| columns.clone().map(move |column| (column, row)));
        let mut depths = around.filter_map(|(column, row)| self.sight.hit(column, row));
        depths.any(|hit| depth <= hit.depth)
    }

    /// Sorts and composes each pixel's list (4.3.3, 4.4.2).
    fn compose<R: Record<Step>>(
        &self,
        (place, points): (TilePlace, &[World]),
        lists: &mut PixelLists,
        touches: &mut Touches,
        record: &mut R,
    ) -> Vec<[f64; 4]> {
        let ([x, y], [width, _]) = (place.corner, place.size);
        let (mut last, mut drawn) = (self.backdrop.no_ground(), Vec::new());
        let (mut lines, mut statics, mut room) = (Vec::new(), Vec::new(), Room::default());
        let compositor = &self.backdrop.compositor;
        let (mut paint_before, mut color_before) = (Paint::CLEAR, compositor.encoded(Paint::CLEAR));
        let mut colors = Vec::with_capacity(points.len());
        for (pixel, point) in points.iter().enumerate() {
            let at = (x + pixel % width, y + pixel / width);
            let triangle = self.sight.triangle(at.0, at.1);
            let ground = self.backdrop.paint_at(&mut last, triangle, || point.plan());
            record.step(|| self.ground_step(triangle, *point, ground));
            lines.clear();
            if lists.count(pixel) > 0 {
                lists.sort(pixel, at, self.settings.sorting, |entry| self.alpha(entry.item, entry.share));
                self.visible(lists.of(pixel), &mut lines);
            }
            statics.clear();
            if let Some(decals) = self.statics.as_ref().filter(|_| triangle != SKY && point.is_finite()) {
                decals.find(point.plan(), || self.footprint(at), &mut room, &mut statics);
            }
            drawn.clear();
            merged(&lines, &statics, &mut drawn);
            record.step(|| Step::Composed(drawn.clone()));
            let mut stack = Stack::on(ground);
            for (item, share) in drawn.iter().rev() {
                touches.push([at.0, at.1], *item, *share >= 0.5);
                let style = self.stage.draw_list.items()[*item as usize].style as usize;
                let paint = if *share < 1.0 { self.paints[style].times(*share) } else { self.paints[style] };
                stack.draw(self.stage.draw_list.styles()[style].group, |below| compositor.over(below, paint));
            }
            let paint = stack.finished();
            record.step(|| Step::Paint(paint));
            if paint != paint_before {
                (paint_before, color_before) = (paint, compositor.encoded(paint));
            }
            colors.push(color_before);
        }
        colors
    }

    fn ground_step(&self, triangle: u32, point: World, paint: Paint) -> Step {
        if triangle == SKY {
            return Step::Sky;
        }
        let pixel_m = self.camera.pixel_at(P3::of(point)).get();
        Step::Ground { triangle, plan: point.plan(), pixel_m, paint }
    }

    /// What of a sorted list can be seen, from the top (4.4.2): each line once, unless overlaps are wanted, until all is opaque.
    fn visible(&self, entries: impl Iterator<Item = Entry>, drawn: &mut Vec<(u32, f64)>) {
        let mut through = 1.0;
        for entry in entries {
            match drawn.last_mut() {
                // Only the element before is asked, as there; of analytic edges the largest share counts.
                Some((item, share))
                    if *item == entry.item && self.settings.overlaps == LineOverlaps::Once =>
                {
                    *share = crate::math::max(*share, entry.share);
                }
                _ if through <= 0.0 => return,
                last => {
                    if let Some((item, share)) = last {
                        through *= 1.0 - self.alpha(*item, *share);
                    }
                    if through <= 0.0 {
                        return;
                    }
                    drawn.push((entry.item, entry.share));
                }
            }
        }
    }

    /// How much of what lies below an entry it hides.
    fn alpha(&self, item: u32, share: f64) -> f64 {
        if self.stage.scene.compositing.mode == BlendMode::Additive {
            return 0.0;
        }
        let style = self.stage.draw_list.style_of(item);
        style.paint.0[3] * share * style.group.map_or(1.0, |group| group.opacity)
    }
}

/// How an item's stroke is drawn, and half its width in pixels.
pub fn line_of<T: Real>(stage: &Stage, item: u32) -> (&Line, T) {
    match stage.draw_list.style_of(item).stroke.as_ref() {
        Some(line @ Line { width: Width::Pixels(width), .. }) => (line, T::of(width / 2.0)),
        _ => unreachable!("only strokes in pixels are matched with the terrain"),
    }
}

/// How far beyond its box a segment may cover a pixel's centre, pixels: half of the pixel's square for analytic edges, and for thin lines, of whose boxes no
/// centre need be in the picture (4.5 does not say how their pixels are found).
pub fn margin(thin: Thin, antialiasing: Antialiasing) -> f64 {
    if thin != Thin::Nothing || antialiasing == Antialiasing::Analytic { 0.75 } else { 0.0 }
}

/// The values of two rectangles, one right of the other (whose rows have so many values) or below it.
fn joined<V: Copy>((first, second): (&[V], &[V]), rows: [usize; 2], is_wide: bool) -> Vec<V> {
    if !is_wide {
        return [first, second].concat();
    }
    let rows = first.chunks(rows[0]).zip(second.chunks(rows[1]));
    rows.flat_map(|(left, right)| left.iter().chain(right).copied()).collect()
}
