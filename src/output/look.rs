//! Planes as pictures to look at: false colours, chosen by what is said of a buffer.

use super::npy::Npy;
use crate::buffer::{Buffer, Look, Plane, Values};
use crate::math;

/// Where nothing is seen.
const NOTHING: [u8; 4] = [207, 226, 243, 255];
/// A class that has no colour: none should exist.
const STRANGE: [u8; 4] = [255, 0, 255, 255];
/// N, P and F pixels (She 2016).
const CLASSES: [[u8; 4]; 3] = [[176, 176, 176, 255], [214, 39, 40, 255], [31, 119, 180, 255]];
/// From few to many: dark to light and perceptually even (the viridis map, every eighth).
const RAMP: [[u8; 3]; 9] = [
    [68, 1, 84],
    [71, 44, 122],
    [59, 81, 139],
    [44, 113, 142],
    [33, 144, 141],
    [39, 173, 129],
    [92, 200, 99],
    [170, 220, 50],
    [253, 231, 37],
];

/// The levels of a texture: red, orange, yellow, green, blue, violet.
const LEVELS: [[u8; 3]; 6] =
    [[228, 66, 60], [245, 148, 49], [244, 220, 75], [92, 180, 86], [66, 135, 205], [150, 95, 190]];

/// The picture of a plane; `None` where there is nothing to look at, or its numbers are not what such a look is of.
///
/// Where nothing is seen it is light blue.
pub fn look(plane: Npy<'_>, look: Look) -> Option<Buffer<[u8; 4]>> {
    let plane = plane.plane();
    if plane.width * plane.height == 0 {
        return None;
    }
    let pixels = match (look, plane.components) {
        (Look::Class, 1) => integers(plane)?.map(class).collect(),
        (Look::Number, 1) => integers(plane)?.map(number).collect(),
        (Look::Count, 1) => counts(&integers(plane)?.collect::<Vec<_>>()),
        (Look::Level, 1) => reals(plane)?.map(level).collect(),
        (Look::Grey, 1) => grey(&reals(plane)?.collect::<Vec<_>>()),
        (Look::CodeValues, 4) => code_values(plane)?,
        (Look::Color, 4) => colors(&reals(plane)?.collect::<Vec<_>>()),
        (Look::Place, 2 | 8) => places(&reals(plane)?.collect::<Vec<_>>(), plane.components),
        _ => return None,
    };
    Some(Buffer::from_values(plane.width, plane.height, pixels))
}

fn integers(plane: &Plane) -> Option<Box<dyn Iterator<Item = u32> + '_>> {
    match &plane.values {
        Values::U32(values) => Some(Box::new(values.iter().copied())),
        Values::U16(values) => Some(Box::new(values.iter().map(|v| u32::from(*v)))),
        Values::U8(values) => Some(Box::new(values.iter().map(|v| u32::from(*v)))),
        Values::F64(_) | Values::F32(_) => None,
    }
}

fn reals(plane: &Plane) -> Option<Box<dyn Iterator<Item = f64> + '_>> {
    match &plane.values {
        Values::F64(values) => Some(Box::new(values.iter().copied())),
        Values::F32(values) => Some(Box::new(values.iter().map(|v| f64::from(*v)))),
        Values::U32(_) | Values::U16(_) | Values::U8(_) => None,
    }
}

/// Pixels that hold code values.
fn code_values(plane: &Plane) -> Option<Vec<[u8; 4]>> {
    let Values::U8(values) = &plane.values else { return None };
    Some(values.as_chunks::<4>().0.to_vec())
}

/// The colour of a level of a texture: six hues after one another, darker each time round.
fn level(value: f64) -> [u8; 4] {
    if !value.is_finite() {
        return NOTHING;
    }
    let of = |whole: usize| {
        let dim = 1.0 / (1.0 + 0.45 * (whole / LEVELS.len()) as f64);
        LEVELS[whole % LEVELS.len()].map(|v| f64::from(v) * dim)
    };
    let whole = value as usize;
    let (near, far, t) = (of(whole), of(whole + 1), value - whole as f64);
    let mix = |k: usize| code(near[k] * (1.0 - t) + far[k] * t);
    [mix(0), mix(1), mix(2), 255]
}

fn class(value: u32) -> [u8; 4] {
    CLASSES.get(value as usize).copied().unwrap_or(STRANGE)
}

/// A colour that neighbouring numbers do not share, neither black nor white.
fn number(value: u32) -> [u8; 4] {
    if value == u32::MAX {
        return NOTHING;
    }
    // The finalizer of MurmurHash3 (Appleby).
    let mut h = value.wrapping_add(0x9e37_79b9);
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    let [r, g, b, _] = (h ^ (h >> 16)).to_le_bytes().map(|v| 48 + v / 4 * 3);
    [r, g, b, 255]
}

