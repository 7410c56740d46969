//! How near a decision was: how far a sample lies from where the answer would be another, and which machines may find another.

use super::bench::{Bench, Near, Seen, Step};
use crate::footprint::{HalfPlane, Primitive};
use crate::holding::Nearby;
use crate::math;
use crate::space::{Plan, PlanBox};
use crate::visibility::PixelFootprint;
use glam::{DMat2, DVec2};
use serde::Serialize;

/// Borders farther away than this are not looked for, pixels.
const REACH: f64 = 1.5;

/// A step over a border, pixels: the answer has to be another on its two sides.
const OVER: f64 = 1e-5;

/// Where more parts of borders than this are near, the rest is not looked at.
const MOST_PARTS: usize = 512;

/// How far a sample is from the border of an item.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Margin {
    /// The item's number in the draw list.
    pub item: u32,
    /// What it is called.
    pub name: String,
    /// Whether the sample lies in it.
    pub is_inside: bool,
    /// How far its border is from the sample on the screen, pixels.
    pub pixels: f64,
    /// Where it lies from there: `left`, `below right`, ...
    pub toward: &'static str,
    /// What may flip it: `single precision`, `a snap to 1/16 px`, ...
    pub flipped_by: Vec<&'static str>,
}

/// Where something else is seen: a silhouette near a sample.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Silhouette {
    /// How far it is from the sample on the screen, pixels.
    pub pixels: f64,
    /// Where it lies from there.
    pub toward: &'static str,
    /// The triangle that is seen beyond; none: the sky.
    pub triangle: Option<u32>,
    /// How much deeper what is seen there is, metres; none in the sky.
    pub deeper: Option<f64>,
    /// What may flip it.
    pub flipped_by: Vec<&'static str>,
}

impl Silhouette {
    /// It in words.
    pub fn text(&self) -> String {
        let beyond = match (self.triangle, self.deeper) {
            (Some(triangle), Some(deeper)) if deeper < 0.0 => {
                format!("triangle {triangle}, {} m nearer", short(-deeper))
            }
            (Some(triangle), Some(deeper)) => format!("triangle {triangle}, {} m farther", short(deeper)),
            _ => "the sky".into(),
        };
        let flipped = flipped(&self.flipped_by);
        format!("beyond a silhouette {} px {}, {beyond} is seen{flipped}", short(self.pixels), self.toward)
    }
}

/// The silhouette that is nearest to a sample.
pub(super) fn silhouette(near: &Near, seen: &Seen) -> Option<Silhouette> {
    let mut best: Option<(f64, DVec2, &Step)> = None;
    for step in &near.silhouettes {
        of_segment(step.ends.map(|end| end - seen.at), &mut |offset, _| {
            let length = offset.length();
            if length <= REACH && best.is_none_or(|(known, ..)| length < known) {
                best = Some((length, offset, step));
            }
        });
    }
    let (pixels, offset, step) = best?;
    let [first, second] = step.sides;
    let (here, beyond) = if offset.dot(step.across) < 0.0 { (second, first) } else { (first, second) };
    Some(Silhouette {
        pixels,
        toward: toward(offset),
        triangle: beyond.map(|(triangle, _)| triangle),
        deeper: beyond.zip(here).map(|((_, beyond), (_, here))| beyond - here),
        flipped_by: causes(pixels, 0.0, step.across.abs()),
    })
}

/// A border near a sample.
struct Border {
    item: u32,
    /// From the sample to the nearest point, pixels.
    offset: DVec2,
    /// Across the border there, pixels.
    across: DVec2,
}

impl Margin {
    /// The margin in words.
    pub fn text(&self) -> String {
        let Self { name, pixels, toward, .. } = self;
        let place = if self.is_inside { "inside" } else { "outside" };
        let flipped = flipped(&self.flipped_by);
        format!("{place} {name}, whose border is {} px {toward}{flipped}", short(*pixels))
    }
}

/// What may flip a decision, in words.
fn flipped(by: &[&str]) -> String {
    if by.is_empty() { String::new() } else { format!(": {} may flip it", by.join(" or ")) }
}

