//! No input makes a reader panic or take memory without bounds: it returns.

use super::super::{DemOptions, PngEncoding, describe, read};
use super::tiff_writer::{Kind, Tiff, Values};
use super::{png, with_file};
use crate::seeds;
use crate::source::zip::tests::packed;
use proptest::prelude::*;

/// Small valid files of every format.
fn valid_files() -> Vec<(&'static str, Vec<u8>)> {
    let tiff = |packing, predictor, tile, big_endian, big| Tiff {
        packing,
        predictor,
        tile,
        big_endian,
        big,
        nodata: Some("-9999"),
        tags: vec![
            (33550, Values::Doubles(vec![10.0, 10.0, 0.0])),
            (33922, Values::Doubles(vec![0.0, 0.0, 0.0, 100.0, 300.0, 0.0])),
            (34735, Values::Shorts(vec![1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 32733])),
        ],
        ..Tiff::new((9, 7), Kind::F32, |c, r| (c * r) as f64)
    };
    let masked = {
        let mask =
            Tiff { tags: vec![(254, Values::Longs(vec![4]))], ..Tiff::new((9, 7), Kind::Bit, |_, _| 1.0) };
        Tiff { more: vec![mask], ..tiff(8, 1, None, false, false) }
    };
    let grid = b"ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 2\n1 2 3\n4 5 6\n";
    vec![
        ("a.tif", masked.bytes()),
        ("a.zip", packed(&[("a.asc", grid)])),
        ("a.tif", tiff(1, 1, None, false, false).bytes()),
        ("a.tif", tiff(5, 2, Some((4, 4)), true, false).bytes()),
        ("a.tif", tiff(8, 3, Some((8, 8)), false, true).bytes()),
        ("a.tif", tiff(32773, 1, None, false, false).bytes()),
        ("a.tif", tiff(50000, 2, Some((4, 4)), false, false).bytes()),
        ("a.png", png::mapbox()),
        ("a.asc", grid.to_vec()),
        ("a.xyz", b"x y z\n0 0 1\n1 0 2\n0 1 3\n1 1 4\n".to_vec()),
    ]
}

fn try_all(name: &str, bytes: &[u8], window: Option<[f64; 4]>) {
    let options = DemOptions { window, encoding: Some(PngEncoding::Mapbox), ..DemOptions::default() };
    with_file(name, bytes, |path| {
        let outcomes = [read(&path, &options).err(), describe(&path, &options).err()];
        for error in outcomes.into_iter().flatten() {
            assert!(!error.is_internal(), "{error}");
            assert!(error.to_string().contains(name), "{error}");
        }
    });
}

#[test]
fn valid_files_read() {
    for (name, bytes) in valid_files() {
        let options = DemOptions { encoding: Some(PngEncoding::Mapbox), ..DemOptions::default() };
        with_file(name, &bytes, |path| read(&path, &options)).unwrap();
    }
}

#[test]
fn every_truncation_returns() {
    for (name, bytes) in valid_files() {
        for length in 0..bytes.len() {
            try_all(name, &bytes[..length], None);
        }
    }
}

#[test]
#[ignore = "writes the seeds for fuzzing into $DRAPERY_SEEDS"]
fn seeds_for_fuzzing_terrain() {
    let of = |extension: &str| {
        let files = valid_files().into_iter().filter(|(name, _)| name.ends_with(extension));
        files.map(|(_, bytes)| bytes).collect::<Vec<_>>()
    };
    seeds::plant("dem_geotiff", of("tif"));
    seeds::plant("dem_ascii", of("asc"));
    seeds::plant("dem_xyz", of("xyz"));
    seeds::plant("dem_zip", of("zip"));
    let told = b"<PAMDataset><SRS>EPSG:32633</SRS><PAMRasterBand band=\"1\"><NoDataValue>3</NoDataValue></PAMRasterBand></PAMDataset>";
    let mask = of("tif").swap_remove(0);
    seeds::plant(
        "dem_geotiff/beside",
        [seeds::beside(&of("tif")[1], &[("tif.aux.xml", told), ("tif.msk", &mask)])],
    );
    let placed = seeds::beside(&png::mapbox(), &[("pgw", b"5\n0\n0\n-5\n100\n200\n")]);
    seeds::plant("dem_png", [png::mapbox(), placed.clone()]);
    seeds::plant("imagery", [png::mapbox(), placed]);
    seeds::plant("dem_hgt", [b"43E006\n\x00\x01\x80\x00".to_vec()]);
}

fn magic() -> impl Strategy<Value = &'static [u8]> {
    prop::sample::select(vec![
        &b""[..],
        b"II*\0\x08\0\0\0",
        b"MM\0*\0\0\0\x08",
        b"II+\0\x08\0\0\0\x10\0\0\0\0\0\0\0",
        b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR",
        b"ncols 3 nrows 3 ",
        b"PK\x03\x04",
        b"<VRTDataset rasterXSize=\"3\" rasterYSize=\"3\">",
    ])
}

fn edits() -> impl Strategy<Value = Vec<(prop::sample::Index, u8)>> {
    let byte = prop_oneof![any::<u8>(), Just(0), Just(0xff), Just(0x7f)];
    prop::collection::vec((any::<prop::sample::Index>(), byte), 1..12)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_bytes_return(
        magic in magic(),
        bytes in prop::collection::vec(any::<u8>(), 0..600),
        name in prop::sample::select(vec!["a.tif", "a.png", "a.asc", "a.xyz", "N43E006.hgt", "a.bin", "a.vrt"]),
    ) {
        try_all(name, &[magic, &bytes].concat(), None);
    }

    #[test]
    fn changed_and_cut_files_return(
        which in any::<prop::sample::Index>(),
        edits in edits(),
        cut in prop::option::of(any::<prop::sample::Index>()),
        window in prop::option::of(prop::array::uniform4(-50.0..400.0_f64)),
    ) {
        let files = valid_files();
        let (name, bytes) = which.get(&files);
        let mut bytes = bytes.clone();
        for (at, byte) in edits {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        if let Some(cut) = cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        try_all(name, &bytes, window);
    }
}