fn counts(values: &[u32]) -> Vec<[u8; 4]> {
    let seen = || values.iter().filter(|v| **v != u32::MAX);
    let size = |count: u32| math::ln(1.0 + f64::from(count));
    let most = size(seen().max().copied().unwrap_or(0).max(1));
    let color = |v: &u32| match *v {
        u32::MAX => NOTHING,
        v => ramp(size(v) / most),
    };
    values.iter().map(color).collect()
}

/// The ramp at a share 0..=1.
fn ramp(share: f64) -> [u8; 4] {
    let along = share * (RAMP.len() - 1) as f64;
    let at = (along as usize).min(RAMP.len() - 2);
    let t = along - at as f64;
    let (a, b) = (RAMP[at], RAMP[at + 1]);
    let mix = |k: usize| code(f64::from(a[k]) * (1.0 - t) + f64::from(b[k]) * t);
    [mix(0), mix(1), mix(2), 255]
}

/// Grey from the least (dark) to the greatest, by the logarithm where all are positive.
fn grey(values: &[f64]) -> Vec<[u8; 4]> {
    let (least, greatest) = range(values.iter().copied());
    let scale = |v: f64| if least > 0.0 { math::ln(v) } else { v };
    let (low, high) = (scale(least), scale(greatest));
    let span = if high > low { high - low } else { 1.0 };
    let color = |v: &f64| {
        if !v.is_finite() {
            return NOTHING;
        }
        let g = code(24.0 + 211.0 * ((scale(*v) - low) / span));
        [g, g, g, 255]
    };
    values.iter().map(color).collect()
}

fn colors(values: &[f64]) -> Vec<[u8; 4]> {
    let (pixels, _) = values.as_chunks::<4>();
    pixels.iter().map(|pixel| pixel.map(|v| code(v * 255.0))).collect()
}

/// Plan points: x in red and y in green, both repeated so that about six periods fill the picture. Of several points
/// the middle counts.
fn places(values: &[f64], components: usize) -> Vec<[u8; 4]> {
    let (x, y) = (values.iter().step_by(2), values.iter().skip(1).step_by(2));
    let extent = |(low, high): (f64, f64)| high - low;
    let period = round_number(math::max(extent(range(x.copied())), extent(range(y.copied()))) / 6.0);
    let color = |pixel: &[f64]| match middle(pixel) {
        Some((x, y)) => [within(x, period), within(y, period), 112, 255],
        None => NOTHING,
    };
    values.chunks_exact(components).map(color).collect()
}

/// The mean of the points that are finite.
fn middle(points: &[f64]) -> Option<(f64, f64)> {
    let (pairs, _) = points.as_chunks::<2>();
    let seen = || pairs.iter().filter(|[x, y]| x.is_finite() && y.is_finite());
    let n = seen().count() as f64;
    let sum = seen().fold((0.0, 0.0), |(sx, sy), [x, y]| (sx + x, sy + y));
    (n > 0.0).then_some((sum.0 / n, sum.1 / n))
}

/// A code value that grows with the place in its period.
fn within(at: f64, period: f64) -> u8 {
    let turns = at / period;
    code(32.0 + 208.0 * (turns - turns.floor()))
}

/// The smallest of 1, 2, 5, 10, 20, ... and 0.5, 0.2, ... that is not below `x`.
fn round_number(x: f64) -> f64 {
    let mut step = 1e-9;
    while step * 10.0 < x && step < 1e300 {
        step *= 10.0;
    }
    let candidates = [step, 2.0 * step, 5.0 * step];
    candidates.into_iter().find(|c| *c >= x).unwrap_or(10.0 * step)
}

/// The least and the greatest finite value; (0, 0) where there is none.
fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let wider = |range: Option<(f64, f64)>, v: f64| match range {
        Some((low, high)) => Some((math::min(low, v), math::max(high, v))),
        None => Some((v, v)),
    };
    values.filter(|v| v.is_finite()).fold(None, wider).unwrap_or((0.0, 0.0))
}

