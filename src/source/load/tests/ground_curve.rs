//! Edges that are geodesics or rhumb lines, on terrains in degrees and in projections.

use super::globe::{Globe, polygon, rectangle, rings, says};
use super::{Folder, grid, vertices};
use crate::crs::{Crs, CurveKind, Geodesy};
use crate::math::{max, min};
use crate::scene::Scene;
use crate::space::Plan;
use glam::DVec2;

const LINE: &str = "line = { color = \"#000000\", width_m = 10.0 }";

fn line(vertices: &str) -> String {
    format!(r#"{{"type":"LineString","coordinates":[{vertices}]}}"#)
}

fn with_edges(globe: &Globe, edges: &str, geojson: &str, style: &str) -> Scene {
    globe.load(geojson, &format!("edges = \"{edges}\"\n{style}"))
}

fn filled(globe: &Globe, edges: &str, rings: &str) -> Scene {
    with_edges(globe, edges, &polygon(rings), "fill = { color = \"#000000\" }")
}

/// How far a point is from a polyline.
fn away(p: Plan, line: &[Plan]) -> f64 {
    let from_segment = |pair: &[Plan]| {
        let (chord, to) = (pair[1] - pair[0], p - pair[0]);
        let squared = chord.length_squared();
        let t = if squared > 0.0 { (to.dot(chord) / squared).clamp(0.0, 1.0) } else { 0.0 };
        (to - chord * t).length()
    };
    line.windows(2).map(from_segment).fold(f64::INFINITY, min)
}

#[test]
fn the_geodesic_edge_of_a_box_rises_as_far_as_the_globe_says() {
    // Hard case 18 (RFC 7946 against geodesics): on the sphere by 1.763 degrees, on WGS 84 by 1.770.
    let plans = [
        Globe::degrees(-100.0, 41.0).with_cell(0.6),
        Globe::around("EPSG:32614", -100.0, 41.0, 60_000.0),
        Globe::around("EPSG:5070", -100.0, 41.0, 60_000.0),
        Globe::around("EPSG:3857", -100.0, 41.0, 90_000.0),
    ];
    for globe in &plans {
        for (edges, top) in [("projected", 40.0), ("rhumb", 40.0), ("geodesic", 41.770)] {
            let scene = filled(globe, edges, &rectangle(-120.0, 30.0, -80.0, 40.0));
            for (off, covered) in [(-0.02, true), (0.02, false)] {
                assert_eq!(globe.covers(&scene, -100.0, top + off), covered, "{} {edges} {off}", globe.crs);
            }
            assert_eq!(says(&scene, "edges that are geodesics: 2"), edges == "geodesic", "{:?}", scene.notes);
        }
    }
}

#[test]
fn an_edge_is_followed_to_a_hundredth_of_a_cell_in_any_plan() {
    let plans = [
        Globe::degrees(9.0, 46.25).with_cell(0.002),
        Globe::around("EPSG:32632", 9.0, 46.25, 200.0),
        Globe::around("EPSG:3035", 9.0, 46.25, 200.0),
        Globe::around("EPSG:3857", 9.0, 46.25, 200.0),
    ];
    let ground = Geodesy::of(&Crs::crs84().unwrap()).unwrap();
    for globe in &plans {
        for (edges, kind) in [("geodesic", CurveKind::Geodesic), ("rhumb", CurveKind::RhumbLine)] {
            for (east, north) in [(0.05, 0.03), (5.0, 2.0), (40.0, 0.0), (30.0, -20.0)] {
                // Through the terrain's middle, which is no vertex.
                let from = DVec2::new(9.0 - 0.41 * east, 46.25 - 0.41 * north);
                let ahead = ground.curve(kind, from, DVec2::new(9.0, 46.25));
                let whole = ground.curve(kind, from, ahead.at(2.3));
                let to = whole.at(1.0);
                let written = format!("[{},{}],[{},{}]", from.x, from.y, to.x, to.y);
                let scene = with_edges(globe, edges, &line(&written), LINE);
                let drawn = vertices(&scene.layers[0].features);
                let tolerance = 0.01 * if globe.cell < 1.0 { globe.cell * 77_000.0 } else { globe.cell };
                let half = 2.0 * if globe.cell < 1.0 { globe.cell * 111_000.0 } else { globe.cell };
                let is_there = |p: &Plan| p.x.abs() <= half && p.y.abs() <= half;
                // Steps much shorter than the edges' own.
                let near = (half * 1.7) / whole.length();
                let share = ahead.length() / whole.length();
                let curve: Vec<Plan> = (0..=400)
                    .map(|k| share + near * (f64::from(k) / 200.0 - 1.0))
                    .filter(|share| (0.0..=1.0).contains(share))
                    .map(|share| whole.at(share))
                    .map(|p| globe.local(&scene, p.x, p.y))
                    .collect();
                let off = curve.iter().filter(|p| is_there(p)).map(|p| away(*p, &drawn)).fold(0.0, max);
                assert!(off <= tolerance, "{} {edges} {east} {north}: {off} m", globe.crs);
                let back = drawn.iter().filter(|p| is_there(p)).map(|p| away(*p, &curve)).fold(0.0, max);
                assert!(back <= tolerance, "{} {edges} {east} {north}: {back} m back", globe.crs);
                assert!(drawn.len() < 200, "{} {edges} {east}: {}", globe.crs, drawn.len());
            }
        }
    }
}

#[test]
fn neighbours_keep_sharing_an_edge_on_the_ground() {
    let ground = Geodesy::of(&Crs::crs84().unwrap()).unwrap();
    for (edges, kind) in [("geodesic", CurveKind::Geodesic), ("rhumb", CurveKind::RhumbLine)] {
        let on = ground.curve(kind, DVec2::new(-3.0, 45.25), DVec2::new(20.0, 46.54)).at(0.52);
        let on = (on * 1000.0).round() / 1000.0;
        let plans =
            [Globe::around("EPSG:32632", on.x, on.y, 100.0), Globe::degrees(on.x, on.y).with_cell(0.001)];
        for globe in plans {
            let pair = format!(
                r#"{{"type":"FeatureCollection","features":[{{"type":"Feature","properties":{{}},"geometry":{}}},{{"type":"Feature","properties":{{}},"geometry":{}}}]}}"#,
                polygon("[[-3,45.25],[20,46.54],[9,58],[-3,45.25]]"),
                polygon("[[20,46.54],[-3,45.25],[9,34],[20,46.54]]")
            );
            let scene = with_edges(&globe, edges, &pair, "fill = { color = \"#000000\" }");
            let near = |ring: &[Plan]| -> Vec<Plan> {
                let mut kept: Vec<Plan> =
                    ring.iter().copied().filter(|p| max(p.x.abs(), p.y.abs()) < 4e5).collect();
                kept.sort_by(|a, b| a.x.total_cmp(&b.x));
                kept
            };
            let all = rings(&scene.layers[0].features);
            let shared = near(all[0]);
            assert!(shared.len() > 3, "{} {edges}: {}", globe.crs, shared.len());
            assert_eq!(shared, near(all[1]), "{} {edges}", globe.crs);
        }
    }
}

/// A plan around the northern pole, with a terrain 800 km wide.
fn arctic() -> Globe {
    Globe::metres("EPSG:3413", 0.0, 0.0, 200_000.0)
}

#[test]
fn an_edge_to_a_pole_is_a_meridian_and_one_between_opposite_meridians_leads_over_it() {
    let globe = arctic();
    let pole = |scene: &Scene| globe.local(scene, 0.0, 90.0);
    for edges in ["geodesic", "rhumb"] {
        for written in ["[10,80],[77,90]", "[77,90],[10,80]", "[10,80],[-170,90]", "[370,80],[77,90.0000001]"]
        {
            let scene = with_edges(&globe, edges, &line(written), LINE);
            let drawn = vertices(&scene.layers[0].features);
            let (a, b) = (globe.local(&scene, 10.0, 80.0), pole(&scene));
            assert!(drawn.iter().all(|p| away(*p, &[a, b]) < 1e-3), "{edges} {written}: {drawn:?}");
        }
    }
    for written in
        ["[10,80],[190,85]", "[190,85],[10,80]", "[10,80],[-170,85]", "[10,80],[190.0000000001,85]"]
    {
        let scene = with_edges(&globe, "geodesic", &line(written), LINE);
        let drawn = vertices(&scene.layers[0].features);
        assert!(away(pole(&scene), &drawn) < 1e-3, "{written}");
        let ends = [globe.local(&scene, 10.0, 80.0), globe.local(&scene, 190.0, 85.0)];
        assert!(drawn.iter().all(|p| away(*p, &ends) < 1.0), "{written}: {drawn:?}");
    }
}

#[test]
fn antipodes_are_joined_over_the_northern_pole_from_both_sides() {
    let globe = arctic();
    for (lon, lat) in [(10.0, 30.0), (10.0, -30.0), (-60.0, 0.0), (0.0, 90.0)] {
        let ends = (format!("[{lon},{lat}]"), format!("[{},{}]", lon + 180.0, -lat));
        for written in [format!("{},{}", ends.0, ends.1), format!("{},{}", ends.1, ends.0)] {
            let scene = with_edges(&globe, "geodesic", &line(&written), LINE);
            let drawn = vertices(&scene.layers[0].features);
            let at = |lon: f64, lat: f64| globe.local(&scene, lon, lat);
            assert!(away(at(0.0, 90.0), &drawn) < 1e-3, "{written}");
            if lat != 90.0 {
                assert!(
                    away(at(lon, 88.0), &drawn) < 1.0 && away(at(lon + 180.0, 88.0), &drawn) < 1.0,
                    "{written}"
                );
            }
        }
    }
}

#[test]
fn a_ring_around_a_pole_stays_closed_and_its_edges_lead_nearer_to_it() {
    let globe = arctic();
    let triangle = "[[0,87],[120,87],[-120,87],[0,87]]";
    for (edges, covered) in [("projected", true), ("rhumb", true), ("geodesic", false)] {
        let scene = filled(&globe, edges, triangle);
        assert!(globe.covers(&scene, 33.0, 89.9) && globe.covers(&scene, 60.0, 88.7), "{edges}");
        assert_eq!(globe.covers(&scene, 60.0, 88.0), covered, "{edges}");
        assert!(!globe.covers(&scene, 0.5, 86.9), "{edges}");
        assert!(says(&scene, "rings around a pole, closed by way of it: 1"), "{:?}", scene.notes);
    }
    // Half a disc: the third edge leads over the pole.
    for ring in ["[[0,87],[90,87],[180,87],[0,87]]", "[[0,87],[180,87],[90,87],[0,87]]"] {
        let scene = filled(&globe, "geodesic", ring);
        for (lon, covered) in
            [(1.0, true), (90.0, true), (179.0, true), (181.0, false), (270.0, false), (359.0, false)]
        {
            assert_eq!(globe.covers(&scene, lon, 89.5), covered, "{ring} {lon}");
        }
    }
    // A corner at the pole, whose longitude says nothing.
    for lon in [0.0, 45.0, 200.0, -170.0] {
        let scene = filled(&globe, "geodesic", &format!("[[0,87],[60,87],[{lon},90],[0,87]]"));
        for (at, covered) in [(1.0, true), (59.0, true), (-1.0, false), (61.0, false), (200.0, false)] {
            assert_eq!(globe.covers(&scene, at, 89.0), covered, "{lon} {at}");
        }
    }
}

#[test]
fn edges_lead_the_short_way_over_the_antimeridian_on_any_turn() {
    let ground = Geodesy::of(&Crs::crs84().unwrap()).unwrap();
    let plans = [
        Globe::degrees(180.0, 52.0),
        Globe::degrees(-180.0, 52.0),
        Globe::around("EPSG:32660", 180.0, 52.0, 40_000.0),
    ];
    for globe in &plans {
        for (edges, kind) in [("geodesic", CurveKind::Geodesic), ("rhumb", CurveKind::RhumbLine)] {
            let curve = ground.curve(kind, DVec2::new(170.0, 50.0), DVec2::new(190.0, 54.0));
            for written in [
                "[170,50],[190,54]",
                "[170,50],[-170,54]",
                "[-190,50],[-170,54]",
                "[530,50],[550,54]",
                "[-170,54],[170,50]",
            ] {
                let scene = with_edges(globe, edges, &line(written), LINE);
                let drawn = vertices(&scene.layers[0].features);
                for share in [0.47, 0.5, 0.52] {
                    let p = curve.at(share);
                    let off = away(globe.local(&scene, p.x, p.y), &drawn);
                    assert!(off < 300.0, "{} {edges} {written}: {off}", globe.crs);
                }
            }
        }
        let scene = filled(globe, "geodesic", &rectangle(170.0, 50.0, -170.0, 52.0));
        for (lon, lat, covered) in
            [(179.8, 52.3, true), (-179.8, 52.3, true), (180.0, 52.45, false), (179.9, 51.7, true)]
        {
            assert_eq!(globe.covers(&scene, lon, lat), covered, "{} {lon} {lat}", globe.crs);
        }
    }
}

#[test]
fn a_frame_of_the_world_stays_as_it_is_written() {
    let hole = rectangle(10.3, 45.3, 10.7, 45.7);
    for globe in [Globe::degrees(10.5, 45.5), Globe::around("EPSG:32632", 10.5, 45.5, 20_000.0)] {
        for edges in ["geodesic", "rhumb"] {
            let scene = filled(&globe, edges, &format!("{},{hole}", rectangle(-180.0, -85.0, 180.0, 85.0)));
            for (lon, lat, covered) in
                [(10.1, 45.1, true), (10.29, 45.5, true), (10.5, 45.5, false), (10.5, 45.72, true)]
            {
                assert_eq!(globe.covers(&scene, lon, lat), covered, "{} {edges} {lon}", globe.crs);
            }
        }
    }
}

#[test]
fn data_that_is_not_in_degrees_has_no_edges_on_the_ground() {
    let style = "edges = \"geodesic\"\nline = { color = \"#000000\", width_m = 4.0 }";
    let refused = |crs: &str, layer: &str| {
        let written = line("[600000,5100000],[600100,5100100]");
        let folder = Folder::new()
            .with("d.asc", grid((5, 5), (600_000.0, 5_100_000.0), 30.0, |_, _| 0.0))
            .with("l.geojson", written);
        let text = format!(
            "terrain = {{ source = \"d.asc\"{crs} }}\n[[layer]]\nsource = \"l.geojson\"\n{layer}{style}"
        );
        folder.refused(&text)
    };
    let error = refused(", crs = \"EPSG:32632\"", "crs = \"EPSG:32632\"\n");
    assert!(
        error.what().contains("EPSG:32632") && error.what().contains("is a plane, not in degrees"),
        "{error}"
    );
    assert!(error.help_text().unwrap().contains("for data in degrees"), "{error}");
    assert!(error.what().starts_with("`layer.l.edges`: "), "{error}");
    let error = refused("", "");
    assert!(error.what().contains("of the terrain no CRS is known"), "{error}");
    let flat = "crs = \"+proj=longlat +a=60268000 +b=54364000\"\n";
    assert!(refused(", crs = \"EPSG:32632\"", flat).what().contains("flatter than 1/50"));
}
