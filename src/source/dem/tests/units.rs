//! Heights in other units than metres are converted, and that is said.

use super::super::{DemOptions, describe, read};
use super::tiff_writer::{Kind, Tiff, Values};
use super::{posts, read_bytes, refusal, with_file};

const SURVEY_FOOT: f64 = 1200.0 / 3937.0;

fn with_tag(tag: u16, values: Values) -> Vec<u8> {
    let mut tiff = Tiff::new((4, 4), Kind::F32, |_, _| 1000.0);
    tiff.tags.push((tag, values));
    tiff.bytes()
}

fn with_keys(keys: &[[u16; 4]]) -> Vec<u8> {
    let mut directory = vec![1, 1, 0, keys.len() as u16];
    directory.extend(keys.iter().flatten());
    with_tag(34735, Values::Shorts(directory))
}

fn with_items(items: &str) -> Vec<u8> {
    with_tag(42112, Values::Text(format!("<GDALMetadata>{items}</GDALMetadata>")))
}

#[test]
fn feet_and_depths_become_metres_however_they_are_declared() {
    let unit = r#"<Item name="UNITTYPE" sample="0" role="unittype">US survey foot</Item>"#;
    let scaled = format!(r#"{unit}<Item name="SCALE" sample="0" role="scale">0.1</Item>"#);
    let projected = [[1024, 0, 1, 1], [3072, 0, 1, 32633]];
    let keys = |vertical: &[[u16; 4]]| with_keys(&[&projected[..], vertical].concat());
    for (bytes, expected) in [
        (keys(&[[4096, 0, 1, 6360]]), 1000.0 * SURVEY_FOOT),
        (keys(&[[4096, 0, 1, 8228]]), 304.8),
        (keys(&[[4099, 0, 1, 9003]]), 1000.0 * SURVEY_FOOT),
        (keys(&[[4096, 0, 1, 5715]]), -1000.0),
        (with_items(unit), 1000.0 * SURVEY_FOOT),
        (with_items(&scaled), 1000.0 * 0.1 * SURVEY_FOOT),
    ] {
        let dem = read_bytes("a.tif", &bytes, &DemOptions::default()).unwrap();
        assert!(dem.notes.iter().any(|n| n.contains("metres (x ")), "{:?}", dem.notes);
        assert_eq!(posts(dem).heights()[0], expected);
        let told = with_file("a.tif", &bytes, |path| describe(&path, &DemOptions::default())).unwrap();
        assert_eq!(told.heights, Some([expected, expected]));
    }
}

#[test]
fn a_vertical_crs_that_is_kept_beside_the_file_counts() {
    let bytes = Tiff::new((4, 4), Kind::F32, |_, _| 1000.0).bytes();
    let wkt =
        "COMPD_CS[&quot;x&quot;,PROJCS[&quot;y&quot;],VERT_CS[&quot;z&quot;,UNIT[&quot;foot&quot;,0.3048]]]";
    for srs in [wkt, "EPSG:8701"] {
        let aux = format!("<PAMDataset><SRS>{srs}</SRS></PAMDataset>");
        let dem = with_file("a.tif", &bytes, |path| {
            std::fs::write(path.with_file_name("a.tif.aux.xml"), &aux).unwrap();
            read(&path, &DemOptions::default()).unwrap()
        });
        assert_eq!(posts(dem).heights()[0], 304.8, "{srs}");
    }
}

#[test]
fn the_unit_of_a_band_wins_over_that_of_the_crs_and_metres_stay() {
    let metre = r#"<Item name="UNITTYPE" sample="0" role="unittype">metre</Item>"#;
    let dem = read_bytes("a.tif", &with_items(metre), &DemOptions::default()).unwrap();
    assert!(dem.notes.is_empty(), "{:?}", dem.notes);
    assert_eq!(posts(dem).heights()[0], 1000.0);
    let kelvin = metre.replace("metre", "K");
    let dem = read_bytes("a.tif", &with_items(&kelvin), &DemOptions::default()).unwrap();
    assert!(dem.notes[0].contains("`K`") && dem.notes[0].contains("taken as metres"), "{:?}", dem.notes);
}

#[test]
fn a_vertical_crs_that_is_described_by_its_name_alone_is_told() {
    let with_citation = |units: &[[u16; 4]]| {
        let keys =
            [&[[1024, 0, 1, 1], [3072, 0, 1, 32633], [4096, 0, 1, 32767], [4097, 34737, 21, 0]], units];
        let keys = keys.concat();
        let mut directory = vec![1, 1, 0, keys.len() as u16];
        directory.extend(keys.iter().flatten());
        let mut tiff = Tiff::new((4, 4), Kind::F32, |_, _| 1000.0);
        tiff.tags.push((34735, Values::Shorts(directory)));
        tiff.tags.push((34737, Values::Text("NAVD88 height (ftUS)|".into())));
        read_bytes("a.tif", &tiff.bytes(), &DemOptions::default()).unwrap()
    };
    let dem = with_citation(&[[4098, 0, 1, 32767], [4099, 0, 1, 32767]]);
    let is_told = |note: &String| note.contains("`NAVD88 height (ftUS)`") && note.contains("taken as metres");
    assert!(dem.notes.iter().any(is_told), "{:?}", dem.notes);
    assert_eq!(posts(dem).heights()[0], 1000.0);
    let dem = with_citation(&[[4099, 0, 1, 9003]]);
    assert!(!dem.notes.iter().any(is_told), "{:?}", dem.notes);
    assert_eq!(posts(dem).heights()[0], 1000.0 * SURVEY_FOOT);
}

#[test]
fn a_scale_that_is_no_number_is_refused() {
    let items = r#"<Item name="SCALE" sample="0" role="scale">abc</Item>"#;
    let message = refusal("a.tif", &with_items(items), &DemOptions::default());
    assert!(message.contains("scale `abc`") && message.contains("gdal_edit.py"), "{message}");
}

#[test]
fn the_projection_file_of_an_ascii_grid_may_state_feet() {
    let grid = b"ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1000 1000\n1000 1000\n";
    let wkt = r#"COMPD_CS["x",PROJCS["y"],VERT_CS["NAVD88 height (ft)",VERT_DATUM["n",2005],UNIT["foot",0.3048],AXIS["Up",UP]]]"#;
    let depths = r#"PROJCS["x",UNIT["Meter",1.0]],VERTCS["EGM2008",VDATUM["EGM2008"],PARAMETER["Vertical_Shift",0.0],PARAMETER["Direction",-1.0],UNIT["Meter",1.0]]"#;
    let dem = with_file("a.asc", grid, |path| {
        std::fs::write(path.with_extension("prj"), depths).unwrap();
        read(&path, &DemOptions::default()).unwrap()
    });
    assert_eq!(posts(dem).heights()[0], -1000.0);
    for prj in [wkt, "Projection    UTM\nZunits        FEET\nUnits         METERS\n"] {
        let dem = with_file("a.asc", grid, |path| {
            std::fs::write(path.with_extension("prj"), prj).unwrap();
            read(&path, &DemOptions::default()).unwrap()
        });
        assert_eq!(posts(dem).heights()[0], 304.8, "{prj}");
    }
}
