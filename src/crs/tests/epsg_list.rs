//! The list of EPSG codes against PROJ's database.

use super::*;

#[test]
fn codes_place_points_where_proj_does() {
    let mut off = Vec::new();
    for line in include_str!("epsg.txt").lines().filter(|line| !line.starts_with('#')) {
        let numbers: Vec<f64> = line.split(' ').map(|number| number.parse().unwrap()).collect();
        let [code, lon, lat, x, y] = numbers[..] else { panic!("{line}") };
        let crs = Crs::from_epsg(code as u32).unwrap();
        let metres = if crs.is_geographic() { 111_000.0 } else { 1.0 } * crs.unit;
        let p = crs.native_from_geographic(DVec2::new(lon, lat)).unwrap();
        let distance = (p - DVec2::new(x, y)).length() * metres;
        if distance > 1.0 {
            off.push(format!("{}: {distance} m", crs.name()));
        }
    }
    assert!(off.is_empty(), "{off:#?}");
}

#[test]
fn a_code_that_cannot_be_followed_names_another() {
    for (code, instead) in
        [(6200, "EPSG:6966"), (6996, "EPSG:7131"), (26591, "EPSG:3003"), (4120, "EPSG:4121")]
    {
        let error = Crs::from_epsg(code).unwrap_err();
        assert!(error.to_string().contains(instead), "{error}");
        let other = Crs::parse(instead).unwrap();
        assert_eq!(other.note(), None);
    }
}

#[test]
fn a_code_without_a_shift_in_its_area_says_so() {
    for code in [2042, 5520, 31267, 21416] {
        let note = Crs::from_epsg(code).unwrap().note().unwrap();
        assert!(note.contains("no datum shift is known"), "{note}");
    }
    for code in [2082, 3844, 4688, 5682] {
        assert_eq!(Crs::from_epsg(code).unwrap().note(), None, "{code}");
    }
}

#[test]
fn a_code_in_grads_counts_grads() {
    let paris = Crs::from_epsg(4807).unwrap();
    let there = paris.geographic_from_native(DVec2::new(0.0, 54.0)).unwrap();
    // reference: PROJ 9.5.1
    assert!((there - DVec2::new(2.3365092458, 48.5999322390)).length() < 1e-6, "{there}");
}

#[test]
fn a_crs_that_counts_west_or_south_is_no_plan() {
    for text in
        ["EPSG:2048", "EPSG:5513", "EPSG:2065", "+proj=cass +axis=wsu", "+proj=utm +zone=33 +axis=neu"]
    {
        let error = PlanSpace::projected(crs(text)).unwrap_err();
        assert!(error.what().contains("counts west or south"), "{text}: {error}");
    }
    assert!(PlanSpace::projected(crs("EPSG:5514")).is_ok());
    let east = crs("EPSG:5514").native_from_geographic(DVec2::new(14.42, 50.09)).unwrap();
    let south = crs("EPSG:5513").native_from_geographic(DVec2::new(14.42, 50.09)).unwrap();
    assert_eq!((south.x, south.y), (-east.y, -east.x));
}

#[test]
fn a_wkt_counts_where_its_code_does() {
    for code in [2065, 5513, 5514] {
        let listed = crs_definitions::from_code(code).unwrap().wkt;
        let bare = listed.replace("AUTHORITY[\"EPSG\"", "AUTHORITY[\"NONE\"");
        let (read, known) = (crs(&bare), Crs::from_epsg(u32::from(code)).unwrap());
        assert!(read.is_same(&known), "{read:?}\n{known:?}");
    }
    // A transverse Mercator that counts west and south, under a name without a number.
    let [east, west] = ["AXIS[\"X\",EAST],AXIS[\"Y\",NORTH]", "AXIS[\"Y\",WEST],AXIS[\"X\",SOUTH]"]
        .map(|axes| crs(&UTM_33S.replace("UNIT[\"Meter\",1]", &format!("UNIT[\"Meter\",1],{axes}"))));
    let place = DVec2::new(18.0, -30.0);
    assert_eq!(west.project(place).unwrap(), -east.project(place).unwrap());
}

#[test]
fn prime_meridians_are_those_of_proj() {
    // reference: PROJ 9.5.1
    for (name, degrees) in
        [("copenhagen", 12.577_875), ("ferro", -17.666_666_666_7), ("madrid", -3.687_938_888_9)]
    {
        let meridian = crs(&format!("+proj=longlat +ellps=WGS84 +pm={name}"));
        let there = meridian.geographic_from_native(DVec2::ZERO).unwrap();
        assert!((there.x - degrees).abs() < 1e-9, "{name}: {there}");
    }
}
