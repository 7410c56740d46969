//! Terrain of several files, and what a scene says of a file's heights.

use super::*;

#[test]
fn several_files_are_one_terrain_in_their_crs() {
    let folder = Folder::new()
        .with("a.asc", grid((5, 4), (500_000.0, 5_100_000.0), 10.0, hills))
        .with("b.asc", grid((5, 4), (500_040.0, 5_100_000.0), 10.0, hills));
    let load = |files: &str| {
        folder.load(&format!("terrain = {{ source = [{files}], crs = \"EPSG:32633\" }}")).unwrap()
    };
    let (scene, surface) = load("\"a.asc\", \"b.asc\"");
    assert!(
        scene.notes.iter().any(|n| n.contains("2 files as one grid of 9 x 4 posts")),
        "{:?}",
        scene.notes
    );
    let posts = posts(surface);
    assert_eq!((posts.columns(), posts.rows()), (9, 4));
    let middle = scene.origin.truncate();
    for i in [0, 4, 8] {
        let at = posts.plan(i, 1).to_vec() + middle;
        assert_eq!(posts.world(i, 1).z, hills(at.x, at.y));
    }
    let (_, one) = load("\"a.asc\"");
    assert_eq!(super::posts(one).columns(), 5);
    let error = folder.refused("terrain = { source = [\"a.asc\", \"c.asc\"] }");
    assert_eq!(error.what(), "there is no file `c.asc`");
    for wrong in ["[]", "[\"\"]", "[1]", "{}"] {
        folder.refused(&format!("terrain = {{ source = {wrong} }}"));
    }
}

#[test]
fn a_scene_can_say_which_value_means_no_data() {
    let ascii = "ncols 2\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 10\n1 2\n3 -500\n";
    let folder = Folder::new().with("d.asc", ascii);
    let (_, surface) = folder.load("terrain = { source = \"d.asc\", nodata = -500 }").unwrap();
    assert!(posts(surface).world(1, 0).z.is_nan());
    let error = folder.refused("terrain = { source = \"d.asc\", band = 2 }");
    assert!(error.what().contains("one band"), "{error}");
    let error = folder.refused("terrain = { generate = { kind = \"plane\" }, nodata = 1 }");
    assert!(error.what().contains("`terrain.nodata`"), "{error}");
}

#[test]
fn heights_of_no_stated_unit_in_a_crs_of_feet_are_told() {
    let folder = Folder::new().with("d.asc", grid((5, 4), (980_000.0, 200_000.0), 10.0, hills));
    let notes = |crs: &str| {
        let text = format!("terrain = {{ source = \"d.asc\", crs = \"{crs}\" }}");
        folder.load(&text).unwrap().0.notes
    };
    let feet = notes("EPSG:2263");
    assert!(feet.iter().any(|n| n.contains("vertical_scale = 0.3048006")), "{feet:?}");
    let metres = notes("EPSG:32618");
    assert!(!metres.iter().any(|n| n.contains("vertical_scale")), "{metres:?}");
}

#[test]
fn the_vertical_part_of_a_crs_that_the_scene_states_is_the_unit_of_heights() {
    let folder = Folder::new().with("d.asc", grid((5, 4), (980_000.0, 200_000.0), 10.0, |_, _| 1000.0));
    let load = |text: &str| {
        let (scene, surface) = folder.load(text).unwrap();
        (posts(surface).world(1, 1).z, scene.notes)
    };
    for (crs, expected, word) in [
        ("EPSG:2263+6360", 1000.0 * 1200.0 / 3937.0, "US survey feet"),
        ("EPSG:32618+8228", 304.8, "feet"),
        ("EPSG:32618+5715", -1000.0, "depths"),
        ("EPSG:2263+5703", 1000.0, ""),
        ("EPSG:32618", 1000.0, ""),
    ] {
        let (z, notes) = load(&format!("terrain = {{ source = \"d.asc\", crs = \"{crs}\" }}"));
        assert!((z - expected).abs() < 1e-9, "{crs}: {z}");
        let told = notes.iter().any(|note| !word.is_empty() && note.contains(word));
        assert_eq!(told, !word.is_empty(), "{crs}: {notes:?}");
        assert!(!notes.iter().any(|note| note.contains("nothing says in which")), "{crs}: {notes:?}");
    }
    let (z, notes) =
        load("crs = \"EPSG:32618+8228\"\nterrain = { source = \"d.asc\", crs = \"EPSG:32618\" }");
    assert!(z == 1000.0 && notes.iter().any(|note| note.contains("whatever the vertical part")), "{notes:?}");
    let unknown = folder.refused("terrain = { source = \"d.asc\", crs = \"EPSG:9518\" }");
    assert!(unknown.to_string().contains("EPSG:4326+3855"), "{unknown}");
    // What the file says itself is not said twice.
    let prj = r#"VERTCS["NAVD88",VDATUM["n"],UNIT["Foot",0.3048]]"#;
    std::fs::write(folder.path("d.prj"), prj).unwrap();
    let (z, notes) = load("terrain = { source = \"d.asc\", crs = \"EPSG:2263+6360\" }");
    assert!(
        (z - 304.8).abs() < 1e-9 && notes.iter().any(|note| note.contains("is not used")),
        "{z} {notes:?}"
    );
}