/// A number with three digits that tell something.
pub(super) fn short(number: f64) -> String {
    let digits = [(1.0, 2), (0.1, 3), (1e-2, 4), (1e-3, 5), (1e-4, 6)];
    let digits = digits.into_iter().find(|(least, _)| number.abs() >= *least);
    match digits {
        Some((_, digits)) => format!("{number:.digits$}"),
        None if number == 0.0 => "0".into(),
        None => format!("{number:.2e}"),
    }
}

/// The nearest borders of items around a sample, one an item, the nearest first.
pub(super) fn margins(bench: &Bench, seen: &Seen) -> Vec<Margin> {
    let Some(reach) = bench.reach(seen) else { return Vec::new() };
    let Some(to_pixels) = Seen::pixels_of_plan(&reach) else { return Vec::new() };
    let mut borders = borders(bench, seen, &reach, &to_pixels);
    borders.sort_by(|a, b| a.offset.length_squared().total_cmp(&b.offset.length_squared()));
    let (mut found, mut room): (Vec<Margin>, Nearby) = (Vec::new(), Nearby::default());
    for border in borders {
        if found.iter().any(|known| known.item == border.item) {
            continue;
        }
        let beside = |side: f64| {
            let plan = seen.hit.plan + Seen::steps(&reach, border.offset + border.across * (side * OVER));
            bench.items_at(seen, plan, &mut room).contains(&border.item)
        };
        let [before, beyond] = [-1.0, 1.0].map(beside);
        if before != beyond {
            found.push(margin(bench, seen, &to_pixels, (&border, before)));
        }
    }
    found
}

fn margin(bench: &Bench, seen: &Seen, to_pixels: &DMat2, (border, is_inside): (&Border, bool)) -> Margin {
    let pixels = border.offset.length();
    let size = seen.hit.plan.to_vec().abs().max_element();
    let single = (to_pixels.x_axis.length() + to_pixels.y_axis.length()) * size * f64::from(f32::EPSILON);
    let flipped_by = causes(pixels, single, border.across.abs());
    let name = bench.name_of(border.item);
    Margin { item: border.item, name, is_inside, pixels, toward: toward(border.offset), flipped_by }
}

/// What may move a border across a sample that is so far from it: rounding, by this much, and snaps of corners, across the border.
fn causes(pixels: f64, single: f64, across: DVec2) -> Vec<&'static str> {
    // A corner that is rounded to a grid is off by up to half its step in both axes.
    let snap = |bits: i32| (across.x + across.y) * 0.5 / f64::from(1 << bits);
    let causes =
        [(single, "single precision"), (snap(8), "a snap to 1/256 px"), (snap(4), "a snap to 1/16 px")];
    causes.into_iter().filter(|(by, _)| pixels <= *by).map(|(_, what)| what).collect()
}

/// A direction on the screen, y down, in words.
fn toward(offset: DVec2) -> &'static str {
    // tan(22.5 degrees)
    const FLAT: f64 = 0.414_213_562_373_095;
    let (x, y) = (offset.x, offset.y);
    match (y.abs() <= FLAT * x.abs(), x.abs() <= FLAT * y.abs()) {
        (true, true) => "from it",
        (true, false) if x < 0.0 => "left of it",
        (true, false) => "right of it",
        (false, true) if y < 0.0 => "above it",
        (false, true) => "below it",
        (false, false) => match (x < 0.0, y < 0.0) {
            (true, true) => "above left of it",
            (false, true) => "above right of it",
            (true, false) => "below left of it",
            (false, false) => "below right of it",
        },
    }
}

