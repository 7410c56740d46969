//! How far the mean paint of a pixel may be off because borders stray: their lengths, times how far, times how much changes across them.
//!
//! A pixel is looked at in squares. A border counts in those where it may show: not where all that is seen lies in the item that it bounds, or none of it
//! (segments' rectangles meet within their union), and between two triangles of one sheet with no more than their grounds differ by.

use super::plane::Plane;
use super::round::Round;
use super::strips::{BEND, CHORD, Contrast, Off, Strips};
use crate::allowed::envelope::COORDINATES;
use crate::allowed::polygon::{clipped, diameter};
use crate::certainty::Known;
use crate::footprint::{Footprints, HalfPlane, Primitive};
use crate::math;
use crate::scene::Imagery;
use crate::space::{Lens, PlanBox, ViewFrame};
use crate::terrain::{Mesh, SKY, SurfaceTriangle};
use crate::truth::Sample;
use glam::DVec2;
use std::f64::consts::SQRT_2;

/// What single precision does to a place on the screen, as a share of the largest coordinate: four roundings of a vertex, and four of what is calculated from two.
const ROUNDINGS: f64 = 8.0 / (1 << 24) as f64;

/// More borders than this may change all of a square.
const CROWD: usize = 512;

/// Parts of edges that a round border may have in a square.
const CHORDS: f64 = 32.0;

/// A width that may bend by so much of a pixel is not surely taken as linear: a quarter of what the technique puts up with.
const BENT: f64 = 1.0 / 1024.0;

/// Half widths that may grow faster with the distance are not either.
const STEEP: f64 = 0.25;

/// A part of a pixel: a square of the screen, and what a sample anywhere in it may see.
#[derive(Clone, Copy)]
pub(super) struct Square<'s> {
    pub(super) corner: DVec2,
    pub(super) side: f64,
    pub(super) sample: &'s Sample,
}

/// What borders do to a pixel.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Borders {
    /// How far each channel of the mean paint may be off.
    pub(super) doubt: [f64; 4],
    /// Parts of triangles and of texels between them.
    pub(super) parts: f64,
    /// Parts of edges.
    pub(super) edges: f64,
}

/// What borders are found in.
pub(super) struct Counter<'a> {
    pub(super) footprints: &'a Footprints<'a>,
    pub(super) imagery: Option<&'a Imagery>,
    pub(super) mesh: &'a Mesh,
    pub(super) frame: &'a ViewFrame,
    /// How far vertices may stray along each axis at most, pixels.
    pub(super) shift: f64,
}

/// A triangle that a pixel may see.
struct Seen {
    triangle: u32,
    /// Around what is seen of it, in all and by square.
    plan: PlanBox,
    places: Vec<(usize, PlanBox)>,
    /// Its corners' numbers.
    corners: [u32; 3],
    /// `None`: a corner is behind the eye.
    plane: Option<Plane>,
    /// What the pixel and its squares have of it.
    shape: Vec<DVec2>,
    shapes: Vec<Vec<DVec2>>,
    /// Whether a plane of the view cuts it.
    is_cut: bool,
    /// How far straight borders on it may stray.
    off: Off,
}

impl Seen {
    /// Whether it and another one are one sheet along the edge that begins at a corner: both are seen from the same side.
    fn continues_in(&self, edge: usize, other: &Self) -> bool {
        let place = |k: usize| other.corners.iter().position(|corner| *corner == self.corners[k % 3]);
        let (Some(from), Some(to), Some(own), Some(its)) =
            (place(edge), place(edge + 1), &self.plane, &other.plane)
        else {
            return false;
        };
        // Neighbours that turn alike have their edge in opposite directions.
        let is_opposite = (to + 1) % 3 == from;
        let turn = |[a, b, c]: [DVec2; 3]| (b - a).perp_dot(c - a) > 0.0;
        self.triangle != other.triangle && (turn(own.screen) == turn(its.screen)) == is_opposite
    }
}

