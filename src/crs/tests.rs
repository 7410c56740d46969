use super::degrees::wrapped;
use super::*;
use crate::math;
use proptest::prelude::*;

mod datums;
mod epsg_list;
mod own;
mod spellings;

fn crs(text: &str) -> Crs {
    Crs::parse(text).unwrap()
}

fn projected(text: &str, lon: f64, lat: f64) -> DVec2 {
    crs(text).project(DVec2::new(lon, lat)).unwrap()
}

#[track_caller]
fn check(text: &str, lon: f64, lat: f64, x: f64, y: f64) {
    let p = projected(text, lon, lat);
    let off = (p - DVec2::new(x, y)).length();
    assert!(off <= 1e-6, "{text} of ({lon}, {lat}) is {p}, {off} m off");
    let back = crs(text).own_geographic(p).unwrap();
    let off = (back - DVec2::new(lon, lat)).length();
    assert!(off <= 1e-9, "{text}: ({lon}, {lat}) came back {off} degrees off");
}

#[test]
fn transverse_mercator_agrees_with_proj() {
    // reference: PROJ 9
    check("EPSG:32733", 20.5, -34.0, 1_008_207.250_195_427_8, 6_224_178.920_222_426);
    check("EPSG:32733", 15.0, -1.0, 500_000.0, 9_889_469.841_197_625);
    check("EPSG:32733", 13.2, -79.5, 463_386.076_658_9, 1_173_655.417_880_704_6);
    check("EPSG:32733", 25.0, -33.9, 1_426_337.309_456_384_7, 6_203_567.979_338_501);
    check("EPSG:32611", -118.2, 34.3, 389_570.721_788_346_07, 3_796_071.921_889_133);
    check("EPSG:32611", -110.0, 40.0, 1_097_776.666_966_041_6, 4_451_293.437_195_173);
    check("EPSG:3794", 14.5, 46.05, 461_307.139_403_884_94, 101_254.901_891_653_43);
    check("EPSG:3794", 16.2, 46.8, 591_597.635_713_253_9, 185_194.011_852_379_9);
    check("EPSG:2193", 174.78, -41.3, 1_749_023.033_640_432_4, 5_426_411.161_363_149);
    check("EPSG:2193", 166.5, -46.0, 1_096_728.102_992_250_4, 4_885_373.763_791_157);
    check("EPSG:2193", -176.5, -44.0, 2_441_977.480_125_731, 5_074_225.226_125_137);
    check("EPSG:23030", -5.3, 40.3, 304_517.023_596_622_63, 4_463_670.482_728_695_5);
    check("EPSG:27700", -1.5, 52.0, 434_321.869_053_483_94, 233_671.743_101_249_86);
    check("EPSG:27700", -5.7, 50.1, 135_440.051_935_812_63, 28_840.527_818_251_678);
}

#[test]
fn conic_and_mercator_agree_with_proj() {
    // reference: PROJ 9
    check("EPSG:31287", 11.3, 47.1, 245_726.780_329_389_96, 357_567.732_656_498_96);
    check("EPSG:31287", 16.4, 48.2, 627_817.084_195_811, 482_293.839_064_645_1);
    check("EPSG:2154", 2.3, 48.8, 648_583.262_125_228_5, 6_855_774.715_696_832);
    check("EPSG:2154", -4.5, 48.4, 145_709.788_949_823_24, 6_837_422.082_614_361);
    check("EPSG:3857", -122.0, 47.0, -13_580_977.876_779_376, 5_942_074.072_431_109);
    check("EPSG:3857", 179.9, -84.0, 20_026_376.393_709_917, -18_807_214.096_747_704);
    check("EPSG:3395", 10.0, 50.0, 1_113_194.907_932_735_7, 6_413_524.594_163_64);
}

