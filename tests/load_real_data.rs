//! Whole scenes of published terrain and vectors, loaded, and starter scenes for them.
//!
//! The data lie in the folder that `DRAPERY_DATA` names, else in `../shared/data`; without them the tests say so and pass.
#![cfg(all(feature = "cli", feature = "gpkg"))]
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test says why it skips, and fails by panicking"
)]

use drapery::scene::{Layer, Scene, Shape, Surface};
use drapery::scene_file::SceneFile;
use drapery::source::load::load;
use drapery::space::Plan;
use drapery::stage::Stage;
use glam::DVec2;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A folder with copies of data files, unpacked where they need be.
struct Folder(tempfile::TempDir);

impl Folder {
    /// `None`, with a word why, where a file or an unpacker is not to be had.
    fn with(names: &[&str]) -> Option<Self> {
        let folder = Self(tempfile::tempdir().unwrap());
        names.iter().all(|name| folder.fetch(name)).then_some(folder)
    }

    fn fetch(&self, name: &str) -> bool {
        let data = std::env::var_os("DRAPERY_DATA")
            .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data"), PathBuf::from);
        let from = data.join(name);
        if !from.is_file() {
            println!("skipped: no {name} in the data folder");
            return false;
        }
        let unpacker = match from.extension().and_then(|e| e.to_str()) {
            Some("xz") => ("xz", "-dc"),
            Some("zip") => ("unzip", "-p"),
            _ => {
                for sibling in ["shx", "prj", "dbf", "cpg"].map(|e| from.with_extension(e)) {
                    let _ = std::fs::copy(&sibling, self.path(&file_name(&sibling)));
                }
                std::fs::copy(&from, self.path(&file_name(&from))).unwrap();
                return true;
            }
        };
        let into = std::fs::File::create(self.path(&file_name(&from.with_extension("")))).unwrap();
        let status = Command::new(unpacker.0).arg(unpacker.1).arg(&from).stdout(Stdio::from(into)).status();
        let done = status.is_ok_and(|s| s.success());
        if !done {
            println!("skipped: {} cannot unpack {name}", unpacker.0);
        }
        done
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn load(&self, text: &str) -> (Scene, Surface) {
        let path = self.path("s.toml");
        std::fs::write(&path, text).unwrap();
        let file = SceneFile::read(&path, &[]).unwrap_or_else(|e| panic!("{e}\n{text}"));
        load(&file, &|_| ()).unwrap_or_else(|e| panic!("{e}"))
    }

    /// What `drapery` prints when it is called in the folder.
    fn drapery(&self, arguments: &[&str]) -> String {
        let output = Command::new(env!("CARGO_BIN_EXE_drapery"))
            .args(arguments)
            .current_dir(self.0.path())
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    }
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap().to_string_lossy().into_owned()
}

fn scene(terrain: &str, vectors: &[&str]) -> String {
    let layer = |source: &&str| {
        format!(
            "[[layer]]\nsource = \"{source}\"\nline = {{ color = \"#ff7f00\", width_m = 12.0 }}\nfill = {{ color = \"#3388ff\" }}\n"
        )
    };
    format!("schema = 1\nterrain = {{ {terrain} }}\n{}", vectors.iter().map(layer).collect::<String>())
}

fn vertices(layer: &Layer) -> usize {
    let count = |shape: &Shape| shape.parts().map(Vec::len).sum::<usize>();
    layer.features.iter().map(|f| count(&f.shape)).sum()
}

/// The first vertex of the feature with this number, absolute.
fn start(scene: &Scene, layer: usize, index: usize) -> Plan {
    let feature = scene.layers[layer].features.iter().find(|f| f.index == index).unwrap();
    feature.shape.parts().next().unwrap()[0] + scene.origin.truncate()
}

fn near(a: Plan, b: (f64, f64), metres: f64) {
    let off = (a - Plan::new(b.0, b.1)).length();
    assert!(off <= metres, "{a:?} is {off} m from {b:?}");
}

fn noted(scene: &Scene, words: &str) -> bool {
    scene.notes.iter().any(|note| note.contains(words))
}

/// The starter scene for some files loads and has a terrain and a view.
fn starts(folder: &Folder, files: &[&str]) -> (Scene, Surface) {
    let text = folder.drapery(&[&["new"], files].concat());
    let (scene, surface) = folder.load(&text);
    Stage::new(scene.clone(), surface.clone()).unwrap();
    (scene, surface)
}

#[test]
fn swellendam_is_one_place_in_its_own_projection() {
    let Some(folder) = Folder::with(&[
        "swellendam/srtm_41_19.tif",
        "swellendam/roads_33S.shp",
        "swellendam/farms_33S.shp",
        "swellendam/urban_33S.shp",
    ]) else {
        return;
    };
    let files = ["roads_33S.shp", "farms_33S.shp", "urban_33S.shp"];
    let (scene, surface) = folder.load(&scene("source = \"srtm_41_19.tif\"", &files));
    assert_eq!(scene.layers.iter().map(|l| l.features.len()).collect::<Vec<_>>(), [345, 2008, 6]);
    assert_eq!(vertices(&scene.layers[0]), 9093);
    near(start(&scene, 0, 0), (971_207.485_331_881_3, 6_232_683.923_680_245), 1e-8);
    assert_eq!(scene.origin.truncate().fract(), DVec2::ZERO);
    let Surface::Grid(posts) = surface else { panic!("points") };
    let corner = posts.plan(0, 0) + scene.origin.truncate();
    near(corner, (969_491.3 + 41.0, 6_196_099.3 + 41.0), 0.1);
    assert!(!noted(&scene, "reprojected"), "{:?}", scene.notes);
    let (starter, _) = starts(&folder, &[&["srtm_41_19.tif"], &files[..]].concat());
    assert_eq!(starter.layers.len(), 3);
}

#[test]
fn swellendam_in_degrees_takes_vectors_in_metres() {
    let Some(folder) = Folder::with(&[
        "swellendam/srtm_41_19_4326.tif.xz",
        "swellendam/roads_33S.shp",
        "swellendam/training_data.gpkg.xz",
    ]) else {
        return;
    };
    let (scene, _) = folder.load(&scene("source = \"srtm_41_19_4326.tif\"", &["roads_33S.shp"]));
    assert!(
        scene.plan_space.starts_with("local plane at longitude 20.454, latitude -34.01 "),
        "{}",
        scene.plan_space
    );
    assert!(noted(&scene, "layer `roads_33S`: reprojected from"), "{:?}", scene.notes);
    // PROJ's longitudes and latitudes, times the metres in a degree there.
    near(start(&scene, 0, 0), (-33_028.424_242_5, 7_671.344_297_0), 1e-3);
    near(start(&scene, 0, 100), (-30_220.759_468_6, 25_185.445_726_4), 1e-3);
    near(start(&scene, 0, 344), (32_564.693_586_9, -22_712.970_601_5), 1e-3);
    let (starter, _) = starts(&folder, &["srtm_41_19_4326.tif", "roads_33S.shp", "training_data.gpkg"]);
    let names: Vec<&str> = starter.layers.iter().map(|l| l.name.as_str()).collect();
    assert_eq!(names, ["buildings", "restaurants", "schools", "roads_33S", "roads"]);
    assert_eq!(starter.layers[4].features.len(), 717);
}

#[test]
fn a_terrain_in_degrees_can_be_resampled_to_the_plan_of_another() {
    let Some(folder) = Folder::with(&["swellendam/srtm_41_19_4326.tif.xz", "swellendam/srtm_41_19.tif"])
    else {
        return;
    };
    let window = "window = [20.3, -34.1, 20.5, -34.0]";
    let text = format!(
        "crs = \"EPSG:32733\"\n{}",
        scene(&format!("source = \"srtm_41_19_4326.tif\", {window}"), &[])
    );
    let (scene_a, a) = folder.load(&text);
    assert!(noted(&scene_a, "resampled (bilinear)"), "{:?}", scene_a.notes);
    let (scene_b, b) = folder.load(&scene("source = \"srtm_41_19.tif\"", &[]));
    let (Surface::Grid(a), Surface::Grid(b)) = (a, b) else { panic!("points") };
    let (mut seen, mut sum) = (0, 0.0);
    for j in (0..a.rows()).step_by(3) {
        for i in (0..a.columns()).step_by(3) {
            let p = a.world(i, j);
            let off = (a.plan(i, j) + scene_a.origin.truncate()) - (b.first + scene_b.origin.truncate());
            let (c, r) = ((off.x / b.east().x).round(), (off.y / b.north().y).round());
            if !p.z.is_nan() {
                seen += 1;
                sum += (p.z - b.world(c as usize, r as usize).z).abs();
            }
        }
    }
    // The same mountains, though one file was itself warped from the other: what is left is the slope across half a cell.
    assert!(seen > 3000 && sum / f64::from(seen) < 4.0, "{} m off at {seen} posts", sum / f64::from(seen));
}

#[test]
fn gredos_has_its_watersheds_on_cell_corners() {
    let Some(folder) = Folder::with(&["gredos/dem25.tif.xz", "gredos/watersheds_106.shp"]) else {
        return;
    };
    let (scene, surface) = folder.load(&scene("source = \"dem25.tif\"", &["watersheds_106.shp"]));
    assert_eq!(scene.layers[0].features.len(), 106);
    let Surface::Grid(posts) = surface else { panic!("points") };
    let on_corner = |p: Plan| {
        let off = (p - posts.first) / 25.0 + 0.5;
        (off - off.round()).abs().max_element() < 1e-9
    };
    let features = &scene.layers[0].features;
    let all = features.iter().flat_map(|f| f.shape.parts().flatten().copied());
    let (on, count) = all.fold((0, 0), |(on, count), p| (on + usize::from(on_corner(p)), count + 1));
    assert!(on * 100 > count * 95, "{on} of {count} vertices");
}

#[test]
fn a_catchment_without_a_crs_meets_its_release_areas() {
    let Some(folder) = Folder::with(&[
        "avalanche/avaWog/avaWog.asc.xz",
        "avalanche/avaWog/relWog.shp",
        "avalanche/avaWog/pathAB.shp",
    ]) else {
        return;
    };
    let files = ["relWog.shp", "pathAB.shp"];
    let (bare, surface) = folder.load(&scene("source = \"avaWog.asc\"", &files));
    assert!(noted(&bare, "terrain: no CRS is known"), "{:?}", bare.notes);
    assert!(noted(&bare, "of the terrain no CRS is known"), "{:?}", bare.notes);
    let (told, same) = folder.load(&scene("source = \"avaWog.asc\", crs = \"EPSG:31287\"", &files));
    assert_eq!((&bare.layers, &bare.camera), (&told.layers, &told.camera));
    let (Surface::Grid(a), Surface::Grid(b)) = (surface, same) else { panic!("points") };
    assert_eq!(a.first, b.first);
    assert!(bare.layers.iter().all(|layer| !layer.features.is_empty()));
    let (starter, _) = starts(&folder, &["avaWog.asc", "relWog.shp"]);
    assert_eq!(starter.layers[0].features.len(), 1);
}

#[test]
fn glaciers_lie_on_their_mountains() {
    let Some(folder) = Folder::with(&[
        "oetztal/srtm_oetztal.tif",
        "oetztal/rgi_oetztal.shp",
        "oetztal/rgi_intersect_oetztal.shp",
    ]) else {
        return;
    };
    let (scene, _) = starts(&folder, &["srtm_oetztal.tif", "rgi_oetztal.shp", "rgi_intersect_oetztal.shp"]);
    assert_eq!(scene.layers.iter().map(|l| l.features.len()).collect::<Vec<_>>(), [20, 112]);
    assert!(scene.plan_space.starts_with("local plane"));
}

#[test]
fn a_tile_of_colours_is_placed_by_its_bounds() {
    let Some(folder) = Folder::with(&["terrain_png/fuji_mapbox.png"]) else {
        return;
    };
    // Web Mercator tile 10/906/404.
    let (side, half) = (39_135.758_482_010_24, 20_037_508.342_789_244);
    let (x, y) = (906.0 * side - half, half - 404.0 * side);
    let place = format!(
        "source = \"fuji_mapbox.png\", encoding = \"mapbox\", crs = \"EPSG:3857\", bounds = [{x}, {}, {}, {y}]",
        y - side,
        x + side
    );
    let summit = "eye_geo = [138.7274, 35.2, 9000.0]\ntarget_geo = [138.7274, 35.3606, 3776.0]";
    let (scene, surface) = folder.load(&format!("{}\n[camera]\n{summit}", scene(&place, &[])));
    let Surface::Grid(posts) = surface else { panic!("points") };
    let highest = (0..posts.heights().len())
        .map(|k| posts.world(k % posts.columns(), k / posts.columns()))
        .max_by(|a, b| a.z.total_cmp(&b.z))
        .unwrap();
    assert!((highest.plan() - scene.camera.target.plan()).length() < 1000.0, "{highest:?}");
    assert!(noted(&scene, "22.4 % longer than the ground"), "{:?}", scene.notes);
    assert!(folder.drapery(&["new", "fuji_mapbox.png"]).contains("encoding = \"mapbox\""));
    assert!(folder.drapery(&["info", "fuji_mapbox.png"]).contains("mapbox, the one that gives heights"));
}

#[test]
fn an_srtm_tile_is_drawn_in_its_local_plane() {
    let Some(folder) = Folder::with(&["riviera/N43E006.hgt.zip"]) else {
        return;
    };
    let (scene, surface) = starts(&folder, &["N43E006.hgt"]);
    assert_eq!(scene.origin.truncate(), DVec2::ZERO);
    assert!(scene.plan_space.starts_with("local plane at longitude 6.5, latitude 43.5 of EPSG:4326"));
    let Surface::Grid(posts) = surface else { panic!("points") };
    assert_eq!((posts.columns(), posts.rows()), (1201, 1201));
}

#[test]
fn posts_written_as_points_make_the_same_place() {
    let Some(folder) = Folder::with(&["swellendam/srtm_41_19.tif"]) else {
        return;
    };
    let window = "window = [1000000.0, 6220000.0, 1001000.0, 6221000.0]";
    let (grid_scene, surface) = folder.load(&scene(&format!("source = \"srtm_41_19.tif\", {window}"), &[]));
    let Surface::Grid(posts) = surface else { panic!("points") };
    let mut text = String::new();
    for k in 0..posts.heights().len() {
        let p = posts.world(k % posts.columns(), k / posts.columns());
        let q = p.plan() + grid_scene.origin.truncate();
        text += &format!("{} {} {}\n", q.x, q.y, p.z);
    }
    std::fs::write(folder.path("p.xyz"), text).unwrap();
    let (scene, surface) = folder.load(&scene("source = \"p.xyz\", crs = \"EPSG:32733\"", &[]));
    assert_eq!(scene.origin, grid_scene.origin);
    let Surface::Points(points) = &surface else { panic!("a grid") };
    assert!((points[5].plan() - posts.plan(5, 0)).length() < 1e-8);
    Stage::new(scene, surface).unwrap();
}

#[test]
fn roads_of_two_types_are_drawn_the_longest_on_top() {
    let Some(folder) = Folder::with(&["swellendam/srtm_41_19.tif", "swellendam/roads_33S.shp"]) else {
        return;
    };
    let (scene, _) = folder.load(
        "schema = 1\nterrain.source = \"srtm_41_19.tif\"\n[[layer]]\nsource = \"roads_33S.shp\"\norder = \"size\"\n\
         where = { TYPE = [\"primary\", \"trunk\"] }\n\
         line = { color = { by = \"TYPE\", map = { trunk = \"#ff0000\" }, default = \"#000000\" }, width_m = 60 }",
    );
    let layer = &scene.layers[0];
    assert_eq!((layer.features.len(), layer.styles.len()), (23, 2));
    let length = |shape: &Shape| {
        let of_part =
            |part: &Vec<Plan>| part.windows(2).map(|pair| (pair[1] - pair[0]).length()).sum::<f64>();
        shape.parts().map(of_part).sum::<f64>()
    };
    assert!(layer.features.iter().is_sorted_by_key(|feature| length(&feature.shape)));
}

#[test]
fn info_tells_what_files_hold() {
    let Some(folder) = Folder::with(&[
        "oetztal/srtm_oetztal.tif",
        "swellendam/training_data.gpkg.xz",
        "avalanche/avaWog/avaWog.asc.xz",
    ]) else {
        return;
    };
    let terrain = folder.drapery(&["info", "srtm_oetztal.tif"]);
    for words in
        ["posts       582 x 444 (258408)", "heights     387 to 3727", "EPSG:4326", "local plane at", "% off"]
    {
        assert!(terrain.contains(words), "{words}: {terrain}");
    }
    let vectors = folder.drapery(&["info", "training_data.gpkg"]);
    assert!(vectors.contains("layer `roads`\n  features    717 (717 lines)"), "{vectors}");
    let bare = folder.drapery(&["info", "avaWog.asc"]);
    assert!(
        bare.contains("-9999; 94079 posts (34.6 %) without data") && bare.contains("CRS         not stated"),
        "{bare}"
    );
}
