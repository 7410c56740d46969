//! Terrain files in zip archives.

use super::super::{DemOptions, PngEncoding, describe, describe_guessing};
use super::tiff_writer::{Kind, Tiff};
use super::{png, posts, read_bytes, refusal, with_file};
use crate::source::zip::tests::packed;
use crate::space::Plan;

const GRID: &[u8] = b"ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 2\n1 2 3\n4 5 6\n";

#[test]
fn a_tile_in_an_archive_is_placed_by_its_own_name() {
    let tile: Vec<u8> = (0..1201_i16).flat_map(|row| [row.to_be_bytes(); 1201]).flatten().collect();
    let archive = packed(&[("readme.txt", b"hello"), ("N43E006.hgt", &tile)]);
    let posts = posts(read_bytes("download.zip", &archive, &DemOptions::default()).unwrap());
    assert!((posts.first - Plan::new(6.0, 43.0)).length() < 1e-12);
    assert_eq!(posts.world(7, 0).z, 1200.0);
}

#[test]
fn a_geotiff_in_an_archive_reads_as_beside_it_and_so_does_its_window() {
    let tiff = Tiff::new((7, 5), Kind::F32, |c, r| (c * 10 + r) as f64).bytes();
    let archive = packed(&[("dem/preview.png", &png::mapbox()), ("dem/a.tif", &tiff)]);
    let options = DemOptions { window: Some([117.0, 216.0, 125.0, 224.0]), ..DemOptions::default() };
    let [inside, beside] = [("a.zip", &archive), ("a.tif", &tiff)]
        .map(|(name, bytes)| posts(read_bytes(name, bytes, &options).unwrap()));
    assert_eq!((inside.first, inside.heights()), (beside.first, beside.heights()));
    let told = with_file("a.zip", &archive, |path| describe(&path, &DemOptions::default())).unwrap();
    assert_eq!((told.format, told.size), ("GeoTIFF", Some((7, 5))));
}

#[test]
fn what_lies_beside_a_file_in_its_archive_is_found() {
    let wkt = br#"GEOGCS["x",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]]]"#;
    let archive = packed(&[("b/g.prj", b"no"), ("a/g.prj", wkt), ("a/g.asc", GRID)]);
    let dem = read_bytes("g.zip", &archive, &DemOptions::default()).unwrap();
    assert!(format!("{:?}", dem.crs_hint).contains("WGS_1984"), "{:?}", dem.crs_hint);
    let archive = packed(&[("a.png", &png::mapbox()), ("a.pgw", b"5\n0\n0\n-5\n100\n200\n")]);
    let options = DemOptions { encoding: Some(PngEncoding::Mapbox), ..DemOptions::default() };
    let placed = posts(read_bytes("a.zip", &archive, &options).unwrap());
    assert_eq!((placed.first, placed.east().x), (Plan::new(100.0, 190.0), 5.0));
    let guessed = with_file("a.zip", &archive, |path| describe_guessing(&path, &DemOptions::default()));
    assert_eq!(guessed.unwrap().1, Some(PngEncoding::Mapbox));
}

#[test]
fn an_archive_of_no_terrain_or_of_several_says_so() {
    let several = packed(&[("N43E006.hgt", b"1"), ("N43E007.hgt", b"2")]);
    let message = refusal("a.zip", &several, &DemOptions::default());
    assert!(message.contains("N43E006.hgt and N43E007.hgt"), "{message}");
    for none in [packed(&[("roads.shp", b"1")]), packed(&[])] {
        assert!(refusal("a.zip", &none, &DemOptions::default()).contains("no terrain file"));
    }
    let arrays = packed(&[("a.npy", b"1"), ("b.npy", b"2")]);
    assert!(refusal("a.npz", &arrays, &DemOptions::default()).contains("NumPy"));
    let nested = packed(&[("a.tif", &packed(&[("a.tif", b"1")]))]);
    assert!(refusal("a.zip", &nested, &DemOptions::default()).contains("zip archive in another"));
    let cut = &packed(&[("g.asc", GRID)])[..60];
    assert!(refusal("a.zip", cut, &DemOptions::default()).contains("half a download"));
}
