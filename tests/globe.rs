//! Scenes on a globe: turned twins have the same picture across the antimeridian and over the poles, the far side is hidden, widths are those on
//! the ground, and what a globe does not have is refused with the reason.
#![cfg(feature = "render")]

mod drawing;

use drapery::buffer::Values;
use drapery::compare::Image;
use drapery::scene_file::{Override, SceneFile};
use drapery::source::load;
use drapery::stage::Stage;
use drapery::technique::Kind;
use drapery::terrain::Drape;
use drapery::truth::Truth;
use std::path::PathBuf;

/// A smooth globe of cells of 10 degrees, white under a blue sky.
const WORLD: &str = r#"kind = "plane", posts = [37, 19], cell_deg = 10"#;

/// What the truth's intervals may hide twice, and the last digits of two worlds that are turned.
const SAME: f64 = 1.0 / 255.0;

/// A scene on that globe, of 60 x 60 pixels.
fn stage(camera: &str, layers: &str, changes: &[&str]) -> Stage {
    let text = format!("plan = \"globe\"\n{}", drawing::scene(WORLD, camera, layers));
    drawing::stage(&text, &[&["image.width=60", "image.height=60"], changes].concat())
}

fn colors(truth: &Truth) -> Vec<f64> {
    let plane = truth.plane("color").unwrap();
    let Values::F64(values) = &plane.values else { panic!("colours are doubles") };
    values.clone()
}

fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, drapery::math::max)
}

/// How much of each pixel is as red as the layers that these tests paint: they are red on white.
fn share(truth: &Truth) -> Vec<f64> {
    colors(truth).chunks_exact(4).map(|c| 1.0 - c[1]).collect()
}

fn straight_down(lon: f64, lat: f64, height: f64) -> String {
    format!("eye_geo = [{lon}, {lat}, {height}], target_geo = [{lon}, {lat}, 0]")
}

/// A red polygon with an outline, half opaque: what lies on it twice would be seen.
fn polygon(ring: &str) -> String {
    format!(
        "[[layer]]\nfeatures = [{{ polygon = [[{ring}]] }}]\nfill = {{ color = \"#ff0000\", opacity = 0.5 }}\n\
         outline = {{ color = \"#ff0000\", opacity = 0.5, width_m = 300000 }}\n"
    )
}

/// Asserts that two stages have the same picture, by the truth and nearly by all techniques, and gives the first one's truth.
fn assert_twins(own: &Stage, other: &Stage) -> Truth {
    let (truth, twin) = (drawing::truth_of(own), drawing::truth_of(other));
    assert!(
        difference(&colors(&truth), &colors(&twin)) <= SAME,
        "{}",
        difference(&colors(&truth), &colors(&twin))
    );
    assert!(share(&truth).iter().filter(|share| **share > 0.4).count() > 100, "something is drawn");
    assert_eq!(
        drawing::kinds_of_footprints_for(own),
        [Kind::Clipmap, Kind::InverseProjection, Kind::StaticDecal, Kind::Analytic]
    );
    for kind in drawing::kinds_of_footprints_for(own) {
        let frame = drawing::frame_of(kind, own, &[]);
        let error = drawing::errors(&truth, &Image::from_rgba8(&frame.image).unwrap());
        assert!(error.mean < 0.01, "{kind:?} {}", error.mean);
    }
    truth
}

#[test]
fn a_box_across_the_antimeridian_is_the_one_at_90_degrees_turned() {
    let at = |lon: f64| straight_down(lon, 3.0, 5e6);
    let own = stage(&at(180.0), &polygon("[170, -10], [-170, -10], [-170, 10], [170, 10]"), &[]);
    let turned = stage(&at(90.0), &polygon("[80, -10], [100, -10], [100, 10], [80, 10]"), &[]);
    let truth = assert_twins(&own, &turned);
    // Neither an outline along the seam, nor anything twice: inside all is half red.
    let middle = share(&truth)[29 * 60 + 29];
    assert!((middle - 0.5).abs() < 0.01, "{middle}");
}

#[test]
fn longitudes_may_be_written_on_any_turn() {
    let at = straight_down(180.0, 3.0, 5e6);
    let of = |ring: &str| colors(&drawing::truth_of(&stage(&at, &polygon(ring), &[])));
    let plain = of("[170, -10], [190, -10], [190, 10], [170, 10]");
    for ring in [
        "[530, -10], [550, -10], [550, 10], [530, 10]",
        "[-190, -10], [-170, -10], [-170, 10], [-190, 10]",
        "[170, -10], [180, -10], [-180, -10], [-170, -10], [-170, 10], [540, 10], [170, 10]",
    ] {
        assert!(difference(&plain, &of(ring)) <= SAME, "{ring}");
    }
}

