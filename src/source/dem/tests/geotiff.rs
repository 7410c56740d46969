//! GeoTIFFs of every kind, written here, read back; and those that must be refused.

use super::super::geotiff::GeoTiff;
use super::super::grid::{GridFile, Sheet};
use super::super::sidecar::Sidecar;
use super::super::{DemOptions, describe};
use super::tiff_writer::{Kind, Tiff, Values};
use super::{posts, read_bytes, refusal, window, with_file};
use crate::space::Plan;
use glam::DVec2;
use std::cell::Cell;
use std::io::{self, Cursor, Read, Seek, SeekFrom};
use std::rc::Rc;

/// A height that fits all kinds and repeats little.
fn height(c: usize, r: usize) -> f64 {
    ((c * 7 + r * 13) % 101) as f64
}

fn sample() -> Tiff {
    Tiff::new((7, 5), Kind::F32, height)
}

fn assert_read_back(tiff: &Tiff) {
    let dem = read_bytes("a.tif", &tiff.bytes(), &DemOptions::default())
        .unwrap_or_else(|e| panic!("{e}\n{tiff:?}"));
    let posts = posts(dem);
    let (columns, rows) = tiff.size;
    assert_eq!((posts.columns(), posts.rows()), (columns, rows));
    for (i, h) in posts.heights().iter().enumerate() {
        let (c, r) = (i % columns, rows - 1 - i / columns);
        assert_eq!(*h, tiff.samples[r * columns + c], "post ({c}, {r}) of {tiff:?}");
    }
}

#[test]
fn every_kind_layout_packing_predictor_and_byte_order_reads_back() {
    for kind in Kind::ALL {
        for packing in [1, 5, 8, 32946, 32773, 50000] {
            let predictors: &[u16] = if packing == 1 {
                &[1]
            } else if kind.is_floating() {
                &[1, 2, 3]
            } else {
                &[1, 2]
            };
            for &predictor in predictors {
                for big_endian in [false, true] {
                    for (tile, big) in [(None, false), (Some((16, 16)), true), (Some((4, 2)), false)] {
                        assert_read_back(&Tiff {
                            packing,
                            predictor,
                            big_endian,
                            big,
                            tile,
                            ..Tiff::new((19, 11), kind, height)
                        });
                    }
                }
            }
        }
    }
}

#[test]
fn the_first_of_several_bands_is_read() {
    for (planar, packing, predictor) in [(false, 1, 1), (true, 5, 2), (false, 8, 2), (false, 8, 3)] {
        let tiff = Tiff { bands: 3, planar, packing, predictor, ..sample() };
        assert_read_back(&tiff);
        let dem = read_bytes("a.tif", &tiff.bytes(), &DemOptions::default()).unwrap();
        assert!(dem.notes[0].contains("3 bands"), "{:?}", dem.notes);
    }
}

#[test]
fn posts_stand_at_pixel_centres_or_at_points() {
    let area = posts(read_bytes("a.tif", &sample().bytes(), &DemOptions::default()).unwrap());
    assert_eq!(area.first, Plan::new(105.0, 205.0));
    assert_eq!((area.east(), area.north()), (DVec2::new(10.0, 0.0), DVec2::new(0.0, 10.0)));
    let mut point = sample();
    point.tags.push((34735, Values::Shorts(vec![1, 1, 0, 1, 1025, 0, 1, 2])));
    let point = posts(read_bytes("a.tif", &point.bytes(), &DemOptions::default()).unwrap());
    assert_eq!(point.first, Plan::new(100.0, 210.0));
}

#[test]
fn a_rotated_raster_keeps_its_posts() {
    let mut tiff = sample();
    // x = 3 c + 4 r + 1000, y = 4 c - 3 r + 2000: turned by 53 degrees.
    let mut matrix = vec![0.0; 16];
    for (i, v) in [(0, 3.0), (1, 4.0), (3, 1000.0), (4, 4.0), (5, -3.0), (7, 2000.0), (15, 1.0)] {
        matrix[i] = v;
    }
    tiff.tags = vec![(34264, Values::Doubles(matrix))];
    let posts = posts(read_bytes("a.tif", &tiff.bytes(), &DemOptions::default()).unwrap());
    assert!(posts.east().perp_dot(posts.north()) > 0.0);
    for (i, j) in [(0, 0), (6, 0), (0, 4), (3, 2)] {
        let (c, r) = (i as f64 + 0.5, (4 - j) as f64 + 0.5);
        let at = posts.plan(i, j);
        assert_eq!((at.x, at.y), (3.0 * c + 4.0 * r + 1000.0, 4.0 * c - 3.0 * r + 2000.0));
        assert_eq!(posts.world(i, j).z, height(i, 4 - j));
    }
}

