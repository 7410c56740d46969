//! Sampling the texture: level and probes from the pixel's footprint, texels and their weights.
//!
//! The isotropic level is that of OpenGL (8.14 of its specification): the binary logarithm of the longer of the footprint's two
//! derivatives. The anisotropic filter takes up to n trilinear probes along the long axis of the ellipse that a round pixel becomes in
//! the plan, at the level of its short axis, after EXT_texture_filter_anisotropic, whose example takes the derivatives for
//! the axes. Derivatives are exact at the visible point: they do not reach across silhouettes.

use super::texture::{ClipRegion, TILE, TileKey, TileWindow, VirtualTexture, power_of_two};
use crate::math;
use crate::scene::Device;
use crate::space::{Plan, Texel};
use crate::technique::clipmap::{Settings, TextureFilter};
use crate::visibility::PixelFootprint;
use glam::DVec2;

/// A ratio of axes that is over a whole number by no more than this needs no further probe: it is rounding.
const SAME_RATIO: f64 = 1e-6;

/// How the texture is sampled in a frame.
#[derive(Debug, Clone)]
pub(super) struct Sampler {
    texture: VirtualTexture,
    windows: Vec<TileWindow>,
    filter: TextureFilter,
    anisotropy: u32,
    bias: f64,
    /// Steps of a weight; 0: any weight.
    steps: f64,
    /// Steps of the weight between two levels; 0: any weight.
    level_steps: f64,
}

/// Where a pixel reads the texture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Probes {
    /// The level that is asked for, between two of them.
    pub(super) level: f64,
    /// The first probe, in the texels of level 0.
    pub(super) first: Texel,
    /// From a probe to the next.
    pub(super) step: DVec2,
    /// How many there are.
    pub(super) count: u32,
}

/// Texels of one level that are read together: one, or a square of four.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Quad {
    pub(super) level: u32,
    /// Column and row of the north-western texel.
    pub(super) at: (i64, i64),
    /// The weights of the eastern and the southern texels among themselves; `None`: one texel.
    pub(super) shares: Option<(f64, f64)>,
    /// The weight of all together.
    pub(super) weight: f64,
    /// Whether a finer level is asked for, and not at hand.
    pub(super) is_fallback: bool,
}

/// The first and the last column and row of the tiles that texels lie in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct TilesOf {
    pub(super) columns: (u32, u32),
    pub(super) rows: (u32, u32),
}

impl Sampler {
    pub(super) fn new(
        texture: VirtualTexture,
        region: &ClipRegion,
        settings: &Settings,
        device: &Device,
    ) -> Self {
        let steps = |bits: u32| if bits > 0 { power_of_two(bits) } else { 0.0 };
        let level_bits = if device.level_bits > 0 { device.level_bits } else { device.filter_bits };
        Self {
            texture,
            windows: (0..texture.levels()).map(|level| region.window(&texture, level)).collect(),
            filter: settings.filter,
            anisotropy: settings.anisotropy,
            bias: settings.level_bias,
            steps: steps(device.filter_bits),
            level_steps: steps(level_bits),
        }
    }

    /// The probes of a pixel that sees a plan point; without a footprint it sees the ground edge-on.
    #[inline(always)]
    pub(super) fn probes(&self, at: Plan, footprint: Option<&PixelFootprint>) -> Probes {
        let center = self.texture.texel(0, at);
        let coarsest = f64::from(self.texture.levels() - 1);
        let scale = 1.0 / self.texture.texel_m(0);
        let level = |length: f64| (math::log2(length * scale) + self.bias).clamp(0.0, coarsest);
        let one = |level: f64| Probes { level, first: center, step: DVec2::ZERO, count: 1 };
        let Some(footprint) = footprint else { return one(coarsest) };
        if self.filter != TextureFilter::Anisotropic {
            return one(level(math::max(footprint.dx.length(), footprint.dy.length())));
        }
        let (axis, short) = axes(footprint);
        let long = axis.length();
        // A quotient of zeros is no number, and its cast 0.
        let wanted = (long / short - SAME_RATIO).ceil().clamp(1.0, f64::from(self.anisotropy)) as u32;
        let count = wanted.max(1);
        // Rows of texels run south.
        let whole = DVec2::new(axis.x, -axis.y) * scale;
        let step = whole / f64::from(count);
        Probes { level: level(long / f64::from(count)), first: center + (step - whole) * 0.5, step, count }
    }

