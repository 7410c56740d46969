//! What a pixel is looked at with: the mesh in use, footprints, paints; points of the screen and what is there.

use super::names::Names;
use crate::canvas::Backdrop;
use crate::footprint::Footprints;
use crate::holding::Nearby;
use crate::parallel;
use crate::resolve::{Paint, Stack};
use crate::space::{Plan, Screen, ViewFrame, World};
use crate::stage::Stage;
use crate::terrain::{Mesh, SKY, SurfaceTriangle};
use crate::truth::{Budget, PixelLook, SeenPiece, look};
use crate::visibility::{FootprintPlane, Hit, PixelFootprint, hit};
use glam::{DMat2, DVec2};
use std::ops::Range;

/// How well the pixels around the one in question need to be known: what they see, and no more.
const GLANCE: Budget = Budget { width: 1.0, depth: 0, coverage: false };

/// Surfaces that are no farther apart than this share of their view depth meet.
const STEP: f64 = 1e-6;

/// A step over a border, pixels.
const OVER: f64 = 1e-5;

/// A corner of a piece, and a point of its rim, are known to so much, pixels.
const RIM: f64 = 1e-9;

/// What pixels are looked at with.
pub(super) struct Bench<'a> {
    pub(super) stage: &'a Stage,
    pub(super) view: &'a ViewFrame,
    pub(super) mesh: &'a Mesh,
    pub(super) footprints: &'a Footprints<'a>,
    pub(super) names: &'a Names<'a>,
    pub(super) budget: Budget,
    pub(super) backdrop: Backdrop<'a>,
    /// The paint of each style of items.
    paints: Vec<Paint>,
}

/// A point of the surface that a point of the screen sees.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    pub(super) triangle: u32,
    pub(super) at: Screen,
    pub(super) hit: Hit,
    surface: SurfaceTriangle,
}

/// A pixel and what it and those around it see.
#[derive(Debug)]
pub(super) struct Near {
    /// Column and row.
    pub(super) pixel: [usize; 2],
    pub(super) look: PixelLook,
    /// What it and its neighbours see; its own pieces come first.
    pub(super) pieces: Vec<SeenPiece>,
    /// Each of these pixels, and which of the pieces are its own.
    ranges: Vec<([usize; 2], Range<usize>)>,
    /// Where surfaces do not meet that are seen side by side.
    pub(super) silhouettes: Vec<Step>,
}

/// A border of what is seen, with what is on its two sides.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step {
    /// Its ends on the screen.
    pub(super) ends: [Screen; 2],
    /// Across it.
    pub(super) across: DVec2,
    /// What is seen against that direction, and along it: triangle and view depth; `None`: the sky.
    pub(super) sides: [Option<(u32, f64)>; 2],
}

impl Near {
    fn of(pixel: [usize; 2], look: PixelLook, around: &[[usize; 2]], glances: Vec<PixelLook>) -> Self {
        let mut near =
            Self { pixel, pieces: look.pieces.clone(), look, ranges: Vec::new(), silhouettes: Vec::new() };
        near.ranges.push((pixel, 0..near.pieces.len()));
        for (pixel, glance) in around.iter().zip(glances) {
            let first = near.pieces.len();
            near.pieces.extend(glance.pieces);
            near.ranges.push((*pixel, first..near.pieces.len()));
        }
        near
    }

    /// The piece that a point of the screen lies in.
    fn piece_at(&self, at: Screen) -> Option<&SeenPiece> {
        let is_in = |pixel: [usize; 2]| {
            let [x, y] = pixel.map(|v| v as f64);
            (x - RIM..=x + 1.0 + RIM).contains(&at.x) && (y - RIM..=y + 1.0 + RIM).contains(&at.y)
        };
        let mut pieces =
            self.ranges.iter().filter(|(pixel, _)| is_in(*pixel)).flat_map(|(_, range)| range.clone());
        pieces.find(|k| holds(&self.pieces[*k].corners, at)).map(|k| &self.pieces[k])
    }
}

