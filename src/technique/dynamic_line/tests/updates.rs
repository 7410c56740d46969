//! What is divided, left out, and seen.

use super::{EXACT, FLAT, MAP, line_layer, stage};
use crate::space::{Plan, PlanBox, ViewFrame, Viewpoint, World};
use crate::technique::dynamic_line::matching::MatchedLines;
use crate::technique::dynamic_line::simplify::screen_error;
use crate::technique::dynamic_line::update::Frustum;
use glam::{DVec2, DVec3};
use proptest::prelude::*;

#[test]
fn a_segment_as_long_as_the_longest_part_is_one_part() {
    let parts = |l_max: f64| {
        let stage = stage(MAP, FLAT, &line_layer(&[[0.0, 0.0], [30.0, 40.0]], 2.0), &EXACT);
        MatchedLines::new(&stage.draw_list, &stage.mesh, Some(l_max)).unwrap().parts
    };
    // Line 5 of Algorithm 3.1: 50 m are divided where they are longer; half as long is three parts.
    assert_eq!([parts(50.0), parts(50.0f64.next_down()), parts(25.0), parts(24.0)], [1, 2, 3, 3]);
}

#[test]
fn what_a_view_leaves_out_may_lie_beyond_a_vertex_that_cannot_be_an_end() {
    let at = |x: f64, y: f64| Some(Plan::new(x, y));
    let kept = |line: &[Option<Plan>], error: f64| {
        let mut kept = Vec::new();
        screen_error(line, error, &mut kept);
        kept
    };
    // At (9, 0) a segment from the start would lose (10, 0); one to (12, 0) has both.
    assert_eq!(kept(&[at(0.0, 0.0), at(10.0, 0.0), at(9.0, 0.0), at(12.0, 0.0)], 0.5), [3]);
    assert_eq!(kept(&[None, at(0.0, 0.0), at(5.0, 5.0), None, None, at(9.0, 0.0)], 0.5), [1, 2, 3, 4, 5]);
}

proptest! {
    #[test]
    fn what_can_be_seen_of_a_box_and_around_it_may_be_shown(
        (x, y, w, h) in (-60.0..60.0f64, -60.0..60.0f64, 0.0..9.0f64, 0.0..9.0f64),
        (ex, ey, ez) in (-50.0..50.0f64, -50.0..50.0f64, 1.0..60.0f64),
        (growth, far) in (prop_oneof![Just(0.0), 0.0..0.9f64], prop_oneof![Just(f64::INFINITY), 20.0..90.0f64]),
        (s, t, u, angle) in (0.0..=1.0f64, 0.0..=1.0f64, 0.0..=1.0f64, 0.0..6.3f64), is_map in prop::bool::ANY,
    ) {
        let stage = stage(MAP, "kind = \"tent\", posts = [9, 9], cell_m = 20, height_m = 9", &line_layer(&[[0.0, 0.0], [9.0, 1.0]], 2.0), &EXACT);
        let viewpoint = Viewpoint {
            eye: World::new(ex, ey, ez),
            target: World::new(0.5, -0.5, 0.25),
            up: DVec3::Z,
            near: 0.5,
            far,
        };
        let size = (32, 24);
        let view = if is_map { ViewFrame::orthographic(&viewpoint, 30.0, size) } else { ViewFrame::perspective(&viewpoint, 40.0, size) };
        let view = view.unwrap();
        let plan = PlanBox { min: Plan::new(x, y), max: Plan::new(x + w, y + h) };
        let (low, high) = stage.mesh.heights().unwrap();
        let (nearest, height) = (Plan::new(x + s * w, y + t * h), low + u * (high - low));
        let way = DVec2::new(crate::math::cos(angle), crate::math::sin(angle));
        // The border of a line as wide as that around the point.
        let mut at = World::new(nearest.x, nearest.y, height);
        for _ in 0..200 {
            let reach = if is_map { growth } else { growth * (at - view.eye()).length() };
            let place = nearest + way * reach;
            at = World::new(place.x, place.y, height);
        }
        let is_seen = view.depth(at) >= view.near() && view.depth(at) < view.far()
            && view.screen_from_world(at).is_some_and(|p| (0.0..=32.0).contains(&p.x) && (0.0..=24.0).contains(&p.y));
        prop_assert!(!is_seen || Frustum::new(&view, &stage.mesh).may_show(&plan, growth));
    }
}