#[test]
fn imported_projections_agree_with_proj_to_a_tenth_of_a_millimetre() {
    // reference: PROJ 9.5.1, on each code's own datum
    for (text, lon, lat, x, y) in [
        ("EPSG:29873", 115.0, 5.0, 590121.1779573819, 553415.8095151458),
        ("EPSG:3168", 102.0, 4.0, 445100.28590808174, 442475.4979159335),
        ("EPSG:3375", 102.0, 4.0, 445072.33326358895, 442508.8986183557),
        ("EPSG:5880", -50.0, -12.0, 5435595.308444151, 8669754.14760566),
        ("EPSG:28191", 35.2, 31.8, 169107.5076776513, 134175.20106805803),
        ("EPSG:4087", 10.0, 50.0, 1113194.9079327357, 5565974.539663678),
    ] {
        assert!(crs(text).is_imported(), "{text}");
        let p = projected(text, lon, lat);
        assert!((p - DVec2::new(x, y)).length() < 1e-4, "{text}: {p}");
        assert_eq!(p.x * 1_048_576.0, (p.x * 1_048_576.0).round());
        let back = crs(text).own_geographic(p).unwrap();
        assert!((back - DVec2::new(lon, lat)).length() < 1e-8, "{text}: {back}");
    }
}

#[test]
fn datum_shifts_agree_with_proj() {
    // reference: PROJ 9, the same +towgs84 in its pipeline
    for (text, x, y, lon, lat) in [
        ("EPSG:31287", 290_000.0, 300_000.0, 11.896_897_621_697_232, 46.590_519_431_960_16),
        ("EPSG:31287", 600_000.0, 480_000.0, 16.023_647_356_813_026, 48.188_137_328_129_145),
        (
            "+proj=utm +zone=30 +ellps=intl +towgs84=-87,-98,-121,0,0,0,0 +units=m",
            270_000.0,
            4_460_000.0,
            -5.705_652_047_792_929,
            40.256_991_059_057_53,
        ),
        (
            "+proj=tmerc +lat_0=49 +lon_0=-2 +k=0.9996012717 +x_0=400000 +y_0=-100000 +ellps=airy \
             +towgs84=446.448,-125.157,542.06,0.15,0.247,0.842,-20.489 +units=m",
            430_000.0,
            230_000.0,
            -1.564_739_752_534_361,
            51.967_670_895_305_886,
        ),
    ] {
        let p = crs(text).geographic_from_native(DVec2::new(x, y)).unwrap();
        assert!((p - DVec2::new(lon, lat)).length() < 1e-11, "{text}: {p}");
        let back = crs(text).native_from_geographic(p).unwrap();
        assert!((back - DVec2::new(x, y)).length() < 1e-6, "{text}: {back}");
    }
}

#[test]
fn the_bits_of_our_own_projections_are_golden() {
    let bits = |text: &str, lon, lat| {
        let p = projected(text, lon, lat);
        (p.x.to_bits(), p.y.to_bits())
    };
    assert_eq!(bits("EPSG:32733", 20.5, -34.0), (4_696_907_646_427_045_227, 4_708_441_172_201_499_802));
    assert_eq!(bits("EPSG:2193", 174.78, -41.3), (4_700_262_808_449_493_200, 4_707_584_575_592_973_850));
    assert_eq!(bits("EPSG:31287", 11.3, 47.1), (4_687_683_120_720_074_110, 4_689_886_579_336_773_952));
    assert_eq!(bits("EPSG:3857", -122.0, 47.0), (13_936_924_879_435_502_495, 4_708_138_264_427_673_111));
    assert_eq!(bits("EPSG:3035", 25.0, 60.0), (4_707_290_817_109_146_933, 4_706_248_896_663_826_774));
    assert_eq!(bits("EPSG:5070", -118.2, 34.3), (13_924_753_059_924_104_030, 4_699_125_751_097_894_072));
    assert_eq!(bits("EPSG:3413", -50.0, 70.5), (13_908_997_202_027_082_453, 13_925_187_862_273_631_158));
    assert_eq!(bits("EPSG:28992", 4.9, 52.37), (4_683_106_027_621_189_740, 4_692_108_512_661_243_615));
    assert_eq!(bits("EPSG:2056", 7.5, 46.9), (4_702_847_753_826_265_391, 4_697_879_760_864_365_514));
    assert_eq!(bits("EPSG:5514", 14.42, 50.09), (13_918_001_135_964_843_807, 13_920_576_806_679_542_358));
}