impl<'a> Bench<'a> {
    pub(super) fn new(
        (stage, view, mesh): (&'a Stage, &'a ViewFrame, &'a Mesh),
        (footprints, names): (&'a Footprints<'a>, &'a Names<'a>),
        budget: Budget,
    ) -> Self {
        let backdrop = Backdrop::of(&stage.scene, mesh);
        let styles = stage.draw_list.styles().iter();
        let paints = styles.map(|style| backdrop.compositor.paint(style.paint)).collect();
        Self { stage, view, mesh, footprints, names, budget, backdrop, paints }
    }

    /// Looks at some pixels and what is around them.
    pub(super) fn look(&self, pixels: &[[usize; 2]]) -> Vec<Near> {
        let at = (self.mesh, self.view);
        let looks = look(self.stage, at, self.footprints, (pixels, self.budget));
        let around: Vec<Vec<[usize; 2]>> = pixels.iter().map(|pixel| self.around(*pixel)).collect();
        let glances = look(self.stage, at, self.footprints, (&around.concat(), GLANCE));
        let mut glances = glances.into_iter();
        let nears = looks.into_iter().zip(pixels).zip(around).map(|((look, pixel), around)| {
            let glances = glances.by_ref().take(around.len()).collect();
            Near::of(*pixel, look, &around, glances)
        });
        let mut nears: Vec<Near> = nears.collect();
        parallel::for_each(&mut nears, |near| near.silhouettes = self.silhouettes(near));
        nears
    }

    /// The borders of pieces beyond which another surface begins, as told by their middles.
    fn silhouettes(&self, near: &Near) -> Vec<Step> {
        let ends = |piece: &SeenPiece| {
            let corners = piece.corners.clone();
            (0..corners.len()).map(move |k| [corners[k], corners[(k + 1) % corners.len()]])
        };
        let sides = near.pieces.iter().flat_map(ends);
        sides.filter_map(|ends| self.step_between(near, ends)).collect()
    }

    /// A border of a piece, if what is seen on its sides does not meet.
    fn step_between(&self, near: &Near, ends: [Screen; 2]) -> Option<Step> {
        let along = ends[1] - ends[0];
        let across = along.perp().try_normalize()?;
        let middle = ends[0] + along * 0.5;
        // Both depths are those of the middle itself: surfaces that meet there have the same, however flatly they are seen.
        let [first, second] = [-OVER, OVER].map(|side| {
            let triangle = near.piece_at(middle + across * side)?.triangle;
            let depth = self.on_triangle(triangle, middle).map(|seen| seen.hit.depth);
            (depth.is_some() || triangle == SKY).then(|| depth.map(|depth| (triangle, depth)))
        });
        let sides = [first?, second?];
        let is_step = match sides {
            [Some((a, here)), Some((b, beyond))] => a != b && (here - beyond).abs() > STEP * here,
            [None, None] => false,
            _ => true,
        };
        is_step.then_some(Step { ends, across, sides })
    }

    /// The pixels of the picture around a pixel.
    fn around(&self, [x, y]: [usize; 2]) -> Vec<[usize; 2]> {
        let columns = x.saturating_sub(1)..(x + 2).min(self.view.width());
        let rows = y.saturating_sub(1)..(y + 2).min(self.view.height());
        let all = rows.flat_map(|row| columns.clone().map(move |column| [column, row]));
        all.filter(|pixel| *pixel != [x, y]).collect()
    }

    /// What a point of the screen sees; `None`: the sky, or a point that is not near.
    pub(super) fn seen(&self, near: &Near, at: Screen) -> Option<Seen> {
        self.on_triangle(near.piece_at(at)?.triangle, at)
    }

    /// Where a point of the screen meets a triangle's plane; `None`: there is no triangle.
    pub(super) fn on_triangle(&self, triangle: u32, at: Screen) -> Option<Seen> {
        if triangle == SKY {
            return None;
        }
        let surface = self.mesh.surface_triangle(triangle)?;
        let hit = hit(self.view, &self.view.ray(at), &surface);
        hit.plan.is_finite().then_some(Seen { triangle, at, hit, surface })
    }

    /// Where a plan point is seen near a pixel; where none of the pieces there has it, on the plane that the pixel's centre sees.
    pub(super) fn seen_over(&self, near: &Near, plan: Plan) -> Option<Seen> {
        let mut tried = SKY;
        for piece in near.pieces.iter().filter(|piece| piece.triangle != SKY) {
            if piece.triangle != tried
                && let Some(seen) = self.over(piece.triangle, plan)
                && holds(&piece.corners, seen.at)
            {
                return Some(seen);
            }
            tried = piece.triangle;
        }
        self.over(near.look.centre?.triangle, plan)
    }

    /// The point of a triangle's plane over a plan point, and where it lies on the screen.
    fn over(&self, triangle: u32, plan: Plan) -> Option<Seen> {
        let surface = self.mesh.surface_triangle(triangle)?;
        let world = world_of(&surface, plan)?;
        let at = self.view.screen_from_world(world)?;
        Some(Seen { triangle, at, hit: Hit { plan, world, depth: self.view.depth(world) }, surface })
    }

    /// Where the point of a triangle's plane over a plan point lies on the screen.
    pub(super) fn screen_over(&self, triangle: u32, plan: Plan) -> Option<Screen> {
        self.over(triangle, plan).map(|seen| seen.at)
    }

    /// How far the point of a triangle's plane over a plan point is from the eye, metres.
    pub(super) fn eye_distance_over(&self, triangle: u32, plan: Plan) -> Option<f64> {
        let world = world_of(&self.mesh.surface_triangle(triangle)?, plan)?;
        Some((world - self.view.eye()).length())
    }

    /// How the plan point moves with the screen point there.
    pub(super) fn reach(&self, seen: &Seen) -> Option<PixelFootprint> {
        FootprintPlane::new(self.view, &seen.surface).footprint(seen.at)
    }

    /// The items that hold a plan point of a triangle, in draw order.
    pub(super) fn items_at(&self, seen: &Seen, plan: Plan, room: &mut Nearby) -> Vec<u32> {
        room.find_all(self.footprints, plan);
        let eye = self.view.eye();
        let from_eye = || {
            let world = world_of(&seen.surface, plan).unwrap_or(seen.hit.world);
            (world - eye).length()
        };
        let held = room.items().iter().filter(|item| room.holds(self.footprints, item, (plan, &from_eye)));
        held.map(|item| item.number).collect()
    }

    /// The paint that a point of the screen sees; `None`: that is not known.
    pub(super) fn spot(&self, near: &Near, at: Screen, room: &mut Nearby) -> Option<Paint> {
        let Some(seen) = self.seen(near, at) else {
            return near.piece_at(at).is_some_and(|piece| piece.triangle == SKY).then_some(self.backdrop.sky);
        };
        let mut stack = Stack::on(self.ground(&seen));
        self.items_at(&seen, seen.hit.plan, room).iter().for_each(|item| self.draw(&mut stack, *item));
        Some(stack.finished())
    }

    /// The terrain's own paint.
    pub(super) fn ground(&self, seen: &Seen) -> Paint {
        self.backdrop.paint_at(&mut self.backdrop.no_ground(), seen.triangle, || seen.hit.plan)
    }

    /// Draws an item over what is there.
    pub(super) fn draw(&self, stack: &mut Stack<Paint>, item: u32) {
        let source = self.paint_of(item);
        stack.draw(self.stage.draw_list.style_of(item).group, |below| {
            self.backdrop.compositor.over(below, source)
        });
    }

    /// The paint of an item.
    pub(super) fn paint_of(&self, item: u32) -> Paint {
        self.paints[self.stage.draw_list.items()[item as usize].style as usize]
    }

    /// What an item is called.
    pub(super) fn name_of(&self, item: u32) -> String {
        self.names.of_item(&self.stage.draw_list, item)
    }

    /// A plan point in the scene's plan space.
    pub(super) fn absolute(&self, plan: Plan) -> [f64; 2] {
        let origin = self.stage.scene.origin;
        [plan.x + origin.x, plan.y + origin.y]
    }

    /// A point of the world, in the scene's plan space; of a globe scene-local.
    pub(super) fn absolute_world(&self, at: World) -> [f64; 3] {
        let scene = &self.stage.scene;
        let origin = if scene.globe.is_some() { glam::DVec3::ZERO } else { scene.origin };
        (at.to_vec() + origin).to_array()
    }
}

impl Seen {
    /// The screen offset of a plan point from this one, pixels, to first order.
    pub(super) fn pixels_of_plan(reach: &PixelFootprint) -> Option<DMat2> {
        let plan_of_pixels = DMat2::from_cols(reach.dx, reach.dy);
        let inverse = plan_of_pixels.inverse();
        (plan_of_pixels.determinant() != 0.0 && inverse.is_finite()).then_some(inverse)
    }

    /// A plan step as a step on the screen, pixels.
    pub(super) fn steps(reach: &PixelFootprint, pixels: DVec2) -> DVec2 {
        reach.dx * pixels.x + reach.dy * pixels.y
    }
}

/// The point of a triangle's plane that has a plan point.
fn world_of(surface: &SurfaceTriangle, plan: Plan) -> Option<World> {
    let [east, north] = surface.world_from_plan()?;
    let step = plan - surface.plan()[0];
    Some(surface.world[0] + (east * step.x + north * step.y))
}

/// Whether a convex polygon holds a point.
pub(super) fn holds(corners: &[Screen], at: Screen) -> bool {
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    let mut signs = sides.map(|(a, b)| (*b - *a).perp_dot(at - *a));
    let is_clockwise = twice_area(corners) < 0.0;
    corners.len() > 2 && signs.all(|sign| if is_clockwise { sign <= RIM } else { sign >= -RIM })
}

/// Twice the signed area of a polygon.
pub(super) fn twice_area(corners: &[Screen]) -> f64 {
    let Some(first) = corners.first() else { return 0.0 };
    corners.windows(2).map(|pair| (pair[0] - *first).perp_dot(pair[1] - *first)).sum()
}
