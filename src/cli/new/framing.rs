//! A camera for a first picture: from the south, the terrain (or what the layers show of it) as large as the picture.

use drapery::math::{atan, max, min, tan};
use drapery::scene::{Feature, Posts, Scene, Surface};
use drapery::space::{Plan, PlanBox, World};
use glam::DVec3;

/// The horizontal angle of view: narrow, so that what is far is not much smaller than what is near.
const FOV_X_DEG: f64 = 24.0;
/// Pixels a row.
pub(super) const WIDTH: usize = 1200;
/// The fewest and the most rows.
const HEIGHTS: [usize; 2] = [600, 1000];
/// What is left free at each side, as a share of the picture.
const MARGIN: f64 = 0.015;
/// Width over height of a picture that the terrain's foreshortened plan should have.
const ASPECT: f64 = 1.5;
/// Sines of the least and the greatest pitch: 30 and 60 degrees.
const SINES: [f64; 2] = [0.5, 0.866];
/// Layers whose box has a smaller share of the terrain's longer side are looked at from near.
const NEAR: f64 = 0.4;
/// Then so much of their box's longer side is seen around them.
const AROUND: f64 = 0.15;
/// The least share of the terrain that is seen.
const LEAST: f64 = 1.0 / 32.0;
/// Samples of a grid a side.
const SAMPLES: usize = 160;
/// Relief of a smaller share of the terrain's longer side looks flat...
const FLAT: f64 = 0.02;
/// ... and is raised to about this.
const RAISED: f64 = 0.05;
/// Heights are drawn so many times as high at most.
const MOST_EXAGGERATED: f64 = 50.0;

/// Relief of a greater share, which no mountainside has (a steep one has half), is that of a plan which is not in metres...
const STEEP: f64 = 1.0;
/// ... and is lowered to about this.
const LOWERED: f64 = 0.2;
/// One in so many points may be nonsense.
const FEW: usize = 200;
/// A post is alone where no neighbour is nearer than this share of the relief.
const LONE: f64 = 1.0 / 3.0;
/// A gap between heights that is a greater share of the relief has nonsense beyond it.
const GAP: f64 = 1.0 / 3.0;
/// A tail of heights that is a greater share of the relief is nonsense.
const TAIL: f64 = 2.0;

/// A picture and its camera.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Framing {
    /// Rows of the picture.
    pub(super) height: usize,
    /// The vertical angle of view.
    pub(super) fov_y_deg: f64,
    /// Nothing nearer than this is seen, where the terrain is so small that the default would hide it.
    pub(super) near_m: Option<f64>,
    /// Absolute plan coordinates and height of the eye.
    pub(super) eye: DVec3,
    /// What it looks at.
    pub(super) target: DVec3,
    /// How many times as high as they are heights are drawn.
    pub(super) exaggeration: f64,
    /// The relief as a multiple of the longer side of the plan.
    steepness: f64,
    /// Metres of the plan that a pixel's width shows in the middle of the picture.
    pub(super) pixel: f64,
    /// The part of the plan that is framed, local.
    pub(super) plan: PlanBox,
}

