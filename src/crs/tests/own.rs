//! Our own projections against PROJ, far from their centres too, and their round trips.

use super::*;

/// A PROJ string and points of it: longitude, latitude, x, y.
type Points = (&'static str, &'static [(f64, f64, f64, f64)]);

#[track_caller]
fn agree(tables: &[Points]) {
    for &(text, points) in tables {
        let crs = crs(text);
        assert!(!crs.is_imported(), "{text}");
        for &(lon, lat, x, y) in points {
            let (place, expected) = (DVec2::new(lon, lat), DVec2::new(x, y));
            let p = crs.project(place).unwrap();
            let off = (p - expected).length();
            assert!(off < 1e-5, "{text} of {place} is {p}, {off} m off");
            let back = crs.own_geographic(expected).unwrap();
            let off = DVec2::new(wrapped(back.x - lon), back.y - lat);
            let at_pole = if lat.abs() == 90.0 { DVec2::Y } else { DVec2::ONE };
            assert!((off * at_pole).length() < 1e-9, "{text} of {expected} is {back}, {off} degrees off");
        }
    }
}

// References: PROJ 9.5.1. (Its own inverse of the equal-area plane is 1.5 mm off: the points are taken back here.)

#[test]
fn lamberts_equal_area_plane_agrees_with_proj() {
    agree(&[
        (
            "+proj=laea +lat_0=52 +lon_0=10 +x_0=4321000 +y_0=3210000 +ellps=GRS80",
            &[
                (10.0, 52.0, 4_321_000.0, 3_210_000.0),
                (10.5, 47.2, 4_358_915.335_064_2, 2_676_397.674_318_2),
                (-9.3, 38.7, 2_651_395.834_492_3, 1_947_878.732_712_1),
                (32.0, 70.1, 5_150_531.771_753_2, 5_352_756.894_721_9),
                (-60.0, -20.0, -3_934_457.887_584_8, -1_115_335.741_856_3),
                (150.0, 10.0, 11_291_811.437_147_7, 10_913_969.422_76),
            ],
        ),
        (
            "+proj=laea +lat_0=90 +lon_0=0 +ellps=WGS84",
            &[
                (0.0, 90.0, 0.0, 0.0),
                (30.0, 70.0, 1_110_835.443_748_1, -1_924_023.427_42),
                (-120.0, 10.0, -7_096_332.897_386_8, 4_097_069.708_565_5),
                (45.0, -60.0, 8_700_690.332_868_5, -8_700_690.332_868_5),
            ],
        ),
        (
            "+proj=laea +lat_0=-90 +lon_0=0 +ellps=WGS84",
            &[
                (-70.0, -65.0, -2_601_593.590_128_6, 946_902.628_464_5),
                (135.0, -89.9, 7_897.955_952_6, -7_897.955_952_6),
                (10.0, 40.0, 2_004_289.690_096_9, 11_366_891.680_693_8),
            ],
        ),
        (
            "+proj=laea +lat_0=45 +lon_0=-100 +R=6370997",
            &[
                (-120.0, 30.0, -1_921_494.455_702_3, -1_439_433.320_852_6),
                (-60.0, 5.0, 4_559_377.802_658_2, -3_403_365.874_646_1),
                (80.0, 10.0, 0.0, 11_302_286.714_291_9),
            ],
        ),
        (
            "+proj=laea +lat_0=0 +lon_0=20 +ellps=clrk66",
            &[
                (30.0, -10.0, 1_099_166.805_652_2, -1_108_568.671_449_1),
                (120.0, 60.0, 4_664_456.018_149_8, 8_148_198.259_176_6),
            ],
        ),
    ]);
}

