//! Other writers' spellings of what has a code.

use super::*;

/// As GDAL writes it; `tail` is what follows the projection's parameters.
fn web_mercator(tail: &str) -> String {
    format!(
        r#"PROJCS["WGS 84 / Pseudo-Mercator",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Mercator_1SP"],PARAMETER["central_meridian",0],PARAMETER["scale_factor",1],PARAMETER["false_easting",0],PARAMETER["false_northing",0],UNIT["metre",1],EXTENSION["PROJ4","+proj=merc +a=6378137 +b=6378137 +lat_ts=0 +lon_0=0 +x_0=0 +y_0=0 +k=1 +units=m +nadgrids=@null +wktext +no_defs"]{tail}]"#
    )
}

#[test]
fn web_mercator_is_read_in_all_its_spellings() {
    let expected = crs("EPSG:3857");
    for text in [
        web_mercator(""),
        web_mercator(r#",AUTHORITY["EPSG","3857"]"#),
        "EPSG:900913".to_owned(),
        "ESRI:102100".to_owned(),
        "+init=epsg:3857".to_owned(),
        "+init=epsg:3857 +no_defs".to_owned(),
    ] {
        let read = crs(&text);
        assert!(read.is_same(&expected), "{text}: {read:?}");
        assert_eq!(read.note(), None, "{text}");
    }
}

#[test]
fn a_compound_code_is_read_by_its_horizontal_part() {
    assert_eq!(crs("EPSG:32633+5773").epsg(), Some(32633));
    assert_eq!(crs("EPSG:32633+6360").epsg(), Some(32633));
}

#[test]
fn init_with_more_than_a_code_is_refused() {
    assert!(Crs::parse("+init=epsg:32633 +lon_0=4").is_err());
}

#[test]
fn esris_behrmann_and_stereographic_agree_with_proj() {
    let degrees = r#"GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137.0,298.257223563]],PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]]"#;
    let behrmann = format!(
        r#"PROJCS["World_Behrmann",{degrees},PROJECTION["Behrmann"],PARAMETER["False_Easting",0.0],PARAMETER["False_Northing",0.0],PARAMETER["Central_Meridian",0.0],UNIT["Meter",1.0]]"#
    );
    let stereographic = |lat: f64| {
        format!(
            r#"PROJCS["UPS_North",{degrees},PROJECTION["Stereographic"],PARAMETER["False_Easting",2000000.0],PARAMETER["False_Northing",2000000.0],PARAMETER["Central_Meridian",0.0],PARAMETER["Scale_Factor",0.994],PARAMETER["Latitude_Of_Origin",{lat:?}],UNIT["Meter",1.0]]"#
        )
    };
    // reference: PROJ 9.5.1
    let there = projected(&behrmann, 10.0, 50.0);
    assert!((there - DVec2::new(964_862.802_508_965, 5_614_050.103_060_801_5)).length() < 1e-3, "{there}");
    check(&stereographic(90.0), 30.0, 80.0, 2_556_475.568_477_452_7, 1_036_156.042_226_277_9);
    assert!(crs(&stereographic(90.0)).is_same(&crs("EPSG:32661")));
    // That of a place between is not the double stereographic, which is all there is here.
    assert!(Crs::parse(&stereographic(52.0)).is_err());
}