    /// Calls `visit` with all that is read by a pixel's probes; the weights are 1 in all.
    #[inline]
    pub(super) fn quads(&self, probes: &Probes, visit: &mut impl FnMut(Quad)) {
        let share = 1.0 / f64::from(probes.count);
        for k in 0..probes.count {
            let at = probes.first + probes.step * f64::from(k);
            match self.filter {
                // The nearest level: the lower of two that are as near.
                TextureFilter::Nearest => {
                    visit(self.texel(at, (probes.level + 0.5).ceil() as u32 - 1, share))
                }
                TextureFilter::Bilinear => {
                    visit(self.square(at, (probes.level + 0.5).ceil() as u32 - 1, share))
                }
                TextureFilter::Trilinear | TextureFilter::Anisotropic => {
                    self.between_levels(at, probes.level, share, visit);
                }
            }
        }
    }

    fn between_levels(&self, at: Texel, level: f64, weight: f64, visit: &mut impl FnMut(Quad)) {
        let fine = level as u32;
        let square = self.square(at, fine, weight);
        // Where only a coarser level is at hand, the level is that at least (Tanner et al. 1998).
        let between = || rounded(level - f64::from(fine), self.level_steps);
        let share = if square.level > fine { 0.0 } else { between() };
        let keep = 1.0 - share;
        if keep > 0.0 {
            visit(Quad { weight: weight * keep, ..square });
        }
        if share > 0.0 {
            visit(self.square(at, fine + 1, weight * share));
        }
    }

    /// The nearest texel of the finest level that is at hand, from one on.
    fn texel(&self, at: Texel, level: u32, weight: f64) -> Quad {
        let (asked, mut level) = (level, level);
        loop {
            let scale = 1.0 / power_of_two(level);
            let place = (floor(at.x * scale), floor(at.y * scale));
            if self.is_at_hand(level, place, (0, 0)) || level + 1 >= self.texture.levels() {
                return Quad { level, at: place, shares: None, weight, is_fallback: level > asked };
            }
            level += 1;
        }
    }

    /// The four texels around a point in the finest level that is at hand, from one on.
    fn square(&self, at: Texel, level: u32, weight: f64) -> Quad {
        let (asked, mut level) = (level, level);
        loop {
            let scale = 1.0 / power_of_two(level);
            let (x, y) = (at.x * scale - 0.5, at.y * scale - 0.5);
            let place = (floor(x), floor(y));
            if self.is_at_hand(level, place, (1, 1)) || level + 1 >= self.texture.levels() {
                let share = |share: f64| rounded(share, self.steps);
                let shares = (share(x - place.0 as f64), share(y - place.1 as f64));
                return Quad { level, at: place, shares: Some(shares), weight, is_fallback: level > asked };
            }
            level += 1;
        }
    }

    /// Whether the texels from `place` to `place + more` are in the part of a level that is at hand.
    fn is_at_hand(&self, level: u32, place: (i64, i64), more: (i64, i64)) -> bool {
        let window = &self.windows[level as usize];
        let tile = |v: i64| self.clamped(level, v) / TILE as i64;
        window.contains(tile(place.0), tile(place.1))
            && window.contains(tile(place.0 + more.0), tile(place.1 + more.1))
    }

    /// A column or row moved to the level's rim where it lies outside (`CLAMP_TO_EDGE`).
    #[inline]
    pub(super) fn clamped(&self, level: u32, v: i64) -> i64 {
        v.clamp(0, i64::from(self.texture.size(level)) - 1)
    }

