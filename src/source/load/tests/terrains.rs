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
