//! Long lines that wind through the window, many of them from a vertex of another.

use super::super::apportion::{apportion, uneven};
use super::super::random::{Sequence, scramble, unit};
use super::super::roads::{direction, normalized};
use super::scatter::Scatter;
use crate::scene::Shape;
use crate::scene_file::Amount;
use crate::space::{Plan, PlanBox};
use glam::DVec2;

/// How long a river is on average, where the distance between rivers is 1: some 40,000 km of 2,735 rivers in 84,000 km2.
const LENGTH: f64 = 2.6;

/// So many lines, whose steps are all about as long.
pub(super) fn rivers(lines: Amount, seed: u64, window: PlanBox) -> Vec<Shape> {
    let scatter = Scatter::new(lines.decals, seed, window);
    let weight = |line| uneven(unit(scramble(seed ^ scramble(1 ^ (line as u64) << 3))));
    let vertices = apportion(lines.vertices, lines.decals, 2, weight);
    let size = window.max - window.min;
    let distance = (size.x * size.y / lines.decals as f64).sqrt();
    let step = LENGTH * distance * lines.decals as f64 / lines.vertices as f64;
    let mut random = Sequence::new(seed);
    let mut rivers: Vec<Shape> = Vec::with_capacity(lines.decals);
    for (number, vertices) in vertices.into_iter().enumerate() {
        // Half of them are tributaries.
        let start = match rivers.get(random.below(2 * rivers.len())) {
            Some(Shape::Line(line)) => line[0][random.below(line[0].len())],
            _ => scatter.place(number, 0.0),
        };
        rivers.push(Shape::Line(vec![wind(start, vertices, step, window, &mut random)]));
    }
    rivers
}

/// A line that turns back where it would leave the window.
fn wind(start: Plan, vertices: usize, step: f64, window: PlanBox, random: &mut Sequence) -> Vec<Plan> {
    let mut course = direction(random);
    let (mut here, mut heading, mut bend) = (start, course, 0.0);
    let mut river = Vec::with_capacity(vertices);
    river.push(here);
    while river.len() < vertices {
        // As roads do, but the course itself changes: a valley bends, too.
        bend = 0.9 * bend + 0.08 * random.signed() + 0.02 * heading.perp_dot(course);
        course = normalized(course + course.perp() * (0.03 * random.signed())).unwrap_or(DVec2::X);
        heading = normalized(heading + heading.perp() * bend).unwrap_or(DVec2::X);
        let there = here + heading * step;
        if !(window.min.x..=window.max.x).contains(&there.x) {
            (heading.x, course.x) = (-heading.x, -course.x);
        }
        if !(window.min.y..=window.max.y).contains(&there.y) {
            (heading.y, course.y) = (-heading.y, -course.y);
        }
        here = here + heading * step;
        river.push(here);
    }
    river
}