const UTM_33S: &str = r#"PROJCS["WGS_1984_UTM_Zone_33S",GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["Degree",0.017453292519943295]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",15],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",10000000],UNIT["Meter",1]]"#;
const MGI_LAMBERT: &str = r#"PROJCS["MGI_Austria_Lambert",GEOGCS["GCS_MGI",DATUM["D_MGI",SPHEROID["Bessel_1841",6377397.155,299.1528128]],PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]],PROJECTION["Lambert_Conformal_Conic"],PARAMETER["False_Easting",400000.0],PARAMETER["False_Northing",400000.0],PARAMETER["Central_Meridian",13.3333333333333],PARAMETER["Standard_Parallel_1",49.0],PARAMETER["Standard_Parallel_2",46.0],PARAMETER["Latitude_Of_Origin",47.5],UNIT["Meter",1.0]]"#;
const ED50_30N: &str = r#"PROJCS["ED50_UTM_zone_30N",GEOGCS["GCS_European_1950",DATUM["D_European_1950",SPHEROID["International_1924",6378388,297]],PRIMEM["Greenwich",0],UNIT["Degree",0.017453292519943295]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",-3],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],UNIT["Meter",1]]"#;
const NZTM_UNKNOWN: &str = r#"PROJCS["unknown",GEOGCS["unknown",DATUM["Unknown based on GRS80 ellipsoid",SPHEROID["GRS 1980",6378137,298.257222101]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",173],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",1600000],PARAMETER["false_northing",10000000],UNIT["metre",1]]"#;
const UTM_33S_WKT2: &str = r#"PROJCRS["some name",BASEGEOGCRS["WGS 84",DATUM["World Geodetic System 1984",ELLIPSOID["WGS 84",6378137,298.257223563,LENGTHUNIT["metre",1]]],PRIMEM["Greenwich",0,ANGLEUNIT["degree",0.0174532925199433]]],CONVERSION["UTM zone 33S",METHOD["Transverse Mercator",ID["EPSG",9807]],PARAMETER["Latitude of natural origin",0,ANGLEUNIT["degree",0.0174532925199433]],PARAMETER["Longitude of natural origin",15,ANGLEUNIT["degree",0.0174532925199433]],PARAMETER["Scale factor at natural origin",0.9996,SCALEUNIT["unity",1]],PARAMETER["False easting",500000,LENGTHUNIT["metre",1]],PARAMETER["False northing",10000000,LENGTHUNIT["metre",1]]],CS[Cartesian,2],AXIS["(E)",east,ORDER[1],LENGTHUNIT["metre",1]],AXIS["(N)",north,ORDER[2],LENGTHUNIT["metre",1]]]"#;
const STATE_PLANE: &str = r#"PROJCS["NAD_1983_StatePlane_New_York_Long_Island_FIPS_3104_Feet",GEOGCS["GCS_North_American_1983",DATUM["D_North_American_1983",SPHEROID["GRS_1980",6378137.0,298.257222101]],PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]],PROJECTION["Lambert_Conformal_Conic"],PARAMETER["False_Easting",984250.0],PARAMETER["False_Northing",0.0],PARAMETER["Central_Meridian",-74.0],PARAMETER["Standard_Parallel_1",40.66666666666666],PARAMETER["Standard_Parallel_2",41.03333333333333],PARAMETER["Latitude_Of_Origin",40.16666666666666],UNIT["Foot_US",0.3048006096012192]]"#;

#[test]
fn wkt_is_the_same_crs_as_its_epsg_code() {
    for (wkt, code) in [
        (UTM_33S, 32733),
        (UTM_33S_WKT2, 32733),
        (MGI_LAMBERT, 31287),
        (ED50_30N, 23030),
        (NZTM_UNKNOWN, 2193),
        (STATE_PLANE, 2263),
        (
            r#"GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["Degree",0.017453292519943295]]"#,
            4326,
        ),
        (
            r#"GEOGCS["GCS_North_American_1983",DATUM["D_North_American_1983",SPHEROID["GRS_1980",6378137,298.257222101]],PRIMEM["Greenwich",0],UNIT["Degree",0.017453292519943295]]"#,
            4326,
        ),
        (
            r#"PROJCS["Web",GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137,298.257223563]],PRIMEM["Greenwich",0],UNIT["Degree",0.017453292519943295]],PROJECTION["Mercator_Auxiliary_Sphere"],PARAMETER["Central_Meridian",0],PARAMETER["Standard_Parallel_1",0],PARAMETER["Auxiliary_Sphere_Type",0],UNIT["Meter",1]]"#,
            3857,
        ),
    ] {
        let (read, known) = (crs(wkt), Crs::from_epsg(code).unwrap());
        assert!(read.is_same(&known) && known.is_same(&read), "{code}:\n{read:#?}\n{known:#?}");
        // Its datum is called "unknown".
        assert_eq!(read.note().is_some(), wkt == NZTM_UNKNOWN);
    }
}