#[test]
fn a_ring_around_a_pole_is_filled_to_the_pole_however_it_begins() {
    for side in [1.0, -1.0] {
        let ring = |lons: [f64; 4]| polygon(&lons.map(|lon| format!("[{lon}, {}]", 80.0 * side)).join(", "));
        let own = stage(&straight_down(0.0, 90.0 * side, 4e6), &ring([0.0, 90.0, 180.0, 270.0]), &[]);
        let turned = stage(&straight_down(90.0, 90.0 * side, 4e6), &ring([180.0, 90.0, 0.0, -90.0]), &[]);
        let share = share(&assert_twins(&own, &turned));
        assert!((share[30 * 60 + 30] - 0.5).abs() < 0.01 && (share[29 * 60 + 29] - 0.5).abs() < 0.01);
        // The circle at latitude 80 and its outline are 2 pi sin(10 degrees) long; half of its stroke lies outside.
        let area: f64 = share.iter().sum();
        assert!(share[0] == 0.0 && area > 100.0, "{area}");
    }
}

#[test]
fn a_lune_is_filled_to_the_pole() {
    let lune = |west: f64| {
        let east = west + 30.0;
        polygon(&format!("[{west}, 0], [{east}, 0], [{east}, -90], [{west}, -90]"))
    };
    let at = |lon: f64| straight_down(lon, -80.0, 4e6);
    let own = stage(&at(15.0), &lune(0.0), &["layer.0.outline.width_m=50000"]);
    let turned = stage(&at(105.0), &lune(90.0), &["layer.0.outline.width_m=50000"]);
    let share = share(&assert_twins(&own, &turned));
    // The pole is some 20 pixels below the middle of the picture: the lune reaches it, and ends.
    let column: Vec<f64> = (0..60).map(|row| share[row * 60 + 30]).collect();
    assert!(column[..45].iter().all(|share| *share > 0.4), "{column:?}");
    assert!(column.iter().any(|share| *share < 0.1), "{column:?}");
}

#[test]
fn a_level_of_detail_mesh_across_the_antimeridian_and_at_a_pole_is_drawn_as_the_truth_says() {
    let terrain =
        r#"kind = "sine", posts = [145, 73], cell_deg = 2.5, height_m = 60000.0, wavelength_m = 4e6"#;
    let layers = polygon("[150, 30], [-150, 30], [-120, 75], [120, 75]");
    let text =
        format!("plan = \"globe\"\n{}", drawing::scene(terrain, &straight_down(180.0, 65.0, 8e6), &layers));
    let changes = ["image.width=60", "image.height=60", "terrain.diagonal=alternating"];
    let full = drawing::stage(&text, &changes);
    let stage = drawing::stage(&text, &[&changes[..], &["terrain.lod={ error_px = 0.5 }"]].concat());
    let view = stage.view().unwrap();
    let mesh = stage.mesh_for(&view);
    assert!(mesh.triangle_ids() < full.mesh.triangle_ids() / 2, "{}", mesh.triangle_ids());
    let deviation = mesh.deviation().unwrap();
    assert!(deviation.pixels <= 0.5 && deviation.metres > 0.0 && deviation.left_out == 0, "{deviation:?}");
    let truth = drawing::truth_of(&stage);
    for kind in drawing::kinds_of_footprints_for(&stage) {
        let frame = drawing::frame_of(kind, &stage, &[]);
        let error = drawing::errors(&truth, &Image::from_rgba8(&frame.image).unwrap());
        assert!(error.mean < 0.02, "{kind:?} {}", error.mean);
    }
    assert!(drawing::kinds_for(&stage).contains(&Kind::GeometryOverlay));
    // What is draped is off by no more than the surface is: half a pixel, along its borders.
    let (own, other) = (share(&truth), share(&drawing::truth_of(&full)));
    let off: f64 = own.iter().zip(&other).map(|(a, b)| (a - b).abs()).sum();
    let red: f64 = other.iter().sum();
    assert!(red > 300.0 && off < 0.1 * red, "{off} of {red}");
    // No crack shows the sky: it is seen at the limb alone, where the surface is off by half a pixel.
    let is_sky = |c: &[f64]| c[2] > c[0] + 0.5 && c[2] > c[1] + 0.5;
    let sky = |truth: &Truth| colors(truth).chunks_exact(4).map(is_sky).collect::<Vec<_>>();
    let (own, other) = (sky(&truth), sky(&drawing::truth_of(&full)));
    for k in (0..3600).filter(|k| own[*k]) {
        let around = |at: usize| at.saturating_sub(2)..(at + 3).min(60);
        let is_near = around(k / 60).any(|row| around(k % 60).any(|column| other[row * 60 + column]));
        assert!(is_near, "sky at {}, {}", k % 60, k / 60);
    }
}

