//! A picture of lines over the mesh in use: fragments, the depth test, composition.

use super::depth::{Depths, Range};
use super::diamond::{Crossing, Diamond, diamonds, often};
use super::face::{Near, ScreenFace};
use super::moved::{Moved, MovedMesh};
use super::screen_line::ScreenLine;
use super::share::share;
use super::stipple::Count;
use crate::allowed::composition::{Composed, Composer, Laid};
use crate::allowed::model::{Guess, Judged, View};
use crate::allowed::picture as pictures;
use crate::allowed::pixel::{BLEND, PixelRange};
use crate::allowed::stages::{Seen, stages};
use crate::allowed::surface::surfaces;
use crate::buffer::Buffer;
use crate::certainty::{Known, PaintRange};
use crate::error::{Error, Result};
use crate::math;
use crate::parallel;
use crate::resolve::GroundPaint;
use crate::scene::Width;
use crate::space::Plan;
use crate::technique::geometry_overlay::{
    FillPiece, LineStrip, Lines, Polygons, Prepare, Primitives, Settings, Widths,
};
use crate::terrain::SKY;

/// What a picture may be.
///
/// # Errors
/// When nobody knows what some setting draws.
pub(in crate::allowed) fn picture(view: &View, guess: &Guess) -> Result<Judged> {
    let (stage, frame) = (view.stage, view.frame);
    let settings: Settings = stage.scene.technique.get();
    let unknown = |what: &str, help: &str| {
        Err(Error::unsupported(format!("nobody knows what geometry-overlay's picture may be {what}"))
            .help(format!("{help}, or judge it by its picture and a tolerance")))
    };
    let mesh = &*stage.mesh_for(frame);
    let composer = Composer::new(&stage.scene, &stage.draw_list);
    let ground = GroundPaint::new(&stage.scene.ground, mesh, composer.compositor);
    if !ground.is_constant_on_triangles() {
        return unknown("over imagery, which moves with the mesh", "give the terrain one colour");
    }
    if settings.lines == Lines::Antialiased && settings.stipple != 0xffff {
        return unknown(
            "of anti-aliased lines with a stipple",
            "leave technique.geometry-overlay.stipple out",
        );
    }
    if settings.polygons == Polygons::Antialiased {
        return unknown(
            "of fills by their shares of pixels, of whose depths other programs have their own idea",
            "set technique.geometry-overlay.polygons to \"filled\"",
        );
    }
    let surfaces = surfaces(view, guess, (None, 1.0));
    let depths = Depths::new(view, guess, mesh);
    let seen = MovedMesh::new(&depths, mesh, &settings, guess).seen(view, &surfaces);
    let prepared = Prepare::new(stage)?;
    let (strips, fills) = (prepared.line_strips(frame), prepared.fill_pieces(frame));
    let overlay = Overlay { view, guess, settings: &settings, depths: &depths, composer, ground };
    Ok(overlay.judged(&seen, (&strips, &fills)))
}

/// A fragment that a segment may have in a pixel.
#[derive(Debug, Clone, Copy)]
struct Fragment {
    item: u32,
    strip: u32,
    /// Its segment's place in the strip.
    segment: u32,
    /// Whether that segment starts where the one before ends.
    goes_on: bool,
    depth: Range,
    kind: Kind,
}

#[derive(Debug, Clone, Copy)]
enum Kind {
    /// It is drawn by leaving a diamond.
    Aliased(Diamond, Crossing),
    /// It covers a share of the pixel.
    Share([f64; 2]),
    /// It covers the centre, or lies near it.
    Face(Near),
}

/// A picture at work.
struct Overlay<'a> {
    view: &'a View<'a>,
    guess: &'a Guess,
    settings: &'a Settings,
    depths: &'a Depths<'a>,
    composer: Composer<'a>,
    ground: GroundPaint<'a>,
}

/// A segment on the screen, ready for its fragments.
struct Ready {
    line: ScreenLine,
    segment: u32,
    goes_on: bool,
    count: Option<Count>,
}

/// More paints of a pixel are not told one by one.
const MOST_PAINTS: usize = 12;

/// Pieces of fills that are looked at at a time.
const PIECES: usize = 1024;

/// By how much shares of places near a centre may be off when they are added up.
const NEXT_TO_ALL: f64 = 1e-6;