#[test]
fn every_wkt_of_the_epsg_list_is_the_same_crs_without_its_codes() {
    let (mut same, mut other) = (0, Vec::new());
    for code in (2000..2400).chain(3000..4300).chain(23000..32800) {
        let Some(known) = crs_definitions::from_code(code) else {
            continue;
        };
        let Ok(expected) = Crs::from_epsg(u32::from(code)) else {
            continue;
        };
        if epsg_corrections::corrected(u32::from(code), known.proj4) != known.proj4 {
            continue;
        }
        let bare = known
            .wkt
            .replace("AUTHORITY[\"EPSG\"", "AUTHORITY[\"NONE\"")
            .replace("EXTENSION[\"PROJ4\"", "EXTENSION[\"NONE\"");
        match Crs::parse(&bare) {
            Ok(read) if read.is_same(&expected) => same += 1,
            _ => other.push(code),
        }
    }
    // What is left: shifts that the code's PROJ string has and its WKT does not, and rare projections.
    assert!(other.len() * 80 < same, "{same} same, {} other: {other:?}", other.len());
}

#[test]
fn different_systems_are_not_the_same() {
    for (a, b) in [
        ("EPSG:32733", "EPSG:32633"),
        ("EPSG:32733", "EPSG:32734"),
        ("EPSG:4326", "EPSG:4230"),
        ("EPSG:3857", "EPSG:3395"),
        ("EPSG:23030", "EPSG:32630"),
        ("EPSG:3035", "EPSG:2056"),
    ] {
        assert!(!crs(a).is_same(&crs(b)), "{a} {b}");
    }
}

#[test]
fn all_spellings_of_longitude_and_latitude_are_one() {
    for text in [
        "OGC:CRS84",
        "urn:ogc:def:crs:OGC:1.3:CRS84",
        "urn:ogc:def:crs:EPSG::4326",
        "epsg:4326",
        "http://www.opengis.net/def/crs/EPSG/0/4326",
        "+proj=longlat +datum=WGS84 +no_defs",
    ] {
        assert!(crs(text).is_same(&crs("EPSG:4326")) && crs(text).is_geographic(), "{text}");
    }
}

#[test]
fn what_is_not_a_crs_is_refused_in_words() {
    for text in [
        "",
        "EPSG:",
        "EPSG:99999999",
        "EPSG:4978",
        "moon",
        "+proj=",
        "+proj=utm",
        "+proj=utm +zone=99",
        "+proj=nonsense",
        "PROJCS[",
        "PROJCS[]",
        "LOCAL_CS[\"x\"]",
        "+proj=longlat +ellps=potato",
        "+proj=tmerc +k=0",
        "+proj=lcc +lat_1=90",
        "+proj=merc +a=nan",
        "+proj=utm +zone=3 +towgs84=1,2",
        "+proj=tmerc +lat_0=1e9",
        "+proj=laea +lat_0=52 +ellps=GRS80 +R_A",
    ] {
        let error = Crs::parse(text).expect_err(text);
        assert!(!error.is_internal() && !error.what().is_empty(), "{text}: {error}");
    }
}

#[test]
#[ignore = "writes the seeds for fuzzing into $DRAPERY_SEEDS"]
fn seeds_for_fuzzing_crs() {
    let texts =
        [UTM_33S, MGI_LAMBERT, UTM_33S_WKT2, STATE_PLANE, "EPSG:31287", "urn:ogc:def:crs:OGC:1.3:CRS84"];
    let proj = [
        "+proj=utm +zone=33 +south +datum=WGS84 +units=m",
        "+proj=lcc +lat_1=49 +lat_2=46 +lat_0=47.5 +lon_0=13.3 +x_0=400000 +y_0=400000 +ellps=bessel +towgs84=577,90,463,5.1,1.4,5.2,2.4 +pm=ferro",
        "+proj=laea +lat_0=52 +lon_0=10 +ellps=GRS80 +to_meter=0.3048",
    ];
    crate::seeds::plant("crs", texts.into_iter().chain(proj));
}