impl Framing {
    /// The framing of a scene's layers and terrain; `is_to_scale` where the plan is known to be in metres, as the heights are.
    pub(super) fn of(scene: &Scene, surface: &Surface, is_to_scale: bool) -> Self {
        let all = samples(surface, None);
        let whole = PlanBox::around(all.iter().map(|p| p.plan()));
        let seen = subject(&whole, scene.layers.iter().flat_map(|layer| &layer.features));
        let near = if seen == whole { Vec::new() } else { samples(surface, Some(&seen)) };
        let mut points = if near.len() > 8 { near } else { all };
        if points.is_empty() {
            // There is no height: whoever draws such a terrain will say so.
            points.push(World::default());
        }
        let steepness = steepness(&points);
        let exaggeration = exaggeration(steepness, is_to_scale);
        if let Surface::Grid(posts) = surface {
            let framed = PlanBox::around(points.iter().map(|p| p.plan()));
            add_summits(&mut points, posts, &framed);
        }
        trim(&mut points);
        points.iter_mut().for_each(|p| p.z *= exaggeration);
        let plan = PlanBox::around(points.iter().map(|p| p.plan()));
        let View { height, eye, target, nearest, pixel } = camera(&points, &plan);
        let step = step(pixel);
        let rounded = |at: DVec3| (((at + scene.origin) / step).round() + 0.0) * step;
        let fov_y_deg = (200.0 * atan(upright(height)).to_degrees()).ceil() / 100.0;
        let near_m = (nearest < 3.0).then(|| two_digits(nearest / 3.0));
        Self {
            height,
            fov_y_deg,
            near_m,
            eye: rounded(eye),
            target: rounded(target),
            exaggeration,
            steepness,
            pixel,
            plan,
        }
    }

    /// What to say of heights that are not drawn as they are.
    pub(super) fn scale_note(&self) -> Option<String> {
        let by = self.exaggeration;
        (by != 1.0).then(|| match by > 1.0 {
            true => format!("heights are low beside its extent, and drawn {by} times as high (vertical_scale; 1.0 is as they are)"),
            false => format!(
                "the size of its cells in metres is not known, and its heights are {:.1} times its extent: they are drawn {by} \
                 times as high (vertical_scale; with the right terrain.crs or bounds, 1.0 is as they are)",
                self.steepness
            ),
        })
    }

    /// How many decimals of its places matter.
    pub(super) fn decimals(&self) -> usize {
        let (mut decimals, mut step) = (1, step(self.pixel));
        while step < 0.09 && decimals < 9 {
            (decimals, step) = (decimals + 1, step * 10.0);
        }
        decimals
    }
}

/// A number to two digits.
pub(super) fn two_digits(number: f64) -> f64 {
    let rounded = format!("{number:.1e}").parse().unwrap_or(number);
    if rounded > 0.0 { rounded } else { 1.0 }
}

/// The tangent of half the horizontal angle of view.
fn across() -> f64 {
    tan(FOV_X_DEG.to_radians() / 2.0)
}

/// The tangent of half the vertical one.
fn upright(height: usize) -> f64 {
    across() * height as f64 / WIDTH as f64
}

/// The greatest power of ten that is no more than this.
fn step(pixel: f64) -> f64 {
    let mut step = 1.0;
    while step > pixel && step > 1e-9 {
        step /= 10.0;
    }
    while step * 10.0 <= pixel {
        step *= 10.0;
    }
    step
}

/// Points of a surface, within a box: enough of a grid to know its shape.
fn samples(surface: &Surface, within: Option<&PlanBox>) -> Vec<World> {
    let is_inside = |p: &World| {
        let at = PlanBox { min: p.plan(), max: p.plan() };
        p.z.is_finite() && within.is_none_or(|within| within.meets(&at))
    };
    match surface {
        Surface::Points(points) => points.iter().copied().filter(is_inside).collect(),
        Surface::Grid(posts) => {
            let (columns, rows) = (posts.columns(), posts.rows());
            let (i, j) = within.map_or((0..columns, 0..rows), |within| posts_within(posts, within));
            let every = |range: &std::ops::Range<usize>| range.len().div_ceil(SAMPLES).max(1);
            let (east, north) = (every(&i), every(&j));
            let along = |range: std::ops::Range<usize>, every: usize| {
                range.clone().step_by(every).chain(range.last())
            };
            let posts = along(j, north).flat_map(|j| along(i.clone(), east).map(move |i| posts.world(i, j)));
            posts.filter(is_inside).collect()
        }
    }
}

