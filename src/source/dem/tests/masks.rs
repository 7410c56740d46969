//! Posts that hold no data: masks, alpha bands, sidecars, and values that nobody declares.

use super::super::{DemOptions, PngEncoding, describe, read};
use super::tiff_writer::{Kind, Tiff, Values};
use super::{png, posts, read_bytes, refusal, window, with_file};
use crate::scene::Posts;
use std::path::Path;

const SIZE: (usize, usize) = (19, 11);

fn height(c: usize, r: usize) -> f64 {
    if is_masked(c, r) { 9000.0 } else { (100 + c + r) as f64 }
}

fn is_masked(c: usize, r: usize) -> bool {
    (c * 7 + r * 5) % 4 == 1
}

fn shown(c: usize, r: usize) -> f64 {
    if is_masked(c, r) { 0.0 } else { 1.0 }
}

/// Heights of 9000 m wherever they are masked.
fn heights() -> Tiff {
    Tiff::new(SIZE, Kind::F32, height)
}

/// The directory of a mask.
fn mask(kind: Kind, most: f64) -> Tiff {
    let mut mask = Tiff::new(SIZE, kind, |c, r| shown(c, r) * most);
    mask.tags = vec![(254, Values::Longs(vec![4])), (262, Values::Shorts(vec![4]))];
    mask
}

fn assert_masked(posts: &Posts) {
    for (i, j) in (0..SIZE.0).flat_map(|i| (0..SIZE.1).map(move |j| (i, j))) {
        let (z, r) = (posts.world(i, j).z, SIZE.1 - 1 - j);
        assert!(if is_masked(i, r) { z.is_nan() } else { z == height(i, r) }, "post ({i}, {r}): {z}");
    }
}

/// Reads a file that may have others beside it.
fn read_with(bytes: &[u8], beside: &[(&str, &[u8])], options: &DemOptions) -> crate::Result<super::Dem> {
    with_file("a.tif", bytes, |path| {
        for (name, bytes) in beside {
            std::fs::write(path.with_file_name(name), bytes).unwrap();
        }
        read(&path, options)
    })
}

#[test]
fn a_mask_in_the_file_takes_its_posts_away_whatever_its_blocks_and_packing() {
    for (kind, most) in [(Kind::Bit, 1.0), (Kind::U8, 255.0)] {
        for (tile, packing, big) in [(None, 1, false), (Some((16, 16)), 8, true), (Some((8, 4)), 5, false)] {
            let mask = Tiff { tile, packing, big, strip_rows: 11, ..mask(kind, most) };
            let overview = Tiff {
                big,
                tags: vec![(254, Values::Longs(vec![5]))],
                ..Tiff::new((9, 5), Kind::Bit, |_, _| 0.0)
            };
            let tiff =
                Tiff { big, more: vec![overview, mask], tile: Some((16, 16)), packing: 8, ..heights() };
            let dem = read_bytes("a.tif", &tiff.bytes(), &DemOptions::default()).unwrap();
            assert!(dem.notes.iter().any(|n| n.contains("mask")), "{:?}", dem.notes);
            assert_masked(&posts(dem));
        }
    }
}

#[test]
fn a_window_of_a_masked_file_and_its_summary_are_masked_alike() {
    let bytes = Tiff { more: vec![mask(Kind::Bit, 1.0)], ..heights() }.bytes();
    let part = posts(read_bytes("a.tif", &bytes, &window([125.0, 225.0, 165.0, 265.0])).unwrap());
    for (i, j) in [(0, 0), (3, 2), (4, 4), (1, 3)] {
        let (c, r) = (i + 2, SIZE.1 - 1 - (j + 2));
        assert_eq!(part.world(i, j).z.is_nan(), is_masked(c, r), "({c}, {r})");
    }
    let told = with_file("a.tif", &bytes, |path| describe(&path, &DemOptions::default())).unwrap();
    let masked = (0..SIZE.0 * SIZE.1).filter(|i| is_masked(i % SIZE.0, i / SIZE.0)).count();
    assert_eq!((told.nodata_count, told.heights), (masked, Some([100.0, 128.0])));
}

#[test]
fn a_mask_in_a_file_beside_it_takes_its_posts_away_from_any_format() {
    let mask = Tiff::new(SIZE, Kind::U8, |c, r| shown(c, r) * 255.0).bytes();
    let dem = read_with(&heights().bytes(), &[("a.tif.msk", &mask)], &DemOptions::default()).unwrap();
    assert_masked(&posts(dem));
    let rows = (0..SIZE.1).flat_map(|r| (0..SIZE.0).map(move |c| height(c, r).to_string()));
    let grid = format!(
        "ncols 19\nnrows 11\nxllcorner 0\nyllcorner 0\ncellsize 2\n{}",
        rows.collect::<Vec<_>>().join(" ")
    );
    let dem = with_file("a.asc", grid.as_bytes(), |path| {
        std::fs::write(path.with_file_name("a.asc.msk"), &mask).unwrap();
        read(&path, &DemOptions::default()).unwrap()
    });
    assert_masked(&posts(dem));
}