#[test]
fn deep_brackets_are_refused() {
    assert!(Crs::parse(&"PROJCS[".repeat(20_000)).is_err());
}

#[test]
fn places_outside_the_domain_are_errors() {
    let utm = crs("EPSG:32733");
    assert!(utm.native_from_geographic(DVec2::new(105.0, 0.0)).is_err());
    assert!(utm.native_from_geographic(DVec2::new(15.0, 91.0)).is_err());
    assert!(utm.native_from_geographic(DVec2::new(f64::NAN, 0.0)).is_err());
    assert!(utm.geographic_from_native(DVec2::new(f64::INFINITY, 0.0)).is_err());
    assert!(crs("EPSG:3857").native_from_geographic(DVec2::new(0.0, 90.0)).is_err());
    assert!(crs("EPSG:4326").geographic_from_native(DVec2::new(240_000.0, 350_000.0)).is_err());
}

#[test]
fn feet_become_metres_in_the_plan() {
    let plan = PlanSpace::projected(crs("EPSG:2263")).unwrap();
    // reference: PROJ 9, EPSG:2263 of (-74, 40.7) in US feet
    let p = plan.plan_from_geographic(-74.0, 40.7).unwrap();
    let feet = p / (1200.0 / 3937.0);
    assert!((feet - DVec2::new(984_250.0, 194_305.339_281_019_43)).length() < 1e-3, "{feet}");
}

#[test]
fn the_same_crs_leaves_every_bit() {
    let plan = PlanSpace::projected(crs("EPSG:32733")).unwrap();
    let map = plan.plan_from(&crs(UTM_33S)).unwrap();
    let affine = map.affine().unwrap();
    assert_eq!((affine.origin, affine.scale), (DVec2::ZERO, DVec2::ONE));
    let p = DVec2::new(969_491.300_000_1, -0.0);
    let q = map.apply(p).unwrap();
    assert_eq!((q.x.to_bits(), q.y.to_bits()), (p.x.to_bits(), p.y.to_bits()));
}

#[test]
fn the_local_plane_keeps_grids_and_tells_its_scale_error() {
    let plan = PlanSpace::local_plane(20.5, -34.0, crs("EPSG:4326")).unwrap();
    let map = plan.plan_from(&crs("OGC:CRS84")).unwrap();
    let affine = map.affine().unwrap();
    let p = DVec2::new(20.6, -33.9);
    assert_eq!(map.apply(p).unwrap(), (p - affine.origin) * affine.scale);
    let (east, north) = plan.metres_per_degree().unwrap();
    assert!((east - 92_385.0).abs() < 20.0 && (north - 110_922.0).abs() < 20.0, "{east} {north}");
    assert_eq!(plan.scale_error_at(0.0, 0.0), (0.0, 0.0));
    let (east, north) = plan.scale_error_at(0.0, 55_000.0);
    assert!((-0.007..-0.005).contains(&east) && north.abs() < 1e-4, "{east} {north}");
    assert!(plan.describe().contains("20.5"));
}

#[test]
fn the_local_plane_crosses_the_antimeridian() {
    let plan = PlanSpace::local_plane(179.5, -17.0, crs("EPSG:4326")).unwrap();
    let west = plan.plan_from_geographic(179.9, -17.0).unwrap();
    let east = plan.plan_from_geographic(-179.9, -17.0).unwrap();
    let step = plan.metres_per_degree().unwrap().0 * 0.2;
    assert!((east.x - west.x - step).abs() < 1e-6);
}

#[test]
fn both_edges_of_the_map_stay_apart() {
    let plan = PlanSpace::local_plane(0.0, 0.0, crs("EPSG:4326")).unwrap();
    let map = plan.plan_from(&crs("EPSG:4326")).unwrap();
    let (w, e) = (map.apply(DVec2::new(-180.0, 0.0)).unwrap(), map.apply(DVec2::new(180.0, 0.0)).unwrap());
    assert_eq!(w.x, -e.x);
}

