//! What stays the same for all pixels of a picture: footprints, paints, the budget.

use super::Budget;
use super::form::{Line, Side};
use super::shape::PixelGround;
use crate::certainty::PaintRange;
use crate::footprint::{Footprints, HalfPlane, PixelSize};
use crate::interval::Ball;
use crate::resolve::{Compositor, GroundPaint, Paint};
use crate::scene::{BlendMode, Color, GroundColors, Group, Imagery, Scene};
use crate::space::Plan;
use crate::terrain::Mesh;
use std::ops::RangeInclusive;

/// Texels that a piece's bounds are taken over one by one.
const MOST_TEXELS: usize = 64;

pub(super) struct Setting<'a> {
    pub(super) budget: Budget,
    /// Whether items are told below an opaque one too.
    tells_hidden: bool,
    pub(super) footprints: &'a Footprints<'a>,
    /// Whether the footprints have the edges between any two places that are seen: what is seen of the plan is convex, but for what hides it.
    /// (A globe's leaves in a view are not.)
    pub(super) knows_between: bool,
    pub(super) pixel_size: PixelSize,
    pub(super) compositor: Compositor,
    pub(super) mode: BlendMode,
    /// The paint of each style of items.
    paints: Vec<Paint>,
    pub(super) sky: Paint,
    /// Around the colours of all styles at full alpha, which any number of items tends to; `None`: there is no item.
    crowd: Option<PaintRange>,
    ground: GroundPaint<'a>,
    /// Where the ground's colours are texels: these, and a range around the paints of all in any light.
    texels: Option<(&'a Imagery, PaintRange)>,
}

impl<'a> Setting<'a> {
    pub(super) fn new(
        scene: &'a Scene,
        mesh: &'a Mesh,
        (footprints, pixel_size): (&'a Footprints<'a>, PixelSize),
        budget: Budget,
    ) -> Self {
        let compositor = Compositor::new(scene.compositing);
        let ground = GroundPaint::new(&scene.ground, mesh, compositor);
        let texels = match &scene.ground.colors {
            GroundColors::Constant(_) => None,
            GroundColors::Imagery(imagery) => {
                let texels = imagery.texels.values().iter().map(|c| PaintRange::exact(compositor.paint(*c)));
                let mut all = texels.reduce(|a, b| a.hull(&b)).unwrap_or(PaintRange::ANY);
                if ground.is_lit() {
                    // A shadow is as black as can be, and takes nothing of the alpha.
                    all.low = [0.0, 0.0, 0.0, all.low[3]];
                }
                Some((imagery, all))
            }
        };
        let styles = || footprints.list().styles().iter();
        let paints = styles().map(|style| compositor.paint(style.paint)).collect();
        let crowd = styles().map(|style| PaintRange::exact(compositor.paint(opaque(style.paint))));
        let crowd = crowd.reduce(|a, b| a.hull(&b));
        let sky = compositor.paint(scene.image.background);
        let mode = scene.compositing.mode;
        let tells_hidden = budget.coverage;
        Self {
            budget,
            tells_hidden,
            footprints,
            knows_between: mesh.heights().is_some(),
            pixel_size,
            compositor,
            mode,
            paints,
            sky,
            crowd,
            ground,
            texels,
        }
    }

    /// The same without what lies below opaque items.
    pub(super) fn of_what_shows(self) -> Self {
        Self { tells_hidden: false, ..self }
    }

    /// The paint of an item.
    #[inline]
    pub(super) fn paint_of(&self, item: u32) -> Paint {
        self.paints[self.footprints.list().items()[item as usize].style as usize]
    }

    /// What an item is composed with first.
    #[inline]
    pub(super) fn group_of(&self, item: u32) -> Option<Group> {
        self.footprints.list().style_of(item).group
    }

    /// Whether nothing below an item matters where it is.
    pub(super) fn hides(&self, item: u32) -> bool {
        let is_opaque = self.paint_of(item).0[3] == 1.0 && self.group_of(item).is_none();
        is_opaque && self.mode == BlendMode::Over && !self.tells_hidden
    }

    /// The paint of a piece that may lie in any number of any items.
    pub(super) fn crowd_paint(&self, ground: &PixelGround, piece: &[[f64; 2]]) -> PaintRange {
        let (base, _) = self.ground_paint(ground, piece, &mut 0.0);
        self.crowd.map_or(base, |crowd| base.under_any_of(&crowd, self.mode))
    }

    /// Whether the terrain's own paint differs within a triangle.
    pub(super) fn has_texels(&self) -> bool {
        self.texels.is_some()
    }

