//! Features anywhere on the globe, on terrains in degrees and in projections.

use super::{Folder, grid};
use crate::crs::{Crs, PlanSpace};
use crate::scene::{Feature, Scene, Shape};
use crate::space::Plan;
use glam::DVec2;

/// A flat terrain of 5 x 5 posts around a place, in some CRS, and how a place in degrees becomes local there.
pub(super) struct Globe {
    pub(super) crs: &'static str,
    middle: (f64, f64),
    pub(super) cell: f64,
}

impl Globe {
    pub(super) const fn degrees(lon: f64, lat: f64) -> Self {
        Self { crs: "EPSG:4326", middle: (lon, lat), cell: 0.25 }
    }

    pub(super) const fn metres(crs: &'static str, x: f64, y: f64, cell: f64) -> Self {
        Self { crs, middle: (x, y), cell }
    }

    /// With cells of another size, in the CRS's unit.
    pub(super) const fn with_cell(self, cell: f64) -> Self {
        Self { cell, ..self }
    }

    /// Around a place in degrees.
    pub(super) fn around(crs: &'static str, lon: f64, lat: f64, cell: f64) -> Self {
        let plan = PlanSpace::projected(Crs::parse(crs).unwrap()).unwrap();
        let at = plan.plan_from_geographic(lon, lat).unwrap();
        Self { crs, middle: (at.x, at.y), cell }
    }

    pub(super) fn load(&self, geojson: &str, style: &str) -> Scene {
        let (x, y) = self.middle;
        let low = (x - 2.0 * self.cell, y - 2.0 * self.cell);
        let folder =
            Folder::new().with("d.asc", grid((5, 5), low, self.cell, |_, _| 0.0)).with("l.geojson", geojson);
        let text = format!(
            "terrain = {{ source = \"d.asc\", crs = \"{}\" }}\n[[layer]]\nsource = \"l.geojson\"\n{style}",
            self.crs
        );
        folder.load(&text).unwrap().0
    }

    fn filled(&self, geojson: &str) -> Scene {
        self.load(geojson, "fill = { color = \"#000000\" }")
    }

    /// A place in degrees in the scene's coordinates.
    pub(super) fn local(&self, scene: &Scene, lon: f64, lat: f64) -> Plan {
        let crs = Crs::parse(self.crs).unwrap();
        let plan = match crs.is_geographic() {
            true => PlanSpace::local_plane(self.middle.0, self.middle.1, crs).unwrap(),
            false => PlanSpace::projected(crs).unwrap(),
        };
        let mut at = plan.plan_from_geographic(lon, lat).unwrap() - scene.origin.truncate();
        if self.crs == "EPSG:3857" && self.cell < 1e6 && at.x.abs() > 2e7 {
            at.x -= 40_075_016.685_578_49_f64.copysign(at.x);
        }
        Plan::from(at)
    }

    /// Whether the scene's polygons enclose a place in degrees an odd number of times.
    pub(super) fn covers(&self, scene: &Scene, lon: f64, lat: f64) -> bool {
        let at = self.local(scene, lon, lat);
        rings(&scene.layers[0].features).iter().filter(|ring| encloses(ring, at)).count() % 2 == 1
    }
}

pub(super) fn rings(features: &[Feature]) -> Vec<&Vec<Plan>> {
    assert!(features.iter().all(|feature| feature.shape.is_area()), "a line");
    features.iter().flat_map(|feature| feature.shape.parts()).collect()
}

fn encloses(ring: &[Plan], at: Plan) -> bool {
    let edges = (0..ring.len()).map(|k| (ring[k], ring[(k + 1) % ring.len()]));
    let crossing = edges.filter(|(a, b)| (a.y <= at.y) != (b.y <= at.y));
    let east = crossing.filter(|(a, b)| a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x) > at.x);
    east.count() % 2 == 1
}