#[test]
fn planes_of_the_wrong_kind_are_refused() {
    assert!(PlanSpace::projected(crs("EPSG:4326")).is_err());
    assert!(PlanSpace::local_plane(0.0, 0.0, crs("EPSG:3857")).is_err());
    assert!(PlanSpace::local_plane(0.0, 90.0, crs("EPSG:4326")).is_err());
}

#[test]
fn plan_and_back_is_the_same_place() {
    for plan in [
        PlanSpace::projected(crs("EPSG:31287")).unwrap(),
        PlanSpace::projected(crs("EPSG:3857")).unwrap(),
        PlanSpace::local_plane(11.0, 47.0, crs("EPSG:4230")).unwrap(),
        PlanSpace::projected(crs("EPSG:3035")).unwrap(),
    ] {
        for file in ["EPSG:4326", "EPSG:32632", "EPSG:31287", "EPSG:23032"] {
            let map = plan.plan_from(&crs(file)).unwrap();
            let start = crs(file).native_from_geographic(DVec2::new(11.5, 47.3)).unwrap();
            let there = map.apply(start).unwrap();
            let back = map.invert(there).unwrap();
            assert!((back - start).length() < 1e-4, "{} {file}: {start} {back}", plan.describe());
            let place = plan.geographic_from_plan(there).unwrap();
            assert!((place - DVec2::new(11.5, 47.3)).length() < 1e-8, "{} {file}: {place}", plan.describe());
        }
    }
}

#[test]
fn a_datum_nobody_knows_is_noted() {
    let unknown = crs("+proj=longlat +ellps=bessel");
    assert!(unknown.note().is_some());
    assert_eq!(crs("EPSG:31287").note(), None);
}

proptest! {
    #[test]
    fn any_text_is_a_crs_or_an_error(text in "\\PC{0,200}") {
        let _ = Crs::parse(&text);
    }

    #[test]
    fn a_damaged_wkt_is_a_crs_or_an_error(at in 0_usize..700, with in "\\PC{0,3}", cut in 0_usize..20) {
        for wkt in [UTM_33S, MGI_LAMBERT, UTM_33S_WKT2] {
            let at = at.min(wkt.len());
            let end = (at + cut).min(wkt.len());
            let _ = Crs::parse(&format!("{}{with}{}", &wkt[..at], &wkt[end..]));
        }
    }

    #[test]
    fn any_proj_string_is_a_crs_or_an_error(
        proj in "(tmerc|utm|lcc|merc|aea|laea|stere|sterea|somerc|omerc|cass|poly|krovak|aeqd|eqc|cea|geos|tpers|labrd|ortho|gnom|moll)",
        rest in "( \\+(lat_0|lon_0|lat_1|lat_2|k|x_0|a|b|rf|zone|h|alpha|lonc|gamma|axis|pm|units|lat_ts)=(0|1|-1|45|90|-90|1e300|wsu|x|33|100000|180|nan)){0,6}",
        p in (-1e7..1e7_f64, -1e7..1e7_f64),
    ) {
        if let Ok(crs) = Crs::parse(&format!("+proj={proj}{rest}")) {
            for q in [crs.geographic_from_native(DVec2::new(p.0, p.1)), crs.native_from_geographic(DVec2::new(p.0 / 1e5, p.1 / 1e5))].into_iter().flatten() {
                prop_assert!(q.is_finite());
            }
        }
    }

    #[test]
    fn own_projections_come_back(lon in -40.0..40.0_f64, lat in -79.0..79.0_f64) {
        for text in ["+proj=tmerc +k=0.9996 +ellps=bessel", "+proj=merc +ellps=WGS84", "EPSG:3857", "+proj=lcc +lat_1=40 +lat_2=60 +lat_0=50", "+proj=lcc +lat_1=-40 +k_0=0.99"] {
            let p = DVec2::new(lon, lat);
            let back = crs(text).own_geographic(projected(text, lon, lat)).unwrap();
            prop_assert!((back - p).length() < 1e-9, "{text} {p} {back}");
        }
    }
}
