//! A picture of dynamic lines: what centres see, which lines hold them, the filter over it.

use super::filter::{Candidates, Filtered, Picture};
use super::lines::{Held, Lines, Place};
use super::order::{merged, once_each, unsorted};
use super::patch::Patch;
use crate::allowed::composition::{Composed, Composer, Laid};
use crate::allowed::model::{Guess, Judged, View};
use crate::allowed::pixel::{BLEND, ColorRange, PixelRange, widened};
use crate::allowed::stages::stages;
use crate::allowed::surface::{Surface, Surfaces, surfaces};
use crate::allowed::{picture, static_decal};
use crate::buffer::Buffer;
use crate::certainty::{Known, PaintRange};
use crate::compare::Hypothesis;
use crate::error::{Error, Result};
use crate::math;
use crate::parallel;
use crate::resolve::{Compositor, Paint};
use crate::scene::Width;
use crate::space::{Plan, World};
use crate::technique::dynamic_line::{Antialiasing, Corners, Settings, Simplification, Sorting, ThinLines};
use crate::technique::static_decal as decals;
use crate::terrain::{Mesh, SKY};

/// What a picture may be.
///
/// # Errors
/// When nobody knows what some setting draws.
pub(in crate::allowed) fn picture(view: &View, guess: &Guess) -> Result<(Judged, Option<Hypothesis>)> {
    let stage = view.stage;
    let settings: Settings = stage.scene.technique.get();
    supported(&settings)?;
    let list = &stage.draw_list;
    let is_static =
        |item: u32| !matches!(list.style_of(item).stroke.map(|line| line.width), Some(Width::Pixels(_)));
    let has_statics = list.numbered().any(|(item, _)| is_static(item));
    let strokes = match has_statics {
        true => {
            let of_decals: decals::Settings = stage.scene.technique.get();
            Some(static_decal::strokes_in_metres(&of_decals, list)?)
        }
        false => None,
    };
    let surfaces = surfaces(view, guess, (strokes, 1.0));
    let thin = Thin::of(&settings, view);
    let frame = Frame {
        view,
        guess,
        mesh: &stage.mesh_for(view.frame),
        lines: Lines::new(view, guess, &settings, thin != Thin::Nothing),
        composer: Composer::new(&stage.scene, list),
        settings,
        thin,
        surfaces,
    };
    Ok(frame.judged())
}

fn supported(settings: &Settings) -> Result<()> {
    let unknown = |setting: &str, instead: &str| {
        Err(Error::unsupported(format!("nobody knows what dynamic-line's picture may be with {setting}"))
            .help(format!(
                "use technique.dynamic-line.{instead}, or judge it by its picture and a tolerance"
            )))
    };
    if settings.simplification == Simplification::ScreenError {
        return unknown("simplification = \"screen-error\"", "simplification = \"same-pixel\"");
    }
    if settings.corners == Corners::Style {
        return unknown("corners = \"style\"", "corners = \"round\"");
    }
    if settings.antialiasing == Antialiasing::Analytic {
        return unknown("antialiasing = \"analytic\"", "antialiasing = \"fxaa\"");
    }
    Ok(())
}

/// What is done about thin lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Thin {
    Nothing,
    /// Pixels near a segment's picture are in the line.
    Near,
    /// Those of them that do not hide the segment.
    NearAndSeen,
}

/// The cosine of ten degrees: how far from straight down a view is top-down.
const TOP_DOWN: f64 = 0.984_807_753_012_208;

impl Thin {
    fn of(settings: &Settings, view: &View) -> Self {
        match settings.thin_lines {
            ThinLines::Correction if view.frame.forward().z <= -TOP_DOWN => Self::Near,
            ThinLines::SecondDepth => Self::NearAndSeen,
            ThinLines::Correction | ThinLines::None => Self::Nothing,
        }
    }
}

/// A picture at work.
struct Frame<'a> {
    view: &'a View<'a>,
    guess: &'a Guess,
    mesh: &'a Mesh,
    settings: Settings,
    thin: Thin,
    lines: Lines,
    composer: Composer<'a>,
    surfaces: Surfaces,
}

/// What a pixel may be before it is smoothed.
#[derive(Debug, Clone, Default)]
struct Unsmoothed {
    /// Around all paints.
    around: Option<PaintRange>,
    /// All paints there are, those with the fewest items first; none where they are too many.
    each: Vec<PaintRange>,
    items: Vec<u32>,
}

/// More paints of a pixel are not told one by one.
const MOST_PAINTS: usize = 12;