impl Counter<'_> {
    /// The borders of a pixel that squares cover.
    pub(super) fn borders(&self, corner: DVec2, squares: &[Square]) -> Borders {
        let seen = self.seen(corner, squares);
        let contrasts = squares.iter().map(|of| Contrast::of(of.sample, of.side)).collect();
        let mut strips = Strips::new(contrasts, self.shift);
        let mut all = Borders::default();
        for of in &seen {
            let off = of.off;
            for edge in 0..3 {
                let next = seen.iter().find(|other| of.continues_in(edge, other));
                // The edge between two of a sheet is one.
                if next.is_some_and(|next| next.triangle < of.triangle) {
                    continue;
                }
                let within = |low: DVec2, side: f64| match &of.plane {
                    Some(plane) => {
                        let ends = [plane.screen[edge], plane.screen[(edge + 1) % 3]];
                        diameter(&clipped(&ends, self.grown(low, side)))
                    }
                    None => SQRT_2 * side,
                };
                let parts: Vec<(usize, f64)> = (of.places.iter())
                    .map(|(square, _)| (*square, within(squares[*square].corner, squares[*square].side)))
                    .filter(|(_, length)| *length > 0.0)
                    .collect();
                let whole = within(corner, 1.0);
                match next {
                    Some(_) => strips.add(off, whole, &parts, |contrast| contrast.ground),
                    None => strips.add(off, whole, &parts, |contrast| contrast.all),
                }
                all.edges += f64::from(u8::from(whole > 0.0));
            }
            if of.is_cut {
                let parts: Vec<(usize, f64)> =
                    of.places.iter().map(|(square, _)| (*square, SQRT_2 * squares[*square].side)).collect();
                strips.add(off, SQRT_2, &parts, |contrast| contrast.all);
            }
            let texels = self.imagery.map_or([0.0; 2], |imagery| texel_borders(imagery, &of.plan));
            for (square, plan) in of.places.iter().filter(|_| self.imagery.is_some()) {
                let here = self.imagery.map_or([0.0; 2], |imagery| texel_borders(imagery, plan));
                let length = diameter(&of.shapes[*square]);
                let length = length * (here[0] + here[1]);
                strips.add(off, length, &[(*square, length)], |contrast| contrast.ground);
            }
            all.parts += (1.0 + texels[0]) * (1.0 + texels[1]);
            self.add_features(of, squares, &mut strips, &mut all);
        }
        all.doubt = strips.doubt();
        all
    }

    /// A square, and all from where a border may stray into it.
    fn grown(&self, low: DVec2, side: f64) -> [DVec2; 2] {
        let margin = 2.0 * (self.shift + CHORD + BEND);
        [low - DVec2::splat(margin), low + DVec2::splat(side + margin)]
    }

    /// The triangles that are seen.
    fn seen(&self, corner: DVec2, squares: &[Square]) -> Vec<Seen> {
        let mut all: Vec<Seen> = Vec::new();
        for (number, square) in squares.iter().enumerate() {
            for outcome in square.sample.outcomes.iter().filter(|outcome| outcome.triangle != SKY) {
                let triangle = outcome.triangle;
                let place = match all.iter().position(|of| of.triangle == triangle) {
                    Some(place) => place,
                    None => match self.sight(triangle, corner, squares) {
                        Some(seen) => {
                            all.push(seen);
                            all.len() - 1
                        }
                        None => continue,
                    },
                };
                let of = &mut all[place];
                of.plan.include_box(&outcome.plan);
                match of.places.iter_mut().find(|(square, _)| *square == number) {
                    Some((_, plan)) => plan.include_box(&outcome.plan),
                    None => of.places.push((number, outcome.plan)),
                }
            }
        }
        all
    }

    fn sight(&self, triangle: u32, corner: DVec2, squares: &[Square]) -> Option<Seen> {
        let surface = self.mesh.surface_triangle(triangle)?;
        let corners = self.mesh.corners(triangle)?;
        let plane = Plane::of(self.frame, &surface);
        let shape = |low: DVec2, side: f64| {
            let around @ [low, high] = self.grown(low, side);
            match &plane {
                Some(plane) => clipped(&plane.screen, around),
                None => vec![low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)],
            }
        };
        let crosses = |limit: f64| {
            let is_near = surface.world.map(|p| self.frame.depth(p) < limit);
            is_near[0] != is_near[1] || is_near[1] != is_near[2]
        };
        let is_cut = crosses(self.frame.near()) || crosses(self.frame.far());
        let (shapes, shape) =
            (squares.iter().map(|of| shape(of.corner, of.side)).collect(), shape(corner, 1.0));
        let (places, off) = (Vec::new(), Off::straight(self.stray(&surface, plane.as_ref())));
        Some(Seen { triangle, plan: PlanBox::EMPTY, places, corners, plane, shape, shapes, is_cut, off })
    }

    /// How far what lies on a triangle may stray along each axis, pixels: roundings of places on the screen and in space, and no more than the shift.
    fn stray(&self, surface: &SurfaceTriangle, plane: Option<&Plane>) -> f64 {
        let Some(plane) = plane else { return self.shift };
        let frame = self.frame;
        let picture = DVec2::new(frame.width() as f64, frame.height() as f64);
        let on_screen =
            plane.screen.iter().map(|at| at.abs().max_element()).fold(picture.max_element(), math::max);
        let eye = frame.eye();
        let in_space = surface.world.iter().map(|at| {
            let size = at.to_vec().abs().max_element() + (*at - eye).length();
            COORDINATES * size / frame.pixel_m(*at)
        });
        math::min(ROUNDINGS * on_screen + in_space.fold(0.0, math::max), self.shift)
    }

    /// Counts the borders of items on a triangle.
    fn add_features(&self, of: &Seen, squares: &[Square], strips: &mut Strips, all: &mut Borders) {
        let (mut parts, mut primitives) = (Vec::new(), Vec::new());
        self.footprints.parts_near(&of.plan, |part| {
            parts.push(part);
            parts.len() < CROWD
        });
        if parts.len() >= CROWD {
            of.places.iter().for_each(|(square, _)| strips.open(*square));
            all.edges = f64::INFINITY;
            return;
        }
        // A long part has several boxes.
        parts.sort_unstable();
        parts.dedup();
        for part in parts {
            primitives.clear();
            self.footprints.primitives(part, &mut primitives);
            let shows =
                |square: &&(usize, PlanBox)| may_show(squares[square.0].sample, of.triangle, part.item);
            let places: Vec<(usize, PlanBox)> = of.places.iter().filter(shows).copied().collect();
            // What is painted less than fully changes less.
            let alpha = self.footprints.list().style_of(part.item).paint.0[3];
            for primitive in primitives.iter().filter(|primitive| !primitive.misses(&of.plan)) {
                let mut straight = |side: &HalfPlane, others: &mut dyn Iterator<Item = &HalfPlane>| {
                    let others: Vec<&HalfPlane> = others.collect();
                    let within = |shape: &[DVec2]| match &of.plane {
                        Some(plane) => plane.length_of(side, &others, shape),
                        None => diameter(shape),
                    };
                    let parts: Vec<(usize, f64)> = (places.iter())
                        .filter(|(_, plan)| meets(side, plan))
                        .map(|(square, _)| (*square, within(&of.shapes[*square])))
                        .filter(|(_, length)| *length > 0.0)
                        .collect();
                    let whole = if parts.is_empty() { 0.0 } else { within(&of.shape) };
                    strips.add(of.off, whole, &parts, |contrast| contrast.at_most(alpha));
                };
                match primitive {
                    Primitive::Edge { from, to } => {
                        all.edges += 1.0;
                        let [along, start, end] = Primitive::edge_sides(*from, *to);
                        straight(&along, &mut [&start, &end].into_iter());
                    }
                    Primitive::Convex(shape) => {
                        let sides = shape.sides();
                        for (k, side) in sides.iter().enumerate().filter(|(_, side)| meets(side, &of.plan)) {
                            all.edges += 1.0;
                            let others = sides.iter().enumerate().filter(|(other, _)| *other != k);
                            straight(side, &mut others.map(|(_, side)| side));
                        }
                    }
                    // Widths whose scales are not 1, in pixels on globes, the technique refuses.
                    Primitive::Near { from, to, reach, growth, .. } => {
                        let round = Round { ends: [*from, *to], reach: *reach, growth: *growth };
                        self.add_round(&round, (of, &places, alpha), strips, all);
                    }
                    // It may be there or not.
                    Primitive::Perhaps(_) => of.places.iter().for_each(|(square, _)| strips.open(*square)),
                }
            }
        }
    }

    /// Whether a width in pixels, taken as linear in what a pixel has of a triangle, may be off by more than programs put up with.
    fn bends(&self, round: &Round, of: &Seen, plane: &Plane) -> bool {
        let Lens::Central { pixel } = self.frame.lens() else { return false };
        let across = (of.plan.max - of.plan.min).length();
        let middle = plane.see(of.plan.min + (of.plan.max - of.plan.min) * 0.5);
        // A distance has second derivatives of at most its reciprocal, and a pixel is at least so wide at it.
        let nearest = math::max((middle - self.frame.eye()).length() - across, self.frame.near());
        let bend = round.growth * across * across / (8.0 * nearest);
        bend > BENT * nearest * pixel || round.growth > STEEP
    }

    /// Counts a round border.
    fn add_round(
        &self,
        round: &Round,
        (of, places, alpha): (&Seen, &[(usize, PlanBox)], f64),
        strips: &mut Strips,
        all: &mut Borders,
    ) {
        let Some(plane) = &of.plane else {
            all.edges += CHORDS;
            return places.iter().for_each(|(square, _)| strips.open(*square));
        };
        let border = |plan: &PlanBox, shape: &[DVec2]| round.border((self.frame, plane), plan, shape, of.off);
        let Some((whole, off)) = border(&of.plan, &of.shape) else { return };
        // Where a width in pixels bends, a program samples the pixel.
        all.edges += if self.bends(round, of, plane) { f64::INFINITY } else { CHORDS };
        let parts: Vec<(usize, f64)> = (places.iter())
            .filter_map(|(square, plan)| Some((*square, border(plan, &of.shapes[*square])?.0)))
            .collect();
        strips.add(off, whole, &parts, |contrast| contrast.at_most(alpha));
    }
}