#[test]
fn nodata_is_compared_in_the_samples_own_type() {
    for (kind, text, value) in [
        (Kind::F32, "-3.4028235e+38", f64::from(f32::MIN)),
        (Kind::F32, "3.4028e38", f64::from(f32::MAX)),
        (Kind::F32, "-9999.9", f64::from(-9999.9_f32)),
        (Kind::F32, "nan", f64::NAN),
        (Kind::F64, "-9999", -9999.0),
        (Kind::I16, "-32768.0 ", -32768.0),
        (Kind::U16, "65535", 65535.0),
        (Kind::I32, "-2147483648", -2_147_483_648.0),
    ] {
        let mut tiff = Tiff::new((4, 4), kind, height);
        tiff.samples[5] = value;
        tiff.nodata = Some(text);
        let posts = posts(read_bytes("a.tif", &tiff.bytes(), &DemOptions::default()).unwrap());
        let voids: Vec<_> = posts.heights().iter().map(|h| h.is_nan()).collect();
        assert_eq!(voids.iter().filter(|v| **v).count(), 1, "{text}");
        assert!(voids[2 * 4 + 1], "{text}");
    }
}

#[test]
fn a_nodata_value_outside_the_type_matches_nothing() {
    let tiff = Tiff { nodata: Some("-9999"), ..Tiff::new((4, 4), Kind::U8, height) };
    let posts = posts(read_bytes("a.tif", &tiff.bytes(), &DemOptions::default()).unwrap());
    assert!(posts.heights().iter().all(|h| h.is_finite()));
}

#[test]
fn a_window_grows_to_whole_posts() {
    let tiff = sample();
    // Posts stand at 105 + 10 i, 205 + 10 j.
    let posts = posts(read_bytes("a.tif", &tiff.bytes(), &window([117.0, 216.0, 125.0, 224.0])).unwrap());
    assert_eq!(posts.first, Plan::new(115.0, 215.0));
    assert_eq!((posts.columns(), posts.rows()), (2, 2));
    assert_eq!(posts.heights(), [height(1, 3), height(2, 3), height(1, 2), height(2, 2)]);
}

#[test]
fn a_window_of_any_place_shows_the_same_heights_as_the_whole() {
    let tiff =
        Tiff { tile: Some((4, 2)), packing: 5, predictor: 3, ..Tiff::new((19, 11), Kind::F32, height) };
    let bytes = tiff.bytes();
    let whole = posts(read_bytes("a.tif", &bytes, &DemOptions::default()).unwrap());
    for (x, y, w, h) in [(0, 0, 3, 3), (4, 2, 5, 1), (17, 9, 1, 1), (3, 0, 15, 10), (8, 5, 4, 4)] {
        let at = whole.plan(x, y);
        let end = whole.plan(x + w, y + h);
        let part = posts(read_bytes("a.tif", &bytes, &window([at.x, at.y, end.x, end.y])).unwrap());
        assert_eq!((part.columns(), part.rows(), part.first), (w + 1, h + 1, at));
        for (i, j) in [(0, 0), (w, 0), (0, h), (w, h)] {
            assert_eq!(part.world(i, j).z, whole.world(x + i, y + j).z);
        }
    }
}

#[test]
fn a_window_beyond_the_raster_is_noted_and_one_that_misses_is_refused() {
    let dem = read_bytes("a.tif", &sample().bytes(), &window([0.0, 0.0, 120.0, 220.0])).unwrap();
    assert!(dem.notes[0].contains("[105, 205, 165, 245]"), "{:?}", dem.notes);
    let message = refusal("a.tif", &sample().bytes(), &window([0.0, 0.0, 50.0, 50.0]));
    assert!(message.contains("misses") && message.contains("[105, 205, 165, 245]"), "{message}");
    for wrong in [[9.0, 9.0, 9.0, 9.0], [120.0, 220.0, 110.0, 230.0], [f64::NAN, 0.0, 1.0, 1.0]] {
        assert!(refusal("a.tif", &sample().bytes(), &window(wrong)).contains("encloses nothing"));
    }
}

