//! Virtual rasters of plain files.

use super::super::{Dem, DemOptions, describe, read};
use super::posts;
use super::tiff_writer::{Kind, Tiff, Values};
use crate::seeds;
use crate::space::Plan;

/// The heights of a file are 100 times its number, and those of its columns and rows.
fn file(number: f64) -> Tiff {
    Tiff::new((4, 3), Kind::I16, move |c, r| 100.0 * number + (10 * c + r) as f64)
}

fn source(kind: &str, name: &str, from: [f64; 4], to: [f64; 4], more: &str) -> String {
    let rectangle = |tag: &str, [x, y, w, h]: [f64; 4]| {
        format!(r#"<{tag} xOff="{x}" yOff="{y}" xSize="{w}" ySize="{h}" />"#)
    };
    format!(
        r#"<{kind} resampling="near"><SourceFilename relativeToVRT="1">{name}</SourceFilename><SourceBand>1</SourceBand>
        <SourceProperties RasterXSize="4" RasterYSize="3" DataType="Int16" BlockXSize="4" BlockYSize="3" />{}{}{more}</{kind}>"#,
        rectangle("SrcRect", from),
        rectangle("DstRect", to)
    )
}

fn dataset(band: &str) -> String {
    format!(
        r#"<VRTDataset rasterXSize="8" rasterYSize="3"><SRS>EPSG:32633</SRS>
        <GeoTransform> 1.0e+03, 1.0e+01, 0.0, 2.0e+03, 0.0, -1.0e+01</GeoTransform>
        <VRTRasterBand dataType="Int16" band="1">{band}</VRTRasterBand></VRTDataset>"#
    )
}

const WHOLE: [f64; 4] = [0.0, 0.0, 4.0, 3.0];

fn with_files<T>(xml: &str, then: impl FnOnce(&std::path::Path) -> T) -> T {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("tiles")).unwrap();
    for number in [1, 2] {
        let mut tiff = file(f64::from(number));
        tiff.tags.push((34735, Values::Shorts(vec![1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 32633])));
        std::fs::write(folder.path().join(format!("tiles/{number}.tif")), tiff.bytes()).unwrap();
    }
    let path = folder.path().join("all.vrt");
    std::fs::write(&path, xml).unwrap();
    then(&path)
}

fn read_vrt(xml: &str, options: &DemOptions) -> crate::Result<Dem> {
    with_files(xml, |path| read(path, options))
}

fn two() -> String {
    source("SimpleSource", "tiles/1.tif", WHOLE, WHOLE, "")
        + &source("SimpleSource", "tiles/2.tif", WHOLE, [4.0, 0.0, 4.0, 3.0], "")
}

#[test]
#[ignore = "writes the seeds for fuzzing into $DRAPERY_SEEDS"]
fn seeds_for_fuzzing_virtual_rasters() {
    let xml = dataset(
        &(source("SimpleSource", "a.tif", WHOLE, WHOLE, "")
            + &source("SimpleSource", "a.tif", WHOLE, [4.0, 0.0, 4.0, 3.0], "")),
    );
    seeds::plant("dem_vrt", [seeds::beside(xml.as_bytes(), &[("tif", &file(1.0).bytes())])]);
}

#[test]
fn files_side_by_side_are_one_terrain_whole_or_in_a_window() {
    let dem = read_vrt(&dataset(&two()), &DemOptions::default()).unwrap();
    assert_eq!(format!("{:?}", dem.crs_hint), "Some(Epsg(32633))");
    let whole = posts(dem);
    assert_eq!((whole.columns(), whole.rows(), whole.first), (8, 3, Plan::new(1005.0, 1975.0)));
    assert_eq!((whole.world(3, 2).z, whole.world(4, 2).z, whole.world(7, 0).z), (130.0, 200.0, 232.0));
    let window = DemOptions { window: Some([1035.0, 1975.0, 1045.0, 1985.0]), ..DemOptions::default() };
    let part = posts(read_vrt(&dataset(&two()), &window).unwrap());
    assert_eq!(part.heights(), [132.0, 202.0, 131.0, 201.0]);
    let told = with_files(&dataset(&two()), |path| describe(path, &DemOptions::default())).unwrap();
    assert_eq!(
        (told.format, told.size, told.heights),
        ("virtual raster", Some((8, 3)), Some([100.0, 232.0]))
    );
}