pub(super) fn polygon(rings: &str) -> String {
    format!(r#"{{"type":"Polygon","coordinates":[{rings}]}}"#)
}

/// A rectangle's ring.
pub(super) fn rectangle(west: f64, south: f64, east: f64, north: f64) -> String {
    format!("[[{west},{south}],[{east},{south}],[{east},{north}],[{west},{north}],[{west},{south}]]")
}

pub(super) fn says(scene: &Scene, words: &str) -> bool {
    scene.notes.iter().any(|note| note.contains(words))
}

const PLANS: [Globe; 4] = [
    Globe::degrees(10.5, 45.5),
    Globe::metres("EPSG:32632", 617_000.0, 5_040_000.0, 20_000.0),
    Globe::metres("EPSG:3857", 1_168_000.0, 5_700_000.0, 20_000.0),
    Globe::metres("EPSG:3035", 4_360_000.0, 2_480_000.0, 20_000.0),
];

#[test]
fn a_mask_of_the_world_covers_all_but_its_hole() {
    let hole = rectangle(10.3, 45.3, 10.7, 45.7);
    for globe in &PLANS {
        for (x, y) in
            [(180.0, 85.0), (180.0, 90.0), (179.9, 89.0), (180.2, 90.000_000_000_000_06), (200.0, 100.0)]
        {
            let scene = globe.filled(&polygon(&format!("{},{hole}", rectangle(-x, -y, x, y))));
            for (lon, lat) in [(10.1, 45.1), (10.29, 45.5), (10.71, 45.5), (10.5, 45.71), (10.9, 45.9)] {
                assert!(globe.covers(&scene, lon, lat), "{} +-{x}: {lon}, {lat}", globe.crs);
            }
            for (lon, lat) in [(10.5, 45.5), (10.31, 45.31), (10.69, 45.69)] {
                assert!(!globe.covers(&scene, lon, lat), "{} +-{x}: {lon}, {lat}", globe.crs);
            }
            assert_eq!(says(&scene, "reach beyond a pole"), y > 91.0, "{:?}", scene.notes);
        }
    }
}

#[test]
fn a_feature_on_the_other_side_of_the_world_is_off_the_terrain() {
    let utm = Globe::metres("EPSG:32612", 322_000.0, 4_096_000.0, 10_000.0);
    let conic = Globe::metres("EPSG:5070", -1_500_000.0, 1_700_000.0, 10_000.0);
    for globe in [Globe::degrees(-113.0, 37.0), utm, conic] {
        for (west, east) in [(60.0, 80.0), (420.0, 440.0), (-300.0, -280.0)] {
            let scene = globe.filled(&polygon(&rectangle(west, 30.0, east, 40.0)));
            assert!(scene.layers[0].features.is_empty(), "{} {west}", globe.crs);
            assert!(says(&scene, "none of its 1 features meets the terrain"), "{:?}", scene.notes);
        }
        let scene = globe.filled(&polygon(&rectangle(100.0, 30.0, 260.0, 40.0)));
        assert!(globe.covers(&scene, -113.0, 37.0), "the long way round to it: {}", globe.crs);
    }
}

#[test]
fn an_ocean_that_reaches_a_pole_and_a_bit_more_is_drawn() {
    let ocean = "[[-180,-60],[0,-70],[100,-65],[180,-60],[180,90.00000000000006],[-180,90],[-180,-60]]";
    let land = rectangle(10.3, 45.3, 10.7, 45.7);
    for globe in &PLANS {
        let scene = globe.filled(&polygon(&format!("{ocean},{land}")));
        assert!(globe.covers(&scene, 10.2, 45.5) && !globe.covers(&scene, 10.5, 45.5), "{}", globe.crs);
    }
    for (lon, lat, covered) in [(0.0, -69.9, true), (0.0, -70.1, false), (0.2, -69.8, true)] {
        let globe = Globe::degrees(0.0, -70.0);
        assert_eq!(globe.covers(&globe.filled(&polygon(ocean)), lon, lat), covered, "{lon} {lat}");
    }
}

/// Antarctica, as files close it: along the pole, not at all, and the other way round.
const ANTARCTICA: [&str; 3] = [
    "[[-180,-90],[-180,-78],[-90,-72],[0,-70],[90,-66],[180,-78],[180,-90],[-180,-90]]",
    "[[-180,-78],[-90,-72],[0,-70],[90,-66],[180,-78]]",
    "[[-180,-78],[90,-66],[0,-70],[-90,-72],[-180,-78]]",
];

#[test]
fn antarctica_is_whole_in_degrees_and_around_the_pole() {
    for written in ANTARCTICA {
        let ring = polygon(written);
        for lon in [0.0, 90.0, 180.0, -180.0] {
            let globe = Globe { cell: 1.0, ..Globe::degrees(lon, -77.0) };
            let scene = globe.filled(&ring);
            let coast = if lon.abs() == 180.0 { -78.0 } else { -66.0 };
            for at in [lon - 0.4, lon, lon + 0.4] {
                let (inside, outside) = (globe.covers(&scene, at, -78.49), globe.covers(&scene, at, -76.5));
                assert_eq!((inside, outside), (true, coast > -70.0), "{written} at {at}");
            }
        }
        let polar = Globe::metres("EPSG:3031", 0.0, 0.0, 900_000.0);
        let scene = polar
            .load(&ring, "outline = { color = \"#000000\", width_m = 5e3 }\nfill = { color = \"#ff0000\" }");
        for (lon, lat, covered) in [
            (0.0, -90.0, true),
            (180.0, -85.0, true),
            (180.0, -77.5, false),
            (179.0, -79.0, true),
            (-179.0, -79.0, true),
            (88.0, -66.5, true),
            (88.0, -65.5, false),
            (-90.0, -71.5, false),
        ] {
            assert_eq!(polar.covers(&scene, lon, lat), covered, "{written}: {lon}, {lat}");
        }
        // Nothing leads to the pole and back: an outline there would be drawn.
        let nearest = rings(&scene.layers[0].features)
            .iter()
            .flat_map(|ring| {
                (0..ring.len()).map(|k| (ring[k].to_vec() + ring[(k + 1) % ring.len()].to_vec()) * 0.5)
            })
            .map(|p| (p + scene.origin.truncate()).length())
            .fold(f64::INFINITY, crate::math::min);
        assert!(nearest > 1e6, "{written}: {nearest}");
    }
}

#[test]
fn an_ocean_around_antarctica_is_what_the_polar_plan_has_outside_of_it() {
    let ocean = "[[-180,-78],[-90,-72],[0,-70],[90,-66],[180,-78],[180,90],[-180,90],[-180,-78]]";
    let polar = Globe::metres("EPSG:3031", 0.0, 0.0, 900_000.0);
    let scene = polar.filled(&polygon(ocean));
    for (lon, lat, covered) in
        [(0.0, -90.0, false), (180.0, -77.5, true), (88.0, -66.5, false), (-60.0, -60.0, true)]
    {
        assert_eq!(polar.covers(&scene, lon, lat), covered, "{lon}, {lat}");
    }
    // A cap that holds the whole terrain, and one on the other side of the world.
    let cap = |y: f64| polygon(&format!("[[-180,{y}],[-90,{y}],[0,{y}],[90,{y}],[180,{y}]]"));
    assert!(polar.covers(&polar.filled(&cap(-20.0)), 77.0, -80.0));
    assert!(!polar.covers(&polar.filled(&cap(20.0)), 77.0, -80.0));
    let band =
        polygon("[[-180,-80],[-90,-80],[0,-80],[90,-80],[180,-80]],[[-180,-85],[0,-85],[90,-85],[180,-85]]");
    let scene = polar.filled(&band);
    assert!(
        polar.covers(&scene, 12.0, -82.0)
            && !polar.covers(&scene, 12.0, -88.0)
            && !polar.covers(&scene, 12.0, -70.0)
    );
}

#[test]
fn longitudes_may_be_written_on_any_turn_and_rings_cross_the_antimeridian() {
    let islands = [
        "[[179.8,-17.2],[-179.8,-17.2],[-179.8,-16.8],[179.8,-16.8],[179.8,-17.2]]".to_owned(),
        rectangle(179.8, -17.2, 180.2, -16.8),
        rectangle(-180.2, -17.2, -179.8, -16.8),
        rectangle(179.8 - 360.0, -17.2, -179.8, -16.8),
        rectangle(539.8, -17.2, 540.0, -16.8),
    ];
    let mercator = Globe::metres("EPSG:3832", 3_339_585.0, -1_900_000.0, 20_000.0);
    let seam = Globe::metres("EPSG:3857", 20_037_508.0, -1_920_000.0, 20_000.0);
    let western = Globe::metres("EPSG:3857", -20_037_508.0, -1_920_000.0, 20_000.0);
    for globe in [Globe::degrees(180.0, -17.0), Globe::degrees(-180.0, -17.0), mercator, seam, western] {
        for island in &islands {
            let scene = globe.filled(&polygon(island));
            for (lon, covered) in [(179.7, false), (179.85, true), (-179.7, false), (179.99, true)] {
                assert_eq!(globe.covers(&scene, lon, -17.0), covered, "{} {island}: {lon}", globe.crs);
            }
        }
        let mask = format!("{},{}", rectangle(-180.0, -85.0, 180.0, 85.0), islands[0]);
        let scene = globe.filled(&polygon(&mask));
        for (lon, covered) in [(179.7, true), (179.85, false), (-179.85, false), (-179.7, true)] {
            assert_eq!(globe.covers(&scene, lon, -17.0), covered, "{}: {lon}", globe.crs);
        }
        let line = r#"{"type":"LineString","coordinates":[[179.7,-17],[-179.7,-17.1]]}"#;
        let scene = globe.load(line, "line = { color = \"#000000\", width_m = 50.0 }");
        let Shape::Line(parts) = &scene.layers[0].features[0].shape else { panic!("no line") };
        let ends = [globe.local(&scene, 179.7, -17.0), globe.local(&scene, -179.7, -17.1)];
        let (first, last) = (parts[0][0], parts[0][parts[0].len() - 1]);
        assert!((first - ends[0]).length() < 1e-3 && (last - ends[1]).length() < 1e-3, "{}", globe.crs);
        assert_eq!(parts.len(), 1);
    }
}

#[test]
fn a_terrain_of_the_whole_world_has_oceans_poles_and_what_crosses_its_seam() {
    let ocean = "[[-180,-60],[0,-70],[100,-45],[180,-60],[180,90.00000000000006],[-180,90],[-180,-60]]";
    let land = "[[170,-20],[-170,-20],[-170,10],[170,10],[170,-20]]";
    let world =
        [Globe::metres("EPSG:3857", 0.0, 0.0, 1e7), Globe::metres("+proj=eqc +datum=WGS84", 0.0, 0.0, 1e7)];
    for globe in &world {
        let scene = globe.filled(&polygon(&format!("{ocean},{land}")));
        for (lon, lat, covered) in [
            (169.0, 0.0, true),
            (171.0, 0.0, false),
            (179.0, 0.0, false),
            (-179.0, 0.0, false),
            (-171.0, 0.0, false),
            (-169.0, 0.0, true),
            (0.0, 80.0, true),
            (-90.0, -66.5, false),
            (0.0, -71.0, false),
        ] {
            assert_eq!(
                globe.covers(&scene, lon, lat),
                covered,
                "{}: {lon}, {lat} {:?}",
                globe.crs,
                scene.notes
            );
        }
    }
}

/// The farthest that a polyline is from the parallel of a latitude, over the terrain.
fn sag(globe: &Globe, scene: &Scene, latitude: f64) -> f64 {
    let plan = PlanSpace::projected(Crs::parse(globe.crs).unwrap()).unwrap();
    let line = super::vertices(&scene.layers[0].features);
    let half = 2.0 * globe.cell;
    let mut worst: f64 = 0.0;
    for pair in line.windows(2) {
        for k in 0..=50 {
            let at = pair[0] + (pair[1] - pair[0]) * (k as f64 / 50.0);
            if at.x.abs() <= half && at.y.abs() <= half {
                let place = plan.geographic_from_plan(at.to_vec() + scene.origin.truncate()).unwrap();
                worst = crate::math::max(worst, (place.y - latitude).abs() * 111_132.0);
            }
        }
    }
    worst
}

#[test]
fn an_edge_along_a_parallel_is_followed_to_a_hundredth_of_a_cell() {
    let globe = Globe::around("EPSG:32632", 9.0, 46.25, 25.0);
    for width in [0.8, 20.0] {
        let (west, east) = (9.0 - 0.5 * width, 9.0 + 0.5 * width);
        let line = format!(r#"{{"type":"LineString","coordinates":[[{west},46.25],[{east},46.25]]}}"#);
        let style = "line = { color = \"#000000\", width_m = 5.0 }";
        let scene = globe.load(&line, style);
        let off = sag(&globe, &scene, 46.25);
        assert!(off < 0.25 && off > 0.0, "{width} degrees: {off} m");
        assert!(says(&scene, "edges that are curves in the plan: 1, followed by"), "{:?}", scene.notes);
        assert!(super::vertices(&scene.layers[0].features).len() < 120);
        let straight = globe.load(&line, &format!("edges = \"straight\"\n{style}"));
        assert!(
            straight.layers[0]
                .features
                .iter()
                .all(|_| super::vertices(&straight.layers[0].features).len() == 2)
        );
        assert!(!says(&straight, "curves"));
    }
}

#[test]
fn neighbours_keep_sharing_an_edge_that_is_followed_and_cut() {
    let globe = Globe::around("EPSG:32632", 9.0, 46.2502, 25.0);
    for (west, east) in [(8.0, 10.0), (-60.0, 78.0)] {
        let pair = format!(
            r#"{{"type":"FeatureCollection","features":[{{"type":"Feature","properties":{{}},"geometry":{}}},{{"type":"Feature","properties":{{}},"geometry":{}}}]}}"#,
            polygon(&format!("[[{west},46.25],[{east},46.2504],[9,48],[{west},46.25]]")),
            polygon(&format!("[[{east},46.2504],[{west},46.25],[9,44],[{east},46.2504]]"))
        );
        let scene = globe.filled(&pair);
        let all = rings(&scene.layers[0].features);
        assert_eq!(all.len(), 2);
        let near = |ring: &[Plan]| -> Vec<Plan> {
            let mut kept: Vec<Plan> =
                ring.iter().copied().filter(|p| p.x.abs() < 60.0 && p.y.abs() < 600.0).collect();
            kept.sort_by(|a, b| a.x.total_cmp(&b.x));
            kept
        };
        let shared = |ring: &[Plan]| -> Vec<Plan> {
            ring.iter().copied().filter(|p| all.iter().all(|other| other.contains(p))).collect()
        };
        assert_eq!(near(all[0]), near(all[1]));
        assert!(shared(all[0]).len() > 10, "{} {}", all[0].len(), shared(all[0]).len());
    }
}

#[test]
fn what_is_cut_off_is_cut_farther_away_than_strokes_reach() {
    let globe = Globe::metres("EPSG:32632", 617_000.0, 5_040_000.0, 25.0);
    let style = "outline = { color = \"#000000\", width_m = 400.0, join = \"miter\", miter_limit = 50.0 }";
    let scene = globe.load(&polygon(&rectangle(-180.0, -90.0, 180.0, 90.0)), style);
    let away = |p: &Plan| crate::math::max(p.x.abs(), p.y.abs());
    for feature in rings(&scene.layers[0].features) {
        assert!(feature.iter().all(|p| away(p) > 100_000.0));
    }
    // It does not touch, so it is left out.
    assert!(scene.layers[0].features.is_empty(), "{:?}", scene.notes);
    let scene = globe.load(&polygon("[[10.6,45.5],[170,45.5],[-20,80],[10.6,45.5]]"), style);
    assert_eq!(scene.layers[0].features.len(), 1, "{:?}", scene.notes);
}

#[test]
fn a_file_in_a_projection_reaches_farther_than_its_projection() {
    // Corners far outside of the zone, around a terrain in degrees.
    let utm = r#"{"type":"Polygon","crs":{"type":"name","properties":{"name":"EPSG:32632"}},"coordinates":[[[-3e8,-3e8],[3e8,-3e8],[3e8,3e8],[-3e8,3e8],[-3e8,-3e8]],[[600000,5030000],[630000,5030000],[630000,5060000],[600000,5060000],[600000,5030000]]]}"#;
    let globe = Globe::degrees(10.5, 45.5);
    let scene = globe.filled(utm);
    assert!(globe.covers(&scene, 10.2, 45.5) && !globe.covers(&scene, 10.5, 45.55), "{:?}", scene.notes);
    assert!(
        says(&scene, "features cut off where the projection can be used no farther, out of sight: 1"),
        "{:?}",
        scene.notes
    );
}

#[test]
fn what_needs_no_cut_keeps_its_bits() {
    let globe = Globe::metres("EPSG:32632", 617_000.0, 5_040_000.0, 20_000.0);
    let ring = "[[10.301,45.302],[10.703,45.304],[10.705,45.706],[10.301,45.302]]";
    let scene = globe.load(&polygon(ring), "edges = \"straight\"\nfill = { color = \"#000000\" }");
    let plan = PlanSpace::projected(Crs::parse(globe.crs).unwrap()).unwrap();
    let map = plan.plan_from(&Crs::crs84().unwrap()).unwrap();
    let expected = [(10.301, 45.302), (10.703, 45.304), (10.705, 45.706)]
        .map(|(x, y)| Plan::from(map.apply(DVec2::new(x, y)).unwrap() - scene.origin.truncate()));
    assert_eq!(rings(&scene.layers[0].features)[0][..], expected);
    assert!(!says(&scene, "cut off"));
}

#[test]
fn a_latitude_that_is_none_is_refused_with_its_feature() {
    let line = r#"{"type":"LineString","coordinates":[[9.6,46.1],[9.7,446]]}"#;
    let folder =
        Folder::new().with("d.asc", grid((5, 5), (9.5, 46.0), 0.25, |_, _| 0.0)).with("l.geojson", line);
    let said = folder
        .refused("terrain = { source = \"d.asc\", crs = \"EPSG:4326\" }\n[[layer]]\nsource = \"l.geojson\"\nline = { color = \"#000000\", width_m = 4.0 }")
        .to_string();
    assert!(said.contains("l.geojson: feature 0: (9.7, 446) is not a place in"), "{said}");
}

#[test]
fn members_stay_members_in_any_plan_and_those_out_of_sight_go() {
    let members = [
        rectangle(10.2, 45.2, 10.8, 45.8),
        rectangle(-120.0, 30.0, -110.0, 40.0),
        rectangle(10.4, 45.4, 10.6, 45.6),
    ];
    let members = members.map(|ring| format!("[{ring}]")).join(",");
    for globe in &PLANS {
        let scene = globe.filled(&format!(r#"{{"type":"MultiPolygon","coordinates":[{members}]}}"#));
        let [feature] = &scene.layers[0].features[..] else { panic!("{}", globe.crs) };
        let Shape::MultiPolygon(members) = &feature.shape else { panic!("{}: {feature:?}", globe.crs) };
        let at = globe.local(&scene, 10.5, 45.5);
        let around = members.iter().filter(|rings| rings.iter().any(|ring| encloses(ring, at)));
        assert_eq!(around.count(), 2, "{}", globe.crs);
    }
}

#[test]
fn points_in_degrees_are_where_they_are_on_every_turn_and_around_a_pole() {
    let points = |lon: f64, lat: f64| {
        format!(
            r#"{{"type":"Feature","properties":{{}},"geometry":{{"type":"MultiPoint","coordinates":[[{lon},{lat}],[{},{}]]}}}}"#,
            lon + 100.0,
            -lat
        )
    };
    let style = "point = { color = \"#000000\", width_m = 10 }";
    for (globe, lon, lat) in [
        (Globe::degrees(10.5, 45.5), 10.4, 45.6),
        (Globe::around("EPSG:32633", 15.0, 47.0, 1000.0), 15.01, 47.01),
        (Globe::around("EPSG:3413", -45.0, 80.0, 1000.0), -45.01, 80.01),
    ] {
        for turn in [0.0, 360.0] {
            let scene = globe.load(&points(lon + turn, lat), style);
            let [Feature { shape: Shape::Points(found), .. }] = &scene.layers[0].features[..] else {
                panic!("{:?} {}", scene.layers[0].features, globe.crs)
            };
            let off = |p: &Plan| (*p - globe.local(&scene, lon, lat)).length();
            assert!(found.iter().any(|p| off(p) < 1e-3), "{found:?} {}", globe.crs);
        }
    }
}

#[test]
fn coordinates_beyond_those_of_scenes_are_refused_as_a_terrains_are() {
    let terrain = "terrain = { generate = { kind = \"plane\", posts = [9, 9], cell_m = 10 } }\n";
    for far in ["1e100", "-1.1e12"] {
        let text = format!(
            "{terrain}[[layer]]\nfeatures = [{{ line = [[0, 0], [{far}, 5]] }}]\nline = {{ color = \"#000000\", width_m = 3 }}\n"
        );
        let error = Folder::new().refused(&text).to_string();
        assert!(error.contains("is more than 1e12 m off"), "{error}");
    }
    // Of a file in the terrain's CRS, too; what another projection takes so far away is left out.
    let line = r#"{"type":"LineString","coordinates":[[500000,5000000],[500000,4e13]]}"#;
    let folder = Folder::new()
        .with("d.asc", grid((5, 5), (498_000.0, 4_998_000.0), 1000.0, |_, _| 0.0))
        .with("l.geojson", line);
    let crs = "crs = \"EPSG:32632\"";
    let text = format!(
        "terrain = {{ source = \"d.asc\", {crs} }}\n[[layer]]\nsource = \"l.geojson\"\n{crs}\nline = {{ color = \"#000000\", width_m = 3 }}\n"
    );
    let error = folder.refused(&text).to_string();
    assert!(error.contains("is more than 1e12 m off"), "{error}");
}

#[test]
fn mercator_metres_may_be_written_on_any_turn_too() {
    const TURN: f64 = 40_075_016.685_578_49;
    let crs = r#""crs":{"type":"name","properties":{"name":"EPSG:3857"}},"#;
    let fiji = (20_000_000.0, -1_940_000.0, 20_074_000.0, -1_890_000.0);
    let wrapped = {
        let (west, south, east, north) = (fiji.0, fiji.1, fiji.2 - TURN, fiji.3);
        format!("[[{west},{south}],[{east},{south}],[{east},{north}],[{west},{north}],[{west},{south}]]")
    };
    let shifted = [-2.0, -1.0, 0.0, 1.0, 2.0, 7.0].map(|turns| turns * TURN);
    let shifted = shifted.map(|by| rectangle(fiji.0 + by, fiji.1, fiji.2 + by, fiji.3));
    let globes = [
        Globe::degrees(180.0, -17.0),
        Globe::metres("EPSG:3832", 3_339_585.0, -1_900_000.0, 20_000.0),
        Globe::metres("EPSG:3857", 20_037_508.0, -1_920_000.0, 20_000.0),
        Globe::metres("EPSG:3857", -20_037_508.0, -1_920_000.0, 20_000.0),
        Globe::around("EPSG:32701", 180.0, -17.0, 20_000.0),
    ];
    for globe in globes {
        for ring in shifted.iter().chain([&wrapped]) {
            let scene = globe.filled(&polygon(ring).replacen('{', &format!("{{{crs}"), 1));
            for (lon, covered) in [(179.6, false), (179.7, true), (-179.7, true), (-179.6, false)] {
                assert_eq!(globe.covers(&scene, lon, -17.0), covered, "{} {ring}: {lon}", globe.crs);
            }
        }
        // A mask of the square of the world, as map tiles cut it, and of whole metres.
        for edge in [20_037_508.342_789_244, 20_037_508.34, 20_037_508.0] {
            let mask = format!("{},{wrapped}", rectangle(-edge, -edge, edge, edge));
            let scene = globe.filled(&polygon(&mask).replacen('{', &format!("{{{crs}"), 1));
            for (lon, covered) in [(179.6, true), (179.7, false), (-179.7, false), (-179.6, true)] {
                assert_eq!(globe.covers(&scene, lon, -17.0), covered, "{} {edge}: {lon}", globe.crs);
            }
        }
    }
}

#[test]
fn longitudes_many_turns_off_are_told_and_absurd_ones_are_left_out_with_a_note() {
    let feature =
        |ring: String| format!(r#"{{"type":"Feature","properties":{{}},"geometry":{}}}"#, polygon(&ring));
    let pair = |one: String, two: String| {
        format!(r#"{{"type":"FeatureCollection","features":[{},{}]}}"#, feature(one), feature(two))
    };
    let near = |by: f64| rectangle(10.3 + by, 45.3, 10.7 + by, 45.7);
    for globe in &PLANS {
        for by in [720.0, -720.0, 3240.0, 540.0 + 180.0] {
            let scene = globe.filled(&pair(near(by), near(0.0)));
            assert_eq!(scene.layers[0].features.len(), 2, "{} {by}", globe.crs);
            for one in scene.layers[0].features.chunks(1) {
                let (at, out) = (globe.local(&scene, 10.31, 45.5), globe.local(&scene, 10.29, 45.5));
                let holds = |at: Plan| rings(one).iter().any(|ring| encloses(ring, at));
                assert!(holds(at) && !holds(out), "{} {by}", globe.crs);
            }
            assert!(says(&scene, "moved by whole turns: 1"), "{:?}", scene.notes);
            assert!(!says(&scene, "off the globe"), "{:?}", scene.notes);
        }
        for by in [1e6, -1e300] {
            let scene = globe.filled(&pair(near(0.0), near(by)));
            assert_eq!(scene.layers[0].features.len(), 1, "{}", globe.crs);
            assert!(
                says(&scene, "1 of 2 features have no place in the plan and are left out"),
                "{:?}",
                scene.notes
            );
        }
    }
}