#[test]
fn what_lies_on_the_far_side_is_hidden() {
    let camera = straight_down(0.0, 0.0, 2.0 * 6_378_137.0);
    let line = |lons: &str| {
        format!(
            "[[layer]]\nfeatures = [{{ line = [{lons}] }}]\nline = {{ color = \"#ff0000\", width_m = 400000 }}\n"
        )
    };
    // From three radii the horizon is acos(1 / 3), 70.5 degrees off; cells of 10 degrees hide what is a little farther.
    let hidden = stage(&camera, &line("[85, 0], [180, 0], [275, 0]"), &[]);
    let truth = drawing::truth_of(&hidden);
    assert!(
        share(&truth)
            .iter()
            .zip(colors(&truth).chunks_exact(4))
            .all(|(share, c)| *share < 1e-9 || c[2] > 0.999)
    );
    let red = |c: &[f64]| c[0] > c[2] + 1e-9;
    assert!(!colors(&truth).chunks_exact(4).any(red));
    for kind in drawing::kinds_of_footprints_for(&hidden) {
        let frame = drawing::frame_of(kind, &hidden, &[]);
        assert!(drawing::errors(&truth, &Image::from_rgba8(&frame.image).unwrap()).mean < 0.01, "{kind:?}");
    }
    let whole = stage(&camera, &line("[-180, 0], [180, 0]"), &[]);
    let seen = colors(&drawing::truth_of(&whole));
    assert!(seen.chunks_exact(4).any(red));
}

/// A file of heights 0 around a place, in degrees.
fn plain_around(name: &str, lon: f64, lat: f64, cell: f64) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let (west, south) = (lon - 8.0 * cell, lat - 8.0 * cell);
    let rows = vec![vec!["0"; 17].join(" "); 17].join("\n");
    let head = format!("ncols 17\nnrows 17\nxllcenter {west}\nyllcenter {south}\ncellsize {cell}\n");
    std::fs::write(&path, head + &rows + "\n").unwrap();
    path
}

#[test]
fn a_width_is_the_same_on_both_axes_at_any_latitude() {
    for lat in [0.0, 40.0, 75.0, -75.0] {
        let path = plain_around(&format!("plain-{lat}.asc"), 20.0, lat, 0.004);
        let text = format!(
            "schema = 1\nplan = \"globe\"\nimage = {{ width = 48, height = 48 }}\n\
             camera = {{ eye_geo = [20, {lat}, 9000], target_geo = [20, {lat}, 0], projection = \"orthographic\", height_m = 1200 }}\n\
             terrain = {{ source = {:?}, crs = \"EPSG:4326\", color = \"#ffffff\" }}\n\
             [[layer]]\nfeatures = [{{ line = [[19.96, {lat}], [20.04, {lat}]] }}]\nline = {{ color = \"#ff0000\", width_m = 300 }}\n",
            path.to_str().unwrap()
        );
        let across = |line: &str, cells: &dyn Fn(usize) -> usize| {
            let change = format!("layer.0.features=[{{ line = {line} }}]");
            let share = share(&drawing::truth_of(&drawing::stage(&text, &[&change])));
            (0..48).map(|k| share[cells(k)]).sum::<f64>()
        };
        let level = across(&format!("[[19.96, {lat}], [20.04, {lat}]]"), &|k| k * 48 + 20);
        let upright = across(&format!("[[20, {}], [20, {}]]", lat - 0.02, lat + 0.02), &|k| 20 * 48 + k);
        // 300 of 1200 m are 12 pixels; a 128th is what strokes promise.
        for (name, width) in [("level", level), ("upright", upright)] {
            assert!((width - 12.0).abs() < 12.0 / 128.0, "{lat} {name} {width}");
        }
    }
}