#[test]
fn a_mask_of_another_size_or_a_damaged_one_is_refused() {
    let small = Tiff::new((4, 4), Kind::U8, |_, _| 1.0).bytes();
    let cut = &Tiff::new(SIZE, Kind::U8, |_, _| 1.0).bytes()[..40];
    for (mask, expected) in [(&small[..], "4 x 4"), (cut, "a.tif.msk"), (b"no mask", "a.tif.msk")] {
        let refused = read_with(&heights().bytes(), &[("a.tif.msk", mask)], &DemOptions::default());
        let message = refused.unwrap_err().to_string();
        assert!(message.contains(expected) && message.contains("mask"), "{message}");
    }
    let mut other = mask(Kind::Bit, 1.0);
    other.packing = 7;
    let message = refusal("a.tif", &Tiff { more: vec![other], ..heights() }.bytes(), &DemOptions::default());
    assert!(message.contains("its mask: unsupported compression 7"), "{message}");
}

#[test]
fn later_directories_that_are_damaged_are_told_and_ones_in_a_circle_end() {
    let bytes = heights().bytes();
    let next = bytes.len() - 4;
    let linked = |to: u32| {
        let mut bytes = bytes.clone();
        bytes[next..].copy_from_slice(&to.to_le_bytes());
        read_bytes("a.tif", &bytes, &DemOptions::default()).unwrap()
    };
    let directory = u32::from_le_bytes(bytes[4..8].try_into().unwrap());
    assert!(linked(directory).notes.is_empty());
    let notes = linked(1 << 30).notes;
    assert!(notes[0].contains("mask among them is not followed"), "{notes:?}");
}

#[test]
fn an_alpha_band_takes_its_posts_away_interleaved_or_apart() {
    for extra in [1, 2] {
        for planar in [false, true] {
            let alpha: Vec<f64> =
                (0..SIZE.0 * SIZE.1).map(|i| shown(i % SIZE.0, i / SIZE.0) * 128.0).collect();
            let mut tiff = Tiff { bands: 2, planar, other_bands: vec![alpha], ..heights() };
            tiff.tags.push((338, Values::Shorts(vec![extra])));
            assert_masked(&posts(read_bytes("a.tif", &tiff.bytes(), &DemOptions::default()).unwrap()));
        }
    }
    // An extra band of no stated meaning is no alpha.
    let mut tiff = Tiff { bands: 2, ..heights() };
    tiff.tags.push((338, Values::Shorts(vec![0])));
    let posts = posts(read_bytes("a.tif", &tiff.bytes(), &DemOptions::default()).unwrap());
    assert!(posts.heights().iter().all(|h| h.is_finite()));
}

#[test]
fn a_band_is_read_where_one_is_asked_for() {
    let second: Vec<f64> = (0..SIZE.0 * SIZE.1).map(|i| i as f64).collect();
    for (planar, packing, predictor) in [(false, 1, 1), (true, 8, 2), (false, 5, 2), (true, 8, 3)] {
        let bands = vec![vec![0.0; second.len()], second.clone()];
        let tiff = Tiff { bands: 3, planar, packing, predictor, other_bands: bands, ..heights() };
        let options = DemOptions { band: Some(3), ..DemOptions::default() };
        let dem = read_bytes("a.tif", &tiff.bytes(), &options).unwrap();
        assert!(dem.notes[0].contains("band 3"), "{:?}", dem.notes);
        let posts = posts(dem);
        assert_eq!(posts.heights()[..SIZE.0], second[second.len() - SIZE.0..]);
        for wrong in [0, 4, usize::MAX] {
            let options = DemOptions { band: Some(wrong), ..options };
            assert!(refusal("a.tif", &tiff.bytes(), &options).contains("bands are 1 to 3"));
        }
    }
    let options = DemOptions { band: Some(2), encoding: Some(PngEncoding::Mapbox), ..DemOptions::default() };
    assert!(refusal("a.png", &png::mapbox(), &options).contains("one band"));
}

const SIDECAR: &str = r#"<PAMDataset>
  <SRS dataAxisToSRSAxisMapping="1,2">EPSG:32633</SRS>
  <GeoTransform>  1.0e+03,  2.0e+01,  0.0, 5.0e+03,  0.0, -2.0e+01</GeoTransform>
  <PAMRasterBand band="2"><NoDataValue>105</NoDataValue></PAMRasterBand>
  <PAMRasterBand band="1"><NoDataValue le_hex_endian="x">9.0e+03</NoDataValue><UnitType>ft</UnitType></PAMRasterBand>
</PAMDataset>"#;