/// Columns and rows that may lie within a box.
fn posts_within(
    posts: &drapery::scene::Posts,
    within: &PlanBox,
) -> (std::ops::Range<usize>, std::ops::Range<usize>) {
    let (east, north) = (posts.east(), posts.north());
    let whole = (0..posts.columns(), 0..posts.rows());
    if east.y != 0.0 || north.x != 0.0 {
        return whole;
    }
    let range = |low: f64, high: f64, step: f64, count: usize| {
        let first = max((low / step).floor(), 0.0) as usize;
        let last = max((high / step).ceil(), 0.0) as usize;
        first.min(count - 1)..(last + 1).min(count)
    };
    let (low, high) = (within.min - posts.first, within.max - posts.first);
    (range(low.x, high.x, east.x, posts.columns()), range(low.y, high.y, north.y, posts.rows()))
}

/// What is worth seeing: the terrain, or the layers and a little around them where they lie in a small part of it.
fn subject<'a>(whole: &PlanBox, features: impl Iterator<Item = &'a Feature>) -> PlanBox {
    let (low, high) = (whole.min.to_vec(), whole.max.to_vec());
    let mut seen = PlanBox::EMPTY;
    for feature in features {
        let of = PlanBox::around(feature.shape.parts().flatten().copied());
        if of.meets(whole) {
            seen.include(Plan::from(of.min.to_vec().clamp(low, high)));
            seen.include(Plan::from(of.max.to_vec().clamp(low, high)));
        }
    }
    let longer = |bounds: &PlanBox| {
        let size = bounds.max - bounds.min;
        max(size.x, size.y)
    };
    if seen.is_empty() || longer(&seen) > NEAR * longer(whole) {
        return *whole;
    }
    let lacking = max(longer(whole) * LEAST - longer(&seen), 0.0);
    let seen = seen.grown(max(0.5 * lacking, AROUND * longer(&seen)));
    PlanBox {
        min: Plan::from(seen.min.to_vec().clamp(low, high)),
        max: Plan::from(seen.max.to_vec().clamp(low, high)),
    }
}

/// Adds the highest post around each sample: a summit is not to be cut off because it lies between samples.
fn add_summits(points: &mut Vec<World>, posts: &Posts, within: &PlanBox) {
    let [low, high] = heights(points);
    // In a grid of few posts a peak is like nothing beside it.
    let far = if points.len() < FEW { f64::INFINITY } else { LONE * (high - low) };
    let is_isolated = |i: usize, j: usize, z: f64| {
        let beside = (j.saturating_sub(1)..(j + 2).min(posts.rows()))
            .flat_map(|j| (i.saturating_sub(1)..(i + 2).min(posts.columns())).map(move |i| (i, j)));
        let mut others = beside.filter(|at| *at != (i, j)).map(|(i, j)| posts.world(i, j).z);
        !others.any(|other| (other - z).abs() <= far)
    };
    let (columns, rows) = posts_within(posts, within);
    let blocks = |range: &std::ops::Range<usize>| (range.len().div_ceil(SAMPLES).max(1), range.end);
    let ((east, last_column), (north, last_row)) = (blocks(&columns), blocks(&rows));
    points.retain(|p| p.z <= high + far && p.z >= low - far);
    for j0 in rows.step_by(north) {
        for i0 in columns.clone().step_by(east) {
            let mut summit: Option<World> = None;
            for j in j0..(j0 + north).min(last_row) {
                for i in i0..(i0 + east).min(last_column) {
                    let p = posts.world(i, j);
                    let is_higher = p.z.is_finite() && summit.is_none_or(|summit| p.z > summit.z);
                    if is_higher && !is_isolated(i, j, p.z) {
                        summit = Some(p);
                    }
                }
            }
            points.extend(summit);
        }
    }
}