#[test]
fn a_regional_terrain_is_near_its_own_zero_and_says_how_far_it_strays() {
    let path = plain_around("stray.asc", 7.0, 46.0, 0.05);
    let strays = |window: &str| {
        let text = format!(
            "schema = 1\nplan = \"globe\"\nterrain = {{ source = {:?}, crs = \"EPSG:4326\"{window} }}\n",
            path.to_str().unwrap()
        );
        let stage = drawing::stage(&text, &[]);
        assert_eq!(stage.mesh.drape(), Drape::Affine);
        assert!(stage.mesh.vertices().all(|vertex| vertex.world.to_vec().length() < 80_000.0));
        let note = stage.scene.notes.iter().find(|note| note.starts_with("globe:")).unwrap().clone();
        let words: Vec<&str> = note.split(' ').collect();
        let place = words.iter().position(|word| *word == "m").unwrap();
        words[place - 1].parse::<f64>().unwrap()
    };
    // Half a degree's hundredth: the sagitta of cells of 5.6 km, times the latitude's tangent.
    let stray = strays("");
    assert!(stray > 0.05 && stray < 3.0, "{stray}");
}

#[test]
fn posts_in_the_middle_of_cells_close_the_circle_and_the_poles() {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("cells.asc");
    let rows = vec![vec!["7"; 18].join(" "); 9].join("\n");
    std::fs::write(&path, format!("ncols 18\nnrows 9\nxllcorner -180\nyllcorner -90\ncellsize 20\n{rows}\n"))
        .unwrap();
    let text = format!(
        "schema = 1\nplan = \"globe\"\nterrain = {{ source = {:?}, crs = \"EPSG:4326\" }}\n",
        path.to_str().unwrap()
    );
    let stage = drawing::stage(&text, &[]);
    assert_eq!(stage.mesh.triangle_ids(), 18 * 8 * 2 + 2 * 18);
    let bounds = stage.mesh.plan_bounds();
    let turn = stage.scene.globe.unwrap().turn();
    assert!(
        (bounds.max.x - bounds.min.x - turn).abs() < 1e-6
            && (bounds.max.y - bounds.min.y - 0.5 * turn).abs() < 1e-6
    );
    assert_eq!(stage.scene.notes.iter().filter(|note| note.contains("half a cell from the")).count(), 2);
}

#[test]
fn a_layer_in_another_crs_is_on_the_same_ground() {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("antarctic.geojson");
    // A square around the southern pole in the polar plane, 2000 km to each side.
    let corners =
        "[[-2000000,-2000000],[2000000,-2000000],[2000000,2000000],[-2000000,2000000],[-2000000,-2000000]]";
    std::fs::write(&path, format!("{{\"type\":\"Polygon\",\"coordinates\":[{corners}]}}")).unwrap();
    let layer = format!(
        "[[layer]]\nsource = {:?}\ncrs = \"EPSG:3031\"\nfill = {{ color = \"#ff0000\" }}\n",
        path.to_str().unwrap()
    );
    let share = share(&drawing::truth_of(&stage(&straight_down(0.0, -90.0, 6e6), &layer, &[])));
    assert!(share[30 * 60 + 30] > 0.99);
    // A square has four corners: as far on both diagonals, and the same seen from all four sides.
    let turned = |k: usize| share[(k % 60) * 60 + 59 - k / 60];
    let off = (0..3600).map(|k| (share[k] - turned(k)).abs()).fold(0.0, drapery::math::max);
    assert!(off < 0.05, "{off}");
}

/// A red line or outline of some places.
fn stroke(geometry: &str, style: &str) -> String {
    let part = if geometry.contains("polygon") { "outline" } else { "line" };
    format!("[[layer]]\nfeatures = [{{ {geometry} }}]\n{part} = {{ color = \"#ff0000\", {style} }}\n")
}

#[test]
fn a_width_in_pixels_is_as_wide_along_a_parallel_as_along_a_meridian_at_any_latitude() {
    for lat in [0.0, 60.0, -80.0] {
        let path = plain_around(&format!("plain-px-{lat}.asc"), 20.0, lat, 0.02);
        let terrain = format!(
            "terrain={{ source = {:?}, crs = \"EPSG:4326\", color = \"#ffffff\" }}",
            path.to_str().unwrap()
        );
        for lens in ["", ", projection = \"orthographic\", height_m = 20000"] {
            let camera =
                format!("eye_geo = [20, {lat:?}, 20000], target_geo = [20, {lat:?}, 0], near_m = 10{lens}");
            let of = |line: &str| {
                let own = stroke(&format!("line = [{line}]"), "width_px = 7.5");
                share(&drawing::truth_of(&stage(&camera, &own, &[&terrain])))
            };
            let level = of(&format!("[19.9, {lat:?}], [20.1, {lat:?}]"));
            let upright = of(&format!("[20, {:?}], [20, {:?}]", lat - 0.1, lat + 0.1));
            let down: f64 = (0..60).map(|y| level[y * 60 + 29]).sum();
            let across: f64 = upright[29 * 60 + 21..29 * 60 + 39].iter().sum();
            assert!(
                (down - 7.5).abs() < 0.03 && (across - 7.5).abs() < 0.03,
                "{lat} {camera} {down} {across}"
            );
        }
    }
}

