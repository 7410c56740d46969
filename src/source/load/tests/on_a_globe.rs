//! Features and notes of scenes whose plan is a globe.

use super::Folder;
use super::globe::says;
use crate::error::Error;
use crate::scene::{Scene, Shape};
use crate::scene_file::SceneFile;

const TERRAIN: &str = "terrain = { generate = { kind = \"plane\", posts = [37, 19], cell_deg = 10 } }\n";
const LINE: &str = "line = { color = \"#ff0000\", width_m = 50000 }\n";
const POLYGON: &str = "fill = { color = \"#ff0000\" }\noutline = { color = \"#ff0000\", width_m = 50000 }\n";

fn load(more: &str) -> Result<Scene, Error> {
    let text = format!("schema = 1\nplan = \"globe\"\n{TERRAIN}{more}");
    super::load(&SceneFile::parse(&text, None, &[])?, &|_| ()).map(|(scene, _)| scene)
}

fn layer(features: &str, style: &str) -> String {
    format!("[[layer]]\nname = \"l\"\nfeatures = [{features}]\n{style}")
}

/// The points of what strokes are along, in radians, of all swaths.
fn lines(scene: &Scene) -> Vec<Vec<[f64; 2]>> {
    let globe = scene.globe.unwrap();
    let features = scene.layers.iter().flat_map(|layer| &layer.features);
    let of = features.filter_map(|feature| match &feature.shape {
        Shape::Swath { lines, .. } => Some(lines),
        _ => None,
    });
    let angles = |p: &crate::space::Plan| {
        let at = (p.to_vec() + globe.plan_origin) / globe.ellipsoid.a;
        [at.x, at.y]
    };
    of.flatten().map(|line| line.iter().map(angles).collect()).collect()
}