#[test]
fn what_gdal_keeps_beside_a_file_counts() {
    let beside = [("a.tif.aux.xml", SIDECAR.as_bytes())];
    let dem = read_with(&heights().bytes(), &beside, &DemOptions::default()).unwrap();
    assert_eq!(format!("{:?}", dem.crs_hint), "Some(Epsg(32633))");
    assert!(dem.notes.iter().any(|n| n.contains("in feet")), "{:?}", dem.notes);
    let placed = posts(dem);
    // The file's own place stands.
    assert_eq!(placed.first, crate::space::Plan::new(105.0, 205.0));
    assert!(placed.world(3, 10).z.is_nan());
    assert_eq!(placed.world(0, 10).z, 100.0 * 0.3048);
    let mut placeless = heights();
    placeless.tags.clear();
    let placed = posts(read_with(&placeless.bytes(), &beside, &DemOptions::default()).unwrap());
    assert_eq!(placed.first, crate::space::Plan::new(1010.0, 4790.0));
}

#[test]
fn a_damaged_sidecar_is_named() {
    let number = SIDECAR.replace("9.0e+03", "many");
    let place = SIDECAR.replace("1.0e+03,", "");
    for (xml, expected) in
        [("<PAMDataset>", "XML"), ("<!DOCTYPE a><a/>", "XML"), (&number, "`many`"), (&place, "GeoTransform")]
    {
        let refused =
            read_with(&heights().bytes(), &[("a.tif.aux.xml", xml.as_bytes())], &DemOptions::default());
        let message = refused.unwrap_err().to_string();
        assert!(message.contains("a.tif.aux.xml") && message.contains(expected), "{message}");
    }
}

#[test]
fn a_customary_value_among_ordinary_heights_is_told_and_can_be_declared() {
    let undeclared = Tiff::new(SIZE, Kind::I16, |c, r| if is_masked(c, r) { -9999.0 } else { height(c, r) });
    let dem = read_bytes("a.tif", &undeclared.bytes(), &DemOptions::default()).unwrap();
    assert!(dem.notes.iter().any(|n| n.contains("`terrain.nodata = -9999`")), "{:?}", dem.notes);
    let options = DemOptions { nodata: Some(-9999.0), ..DemOptions::default() };
    let dem = read_bytes("a.tif", &undeclared.bytes(), &options).unwrap();
    assert!(dem.notes.is_empty(), "{:?}", dem.notes);
    assert_masked(&posts(dem));
    let told = with_file("a.tif", &undeclared.bytes(), |path: std::path::PathBuf| summary_notes(&path));
    assert!(told.iter().any(|n| n.contains("-9999")), "{told:?}");
    let deep = Tiff::new(SIZE, Kind::I16, |c, r| -9999.0 + (c * 100 + r) as f64);
    assert!(read_bytes("a.tif", &deep.bytes(), &DemOptions::default()).unwrap().notes.is_empty());
}

#[test]
fn customary_values_among_scattered_points_and_in_pixels_are_told() {
    let points = b"0 0 101\n1 0 102\n0 1 -9999\n1 1 104\n";
    let dem = read_bytes("a.xyz", points, &DemOptions::default()).unwrap();
    assert!(dem.notes.iter().any(|n| n.contains("1 height is -9999")), "{:?}", dem.notes);
    let told = with_file("a.xyz", points, |path: std::path::PathBuf| summary_notes(&path));
    assert!(told.iter().any(|n| n.contains("-9999")), "{told:?}");
    let mut pixels = [1, 134, 160].repeat(6);
    pixels[..3].fill(0);
    let options = DemOptions { encoding: Some(PngEncoding::Mapbox), ..DemOptions::default() };
    let dem = read_bytes("a.png", &png::rgb(&pixels, (3, 2)), &options).unwrap();
    assert!(dem.notes.iter().any(|n| n.contains("-10000")), "{:?}", dem.notes);
}

fn summary_notes(path: &Path) -> Vec<String> {
    describe(path, &DemOptions::default()).unwrap().notes
}

#[test]
fn nodata_can_be_declared_for_every_format() {
    let options =
        DemOptions { nodata: Some(4.0), encoding: Some(PngEncoding::Mapbox), ..DemOptions::default() };
    let grid = b"ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 2\n1 2 3\n4 5 6\n";
    assert!(posts(read_bytes("a.asc", grid, &options).unwrap()).world(0, 0).z.is_nan());
    let options = DemOptions { nodata: Some(102.0), ..options };
    assert!(posts(read_bytes("a.png", &png::mapbox(), &options).unwrap()).world(1, 0).z.is_nan());
    let options = DemOptions { nodata: Some(7.0), ..options };
    let tile: Vec<u8> = (0..1201_i16).flat_map(|row| [row.to_be_bytes(); 1201]).flatten().collect();
    let tile = posts(read_bytes("N43E006.hgt", &tile, &options).unwrap());
    assert_eq!(tile.heights().iter().filter(|h| h.is_nan()).count(), 1201);
    let dem = read_bytes("a.xyz", b"0 0 1\n1 0 2\n0 1 3\n1 1 7\n", &options).unwrap();
    assert!(matches!(dem.surface, crate::scene::Surface::Points(points) if points.len() == 3));
}