/// Pieces of borders near a sample, whether they are borders or lie inside of other parts of their item.
fn borders(bench: &Bench, seen: &Seen, reach: &PixelFootprint, to_pixels: &DMat2) -> Vec<Border> {
    let wide = (reach.dx.abs() + reach.dy.abs()) * REACH;
    let plan = seen.hit.plan;
    let window = PlanBox { min: plan + -wide, max: plan + wide };
    let (mut parts, mut room) = (Vec::new(), Vec::new());
    bench.footprints.parts_near(&window, |part| {
        parts.push(part);
        parts.len() < MOST_PARTS
    });
    parts.sort_unstable();
    parts.dedup();
    let from_eye = (seen.hit.world - bench.view.eye()).length();
    let mut found = Vec::new();
    for part in parts {
        room.clear();
        bench.footprints.primitives(part, &mut room);
        for primitive in &room {
            of_primitive(primitive, (plan, from_eye), (to_pixels, wide.length()), &mut |offset, across| {
                if offset.length() <= REACH {
                    found.push(Border { item: part.item, offset, across });
                }
            });
        }
    }
    found
}

/// Calls `visit` with the nearest point of each piece of a primitive's border, and what lies across it there, in pixels.
fn of_primitive(
    primitive: &Primitive,
    (plan, from_eye): (Plan, f64),
    (to_pixels, wide): (&DMat2, f64),
    visit: &mut dyn FnMut(DVec2, DVec2),
) {
    let pixels = |at: Plan| *to_pixels * (at - plan);
    match primitive {
        Primitive::Edge { from, to } => of_segment([pixels(*from), pixels(*to)], visit),
        Primitive::Convex(shape) | Primitive::Perhaps(shape) => {
            for k in 0..shape.sides().len() {
                if let Some(ends) = side_within(shape.sides(), k, plan, wide) {
                    of_segment(ends.map(pixels), visit);
                }
            }
        }
        Primitive::Near { from, to, scale, reach, growth } => {
            let (along, from) = ((*to - *from) * *scale, (plan - *from) * *scale);
            let length = along.length_squared();
            let share = if length > 0.0 { (from.dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
            let away = from - along * share;
            let distance = away.length();
            let (radius, Some(out)) = (reach + growth * from_eye, away.try_normalize()) else { return };
            // The gradient of the distance in pixels says how far that is on the screen.
            let slope = to_pixels.inverse().transpose() * (out * *scale);
            let steepness = slope.length();
            if steepness > 0.0 {
                let across = slope / steepness;
                visit(across * ((radius - distance) / steepness), across);
            }
        }
    }
}

fn of_segment([a, b]: [DVec2; 2], visit: &mut dyn FnMut(DVec2, DVec2)) {
    let along = b - a;
    let length = along.length_squared();
    let share = if length > 0.0 { (-a.dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
    let offset = a + along * share;
    let normal = along.perp().try_normalize().unwrap_or(DVec2::X);
    // Outward from the sample, so that the sample's own side comes first.
    let across = if normal.dot(offset) < 0.0 { -normal } else { normal };
    visit(offset, across);
}

/// The part of a side of a convex shape that bounds it, near a point.
pub(super) fn side_within(sides: &[HalfPlane], k: usize, near: Plan, wide: f64) -> Option<[Plan; 2]> {
    let middle = |side: &HalfPlane| (DVec2::new(side.normal[0].mid, side.normal[1].mid), side.offset.mid);
    let (normal, offset) = middle(&sides[k]);
    let length = normal.length();
    let normal = normal.try_normalize()?;
    // The foot of the point on the side's line, and a stretch to both sides of it.
    let inside = normal.dot(near - sides[k].at) + offset / length;
    let foot = near + normal * -inside;
    let along = normal.perp();
    let (mut low, mut high) = (-4.0 * wide, 4.0 * wide);
    for (_, other) in sides.iter().enumerate().filter(|(other, _)| *other != k) {
        let (n, c) = middle(other);
        let (at_foot, slope) = (n.dot(foot - other.at) + c, n.dot(along));
        if slope == 0.0 {
            if at_foot < 0.0 {
                return None;
            }
            continue;
        }
        let cut = -at_foot / slope;
        if slope > 0.0 {
            low = math::max(cut, low);
        } else {
            high = math::min(cut, high);
        }
    }
    (low <= high).then(|| [foot + along * low, foot + along * high])
}