    /// The tiles of texels that are read together.
    #[inline]
    pub(super) fn tiles_of(&self, quad: &Quad) -> TilesOf {
        let more = i64::from(quad.shares.is_some());
        let (west, north) = quad.at;
        let tile = |v: i64| (self.clamped(quad.level, v) as usize / TILE) as u32;
        TilesOf { columns: (tile(west), tile(west + more)), rows: (tile(north), tile(north + more)) }
    }

    /// The tile of a texel, and the texel's place in it.
    #[inline]
    pub(super) fn tile_of(&self, level: u32, column: i64, row: i64) -> (TileKey, (usize, usize)) {
        let (column, row) = (self.clamped(level, column) as usize, self.clamped(level, row) as usize);
        let key = TileKey { level, row: (row / TILE) as u32, column: (column / TILE) as u32 };
        (key, (column % TILE, row % TILE))
    }
}

/// A weight as a device stores it that has so many steps of it; 0: any weight.
fn rounded(share: f64, steps: f64) -> f64 {
    if steps > 0.0 { (share * steps + 0.5).floor() / steps } else { share }
}

/// The floor of a place in the texture, without a call for each texel.
#[inline]
fn floor(v: f64) -> i64 {
    let truncated = v as i64;
    truncated - i64::from(v < truncated as f64)
}