/// Takes heights that are far out (a few posts of nonsense) to those that are not. Summits rise from what is below them: of the few
/// highest and lowest those are nonsense that lie beyond a gap, or in a tail longer than all the rest.
fn trim(points: &mut [World]) {
    let mut all: Vec<f64> = points.iter().map(|p| p.z).collect();
    all.sort_by(f64::total_cmp);
    let [low, high] = heights(points);
    let few = all.len() / FEW;
    let relief = high - low;
    let end = |tail: &mut dyn Iterator<Item = f64>, from: f64| {
        let mut last = from;
        for z in tail {
            if (z - last).abs() > GAP * relief || (z - from).abs() > TAIL * relief {
                return last;
            }
            last = z;
        }
        last
    };
    let top = end(&mut all[all.len() - few..].iter().copied(), high);
    let bottom = end(&mut all[..few].iter().rev().copied(), low);
    points.iter_mut().for_each(|p| p.z = min(max(p.z, bottom), top));
}

/// The heights that one in 200 points is below, and above.
fn heights(points: &[World]) -> [f64; 2] {
    let mut heights: Vec<f64> = points.iter().map(|p| p.z).collect();
    heights.sort_by(f64::total_cmp);
    let few = heights.len() / FEW;
    let at = |k: usize| heights.get(k).copied().unwrap_or(0.0);
    [at(few), at(heights.len().saturating_sub(1 + few))]
}

/// The relief as a multiple of the longer side of the plan.
fn steepness(points: &[World]) -> f64 {
    let size = PlanBox::around(points.iter().map(|p| p.plan()));
    let size = size.max - size.min;
    let [low, high] = heights(points);
    let extent = max(size.x, size.y);
    if extent > 0.0 { (high - low) / extent } else { 0.0 }
}

/// How many times as high heights are to be drawn: 1, but on flat land, and where the plan is not in metres.
fn exaggeration(steepness: f64, is_to_scale: bool) -> f64 {
    if steepness > STEEP && !is_to_scale {
        return two_digits(LOWERED / steepness);
    }
    if steepness <= 1e-6 || steepness >= FLAT {
        return 1.0;
    }
    let wanted = min(RAISED / steepness, MOST_EXAGGERATED);
    let steps = [2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 15.0, 20.0, 30.0, 40.0, 50.0];
    steps.into_iter().rev().find(|step| *step <= wanted).unwrap_or(2.0)
}

/// A camera, local.
struct View {
    /// Rows of the picture.
    height: usize,
    eye: DVec3,
    target: DVec3,
    /// How far from the eye the nearest point is.
    nearest: f64,
    /// The width of a pixel at the target.
    pixel: f64,
}

/// The camera that sees all points.
fn camera(points: &[World], plan: &PlanBox) -> View {
    let size = plan.max - plan.min;
    // Foreshortened by the sine of the pitch, the plan is as wide to its height as the picture.
    let sine = min(max(size.x / (ASPECT * max(size.y, 1e-9)), SINES[0]), SINES[1]);
    let cosine = (1.0 - sine * sine).sqrt();
    let fit = Fit::new(points, DVec3::new(0.0, cosine, -sine));
    let [mut low, mut high] = HEIGHTS;
    // With more rows there is room above and below, with fewer at the sides.
    while high - low > 20 {
        let middle = (low + high) / 40 * 20;
        if fit.is_wide(middle) { high = middle } else { low = middle }
    }
    let height = if fit.is_wide(low) { low } else { high };
    let (eye, [nearest, depth]) = fit.eye(height);
    let target = eye + fit.forward * depth;
    View { height, eye, target, nearest, pixel: 2.0 * across() * depth / WIDTH as f64 }
}

/// Points along the axes of a camera: to the right, up, forward.
struct Fit {
    forward: DVec3,
    up: DVec3,
    along: Vec<DVec3>,
}

impl Fit {
    fn new(points: &[World], forward: DVec3) -> Self {
        let up = DVec3::X.cross(forward);
        let along = points.iter().map(|p| p.to_vec()).map(|p| DVec3::new(p.x, p.dot(up), p.dot(forward)));
        Self { forward, up, along: along.collect() }
    }