    /// The terrain's own paint on a piece, and where to cut it to know more. `slop` grows by what is doubtful.
    pub(super) fn ground_paint(
        &self,
        ground: &PixelGround,
        piece: &[[f64; 2]],
        slop: &mut f64,
    ) -> (PaintRange, Option<Line>) {
        let triangle = ground.facet.id;
        let Some((imagery, all)) = &self.texels else {
            return (PaintRange::exact(self.ground.at(triangle, Plan::default())), None);
        };
        let (columns, rows, cut) = texels_of(imagery, ground, piece, slop);
        let count = (columns.end() - columns.start() + 1) * (rows.end() - rows.start() + 1);
        if count > MOST_TEXELS {
            return (*all, cut);
        }
        let texels = rows.flat_map(|y| columns.clone().map(move |x| (x, y)));
        let paints = texels.map(|(x, y)| self.ground.lit(triangle, *imagery.texels.at(x, y)));
        let range = paints.map(PaintRange::exact).reduce(|a, b| a.hull(&b));
        (range.unwrap_or(*all), cut)
    }
}

fn opaque(color: Color) -> Color {
    let [r, g, b, _] = color.0;
    Color([r, g, b, 1.0])
}

/// The columns and rows of texels that a piece sees, and where to cut it to see fewer.
fn texels_of(
    imagery: &Imagery,
    ground: &PixelGround,
    piece: &[[f64; 2]],
    slop: &mut f64,
) -> (RangeInclusive<usize>, RangeInclusive<usize>, Option<Line>) {
    let (plan, extent, texels) = (ground.plan_box(piece), &imagery.extent, &imagery.texels);
    let east = Axis { origin: extent.min.x, size: extent.max.x - extent.min.x, count: texels.width() };
    let south = Axis { origin: extent.max.y, size: extent.min.y - extent.max.y, count: texels.height() };
    let mut cut = None;
    let columns = east.narrowed(
        east.range(plan.min.x, plan.max.x),
        |k, slop| {
            let line = ground.line(&border(east.border(k), [1.0, 0.0]));
            let side = line.side(piece, slop);
            cut = if side == Side::Both { cut.or(Some(line)) } else { cut };
            side
        },
        slop,
    );
    let rows = south.narrowed(
        south.range(plan.max.y, plan.min.y),
        |k, slop| {
            let line = ground.line(&border(south.border(k), [0.0, -1.0]));
            let side = line.side(piece, slop);
            cut = if side == Side::Both { cut.or(Some(line)) } else { cut };
            side
        },
        slop,
    );
    (columns, rows, cut)
}

/// The half plane beyond a texel border.
fn border(at: Ball, [x, y]: [f64; 2]) -> HalfPlane {
    HalfPlane { at: Plan::default(), normal: [Ball::exact(x), Ball::exact(y)], offset: at * -(x + y) }
}

/// Texels along an axis of the plan.
#[derive(Clone, Copy)]
struct Axis {
    origin: f64,
    /// Negative where texels are counted against the axis.
    size: f64,
    count: usize,
}

impl Axis {
    /// The texels from one coordinate to another; the rim's texels reach beyond the image.
    fn range(&self, from: f64, to: f64) -> RangeInclusive<usize> {
        let place = |v: f64| (v - self.origin) / self.size * self.count as f64;
        // Casts saturate. A texel more on each side makes up for the rounding.
        let (low, high) = ((place(from) - 1e-6) as usize, (place(to) + 1e-6) as usize);
        low.min(self.count - 1)..=high.min(self.count - 1)
    }

    /// The coordinate where texel `k` begins.
    fn border(&self, k: usize) -> Ball {
        let share = Ball::exact(k as f64) * Ball::exact(self.count as f64).recip();
        Ball::exact(self.origin) + share * self.size
    }

    /// Halves a range of texels while a border in its middle has all of the piece on one side.
    fn narrowed(
        &self,
        range: RangeInclusive<usize>,
        mut side_of: impl FnMut(usize, &mut f64) -> Side,
        slop: &mut f64,
    ) -> RangeInclusive<usize> {
        let (mut low, mut high) = range.into_inner();
        while low < high {
            let middle = (low + high).div_ceil(2);
            match side_of(middle, slop) {
                Side::In => low = middle,
                Side::Out => high = middle - 1,
                Side::Both | Side::Unknown => break,
            }
        }
        low..=high
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_half_plane_beyond_a_texels_border_holds_that_texel_and_those_after_it() {
        let east = Axis { origin: -3.0, size: 8.0, count: 4 };
        let south = Axis { origin: 5.0, size: -2.0, count: 4 };
        for (axis, way) in [(east, [1.0, 0.0]), (south, [0.0, -1.0])] {
            let step = axis.size / axis.count as f64;
            for k in 0..axis.count {
                let HalfPlane { at, normal, offset } = border(axis.border(k), way);
                let value = |v: f64| {
                    let off = Plan::new(v, v) - at;
                    normal[0].low() * off.x + normal[1].low() * off.y + offset.low()
                };
                let first = axis.origin + step * k as f64;
                assert_eq!(axis.range(first + 0.5 * step, first + 0.5 * step), k..=k);
                for beyond in [0.5, -0.5] {
                    let found = value(first + beyond * step);
                    assert!((found - beyond * step.abs()).abs() < 1e-9, "{way:?} {k}: {found}");
                }
            }
        }
    }
}