#[test]
fn albers_cone_agrees_with_proj() {
    agree(&[
        (
            "+proj=aea +lat_0=23 +lon_0=-96 +lat_1=29.5 +lat_2=45.5 +ellps=GRS80",
            &[
                (-96.0, 23.0, 0.0, 0.0),
                (-118.2, 34.3, -2_009_377.663_319_8, 1_484_281.238_596_2),
                (-67.0, 45.0, 2_248_275.924_593_5, 2_791_445.734_751_5),
                (-150.0, -30.0, -7_947_161.669_012_1, -2_518_384.538_277_3),
                (60.0, 89.0, 4_035_669.267_396_2, 10_214_878.186_369_6),
            ],
        ),
        (
            "+proj=aea +lat_0=0 +lon_0=132 +lat_1=-18 +lat_2=-36 +ellps=GRS80",
            &[
                (151.2, -33.9, 1_759_614.416_025_3, -3_832_061.664_777),
                (115.0, -20.0, -1_765_634.360_179_8, -2_261_745.615_002),
                (-60.0, 50.0, 18_789_106.205_885_7, -10_538_514.078_802),
            ],
        ),
        (
            "+proj=aea +lat_0=45 +lon_0=-126 +lat_1=50 +lat_2=58.5 +x_0=1000000 +ellps=GRS80",
            &[
                (-123.1, 49.3, 1_211_046.648_235_9, 480_285.140_426_8),
                (-139.0, 60.0, 276_746.124_897_5, 1_735_132.046_952_5),
            ],
        ),
        (
            "+proj=aea +lat_0=10 +lon_0=25 +lat_1=20 +lat_2=-23 +ellps=WGS84",
            &[
                (-17.0, 14.7, -4_384_285.878_875_4, 502_952.294_423_5),
                (50.0, -33.0, 2_551_692.051_761_6, -4_931_367.816_065_5),
            ],
        ),
        (
            "+proj=aea +lat_0=40 +lon_0=0 +lat_1=40 +R=6371000",
            &[
                (20.0, 50.0, 1_581_112.328_163_9, 1_151_033.441_066_8),
                (-90.0, -40.0, -11_397_729.503_485_1, -5_439_974.837_554),
            ],
        ),
    ]);
}

#[test]
fn the_stereographic_planes_of_the_poles_agree_with_proj() {
    agree(&[
        (
            "+proj=stere +lat_0=90 +lat_ts=70 +lon_0=-45 +ellps=WGS84",
            &[
                (-45.0, 90.0, 0.0, 0.0),
                (-50.0, 70.5, -185_832.390_979_7, -2_124_073.948_444_8),
                (100.0, 60.0, 1_906_086.425_457_6, 2_722_173.529_195_5),
                (10.0, -40.0, 21_567_421.844_481_1, -15_101_671.355_254_4),
            ],
        ),
        (
            "+proj=stere +lat_0=-90 +lat_ts=-71 +lon_0=0 +ellps=WGS84",
            &[
                (166.7, -77.8, 306_055.514_377_1, -1_294_705.936_765_4),
                (-60.0, -63.0, -2_586_769.310_366_9, 1_493_471.957_671_8),
                (-120.0, -10.0, -8_997_613.287_128_4, -5_194_774.453_387_7),
            ],
        ),
        (
            "+proj=stere +lat_0=90 +lon_0=0 +k=0.994 +x_0=2000000 +y_0=2000000 +ellps=WGS84",
            &[
                (15.0, 84.0, 2_172_561.827_610_9, 1_355_990.491_909_2),
                (-170.0, 61.0, 1_429_138.997_309, 5_237_513.626_090_2),
            ],
        ),
        (
            "+proj=stere +lat_0=-90 +lat_ts=-60 +lon_0=70 +R=6371000",
            &[(75.0, -68.0, 201_406.477_422_5, 2_302_086.571_054_6)],
        ),
        (
            "+proj=stere +lat_0=90 +lat_ts=90 +lon_0=10 +ellps=intl",
            &[(15.0, 84.0, 58_463.031_612, -668_235.509_102_7)],
        ),
    ]);
}