/// A hill that goes around the globe without a seam, by degrees.
fn around(lon: f64, lat: f64) -> f64 {
    1000.0 + 300.0 * crate::math::cos((lon - 170.0).to_radians()) + 2.0 * lat
}

/// The posts of a terrain in one CRS on a plan in another, each with its place in degrees on WGS 84.
fn resampled(file: String, crs: &str, plan: &str) -> Vec<(DVec2, f64)> {
    let folder = Folder::new().with("d.asc", file);
    let text = format!("crs = \"{plan}\"\nterrain = {{ source = \"d.asc\", crs = \"{crs}\" }}");
    let (scene, surface) = folder.load(&text).unwrap();
    let posts = posts(surface);
    let space = PlanSpace::projected(Crs::parse(plan).unwrap()).unwrap();
    let map = space.plan_from(&Crs::crs84().unwrap()).unwrap();
    let all = (0..posts.rows()).flat_map(|j| (0..posts.columns()).map(move |i| (i, j)));
    let place = |(i, j): (usize, usize)| {
        let at = posts.plan(i, j).to_vec() + scene.origin.truncate();
        (map.invert_unrolled(at).unwrap(), posts.world(i, j).z)
    };
    all.map(place).collect()
}

#[test]
fn a_terrain_across_the_antimeridian_is_resampled_whole() {
    let plans = ["EPSG:32701", "EPSG:32760", "EPSG:3832", "EPSG:3857", "EPSG:3994"];
    for (plan, west) in plans.into_iter().flat_map(|plan| [179.0, -181.0].map(|west| (plan, west))) {
        let found = resampled(grid((21, 11), (west, -17.5), 0.1, around), "EPSG:4326", plan);
        let turned = |lon: f64| lon - 360.0 * (lon / 360.0).floor();
        let mut seen = [0, 0];
        for (at, z) in &found {
            let lon = turned(at.x);
            if (179.1..180.9).contains(&lon) && (-17.4..-16.6).contains(&at.y) {
                assert!((z - around(lon, at.y)).abs() < 0.01, "{plan} from {west}: {at} {z}");
                seen[usize::from(lon > 180.0)] += 1;
            }
        }
        assert!(
            seen[0] > 40 && seen[1] > 40 && found.len() < 400,
            "{plan} from {west}: {seen:?} of {}",
            found.len()
        );
    }
}

#[test]
fn a_terrain_in_mercator_metres_across_the_antimeridian_is_resampled_whole() {
    let to_degrees = 180.0 / 20_037_508.342_789_244;
    let height = |x: f64, y: f64| around(x * to_degrees, y / 1e5);
    for west in [19_930_000.0, -20_150_000.0] {
        let found =
            resampled(grid((45, 21), (west, -2_000_000.0), 5000.0, height), "EPSG:3857", "EPSG:32701");
        let inside = |at: &DVec2| (at.y + 17.2).abs() < 0.3 && (at.x.abs() - 180.0).abs() < 0.7;
        let (east, western): (Vec<_>, Vec<_>) =
            found.iter().filter(|(at, _)| inside(at)).partition(|(at, _)| at.x > 0.0);
        assert!(east.len() > 100 && western.len() > 100, "{} {}", east.len(), western.len());
        for (at, z) in east.iter().chain(&western) {
            let y = Crs::parse("EPSG:3857").unwrap().native_from_geographic(*at).unwrap().y;
            assert!((z - around(at.x, y / 1e5)).abs() < 0.01, "{west}: {at} {z}");
        }
    }
}

#[test]
fn a_terrain_of_the_whole_globe_has_no_gap_where_its_columns_meet() {
    for (plan, lat) in [("EPSG:3031", -80.0), ("EPSG:3413", 60.0)] {
        for west in [-179.5, 0.5] {
            let found = resampled(grid((360, 20), (west, lat), 1.0, around), "EPSG:4326", plan);
            let inside = |at: &DVec2| at.y > lat + 1.0 && at.y < lat + 18.0;
            let mut near_the_seam = 0;
            for (at, z) in found.iter().filter(|(at, _)| inside(at)) {
                assert!((z - around(at.x, at.y)).abs() < 0.1, "{plan} from {west}: {at} {z}");
                near_the_seam += usize::from((at.x.abs() - 180.0).abs() < 0.5 || at.x.abs() < 0.5);
            }
            assert!(near_the_seam > 20, "{plan} {near_the_seam}");
        }
    }
}
