//! Starter scenes of small files.

mod widths;

use super::*;
use drapery::scene_file::LayerSource;
use drapery::space::World;
use std::fs;

const GRID: &str = "ncols 3\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 100\n1 2 3\n4 5 6\n";
const BOTH: &str = r#"{"type":"FeatureCollection","features":[
    {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[0,0],[100,50]]}},
    {"type":"Feature","properties":{},"geometry":{"type":"Polygon","coordinates":[[[0,0],[100,50],[0,50],[0,0]]]}}]}"#;

const UTM: &str = r#"PROJCS["WGS 84 / UTM zone 33N",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",15],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],UNIT["metre",1]]"#;

/// Files in a folder of their own, and the paths of those that are named.
struct Folder(tempfile::TempDir);

impl Folder {
    fn with(files: &[(&str, &str)]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        files.iter().for_each(|(name, text)| fs::write(folder.path().join(name), text).unwrap());
        Self(folder)
    }

    /// The starter scene of some files, and its notes.
    fn starter(&self, names: &[&str]) -> Result<(String, Vec<String>)> {
        let paths: Vec<PathBuf> = names.iter().map(|name| self.0.path().join(name)).collect();
        starter(&Files::of(&paths, &|_| ())?, None, &|_| ())
    }
}

/// The scene that a text is.
fn parsed(text: &str) -> SceneFile {
    SceneFile::parse(text, None, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// A line, or points, or a square, with a name as GeoJSON.
fn square(x0: f64, y0: f64, side: f64) -> String {
    let (x1, y1) = (x0 + side, y0 + side);
    format!(
        r#"{{"type":"Feature","properties":{{}},"geometry":{{"type":"Polygon","coordinates":[[[{x0},{y0}],[{x1},{y0}],[{x1},{y1}],[{x0},{y1}],[{x0},{y0}]]]}}}}"#
    )
}

/// A grid of so many posts a side, so far apart, that rises by `rise` metres a post to the north.
fn slope(side: usize, cell: f64, rise: f64) -> String {
    let mut text = format!("ncols {side}\nnrows {side}\nxllcenter 0\nyllcenter 0\ncellsize {cell}\n");
    for row in (0..side).rev() {
        text += &vec![format!("{}", row as f64 * rise); side].join(" ");
        text.push('\n');
    }
    text
}

#[test]
fn a_starter_scene_parses_whatever_its_files_are_called() {
    for name in ["dem", "a \"b\" 'c' \\ #", "höhen", "'''\"\"\"", "new\nline\ttab"] {
        let (grid, json) = (format!("{name}.asc"), format!("{name}.json"));
        let folder = Folder::with(&[(&grid, GRID), (&json, BOTH)]);
        let (text, _) = folder.starter(&[&grid, &json, &json]).unwrap();
        let scene = parsed(&text);
        assert_eq!(scene.layers[1].name, format!("{name}-2"));
        let LayerSource::File { file, .. } = &scene.layers[0].source else { panic!("no file") };
        assert_eq!(file.path, folder.0.path().join(&json));
    }
}

#[test]
fn files_are_told_apart_by_what_they_are_and_areas_lie_below_lines() {
    let line = r#"{"type":"LineString","coordinates":[[0,0],[100,50]]}"#;
    let folder = Folder::with(&[("dem.asc", GRID), ("way.json", line), ("area", &square(0.0, 0.0, 50.0))]);
    let (text, _) = folder.starter(&["way.json", "area", "dem.asc"]).unwrap();
    let names: Vec<String> = parsed(&text).layers.iter().map(|layer| layer.name.clone()).collect();
    assert_eq!(names, ["area", "way"]);
}

#[test]
fn several_files_are_one_terrain_and_none_is_refused() {
    let east =
        GRID.replace("xllcenter 0", "xllcenter 200").replace("1 2 3", "3 2 1").replace("4 5 6", "6 5 4");
    let folder = Folder::with(&[("a.asc", GRID), ("b.asc", &east), ("way.json", BOTH)]);
    let (text, _) = folder.starter(&["a.asc", "way.json", "b.asc"]).unwrap();
    assert!(text.contains("a.asc\", \""), "{text}");
    let (scene, surface) = load::load(&parsed(&text), &|_| ()).unwrap();
    let drapery::scene::Surface::Grid(posts) = surface else { panic!("points") };
    assert_eq!((posts.columns(), posts.rows(), &scene.name[..]), (5, 2, "a"));
    let none = folder.starter(&["way.json"]).unwrap_err();
    assert!(none.what().contains("none of these files is a terrain"), "{none}");
}

#[test]
fn a_terrain_in_metres_does_not_get_the_degrees_of_a_geojson_that_lies_on_it() {
    let crs = |cell: &str| {
        let grid = GRID.replace("cellsize 100", cell);
        let folder = Folder::with(&[("dem.asc", &grid), ("both.json", BOTH)]);
        let (text, _) = folder.starter(&["dem.asc", "both.json"]).unwrap();
        text.lines().find(|line| line.contains("crs = ")).unwrap().to_owned()
    };
    assert!(crs("cellsize 100").starts_with("# crs = \"EPSG:...\""), "{}", crs("cellsize 100"));
    assert!(crs("cellsize 10").starts_with("crs = \"EPSG:4326\""), "{}", crs("cellsize 10"));
}

#[test]
fn a_terrain_that_states_its_crs_gets_no_example_of_another() {
    let folder = Folder::with(&[("dem.asc", GRID), ("dem.prj", UTM)]);
    let (text, _) = folder.starter(&["dem.asc"]).unwrap();
    assert!(!text.contains("crs ="), "{text}");
}

#[test]
fn all_that_drawing_would_say_is_said_and_stands_in_the_file() {
    let far = format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, square(5000.0, 5000.0, 10.0));
    let empty = r#"{"type":"FeatureCollection","features":[]}"#;
    let folder = Folder::with(&[("dem.asc", GRID), ("far.json", &far), ("empty.json", empty)]);
    let (text, notes) = folder.starter(&["dem.asc", "far.json", "empty.json"]).unwrap();
    let says = |part: &str| notes.iter().any(|note| note.contains(part));
    assert!(says("no CRS is known") && says("none of its 1 features meets the terrain"), "{notes:?}");
    assert!(says("layer `empty`: it holds nothing that is drawn"), "{notes:?}");
    let mut tables = text.split("[[layer]]");
    assert!(tables.next().unwrap().contains("# Note: no CRS is known"), "{text}");
    let far = tables.next().unwrap();
    assert!(far.contains("name = \"far\"") && far.contains("# Note: none of its 1 features"), "{text}");
    assert!(tables.next().is_none(), "{text}");
}

#[test]
fn widths_are_of_what_the_camera_shows() {
    let width = |side: f64| {
        let small =
            format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, square(30_000.0, 30_000.0, side));
        let folder = Folder::with(&[
            ("dem.asc", &slope(101, 600.0, 60.0)),
            ("small.json", &small),
            ("dem.prj", "EPSG:32633"),
        ]);
        fs::write(
            folder.0.path().join("small.json"),
            small.replacen('{', r#"{"crs":{"type":"name","properties":{"name":"EPSG:32633"}},"#, 1),
        )
        .unwrap();
        let (text, _) = folder.starter(&["dem.asc", "small.json"]).unwrap();
        let line = text.lines().find(|line| line.starts_with("outline")).unwrap().to_owned();
        let from = line.find("width_m = ").unwrap() + 10;
        line[from..].split(',').next().unwrap().parse::<f64>().unwrap()
    };
    let (near, far) = (width(300.0), width(50_000.0));
    assert!(near < 25.0, "an outline of {near} m hides a site of 300 m");
    assert!((40.0..100.0).contains(&far), "{far} m of 60 km");
}

#[test]
fn flat_land_is_exaggerated_with_a_word_and_mountains_are_not() {
    let starter =
        |rise: f64| Folder::with(&[("dem.asc", &slope(51, 100.0, rise))]).starter(&["dem.asc"]).unwrap();
    let (text, notes) = starter(0.5);
    assert!(parsed(&text).terrain.vertical_scale >= 5.0, "{text}");
    assert!(notes.iter().any(|note| note.contains("vertical_scale")), "{notes:?}");
    for rise in [20.0, 0.0] {
        let (text, notes) = starter(rise);
        assert_eq!(parsed(&text).terrain.vertical_scale, 1.0);
        assert!(!notes.iter().any(|note| note.contains("vertical_scale")), "{notes:?}");
    }
}

#[test]
fn the_terrain_fills_the_picture_and_none_of_it_is_cut_off() {
    for (side, cell, rise) in [(41, 50.0, 8.0), (41, 50.0, 0.0), (9, 3000.0, 1.0), (3, 0.01, 0.0)] {
        let folder = Folder::with(&[("dem.asc", &slope(side, cell, rise))]);
        let (text, _) = folder.starter(&["dem.asc"]).unwrap();
        let scene = drapery::Opened::parse(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        let view = scene.view().unwrap();
        let (width, height) = (scene.stage.scene.image.width as f64, scene.stage.scene.image.height as f64);
        let far = (side - 1) as f64 * cell;
        let z = parsed(&text).terrain.vertical_scale * (side - 1) as f64 * rise;
        let origin = scene.stage.scene.origin;
        // A plane: its picture is that of its corners.
        let corners = [(0.0, 0.0, 0.0), (far, 0.0, 0.0), (far, far, z), (0.0, far, z)].map(|(x, y, z)| {
            let at = World::from(glam::DVec3::new(x, y, z) - origin);
            view.screen_from_world(at).unwrap()
        });
        let camera = &scene.stage.scene.camera;
        for (x, y, z) in [(0.0, 0.0, 0.0), (far, 0.0, 0.0)] {
            let depth = (glam::DVec3::new(x, y, z) - origin - camera.eye.to_vec()).length();
            assert!(camera.near_m < depth, "{} hides what is {depth} m away: {text}", camera.near_m);
        }
        for at in corners {
            assert!((0.0..=width).contains(&at.x) && (0.0..=height).contains(&at.y), "{at:?} in {text}");
        }
        let edges = corners.iter().zip(corners.iter().cycle().skip(1));
        let area: f64 = edges.map(|(a, b)| 0.5 * (a.x * b.y - a.y * b.x)).sum();
        let share = area.abs() / (width * height);
        assert!((0.72..0.95).contains(&share), "the terrain fills {share} of the picture: {text}");
    }
}

#[test]
fn roads_have_one_hue_by_class() {
    let road = |class: &str| {
        format!(
            r#"{{"type":"Feature","properties":{{"kind":"{class}"}},"geometry":{{"type":"LineString","coordinates":[[0,0],[100,50]]}}}}"#
        )
    };
    let roads = ["primary", "residential", "odd"].map(road).join(",");
    let roads = format!(r#"{{"type":"FeatureCollection","features":[{roads}]}}"#);
    let folder = Folder::with(&[("dem.asc", GRID), ("roads.json", &roads)]);
    let (text, _) = folder.starter(&["dem.asc", "roads.json"]).unwrap();
    let scene = parsed(&text);
    let (scene, _) = load::load(&scene, &|_| ()).unwrap();
    assert_eq!(scene.layers[0].styles.len(), 2, "{text}");
    assert!(text.contains("by = \"kind\", map = { primary = "), "{text}");
}

#[test]
fn a_scene_is_not_written_over_what_it_shows() {
    let folder = Folder::with(&[("dem.asc", GRID)]);
    let path = folder.0.path().join("dem.asc");
    let arguments = Arguments { files: vec![path.clone()], output: Some(path.clone()) };
    assert!(run(&arguments).is_err());
    assert_eq!(fs::read_to_string(path).unwrap(), GRID);
}

#[test]
fn a_scene_in_another_folder_finds_its_files() {
    let folder = Folder::with(&[("dem.asc", GRID), ("both.json", BOTH)]);
    fs::create_dir(folder.0.path().join("scenes")).unwrap();
    let output = folder.0.path().join("scenes/a.toml");
    let files = ["dem.asc", "both.json"].map(|name| folder.0.path().join(name)).to_vec();
    run(&Arguments { files, output: Some(output.clone()) }).unwrap();
    drapery::open(output).unwrap();
}

#[test]
fn points_are_discs_above_all_else() {
    let towns = r#"{"type":"MultiPoint","coordinates":[[0,0],[100,50]]}"#;
    let folder = Folder::with(&[("dem.asc", GRID), ("towns.json", towns), ("both.json", BOTH)]);
    let (text, _) = folder.starter(&["towns.json", "dem.asc", "both.json"]).unwrap();
    let scene = parsed(&text);
    let names: Vec<&str> = scene.layers.iter().map(|layer| layer.name.as_str()).collect();
    assert_eq!(names, ["both", "towns"]);
    assert!(scene.layers[1].style.point.is_some() && scene.layers[1].style.line.is_none(), "{text}");
}

/// A collection of features of some properties and geometries.
fn collection(features: &[(&str, &str)]) -> String {
    let feature = |(properties, geometry): &(&str, &str)| {
        format!(r#"{{"type":"Feature","properties":{properties},"geometry":{geometry}}}"#)
    };
    let features: Vec<String> = features.iter().map(feature).collect();
    format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, features.join(","))
}

#[test]
fn tags_of_many_values_give_colors() {
    let line = r#"{"type":"LineString","coordinates":[[0,0],[100,50]]}"#;
    let area = r#"{"type":"Polygon","coordinates":[[[0,0],[100,50],[0,50],[0,0]]]}"#;
    let tags: Vec<String> = (0..300).map(|k| format!(r#"{{"highway":"odd{k}"}}"#)).collect();
    let mut features = vec![(r#"{"highway":"primary"}"#, line); 3];
    features.extend([(r#"{"highway":"residential"}"#, line); 2]);
    features.extend([(r#"{"natural":"water"}"#, area), (r#"{"natural":"wood"}"#, area)]);
    features.extend(tags.iter().map(|tag| (&tag[..], line)));
    let folder = Folder::with(&[("dem.asc", GRID), ("city.json", &collection(&features))]);
    let (text, _) = folder.starter(&["dem.asc", "city.json"]).unwrap();
    assert!(text.contains("color = { by = \"highway\", map = { primary = "), "{text}");
    assert!(
        text.contains("fill = { color = { by = \"natural\", map = { water = \"#4a9bd9\", wood = "),
        "{text}"
    );
    load::load(&parsed(&text), &|_| ()).unwrap();
}

#[test]
fn what_lies_off_the_terrain_is_counted_with_the_widths_that_are_written() {
    let line = |x: f64| format!(r#"{{"type":"LineString","coordinates":[[{x},0],[{x},6000]]}}"#);
    let lines: Vec<String> = (0..200).map(|k| line(5990.0 + f64::from(k))).collect();
    let features: Vec<(&str, &str)> = lines.iter().map(|line| ("{}", &line[..])).collect();
    let lines = collection(&features).replacen(
        '{',
        r#"{"crs":{"type":"name","properties":{"name":"EPSG:32633"}},"#,
        1,
    );
    let folder = Folder::with(&[("dem.asc", &slope(61, 100.0, 6.0)), ("dem.prj", UTM), ("a.json", &lines)]);
    let (text, notes) = folder.starter(&["dem.asc", "a.json"]).unwrap();
    let off = |notes: &[String]| notes.iter().find(|note| note.contains("off the terrain")).cloned();
    let (scene, _) = load::load(&parsed(&text), &|_| ()).unwrap();
    assert!(off(&notes).is_some(), "{notes:?}");
    assert_eq!(off(&notes), off(&scene.notes), "{text}");
}

#[test]
fn an_error_of_the_draft_names_no_place_in_it() {
    let broken = r#"{"type":"LineString","coordinates":[[0,0],[1e300,50]]}"#;
    let empty = r#"{"type":"FeatureCollection","features":[]}"#;
    for layer in [broken, empty] {
        let folder = Folder::with(&[("dem.asc", GRID), ("dem.prj", "EPSG:32633"), ("way.json", layer)]);
        if let Err(error) = folder.starter(&["dem.asc", "way.json"]) {
            assert!(!error.to_string().contains("of the scene"), "{error}");
        }
    }
    let named =
        Error::new("it is wrong").named_in(None, drapery::Position { line: 40, column: 10, length: 1 });
    assert_eq!(named.without_scene().to_string(), "it is wrong");
}

#[test]
fn heights_beyond_an_extent_of_unknown_length_are_lowered_with_a_word() {
    let steep = slope(51, 1.0, 100.0);
    let folder = Folder::with(&[("dem.asc", &steep)]);
    let (text, notes) = folder.starter(&["dem.asc"]).unwrap();
    let scale = parsed(&text).terrain.vertical_scale;
    assert!((0.001..0.01).contains(&scale), "{text}");
    assert!(notes.iter().any(|note| note.contains("times its extent")), "{notes:?}");
    let folder = Folder::with(&[("dem.asc", &steep), ("dem.prj", UTM)]);
    assert_eq!(parsed(&folder.starter(&["dem.asc"]).unwrap().0).terrain.vertical_scale, 1.0);
}

#[test]
fn a_layer_whose_crs_cannot_be_used_stands_there_as_a_comment_that_tells_what_to_do() {
    let strange = BOTH.replacen('{', r#"{"crs":{"type":"name","properties":{"name":"EPSG:6200"}},"#, 1);
    let folder =
        Folder::with(&[("dem.asc", GRID), ("dem.prj", UTM), ("odd.json", &strange), ("both.json", BOTH)]);
    let (text, notes) = folder.starter(&["dem.asc", "odd.json", "both.json"]).unwrap();
    let note = notes.iter().find(|note| note.starts_with("layer `odd`: the CRS")).unwrap();
    assert!(note.contains("cannot be used") && note.contains("ogr2ogr -t_srs"), "{note}");
    assert_eq!(parsed(&text).layers.iter().map(|layer| &layer.name[..]).collect::<Vec<_>>(), ["both"]);
    load::load(&parsed(&text), &|_| ()).unwrap();
    // What the comment has is the layer, as soon as it says its CRS.
    let (_, rest) = text.split_once("# [[layer]]\n").unwrap();
    let (commented, others) = rest.split_once("\n\n").unwrap();
    let table = commented.replace("\n# ", "\n").replacen("# ", "", 1).replace("EPSG:...", "EPSG:32633");
    let whole = format!("{}[[layer]]\n{table}\n{others}", text.split_once("# [[layer]]\n").unwrap().0);
    assert_eq!(parsed(&whole).layers[0].crs.as_deref(), Some("EPSG:32633"), "{whole}");
    load::load(&parsed(&whole), &|_| ()).unwrap();
    // Without a CRS of the terrain coordinates are taken as they are.
    let folder = Folder::with(&[("dem.asc", GRID), ("odd.json", &strange)]);
    let (text, _) = folder.starter(&["dem.asc", "odd.json"]).unwrap();
    assert_eq!(parsed(&text).layers.len(), 1, "{text}");
}

#[test]
fn a_terrain_that_states_a_crs_which_cannot_be_used_gets_no_other_and_says_why() {
    let odd = UTM.replace("Transverse_Mercator", "Barsoom");
    let metres = BOTH.replacen('{', r#"{"crs":{"type":"name","properties":{"name":"EPSG:32633"}},"#, 1);
    let folder = Folder::with(&[("dem.asc", GRID), ("dem.prj", &odd), ("both.json", &metres)]);
    let (text, _) = folder.starter(&["dem.asc", "both.json"]).unwrap();
    let line = text.lines().find(|line| line.contains("crs = ")).unwrap();
    assert!(
        line.starts_with("# crs = ") && line.contains("cannot be used: the projection 'Barsoom'"),
        "{line}"
    );
}