impl Frame<'_> {
    /// What the picture may be; where it is smoothed, also what it may be if the filter reads rounded pixels.
    fn judged(&self) -> (Judged, Option<Hypothesis>) {
        let (width, height) = (self.view.frame.width(), self.view.frame.height());
        let told = |share: f64| (self.view.progress)(0.5 + 0.3 * share);
        let rows = parallel::map_telling(height, &told, |y| {
            (0..width).map(|x| self.unsmoothed([x, y])).collect::<Vec<_>>()
        });
        let pixels: Vec<Unsmoothed> = rows.into_iter().flatten().collect();
        let buffer =
            |ranges: Vec<PixelRange>| -> Buffer<PixelRange> { Buffer::from_values(width, height, ranges) };
        let is_smoothed = self.settings.antialiasing == Antialiasing::Fxaa;
        let ranges = match is_smoothed {
            true => buffer(self.smoothed(&pixels, &Unsmoothed::candidates)),
            false => buffer(pixels.iter().map(|of| of.range(&self.composer.compositor)).collect()),
        };
        let rounded = is_smoothed.then(|| {
            let ranges = self.smoothed(&pixels, &|of, compositor| of.candidates(compositor).rounded());
            picture::hypothesis(format!("{}-8-bit-before-filter", self.guess.name), &buffer(ranges))
        });
        let judged = (
            picture::hypothesis(self.guess.name.clone(), &ranges),
            stages(&self.surfaces.seen),
            picture::feature_runs(&ranges, &self.view.stage.draw_list),
        );
        (judged, rounded)
    }

    /// What a pixel may be of all that its centre may see.
    fn unsmoothed(&self, pixel: [usize; 2]) -> Unsmoothed {
        let mut all = Unsmoothed::default();
        let mut has_all = true;
        for surface in self.surfaces.of.at(pixel[0], pixel[1]) {
            let laid = self.laid(surface, pixel);
            let composed = match laid {
                None => Composed { range: surface.paint, each: vec![surface.paint] },
                Some(laid) => {
                    all.items.extend(laid.iter().flatten().map(|one| one.item));
                    let each = laid.iter().map(|laid| self.composer.over(surface.ground, laid));
                    joined(each)
                }
            };
            all.items.extend(surface.items.iter().flatten().map(|(item, _)| *item));
            all.around = Some(all.around.map_or(composed.range, |around| around.hull(&composed.range)));
            has_all &= !composed.each.is_empty();
            for paint in composed.each {
                if !all.each.contains(&paint) {
                    all.each.push(paint);
                }
            }
        }
        if !has_all || all.each.len() > MOST_PAINTS {
            all.each.clear();
        }
        all.items.sort_unstable();
        all.items.dedup();
        all
    }

    /// What is laid on a surface, in each order that it may be laid in; `None`: no line is near.
    fn laid(&self, surface: &Surface, pixel: [usize; 2]) -> Option<Vec<Vec<Laid>>> {
        let centre = Plan::new(pixel[0] as f64 + 0.5, pixel[1] as f64 + 0.5);
        if surface.triangle == SKY {
            return None;
        }
        let patch = Patch::new(self.view, self.guess, self.mesh, surface, pixel);
        if !self.lines.may_reach(&patch.bounds(), centre) {
            return None;
        }
        let is_seen = |at: World| match self.thin {
            Thin::NearAndSeen => self.is_seen(at, pixel),
            _ => Known::In,
        };
        let is_seen: &dyn Fn(World) -> Known = &is_seen;
        let place = Place { patch: &patch, centre, is_seen: (self.thin != Thin::Nothing).then_some(is_seen) };
        let held = self.lines.holding(&place);
        if held.is_empty() {
            return None;
        }
        let statics: Vec<Laid> = match &surface.items {
            Some(items) => items.iter().map(|(item, known)| Laid::once(*item, *known)).collect(),
            // There are too many to have been told: whatever they are, they lie somewhere between.
            None => return Some(vec![self.anything(&held)]),
        };
        let overlaps = self.settings.overlaps;
        Some(match self.settings.sorting {
            Sorting::Selection => vec![merged(&once_each(&held, overlaps), &statics)],
            Sorting::None => unsorted(&held, overlaps).iter().map(|lines| merged(lines, &statics)).collect(),
        })
    }

    /// Any of all items, any number of times.
    fn anything(&self, held: &[Held]) -> Vec<Laid> {
        const OFTEN: u32 = 8;
        let count = self.view.stage.draw_list.items().len() as u32;
        let of = |item: u32| Laid { most: OFTEN, ..Laid::once(item, Known::Open) };
        (0..count.min(64)).map(of).chain(held.iter().map(|held| of(held.item))).collect()
    }

    /// Whether the surface under a place of a segment is no deeper than what a pixel and those around it see of the terrain.
    fn is_seen(&self, at: World, [x, y]: [usize; 2]) -> Known {
        let Some(height) = self.view.stage.mesh.height_at(at.plan()) else { return Known::Out };
        let under = World::new(at.x, at.y, height);
        let depth = self.view.frame.depth(under);
        let doubt = self.guess.envelope.along(self.view.frame, depth)
            + 8.0 * self.guess.envelope.single() * self.view.frame.pixel_m(under);
        let of = &self.surfaces.of;
        let (columns, rows) =
            (x.saturating_sub(1)..(x + 2).min(of.width()), y.saturating_sub(1)..(y + 2).min(of.height()));
        let around = rows.flat_map(|y| columns.clone().map(move |x| of.at(x, y)));
        let (mut may_be, mut is_sure) = (false, false);
        for seen in around {
            let on_terrain = || seen.iter().filter(|surface| surface.triangle != SKY);
            may_be |= on_terrain().any(|surface| surface.depth.1 >= depth - doubt);
            is_sure |= on_terrain().count() == seen.len()
                && seen.iter().all(|surface| surface.depth.0 > depth + doubt);
        }
        match (is_sure, may_be) {
            (true, _) => Known::In,
            (_, true) => Known::Open,
            _ => Known::Out,
        }
    }

    /// All pixels after the filter.
    fn smoothed(
        &self,
        pixels: &[Unsmoothed],
        candidates: &dyn Fn(&Unsmoothed, &Compositor) -> Candidates,
    ) -> Vec<PixelRange> {
        let (width, height) = (self.view.frame.width(), self.view.frame.height());
        let read = pixels.iter().map(|of| candidates(of, &self.composer.compositor)).collect();
        let weight = 0.5 / f64::from(1u32 << self.guess.envelope.filter_bits);
        let picture = Picture { size: [width, height], pixels: read, weight };
        let told = |share: f64| (self.view.progress)(0.8 + 0.2 * share);
        let rows = parallel::map_telling(height, &told, |y| {
            (0..width)
                .map(|x| {
                    let own = &pixels[y * width + x];
                    PixelRange { items: own.items.clone(), ..of_filtered(&picture.filtered([x, y])) }
                })
                .collect::<Vec<_>>()
        });
        rows.into_iter().flatten().collect()
    }
}