    /// How far one may go forward with the points between two sides of the picture, and where the eye then is along that axis.
    fn side(&self, tangent: f64, of: impl Fn(&DVec3) -> f64) -> (f64, f64) {
        let (mut right, mut left) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        for p in &self.along {
            right = max(right, of(p) - tangent * p.z);
            left = max(left, -of(p) - tangent * p.z);
        }
        (-(right + left) / (2.0 * tangent), (right - left) / 2.0)
    }

    fn sides(&self, height: usize) -> [(f64, f64); 2] {
        let within = 1.0 - 2.0 * MARGIN;
        [self.side(across() * within, |p| p.x), self.side(upright(height) * within, |p| p.y)]
    }

    /// Whether the points reach the sides of a picture before its top and bottom.
    fn is_wide(&self, height: usize) -> bool {
        let [across, upright] = self.sides(height);
        across.0 < upright.0
    }

    /// The nearest eye that sees all points, and how far the first of them and their middle are from it.
    fn eye(&self, height: usize) -> (DVec3, [f64; 2]) {
        let [across, upright] = self.sides(height);
        let depths = self.along.iter().map(|p| p.z);
        let (nearest, farthest) =
            depths.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| (min(low, z), max(high, z)));
        // Points in one place: any distance does.
        let size = max(farthest - nearest, 1e-6);
        let forward = min(min(across.0, upright.0), nearest - size);
        let eye = DVec3::X * across.1 + self.up * upright.1 + self.forward * forward;
        (eye, [nearest - forward, (nearest + farthest) / 2.0 - forward])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_two_digits() {
        assert_eq!([145.6, 0.0123, 9.96, 0.0].map(two_digits), [150.0, 0.012, 10.0, 1.0]);
    }

    /// Heights of a hundred metres, and a few others, and the least and the greatest of them that are framed.
    fn framed(others: &[f64]) -> [f64; 2] {
        let heights = (0..2000).map(|k| f64::from(k) / 20.0).chain(others.iter().copied());
        let mut points: Vec<World> = heights.map(|z| World { z, ..World::default() }).collect();
        trim(&mut points);
        points
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| [min(low, p.z), max(high, p.z)])
    }

    #[test]
    fn summits_are_framed_and_nonsense_is_not() {
        assert_eq!(framed(&[110.0, 115.0, 130.0, 150.0]), [0.0, 150.0], "a summit");
        assert_eq!(framed(&[9999.0]), [0.0, 99.95], "a height of nonsense");
        assert_eq!(framed(&[-9999.0, -9998.0, 105.0]), [0.0, 105.0], "data that is none");
    }

    #[test]
    fn heights_are_lowered_where_the_plan_is_not_in_metres() {
        assert_eq!(exaggeration(7.3, false), 0.027);
        assert_eq!([exaggeration(7.3, true), exaggeration(0.51, false)], [1.0, 1.0]);
    }

    #[test]
    fn a_summit_between_samples_is_framed_and_a_lone_post_is_not() {
        let summit = |height: fn(i32, i32) -> f64| {
            let heights = (0..400 * 400).map(|k| height(k % 400, k / 400)).collect();
            let steps = (glam::DVec2::X, glam::DVec2::Y);
            let posts = Posts::new((400, 400), Plan::new(0.0, 0.0), steps, heights).unwrap();
            let mut points = samples(&Surface::Grid(posts.clone()), None);
            let all = PlanBox::around(points.iter().map(|p| p.plan()));
            add_summits(&mut points, &posts, &all);
            points.iter().fold(0.0, |high, p| max(high, p.z))
        };
        let cone = |i: i32, j: i32| 300.0 - f64::from(((i - 202).abs() + (j - 202).abs()).min(300));
        assert_eq!(summit(cone), 300.0);
        assert_eq!(summit(|i, j| if (i, j) == (202, 202) { 4140.0 } else { f64::from(i) }), 399.0);
    }
}