/// Widths of metres that are this near to halfway between two whole numbers of pixels may be rounded to either.
const HALFWAY: f64 = 1e-4;

impl Overlay<'_> {
    fn judged(&self, seen: &Buffer<Vec<Moved>>, (strips, fills): (&[LineStrip], &[FillPiece])) -> Judged {
        let (width, height) = (seen.width(), seen.height());
        let found = parallel::map_indices(strips.len(), |k| self.fragments(k as u32, &strips[k]));
        let mut of_pixels: Vec<Vec<Fragment>> = vec![Vec::new(); width * height];
        let faces: Vec<&[FillPiece]> = fills.chunks(PIECES).collect();
        let faces = parallel::map(&faces, |pieces| self.fragments_of_fills(pieces));
        for (pixel, fragment) in found.into_iter().chain(faces).flatten() {
            of_pixels[pixel].push(fragment);
        }
        of_pixels.iter_mut().for_each(|fragments| fragments.sort_by_key(|fragment| fragment.item));
        let told = |share: f64| (self.view.progress)(0.5 + 0.5 * share);
        let ranges =
            parallel::map_telling(width * height, &told, |k| self.range(&of_pixels[k], &seen.values()[k]));
        let ranges: Buffer<PixelRange> = Buffer::from_values(width, height, ranges);
        let centres = seen.values().iter().map(|of| self.seen(of)).collect();
        let centres: Buffer<Seen> = Buffer::from_values(width, height, centres);
        (
            pictures::hypothesis(self.guess.name.clone(), &ranges),
            stages(&centres),
            pictures::feature_runs(&ranges, &self.view.stage.draw_list),
        )
    }

    /// The triangles and view depths of a centre, as the mesh is and as it is moved.
    fn seen(&self, of: &[Moved]) -> Seen {
        let view_depth = |depth: f64| {
            let found = self.depths.view_depth(depth);
            if found.is_finite() && found > 0.0 { found } else { f64::INFINITY }
        };
        let low = of.iter().map(|moved| math::min(moved.own[0], moved.depth[0])).map(view_depth);
        let high = of.iter().map(|moved| math::max(moved.own[1], moved.depth[1])).map(view_depth);
        let depth = (low.fold(f64::INFINITY, math::min), high.fold(f64::NEG_INFINITY, math::max));
        Seen::any_of(of.iter().map(|moved| moved.triangle).collect(), depth)
    }

    /// How wide a strip is, pixels: where it comes nearest to the eye. And by how much that may be off.
    fn width(&self, strip: &LineStrip) -> (f64, f64) {
        let frame = self.view.frame;
        let nearest = || {
            let sizes = strip.segments.iter().flatten().map(|at| frame.pixel_m(*at));
            sizes.fold(f64::INFINITY, math::min)
        };
        let stroke = self.view.stage.draw_list.style_of(strip.item).stroke.map(|line| line.width);
        let (width, doubt) = match (self.settings.widths, stroke) {
            (Widths::One, _) | (_, None) => (1.0, 0.0),
            (Widths::Style, Some(Width::Pixels(width))) => (width, 0.0),
            (Widths::Style, Some(Width::Metres(width))) => (width / nearest(), HALFWAY),
        };
        (math::min(width, self.view.stage.scene.device.max_line_width_px), doubt)
    }

    /// The fragments that a strip may have, with their pixels.
    fn fragments(&self, number: u32, strip: &LineStrip) -> Vec<(usize, Fragment)> {
        let (width, doubt) = self.width(strip);
        let whole = [width - doubt, width + doubt].map(|width| (width.round() as u32).max(1));
        let mut out = Vec::new();
        for ready in self.ready(strip, whole) {
            let line = &ready.line;
            let mut kinds: Vec<(Diamond, Known)> = diamonds(line, whole[0]);
            if whole[0] < whole[1] {
                kinds.extend(diamonds(line, whole[1]));
                kinds.iter_mut().for_each(|(_, known)| *known = Known::Open);
            }
            let reach = width / 2.0 + 2.0;
            self.for_each_pixel(line, reach, &mut |pixel| {
                let centre = Plan::new(pixel[0] as f64 + 0.5, pixel[1] as f64 + 0.5);
                let mut add = |kind: Kind| {
                    let fragment = Fragment {
                        item: strip.item,
                        strip: number,
                        segment: ready.segment,
                        goes_on: ready.goes_on,
                        depth: line.depth_at(centre),
                        kind,
                    };
                    out.push((pixel[1] * self.view.frame.width() + pixel[0], fragment));
                };
                if self.settings.lines == Lines::Antialiased {
                    let share = share(line, width, pixel);
                    if share[1] > 0.0 {
                        add(Kind::Share(share));
                    }
                    return;
                }
                let is_on = ready.count.map_or(Known::In, |count| count.is_on(pixel, self.settings));
                for (diamond, known) in &kinds {
                    if let Some(crossing) = Crossing::new(line, centre, *diamond) {
                        let is_drawn = known.and(is_on);
                        add(Kind::Aliased(*diamond, crossing.drawn(is_drawn)));
                    }
                }
            });
        }
        out
    }

    /// The fragments that pieces of fills may have, with their pixels.
    fn fragments_of_fills(&self, pieces: &[FillPiece]) -> Vec<(usize, Fragment)> {
        let frame = self.view.frame;
        let (size, planes) = ([frame.width(), frame.height()], [frame.near(), frame.far()]);
        let mut out = Vec::new();
        for piece in pieces {
            let of = (&piece.corners[..], piece.triangle);
            let Some(face) = ScreenFace::new(self.depths, of, planes, self.guess.envelope.shift()) else {
                continue;
            };
            face.for_each_centre(size, &mut |pixel, near| {
                let depth = face.depth_at((self.depths, frame), pixel, near.may_turn);
                let (item, kind) = (piece.item, Kind::Face(near));
                let fragment = Fragment { item, strip: 0, segment: 0, goes_on: false, depth, kind };
                out.push((pixel[1] * size[0] + pixel[0], fragment));
            });
        }
        out
    }

    /// The segments of a strip that is so wide on the screen.
    fn ready(&self, strip: &LineStrip, widths: [u32; 2]) -> Vec<Ready> {
        let frame = self.view.frame;
        let planes = [frame.near(), frame.far()];
        let is_stippled = self.settings.stipple != 0xffff;
        let mut out: Vec<Ready> = Vec::with_capacity(strip.segments.len());
        for (segment, ends) in (0..).zip(&strip.segments) {
            let Some(line) = ScreenLine::new(self.depths, *ends, planes, self.guess.envelope.shift()) else {
                continue;
            };
            let goes_on = out
                .last()
                .is_some_and(|before| before.segment + 1 == segment && before.line.ends[1] == line.ends[0]);
            let before = out.last().and_then(|before| before.count);
            let start = before
                .filter(|_| self.settings.primitives == Primitives::Strips)
                .map_or([0; 2], |of| of.end());
            let count = is_stippled.then(|| Count::new(&line, widths, start));
            out.push(Ready { line, segment, goes_on, count });
        }
        out
    }

    /// Calls `visit` with the pixels of the picture that lie near a segment.
    fn for_each_pixel(&self, line: &ScreenLine, reach: f64, visit: &mut dyn FnMut([usize; 2])) {
        let frame = self.view.frame;
        let [a, b] = line.ends;
        let range = |a: f64, b: f64, count: usize| {
            // Casts saturate.
            let from = (math::min(a, b) - reach).floor() as usize;
            from..((math::max(a, b) + reach).ceil() as usize).min(count)
        };
        let along = b - a;
        let length = along.length();
        let (columns, rows) = (range(a.x, b.x, frame.width()), range(a.y, b.y, frame.height()));
        for y in rows {
            for x in columns.clone() {
                let from = Plan::new(x as f64 + 0.5, y as f64 + 0.5) - a;
                // Wide lines are wide along an axis.
                if along.perp_dot(from).abs() <= (reach + 1.0) * length * std::f64::consts::SQRT_2 {
                    visit([x, y]);
                }
            }
        }
    }

    /// What a pixel may be.
    fn range(&self, fragments: &[Fragment], seen: &[Moved]) -> PixelRange {
        let mut all: Option<Composed> = None;
        let mut blends = 1;
        for moved in seen {
            let laid = self.laid(fragments, moved);
            let is_translucent = |of: &Laid| {
                let style = self.view.stage.draw_list.style_of(of.item);
                style.paint.0[3] < 1.0 || style.group.is_some() || of.share[0] < 1.0
            };
            let times: u32 = laid.iter().filter(|of| is_translucent(of)).map(|of| of.most).sum();
            blends = blends.max(times);
            let ground = match moved.triangle {
                SKY => self.composer.compositor.paint(self.view.stage.scene.image.background),
                triangle => self.ground.at(triangle, Plan::default()),
            };
            let composed = self.composer.over(PaintRange::exact(ground), &laid);
            match &mut all {
                None => all = Some(composed),
                Some(known) => known.join(composed),
            }
        }
        let mut all = all.unwrap_or(Composed { range: PaintRange::ANY, each: Vec::new() });
        if all.each.len() > MOST_PAINTS {
            all.each.clear();
        }
        let mut items: Vec<u32> = fragments.iter().map(|fragment| fragment.item).collect();
        items.dedup();
        let roundings = if self.guess.has_coarse_blends { 3 } else { 1 };
        let slack = BLEND * f64::from(roundings * blends.min(MOST_BLENDS));
        PixelRange::of_composed(&all, items, slack, &self.composer.compositor)
    }

    /// What is laid over a triangle: of each item all its fragments together, as nothing of another item comes between.
    fn laid(&self, fragments: &[Fragment], moved: &Moved) -> Vec<Laid> {
        let passes = |depth: Range| match moved.triangle {
            SKY => Known::In,
            _ if depth[1] < moved.depth[0] => Known::In,
            _ if depth[0] > moved.depth[1] => Known::Out,
            _ => Known::Open,
        };
        let of_item = |of: &[Fragment]| -> Laid {
            let (mut share, mut faces, mut turns) = ([0.0; 2], [[0.0; 2]; 2], false);
            let mut aliased: Vec<(u32, Diamond, u32, bool, Crossing)> = Vec::new();
            for one in of {
                match (one.kind, passes(one.depth)) {
                    (_, Known::Out) => {}
                    (Kind::Share([least, most]), passes) => {
                        share[0] += if passes == Known::In { least } else { 0.0 };
                        share[1] += most;
                    }
                    (Kind::Face(near), passes) => {
                        let sheets = &mut faces[usize::from(near.is_clockwise)];
                        sheets[0] += if passes == Known::In { near.share } else { 0.0 };
                        sheets[1] += near.share;
                        // Over itself and what it was beside.
                        turns |= near.may_turn;
                    }
                    (Kind::Aliased(diamond, crossing), passes) => {
                        let is_drawn = crossing.is_drawn.and(passes);
                        let crossing = crossing.drawn(is_drawn);
                        aliased.push((one.strip, diamond, one.segment, one.goes_on, crossing));
                    }
                }
            }
            if matches!(of[0].kind, Kind::Face(_)) {
                // What has all places near the centre covers it.
                let least: f64 = faces.iter().map(|sheets| (sheets[0] + NEXT_TO_ALL).floor()).sum();
                let most: f64 = faces.iter().map(|sheets| (sheets[1] - NEXT_TO_ALL).ceil()).sum();
                let [least, most] = [least as u32, most as u32 + if turns { 2 } else { 0 }];
                return Laid { item: of[0].item, least, most, share: [1.0; 2] };
            }
            if self.settings.lines == Lines::Antialiased {
                let share = share.map(|share| math::min(share, 1.0));
                return Laid { item: of[0].item, least: 1, most: 1, share };
            }
            aliased.sort_by_key(|(strip, diamond, segment, ..)| (*strip, *diamond, *segment));
            let [least, most] = aliased
                .chunk_by(|a, b| (a.0, a.1, a.2 + 1) == (b.0, b.1, b.2) && b.3)
                .map(|run| often(&run.iter().map(|of| of.4).collect::<Vec<_>>()))
                .fold([0; 2], |sum, of| [sum[0] + of[0], sum[1] + of[1]]);
            Laid { item: of[0].item, least, most, share: [1.0; 2] }
        };
        let laid = fragments.chunk_by(|a, b| a.item == b.item).map(of_item);
        laid.filter(|of| of.most > 0 && of.share[1] > 0.0).collect()
    }
}

/// More blends do not add up: their roundings are as likely to cancel.
const MOST_BLENDS: u32 = 4;