#[test]
fn blocks_left_out_are_nodata_or_zero() {
    let mut tiff = Tiff {
        tile: Some((4, 4)),
        left_out: vec![0],
        nodata: Some("-1"),
        ..Tiff::new((8, 8), Kind::I16, |_, _| 5.0)
    };
    let with = posts(read_bytes("a.tif", &tiff.bytes(), &DemOptions::default()).unwrap());
    assert!(with.world(0, 7).z.is_nan() && with.world(7, 7).z == 5.0 && with.world(0, 0).z == 5.0);
    tiff.nodata = None;
    let without = posts(read_bytes("a.tif", &tiff.bytes(), &DemOptions::default()).unwrap());
    assert_eq!(without.world(0, 7).z, 0.0);
}

#[test]
fn scale_and_offset_of_gdal_are_applied() {
    let mut tiff = Tiff::new((4, 4), Kind::I16, |_, _| 100.0);
    let xml = "<GDALMetadata><Item name=\"OFFSET\" sample=\"0\" role=\"offset\">5</Item>\
               <Item name=\"SCALE\" sample=\"0\" role=\"scale\">0.5</Item></GDALMetadata>";
    tiff.tags.push((42112, Values::Text(xml.into())));
    let dem = read_bytes("a.tif", &tiff.bytes(), &DemOptions::default()).unwrap();
    assert!(dem.notes[0].contains("x 0.5 + 5"), "{:?}", dem.notes);
    assert_eq!(posts(dem).heights()[0], 55.0);
}

#[test]
fn a_file_without_a_place_is_local_or_takes_bounds() {
    let mut tiff = sample();
    tiff.tags.clear();
    let dem = read_bytes("a.tif", &tiff.bytes(), &DemOptions::default()).unwrap();
    assert!(dem.notes[0].contains("local grid"), "{:?}", dem.notes);
    assert_eq!(posts(dem).first, Plan::new(0.0, 0.0));
    let bounds = DemOptions { bounds: Some([0.0, 0.0, 70.0, 50.0]), ..DemOptions::default() };
    let placed = posts(read_bytes("a.tif", &tiff.bytes(), &bounds).unwrap());
    assert_eq!(placed.first, Plan::new(5.0, 5.0));
}

#[test]
fn what_is_unsupported_is_named_with_the_way_out() {
    for (packing, name) in [(7, "JPEG"), (34887, "LERC"), (34925, "LZMA"), (999, "999")] {
        let message = refusal("a.tif", &Tiff { packing, ..sample() }.bytes(), &DemOptions::default());
        assert!(message.contains(name) && message.contains("COMPRESS=DEFLATE"), "{message}");
    }
    let mut gcps = sample();
    gcps.tags.retain(|(tag, _)| *tag != 33550);
    assert!(refusal("a.tif", &gcps.bytes(), &DemOptions::default()).contains("gdalwarp"));
}

#[test]
fn absurd_headers_are_refused_before_memory_is_set_aside() {
    let absurd: &[(&[(u16, u64)], &str)] = &[
        (&[(256, 1 << 31), (257, 1 << 31), (278, 1 << 31)], "not supported"),
        (&[(256, 3 << 30)], "absurd"),
        (&[(257, 1 << 30), (278, 1 << 30)], "outside the file"),
        (&[(257, 1 << 30)], "blocks"),
        (&[(278, 0)], "not supported"),
        (&[(256, 0)], "absurd"),
        (&[(277, 60_000)], "absurd"),
    ];
    for (tags, expected) in absurd {
        let mut tiff = sample();
        let long = |v: &u64| Values::Longs(vec![*v]);
        tiff.tags.extend(tags.iter().map(|(tag, v)| (*tag, long(v))));
        let message = refusal("a.tif", &tiff.bytes(), &window([110.0, 0.0, 130.0, 1e9]));
        assert!(message.contains(expected), "{tags:?}: {message}");
    }
}

#[test]
fn a_small_packed_block_cannot_promise_a_huge_raster() {
    for packing in [5, 8, 32773, 50000] {
        let mut tiff = Tiff { packing, ..sample() };
        let rows = 1_000_000;
        tiff.tags.extend([257, 278].map(|tag| (tag, Values::Longs(vec![rows]))));
        let message = refusal("a.tif", &tiff.bytes(), &DemOptions::default());
        assert!(message.contains("can stand for"), "{message}");
    }
}

#[test]
fn places_that_are_no_place_are_refused() {
    for scale in [0.0, f64::NAN, f64::INFINITY, 1e-300] {
        let mut tiff = sample();
        tiff.tags[0] = (33550, Values::Doubles(vec![scale, 10.0, 0.0]));
        refusal("a.tif", &tiff.bytes(), &DemOptions::default());
    }
    let mut far = sample();
    far.tags[1] = (33922, Values::Doubles(vec![0.0, 0.0, 0.0, 1e300, 0.0, 0.0]));
    refusal("a.tif", &far.bytes(), &DemOptions::default());
}

