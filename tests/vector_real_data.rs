//! The vector readers on published data, where it is at hand.
//!
//! Vertices are counted as the files store them, closing vertices of rings included, which is also how GDAL counts.
#![cfg(feature = "gpkg")]
#![allow(clippy::unwrap_used, clippy::print_stdout)] // helpers of tests may stop a test and say what is skipped

use drapery::crs::{Crs, PlanSpace};
use drapery::scene::{Attribute, Shape};
use drapery::source::vector::{ColumnSummary, VectorSummary, describe, doubts, read, read_columns};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A file of the data folder, unpacked beside its .prj into `scratch` where it is packed; `None` where it cannot be had.
fn data(scratch: &Path, name: &str) -> Option<PathBuf> {
    let folder = std::env::var_os("DRAPERY_DATA")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data"), PathBuf::from);
    let plain = folder.join(name);
    if plain.is_file() {
        return Some(plain);
    }
    let packed = folder.join(format!("{name}.xz"));
    let output = packed
        .is_file()
        .then(|| Command::new("xz").args(["-dkc"]).arg(&packed).output().ok())
        .flatten()
        .filter(|o| o.status.success());
    let Some(output) = output else {
        println!("skipped: {name} is not at hand (set DRAPERY_DATA; .xz needs the xz command)");
        return None;
    };
    let target = scratch.join(plain.file_name()?);
    std::fs::write(&target, output.stdout).ok()?;
    let _ = std::fs::copy(plain.with_extension("prj"), target.with_extension("prj"));
    Some(target)
}

fn with_data(name: &str, check: impl FnOnce(&Path)) {
    let scratch = tempfile::tempdir().unwrap();
    if let Some(path) = data(scratch.path(), name) {
        check(&path);
    }
}

fn only(path: &Path) -> VectorSummary {
    let all = describe(path).unwrap();
    assert_eq!(all.len(), 1);
    all.into_iter().next().unwrap()
}

/// Features, vertices and CRS of a file with one layer.
fn check(name: &str, features: usize, vertices: usize, epsg: u32) {
    with_data(name, |path| {
        let found = only(path);
        assert_eq!((found.features, found.vertices), (features, vertices), "{name}: {:?}", found.notes);
        let crs = found.crs.expect(name);
        assert!(crs.is_same(&Crs::from_epsg(epsg).unwrap()), "{name}: {crs:?}");
    });
}

#[test]
fn shapefiles_hold_what_their_publishers_say() {
    check("swellendam/roads_33S.shp", 345, 9093, 32733);
    check("swellendam/farms_33S.shp", 2008, 41685, 32733);
    check("swellendam/urban_33S.shp", 6, 16893, 32733);
    check("swellendam/water_33S.shp", 6, 198, 32733);
    check("swellendam/protected_areas.shp", 2, 189, 4326);
    check("gredos/watersheds_106.shp", 106, 12808, 23030);
    check("gredos/watersheds_9.shp", 9, 4544, 23030);
    check("oetztal/rgi_oetztal.shp", 20, 11613, 4326);
    check("oetztal/rgi7g_hef_complex.shp", 23, 10384, 4326);
    check("oetztal/rgi_intersect_oetztal.shp", 112, 524, 4326);
    check("baltoro/baltoro_wgs84.shp", 1, 8346, 4326);
    check("baltoro/centerlines_baltoro_wgs84.shp", 98, 6333, 4326);
    check("voids/flatten_mt_rainier.shp", 1, 5, 4326);
}

#[test]
fn alpine_shapefiles_are_in_austrias_lambert_projection() {
    check("avalanche/avaAlr/relAlr.shp", 1, 33, 31287);
    check("avalanche/avaMal/relMalRegional.shp", 6, 117, 31287);
    check("avalanche/avaGar/pathAB.shp", 3, 22, 31287);
    check("avalanche/avaKot/dam.shp", 1, 6, 31287);
    check("avalanche/avaKot/resistance.shp", 2, 17, 31287);
    check("avalanche/avaPfa/relPfa.shp", 1, 40, 31287);
}

