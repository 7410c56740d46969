//! Real terrain files, read and compared with what other programs read in them.
//!
//! The data lie in the folder that `DRAPERY_DATA` names, else in `../shared/data`; without them the tests say so and pass.
#![cfg(feature = "render")]
#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test says why it skips, and fails by panicking"
)]

use drapery::scene::{Posts, Surface};
use drapery::source::dem::{CrsHint, Dem, DemOptions, DemSummary, PngEncoding, describe, read};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The file in the data folder, unpacked if it needs be; keeps its temporary folder alive.
struct Data {
    path: PathBuf,
    _folder: Option<tempfile::TempDir>,
}

/// `None`, with a word why, where the file or the unpacker is not to be had.
fn data(name: &str) -> Option<Data> {
    let folder = std::env::var_os("DRAPERY_DATA")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data"), PathBuf::from);
    let packed = folder.join(name);
    if !packed.is_file() {
        println!("skipped: no {name} in the data folder");
        return None;
    }
    let (command, option) = match packed.extension()?.to_str()? {
        "xz" => ("xz", "-dc"),
        "zip" => ("unzip", "-p"),
        _ => {
            return Some(Data { path: packed, _folder: None });
        }
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(packed.file_stem()?);
    let into = std::fs::File::create(&path).unwrap();
    let status = Command::new(command).arg(option).arg(&packed).stdout(Stdio::from(into)).status();
    if !status.is_ok_and(|s| s.success()) {
        println!("skipped: {command} cannot unpack {name}");
        return None;
    }
    Some(Data { path, _folder: Some(folder) })
}

/// What another program reads in a file.
struct Reading {
    size: (usize, usize),
    sample: &'static str,
    heights: [f64; 2],
    nodata_count: usize,
    /// How closely the heights above are written.
    digits: f64,
}

fn whole(size: (usize, usize), sample: &'static str, heights: [f64; 2], nodata_count: usize) -> Reading {
    Reading { size, sample, heights, nodata_count, digits: 1e-9 }
}

fn tenths(size: (usize, usize), sample: &'static str, heights: [f64; 2], nodata_count: usize) -> Reading {
    Reading { digits: 0.0501, ..whole(size, sample, heights, nodata_count) }
}

/// Reads and describes a file and compares both with a reading; hands over the description.
fn check(name: &str, expected: &Reading) -> Option<DemSummary> {
    let data = data(name)?;
    let summary = describe(&data.path, &options(name)).unwrap();
    assert_eq!(summary.size, Some(expected.size), "{name}");
    assert_eq!(summary.sample, expected.sample, "{name}");
    assert_eq!(summary.nodata_count, expected.nodata_count, "{name}");
    let heights = summary.heights.unwrap();
    for (read, printed) in heights.iter().zip(expected.heights) {
        assert!((read - printed).abs() <= expected.digits, "{name}: {heights:?}");
    }
    let posts = posts(read(&data.path, &options(name)).unwrap());
    assert_eq!((posts.columns(), posts.rows()), expected.size, "{name}");
    let voids = posts.heights().iter().filter(|h| h.is_nan()).count();
    assert_eq!(voids, expected.nodata_count, "{name}");
    check_window(&data.path, &posts, name);
    Some(summary)
}

/// A window holds the same heights as the whole.
fn check_window(path: &Path, all: &Posts, name: &str) {
    let span = |n: usize| (n / 3, n / 3 + 17);
    let ((i0, i1), (j0, j1)) = (span(all.columns()), span(all.rows()));
    let (a, b) = (all.plan(i0, j0), all.plan(i1, j1));
    let window = DemOptions { window: Some([a.x, a.y, b.x, b.y]), ..options(name) };
    let part = match read(path, &window) {
        Ok(dem) => posts(dem),
        Err(error) => return assert!(error.what().contains("no post"), "{error}"),
    };
    assert_eq!((part.columns(), part.rows()), (i1 - i0 + 1, j1 - j0 + 1), "{name}");
    for (i, j) in (j0..=j1).flat_map(|j| (i0..=i1).map(move |i| (i, j))) {
        let (inner, outer) = (part.world(i - i0, j - j0).z, all.world(i, j).z);
        assert!(inner == outer || inner.is_nan() && outer.is_nan(), "{name} ({i}, {j})");
    }
}

fn options(name: &str) -> DemOptions {
    let encoding = match name {
        n if n.contains("terrarium") => Some(PngEncoding::Terrarium),
        n if n.contains("terrain_png") => Some(PngEncoding::Mapbox),
        _ => None,
    };
    DemOptions { encoding, ..DemOptions::default() }
}

fn posts(dem: Dem) -> Posts {
    match dem.surface {
        Surface::Grid(posts) => posts,
        Surface::Points(_) | Surface::Globe(_) => panic!("a grid was expected"),
    }
}

/// Compares the outer edges of the cells with printed ones.
fn check_edges(summary: Option<DemSummary>, expected: [f64; 4], digits: f64) {
    let Some(summary) = summary else { return };
    for (read, expected) in summary.edges.iter().zip(expected) {
        assert!((read - expected).abs() <= digits, "{:?}", summary.edges);
    }
}

#[test]
fn swellendam_reads_in_utm_and_in_degrees() {
    let utm = check("swellendam/srtm_41_19.tif", &whole((837, 661), "int16", [0.0, 1699.0], 0));
    if let Some(utm) = &utm {
        assert_eq!(utm.crs_hint, Some(CrsHint::Epsg(32733)));
        assert!((utm.cell.unwrap()[0] - 81.993_426).abs() < 1e-6);
    }
    check_edges(utm, [969_491.3, 6_196_099.3, 1_038_119.8, 6_250_297.0], 0.051);
    let name = "swellendam/srtm_41_19_4326.tif.xz";
    let degrees = check(name, &whole((919, 619), "float32", [0.0, 1699.0], 0));
    check_edges(degrees, [20.0686, -34.2700, 20.8395, -33.7508], 5.1e-5);
}

#[test]
fn gredos_reads() {
    let gredos = check("gredos/dem25.tif.xz", &whole((601, 410), "float32", [514.0, 2410.0], 0));
    check_edges(gredos, [262_846.5, 4_454_025.0, 277_871.5, 4_464_275.0], 0.051);
}

#[test]
fn avalanche_catchments_read_from_tiff_and_text() {
    for (name, reading) in [
        ("avaAlr/avaAlr.tif.xz", tenths((417, 915), "float64", [566.1, 2452.3], 116_844)),
        ("avaMal/avaMal.tif.xz", tenths((567, 787), "float32", [1328.6, 2896.1], 167_357)),
        ("avaWog/avaWog.asc.xz", tenths((490, 555), "text", [1248.6, 2543.8], 94_079)),
        ("avaGar/avaGar.asc.xz", tenths((520, 387), "text", [1234.0, 2672.2], 82_888)),
        ("avaKot/avaKot.asc.xz", tenths((439, 517), "text", [1052.2, 2207.0], 90_023)),
        ("avaPfa/avaPfa.asc.xz", tenths((433, 350), "text", [1278.2, 1393.6], 52_303)),
    ] {
        check(&format!("avalanche/{name}"), &reading);
    }
}

#[test]
fn glaciers_read() {
    let oetztal = check("oetztal/srtm_oetztal.tif", &whole((582, 444), "int16", [387.0, 3727.0], 0));
    check_edges(oetztal, [10.6225, 46.6567, 11.1075, 47.0267], 5.1e-5);
    let name = "baltoro/baltoro_srtm_clip.tif";
    let baltoro = check(name, &whole((860, 430), "int16", [3197.0, 8569.0], 0));
    check_edges(baltoro, [76.0479, 35.5729, 76.7646, 35.9313], 5.1e-5);
}

#[test]
fn the_atlantic_is_mostly_without_data() {
    let name = "atlantic_3600/dem_3600.tif.xz";
    let atlantic = check(name, &whole((3600, 3600), "int16", [-50.0, 4016.0], 10_716_760));
    check_edges(atlantic, [-30.0, 30.0, 0.0, 60.0], 1e-9);
}

#[test]
fn new_zealand_has_nan_voids_and_a_described_crs() {
    let name = "new_zealand/nz_elev.tif";
    let nz = check(name, &tenths((1115, 1450), "float32", [0.0, 4140.3], 1_348_639));
    if let Some(nz) = &nz {
        assert_eq!(nz.compression, "LZW");
        let Some(CrsHint::Proj(proj)) = &nz.crs_hint else {
            panic!("{:?}", nz.crs_hint);
        };
        for part in ["+proj=tmerc", "+lon_0=173", "+k=0.9996", "+x_0=1600000", "+y_0=10000000", "GRS80"] {
            assert!(proj.contains(part), "{proj}");
        }
    }
    check_edges(nz, [995_456.5, 4_741_960.9, 2_110_456.5, 6_191_960.9], 0.051);
}

#[test]
fn unsigned_whole_numbers_read() {
    let zion = check("zion/srtm.tif", &whole((465, 457), "uint16", [1024.0, 2892.0], 0));
    check_edges(zion, [-113.2396, 37.1321, -112.8521, 37.5129], 5.1e-5);
    let name = "porto_alegre/poa_elevation.tif";
    let poa = check(name, &whole((413, 403), "uint8", [0.0, 255.0], 0));
    check_edges(poa, [-51.2549, -30.1096, -51.1401, -29.9976], 5.1e-5);
}

#[test]
fn srtm_tiles_share_the_degree_line() {
    let tile = |name, heights, voids| check(name, &whole((1201, 1201), "int16", heights, voids));
    let west = tile("riviera/N43E006.hgt.zip", [-12.0, 1923.0], 0);
    let east = tile("riviera/N43E007.hgt.zip", [-16.0, 2060.0], 4);
    if let (Some(west), Some(east)) = (west, east) {
        assert_eq!(west.bounds, [6.0, 43.0, 7.0, 44.0]);
        assert_eq!(west.bounds[2], east.bounds[0]);
        assert_eq!(east.crs_hint, Some(CrsHint::Epsg(4326)));
    }
}

#[test]
fn tiled_summits_with_voids_read() {
    for (name, heights, voids) in [
        ("mt_everest", [192.0, 8642.0], 130_953),
        ("mt_rainier", [263.0, 4371.0], 9033),
        ("mt_fuji", [-16.0, 3742.0], 2437),
    ] {
        let name = format!("voids/{name}_90m.tif.xz");
        let summary = check(&name, &whole((1201, 1201), "int16", heights, voids));
        assert!(summary.is_none_or(|s| s.layout == "tiles of 256 x 256"));
    }
}

#[test]
fn bigtujunga_reads_from_small_tiles() {
    let name = "bigtujunga/bigtujunga.tif.xz";
    let summary = check(name, &whole((1197, 643), "int16", [315.0, 2295.0], 0));
    assert!(summary.as_ref().is_none_or(|s| s.layout == "tiles of 128 x 128"));
    check_edges(summary, [376_313.7, 3_788_627.8, 412_223.7, 3_807_917.8], 0.051);
}

#[test]
fn slovenia_reads_packed_and_with_voids() {
    let hundredths =
        |voids| Reading { digits: 0.00501, ..whole((1000, 1000), "float32", [254.97, 325.05], voids) };
    let packed = check("slovenia_1m/TM1_564_146.tif", &hundredths(0));
    check_edges(packed, [563_999.5, 145_999.5, 564_999.5, 146_999.5], 0.051);
    check("slovenia_1m/TM1_564_146_nodata.tif.xz", &hundredths(500));
}

#[test]
fn tiles_with_heights_in_their_colours_read() {
    for (name, size, heights) in [
        ("fuji_mapbox", 512, [13.7, 3751.0]),
        ("mapbox_st_helens", 256, [1002.0, 1164.2]),
        ("terrarium", 256, [715.2, 2489.0]),
    ] {
        let name = format!("terrain_png/{name}.png");
        check(&name, &tenths((size, size), "uint8 x 3", heights, 0));
    }
}
