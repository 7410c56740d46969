//! Widths, colours and the frame of a starter scene, by what its layers hold.

use super::*;
use drapery::math::{max, min};
use drapery::scene::{Color, Width};

/// The starter scene of a terrain, so many posts a side and 50 m apart, and of one layer; and the folder in which it lies.
fn with_layer(posts: usize, name: &str, layer: &str) -> (String, Folder) {
    let folder = Folder::with(&[("dem.asc", &slope(posts, 50.0, 5.0)), (name, layer)]);
    (folder.starter(&["dem.asc", name]).unwrap().0, folder)
}

/// The width in metres that the line of a part has.
fn width(text: &str, part: &str) -> f64 {
    let line = text.lines().find(|line| line.starts_with(&format!("{part} = "))).unwrap();
    let from = line.find("width_m = ").unwrap() + 10;
    line[from..].split([',', ' ']).next().unwrap().parse().unwrap()
}

fn line(from: (f64, f64), to: (f64, f64)) -> String {
    format!(r#"{{"type":"LineString","coordinates":[[{},{}],[{},{}]]}}"#, from.0, from.1, to.0, to.1)
}

fn of_geometries(geometries: &[String]) -> String {
    collection(&geometries.iter().map(|geometry| ("{}", &geometry[..])).collect::<Vec<_>>())
}

#[test]
fn lines_and_points_that_would_hide_the_terrain_are_thin() {
    let faults = |count: usize| {
        let x = |k: usize| 2000.0 * k as f64 / count as f64;
        let lines: Vec<String> = (0..count).map(|k| line((x(k), 0.0), (x(k), 2000.0))).collect();
        width(&with_layer(41, "faults.json", &of_geometries(&lines)).0, "line")
    };
    assert!(faults(400) < 0.4 * faults(3), "{} {}", faults(400), faults(3));
    let trees = |side: usize| {
        let at = |k: usize| format!("[{},{}]", 2000 * (k % side) / side, 2000 * (k / side) / side);
        let points: Vec<String> = (0..side * side).map(at).collect();
        let trees = format!(r#"{{"type":"MultiPoint","coordinates":[{}]}}"#, points.join(","));
        width(&with_layer(41, "trees.json", &trees).0, "point")
    };
    assert!(trees(150) < 0.4 * trees(3), "{} {}", trees(150), trees(3));
}

#[test]
fn borders_leave_something_of_small_areas_and_are_wide_where_they_alone_show_them() {
    let areas = |name: &str, side: f64| {
        let two = [square(0.0, 0.0, side), square(1900.0 - side, 1900.0 - side, side)].join(",");
        let text = format!(r#"{{"type":"FeatureCollection","features":[{two}]}}"#);
        width(&with_layer(41, name, &text).0, "outline")
    };
    assert!(areas("lakes.json", 10.0) <= 0.8, "{} m of 10 m", areas("lakes.json", 10.0));
    assert!(areas("borders.json", 800.0) > 1.2 * areas("lakes.json", 800.0));
}

#[test]
fn important_roads_are_wider_and_darker_and_links_are_as_the_roads_that_they_link() {
    let classes = ["primary", "primary_link", "residential"];
    let road = line((0.0, 0.0), (2000.0, 1000.0));
    let tags = classes.map(|class| format!(r#"{{"class":"{class}"}}"#));
    let (text, _folder) =
        with_layer(41, "roads.json", &collection(&tags.each_ref().map(|tags| (&tags[..], &road[..]))));
    let (scene, _) = load::load(&parsed(&text), &|_| ()).unwrap();
    let layer = &scene.layers[0];
    let of = |index: usize| {
        let feature = layer.features.iter().find(|feature| feature.index == index).unwrap();
        let line = layer.styles[feature.style as usize].line.unwrap();
        let (Width::Metres(width), Color([r, g, b, _])) = (line.width, line.color) else { panic!("{text}") };
        (width, r + g + b)
    };
    assert_eq!(of(0), of(1), "{text}");
    assert!(of(0).0 > of(2).0 && of(0).1 < of(2).1, "{:?} {:?}", of(0), of(2));
}

#[test]
fn a_layer_in_a_small_part_of_the_terrain_is_looked_at_from_near_with_a_little_around_it() {
    let (low, side) = (4000.0, 800.0);
    let site = format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, square(low, low, side));
    let (text, _folder) = with_layer(201, "site.json", &site);
    let scene = drapery::Opened::parse(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let (view, origin) = (scene.view().unwrap(), scene.stage.scene.origin);
    let high = low + side;
    let corners = [(low, low), (high, low), (high, high), (low, high)].map(|(x, y)| {
        let at = World::from(glam::DVec3::new(x, y, 0.1 * y) - origin);
        view.screen_from_world(at).unwrap()
    });
    let (width, height) = (scene.stage.scene.image.width as f64, scene.stage.scene.image.height as f64);
    let share = |of: fn(&drapery::space::Screen) -> f64, whole: f64| {
        let ends = corners
            .iter()
            .map(of)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| [min(low, at), max(high, at)]);
        (ends[1] - ends[0]) / whole
    };
    let (across, upright) = (share(|at| at.x, width), share(|at| at.y, height));
    let most = max(across, upright);
    assert!((0.4..0.85).contains(&most), "{across} of the width, {upright} of the height: {text}");
}