#[test]
fn strokes_in_pixels_know_neither_the_antimeridian_nor_the_pole() {
    let at = |lon: f64, lat: f64| straight_down(lon, lat, 5e6);
    let px = "width_px = 3.5, opacity = 0.5";
    let small = ["image.width=36", "image.height=36"];
    let twins = [
        (
            stage(
                &at(180.0, 3.0),
                &stroke("polygon = [[[170, -10], [-170, -10], [-170, 10], [170, 10]]]", px),
                &small,
            ),
            stage(
                &at(90.0, 3.0),
                &stroke("polygon = [[[80, -10], [100, -10], [100, 10], [80, 10]]]", px),
                &small,
            ),
        ),
        // Beside the seam, and as wide over it.
        (
            stage(&at(180.0, 3.0), &stroke("line = [[179.9, -20], [179.9, 20]]", px), &small),
            stage(&at(90.0, 3.0), &stroke("line = [[89.9, -20], [89.9, 20]]", px), &small),
        ),
        (
            stage(&at(0.0, 90.0), &stroke("line = [[200, 70], [200, 90], [20, 90], [20, 70]]", px), &small),
            stage(
                &at(90.0, 90.0),
                &stroke("line = [[-70, 70], [-70, 90], [110, 90], [110, 70]]", px),
                &small,
            ),
        ),
    ];
    for (own, turned) in &twins {
        let (truth, twin) = (drawing::truth_of(own), drawing::truth_of(turned));
        let off = difference(&colors(&truth), &colors(&twin));
        // Tangents of pictures from two sides of a pole have other last digits.
        assert!(off <= 2.0 * SAME, "{off}");
        assert!(share(&truth).iter().filter(|share| **share > 0.45).count() > 20, "something is drawn");
        assert!(share(&truth).iter().all(|share| *share < 0.51), "and nothing twice");
        let kinds = Kind::ALL.iter().copied();
        let kinds: Vec<Kind> = kinds.filter(|kind| drapery::technique::applies(*kind, own).is_ok()).collect();
        assert_eq!(kinds, [Kind::GeometryOverlay]);
        let frame = drawing::frame_of(Kind::GeometryOverlay, own, &[]);
        let error = drawing::errors(&truth, &Image::from_rgba8(&frame.image).unwrap());
        assert!(error.mean < 0.03, "{}", error.mean);
    }
}

#[test]
fn a_point_in_pixels_is_a_disc_on_the_screen_even_at_a_pole() {
    let own =
        "[[layer]]\nfeatures = [{ points = [[33, 90]] }]\npoint = { color = \"#ff0000\", width_px = 21 }\n";
    let share = share(&drawing::truth_of(&stage(&straight_down(0.0, 90.0, 3e6), own, &[])));
    let area: f64 = share.iter().sum();
    assert!((area / (std::f64::consts::PI * 10.5 * 10.5) - 1.0).abs() < 0.02, "{area}");
    assert!(
        share[30 * 60 + 30 + 9] > 0.9
            && share[(30 + 9) * 60 + 30] > 0.9
            && share[(30 + 9) * 60 + 30 + 9] < 0.1
    );
}

#[test]
fn dashes_are_as_long_on_the_ground_and_know_no_seam() {
    let dashed = "width_m = 100000, opacity = 0.5, dash = [300000, 200000], dash_offset = 70000";
    let line = |from: f64, to: f64| stroke(&format!("line = [[{from}, 30], [{}, 30]]", to), dashed);
    let own = stage(&straight_down(180.0, 30.0, 5e6), &line(160.0, -160.0), &[]);
    let turned = stage(&straight_down(90.0, 30.0, 5e6), &line(70.0, 110.0), &[]);
    let truth = drawing::truth_of(&own);
    assert!(difference(&colors(&truth), &colors(&drawing::truth_of(&turned))) <= SAME);
    let covered = |style: &str| -> f64 {
        let layer = stroke("line = [[90, 30], [90, 31.5]]", style);
        share(&drawing::truth_of(&stage(&straight_down(90.0, 31.0, 1e6), &layer, &[]))).iter().sum()
    };
    // 166 km along a meridian: 4 of 10 km, 2 of 40, of them drawn.
    let whole = covered("width_m = 30000");
    let some = covered("width_m = 30000, dash = [10000, 30000]");
    assert!((some / whole - 46.3 / 166.3).abs() < 0.01, "{}", some / whole);
    // A pixel is 13.8 km: five dashes with half a disc of that at both ends.
    let dots = covered("width_px = 1, dash = [10000, 30000]") / covered("width_px = 1");
    let disc = std::f64::consts::FRAC_PI_4 * 13.8;
    assert!((dots - (46.3 + 5.0 * disc) / (166.3 + disc)).abs() < 0.05, "{dots}");
}