#[test]
fn the_double_stereographic_plane_agrees_with_proj() {
    agree(&[
        (
            "+proj=sterea +lat_0=52.1561605555556 +lon_0=5.38763888888889 +k=0.9999079 +x_0=155000 +y_0=463000 +ellps=bessel",
            &[
                (5.387_638_888_888_89, 52.156_160_555_555_6, 155_000.0, 463_000.0),
                (4.9, 52.37, 121_793.919_397_4, 486_901.274_179_6),
                (7.1, 53.3, 269_143.935_938_8, 591_623.107_221_6),
                (30.0, 40.0, 2_260_787.453_584_6, -560_200.865_107_9),
                (-80.0, -20.0, -15_199_520.812_207_2, -3_889_197.617_539),
            ],
        ),
        (
            "+proj=sterea +lat_0=46 +lon_0=25 +k=0.99975 +x_0=500000 +y_0=500000 +ellps=krass",
            &[
                (26.1, 44.4, 587_627.125_956_3, 322_809.729_116_6),
                (20.3, 47.9, 148_687.789_582_8, 721_729.840_334_4),
                (60.0, 10.0, 4_773_115.429_767_2, -2_959_203.544_313_8),
            ],
        ),
        (
            "+proj=sterea +lat_0=-46.5 +lon_0=-66.5 +k=0.999912 +x_0=2500000 +y_0=7500000 +ellps=GRS80",
            &[
                (-64.0, -45.1, 2_696_768.984_301_7, 7_652_522.096_018_8),
                (-100.0, -75.0, 1_511_855.127_185_4, 3_990_211.945_937_6),
            ],
        ),
        (
            "+proj=sterea +lat_0=34.2 +lon_0=39.15 +k=0.9995341 +ellps=clrk80",
            &[(36.3, 33.5, -264_728.701_113_2, -73_937.073_286_1)],
        ),
    ]);
}

#[test]
fn the_swiss_cylinder_agrees_with_proj() {
    agree(&[
        (
            "+proj=somerc +lat_0=46.9524055555556 +lon_0=7.43958333333333 +k_0=1 +x_0=2600000 +y_0=1200000 +ellps=bessel",
            &[
                (7.439_583_333_333_33, 46.952_405_555_555_6, 2_600_000.0, 1_200_000.0),
                (7.5, 46.9, 2_604_603.059_048_8, 1_194_176.530_537_3),
                (10.4, 46.6, 2_826_754.868_475_1, 1_165_109.608_241_6),
                (6.1, 46.2, 2_496_614.707_233_3, 1_117_250.907_192_2),
                (40.0, 60.0, 4_418_208.615_966_7, 3_057_359.767_262_1),
                (-70.0, -10.0, -7_274_881.296_497_1, -577_953.781_493_5),
            ],
        ),
        (
            "+proj=somerc +lat_0=47.1443937222222 +lon_0=19.0485717777778 +k_0=0.99993 +x_0=650000 +y_0=200000 +ellps=GRS67",
            &[
                (19.05, 47.5, 650_107.602_285_3, 239_532.910_515_2),
                (16.2, 46.3, 430_575.868_027_5, 110_134.503_506_6),
                (22.8, 48.5, 927_190.655_161_8, 357_383.997_516_4),
            ],
        ),
    ]);
}

#[test]
fn krovaks_cone_agrees_with_proj() {
    agree(&[(
        "+proj=krovak +lat_0=49.5 +lon_0=24.8333333333333 +alpha=30.2881397527778 +k=0.9999 +ellps=bessel",
        &[
            (14.42, 50.09, -742_949.430_991_4, -1_042_796.966_162_6),
            (17.1, 48.15, -574_341.827_532_4, -1_280_152.023_098_4),
            (22.2, 49.0, -192_620.520_190_8, -1_211_349.788_341_2),
            (12.1, 50.3, -903_108.437_314_9, -994_592.804_573_8),
            (5.0, 40.0, -1_694_389.397_917_5, -2_000_484.275_208_7),
        ],
    )]);
}

