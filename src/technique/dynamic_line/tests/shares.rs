//! Shares of pixels, and thin lines.

use super::fragment;
use crate::math;
use crate::scene::{Cap, Color, Join, Line, Width};
use crate::space::{Plan, ViewFrame, Viewpoint, World};
use crate::technique::dynamic_line::Corners;
use crate::technique::dynamic_line::camera::{Camera, P3};
use crate::technique::dynamic_line::in_line::{ReadySegment, Thin};
use crate::technique::dynamic_line::update::Segment;
use crate::visibility::PixelFootprint;
use glam::{DVec2, DVec3};

fn ready(ends: [Plan; 2], width: f64, view: &ViewFrame, thin: Thin) -> ReadySegment<f64> {
    let [start, end] = ends.map(|p| P3 { x: p.x, y: p.y, z: 0.0 });
    let segment = Segment { item: 0, before: None, start, end, after: None, source: None, is_inside: true };
    let line =
        Line { color: Color([0.0; 4]), width: Width::Pixels(width), join: Join::Round, cap: Cap::Round };
    ReadySegment::new(
        &segment,
        (&line, width / 2.0, None),
        (&Camera::new(view), view),
        (Corners::Round, thin),
    )
}

#[test]
fn a_share_is_how_much_of_a_pixels_reach_lies_between_the_sides_of_the_line() {
    let (eye, target) = (World::new(0.0, 0.0, 4.0), World::new(0.0, 0.0, 0.0));
    let view = Viewpoint { eye, target, up: DVec3::Y, near: 0.5, far: f64::INFINITY };
    let view = ViewFrame::orthographic(&view, 40.0, (8, 8)).unwrap();
    // Pixels of 5 m.
    let footprint = PixelFootprint { dx: DVec2::new(5.0, 0.0), dy: DVec2::new(0.0, -5.0) };
    let reach = 5.0f64;
    for half in [1.0, 2.0, 2.5, 4.0, 20.0] {
        let line =
            ready([Plan::new(-100.0, 0.0), Plan::new(100.0, 0.0)], half * 2.0 / 5.0, &view, Thin::Nothing);
        for k in -60..60 {
            let y = f64::from(k) / 2.0;
            let (low, high) = (y - reach / 2.0, y + reach / 2.0);
            let right = math::max((math::min(high, half) - math::max(low, -half)) / reach, 0.0);
            let found = line.share(&fragment(&view, World::new(3.0, y, 1.0)), Some(footprint));
            assert!((found - right).abs() < 1e-12, "{half} {y}: {found} {right}");
        }
        let at = fragment(&view, World::new(3.0, half, 1.0));
        assert_eq!(line.share(&at, None), 1.0, "edge-on: its point tells");
    }
    let slanted = ready([Plan::new(-40.0, 30.0), Plan::new(40.0, -30.0)], 2.0, &view, Thin::Nothing);
    let found = slanted.share(&fragment(&view, World::new(3.0, 4.0, 0.0)), Some(footprint));
    // At a distance of 5 m of a line half as wide, each pixel reaches 5 sqrt(0.36 + 0.64) m across it: half of it.
    assert!((found - 0.5).abs() < 1e-12, "{found}");
}

#[test]
fn the_place_of_a_thin_line_is_where_its_picture_is_nearest() {
    let viewpoint = Viewpoint {
        eye: World::new(3.0, -40.0, 25.0),
        target: World::new(0.0, 0.0, 0.0),
        up: DVec3::Z,
        near: 0.5,
        far: f64::INFINITY,
    };
    let view = ViewFrame::perspective(&viewpoint, 50.0, (40, 30)).unwrap();
    // From near to far, and one that comes from behind the eye.
    for ends in
        [[Plan::new(-9.0, -22.0), Plan::new(30.0, 120.0)], [Plan::new(-6.0, -90.0), Plan::new(4.0, 30.0)]]
    {
        let line = ready(ends, 0.1, &view, Thin::Near);
        let (mut near, mut before) = (0, 0);
        for (column, row) in (0..40 * 30).map(|k| (k % 40, k / 40)) {
            let centre = DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
            let on = |t: f64| ends[0] + (ends[1] - ends[0]) * t;
            let screen = |p: Plan| view.screen_from_world(World::new(p.x, p.y, 0.0));
            let distance =
                |p: Plan| screen(p).map_or(f64::INFINITY, |at| (DVec2::new(at.x, at.y) - centre).length());
            let nearest =
                (0..=1000).map(|k| distance(on(f64::from(k) / 1000.0))).fold(f64::INFINITY, math::min);
            match line.near((column, row)) {
                Some(place) => {
                    near += 1;
                    assert!(distance(place) <= math::min(nearest, 0.5) + 1e-9, "{column} {row}");
                }
                None => assert!(nearest > 0.5 - 1e-9, "{column} {row}: {nearest}"),
            }
            before += usize::from(nearest < 2.0);
        }
        assert!(near > 15 && before > near, "{near} {before}");
    }
}