#[test]
fn describe_counts_without_holding_the_raster() {
    let mut tiff = Tiff {
        tile: Some((16, 16)),
        packing: 5,
        predictor: 2,
        nodata: Some("-7"),
        ..Tiff::new((19, 11), Kind::I16, height)
    };
    tiff.samples[3] = -7.0;
    let summary = with_file("a.tif", &tiff.bytes(), |p| describe(&p, &DemOptions::default())).unwrap();
    assert_eq!(summary.size, Some((19, 11)));
    assert_eq!(summary.edges, [100.0, 200.0, 290.0, 310.0]);
    assert_eq!(summary.bounds, [105.0, 205.0, 285.0, 305.0]);
    assert_eq!((summary.nodata_count, summary.nodata.as_deref()), (1, Some("-7")));
    assert_eq!(summary.heights, Some([0.0, 100.0]));
    let told = (summary.sample.as_str(), summary.compression.as_str(), summary.layout.as_str());
    assert_eq!(told, ("int16", "LZW", "tiles of 16 x 16"));
}

/// Counts the bytes that are read.
struct Counting {
    inner: Cursor<Vec<u8>>,
    read: Rc<Cell<usize>>,
}

impl Read for Counting {
    fn read(&mut self, buf: &mut [u8]) -> io::Result<usize> {
        let n = self.inner.read(buf)?;
        self.read.set(self.read.get() + n);
        Ok(n)
    }
}

impl Seek for Counting {
    fn seek(&mut self, pos: SeekFrom) -> io::Result<u64> {
        self.inner.seek(pos)
    }
}

#[test]
fn a_window_of_a_large_tiled_raster_reads_its_own_tiles_only() {
    // 10,000 x 10,000 float32: 40 x 40 tiles that all share the bytes of one, 256 KiB unpacked.
    const TILE: usize = 256;
    let one = Tiff { tile: Some((TILE, TILE)), ..Tiff::new((TILE, TILE), Kind::F32, |c, r| (c + r) as f64) };
    let mut large = one.clone();
    let blocks = 10_000_usize.div_ceil(TILE).pow(2);
    let block_bytes = (TILE * TILE * 4) as u64;
    large.tags.extend([
        (256, Values::Longs(vec![10_000])),
        (257, Values::Longs(vec![10_000])),
        (324, Values::Longs(vec![8; blocks])),
        (325, Values::Longs(vec![block_bytes; blocks])),
        (33922, Values::Doubles(vec![0.0, 0.0, 0.0, 0.0, 100_000.0, 0.0])),
    ]);
    let read = Rc::new(Cell::new(0));
    let counting = Counting { inner: Cursor::new(large.bytes()), read: Rc::clone(&read) };
    let mut file = GeoTiff::open(counting, None, &DemOptions::default(), &Sidecar::default()).unwrap().0;
    let header = read.get();
    let frame = file.header().frame;
    // Columns 5115..=5125 and rows from the north 4994..=5004: tiles 19 to 20 across and 19 down.
    let (part, _) = frame.part(Some([51_155.0, 49_955.0, 51_255.0, 50_055.0])).unwrap();
    let mut sheet = Sheet::new(&frame, part).unwrap();
    file.scan(&part, &mut sheet).unwrap();
    let posts = sheet.finish(&mut Vec::new()).unwrap();
    assert_eq!((posts.columns(), posts.rows()), (11, 11));
    assert_eq!(posts.world(0, 0).z, ((5115 % TILE) + (5004 % TILE)) as f64);
    let tiles = 2;
    assert!(header < 60_000, "{header} bytes for the header");
    assert!(read.get() - header <= tiles * block_bytes as usize, "{} bytes", read.get() - header);
}

#[test]
fn lzw_without_an_end_code_reads_until_the_rows_are_full() {
    let tiff = Tiff { packing: 5, strip_rows: 5, ..Tiff::new((64, 5), Kind::U8, height) };
    let mut bytes = tiff.bytes();
    // Shorten the only strip by its last byte, which holds the end code.
    let table = bytes.windows(4).position(|w| w == [0x17, 1, 4, 0]).unwrap();
    bytes[table + 8] -= 1;
    let posts = posts(read_bytes("a.tif", &bytes, &DemOptions::default()).unwrap());
    assert_eq!(posts.heights()[0], height(0, 4));
}