#[test]
fn large_shapefiles_hold_what_their_publishers_say() {
    check("atlantic_3600/contours.shp", 10535, 235_231, 4326);
    check("new_zealand/nz_coast.shp", 9139, 720_030, 2193);
    check("us_counties/cb_2023_us_county_5m.shp", 3235, 227_627, 4269);
}

#[test]
fn a_geopackage_of_one_layer_needs_no_name() {
    check("zion/zion.gpkg", 1, 622, 32612);
}

#[test]
fn a_geopackage_of_many_layers_is_read_by_name() {
    with_data("swellendam/training_data.gpkg", |path| {
        assert!(read(path, None).unwrap_err().to_string().contains("'roads'"));
        let all = describe(path).unwrap();
        let layer = |name: &str| all.iter().find(|s| s.layer.as_deref() == Some(name)).unwrap();
        assert_eq!((layer("roads").features, layer("roads").vertices), (717, 9652));
        assert_eq!((layer("buildings").features, layer("buildings").vertices), (4708, 31868));
        assert_eq!(layer("roads").crs.as_ref().and_then(Crs::epsg), Some(4326));
    });
}

#[test]
fn geopackage_and_shapefile_of_one_source_are_equal() {
    with_data("atlantic_3600/dimensions.gpkg", |gpkg| {
        with_data("atlantic_3600/contours.shp", |shp| {
            let from_gpkg = read(gpkg, Some("contours")).unwrap();
            let from_shp = read(shp, None).unwrap();
            assert_eq!(from_gpkg.features.len(), 10535);
            assert!(from_gpkg.features == from_shp.features);
        });
    });
}

#[test]
fn vectors_in_degrees_meet_the_terrain_of_the_same_place_in_metres() {
    with_data("swellendam/training_data.gpkg", |path| {
        let roads = read(path, Some("roads")).unwrap();
        let plan = PlanSpace::projected(Crs::from_epsg(32733).unwrap()).unwrap();
        let map = plan.plan_from(&roads.crs.unwrap()).unwrap();
        for feature in &roads.features {
            for p in feature.shape.parts().flatten() {
                let q = map.apply(p.to_vec()).unwrap();
                // The bounds of swellendam/srtm_41_19.tif.
                assert!((969_491.3..1_038_119.8).contains(&q.x) && (6_196_099.3..6_250_297.0).contains(&q.y));
                assert!((map.invert(q).unwrap() - p.to_vec()).length() < 1e-9);
            }
        }
    });
}

#[test]
fn towns_are_points() {
    with_data("swellendam/places_33S.shp", |path| {
        let found = read(path, None).unwrap();
        assert!(
            found.features.iter().all(|f| matches!(&f.shape, Shape::Points(points) if points.len() == 1))
        );
        assert_eq!((found.features.len(), found.notes.len()), (11, 0));
    });
}

/// Both files are published with an index that belongs to other contents: programs that follow it (GDAL) see 19 rivers
/// of 1938 vertices, and stop at the 31st water. The records themselves are whole.
#[test]
fn a_shapefile_with_a_foreign_index_is_read_whole_and_reported_by_feature() {
    for (name, features, vertices, first_wrong) in
        [("swellendam/water.shp", 37, 554, 30), ("swellendam/rivers.shp", 20, 4404, 12)]
    {
        with_data(name, |path| {
            let found = only(path);
            assert_eq!((found.features, found.vertices), (features, vertices), "{name}");
            let note = found.notes.iter().find(|n| n.contains(".shx")).expect(name);
            assert!(note.contains(&format!("from feature {first_wrong} on")), "{note}");
        });
    }
}

