//! Datums that WKT names without a code, and ellipsoids that name none.

use super::*;

/// The Esri text of a transverse Mercator: the datum's name, its ellipsoid, and latitude and longitude of origin, scale, offsets.
fn esri(datum: &str, spheroid: &str, [lat_0, lon_0, k_0, x_0, y_0]: [f64; 5]) -> String {
    format!(
        r#"PROJCS["x",GEOGCS["y",DATUM["{datum}",SPHEROID[{spheroid}]],PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["False_Easting",{x_0}],PARAMETER["False_Northing",{y_0}],PARAMETER["Central_Meridian",{lon_0}],PARAMETER["Scale_Factor",{k_0}],PARAMETER["Latitude_Of_Origin",{lat_0}],UNIT["Meter",1.0]]"#
    )
}

const GRS80: &str = r#""GRS_1980",6378137.0,298.257222101"#;
const WGS84: &str = r#""WGS_1984",6378137.0,298.257223563"#;
const GREECE: [f64; 5] = [0.0, 24.0, 0.9996, 500_000.0, 0.0];
const VIETNAM: [f64; 5] = [0.0, 105.0, 0.9996, 500_000.0, 0.0];
const ISRAEL: [f64; 5] = [31.734_393_611_111_1, 35.204_516_944_444_4, 1.000_006_7, 219_529.584, 626_907.39];

#[test]
fn a_datum_on_the_ellipsoid_of_wgs_84_is_shifted_by_its_name() {
    // reference: PROJ 9.5.1, one of its operations for the code
    for (datum, spheroid, numbers, place, expected, code) in [
        ("D_GGRS_1987", GRS80, GREECE, (23.7, 38.0), (473_511.081, 4_205_569.560), 2100),
        (
            "Greek_Geodetic_Reference_System_1987",
            GRS80,
            GREECE,
            (23.7, 38.0),
            (473_511.081, 4_205_569.560),
            2100,
        ),
        ("D_Vietnam_2000", WGS84, VIETNAM, (105.85, 21.03), (588_127.340, 2_325_811.035), 3405),
        ("D_Israel", GRS80, ISRAEL, (35.2, 31.8), (219_029.223, 634_133.910), 2039),
        ("Israel_1993", GRS80, ISRAEL, (35.2, 31.8), (219_029.223, 634_133.910), 2039),
    ] {
        let read = crs(&esri(datum, spheroid, numbers));
        let p = read.native_from_geographic(DVec2::from(place)).unwrap();
        let off = (p - DVec2::from(expected)).length();
        // Of two operations for Israel PROJ's lie 10 m from each other.
        assert!(off < if code == 2039 { 10.0 } else { 1.0 }, "{datum}: {p}, {off} m off");
        let coded = crs(&format!("EPSG:{code}")).native_from_geographic(DVec2::from(place)).unwrap();
        assert!((p - coded).length() < 10.0, "{datum}: {p}, by its code {coded}");
        assert_eq!(read.note(), None, "{datum}");
    }
}

#[test]
fn datums_that_agree_with_wgs_84_are_known_in_all_their_spellings() {
    for datum in [
        "WGS_1984",
        "D_WGS_1984",
        "World Geodetic System 1984 ensemble",
        "D_ETRS_1989",
        "European Terrestrial Reference System 1989 ensemble",
        "European_Terrestrial_Reference_Frame_2014",
        "D_North_American_1983",
        "D_NAD_1983_2011",
        "North_American_Datum_of_1983_CSRS_version_8",
        "D_GDA_1994",
        "GDA2020",
        "D_NZGD_2000",
        "D_JGD_2011",
        "D_SIRGAS_2000",
        "D_RGF_1993",
        "Reseau_Geodesique_Francais_1993_v2b",
        "D_ITRF_2008",
        "D_Hartebeesthoek_1994",
        "D_Korea_Geodetic_Datum_2002",
        "D_MAGNA",
        "Lithuania_1994_ETRS89",
    ] {
        let read = crs(&esri(datum, GRS80, GREECE));
        assert_eq!((read.datum, read.note()), (Datum::Wgs84, None), "{datum}");
    }
}

#[test]
fn an_ellipsoid_alone_states_no_datum_and_its_places_stay() {
    let stated = crs("+proj=utm +zone=33 +datum=WGS84");
    let place = DVec2::new(15.5, 47.0);
    for text in [
        "+proj=utm +zone=33 +ellps=GRS80".to_owned(),
        "+proj=utm +zone=33 +ellps=WGS84".to_owned(),
        "+proj=utm +zone=33".to_owned(),
        esri("D_Barsoom", GRS80, [0.0, 15.0, 0.9996, 500_000.0, 0.0]),
        esri("Unknown based on GRS80 ellipsoid", GRS80, [0.0, 15.0, 0.9996, 500_000.0, 0.0]),
    ] {
        let unknown = crs(&text);
        let note = unknown.note().unwrap();
        assert!(note.contains("no datum shift is known"), "{note}");
        let p = unknown.native_from_geographic(place).unwrap();
        assert!((p - stated.native_from_geographic(place).unwrap()).length() < 1e-3, "{text}: {p}");
    }
    for text in ["+proj=utm +zone=33 +ellps=GRS80 +towgs84=0,0,0", "+proj=utm +zone=33 +datum=NAD83"] {
        assert_eq!(crs(text).note(), None, "{text}");
    }
}

#[test]
fn an_unknown_datum_is_not_taken_for_another_on_its_ellipsoid() {
    let greek = PlanSpace::projected(crs("EPSG:2100")).unwrap();
    let place = DVec2::new(23.7, 38.0);
    let [unknown, wgs84] =
        ["+proj=longlat +ellps=GRS80", "EPSG:4326"].map(|text| greek.plan_from(&crs(text)).unwrap());
    let [unknown, wgs84] = [unknown, wgs84].map(|map| map.apply(place).unwrap());
    assert!((unknown - wgs84).length() < 1e-3, "{unknown} {wgs84}");
}

#[test]
fn a_datum_without_a_usual_name_is_found_by_the_code_of_its_degrees() {
    let text = esri("no name", GRS80, GREECE)
        .replace("0.0174532925199433]]", "0.0174532925199433],AUTHORITY[\"EPSG\",\"4121\"]]");
    assert!(matches!(crs(&text).datum, Datum::Shift(_)));
}