#[test]
fn strokes_follow_the_curves_of_the_ground_that_a_layer_says_its_edges_are() {
    let along = |line: &str, edges: &str| {
        let folder =
            Folder::new().with("l.geojson", format!(r#"{{"type":"LineString","coordinates":{line}}}"#));
        let text = format!(
            "plan = \"globe\"\n{TERRAIN}[[layer]]\nname = \"l\"\nsource = \"l.geojson\"\nedges = \"{edges}\"\n{LINE}"
        );
        lines(&folder.load(&text).unwrap().0).concat()
    };
    let top = |line: &str, edges: &str| {
        along(line, edges).iter().map(|at| at[1].to_degrees()).fold(0.0, crate::math::max)
    };
    let parallel = "[[-120, 40], [-80, 40]]";
    // Hard case 18, on WGS 84.
    assert!((top(parallel, "geodesic") - 41.770).abs() < 1e-3, "{}", top(parallel, "geodesic"));
    assert!((top(parallel, "rhumb") - 40.0).abs() < 1e-9 && (top(parallel, "projected") - 40.0).abs() < 1e-9);
    assert!(along(parallel, "geodesic").len() > 4 && along(parallel, "projected").len() == 2);
    // A great circle over the pole between opposite meridians.
    let over = top("[[10, 60], [190, 60]]", "geodesic");
    assert!((over - 90.0).abs() < 1e-9, "{over}");
}

#[test]
fn a_features_stroke_is_no_feature_of_its_own() {
    let ring = "{ polygon = [[-120, 70], [0, 70], [120, 70]] }";
    let scene = load(&layer(ring, POLYGON)).unwrap();
    assert_eq!(scene.layers[0].features.len(), 2, "its fill and its outline");
    assert!(says(&scene, "rings around a pole, closed by way of it: 1"), "{:?}", scene.notes);
    let scene = load(&layer("{ line = [[-120, 70], [0, 70], [120, 70], [240, 70]] }", LINE)).unwrap();
    assert!(!says(&scene, "rings around a pole"), "{:?}", scene.notes);
    let beyond = "{ polygon = [[0, 80], [9, 80], [9, 95]] }";
    let scene = load(&layer(beyond, POLYGON)).unwrap();
    assert!(says(&scene, "reach beyond a pole: 1"), "{:?}", scene.notes);
}

#[test]
fn longitudes_of_strokes_are_told_as_those_of_fills_are() {
    for style in [LINE, POLYGON] {
        let feature = |x: f64| match style {
            LINE => format!("{{ line = [[{x}, 10], [{}, 12]] }}", x + 5.0),
            _ => format!("{{ polygon = [[{x}, 10], [{}, 12], [{x}, 14]] }}", x + 5.0),
        };
        let scene = load(&layer(&feature(1085.0), style)).unwrap();
        assert!(says(&scene, "moved by whole turns: 1"), "{:?}", scene.notes);
        let scene = load(&layer(&format!("{}, {}", feature(4000.0), feature(5.0)), style)).unwrap();
        assert!(says(&scene, "1 of 2 features have no place in the plan"), "{:?}", scene.notes);
        let error = load(&layer(&feature(4000.0), style)).unwrap_err().to_string();
        assert!(error.contains("not a place"), "{error}");
    }
}

#[test]
fn a_pole_and_the_antimeridian_are_places_of_every_datum() {
    for (crs, scale) in [("EPSG:4267", 1.0), ("EPSG:4807", 10.0 / 9.0), ("EPSG:4326", 1.0)] {
        let places = [(0.0, 60.0), (-90.0, 90.0), (170.0, 60.0), (190.0, 50.0), (0.0, -90.0)];
        let written: Vec<String> =
            places.iter().map(|(x, y)| format!("[{},{}]", x * scale, y * scale)).collect();
        let geojson = format!(r#"{{"type":"LineString","coordinates":[{}]}}"#, written.join(","));
        let folder = Folder::new().with("l.geojson", geojson);
        let text = format!(
            "plan = \"globe\"\n{TERRAIN}[[layer]]\nname = \"l\"\nsource = \"l.geojson\"\ncrs = \"{crs}\"\n{LINE}"
        );
        let (scene, _) = folder.load(&text).unwrap_or_else(|error| panic!("{crs}: {error}"));
        // The copies a turn apart are one line.
        let all = lines(&scene);
        let line = all.iter().max_by_key(|line| line.len()).unwrap();
        assert!(line.len() < 40, "{crs}: {} vertices", line.len());
        let highest = line.iter().map(|at| at[1].to_degrees()).fold(-90.0, crate::math::max);
        assert!(highest > 89.9, "{crs}: {highest}");
        let steps = line.windows(2).map(|pair| (pair[1][0] - pair[0][0]).to_degrees().abs());
        let longest = steps.fold(0.0, crate::math::max);
        assert!(longest < 180.1, "{crs}: {longest}");
    }
}

#[test]
fn heights_deeper_than_where_normals_meet_are_refused() {
    for (lowest, is_refused) in [(-7e6, true), (-6.33e6, false)] {
        let heights = super::grid((5, 5), (10.0, 20.0), 1.0, |x, _| if x > 12.0 { lowest } else { 0.0 });
        let folder = Folder::new().with("d.asc", heights);
        let loaded = folder.load("plan = \"globe\"\nterrain = { source = \"d.asc\", crs = \"EPSG:4326\" }\n");
        let error = loaded.map_or_else(|error| error.to_string(), |_| String::new());
        assert_eq!(error.contains("deeper than the middle of the globe"), is_refused, "{error}");
        assert!(is_refused || error.is_empty(), "{error}");
    }
}

#[test]
fn plan_coordinates_of_a_camera_are_refused_as_what_they_are() {
    for camera in ["eye = [0, 0, 1e7], target = [0, 0, 0]", "eye = [1e6, 0, 1e7], target = [0, 0, 0]"] {
        let error = load(&format!("camera = {{ {camera} }}\n")).unwrap_err();
        assert!(error.help_text().unwrap_or_default().contains("eye_geo"), "{error}");
    }
}
