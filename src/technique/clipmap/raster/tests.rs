//! Coverage against areas that were found in other ways, and tiles against parts of larger tiles.

use super::*;
use crate::resolve::Paint;
use crate::scene::BlendMode;
use crate::technique::clipmap::rational::union_area;
use proptest::prelude::*;

const EXACT: RasterSettings = RasterSettings {
    polygons: PolygonRaster::Exact,
    lines: LinePrimitives::Coverage,
    line_filter: LineFilter::Gaussian,
    overlaps: Overlaps::Once,
    texel: TexelFormat::F32,
};

fn tile(size: usize) -> TexelRect {
    TexelRect { origin: (0, 0), size: (size, size) }
}

fn white() -> Ink {
    Ink::new(Paint([1.0; 4]), BlendMode::Over)
}

fn texels(ring: &[[f64; 2]]) -> Vec<Texel> {
    ring.iter().map(|p| Texel::new(p[0], p[1])).collect()
}

/// The alpha of a tile in which rings of a polygon were filled.
fn filled(size: usize, rings: &[Vec<[f64; 2]>], rule: Rule, settings: RasterSettings) -> Vec<f32> {
    let mut raster = TileRaster::new(tile(size), settings);
    let rings: Vec<Vec<Texel>> = rings.iter().map(|ring| texels(ring)).collect();
    let rings: Vec<&[Texel]> = rings.iter().map(Vec::as_slice).collect();
    raster.fill(&Area { rings: &rings, rule, is_simple: false }, &white());
    raster.texels().iter().map(|texel| texel[3]).collect()
}

/// The alpha of a tile in which segments were drawn as one item.
fn drawn(size: usize, segments: &[[f64; 4]], width: f64, settings: RasterSettings) -> Vec<f32> {
    let mut raster = TileRaster::new(tile(size), settings);
    let ends = segments.iter().map(|s| [Texel::new(s[0], s[1]), Texel::new(s[2], s[3])]);
    raster.segments(ends, width, None, &white());
    raster.texels().iter().map(|texel| texel[3]).collect()
}

/// The square of a texel: west, north, east, south.
fn texel(column: usize, row: usize) -> [f64; 4] {
    let (x, y) = (column as f64, row as f64);
    [x, y, x + 1.0, y + 1.0]
}

/// The rectangle of a segment.
fn rectangle([x0, y0, x1, y1]: [f64; 4], width: f64) -> Vec<[f64; 2]> {
    let (dx, dy) = (x1 - x0, y1 - y0);
    let half = 0.5 * width / (dx * dx + dy * dy).sqrt();
    let (nx, ny) = (-dy * half, dx * half);
    vec![[x0 + nx, y0 + ny], [x1 + nx, y1 + ny], [x1 - nx, y1 - ny], [x0 - nx, y0 - ny]]
}

/// The area of a polygon in a texel, by clipping it at the texel's four sides (Sutherland, Hodgman 1974).
fn clipped_area(ring: &[[f64; 2]], column: usize, row: usize) -> f64 {
    let mut ring = ring.to_vec();
    let sides = [
        (0, column as f64, 1.0),
        (0, column as f64 + 1.0, -1.0),
        (1, row as f64, 1.0),
        (1, row as f64 + 1.0, -1.0),
    ];
    for (axis, limit, sign) in sides {
        let inside = |p: &[f64; 2]| (p[axis] - limit) * sign;
        let mut kept = Vec::new();
        for k in 0..ring.len() {
            let (a, b) = (ring[k], ring[(k + 1) % ring.len()]);
            let (da, db) = (inside(&a), inside(&b));
            if da >= 0.0 {
                kept.push(a);
            }
            if (da >= 0.0) != (db >= 0.0) {
                let t = da / (da - db);
                kept.push([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]);
            }
        }
        ring = kept;
    }
    let cross = |k: usize| {
        let (a, b) = (ring[k], ring[(k + 1) % ring.len()]);
        a[0] * b[1] - a[1] * b[0]
    };
    0.5 * (0..ring.len()).map(cross).sum::<f64>().abs()
}