/// The long half axis of the ellipse that a footprint is, doubled, and the length of the short one: the singular values of the
/// matrix of its derivatives.
fn axes(PixelFootprint { dx, dy }: &PixelFootprint) -> (DVec2, f64) {
    // The symmetric matrix of the derivatives times its transpose: its larger eigenvalue is the square of the long axis.
    let (p, q, r) = (dx.x * dx.x + dy.x * dy.x, dx.x * dx.y + dy.x * dy.y, dx.y * dx.y + dy.y * dy.y);
    let spread = ((p - r) * (p - r) + 4.0 * q * q).sqrt();
    let square = 0.5 * (p + r + spread);
    // Of two expressions for its eigenvector, the longer; of a circle any direction is an axis.
    let (a, b) = (DVec2::new(square - r, q), DVec2::new(q, square - p));
    let along = if a.length_squared() > b.length_squared() { a } else { b };
    let direction = along.try_normalize().unwrap_or(DVec2::X);
    let long = square.sqrt();
    (direction * long, dx.perp_dot(*dy).abs() / long)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::PlanBox;
    use proptest::prelude::*;

    fn sampler(settings: &Settings, filter_bits: u32) -> Sampler {
        let bounds = PlanBox { min: Plan::new(0.0, 0.0), max: Plan::new(1024.0, 1024.0) };
        let texture = VirtualTexture::over(&bounds, 4096);
        let region = ClipRegion::new(&texture, Plan::new(512.0, 512.0), settings.clip_size);
        let device = Device { filter_bits, ..Device::default() };
        Sampler::new(texture, &region, settings, &device)
    }

    fn settings(filter: TextureFilter) -> Settings {
        Settings { filter, anisotropy: 16, clip_size: 1 << 20, ..Settings::default() }
    }

    fn footprint(a: f64, b: f64, c: f64, d: f64) -> PixelFootprint {
        PixelFootprint { dx: DVec2::new(a, b), dy: DVec2::new(c, d) }
    }

    fn quads(sampler: &Sampler, probes: &Probes) -> Vec<Quad> {
        let mut all = Vec::new();
        sampler.quads(probes, &mut |quad| all.push(quad));
        all
    }

    const MIDDLE: Plan = Plan::new(500.0, 500.0);

    #[test]
    fn a_footprint_of_one_texel_asks_for_level_0_and_of_eight_for_level_3() {
        // A texel is a quarter of a metre.
        let sampler = sampler(&settings(TextureFilter::Trilinear), 0);
        let level = |size: f64| sampler.probes(MIDDLE, Some(&footprint(size, 0.0, 0.0, size))).level;
        assert_eq!([0.01, 0.25, 0.5, 2.0, 1e9].map(level), [0.0, 0.0, 1.0, 3.0, 12.0]);
        assert_eq!(sampler.probes(MIDDLE, None).level, 12.0, "edge-on: the coarsest");
    }

    #[test]
    fn the_isotropic_level_follows_the_longer_derivative() {
        let sampler = sampler(&settings(TextureFilter::Bilinear), 0);
        assert_eq!(sampler.probes(MIDDLE, Some(&footprint(0.25, 0.0, 0.0, 4.0))).level, 4.0);
    }

    #[test]
    fn anisotropy_takes_as_many_probes_as_the_long_axis_is_longer() {
        let sampler = sampler(&settings(TextureFilter::Anisotropic), 0);
        let probes = sampler.probes(MIDDLE, Some(&footprint(0.5, 0.0, 0.0, 2.0)));
        assert_eq!((probes.count, probes.level), (4, 1.0));
        // From north to south, in texels of level 0: the axis is 8 texels long, probes in the middle of its quarters.
        let center = sampler.texture.texel(0, MIDDLE);
        let from_center = |k: u32| (probes.first + probes.step * f64::from(k)) - center;
        let ys: Vec<f64> = (0..4).map(|k| from_center(k).y.abs()).collect();
        assert_eq!(ys, [3.0, 1.0, 1.0, 3.0]);
        assert!((0..4).all(|k| from_center(k).x.abs() < 1e-12));
        let round = sampler.probes(MIDDLE, Some(&footprint(0.6, 0.8, -0.8, 0.6)));
        assert_eq!((round.count, round.level), (1, 2.0));
        let grazing = sampler.probes(MIDDLE, Some(&footprint(0.25, 0.0, 0.0, 1e6)));
        assert_eq!(grazing.count, 16, "no more than is allowed");
    }

    #[test]
    fn the_axis_is_that_of_the_ellipse_and_not_of_a_derivative() {
        // A shear: both derivatives are shorter than the long axis.
        let (axis, short) = axes(&footprint(1.0, 0.0, 1.0, 1.0));
        let golden = 0.5 * (1.0 + 5f64.sqrt());
        assert!((axis.length() - golden).abs() < 1e-12 && (short - 1.0 / golden).abs() < 1e-12);
        assert_eq!(axes(&footprint(0.0, 0.0, 0.0, 0.0)).0, DVec2::ZERO);
    }

    #[test]
    fn nearest_reads_one_texel_and_bilinear_four() {
        let nearest = sampler(&settings(TextureFilter::Nearest), 0);
        let bilinear = sampler(&settings(TextureFilter::Bilinear), 0);
        // Level 1 has texels of half a metre: (100.3, 1024 - 100.9) lies in texel (200, 201), near its north-eastern corner.
        let at = Plan::new(100.3, 1024.0 - 100.6);
        let probes = nearest.probes(at, Some(&footprint(0.5, 0.0, 0.0, 0.5)));
        assert_eq!(
            quads(&nearest, &probes),
            [Quad { level: 1, at: (200, 201), shares: None, weight: 1.0, is_fallback: false }]
        );
        let quad = quads(&bilinear, &probes)[0];
        assert_eq!((quad.level, quad.at), (1, (200, 200)));
        let (x, y) = quad.shares.unwrap();
        assert!((x - 0.1).abs() < 1e-9 && (y - 0.7).abs() < 1e-9);
    }

    #[test]
    fn a_level_between_two_mixes_them() {
        let sampler = sampler(&settings(TextureFilter::Trilinear), 0);
        let size = 0.25 * 2f64.sqrt() * 2.0;
        let quads = quads(&sampler, &sampler.probes(MIDDLE, Some(&footprint(size, 0.0, 0.0, size))));
        assert_eq!(quads.iter().map(|q| q.level).collect::<Vec<_>>(), [1, 2]);
        assert!(quads.iter().all(|q| (q.weight - 0.5).abs() < 1e-9));
    }

    #[test]
    fn beyond_the_clip_region_a_coarser_level_is_read() {
        let clipped = Settings { clip_size: 256, ..settings(TextureFilter::Trilinear) };
        let sampler = sampler(&clipped, 0);
        let small = footprint(0.25, 0.0, 0.0, 0.25);
        let levels = |x: f64| {
            quads(&sampler, &sampler.probes(Plan::new(x, 500.0), Some(&small)))
                .iter()
                .map(|q| q.level)
                .collect::<Vec<_>>()
        };
        // Of one tile, the regions are 64, 128, 256, ... m wide from (512, 512) to the south-east.
        assert_eq!([540.0, 620.0, 700.0, 1000.0].map(levels), [vec![0], vec![1], vec![2], vec![3]]);
        // Of the square of texels around the last centre in a region, two lie beyond it.
        assert_eq!([575.875 - 1e-6, 575.875 + 1e-6].map(levels), [vec![0], vec![1]]);
        let is_fallback =
            |x: f64| quads(&sampler, &sampler.probes(Plan::new(x, 500.0), Some(&small)))[0].is_fallback;
        assert_eq!([540.0, 620.0].map(is_fallback), [false, true]);
    }

    #[test]
    fn weights_have_the_devices_fraction_bits() {
        let sampler = sampler(&settings(TextureFilter::Anisotropic), 4);
        let probes = sampler.probes(Plan::new(123.456, 654.321), Some(&footprint(0.3, 0.1, -0.2, 0.9)));
        for quad in quads(&sampler, &probes) {
            let (x, y) = quad.shares.unwrap();
            assert!([x, y, quad.weight * f64::from(probes.count)].iter().all(|v| (v * 16.0).fract() == 0.0));
        }
    }

    #[test]
    fn the_weight_between_levels_may_have_fewer_bits_than_others() {
        let device = Device { filter_bits: 8, level_bits: 2, ..Device::default() };
        let own = sampler(&settings(TextureFilter::Trilinear), 0);
        let region = ClipRegion::new(&own.texture, MIDDLE, 4096);
        let sampler = Sampler::new(own.texture, &region, &settings(TextureFilter::Trilinear), &device);
        let at = Plan::new(123.456, 654.321);
        for quad in quads(&sampler, &sampler.probes(at, Some(&footprint(0.3, 0.0, 0.0, 0.3)))) {
            let (x, y) = quad.shares.unwrap();
            assert!([x, y].iter().all(|v| (v * 256.0).fract() == 0.0) && (quad.weight * 4.0).fract() == 0.0);
        }
    }

    proptest! {
        #[test]
        fn weights_sum_to_one_and_texels_are_in_the_texture(
            x in -100.0..1200.0f64, y in -100.0..1200.0f64, f in prop::array::uniform4(-50.0..50.0f64),
            filter in 0..4usize, bits in 8..13u32, filter_bits in 0..9u32,
        ) {
            let filter = [TextureFilter::Nearest, TextureFilter::Bilinear, TextureFilter::Trilinear, TextureFilter::Anisotropic][filter];
            let sampler = sampler(&Settings { clip_size: 1 << bits, ..settings(filter) }, filter_bits);
            let probes = sampler.probes(Plan::new(x, y), Some(&footprint(f[0], f[1], f[2], f[3])));
            let quads = quads(&sampler, &probes);
            prop_assert!((quads.iter().map(|q| q.weight).sum::<f64>() - 1.0).abs() < 1e-9);
            for quad in quads {
                let (key, place) = sampler.tile_of(quad.level, quad.at.0 + 1, quad.at.1);
                prop_assert!(key.column < sampler.texture.tiles(quad.level) && place.0 < sampler.texture.tile_size(quad.level));
            }
        }
    }
}