impl Unsmoothed {
    /// As it is judged: its list is composed by one program (4.4.2), and rounded once.
    fn range(&self, compositor: &Compositor) -> PixelRange {
        let of = Composed { range: self.around.unwrap_or(PaintRange::ANY), each: self.each.clone() };
        PixelRange::of_composed(&of, self.items.clone(), BLEND, compositor)
    }

    /// What the filter may read.
    fn candidates(&self, compositor: &Compositor) -> Candidates {
        let premultiplied = |paint: [f64; 4]| {
            let [r, g, b, a] = compositor.encoded(Paint(paint));
            [r * a, g * a, b * a, a]
        };
        let is_exact = |paint: &PaintRange| paint.low == paint.high;
        if self.each.is_empty() || !self.each.iter().all(is_exact) {
            let around = self.around.unwrap_or(PaintRange::ANY);
            // Each channel grows with its own, whatever the alpha does.
            return Candidates::Between([premultiplied(around.low), premultiplied(around.high)]);
        }
        Candidates::Each(self.each.iter().map(|paint| premultiplied(paint.low)).collect())
    }
}

/// What is composed in one of several orders.
fn joined(all: impl Iterator<Item = Composed>) -> Composed {
    let whole = |mut known: Composed, one: Composed| {
        known.join(one);
        known
    };
    all.reduce(whole).unwrap_or(Composed { range: PaintRange::ANY, each: Vec::new() })
}

/// A filtered pixel as it is judged: rounded.
fn of_filtered(filtered: &Filtered) -> PixelRange {
    let slack = BLEND;
    let straight = |[r, g, b, a]: [f64; 4]| {
        let by = |v: f64| if a > 0.0 { math::min(v / a, 1.0) } else { 0.0 };
        [by(r), by(g), by(b), a]
    };
    match filtered {
        Filtered::Between([low, high]) => {
            // A straight channel falls as the alpha grows.
            let ends = |of: &[f64; 4], alpha: f64, none: f64| -> [f64; 4] {
                std::array::from_fn(|c| match c {
                    3 => of[3],
                    _ if alpha > 0.0 => math::min(of[c] / alpha, 1.0),
                    _ => none,
                })
            };
            let all = widened([ends(low, high[3], 0.0), ends(high, low[3], 1.0)], slack);
            PixelRange { all, ..PixelRange::default() }
        }
        Filtered::Each(each) => {
            let each: Vec<(ColorRange, [f64; 4])> = each
                .iter()
                .map(|(color, weight)| (widened([straight(*color); 2], slack + weight), straight(*color)))
                .collect();
            let all = each.iter().skip(1).fold(each[0].0, |all, (of, _)| {
                let least = std::array::from_fn(|c| math::min(all[0][c], of[0][c]));
                [least, std::array::from_fn(|c| math::max(all[1][c], of[1][c]))]
            });
            let is_open = each.len() > 1;
            let extremes = is_open.then(|| [each[0].1, each[each.len() - 1].1]);
            let choices = if is_open { each.into_iter().map(|(of, _)| of).collect() } else { Vec::new() };
            PixelRange { all, choices, extremes, items: Vec::new() }
        }
    }
}