#[test]
fn metres_under_degrees_load_with_a_note() {
    with_data("avalanche/avaMal/pathAB.shp", |path| {
        let found = read(path, None).unwrap();
        assert_eq!(found.features.len(), 2);
        let doubts = doubts(found.crs.as_ref().unwrap(), &found.features);
        assert!(doubts.iter().any(|n| n.contains("off the globe")), "{doubts:?}");
    });
}

fn with_columns(name: &str, check: impl FnOnce(&Path, &[ColumnSummary])) {
    with_data(name, |path| check(path, &describe(path).unwrap().remove(0).columns));
}

fn told(columns: &[ColumnSummary], name: &str) -> String {
    let column = columns.iter().find(|column| column.name == name).unwrap();
    format!("{} {} {:?}", column.kind, column.values, column.range)
}

#[test]
fn the_roads_of_swellendam_have_a_type_and_lanes() {
    with_columns("swellendam/roads_33S.shp", |path, columns| {
        let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
        assert_eq!(names, ["TYPE", "NAME", "ONEWAY", "LANES"]);
        let types = columns[0].distinct.as_ref().unwrap();
        let counts: usize = types.iter().map(|(_, count)| count).sum();
        assert_eq!((types.len(), counts, columns[0].values), (10, 345, 345), "{types:?}");
        assert_eq!(told(columns, "LANES"), "whole numbers 345 Some([0.0, 2.0])");
        let read = read_columns(path, None, &["TYPE".into()]).unwrap();
        assert_eq!(read.columns[0].values[..2], ["secondary", "tertiary"].map(|t| Attribute::Text(t.into())));
    });
}

#[test]
fn glaciers_of_the_alps_have_names_in_the_code_page_of_their_cpg() {
    with_columns("oetztal/rgi_oetztal.shp", |path, columns| {
        assert_eq!(columns.len(), 18);
        assert_eq!(told(columns, "Zmax"), "whole numbers 20 Some([3235.0, 3715.0])");
        let read = read_columns(path, None, &["Name".into(), "Area".into()]).unwrap();
        assert_eq!(read.columns[0].values[0], Attribute::Number(1.64));
        let hintereis =
            |value: &&Attribute| value.text().is_some_and(|name| name.starts_with("Hintereisferner"));
        let name = read.columns[1].values.iter().find(hintereis).and_then(Attribute::text);
        assert!(name.is_some_and(|name| name.ends_with('\u{c0}')), "ISO 8859-1, as the .cpg says: {name:?}");
    });
}

#[test]
fn roads_of_openstreetmap_are_its_ways_with_tags() {
    with_columns("porto_alegre/poa_osm.pbf", |path, columns| {
        let summary = only(path);
        // 15,984 of its 16,032 ways have tags, with 66,489 nodes; all of its 23 relations are multipolygons.
        assert_eq!((summary.features, summary.polygons + summary.lines), (15_984 + 23, 16_007));
        assert!(
            summary.vertices > 66_489 && summary.notes.iter().any(|note| note.starts_with("6140 points"))
        );
        assert!(columns.iter().any(|column| column.name == "highway"));
        let read = read_columns(path, None, &["highway".into()]).unwrap();
        let primary = read.columns[0].values.iter().filter(|value| value.text() == Some("primary"));
        assert_eq!(primary.count(), 529);
    });
}

#[test]
fn geopackages_have_columns_by_layer() {
    with_columns("zion/zion.gpkg", |_, columns| {
        assert_eq!((columns.len(), columns[0].name.as_str()), (12, "fid"));
        assert_eq!(told(columns, "STATE"), "text 1 None");
    });
    with_columns("atlantic_3600/dimensions.gpkg", |path, _| {
        let read = read_columns(path, Some("contours"), &["elev".into()]).unwrap();
        let elevations = &read.columns[0].values;
        assert_eq!(elevations.len(), 10535);
        assert!(elevations.iter().all(|e| e.number().is_some_and(|e| e % 500.0 == 0.0)));
    });
}