/// The nearest code value.
fn code(v: f64) -> u8 {
    // A cast keeps within 0..=255.
    (v + 0.5).floor() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    fn looked(seen: Look, components: usize, values: Values) -> Option<Vec<[u8; 4]>> {
        let length = match &values {
            Values::F64(v) => v.len(),
            Values::F32(v) => v.len(),
            Values::U32(v) => v.len(),
            Values::U16(v) => v.len(),
            Values::U8(v) => v.len(),
        };
        let plane = Plane { name: "any", width: length / components, height: 1, components, values };
        look(Npy::new(&plane).unwrap(), seen).map(|picture| picture.values().to_vec())
    }

    #[test]
    fn depth_is_dark_near_and_light_far_with_equal_steps_for_equal_ratios() {
        let seen = looked(Look::Grey, 1, Values::F64(vec![1.0, 10.0, 100.0, f64::INFINITY])).unwrap();
        let grey = |v: u8| [v, v, v, 255];
        assert_eq!(seen, [grey(24), grey(130), grey(235), NOTHING]);
    }

    #[test]
    fn classes_have_the_colours_of_the_paper() {
        let seen = looked(Look::Class, 1, Values::U8(vec![0, 1, 2, 3])).unwrap();
        assert_eq!(seen, [CLASSES[0], CLASSES[1], CLASSES[2], STRANGE]);
    }

    #[test]
    fn neighbouring_triangles_differ_and_the_sky_is_no_triangle() {
        let seen = looked(Look::Number, 1, Values::U32(vec![0, 1, 2, u32::MAX])).unwrap();
        assert!(seen[0] != seen[1] && seen[1] != seen[2] && seen[3] == NOTHING);
        assert!(seen.iter().all(|p| p[..3].iter().all(|v| *v >= 48)));
    }

    #[test]
    fn counts_run_from_dark_to_light() {
        let seen = looked(Look::Count, 1, Values::U16(vec![0, 3, 15])).unwrap();
        assert_eq!(seen, [[68, 1, 84, 255], [33, 144, 141, 255], [253, 231, 37, 255]]);
        let none = looked(Look::Count, 1, Values::U16(vec![0, 0])).unwrap();
        assert_eq!(none, [[68, 1, 84, 255]; 2]);
    }

    #[test]
    fn plan_coordinates_repeat() {
        let seen = looked(
            Look::Place,
            2,
            Values::F64(vec![0.0, 0.0, 50.0, 0.0, 100.0, 0.0, 600.0, 0.0, f64::INFINITY, 0.0]),
        )
        .unwrap();
        assert_eq!(seen[0], seen[2], "the period is 100");
        assert!(seen[1][0] > seen[0][0] && seen[1][1] == seen[0][1]);
        assert_eq!(seen[4], NOTHING);
    }

    #[test]
    fn a_quad_is_seen_at_its_middle() {
        let quad = vec![-1.0, -1.0, 1.0, -1.0, 1.0, 1.0, -1.0, 1.0];
        let point = vec![0.0, 0.0, -1.0, -1.0, 1.0, 1.0];
        let quads = looked(Look::Place, 8, Values::F64(quad)).unwrap();
        assert_eq!(quads[0], looked(Look::Place, 2, Values::F64(point)).unwrap()[0]);
    }

    #[test]
    fn colours_are_themselves_and_clamped() {
        let seen = looked(Look::Color, 4, Values::F64(vec![0.0, 0.5, 1.0, 2.0])).unwrap();
        assert_eq!(seen, [[0, 128, 255, 255]]);
    }

    #[test]
    fn levels_have_hues_and_between_two_of_them_a_mixture() {
        let seen = looked(Look::Level, 1, Values::F64(vec![0.0, 0.5, 1.0, 6.0, f64::INFINITY])).unwrap();
        assert_eq!((seen[0], seen[2]), ([228, 66, 60, 255], [245, 148, 49, 255]));
        assert_eq!(seen[1], [237, 107, 55, 255]);
        assert!(seen[3][0] < seen[0][0] && seen[3][0] > seen[3][1], "the next round is darker");
        assert_eq!(seen[4], NOTHING);
    }

    #[test]
    fn a_picture_of_tiles_shows_their_code_values_and_tables_have_none() {
        assert_eq!(looked(Look::CodeValues, 4, Values::U8(vec![1, 2, 3, 4])), Some(vec![[1, 2, 3, 4]]));
        assert_eq!(looked(Look::Table, 1, Values::U32(vec![1, 2, 3])), None);
        assert_eq!(looked(Look::Table, 1, Values::F64(vec![1.0, 2.0])), None);
    }

    #[test]
    fn what_has_no_picture_has_none() {
        assert_eq!(looked(Look::Count, 3, Values::U32(vec![1, 2, 3])), None);
        assert_eq!(looked(Look::Place, 8, Values::U32(vec![0; 8])), None);
    }

    #[test]
    fn extremes_make_no_panic() {
        for v in [0.0, -0.0, 1e308, -1e308, f64::INFINITY, f64::NEG_INFINITY, 5e-324] {
            for (seen, components) in [(Look::Grey, 1), (Look::Place, 2), (Look::Place, 8), (Look::Color, 4)]
            {
                looked(seen, components, Values::F64(vec![v; 8])).unwrap();
                let mixed = [v, 1.0, -1e308, v, 0.0, v, 1e308, 5e-324];
                looked(seen, components, Values::F64(mixed.to_vec())).unwrap();
            }
        }
    }
}