/// Whether an item's border may show in what a sample sees of a triangle: not where the item holds all of it, nor where it holds none.
fn may_show(sample: &Sample, triangle: u32, item: u32) -> bool {
    let mut outcomes = sample.outcomes.iter().filter(|outcome| outcome.triangle == triangle);
    let known = |items: &Option<Vec<(u32, Known)>>| match items {
        Some(items) => items.iter().find(|(of, _)| *of == item).map_or(Known::Out, |(_, known)| *known),
        None => Known::Open,
    };
    let Some(first) = outcomes.next().map(|outcome| known(&outcome.items)) else { return true };
    first == Known::Open || outcomes.any(|outcome| known(&outcome.items) != first)
}

/// The most borders between texels that a box of the plan has along each axis.
fn texel_borders(imagery: &Imagery, plan: &PlanBox) -> [f64; 2] {
    let (extent, texels) = (imagery.extent.max - imagery.extent.min, &imagery.texels);
    let size = plan.max - plan.min;
    let along = |size: f64, extent: f64, count: usize| {
        math::min((size / extent * count as f64).ceil() + 1.0, count as f64)
    };
    [along(size.x, extent.x, texels.width()), along(size.y, extent.y, texels.height())]
}

/// Whether a half plane's border may run through a box.
fn meets(side: &HalfPlane, plan: &PlanBox) -> bool {
    let beyond = HalfPlane { normal: side.normal.map(|n| -n), offset: -side.offset, ..*side };
    !side.excludes(plan) && !beyond.excludes(plan)
}