#[test]
fn later_files_lie_on_earlier_ones_except_where_they_hold_no_data() {
    let over = source("ComplexSource", "tiles/2.tif", WHOLE, [2.0, 0.0, 4.0, 3.0], "<NODATA>210</NODATA>");
    let band = source("SimpleSource", "tiles/1.tif", WHOLE, WHOLE, "") + &over;
    let posts = posts(read_vrt(&dataset(&band), &DemOptions::default()).unwrap());
    assert_eq!((posts.world(1, 2).z, posts.world(2, 2).z, posts.world(3, 2).z), (110.0, 200.0, 130.0));
    assert!(posts.world(7, 2).z.is_nan(), "what no file covers is no post");
}

#[test]
fn a_source_that_does_not_say_its_nodata_lays_its_holes_over_those_before_it() {
    let at = |kind: &str, more: &str| {
        let over = source(kind, "tiles/2.tif", WHOLE, WHOLE, more);
        let band = "<NoDataValue>210</NoDataValue>".to_owned()
            + &source("SimpleSource", "tiles/1.tif", WHOLE, WHOLE, "")
            + &over;
        posts(read_vrt(&dataset(&band), &DemOptions::default()).unwrap()).world(1, 2).z
    };
    assert!(at("SimpleSource", "").is_nan());
    assert!(at("ComplexSource", "").is_nan());
    assert!(at("SimpleSource", "<NODATA>210</NODATA>").is_nan(), "a simple source has no nodata");
    assert_eq!(at("ComplexSource", "<NODATA>210</NODATA>"), 110.0);
}

#[test]
fn holes_of_a_file_let_others_through_only_where_its_source_says_so() {
    let at = |kind: &str, more: &str| {
        let mut above = file(2.0);
        above.nodata = Some("210");
        let band = source("SimpleSource", "tiles/1.tif", WHOLE, WHOLE, "")
            + &source(kind, "tiles/2.tif", WHOLE, WHOLE, more);
        let dem = with_files(&dataset(&band), |path| {
            std::fs::write(path.with_file_name("tiles/2.tif"), above.bytes()).unwrap();
            read(path, &DemOptions::default()).unwrap()
        });
        posts(dem).world(1, 2).z
    };
    assert!(at("SimpleSource", "").is_nan());
    assert_eq!(at("ComplexSource", "<NODATA>210</NODATA>"), 110.0);
    assert_eq!(at("ComplexSource", "<UseMaskBand>true</UseMaskBand>"), 110.0);
}

/// The first file's metadata, and the second's, as two tiles side by side.
fn told_apart(items: [&str; 2], more: &str, options: &DemOptions) -> crate::Result<Dem> {
    with_files(&dataset(&(two() + more)), |path| {
        for (number, items) in (1..).zip(items) {
            let mut tiff = file(f64::from(number));
            tiff.tags.push((42112, Values::Text(format!("<GDALMetadata>{items}</GDALMetadata>"))));
            std::fs::write(path.with_file_name(format!("tiles/{number}.tif")), tiff.bytes()).unwrap();
        }
        read(path, options)
    })
}

#[test]
fn files_in_different_units_or_scales_are_refused_by_both_their_names_unless_the_raster_states_one() {
    const FEET: &str = r#"<Item name="UNITTYPE" sample="0" role="unittype">ft</Item>"#;
    const METRES: &str = r#"<Item name="UNITTYPE" sample="0" role="unittype">m</Item>"#;
    const TENTHS: &str = r#"<Item name="SCALE" sample="0" role="scale">0.1</Item>"#;
    let read = |items, more: &str| told_apart(items, more, &DemOptions::default());
    for (items, what) in
        [([FEET, METRES], "unit"), ([METRES, FEET], "unit"), ([FEET, ""], "unit"), ([TENTHS, ""], "scale")]
    {
        let message = read(items, "").unwrap_err().to_string();
        let is_named = message.contains("1.tif") && message.contains("2.tif") && message.contains(what);
        assert!(is_named && message.contains("source = ["), "{message}");
    }
    let heights = |items, more: &str| {
        let posts = posts(read(items, more).unwrap());
        (posts.world(0, 2).z, posts.world(4, 2).z)
    };
    assert_eq!(heights([FEET, FEET], ""), (100.0 * 0.3048, 200.0 * 0.3048));
    assert_eq!(heights([TENTHS, TENTHS], ""), (100.0 * 0.1, 200.0 * 0.1));
    assert_eq!(heights([METRES, ""], ""), (100.0, 200.0));
    assert_eq!(heights([FEET, METRES], "<UnitType>m</UnitType>"), (100.0, 200.0));
    assert_eq!(heights([TENTHS, ""], "<Scale>2</Scale>"), (200.0, 400.0));
}

