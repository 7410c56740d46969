//! Borders beside rational arithmetic.

use super::{fragment, is_in_footprint};
use crate::scene::{Cap, Color, Join, Line, Width};
use crate::space::{Plan, ViewFrame, Viewpoint, World};
use crate::technique::dynamic_line::Corners;
use crate::technique::dynamic_line::border::Border;
use crate::technique::dynamic_line::camera::{Camera, P3};
use crate::technique::dynamic_line::in_line::{ReadySegment, Thin};
use crate::technique::dynamic_line::update::Segment;
use glam::DVec3;
use proptest::prelude::*;

/// From above; a pixel is 5 m, or as large as the distance from the eye times a number with all its digits.
fn views() -> [ViewFrame; 2] {
    let (eye, target) = (World::new(0.0, 0.0, 4.0), World::new(0.0, 0.0, 0.0));
    let view = Viewpoint { eye, target, up: DVec3::Y, near: 0.5, far: f64::INFINITY };
    [ViewFrame::orthographic(&view, 40.0, (8, 8)), ViewFrame::perspective(&view, 60.0, (8, 8))]
        .map(|view| view.unwrap())
}

/// The parts of a segment, as they are matched, of a line so many half pixels wide.
fn parts([from, to]: [Plan; 2], count: u32, half_px: f64, view: &ViewFrame) -> Vec<ReadySegment<f64>> {
    let camera = Camera::new(view);
    let line = Line {
        color: Color([0.0; 4]),
        width: Width::Pixels(2.0 * half_px),
        join: Join::Round,
        cap: Cap::Round,
    };
    let at = |k: u32| {
        let at = if k == count { to } else { from + (to - from) / f64::from(count) * f64::from(k) };
        P3 { x: at.x, y: at.y, z: 0.0 }
    };
    let part = |k| {
        let (start, end) = (at(k), at(k + 1));
        let segment =
            Segment { item: 0, before: None, start, end, after: None, source: Some(0), is_inside: true };
        let border = Some(Border::of_part([from, to], half_px, &camera));
        ReadySegment::new(
            &segment,
            (&line, half_px, border),
            (&camera, view),
            (Corners::Round, Thin::Nothing),
        )
    };
    (0..count).map(part).collect()
}

/// A point and some around it, by so many doubles.
fn nudged(at: World, steps: i32) -> impl Iterator<Item = World> {
    let moved =
        |v: f64, by: i32| (0..by.abs()).fold(v, |v, _| if by > 0 { v.next_up() } else { v.next_down() });
    (-steps..=steps)
        .flat_map(move |x| (-steps..=steps).map(move |y| World::new(moved(at.x, x), moved(at.y, y), at.z)))
}

#[test]
fn a_point_on_the_border_is_in_the_line_and_the_next_one_beyond_is_not() {
    let [map, above] = views();
    // On a map along (4, 3): 15 m away, and 15 m from an end.
    let segment = [Plan::new(-8.0, -6.0), Plan::new(20.0, 15.0)];
    for at in [World::new(-5.0, 15.0, 0.7), World::new(32.0, 24.0, 0.0), World::new(-8.0, -21.0, 0.0)] {
        for count in 1..9 {
            let parts = parts(segment, count, 3.0, &map);
            let holds = |at: World| parts.iter().any(|part| part.holds(&fragment(&map, at)));
            assert!(holds(at), "{at:?} {count}");
            let beyond = World::new(at.x, if at.y > 0.0 { at.y.next_up() } else { at.y.next_down() }, at.z);
            assert!(!holds(beyond), "{beyond:?} {count}");
        }
    }
    // 4 m below the eye a pixel is 4 times as large as at 1 m.
    let x = 4.0 * (1.5 * above.lens().pixel());
    let segment = [Plan::new(x, -3.0), Plan::new(x, 5.0)];
    let line = &parts(segment, 1, 1.5, &above)[0];
    assert!(line.holds(&fragment(&above, World::new(0.0, 0.0, 0.0))));
    assert!(!line.holds(&fragment(&above, World::new(-1e-300, 0.0, 0.0))));
}

/// A coordinate of few digits, or of many.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![(-40..40i32).prop_map(|v| f64::from(v) / 4.0), -2e3..2e3f64, 4.1e5..4.2e5f64]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    #[test]
    fn near_the_border_the_parts_of_a_segment_hold_what_the_footprint_holds(
        ends in prop::array::uniform4(coordinate()),
        (along, half_px) in (-0.3..1.3f64, prop_oneof![Just(3.0), 0.0..9.0f64]),
        (height, side, count) in (-2.0..3.0f64, prop::bool::ANY, 1..6u32),
    ) {
        let segment = [Plan::new(ends[0], ends[1]), Plan::new(ends[2], ends[3])];
        let way = segment[1] - segment[0];
        let nearest = segment[0] + way * along.clamp(0.0, 1.0);
        let aside = glam::DVec2::new(-way.y, way.x).normalize_or(glam::DVec2::X);
        let beyond = way.normalize_or(glam::DVec2::X) * (along - along.clamp(0.0, 1.0));
        let out = (if side { aside } else { -aside } + beyond * 4.0).normalize();
        for view in views() {
            let parts = parts(segment, count, half_px, &view);
            let mut at = World::new(nearest.x, nearest.y, height);
            for _ in 0..40 {
                let place = nearest + out * (half_px * fragment(&view, at).pixel);
                at = World::new(place.x, place.y, height);
            }
            for at in nudged(at, 2) {
                let held = parts.iter().any(|part| part.holds(&fragment(&view, at)));
                prop_assert_eq!(held, is_in_footprint(segment, half_px, &view, at), "{:?}", at);
            }
        }
    }
}