#[test]
fn what_a_globe_does_not_have_is_refused_with_the_reason() {
    let base = format!(
        "plan = \"globe\"\n{}",
        drawing::scene(WORLD, &straight_down(0.0, 0.0, 1e7), &polygon("[0, 0], [9, 0], [9, 9]"))
    );
    let points = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("points.xyz");
    std::fs::write(&points, "0 0 1\n1 0 2\n0 1 3\n").unwrap();
    let plain = plain_around("plain.asc", 0.0, 80.0, 1.25);
    let beyond = plain_around("beyond.asc", 0.0, 80.0, 2.0);
    let wide = plain_around("wide.asc", 0.0, 0.0, 25.0);
    let source =
        |path: &PathBuf, crs: &str| format!("terrain={{ source = {:?}{crs} }}", path.to_str().unwrap());
    let wgs84 = ", crs = \"EPSG:4326\"";
    let mut others = Vec::new();
    for (change, words) in [
        ("crs=EPSG:3857".to_owned(), "names a plane"),
        ("terrain.offset=[1, 0]".into(), "cannot be moved"),
        ("layer.0.offset=[0, 1]".into(), "cannot be moved"),
        ("layer.0.order=size".into(), "measured in the plan"),
        ("layer.0.outline.mode=inset".into(), "not cut to the polygon"),
        ("layer.0.outline.dash=[1e-2, 1e-2]".into(), "more than 2^22 dashes"),
        ("layer.0.fill.invert=true".into(), "left out of an inverted fill"),
        ("camera={ eye = [1e6, 0, 1e7], target = [0, 0, 0] }".into(), "eye_geo"),
        ("layer.0.features=[{ polygon = [[[0, 0], [9, 0], [9, 200]]] }]".into(), "not a place"),
        (source(&plain, ""), "CRS is not known"),
        (source(&plain, ", crs = \"EPSG:32633\""), "is a plane"),
        (source(&plain, ", crs = \"+proj=longlat +a=0 +b=0\""), "+a"),
        (source(&points, wgs84), "scattered points"),
        (source(&beyond, wgs84), "beyond a pole"),
        (source(&wide, wgs84), "more than a turn"),
        ("plan=plane".into(), "`cell_deg` is of a globe"),
    ] {
        let file = SceneFile::parse(&base, None, &[Override::parse(&change).unwrap()]);
        let error = file.and_then(|file| load::load(&file, &|_| {}).map(|_| ()));
        let text =
            error.map_or_else(|e| format!("{e} {}", e.help_text().unwrap_or_default()), |()| "taken".into());
        if !text.contains(words) {
            others.push(format!("{change}: {text}"));
        }
    }
    assert!(others.is_empty(), "{others:#?}");
}

#[test]
fn a_scene_that_says_nothing_more_frames_the_globe() {
    let text = format!("plan = \"globe\"\nschema = 1\nterrain = {{ generate = {{ {WORLD} }} }}\n");
    let camera = drawing::stage(&text, &[]).scene.camera;
    assert!((camera.eye.to_vec().length() / 6_378_137.0 - 3.0).abs() < 1e-9, "{camera:?}");
    assert!(camera.up.z > 0.999_999);
    let region = r#"kind = "fbm", posts = [17, 17], cell_deg = 0.01"#;
    let text = format!("plan = \"globe\"\nschema = 1\nterrain = {{ generate = {{ {region} }} }}\n");
    let truth = drawing::truth_of(&drawing::stage(&text, &["image.width=30", "image.height=20"]));
    let sky = colors(&truth).chunks_exact(4).filter(|c| c.iter().all(|v| *v > 0.999)).count();
    assert!(sky < 300, "the region fills the picture: {sky} pixels of 600 are sky");
}