/// A bound of the errors that fixed-point coordinates leave in a texel.
const FIXED: f64 = 1e-4;

fn polygon() -> impl Strategy<Value = Vec<[f64; 2]>> {
    // A star around (6, 6): simple, of any other form.
    prop::collection::vec(0.5..9.0f64, 3..9).prop_map(|radii| {
        let n = radii.len();
        let at = |k: usize| std::f64::consts::TAU * (k as f64 + 0.3) / n as f64;
        (0..n)
            .map(|k| [6.0 + radii[k] * crate::math::cos(at(k)), 6.0 - radii[k] * crate::math::sin(at(k))])
            .collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn a_polygon_covers_of_each_texel_what_clipping_leaves(ring in polygon(), even_odd in any::<bool>()) {
        let rule = if even_odd { Rule::EvenOdd } else { Rule::NonZero };
        let coverage = filled(12, std::slice::from_ref(&ring), rule, EXACT);
        for (k, coverage) in coverage.iter().enumerate() {
            let area = clipped_area(&ring, k % 12, k / 12);
            prop_assert!((f64::from(*coverage) - area).abs() < FIXED, "{} {}: {coverage} {area}", k % 12, k / 12);
        }
    }

    #[test]
    fn a_line_covers_of_each_texel_its_rectangles_area(
        segment in [-4.0..16.0f64, -4.0..16.0f64, -4.0..16.0f64, -4.0..16.0f64], width in 0.01..6.0f64,
    ) {
        let coverage = drawn(12, &[segment], width, EXACT);
        let shape = rectangle(segment, width);
        for (k, coverage) in coverage.iter().enumerate() {
            let area = clipped_area(&shape, k % 12, k / 12);
            prop_assert!((f64::from(*coverage) - area).abs() < FIXED, "{} {}: {coverage} {area}", k % 12, k / 12);
        }
    }

    #[test]
    fn a_self_crossing_polygon_covers_what_its_rule_says(
        ring in prop::collection::vec([-2.0..6.0f64, -2.0..6.0f64], 3..12), even_odd in any::<bool>(),
    ) {
        let rule = if even_odd { Rule::EvenOdd } else { Rule::NonZero };
        let coverage = filled(4, std::slice::from_ref(&ring), rule, EXACT);
        let winding = |x: f64, y: f64| (0..ring.len()).map(|k| {
            let (a, b) = (ring[k], ring[(k + 1) % ring.len()]);
            let crosses = (a[1] <= y) != (b[1] <= y) && a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) <= x;
            if !crosses { 0 } else if a[1] < b[1] { 1 } else { -1 }
        }).sum::<i32>();
        const N: usize = 100;
        for (k, coverage) in coverage.iter().enumerate() {
            let at = |n: usize| (n as f64 + 0.5) / N as f64;
            let inside = (0..N * N).filter(|n| {
                rule.contains(winding((k % 4) as f64 + at(n % N), (k / 4) as f64 + at(n / N)))
            }).count() as f64 / (N * N) as f64;
            prop_assert!((f64::from(*coverage) - inside).abs() < 0.02, "{k}: {coverage} {inside}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn lines_that_cross_cover_their_union_by_rational_arithmetic(
        segments in prop::collection::vec([-2.0..5.0f64, -2.0..5.0f64, -2.0..5.0f64, -2.0..5.0f64], 2..7),
        width in 0.1..1.5f64,
    ) {
        let coverage = drawn(3, &segments, width, EXACT);
        let shapes: Vec<Vec<[f64; 2]>> = segments.iter().map(|s| rectangle(*s, width)).collect();
        for (k, coverage) in coverage.iter().enumerate() {
            let area = union_area(&shapes, texel(k % 3, k / 3));
            prop_assert!((f64::from(*coverage) - area).abs() < FIXED, "{k}: {coverage} {area}");
        }
    }
}

/// Numbers that look random.
fn random(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    }
}

#[test]
fn a_crowd_of_forty_lines_covers_its_union() {
    let mut random = random(7);
    let segments: Vec<[f64; 4]> = (0..40).map(|_| [(); 4].map(|()| 6.0 * random() - 1.0)).collect();
    let coverage = drawn(4, &segments, 1.0, EXACT);
    let shapes: Vec<Vec<[f64; 2]>> = segments.iter().map(|s| rectangle(*s, 1.0)).collect();
    let inside = |x: f64, y: f64| {
        shapes.iter().any(|ring| {
            let side = |k: usize| {
                let (a, b) = (ring[k], ring[(k + 1) % 4]);
                (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])
            };
            (0..4).all(|k| side(k) >= 0.0) || (0..4).all(|k| side(k) <= 0.0)
        })
    };
    const N: usize = 256;
    for (k, coverage) in coverage.iter().enumerate() {
        let at = |n: usize| (n as f64 + 0.5) / N as f64;
        let hits =
            (0..N * N).filter(|n| inside((k % 4) as f64 + at(n % N), (k / 4) as f64 + at(n / N))).count();
        let area = hits as f64 / (N * N) as f64;
        assert!((f64::from(*coverage) - area).abs() < 0.005, "{k}: {coverage} {area}");
    }
}

#[test]
fn overlaps_are_blended_as_often_as_they_overlap_or_once() {
    let settings = |overlaps| RasterSettings { overlaps, ..EXACT };
    let alpha = |settings: RasterSettings| {
        let mut raster = TileRaster::new(tile(4), settings);
        let across = [[0.0, 1.0], [4.0, 1.0], [0.0, 3.0], [4.0, 3.0]];
        let along = [[3.0, 0.0], [3.0, 4.0], [1.0, 0.0], [1.0, 4.0]];
        let strips = [across, along].map(|[l0, l1, r0, r1]| {
            let t = |p: [f64; 2]| Texel::new(p[0], p[1]);
            [Pair { left: t(l0), right: t(r0) }, Pair { left: t(l1), right: t(r1) }]
        });
        let half = Ink::new(Paint([0.5, 0.0, 0.0, 0.5]), BlendMode::Over);
        raster.strips(strips.iter().map(|s| &s[..]), Folded::Triangles, None, &half);
        raster.texels().iter().map(|t| t[3]).collect::<Vec<f32>>()
    };
    for polygons in [PolygonRaster::Exact, PolygonRaster::Aliased] {
        let once = alpha(RasterSettings { polygons, ..settings(Overlaps::Once) });
        let each = alpha(RasterSettings { polygons, ..settings(Overlaps::Blend) });
        assert_eq!((once[0], once[1], once[5]), (0.0, 0.5, 0.5), "{polygons:?}");
        assert_eq!((each[0], each[1], each[5]), (0.0, 0.5, 0.75), "{polygons:?}");
    }
}

/// Items of all kinds in a level whose tile starts at `origin`; each is drawn into `raster`.
fn draw_scene(raster: &mut TileRaster, base: f64) {
    let mut random = random(99);
    let mut point =
        |spread: f64| Texel::new(base + spread * random() - 20.0, 300.0 + spread * random() - 20.0);
    for k in 0..60 {
        let color = [0.2 + 0.01 * f64::from(k), 0.5, 0.9 - 0.01 * f64::from(k), 0.7].map(|v| v * 0.7);
        let ink = Ink::new(Paint(color), BlendMode::Over);
        let ring: Vec<Texel> = (0..7).map(|_| point(170.0)).collect();
        let area = Area { rings: &[&ring], rule: Rule::EvenOdd, is_simple: false };
        let width = 0.3 + 0.2 * f64::from(k % 30);
        match k % 4 {
            0 => raster.fill(&area, &ink),
            1 => raster.segments(ring.windows(2).map(|p| [p[0], p[1]]), width, None, &ink),
            2 => {
                let cut = Cut { area, keeps_inside: k % 8 == 2 };
                let pairs: Vec<Pair<Texel>> = ring
                    .windows(2)
                    .flat_map(|p| {
                        let aside = (p[1] - p[0]).normalize().perp() * -width;
                        [p[0], p[1]].map(|v| Pair { left: v + aside, right: v + -aside })
                    })
                    .collect();
                raster.strips([&pairs[..]].into_iter(), Folded::Triangles, Some(&cut), &ink);
            }
            _ => {
                let pairs = [(ring[0], ring[1]), (ring[2], ring[3]), (ring[4], ring[5])]
                    .map(|(left, right)| Pair { left, right });
                raster.strips([&pairs[..]].into_iter(), Folded::Polygon, None, &ink);
            }
        }
        assert!(raster.is_idle(), "item {k} left something");
    }
}

#[test]
fn a_tile_has_the_bits_of_the_same_part_of_a_larger_tile() {
    let ways = [
        EXACT,
        RasterSettings { overlaps: Overlaps::Blend, ..EXACT },
        RasterSettings { polygons: PolygonRaster::Aliased, lines: LinePrimitives::Plain, ..EXACT },
        RasterSettings { lines: LinePrimitives::Prefiltered, texel: TexelFormat::Unorm8, ..EXACT },
    ];
    for settings in ways {
        let base = 70_000.0;
        let whole = TexelRect { origin: (70_000, 300), size: (128, 128) };
        let mut large = TileRaster::new(whole, settings);
        draw_scene(&mut large, base);
        let painted = large.texels().iter().filter(|t| t[3] > 0.0).count();
        assert!(painted > 10_000, "{painted}");
        for (column, row, width, height) in
            [(0, 0, 64, 64), (64, 32, 64, 96), (37, 51, 13, 70), (127, 0, 1, 128)]
        {
            let place =
                TexelRect { origin: (70_000 + column as i64, 300 + row as i64), size: (width, height) };
            let mut small = TileRaster::new(place, settings);
            draw_scene(&mut small, base);
            for y in 0..height {
                let differs = (0..width).find(|x| small.row(y)[*x] != large.row(row + y)[column + x]);
                let both = differs.map(|x| (x, small.row(y)[x], large.row(row + y)[column + x]));
                assert_eq!(both, None, "{settings:?} {column} {row} {y}");
            }
        }
    }
}

#[test]
fn items_of_many_edges_have_the_bits_of_the_same_items_of_few() {
    // In the whole tile edges are sorted by rows and columns, in its small parts each texel collects its own.
    let mut random = random(5);
    for run in 0..6 {
        // Half of them on corners and sides of texels, where there are ties.
        let place = |v: f64| 64.0 * if run % 2 == 0 { (v * 128.0).floor() / 128.0 } else { v };
        let ring: Vec<Texel> = (0..150).map(|_| Texel::new(place(random()), place(random()))).collect();
        let drawn = |place: TexelRect| {
            let settings =
                RasterSettings { overlaps: if run < 3 { Overlaps::Once } else { Overlaps::Blend }, ..EXACT };
            let ink = Ink::new(Paint([0.1, 0.2, 0.3, 0.4]), BlendMode::Over);
            let mut raster = TileRaster::new(place, settings);
            // Short pieces and one long ring.
            for part in ring.chunks(5) {
                raster.fill(&Area { rings: &[part], rule: Rule::EvenOdd, is_simple: false }, &ink);
            }
            raster.fill(&Area { rings: &[&ring], rule: Rule::NonZero, is_simple: false }, &ink);
            let pairs: Vec<Pair<Texel>> = ring
                .windows(2)
                .step_by(2)
                .map(|w| Pair { left: w[0], right: w[0] + (w[1] - w[0]) * 0.1 })
                .collect();
            raster.strips([&pairs[..]].into_iter(), Folded::Triangles, None, &ink);
            raster
        };
        let whole = drawn(tile(64));
        for (column, row) in
            (0..64).step_by(4).flat_map(|row| (0..64).step_by(16).map(move |column| (column, row)))
        {
            let part = drawn(TexelRect { origin: (column as i64, row as i64), size: (16, 4) });
            let is_same = |y: usize| part.row(y) == &whole.row(row + y)[column..column + 16];
            assert!((0..4).all(is_same), "run {run}, {column} {row}");
        }
    }
}

#[test]
fn an_outline_is_cut_to_the_exact_area_that_it_shares_with_its_polygon() {
    // A thin stroke along a slanted border: every texel on it is partly stroke and partly polygon.
    let (a, b) = (Texel::new(-10.0, 1.3), Texel::new(20.0, 7.9));
    let ring = [a, Texel::new(-10.0, 40.0), Texel::new(20.0, 40.0), b];
    let area = Area { rings: &[&ring], rule: Rule::EvenOdd, is_simple: false };
    let along = (b - a).normalize();
    for keeps_inside in [true, false] {
        let mut raster = TileRaster::new(tile(8), EXACT);
        let aside = along.perp() * -0.2;
        let pairs = [a, b].map(|v| Pair { left: v + aside, right: v + -aside });
        let cut = Cut { area, keeps_inside };
        raster.strips([&pairs[..]].into_iter(), Folded::Triangles, Some(&cut), &white());
        let half = along.perp() * if keeps_inside { 0.2 } else { -0.2 };
        let expected = [a, b, b + half, a + half].map(|p| [p.x, p.y]);
        for (k, texel) in raster.texels().iter().enumerate() {
            let area = clipped_area(&expected, k % 8, k / 8);
            assert!((f64::from(texel[3]) - area).abs() < FIXED, "{k}: {} {area}", texel[3]);
        }
    }
}

#[test]
fn tiny_skia_covers_a_square_as_the_exact_way_does() {
    let square = vec![vec![[1.0, 1.0], [1.0, 3.0], [3.0, 3.0], [3.0, 1.0]]];
    let smooth = RasterSettings { polygons: PolygonRaster::TinySkia, ..EXACT };
    assert_eq!(filled(4, &square, Rule::EvenOdd, smooth), filled(4, &square, Rule::EvenOdd, EXACT));
}

#[test]
fn plain_lines_are_as_wide_along_the_minor_axis_as_they_are_told() {
    let plain = RasterSettings { lines: LinePrimitives::Plain, ..EXACT };
    let picture = |segment: [f64; 4], width: f64| {
        let coverage = drawn(6, &[segment], width, plain);
        coverage
            .chunks(6)
            .map(|row| row.iter().map(|v| if *v > 0.0 { '#' } else { '.' }).collect::<String>())
            .collect::<Vec<_>>()
    };
    assert_eq!(
        picture([0.5, 2.5, 4.5, 2.5], 1.0),
        ["......", "......", "####..", "......", "......", "......"]
    );
    assert_eq!(
        picture([4.5, 2.5, 0.5, 2.5], 3.0),
        ["......", ".####.", ".####.", ".####.", "......", "......"]
    );
    assert_eq!(
        picture([0.0, 0.0, 6.0, 6.0], 1.0),
        ["#.....", ".#....", "..#...", "...#..", "....#.", ".....#"]
    );
    assert_eq!(picture([2.5, 0.0, 2.5, 6.0], 2.0)[3], "..##..");
}

#[test]
fn what_lies_far_outside_leaves_no_trace_and_makes_no_panic() {
    let far = [1e9, 1e15, 1e30, 1e300];
    for d in far {
        let ring = vec![[-d, 3.0], [d, d], [d, 3.0]];
        for polygons in [PolygonRaster::Exact, PolygonRaster::Aliased, PolygonRaster::TinySkia] {
            let settings = RasterSettings { polygons, ..EXACT };
            let coverage = filled(4, std::slice::from_ref(&ring), Rule::NonZero, settings);
            assert!(coverage.iter().all(|v| v.is_finite()), "{d} {polygons:?}");
            assert_eq!(coverage[0], 0.0, "{d} {polygons:?}");
        }
        for lines in [LinePrimitives::Plain, LinePrimitives::Coverage, LinePrimitives::Prefiltered] {
            let coverage = drawn(4, &[[-d, 1.5, d, 1.5]], 1.0, RasterSettings { lines, ..EXACT });
            assert!(coverage.iter().all(|v| v.is_finite()), "{d} {lines:?}");
        }
    }
}