#[test]
fn a_source_that_is_scaled_as_it_is_taken_is_not_scaled_again() {
    const TENTHS: &str = r#"<Item name="SCALE" sample="0" role="scale">0.5</Item>"#;
    let xml = dataset(&source(
        "ComplexSource",
        "tiles/1.tif",
        WHOLE,
        WHOLE,
        "<ScaleOffset>0</ScaleOffset><ScaleRatio>0.5</ScaleRatio>",
    ));
    let dem = with_files(&xml, |path| {
        let mut tiff = file(1.0);
        tiff.tags.push((42112, Values::Text(format!("<GDALMetadata>{TENTHS}</GDALMetadata>"))));
        std::fs::write(path.with_file_name("tiles/1.tif"), tiff.bytes()).unwrap();
        read(path, &DemOptions::default()).unwrap()
    });
    assert_eq!(posts(dem).world(0, 2).z, 50.0);
}

#[test]
fn a_mask_of_its_own_and_an_alpha_band_are_refused_with_the_command_that_keeps_them() {
    let alpha = source("SimpleSource", "tiles/2.tif", WHOLE, WHOLE, "");
    let alpha = format!(
        r#"<VRTRasterBand dataType="Byte" band="2"><ColorInterp>Alpha</ColorInterp>{alpha}</VRTRasterBand></VRTDataset>"#
    );
    let mask = |sources: &str| {
        format!(
            r#"<MaskBand><VRTRasterBand dataType="Byte">{sources}</VRTRasterBand></MaskBand></VRTDataset>"#
        )
    };
    let with = |more: &str| dataset(&two()).replace("</VRTDataset>", more);
    let of_files = two().replace("<SourceBand>1<", "<SourceBand>mask,1<");
    let first = source("SimpleSource", "tiles/1.tif", WHOLE, WHOLE, "").replace(">1</So", ">mask,1</So");
    for (xml, what) in [
        (with(&alpha), "alpha band"),
        (with(&mask(&two())), "mask of its own"),
        (with(&mask(&first)), "mask of other files"),
    ] {
        let message = read_vrt(&xml, &DemOptions::default()).unwrap_err().to_string();
        assert!(message.contains(what) && message.contains("gdal_translate"), "{message}");
    }
    // The files' own masks are read with them.
    assert!(read_vrt(&with(&mask(&of_files)), &DemOptions::default()).is_ok());
}

#[test]
fn heights_are_rounded_and_cut_to_the_kind_of_number_that_the_raster_stores() {
    let stored = |kind: &str, ratio: &str| {
        let scaled = format!("<ScaleOffset>0</ScaleOffset><ScaleRatio>{ratio}</ScaleRatio>");
        let band = source("ComplexSource", "tiles/1.tif", WHOLE, WHOLE, &scaled);
        let xml = dataset(&band).replace("<VRTRasterBand dataType=\"Int16\"", kind);
        Ok::<_, crate::Error>(posts(read_vrt(&xml, &DemOptions::default())?).world(0, 2).z)
    };
    let kind = |name: &str| format!("<VRTRasterBand dataType=\"{name}\"");
    assert_eq!(stored(&kind("Int16"), "0.016").unwrap(), 2.0);
    assert_eq!(stored(&kind("Int16"), "-0.015").unwrap(), -2.0);
    assert_eq!(stored(&kind("Int16"), "1000").unwrap(), 32767.0);
    assert_eq!(stored(&kind("Byte"), "-1").unwrap(), 0.0);
    assert_eq!(stored("<VRTRasterBand", "3").unwrap(), 255.0);
    assert_eq!(stored(&kind("Float32"), "0.001").unwrap(), f64::from(0.1_f32));
    assert_eq!(stored(&kind("Float64"), "0.001").unwrap(), 0.1);
    assert!(stored(&kind("CFloat32"), "1").unwrap_err().to_string().contains("CFloat32"));
}

#[test]
fn scale_offset_nodata_and_unit_of_the_raster_count() {
    let scaled = "<ScaleOffset>1000</ScaleOffset><ScaleRatio>2</ScaleRatio>";
    let band = source("ComplexSource", "tiles/1.tif", WHOLE, WHOLE, scaled);
    let posts_of =
        |more: &str| posts(read_vrt(&dataset(&(band.clone() + more)), &DemOptions::default()).unwrap());
    assert_eq!(posts_of("").world(0, 2).z, 1200.0);
    assert!(posts_of("<NoDataValue>1200</NoDataValue>").world(0, 2).z.is_nan());
    assert_eq!(posts_of("<UnitType>ft</UnitType>").world(0, 2).z, 1200.0 * 0.3048);
    assert_eq!(posts_of("<Scale>0.5</Scale><Offset>7</Offset>").world(0, 2).z, 607.0);
}