#[test]
fn axes_count_where_the_survey_counts() {
    // reference: PROJ 9.5.1
    for (text, x, y) in [
        (
            "+proj=tmerc +axis=wsu +x_0=100 +y_0=7 +to_meter=2 +ellps=GRS80",
            -501_010.735_475_218_2,
            -2_817_743.472_084_861,
        ),
        ("+proj=krovak +axis=swu +ellps=bessel", 1_048_524.829_861_361_3, 774_126.553_171_736_1),
        ("+proj=krovak +ellps=bessel", -774_126.553_171_736_1, -1_048_524.829_861_361_3),
    ] {
        let p = projected(text, 14.0, 50.0);
        assert!((p - DVec2::new(x, y)).length() < 1e-6, "{text}: {p}");
        let back = crs(text).own_geographic(p).unwrap();
        assert!((back - DVec2::new(14.0, 50.0)).length() < 1e-11, "{text}: {back}");
    }
}

#[test]
fn a_parallel_of_true_scale_tells_the_scale_of_a_pole_alone() {
    // reference: PROJ 9.5.1
    for text in ["+proj=stere +lat_0=90 +lat_ts=70 +k=0.9", "+proj=stere +lat_0=90 +lat_ts=-70"] {
        let p = projected(text, 14.0, 50.0);
        assert!(
            (p - DVec2::new(1_091_309.406_182_188_5, -4_377_002.958_903_846)).length() < 1e-6,
            "{text}: {p}"
        );
    }
    let p = projected("+proj=stere +lat_0=90 +lat_ts=90 +k=0.9", 14.0, 50.0);
    assert!((p - DVec2::new(1_012_703.171_825_018_8, -4_061_730.572_887_06)).length() < 1e-6, "{p}");
}

const WIDE: [&str; 7] = [
    "+proj=laea +lat_0=52 +lon_0=10 +ellps=GRS80",
    "+proj=laea +lat_0=-90 +ellps=WGS84",
    "+proj=aea +lat_0=23 +lon_0=-96 +lat_1=29.5 +lat_2=45.5 +ellps=GRS80",
    "+proj=aea +lat_1=-18 +lat_2=-36 +lon_0=132 +ellps=GRS80",
    "+proj=stere +lat_0=90 +lat_ts=70 +lon_0=-45 +ellps=WGS84",
    "+proj=stere +lat_0=-90 +k=0.994 +ellps=intl",
    "+proj=sterea +lat_0=52 +lon_0=5 +k=0.9999 +ellps=bessel",
];

proptest! {
    #[test]
    fn wide_projections_come_back(lon in -180.0..180.0_f64, lat in -80.0..80.0_f64) {
        for text in WIDE {
            let p = DVec2::new(lon, lat);
            let Ok(q) = crs(text).project(p) else { continue };
            // Near the far side of the sphere a metre is next to no angle.
            if q.length() > 1e8 || (text.contains("laea") && q.length() > 12.5e6) {
                continue;
            }
            let back = crs(text).own_geographic(q).unwrap();
            let off = DVec2::new(wrapped(back.x - lon), back.y - lat);
            prop_assert!(off.length() < 1e-9, "{text} {p} {back}");
        }
    }

    #[test]
    fn oblique_cylinders_and_cones_come_back(lon in -40.0..60.0_f64, lat in -20.0..80.0_f64) {
        for text in ["+proj=somerc +lat_0=46.95 +lon_0=7.44 +ellps=bessel", "+proj=krovak +ellps=bessel"] {
            // Krovak's cone is cut along the meridian of its axis.
            let p = DVec2::new(lon, if text.contains("krovak") { math::min(lat, 55.0) } else { lat });
            let back = crs(text).own_geographic(projected(text, p.x, p.y)).unwrap();
            prop_assert!((back - p).length() < 1e-9, "{text} {p} {back}");
        }
    }
}