#[test]
fn rectangles_that_leave_the_raster_are_cut_and_ones_that_leave_a_file_refused() {
    let band = source("SimpleSource", "tiles/1.tif", WHOLE, [-2.0, 0.0, 4.0, 3.0], "");
    let posts = posts(read_vrt(&dataset(&band), &DemOptions::default()).unwrap());
    assert_eq!((posts.world(0, 2).z, posts.world(1, 2).z), (120.0, 130.0));
    let band = source("SimpleSource", "tiles/1.tif", [0.0, 0.0, 8.0, 3.0], [0.0, 0.0, 8.0, 3.0], "");
    let message = read_vrt(&dataset(&band), &DemOptions::default()).unwrap_err().to_string();
    assert!(message.contains("1.tif") && message.contains("has 4 x 3"), "{message}");
}

#[test]
fn what_is_more_than_plain_files_is_refused_by_name() {
    let half = [0.0, 0.0, 2.0, 1.5];
    let simple = |name: &str| source("SimpleSource", name, WHOLE, WHOLE, "");
    for (xml, expected) in [
        (dataset(&source("SimpleSource", "tiles/1.tif", WHOLE, half, "")), "resampled to 2 x 1.5"),
        (dataset(&source("SimpleSource", "tiles/1.tif", WHOLE, [0.5, 0.0, 4.0, 3.0], "")), "pixel 0.5"),
        (dataset(&source("ComplexSource", "tiles/1.tif", WHOLE, WHOLE, "<LUT>0:1,2:3</LUT>")), "LUT"),
        (dataset(&source("KernelFilteredSource", "tiles/1.tif", WHOLE, WHOLE, "")), "KernelFilteredSource"),
        (dataset(&two()).replace("<VRTDataset ", "<VRTDataset subClass=\"VRTWarpedDataset\" "), "VRTWarped"),
        (
            dataset(&two()).replace("band=\"1\">", "band=\"1\" subClass=\"VRTDerivedRasterBand\">"),
            "VRTDerived",
        ),
        (dataset(&two()).replace("band=\"1\">", "band=\"2\">"), "no such band"),
        (dataset(&two()).replace("\"8\"", "\"many\""), "`many`"),
        (dataset(&two()).replace("\"8\"", "\"99999999999999999999\""), "999"),
        (dataset(&simple("/vsicurl/x.tif")), "no file on disk"),
        (dataset(&simple("all.vrt")), "names another"),
        (dataset(&simple("tiles/3.tif")), "3.tif"),
        (dataset(""), "names no file"),
        ("<VRTDataset".into(), "XML"),
        ("<other/>".into(), "<other> is no virtual raster"),
    ] {
        let message = read_vrt(&xml, &DemOptions::default()).unwrap_err().to_string();
        assert!(message.contains(expected), "{expected}: {message}");
    }
}

#[test]
fn a_few_words_cannot_promise_more_posts_than_anyone_waits_for() {
    let wide = |text: &str| dataset(&two()).replace("rasterXSize=\"8\"", text);
    for xml in [
        wide("rasterXSize=\"2000000000\""),
        wide("rasterXSize=\"9000000\"").replace("rasterYSize=\"3\"", "rasterYSize=\"2000000000\""),
        wide("rasterXSize=\"90000\"").replace("rasterYSize=\"3\"", "rasterYSize=\"90000\""),
    ] {
        let message = with_files(&xml, |path| {
            let refused =
                [read(path, &DemOptions::default()).err(), describe(path, &DemOptions::default()).err()];
            refused.map(|error| error.unwrap().to_string())
        });
        assert!(message.iter().all(|m| m.contains("are more than")), "{message:?}");
    }
    let many = two().repeat(70);
    let message = read_vrt(&dataset(&many), &DemOptions::default()).unwrap_err().to_string();
    assert!(message.contains("lie on one another"), "{message}");
}

#[test]
fn one_that_names_itself_by_another_name_ends() {
    let xml = dataset(&source("SimpleSource", "self.tif", WHOLE, WHOLE, ""));
    let message = with_files(&xml, |path| {
        std::fs::write(path.with_file_name("self.tif"), &xml).unwrap();
        read(path, &DemOptions::default()).unwrap_err().to_string()
    });
    assert!(message.contains("self.tif"), "{message}");
}
